"""Commented templates of specs, and the reference of keys."""

from __future__ import annotations

import json
from typing import Any

from . import _core
from ._spec import Spec


def starters() -> dict[str, str]:
    """Returns the kinds of harvester with a commented template, with a summary of each in one line."""
    return dict(_core.starters())


def new(kind: str) -> Spec:
    """Returns the commented template of a kind of harvester, ``jounce.new("cantilever-with-stop")``.

    :func:`jounce.starters` lists the kinds. The numbers are plausible, but not those of a device; ``spec.to_toml()`` explains each key.
    """
    return Spec(_core.starter(kind))


def keys() -> str:
    """Returns the reference of all keys of a spec, in Markdown, as printed by ``jounce keys``."""
    return _core.keys()


def schema() -> dict[str, Any]:
    """Returns the JSON Schema (draft-07) of a spec, for editors, as printed by ``jounce schema``."""
    contents: dict[str, Any] = json.loads(_core.schema())
    return contents
