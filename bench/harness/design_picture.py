"""Quality against evaluations and against CPU time, one row per problem: the median of the searches and their range."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from statistics import median
from typing import Any

from .design_problems import Problem
from .design_report import JOUNCE, Run, best_so_far, groups, hypervolume, hypervolume_so_far

Trace = list[tuple[int, float, float]]


def at(trace: Trace, axis: int, place: float) -> float:
    """Returns the value of a trace at a number of evaluations (axis 0) or a CPU time (axis 1); 0 before its first design."""
    return max((step[2] for step in trace if step[axis] <= place), default=0.0)


def band(traces: list[Trace], axis: int) -> list[tuple[float, float, float, float]]:
    """Returns place, median and extremes of several traces wherever one of them changes."""
    places = sorted({step[axis] for trace in traces for step in trace})
    values = ((place, [at(trace, axis, place) for trace in traces]) for place in places)
    return [(place, median(each), min(each), max(each)) for place, each in values]


def jounce_band(runs: list[Run], axis: int, value: Any) -> list[tuple[float, float, float, float]]:  # noqa: ANN401 (a function of a run)
    """Returns the same for `jounce design`, of which each budget is a search: medians of the place too."""
    found = []
    for group in groups([run for run in runs if run.method == JOUNCE]).values():
        places = [run.record["evaluations" if axis == 0 else "cpu_s"] for run in group]
        values = [value(run) for run in group]
        found.append((median(places), median(values), min(values), max(values)))
    return found


def draw(problems: Sequence[Problem], runs: dict[str, list[Run]], path: Path) -> None:
    """Draws all problems into one figure and saves it."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "jounce", "svg.fonttype": "none"})
    import matplotlib.pyplot as plt

    drawn = [problem for problem in problems if runs.get(problem.name)]
    figure, axes = plt.subplots(len(drawn), 2, figsize=(10.0, 3.0 * len(drawn) + 0.6), squeeze=False)
    for row, problem in zip(axes, drawn, strict=True):
        panels(row, problem, [run for run in runs[problem.name] if not run.is_of_run])
    for axis, text in zip(axes[-1], ("evaluations", "CPU time, s"), strict=True):
        axis.set_xlabel(text)
    handles, labels = axes[0][0].get_legend_handles_labels()
    others, names = axes[-1][0].get_legend_handles_labels()
    both = dict(zip(labels + names, handles + others, strict=True))
    figure.legend(both.values(), both.keys(), loc="outside upper center", ncols=3, fontsize=8)
    figure.set_layout_engine("constrained")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
    plt.close(figure)


def panels(row: Any, problem: Problem, runs: list[Run]) -> None:  # noqa: ANN401 (axes of matplotlib)
    """Draws the two panels of a problem."""
    is_front = len(problem.goals) > 1
    value = (lambda run: hypervolume(sorted(run.record["front"]))) if is_front else (lambda run: run.value() or 0.0)
    peers = {name: group for (name, _), group in groups(runs).items() if name != JOUNCE}
    for index, axis in enumerate(row):
        curves = {JOUNCE: jounce_band(runs, index, value)}
        for name, group in peers.items():
            traces = [(hypervolume_so_far if is_front else best_so_far)(run.record["points"]) for run in group]
            curves[name] = band(traces, index)
        for number, (name, curve) in enumerate(curves.items()):
            places, middle, low, high = ([step[k] * (problem.scale if k else 1.0) for step in curve] for k in range(4))
            is_jounce = name == JOUNCE
            colour = "black" if is_jounce else f"C{number - 1 + (4 if is_front else 0)}"
            if is_jounce:
                errors = [[m - b for m, b in zip(middle, low, strict=True)], [t - m for m, t in zip(middle, high, strict=True)]]
                axis.errorbar(places, middle, errors, color=colour, marker="o", markersize=4, capsize=3, label=name, zorder=5)
            else:
                axis.plot(places, middle, color=colour, drawstyle="steps-post", linewidth=1.3, label=name)
                axis.fill_between(places, low, high, color=colour, step="post", alpha=0.12, linewidth=0.0)
        axis.set(xscale="log", title=problem.title)
        axis.grid(True, which="major", linewidth=0.3)
    row[0].set_ylabel(f"{'hypervolume' if is_front else 'expected power'}, {problem.unit}")
