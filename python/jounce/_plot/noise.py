"""Picture of densities without contact."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .style import axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._noise import NoiseResult


def plot_noise(result: NoiseResult, ax: Axes | None, density: str) -> Axes:
    """Draws a power spectral density over frequency, on a logarithmic axis."""
    values = result[density]
    with axes(ax) as ax:
        ax.plot(result.frequency_hz, values, label=density)
        label(ax.xaxis, "Frequency", "Hz")
        label(ax.yaxis, f"PSD of {density}", result.units[density], log=True)
    return ax
