"""Writes the docstrings of the package: ``python -P python/docstrings > python/jounce/docstrings.txt``.

They are completed from the definitions of options, keys and result fields, in the form of numpydoc, and set when the package is imported.

A docstring in the source has a summary, and sections for what no definition knows: most often only an example. Parameters, their types,
defaults and limits come from the signature and the questions of the library; fields come from their annotations.
"""

from __future__ import annotations

import dataclasses
import inspect
import json
import re
import sys
from collections.abc import Iterator, Mapping
from types import FunctionType
from typing import Any

from form import Sections, entries, entry, field_entry, joined, parse, sentence, summary, type_text
from parameters import EXAMPLES, LIMITS, PAGES, PARAMETERS, RAISES

import jounce
from jounce._core import questions
from jounce._docstrings import IN_SOURCE
from jounce._elements import Element

_BOOK = "https://github.com/jounce/jounce/blob/main/book/src"
_KINDS = {
    "hz": "frequency",
    "s": "time",
    "kg": "mass",
    "f": "capacitance",
    "ohm": "resistance",
    "n": "force",
    "m": "length",
    "pa": "pressure",
}
#: Calls that have the options of another question too.
_SHARED = {"measured_modes": ("measured_frf",)}
#: Name of the value that a method without arguments returns, in its example.
_RESULTS = {"to_xarray": "dataset", "to_datatree": "tree", "to_pandas": "frame", "plot": "axes"}

#: Words of the help of the command line, and of a docstring.
_WORDS = (
    (r"; can be given several times", ""),
    (r", in quotes, as in --level ", r": "),
    (r" of --at", " in ``at``"),
    (r"; with 0 s the averaging window with --out, else nothing", ""),
    (r"as `(\w+) --(\w+)`", r"as ``\2`` of :meth:`\1`"),
    (r"`(\w+)`", r":meth:`\1`"),
    (r"the command", "the result"),
    (r"(?:KEY=)?FROM:TO:STEP, .*", "as in :meth:`Spec.sweep`"),
)


class Options:
    """Options of the questions of the library, by call and keyword."""

    def __init__(self) -> None:
        self.calls: dict[str, dict[str, dict[str, Any]]] = {}
        for question in json.loads(questions()):
            options = self.calls.setdefault(question["python"], {})
            for option in question["options"]:
                options[option["name"]] = options[option["argument"].removeprefix("no-").replace("-", "_")] = option

    def find(self, call: str, keyword: str) -> dict[str, Any] | None:
        """Returns the option of a keyword of a call, if it has one."""
        calls = (call, *_SHARED.get(call, ()))
        return next((self.calls[one][keyword] for one in calls if keyword in self.calls.get(one, ())), None)


def option_text(option: Mapping[str, Any], is_flag: bool) -> str:
    """Returns the meaning of an option of the library for a docstring."""
    help_text = str(option["help"])
    for pattern, text in _WORDS:
        help_text = re.sub(pattern, text, help_text)
    help_text = re.sub(r'("[^"]*")', r"``\1``", help_text)
    if is_flag:
        value = "False" if option["argument"].startswith("no-") else "True"
        help_text = f"``{value}`` {help_text[:1].lower()}{help_text[1:]}"
    return sentence(help_text)


def parameters(call: str, function: Any, options: Options, written: Mapping[str, tuple[str, str]]) -> Iterator[str]:
    """Yields the lines of the parameters of a call."""
    # The decorator of calls that are recorded has parameters of its own.
    function = inspect.unwrap(function)
    code, hints = function.__code__, function.__annotations__
    count = code.co_argcount + code.co_kwonlyargcount
    names = [name for name in code.co_varnames[:count] if name not in ("self", "cls")]
    positional = code.co_varnames[: code.co_argcount]
    defaults = dict(zip(positional[::-1], (function.__defaults__ or ())[::-1])) | (function.__kwdefaults__ or {})
    name_of_rest = [f"**{code.co_varnames[count]}"] if code.co_flags & inspect.CO_VARKEYWORDS else []
    for name in (*names, *name_of_rest):
        bare = name.strip("*")
        option = options.find(call, bare)
        kind, text = written.get(bare) or PARAMETERS.get(f"{call}.{bare}") or (("", "") if option else PARAMETERS.get(bare, ("", "")))
        hint = str(hints.get(bare, "Any"))
        if option and not text:
            text = option_text(option, hint == "bool")
            unit = _KINDS.get(option["name"].rpartition("_")[2]) if "_" in option["name"] else None
            kind = kind or (f"str or quantity ({unit})" if unit and hint == "Any" else "")
        kind = kind or type_text(hint.removesuffix(" | None"))
        yield from entry(name, kind + limits(call, bare) + default_text(bare, defaults, option), text)


