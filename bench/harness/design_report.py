"""DESIGN.md: what each optimiser reached on each problem, in how many evaluations and seconds."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

from .design_problems import Problem

JOUNCE = "jounce design"
OF_RUN = ", one run"

#: Share of the best known value at which the time of a search is read.
NEAR = 0.95

Points = list[dict[str, Any]]


@dataclass(frozen=True)
class Run:
    """One stored search."""

    method: str
    budget: int
    seed: int
    record: dict[str, Any]

    @property
    def is_of_run(self) -> bool:
        """True where the objective was one run of 20 s."""
        return self.method.endswith(OF_RUN)

    def value(self) -> float | None:
        """Returns the first goal of the best design in SI, or None where it is beyond the limits."""
        found = best(self.record["points"])
        return found["goals"][0] if found["violation"] == 0.0 else None


def read_runs(folder: Path) -> list[Run]:
    """Reads what is stored of a problem."""
    runs = []
    for path in sorted(folder.glob("*.json")):
        method, budget, seed = path.stem.rsplit("-", 2)
        runs.append(Run(method, int(budget), int(seed), json.loads(path.read_text())))
    return sorted(runs, key=lambda run: (run.method != JOUNCE, run.method, run.budget, run.seed))


def complete(runs: list[Run]) -> list[Run]:
    """Returns the searches with the seeds that every method has at every budget: the others are still to come."""
    seeds = [{run.seed for run in group} for group in groups(runs).values()]
    common = set.intersection(*seeds) if seeds else set()
    return [run for run in runs if run.seed in common]


def best(points: Points) -> dict[str, Any]:
    """Returns the point with the least violation, of those the one with the largest first goal (Deb 2000)."""
    return min(points, key=lambda point: (point["violation"], -point["goals"][0]))


def best_so_far(points: Points) -> list[tuple[int, float, float]]:
    """Returns number of evaluations, CPU time, s, and first goal of each design within the limits that is better than all before it."""
    found: list[tuple[int, float, float]] = []
    for number, point in enumerate(points, 1):
        value = point["goals"][0]
        if point["violation"] == 0.0 and (not found or value > found[-1][2]):
            found.append((number, point["cpu_s"], value))
    return found


def front(points: Points) -> list[list[float]]:
    """Returns the goals of the designs within the limits that no other one beats in both goals, by increasing first goal."""
    chosen: list[list[float]] = []
    within = [point["goals"] for point in points if point["violation"] == 0.0]
    for first, second in sorted(within, key=lambda goals: (-goals[0], -goals[1])):
        if not chosen or second > chosen[-1][1]:
            chosen.append([first, second])
    return chosen[::-1]


def hypervolume(goals: list[list[float]]) -> float:
    """Returns the area of the two goals that a front dominates, from the origin."""
    area, width = 0.0, 0.0
    for first, second in goals:
        area += (first - width) * second
        width = first
    return area


def hypervolume_so_far(points: Points) -> list[tuple[int, float, float]]:
    """Returns number of evaluations, CPU time, s, and hypervolume after each evaluation."""
    return [(number, point["cpu_s"], hypervolume(front(points[:number]))) for number, point in enumerate(points, 1)]


def span(values: Sequence[float], form: Callable[[float], str] = "{:.3g}".format) -> str:
    """Returns median and extremes."""
    return f"{form(median(values))} [{form(min(values))} .. {form(max(values))}]" if values else "none"


def best_by_seed(runs: list[Run]) -> dict[int, float]:
    """Returns the largest first goal of any method for the starts of each seed."""
    found: dict[int, float] = {}
    for run in runs:
        value = None if run.is_of_run else run.value()
        if value is not None:
            found[run.seed] = max(value, found.get(run.seed, 0.0))
    return found


def near_s(group: list[Run], known: dict[int, float]) -> list[float]:
    """Returns the CPU time of each search of a peer until NEAR of the best known value, of those that reach it."""
    traces = ((run, best_so_far(run.record["points"])) for run in group)
    times = (next((cpu_s for _, cpu_s, value in trace if value >= NEAR * known[run.seed]), None) for run, trace in traces)
    return [each for each in times if each is not None]


def groups(runs: list[Run]) -> dict[tuple[str, int], list[Run]]:
    """Returns the searches of each method at each budget."""
    found: dict[tuple[str, int], list[Run]] = {}
    for run in runs:
        found.setdefault((run.method, run.budget), []).append(run)
    return found


def power_row(problem: Problem, name: str, group: list[Run], known: dict[int, float]) -> str:
    """Returns one line of the table of a problem with one goal."""
    kept = [(run, value) for run in group if (value := run.value()) is not None]
    shares = [value / known[run.seed] for run, value in kept]
    judged = [run.record["judged"] for run, _ in kept]
    near = near_s(group, known)
    cells = [
        span([run.record["evaluations"] for run in group], "{:.0f}".format),
        span([run.record["cpu_s"] for run in group]),
        span([problem.scale * value for _, value in kept]),
        span(shares, "{:.0%}".format),
        f"{len(kept)} of {len(group)}",
        f"{span(near)} ({len(near)} of {len(group)})" if near else "not reached",
        span([problem.scale * each["fresh_w"] for each in judged]),
        span([each["basin_fraction"] for each in judged], "{:.2f}".format),
        span([problem.scale * each["long_run_w"] for each in judged]),
    ]
    return f"| {name} | " + " | ".join(cells) + " |"


def power_table(problem: Problem, runs: list[Run]) -> list[str]:
    """Returns the table of a problem with one goal."""
    known = best_by_seed(runs)
    length_s, unit = problem.long_run[0], problem.unit
    columns = ["method", "evaluations", "CPU s", f"expected power, {unit}", "of the best known", "within limits"]
    columns += [
        f"CPU s to {NEAR:.0%} of the best",
        "expected power, 100 other starts",
        "share of these on the main orbit",
        f"run of {length_s:g} s",
    ]
    lines = ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
    for (method, budget), group in groups([run for run in runs if not run.is_of_run]).items():
        name = f"{method}, budget {budget}" if method == JOUNCE else method
        lines.append(power_row(problem, name, group, known))
    return lines


def trap_table(problem: Problem, runs: list[Run]) -> list[str]:
    """Returns what searches over runs of 20 s claim, and what their designs give."""
    lines = [
        f"| method | claim, {problem.unit} | run of {problem.long_run[0]:g} s from rest | expected power | starts on the main orbit |",
        "|---|---|---|---|---|",
    ]
    for (method, _), group in groups([run for run in runs if run.is_of_run]).items():
        claims = [problem.scale * best(run.record["points"])["goals"][0] for run in group]
        judged = [run.record["judged"] for run in group]
        cells = [span(claims), *(span([problem.scale * each[name] for each in judged]) for name in ("long_run_w", "fresh_w"))]
        cells.append(span([each["basin_fraction"] for each in judged], "{:.2f}".format))
        lines.append(f"| {method.removesuffix(OF_RUN)} | " + " | ".join(cells) + " |")
    return lines


def front_table(problem: Problem, runs: list[Run]) -> list[str]:
    """Returns the table of a problem with two goals."""
    lines = [f"| method | evaluations | CPU s | hypervolume, {problem.unit} | designs on the front |", "|---|---|---|---|---|"]
    for (method, budget), group in groups(runs).items():
        fronts = [run.record["front"] for run in group]
        cells = [
            span([run.record["evaluations"] for run in group], "{:.0f}".format),
            span([run.record["cpu_s"] for run in group]),
            span([problem.scale * hypervolume(sorted(each)) for each in fronts]),
            span([len(each) for each in fronts], "{:.0f}".format),
        ]
        name = f"{method}, budget {budget}" if method == JOUNCE else method
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return lines


def largest_difference(runs: list[Run]) -> float:
    """Returns the largest relative difference of a search's value of its best design from that of `Spec.design`."""
    pairs = [(run.value(), run.record["judged"]["own_w"]) for run in runs if "judged" in run.record and not run.is_of_run]
    return max((abs(own / value - 1.0) for value, own in pairs if value), default=0.0)


def section(problem: Problem, runs: list[Run]) -> list[str]:
    """Returns the section of a problem."""
    seeds = len({run.seed for run in runs})
    lines = [
        f"## {problem.title}",
        "",
        f"Searches of each method: {seeds}.",
        "",
        *(front_table if len(problem.goals) > 1 else power_table)(problem, runs),
        "",
    ]
    if len(problem.goals) == 1:
        difference = largest_difference(runs)
        text = "`Spec.design` over the same starts gives the value of each search for its best design, within a relative difference of"
        lines += [f"{text} {difference:.1e}.", ""]
    if any(run.is_of_run for run in runs):
        lines += ["### The same with one run of 20 s as objective", "", *trap_table(problem, runs), ""]
    return lines


def report(described: list[str], problems: Sequence[Problem], runs: dict[str, list[Run]]) -> str:
    """Returns the text of DESIGN.md."""
    lines = ["# Design", "", "Written by `bench/design.py`; `bench/README.md` explains it.", "", *(f"- {line}" for line in described)]
    lines += ["- Each cell: median [least .. largest].", ""]
    for problem in problems:
        if runs.get(problem.name):
            lines += section(problem, runs[problem.name])
    return "\n".join(lines).rstrip() + "\n"
