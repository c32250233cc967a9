"""Docstrings of the public objects, from the file that ``python/docstrings`` writes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

#: Public objects by name, with their docstrings in the source.
IN_SOURCE: dict[str, tuple[Any, str | None]] = {}


def apply(public: Mapping[str, Any]) -> None:
    """Sets the docstrings of the public objects."""
    if __doc__ is None:  # Python runs without docstrings.
        return
    text = Path(__file__).with_name("docstrings.txt").read_text(encoding="utf-8")
    for block in f"\n{text}".split("\n==== ")[1:]:
        name, _, docstring = block.partition("\n")
        owner, _, method = name.partition(".")
        member = getattr(public.get(owner), method, None) if method else public.get(owner)
        if member is not None:
            member = getattr(member, "__func__", member)
            IN_SOURCE[name] = (member, member.__doc__)
            member.__doc__ = docstring