def limits(call: str, name: str) -> str:
    """Returns the least and the largest value of a count, for the type of a parameter."""
    least, most = LIMITS.get(f"{call}.{name}", (None, None))
    return "" if least is None else f" from {least} to {most}"


def default_text(name: str, defaults: Mapping[str, Any], option: Mapping[str, Any] | None) -> str:
    """Returns the default of a parameter as it follows its type."""
    if name not in defaults:
        return ""
    value = defaults[name]
    if value is None and option and option["default"]:
        return f", default {option['default']}"
    if value is None or value is ... or value == ():
        return ", optional"
    return f", default {json.dumps(value) if isinstance(value, str) else value}"


def returns(function: Any, head: str, owner: str, public: Mapping[str, Any]) -> list[str]:
    """Returns the lines of the section about the result of a call."""
    hint = str(function.__annotations__.get("return", "None")).replace("Self", owner)
    if hint == "None":
        return []
    known = public.get(hint)
    first = re.sub(r"^(?:Returns|Computes|Estimates|Reads) ", "", head.split("\n\n")[0].replace("\n", " "))
    text = summary(known) if inspect.isclass(known) else sentence(first)
    return entry(type_text(hint), "", "Axes with the figure." if first.startswith("Draws") else text)


def raises(call: str, has_options: bool, public: Mapping[str, Any], written: Mapping[str, tuple[str, str]]) -> list[str]:
    """Returns the lines of the section about the errors of a call."""
    texts = {name: text for name, (_, text) in written.items()}
    for name in (*(("ArgumentError",) if has_options else ()), *RAISES.get(call, ())):
        texts.setdefault(name, "")
    return [line for name, text in texts.items() for line in entry(name, "", text or summary(public[name]))]


def notes(call: str) -> list[str]:
    """Returns the lines with the page of the book that describes a call."""
    return [f"The book describes this in {_BOOK}/{PAGES[call]}"] if call in PAGES else []


def example(name: str, lines: list[str], first_lines: list[str]) -> list[str]:
    """Returns a complete example: the lines of the class of a method first, then its own."""
    assigned = [line.split()[1] for line in first_lines if re.match(r">>> \w+ = ", line)]
    variable = "result" if "result" in assigned else assigned[-1] if assigned else ""
    kind = next((kind for kind in _RESULTS if name.endswith(kind) or name.startswith(f"{kind}_")), None)
    own = lines or ([f">>> {_RESULTS[kind]} = {variable}.{name}()"] if kind and assigned else [])
    text = "\n".join(own)
    if any(re.search(rf"\b{one}\b", text) and f">>> {one} = " not in text for one in assigned):
        own = [*first_lines, *own]
    return own if not own or own[0] == ">>> import jounce" else [">>> import jounce", *own]


def preamble(lines: list[str]) -> list[str]:
    """Returns the assignments of an example with their continuation lines, and the files that it writes."""
    kept: list[str] = []
    is_kept = False
    for line in lines:
        is_kept = bool(re.match(r">>> (?:\w+ = |import |\w+\.write\()", line)) or (line.startswith("...") and is_kept)
        kept += [line] if is_kept else []
    return kept


def document_call(call: str, function: Any, options: Options, public: Mapping[str, Any], first_lines: list[str]) -> str:
    """Returns the completed docstring of a function or a method."""
    head, sections = parse(function.__doc__)
    owner, _, name = call.rpartition(".")
    origin = function.__qualname__ if function.__qualname__ in EXAMPLES else call
    completed: Sections = dict(sections)
    completed["Parameters"] = list(parameters(call, function, options, entries(sections.get("Parameters", []))))
    completed["Returns"] = sections.get("Returns") or returns(function, head, owner, public)
    completed["Raises"] = raises(call, call in options.calls, public, entries(sections.get("Raises", [])))
    completed["Notes"] = [*sections.get("Notes", []), *notes(call)]
    completed["Examples"] = example(name, EXAMPLES.get(origin, []) or sections.get("Examples", []), first_lines)
    return joined(head, completed)


