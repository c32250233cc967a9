"""Picture of branches with their bifurcations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .style import COLOURS, axes, label

if TYPE_CHECKING:
    from ..branch import BranchResult

#: Marker of each kind of bifurcation.
MARKS = {"fold": "s", "period-doubling": "^", "neimark-sacker": "D", "branch-point": "P", "grazing": "o"}


def plot_branch(result: BranchResult, ax: Any = None) -> Any:
    """Draws mean power over the key: stable solid, unstable dashed, a colour for each period, bifurcations marked.

    Without power the displacement amplitude at the first stop is drawn instead.
    """
    harvests = any(one.mean_power_w.any() for one in result)
    periods = sorted({one.period_cycles for one in result})
    named: set[str] = set()

    def once(text: str) -> str | None:
        fresh = text not in named
        named.add(text)
        return text if fresh else None

    with axes(ax) as ax:
        for one in result:
            colour = COLOURS[periods.index(one.period_cycles) % len(COLOURS)]
            for stable in (True, False):
                values = one.mean_power_w if harvests else one.displacement_peak_m
                shown = np.where(_stretch(one.stable, stable), values, np.nan)
                text = once(f"period {one.period_cycles}{'' if stable else ', unstable'}") if (one.stable == stable).any() else None
                ax.plot(one.parameter, shown, "-" if stable else "--", color=colour, label=text)
        for one in result:
            marked = one.bifurcation_power_w if harvests else one.bifurcation_displacement_peak_m
            for kind, at, value in zip(one.bifurcation_kind, one.bifurcation_parameter, marked):
                ax.plot([at], [value], MARKS.get(kind, "x"), color="black", markerfacecolor="white", label=once(kind), zorder=3)
        label(ax.xaxis, result.key, result.unit)
        if harvests:
            label(ax.yaxis, "Mean power", "W", log=True)
        else:
            label(ax.yaxis, "Displacement amplitude", "m")
        ax.legend()
    return ax


def _stretch(stable: Any, wanted: bool) -> Any:
    """Returns the points of one stability; the unstable ones include their neighbours, which avoids gaps at changes of stability."""
    inside = stable == wanted
    if wanted:
        return inside
    joined = inside.copy()
    joined[1:] |= inside[:-1]
    joined[:-1] |= inside[1:]
    return joined
