"""Picture of bifurcation diagrams."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .style import COLOURS, axes, has_equal_ratios, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._diagram import DiagramResult


def plot_diagram(result: DiagramResult, ax: Axes | None = None, quantity: str = "displacement") -> Axes:
    """Draws the section over the key, with a colour for each attractor, or for each direction of a stepped diagram."""
    values, unit, description = result.section(quantity)
    groups = [attractor or direction for attractor, direction in zip(result.attractor, result.direction)]
    point_groups = np.array(groups, dtype=object)[result.section_point]
    is_periodic = (result.period_cycles > 0)[result.section_point]
    parameter = result.parameter[result.section_point]
    with axes(ax) as ax:
        for number, name in enumerate(dict.fromkeys(groups)):
            colour, in_group = COLOURS[number % len(COLOURS)], point_groups == name
            ax.plot(parameter[in_group & is_periodic], values[in_group & is_periodic], "o", markersize=3, color=colour, label=name)
            ax.plot(parameter[in_group & ~is_periodic], values[in_group & ~is_periodic], ".", markersize=1.5, color=colour)
        label(ax.xaxis, result.key, result.unit, log=has_equal_ratios(result.parameter))
        label(ax.yaxis, description[0].upper() + description[1:] if len(description) < 30 else quantity.capitalize(), unit)
        ax.legend()
    return ax
