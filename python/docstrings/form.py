"""Docstrings in the form of numpydoc: their sections, types and sentences."""

from __future__ import annotations

import inspect
import re
import textwrap
from collections.abc import Mapping
from typing import Any

from jounce._fields import About, Along

#: Sections in the order of numpydoc.
ORDER = ("Parameters", "Attributes", "Returns", "Raises", "Warns", "See Also", "Notes", "References", "Examples")
_WIDTH = 96

#: Types as they are written in a signature, and in a docstring.
_TYPES = (
    (r"Literal\[(.*?)\]", r"{\1}"),
    (r"str \| PathLike\[str\]", "path"),
    (r"str \| _PathLike\[str\]", "path"),
    (r"str \| Sequence\[str\]", "str or list of str"),
    (r"(?:dict|Mapping)\[str, (\w+)\]", "dict"),
    (r"\bFloats\b", "ndarray of float"),
    (r"\bIntegers\b", "ndarray of int"),
    (r"\bTruths\b", "ndarray of bool"),
    (r"\bComplexes\b", "ndarray of complex"),
    (r"\bMeasured\b", "recording"),
    (r"\blist\[(.+)\]", r"list of \1"),
    (r" \| None", " or None"),
    (r" \| ", " or "),
)

Sections = dict[str, list[str]]


def parse(doc: str | None) -> tuple[str, Sections]:
    """Returns the text before the sections of a docstring, and the lines of each section."""
    lines = inspect.cleandoc(doc or "").split("\n")
    starts = [i for i in range(len(lines) - 1) if lines[i] in ORDER and lines[i + 1].startswith("---")]
    ends = [*starts[1:], len(lines)]
    sections = {lines[i]: "\n".join(lines[i + 2 : end]).strip("\n").split("\n") for i, end in zip(starts, ends)}
    return "\n".join(lines[: starts[0]] if starts else lines).strip(), sections


def entries(lines: list[str]) -> dict[str, tuple[str, str]]:
    """Returns type and text of each entry of a section, by name."""
    found: dict[str, tuple[str, list[str]]] = {}
    text: list[str] = []
    for line in lines:
        if line and not line.startswith(" "):
            name, _, kind = line.partition(" : ")
            text = []
            found[name] = (kind, text)
        else:
            text.append(line.strip())
    return {name: (kind, " ".join(text).strip()) for name, (kind, text) in found.items()}


def type_text(annotation: str) -> str:
    """Returns a type of a signature as it is written in a docstring."""
    for pattern, text in _TYPES:
        annotation = re.sub(pattern, text, annotation)
    return annotation.replace("'", '"')


def sentence(text: str) -> str:
    """Returns a text with a capital and a full stop."""
    return text[:1].upper() + text[1:] + ("" if text.endswith((".", "...")) else ".")


def summary(documented: Any) -> str:
    """Returns the first sentence of a docstring."""
    first = parse(documented.__doc__)[0].split("\n\n")[0].replace("\n", " ")
    return sentence(re.split(r"(?<=[a-z\])`])\. |: ", first)[0])


def entry(name: str, kind: str, text: str) -> list[str]:
    """Returns the lines of one entry of a section."""
    head = f"{name} : {kind}" if kind else name
    return [head, *textwrap.wrap(text, _WIDTH, initial_indent="    ", subsequent_indent="    ", break_on_hyphens=False)]


def joined(head: str, sections: Mapping[str, list[str]]) -> str:
    """Returns the docstring of a text and its sections."""
    parts = [head.rstrip()]
    for name in ORDER:
        lines = sections.get(name)
        if lines:
            parts.append("\n".join([name, "-" * len(name), *lines]))
    return "\n\n".join(parts) + "\n"


_FIELD = re.compile(r"Annotated\[(.*?), (Along|About)\((.*)\)\]$")
_TEXT = re.compile(r"""(?:(\w+)=)?('(?:[^'\\]|\\.)*'|"(?:[^"\\]|\\.)*")""")


def field_entry(name: str, annotation: str) -> list[str]:
    """Returns the lines of a field of a class from its annotation: type, shape, meaning and unit."""
    match = _FIELD.match(annotation)
    if match is None:
        return entry(name, type_text(annotation), "")
    texts = [(key, text[1:-1].replace("\\'", "'").replace('\\"', '"')) for key, text in _TEXT.findall(match[3])]
    positional, named = [text for key, text in texts if not key], {key: text for key, text in texts if key}
    description = Along(*positional, **named) if match[2] == "Along" else About(*positional, **named)
    about, detail = (description.about, description.detail) if isinstance(description, Along) else (description.text, "")
    shape = f", shape ({', '.join(description.axes.split())}{',' if ' ' not in description.axes else ''})" if description.axes else ""
    unit = "in SI units" if description.unit == "SI" else f"in {description.unit}"
    first, separator, rest = about.partition("; ")
    meaning = first + ("" if description.unit in ("", "1") else f", {unit}") + separator + rest
    return entry(name, type_text(match[1]) + shape, sentence("; ".join(filter(None, (meaning, detail)))))
