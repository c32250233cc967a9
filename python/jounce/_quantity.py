"""Conversion of Python values to the text of a spec."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from . import _core
from ._errors import ArgumentError

_BARE = re.compile(r"[A-Za-z0-9_-]+\Z")


def is_quantity(value: Any) -> bool:
    """True for a number with a unit, as defined by pint."""
    return hasattr(value, "to_base_units") and hasattr(value, "magnitude")


def unit_of(value: Any) -> str:
    """Returns the SI unit of a quantity."""
    return format(value.to_base_units().units, "~C")


#: Gram, which is the acceleration of gravity in a key for accelerations.
_GRAM = re.compile(r"(?<![A-Za-z_])g(?![A-Za-z_])")


def _is_known(unit: str) -> bool:
    """True for a unit of pint that means the same to jounce."""
    return not unit or (_core.is_unit(unit) and not _GRAM.search(unit))


def given_unit(unit: Any) -> str:
    """Returns a unit of pint as text, in its own form if jounce knows it, else in SI."""
    text = format(unit, "~C")
    if _is_known(text):
        return text
    scale = (1.0 * unit).to_base_units()
    if scale.magnitude != 1.0:
        raise ArgumentError(f"{text}: jounce has no such unit; convert to {scale.units:~C}", {"unit": text})
    return format(scale.units, "~C")


def texts_of(value: Any, what: str) -> list[str]:
    """Returns each number of an array with a unit as text in this unit, ``["10.0 kHz", "11.0 kHz"]``; in SI if jounce has no such unit."""
    unit = format(value.units, "~C")
    if not _is_known(unit):
        value, unit = value.to_base_units(), unit_of(value)
    numbers = np.atleast_1d(_array(value.magnitude, what)).astype(float)
    if numbers.ndim != 1:
        raise ArgumentError(f"{what} has {numbers.ndim} axes; give one number or a list of numbers", {"axes": int(numbers.ndim)})
    return [f"{number!r} {unit}".strip() for number in numbers.tolist()]


def _array(values: Any, what: str) -> Any:
    """Returns any array as one of numpy; raises ArgumentError for masked values, dates and complex numbers."""
    if np.ma.is_masked(values):
        place = int(np.flatnonzero(np.ma.getmaskarray(values))[0])
        raise ArgumentError(f"{what}: value {place} is masked; give every value", {"masked": place})
    array = np.asarray(values)
    if array.dtype.kind not in "biufOU":
        raise ArgumentError(f"{what} is an array of {array.dtype}; give numbers or text with a unit", {"type": str(array.dtype)})
    return array


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
    if hasattr(value, "__array__"):
        inner = getattr(value, "data", None)
        if is_quantity(inner):
            return plain(inner, what)
        return plain(_array(value, what).tolist(), what)
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


def settings(keys: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Returns keys with their values as they are written after ``key=`` on a command line; nothing for ``None``, which removes the key."""
    return [(name(key, "spec"), "" if value is None else _setting(value, str(key))) for key, value in keys.items()]


def _setting(value: Any, key: str) -> str:
    plain_value = plain(value, key)
    is_text = isinstance(plain_value, str) and plain_value.strip() != ""
    return str(plain_value) if is_text else _value(plain_value)


def toml(tables: Mapping[str, Any]) -> str:
    """Returns a spec as TOML."""
    lines: list[str] = []
    _table(plain(tables, "spec"), "", lines)
    return "\n".join(lines).strip() + "\n"


def inline_toml(table: Mapping[str, Any]) -> str:
    """Returns a table in one line of TOML."""
    return _value(plain(table, "spec"))


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
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(key)} = {_value(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    return repr(value)
