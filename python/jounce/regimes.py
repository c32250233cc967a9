"""A long record cut into stretches of one solution each."""

from __future__ import annotations

import dataclasses
import json
from typing import Annotated, Any

import numpy as np

from . import _core
from .arguments import optional_si, positive_si
from .finding import Finding, found, told
from .given import Measured, recording
from .recording import names_of
from .result import Along, Floats, Integers, Result, Variable, column, html_table, made_manifest


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class RegimesResult(Result):
    """Stretches of one solution each; arrays of shape ``(stretch,)`` and, of the record that was cut, ``(time,)``."""

    #: The channel that was cut, and its unit.
    channel: str
    unit: str
    drive_hz: float
    start_s: Annotated[Floats, Along("stretch", "s", "begin of the stretch")]
    end_s: Annotated[Floats, Along("stretch", "s", "end of the stretch")]
    #: Rms about the mean, in ``unit``.
    rms: Floats
    period_cycles: Annotated[Integers, Along("stretch", "1", "drive cycles of the period, 0 where it does not repeat")]
    mismatch: Annotated[Floats, Along("stretch", "1", "what the repetition misses, over the rms")]
    #: NaN where no resistance was given.
    mean_power_w: Annotated[Floats, Along("stretch", "W", "mean power")]
    half_width_w: Annotated[Floats, Along("stretch", "W", "half the width of its 95 % interval")]
    #: How far a change may lie from its place, s.
    uncertainty_s: float
    #: The record: time from its first sample, s, and the values.
    time_s: Floats
    values: Floats
    findings: list[Finding]

    def __len__(self) -> int:
        return len(self.start_s)

    def names(self) -> list[str]:
        """What each stretch is: ``"period 2"``, ``"no period"``."""
        return [f"period {cycles}" if cycles else "no period" for cycles in self.period_cycles]

    def _summary(self) -> list[tuple[str, str]]:
        lines = [
            ("channel", f"{self.channel} [{self.unit or 'no unit'}]"),
            ("changes", f"lie within {self.uncertainty_s:.3g} s of their places"),
        ]
        for k, name in enumerate(self.names()):
            power = f", {self.mean_power_w[k]:.5e} W +- {self.half_width_w[k]:.1e} W" if np.isfinite(self.mean_power_w[k]) else ""
            lines.append((f"{self.start_s[k]:.3f} s to {self.end_s[k]:.3f} s", f"rms {self.rms[k]:.5e} {self.unit}, {name}{power}"))
        return lines + told(self.findings)

    def _repr_html_(self) -> str:
        columns = (self.start_s, self.end_s, self.rms, self.mismatch)
        rows = [[name, *(f"{one[k]:.5g}" for one in columns)] for k, name in enumerate(self.names())]
        return html_table("Stretches", ["solution", "from [s]", "to [s]", f"rms [{self.unit}]", "mismatch"], rows)

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over ``stretch``, and the record over ``time``."""
        variables = {
            **self._variables(),
            "rms": Variable(("stretch",), self.rms, self.unit, f"{self.channel}, rms about the mean"),
            "values": Variable(("time",), self.values, self.unit, self.channel),
        }
        coords = {
            "stretch": Variable(("stretch",), np.arange(len(self)), "1", "number of the stretch"),
            "time": Variable(("time",), self.time_s, "s", "time from the first sample"),
        }
        return self._dataset(variables, coords)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each stretch."""
        return self._frame({**self._columns("stretch"), "rms": self.rms})

    def plot_regimes(self, ax: Any = None) -> Any:
        """Draws the record, a colour for each stretch."""
        from .plot.regimes import plot_regimes

        return plot_regimes(self, ax)


def regimes(
    record: Measured, drive: Any, *, sample_rate_hz: Any = None, channel: str | None = None, resistance: Any = None
) -> RegimesResult:
    """Cuts a record under a ``drive`` of a known frequency, ``"13 Hz"``, into stretches of one solution each.

    ``record`` is a :class:`Recording`, a file, SEP005 time series, or an array with its ``sample_rate_hz``; ``channel`` the one to cut, by
    default the first in volts. With the ``resistance`` of the load, of which the channel is the voltage, power is told for each stretch.
    """
    given = recording(record, sample_rate_hz)
    drive_hz, ohm = positive_si("frequency", drive, "drive"), optional_si("resistance", resistance, "resistance")
    answer = _core.measured_regimes(given._core(), drive_hz, channel, ohm)
    stretches, powers = json.loads(answer["stretches"]), json.loads(answer["powers"])
    periods = [one["period"] for one in stretches]
    none: list[dict[str, Any]] = [{} for _ in stretches]
    return RegimesResult(
        manifest=made_manifest("regimes", **names_of([given]), drive_hz=drive_hz, resistance_ohm=ohm),
        channel=answer["channel"],
        unit=answer["unit"],
        drive_hz=drive_hz,
        start_s=column(stretches, "start_s"),
        end_s=column(stretches, "end_s"),
        rms=column(stretches, "rms"),
        period_cycles=np.array([one["cycles"] or 0 for one in periods], dtype=np.int64),
        mismatch=column(periods, "mismatch"),
        mean_power_w=column(powers or none, "mean_power_w"),
        half_width_w=column(powers or none, "half_width_w"),
        uncertainty_s=answer["uncertainty_s"],
        time_s=answer["time_s"] - answer["time_s"][0],
        values=answer["values"],
        findings=[*given.findings, *found(answer["findings"])],
    )
