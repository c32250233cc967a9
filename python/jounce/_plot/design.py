"""Pictures of a design: the search, and the front."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._design import GOALS
from .style import axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._design import DesignResult


def plot_trace(result: DesignResult, ax: Axes | None = None) -> Axes:
    """Draws the first goal of the best design within the limits over the number of evaluated designs."""
    within = result.trace_violation == 0.0
    evaluation, goal = result.trace_evaluation[within], result.trace_goal[within]
    name = next(iter(result.goals))
    with axes(ax) as ax:
        # The best design stays until the next better one.
        ends = [*evaluation, result.evaluations] if len(goal) else []
        ax.step(ends, [*goal, *goal[-1:]], where="post", color="C0", label="best design within the limits")
        ax.plot(evaluation, goal, "o", color="C0")
        ax.axhline(result.goals_before[name], color="0.5", ls="--", label="spec as given")
        ax.set_xlabel("Evaluations [-]")
        label(ax.yaxis, *GOALS[name])
        ax.legend()
    return ax


def plot_front(result: DesignResult, ax: Axes | None = None) -> Axes:
    """Draws the front over its first two goals."""
    first, second = list(result.goals)[:2]
    with axes(ax) as ax:
        points = [(one["goals"][first], one["goals"][second]) for one in result.front]
        ax.plot([x for x, _ in points], [y for _, y in points], "o")
        label(ax.xaxis, *GOALS[first])
        label(ax.yaxis, *GOALS[second])
    return ax
