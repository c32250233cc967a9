"""Pictures of frequency responses."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .style import axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._frf import FrfResult
    from .._measured_frf import MeasuredFrf


def plot_frf(result: FrfResult, ax: Axes | None, response: str) -> Axes:
    """Draws the magnitude of a response over frequency, both axes logarithmic."""
    values = result[response]
    with axes(ax) as ax:
        ax.plot(result.frequency_hz, np.abs(values), label=response)
        label(ax.xaxis, "Frequency", "Hz", log=True)
        label(ax.yaxis, f"|{response}|", result.units[response], log=True)
    return ax


def plot_bode(result: FrfResult | MeasuredFrf, ax: Any, response: str) -> Any:
    """Draws magnitude and phase of a response into two axes, which are returned; into a single one the magnitude."""
    if ax is None:
        with axes(None, nrows=2, sharex=True, figsize=(4.8, 5.8)) as ax:
            pass
    pair = list(np.ravel(ax))
    result.plot_frf(pair[0], response)
    if len(pair) == 1:
        return ax
    # The line at 0 Hz of a measured response is the offset of the sensor.
    positive = result.frequency_hz > 0.0
    with axes(pair[1]) as phase_ax:
        phase_ax.plot(result.frequency_hz[positive], np.degrees(np.angle(result[response][positive])), label=response)
        phase_ax.set(xscale=pair[0].get_xscale(), ylim=(-190.0, 190.0), yticks=range(-180, 181, 90))
        label(phase_ax.xaxis, "Frequency", "Hz", log=pair[0].get_xscale() == "log")
        label(phase_ax.yaxis, f"Phase of {response}", "deg")
    return ax
