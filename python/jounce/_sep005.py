"""Time series in the form of SEP005: dicts of ``data``, ``name``, ``unit_str``, and ``fs`` or ``time``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ._errors import ArgumentError
from ._quantity import is_quantity
from ._result import Floats

#: A complete time series.
_EXAMPLE = 'as in {"data": values, "name": "base", "unit_str": "m/s^2", "fs": 1000.0}; an array alone is accepted too'


def check_series(series: Mapping[str, Any]) -> Mapping[str, Any]:
    """Returns the series; raises ArgumentError where a required key is missing."""
    missing = [key for key in ("data", "name", "unit_str") if key not in series]
    if missing:
        names = ", ".join(missing)
        raise ArgumentError(f"a SEP005 time series has data, name and unit_str; missing: {names}; {_EXAMPLE}", {"missing": missing})
    return series


def numbers(values: Any, what: str) -> Floats:
    """Returns real numbers along one axis, from read-only or strided arrays too."""
    if is_quantity(values):
        values = values.to_base_units().magnitude
    if np.iscomplexobj(values):
        raise ArgumentError(f"{what} are complex; a time series must be real")
    try:
        # Masked values are missing.
        row = np.ma.filled(values.astype(np.float64), np.nan) if np.ma.isMaskedArray(values) else np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ArgumentError(f"{what} are not numbers: {error}") from error
    if row.ndim != 1:
        raise ArgumentError(f"{what} have {row.ndim} axes; give one", {"axes": row.ndim})
    return row


def even_rate_hz(series: Mapping[str, Any]) -> float:
    """Returns the sampling rate of an evenly spaced series."""
    if "fs" in series:
        return float(series["fs"])
    steps = np.diff(numbers(series.get("time", ()), "the times"))
    if len(steps) == 0 or not np.allclose(steps, steps[0], rtol=1e-6):
        raise ArgumentError("a SEP005 time series needs its sample rate `fs`, or evenly spaced `time`", {"has": list(series)})
    return float(1.0 / steps.mean())
