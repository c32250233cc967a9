"""Picture of bifurcation curves."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .style import EVENT_COLOURS, axes, label

#: Lines of the curves of one kind, by period and level.
LINES = ["-", "--", ":", "-."]

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._bifurcations import BifurcationsResult


def plot_bifurcations(result: BifurcationsResult, ax: Axes | None = None) -> Axes:
    """Draws the curves over the plane of the two keys, a colour for each kind, and in it a line for each period and level."""
    groups = sorted({(one.kind, one.period_cycles, one.level or one.kind) for one in result})
    used: set[tuple[str, int, str]] = set()
    with axes(ax) as ax:
        for one in result:
            group = (one.kind, one.period_cycles, one.level or one.kind)
            text = None if group in used else f"{group[2]}, period {one.period_cycles}"
            used.add(group)
            line = LINES[[own for own in groups if own[0] == one.kind].index(group) % len(LINES)]
            ax.plot(one.parameter, one.parameter_2, line, color=EVENT_COLOURS[one.kind], label=text)
        label(ax.xaxis, result.key, result.unit)
        label(ax.yaxis, result.key_2, result.unit_2)
        if groups:
            ax.legend()
    return ax
