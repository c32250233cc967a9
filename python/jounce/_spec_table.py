"""Mapping over the tables of a spec; a change of a nested table changes the spec."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, MutableMapping
from typing import Any

#: Stands for an argument that is not given, where None is a value.
MISSING: Any = ...


class SpecTables(MutableMapping[str, Any]):
    """Tables and keys of a spec by name; ``"stop.tip.gap"`` is the key ``gap`` of the table ``tip`` in ``stop``.

    Iteration gives the names that the text has. ``in`` and ``[]`` also know the keys that have their default. A table is a
    :class:`SpecTable`, a list of numbers a tuple.
    """

    __slots__ = ()

    def to_dict(self) -> dict[str, Any]:
        """Returns the tables as dicts."""
        raise NotImplementedError

    def set(self, keys: Mapping[str, Any], /) -> None:
        """Sets several keys at once."""
        raise NotImplementedError

    def __setitem__(self, key: str, value: Any) -> None:
        self.set({key: value})

    def __iter__(self) -> Iterator[str]:
        return iter(self.to_dict())

    def __len__(self) -> int:
        return len(self.to_dict())

    def update(self, other: Any = (), /, **keys: Any) -> None:
        """Sets keys at once, so that only their result must be valid."""
        self.set({**dict(other), **keys})

    def pop(self, key: str, default: Any = MISSING) -> Any:
        """Removes a key of the text and returns its value."""
        if default is not MISSING and key not in self:
            return default
        value = self[key]
        value = value.to_dict() if isinstance(value, SpecTable) else value
        del self[key]
        return value

    def popitem(self) -> tuple[str, Any]:
        """Removes the last key and returns it with its value."""
        key = list(self)[-1]
        return key, self.pop(key)


class SpecTable(SpecTables):
    """Table of a spec, ``spec["stop.tip"]``; a change of it changes the spec."""

    __slots__ = ("_path", "_spec")

    def __init__(self, spec: SpecTables, path: str) -> None:
        self._spec = spec
        self._path = path

    def to_dict(self) -> dict[str, Any]:
        """Returns the table as a dict."""
        tables: Any = self._spec.to_dict()
        for part in self._path.split("."):
            tables = tables.get(part, {})
        return dict(tables)

    def set(self, keys: Mapping[str, Any], /) -> None:
        """Sets several keys at once; ``None`` removes one."""
        self._spec.set({f"{self._path}.{key}": value for key, value in keys.items()})

    def __getitem__(self, key: str) -> Any:
        return self._spec[f"{self._path}.{key}"]

    def __delitem__(self, key: str) -> None:
        del self._spec[f"{self._path}.{key}"]

    def __contains__(self, key: object) -> bool:
        return f"{self._path}.{key}" in self._spec

    def clear(self) -> None:
        """Removes all keys at once."""
        self._spec.set({self._path: {}})

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def __repr__(self) -> str:
        return f"<jounce.SpecTable {self._path}: {self.to_dict()!r}>"


def dotted(tables: Mapping[str, Any], path: str = "") -> Iterator[str]:
    """Yields the dotted names of the tables and keys in a dict."""
    for key, value in tables.items():
        yield path + key
        if isinstance(value, Mapping):
            yield from dotted(value, f"{path}{key}.")
