"""Picture of bifurcation curves."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .style import COLOURS, axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._bifurcations import BifurcationsResult


def plot_bifurcations(result: BifurcationsResult, ax: Axes | None = None) -> Axes:
    """Draws the curves over the plane of the two keys, a colour for each kind."""
    kinds = sorted({(one.kind, one.period_cycles) for one in result})
    labelled_kinds: set[tuple[str, int]] = set()
    with axes(ax) as ax:
        for one in result:
            kind = (one.kind, one.period_cycles)
            text = None if kind in labelled_kinds else f"{one.kind}, period {one.period_cycles}"
            labelled_kinds.add(kind)
            ax.plot(one.parameter, one.parameter_2, color=COLOURS[kinds.index(kind) % len(COLOURS)], label=text)
        label(ax.xaxis, result.key, result.unit)
        label(ax.yaxis, result.key_2, result.unit_2)
        if kinds:
            ax.legend()
    return ax
