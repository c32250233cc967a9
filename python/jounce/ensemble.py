"""Many realisations of noise."""

from __future__ import annotations

import dataclasses
from typing import Any

from .errors import ArgumentError
from .result import Floats, Integers, Result, Variable

#: Fields with a value for each member: name in a dataset, unit, what it is.
_MEMBERS = {
    "member_power_w": ("member_power", "W", "mean power of all loads"),
    "member_contacts": ("member_contacts", "1", "contacts that began"),
    "member_contact_rate_hz": ("member_contact_rate", "1/s", "contacts per second"),
    "member_mean_strike_m_s": ("member_mean_strike", "m/s", "mean speed at which contacts began"),
    "member_max_strike_m_s": ("member_max_strike", "m/s", "largest speed at which one began"),
    "member_mean_dwell_s": ("member_mean_dwell", "s", "mean time that a contact lasts"),
    "member_max_penetration_m": ("member_max_penetration", "m", "largest penetration of the stop"),
    "member_energy_residual_relative": ("member_energy_residual_relative", "1", "energy residual of the march"),
}

#: Fields with a value for each stop.
_STOPS = {
    "stop_contact_rate_hz": ("stop_contact_rate", "1/s", "contacts per second"),
    "stop_contact_rate_half_width_hz": ("stop_contact_rate_half_width", "1/s", "half the width of its 95 % interval"),
    "stop_mean_strike_m_s": ("stop_mean_strike", "m/s", "mean speed at which contacts began"),
    "stop_mean_strike_half_width_m_s": ("stop_mean_strike_half_width", "m/s", "half the width of its 95 % interval"),
    "stop_max_strike_m_s": ("stop_max_strike", "m/s", "largest speed at which one began"),
    "stop_mean_dwell_s": ("stop_mean_dwell", "s", "mean time that a contact lasts"),
    "stop_mean_dwell_half_width_s": ("stop_mean_dwell_half_width", "s", "half the width of its 95 % interval"),
    "stop_max_dwell_s": ("stop_max_dwell", "s", "longest time that one lasted"),
    "stop_contact_duty": ("stop_contact_duty", "1", "share of the time in contact"),
    "stop_contact_duty_half_width": ("stop_contact_duty_half_width", "1", "half the width of its 95 % interval"),
    "stop_max_contact_force_n": ("stop_max_contact_force", "N", "largest contact force"),
    "stop_max_penetration_m": ("stop_max_penetration", "m", "largest penetration"),
}


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class EnsembleResult(Result):
    """Means over realisations of noise with their 95 % intervals; arrays of shape ``(member,)``, and ``(stop,)`` where they say so.

    An interval that nothing can be said of is infinitely wide.
    """

    #: Mean power of all loads and half the width of its 95 % interval, W.
    mean_power_w: float
    mean_power_half_width_w: float
    #: What the interval was taken over: ``"members"``, or ``"batches"`` of them where they are few.
    interval_over: str
    #: Was the wanted width reached (or none wanted), and the work not stopped?
    reached: bool
    #: Contacts per second and half the width of its 95 % interval.
    contact_rate_hz: float
    contact_rate_half_width_hz: float
    #: Speed at which contacts began, m/s, and the time that one lasts, s; 0 without contact.
    mean_strike_m_s: float
    max_strike_m_s: float
    mean_dwell_s: float
    #: Number of each realisation under the seed, and its own answers.
    member: Integers
    member_power_w: Floats
    member_contacts: Integers
    member_contact_rate_hz: Floats
    member_mean_strike_m_s: Floats
    member_max_strike_m_s: Floats
    member_mean_dwell_s: Floats
    member_max_penetration_m: Floats
    member_energy_residual_relative: Floats
    #: Names of the stops. For each, contacts per second, speed at which contacts began, m/s, time that one lasts, s, and share of the
    #: time in contact, with half the widths of their 95 % intervals (over what ``interval_over`` says) and their largest values.
    stop: list[str]
    stop_contact_rate_hz: Floats
    stop_contact_rate_half_width_hz: Floats
    stop_mean_strike_m_s: Floats
    stop_mean_strike_half_width_m_s: Floats
    stop_max_strike_m_s: Floats
    stop_mean_dwell_s: Floats
    stop_mean_dwell_half_width_s: Floats
    stop_max_dwell_s: Floats
    stop_contact_duty: Floats
    stop_contact_duty_half_width: Floats
    #: Largest contact force, N, 0 for impacts on a rigid stop, and penetration, m.
    stop_max_contact_force_n: Floats
    stop_max_penetration_m: Floats
    #: Names of the patches whose voltages have a spectrum; none unless they were asked for.
    patch: list[str]
    #: Middle of each bin of frequencies, Hz; of shape ``(frequency,)``.
    frequency_hz: Floats
    #: One-sided power spectral density of each voltage, V^2/Hz, and half the width of its 95 % interval over members; of shape
    #: ``(patch, frequency)``.
    voltage_psd_v2_hz: Floats
    voltage_psd_half_width_v2_hz: Floats
    #: Statistical bandwidth of each voltage, Hz, and half the width of its 95 % interval; of shape ``(patch,)``.
    bandwidth_hz: Floats
    bandwidth_half_width_hz: Floats

    def __len__(self) -> int:
        return len(self.member)

    def _summary(self) -> list[tuple[str, str]]:
        power = f"{self.mean_power_w:.6e} W +- {self.mean_power_half_width_w:.1e} W (95 %, over {self.interval_over})"
        return [
            ("mean power", power),
            ("members", str(len(self))),
            ("wanted width", "reached" if self.reached else "NOT reached"),
            ("contacts", f"{self.contact_rate_hz:.4f} per second +- {self.contact_rate_half_width_hz:.2f}"),
            (
                "strikes",
                f"{self.mean_strike_m_s:.4e} m/s in the mean, {self.max_strike_m_s:.4e} m/s at most, {self.mean_dwell_s:.4e} s each",
            ),
            *((f"stop {name}", self._of_stop(k)) for k, name in enumerate(self.stop)),
            *(
                (f"bandwidth of {name}", f"{width:.4e} Hz +- {half:.1e} Hz (statistical)")
                for name, width, half in zip(self.patch, self.bandwidth_hz, self.bandwidth_half_width_hz)
            ),
        ]

    def _of_stop(self, k: int) -> str:
        rate = f"{self.stop_contact_rate_hz[k]:.4g} contacts per second +- {self.stop_contact_rate_half_width_hz[k]:.1e}"
        strike = f"{self.stop_mean_strike_m_s[k]:.4e} m/s +- {self.stop_mean_strike_half_width_m_s[k]:.1e} m/s"
        return f"{rate}, at {strike}, {100 * self.stop_contact_duty[k]:.3g} % of the time"

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over ``member`` and ``stop``, with the means as scalars; spectra over ``patch`` and ``frequency``."""
        scalars = {
            "mean_power": (self.mean_power_w, "W", "mean power of all loads"),
            "mean_power_half_width": (self.mean_power_half_width_w, "W", "half the width of its 95 % interval"),
            "contact_rate": (self.contact_rate_hz, "1/s", "contacts per second"),
            "contact_rate_half_width": (self.contact_rate_half_width_hz, "1/s", "half the width of its 95 % interval"),
            "mean_strike": (self.mean_strike_m_s, "m/s", "mean speed at which contacts began"),
            "max_strike": (self.max_strike_m_s, "m/s", "largest speed at which one began"),
            "mean_dwell": (self.mean_dwell_s, "s", "mean time that a contact lasts"),
            "reached": (self.reached, "1", "the wanted width was reached"),
        }
        variables = {name: Variable((), value, units, about) for name, (value, units, about) in scalars.items()}
        for field, (name, units, about) in _MEMBERS.items():
            variables[name] = Variable(("member",), getattr(self, field), units, about)
        for field, (name, units, about) in _STOPS.items():
            variables[name] = Variable(("stop",), getattr(self, field), units, about)
        coords = {
            "member": Variable(("member",), self.member, "1", "number of the realisation under its seed"),
            "stop": Variable(("stop",), self.stop, "", "stop"),
        }
        if self.patch:
            variables |= self._spectra()
            coords["patch"] = Variable(("patch",), self.patch, "", "patch")
            coords["frequency"] = Variable(("frequency",), self.frequency_hz, "Hz", "middle of the bin")
        return self._dataset(variables, coords)

    def _spectra(self) -> dict[str, Variable]:
        each, bins, half = ("patch",), ("patch", "frequency"), "half the width of its 95 % interval"
        return {
            "voltage_psd": Variable(bins, self.voltage_psd_v2_hz, "V^2/Hz", "one-sided power spectral density"),
            "voltage_psd_half_width": Variable(bins, self.voltage_psd_half_width_v2_hz, "V^2/Hz", half),
            "bandwidth": Variable(each, self.bandwidth_hz, "Hz", "statistical bandwidth of the voltage"),
            "bandwidth_half_width": Variable(each, self.bandwidth_half_width_hz, "Hz", half),
        }

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each member."""
        return self._frame({"member": self.member, **{field: getattr(self, field) for field in _MEMBERS}})

    def plot_ensemble(self, ax: Any = None) -> Any:
        """Draws the mean power of each member over the mean of all with its 95 % interval."""
        from .plot.ensemble import plot_ensemble

        return plot_ensemble(self, ax)

    def plot_spectra(self, ax: Any = None) -> Any:
        """Draws the density of each voltage with its 95 % interval; they are there after ``ensemble(spectrum=True)``."""
        from .plot.spectra import plot_spectra

        if not self.patch:
            raise ArgumentError("this ensemble has no spectra; make them with ensemble(spectrum=True)")
        return plot_spectra(self, ax)
