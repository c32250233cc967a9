"""Picture of basins of attraction."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .style import axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._basins import BasinsResult

#: Field, text and unit of each coordinate of a start.
COORDINATES = {
    "start_displacement": ("start_displacement_m", "Displacement towards the stop", "m"),
    "start_velocity": ("start_velocity_m_s", "Velocity", "m/s"),
    "start_voltage": ("start_voltage_v", "Voltage", "V"),
}


def plot_basins(result: BasinsResult, ax: Axes | None = None) -> Axes:
    """Draws the starts by displacement and velocity towards the stop, or by the first two sides of their grid, coloured by attractor."""
    sides = result._sides()
    match sides:
        case [_, _, *_]:
            plane = sides[:2]
        case ["start_voltage"]:
            plane = ["start_voltage", "start_velocity"]
        case _:
            plane = ["start_displacement", "start_velocity"]
    marker = "s" if sides else "o"
    x, y = (getattr(result, COORDINATES[name][0]) for name in plane)
    with axes(ax) as ax:
        for number, name in enumerate(result.attractor):
            own = result.attractor_index == number
            ax.plot(x[own], y[own], marker, alpha=0.8, label=f"{name}: {100 * result.fraction[number]:.0f} %")
        left = result.attractor_index < 0
        if left.any():
            ax.plot(x[left], y[left], "x", color="#888888", label="not classified")
        for name, line in zip(plane, (ax.axvline, ax.axhline)):
            if name == "start_displacement" and result.gap_m is not None:
                line(result.gap_m, color="black", linestyle=":", linewidth=0.8, label="gap", gid="guide")
        label(ax.xaxis, *COORDINATES[plane[0]][1:])
        label(ax.yaxis, *COORDINATES[plane[1]][1:])
        ax.legend()
    return ax
