"""Bifurcation curves in two keys."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Annotated, Any, Self

import numpy as np

from ._fields import About, Variable
from ._format import counted
from ._result import Data, Floats, Integers, Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False)
class BifurcationCurve(Data):
    """Curve of one kind of bifurcation; arrays of shape ``(point,)`` along it."""

    kind: Annotated[
        str,
        About(
            '``"fold"``, ``"period-doubling"``, ``"neimark-sacker"``, ``"grazing"``, ``"level"``, or ``"peak"``: the largest mean power '
            "along a branch"
        ),
    ]
    level: Annotated[str | None, About("level of the curve as given; ``None`` for other kinds")]
    period_cycles: Annotated[int, About("period in drive cycles")]
    parameter: Annotated[Floats, About("value of the first key", "SI", axes="point")]
    parameter_2: Annotated[Floats, About("value of the second key", "SI", axes="point")]
    mean_power_w: Annotated[Floats, About("mean power of all loads", "W", axes="point")]
    stable: Annotated[
        Integers, About("on a curve of peaks 1 for a stable orbit and 0 for an unstable one; -1 on other curves", axes="point")
    ]
    failures: Annotated[list[str], About("places where continuation stopped early, with the reason")]

    def __len__(self) -> int:
        return len(self.parameter)


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class BifurcationsResult(Result):
    """All curves that were found; can be iterated and indexed by number."""

    key: Annotated[str, About("first key")]
    unit: Annotated[str, About("SI unit of the first key")]
    key_2: Annotated[str, About("second key")]
    unit_2: Annotated[str, About("SI unit of the second key")]
    curves: Annotated[list[BifurcationCurve], About("curves that were found")]
    note: Annotated[str, About("curves that the search may miss, and options that find more")]
    warnings: Annotated[list[str], About("curves that end early")]

    @classmethod
    def _from_core(cls, fields: dict[str, Any]) -> Self:
        return super()._from_core({**fields, "curves": [BifurcationCurve(**one) for one in fields["curves"]]})

    def __len__(self) -> int:
        return len(self.curves)

    def __getitem__(self, number: int) -> BifurcationCurve:
        return self.curves[number]

    def __iter__(self) -> Iterator[BifurcationCurve]:
        return iter(self.curves)

    def _summary(self) -> list[tuple[str, str]]:
        plane = f"{self.key} [{self.unit}] against {self.key_2} [{self.unit_2}]"
        curves = [
            (f"curve {k}", f"{one.level or one.kind} of period {one.period_cycles}, {counted(len(one), 'point')}")
            for k, one in enumerate(self.curves)
        ]
        return [("over", plane), *curves, *(("warning", text) for text in self.warnings), ("note", self.note)]

    def _table(self) -> dict[str, Any]:
        def concatenated(field: str) -> Any:
            return np.concatenate([getattr(one, field) for one in self.curves]) if self.curves else np.empty(0)

        lengths = [len(one) for one in self.curves]
        numbers: Integers = np.repeat(np.arange(len(self), dtype=np.int64), lengths)
        return {
            "curve": numbers,
            "kind": [one.level or one.kind for one in self.curves for _ in range(len(one))],
            "period_cycles": np.repeat(np.array([one.period_cycles for one in self.curves], dtype=np.int64), lengths),
            "parameter": concatenated("parameter"),
            "parameter_2": concatenated("parameter_2"),
            "mean_power_w": concatenated("mean_power_w"),
            "stable": concatenated("stable"),
        }

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``point``: all curves in sequence, numbered by ``curve``."""
        columns = self._table()
        descriptions = {
            "curve": ("curve", "1", "number of the curve"),
            "kind": ("kind", "", "kind of the bifurcation, or the level"),
            "period_cycles": ("period_cycles", "1", "period in drive cycles"),
            "mean_power_w": ("mean_power", "W", "mean power of all loads"),
            "stable": ("stable", "1", "1 for a stable peak; -1 on other curves"),
        }
        dims = ("point",)
        variables = {name: Variable(dims, columns[column], units, text) for column, (name, units, text) in descriptions.items()}
        coords = {
            self.key: Variable(dims, columns["parameter"], self.unit, self.key),
            self.key_2: Variable(dims, columns["parameter_2"], self.unit_2, self.key_2),
        }
        return self._dataset(variables, coords)

    def _root(self) -> Dataset:
        return self._dataset({}, {})

    def _parts(self) -> dict[str, Dataset]:
        alone = (dataclasses.replace(self, curves=[one]).to_xarray() for one in self.curves)
        return {f"curve_{number}": one for number, one in enumerate(alone)}

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each point of each curve."""
        return self._frame(self._table())

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {"curves": self.plot_bifurcations}

    def plot_bifurcations(self, ax: Axes | None = None) -> Axes:
        """Draws the curves over the plane of the two keys."""
        from ._plot.bifurcations import plot_bifurcations

        return plot_bifurcations(self, ax)
