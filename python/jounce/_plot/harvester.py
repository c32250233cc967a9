"""Picture of the harvester to scale."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

from .._optional import require
from .style import axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Width of the picture, inches: two columns of a journal.
WIDTH_IN = 7.2


def plot_harvester(drawing: tuple[str, bytes], ax: Axes | None = None) -> Axes:
    """Puts the drawing of a harvester, as SVG and PNG, into axes without ticks."""
    _, png = drawing
    picture = require("matplotlib.image", "plot").imread(io.BytesIO(png))
    height, width = picture.shape[:2]
    with axes(ax, figsize=(WIDTH_IN, WIDTH_IN * height / width)) as ax:
        ax.imshow(picture, interpolation="lanczos")
        ax.set_axis_off()
    return ax
