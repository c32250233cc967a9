"""Segmentation of a long record into steady-state responses."""

from __future__ import annotations

import dataclasses
import json
from typing import Annotated, Any

import numpy as np

from . import _core
from .arguments import check_integers, optional_si, positive_si
from .errors import ArgumentError
from .inputs import Measured, recording
from .issue import Finding, issue_lines, parse_issues
from .recording import Recording, names_of
from .result import Along, Floats, Integers, Result, Variable, column, html_table, make_manifest, result_or_raise, with_uncertainty
from .spec import Spec


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class RegimesResult(Result):
    """Segments of one solution each; arrays of shape ``(stretch,)`` and, for the segmented record, ``(time,)``."""

    #: Segmented channel, and its unit.
    channel: str
    unit: str
    drive_hz: float
    start_s: Annotated[Floats, Along("stretch", "s", "begin of the segment")]
    end_s: Annotated[Floats, Along("stretch", "s", "end of the segment")]
    #: Rms about the mean, in ``unit``.
    rms: Floats
    period_cycles: Annotated[Integers, Along("stretch", "1", "period in drive cycles, 0 where it is longer than 12 or absent")]
    mismatch: Annotated[Floats, Along("stretch", "1", "deviation from periodicity, relative to the rms")]
    #: NaN where no resistance was given, and where a segment is too short for an interval.
    mean_power_w: Annotated[Floats, Along("stretch", "W", "mean power")]
    half_width_w: Annotated[Floats, Along("stretch", "W", "half width of its 95 % interval")]
    effective_samples: Annotated[Floats, Along("stretch", "1", "effective number of independent values of the power")]
    #: Changes within one solution: ``"noise-changed"``, ``"drifts"`` or ``"glitch"`` at each.
    joint_s: Annotated[Floats, Along("joint", "s", "change within one solution")]
    joint_reason: list[str]
    #: Uncertainty of the time of a change, s.
    uncertainty_s: float
    #: Matching solution of the model for each segment, ``"1a"``; ``"several"`` where more than one matches, ``"none"`` where no solution
    #: matches. Empty without a model.
    solution: list[str]
    #: For each segment every solution of the model, the nearest first: ``id``, ``period_cycles``, ``mean_power_w``, ``waveform_distance``,
    #: ``spectrum_distance`` (relative to that of the record, ``None`` without a period), ``power_ratio``, ``inverted``. Empty without a
    #: model.
    candidates: list[list[dict[str, Any]]]
    #: Record: time from its first sample, s, and the values.
    time_s: Floats
    values: Floats
    findings: list[Finding]

    def __len__(self) -> int:
        return len(self.start_s)

    def names(self) -> list[str]:
        """Returns the kind of each segment: ``"period 2"``, ``"no period"``."""
        return [f"period {cycles}" if cycles else "no period" for cycles in self.period_cycles]

    def _summary(self) -> list[tuple[str, str]]:
        lines = [
            ("channel", f"{self.channel} [{self.unit or 'no unit'}]"),
            ("changes", f"uncertainty {self.uncertainty_s:.3g} s"),
        ]
        for k, name in enumerate(self.names()):
            mean = with_uncertainty(self.mean_power_w[k], self.half_width_w[k], "W")
            power = f", {mean}" if np.isfinite(self.mean_power_w[k]) else ""
            solution = f", solution: {self.solution[k]}" if self.solution else ""
            lines.append(
                (f"{self.start_s[k]:.3f} s to {self.end_s[k]:.3f} s", f"rms {self.rms[k]:.5e} {self.unit}, {name}{power}{solution}")
            )
        lines += [(f"{at_s:.3f} s", f"{reason}, same solution") for at_s, reason in zip(self.joint_s, self.joint_reason)]
        return lines + issue_lines(self.findings)

    def _repr_html_(self) -> str:
        columns = (self.start_s, self.end_s, self.rms, self.mismatch)
        rows = [[name, *(f"{one[k]:.5g}" for one in columns)] for k, name in enumerate(self.names())]
        return html_table("Segments", ["solution", "from [s]", "to [s]", f"rms [{self.unit}]", "mismatch"], rows)

    def to_xarray(self) -> Any:
        """Returns an ``xarray.Dataset`` over ``stretch``, and the record over ``time``."""
        variables = {
            **self._variables(),
            "rms": Variable(("stretch",), self.rms, self.unit, f"{self.channel}, rms about the mean"),
            "values": Variable(("time",), self.values, self.unit, self.channel),
        }
        variables["joint_reason"] = Variable(("joint",), self.joint_reason, "", "reason of the change")
        if self.solution:
            variables["solution"] = Variable(("stretch",), self.solution, "", "matching solution of the model")
        coords = {
            "stretch": Variable(("stretch",), np.arange(len(self)), "1", "number of the segment"),
            "time": Variable(("time",), self.time_s, "s", "time from the first sample"),
        }
        return self._dataset(variables, coords)

    def to_pandas(self) -> Any:
        """Returns a ``pandas.DataFrame`` with a row for each segment."""
        solution_column = {"solution": self.solution} if self.solution else {}
        return self._frame({**self._columns("stretch"), "rms": self.rms, **solution_column})

    def candidates_to_pandas(self) -> Any:
        """Returns a ``pandas.DataFrame`` with a row for each solution of the model in each segment."""
        rows = [{"stretch": k, **one} for k, each in enumerate(self.candidates) for one in each]
        return self._frame({name: [row[name] for row in rows] for name in (rows[0] if rows else ())})

    def plot_regimes(self, ax: Any = None) -> Any:
        """Draws the record, with a colour for each segment."""
        from .plot.regimes import plot_regimes

        return plot_regimes(self, ax)


