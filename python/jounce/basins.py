"""Attractors and how likely each is."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from .result import Floats, Integers, Result, Truths, Variable, html_table


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class BasinsResult(Result):
    """The attractors that a cloud or a grid of starts ends on; arrays of shape ``(attractor,)`` and, of the starts, ``(start,)``."""

    #: Drive cycles of the period and a letter by falling power, ``"1a"``; ``"chaos"``, ``"torus"``, ``"unsettled"``.
    attractor: list[str]
    #: Period in drive cycles; 0 for none.
    period_cycles: Integers
    chaotic: Truths
    mean_power_w: Floats
    contacts_per_period: Integers
    #: Share of the starts and its 95 % interval.
    fraction: Floats
    fraction_low: Floats
    fraction_high: Floats
    #: Largest Lyapunov exponent and its error, 1/s; NaN on an orbit.
    lyapunov_per_s: Floats
    lyapunov_error_per_s: Floats
    #: Power to be expected from a start of the cloud and its 95 % interval, W.
    expected_power_w: float
    expected_power_low_w: float
    expected_power_high_w: float
    #: Starts whose march failed, with the reason.
    lost: list[tuple[int, str]]
    #: Number of the attractor of each start; -1 where it was lost or not finished.
    ends_in: Integers
    #: Displacement, m, and velocity, m/s, of each start towards the first stop, and voltage of the first patch, V.
    start_displacement_m: Floats
    start_velocity_m_s: Floats
    start_voltage_v: Floats

    def __len__(self) -> int:
        return len(self.attractor)

    def _summary(self) -> list[tuple[str, str]]:
        finished = int((self.ends_in >= 0).sum())
        lines = [("starts", f"{len(self.ends_in)}, {finished} of them recognised")]
        for k, name in enumerate(self.attractor):
            share = f"share {self.fraction[k]:.3f} ({self.fraction_low[k]:.3f} to {self.fraction_high[k]:.3f})"
            lines.append((name, f"{self.mean_power_w[k]:.6e} W, {share}"))
        expected = f"{self.expected_power_w:.6e} W ({self.expected_power_low_w:.3e} to {self.expected_power_high_w:.3e})"
        return [*lines, ("expected power", expected)]

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
        of = ("attractor",)
        variables = {
            "period_cycles": Variable(of, self.period_cycles, "1", "period in drive cycles, 0 for none"),
            "chaotic": Variable(of, self.chaotic, "1", "neighbouring motions part"),
            "mean_power": Variable(of, self.mean_power_w, "W", "mean power of all loads"),
            "contacts_per_period": Variable(of, self.contacts_per_period, "1", "contacts that begin in a period"),
            "fraction": Variable(of, self.fraction, "1", "share of the starts"),
            "fraction_low": Variable(of, self.fraction_low, "1", "lower end of its 95 % interval"),
            "fraction_high": Variable(of, self.fraction_high, "1", "upper end of its 95 % interval"),
            "lyapunov": Variable(of, self.lyapunov_per_s, "1/s", "largest Lyapunov exponent"),
            "lyapunov_error": Variable(of, self.lyapunov_error_per_s, "1/s", "its standard error"),
            "expected_power": Variable((), self.expected_power_w, "W", "power to be expected"),
            "expected_power_low": Variable((), self.expected_power_low_w, "W", "lower end of its 95 % interval"),
            "expected_power_high": Variable((), self.expected_power_high_w, "W", "upper end of its 95 % interval"),
            "ends_in": Variable(("start",), self.ends_in, "1", "number of the attractor, -1 for none"),
            "start_displacement": Variable(("start",), self.start_displacement_m, "m", "displacement towards the stop"),
            "start_velocity": Variable(("start",), self.start_velocity_m_s, "m/s", "velocity towards the stop"),
            "start_voltage": Variable(("start",), self.start_voltage_v, "V", "voltage of the first patch"),
        }
        coords = {
            "attractor": Variable(of, self.attractor, "", "attractor"),
            "start": Variable(("start",), np.arange(len(self.ends_in)), "1", "number of the start"),
        }
        return self._dataset(variables, coords)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each attractor."""
        fields = dataclasses.fields(self)
        first, last = ([field.name for field in fields].index(name) for name in ("attractor", "lyapunov_error_per_s"))
        return self._frame({field.name: getattr(self, field.name) for field in fields[first : last + 1]})

    def plot_basins(self, ax: Any = None) -> Any:
        """Draws the starts by displacement and velocity towards the stop, coloured by where they end."""
        from .plot.basins import plot_basins

        return plot_basins(self, ax)
