"""Picture of features before and after a fit."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .style import axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._fit import FitCurve, FitResult


def plot_fit(result: FitResult, ax: Axes | None = None) -> Axes:
    """Draws the relative error of every feature in percent, before and after; bars are the 95 % intervals of the measurement."""
    position = np.arange(len(result.feature))
    with axes(ax) as ax:
        zero, half = np.zeros(len(position)), 196.0 * result.feature_deviation
        ax.errorbar(position, zero, yerr=half, fmt="none", ecolor="#888888", capsize=3, label="95 % interval of the measurement")
        ax.plot(position, 100.0 * result.error_before, "o", fillstyle="none", label="before")
        ax.plot(position, 100.0 * result.error_after, "o", label="after")
        ax.set_xticks(position, result.feature, rotation=90)
        ax.set_xlim(-1.0, len(position))
        ax.set_xlabel("Feature [-]")
        ax.set_ylabel("Error of the model [%]")
        ax.legend()
    return ax


def plot_curve(curve: FitCurve, ax: Axes | None = None) -> Axes:
    """Draws a measured curve with those of the model before and after, and the 95 % prediction interval as a band."""
    over_time = curve.over == "time_s"
    # Real and imaginary parts and time histories pass through 0; magnitudes do not.
    log = not over_time and bool((curve.measured > 0.0).all() and (curve.low > 0.0).all())
    with axes(ax) as ax:
        ax.fill_between(curve.at, curve.low, curve.high, color="#888888", alpha=0.25, linewidth=0.0, label="95 % prediction interval")
        ax.plot(curve.at, curve.measured, ".", color="#000000", markersize=3, label="measured")
        ax.plot(curve.at, curve.before, "--", label="model before")
        ax.plot(curve.at, curve.after, label="model after")
        label(ax.xaxis, *(("Time", "s") if over_time else ("Frequency", "Hz")))
        label(ax.yaxis, curve.name, curve.unit, log=log)
        ax.legend()
    return ax
