"""Picture of realisations of noise."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .style import COLOURS, axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._ensemble import EnsembleResult


def plot_ensemble(result: EnsembleResult, ax: Axes | None = None) -> Axes:
    """Draws the mean power of each member, and the mean of all with its 95 % interval as a band."""
    mean, half = result.mean_power_w, result.mean_power_half_width_w
    with axes(ax) as ax:
        ax.plot(result.member, result.member_mean_power_w, "o", label="member")
        ax.axhline(mean, color=COLOURS[1], label="mean")
        if np.isfinite(half):
            ax.axhspan(mean - half, mean + half, color=COLOURS[1], alpha=0.2, linewidth=0.0, label="95 % interval")
        label(ax.xaxis, "Number of the realisation", "-")
        label(ax.yaxis, "Mean power", "W")
        ax.legend()
    return ax
