"""What a study has found, on disk."""

from __future__ import annotations

import dataclasses
import json
from os import PathLike, fspath
from pathlib import Path
from typing import Any, Self

from . import _core
from .errors import ArgumentError
from .result import Result, Variable, html_table


@dataclasses.dataclass(frozen=True)
class StudyStatus:
    """How far a study is."""

    study_sha256: str
    points: int
    parts: int
    #: Parts that are there, and points of them without an answer.
    finished: int
    failed_points: int
    #: Files that are not the part that their name says.
    damaged: list[str]
    #: Is the merged table there?
    merged: bool

    @classmethod
    def read(cls, folder: str | PathLike[str]) -> Self:
        """The status of the study in a folder."""
        return cls(**json.loads(_core.study_status(fspath(folder))))

    @property
    def missing(self) -> int:
        """Parts that are not there yet."""
        return self.parts - self.finished


class StudyResult:
    """The table of a study in a folder, ``jounce.StudyResult("out")``: read when it is asked for.

    ``wall_time_s`` is the wall time of the marching of runs in the call that gave it, s, summed over all threads and workers; 0 where no
    part was missing.
    """

    def __init__(self, folder: str | PathLike[str], wall_time_s: float = 0.0) -> None:
        self.folder = Path(folder)
        self.wall_time_s = wall_time_s

    @property
    def status(self) -> StudyStatus:
        """How far the study is."""
        return StudyStatus.read(self.folder)

    @property
    def path(self) -> Path:
        """The merged table, in Parquet."""
        return self.folder / "study.parquet"

    def merge(self) -> Path:
        """Joins the parts that shards have written to one table; its path. Raises :class:`StudyError` while parts are missing."""
        return _core.study_merge(fspath(self.folder))

    def table(self) -> StudyTable:
        """The merged table, in memory."""
        if not self.path.exists():
            raise ArgumentError(f"the study in {self.folder} has {self.status.missing} parts missing: run it first")
        columns, notes, manifest = _core.table_read(fspath(self.path))
        return StudyTable(json.loads(manifest), columns, notes)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each point."""
        return self.table().to_pandas()

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over ``point``."""
        return self.table().to_xarray()

    def __len__(self) -> int:
        return self.status.points

    def __repr__(self) -> str:
        status = self.status
        return f"<jounce.StudyResult in {self.folder}: {status.finished} of {status.parts} parts, {status.points} points>"


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class StudyTable(Result):
    """Columns by name: ``point``, the varied keys in SI units, the numbers of the quantity, ``failure``; ``table["mean_power_w"]``."""

    columns: dict[str, Any]
    #: Unit and meaning of each column.
    notes: dict[str, tuple[str, str]]

    def __len__(self) -> int:
        return len(self.columns["point"])

    def __getitem__(self, name: str) -> Any:
        if name not in self.columns:
            raise ArgumentError(f"{name}: no such column; there are {', '.join(self.columns)}")
        return self.columns[name]

    @property
    def keys(self) -> list[str]:
        """The keys that were varied."""
        return [name for name, (_, about) in self.notes.items() if about == "varied key"]

    def _summary(self) -> list[tuple[str, str]]:
        failed = sum(1 for text in self.columns["failure"] if text)
        return [("points", f"{len(self)}, {failed} without an answer"), ("varied", ", ".join(self.keys))]

    def _repr_html_(self) -> str:
        shown = [name for name in self.columns if name != "failure"]
        rows = [[f"{self.columns[name][k]:.6g}" for name in shown] for k in range(min(len(self), 20))]
        return html_table(f"The first of {len(self)} points", shown, rows)

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over ``point``, the varied keys as further coordinates."""
        made = {
            name: Variable(("point",), values, self.notes[name][0] or "1", self.notes[name][1] if name not in self.keys else name)
            for name, values in self.columns.items()
        }
        coords = {name: made.pop(name) for name in ["point", *self.keys]}
        return self._dataset(made, coords)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each point."""
        return self._frame(self.columns)
