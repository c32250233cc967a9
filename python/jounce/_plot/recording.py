"""Recordings."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .style import axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._recording import Channel, Recording


def plot_recording(recording: Recording, ax: Axes | None, channel: Channel) -> Axes:
    """Draws a channel over time, or its magnitude over frequency."""
    over_time = recording.over == "time"
    values = channel.values if over_time else np.abs(channel.values)
    with axes(ax) as ax:
        ax.plot(recording.places, values, label=channel.name)
        label(ax.xaxis, recording.over.capitalize(), "s" if over_time else "Hz")
        label(ax.yaxis, channel.name if over_time else f"|{channel.name}|", channel.unit, log=not over_time)
    return ax
