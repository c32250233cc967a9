"""Picture of the derivatives of an orbit."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .style import axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._sensitivity import SensitivityResult

#: Largest number of keys in the picture.
SHOWN = 20


def plot_sensitivity(result: SensitivityResult, quantity: int, ax: Axes | None = None) -> Axes:
    """Draws the relative derivatives of a result as bars, the largest at the top."""
    order = np.argsort(-np.abs(result.relative[:, quantity]), kind="stable")[:SHOWN]
    places = np.arange(len(order))
    with axes(ax) as ax:
        ax.barh(places, result.relative[order, quantity])
        ax.set_yticks(places, [result.key[k] for k in order])
        ax.invert_yaxis()
        ax.axvline(0.0, color="#888888", linewidth=0.8)
        ax.set_xlabel(f"Change of {result.quantity[quantity]} for 1 % more of the key [%]")
    return ax