def document_class(name: str, kind: type, options: Options, public: Mapping[str, Any], documented: dict[str, str], seen: set[int]) -> None:
    """Adds the completed docstrings of a class and of its methods."""
    head, sections = parse(kind.__doc__)
    completed: Sections = dict(sections)
    if dataclasses.is_dataclass(kind):
        hints = {field: hint for base in reversed(kind.__mro__) for field, hint in vars(base).get("__annotations__", {}).items()}
        names_of_fields = [field.name for field in dataclasses.fields(kind)]
        fields = {field: str(hint) for field, hint in hints.items() if field in names_of_fields}
        completed["Attributes"] = [line for field, hint in fields.items() for line in field_entry(field, hint)]
    if issubclass(kind, Element):
        others = {call.partition(".")[2]: one for call, one in PARAMETERS.items() if call.startswith(f"{name}.")}
        own = (line for other, (kind_text, text) in others.items() for line in entry(other, f"{kind_text}, optional", text))
        completed["Parameters"] = [*table_entries(name.lower()), *own]
    elif "Parameters" in sections:
        completed["Parameters"] = list(parameters(name, kind.__init__, options, entries(sections["Parameters"])))
    completed["Notes"] = [*sections.get("Notes", []), *notes(name)]
    completed["Examples"] = example("", EXAMPLES.get(name, []) or sections.get("Examples", []), [])
    documented[name] = joined(head, completed)
    first_lines = preamble(completed["Examples"])
    names = [one for base in kind.__mro__ if base.__module__.startswith("jounce") for one in vars(base) if not one.startswith("_")]
    for method_name in dict.fromkeys(names):
        member = inspect.getattr_static(kind, method_name)
        function = member.__func__ if isinstance(member, (classmethod, staticmethod)) else member
        if isinstance(function, FunctionType) and id(function) not in seen:
            seen.add(id(function))
            call = f"{name}.{method_name}"
            documented[function.__qualname__] = document_call(call, function, options, public, first_lines)


def table_entries(table: str) -> list[str]:
    """Returns the lines of the keys of a table of a spec, from its JSON schema."""
    schema = jounce.schema()["properties"][table]
    (schema,) = schema.get("patternProperties", {"": schema}).values()
    lines: list[str] = []
    for key, value in schema["properties"].items():
        if "enum" in value:
            kind = "{" + ", ".join(json.dumps(one) for one in value["enum"]) + "}"
        elif "pattern" in value:
            kind = "str or quantity"
        elif "type" not in value:
            kind = "float or str"
        else:
            kinds = {"string": "str", "number": "float", "integer": "int", "boolean": "bool", "array": "list of float", "object": "dict"}
            kind = kinds[value["type"]]
            if value.get("items", {}).get("type") == "string":
                kind = "list of str"
        least, most = value.get("minimum"), value.get("maximum")
        kind += "" if least is None or most is None else f" from {least:g} to {most:g}"
        text, _, default = value["description"].removesuffix(")").partition(" (default ")
        end = f", default {default}" if default else "" if key in schema.get("required", ()) else ", optional"
        lines += entry(key, kind + end, sentence(re.sub(r"`([^`]*)`", r"``\1``", text)))
    return lines


def complete(public: Mapping[str, Any]) -> str:
    """Returns the completed docstrings of all public objects, each after a line with its name."""
    options, seen, documented = Options(), set[int](), dict[str, str]()
    for name, member in public.items():
        if isinstance(member, type):
            document_class(name, member, options, public, documented, seen)
        elif isinstance(member, FunctionType):
            documented[name] = document_call(name, member, options, public, [])
    return "".join(f"==== {name}\n{text}\n" for name, text in documented.items())


if __name__ == "__main__":
    public_objects = {name: getattr(jounce, name) for name in jounce.__all__}
    for documented_object, docstring in IN_SOURCE.values():
        documented_object.__doc__ = docstring
    sys.stdout.write(complete(public_objects))
