"""Mean power of recorded voltages."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Annotated, Any

from . import _core
from ._arguments import optional_si, options, to_si
from ._call import recorded
from ._fields import About, Along, Variable
from ._format import html_table, with_uncertainty
from ._inputs import Measured, recordings
from ._issue import Issue, issue_lines, parse_issues
from ._recording import names_of
from ._result import Floats, Integers, Result, Truths, make_manifest, result_or_raise
from ._signal import Spectrum

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class PowerResult(Result):
    """Mean power of each record with its interval; arrays of shape ``(record,)`` and, for amplitudes at orders, ``(record, order)``."""

    record: Annotated[list[str], About("names of the recordings")]
    channel: Annotated[list[str], About("voltage channel of each recording")]
    resistance_ohm: Annotated[Floats, Along("record", "ohm", "resistance of the load")]
    mean_power_w: Annotated[Floats, Along("record", "W", "mean power")]
    half_width_w: Annotated[Floats, Along("record", "W", "half width of its 95 % interval")]
    batches: Annotated[Integers, Along("record", "1", "number of batches of the interval")]
    batch_correlation: Annotated[Floats, Along("record", "1", "correlation of neighbouring batches")]
    effective_samples: Annotated[Floats, Along("record", "1", "effective number of independent values", detail="at most 256")]
    correlated: Annotated[Truths, Along("record", "1", "True where the record is too short and its interval too narrow")]
    mean_voltage_v: Annotated[Floats, Along("record", "V", "mean of the voltage")]
    mean_square_base_acceleration_m2_s4: Annotated[
        Floats, Along("record", "m^2/s^4", "mean square of the base's acceleration", detail="NaN where no base channel was named")
    ]
    mean_power_per_mean_square_w_s4_m2: Annotated[
        Floats, Along("record", "W s^4/m^2", "mean power per mean square of it", detail="NaN where no base channel was named")
    ]
    order: Annotated[Floats, About("multiples of the drive; empty without a drive", axes="order")]
    order_amplitude_peak_v: Annotated[
        Floats, Along("record order", "V", "amplitude zero to peak at a multiple of the drive", detail="NaN above half the sampling rate")
    ]
    spectra: Annotated[list[Spectrum], About("spectrum of each voltage, Hann window")]
    issues: Annotated[list[Issue], About("data-quality issues of the recordings")]

    def __len__(self) -> int:
        return len(self.record)

    def _summary(self) -> list[tuple[str, str]]:
        lines = []
        for k, name in enumerate(self.record):
            mean = with_uncertainty(self.mean_power_w[k], self.half_width_w[k], "W")
            power = f"{mean} (95 %) in {self.resistance_ohm[k]:g} ohm"
            lines.append((name, power + (", interval too narrow: the record is too short" if self.correlated[k] else "")))
        return lines + issue_lines(self.issues)

    def _repr_html_(self) -> str:
        rows = [
            [name, f"{self.resistance_ohm[k]:g}", f"{self.mean_power_w[k]:.5e}", f"{self.half_width_w[k]:.1e}"]
            for k, name in enumerate(self.record)
        ]
        return html_table("Measured power", ["record", "load [ohm]", "mean power [W]", "± 95 % [W]"], rows)

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``record`` and ``order``."""
        coords = {
            "record": Variable(("record",), self.record, "", "recording"),
            "order": Variable(("order",), self.order, "1", "multiple of the drive"),
        }
        return self._dataset(self._variables(), coords)

    def _parts(self) -> dict[str, Dataset]:
        return {f"spectrum_{number}": one.to_xarray() for number, one in enumerate(self.spectra)}

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each record."""
        return self._frame({"record": self.record, "channel": self.channel, **self._columns("record")})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {"mean_power_w": self.plot_power, "spectra": self.plot_spectra}

    def plot_power(self, ax: Axes | None = None) -> Axes:
        """Draws mean power over the load with its intervals, per mean square of the base acceleration where that is known."""
        from ._plot.power import plot_power

        return plot_power(self, ax)

    def plot_spectra(self, ax: Axes | None = None) -> Axes:
        """Draws the spectra of the voltages."""
        from ._plot.power import plot_spectra

        return plot_spectra(self, ax)


@recorded
def power(
    records: Measured,
    resistance: Any,
    *,
    sample_rate_hz: Any = None,
    voltage: str | None = None,
    base: str | None = None,
    drive: Any = None,
    remove_mean: bool = False,
) -> PowerResult:
    """Computes the mean power of a voltage over a ``resistance``, with a confidence interval that accounts for correlation.

    A list of SEP005 time series is one recording.
    """
    inputs = recordings(records, sample_rate_hz)
    is_list = isinstance(resistance, Sequence) and not isinstance(resistance, str)
    given: dict[str, Any] = {
        "resistance_ohm": [to_si("resistance", one, "resistance") for one in (resistance if is_list else [resistance])],
        "voltage": voltage,
        "base": base,
        "drive_hz": optional_si("frequency", drive, "drive"),
        "remove_mean": remove_mean,
    }
    fields = PowerResult._filled(result_or_raise(_core.power([one._core() for one in inputs], options(**given))))
    manifest = make_manifest("power", **names_of(inputs), **given)
    labels = (f"{record}, {channel}" for record, channel in zip(fields["record"], fields["channel"]))
    fields["spectra"] = [Spectrum(manifest, label, "V", **one) for label, one in zip(labels, fields["spectra"])]
    fields["issues"] = [*(issue for one in inputs for issue in one.issues), *parse_issues(fields["issues"])]
    return PowerResult(**{**fields, "manifest": manifest})
