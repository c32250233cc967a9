"""Common base of all results: equality, printing, tables and origin."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Self, TypeVar, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._docstrings import document
from ._errors import Interrupted
from ._fields import About, Variable, dataset_fields
from ._format import html_table
from ._named import look_up
from ._optional import require

if TYPE_CHECKING:
    from pandas import DataFrame
    from xarray import Dataset, DataTree

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Truths = NDArray[np.bool_]
Complexes = NDArray[np.complex128]


#: Result of a long call of the compiled module, if there is one, and the error that ended it early.
CoreResult = tuple[dict[str, Any] | None, BaseException | None]
ResultT = TypeVar("ResultT")


class Data:
    """Plain data that is compared by value, arrays included; its arrays are read-only."""

    def __init_subclass__(cls) -> None:
        # A result comes from a call, not from the package, which documents the names that are used.
        document(cls)

    def __post_init__(self) -> None:
        self._freeze()

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._freeze()

    def _freeze(self) -> None:
        """Makes the arrays read-only, also those in a dict."""
        for value in vars(self).values():
            for one in value.values() if isinstance(value, dict) else (value,):
                if isinstance(one, np.ndarray):
                    one.flags.writeable = False

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        fields = (field.name for field in dataclasses.fields(self) if field.compare)  # type: ignore[arg-type]
        return all(_equal(getattr(self, name), getattr(other, name)) for name in fields)

    __hash__ = None  # type: ignore[assignment]

    @classmethod
    def _filled(cls, fields: dict[str, Any]) -> dict[str, Any]:
        """Returns a dict of the library with NaN for missing numbers, and empty lists and arrays for parts that a harvester lacks."""
        hints = get_type_hints(cls, include_extras=False)
        filled = dict(fields)
        for name, hint in hints.items():
            if hint is float and filled.get(name, 0.0) is None:
                filled[name] = np.nan
            elif get_origin(hint) is list and (name not in filled or isinstance(filled[name], np.ndarray)):
                filled[name] = filled[name].tolist() if name in filled else []
            elif name not in filled and get_origin(hint) is np.ndarray:
                filled[name] = np.array([], dtype=get_args(get_args(hint)[1])[0])
        return filled


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Result(Data):
    """Base class of results: plain data that can be pickled, compared and printed."""

    manifest: Annotated[dict[str, Any], About("origin: program, version, SHA-256 of the spec, command and options")]

    @classmethod
    def _from_core(cls, fields: dict[str, Any]) -> Self:
        """Returns the result of a dict of the library."""
        return cls(**{**fields, "manifest": json.loads(fields["manifest"])})

    @classmethod
    def _from_core_call(cls, core_result: CoreResult) -> Self:
        """Returns the result of a long call; raises the error that ended it early, with the finished part."""
        fields, error = core_result
        result = None if fields is None else cls._from_core(fields)
        if isinstance(error, KeyboardInterrupt):
            raise Interrupted(result) from None
        if error is not None:
            raise error
        assert result is not None, "a call without an error must have a result"
        return result

    #: Call that made the result; no field, so that it takes no part in comparisons.
    _call: ClassVar[Any] = None

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in vars(self).items() if name != "_call"}

    def save(self, path: str | PathLike[str]) -> None:
        """Writes the result with its origin and its call into a file, for :func:`jounce.load` and :func:`jounce.rerun`.

        It replaces a file of that name.
        """
        from ._saved import save

        save(self, path)

    def _summary(self) -> list[tuple[str, str]]:
        """Returns printable lines of name and value."""
        raise NotImplementedError

    def __repr__(self) -> str:
        lines = self._summary()
        width = max((len(name) for name, _ in lines), default=0)
        return "\n".join([f"<jounce.{type(self).__name__}>", *(f"  {name:<{width}}  {value}" for name, value in lines)])

    def _repr_html_(self) -> str:
        return html_table(type(self).__name__, ["", ""], self._summary())

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        """Returns the functions of the axes that draw each quantity, the default first."""
        return {}

    @property
    def quantities(self) -> list[str]:
        """Names that :meth:`plot` accepts as ``quantity``, the default first."""
        return list(self._pictures())

    def plot(self, ax: Any = None, *, quantity: str | None = None, **style: Any) -> Any:
        """Draws a quantity into ``ax``, by default into new axes, and returns the axes.

        ``quantity`` is one of :attr:`quantities`, by default the first. A frequency response has two axes, magnitude and phase; a single
        ``ax`` gets the magnitude. Further keywords are properties of lines of matplotlib: ``color="k"``, ``linestyle=":"``.
        """
        from ._plot.style import draw_with

        pictures = self._pictures()
        name = next(iter(pictures), "") if quantity is None else quantity
        return draw_with(look_up(pictures, name, "quantity"), ax, style)

    def _variables(self) -> dict[str, Variable]:
        """Returns the fields that have a description for a dataset."""
        return {along.name(field): along.of(getattr(self, field)) for field, along in dataset_fields(type(self)).items()}

    def _columns(self, axis: str) -> dict[str, Any]:
        """Returns the fields along one axis, by their own names."""
        return {field: getattr(self, field) for field, along in dataset_fields(type(self)).items() if along.axes == axis}

    def _dataset(self, variables: Mapping[str, Variable], coords: Mapping[str, Variable]) -> Dataset:
        """Returns an xarray.Dataset with units, long names and the manifest in its attributes."""
        xarray = require("xarray", "xarray")

        def with_attrs(variables: Mapping[str, Variable]) -> dict[str, Any]:
            entries = {}
            for name, variable in variables.items():
                # A copy, which can be changed: the arrays of a result are read-only.
                values: Any = np.array(variable.values)
                attrs = {"units": variable.units, "long_name": variable.long_name}
                entries[name] = (variable.dims, values.astype(object) if values.dtype.kind == "U" else values, attrs)
            return entries

        attrs = {"manifest": json.dumps(self.manifest, sort_keys=True), "created_by": "jounce", "version": self.manifest["version"]}
        dataset: Dataset = xarray.Dataset(with_attrs(variables), with_attrs(coords), attrs)
        return dataset

    def to_datatree(self) -> DataTree:
        """Returns an ``xarray.DataTree``: the dataset of :meth:`to_xarray`, and a node for each part of the result.

        Parts are the record of a run, branches, curves, pulses, and the recordings of a file.
        """
        nodes = {"/": self._root(), **self._parts()}
        tree: DataTree = require("xarray", "xarray").DataTree.from_dict(nodes)
        return tree

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset``."""
        raise NotImplementedError

    def _root(self) -> Dataset:
        """Returns the dataset at the root of the tree."""
        return self.to_xarray()

    def _parts(self) -> dict[str, Dataset]:
        """Returns the datasets below the root of the tree, by path."""
        return {}

    def _frame(self, columns: Mapping[str, Any], units: Mapping[str, str] | None = None) -> DataFrame:
        """Returns a pandas.DataFrame with the manifest in its attributes, and the units of its columns where given."""
        frame = require("pandas", "pandas").DataFrame(dict(columns))
        frame.attrs["manifest"] = self.manifest
        if units is not None:
            frame.attrs["units"] = dict(units)
        return frame


