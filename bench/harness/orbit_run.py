"""Runs every method on the complete branch, interleaved in a shuffled order, and the cost per point against the number of modes."""

from __future__ import annotations

import json
import random
import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from statistics import median

from .branches import CHECKS_HZ, FORCE_N, JOUNCE_METHODS, Found, Method, jounce_words, read_jounce
from .build import BUILD, say
from .compare import reference_w
from .plant import Case, Plant
from .process import finish

SETTLING_S, AVERAGE_S, STEPS_PER_S = 300.0, 10.0, "200000"
MODES = (8, 16, 24, 32, 40)
SHORT_HZ = (10.5, 12.0)
EQUATIONS = "harmonic balance equations alone"
ORBITS = "harmonic balance with multipliers and error"
WALKS = {EQUATIONS: "balance", ORBITS: "orbits"}
LONG_S = 10.0  # a short branch that takes longer is not repeated


@dataclass
class Drawn:
    """All repetitions of one method on the complete branch; `varies` is true if their results differ."""

    method: str
    found: Found
    cpu_s: list[float] = field(default_factory=list)
    varies: bool = False


@dataclass
class Cost:
    """CPU time of one short branch at one number of modes, s, of all repetitions."""

    method: str
    modes: int
    points: int = 0
    cpu_s: list[float] = field(default_factory=list)
    failed: str | None = None

    def per_point_s(self) -> float | None:
        """Returns the median CPU time per point, s."""
        return median(self.cpu_s) / self.points if self.cpu_s and self.points else None


def draw(methods: list[Method], cap_s: float) -> list[Drawn]:
    """Runs every method as often as its `repeats`."""
    shuffled, began = random.Random(1), time.monotonic()
    jobs = sorted(((shuffled.random(), method.name, method) for method in methods for _ in range(method.repeats)), key=lambda job: job[:2])
    drawn: dict[str, Drawn] = {}
    for done, (_, name, method) in enumerate(jobs):
        if name in drawn and drawn[name].found.failed:
            continue
        found, cpu_s = method.follow(cap_s)
        each = drawn.setdefault(name, Drawn(name, found))
        each.varies |= found != each.found
        if not found.failed:
            each.cpu_s.append(cpu_s)
        say(f"whole branch: {name}: {found.failed or f'{cpu_s:.3g} s'}; run {done + 1} of {len(jobs)}, {time.monotonic() - began:.0f} s")
    return [drawn[method.name] for method in methods]


def settled_w(plant: Plant, rk4: Path, dop853: Path) -> dict[float, tuple[float, float]]:
    """Returns the mean power of the orbit reached by a very long integration from rest, W, and the distance of its two methods.

    At CHECKS_HZ it is the orbit of the branch, and AVERAGE_S is a whole number of periods.
    """
    long = replace(plant, single=plant.single | {"duration_s": SETTLING_S, "average_over_s": AVERAGE_S})
    return {hz: reference_w(long, Case(FORCE_N, hz), rk4, dop853, STEPS_PER_S) for hz in CHECKS_HZ}


def walked(peer: Path, spec: Path, cost: Cost, cap_s: float) -> None:
    """Runs one process with many continuations; it prints their median time."""
    finished = finish([str(peer), str(spec), WALKS[cost.method]], BUILD, cap_s)
    said = json.loads(finished.stdout or "{}")
    cost.failed = finished.failed or said.get("failed")
    if not cost.failed:
        cost.points = said["points"]
        cost.cpu_s.append(said["cpu_s"])


def costs(program: Path, peer: Path | None, specs: dict[int, Path], repeats: int, cap_s: float) -> list[Cost]:
    """Runs the short range by both methods at each number of modes, interleaved; a run longer than LONG_S is not repeated.

    With the library in `peer`, it also runs a continuation of the harmonic-balance equations only, as for a method without stability, and
    one that computes an orbit at every point.
    """
    shuffled, began = random.Random(2), time.monotonic()
    names = [*JOUNCE_METHODS, *(WALKS if peer else [])]
    found = {(name, modes): Cost(name, modes) for modes in specs for name in names}
    jobs = [(shuffled.random(), key) for key in found for _ in range(repeats)]
    for done, (_, key) in enumerate(sorted(jobs)):
        cost = found[key]
        if cost.failed or any(taken_s > LONG_S for taken_s in cost.cpu_s):
            continue
        if peer and cost.method in WALKS:
            walked(peer, specs[cost.modes], cost, cap_s)
            continue
        finished = finish([str(program), *jounce_words(specs[cost.modes], JOUNCE_METHODS[cost.method], *SHORT_HZ)], BUILD, cap_s)
        branch = read_jounce(finished)
        cost.failed, cost.points = branch.failed, branch.points
        if not branch.failed:
            cost.cpu_s.append(finished.cpu_s)
        if done % 10 == 0:
            say(f"cost per point: run {done + 1} of {len(jobs)}, {time.monotonic() - began:.0f} s")
    return list(found.values())
