"""Picture of frequency responses."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .style import axes, label

if TYPE_CHECKING:
    from .._frf import FrfResult


def plot_frf(result: FrfResult, ax: Any, response: str) -> Any:
    """Draws the magnitude of a response over frequency, both axes logarithmic."""
    values = result[response]
    with axes(ax) as ax:
        ax.plot(result.frequency_hz, np.abs(values), label=response)
        label(ax.xaxis, "Frequency", "Hz", log=True)
        label(ax.yaxis, f"|{response}|", result.units[response], log=True)
    return ax
