"""Pictures of the table of a study."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .style import axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._study_result import StudyTable


def plot_study(table: StudyTable, ax: Axes | None, quantity: str) -> Axes:
    """Draws a column over the varied key; over the first two of several keys as the colour of points."""
    key, *others = table.keys
    values, unit = table[quantity], table.notes[quantity][0]
    with axes(ax) as ax:
        if others:
            points = ax.scatter(table[key], table[others[0]], c=values, s=12.0)
            ax.figure.colorbar(points, ax=ax, label=f"{quantity} [{unit or '-'}]")
            label(ax.yaxis, others[0], table.notes[others[0]][0] or "-")
        else:
            order = np.argsort(table[key], kind="stable")
            ax.plot(table[key][order], values[order], "-o", label=quantity)
            label(ax.yaxis, quantity, unit or "-")
        label(ax.xaxis, key, table.notes[key][0] or "-")
    return ax
