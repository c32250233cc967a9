"""Pictures of spectra of realisations of noise, and of recorded channels."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._errors import ArgumentError
from .._optional import require
from .style import axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._ensemble import EnsembleResult
    from .._spectra import SpectraResult


def plot_spectra(result: EnsembleResult, ax: Axes | None = None) -> Axes:
    """Draws the density of each voltage over frequency with its 95 % interval as a band."""
    densities = result.voltage_psd_v2_hz
    # A logarithmic axis has no 0: an interval that includes it extends to the lower limit of the picture.
    floor = 0.1 * np.min(densities[densities > 0.0], initial=np.inf)
    with axes(ax) as ax:
        for name, mean, half in zip(result.patch, densities, result.voltage_psd_half_width_v2_hz):
            (line,) = ax.plot(result.frequency_hz, mean, label=name)
            ax.fill_between(
                result.frequency_hz, np.maximum(mean - half, floor), mean + half, color=line.get_color(), alpha=0.25, linewidth=0.0
            )
        label(ax.xaxis, "Frequency", "Hz")
        label(ax.yaxis, "PSD of voltage", "V^2/Hz", log=True)
        ax.legend()
    return ax


def plot_density(result: SpectraResult, ax: Axes | None = None) -> Axes:
    """Draws the density of a channel without its line at 0 Hz; vertical lines mark multiples of the drive."""
    with axes(ax) as ax:
        for hz in result.order_frequency_hz:
            ax.axvline(hz, color="#888888", linewidth=0.5, linestyle=":", gid="guide")
        ax.plot(result.frequency_hz[1:], result.density[1:], label=result.channel)
        label(ax.xaxis, "Frequency", "Hz", log=True)
        label(ax.yaxis, f"PSD of {result.channel}", result.density_unit, log=True)
    return ax


#: Range of a spectrogram below the largest amplitude, in decades.
_DECADES = 4.0


def plot_spectrogram(result: SpectraResult, ax: Axes | None = None) -> Axes:
    """Draws the amplitudes of each segment over time and frequency without their line at 0 Hz, with a colour bar."""
    colours = require("matplotlib.colors", "plot")
    highest_hz = 2.0 * result.order_frequency_hz.max() if len(result.order) else result.frequency_hz[-1]
    visible = (result.frequency_hz > 0.0) & (result.frequency_hz <= highest_hz)
    values = result.amplitude_peak[:, visible].T
    max_amplitude = float(values.max())
    if not max_amplitude > 0.0:
        raise ArgumentError(f"{result.channel} has no amplitude above 0 Hz, so there is nothing to draw")
    min_amplitude = max_amplitude / 10.0**_DECADES
    with axes(ax) as ax:
        scale = colours.LogNorm(min_amplitude, max_amplitude)
        mesh = ax.pcolormesh(
            result.time_s,
            result.frequency_hz[visible],
            np.maximum(values, min_amplitude),
            norm=scale,
            shading="nearest",
            cmap="viridis",
            rasterized=True,
        )
        ax.grid(False)
        unit = f" [{result.unit}]" if result.unit else ""
        ax.figure.colorbar(mesh, ax=ax, label=f"{result.channel}, amplitude (zero to peak){unit}")
        label(ax.xaxis, "Time", "s")
        label(ax.yaxis, "Frequency", "Hz")
    return ax
