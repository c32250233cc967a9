"""Times of jounce without a peer: a complete process, a figure of sweeps, the complete reproduction. On all cores."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from .build import say
from .process import finish

LEVELS_N = (50, 100, 200)
SWEEP = ("--over", "drive.shaker.frequency=4Hz:20Hz:0.1Hz", "--direction", "both", "--fixed-duration", "--json")


@dataclass
class Whole:
    """CPU and wall times of one task from start to exit, s; `failed` is the reason of a failure."""

    task: str
    cpu_s: list[float] = field(default_factory=list)
    wall_s: list[float] = field(default_factory=list)
    failed: str | None = None


def timed(binary: Path, task: str, commands: list[list[str]], repeats: int, cap_s: float) -> Whole:
    """Returns the sum over the commands, repeated; each runs in an empty folder, so that it resumes no earlier run."""
    whole = Whole(task)
    for _ in range(repeats):
        cpu_s = wall_s = 0.0
        for words in commands:
            with tempfile.TemporaryDirectory() as folder:
                done = finish([str(binary), *words], Path(folder), cap_s, threads={})
            if done.failed:
                say(f"failed: {task}: {done.failed}")
                whole.failed = done.failed
                return whole
            cpu_s, wall_s = cpu_s + done.cpu_s, wall_s + done.wall_s
        whole.cpu_s.append(cpu_s)
        whole.wall_s.append(wall_s)
    return whole


def whole_tasks(binary: Path, spec: Path, repeats: int, cap_s: float) -> list[Whole]:
    """Runs the three tasks on the paper's spec."""
    sweeps = [["sweep", str(spec), *SWEEP, "--set", f'drive.shaker.amplitude="{level} N"'] for level in LEVELS_N]
    return [
        timed(binary, "`jounce run`, start to exit", [["run", str(spec), "--json"]], 4 * repeats, cap_s),
        timed(binary, f"figure 6: sweeps up and down at {len(LEVELS_N)} levels, 966 runs of 20 s", sweeps, repeats, cap_s),
        timed(binary, "`jounce reproduce`", [["reproduce", "--out", "report"]], min(repeats, 3), cap_s),
    ]
