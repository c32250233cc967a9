"""One design as the peers of `design.py` evaluate it, by calls of jounce's Python package.

Three evaluations:

- `of_basins`: expected power of the proved attractors of the starts, their strain, and the share of the main one, from `Spec.basins`;
- `of_design`: the same from `Spec.design` with a range of no width, for problems with a bandwidth or with much chaos, where it is cheaper;
- `of_run`: mean power at the end of one run of 20 s from rest, without limits: the objective that transients may mislead.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .design_problems import BISTABLE, Problem

#: Options of the evaluation with all starts inside `jounce design`.
TOLERANCE, MAX_CYCLES = 1e-8, 600

#: Starts that are integrated first: where none is proved to reach an orbit, 90 % of 20 cannot be, and the rest is left out.
FIRST_STARTS = 3

RUN_S, AVERAGE_S = 20.0, 10.0
STRAIN = re.compile(r"its strain reaches -?(\d+) ppm")


@dataclass(frozen=True)
class Evaluation:
    """Goals in SI and the sum of the violations of the limits, each from 0 to 1, as `jounce design` defines it."""

    goals: tuple[float, ...]
    violation: float


Evaluator = Callable[[tuple[float, ...]], Evaluation]


def spec_of(problem: Problem) -> Any:  # noqa: ANN401 (jounce is imported only where it runs)
    """Returns the spec as given, in the conditions of the problem."""
    import jounce

    spec = jounce.Spec(BISTABLE) if problem.spec is None else jounce.read(problem.spec)
    return spec.changed(problem.settings | problem.values(problem.start()))


def upper_violation(value: float, limit: float) -> float:
    """Returns the violation of an upper limit."""
    return max(0.0, 1.0 - limit / value)


def lower_violation(value: float, limit: float) -> float:
    """Returns the violation of a lower limit."""
    return max(0.0, 1.0 - value / limit)


def strain_ppm(messages: list[str]) -> float:
    """Returns the largest strain in the warnings of a basin study, which give it with its sign as a whole number of ppm."""
    return max((float(found) for message in messages for found in STRAIN.findall(message)), default=0.0)


Strain = tuple[float, float]  # largest value and limit, ppm


def judged(powers_w: list[float], shares: list[float], periods: list[int], least_share: float, strain: Strain | None) -> Evaluation:
    """Returns the evaluation of attractors: a start without a period has no power, and its strain is unknown."""
    proved = [(power * share, share) for power, share, period in zip(powers_w, shares, periods, strict=True) if period > 0]
    main_share = max(proved, default=(0.0, 0.0))[1]
    violation = lower_violation(main_share, least_share)
    if strain:
        unknown = 1.0 - sum(share for _, share in proved)
        violation += (upper_violation(*strain) if proved else 1.0) + (unknown if unknown > 1e-9 else 0.0)
    return Evaluation((sum((power for power, _ in proved), 0.0),), violation)


def of_basins(problem: Problem, seed: int) -> Evaluator:
    """Evaluates by `Spec.basins`."""
    has_strain = "patch.mfc.strain" in problem.limits
    # A recommended limit far below any strain makes the study report the strain of every design.
    base = spec_of(problem).changed({"patch.mfc.strain_limit": "1e-9"} if has_strain else {})
    least_share = float(str(problem.limits["basin_fraction"]))
    given = {"seed": seed, "tolerance": TOLERANCE, "max_cycles": MAX_CYCLES, "threads": 1}

    def evaluate(place: tuple[float, ...]) -> Evaluation:
        spec = base.changed(problem.values(place))
        if not (spec.basins(starts=FIRST_STARTS, **given).period_cycles > 0).any():
            return judged([], [], [], least_share, (1.0, 1.0) if has_strain else None)
        found = spec.basins(starts=problem.starts, **given)
        strain = (strain_ppm(found.warnings), 600.0) if has_strain else None
        return judged(found.mean_power_w.tolist(), found.fraction.tolist(), found.period_cycles.tolist(), least_share, strain)

    return evaluate


def design_once(problem: Problem, place: tuple[float, ...], seed: int, starts: int | None = None) -> Any:  # noqa: ANN401 (as above)
    """Returns the result of `Spec.design` for one design: the first key is free in a range of a ten-millionth of its value."""
    key, value = problem.keys[0], problem.keys[0].value(place[0])
    free = {key.path: f"{value!r}{key.unit}:{value * (1.0 + 1e-7)!r}{key.unit}"}
    spec = spec_of(problem).changed(problem.values(place))
    return spec.design(problem.design(1, free, starts), seed=seed, threads=1)


def of_design(problem: Problem, seed: int) -> Evaluator:
    """Evaluates by `Spec.design`."""

    def evaluate(place: tuple[float, ...]) -> Evaluation:
        found = design_once(problem, place, seed)
        return Evaluation(tuple(found.goals[name] for name in problem.goals), found.violation)

    return evaluate


def run_w(problem: Problem, place: tuple[float, ...], length_s: float, average_s: float) -> float:
    """Returns the mean power at the end of a run from rest, W, settled or not."""
    spec = spec_of(problem).changed(problem.values(place) | {"run.duration": f"{length_s!r} s", "run.average_over": f"{average_s!r} s"})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return float(spec.run().mean_power_w)


def of_run(problem: Problem, seed: int) -> Evaluator:
    """Evaluates by one run; the seed has no effect."""
    return lambda place: Evaluation((run_w(problem, place, RUN_S, AVERAGE_S),), 0.0)


def evaluator_of(problem: Problem, seed: int) -> Evaluator:
    """Returns the evaluation of a problem that is exact and cheapest."""
    return of_basins(problem, seed) if len(problem.goals) == 1 and "basin_fraction" in problem.limits else of_design(problem, seed)
