"""Times of jounce that have no peer: a whole process, a figure of sweeps, the whole reproduction."""

from __future__ import annotations

import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from .build import say

LEVELS_N = (50, 100, 200)
SWEEP = ("--over", "drive.shaker.frequency=4Hz:20Hz:0.1Hz", "--direction", "both", "--fixed-duration", "--json")


@dataclass(frozen=True)
class Whole:
    """Wall times of one task, s; `failed` says why there are none."""

    task: str
    wall_s: list[float]
    failed: str | None = None


def once(binary: Path, words: list[str], cap_s: float) -> float | str:
    """Wall time from start to exit, in an empty folder so that nothing is resumed; or why it failed."""
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        try:
            done = subprocess.run([str(binary), *words], cwd=folder, capture_output=True, text=True, timeout=cap_s)
        except subprocess.TimeoutExpired:
            return f"over {cap_s:g} s"
        taken_s = time.perf_counter() - begin
    if done.returncode:
        return (done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[0][:160]
    return taken_s


def timed(binary: Path, task: str, commands: list[list[str]], repeats: int, cap_s: float) -> Whole:
    """The sum over the commands, repeated."""
    sums: list[float] = []
    for _ in range(repeats):
        total = 0.0
        for words in commands:
            taken = once(binary, words, cap_s)
            if isinstance(taken, str):
                say(f"failed: {task}: {taken}")
                return Whole(task, sums, taken)
            total += taken
        sums.append(total)
    return Whole(task, sums)


def whole_tasks(binary: Path, spec: Path, repeats: int, cap_s: float) -> list[Whole]:
    """The three tasks on the paper's spec."""
    sweeps = [["sweep", str(spec), *SWEEP, "--set", f'drive.shaker.amplitude="{level} N"'] for level in LEVELS_N]
    return [
        timed(binary, "`jounce run`, start to exit", [["run", str(spec), "--json"]], 4 * repeats, cap_s),
        timed(binary, f"figure 6: sweeps up and down at {len(LEVELS_N)} levels, 966 runs of 20 s", sweeps, repeats, cap_s),
        timed(binary, "`jounce reproduce`", [["reproduce", "--out", "report"]], min(repeats, 3), cap_s),
    ]
