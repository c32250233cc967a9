"""Text and keys of a spec."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, Unpack

from . import _core
from ._arguments import spec_from_tables
from ._errors import ArgumentError, SpecError, UnknownKeyError
from ._format import html_table
from ._issue import Issue, parse_issues
from ._named import nearest_name
from ._quantity import settings
from ._spec_table import MISSING, SpecTable, SpecTables, dotted

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._tables import SpecKeys


class SpecText(SpecTables):
    """Text of a spec with its operations that need no computation."""

    __slots__ = ("_spec",)
    _spec: _core.Spec

    def __init__(self, spec: str | Mapping[str, Any] | SpecKeys | None = None, /, **tables: Unpack[SpecKeys]) -> None:
        if isinstance(spec, str) and not tables:
            if "\n" not in spec and spec.endswith(".toml"):
                raise ArgumentError(f"{spec} is the name of a file: read it with jounce.read({spec!r})")
            self._spec = _core.Spec(spec, "")
        elif isinstance(spec, SpecText):
            self._spec = spec._spec.with_keys(settings(tables))
        elif spec is None or isinstance(spec, Mapping):
            self._spec = spec_from_tables({**(spec or {}), **tables})
        else:
            raise ArgumentError(f"a spec is made of TOML text or of a dict, not of {type(spec).__name__}")

    @classmethod
    def _from_core(cls, core: _core.Spec) -> Self:
        spec = cls.__new__(cls)
        spec._spec = core
        return spec

    @classmethod
    def read(cls, path: str | PathLike[str]) -> Self:
        """Reads a TOML file; the path of a state file in it is relative to its folder."""
        try:
            return cls._from_core(_core.Spec.read(fspath(path)))
        except SpecError as error:
            lines = "\n".join(f"{fspath(path)}: {fault}" for fault in error.faults)
            raise SpecError(lines or str(error), error.details) from None

    def write(self, path: str | PathLike[str]) -> None:
        """Writes the text to a file, with comments and layout; the file is written completely or not at all.

        Samples that were given as the ``recording`` of a :class:`Drive` are copied next to it, and the text names the copies.
        """
        from ._recorded_drive import copy_next_to

        text = self._spec.text
        for file, name in copy_next_to(Path(path), self.to_dict()).items():
            text = text.replace(json.dumps(file, ensure_ascii=False), json.dumps(name))
        if text == self._spec.text:
            self._spec.write(fspath(path))
        else:
            _core.Spec(text, fspath(Path(path).parent)).write(fspath(path))

    def to_toml(self, canonical: bool = False) -> str:
        """Returns the text with comments and layout; or in canonical form: every key that applies, with its default."""
        return self._spec.to_toml() if canonical else self._spec.text

    @property
    def issues(self) -> list[Issue]:
        """Data-quality issues of the recordings of its drives, and the corrections made."""
        return parse_issues(self._spec.issues())

    def to_dict(self, canonical: bool = False) -> dict[str, Any]:
        """Returns the tables; ``Spec(spec.to_dict()) == spec``."""
        import tomllib

        return tomllib.loads(self.to_toml(canonical))

    def set(self, key: str | Mapping[str, Any], value: Any = MISSING, /) -> None:
        """Sets a key or a table, ``spec.set("stop.tip.gap", "0.5 mm")``, or several at once with a dict; ``None`` removes one."""
        if not isinstance(key, (str, Mapping)):
            raise ArgumentError(
                f'{key!r} is not a key; give its name, as in "stop.tip.gap", or a dict of keys and values', {"given": repr(key)}
            )
        if isinstance(key, str) and value is MISSING:
            raise ArgumentError(f"{key}: expected a value; None removes the key")
        self._spec = self._spec.with_keys(settings(key if isinstance(key, Mapping) else {key: value}))

    def changed(self, keys: Mapping[str, Any]) -> Self:
        """Returns a copy with changed keys and tables; those of ``None`` are removed.

        A contact law is changed with its keys: ``{"stop.tip.law": "rigid", "stop.tip.restitution": 0.8, "stop.tip.stiffness": None}``.
        """
        spec = self.copy()
        spec.set(keys)
        return spec

    def copy(self) -> Self:
        """Returns an independent copy."""
        return self._from_core(self._spec)

    __copy__ = copy

    def __deepcopy__(self, memo: object) -> Self:
        return self.copy()

    def __getitem__(self, key: str) -> Any:
        """Returns the value of a key in the text, or its default; a table as a :class:`SpecTable`."""
        if not isinstance(key, str):
            raise ArgumentError(f'{key!r} is not a key; keys are text, as in "stop.tip.gap"', {"given": repr(key)})
        value = self._lookup(key)
        if value is None:
            raise self._unknown(key)
        if isinstance(value, dict):
            return SpecTable(self, key)
        return tuple(value) if isinstance(value, list) else value

    def __contains__(self, key: object) -> bool:
        return isinstance(key, str) and self._lookup(key) is not None

    def __delitem__(self, key: str) -> None:
        """Removes a key or a table of the text."""
        if key not in dotted(self.to_dict()):
            missing = UnknownKeyError(f"{key}: the text has no such key, only its default applies", {"wanted": key, "nearest": None})
            raise missing if key in self else self._unknown(key)
        self.set({key: None})

    def clear(self) -> None:
        """Raises SpecError: a spec without tables is not valid."""
        self.set(dict.fromkeys(self))

    def _ipython_key_completions_(self) -> list[str]:
        return list(dotted(self.to_dict(canonical=True)))

    def _lookup(self, key: str) -> Any:
        for canonical in (False, True):
            value: Any = self.to_dict(canonical)
            for part in key.split("."):
                value = value.get(part) if isinstance(value, dict) else None
            if value is not None:
                return value
        return None

    def _unknown(self, key: str) -> UnknownKeyError:
        nearest = nearest_name(key, list(dotted(self.to_dict(canonical=True))))
        hint = f"did you mean {nearest}?" if nearest else "spec.to_dict(canonical=True) contains all keys"
        return UnknownKeyError(f"{key}: this spec has no such key; {hint}", {"wanted": key, "nearest": nearest})

    def _number(self, key: str) -> tuple[float, str]:
        try:
            return self._spec.number(key)
        except SpecError:
            # An existing key that is not a number is a different fault.
            if self._lookup(key) is None:
                raise self._unknown(key) from None
            raise

    def si(self, key: str) -> float:
        """Returns the number of a key in SI units."""
        return self._number(key)[0]

    def unit(self, key: str) -> str:
        """Returns the SI unit of a key; empty for a plain number."""
        return self._number(key)[1]

    @property
    def sha256(self) -> str:
        """Digest of the canonical form, equal for specs with equal contents."""
        return self._spec.hash_hex()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, SpecText):
            return NotImplemented
        return self.to_toml(canonical=True) == other.to_toml(canonical=True)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return (_rebuild, (type(self), self._spec.text, str(self._spec.folder)))

    def _lines(self) -> Iterator[tuple[str, str]]:
        for kind, elements in self.to_dict().items():
            if all(isinstance(element, dict) for element in elements.values()):
                for name, keys in elements.items():
                    yield f"{kind}.{name}", _format_keys(keys)
            else:
                yield kind, _format_keys(elements)

    def __repr__(self) -> str:
        lines = list(self._lines())
        width = max(len(name) for name, _ in lines)
        return "\n".join(["<jounce.Spec>", *(f"  {name:<{width}}  {keys}" for name, keys in lines)])

    def _repr_html_(self) -> str:
        drawing, _ = self._spec.drawing("")
        return drawing + html_table("Spec", ["", ""], list(self._lines()))

    def plot_harvester(self, ax: Axes | None = None, title: str = "Harvester") -> Axes:
        """Draws the harvester to scale, the drawing of ``jounce show``."""
        from ._plot.harvester import plot_harvester

        return plot_harvester(self._spec.drawing(title), ax)


def _rebuild(kind: type[SpecText], text: str, folder: str) -> SpecText:
    return kind._from_core(_core.Spec(text, folder))


def _format_keys(keys: Mapping[str, Any]) -> str:
    return ", ".join(f"{key} = {value}" if not isinstance(value, dict) else f"{key}: {_format_keys(value)}" for key, value in keys.items())
