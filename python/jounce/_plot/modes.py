"""Pictures of mode shapes and natural frequencies."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._errors import ArgumentError
from .style import axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._import import ImportResult
    from .._modes import ModesResult


def plot_modes(result: ModesResult, ax: Axes | None = None, modes: int = 4) -> Axes:
    """Draws the shapes of the first modes along the beams, each scaled to 1."""
    if not result.beams:
        raise ArgumentError("this harvester is given by its modes: there is no beam to draw them along")
    if modes < 1:
        raise ArgumentError(f"modes is {modes}; it must be at least 1")
    with axes(ax) as ax:
        for mode in range(min(modes, len(result))):
            scale = max(np.abs(shape[mode]).max() for _, shape in result.beams.values()) or 1.0
            colour = None
            for position_m, shape in result.beams.values():
                text = f"{result.frequency_hz[mode]:.4g} Hz" if colour is None else None
                (line,) = ax.plot(position_m, shape[mode] / scale, label=text, color=colour)
                colour = line.get_color()
        ax.axhline(0.0, color="#888888", linewidth=0.6, gid="guide")
        label(ax.xaxis, "Distance from the root", "m")
        label(ax.yaxis, "Shape, scaled to 1", "-")
        ax.legend()
    return ax


def plot_frequencies(result: ImportResult, ax: Axes | None = None) -> Axes:
    """Draws the natural frequency of each mode."""
    with axes(ax) as ax:
        ax.plot(range(1, len(result) + 1), result.frequency_hz, "o")
        label(ax.xaxis, "Number of the mode", "-")
        label(ax.yaxis, "Natural frequency", "Hz")
    return ax
