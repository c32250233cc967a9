"""Compares `jounce design` with SciPy, Optuna and pymoo at the same budget and the same goal, and writes DESIGN.md and its picture.

`python bench/design.py --help` lists the options. Needs the Python package of jounce with its extra `plot`, and scipy, optuna, cmaes and
pymoo. Each search is stored when it ends; the same command continues after an interruption. Two commands with different `--problem` may
run at the same time.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from harness import design_report as report
from harness import machine
from harness.build import say
from harness.design_evaluation import design_once, evaluator_of, of_run, run_w, spec_of
from harness.design_peers import FRONT_PEERS, PEERS, search
from harness.design_problems import PROBLEMS, Problem

HERE = Path(__file__).resolve().parent
PICTURE = HERE.parent / "book" / "src" / "pictures" / "design-comparison.svg"

#: Starts that no search has used, on which every best design is judged.
JUDGE_STARTS, JUDGE_SEED = 100, 1000

Record = dict[str, Any]


def options() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    names = [problem.name for problem in PROBLEMS]
    parser.add_argument("--problem", choices=names, action="append", help="only this problem; can be given several times")
    parser.add_argument("--seeds", type=int, default=5, help="searches of each method, with the seeds 1, 2, and so on")
    parser.add_argument("--quick", action="store_true", help="one seed, a quarter of the budget; DESIGN.md stays as it is")
    parser.add_argument("--report", action="store_true", help="search nothing; write DESIGN.md and the picture from what is stored")
    parser.add_argument("--keep", action="store_true", help="leave DESIGN.md and the picture as they are")
    return parser.parse_args()


def stored(path: Path, make: Callable[[], Record]) -> None:
    """Makes a record and writes it, unless it exists."""
    if path.exists():
        return
    begin = time.perf_counter()
    record = make()
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_suffix(".part")
    part.write_text(json.dumps(record, indent=1))
    part.rename(path)
    say(f"{path.parent.name}/{path.stem}: {time.perf_counter() - begin:.1f} s")


def by_jounce(problem: Problem, seed: int, evaluations: int) -> Record:
    """One search of `jounce design` on one thread; its time includes the examination of the best design."""
    spec = spec_of(problem)
    cpu_s, wall_s = time.process_time(), time.perf_counter()
    found = spec.design(problem.design(evaluations), seed=seed, threads=1)
    cpu_s, wall_s = time.process_time() - cpu_s, time.perf_counter() - wall_s
    # Values have all digits, so that this is the place of the search again.
    values = {key: float(text.split(" ")[0]) for key, text in zip(found.key, found.value, strict=True)}
    place = tuple(key.place(values[key.path]) for key in problem.keys)
    goals = tuple(found.goals[name] for name in problem.goals)
    front = [[each["goals"][name] for name in problem.goals] for each in found.front]
    point = {"place": place, "goals": goals, "violation": found.violation, "cpu_s": cpu_s, "wall_s": wall_s}
    record = {"points": [point], "evaluations": found.evaluations, "cpu_s": cpu_s, "wall_s": wall_s, "front": front}
    record |= {"ended_by": found.ended_by}
    return record | ({} if front else {"judged": judge(problem, place, seed)})


def by_peer(problem: Problem, method: str, seed: int, is_run: bool, budget: int) -> Record:
    """One search of a peer."""
    peers = FRONT_PEERS if len(problem.goals) > 1 else PEERS
    evaluate = of_run(problem, seed) if is_run else evaluator_of(problem, seed)
    asked = dataclasses.replace(problem, limits={}) if is_run else problem
    counted = search(peers[method], asked, evaluate, budget, seed)
    points = [dataclasses.asdict(point) for point in counted.points]
    record = {"points": points, "evaluations": len(points), "cpu_s": points[-1]["cpu_s"], "wall_s": points[-1]["wall_s"], "front": []}
    if len(problem.goals) > 1:
        return record | {"front": report.front(points)}
    return record | {"judged": judge(problem, tuple(report.best(points)["place"]), seed)}


def judge(problem: Problem, place: tuple[float, ...], seed: int) -> Record:
    """Returns a design's evaluation by `Spec.design` over the starts of the search and over fresh ones, and the power of a long run."""
    own, fresh = design_once(problem, place, seed), design_once(problem, place, JUDGE_SEED, JUDGE_STARTS)
    limits = {each["name"]: each["value"] for each in fresh.limits}
    return {
        "own_w": own.goals["expected-power"],
        "own_violation": own.violation,
        "fresh_w": fresh.goals["expected-power"],
        "basin_fraction": fresh.basin_fraction,
        "limits": limits,
        "long_run_w": run_w(problem, place, *problem.long_run),
    }


def search_all(problem: Problem, folder: Path, seeds: int, share: float) -> None:
    """Makes all records of a problem, seed by seed, so that an early end leaves all methods."""
    budget = round(share * problem.evaluations)
    peers = FRONT_PEERS if len(problem.goals) > 1 else PEERS
    for seed in range(1, seeds + 1):
        for most in problem.jounce_evaluations:
            evaluations = max(1, round(share * most))
            path = folder / problem.name / f"{report.JOUNCE}-{evaluations}-{seed}.json"
            stored(path, lambda seed=seed, evaluations=evaluations: by_jounce(problem, seed, evaluations))
        for method in peers:
            for is_run in (False, True) if problem.name == "hard" else (False,):
                name = f"{method}{report.OF_RUN if is_run else ''}-{budget}-{seed}.json"
                stored(
                    folder / problem.name / name,
                    lambda method=method, seed=seed, is_run=is_run: by_peer(problem, method, seed, is_run, budget),
                )


def main() -> None:
    """Searches, judges, writes."""
    chosen = options()
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[name] = "1"
    folder = HERE / "results" / ("design-quick" if chosen.quick else "design")
    wanted = [problem for problem in PROBLEMS if not chosen.problem or problem.name in chosen.problem]
    if not chosen.report:
        for problem in wanted:
            search_all(problem, folder, 1 if chosen.quick else chosen.seeds, 0.25 if chosen.quick else 1.0)
    runs = {problem.name: report.complete(report.read_runs(folder / problem.name)) for problem in wanted}
    text = report.report(described(), wanted, runs)
    if not (chosen.quick or chosen.keep or chosen.problem):
        from harness import design_picture

        (HERE / "DESIGN.md").write_text(text)
        design_picture.draw(wanted, runs, PICTURE)
    print(text)


def described() -> list[str]:
    """Returns the machine and the versions."""
    from importlib.metadata import version

    versions = ", ".join(f"{name} {version(name)}" for name in ("jounce", "scipy", "optuna", "cmaes", "pymoo"))
    return [f"CPU: {machine.processor()}, {os.cpu_count()} cores, shared with other work; every search on one thread", versions]


if __name__ == "__main__":
    main()
