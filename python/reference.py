"""Writes the reference of the Python package from its docstrings: ``python python/reference.py > book/src/python-reference.md``."""

import dataclasses
import inspect
import sys

import jounce

HEAD = """# Reference of the Python package

Made from the docstrings by `python/reference.py`. Arrays are numpy's; units are in the names.
"""


def signature(name: str, what: object) -> str:
    """A call as it is written, without the annotations that only a type checker reads."""
    try:
        found = inspect.signature(what)  # type: ignore[arg-type]
    except ValueError:
        return name
    shown = [p.replace(annotation=inspect.Parameter.empty) for p in found.parameters.values() if p.name not in ("self", "cls")]
    return f"{name}{found.replace(parameters=shown, return_annotation=inspect.Signature.empty)}"


def members(kind: type) -> list[str]:
    """Lines of the public methods and properties of a class, its bases of jounce included."""
    lines = []
    for name, what in inspect.getmembers(kind):
        plain = inspect.isfunction(what) or inspect.ismethod(what) or isinstance(what, property)
        if name.startswith("_") or not plain or not (inspect.getdoc(what) or "").strip() or hasattr(dict, name):
            continue
        call = f"{name}" if isinstance(what, property) else signature(name, what)
        lines.append(f"- `{call}`: {' '.join((inspect.getdoc(what) or '').split())}")
    return lines


def fields(kind: type) -> str:
    """The names of the values that a result holds."""
    if not dataclasses.is_dataclass(kind):
        return ""
    return ", ".join(f"`{field.name}`" for field in dataclasses.fields(kind))


def page() -> str:
    """The whole page."""
    parts = [HEAD]
    for name in sorted(jounce.__all__, key=str.lower):
        what = getattr(jounce, name)
        if not callable(what):
            continue
        parts.append(f"## {name}\n\n{' '.join((inspect.getdoc(what) or '').split())}\n")
        if not inspect.isclass(what):
            parts.append(f"`{signature(name, what)}`\n")
            continue
        held = fields(what)
        if held:
            parts.append(f"Holds {held}.\n")
        lines = members(what)
        if lines:
            parts.append("\n".join(lines) + "\n")
    return "\n".join(parts)


if __name__ == "__main__":
    sys.stdout.write(page())
