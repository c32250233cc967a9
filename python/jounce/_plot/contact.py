"""Picture of force pulses and the fitted contact laws."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .style import COLOURS, axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._contact import ContactResult


def plot_contact(result: ContactResult, ax: Axes | None = None, hits: int = 6) -> Axes:
    """Draws pulses over the time from their largest force: rings for samples, lines for laws."""
    with axes(ax) as ax:
        for k, pulse in enumerate(result.pulses[:hits]):
            colour = COLOURS[k % len(COLOURS)]
            text = f"{result.time_s[k]:.4f} s"
            ax.plot(1e3 * pulse.time_s, pulse.force_n, "o", markerfacecolor="none", color=colour, label=text)
            ax.plot(1e3 * pulse.law_time_s, pulse.law_force_n, color=colour)
        label(ax.xaxis, "Time from the largest force", "ms")
        label(ax.yaxis, "Force", "N")
        ax.legend()
    return ax
