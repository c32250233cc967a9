"""Features before and after a fit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .style import axes

if TYPE_CHECKING:
    from ..fit import FitResult


def plot_fit(result: FitResult, ax: Any = None) -> Any:
    """Draws the relative error of every feature in percent, before and after; bars are the 95 % intervals of the measurement."""
    place = np.arange(len(result.feature))
    with axes(ax) as ax:
        zero, half = np.zeros(len(place)), 196.0 * result.feature_deviation
        ax.errorbar(place, zero, yerr=half, fmt="none", ecolor="#888888", capsize=3, label="95 % interval of the measurement")
        ax.plot(place, 100.0 * result.error_before, "o", fillstyle="none", label="before")
        ax.plot(place, 100.0 * result.error_after, "o", label="after")
        ax.set_xticks(place, result.feature, rotation=90)
        ax.set_xlim(-1.0, len(place))
        ax.set_xlabel("Feature")
        ax.set_ylabel("Error of the model [%]")
        ax.legend()
    return ax
