"""Spectra of sampled signals, and files of recorded drives."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from . import _core
from ._arguments import rate_hz
from ._call import recorded
from ._errors import ArgumentError
from ._fields import About, Variable
from ._files import write_whole
from ._quantity import is_quantity, unit_of
from ._result import Floats, Result, make_manifest
from ._samples import check_samples
from ._sep005 import check_series, even_rate_hz, numbers

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Spectrum(Result):
    """Amplitudes (zero to peak) over frequency, Hann window."""

    name: Annotated[str, About("name of the signal")]
    unit: Annotated[str, About("unit of the signal")]
    frequency_hz: Annotated[Floats, About("frequencies of the lines", "Hz", axes="frequency")]
    amplitude_peak: Annotated[Floats, About("amplitudes zero to peak, in ``unit``", axes="frequency")]

    def _summary(self) -> list[tuple[str, str]]:
        highest = int(np.argmax(self.amplitude_peak))
        return [
            ("signal", self.name),
            ("highest line", f"{self.amplitude_peak[highest]:.5g} {self.unit} at {self.frequency_hz[highest]:.5g} Hz"),
            ("resolution", f"{self.frequency_hz[1] - self.frequency_hz[0]:g} Hz"),
        ]

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``frequency``."""
        amplitude = Variable(("frequency",), self.amplitude_peak, self.unit, f"{self.name}, amplitude zero to peak")
        return self._dataset({"amplitude_peak": amplitude}, {"frequency": Variable(("frequency",), self.frequency_hz, "Hz", "frequency")})

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each line."""
        return self._frame({"frequency_hz": self.frequency_hz, "amplitude_peak": self.amplitude_peak})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {"amplitude": self.plot_spectrum}

    def plot_spectrum(self, ax: Axes | None = None) -> Axes:
        """Draws the spectrum."""
        from ._plot.history import plot_spectrum

        return plot_spectrum(self, ax)


@recorded
def spectrum(values: Any, sample_rate_hz: float | None = None, *, name: str = "signal", unit: str = "") -> Spectrum:
    """Computes the amplitude spectrum of evenly spaced samples, or of a time series in the form of SEP005."""
    row, row_rate_hz = _samples(values, sample_rate_hz)
    if isinstance(values, Mapping):
        name, unit = values["name"], values["unit_str"]
    elif is_quantity(values):
        unit = unit_of(values)
    frequency_hz, amplitude_peak = _core.spectrum(row, row_rate_hz)
    return Spectrum(make_manifest("spectrum"), name, unit, frequency_hz, amplitude_peak)


def write_recording(path: str | PathLike[str], values: Any, sample_rate_hz: float | None = None) -> None:
    """Writes evenly spaced samples, or a time series in the form of SEP005, as the CSV file of a recorded drive.

    ``jounce.Drive(kind="base-acceleration", signal="recording", file=PATH)`` reads the file. Values without a unit are in SI, or in
    that of ``unit=``.
    """
    if Path(path).suffix.lower() != ".csv":
        raise ArgumentError(f"{fspath(path)} is written as CSV; give a name that ends in .csv", {"path": fspath(path)})
    row, row_rate_hz = _samples(values, sample_rate_hz)
    unit = values["unit_str"] if isinstance(values, Mapping) else unit_of(values) if is_quantity(values) else ""
    if len(row) < 2:
        raise ArgumentError("a recording needs at least two samples")
    times = np.arange(len(row)) / row_rate_hz
    head = f"time (s),value ({unit})" if unit else "time (s),value"
    lines = (f"{time!r},{value!r}\n" for time, value in zip(times.tolist(), row.tolist()))
    write_whole(path, "the recording", lambda file: file.write("".join([head, "\n", *lines]).encode()))


def _samples(values: Any, sample_rate_hz: float | None) -> tuple[Floats, float]:
    """Returns samples and their rate, Hz."""
    if isinstance(values, Mapping):
        values, sample_rate_hz = check_series(values)["data"], even_rate_hz(values)
    row = numbers(values, "the samples")
    check_samples([("the signal", row)])
    return row, rate_hz(sample_rate_hz)
