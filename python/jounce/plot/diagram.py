"""Picture of bifurcation diagrams."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .style import COLOURS, axes, label

if TYPE_CHECKING:
    from ..diagram import DiagramResult


def plot_diagram(result: DiagramResult, ax: Any = None, quantity: str = "displacement") -> Any:
    """Draws the section over the key, with a colour for each attractor, or for each direction of a stepped diagram."""
    values, unit, about = result.section(quantity)
    names = [one["id"] for one in result.attractors]
    home = [names[k] if k >= 0 else way for k, way in zip(result.attractor_number, result.direction)]
    of_point = np.array(home, dtype=object)[result.section_visit]
    whole = (result.period_cycles > 0)[result.section_visit]
    at = result.parameter[result.section_visit]
    with axes(ax) as ax:
        for number, name in enumerate(dict.fromkeys(home)):
            colour, own = COLOURS[number % len(COLOURS)], of_point == name
            ax.plot(at[own & whole], values[own & whole], "o", markersize=3, color=colour, label=name)
            ax.plot(at[own & ~whole], values[own & ~whole], ".", markersize=1.5, color=colour)
        label(ax.xaxis, result.key, result.unit)
        label(ax.yaxis, about[0].upper() + about[1:] if len(about) < 30 else quantity.capitalize(), unit)
        ax.legend()
    return ax
