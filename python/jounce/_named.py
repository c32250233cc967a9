"""Mappings of names to values: how they are looked up, and what an unknown name raises."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeVar

from ._errors import UnknownKeyError

Value = TypeVar("Value")


class Named(Mapping[str, Value]):
    """Values by name, the entries of :meth:`_named`."""

    #: What a name stands for, in messages.
    _noun = "entry"

    def _named(self) -> Mapping[str, Value]:
        raise NotImplementedError

    def __getitem__(self, name: str) -> Value:
        return look_up(self._named(), name, self._noun)

    def __iter__(self) -> Iterator[str]:
        return iter(self._named())

    def __len__(self) -> int:
        return len(self._named())

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)


def look_up(named: Mapping[str, Value], name: str, noun: str) -> Value:
    """Returns the value of a name; raises UnknownKeyError with the known names."""
    if name in named:
        return named[name]
    known = list(named)
    nearest = nearest_name(str(name), known)
    message = f"{name}: no such {noun}; use one of {', '.join(known)}" if known else f"{name}: there is no {noun}"
    raise UnknownKeyError(message, {"wanted": name, "nearest": nearest, "known": known})


def nearest_name(name: str, known: Sequence[str]) -> str | None:
    """Returns the known name that is most similar, if one is."""
    from difflib import get_close_matches

    return next(iter(get_close_matches(name, known, 1)), None)
