"""Modes of a harvester."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from ._fields import About, Along, Variable
from ._format import html_table
from ._result import Floats, Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class ModesResult(Result):
    """Undamped short-circuit modes, in ascending frequency."""

    frequency_hz: Annotated[Floats, Along("mode", "Hz", "natural frequency, short circuit", detail="0 for a rigid-body mode")]
    damping_ratio: Annotated[Floats, Along("mode", "1", "damping ratio")]
    discretisation_error: Annotated[Floats, Along("mode", "1", "estimated relative error of the frequency")]
    point: Annotated[list[str], About("names of the points")]
    shape: Annotated[Floats, Along("point mode", "kg^-0.5", "mass-normalised shape")]
    patch: Annotated[list[str], About("names of the patches")]
    capacitance_f: Annotated[Floats, Along("patch", "F", "clamped capacitance")]
    open_circuit_hz: Annotated[
        Floats,
        Along("patch mode", "Hz", "frequency with the patch open", detail="one patch open, for this mode only; NaN for a rigid-body mode"),
    ]
    coupling_squared: Annotated[Floats, Along("patch mode", "1", "modal coupling, squared")]
    matched_resistance_ohm: Annotated[
        Floats,
        Along(
            "patch mode",
            "ohm",
            "impedance of the capacitance, 1/(w C)",
            detail="at the short-circuit frequency; the optimal load of a weakly coupled patch",
        ),
    ]
    optimal_resistance_ohm: Annotated[
        Floats,
        Along(
            "patch mode", "ohm", "resistance with the largest power", detail="at the short-circuit frequency, for this patch and mode only"
        ),
    ]
    coupling_n_per_v: Annotated[Floats, Along("patch mode", "N V^-1 kg^-0.5", "modal coupling", "coupling")]
    beams: Annotated[
        dict[str, tuple[Floats, Floats]], About("positions along each beam, m, and the shapes there, kg^-1/2, of shape ``(mode, place)``")
    ]
    plates: Annotated[
        dict[str, tuple[Floats, Floats]],
        About("length and width of each plate, m, and the shapes in an even grid of cells, kg^-1/2, of shape ``(mode, column, row)``"),
    ]
    held: Annotated[list[str], About("masses that were fixed")]

    def __len__(self) -> int:
        return len(self.frequency_hz)

    def _summary(self) -> list[tuple[str, str]]:
        lines = [
            (f"mode {k + 1}", f"{f:.6g} Hz, damping ratio {z:.4g}") for k, (f, z) in enumerate(zip(self.frequency_hz, self.damping_ratio))
        ]
        return lines + ([("held", ", ".join(self.held))] if self.held else [])

    def _repr_html_(self) -> str:
        rows = [
            [k + 1, f"{f:.6g}", f"{z:.4g}", *(f"{c:.4g}" for c in self.coupling_squared[:, k])]
            for k, (f, z) in enumerate(zip(self.frequency_hz, self.damping_ratio))
        ]
        return html_table("Modes", ["mode", "frequency [Hz]", "damping ratio", *(f"coupling² {name}" for name in self.patch)], rows)

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``mode``, ``point`` and ``patch``.

        Shapes along a beam have the axis ``place_BEAM``, shapes over a plate ``x_PLATE`` and ``y_PLATE``.
        """
        variables = self._variables()
        coords = {
            "mode": Variable(("mode",), range(1, len(self) + 1), "1", "number of the mode"),
            "point": Variable(("point",), self.point, "", "point"),
            "patch": Variable(("patch",), self.patch, "", "patch"),
        }
        for name, (position_m, shape) in self.beams.items():
            coords[f"place_{name}"] = Variable((f"place_{name}",), position_m, "m", f"distance from the root of {name}")
            variables[f"shape_{name}"] = Variable(("mode", f"place_{name}"), shape, "kg^-0.5", f"mass-normalised shape along {name}")
        for name, (size_m, shape) in self.plates.items():
            for axis, side_m, count in zip("xy", size_m, shape.shape[1:]):
                middles = (np.arange(count) + 0.5) * side_m / count
                coords[f"{axis}_{name}"] = Variable((f"{axis}_{name}",), middles, "m", f"{axis} of the middle of a cell of {name}")
            dims = ("mode", f"x_{name}", f"y_{name}")
            variables[f"shape_{name}"] = Variable(dims, shape, "kg^-0.5", f"mass-normalised shape over {name}")
        return self._dataset(variables, coords)

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each mode."""
        couplings = {f"coupling_squared_{name}": self.coupling_squared[k] for k, name in enumerate(self.patch)}
        return self._frame({**self._columns("mode"), **couplings})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {"shape": self.plot_modes}

    def plot_modes(self, ax: Axes | None = None, modes: int = 4) -> Axes:
        """Draws the first modes: along the beams, each scaled to 1; without beams over the plates, as contours with nodal lines."""
        from ._plot.modes import plot_modes

        return plot_modes(self, ax, modes)
