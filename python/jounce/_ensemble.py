"""Ensembles of realisations of noise."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any, Self

from ._errors import ArgumentError
from ._fields import About, Along, Variable
from ._result import Floats, Integers, Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class EnsembleResult(Result):
    """Means over realisations of noise with their 95 % intervals; arrays of shape ``(member,)``, and of the stops ``(stop,)``.

    The half width of an interval that cannot be estimated is NaN.
    """

    mean_power_w: Annotated[float, Along("", "W", "mean power of all loads")]
    mean_power_half_width_w: Annotated[float, Along("", "W", "half width of its 95 % interval")]
    relative_width: Annotated[float, Along("", "1", "half width over the mean power")]
    interval_over: Annotated[str, About('basis of the interval: ``"members"``, or ``"batches"`` of them where they are few')]
    reached: Annotated[
        bool, Along("", "1", "the required width was reached", detail="also where no width was required; False where the work was stopped")
    ]
    contact_rate_hz: Annotated[float, Along("", "1/s", "contacts per second")]
    contact_rate_half_width_hz: Annotated[float, Along("", "1/s", "half width of its 95 % interval")]
    mean_impact_velocity_m_s: Annotated[float, Along("", "m/s", "mean impact velocity", detail="0 without contact")]
    max_impact_velocity_m_s: Annotated[float, Along("", "m/s", "largest impact velocity")]
    mean_contact_duration_s: Annotated[float, Along("", "s", "mean contact duration", detail="0 without contact")]
    energy_residual_relative: Annotated[float, Along("", "1", "largest energy residual of a member")]
    seed: Annotated[int, About("seed of the realisations")]
    member: Annotated[Integers, About("number of each realisation under the seed", axes="member")]
    member_mean_power_w: Annotated[Floats, Along("member", "W", "mean power of all loads")]
    member_contacts: Annotated[Integers, Along("member", "1", "contacts that began")]
    member_contact_rate_hz: Annotated[Floats, Along("member", "1/s", "contacts per second")]
    member_mean_impact_velocity_m_s: Annotated[Floats, Along("member", "m/s", "mean impact velocity")]
    member_max_impact_velocity_m_s: Annotated[Floats, Along("member", "m/s", "largest impact velocity")]
    member_mean_contact_duration_s: Annotated[Floats, Along("member", "s", "mean contact duration")]
    member_max_penetration_m: Annotated[Floats, Along("member", "m", "largest penetration of the stop")]
    warnings: Annotated[list[str], About("recordings that end too early and exceeded limits of patches in members")]
    member_energy_residual_relative: Annotated[Floats, Along("member", "1", "energy residual of the run")]
    stop: Annotated[list[str], About("names of the stops")]
    stop_contact_rate_hz: Annotated[Floats, Along("stop", "1/s", "contacts per second")]
    stop_contact_rate_half_width_hz: Annotated[Floats, Along("stop", "1/s", "half width of its 95 % interval")]
    stop_mean_impact_velocity_m_s: Annotated[Floats, Along("stop", "m/s", "mean impact velocity")]
    stop_mean_impact_velocity_half_width_m_s: Annotated[Floats, Along("stop", "m/s", "half width of its 95 % interval")]
    stop_max_impact_velocity_m_s: Annotated[Floats, Along("stop", "m/s", "largest impact velocity")]
    stop_mean_contact_duration_s: Annotated[Floats, Along("stop", "s", "mean contact duration")]
    stop_mean_contact_duration_half_width_s: Annotated[Floats, Along("stop", "s", "half width of its 95 % interval")]
    stop_max_contact_duration_s: Annotated[Floats, Along("stop", "s", "longest contact duration")]
    stop_contact_duty: Annotated[Floats, Along("stop", "1", "share of the time in contact")]
    stop_contact_duty_half_width: Annotated[Floats, Along("stop", "1", "half width of its 95 % interval")]
    stop_max_contact_force_n: Annotated[Floats, Along("stop", "N", "largest contact force", detail="0 for impacts on a rigid stop")]
    stop_max_penetration_m: Annotated[Floats, Along("stop", "m", "largest penetration")]
    device: Annotated[list[str], About("circuits with a device behind a regulator")]
    device_on_fraction: Annotated[Floats, Along("device", "1", "share of the time on")]
    device_on_fraction_half_width: Annotated[Floats, Along("device", "1", "half width of its 95 % interval")]
    device_cold_start_s: Annotated[Floats, Along("device", "s", "time to the first start", detail="over the members in which it starts")]
    device_cold_start_half_width_s: Annotated[Floats, Along("device", "s", "half width of its 95 % interval")]
    device_never_started: Annotated[Integers, Along("device", "1", "members in which the device never starts")]
    device_longest_outage_s: Annotated[Floats, Along("device", "s", "longest time off in any member")]
    device_completed_tasks: Annotated[Integers, Along("device", "1", "completed measurements and transmissions")]
    device_interrupted_tasks: Annotated[Integers, Along("device", "1", "tasks that an outage interrupted")]
    device_mean_power_w: Annotated[Floats, Along("device", "W", "mean power delivered to the device")]
    device_mean_power_half_width_w: Annotated[Floats, Along("device", "W", "half width of its 95 % interval")]
    device_margin_w: Annotated[Floats, Along("device", "W", "available minus needed power")]
    device_margin_half_width_w: Annotated[Floats, Along("device", "W", "half width of its 95 % interval")]
    patch: Annotated[list[str], About("patches whose voltages have a spectrum; empty unless requested")]
    frequency_hz: Annotated[Floats, About("middle of each bin of frequencies", "Hz", axes="frequency")]
    voltage_psd_v2_hz: Annotated[Floats, Along("patch frequency", "V^2/Hz", "one-sided power spectral density")]
    voltage_psd_half_width_v2_hz: Annotated[Floats, Along("patch frequency", "V^2/Hz", "half width of its 95 % interval")]
    bandwidth_hz: Annotated[Floats, Along("patch", "Hz", "statistical bandwidth of the voltage")]
    bandwidth_half_width_hz: Annotated[Floats, Along("patch", "Hz", "half width of its 95 % interval")]

    @classmethod
    def _from_core(cls, fields: dict[str, Any]) -> Self:
        return super()._from_core(cls._filled(fields))

    def __len__(self) -> int:
        return len(self.member)

    def _summary(self) -> list[tuple[str, str]]:
        power = f"{self.mean_power_w:.6e} W +- {self.mean_power_half_width_w:.1e} W (95 %, over {self.interval_over})"
        return [
            ("mean power", power),
            ("members", str(len(self))),
            ("required width", "reached" if self.reached else "NOT reached"),
            ("contacts", f"{self.contact_rate_hz:.4f} per second +- {self.contact_rate_half_width_hz:.2f}"),
            (
                "impacts",
                f"{self.mean_impact_velocity_m_s:.4e} m/s in the mean, {self.max_impact_velocity_m_s:.4e} m/s at most, "
                f"{self.mean_contact_duration_s:.4e} s each",
            ),
            *((f"stop {name}", self._stop_summary(k)) for k, name in enumerate(self.stop)),
            *((f"device {name}", self._device_summary(k)) for k, name in enumerate(self.device)),
            *(
                (f"bandwidth of {name}", f"{width:.4e} Hz +- {half:.1e} Hz (statistical)")
                for name, width, half in zip(self.patch, self.bandwidth_hz, self.bandwidth_half_width_hz)
            ),
            *(("warning", text) for text in self.warnings),
        ]

    def _device_summary(self, k: int) -> str:
        share = f"on for {100 * self.device_on_fraction[k]:.3g} % of the time +- {100 * self.device_on_fraction_half_width[k]:.1g} %"
        tasks = f"{self.device_completed_tasks[k]} tasks completed, {self.device_interrupted_tasks[k]} interrupted"
        return f"{share}, {tasks}, margin {self.device_margin_w[k]:.3e} W +- {self.device_margin_half_width_w[k]:.1e} W"

    def _stop_summary(self, k: int) -> str:
        rate = f"{self.stop_contact_rate_hz[k]:.4g} contacts per second +- {self.stop_contact_rate_half_width_hz[k]:.1e}"
        strike = f"{self.stop_mean_impact_velocity_m_s[k]:.4e} m/s +- {self.stop_mean_impact_velocity_half_width_m_s[k]:.1e} m/s"
        return f"{rate}, at {strike}, {100 * self.stop_contact_duty[k]:.3g} % of the time"

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``member``, ``stop`` and ``device``, spectra over ``patch`` and ``frequency``."""
        coords = {
            "member": Variable(("member",), self.member, "1", "number of the realisation under its seed"),
            "stop": Variable(("stop",), self.stop, "", "stop"),
            "device": Variable(("device",), self.device, "", "device"),
            "patch": Variable(("patch",), self.patch, "", "patch"),
            "frequency": Variable(("frequency",), self.frequency_hz, "Hz", "middle of the bin"),
        }
        variables = {name: one for name, one in self._variables().items() if self.patch or "patch" not in one.dims}
        axes = {axis for one in variables.values() for axis in one.dims}
        return self._dataset(variables, {name: one for name, one in coords.items() if name in axes})

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each member."""
        return self._frame({"member": self.member, **self._columns("member")})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {"mean_power_w": self.plot_ensemble, **({"voltage_psd_v2_hz": self.plot_spectra} if self.patch else {})}

    def plot_ensemble(self, ax: Axes | None = None) -> Axes:
        """Draws the mean power of each member over the mean of all with its 95 % interval."""
        from ._plot.ensemble import plot_ensemble

        return plot_ensemble(self, ax)

    def plot_spectra(self, ax: Axes | None = None) -> Axes:
        """Draws the density of each voltage with its 95 % interval; needs ``ensemble(spectrum=True)``."""
        from ._plot.spectra import plot_spectra

        if not self.patch:
            raise ArgumentError("this ensemble has no spectra; compute them with ensemble(spectrum=True)")
        return plot_spectra(self, ax)
