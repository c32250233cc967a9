"""Style of the pictures."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np

from .._optional import require

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes

    from .._fields import Along

#: Colours that colour-blind readers can distinguish (Okabe and Ito, 2008); black, their first, is omitted.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]

#: Words of each direction of a sweep.
DIRECTION_WORDS = {"up": "up: increasing values", "down": "down: decreasing values", "independent": "independent values"}

#: Colour of each kind of bifurcation curve, the same in every picture; grey for levels.
EVENT_COLOURS = {
    "fold": COLOURS[0],
    "period-doubling": COLOURS[1],
    "neimark-sacker": COLOURS[2],
    "branch-point": COLOURS[3],
    "grazing": COLOURS[4],
    "sticking": COLOURS[5],
    "peak": COLOURS[6],
    "level": "#8A8A8A",
}

_STYLE: dict[str, Any] = {
    "figure.figsize": (4.8, 3.2),
    "figure.dpi": 150,
    "figure.constrained_layout.use": True,
    "font.size": 9,
    "axes.labelsize": 9,
    "axes.titlesize": 9,
    "axes.linewidth": 0.7,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "lines.linewidth": 1.2,
    "lines.markersize": 4,
    "legend.fontsize": 8,
    "legend.framealpha": 0.8,
    "legend.edgecolor": "none",
    "legend.fancybox": False,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
}


@contextmanager
def axes(ax: Axes | None, **figure: Any) -> Iterator[Axes]:
    """Yields the axes to draw into, with the style of jounce."""
    matplotlib = require("matplotlib", "plot")
    with matplotlib.rc_context({**_STYLE, "axes.prop_cycle": matplotlib.cycler(color=COLOURS)}):
        yield require("matplotlib.pyplot", "plot").subplots(**figure)[1] if ax is None else ax
        is_interactive = matplotlib.is_interactive()
    # The first figure loads the backend; that of notebooks makes matplotlib interactive, without which they show no later figure.
    matplotlib.interactive(is_interactive)


def label(axis: Any, what: str, unit: str, log: bool = False) -> None:
    """Labels an axis with its unit. Ticks of a linear axis carry the unit with a prefix, ``2 mW``; the data remain in SI."""
    ticker = require("matplotlib.ticker", "plot")
    if log:
        axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    elif unit and unit not in ("Hz", "s", "ms", "deg", "%", "-"):
        axis.set_major_formatter(ticker.EngFormatter(unit=unit))
        axis.set_major_locator(ticker.MaxNLocator(nbins=6 if axis.axis_name == "y" else 5))
        unit = ""
    axis.set_label_text(f"{what} [{unit}]" if unit else what)


def period_colour(period_cycles: int) -> str:
    """Returns the colour of motions of a period, the same in every picture: black for no period, one for all periods above 5."""
    return COLOURS[min(period_cycles, 6) - 1]


def has_equal_ratios(values: npt.NDArray[np.float64]) -> bool:
    """Whether at least three values of a parameter, in any order, are at equal ratios and not at equal distances."""
    steps = np.unique(values)
    if len(steps) < 3 or steps[0] <= 0.0:
        return False
    even, geometric = (np.ptp(np.diff(places)) <= 1e-6 * np.diff(places)[0] for places in (steps, np.log(steps)))
    return bool(geometric and not even)


def label_field(axis: Any, along: Along, is_power: bool) -> None:
    """Labels an axis with the description of a field of a result; a power has a logarithmic axis."""
    text = "Mean power" if is_power else along.about[0].upper() + along.about[1:]
    label(axis, textwrap.fill(text, 40), "-" if along.unit == "1" else along.unit, log=is_power)


def draw_with(draw: Callable[[Any], Any], ax: Any, style: Mapping[str, Any]) -> Any:
    """Draws a picture and gives its new lines, except guides, the properties of a style; its label goes to the first of them."""
    known = {line for one in _flat(ax) for line in one.lines}
    drawn = draw(ax)
    for one in _flat(drawn):
        lines = [line for line in one.lines if line not in known and line.get_gid() != "guide"]
        for number, line in enumerate(lines):
            line.set(**{**style, "label": "_nolegend_"} if number and "label" in style else style)
        if style and one.get_legend() is not None:
            one.legend()
    return drawn


def _flat(ax: Any) -> list[Any]:
    return [] if ax is None else list(np.ravel(ax))
