"""What the functions on recordings take: recordings, files, SEP005 time series and arrays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

import numpy as np

from .arguments import rate_hz
from .errors import ArgumentError
from .quantity import is_quantity, unit_of
from .recorded_file import RecordedFile, read_recordings
from .recording import Recording
from .result import Floats
from .sep005 import checked, numbers

#: A recording, a file, a SEP005 time series or a list of those over one time, or an array with its sample rate.
Measured = Any


def recording(given: Measured, sample_rate_hz: Any = None) -> Recording:
    """One recording over time."""
    if isinstance(given, (str, PathLike)):
        given = read_recordings(given)
    if isinstance(given, RecordedFile):
        return given.over_time
    return given if isinstance(given, Recording) else Recording.of(given, sample_rate_hz)


def recordings(given: Measured, sample_rate_hz: Any = None) -> list[Recording]:
    """One recording or several in a list; a list of SEP005 time series, or of numbers, is one."""
    if isinstance(given, (list, tuple)) and not given:
        raise ArgumentError("there is no recording; give at least one")
    kinds = (Recording, RecordedFile, str, PathLike, list, np.ndarray)
    several = isinstance(given, (list, tuple)) and any(isinstance(one, kinds) for one in given)
    return [recording(one, sample_rate_hz) for one in given] if several else [recording(given, sample_rate_hz)]


def responses(given: Measured, sample_rate_hz: Any = None) -> list[Recording]:
    """Recordings of a hammer test; of one file that holds nothing but responses over frequency, all of them."""
    found = read_recordings(given) if isinstance(given, (str, PathLike)) else given
    if isinstance(found, RecordedFile) and found.recordings and all(one.over == "frequency" for one in found):
        return found.recordings
    return recordings(found, sample_rate_hz)


def of_arrays(values: Any, grid: Mapping[str, Any], units: str | Mapping[str, str] | None, name: str) -> dict[str, Any]:
    """Arrays with their units over a grid, as the compiled module takes a recording."""
    series = _series(values, units)
    over = "time" if grid["frequency_hz"] is None else "frequency"
    if over == "frequency" and not all(grid[other] is None for other in ("sample_rate_hz", "time_s")):
        raise ArgumentError("frequency_hz is given beside times; a recording is over one of them")
    if over == "frequency":
        places, step = numbers(grid["frequency_hz"], "the frequencies"), None
    else:
        places, step = _times(series, grid["sample_rate_hz"], grid["time_s"])
    return {"name": name, "over": over, "places": places, "step": step, "channels": [_channel(one, over) for one in series]}


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
    """Times of the samples, and their distance where they are even."""
    first = series[0]
    start_s = 0.0
    if sample_rate_hz is None and time_s is None:
        _check_clocks(series)
        sample_rate_hz, time_s = first.get("fs"), first.get("time")
        if sample_rate_hz is not None and time_s is not None:
            stamps, time_s = numbers(time_s, "the times"), None
            start_s = float(stamps[0]) if len(stamps) else 0.0
    if time_s is not None and sample_rate_hz is None:
        return numbers(time_s, "the times"), None
    if time_s is not None:
        raise ArgumentError("sample_rate_hz and time_s are both given; give one of them")
    step = 1.0 / rate_hz(sample_rate_hz)
    places: Floats = start_s + step * np.arange(np.size(first["data"]), dtype=np.float64)
    return places, step


def _series(values: Any, units: str | Mapping[str, str] | None) -> list[Mapping[str, Any]]:
    """Every channel as a SEP005 time series; without ``fs`` and ``time`` where an array has none."""
    # A time series without its data is told so: it is no dict of arrays by their names.
    if isinstance(values, Mapping) and ("data" in values or isinstance(values.get("unit_str"), str)):
        return [checked(values)]
    if isinstance(values, Mapping):
        if not values:
            raise ArgumentError("there is no channel; give at least one array")
        given = units or {}
        if isinstance(given, str):
            given = dict.fromkeys(values, given)
        unknown = [name for name in given if name not in values]
        if unknown:
            raise ArgumentError(f"units are given for {', '.join(map(str, unknown))}, but the channels are {', '.join(map(str, values))}")
        return [_array(name, one, given.get(name, "")) for name, one in values.items()]
    if isinstance(values, Sequence) and values and all(isinstance(one, Mapping) for one in values):
        return [checked(one) for one in values]
    if units is not None and not isinstance(units, str):
        raise ArgumentError('one array has one unit: give units="V"')
    return [_array("signal", values, units or "")]


def _array(name: Any, values: Any, unit: str) -> Mapping[str, Any]:
    own = unit_of(values) if is_quantity(values) else unit
    return {"name": name, "data": values, "unit_str": own}


def _check_clocks(series: Sequence[Mapping[str, Any]]) -> None:
    """Channels of one recording are sampled at the same times."""
    first = series[0]
    for one in series[1:]:
        same = one.get("fs") == first.get("fs")
        if same and one.get("fs") is None:
            same = np.array_equal(numbers(one.get("time", ()), "the times"), numbers(first.get("time", ()), "the times"))
        if not same:
            names = f"{one['name']} and {first['name']}"
            raise ArgumentError(f"{names} are not sampled at the same times; make a recording of each")
