"""Many realisations of noise."""

from __future__ import annotations

import dataclasses
from typing import Any

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


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class EnsembleResult(Result):
    """Means over realisations of noise with their 95 % intervals; arrays of shape ``(member,)``."""

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
        ]

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over ``member``, with the means as scalars."""
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
        return self._dataset(variables, {"member": Variable(("member",), self.member, "1", "number of the realisation under its seed")})

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each member."""
        return self._frame({"member": self.member, **{field: getattr(self, field) for field in _MEMBERS}})

    def plot_ensemble(self, ax: Any = None) -> Any:
        """Draws the mean power of each member over the mean of all with its 95 % interval."""
        from .plot.ensemble import plot_ensemble

        return plot_ensemble(self, ax)
