"""Picture of the segments of a record."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .style import COLOURS, axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._segments import SegmentsResult


def plot_segments(result: SegmentsResult, ax: Axes | None = None) -> Axes:
    """Draws the record, with a colour and a label for each segment."""
    with axes(ax) as ax:
        for k, name in enumerate(result.names()):
            inside = (result.time_s >= result.start_s[k]) & (result.time_s < result.end_s[k])
            colour = COLOURS[k % len(COLOURS)]
            ax.plot(result.time_s[inside], result.values[inside], color=colour, linewidth=0.6, label=f"{name}, rms {result.rms[k]:.3g}")
        label(ax.xaxis, "Time", "s")
        label(ax.yaxis, result.channel, result.unit)
        ax.legend()
    return ax
