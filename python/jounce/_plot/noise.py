"""Picture of densities without contact."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .style import axes, label

if TYPE_CHECKING:
    from .._noise import NoiseResult


def plot_noise(result: NoiseResult, ax: Any, density: str) -> Any:
    """Draws a power spectral density over frequency, on a logarithmic axis."""
    values = result[density]
    with axes(ax) as ax:
        ax.plot(result.frequency_hz, values, label=density)
        label(ax.xaxis, "Frequency", "Hz")
        label(ax.yaxis, f"PSD of {density}", result.units[density], log=True)
    return ax
