"""Reads a jounce spec of a structure given by its modes into plain SI numbers that every peer can take."""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

PREFIXES = {"": 1.0, "n": 1e-9, "u": 1e-6, "m": 1e-3, "k": 1e3, "M": 1e6}


class SpecError(ValueError):
    """The peers cannot run the spec."""


@dataclass(frozen=True)
class Case:
    """One drive: zero-to-peak force and frequency."""

    amplitude_n: float
    frequency_hz: float

    @property
    def title(self) -> str:
        """Returns the title in reports."""
        return f"{self.amplitude_n:g} N at {self.frequency_hz:g} Hz"

    @property
    def slug(self) -> str:
        """Returns the name in files."""
        return f"{self.amplitude_n:g}N-{self.frequency_hz:g}Hz"


@dataclass(frozen=True)
class Plant:
    """The modal plant: rows of one number per mode, then single numbers, all SI."""

    path: Path
    drive: str
    rows: dict[str, list[float]]
    single: dict[str, float]

    @property
    def modes(self) -> int:
        """Returns the number of modes."""
        return len(self.rows["frequency_hz"])

    def parameters(self, case: Case) -> str:
        """Returns the parameter file: a name and its numbers on each line, in the order that the C peers expect."""
        single = self.single | {"amplitude_n": case.amplitude_n, "frequency_drive_hz": case.frequency_hz}
        order = (
            "capacitance_f",
            "resistance_ohm",
            "gap_m",
            "contact_n_per_m15",
            "amplitude_n",
            "frequency_drive_hz",
            "duration_s",
            "average_over_s",
        )
        lines = [f"modes {self.modes}"]
        lines += [f"{name} {' '.join(repr(value) for value in values)}" for name, values in self.rows.items()]
        lines += [f"{name} {single[name]!r}" for name in order]
        return "\n".join(lines) + "\n"


def quantity(text: str, unit: str) -> float:
    """Returns a number with its unit, in SI."""
    match = re.fullmatch(r"\s*([-+0-9.eE]+)\s*([a-zA-Z/^0-9.]+)\s*", text)
    if match and match[2].endswith(unit) and match[2][: -len(unit)] in PREFIXES:
        return float(match[1]) * PREFIXES[match[2][: -len(unit)]]
    raise SpecError(f"'{text}' is not a quantity in {unit}")


def only(table: dict[str, Any], kind: str) -> dict[str, Any]:
    """Returns the only element of its kind; the peers accept no plant with several."""
    things = table.get(kind, {})
    if len(things) != 1:
        raise SpecError(f"the peers need exactly one [{kind}.NAME], here are {len(things)}")
    thing: dict[str, Any] = next(iter(things.values()))
    return thing


def last_name(reference: str) -> str:
    """Returns `tip` of `harvester.tip`."""
    return reference.rsplit(".", 1)[-1]


def read_plant(path: Path) -> Plant:
    """Reads a spec with one modal structure, one Hertz stop on the ground, one resistor and one force."""
    spec = tomllib.loads(path.read_text())
    modal, stop, circuit, drive, run = only(spec, "modal"), only(spec, "stop"), only(spec, "circuit"), only(spec, "drive"), spec["run"]
    if stop["law"] != "hertz" or stop.get("frame", "ground") != "ground" or stop.get("side", "positive") != "positive":
        raise SpecError("the peers know only a Hertz stop on the ground, on the positive side")
    if float(stop.get("exponent", 1.5)) != 1.5 or run.get("start", "rest") != "rest":
        raise SpecError("the peers know only the exponent 1.5 and a start from rest")
    patch = modal["patch"][last_name(circuit["patch"])]
    rows = {
        "frequency_hz": modal["frequency_hz"],
        "damping_ratio": modal["damping_ratio"],
        "table": modal["point"][last_name(drive["at"])],
        "tip": modal["point"][last_name(stop["at"])],
        "coupling_n_per_v": patch["coupling_n_per_v"],
    }
    single = {
        "capacitance_f": quantity(patch["capacitance"], "F"),
        "resistance_ohm": quantity(circuit["resistance"], "ohm"),
        "gap_m": quantity(stop["gap"], "m"),
        "contact_n_per_m15": quantity(stop["stiffness"], "N/m^1.5"),
        "duration_s": quantity(run["duration"], "s"),
        "average_over_s": quantity(run["average_over"], "s"),
    }
    return Plant(path.resolve(), next(iter(spec["drive"])), rows, single)
