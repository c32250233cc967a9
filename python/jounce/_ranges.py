"""Ranges of keys and options, with one grammar for all calls.

A range is text, ``"10 Hz:14 Hz:0.5 Hz"`` (step), ``"10 Hz:14 Hz:9x"`` (number), ``"1 kohm:1 Mohm:9log"``, ``"1 mm,2 mm"``, or a list or an
array of quantities, or of numbers with their ``unit``. Arrays of numpy, pandas, xarray and pint are accepted; their own unit counts. A
continuous range has two ends, ``"12 Hz:13 Hz"`` or a pair.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np

from . import _core
from ._errors import ArgumentError, SpecError
from ._quantity import given_unit, plain

#: Sides of a grid of starts.
_SIDES = ("displacement", "velocity", "voltage")


def unit_text(unit: Any) -> str | None:
    """Returns a unit as text, from text or a unit of pint."""
    if unit is None or isinstance(unit, str):
        return unit
    if hasattr(unit, "dimensionality"):
        return given_unit(unit)
    raise ArgumentError(f'unit is of type {type(unit).__name__}; give text, as in "Hz", or a unit of pint', {"type": type(unit).__name__})


def texts(value: Any, unit: Any, what: str) -> str | list[str]:
    """Returns a range as it is written: its text, or the text of each of its values."""
    own, unit = getattr(value, "attrs", {}).get("units") or None, unit_text(unit)
    if own is not None and unit is not None and own != unit:
        raise ArgumentError(f"{what} is in {own}, but {unit} is given for it; give one of them", {"own": own, "given": unit})
    plain_value, unit = plain(value, what), own or unit
    if isinstance(plain_value, str):
        separator = ":" if ":" in plain_value else ","
        return separator.join(_with_unit(part, unit) for part in plain_value.split(separator))
    items = plain_value if isinstance(plain_value, list) else [plain_value]
    if any(isinstance(item, (dict, list)) for item in items):
        raise ArgumentError(f"{what}: the values must be one list without nested lists")
    return [_with_unit(item if isinstance(item, str) else repr(item), unit) for item in items]


def _with_unit(text: str, unit: str | None) -> str:
    """Returns a number with the unit; a text that has a unit is unchanged."""
    if not unit:
        return text
    try:
        float(text)
    except ValueError:
        return text
    return f"{text.strip()} {unit}"


def values(value: Any, unit: Any, key: str) -> str:
    """Returns the values of a key as one text."""
    range_texts = texts(value, unit, key)
    if not range_texts:
        raise ArgumentError(f"{key}: the list of values is empty; give at least one")
    return range_texts if isinstance(range_texts, str) else ",".join(range_texts)


def span(value: Any, unit: Any, key: str) -> str:
    """Returns a continuous range as text, ``"12 Hz:13 Hz"``."""
    range_texts = texts(value, unit, key)
    ends = range_texts.split(":") if isinstance(range_texts, str) else range_texts
    if len(ends) != 2:
        raise ArgumentError(
            f'{key}: {value!r} is not a continuous range; give "FROM:TO", as in "4 Hz:20 Hz", or a pair of quantities',
            {"given": repr(value)},
        )
    return ":".join(ends)


def values_si(kind: str, value: Any, unit: Any, what: str) -> list[float]:
    """Returns the values of a range of quantities of one kind, SI."""
    with naming(what):
        return _core.quantities_si(kind, values(value, unit, what))


@contextmanager
def naming(what: str) -> Iterator[None]:
    """Names the argument in an ArgumentError about its value."""
    try:
        yield
    except ArgumentError as error:
        raise ArgumentError(f"{what}: {error}", error.details) from None


@contextmanager
def naming_unit(argument: str) -> Iterator[None]:
    """Names the argument that gives numbers their unit, in an error about numbers without one; ``{}`` in it stands for a unit that fits."""
    try:
        yield
    except (ArgumentError, SpecError) as error:
        fits = re.search(r"has no unit; expected .*? in ([^,;\n]+)", str(error))
        if fits is None:
            raise
        remedy = argument.replace("{}", fits[1])
        raise type(error)(f"{error}; or give {remedy} for numbers", error.details) from None


def check_units(units: Mapping[str, Any] | None, keys: Iterable[str], noun: str) -> None:
    """Raises ArgumentError for units of what is not given."""
    unknown = [key for key in units or {} if key not in keys]
    if unknown:
        raise ArgumentError(f"units: there is no {noun} {', '.join(map(str, unknown))}; there are {', '.join(map(str, keys))}")


def sides(grid: Mapping[str, Any] | None, units: Mapping[str, Any] | None) -> list[str]:
    """Returns the sides of a grid of starts as texts, ``["displacement=-5 mm:5 mm:21x"]``."""
    if grid is None:
        return []
    if not isinstance(grid, Mapping) or not grid:
        raise ArgumentError(f'grid is {grid!r}; give a dict of sides, as in {{"displacement": "-5 mm:5 mm:21x"}}', {"given": repr(grid)})
    check_units(units, grid, "side")
    return [f"{side}={_side(side, range, (units or {}).get(side))}" for side, range in grid.items()]


def _side(side: Any, range: Any, unit: Any) -> str:
    """Returns a side as ``FROM:TO:Nx``; it may also be two ends and a number, or evenly spaced values."""
    if side not in _SIDES:
        raise ArgumentError(f"grid, {side}: no such side; use one of {', '.join(_SIDES)}")
    if isinstance(range, tuple) and len(range) == 3 and isinstance(range[2], int):
        return f"{span(range[:2], unit, side)}:{range[2]}x"
    range_texts = texts(range, unit, f"grid, {side}")
    if isinstance(range_texts, str):
        return range_texts
    pairs = [text.partition(" ") for text in range_texts]
    try:
        steps = np.diff([float(number) for number, _, _ in pairs])
    except ValueError:
        steps = np.array([])
    is_even = len(steps) > 1 and np.allclose(steps, steps[0], rtol=1e-9) and len({end for _, _, end in pairs}) == 1
    if not is_even:
        raise ArgumentError(
            f'grid, {side}: {range!r} is not a side; give "FROM:TO:Nx", two ends and a number, or evenly spaced values in one unit',
            {"side": side, "given": repr(range)},
        )
    return f"{range_texts[0]}:{range_texts[-1]}:{len(pairs)}x"
