"""Descriptions of the fields of results: unit, axes and meaning, for datasets and for the documentation."""

from __future__ import annotations

from typing import Any, NamedTuple, get_args, get_type_hints


class Variable(NamedTuple):
    """Variable of a dataset."""

    dims: tuple[str, ...]
    values: Any
    units: str
    long_name: str


class Along(NamedTuple):
    """Description of a result field in a dataset: ``power_w: Annotated[Floats, Along("record", "W", "power")]``."""

    #: Names of the axes, separated by blanks; empty for a number.
    axes: str
    unit: str
    about: str
    #: Name in a dataset, without a unit; by default the name of the field without its unit.
    dataset_name: str = ""
    #: Addition to ``about`` in the documentation.
    detail: str = ""

    def name(self, field: str) -> str:
        """Returns the name in a dataset."""
        unit_suffix = {"1/s": "hz"}.get(self.unit, self.unit.lower().replace("^", "").replace("/", "_").replace(" ", "_"))
        return self.dataset_name or field.removesuffix(f"_{unit_suffix}")

    def of(self, values: Any) -> Variable:
        """Returns the variable of these values."""
        return Variable(tuple(self.axes.split()), values, self.unit, self.about)


class About(NamedTuple):
    """Description of a result field that is not a variable of the dataset: ``parameter: Annotated[Floats, About("value of the key")]``."""

    text: str
    unit: str = ""
    #: Names of the axes, separated by blanks; empty for a value without axes.
    axes: str = ""


def dataset_fields(kind: type) -> dict[str, Along]:
    """Returns the fields of a class that are part of its dataset."""
    hints = get_type_hints(kind, include_extras=True)
    return {field: annotation for field, hint in hints.items() for annotation in get_args(hint)[1:] if isinstance(annotation, Along)}
