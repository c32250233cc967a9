"""Results of a study on disk."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable
from functools import partial
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Self

import numpy as np

from . import _core
from ._errors import ArgumentError, warn_not_settled
from ._fields import About, Along, Variable
from ._format import counted, html_table
from ._grid import on_grid
from ._named import look_up
from ._result import Result

if TYPE_CHECKING:
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True)
class StudyStatus:
    """Progress of a study."""

    study_sha256: Annotated[str, About("digest of all inputs of the table")]
    points: Annotated[int, About("number of points")]
    parts: Annotated[int, About("number of parts")]
    finished: Annotated[int, About("number of finished parts")]
    failed_points: Annotated[int, About("points of the finished parts without a result")]
    damaged: Annotated[list[str], About("files whose contents do not match the part in their name")]
    merged: Annotated[bool, About("True where the merged table exists")]
    warnings: Annotated[list[str], About("gaps of the table, one sentence each")]

    @classmethod
    def read(cls, folder: str | PathLike[str]) -> Self:
        """Returns the status of the study in a folder."""
        return cls(**json.loads(_core.study_status(fspath(folder))))

    @property
    def missing(self) -> int:
        """Number of unfinished parts."""
        return self.parts - self.finished


class StudyResult:
    """Table of a study in a folder, ``jounce.StudyResult("out")``; it is read on access.

    Parameters
    ----------
    folder
        Folder of the study.
    wall_time_s
        Wall time of the integration of runs in the call that returned it, s, summed over all threads and workers; 0 where no part was
        missing.
    """

    def __init__(self, folder: str | PathLike[str], wall_time_s: float = 0.0) -> None:
        self.folder = Path(folder)
        self.wall_time_s = wall_time_s

    @property
    def status(self) -> StudyStatus:
        """Progress of the study."""
        return StudyStatus.read(self.folder)

    @property
    def path(self) -> Path:
        """Merged table, in Parquet."""
        return self.folder / "study.parquet"

    def merge(self) -> Path:
        """Joins the parts written by shards into one table and returns its path. Raises :class:`StudyError` while parts are missing."""
        return _core.study_merge(fspath(self.folder))

    def table(self) -> StudyTable:
        """Returns the merged table, in memory."""
        if not self.path.exists():
            raise ArgumentError(f"the study in {self.folder} lacks {self.status.missing} parts; run it first")
        columns, notes, manifest = _core.table_read(fspath(self.path))
        table = StudyTable(json.loads(manifest), columns, notes)
        if table._transient():
            warn_not_settled(f"{table._transient()} of {len(table)} points of the study have not settled")
        return table

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each point."""
        return self.table().to_pandas()

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset``, see :meth:`StudyTable.to_xarray`."""
        return self.table().to_xarray()

    def plot(self, ax: Any = None, *, quantity: str | None = None, **style: Any) -> Any:
        """Draws a column of the table, see :meth:`Result.plot`."""
        return self.table().plot(ax, quantity=quantity, **style)

    def __len__(self) -> int:
        return self.status.points

    def __repr__(self) -> str:
        status = self.status
        failed = f", {status.failed_points} without a result" if status.failed_points else ""
        parts, points = f"{status.finished} of {counted(status.parts, 'part')}", counted(status.points, "point")
        return f"<jounce.StudyResult in {self.folder}: {parts}, {points}{failed}>"


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class StudyTable(Result):
    """Columns by name: ``point``, the varied keys in SI units, the numbers of the quantity, ``failure``; ``table["mean_power_w"]``."""

    columns: Annotated[dict[str, Any], About("arrays by name, each of shape ``(point,)``")]
    notes: Annotated[dict[str, tuple[str, str]], About("unit and meaning of each column")]

    def __len__(self) -> int:
        return len(self.columns["point"])

    def __getitem__(self, name: str) -> Any:
        return look_up(self.columns, name, "column")

    @property
    def keys(self) -> list[str]:
        """Varied keys."""
        return [name for name, (_, about) in self.notes.items() if about == "varied key"]

    def _summary(self) -> list[tuple[str, str]]:
        failed = sum(1 for text in self.columns["failure"] if text)
        lines = [("points", f"{len(self)}, {failed} without a result"), ("varied", ", ".join(self.keys))]
        return [*lines, ("NOT settled", counted(self._transient(), "point"))] if self._transient() else lines

    def _transient(self) -> int:
        """Returns the number of points that have not settled, although their drives have a common period."""
        if "settled" not in self.columns or "period_cycles" not in self.columns:
            return 0
        return int(np.sum((np.asarray(self.columns["settled"]) == 0) & (np.asarray(self.columns["period_cycles"]) > 0)))

    def _repr_html_(self) -> str:
        columns = [name for name in self.columns if name != "failure"]
        rows = [[f"{self.columns[name][k]:.6g}" for name in columns] for k in range(min(len(self), 20))]
        return html_table(f"The first of {len(self)} points", columns, rows)

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over the varied keys; over ``point`` where the points are not all combinations of their values."""
        variables, coords = {}, {}
        for name, values in self.columns.items():
            unit, about = self.notes[name]
            if name in self.keys:
                coords[name] = Variable(("point",), values, unit or "1", name)
            else:
                variables[Along("", unit, "").name(name)] = Variable(("point",), values, unit or "1", about)
        grid_coords, variables = on_grid(coords, variables, complete=True)
        return self._dataset(variables, grid_coords)

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each point."""
        return self._frame(self.columns)

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        from ._plot.study import plot_study

        drawn = [name for name, values in self.columns.items() if np.asarray(values).dtype.kind in "biuf"]
        names = [name for name in drawn if name not in (*self.keys, "point")]
        return {name: partial(plot_study, self, quantity=name) for name in names}
