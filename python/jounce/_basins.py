"""Attractors and the share of starts that reach each."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Annotated, Any, Self

import numpy as np

from ._format import counted, html_table
from ._result import Along, Floats, Integers, Result, Truths, Variable


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class BasinsResult(Result):
    """Attractors reached from a cloud or a grid of starts; arrays of shape ``(attractor,)`` and, of the starts, ``(start,)``."""

    #: Drive cycles of the period and a letter by decreasing power, ``"1a"``; ``"chaos"``, ``"torus"``, ``"undecided"`` for the starts
    #: without a proven attractor.
    attractor: list[str]
    #: Period in drive cycles; 0 without a period.
    period_cycles: Annotated[Integers, Along("attractor", "1", "period in drive cycles, 0 without a period")]
    chaotic: Annotated[Truths, Along("attractor", "1", "neighbouring motions diverge")]
    mean_power_w: Annotated[Floats, Along("attractor", "W", "mean power of all loads")]
    contacts_per_period: Annotated[Integers, Along("attractor", "1", "contacts per period")]
    #: Id of the orbit whose mirror image, half a drive cycle later, this orbit is; ``None`` for the others.
    mirror_of: list[str | None]
    #: Share of the starts with its 95 % interval.
    fraction: Annotated[Floats, Along("attractor", "1", "share of the starts")]
    fraction_low: Annotated[Floats, Along("attractor", "1", "lower end of the 95 % interval of the share")]
    fraction_high: Annotated[Floats, Along("attractor", "1", "upper end of the 95 % interval of the share")]
    #: Largest Lyapunov exponent and its error, 1/s; NaN on an orbit.
    lyapunov_per_s: Annotated[Floats, Along("attractor", "1/s", "largest Lyapunov exponent", "lyapunov")]
    lyapunov_error_per_s: Annotated[Floats, Along("attractor", "1/s", "standard error of the exponent", "lyapunov_error")]
    #: Expected power of a start of the cloud with its 95 % interval, W.
    expected_power_w: Annotated[float, Along("", "W", "expected power")]
    expected_power_low_w: Annotated[float, Along("", "W", "lower end of the 95 % interval of the expected power")]
    expected_power_high_w: Annotated[float, Along("", "W", "upper end of the 95 % interval of the expected power")]
    #: Number of starts, number of finished starts, and the seed of the cloud.
    starts: int
    finished: int
    seed: int
    #: Starts whose run failed, and the reason of each.
    failed_start: Annotated[Integers, Along("failed", "1", "number of the start")]
    failed_reason: list[str]
    #: Warnings about exceeded limits of patches on attractors.
    warnings: list[str]
    #: Number of the attractor of each start; -1 where the run failed or was not finished.
    attractor_index: Annotated[Integers, Along("start", "1", "number of the attractor, -1 without one")]
    #: Displacement, m, and velocity, m/s, of each start towards the first stop, and voltage of the first patch, V.
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

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over ``attractor`` and ``start``."""
        coords = {
            "attractor": Variable(("attractor",), self.attractor, "", "attractor"),
            "start": Variable(("start",), np.arange(len(self.attractor_index)), "1", "number of the start"),
        }
        return self._dataset(self._variables(), coords)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each attractor."""
        return self._frame({"attractor": self.attractor, **self._columns("attractor")})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {"starts": self.plot_basins}

    def plot_basins(self, ax: Any = None) -> Any:
        """Draws the starts by displacement and velocity towards the stop, coloured by attractor."""
        from ._plot.basins import plot_basins

        return plot_basins(self, ax)
