"""Docstrings of the public objects, from the file that ``python/docstrings`` writes."""

from __future__ import annotations

import os
from functools import cache
from types import FunctionType
from typing import Any

#: Public objects by name, with their docstrings in the source.
IN_SOURCE: dict[str, tuple[Any, str | None]] = {}


@cache
def _docstrings() -> dict[str, str]:
    """Returns the docstrings by name; a method has the name of the class that defines it."""
    with open(os.path.join(os.path.dirname(__file__), "docstrings.txt"), encoding="utf-8") as file:
        text = file.read()
    blocks = (block.partition("\n") for block in f"\n{text.rstrip()}\n".split("\n==== ")[1:])
    return {name: docstring for name, _, docstring in blocks}


def document(public: Any) -> None:
    """Sets the docstring of a public function, or of a class and its methods."""
    if __doc__ is None:  # Python runs without docstrings.
        return
    bases = [base for base in getattr(public, "__mro__", ()) if base.__module__.startswith("jounce")]
    functions = (getattr(member, "__func__", member) for base in bases for member in vars(base).values())
    for one in (public, *(function for function in functions if isinstance(function, FunctionType))):
        name = getattr(one, "__qualname__", "")
        if name in _docstrings() and name not in IN_SOURCE:
            IN_SOURCE[name] = (one, one.__doc__)
            one.__doc__ = _docstrings()[name]
