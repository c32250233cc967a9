"""Files of instruments."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from . import _core
from ._arguments import options, rate_hz
from ._call import recorded
from ._errors import ArgumentError
from ._fields import About, Variable
from ._format import counted, html_table
from ._issue import Issue, issue_lines, parse_issues
from ._recording import Recording, digest_of
from ._result import Complexes, Data, Floats, Integers, Result, make_manifest

if TYPE_CHECKING:
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False)
class ModeShape(Data):
    """Mode shape of a UFF file: natural frequency, Hz, damping ratio, modal mass, NaN where not given, and the shape at each node."""

    frequency_hz: Annotated[float, About("natural frequency", "Hz")]
    damping_ratio: Annotated[float, About("damping ratio, 1 = critical")]
    modal_mass: Annotated[float, About("modal mass of a normal mode, in units of the file")]
    node: Annotated[Integers, About("numbers of the nodes", axes="node")]
    shape: Annotated[Complexes, About("components at each node", axes="node component")]


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class RecordedFile(Result):
    """Contents of a file: recordings, one for each grid of time or frequency, and mode shapes; can be iterated."""

    name: Annotated[str, About("name of the file")]
    recordings: Annotated[list[Recording], About("recordings of the file")]
    shapes: Annotated[list[ModeShape], About("mode shapes of a UFF file")]
    issues: Annotated[list[Issue], About("issues of the complete file")]

    def __len__(self) -> int:
        return len(self.recordings)

    def __iter__(self) -> Iterator[Recording]:
        return iter(self.recordings)

    def __getitem__(self, number: int) -> Recording:
        return self.recordings[number]

    @property
    def over_time(self) -> Recording:
        """First recording over time."""
        for one in self.recordings:
            if one.over == "time":
                return one
        raise ArgumentError(f"{self.name} contains no recording over time")

    def _summary(self) -> list[tuple[str, str]]:
        lines = [("file", self.name)]
        lines += [(one.name, f"{counted(one.samples, 'sample')} over {one.over} of {', '.join(one)}") for one in self.recordings]
        lines += [("shape", f"at {one.frequency_hz:g} Hz, {len(one.node)} nodes") for one in self.shapes]
        return lines + issue_lines([*self.issues, *(issue for one in self.recordings for issue in one.issues)])

    def _table(self) -> dict[str, list[Any]]:
        pairs = [(one, channel) for one in self.recordings for channel in one.channels]
        return {
            "recording": [one.name for one, _ in pairs],
            "channel": [channel.name for _, channel in pairs],
            "quantity": [channel.quantity for _, channel in pairs],
            "unit": [channel.unit for _, channel in pairs],
            "rms": [channel.rms for _, channel in pairs],
            "peak": [channel.peak for _, channel in pairs],
            "rate": [one.rate for one, _ in pairs],
        }

    def _repr_html_(self) -> str:
        table = self._table()
        return html_table(self.name, list(table), list(zip(*table.values())))

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        several = len(self.recordings) > 1
        return {
            f"{number}.{name}" if several else name: draw
            for number, one in enumerate(self.recordings, 1)
            for name, draw in one._pictures().items()
        }

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``channel`` that lists the channels; each recording has a dataset of its samples."""
        dims = ("channel",)
        variables = {name: Variable(dims, values, "", name) for name, values in self._table().items() if name != "channel"}
        return self._dataset(variables, {"channel": Variable(dims, self._table()["channel"], "", "channel")})

    def _parts(self) -> dict[str, Dataset]:
        return {f"recording_{number}": one.to_xarray() for number, one in enumerate(self.recordings)}

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each channel; each recording has a frame of its samples."""
        return self._frame(self._table())


@recorded
def read_recordings(path: str | PathLike[str], *, sample_rate_hz: Any = None) -> RecordedFile:
    """Reads a file of an instrument: CSV and text with any header, Parquet, NPY, NPZ, MAT, HDF5, TDMS, WAV, UFF 55, 58 and 58b, LVM.

    Notes in ``FILE.channels.toml`` next to the file add data that the file lacks. Every data-quality issue is an :class:`Issue`.
    """
    given = {"sample_rate_hz": None if sample_rate_hz is None else rate_hz(sample_rate_hz)}
    contents = _core.recording_read(fspath(path), options(**given))
    name = Path(path).name
    manifest = make_manifest("read", recording=name, recording_sha256=digest_of(path), **given)
    recordings = [Recording._from_core_recording(one, manifest) for one in contents["recordings"]]
    shapes = [_shape(one) for one in contents["shapes"]]
    return RecordedFile(manifest, name, recordings, shapes, parse_issues(contents["issues"]))


def _shape(contents: dict[str, Any]) -> ModeShape:
    real: Floats = contents["real"]
    scalars = {name: contents[name] for name in ("frequency_hz", "damping_ratio", "modal_mass")}
    return ModeShape(**scalars, node=contents["node"], shape=real + 1j * contents["imaginary"])
