"""The published systems that come with jounce."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from . import _core
from .errors import ArgumentError
from .spec import Spec


class Examples(Mapping[str, Spec]):
    """Specs by name: the name of the system, and of the file where a system has several."""

    def __init__(self) -> None:
        files = _core.examples()
        counts: dict[str, int] = {}
        for system, _, _ in files:
            counts[system] = counts.get(system, 0) + 1
        self._texts = {system if counts[system] == 1 else f"{system}/{file}": text for system, file, text in files}

    def __getitem__(self, name: str) -> Spec:
        if name not in self._texts:
            raise ArgumentError(f"{name}: no such example; there are {', '.join(self._texts)}")
        return Spec(self._texts[name])

    def __iter__(self) -> Iterator[str]:
        return iter(self._texts)

    def __len__(self) -> int:
        return len(self._texts)

    def __contains__(self, name: object) -> bool:
        return name in self._texts

    def __repr__(self) -> str:
        return f"<jounce.examples: {', '.join(self._texts)}>"


def examples() -> Examples:
    """The specs of published systems, ``jounce.examples()["impact-harvester-2019"]``."""
    return Examples()
