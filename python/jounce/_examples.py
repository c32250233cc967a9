"""Specs of the examples, included in jounce."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from . import _core
from ._named import look_up
from ._spec import Spec


class Examples(Mapping[str, Spec]):
    """Specs by name: the name of the system for its ``harvester.toml``, ``SYSTEM/FILE`` for others, as in ``random-base/ball``."""

    def __init__(self) -> None:
        named_texts = ((system if file == "harvester" else f"{system}/{file}", text) for system, file, text in _core.examples())
        self._texts = dict(named_texts)

    def __getitem__(self, name: str) -> Spec:
        return Spec(look_up(self._texts, name, "example"))

    def __iter__(self) -> Iterator[str]:
        return iter(self._texts)

    def __len__(self) -> int:
        return len(self._texts)

    def __contains__(self, name: object) -> bool:
        return name in self._texts

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def __repr__(self) -> str:
        return f"<jounce.examples: {', '.join(self._texts)}>"


def examples() -> Examples:
    """Returns the specs of the examples, ``jounce.examples()["impact-harvester-2019"]``."""
    return Examples()
