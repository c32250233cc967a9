"""Pictures of a hammer test: responses, coherence, stabilisation, and the reconstruction from the modes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .style import COLOURS, axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._measured_frf import MeasuredFrf
    from .._measured_modes import MeasuredModes


def plot_measured_frf(result: MeasuredFrf, ax: Axes | None, response: str) -> Axes:
    """Draws the magnitude of a response over frequency, without the offset of the sensor at 0 Hz."""
    values = result[response]
    with axes(ax) as ax:
        ax.plot(result.frequency_hz[1:], np.abs(values[1:]), label=response)
        label(ax.xaxis, "Frequency", "Hz")
        label(ax.yaxis, f"|{response}|", result.units[response], log=True)
    return ax


def plot_coherence(result: MeasuredFrf, ax: Axes | None = None) -> Axes:
    """Draws the coherence of every response."""
    with axes(ax) as ax:
        for name, values in result.coherence.items():
            ax.plot(result.frequency_hz[1:], values[1:], label=name)
        ax.set_ylim(0.0, 1.05)
        label(ax.xaxis, "Frequency", "Hz")
        label(ax.yaxis, "Coherence", "-")
        ax.legend()
    return ax


_POLES = {
    "pole": ("o", COLOURS[0], "full", "frequency and damping stable"),
    "frequency": ("o", COLOURS[1], "none", "frequency stable"),
    "new": ("s", "#999999", "full", "new"),
}


def plot_stabilisation(result: MeasuredModes, ax: Axes | None = None) -> Axes:
    """Draws the poles by order; vertical lines mark the selected modes."""
    inside = (result.pole_frequency_hz >= result.line_hz[0]) & (result.pole_frequency_hz <= result.line_hz[-1])
    kinds = np.array(result.pole_stable)
    with axes(ax) as ax:
        for hz in result.frequency_hz:
            ax.axvline(hz, color="#888888", linewidth=0.6, gid="guide")
        for kind, (marker, colour, fill, text) in _POLES.items():
            selected = inside & (kinds == kind)
            style: dict[str, Any] = {"linestyle": "none", "marker": marker, "fillstyle": fill, "markersize": 3 if kind != "new" else 1.5}
            ax.plot(result.pole_frequency_hz[selected], result.pole_order[selected], color=colour, label=text, **style)
        label(ax.xaxis, "Frequency", "Hz")
        label(ax.yaxis, "Order", "-")
        ax.legend()
    return ax


def plot_modal_fit(result: MeasuredModes, ax: Axes | None, row: int) -> Axes:
    """Draws a function of the band, measured and reconstructed from the modes: motion as displacement, voltage unchanged."""
    unit = "" if result.frf is None else _fit_unit(result.frf.units[result.function[row]])
    description = "Spectrum of the decay" if result.frf is None else "Displacement per force" if unit == "m/N" else "Response"
    with axes(ax) as ax:
        ax.plot(result.line_hz, np.abs(result.measured[row]), label=f"{result.function[row]}, measured")
        ax.plot(result.line_hz, np.abs(result.model[row]), "--", label="modes")
        label(ax.xaxis, "Frequency", "Hz")
        label(ax.yaxis, description, unit, log=True)
        ax.legend()
    return ax


def _fit_unit(unit: str) -> str:
    """Returns the unit of a response in which motion is a displacement, and motion of the base an acceleration."""
    for output in ("m/s^2", "m/s", "m", "V"):
        if unit.startswith(f"{output}/"):
            base_motion = unit[len(output) + 1 :] in ("(m/s^2)", "(m/s)", "m")
            return f"{output[0]}/{'(m/s^2)' if base_motion else unit[len(output) + 1 :]}"
    return ""
