"""Pictures of records, spectra and Poincaré sections."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._errors import ArgumentError
from .style import axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._history import History
    from .._result import Floats
    from .._signal import Spectrum


def plot_time_history(history: History, ax: Axes | None, channel: str | None) -> Axes:
    """Draws a channel over time."""
    name, values, unit = history.channel(channel)
    with axes(ax) as ax:
        ax.plot(history.time_s, values, label=name)
        label(ax.xaxis, "Time", "s")
        label(ax.yaxis, name, unit)
    return ax


def plot_spectrum(spectrum: Spectrum, ax: Axes | None) -> Axes:
    """Draws a spectrum without its line at 0 Hz."""
    with axes(ax) as ax:
        ax.plot(spectrum.frequency_hz[1:], spectrum.amplitude_peak[1:], label=spectrum.name)
        label(ax.xaxis, "Frequency", "Hz", log=True)
        label(ax.yaxis, f"{spectrum.name}, amplitude (zero to peak)", spectrum.unit, log=True)
    return ax


def plot_poincare(history: History, ax: Axes | None, point: str | None) -> Axes:
    """Draws velocity over displacement once per drive cycle."""
    if len(history.poincare_time_s) == 0:
        raise ArgumentError("this harvester has no drive, so there is no drive cycle for a Poincaré section")
    default_point = next((name for name in history.point if name.endswith(".tip")), history.point[-1])
    point = default_point if point is None else point
    if point not in history.point:
        raise ArgumentError(f"{point}: no such point; use one of {', '.join(history.point)}")
    row = history.point.index(point)
    with axes(ax) as ax:
        ax.plot(history.poincare_displacement_m[row], history.poincare_velocity_m_s[row], "o", alpha=0.7, label=point)
        label(ax.xaxis, f"Displacement of {point}", "m")
        label(ax.yaxis, "Velocity", "m/s")
        ax.margins(0.15)
        _widen(ax.xaxis, history.displacement_m[row])
        _widen(ax.yaxis, history.velocity_m_s[row])
    return ax


def _widen(axis: Any, motion: Floats) -> None:
    """Sets a minimum width of an axis, a hundredth of the motion, so that a settled orbit shows a point and not its roundoff."""
    low, high = axis.get_view_interval()
    deficit = 0.01 * float(np.ptp(motion)) - (high - low)
    if deficit > 0.0:
        axis.axes.set(**{f"{axis.axis_name}lim": (low - 0.5 * deficit, high + 0.5 * deficit)})
