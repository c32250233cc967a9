"""Picture of basins of attraction."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .style import axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._basins import BasinsResult


def plot_basins(result: BasinsResult, ax: Axes | None = None) -> Axes:
    """Draws the starts by displacement and velocity towards the stop, coloured by attractor."""
    with axes(ax) as ax:
        for number, name in enumerate(result.attractor):
            own = result.attractor_index == number
            text = f"{name}: {100 * result.fraction[number]:.0f} %"
            ax.plot(result.start_displacement_m[own], result.start_velocity_m_s[own], "o", alpha=0.8, label=text)
        left = result.attractor_index < 0
        if left.any():
            ax.plot(result.start_displacement_m[left], result.start_velocity_m_s[left], "x", color="#888888", label="not classified")
        label(ax.xaxis, "Displacement towards the stop", "m")
        label(ax.yaxis, "Velocity", "m/s")
        ax.legend()
    return ax
