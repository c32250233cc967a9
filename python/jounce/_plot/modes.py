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


#: Number of colours, as in the pictures of ``jounce modes --out``.
LEVELS = 24


def plot_modes(result: ModesResult, ax: Axes | None = None, modes: int = 4) -> Axes:
    """Draws the first modes: along the beams, each scaled to 1; without beams over the plates, as contours with nodal lines."""
    if not result.beams and not result.plates:
        raise ArgumentError("this harvester is given by its modes: there is no beam and no plate to draw them on")
    if modes < 1:
        raise ArgumentError(f"modes is {modes}; it must be at least 1")
    if not result.beams:
        return plot_plates(result, ax, min(modes, len(result)))
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


def plot_plates(result: ModesResult, ax: Axes | None, modes: int) -> Axes:
    """Draws the plates to scale, one column for each plate and one row for each mode; colours from the negative to the positive maximum."""
    sizes = [size_m for size_m, _ in result.plates.values()]
    spacing_m = 0.15 * max(size_m.max() for size_m in sizes)
    row_m = max(size_m[1] for size_m in sizes) + spacing_m
    length_m = sum(size_m[0] + spacing_m for size_m in sizes) - spacing_m
    with axes(ax, figsize=(4.8, 0.8 + min(3.6 * modes * row_m / length_m, 9.0))) as ax:
        for mode in range(modes):
            left_m, base_m = 0.0, -mode * row_m
            ax.text(0.0, base_m + row_m - 0.85 * spacing_m, f"{mode + 1}: {result.frequency_hz[mode]:.2f} Hz", va="bottom")
            for size_m, shapes in result.plates.values():
                shape = shapes[mode].T
                largest = np.abs(shape).max() or 1.0
                rows, columns = shape.shape
                x_m = left_m + np.linspace(0.0, size_m[0], columns + 1)
                y_m = base_m + np.linspace(0.0, size_m[1], rows + 1)
                colours = np.floor(np.clip((shape / largest + 1.0) * LEVELS / 2, 0, LEVELS - 1))
                ax.pcolormesh(x_m, y_m, colours, cmap="viridis", vmin=0, vmax=LEVELS - 1, rasterized=True)
                # A shape of one sign has no nodal line.
                if shape.min() < 0.0 < shape.max():
                    middles = [(edges[1:] + edges[:-1]) / 2 for edges in (x_m, y_m)]
                    ax.contour(*middles, shape, levels=[0.0], colors="#1a1a1a", linewidths=1.2)
                left_m += size_m[0] + spacing_m
        ax.grid(False)
        ax.set_aspect("equal")
        label(ax.xaxis, "Position along the plate", "m")
        ax.set_yticks([])
        ax.spines["left"].set_visible(False)
    return ax


def plot_frequencies(result: ImportResult, ax: Axes | None = None) -> Axes:
    """Draws the natural frequency of each mode."""
    with axes(ax) as ax:
        ax.plot(range(1, len(result) + 1), result.frequency_hz, "o")
        label(ax.xaxis, "Number of the mode", "-")
        label(ax.yaxis, "Natural frequency", "Hz")
    return ax
