"""Recordings: channels in SI units over time or frequency."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from os import PathLike, fspath
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

import numpy as np

from . import _core
from ._errors import ArgumentError
from ._fields import About, Variable
from ._format import counted, html_table
from ._issue import Issue, issue_lines, parse_issues
from ._named import Named, look_up
from ._result import Complexes, Data, Floats, Result, make_manifest
from ._samples import check_samples

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset

    from ._contact import ContactResult
    from ._power import PowerResult
    from ._segments import SegmentsResult
    from ._spectra import SpectraResult


@dataclasses.dataclass(frozen=True, eq=False)
class Channel(Data):
    """Samples of one quantity at one place."""

    name: Annotated[str, About("name of the channel")]
    quantity: Annotated[str, About('``"acceleration"``, ``"voltage"``, ``"force"``, ..., ``"unknown"`` where the file does not give it')]
    unit: Annotated[str, About("SI unit; unchanged where the quantity is unknown")]
    place: Annotated[str, About("place of the sensor; empty where unknown")]
    direction: Annotated[str, About("direction of the sensor; empty where unknown")]
    reference: Annotated[str, About('place and direction of the force of a response function, ``"node 3 +z"``; empty where unknown')]
    values: Annotated[Floats | Complexes, About("samples, in ``unit``; NaN for a missing sample", axes="sample")]

    @property
    def rms(self) -> float:
        """Rms of the valid samples."""
        finite, peak = self.values[np.isfinite(self.values)], self.peak
        # Scaled by the peak, so that no square overflows.
        return peak * float(np.sqrt(np.mean(np.abs(finite / peak) ** 2))) if peak > 0.0 else 0.0

    @property
    def peak(self) -> float:
        """Largest magnitude of the valid samples."""
        return float(np.max(np.abs(self.values[np.isfinite(self.values)]), initial=0.0))


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Recording(Result, Named[Floats | Complexes]):
    """Channels of equal length over one grid of time or frequency, and their data-quality issues; a mapping of names to samples.

    Returned by :func:`jounce.read_recordings` and ``harvester.rig()``, and by :meth:`Recording.of` from arrays or SEP005 time series.
    """

    _noun = "channel"

    name: Annotated[str, About("name of the recording")]
    over: Annotated[Literal["time", "frequency"], About("axis of the samples")]
    places: Annotated[Floats, About("times or frequencies of the samples, s or Hz", axes="sample")]
    step: Annotated[float | None, About("step between samples, s or Hz; ``None`` where each sample has its own stamp")]
    rate: Annotated[float, About("samples per second, or per hertz")]
    channels: Annotated[list[Channel], About("channels of the recording")]
    issues: Annotated[list[Issue], About("data-quality issues and corrections")]

    @classmethod
    def _from_core_recording(cls, fields: Mapping[str, Any], manifest: Mapping[str, Any]) -> Self:
        """Returns a recording of the compiled module; the manifest gets the digest of the samples where it has no digest of a file."""
        channels = [_channel(one) for one in fields["channels"]]
        recording = cls(**{**fields, "manifest": dict(manifest), "channels": channels, "issues": parse_issues(fields["issues"])})
        options = {"recording": recording.name, "recording_sha256": recording._sha256(), **manifest["options"]}
        return dataclasses.replace(recording, manifest={**manifest, "options": options})

    @classmethod
    def of(
        cls,
        values: Any,
        sample_rate_hz: Any = None,
        *,
        time_s: Any = None,
        frequency_hz: Any = None,
        units: str | Mapping[str, str] | None = None,
        name: str = "recording",
        allow_missing: bool = False,
    ) -> Self:
        """Returns a recording of arrays: one, a dict of them by channel, a SEP005 time series, or a list of these; or of a history.

        Arrays of xarray and pandas bring their names, their times or frequencies, and the units in their ``attrs``; arrays of pint bring
        their units. Arguments must not contradict them. ``units`` is the unit of one array, or of each channel, as an instrument writes it
        (``"g"``, ``"m/s2"``, ``"lbf"``); values are converted to SI. The sampling is given by ``sample_rate_hz``, or by ``time_s``, which
        is checked for jitter and gaps. With ``frequency_hz`` the values are accelerations per force, complex and for ``e^{+i w t}``.

        Samples that are NaN, masked, infinite or too large to be squared are refused. With ``allow_missing`` NaN and masked samples are
        missing samples: analyses interpolate them linearly and report it in ``issues``, as for a file.
        """
        from ._inputs import recording_from_arrays

        grid = {"sample_rate_hz": sample_rate_hz, "time_s": time_s, "frequency_hz": frequency_hz}
        fields = _core.recording_from_arrays(recording_from_arrays(values, grid, units, name))
        recording = cls._from_core_recording(fields, make_manifest("read"))
        check_samples(recording.items(), allow_missing=allow_missing)
        return recording

    @property
    def samples(self) -> int:
        """Number of samples of each channel."""
        return len(self.places)

    def _named(self) -> Mapping[str, Floats | Complexes]:
        return {one.name: one.values for one in self.channels}

    def channel(self, name: str | int) -> Channel:
        """Returns the channel of a name, or of a number from 1."""
        by_name = {one.name: one for one in self.channels}
        by_number = {str(number): one for number, one in enumerate(self.channels, 1)}
        return by_name[str(name)] if str(name) in by_name else by_number.get(str(name)) or look_up(by_name, str(name), "channel")

    def _core(self) -> dict[str, Any]:
        """Returns the recording in the form of the compiled module."""

        def channel_fields(one: Channel) -> dict[str, Any]:
            values = np.asarray(one.values)
            imaginary = values.imag if np.iscomplexobj(values) else None
            fields = ("name", "quantity", "unit", "place", "direction", "reference")
            return {**{field: getattr(one, field) for field in fields}, "values": values.real, "imaginary": imaginary}

        channels = [channel_fields(one) for one in self.channels]
        return {"name": self.name, "over": self.over, "places": self.places, "step": self.step, "channels": channels}

    def _sha256(self) -> str:
        import hashlib

        digest = hashlib.sha256(np.ascontiguousarray(self.places).data)
        for one in self.channels:
            digest.update(f"{one.name}\0{one.unit}\0".encode())
            digest.update(np.ascontiguousarray(one.values).data)
        return digest.hexdigest()

    def even(self) -> Self:
        """Returns the recording at even steps without missing samples, by linear interpolation; ``issues`` lists the corrections."""
        even_recording = type(self)._from_core_recording(_core.recording_even(self._core()), self.manifest)
        return dataclasses.replace(even_recording, issues=[*self.issues, *even_recording.issues])

    def power(self, resistance: Any, **options: Any) -> PowerResult:
        """Computes the mean power of a voltage over a resistance; the options are those of :func:`jounce.power`."""
        from ._power import power

        return power(self, resistance, **options)

    def spectra(self, **options: Any) -> SpectraResult:
        """Computes density, order lines and spectrogram of a channel; the options are those of :func:`jounce.spectra`."""
        from ._spectra import spectra

        return spectra(self, **options)

    def contact(self, **options: Any) -> ContactResult:
        """Fits contact laws to the force pulses; the options are those of :func:`jounce.contact`."""
        from ._contact import contact

        return contact(self, **options)

    def segments(self, drive: Any, **options: Any) -> SegmentsResult:
        """Cuts the recording into segments of one attractor each; the options are those of :func:`jounce.segments`."""
        from ._segments import segments

        return segments(self, drive, **options)

    def write(self, path: str | PathLike[str]) -> None:
        """Writes the recording in SI, in the format of the ending: ``.uff`` (UFF 58 in ASCII), ``.parquet`` or ``.csv``."""
        _core.recording_write(self._core(), fspath(path))

    def to_sep005(self) -> list[dict[str, Any]]:
        """Returns every channel as a time series in the form of SEP005."""
        if self.over != "time":
            raise ArgumentError(f"{self.name} is over {self.over}; a SEP005 time series is over time")
        common = {"time": self.places, "fs": self.rate}
        return [{"name": one.name, "data": one.values, "unit_str": one.unit, **common} for one in self.channels]

    def _grid(self) -> tuple[str, str, str]:
        return ("time", "time_s", "s") if self.over == "time" else ("frequency", "frequency_hz", "Hz")

    def _summary(self) -> list[tuple[str, str]]:
        _, _, unit = self._grid()
        lines = [("name", self.name), ("samples", f"{self.samples} over {self.over}, {self.rate:.6g} per {unit}")]
        lines += [(one.name, f"rms {one.rms:.5e}, peak {one.peak:.5e} {one.unit or '(no unit)'}") for one in self.channels]
        return lines + issue_lines(self.issues)

    def _repr_html_(self) -> str:
        rows = [[one.name, one.quantity, one.unit, f"{one.rms:.5e}", f"{one.peak:.5e}"] for one in self.channels]
        issue_table = html_table("", [], [[one.text] for one in self.issues]) if self.issues else ""
        title = f"{self.name}: {counted(self.samples, 'sample')}, {self.rate:.6g} per {self._grid()[2]}"
        return html_table(title, ["channel", "quantity", "unit", "rms", "peak"], rows) + issue_table

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``time`` or ``frequency`` with a variable for each channel."""
        axis, _, unit = self._grid()
        variables = {one.name: Variable((axis,), one.values, one.unit, " ".join([one.name, one.place]).strip()) for one in self.channels}
        return self._dataset(variables, {axis: Variable((axis,), self.places, unit, axis)})

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each sample and a column for each channel; units are in ``attrs["units"]``."""
        units = {self._grid()[1]: self._grid()[2], **{one.name: one.unit for one in self.channels}}
        return self._frame({self._grid()[1]: self.places, **{one.name: one.values for one in self.channels}}, units)

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {name: partial(self.plot_recording, channel=name) for name in self}

    def plot_recording(self, ax: Axes | None = None, channel: str | None = None) -> Axes:
        """Draws a channel, by default the first; a complex one by its magnitude."""
        from ._plot.recording import plot_recording

        return plot_recording(self, ax, self.channels[0] if channel is None else self.channel(channel))


def _channel(fields: Mapping[str, Any]) -> Channel:
    real, imaginary = fields["values"], fields["imaginary"]
    other_fields = {key: value for key, value in fields.items() if key not in ("values", "imaginary")}
    return Channel(**other_fields, values=real if imaginary is None else real + 1j * imaginary)


def digest_of(path: str | PathLike[str]) -> str:
    """Computes the SHA-256 of a file, read in blocks."""
    import hashlib

    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def names_of(recordings: Sequence[Recording]) -> dict[str, str]:
    """Returns the options of a manifest that name the recordings of a result."""
    options = [one.manifest["options"] for one in recordings]
    return {name: " ".join(each[name] for each in options) for name in ("recording", "recording_sha256")}
