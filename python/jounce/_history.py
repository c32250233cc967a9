"""Recorded end of a run."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any

from ._fields import About, Variable
from ._named import look_up
from ._result import Floats, Result
from ._signal import Spectrum, spectrum

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class History(Result):
    """Samples of the exact trajectory: evenly spaced, and (``poincare_``) once per drive cycle, up to the end of the run.

    Arrays have a row for each point, patch, stop or storage and a column for each time.
    """

    point: Annotated[list[str], About("names of the points")]
    patch: Annotated[list[str], About("names of the patches")]
    stop: Annotated[list[str], About("names of the stops")]
    storage: Annotated[list[str], About("names of the rectified circuits with a storage capacitor")]
    sample_rate_hz: Annotated[float, About("sampling rate", "Hz")]
    time_s: Annotated[Floats, About("time since the start of the run", "s", axes="time")]
    displacement_m: Annotated[Floats, About("displacement of each point", "m", axes="point time")]
    velocity_m_s: Annotated[Floats, About("velocity of each point", "m/s", axes="point time")]
    relative_displacement_m: Annotated[Floats, About("displacement towards each stop; contact begins at the gap", "m", axes="stop time")]
    voltage_v: Annotated[Floats, About("voltage of each patch", "V", axes="patch time")]
    force_n: Annotated[Floats, About("contact force of each stop", "N", axes="stop time")]
    storage_voltage_v: Annotated[Floats, About("voltage of each storage capacitor", "V", axes="storage time")]
    poincare_time_s: Annotated[Floats, About("times of the samples once per drive cycle", "s", axes="cycle_time")]
    poincare_displacement_m: Annotated[Floats, About("displacement of each point once per drive cycle", "m", axes="point cycle_time")]
    poincare_velocity_m_s: Annotated[Floats, About("velocity of each point once per drive cycle", "m/s", axes="point cycle_time")]
    poincare_relative_displacement_m: Annotated[
        Floats, About("displacement towards each stop once per drive cycle", "m", axes="stop cycle_time")
    ]
    poincare_voltage_v: Annotated[Floats, About("voltage of each patch once per drive cycle", "V", axes="patch cycle_time")]
    poincare_force_n: Annotated[Floats, About("contact force of each stop once per drive cycle", "N", axes="stop cycle_time")]
    poincare_storage_voltage_v: Annotated[
        Floats, About("voltage of each storage capacitor once per drive cycle", "V", axes="storage cycle_time")
    ]

    def _summary(self) -> list[tuple[str, str]]:
        return [
            ("samples", f"{len(self.time_s)} at {self.sample_rate_hz:g} Hz, from {self.time_s[0]:g} s to {self.time_s[-1]:g} s"),
            ("points", ", ".join(self.point)),
            ("patches", ", ".join(self.patch)),
            ("stops", ", ".join(self.stop)),
        ]

    def channels(self) -> dict[str, tuple[Floats, str]]:
        """Returns channels with units by name: ``"beam.tip.displacement"``, ``"mfc.voltage"``, ``"tip.towards"``, ``"tip.force"``,
        ``"rectifier.storage"``."""
        channels: dict[str, tuple[Floats, str]] = {}
        for row, name in enumerate(self.patch):
            channels[f"{name}.voltage"] = (self.voltage_v[row], "V")
        for row, name in enumerate(self.point):
            channels[f"{name}.displacement"] = (self.displacement_m[row], "m")
            channels[f"{name}.velocity"] = (self.velocity_m_s[row], "m/s")
        for row, name in enumerate(self.stop):
            channels[f"{name}.towards"] = (self.relative_displacement_m[row], "m")
            channels[f"{name}.force"] = (self.force_n[row], "N")
        for row, name in enumerate(self.storage):
            channels[f"{name}.storage"] = (self.storage_voltage_v[row], "V")
        return channels

    def channel(self, name: str | None = None) -> tuple[str, Floats, str]:
        """Returns name, values and unit of a channel; by default the first, which is a voltage if there is a patch."""
        channels = self.channels()
        name = next(iter(channels)) if name is None else name
        return (name, *look_up(channels, name, "channel"))

    def spectrum(self, channel: str | None = None) -> Spectrum:
        """Returns the amplitude spectrum of a channel."""
        name, values, unit = self.channel(channel)
        return spectrum(values, self.sample_rate_hz, name=name, unit=unit)

    def to_sep005(self) -> list[dict[str, Any]]:
        """Returns every channel as a time series in the form of SEP005."""
        common = {"time": self.time_s, "fs": self.sample_rate_hz}
        return [{"name": name, "data": values, "unit_str": unit, **common} for name, (values, unit) in self.channels().items()]

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``time``, ``cycle_time`` (drive cycles), ``point``, ``patch``, ``stop`` and ``storage``."""
        variables: dict[str, Variable] = {}
        for prefix, time in (("", "time"), ("poincare_", "cycle_time")):
            variables |= {
                f"{prefix}displacement": Variable(("point", time), getattr(self, f"{prefix}displacement_m"), "m", "displacement"),
                f"{prefix}velocity": Variable(("point", time), getattr(self, f"{prefix}velocity_m_s"), "m/s", "velocity"),
                f"{prefix}towards": Variable(
                    ("stop", time), getattr(self, f"{prefix}relative_displacement_m"), "m", "displacement towards the stop"
                ),
                f"{prefix}voltage": Variable(("patch", time), getattr(self, f"{prefix}voltage_v"), "V", "voltage"),
                f"{prefix}force": Variable(("stop", time), getattr(self, f"{prefix}force_n"), "N", "contact force"),
                f"{prefix}storage_voltage": Variable(
                    ("storage", time), getattr(self, f"{prefix}storage_voltage_v"), "V", "voltage of the storage"
                ),
            }
        coords = {
            "time": Variable(("time",), self.time_s, "s", "time since the start of the run"),
            "cycle_time": Variable(("cycle_time",), self.poincare_time_s, "s", "time since the start of the run, once per drive cycle"),
            "point": Variable(("point",), self.point, "", "point"),
            "patch": Variable(("patch",), self.patch, "", "patch"),
            "stop": Variable(("stop",), self.stop, "", "stop"),
            "storage": Variable(("storage",), self.storage, "", "storage"),
        }
        return self._dataset(variables, coords)

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each sample and a column for each channel; units are in ``attrs["units"]``."""
        units = {"time_s": "s", **{name: unit for name, (_, unit) in self.channels().items()}}
        return self._frame({"time_s": self.time_s, **{name: values for name, (values, _) in self.channels().items()}}, units)

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {**{name: partial(self.plot_time_history, channel=name) for name in self.channels()}, "poincare": self.plot_poincare}

    def plot_time_history(self, ax: Axes | None = None, channel: str | None = None) -> Axes:
        """Draws a channel over time."""
        from ._plot.history import plot_time_history

        return plot_time_history(self, ax, channel)

    def plot_spectrum(self, ax: Axes | None = None, channel: str | None = None) -> Axes:
        """Draws the amplitude spectrum of a channel."""
        return self.spectrum(channel).plot_spectrum(ax)

    def plot_poincare(self, ax: Axes | None = None, point: str | None = None) -> Axes:
        """Draws velocity over displacement of a point once per drive cycle; an orbit gives one dot for each cycle of its period."""
        from ._plot.history import plot_poincare

        return plot_poincare(self, ax, point)
