"""Calls that make results: kept with a result, so that :func:`jounce.rerun` can make it again."""

from __future__ import annotations

import functools
import importlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

from ._errors import FileError
from ._spec_text import SpecText

P = ParamSpec("P")
R = TypeVar("R")

#: Keywords that change no number.
_WITHOUT_EFFECT = ("progress", "threads")


@dataclass(frozen=True)
class Call:
    """A function of the package, or a method, whose object is the first argument, with its arguments."""

    function: str
    is_method: bool
    arguments: list[Any]
    keywords: dict[str, Any]
    #: SHA-256 of the files among the arguments.
    files: dict[str, str]

    def __str__(self) -> str:
        is_ours = [type(value).__module__.startswith("jounce.") for value in self.arguments]
        given = [type(value).__name__ if ours else repr(value) for value, ours in zip(self.arguments, is_ours)]
        owner = f"{type(self.arguments[0]).__name__}." if self.is_method else ""
        return f"jounce.{owner}{self.function}({', '.join([*given, *(f'{name}={value!r}' for name, value in self.keywords.items())])})"

    def repeat(self) -> Any:
        """Calls again; raises FileError where a file has changed since."""
        from ._recording import digest_of

        for path, digest in self.files.items():
            if not Path(path).is_file():
                raise FileError(f"{path}: there is no such file; run in the folder of the call, which held it", {"path": path})
            if digest_of(path) != digest:
                raise FileError(f"{path}: the file has changed since the result was computed: its SHA-256 differs", {"path": path})
        if self.is_method:
            return getattr(self.arguments[0], self.function)(*self.arguments[1:], **self.keywords)
        return getattr(importlib.import_module("jounce"), self.function)(*self.arguments, **self.keywords)


def recorded(function: Callable[P, R]) -> Callable[P, R]:
    """Returns a function whose results keep their call. An argument that changes later does not change the call."""
    name, is_method = function.__name__, "." in function.__qualname__

    @functools.wraps(function)
    def call(*arguments: P.args, **keywords: P.kwargs) -> R:
        from ._recording import digest_of

        kept = [_kept(value) for value in arguments]
        named = {name: _kept(value) for name, value in keywords.items() if name not in _WITHOUT_EFFECT}
        files = {path: digest_of(path) for path in _files([*kept, *named.values()])}
        result = function(*arguments, **keywords)
        # The call is no field: it takes no part in comparisons.
        object.__setattr__(result, "_call", Call(name, is_method, kept, named, files))
        return result

    return call


def _kept(value: Any) -> Any:
    """Returns a copy of what can change."""
    if isinstance(value, SpecText):
        return value.copy()
    if type(value) is dict:
        return {key: _kept(one) for key, one in value.items()}
    if type(value) in (list, tuple):
        return type(value)(_kept(one) for one in value)
    return value


def _files(values: list[Any]) -> Iterator[str]:
    """Yields the paths of existing files among the values."""
    for value in values:
        if isinstance(value, (list, tuple)):
            yield from _files(list(value))
        elif isinstance(value, (str, PathLike)) and len(fspath(value)) < 4096 and Path(value).is_file():
            yield str(fspath(value))
