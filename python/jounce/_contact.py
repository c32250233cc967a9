"""Force pulses of a hammer and the contact laws fitted to them."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from . import _core
from ._arguments import options, to_si
from ._call import recorded
from ._fields import About, Along, Variable
from ._format import html_table
from ._inputs import Measured, recording
from ._issue import Issue, issue_lines, parse_issues
from ._recording import names_of
from ._result import Data, Floats, Result, make_manifest

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset

#: Description of the laws that a pulse allows.
LAW_DESCRIPTIONS = {
    "neither": "neither a linear spring nor Hertz's law fits",
    "linear": "a linear spring fits, Hertz's law does not",
    "hertz": "Hertz's law fits, a linear spring does not",
    "both": "the data do not distinguish a linear spring from Hertz's law",
}


@dataclasses.dataclass(frozen=True, eq=False)
class Pulse(Data):
    """Samples of one pulse, time from the largest force, s, and the fitted law between them; the last two are empty without a law."""

    time_s: Annotated[Floats, About("time from the largest force", "s", axes="sample")]
    force_n: Annotated[Floats, About("measured force", "N", axes="sample")]
    law_time_s: Annotated[Floats, About("time from the largest force, of the fitted law", "s", axes="law_sample")]
    law_force_n: Annotated[Floats, About("force of the fitted law", "N", axes="law_sample")]


@dataclasses.dataclass(frozen=True, eq=False)
class ForceTable(Data):
    """Force over penetration of one pulse, for ``law = "table"`` of a stop; both arrays are empty where there is a reason.

    It holds all force while the hammer is pressed in, that of damping too. Dissipation is not part of it.
    """

    penetration_m: Annotated[Floats, About("penetrations, ascending", "m", axes="point")]
    force_n: Annotated[Floats, About("force at each penetration, ascending", "N", axes="point")]
    speed_m_s: Annotated[float, About("speed of the hammer from which the penetrations follow; NaN without a table", "m/s")]
    reason: Annotated[str | None, About("reason why there is no table")]

    @property
    def keys(self) -> dict[str, Any]:
        """Keys of a stop: ``jounce.Stop(at="ball", gap="1 mm", **table.keys)``."""
        return {"law": "table", "penetration_m": self.penetration_m.tolist(), "force_n": self.force_n.tolist()}


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class ContactResult(Result):
    """Hits of a record and the contact law fitted to each; arrays of shape ``(hit,)``, NaN where no law could be fitted."""

    channel: Annotated[str, About("channel of the force")]
    mass_kg: Annotated[float, About("mass of the hammer; NaN where it was not given", "kg")]
    time_s: Annotated[Floats, Along("hit", "s", "time of the largest force, from the first sample")]
    start_s: Annotated[Floats, Along("hit", "s", "begin of the pulse, from the first sample")]
    end_s: Annotated[Floats, Along("hit", "s", "end of the pulse, from the first sample")]
    peak_force_n: Annotated[Floats, Along("hit", "N", "largest force")]
    edge_force_n: Annotated[Floats, Along("hit", "N", "a tenth of the largest force")]
    contact_time_s: Annotated[Floats, Along("hit", "s", "time above a tenth of the largest force")]
    law_contact_time_s: Annotated[Floats, Along("hit", "s", "contact time of the law")]
    impulse_n_s: Annotated[Floats, Along("hit", "N s", "integral of the force")]
    exponent: Annotated[Floats, Along("hit", "1", "exponent of the law: 1 for a linear spring, 1.5 for Hertz")]
    exponent_deviation: Annotated[Floats, Along("hit", "1", "standard deviation of the exponent")]
    exponent_half_width: Annotated[Floats, Along("hit", "1", "half width of the 95 % interval of the exponent")]
    restitution: Annotated[Floats, Along("hit", "1", "ratio of speed after to speed before contact")]
    restitution_deviation: Annotated[Floats, Along("hit", "1", "standard deviation of the restitution")]
    restitution_half_width: Annotated[Floats, Along("hit", "1", "half width of the 95 % interval of the restitution")]
    stiffness: Annotated[
        Floats,
        Along("hit", "N m^-exponent", "stiffness of the law", detail="in N/m^exponent; NaN where the mass of the hammer was not given"),
    ]
    stiffness_relative_deviation: Annotated[
        Floats,
        Along("hit", "1", "standard deviation of the logarithm of the stiffness", detail="NaN where the mass of the hammer was not given"),
    ]
    stiffness_low: Annotated[Floats, Along("hit", "N m^-exponent", "lower end of the 95 % interval of the stiffness")]
    stiffness_high: Annotated[Floats, Along("hit", "N m^-exponent", "upper end of the 95 % interval of the stiffness")]
    linear_stiffness: Annotated[
        Floats,
        Along(
            "hit",
            "N/m",
            "stiffness of a linear spring",
            detail="NaN without the mass of the hammer, and where the pulse does not allow a linear spring",
        ),
    ]
    linear_stiffness_low: Annotated[Floats, Along("hit", "N/m", "lower end of the 95 % interval of this stiffness")]
    linear_stiffness_high: Annotated[Floats, Along("hit", "N/m", "upper end of the 95 % interval of this stiffness")]
    linear_restitution: Annotated[Floats, Along("hit", "1", "restitution of a linear spring")]
    linear_speed_m_s: Annotated[Floats, Along("hit", "m/s", "speed of the hammer by a linear spring")]
    linear_relative_error: Annotated[Floats, Along("hit", "1", "rms residual of a linear spring relative to the largest force")]
    hertz_stiffness: Annotated[
        Floats,
        Along(
            "hit",
            "N m^-1.5",
            "stiffness of Hertz's law",
            detail="NaN without the mass of the hammer, and where the pulse does not allow Hertz's law",
        ),
    ]
    hertz_stiffness_low: Annotated[Floats, Along("hit", "N m^-1.5", "lower end of the 95 % interval of this stiffness")]
    hertz_stiffness_high: Annotated[Floats, Along("hit", "N m^-1.5", "upper end of the 95 % interval of this stiffness")]
    hertz_restitution: Annotated[Floats, Along("hit", "1", "restitution of Hertz's law")]
    hertz_speed_m_s: Annotated[Floats, Along("hit", "m/s", "speed of the hammer by Hertz's law")]
    hertz_relative_error: Annotated[Floats, Along("hit", "1", "rms residual of Hertz's law relative to the largest force")]
    speed_m_s: Annotated[Floats, Along("hit", "m/s", "speed of the hammer", detail="NaN where the mass of the hammer was not given")]
    relative_error: Annotated[Floats, Along("hit", "1", "rms residual of the law relative to the largest force")]
    allowed_laws: Annotated[
        list[str | None],
        About(
            'laws that a pulse allows, at 95 %: ``"neither"``, ``"linear"``, ``"hertz"``, ``"both"``; ``None`` where no law could be fitted'
        ),
    ]
    reason: Annotated[list[str | None], About("reason why no law could be fitted; ``None`` where one was fitted")]
    warnings: Annotated[list[list[str]], About('warnings of each hit: ``"double"``, ``"clipped"``, ``"coarse"``, ``"cut"``')]
    force_tables: Annotated[list[ForceTable], About("force over penetration of each hit; empty without the mass of the hammer")]
    pulses: Annotated[list[Pulse], About("samples of each pulse")]
    issues: Annotated[list[Issue], About("data-quality issues of the recording")]

    def __len__(self) -> int:
        return len(self.time_s)

    def _summary(self) -> list[tuple[str, str]]:
        lines = [("channel", self.channel)]
        for k, kind in enumerate(self.allowed_laws):
            hit = f"{self.peak_force_n[k]:.4f} N, {self.contact_time_s[k]:.4e} s above a tenth of it, impulse {self.impulse_n_s[k]:.4e} N s"
            lines.append((f"hit at {self.time_s[k]:.6f} s", ", ".join([hit, *self.warnings[k]])))
            if kind:
                law = f"95 %: exponent {self.exponent[k]:.3f} +- {self.exponent_half_width[k]:.3f}"
                restitution = f"restitution {self.restitution[k]:.3f} +- {self.restitution_half_width[k]:.3f}"
                lines.append(("", f"{law}, {restitution}; contact time {self.law_contact_time_s[k]:.4e} s; {LAW_DESCRIPTIONS[kind]}"))
                lines.extend(("", stiffness) for stiffness in self._stiffnesses(k))
            else:
                lines.append(("", f"no law: {self.reason[k]}"))
        return lines + issue_lines(self.issues)

    def _stiffnesses(self, k: int) -> list[str]:
        laws = {
            f"N/m^{self.exponent[k]:.3f}": (self.stiffness, self.stiffness_low, self.stiffness_high),
            "N/m as a linear spring": (self.linear_stiffness, self.linear_stiffness_low, self.linear_stiffness_high),
            "N/m^1.5 as Hertz's law": (self.hertz_stiffness, self.hertz_stiffness_low, self.hertz_stiffness_high),
        }
        values_by_unit = {unit: [one[k] for one in values] for unit, values in laws.items() if np.isfinite(values[0][k])}
        return [f"stiffness {value:.4e} {unit}, 95 % from {low:.4e} to {high:.4e}" for unit, (value, low, high) in values_by_unit.items()]

    def _repr_html_(self) -> str:
        columns = (self.time_s, self.peak_force_n, self.contact_time_s, self.exponent, self.restitution)
        laws = [LAW_DESCRIPTIONS[kind] if kind else reason for kind, reason in zip(self.allowed_laws, self.reason)]
        rows = [[*(f"{one[k]:.5g}" for one in columns), law] for k, law in enumerate(laws)]
        return html_table("Hits", ["time [s]", "peak force [N]", "contact [s]", "exponent", "restitution", ""], rows)

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``hit``."""
        allowed_laws = [one or "" for one in self.allowed_laws]
        variables = {**self._variables(), "allowed_laws": Variable(("hit",), allowed_laws, "", "laws that the pulse allows")}
        return self._dataset(variables, {"hit": Variable(("hit",), np.arange(len(self)), "1", "number of the hit")})

    def _parts(self) -> dict[str, Dataset]:
        def dataset(pulse: Pulse) -> Dataset:
            force = Variable(("time",), pulse.force_n, "N", "force")
            law = Variable(("law_time",), pulse.law_force_n, "N", "force of the fitted law")
            times = {
                "time": Variable(("time",), pulse.time_s, "s", "time from the largest force"),
                "law_time": Variable(("law_time",), pulse.law_time_s, "s", "time from the largest force"),
            }
            return self._dataset({"force": force, "law_force": law}, times)

        return {f"pulse_{number}": dataset(one) for number, one in enumerate(self.pulses)}

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each hit."""
        return self._frame({**self._columns("hit"), "allowed_laws": self.allowed_laws, "reason": self.reason})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {"force": self.plot_contact}

    def plot_contact(self, ax: Axes | None = None, hits: int = 6) -> Axes:
        """Draws the first pulses with the laws fitted to them."""
        from ._plot.contact import plot_contact

        return plot_contact(self, ax, hits)


@recorded
def contact(
    record: Measured, *, sample_rate_hz: Any = None, force: str | None = None, mass: Any = None, speed: Any = None
) -> ContactResult:
    """Fits contact time, exponent and restitution of every hit in a record of force, and stiffnesses with the ``mass`` of the hammer.

    With the ``mass``, the loading branch of each pulse gives a table of force over penetration, from the ``speed`` of the hammer before
    the contact, or from that of the fitted law. Stiffnesses are returned for the fitted exponent, and for the linear spring and Hertz's
    law where a pulse allows them.
    The struck body is assumed to be at rest during a contact.
    """
    input_recording = recording(record, sample_rate_hz)
    mass_kg = None if mass is None else to_si("mass", mass, "mass")
    speed_m_s = None if speed is None else to_si("speed", speed, "speed")
    given = options(force=force, mass_kg=mass_kg, speed_m_s=speed_m_s)
    fields = ContactResult._filled(_core.contact(input_recording._core(), given))
    fields["manifest"] = make_manifest("contact", **names_of([input_recording]), mass_kg=mass_kg, speed_m_s=speed_m_s)
    fields["force_tables"] = [_table_of(one) for one in fields["force_tables"]]
    fields["warnings"] = [[kind_of(one) for one in warnings] for warnings in json.loads(fields["warnings"])]
    fields["pulses"] = [Pulse(*one) for one in fields["pulses"]]
    fields["issues"] = [*input_recording.issues, *parse_issues(fields["issues"])]
    return ContactResult(**fields)


def _table_of(fields: dict[str, Any]) -> ForceTable:
    arrays = {name: np.array(fields[name], dtype=np.float64) for name in ("penetration_m", "force_n")}
    speed_m_s = np.nan if fields["speed_m_s"] is None else fields["speed_m_s"]
    return ForceTable(**arrays, speed_m_s=speed_m_s, reason=fields["reason"])


def kind_of(warning: Any) -> str:
    """Returns the kind of a warning of a hit, which may carry numbers."""
    return warning if isinstance(warning, str) else next(iter(warning))
