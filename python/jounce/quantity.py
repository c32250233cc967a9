"""Conversion of Python values to the text of a spec."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .errors import ArgumentError

_BARE = re.compile(r"[A-Za-z0-9_-]+\Z")


def is_quantity(value: Any) -> bool:
    """True for a number with a unit, as defined by pint."""
    return hasattr(value, "to_base_units") and hasattr(value, "magnitude")


def unit_of(value: Any) -> str:
    """Returns the SI unit of a quantity."""
    return format(value.to_base_units().units, "~C")


def texts_of(value: Any, what: str) -> list[str]:
    """Returns each number of an array with a unit as text, ``["10.0 1/s", "11.0 1/s"]``."""
    base, unit = value.to_base_units(), unit_of(value)
    numbers = np.atleast_1d(np.asarray(base.magnitude, dtype=float))
    if numbers.ndim != 1:
        raise ArgumentError(f"{what} has {numbers.ndim} axes; give one number or a list of numbers", {"axes": int(numbers.ndim)})
    return [f"{number!r} {unit}".strip() for number in numbers.tolist()]


def plain(value: Any, what: str) -> Any:
    """Returns a value as text, number, bool, list or dict of those; a quantity with a unit becomes text in SI units."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, (str, bool, int, float)):
        return value
    if is_quantity(value):
        texts = texts_of(value, what)
        text_or_texts = texts[0] if np.ndim(value.magnitude) == 0 else texts
        # A pure number has no unit, as a key without unit expects.
        return float(text_or_texts) if isinstance(text_or_texts, str) and " " not in text_or_texts else text_or_texts
    if isinstance(value, Mapping):
        return {name(key, what): plain(item, f"{what}.{key}") for key, item in value.items()}
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray, memoryview)):
        return [plain(item, what) for item in value]
    kind = type(value).__name__
    raise ArgumentError(
        f'{what} is of type {kind}; give text with a unit, as in "0.5 mm", a number, a list or a quantity with a unit', {"type": kind}
    )


def name(key: Any, what: str) -> str:
    """Returns the name of an element."""
    if not isinstance(key, str):
        raise ArgumentError(f"{what}: {key!r} is not a name; names must be text", {"given": repr(key)})
    return key


def setting(value: Any, key: str) -> str:
    """Returns a value as it is written after ``key =`` on a command line."""
    plain_value = plain(value, key)
    if isinstance(plain_value, dict):
        raise ArgumentError(f"{key} is a table; set its keys one by one, or make a spec of a dict")
    return plain_value if isinstance(plain_value, str) else _value(plain_value)


def toml(tables: Mapping[str, Any]) -> str:
    """Returns a spec as TOML."""
    lines: list[str] = []
    _table(plain(tables, "spec"), "", lines)
    return "\n".join(lines).strip() + "\n"


def _table(table: dict[str, Any], path: str, lines: list[str]) -> None:
    entries = {key: value for key, value in table.items() if not isinstance(value, dict)}
    if path and (entries or not table):
        lines += ["", f"[{path}]"]
    lines += [f"{_key(key)} = {_value(value)}" for key, value in entries.items()]
    for key, value in table.items():
        if isinstance(value, dict):
            _table(value, f"{path}.{_key(key)}" if path else _key(key), lines)


def _key(key: str) -> str:
    return key if _BARE.match(key) else json.dumps(key)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, list):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    return repr(value)


def span(value: Any, key: str) -> tuple[str, str]:
    """Returns the two ends of a range: ``"12 Hz:13 Hz"``, or two quantities."""
    plain_value = plain(value, key)
    ends = plain_value.split(":") if isinstance(plain_value, str) else plain_value
    if not isinstance(ends, list) or len(ends) != 2 or any(isinstance(end, (dict, list)) for end in ends):
        raise ArgumentError(
            f'{key}: {value!r} is not a range; give "FROM:TO", as in "4 Hz:20 Hz", or a pair of quantities', {"given": repr(value)}
        )
    low, high = (str(end) for end in ends)
    return low, high


#: Unit of each side of a grid of starts.
_SIDES = {"displacement": "m", "velocity": "m/s", "voltage": "V"}


def sides(grid: Mapping[str, Any] | None) -> list[str]:
    """Returns the sides of a grid of starts as texts, ``["displacement=-5 mm:5 mm:21x"]``."""
    if grid is None:
        return []
    if not isinstance(grid, Mapping) or not grid:
        raise ArgumentError(f'grid is {grid!r}; give a dict of sides, as in {{"displacement": "-5 mm:5 mm:21x"}}', {"given": repr(grid)})
    return [f"{side}={_side(side, range)}" for side, range in grid.items()]


def _side(side: Any, range: Any) -> str:
    if isinstance(range, str):
        return range
    if not isinstance(range, Sequence) or len(range) != 3:
        raise ArgumentError(
            f'grid, {side}: {range!r} is not a side; give "FROM:TO:Nx", or a tuple of two quantities and a number',
            {"side": side, "given": repr(range)},
        )
    if side not in _SIDES:
        raise ArgumentError(f"grid, {side}: no such side; use one of {', '.join(_SIDES)}")
    low, high = (f"{end.to(_SIDES[side]).magnitude!r} {_SIDES[side]}" if is_quantity(end) else str(end) for end in range[:2])
    return f"{low}:{high}:{range[2]}x"


def values(value: Any, unit: str | None, key: str) -> str:
    """Returns the values of a sweep as one text: a range, or a list of quantities, or numbers in ``unit``."""
    plain_value = plain(value, key)
    if isinstance(plain_value, str):
        return plain_value
    items = plain_value if isinstance(plain_value, list) else [plain_value]
    if not items:
        raise ArgumentError(f"{key}: the list of values is empty; give at least one")
    if any(isinstance(item, (dict, list)) for item in items):
        raise ArgumentError(f"{key}: the values of a sweep must be one list without nested lists")
    return ",".join(str(item) if unit is None or isinstance(item, str) else f"{item!r} {unit}" for item in items)
