"""Measures what the Python package adds to one run of the library; `python_study.py` measures studies.

`python bench/python_overhead.py --help` lists the options. Needs the package, and cargo; load on the machine falls on
all figures, so leave it alone meanwhile.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path
from statistics import median
from typing import Any

import jounce

from harness import build, machine, process

HERE = Path(__file__).resolve().parent
SPEC = HERE.parent / "examples" / "impact-harvester-2019" / "harvester.toml"


def options() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=101, help="repetitions of the single run")
    parser.add_argument("--without-rust", action="store_true", help="leave out the library's own call, which cargo builds")
    return parser.parse_args()


def outside_python_s(repeats: int) -> list[float]:
    """Wall time of `run` on the paper's spec, warm, less the march inside it."""
    spec = jounce.read(SPEC)
    spec.run()
    outside_s = []
    for _ in range(repeats):
        begin = time.perf_counter()
        answer = spec.run()
        outside_s.append(time.perf_counter() - begin - answer.march_s)
    return outside_s


def outside_rust_s(program: Path, repeats: int) -> list[float]:
    """The same of `simulate` in Rust, each in a process that has marched a part of the run before."""
    outside_s = []
    for _ in range(repeats):
        done = process.finish([str(program), str(SPEC), "warm"], HERE, 300.0)
        if done.failed:
            sys.exit(f"peer-jounce failed: {done.failed}")
        found = json.loads(done.stdout)
        outside_s.append(found["wall_s"] - found["march_s"])
    return outside_s


def run_figures(chosen: argparse.Namespace) -> dict[str, Any]:
    """What a single run costs beside its march."""
    python_s = median(outside_python_s(chosen.repeats))
    found: dict[str, Any] = {"run_outside_march_python_s": python_s}
    program = None if chosen.without_rust else build.compile_jounce()
    if program:
        rust_s = median(outside_rust_s(program, chosen.repeats))
        found |= {"run_outside_march_rust_s": rust_s, "run_overhead_s": python_s - rust_s}
    return found


def told(figures: dict[str, Any]) -> str:
    """The figures for reading."""

    def ms(s: float) -> str:
        return f"{1e3 * s:.3f} ms"

    line = f"run, what is not marching: {ms(figures['run_outside_march_python_s'])} in Python"
    if "run_overhead_s" in figures:
        line += f", {ms(figures['run_outside_march_rust_s'])} in Rust; overhead {ms(figures['run_overhead_s'])}"
    return "\n".join([*figures["machine"], line])


def main() -> None:
    """Measures and writes."""
    chosen = options()
    described = [f"CPU: {machine.processor()}", f"jounce {jounce.__version__}, Python {sys.version.split()[0]}"]
    figures = {"machine": described, **run_figures(chosen)}
    folder = HERE / "results"
    folder.mkdir(exist_ok=True)
    stem = folder / time.strftime("python-%Y-%m-%dT%H-%M-%S")
    stem.with_suffix(".json").write_text(json.dumps(figures, indent=1))
    print(told(figures))


if __name__ == "__main__":
    main()
