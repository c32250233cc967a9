"""Runs jounce, AUTO-07p and a plain harmonic balance on the branch of periodic orbits, and writes ORBITS.md.

`python3 bench/orbits.py --help` lists the options. Needs Python 3.11 and gcc; AUTO-07p also needs the Debian packages auto-07p and
gfortran.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from run import HERE, enter_venv


def options() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--jounce", type=Path, default=HERE.parent / "target" / "release" / "jounce", help="the program; left out where absent")
    parser.add_argument("--repeats", type=int, default=5, help="repetitions of jounce and of the NumPy peer")
    parser.add_argument("--cap", type=float, default=300.0, help="seconds of CPU time after which one run is stopped")
    parser.add_argument("--keep", action="store_true", help="leave ORBITS.md as it is; write only bench/results")
    return parser.parse_args()


def main() -> None:
    """Builds, measures, writes."""
    from harness import branches, build, machine, orbit_report, orbit_run, plant

    chosen = options()
    build.BUILD.mkdir(exist_ok=True)
    build.write_coefficients()
    described = machine.describe()
    model = plant.read_plant(HERE / "plant.toml")
    methods = [branches.numpy_balance(sys.executable, model, chosen.repeats)]
    if auto := build.compile_auto():
        methods = [branches.auto_07p(auto, model, mesh) for mesh in branches.MESHES] + methods
    program = chosen.jounce.resolve() if chosen.jounce.exists() else None
    if program:
        methods = [branches.jounce(program, model, name, chosen.repeats, chosen.cap) for name in branches.JOUNCE_METHODS] + methods
    else:
        build.say(f"left out: jounce: no binary at {chosen.jounce}")
    drawn = orbit_run.draw(methods, chosen.cap)
    rk4, dop853 = (build.compile_c(name, model.modes) for name in ("rk4", "dop853"))
    references = orbit_run.settled_w(model, rk4, dop853) if rk4 and dop853 else {}
    stem = HERE / "results" / time.strftime("orbits-%Y-%m-%dT%H-%M-%S")
    costs: list[orbit_run.Cost] = []
    for measure_costs in (False, True) if program else (False,):  # the branch is on disk before the long second part begins
        if program and measure_costs:
            costs = orbit_run.costs(program, build.compile_jounce(), specs(orbit_run.MODES), chosen.repeats, chosen.cap)
        text = orbit_report.report(described, drawn, references, costs, chosen.cap)
        write(text, stem, {"branch": drawn, "costs": costs}, chosen.keep)
    print(text)


def write(text: str, stem: Path, parts: dict[str, Sequence[Any]], keep: bool) -> None:
    """Stores every number of this run under bench/results, and the report in ORBITS.md."""
    stem.parent.mkdir(exist_ok=True)
    raw = {name: [dataclasses.asdict(each) for each in part] for name, part in parts.items()}
    stem.with_suffix(".json").write_text(json.dumps(raw, indent=1))
    stem.with_suffix(".md").write_text(text)
    if not keep:
        (HERE / "ORBITS.md").write_text(text)


def specs(modes: tuple[int, ...]) -> dict[int, Path]:
    """Returns specs of the harvester with increasing numbers of modes."""
    import make_plant
    from harness.build import BUILD

    paths = {count: BUILD / f"plant-{count}.toml" for count in modes}
    for count, path in paths.items():
        path.write_text(make_plant.spec(make_plant.solve(count)))
    return paths


if __name__ == "__main__":
    enter_venv()
    main()
