"""Sweeps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .._fields import dataset_fields
from .style import DIRECTION_WORDS, axes, has_equal_ratios, label, label_field

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._sweep import SweepResult

_DIRECTION_STYLES: dict[str, dict[str, Any]] = {
    "up": {"linestyle": "-", "marker": ">"},
    "down": {"linestyle": "--", "marker": "<", "markerfacecolor": "none"},
    "independent": {"linestyle": "none", "marker": "o"},
}


def plot_sweep(result: SweepResult, ax: Axes | None, text: str | None, quantity: str) -> Axes:
    """Draws a quantity over the key, with separate directions; unsettled points have a ring."""
    with axes(ax) as ax:
        colour = None
        for direction, style in _DIRECTION_STYLES.items():
            points = result.going(direction)
            if len(points) == 0:
                continue
            values, words = getattr(points, quantity), DIRECTION_WORDS[direction]
            (line,) = ax.plot(points.parameter, values, label=f"{text}, {words}" if text else words, color=colour, **style)
            colour = line.get_color()
            unsettled = ~points.settled
            ax.plot(points.parameter[unsettled], values[unsettled], "o", markersize=9, markerfacecolor="none", color=colour)
        label(ax.xaxis, result.key, result.unit, log=has_equal_ratios(result.parameter))
        label_field(ax.yaxis, dataset_fields(type(result))[quantity], quantity == "mean_power_w")
        ax.legend()
    return ax
