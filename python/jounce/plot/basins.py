"""Picture of basins of attraction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .style import axes, label

if TYPE_CHECKING:
    from ..basins import BasinsResult


def plot_basins(result: BasinsResult, ax: Any = None) -> Any:
    """Draws the starts by displacement and velocity towards the stop, coloured by attractor."""
    with axes(ax) as ax:
        for number, name in enumerate(result.attractor):
            members = result.ends_in == number
            text = f"{name}: {100 * result.fraction[number]:.0f} %"
            ax.plot(result.start_displacement_m[members], result.start_velocity_m_s[members], "o", alpha=0.8, label=text)
        unclassified = result.ends_in < 0
        if unclassified.any():
            ax.plot(
                result.start_displacement_m[unclassified],
                result.start_velocity_m_s[unclassified],
                "x",
                color="#888888",
                label="not classified",
            )
        label(ax.xaxis, "Displacement towards the stop", "m")
        label(ax.yaxis, "Velocity", "m/s")
        ax.legend()
    return ax
