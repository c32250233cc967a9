"""Conversion of the arguments of calls on a spec for the compiled module."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from . import _core
from .errors import ArgumentError, Fault, SpecError
from .quantity import is_quantity, plain, texts_of, toml
from .result import Floats

#: Largest value of a count or a seed.
MOST_WHOLE = 2**32 - 1


def options(**given: Any) -> str:
    """Returns options for the library, as JSON; those of ``None`` have their default."""
    for name, value in given.items():
        if isinstance(value, float) and not np.isfinite(value):
            raise ArgumentError(f"{name} is {value}; it must be a finite number", {"option": name, "value": str(value)})
    try:
        return json.dumps({name: value for name, value in given.items() if value is not None})
    except TypeError as error:
        raise ArgumentError(f"an option has the wrong type: {error}") from error


def of_tables(tables: Mapping[str, Any]) -> _core.Spec:
    """Returns the spec of a dict of tables; its faults have no line and column."""
    try:
        return _core.Spec(toml(tables), "")
    except SpecError as error:
        faults = [Fault(0, 0, fault.key, fault.message) for fault in error.faults]
        listed = [vars(fault) for fault in faults]
        raise SpecError("\n".join(map(str, faults)), {"faults": listed}) from None


def names(hold: str | Sequence[str]) -> list[str]:
    """Returns a list of names; one name may be given alone."""
    return [hold] if isinstance(hold, str) else list(hold)


def si(kind: str, value: Any, what: str) -> float:
    """Returns a quantity in SI units."""
    made = plain(value, what)
    return _core.quantity_si(kind, made if isinstance(made, str) else repr(made))


def optional_si(kind: str, value: Any, what: str) -> float | None:
    """Returns a positive quantity in SI units, or ``None`` where no quantity is given."""
    if value is None:
        return None
    found = si(kind, value, what)
    if not 0.0 < found < np.inf:
        raise ArgumentError(f"{what} is {value}; it must be above 0", {"given": str(value), "least": 0})
    return found


def positive_si(kind: str, value: Any, what: str) -> float:
    """Returns a positive quantity in SI units."""
    found = optional_si(kind, value, what)
    if found is None:
        raise ArgumentError(f"{what} is missing")
    return found


#: Arguments that must be at least 1.
COUNTED_FROM_ONE = frozenset({"longest_period"})


def check_wholes(**numbers: int | None) -> None:
    """Raises ArgumentError for counts out of range; a value that is not an integer is a TypeError of the call itself."""
    for least, names in ((1, COUNTED_FROM_ONE & numbers.keys()), (0, numbers.keys() - COUNTED_FROM_ONE)):
        given = {name: numbers[name] for name in numbers if name in names}
        wrong = {name: value for name, value in given.items() if isinstance(value, int) and not least <= value <= MOST_WHOLE}
        if wrong:
            told = ", ".join(f"{name} is {value}" for name, value in wrong.items())
            raise ArgumentError(f"{told}; give a whole number from {least} to {MOST_WHOLE}", {**wrong, "least": least, "most": MOST_WHOLE})


def rate_hz(given: Any) -> float:
    """Returns a sampling rate, Hz, from a number or a frequency with its unit."""
    if given is None:
        raise ArgumentError("expected the sampling rate, in Hz")
    if is_quantity(given) or isinstance(given, str):
        return positive_si("frequency", given, "the sample rate")
    try:
        found = float(given)
    except (TypeError, ValueError) as error:
        raise ArgumentError(f"sample_rate_hz is {given!r}; it must be a number in Hz", {"given": repr(given)}) from error
    if not 0.0 < found < np.inf:
        raise ArgumentError(f"sample_rate_hz is {given}; it must be above 0", {"sample_rate_hz": found, "least": 0})
    return found


def frequencies(given: Any) -> Floats:
    """Frequencies, Hz."""
    if given is None:
        return np.geomspace(1.0, 1000.0, 2000)
    texts = texts_of(given, "frequency") if is_quantity(given) else plain(given, "frequency")
    items = texts if isinstance(texts, list) else [texts]
    if not items:
        raise ArgumentError("frequency is an empty list; give at least one frequency")
    found = np.array([si("frequency", item, "frequency") for item in items])
    if not (np.isfinite(found).all() and (found > 0.0).all()):
        wrong = float(found[~(np.isfinite(found) & (found > 0.0))][0])
        raise ArgumentError(f"a frequency is {wrong} Hz; every one must be above 0 Hz and finite", {"frequency_hz": wrong, "least_hz": 0})
    return found
