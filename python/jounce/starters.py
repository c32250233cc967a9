"""Commented specs to start from, and what a spec may hold."""

from __future__ import annotations

import json
from typing import Any

from . import _core
from .spec import Spec


def starters() -> dict[str, str]:
    """The kinds of harvester that there is a commented spec for, and what each is in one line."""
    return dict(_core.starters())


def new(kind: str) -> Spec:
    """The commented spec of a kind of harvester to start from, ``jounce.new("cantilever-with-stop")``.

    :func:`jounce.starters` lists the kinds. The numbers are plausible, not those of a device; ``spec.to_toml()`` tells what each key is.
    """
    return Spec(_core.starter(kind))


def keys() -> str:
    """The reference of all keys of a spec, in Markdown: what ``jounce keys`` prints."""
    return _core.keys()


def schema() -> dict[str, Any]:
    """The JSON Schema (draft-07) of a spec, for editors: what ``jounce schema`` prints."""
    found: dict[str, Any] = json.loads(_core.schema())
    return found
