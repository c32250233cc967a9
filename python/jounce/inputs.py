"""Inputs of the functions on recordings: recordings, files, SEP005 time series, labelled and plain arrays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

import numpy as np

from .arguments import rate_hz
from .errors import ArgumentError
from .labelled import agreed, series_of
from .quantity import is_quantity
from .recorded_file import RecordedFile, read_recordings
from .recording import Recording
from .result import Floats
from .sep005 import checked, numbers

#: Accepted as a recording: a recording, a file, a SEP005 time series or a list of those over one time, an array of xarray or pandas with
#: its times and units, a history, or an array with its sampling rate.
Measured = Any

#: Relative difference up to which two rates are equal.
SAME_RATE = 1e-3


def recording(given: Measured, sample_rate_hz: Any = None) -> Recording:
    """Returns one recording over time."""
    if isinstance(given, (str, PathLike)):
        given = read_recordings(given)
    if isinstance(given, RecordedFile):
        return given.over_time
    return given if isinstance(given, Recording) else Recording.of(given, sample_rate_hz)


def recordings(given: Measured, sample_rate_hz: Any = None) -> list[Recording]:
    """Returns a list of recordings; a list of SEP005 time series, or of numbers, is one recording."""
    if isinstance(given, (list, tuple)) and not given:
        raise ArgumentError("there is no recording; give at least one")
    kinds = (Recording, RecordedFile, str, PathLike, list, np.ndarray)
    several = isinstance(given, (list, tuple)) and any(isinstance(one, kinds) or _is_labelled(one) for one in given)
    return [recording(one, sample_rate_hz) for one in given] if several else [recording(given, sample_rate_hz)]


def _is_labelled(values: Any) -> bool:
    return hasattr(values, "to_sep005") or type(values).__module__.partition(".")[0] in ("xarray", "pandas")


def responses(given: Measured, sample_rate_hz: Any = None) -> list[Recording]:
    """Returns the recordings of a hammer test; for one file with only responses over frequency, all of its recordings."""
    found = read_recordings(given) if isinstance(given, (str, PathLike)) else given
    if isinstance(found, RecordedFile) and found.recordings and all(one.over == "frequency" for one in found):
        return found.recordings
    return recordings(found, sample_rate_hz)


def of_arrays(values: Any, grid: Mapping[str, Any], units: str | Mapping[str, str] | None, name: str) -> dict[str, Any]:
    """Returns arrays with their units over a grid, in the form of the compiled module."""
    series = _series(values, units)
    frequency_hz = series[0].get("frequency")
    if frequency_hz is not None:
        grid = {**grid, "frequency_hz": _one_axis(frequency_hz, grid["frequency_hz"], "frequency_hz")}
    over = "time" if grid["frequency_hz"] is None else "frequency"
    if over == "frequency" and not all(grid[other] is None for other in ("sample_rate_hz", "time_s")):
        raise ArgumentError("frequency_hz and times are both given; give one of them")
    if over == "frequency":
        _check_lengths(series)
        places, step = numbers(grid["frequency_hz"], "the frequencies"), None
    else:
        places, step = _times(series, grid["sample_rate_hz"], grid["time_s"])
    return {"name": name, "over": over, "places": places, "step": step, "channels": [_channel(one, over) for one in series]}


def _one_axis(own: Floats, given: Any, what: str) -> Floats:
    """Returns the axis of an array; an axis that is also given must be equal."""
    if given is not None:
        places = numbers(given, what)
        if places.shape != own.shape or not np.allclose(places, own, rtol=SAME_RATE, atol=0.0):
            raise ArgumentError(f"{what} is given, but the array has different values; give one of them")
    return own


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
    place, direction, reference = (str(one.get(key, "")) for key in ("location", "direction", "reference"))
    told = {"name": str(one["name"]), "quantity": None, "unit": str(one["unit_str"])}
    return {**told, "place": place, "direction": direction, "reference": reference, "values": numbers(data, what), "imaginary": imaginary}


def _times(series: Sequence[Mapping[str, Any]], sample_rate_hz: Any, time_s: Any) -> tuple[Floats, float | None]:
    """Returns the times of the samples, and their step where they are evenly spaced."""
    if sample_rate_hz is not None and time_s is not None:
        raise ArgumentError("sample_rate_hz and time_s are both given; give one of them")
    _check_clocks(series)
    first = series[0]
    own_rate, own_time = first.get("fs"), first.get("time")
    stamps = None if own_time is None else numbers(own_time, f"the times of {first['name']}")
    told = [(what, rate_hz(rate)) for what, rate in (("sample_rate_hz", sample_rate_hz), ("fs", own_rate)) if rate is not None]
    if stamps is not None and time_s is not None:
        return _one_axis(stamps, time_s, "time_s"), None
    if time_s is not None:
        stamps = numbers(time_s, "the times")
    _check_rates(first["name"], told, stamps)
    if stamps is not None and (not told or not _is_even(stamps, told[0][1])):
        return stamps, None
    step = 1.0 / (told[0][1] if told else rate_hz(None))
    start_s = float(stamps[0]) if stamps is not None and len(stamps) else 0.0
    places: Floats = start_s + step * np.arange(np.size(first["data"]), dtype=np.float64)
    return places, step


def _check_rates(name: Any, told: Sequence[tuple[str, float]], stamps: Floats | None) -> None:
    """Raises ArgumentError for rates that contradict each other or the times."""
    all_told = list(told)
    if stamps is not None and len(stamps) > 1:
        step = float(np.median(np.diff(stamps)))
        all_told += [("its times", 1.0 / step)] if step > 0.0 else []
    for what, rate in all_told[1:]:
        if abs(rate / all_told[0][1] - 1.0) > SAME_RATE:
            told_text = f"{all_told[0][0]} is {all_told[0][1]:g} Hz, but {what} give{'' if what == 'its times' else 's'} {rate:g} Hz"
            raise ArgumentError(f"{name}: {told_text}; give one of them", {"rates_hz": [all_told[0][1], rate]})


def _is_even(stamps: Floats, rate: float) -> bool:
    """True where the times agree with a rate within a thousandth of a step."""
    even = stamps[:1] + np.arange(len(stamps)) / rate
    return bool(np.all(np.abs(stamps - even) * rate <= SAME_RATE))


def _series(values: Any, units: str | Mapping[str, str] | None) -> list[Mapping[str, Any]]:
    """Returns every channel as a SEP005 time series; without ``fs`` and ``time`` where an array has none."""
    labelled = series_of(values)
    if labelled is not None:
        return [_with_unit(one, units) for one in labelled]
    # A time series without its data is reported as such; it is not a dict of arrays by name.
    if isinstance(values, Mapping) and ("data" in values or isinstance(values.get("unit_str"), str)):
        return [_with_unit(checked(values), units)]
    if isinstance(values, Mapping):
        if not values:
            raise ArgumentError("there is no channel; give at least one array")
        given = units or {}
        if isinstance(given, str):
            given = dict.fromkeys(values, given)
        unknown = [name for name in given if name not in values]
        if unknown:
            raise ArgumentError(f"units are given for {', '.join(map(str, unknown))}, but the channels are {', '.join(map(str, values))}")
        return [found for name, one in values.items() for found in _named(name, one, given.get(name, ""))]
    if isinstance(values, Sequence) and values and all(isinstance(one, Mapping) for one in values):
        return [_with_unit(checked(one), units) for one in values]
    if units is not None and not isinstance(units, str):
        raise ArgumentError('one array has one unit: give units="V"')
    return [_array("signal", values, units or "")]


def _named(name: Any, values: Any, unit: str) -> list[Mapping[str, Any]]:
    """Returns an array of a dict under its name there, with its own times and unit."""
    labelled = series_of(values)
    if labelled is None:
        return [_array(name, values, unit)]
    renamed = [{**one, "name": name} for one in labelled] if len(labelled) == 1 else labelled
    return [_with_unit(one, unit) for one in renamed]


def _with_unit(series: Mapping[str, Any], units: str | Mapping[str, str] | None) -> Mapping[str, Any]:
    """Returns a series with the given unit, which must equal its own unit if it has one."""
    unit = units if isinstance(units, str) else (units or {}).get(series["name"], "")
    own = str(series["unit_str"])
    if unit and own and unit != own:
        raise ArgumentError(f"{series['name']} is in {own}, but {unit} is given for it; give one of them", {"own": own, "given": unit})
    return {**series, "unit_str": agreed(series["name"], series["data"], unit or own)}


def _array(name: Any, values: Any, unit: str) -> Mapping[str, Any]:
    return {"name": name, "data": values, "unit_str": agreed(name, values, unit)}


def _check_clocks(series: Sequence[Mapping[str, Any]]) -> None:
    """Raises ArgumentError where channels of one recording have different sample times."""
    first = series[0]
    for one in series[1:]:
        same = one.get("fs") == first.get("fs")
        if same and one.get("fs") is None:
            same = np.array_equal(numbers(one.get("time", ()), "the times"), numbers(first.get("time", ()), "the times"))
        if not same:
            names = f"{one['name']} and {first['name']}"
            raise ArgumentError(f"{names} are not sampled at the same times; make a recording of each")
