"""Picture of the energy balance."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._errors import ArgumentError
from .style import COLOURS, axes, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._run import RunResult

_NAMES = {
    "loads_j": "electrical loads",
    "rectified_j": "rectified storage",
    "rectified_loss_j": "rectifiers",
    "leaks_j": "leakage of patches",
    "damping_j": "damping",
    "contact_loss_j": "contact",
    "stored_j": "still stored",
}


def plot_energy(result: RunResult, ax: Axes | None = None) -> Axes:
    """Draws a bar for each energy output, in percent of the input."""
    input_j = result.energies_j["input_j"]
    if input_j <= 0.0:
        raise ArgumentError(f"the input energy is {input_j:g} J, so there are no shares to draw")
    # Outputs that the harvester does not have are omitted.
    required_elements = {"rectified_j": result.rectified, "rectified_loss_j": result.rectified, "leaks_j": result.leak}
    names = {key: name for key, name in _NAMES.items() if required_elements.get(key, True)}
    shares = [100.0 * result.energies_j[key] / input_j for key in names]
    with axes(ax) as ax:
        bars = ax.barh(list(names.values()), shares, color=COLOURS[: len(shares)])
        ax.bar_label(bars, [f"{share:.3g} %" for share in shares], padding=3, fontsize=8)
        ax.invert_yaxis()
        ax.grid(axis="y", visible=False)
        ax.margins(x=0.15)
        label(ax.xaxis, f"Share of the input of {input_j:.3g} J", "%")
    return ax
