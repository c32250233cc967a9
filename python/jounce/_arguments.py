"""Conversion of the arguments of calls on a spec for the compiled module."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from . import _core
from ._errors import ArgumentError, Fault, SpecError
from ._quantity import is_quantity, plain, toml
from ._ranges import naming, span, values_si

#: Largest value of a count or a seed.
MAX_INTEGER = 2**32 - 1


def options(**given: Any) -> str:
    """Returns options for the library, as JSON; those of ``None`` have their default."""
    for name, value in given.items():
        if isinstance(value, float) and not np.isfinite(value):
            raise ArgumentError(f"{name} is {value}; it must be a finite number", {"option": name, "value": str(value)})
    try:
        return json.dumps({name: value for name, value in given.items() if value is not None})
    except TypeError as error:
        raise ArgumentError(f"an option has the wrong type: {error}") from error


def spec_from_tables(tables: Mapping[str, Any]) -> _core.Spec:
    """Returns the spec of a dict of tables; its faults have no line and column."""
    with without_places():
        return _core.Spec(toml(tables), "")


@contextmanager
def without_places() -> Iterator[None]:
    """Removes line and column from faults of a text that the package wrote."""
    try:
        yield
    except SpecError as error:
        faults = [Fault(0, 0, fault.key, fault.message) for fault in error.faults]
        fault_dicts = [vars(fault) for fault in faults]
        raise SpecError("\n".join(map(str, faults)), {"faults": fault_dicts}) from None


def names(value: str | Sequence[str]) -> list[str]:
    """Returns a list of names; one name may be given alone."""
    return [value] if isinstance(value, str) else list(value)


def to_si(kind: str, value: Any, what: str) -> float:
    """Returns a quantity in SI units."""
    plain_value = plain(value, what)
    with naming(what):
        return _core.quantity_si(kind, plain_value if isinstance(plain_value, str) else repr(plain_value))


def optional_si(kind: str, value: Any, what: str) -> float | None:
    """Returns a quantity in SI units, or ``None`` where no quantity is given."""
    return None if value is None else to_si(kind, value, what)


def optional_range_si(kind: str, value: Any, what: str) -> tuple[float, float] | None:
    """Returns the two ends of a range in SI units, or ``None`` where no range is given."""
    if value is None:
        return None
    low, high = (to_si(kind, end, what) for end in span(value, None, what).split(":"))
    return low, high


#: Arguments that must be at least 1.
POSITIVE_ARGUMENTS = frozenset({"evaluations", "longest_period", "threads"})


def check_integers(**numbers: int | None) -> None:
    """Raises ArgumentError for counts out of range; a value that is not an integer is a TypeError of the call itself."""
    for least, names in ((1, POSITIVE_ARGUMENTS & numbers.keys()), (0, numbers.keys() - POSITIVE_ARGUMENTS)):
        values = {name: numbers[name] for name in numbers if name in names}
        invalid = {name: value for name, value in values.items() if isinstance(value, int) and not least <= value <= MAX_INTEGER}
        if invalid:
            message = ", ".join(f"{name} is {value}" for name, value in invalid.items())
            raise ArgumentError(
                f"{message}; give a whole number from {least} to {MAX_INTEGER}", {**invalid, "least": least, "most": MAX_INTEGER}
            )


def rate_hz(value: Any) -> float:
    """Returns a sampling rate, Hz, from a number or a frequency with its unit."""
    if value is None:
        raise ArgumentError("the samples have no times; give sample_rate_hz, in Hz")
    if is_quantity(value) or isinstance(value, str):
        rate = to_si("frequency", value, "the sample rate")
    else:
        try:
            rate = float(value)
        except (TypeError, ValueError) as error:
            raise ArgumentError(f"sample_rate_hz is {value!r}; it must be a number in Hz", {"given": repr(value)}) from error
    if not 0.0 < rate < np.inf:
        raise ArgumentError(f"sample_rate_hz is {value}; it must be above 0", {"sample_rate_hz": rate, "least": 0})
    return rate


def frequencies(value: Any, unit: Any) -> list[float] | None:
    """Returns the frequencies of a range, Hz, or ``None`` where none is given."""
    return None if value is None else values_si("frequency", value, unit, "frequency")


def optional_hz(value: Any, what: str) -> float | None:
    """Returns a frequency, Hz, or ``None`` where none is given."""
    return None if value is None else to_si("frequency", value, what)
