"""Pictures of measured power and of the voltage spectra."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .style import axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._power import PowerResult


def plot_power(result: PowerResult, ax: Axes | None = None) -> Axes:
    """Draws mean power over the load with its 95 % intervals."""
    order = np.argsort(result.resistance_ohm, kind="stable")
    square = result.mean_square_base_acceleration_m2_s4
    has_acceleration = bool(np.isfinite(square).all())
    divisor = square if has_acceleration else np.ones(len(result))
    power, half = (result.mean_power_w / divisor)[order], (result.half_width_w / divisor)[order]
    with axes(ax) as ax:
        ax.errorbar(result.resistance_ohm[order], power, yerr=half, marker="o", capsize=3, label="mean of a record, 95 % interval")
        label(ax.xaxis, "Load resistance", "ohm", log=True)
        label(ax.yaxis, "Mean power", "W/(m/s²)²" if has_acceleration else "W")
        ax.legend()
    return ax


def plot_spectra(result: PowerResult, ax: Axes | None = None) -> Axes:
    """Draws the spectra of the voltages without their lines at 0 Hz."""
    with axes(ax) as ax:
        for spectrum, ohm in zip(result.spectra, result.resistance_ohm):
            ax.plot(spectrum.frequency_hz[1:], spectrum.amplitude_peak[1:], label=f"{ohm:g} ohm")
        label(ax.xaxis, "Frequency", "Hz", log=True)
        label(ax.yaxis, "Voltage, amplitude (zero to peak)", "V", log=True)
        ax.legend()
    return ax
