"""Spectra of a recorded channel: density, spectrogram, and the lines of its drive."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any, Literal

from . import _core
from ._arguments import optional_si, options
from ._call import recorded
from ._fields import About, Along, Variable
from ._format import html_table
from ._inputs import Measured, recording
from ._issue import Issue, issue_lines, parse_issues
from ._recording import names_of
from ._result import Floats, Result, make_manifest, result_or_raise

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class SpectraResult(Result):
    """Spectra of a channel from overlapping segments; arrays of shape ``(frequency,)``, ``(segment,)`` and ``(order,)``.

    Densities are one-sided: their integral over frequency is the variance. Amplitudes are zero to peak, in the ``unit`` of the channel.
    """

    channel: Annotated[str, About("channel that was transformed")]
    unit: Annotated[str, About("unit of the channel")]
    convention: Annotated[str, About("segments, window and amplitudes in words")]
    segments: Annotated[int, About("number of segments")]
    window: Annotated[str, About("window of a segment")]
    overlap: Annotated[float, About("overlap of adjacent segments, as a share of a segment")]
    segment_s: Annotated[float, Along("", "s", "length of a segment")]
    step_s: Annotated[float, Along("", "s", "time between starts of segments")]
    resolution_hz: Annotated[float, Along("", "Hz", "distance of the lines")]
    mean: Annotated[float, About("mean of the record, in ``unit``, subtracted before the density; the spectrogram includes it, at 0 Hz")]
    frequency_hz: Annotated[Floats, About("frequencies of the lines", "Hz", axes="frequency")]
    density: Annotated[Floats, About("power spectral density (Welch), in ``density_unit``", axes="frequency")]
    peak_frequency_hz: Annotated[Floats, Along("peak", "Hz", "frequency of a peak of the density")]
    peak_density: Annotated[Floats, About("density at the peaks, in ``density_unit``", axes="peak")]
    time_s: Annotated[Floats, About("middle of each segment from the first sample", "s", axes="time")]
    amplitude_peak: Annotated[Floats, About("amplitudes zero to peak of each segment, in ``unit``", axes="time frequency")]
    drive_hz: Annotated[float | None, About("frequency of the drive; ``None`` without one", "Hz")]
    order: Annotated[Floats, About("multiples of the drive below half the sampling rate", axes="order")]
    order_frequency_hz: Annotated[Floats, Along("order", "Hz", "frequency of a multiple of the drive")]
    order_amplitude_peak: Annotated[Floats, About("amplitudes zero to peak at the multiples of the drive, in ``unit``", axes="order")]
    issues: Annotated[list[Issue], About("data-quality issues of the recording")]

    def __len__(self) -> int:
        return len(self.time_s)

    @property
    def density_unit(self) -> str:
        """Unit of the density."""
        if not self.unit:
            return "1/Hz"
        return f"{self.unit}^2/Hz" if self.unit.isalpha() else f"({self.unit})^2/Hz"

    def variance_between(self, low_hz: float, high_hz: float) -> float:
        """Returns the variance between two frequencies: the integral of the density."""
        inside = (self.frequency_hz >= low_hz) & (self.frequency_hz <= high_hz)
        return float(self.density[inside].sum() * self.resolution_hz)

    def _summary(self) -> list[tuple[str, str]]:
        lines = [
            ("channel", f"{self.channel} [{self.unit or 'no unit'}]"),
            ("segments", f"{len(self)} of {self.segment_s:.4g} s, {self.window} window, overlap {self.overlap:g}"),
            ("lines", f"{self.resolution_hz:.4g} Hz apart"),
        ]
        peaks = zip(self.peak_frequency_hz, self.peak_density)
        lines += [("peak", f"{density:.4e} {self.density_unit} at {hz:.5g} Hz") for hz, density in peaks]
        for order, hz, peak in zip(self.order, self.order_frequency_hz, self.order_amplitude_peak):
            lines.append((f"order {order:.4g}", f"{peak:.5e} {self.unit} peak at {hz:.5g} Hz"))
        return lines + issue_lines(self.issues)

    def _repr_html_(self) -> str:
        lines = super()._repr_html_()
        numbers = zip(self.order, self.order_frequency_hz, self.order_amplitude_peak)
        rows = [[f"{order:.4g}", f"{hz:.5g}", f"{peak:.5e}"] for order, hz, peak in numbers]
        return lines + html_table("Orders", ["order", "frequency [Hz]", f"amplitude, peak [{self.unit}]"], rows) if rows else lines

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``frequency``, ``time`` (the middle of each segment) and ``order``."""
        variables = {
            **self._variables(),
            "mean": Variable((), self.mean, self.unit, f"{self.channel}, mean"),
            "density": Variable(("frequency",), self.density, self.density_unit, f"{self.channel}, one-sided power spectral density"),
            "peak_density": Variable(("peak",), self.peak_density, self.density_unit, "density of a peak"),
            "amplitude_peak": Variable(("time", "frequency"), self.amplitude_peak, self.unit, f"{self.channel}, amplitude zero to peak"),
            "order_amplitude_peak": Variable(("order",), self.order_amplitude_peak, self.unit, "amplitude zero to peak at a multiple"),
        }
        coords = {
            "frequency": Variable(("frequency",), self.frequency_hz, "Hz", "frequency"),
            "time": Variable(("time",), self.time_s, "s", "middle of the segment, from the first sample"),
            "order": Variable(("order",), self.order, "1", "multiple of the drive"),
        }
        return self._dataset(variables, coords)

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` of the density, with a row for each line."""
        return self._frame({"frequency_hz": self.frequency_hz, "density": self.density})

    def orders_to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each multiple of the drive."""
        numbers = {"frequency_hz": self.order_frequency_hz, "amplitude_peak": self.order_amplitude_peak}
        return self._frame({"order": self.order, **numbers})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {"density": self.plot_density, "spectrogram": self.plot_spectrogram}

    def plot_density(self, ax: Axes | None = None) -> Axes:
        """Draws the power spectral density; vertical lines mark multiples of the drive."""
        from ._plot.spectra import plot_density

        return plot_density(self, ax)

    def plot_spectrogram(self, ax: Axes | None = None) -> Axes:
        """Draws the amplitudes over time and frequency, up to twice the highest multiple of the drive."""
        from ._plot.spectra import plot_spectrogram

        return plot_spectrogram(self, ax)


@recorded
def spectra(
    record: Measured,
    *,
    sample_rate_hz: Any = None,
    channel: str | None = None,
    drive: Any = None,
    segment: Any = None,
    overlap: float = 0.5,
    window: Literal["hann", "flat-top", "rectangular"] = "hann",
) -> SpectraResult:
    """Computes power spectral density (Welch), order lines and spectrogram of a channel, ``jounce spectra``.

    Amplitudes at the multiples of the ``drive`` are fitted to the complete record, exact where no line is at a bin. A sinusoid between
    two lines shows up to 15 % less under ``"hann"``, at most 0.1 % less under ``"flat-top"``, whose lines are wider.

    References
    ----------
    P. Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70; G. Heinzel, A. Ruediger, R. Schilling (2002).
    """
    input_recording = recording(record, sample_rate_hz)
    given = {
        "channel": channel,
        "drive_hz": optional_si("frequency", drive, "drive"),
        "segment_s": optional_si("time", segment, "segment"),
        "overlap": overlap,
        "window": window,
    }
    fields = SpectraResult._filled(result_or_raise(_core.spectra(input_recording._core(), options(**given))))
    fields["issues"] = [*input_recording.issues, *parse_issues(fields["issues"])]
    return SpectraResult(**{**fields, "manifest": make_manifest("spectra", **names_of([input_recording]), **given)})
