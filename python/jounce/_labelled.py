"""Labelled arrays with names, units and times: xarray, pandas, histories. Each becomes time series in the form of SEP005."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import product
from typing import Any

import numpy as np

from ._errors import ArgumentError
from ._quantity import is_quantity, unit_of
from ._result import Floats

#: Lower-case names of a coordinate, an index or a column that holds times or frequencies.
_TIMES = ("time", "t", "time_s", "times", "seconds", "timestamp", "cycle_time")
_FREQUENCIES = ("frequency", "f", "freq", "frequency_hz", "frequencies")
#: Seconds and hertz in the units of coordinates.
_TO_SI = {"s": 1.0, "sec": 1.0, "second": 1.0, "seconds": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60.0, "h": 3600.0}
_TO_SI |= {"hz": 1.0, "khz": 1e3, "mhz": 1e6}


def series_of(values: Any) -> list[Mapping[str, Any]] | None:
    """Returns the channels of labelled arrays; ``None`` for unlabelled values. Frequencies are under ``frequency``."""
    if hasattr(values, "to_sep005"):
        return list(values.to_sep005())
    kind = f"{type(values).__module__.partition('.')[0]}.{type(values).__name__}"
    if kind == "xarray.DataArray":
        return list(_array_channels(values.name or "signal", values))
    if kind == "xarray.Dataset":
        return _dataset_channels(values)
    if kind == "pandas.Series":
        return [_column_channel(str(values.name or "signal"), values, _text(values.attrs.get("units")), _index_axis(values.index))]
    if kind == "pandas.DataFrame":
        return _frame_channels(values)
    return None


def _dataset_channels(dataset: Any) -> list[Mapping[str, Any]]:
    """Returns the variables of a dataset along time, or along frequency where no variable is along time."""
    along = [name for name in dataset.dims if str(name).lower() in _TIMES[:-1]]
    along = along or [name for name in dataset.dims if _axis(name, dataset) is not None] or list(dataset.dims)[:1]
    variables = {str(name): one for name, one in dataset.data_vars.items() if along and along[0] in one.dims and one.dtype.kind in "biufc"}
    channels: list[Mapping[str, Any]] = []
    for name, one in variables.items():
        stem, suffix = name[:-3], name[-3:]
        if suffix == "_im" and f"{stem}_re" in variables:
            continue
        if suffix == "_re" and f"{stem}_im" in variables:
            one = (one + 1j * variables[f"{stem}_im"]).assign_attrs(one.attrs)
            name = stem
        channels += _array_channels(name, one, along[0])
    if not channels:
        raise ArgumentError(f"the dataset has no variable over time or frequency, only {', '.join(map(str, dataset.variables))}")
    return channels


def _array_channels(name: Any, array: Any, axis_dim: Any = None) -> Iterator[Mapping[str, Any]]:
    """Yields a channel for each place along the other dimensions, ``tip.voltage``."""
    if axis_dim is None:
        axis_dims = [dim for dim in array.dims if _axis(dim, array) is not None]
        axis_dim = (axis_dims or list(array.dims) or [None])[0]
    others = [dim for dim in array.dims if dim != axis_dim]
    axis_values = _axis_values(axis_dim, array.coords[axis_dim]) if axis_dim in array.coords else {}
    for index in product(*(range(array.sizes[dim]) for dim in others)):
        selection = dict(zip(others, index))
        labels = [str(array.coords[dim].values[k]) if dim in array.coords else str(k + 1) for dim, k in selection.items()]
        yield {
            "name": ".".join([*labels, str(name)]),
            "data": array.isel(selection).data,
            "unit_str": _text(array.attrs.get("units")),
            **axis_values,
        }


def _axis(dim: Any, array: Any) -> str | None:
    """Returns ``"time"`` or ``"frequency"`` where the name or the unit of a dimension shows it."""
    lower_name = str(dim).lower()
    unit = _text(array.coords[dim].attrs.get("units")).lower() if dim in array.coords else ""
    if lower_name in _FREQUENCIES or unit.endswith("hz"):
        return "frequency"
    return "time" if lower_name in _TIMES or unit in _TO_SI else None


def _axis_values(name: Any, coordinate: Any) -> dict[str, Floats]:
    """Returns the times in s, or the frequencies in Hz, of a coordinate."""
    unit = _text(coordinate.attrs.get("units"))
    axis = "frequency" if str(name).lower() in _FREQUENCIES or unit.lower().endswith("hz") else "time"
    return {axis: _stamps_si(coordinate.data, unit, str(name))}


def _stamps_si(values: Any, unit: str, name: str) -> Floats:
    """Returns stamps as numbers in s or Hz; dates and times of day count from the first one."""
    if is_quantity(values):
        values, unit = values.to_base_units().magnitude, ""
    values = np.asarray(values)
    if values.dtype.kind in "mM":
        elapsed_s: Floats = (values - values[:1]) / np.timedelta64(1, "ns") * 1e-9
        return elapsed_s
    factor = _TO_SI.get(unit.lower(), 1.0 if not unit else None)
    if factor is None:
        raise ArgumentError(f'{name} is in {unit}, which is not a unit of time or frequency; use "s" or "Hz"', {"units": unit})
    values_si: Floats = values.astype(np.float64) * factor
    return values_si


def _frame_channels(frame: Any) -> list[Mapping[str, Any]]:
    """Returns a channel for each column of numbers, over the column or the index of times or frequencies."""
    units = frame.attrs.get("units") or {}
    if not isinstance(units, Mapping):
        raise ArgumentError('units of a DataFrame must be a dict by column: frame.attrs["units"] = {"tip": "mV"}', {"units": str(units)})
    axis = next((name for name in frame.columns if str(name).lower() in (*_TIMES, *_FREQUENCIES)), None)
    if axis is None:
        axis_values = _index_axis(frame.index)
    else:
        kind = "frequency" if str(axis).lower() in _FREQUENCIES else "time"
        axis_values = {kind: _stamps_si(frame[axis].to_numpy(), _text(units.get(axis)), str(axis))}
    columns = [name for name in frame.columns if name != axis and frame[name].dtype.kind in "biufc"]
    if not columns:
        raise ArgumentError("the DataFrame has no column of numbers except its times")
    return [_column_channel(str(name), frame[name], _text(units.get(name)), axis_values) for name in columns]


def _column_channel(name: str, column: Any, unit: str, axis_values: Mapping[str, Floats]) -> Mapping[str, Any]:
    return {"name": name, "data": column.to_numpy(), "unit_str": unit, **axis_values}


def _index_axis(index: Any) -> dict[str, Floats]:
    """Returns the times of an index; empty where it only numbers the rows."""
    values = index.to_numpy()
    lower_name = str(index.name or "").lower()
    if values.dtype.kind in "mM" or lower_name in _TIMES:
        return {"time": _stamps_si(values, "", lower_name)}
    if lower_name in _FREQUENCIES:
        return {"frequency": _stamps_si(values, "", lower_name)}
    if values.dtype.kind == "f":
        raise ArgumentError('the index of numbers has no name; call it "time" (s) or "frequency" (Hz), or reset it')
    return {}


def _text(unit: Any) -> str:
    return "" if unit is None or unit == "dimensionless" else str(unit)


def agreed_unit(name: Any, values: Any, unit: str) -> str:
    """Returns the unit of values, which may have one and may be given one; both must be equal."""
    if not is_quantity(values):
        return unit
    value_unit = values.units
    is_same_unit = not unit
    if unit:
        try:
            is_same_unit = values._REGISTRY.Unit(unit) == value_unit
        except Exception:  # A unit of instruments that pint does not define, such as m/s2 or "g" for 9.80665 m/s^2.
            is_same_unit = unit == format(value_unit, "~C")
    if not is_same_unit:
        raise ArgumentError(
            f"{name} is in {value_unit:~}, but {unit} is given for it; give one of them", {"own": f"{value_unit:~}", "given": unit}
        )
    return unit_of(values)
