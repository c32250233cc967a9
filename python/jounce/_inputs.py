"""Inputs of the functions on recordings: recordings, files, SEP005 time series, labelled and plain arrays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

import numpy as np

from ._arguments import rate_hz
from ._errors import ArgumentError
from ._labelled import agreed_unit, series_of
from ._quantity import is_quantity
from ._recorded_file import RecordedFile, read_recordings
from ._recording import Recording
from ._result import Floats
from ._sep005 import check_series, numbers

#: Accepted as a recording: a recording, a file, a SEP005 time series or a list of those over one time, an array of xarray or pandas with
#: its times and units, a history, or an array with its sampling rate.
Measured = Any

#: Relative difference up to which two rates are equal.
RATE_TOLERANCE = 1e-3


def recording(source: Measured, sample_rate_hz: Any = None) -> Recording:
    """Returns one recording over time."""
    if isinstance(source, (str, PathLike)):
        source = read_recordings(source, sample_rate_hz=sample_rate_hz)
    if isinstance(source, RecordedFile):
        return source.over_time
    return source if isinstance(source, Recording) else Recording.of(source, sample_rate_hz)


def recordings(source: Measured, sample_rate_hz: Any = None) -> list[Recording]:
    """Returns a list of recordings; a list of SEP005 time series, or of numbers, is one recording."""
    if isinstance(source, (list, tuple)) and not source:
        raise ArgumentError("there is no recording; give at least one")
    recording_types = (Recording, RecordedFile, str, PathLike, list, np.ndarray)
    is_list = isinstance(source, (list, tuple)) and any(isinstance(one, recording_types) or _is_labelled(one) for one in source)
    return [recording(one, sample_rate_hz) for one in source] if is_list else [recording(source, sample_rate_hz)]


def _is_labelled(values: Any) -> bool:
    return hasattr(values, "to_sep005") or type(values).__module__.partition(".")[0] in ("xarray", "pandas")


def responses(source: Measured, sample_rate_hz: Any = None) -> list[Recording]:
    """Returns the recordings of a hammer test; for one file with only responses over frequency, all of its recordings."""
    contents = read_recordings(source, sample_rate_hz=sample_rate_hz) if isinstance(source, (str, PathLike)) else source
    if isinstance(contents, RecordedFile) and contents.recordings and all(one.over == "frequency" for one in contents):
        return contents.recordings
    return recordings(contents, sample_rate_hz)


def recording_from_arrays(values: Any, grid: Mapping[str, Any], units: str | Mapping[str, str] | None, name: str) -> dict[str, Any]:
    """Returns arrays with their units over a grid, in the form of the compiled module."""
    series = _series(values, units)
    frequency_hz = series[0].get("frequency")
    if frequency_hz is not None:
        grid = {**grid, "frequency_hz": _matching_axis(frequency_hz, grid["frequency_hz"], "frequency_hz")}
    over = "time" if grid["frequency_hz"] is None else "frequency"
    if over == "frequency" and not all(grid[other] is None for other in ("sample_rate_hz", "time_s")):
        raise ArgumentError("frequency_hz and times are both given; give one of them")
    if over == "frequency":
        _check_lengths(series)
        axis_values, step = numbers(grid["frequency_hz"], "the frequencies"), None
    else:
        axis_values, step = _times(series, grid["sample_rate_hz"], grid["time_s"])
    return {"name": name, "over": over, "places": axis_values, "step": step, "channels": [_channel(one, over) for one in series]}


def _matching_axis(array_axis: Floats, argument: Any, what: str) -> Floats:
    """Returns the axis of an array; an axis that is also given must be equal."""
    if argument is not None:
        axis_values = numbers(argument, what)
        if axis_values.shape != array_axis.shape or not np.allclose(axis_values, array_axis, rtol=RATE_TOLERANCE, atol=0.0):
            raise ArgumentError(f"{what} is given, but the array has different values; give one of them")
    return array_axis


def _check_lengths(series: Sequence[Mapping[str, Any]]) -> None:
    """Raises ArgumentError where channels over frequency have different frequencies."""
    for one in series[1:]:
        if "frequency" in series[0] and not np.array_equal(one.get("frequency", ()), series[0]["frequency"]):
            raise ArgumentError(f"{one['name']} and {series[0]['name']} have different frequencies; make a recording of each")


def _channel(one: Mapping[str, Any], over: str) -> dict[str, Any]:
    what, data = f"the samples of {one['name']}", one["data"]
    if is_quantity(data):
        data = data.to_base_units().magnitude
    imaginary = None
    if over == "frequency" and np.iscomplexobj(data):
        data, imaginary = np.real(data), numbers(np.imag(data), what)
    location, direction, reference = (str(one.get(key, "")) for key in ("location", "direction", "reference"))
    fields = {"name": str(one["name"]), "quantity": None, "unit": str(one["unit_str"])}
    return {
        **fields,
        "place": location,
        "direction": direction,
        "reference": reference,
        "values": numbers(data, what),
        "imaginary": imaginary,
    }


def _times(series: Sequence[Mapping[str, Any]], sample_rate_hz: Any, time_s: Any) -> tuple[Floats, float | None]:
    """Returns the times of the samples, and their step where they are evenly spaced."""
    if sample_rate_hz is not None and time_s is not None:
        raise ArgumentError("sample_rate_hz and time_s are both given; give one of them")
    _check_clocks(series)
    first = series[0]
    series_rate, series_time = first.get("fs"), first.get("time")
    stamps = None if series_time is None else numbers(series_time, f"the times of {first['name']}")
    rates = [(what, rate_hz(rate)) for what, rate in (("sample_rate_hz", sample_rate_hz), ("fs", series_rate)) if rate is not None]
    if stamps is not None and time_s is not None:
        return _matching_axis(stamps, time_s, "time_s"), None
    if time_s is not None:
        stamps = numbers(time_s, "the times")
    _check_rates(first["name"], rates, stamps)
    if stamps is not None and (not rates or not _is_even(stamps, rates[0][1])):
        return stamps, None
    step = 1.0 / (rates[0][1] if rates else rate_hz(None))
    start_s = float(stamps[0]) if stamps is not None and len(stamps) else 0.0
    axis_values: Floats = start_s + step * np.arange(np.size(first["data"]), dtype=np.float64)
    return axis_values, step


def _check_rates(name: Any, rates: Sequence[tuple[str, float]], stamps: Floats | None) -> None:
    """Raises ArgumentError for rates that contradict each other or the times."""
    all_rates = list(rates)
    if stamps is not None and len(stamps) > 1:
        step = float(np.median(np.diff(stamps)))
        all_rates += [("its times", 1.0 / step)] if step > 0.0 else []
    for what, rate in all_rates[1:]:
        if abs(rate / all_rates[0][1] - 1.0) > RATE_TOLERANCE:
            conflict = f"{all_rates[0][0]} is {all_rates[0][1]:g} Hz, but {what} give{'' if what == 'its times' else 's'} {rate:g} Hz"
            raise ArgumentError(f"{name}: {conflict}; give one of them", {"rates_hz": [all_rates[0][1], rate]})


def _is_even(stamps: Floats, rate: float) -> bool:
    """True where the times agree with a rate within a thousandth of a step."""
    even_stamps = stamps[:1] + np.arange(len(stamps)) / rate
    return bool(np.all(np.abs(stamps - even_stamps) * rate <= RATE_TOLERANCE))


def _series(values: Any, units: str | Mapping[str, str] | None) -> list[Mapping[str, Any]]:
    """Returns every channel as a SEP005 time series; without ``fs`` and ``time`` where an array has none."""
    labelled = series_of(values)
    if labelled is not None:
        return [_with_unit(one, units) for one in labelled]
    # A time series without its data is reported as such; it is not a dict of arrays by name.
    if isinstance(values, Mapping) and ("data" in values or isinstance(values.get("unit_str"), str)):
        return [_with_unit(check_series(values), units)]
    if isinstance(values, Mapping):
        if not values:
            raise ArgumentError("there is no channel; give at least one array")
        unit_by_name = units or {}
        if isinstance(unit_by_name, str):
            unit_by_name = dict.fromkeys(values, unit_by_name)
        unknown = [name for name in unit_by_name if name not in values]
        if unknown:
            raise ArgumentError(f"units are given for {', '.join(map(str, unknown))}, but the channels are {', '.join(map(str, values))}")
        return [channel for name, one in values.items() for channel in _named_channels(name, one, unit_by_name.get(name, ""))]
    if isinstance(values, Sequence) and values and all(isinstance(one, Mapping) for one in values):
        return [_with_unit(check_series(one), units) for one in values]
    if units is not None and not isinstance(units, str):
        raise ArgumentError('one array has one unit: give units="V"')
    return [_array("signal", values, units or "")]


def _named_channels(name: Any, values: Any, unit: str) -> list[Mapping[str, Any]]:
    """Returns an array of a dict under its name there, with its own times and unit."""
    labelled = series_of(values)
    if labelled is None:
        return [_array(name, values, unit)]
    channels = [{**one, "name": name} for one in labelled] if len(labelled) == 1 else labelled
    return [_with_unit(one, unit) for one in channels]


def _with_unit(series: Mapping[str, Any], units: str | Mapping[str, str] | None) -> Mapping[str, Any]:
    """Returns a series with the given unit, which must equal its own unit if it has one."""
    unit = units if isinstance(units, str) else (units or {}).get(series["name"], "")
    series_unit = str(series["unit_str"])
    if unit and series_unit and unit != series_unit:
        raise ArgumentError(
            f"{series['name']} is in {series_unit}, but {unit} is given for it; give one of them", {"own": series_unit, "given": unit}
        )
    return {**series, "unit_str": agreed_unit(series["name"], series["data"], unit or series_unit)}


def _array(name: Any, values: Any, unit: str) -> Mapping[str, Any]:
    if not isinstance(values, Sequence) and np.ndim(values) == 0:
        kind = type(values).__name__
        raise ArgumentError(
            f"{name} is of type {kind}; give the path of a recording, a Recording, an array with its sample_rate_hz, or a dict of arrays",
            {"type": kind},
        )
    return {"name": name, "data": values, "unit_str": agreed_unit(name, values, unit)}


def _check_clocks(series: Sequence[Mapping[str, Any]]) -> None:
    """Raises ArgumentError where channels of one recording have different sample times."""
    first = series[0]
    for one in series[1:]:
        is_same_clock = one.get("fs") == first.get("fs")
        if is_same_clock and one.get("fs") is None:
            is_same_clock = np.array_equal(numbers(one.get("time", ()), "the times"), numbers(first.get("time", ()), "the times"))
        if not is_same_clock:
            names = f"{one['name']} and {first['name']}"
            raise ArgumentError(f"{names} are not sampled at the same times; make a recording of each")
