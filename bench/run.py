"""Runs jounce and its peers on one model, in one interleaved run, and writes RESULTS.md and the work-precision picture.

`python3 bench/run.py --help` lists the options. Needs Python 3.11, gcc, cargo and, for ode45, Octave.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
VENV = HERE / ".venv"
REQUIREMENTS = ("numpy>=2.1", "scipy>=1.15", "matplotlib>=3.10")
EIGHT_MODE_CASES = ((50.0, 11.0), (50.0, 6.0), (100.0, 11.0))
MANY_MODE_CASES = ((50.0, 11.0), (50.0, 6.0))


def enter_venv() -> None:
    """Makes bench/.venv once and continues inside it."""
    python = VENV / "bin" / "python"
    if Path(sys.prefix) == VENV:
        return
    if not (VENV / "complete").exists():
        subprocess.run([sys.executable, "-m", "venv", str(VENV)], check=True)
        subprocess.run([str(python), "-m", "pip", "install", "--quiet", *REQUIREMENTS], check=True)
        (VENV / "complete").touch()
    os.execv(python, [str(python), str(Path(sys.argv[0]).resolve()), *sys.argv[1:]])


def options() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("plant", nargs="*", type=Path, help="specs given by modes; default bench/plant.toml and bench/plant-24.toml")
    parser.add_argument(
        "--jounce", type=Path, default=HERE.parent / "target" / "release" / "jounce", help="the program, for whole tasks; left out where absent"
    )
    parser.add_argument("--spec", type=Path, default=HERE.parent / "examples" / "impact-harvester-2019" / "harvester.toml")
    parser.add_argument("--repeats", type=int, default=7, help="repetitions of each compiled method")
    parser.add_argument("--cap", type=float, default=300.0, help="seconds of CPU time after which one run is stopped")
    parser.add_argument("--quick", action="store_true", help="compiled peers only")
    parser.add_argument("--keep", action="store_true", help="leave RESULTS.md and the picture as they are; write only bench/results")
    return parser.parse_args()


def main() -> None:
    """Builds, measures, compares, writes."""
    from harness import build, compare, machine, measure, peers, picture, plant, product, report

    chosen = options()
    build.BUILD.mkdir(exist_ok=True)
    build.write_coefficients()
    described = machine.describe()
    binary = chosen.jounce.resolve() if chosen.jounce.exists() else None
    if binary is None:
        build.say(f"left out: jounce: no binary at {chosen.jounce}")
    results: dict[str, list[measure.Result]] = {}
    references: dict[str, dict[str, tuple[float, float]]] = {}
    modes: dict[str, int] = {}
    for path in chosen.plant or [HERE / "plant.toml", HERE / "plant-24.toml"]:
        model = plant.read_plant(path)
        few = model.modes <= 8
        cases = [plant.Case(*pair) for pair in (EIGHT_MODE_CASES if few else MANY_MODE_CASES)]
        methods = peers.jounce(model, chosen.repeats) + peers.compiled(model.modes, chosen.repeats)
        if few and not chosen.quick:
            methods += peers.interpreted(sys.executable)
        found = measure.run_all(model, cases, methods, chosen.cap)
        tools = [build.BUILD / f"{name}-{model.modes}" for name in ("rk4", "dop853")]
        name = path.stem
        references[name] = {case.title: compare.reference_w(model, case, *tools) for case in cases}
        compare.set_errors(found, {case: reference[0] for case, reference in references[name].items()})
        results[name], modes[name] = found, model.modes
    wholes = product.whole_tasks(binary, chosen.spec.resolve(), chosen.repeats, chosen.cap) if binary else []
    stem = keep(results, wholes)
    text = report.report(described, results, references, wholes, chosen.cap)
    stem.with_suffix(".md").write_text(text)
    if not chosen.keep:
        (HERE / "RESULTS.md").write_text(text)
        pictures = HERE.parent / "book" / "src" / "pictures"
        picture.draw(results, modes, [pictures / "work-precision.svg", HERE / "results" / "work-precision.png"])
    print(text)


def keep(results: dict[str, list[Any]], wholes: list[Any]) -> Path:
    """Stores every number of this run under bench/results before processing; returns the file name without extension."""
    folder = HERE / "results"
    folder.mkdir(exist_ok=True)
    stem = folder / time.strftime("%Y-%m-%dT%H-%M-%S")
    raw = {plant: [dataclasses.asdict(result) for result in found] for plant, found in results.items()}
    stem.with_suffix(".json").write_text(json.dumps({"results": raw, "jounce": [dataclasses.asdict(whole) for whole in wholes]}, indent=1))
    return stem


if __name__ == "__main__":
    enter_venv()
    main()
