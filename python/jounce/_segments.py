"""Segmentation of a long record into steady-state responses."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from . import _core
from ._arguments import check_integers, options, to_si
from ._call import recorded
from ._errors import ArgumentError
from ._fields import About, Along, Variable
from ._format import html_table, with_uncertainty
from ._inputs import Measured, recording
from ._issue import Issue, issue_lines, parse_issues
from ._recording import names_of
from ._result import Floats, Integers, Result, Truths, make_manifest, result_or_raise
from ._spec import Spec

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class SegmentsResult(Result):
    """Segments of one solution each; arrays of shape ``(segment,)`` and, for the segmented record, ``(time,)``."""

    channel: Annotated[str, About("segmented channel")]
    unit: Annotated[str, About("unit of the channel")]
    drive_hz: Annotated[float, About("frequency of the drive", "Hz")]
    resistance_ohm: Annotated[float, About("resistance of the load; NaN where it was not given", "ohm")]
    start_s: Annotated[Floats, Along("segment", "s", "begin of the segment")]
    end_s: Annotated[Floats, Along("segment", "s", "end of the segment")]
    rms: Annotated[Floats, About("rms about the mean, in ``unit``", axes="segment")]
    period_cycles: Annotated[Integers, Along("segment", "1", "period in drive cycles, 0 where it is longer than 12 or absent")]
    mismatch: Annotated[Floats, Along("segment", "1", "deviation from periodicity, relative to the rms")]
    mean_power_w: Annotated[Floats, Along("segment", "W", "mean power", detail="NaN where no resistance was given")]
    half_width_w: Annotated[Floats, Along("segment", "W", "half width of its 95 % interval")]
    effective_samples: Annotated[Floats, Along("segment", "1", "effective number of independent values of the power")]
    batch_correlation: Annotated[Floats, Along("segment", "1", "correlation between consecutive batches of the power")]
    mean_voltage_v: Annotated[Floats, Along("segment", "V", "mean voltage")]
    correlated: Annotated[Truths, Along("segment", "1", "the interval of the mean power may be too narrow")]
    joint_at_s: Annotated[Floats, Along("joint", "s", "change within one solution")]
    joint_reason: Annotated[list[str], About('changes within one solution: ``"noise-changed"``, ``"drifts"`` or ``"glitch"`` at each')]
    uncertainty_s: Annotated[float, About("uncertainty of the time of a change", "s")]
    solution: Annotated[
        list[str],
        About(
            'matching solution of the model for each segment, ``"1a"``; ``"several"`` where more than one matches, ``"none"`` where no '
            "solution matches; empty without a model"
        ),
    ]
    candidates: Annotated[
        list[list[dict[str, Any]]],
        About(
            "for each segment every solution of the model, the nearest first: ``id``, ``period_cycles``, ``mean_power_w``, "
            "``waveform_distance``, ``spectrum_distance`` (relative to that of the record, ``None`` without a period), ``power_ratio``, "
            "``inverted``; empty without a model"
        ),
    ]
    time_s: Annotated[Floats, About("time of each sample from the first one", "s", axes="time")]
    values: Annotated[Floats, About("samples of the channel, in ``unit``", axes="time")]
    issues: Annotated[list[Issue], About("data-quality issues of the recording")]

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
        lines += [(f"{at_s:.3f} s", f"{reason}, same solution") for at_s, reason in zip(self.joint_at_s, self.joint_reason)]
        return lines + issue_lines(self.issues)

    def _repr_html_(self) -> str:
        columns = (self.start_s, self.end_s, self.rms, self.mismatch)
        rows = [[name, *(f"{one[k]:.5g}" for one in columns)] for k, name in enumerate(self.names())]
        return html_table("Segments", ["solution", "from [s]", "to [s]", f"rms [{self.unit}]", "mismatch"], rows)

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``segment``, and the record over ``time``."""
        variables = {
            **self._variables(),
            "rms": Variable(("segment",), self.rms, self.unit, f"{self.channel}, rms about the mean"),
            "values": Variable(("time",), self.values, self.unit, self.channel),
        }
        variables["joint_reason"] = Variable(("joint",), self.joint_reason, "", "reason of the change")
        if self.solution:
            variables["solution"] = Variable(("segment",), self.solution, "", "matching solution of the model")
        coords = {
            "segment": Variable(("segment",), np.arange(len(self)), "1", "number of the segment"),
            "time": Variable(("time",), self.time_s, "s", "time from the first sample"),
        }
        return self._dataset(variables, coords)

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each segment."""
        solution_column = {"solution": self.solution} if self.solution else {}
        return self._frame({**self._columns("segment"), "rms": self.rms, **solution_column})

    def candidates_to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each solution of the model in each segment."""
        rows = [{"segment": k, **one} for k, each in enumerate(self.candidates) for one in each]
        return self._frame({name: [row[name] for row in rows] for name in (rows[0] if rows else ())})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {"record": self.plot_segments}

    def plot_segments(self, ax: Axes | None = None) -> Axes:
        """Draws the record, with a colour for each segment."""
        from ._plot.segments import plot_segments

        return plot_segments(self, ax)


@recorded
def segments(
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
) -> SegmentsResult:
    """Segments a record under a ``drive`` of a known frequency, ``"13 Hz"``, by steady-state response.

    With a ``model``, set to the drive and the load of the record, each segment is matched with the nearest solution.
    """
    check_integers(starts=starts, seed=seed)
    if model is not None and not isinstance(model, Spec):
        raise ArgumentError(f"model is of type {type(model).__name__}; give a jounce.Spec")
    input_recording = recording(record, sample_rate_hz)
    given: dict[str, Any] = {"drive_hz": to_si("frequency", drive, "drive"), "channel": channel}
    given["resistance_ohm"] = None if resistance is None else to_si("resistance", resistance, "resistance")
    given |= {"starts": starts, "seed": seed, "load": load, "within": within}
    core_result = _core.segments(input_recording._core(), options(**given), None if model is None else model._spec)
    fields = SegmentsResult._filled(result_or_raise(core_result))
    manifest = make_manifest("segments", **names_of([input_recording]), **given)
    fields["manifest"] = manifest if model is None else {**manifest, "spec_sha256": model.sha256}
    fields["candidates"] = [] if model is None else json.loads(fields["candidates"])
    fields["issues"] = [*input_recording.issues, *parse_issues(fields["issues"])]
    return SegmentsResult(**fields)
