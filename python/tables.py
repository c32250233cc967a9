"""Writes the types of the tables of a spec from its JSON schema: ``python -P python/tables.py > python/jounce/_tables.py``."""

import json
import keyword
import sys
from typing import Any

import jounce

HEAD = '''"""Types of the tables of a spec, for editors and type checkers. Written by ``python/tables.py`` from the JSON schema."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, Protocol, Required, TypedDict

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from . import _elements


class QuantityLike(Protocol):
    """Number with a unit, as defined by pint."""

    @property
    def magnitude(self) -> Any:
        """Number without its unit."""

    def to_base_units(self) -> Any:
        """Returns the quantity in base units."""


#: Text with a unit, ``"0.5 mm"``, or a quantity of pint.
Quantity = str | QuantityLike
Numbers = Sequence[float] | NDArray[np.float64]
'''


class Tables:
    """Classes of the tables of a schema."""

    def __init__(self) -> None:
        self.classes: list[str] = []

    def type_of(self, schema: dict[str, Any], name: str) -> str:
        """The type of a value, with a class for a table; ``name`` names it."""
        if "patternProperties" in schema:
            (value,) = schema["patternProperties"].values()
            return f"Mapping[str, {self.type_of(value, name)}]"
        if "properties" in schema:
            return self.table(schema, name)
        if "enum" in schema:
            return f"Literal[{', '.join(json.dumps(one) for one in schema['enum'])}]"
        if "type" not in schema:
            # A number, or text with a unit.
            return "float | str"
        if schema["type"] == "array":
            return "Sequence[str]" if schema["items"]["type"] == "string" else "Numbers"
        if schema["type"] == "string":
            return "Quantity" if "pattern" in schema else "str"
        return {"number": "float", "integer": "int", "boolean": "bool"}[schema["type"]]

    def table(self, schema: dict[str, Any], name: str) -> str:
        """The name of the class of a table, which is added."""
        types = {key: self.type_of(value, f"{name}{key.capitalize()}") for key, value in schema["properties"].items()}
        for key in schema.get("required", ()):
            types[key] = f"Required[{types[key]}]"
        if any(map(keyword.iskeyword, types)):
            fields = "".join(f'        "{key}": {kind},\n' for key, kind in types.items())
            self.classes.append(f'{name}Keys = TypedDict(\n    "{name}Keys",\n    {{\n{fields}    }},\n    total=False,\n)')
        else:
            head = [f"class {name}Keys(TypedDict, total=False):", f'    """Keys of a table of a spec: {name.lower()}."""', ""]
            self.classes.append("\n".join([*head, *(f"    {key}: {kind}" for key, kind in types.items())]))
        return f"{name}Keys"


def page() -> str:
    """The whole module."""
    tables = Tables()
    lines = ["class SpecKeys(TypedDict, total=False):", '    """Tables of a spec."""', ""]
    for name, schema in jounce.schema()["properties"].items():
        kind = name.capitalize()
        (value,) = schema.get("patternProperties", {"": schema}).values()
        one = f"{tables.type_of(value, kind)} | _elements.{kind}"
        lines.append(f"    {name}: {f'Mapping[str, {one}]' if value is not schema else one}")
    return "\n\n\n".join([HEAD.rstrip(), *tables.classes, "\n".join(lines)]) + "\n"


if __name__ == "__main__":
    sys.stdout.write(page())