def regimes(
    record: Measured,
    drive: Any,
    *,
    sample_rate_hz: Any = None,
    channel: str | None = None,
    resistance: Any = None,
    model: Spec | None = None,
    starts: int = 40,
    seed: int = 1,
    load: str | None = None,
    within: float = 0.2,
) -> RegimesResult:
    """Segments a record under a ``drive`` of a known frequency, ``"13 Hz"``, by steady-state response.

    ``record`` is a :class:`Recording`, a file, SEP005 time series, or an array with its ``sample_rate_hz``. ``channel`` names the channel
    to segment, by default the first in volts. With the ``resistance`` of a load whose voltage this channel is, the power of each segment is
    returned.

    With a ``model``, set to the drive and the load of the record, each segment is matched with the nearest solution. A solution matches if
    the relative distance of its waveform is at most ``within``. The solutions are found from random ``starts`` with a ``seed``; ``load``
    names the circuit whose voltage was recorded, by default the first.
    """
    check_integers(starts=starts, seed=seed)
    if model is not None and not isinstance(model, Spec):
        raise ArgumentError(f"model is of type {type(model).__name__}; give a jounce.Spec")
    input_recording = recording(record, sample_rate_hz)
    drive_hz, ohm = positive_si("frequency", drive, "drive"), optional_si("resistance", resistance, "resistance")
    matching = {"starts": starts, "seed": seed, "load": load, "within": within}
    core_result = _core.measured_regimes(input_recording._core(), drive_hz, channel, ohm, None if model is None else model._spec, matching)
    result = result_or_raise(core_result)
    matches = json.loads(result["correspondences"])
    segments, power_dicts, joints = (json.loads(result[name]) for name in ("stretches", "powers", "joints"))
    powers = [one or {} for one in power_dicts]
    periods = [one["period"] for one in segments]
    no_values: list[dict[str, Any]] = [{} for _ in segments]
    return RegimesResult(
        manifest=_manifest(input_recording, drive_hz, ohm, model, matching),
        channel=result["channel"],
        unit=result["unit"],
        drive_hz=drive_hz,
        start_s=column(segments, "start_s"),
        end_s=column(segments, "end_s"),
        rms=column(segments, "rms"),
        period_cycles=np.array([one["cycles"] or 0 for one in periods], dtype=np.int64),
        mismatch=column(periods, "mismatch"),
        mean_power_w=column(powers or no_values, "mean_power_w"),
        half_width_w=column(powers or no_values, "half_width_w"),
        effective_samples=column(powers or no_values, "effective_samples"),
        joint_s=column(joints, "at_s"),
        joint_reason=[one["reason"] for one in joints],
        uncertainty_s=result["uncertainty_s"],
        solution=[_solution_name(one) for one in matches],
        candidates=[one["candidates"] for one in matches],
        time_s=result["time_s"] - result["time_s"][0],
        values=result["values"],
        findings=[*input_recording.findings, *parse_issues(result["findings"])],
    )


def _solution_name(match: dict[str, Any]) -> str:
    """Returns the matching solution of a segment."""
    one: str = match["candidates"][0]["id"] if match["fits"] == "one" else match["fits"]
    return one


def _manifest(
    input_recording: Recording, drive_hz: float, ohm: float | None, model: Spec | None, matching: dict[str, Any]
) -> dict[str, Any]:
    options: dict[str, Any] = {"drive_hz": drive_hz, "resistance_ohm": ohm}
    if model is None:
        return make_manifest("regimes", **names_of([input_recording]), **options)
    return {**make_manifest("regimes", **names_of([input_recording]), **options, **matching), "spec_sha256": model.sha256}
