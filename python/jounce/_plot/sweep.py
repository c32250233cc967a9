"""Sweeps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .style import axes, label

if TYPE_CHECKING:
    from .._sweep import SweepResult

_DIRECTION_STYLES = {
    "up": {"linestyle": "-", "marker": ">"},
    "down": {"linestyle": "--", "marker": "<", "markerfacecolor": "none"},
    "independent": {"linestyle": "none", "marker": "o"},
}


def plot_sweep(result: SweepResult, ax: Any = None, text: str | None = None) -> Any:
    """Draws mean power over the key, with separate directions; unsettled points have a ring."""
    with axes(ax) as ax:
        colour = None
        for direction, style in _DIRECTION_STYLES.items():
            points = result.going(direction)
            if len(points) == 0:
                continue
            (line,) = ax.plot(
                points.parameter, points.mean_power_w, label=f"{text}, {direction}" if text else direction, color=colour, **style
            )
            colour = line.get_color()
            unsettled = ~points.settled
            ax.plot(points.parameter[unsettled], points.mean_power_w[unsettled], "o", markersize=9, markerfacecolor="none", color=colour)
        label(ax.xaxis, result.key, result.unit)
        label(ax.yaxis, "Mean power", "W", log=True)
        ax.legend()
    return ax
