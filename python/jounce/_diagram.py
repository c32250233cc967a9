"""Bifurcation diagrams by integration."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Self

import numpy as np

from ._branch import Branch, BranchResult
from ._errors import ArgumentError
from ._fields import About, Variable
from ._format import counted, html_table
from ._grid import on_grid
from ._result import Floats, Integers, Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset

#: Quantities of the section: field, unit, description.
SECTION = {
    "displacement": ("section_displacement_m", "m", "displacement towards the stop at the start of a drive cycle"),
    "velocity": ("section_velocity_m_s", "m/s", "velocity towards the stop"),
    "voltage": ("section_voltage_v", "V", "voltage of the first patch"),
}


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class DiagramResult(Result):
    """State at the start of each drive cycle; arrays of shape ``(point,)`` and, of the section, ``(section,)``."""

    key: Annotated[str, About("key of the diagram")]
    unit: Annotated[str, About("SI unit of the key")]
    parameter: Annotated[Floats, About("value of the key in each run", "SI", axes="point")]
    direction: Annotated[list[str], About('direction of each run: ``"up"``, ``"down"``, ``"independent"`` (from a start of the cloud)')]
    start: Annotated[Integers, About("number of the start in its cloud; 0 in a stepped diagram", axes="point")]
    motion: Annotated[list[str], About('``"orbit"``, ``"chaos"``, ``"torus"``, ``"undecided"`` or ``"lost"`` of each run')]
    period_cycles: Annotated[Integers, About("period in drive cycles; 0 without a period", axes="point")]
    contacts_per_period: Annotated[Integers, About("contacts in a period", axes="point")]
    mean_power_w: Annotated[Floats, About("mean power of all loads", "W", axes="point")]
    attractor: Annotated[list[str | None], About("attractor of each run; ``None`` without one, and in a stepped diagram")]
    section_point: Annotated[Integers, About("number of the run of each point of the section", axes="section")]
    section_displacement_m: Annotated[Floats, About("displacement towards the first stop", "m", axes="section")]
    section_velocity_m_s: Annotated[Floats, About("velocity towards the first stop", "m/s", axes="section")]
    section_voltage_v: Annotated[Floats, About("voltage of the first patch", "V", axes="section")]
    attractors: Annotated[
        list[dict[str, Any]],
        About("with starts only: each attractor with ``id``, ``motion``, ``period_cycles``, ``born``, ``died``, ``seen``"),
    ]
    branches: Annotated[list[Branch], About("branches continued over the same range, unstable parts included")]
    warnings: Annotated[list[str], About("failed runs")]

    @classmethod
    def _from_core(cls, fields: dict[str, Any]) -> Self:
        branches = [Branch._of(one) for one in fields["branches"]]
        return super()._from_core({**fields, "branches": branches, "attractors": fields["attractors"] or []})

    def __len__(self) -> int:
        return len(self.parameter)

    def _summary(self) -> list[tuple[str, str]]:
        kinds = sorted(set(self.motion))
        runs = f"{len(self)} with {counted(len(self.section_point), 'point')} of the section"
        lines = [("over", f"{self.key} [{self.unit}]"), ("runs", runs)]
        lines += [(kind, str(self.motion.count(kind))) for kind in kinds]
        for one in self.attractors:
            track_points = one["seen"]
            lines.append(
                (f"attractor {one['id']}", f"from {track_points[0]['parameter']:.6g} to {track_points[-1]['parameter']:.6g} {self.unit}")
            )
        return [*lines, ("branches", str(len(self.branches))), *(("warning", text) for text in self.warnings)]

    def _repr_html_(self) -> str:
        rows = [[kind, self.motion.count(kind)] for kind in sorted(set(self.motion))]
        return html_table(f"Diagram over {self.key}", ["motion", "runs"], rows)

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` of the runs over ``direction`` and the key, or ``start`` and the key, and of the ``section``.

        ``section_point`` is the number of the run of each point of the section, the value of ``point`` at the run. A run that was not
        computed is NaN.
        """
        dims = ("point",)
        variables = {
            "point": Variable(dims, np.arange(len(self)), "1", "number of the run"),
            "motion": Variable(dims, self.motion, "", "kind of the motion"),
            "period_cycles": Variable(dims, self.period_cycles, "1", "period in drive cycles, 0 without a period"),
            "contacts_per_period": Variable(dims, self.contacts_per_period, "1", "contacts per period"),
            "mean_power": Variable(dims, self.mean_power_w, "W", "mean power of all loads"),
            "attractor": Variable(dims, [one or "" for one in self.attractor], "", "id of the attractor, empty without one"),
        }
        coords = {
            "direction": Variable(dims, self.direction, "", "direction of the sweep"),
            "start": Variable(dims, self.start, "1", "number of the start in its cloud"),
            self.key: Variable(dims, self.parameter, self.unit, self.key),
        }
        del coords["direction" if set(self.direction) == {"independent"} else "start"]
        grid_coords, variables = on_grid(coords, variables)
        along = ("section",)
        for name, (field, units, description) in SECTION.items():
            variables[f"section_{name}"] = Variable(along, getattr(self, field), units, description)
        variables["section_point"] = Variable(along, self.section_point, "1", "number of the run of the point")
        grid_coords["section_parameter"] = Variable(along, self.parameter[self.section_point], self.unit, self.key)
        return self._dataset(variables, grid_coords)

    def _parts(self) -> dict[str, Dataset]:
        return BranchResult(self.manifest, self.key, self.unit, self.branches, None, None, "", [])._parts()

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each point of the section."""
        point = self.section_point
        return self._frame(
            {
                "parameter": self.parameter[point],
                "direction": [self.direction[k] for k in point],
                "start": self.start[point],
                "attractor": [self.attractor[k] or "" for k in point],
                "motion": [self.motion[k] for k in point],
                "period_cycles": self.period_cycles[point],
                "mean_power_w": self.mean_power_w[point],
                "displacement_m": self.section_displacement_m,
                "velocity_m_s": self.section_velocity_m_s,
                "voltage_v": self.section_voltage_v,
            }
        )

    def section(self, quantity: str) -> tuple[Floats, str, str]:
        """Returns values at the points of the section, unit and description of ``"displacement"``, ``"velocity"`` or ``"voltage"``."""
        if quantity not in SECTION:
            raise ArgumentError(f"{quantity}: no such quantity of a section; there are {', '.join(SECTION)}")
        field, units, description = SECTION[quantity]
        return getattr(self, field), units, description

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {quantity: partial(self.plot_diagram, quantity=quantity) for quantity in SECTION}

    def plot_diagram(self, ax: Axes | None = None, quantity: str = "displacement") -> Axes:
        """Draws the section over the key: orbits as large dots, other motions as small dots, coloured by direction or attractor."""
        from ._plot.diagram import plot_diagram

        return plot_diagram(self, ax, quantity)
