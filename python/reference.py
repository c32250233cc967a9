"""Writes the reference of the Python package from its docstrings: ``python -P python/reference.py > book/src/python-reference.md``."""

import inspect
import re
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


def markdown(line: str) -> str:
    """A line of a docstring with the marks of Markdown."""
    return re.sub(r":(?:class|meth|func|attr):(?=`)", "", line).replace("``", "`")


def page_text(documented: object) -> str:
    """The docstring of an object in Markdown: entries of sections as lists, the example as a block."""
    text, _, example = (inspect.getdoc(documented) or "").partition("\nExamples\n--------\n")
    lines = []
    source = text.rstrip().split("\n")
    for line, following in zip(source, [*source[1:], ""]):
        if line.startswith("    "):
            lines.append(f"  {markdown(line.strip())}")
        elif following.startswith("    "):
            name, _, kind = line.partition(" : ")
            lines.append(f"- `{name}`" + (f" ({markdown(kind)})" if kind else "") + ":")
        elif following and following == "-" * len(line):
            lines.append(f"{line}:")
        elif not line.startswith("---"):
            lines.append(markdown(line))
        else:
            lines.append("")
    return "\n".join([*lines, *(["", "```pycon", example.rstrip(), "```"] if example else [])]) + "\n"


def members(kind: type, shown: dict[int, str]) -> list[str]:
    """Lines of the public methods and properties of a class, its bases of jounce included; one shown before is named only."""
    lines = []
    for name, member in inspect.getmembers(kind):
        is_public = inspect.isfunction(member) or inspect.ismethod(member) or isinstance(member, property)
        if name.startswith("_") or not is_public or not (inspect.getdoc(member) or "").strip() or hasattr(dict, name):
            continue
        call = f"{name}" if isinstance(member, property) else signature(name, member)
        first = shown.setdefault(id(getattr(member, "__func__", member)), f"{kind.__name__}.{name}")
        text = page_text(member) if first == f"{kind.__name__}.{name}" else f"As `{first}`.\n"
        lines += [f"### {kind.__name__}.{name}\n", f"`{call}`\n", text]
    return lines


def page() -> str:
    """The whole page."""
    parts = [HEAD]
    shown: dict[int, str] = {}
    for name in sorted(jounce.__all__, key=str.lower):
        member = getattr(jounce, name)
        if not callable(member):
            continue
        parts.append(f"## {name}\n")
        if inspect.isclass(member):
            parts += [page_text(member), *members(member, shown)]
        else:
            parts += [f"`{signature(name, member)}`\n", page_text(member)]
    return "\n".join(parts)


if __name__ == "__main__":
    sys.stdout.write(page())
