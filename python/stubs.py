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

#: Types that are converted by name, as arguments and as results.
SIMPLE_TYPES = {
    "()": "None",
    "[u8]": "bytes",
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
TYPE_ALIASES = {
    "_CallResult": "tuple[dict[str, Any] | None, BaseException | None]",
    "_Progress": "Callable[[int, int, float | None], object] | None",
}

WIDTH = 140


def split_top_level(text: str) -> list[str]:
    """The parts of a list between commas that are in no bracket."""
    items, depth, start = [], 0, 0
    for index, char in enumerate(text):
        depth += (char in "<([{") - (char in ">)]}" and text[index - 1] != "-")
        if char == "," and depth == 0:
            items.append(text[start:index])
            start = index + 1
    return [one.strip() for one in [*items, text[start:]] if one.strip()]


def bracket_contents(text: str, start: int) -> tuple[str, int]:
    """What the bracket that opens at a place holds, and the place after it."""
    depth = 0
    for index in range(start, len(text)):
        depth += (text[index] in "([{") - (text[index] in ")]}")
        if depth == 0:
            return text[start + 1 : index], index + 1
    raise ValueError(f"no bracket is closed after {text[start : start + 40]!r}")


class Source:
    """A source file, with the names that it and the others give to types."""

    aliases: dict[str, str] = {}
    dict_types: set[str] = set()
    classes: set[str] = set()

    def __init__(self, path: str) -> None:
        self.text = (SOURCES / f"{path}.rs").read_text(encoding="utf-8")

    @classmethod
    def scan_sources(cls) -> None:
        """Reads which types have names, come from a dict of their fields, or are classes."""
        for path in SOURCES.rglob("*.rs"):
            text = path.read_text(encoding="utf-8")
            cls.aliases |= dict(re.findall(r"^(?:pub )?type (\w+)(?:<'py>)? = (.*?);", text, re.MULTILINE | re.DOTALL))
            cls.dict_types |= set(re.findall(r"#\[pyo3\(from_item_all\)\]\npub struct (\w+)", text))
            cls.classes |= set(re.findall(r"#\[pyclass[^\n]*\npub struct (\w+)", text))

    def python(self, rust: str, is_result: bool, class_name: str = "") -> str:
        """A type as Python writes it; a path is taken in more forms than it is given in."""
        rust = re.sub(r"'\w+ ?,? ?", "", rust.strip()).replace("<>", "").removeprefix("&").strip()
        if rust in SIMPLE_TYPES:
            return SIMPLE_TYPES[rust]
        if rust == "Self":
            return class_name
        if rust == "PathBuf":
            return "Path" if is_result else "str | PathLike[str]"
        if rust == "Option<Bound<PyAny>>":
            return "_Progress"
        if rust in self.dict_types:
            return "dict[str, Any]"
        if rust in self.classes:
            return rust
        if rust in self.aliases:
            return self.python(self.aliases[rust], is_result, class_name)
        if rust.startswith("("):
            return f"tuple[{', '.join(self.python(one, is_result, class_name) for one in split_top_level(rust[1:-1]))}]"
        outer, _, inner = rust.partition("<")
        parts = split_top_level(inner.removesuffix(">"))
        if outer in ("PyResult", "Result", "Bound"):
            return self.python(parts[0], is_result, class_name)
        if outer == "Option":
            return f"{self.python(parts[0], is_result, class_name)} | None"
        if outer == "Vec":
            return f"list[{self.python(parts[0], is_result, class_name)}]"
        if outer in ("PyArray1", "PyReadonlyArray1") and parts == ["f64"]:
            return "NDArray[np.float64]"
        raise ValueError(f"{rust}: this type has no form in Python yet")

    def function(self, name: str, text: str, attributes: str, class_name: str = "") -> list[str]:
        """The stub of a function whose declaration begins at ``fn NAME``."""
        arguments, after = bracket_contents(text, text.index("("))
        return_match = re.match(r"\s*-> (.*?) \{", text[after:], re.DOTALL)
        return_type = self.python(return_match.group(1), True, class_name) if return_match else "None"
        signature_match = re.search(r"signature = \((.*?)\)\s*\)\s*\]", attributes, re.DOTALL)
        types = dict(one.split(": ", 1) for one in split_top_level(arguments) if ": " in one)
        names = (
            split_top_level(signature_match.group(1))
            if signature_match
            else [one for one, rust in types.items() if not rust.startswith("Python")]
        )
        parameters = []
        for one in names:
            key, _, default = one.partition(" = ")
            default = {"true": "True", "false": "False"}.get(default, default)
            parameters.append(
                one if one == "*" else f"{key}: {self.python(types[key], False, class_name)}" + (f" = {default}" if default else "")
            )
        decorators = []
        if "#[new]" in attributes:
            name, return_type, parameters = "__new__", class_name, ["cls", *parameters]
        elif "#[staticmethod]" in attributes:
            decorators = ["@staticmethod"]
        elif class_name:
            decorators, parameters = ["@property"] if "#[getter]" in attributes else [], ["self", *parameters]
        alias_of_type = {long: short for short, long in TYPE_ALIASES.items()}
        return [*decorators, *format_declaration(name, parameters, alias_of_type.get(return_type, return_type), 4 if class_name else 0)]

    def functions(self, text: str, class_name: str = "") -> list[str]:
        """The stubs of the functions of a text, each after its attributes."""
        lines = []
        for one in re.finditer(r"((?:[ ]*#\[(?:[^\[\]]|\[[^\]]*\])*\]\n)*)[ ]*(?:pub )?fn (\w+)", text):
            lines += self.function(one.group(2), text[one.start(2) :], one.group(1), class_name)
        return lines

    def exported(self, name: str) -> list[str]:
        """The stub of what the module exports under a name."""
        if name not in self.classes:
            match = re.search(rf"#\[pyfunction\]\n((?:#\[(?:[^\[\]]|\[[^\]]*\])*\]\n)*)pub fn {name}\b", self.text)
            if match is None:
                raise ValueError(f"{name}: there is no function of this name")
            return self.function(name, self.text[match.end() - len(name) :], match.group(1))
        start = self.text.index("{", self.text.index(f"#[pymethods]\nimpl {name} "))
        body, _ = bracket_contents(self.text, start)
        return ["", "@final", f"class {name}:", *(f"    {line}" for line in self.functions(body, name)), ""]


def format_declaration(name: str, arguments: list[str], return_type: str, indent: int) -> list[str]:
    """A declaration on one line, on three, or with a line for each argument, whichever is the first to fit."""
    flat = ", ".join(arguments)
    if indent + len(f"def {name}({flat}) -> {return_type}: ...") <= WIDTH:
        return [f"def {name}({flat}) -> {return_type}: ..."]
    inner = [f"    {flat}"] if indent + 4 + len(flat) <= WIDTH else [f"    {one}," for one in arguments]
    return [f"def {name}(", *inner, f") -> {return_type}: ..."]


def stubs() -> str:
    """The whole file."""
    Source.scan_sources()
    library = (SOURCES / "lib.rs").read_text(encoding="utf-8")
    exports: list[tuple[str, str]] = []
    for path, exports_of_module in re.findall(r"#\[pymodule_export\]\s+use super::([\w:]+?)::(\w+|\{[^}]*\});", library):
        exports += [(one, path.replace("::", "/")) for one in split_top_level(exports_of_module.strip("{}"))]
    names = sorted([*(name for name, _ in exports), "VERSION"], key=lambda name: (name[0].islower(), name.lower()))
    lines = [HEAD, "__all__ = [", *(f'    "{name}",' for name in names), "]", "", "VERSION: Final[str]", ""]
    lines += [f"{short} = {long}" for short, long in TYPE_ALIASES.items()]
    for name, path in sorted(exports, key=lambda one: one[0] not in Source.classes):
        lines += Source(path).exported(name)
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines)) + "\n"


if __name__ == "__main__":
    sys.stdout.write(stubs())
