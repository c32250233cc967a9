"""Exact response to noise without contact."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from functools import partial
from typing import Annotated, Any, Self

from ._named import Named
from ._result import Along, Floats, Result, Variable


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class NoiseResult(Result, Named[Floats]):
    """Means, mean squares and one-sided power spectral densities of the response to noise without contact.

    Stops are omitted: ``stop_`` fields give the crossing rates of their gaps. Drives other than noise are omitted too, see ``left_out``.
    """

    _noun = "density"

    #: Names of the drives with noise, and of the omitted drives.
    drive: list[str]
    left_out: list[str]
    #: Mean power of all loads, W.
    mean_power_w: Annotated[float, Along("", "W", "mean power of all loads")]
    #: Names of the circuits; arrays of shape ``(load,)``.
    load: list[str]
    #: Mean power by the Lyapunov equation and by the integral over frequency, W, and their difference relative to the first.
    load_mean_power_w: Annotated[Floats, Along("load", "W", "mean power, by the Lyapunov equation")]
    load_spectral_power_w: Annotated[Floats, Along("load", "W", "mean power, by the integral over frequency")]
    load_difference_relative: Annotated[Floats, Along("load", "1", "difference of the two relative to the first")]
    #: Voltage, rms, V.
    load_voltage_rms_v: Annotated[Floats, Along("load", "V", "voltage, rms")]
    #: Noise bandwidth of the voltage per unit of each drive, Hz; of shape ``(load, drive)``.
    load_noise_bandwidth_hz: Annotated[Floats, Along("load drive", "Hz", "noise bandwidth of the voltage per unit of a drive")]
    #: Statistical bandwidth of the voltage, Hz.
    load_statistical_bandwidth_hz: Annotated[Floats, Along("load", "Hz", "statistical bandwidth of the voltage")]
    #: Names of the patches, and their voltages, rms, V; of shape ``(patch,)``.
    patch: list[str]
    patch_voltage_rms_v: Annotated[Floats, Along("patch", "V", "voltage, rms")]
    #: Names of the points; displacement about its mean, rms, m, relative to a moving base, and velocity, rms, m/s.
    point: list[str]
    point_displacement_rms_m: Annotated[Floats, Along("point", "m", "displacement, rms about its mean")]
    point_velocity_rms_m_s: Annotated[Floats, Along("point", "m/s", "velocity, rms")]
    #: Names of the stops; gap, and displacement towards the stop in its absence: mean, and rms about the mean, m; of shape ``(stop,)``.
    stop: list[str]
    stop_gap_m: Annotated[Floats, Along("stop", "m", "gap")]
    stop_mean_m: Annotated[Floats, Along("stop", "m", "mean displacement towards the stop")]
    stop_displacement_rms_m: Annotated[Floats, Along("stop", "m", "displacement towards the stop, rms about its mean")]
    #: Crossing rate of the gap, 1/s, and share of the time beyond it; NaN where a noise moves only one side of the gap, with growing
    #: variance.
    stop_reached_hz: Annotated[Floats, Along("stop", "1/s", "crossing rate of the gap without contact")]
    stop_share_beyond: Annotated[Floats, Along("stop", "1", "share of the time beyond the gap")]
    #: Noise that moves only one side of the gap; ``None`` for the other stops.
    stop_carried_by: list[str | None]
    #: Frequencies of the densities, Hz, closer about each resonance.
    frequency_hz: Floats
    #: Density of each output by name, ``"mfc.voltage"``, ``"beam.tip.displacement"``; of shape ``(frequency,)``.
    densities: dict[str, Floats]
    #: Units of the densities, ``"V^2/Hz"``.
    units: dict[str, str]

    @classmethod
    def _from_core(cls, result: dict[str, Any]) -> Self:
        densities, drives = result.pop("densities"), result.pop("drives")
        by_name = {"densities": {k: v for k, (v, _) in densities.items()}, "units": {k: unit for k, (_, unit) in densities.items()}}
        return super()._from_core(cls._filled({**result, **by_name, "drive": drives}))

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

    def to_xarray(self) -> Any:
        """Returns an ``xarray.Dataset``: densities over ``frequency``, others over ``load``, ``drive``, ``patch``, ``point``, ``stop``."""
        variables = self._variables()
        for name, values in self.densities.items():
            description = f"{name}, one-sided power spectral density"
            variables[f"{name}_psd"] = Variable(("frequency",), values, self.units[name], description)
        coords = {name: Variable((name,), getattr(self, name), "", name) for name in ("load", "drive", "patch", "point", "stop")}
        return self._dataset(variables, {**coords, "frequency": Variable(("frequency",), self.frequency_hz, "Hz", "frequency")})

    def to_pandas(self) -> Any:
        """Returns a ``pandas.DataFrame`` of the densities, with a row for each frequency."""
        return self._frame({"frequency_hz": self.frequency_hz, **self.densities})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {name: partial(self.plot_noise, density=name) for name in self.densities}

    def plot_noise(self, ax: Any = None, density: str | None = None) -> Any:
        """Draws a power spectral density, by default of the first voltage (else of the first output)."""
        from ._plot.noise import plot_noise

        first = next((name for name in self.densities if name.endswith("voltage")), next(iter(self.densities)))
        return plot_noise(self, ax, first if density is None else density)
