"""Exact response to noise without contact."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Self

import numpy as np

from ._fields import About, Along, Variable
from ._named import Named
from ._result import Floats, Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class NoiseResult(Result, Named[Floats]):
    """Means, mean squares and one-sided power spectral densities of the response to noise without contact.

    Stops are omitted: ``stop_`` fields give the crossing rates of their gaps. Drives other than noise are omitted too, see ``left_out``.
    """

    _noun = "density"

    drive: Annotated[list[str], About("drives with noise")]
    left_out: Annotated[list[str], About("drives that were omitted")]
    mean_power_w: Annotated[float, Along("", "W", "mean power of all loads")]
    load: Annotated[list[str], About("names of the circuits")]
    load_mean_power_w: Annotated[Floats, Along("load", "W", "mean power, by the Lyapunov equation")]
    load_spectral_power_w: Annotated[
        Floats,
        Along("load", "W", "mean power, by the integral over frequency", detail="the other value is computed from the Lyapunov equation"),
    ]
    load_difference_relative: Annotated[Floats, Along("load", "1", "difference of the two relative to the first")]
    load_voltage_rms_v: Annotated[Floats, Along("load", "V", "voltage, rms")]
    load_noise_bandwidth_hz: Annotated[Floats, Along("load drive", "Hz", "noise bandwidth of the voltage per unit of a drive")]
    load_statistical_bandwidth_hz: Annotated[Floats, Along("load", "Hz", "statistical bandwidth of the voltage")]
    patch: Annotated[list[str], About("names of the patches")]
    patch_voltage_rms_v: Annotated[Floats, Along("patch", "V", "voltage, rms")]
    point: Annotated[list[str], About("names of the points")]
    point_displacement_rms_m: Annotated[Floats, Along("point", "m", "displacement, rms about its mean")]
    point_velocity_rms_m_s: Annotated[Floats, Along("point", "m/s", "velocity, rms")]
    stop: Annotated[list[str], About("names of the stops")]
    stop_gap_m: Annotated[Floats, Along("stop", "m", "gap")]
    stop_mean_m: Annotated[Floats, Along("stop", "m", "mean displacement towards the stop")]
    stop_displacement_rms_m: Annotated[Floats, Along("stop", "m", "displacement towards the stop, rms about its mean")]
    stop_reached_hz: Annotated[
        Floats,
        Along(
            "stop",
            "1/s",
            "crossing rate of the gap without contact",
            detail="NaN where a noise moves only one side of the gap, with growing variance",
        ),
    ]
    stop_share_beyond: Annotated[
        Floats,
        Along(
            "stop",
            "1",
            "share of the time beyond the gap",
            detail="NaN where a noise moves only one side of the gap, with growing variance",
        ),
    ]
    stop_carried_by: Annotated[list[str | None], About("noise that moves only one side of the gap; ``None`` for the other stops")]
    frequency_hz: Annotated[Floats, About("frequencies of the densities, closer about each resonance", "Hz", axes="frequency")]
    densities: Annotated[
        dict[str, Floats],
        About(
            'one-sided density of each output by name, ``"mfc.voltage"``, ``"beam.tip.displacement"``, of shape ``(frequency,)``, in '
            "``units``"
        ),
    ]
    units: Annotated[dict[str, str], About('unit of each density, ``"V^2/Hz"``')]

    @classmethod
    def _from_core(cls, fields: dict[str, Any]) -> Self:
        densities, drives = fields.pop("densities"), fields.pop("drives")
        by_name = {"densities": {k: v for k, (v, _) in densities.items()}, "units": {k: unit for k, (_, unit) in densities.items()}}
        return super()._from_core(cls._filled({**fields, **by_name, "drive": drives}))

    def _named(self) -> Mapping[str, Floats]:
        return self.densities

    def _summary(self) -> list[tuple[str, str]]:
        loads = zip(self.load, self.load_voltage_rms_v, self.load_difference_relative, self.load_statistical_bandwidth_hz)
        points = zip(self.point, self.point_displacement_rms_m, self.point_velocity_rms_m_s)
        stops = zip(self.stop, self.stop_gap_m, self.stop_reached_hz, self.stop_share_beyond)
        return [
            ("mean power", f"{self.mean_power_w:.6e} W"),
            *(
                (f"load {name}", f"{volts:.6g} V rms, {width:.4g} Hz wide; powers by two methods differ by {difference:.1e}")
                for name, volts, difference, width in loads
            ),
            *((f"patch {name}", f"{volts:.6g} V rms") for name, volts in zip(self.patch, self.patch_voltage_rms_v)),
            *((f"point {name}", f"{displacement:.4e} m rms, {speed:.4e} m/s rms") for name, displacement, speed in points),
            *((f"drive {name}", "LEFT OUT: not a stationary noise") for name in self.left_out),
            *(
                (
                    f"stop {name}",
                    f"LEFT OUT: gap of {gap:.4g} m reached {rate:.4g} times per second, exceeded for {100 * share:.3g} %"
                    if rate == rate
                    else f"LEFT OUT: a drive moves only one side of its gap of {gap:.4g} m, so there is no crossing rate",
                )
                for name, gap, rate, share in stops
            ),
        ]

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset``: ``density`` over ``output`` and ``frequency``, others over the elements.

        Elements are ``load``, ``drive``, ``patch``, ``point`` and ``stop``.
        """
        density = np.reshape(list(self.densities.values()), (len(self.densities), len(self.frequency_hz)))
        variables = self._variables()
        variables["density"] = Variable(("output", "frequency"), density, "", "one-sided power spectral density, in unit")
        coords = {name: Variable((name,), getattr(self, name), "", name) for name in ("load", "drive", "patch", "point", "stop")}
        coords["output"] = Variable(("output",), list(self.densities), "", "output")
        coords["unit"] = Variable(("output",), [self.units[name] for name in self.densities], "", "unit of the density")
        return self._dataset(variables, {**coords, "frequency": Variable(("frequency",), self.frequency_hz, "Hz", "frequency")})

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` of the densities, with a row for each frequency."""
        return self._frame({"frequency_hz": self.frequency_hz, **self.densities})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {name: partial(self.plot_noise, density=name) for name in self.densities}

    def plot_noise(self, ax: Axes | None = None, density: str | None = None) -> Axes:
        """Draws a power spectral density, by default of the first voltage (else of the first output)."""
        from ._plot.noise import plot_noise

        first = next((name for name in self.densities if name.endswith("voltage")), next(iter(self.densities)))
        return plot_noise(self, ax, first if density is None else density)
