"""Attractors and the share of starts that reach each."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any, Self

import numpy as np

from ._fields import About, Along, Variable
from ._format import counted, html_table
from ._grid import on_grid
from ._result import Floats, Integers, Result, Truths

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class BasinsResult(Result):
    """Attractors reached from a cloud or a grid of starts; arrays of shape ``(attractor,)`` and, of the starts, ``(start,)``."""

    attractor: Annotated[
        list[str],
        About(
            'name: drive cycles of the period and a letter by decreasing power, ``"1a"``; ``"chaos"``, ``"torus"`` or ``"undecided"`` for '
            "starts without a proven attractor"
        ),
    ]
    period_cycles: Annotated[Integers, Along("attractor", "1", "period in drive cycles, 0 without a period")]
    chaotic: Annotated[Truths, Along("attractor", "1", "neighbouring motions diverge")]
    mean_power_w: Annotated[Floats, Along("attractor", "W", "mean power of all loads")]
    contacts_per_period: Annotated[Integers, Along("attractor", "1", "contacts per period")]
    mirror_of: Annotated[
        list[str | None], About("orbit whose mirror image, half a drive cycle later, this orbit is; ``None`` for the others")
    ]
    fraction: Annotated[Floats, Along("attractor", "1", "share of the starts")]
    fraction_low: Annotated[Floats, Along("attractor", "1", "lower end of the 95 % interval of the share")]
    fraction_high: Annotated[Floats, Along("attractor", "1", "upper end of the 95 % interval of the share")]
    lyapunov_per_s: Annotated[Floats, Along("attractor", "1/s", "largest Lyapunov exponent", "lyapunov", detail="NaN on an orbit")]
    lyapunov_error_per_s: Annotated[
        Floats, Along("attractor", "1/s", "standard error of the exponent", "lyapunov_error", detail="NaN on an orbit")
    ]
    expected_power_w: Annotated[float, Along("", "W", "expected power")]
    expected_power_low_w: Annotated[float, Along("", "W", "lower end of the 95 % interval of the expected power")]
    expected_power_high_w: Annotated[float, Along("", "W", "upper end of the 95 % interval of the expected power")]
    starts: Annotated[int, About("number of starts")]
    finished: Annotated[int, About("number of finished starts")]
    chaotic_transients: Annotated[
        int, About("number of starts that reach their orbit after a chaotic transient: roundoff decides which orbit each of them reaches")
    ]
    seed: Annotated[int, About("seed of the cloud")]
    gap_m: Annotated[
        float | None,
        About(
            "displacement towards the first stop at which contact begins, its gap, m; ``None`` without a stop, or where the motions of two "
            "bases change the gap"
        ),
    ]
    failed_start: Annotated[Integers, Along("failed", "1", "number of the start")]
    failed_reason: Annotated[list[str], About("reason of each start whose run failed")]
    warnings: Annotated[list[str], About("exceeded limits of patches on attractors")]
    attractor_index: Annotated[
        Integers, Along("start", "1", "number of the attractor, -1 without one", detail="-1 where the run failed or was not finished")
    ]
    start_displacement_m: Annotated[Floats, Along("start", "m", "displacement towards the stop")]
    start_velocity_m_s: Annotated[Floats, Along("start", "m/s", "velocity towards the stop")]
    start_voltage_v: Annotated[Floats, Along("start", "V", "voltage of the first patch")]

    @classmethod
    def _from_core(cls, fields: dict[str, Any]) -> Self:
        return super()._from_core(cls._filled(fields))

    def __len__(self) -> int:
        return len(self.attractor)

    def _summary(self) -> list[tuple[str, str]]:
        finished = int((self.attractor_index >= 0).sum())
        lines = [("starts", f"{len(self.attractor_index)}, {finished} of them classified")]
        lines += [("failed", counted(len(self.failed_start), "start"))] if len(self.failed_start) else []
        for k, name in enumerate(self.attractor):
            share = f"share {self.fraction[k]:.3f} ({self.fraction_low[k]:.3f} to {self.fraction_high[k]:.3f})"
            lines.append((name, f"{self.mean_power_w[k]:.6e} W, {share}"))
        expected = f"{self.expected_power_w:.6e} W ({self.expected_power_low_w:.3e} to {self.expected_power_high_w:.3e})"
        return [*lines, ("expected power", expected), *(("warning", text) for text in self.warnings)]

    def _repr_html_(self) -> str:
        rows = [
            [
                name,
                self.period_cycles[k],
                f"{self.mean_power_w[k]:.5e}",
                f"{self.fraction[k]:.3f}",
                f"{self.fraction_low[k]:.3f} to {self.fraction_high[k]:.3f}",
            ]
            for k, name in enumerate(self.attractor)
        ]
        return html_table("Basins", ["attractor", "period", "mean power [W]", "share", "95 %"], rows)

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``attractor`` and the starts, which are over ``start``, or over the sides of their grid.

        The sides are ``start_displacement``, ``start_velocity`` and ``start_voltage``. ``failure`` is empty where a run did not fail.
        """
        dims, numbers = ("start",), np.arange(len(self.attractor_index))
        reasons = dict(zip(self.failed_start.tolist(), self.failed_reason))
        own = {name: one for name, one in self._variables().items() if one.dims != ("failed",)}
        starts = {name: own.pop(name) for name, one in list(own.items()) if one.dims == dims}
        starts["failure"] = Variable(dims, [reasons.get(number, "") for number in numbers], "", "reason of a failed run")
        start = Variable(dims, numbers, "1", "number of the start")
        sides = self._sides()
        if sides:
            coords, starts = on_grid({name: starts.pop(name) for name in sides}, {**starts, "start": start})
        else:
            coords = {"start": start}
        attractors = {"attractor": Variable(("attractor",), self.attractor, "", "attractor")}
        return self._dataset({**own, **starts}, {**attractors, **coords})

    def _sides(self) -> list[str]:
        """Returns the names of the sides of the grid of starts, as ``start_displacement``; empty for a cloud."""
        return [f"start_{text.partition('=')[0].strip()}" for text in json.loads(self.manifest["options"].get("grid", "[]"))]

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each attractor."""
        return self._frame({"attractor": self.attractor, **self._columns("attractor")})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {"starts": self.plot_basins}

    def plot_basins(self, ax: Axes | None = None) -> Axes:
        """Draws the starts, coloured by attractor, by displacement and velocity or by the first two sides of their grid."""
        from ._plot.basins import plot_basins

        return plot_basins(self, ax)
