"""Style of the pictures."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from .._optional import require

#: Colours that colour-blind readers can distinguish (Okabe and Ito, 2008); black, their first, is omitted.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]

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
def axes(ax: Any, **figure: Any) -> Iterator[Any]:
    """Yields the axes to draw into, with the style of jounce."""
    matplotlib = require("matplotlib", "plot")
    with matplotlib.rc_context({**_STYLE, "axes.prop_cycle": matplotlib.cycler(color=COLOURS)}):
        yield require("matplotlib.pyplot", "plot").subplots(**figure)[1] if ax is None else ax


def label(axis: Any, what: str, unit: str, log: bool = False) -> None:
    """Labels an axis with its unit. Ticks of a linear axis carry the unit with a prefix, ``2 mW``; the data remain in SI."""
    ticker = require("matplotlib.ticker", "plot")
    if log:
        axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    elif unit and unit not in ("Hz", "s"):
        axis.set_major_formatter(ticker.EngFormatter(unit=unit))
        axis.set_major_locator(ticker.MaxNLocator(nbins=6 if axis.axis_name == "y" else 5))
        unit = ""
    axis.set_label_text(f"{what} [{unit}]" if unit else what)
