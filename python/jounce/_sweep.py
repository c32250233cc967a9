"""Sweeps over one key."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Self

import numpy as np

from ._fields import About, Along, Variable, dataset_fields
from ._format import counted, html_table
from ._grid import on_grid
from ._result import Floats, Integers, Result, Truths

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class SweepResult(Result):
    """Runs at every value of a key, in the order of computation; arrays of shape ``(point,)``."""

    key: Annotated[str, About("key of the sweep")]
    unit: Annotated[str, About("SI unit of the key")]
    parameter: Annotated[Floats, About("value of the key", "SI", axes="point")]
    direction: Annotated[list[str], About('direction of each point: ``"up"``, ``"down"`` or ``"independent"``')]
    mean_power_w: Annotated[Floats, Along("point", "W", "mean power of all loads")]
    voltage_rms_v: Annotated[Floats, Along("point", "V", "rms voltage of the first load, else of the output of the first rectifier")]
    max_penetration_m: Annotated[Floats, Along("point", "m", "largest penetration of the stop")]
    contact_rate_hz: Annotated[Floats, Along("point", "1/s", "contacts per second")]
    settled: Annotated[Truths, Along("point", "1", "settled at the end of the average")]
    period_cycles: Annotated[Integers, Along("point", "1", "period in drive cycles")]
    energy_residual_relative: Annotated[Floats, Along("point", "1", "energy residual of the run")]
    simulated_time_s: Annotated[Floats, Along("point", "s", "simulated time")]
    warnings: Annotated[list[str], About("warnings at points")]

    @classmethod
    def _from_core(cls, fields: dict[str, Any]) -> Self:
        return super()._from_core(cls._filled(fields))

    def __len__(self) -> int:
        return len(self.parameter)

    @property
    def transient(self) -> Truths:
        """True at points that have not settled, although their drives have a common period."""
        not_settled: Truths = ~self.settled & (self.period_cycles > 0)
        return not_settled

    def _summary(self) -> list[tuple[str, str]]:
        lines = [("over", f"{self.key} [{self.unit}]"), ("points", f"{len(self)}, {int(self.settled.sum())} of them settled")]
        if self.transient.any():
            lines.append(("NOT settled", counted(int(self.transient.sum()), "point")))
        if len(self):
            best = int(np.argmax(self.mean_power_w))
            lines.append(("highest power", f"{self.mean_power_w[best]:.6e} W at {self.parameter[best]:g} {self.unit}"))
        return [*lines, *(("warning", text) for text in self.warnings)]

    def _repr_html_(self) -> str:
        rows: list[list[object]] = [
            [f"{p:g}", point_direction, f"{w:.5e}", f"{v:.5g}", bool(s)]
            for p, point_direction, w, v, s in zip(self.parameter, self.direction, self.mean_power_w, self.voltage_rms_v, self.settled)
        ]
        displayed_rows: list[list[object]] = rows if len(rows) <= 20 else [*rows[:10], list("…" * 5), *rows[-10:]]
        return html_table(
            f"Sweep over {self.key}", [f"[{self.unit}]", "direction", "mean power [W]", "voltage, rms [V]", "settled"], displayed_rows
        )

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``direction`` and the key, ``dataset.sel(direction="up")``.

        A point that was not computed is NaN. Where a direction has a value twice, the dataset is over ``point``.
        """
        coords = {
            "direction": Variable(("point",), self.direction, "", "direction of the sweep"),
            self.key: Variable(("point",), self.parameter, self.unit, self.key),
        }
        order = {"point": Variable(("point",), np.arange(len(self)), "1", "order of the points")}
        grid_coords, variables = on_grid(coords, {**self._variables(), **order})
        return self._dataset(variables, grid_coords)

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each point."""
        return self._frame({"parameter": self.parameter, "direction": self.direction, **self._columns("point")})

    def going(self, direction: str) -> Self:
        """Returns the points of one direction, by ascending value of the key."""
        selected = np.array([point_direction == direction for point_direction in self.direction], dtype=bool)
        order = np.flatnonzero(selected)[np.argsort(self.parameter[selected], kind="stable")]
        arrays = {
            field.name: getattr(self, field.name)[order]
            for field in dataclasses.fields(self)
            if isinstance(getattr(self, field.name), np.ndarray)
        }
        return dataclasses.replace(self, direction=[direction] * len(order), **arrays)

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        fields = (field for field, along in dataset_fields(type(self)).items() if along.axes == "point")
        return {field: partial(self.plot_sweep, quantity=field) for field in fields}

    def plot_sweep(self, ax: Axes | None = None, label: str | None = None, *, quantity: str = "mean_power_w") -> Axes:
        """Draws a quantity over the key: up solid, down dashed, single points as dots; unsettled points have a ring."""
        from ._plot.sweep import plot_sweep

        return plot_sweep(self, ax, label, quantity)
