"""The problems of `design.py`: free keys with their ranges, goals, limits and the spec as given.

The bistable harvester is that of HarvesterOpt (A. Cunha, arXiv:2105.13459) in its box of two variables, in dimensionless numbers as SI:

    x'' + 2 xi x' - x (1 - x^2) / 2 - chi v = f cos(W t),   v' + lambda v + kappa x' = 0
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path

PAPER = Path(__file__).resolve().parent.parent.parent / "examples" / "impact-harvester-2019" / "harvester.toml"

BISTABLE = """\
[modal.m]
frequency_hz = [0.15915494309189535]
damping_ratio = [0.01]
[modal.m.point]
tip = [1.0]
[modal.m.patch.p]
coupling_n_per_v = [0.05]
capacitance = "0.1 F"
[stop.well]
at = "m.tip"
law = "cubic"
gap = "0 m"
stiffness = "-1.5 N/m"
cubic_stiffness = "0.5 N/m^3"
[circuit.load]
patch = "m.p"
resistance = "200 ohm"
[drive.d]
at = "m.tip"
kind = "force"
amplitude = "0.0999 N"
frequency = "0.12391803869134971 Hz"
[run]
duration = "1 s"
average_over = "1 s"
"""

#: Values of the paper for the free keys.
AS_GIVEN = {"stop.tip.gap": 1e-3, "stop.tip.stiffness": 1000.0, "circuit.load.resistance": 1e6}


@dataclass(frozen=True)
class Key:
    """A free key: its range in SI, and whether it is searched in its logarithm."""

    path: str
    low: float
    high: float
    unit: str
    is_log: bool = False

    def value(self, place: float) -> float:
        """Returns the value at a place of the unit interval."""
        place = min(max(place, 0.0), 1.0)
        if self.is_log:
            return self.low * (self.high / self.low) ** place
        return self.low + (self.high - self.low) * place

    def place(self, value: float) -> float:
        """Returns the place of a value."""
        if self.is_log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)

    def text(self, value: float) -> str:
        """Returns a value with its unit."""
        return f"{value!r} {self.unit}"

    def span(self) -> str:
        """Returns the range as a design file has it."""
        return f"{self.low!r}{self.unit}:{self.high!r}{self.unit}" if not self.is_log else f"{self.low!r}:{self.high!r}:log {self.unit}"


@dataclass(frozen=True)
class Problem:
    """A design problem with its budgets; `long_run` is the length of the run that checks a design, and its averaged end, s."""

    name: str
    title: str
    keys: tuple[Key, ...]
    goals: tuple[str, ...]
    settings: dict[str, str]
    given: dict[str, float]
    limits: dict[str, object] = field(default_factory=dict)
    starts: int = 20
    evaluations: int = 80
    jounce_evaluations: tuple[int, ...] = (20, 40, 80, 1000)
    long_run: tuple[float, float] = (300.0, 10.0)
    spec: Path | None = PAPER
    scale: float = 1e3
    unit: str = "mW"

    def values(self, place: tuple[float, ...]) -> dict[str, str]:
        """Returns the keys at a place of the unit cube, as text."""
        return {key.path: key.text(key.value(each)) for key, each in zip(self.keys, place, strict=True)}

    def start(self) -> tuple[float, ...]:
        """Returns the place of the spec as given, with which every method begins."""
        return tuple(key.place(self.given[key.path]) for key in self.keys)

    def design(self, evaluations: int, free: dict[str, str] | None = None, starts: int | None = None) -> dict[str, object]:
        """Returns the problem as `Spec.design` takes it."""
        goal = {"maximise": list(self.goals) if len(self.goals) > 1 else self.goals[0], "starts": starts or self.starts}
        free = free or {key.path: key.span() for key in self.keys}
        return {"free": free, "goal": goal, "limits": self.limits, "evaluations": evaluations}


GAP = Key("stop.tip.gap", 0.2e-3, 3e-3, "m")
STIFFNESS = Key("stop.tip.stiffness", 100.0, 1e5, "N/m^1.5", True)
LOAD = Key("circuit.load.resistance", 1e4, 3e6, "ohm", True)
PAPER_KEYS = (GAP, STIFFNESS, LOAD)
STRAIN = {"patch.mfc.strain": "600 ppm"}


def drive(frequency: str, amplitude: str) -> dict[str, str]:
    """Returns the keys of the shaker."""
    return {"drive.shaker.frequency": frequency, "drive.shaker.amplitude": amplitude}


PROBLEMS = (
    Problem(
        "strain",
        "11 Hz and 50 N, strain below 600 ppm",
        PAPER_KEYS,
        ("expected-power",),
        drive("11 Hz", "50 N"),
        AS_GIVEN,
        STRAIN | {"basin_fraction": 0.9},
    ),
    Problem("hard", "13 Hz and 200 N", PAPER_KEYS, ("expected-power",), drive("13 Hz", "200 N"), AS_GIVEN, {"basin_fraction": 0.9}),
    Problem(
        "bistable",
        "bistable harvester",
        (Key("drive.d.amplitude", 0.08, 0.10, "N"), Key("drive.d.frequency", 0.75 / math.tau, 0.85 / math.tau, "Hz")),
        ("expected-power",),
        {},
        {"drive.d.amplitude": 0.0999, "drive.d.frequency": 0.7786 / math.tau},
        evaluations=60,
        jounce_evaluations=(15, 30, 60, 1000),
        long_run=(5000.0, 2500.0),
        spec=None,
        scale=10.0,
        unit="(dimensionless)",
    ),
    Problem(
        "front",
        "power against bandwidth, 11 Hz and 50 N",
        PAPER_KEYS,
        ("expected-power", "bandwidth"),
        drive("11 Hz", "50 N"),
        AS_GIVEN,
        STRAIN,
        evaluations=120,
        jounce_evaluations=(120,),
        unit="mW Hz",
    ),
)
