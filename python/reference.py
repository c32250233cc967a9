"""Writes the reference of the Python package from its docstrings: ``python -P python/reference.py > book/src/python-reference.md``."""

import dataclasses
import inspect
import sys

import jounce

HEAD = """# Reference of the Python package

Made from the docstrings by `python/reference.py`. Arrays are numpy's; units are in the names.
"""


def signature(name: str, member: object) -> str:
    """A call as it is written, without the annotations that only a type checker reads."""
    try:
        call_signature = inspect.signature(member)  # type: ignore[arg-type]
    except ValueError:
        return name
    parameters = [
        p.replace(annotation=inspect.Parameter.empty) for p in call_signature.parameters.values() if p.name not in ("self", "cls")
    ]
    return f"{name}{call_signature.replace(parameters=parameters, return_annotation=inspect.Signature.empty)}"


def members(kind: type) -> list[str]:
    """Lines of the public methods and properties of a class, its bases of jounce included."""
    lines = []
    for name, member in inspect.getmembers(kind):
        is_shown = inspect.isfunction(member) or inspect.ismethod(member) or isinstance(member, property)
        if name.startswith("_") or not is_shown or not (inspect.getdoc(member) or "").strip() or hasattr(dict, name):
            continue
        call = f"{name}" if isinstance(member, property) else signature(name, member)
        lines.append(f"- `{call}`: {' '.join((inspect.getdoc(member) or '').split())}")
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
        member = getattr(jounce, name)
        if not callable(member):
            continue
        parts.append(f"## {name}\n\n{' '.join((inspect.getdoc(member) or '').split())}\n")
        if not inspect.isclass(member):
            parts.append(f"`{signature(name, member)}`\n")
            continue
        field_names = fields(member)
        if field_names:
            parts.append(f"Holds {field_names}.\n")
        lines = members(member)
        if lines:
            parts.append("\n".join(lines) + "\n")
    return "\n".join(parts)


if __name__ == "__main__":
    sys.stdout.write(page())
