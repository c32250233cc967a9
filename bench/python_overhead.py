"""Measures the overhead of the Python package on one run of the library, and writes PYTHON.md; `python_study.py` measures studies.

`python bench/python_overhead.py --help` lists the options. Needs the package, and cargo or a built `peer-jounce`. Other load on the machine
changes all figures. Only a full run writes PYTHON.md.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from statistics import median
from typing import IO

import jounce

from harness import build, machine

HERE = Path(__file__).resolve().parent
SPEC = HERE.parent / "examples" / "impact-harvester-2019" / "harvester.toml"

#: Smallest number of repetitions of a full run.
FULL = 200

#: Largest allowed overhead over the library's own call, s.
WANTED_S = 0.2e-3

PYTHON, LIBRARY, MARCHING = "`Spec.run` in Python", "the same library calls, in Rust", "`simulate` alone, in Rust"


def options() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--repeats", type=int, default=2 * FULL, help=f"repetitions of each call, in turn; with fewer than {FULL} PYTHON.md stays"
    )
    parser.add_argument("--peer", type=Path, help="a built peer-jounce; without it cargo builds one")
    return parser.parse_args()


def in_turn(peer: subprocess.Popen[str], repeats: int) -> dict[str, list[tuple[float, float]]]:
    """Returns the wall time of each call, and its part outside the integration, s; the calls alternate, all warm."""
    spec = jounce.read(SPEC)
    spec.run()
    found: dict[str, list[tuple[float, float]]] = {PYTHON: [], LIBRARY: [], MARCHING: []}
    for _ in range(repeats):
        begin = time.perf_counter()
        result = spec.run()
        wall_s = time.perf_counter() - begin
        found[PYTHON].append((wall_s, wall_s - result.wall_time_s))
        said = json.loads(asked(peer.stdin, peer.stdout))
        if "failed" in said:
            sys.exit(f"peer-jounce failed: {said['failed']}")
        if said["mean_power_w"] != result.mean_power_w:
            sys.exit(f"Rust returns {said['mean_power_w']} W, Python {result.mean_power_w} W: not the same version")
        found[LIBRARY].append((said["run_s"], said["run_s"] - said["wall_time_s"]))
        found[MARCHING].append((said["simulate_s"], said["simulate_s"] - said["wall_time_s"]))
    return found


def asked(to: IO[str] | None, of: IO[str] | None) -> str:
    """Requests one more run of the peer."""
    assert to is not None and of is not None
    to.write("\n")
    to.flush()
    return of.readline() or '{"failed": "it ended"}'


def row(name: str, times: Sequence[tuple[float, float]]) -> str:
    """Returns a line of the table."""
    wall_s, outside_s = zip(*times, strict=True)
    cells = (f"{1e3 * pick(kind):.3f}" for kind in (wall_s, outside_s) for pick in (min, median))
    return f"| {name} | {' | '.join(cells)} |"


def report(described: list[str], found: dict[str, list[tuple[float, float]]]) -> str:
    """Returns the text of the report."""
    outside_s = {name: [outside for _, outside in times] for name, times in found.items()}
    lines = ["# Overhead of Python per run", "", "Written by `bench/python_overhead.py`; `bench/README.md` explains it.", ""]
    lines += [f"- {line}" for line in described]
    lines += ["", "| call | wall ms, least | median | outside integration ms, least | median |", "|---|---|---|---|---|"]
    lines += [row(name, times) for name, times in found.items()]
    lines.append("")
    for name in (LIBRARY, MARCHING):
        least_s, middle_s = (pick(outside_s[PYTHON]) - pick(outside_s[name]) for pick in (min, median))
        lines.append(f"- Python minus {name}: {1e3 * least_s:+.3f} ms by the minima, {1e3 * middle_s:+.3f} ms by the medians.")
    lines.append(f"- Target: less than {1e3 * WANTED_S:.1f} ms more than the library calls.")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Measures and writes."""
    chosen = options()
    program = chosen.peer or build.compile_jounce()
    if program is None:
        sys.exit("there is nothing to compare with; install cargo, or name a built peer-jounce with --peer")
    described = [
        f"CPU: {machine.processor()}, {os.cpu_count()} cores; load average at the start {os.getloadavg()[0]:.1f}",
        f"jounce {jounce.__version__}, Python {sys.version.split()[0]}; the paper's spec, {chosen.repeats} runs of each in turn",
    ]
    with subprocess.Popen([str(program), str(SPEC), "each"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as peer:
        found = in_turn(peer, chosen.repeats)
    results = HERE / "results"
    results.mkdir(exist_ok=True)
    (results / time.strftime("python-%Y-%m-%dT%H-%M-%S.json")).write_text(json.dumps({"machine": described, "wall_and_outside_s": found}))
    text = report(described, found)
    if chosen.repeats >= FULL:
        (HERE / "PYTHON.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
