"""Spectra of realisations of noise."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .style import axes, label

if TYPE_CHECKING:
    from ..ensemble import EnsembleResult


def plot_spectra(result: EnsembleResult, ax: Any = None) -> Any:
    """Draws the density of each voltage over frequency with its 95 % interval as a band."""
    densities = result.voltage_psd_v2_hz
    # An axis of powers of ten has no 0: an interval that reaches it goes down to the floor of the picture.
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
