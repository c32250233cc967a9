"""Sweeps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .style import axes, label

if TYPE_CHECKING:
    from ..sweep import SweepResult

_WAYS = {
    "up": {"linestyle": "-", "marker": ">"},
    "down": {"linestyle": "--", "marker": "<", "markerfacecolor": "none"},
    "independent": {"linestyle": "none", "marker": "o"},
}


def plot_sweep(result: SweepResult, ax: Any = None, text: str | None = None) -> Any:
    """Draws mean power over the key, with separate directions; unsettled points have a ring."""
    with axes(ax) as ax:
        colour = None
        for way, look in _WAYS.items():
            one = result.going(way)
            if len(one) == 0:
                continue
            (line,) = ax.plot(one.parameter, one.mean_power_w, label=f"{text}, {way}" if text else way, color=colour, **look)
            colour = line.get_color()
            open_ = ~one.settled
            ax.plot(one.parameter[open_], one.mean_power_w[open_], "o", markersize=9, markerfacecolor="none", color=colour)
        label(ax.xaxis, result.key, result.unit)
        label(ax.yaxis, "Mean power", "W", log=True)
        ax.legend()
    return ax
