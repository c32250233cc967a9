"""Pictures of the reproduction of the paper."""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import TYPE_CHECKING

from .._optional import require
from .style import COLOURS, axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._reproduce import ReproduceResult


def plot_claims(result: ReproduceResult, ax: Axes | None) -> Axes:
    """Draws a dot for each claim at its verdict."""
    with axes(ax, figsize=(6.4, 0.45 * len(result) + 0.8)) as ax:
        rows = range(len(result))
        for verdict, colour in ((True, COLOURS[0]), (False, COLOURS[1])):
            selected = [row for row in rows if result.holds[row] == verdict]
            ax.plot([int(verdict)] * len(selected), selected, "o", color=colour)
        ax.set_xticks([0, 1], ["does not hold", "holds"])
        ax.set_yticks(rows, [textwrap.fill(claim, 60) for claim in result.claim])
        ax.set(xlim=(-0.5, 1.5), ylim=(len(result) - 0.5, -0.5))
    return ax


def plot_figure(path: Path, ax: Axes | None) -> Axes:
    """Draws a figure of the report from its PNG file."""
    picture = require("matplotlib.image", "plot").imread(path)
    with axes(ax, figsize=(6.4, 6.4 * picture.shape[0] / picture.shape[1])) as ax:
        ax.imshow(picture)
        ax.set_axis_off()
    return ax
