"""Writes the stubs of the compiled module from its sources: ``python -P python/stubs.py > python/jounce/_core.pyi``.

What is exported stands in ``lib.rs``; the arguments of each function, their types and defaults stand where it is written. mypy's stubtest
holds the stubs to the compiled module besides.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

SOURCES = Path(__file__).parents[1] / "crates/jounce-python/src"

HEAD = '''"""The compiled module; the package around it is what people use. Written by ``python/stubs.py``."""

from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Any, Final, final

import numpy as np
from numpy.typing import NDArray
'''

#: Types that need no look at what is inside them, for arguments and for answers.
PLAIN = {
    "()": "None",
    "[u8]": "bytes",
    "Given": "dict[str, Any]",
    "PyAny": "Any",
    "PyBytes": "bytes",
    "PyDict": "dict[str, Any]",
    "PyErr": "BaseException",
    "String": "str",
    "bool": "bool",
    "f64": "float",
    "str": "str",
    **dict.fromkeys(("i64", "u32", "u64", "usize"), "int"),
}

#: Types that are so long that they have a name in the stubs.
NAMED = {
    "_Handed": "tuple[dict[str, Any] | None, BaseException | None]",
    "_Progress": "Callable[[int, int, float | None], object] | None",
}

WIDTH = 140


def pieces(text: str) -> list[str]:
    """The parts of a list between commas that are in no bracket."""
    found, depth, begin = [], 0, 0
    for place, letter in enumerate(text):
        depth += (letter in "<([{") - (letter in ">)]}" and text[place - 1] != "-")
        if letter == "," and depth == 0:
            found.append(text[begin:place])
            begin = place + 1
    return [one.strip() for one in [*found, text[begin:]] if one.strip()]


def inside(text: str, begin: int) -> tuple[str, int]:
    """What the bracket that opens at a place holds, and the place after it."""
    depth = 0
    for place in range(begin, len(text)):
        depth += (text[place] in "([{") - (text[place] in ")]}")
        if depth == 0:
            return text[begin + 1 : place], place + 1
    raise ValueError(f"no bracket is closed after {text[begin : begin + 40]!r}")


class Source:
    """A source file, with the names that it and the others give to types."""

    aliases: dict[str, str] = {}
    tables: set[str] = set()
    classes: set[str] = set()

    def __init__(self, path: str) -> None:
        self.text = (SOURCES / f"{path}.rs").read_text(encoding="utf-8")

    @classmethod
    def learn(cls) -> None:
        """Reads which types have names, come from a dict of their fields, or are classes."""
        for path in SOURCES.rglob("*.rs"):
            text = path.read_text(encoding="utf-8")
            cls.aliases |= dict(re.findall(r"^(?:pub )?type (\w+)(?:<'py>)? = (.*?);", text, re.MULTILINE | re.DOTALL))
            cls.tables |= set(re.findall(r"#\[pyo3\(from_item_all\)\]\npub struct (\w+)", text))
            cls.classes |= set(re.findall(r"#\[pyclass[^\n]*\npub struct (\w+)", text))

    def python(self, rust: str, answer: bool, of: str = "") -> str:
        """A type as Python writes it; a path is taken in more forms than it is given in."""
        rust = re.sub(r"'\w+ ?,? ?", "", rust.strip()).replace("<>", "").removeprefix("&").strip()
        if rust in PLAIN:
            return PLAIN[rust]
        if rust == "Self":
            return of
        if rust == "PathBuf":
            return "Path" if answer else "str | PathLike[str]"
        if rust == "Option<Bound<PyAny>>":
            return "_Progress"
        if rust in self.tables:
            return "dict[str, Any]"
        if rust in self.classes:
            return rust
        if rust in self.aliases:
            return self.python(self.aliases[rust], answer, of)
        if rust.startswith("("):
            return f"tuple[{', '.join(self.python(one, answer, of) for one in pieces(rust[1:-1]))}]"
        outer, _, inner = rust.partition("<")
        parts = pieces(inner.removesuffix(">"))
        if outer in ("PyResult", "Result", "Bound"):
            return self.python(parts[0], answer, of)
        if outer == "Option":
            return f"{self.python(parts[0], answer, of)} | None"
        if outer == "Vec":
            return f"list[{self.python(parts[0], answer, of)}]"
        if outer in ("PyArray1", "PyReadonlyArray1") and parts == ["f64"]:
            return "NDArray[np.float64]"
        raise ValueError(f"{rust}: this type has no form in Python yet")

    def function(self, name: str, text: str, attributes: str, of: str = "") -> list[str]:
        """The stub of a function whose declaration begins at ``fn NAME``."""
        arguments, after = inside(text, text.index("("))
        told = re.match(r"\s*-> (.*?) \{", text[after:], re.DOTALL)
        answer = self.python(told.group(1), True, of) if told else "None"
        written = re.search(r"signature = \((.*?)\)\s*\)\s*\]", attributes, re.DOTALL)
        types = dict(one.split(": ", 1) for one in pieces(arguments) if ": " in one)
        names = pieces(written.group(1)) if written else [one for one, rust in types.items() if not rust.startswith("Python")]
        shown = []
        for one in names:
            key, _, default = one.partition(" = ")
            shown.append(one if one == "*" else f"{key}: {self.python(types[key], False, of)}" + (f" = {default}" if default else ""))
        decorators = []
        if "#[new]" in attributes:
            name, answer, shown = "__new__", of, ["cls", *shown]
        elif "#[staticmethod]" in attributes:
            decorators = ["@staticmethod"]
        elif of:
            decorators, shown = ["@property"] if "#[getter]" in attributes else [], ["self", *shown]
        handed = {long: short for short, long in NAMED.items()}
        return [*decorators, *wrapped(name, shown, handed.get(answer, answer), 4 if of else 0)]

    def functions(self, text: str, of: str = "") -> list[str]:
        """The stubs of the functions of a text, each after its attributes."""
        found = []
        for one in re.finditer(r"((?:[ ]*#\[(?:[^\[\]]|\[[^\]]*\])*\]\n)*)[ ]*(?:pub )?fn (\w+)", text):
            found += self.function(one.group(2), text[one.start(2) :], one.group(1), of)
        return found

    def exported(self, name: str) -> list[str]:
        """The stub of what the module exports under a name."""
        if name not in self.classes:
            found = re.search(rf"#\[pyfunction\]\n((?:#\[(?:[^\[\]]|\[[^\]]*\])*\]\n)*)pub fn {name}\b", self.text)
            if found is None:
                raise ValueError(f"{name}: there is no function of this name")
            return self.function(name, self.text[found.end() - len(name) :], found.group(1))
        begin = self.text.index("{", self.text.index(f"#[pymethods]\nimpl {name} "))
        body, _ = inside(self.text, begin)
        return ["", "@final", f"class {name}:", *(f"    {line}" for line in self.functions(body, name)), ""]


def wrapped(name: str, arguments: list[str], answer: str, indent: int) -> list[str]:
    """A declaration on one line, on three, or with a line for each argument, whichever is the first to fit."""
    flat = ", ".join(arguments)
    if indent + len(f"def {name}({flat}) -> {answer}: ...") <= WIDTH:
        return [f"def {name}({flat}) -> {answer}: ..."]
    inner = [f"    {flat}"] if indent + 4 + len(flat) <= WIDTH else [f"    {one}," for one in arguments]
    return [f"def {name}(", *inner, f") -> {answer}: ..."]


def stubs() -> str:
    """The whole file."""
    Source.learn()
    library = (SOURCES / "lib.rs").read_text(encoding="utf-8")
    exports: list[tuple[str, str]] = []
    for path, listed in re.findall(r"#\[pymodule_export\]\s+use super::([\w:]+?)::(\w+|\{[^}]*\});", library):
        exports += [(one, path.replace("::", "/")) for one in pieces(listed.strip("{}"))]
    names = sorted([*(name for name, _ in exports), "VERSION"], key=lambda name: (name[0].islower(), name.lower()))
    lines = [HEAD, "__all__ = [", *(f'    "{name}",' for name in names), "]", "", "VERSION: Final[str]", ""]
    lines += [f"{short} = {long}" for short, long in NAMED.items()]
    for name, path in sorted(exports, key=lambda one: one[0] not in Source.classes):
        lines += Source(path).exported(name)
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines)) + "\n"


if __name__ == "__main__":
    sys.stdout.write(stubs())
