"""Picture of bifurcation diagrams."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .style import DIRECTION_WORDS, axes, has_equal_ratios, label, period_colour

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._diagram import DiagramResult


#: Markers of the attractors of one period, in the order of their letters.
MARKERS = ["o", "s", "^", "D"]


def plot_diagram(result: DiagramResult, ax: Axes | None = None, quantity: str = "displacement") -> Axes:
    """Draws the section over the key, with a colour for each period and a marker for each of its attractors, or for each direction."""
    values, unit, description = result.section(quantity)
    groups = [attractor or direction for attractor, direction in zip(result.attractor, result.direction)]
    looks = _looks(result)
    point_groups = np.array(groups, dtype=object)[result.section_point]
    is_periodic = (result.period_cycles > 0)[result.section_point]
    parameter = result.parameter[result.section_point]
    with axes(ax) as ax:
        for name in dict.fromkeys(groups):
            (marker, colour), in_group = looks[name], point_groups == name
            text = DIRECTION_WORDS.get(name, name)
            ax.plot(parameter[in_group & is_periodic], values[in_group & is_periodic], marker, markersize=3, color=colour, label=text)
            ax.plot(parameter[in_group & ~is_periodic], values[in_group & ~is_periodic], ".", markersize=1.5, color=colour)
        label(ax.xaxis, result.key, result.unit, log=has_equal_ratios(result.parameter))
        label(ax.yaxis, description[0].upper() + description[1:] if len(description) < 30 else quantity.capitalize(), unit)
        ax.legend()
    return ax


def _looks(result: DiagramResult) -> dict[str, tuple[str, str]]:
    """Returns the marker and the colour of each attractor and each direction."""
    looks = {"up": (">", "black"), "down": ("<", "#8A8A8A"), "independent": ("o", "black")}
    for number, own in enumerate(result.attractors):
        same = [one for one in result.attractors[:number] if one["period_cycles"] == own["period_cycles"]]
        looks[own["id"]] = MARKERS[len(same) % len(MARKERS)], period_colour(own["period_cycles"])
    return looks