def _equal(a: Any, b: Any) -> bool:
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.shape == b.shape and a.dtype == b.dtype and bool(np.array_equal(a, b, equal_nan=a.dtype.kind in "fc"))
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(_equal(a[key], b[key]) for key in a)
    if isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)):
        return len(a) == len(b) and all(map(_equal, a, b))
    return bool(a == b or (a != a and b != b))


def result_or_raise(core_result: tuple[ResultT | None, BaseException | None]) -> ResultT:
    """Returns the result of a long call that has no partial result; raises the error that ended it early."""
    result, error = core_result
    if isinstance(error, KeyboardInterrupt):
        raise Interrupted(None) from None
    if error is not None:
        raise error
    assert result is not None, "a call without an error must have a result"
    return result


def column(rows: Sequence[Mapping[str, Any]], name: str) -> Floats:
    """Returns the numbers of a name in each row; NaN where missing."""
    return np.array([np.nan if row.get(name) is None else row[name] for row in rows], dtype=np.float64)


def make_manifest(command: str, **options: Any) -> dict[str, Any]:
    """Returns the origin of a result that needs no spec; options of ``None`` are those that were not given."""
    string_options = {name: str(value) for name, value in options.items() if value is not None}
    return {"created_by": "jounce", "version": _core.VERSION, "spec_sha256": "", "options": {"command": command, **string_options}}
