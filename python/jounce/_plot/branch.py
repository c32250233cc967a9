"""Picture of branches with their bifurcations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._branch import Branch
from .._fields import dataset_fields
from .style import axes, label, label_field, period_colour

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._branch import BranchResult

#: Marker of each kind of event, and how it is filled.
MARKS = {
    "fold": ("s", "full"),
    "period-doubling": ("^", "full"),
    "neimark-sacker": ("D", "full"),
    "branch-point": ("X", "full"),
    "grazing": ("o", "full"),
    "sticking": ("o", "none"),
    "level": (">", "full"),
}


def plot_branch(result: BranchResult, ax: Axes | None, quantity: str) -> Axes:
    """Draws a quantity over the key: stable solid, unstable dashed, a colour for each period, bifurcations marked where it is known."""
    used_labels: set[str] = set()

    def label_once(text: str) -> str | None:
        is_new = text not in used_labels
        used_labels.add(text)
        return text if is_new else None

    with axes(ax) as ax:
        for one in result:
            colour = period_colour(one.period_cycles)
            for stable in (True, False):
                values = getattr(one, quantity)
                segment_values = np.where(_stability_mask(one.stable, stable), values, np.nan)
                text = label_once(f"period {one.period_cycles}{'' if stable else ', unstable'}") if (one.stable == stable).any() else None
                ax.plot(one.parameter, segment_values, "-" if stable else "--", color=colour, label=text)
        for one in result:
            bifurcation_values = getattr(one, f"bifurcation_{quantity}", ())
            for kind, at, value in zip(one.bifurcation_kind, one.bifurcation_parameter, bifurcation_values):
                marker, fill = MARKS[kind]
                ax.plot([at], [value], marker, color="black", fillstyle=fill, label=label_once(kind), zorder=3)
        label(ax.xaxis, result.key, result.unit)
        label_field(ax.yaxis, dataset_fields(Branch)[quantity], quantity == "mean_power_w")
        ax.legend()
    return ax


def _stability_mask(stable: Any, stability: bool) -> Any:
    """Returns the points of one stability; the unstable ones include their neighbours, which avoids gaps at changes of stability."""
    mask = stable == stability
    if stability:
        return mask
    widened_mask = mask.copy()
    widened_mask[1:] |= mask[:-1]
    widened_mask[:-1] |= mask[1:]
    return widened_mask
