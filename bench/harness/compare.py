"""Errors relative to a reference on which two methods agree, and times at the same error."""

from __future__ import annotations

import math
from pathlib import Path

from .measure import Result, outcome, parameter_file
from .plant import Case, Plant

AGREEMENT = 1e-10
FINEST_STEPS_PER_S = "2000000"
TIGHTEST = ("1e-13", "1e-19")


class NoReferenceError(ArithmeticError):
    """The two methods do not agree, or one cannot be run."""


def reference_w(plant: Plant, case: Case, rk4: Path, dop853: Path, steps_per_s: str = FINEST_STEPS_PER_S) -> tuple[float, float]:
    """Returns the mean power by RK4 in very many steps, W, and its relative distance from DOP853 at a tolerance of 1e-13."""
    file = str(parameter_file(plant, case))
    found = [outcome([str(rk4), file, steps_per_s], 600.0), outcome([str(dop853), file, *TIGHTEST], 600.0)]
    for each in found:
        if "failed" in each:
            raise NoReferenceError(f"{plant.path.name}, {case.title}: {each['failed']}")
    fixed, adaptive = (float(each["mean_power_w"]) for each in found)
    apart = abs(fixed / adaptive - 1.0)
    if apart > AGREEMENT:
        raise NoReferenceError(f"{plant.path.name}, {case.title}: {fixed!r} W and {adaptive!r} W differ by {apart:.1e}")
    return fixed, apart


def set_errors(results: list[Result], references_w: dict[str, float]) -> None:
    """Sets the relative error of the mean power in every result that has one; a step beyond the stability limit gives no error."""
    for result in results:
        if result.mean_power_w is None:
            continue
        if math.isfinite(result.mean_power_w):
            result.error = abs(result.mean_power_w / references_w[result.case] - 1.0)
        else:
            result.failed = f"mean power {result.mean_power_w}: unstable at this step"


def curve(results: list[Result], case: str, peer: str) -> list[tuple[float, float]]:
    """Returns (error, median time) of one peer from loose to tight; the error is the largest at the setting or any tighter one.

    An error that crosses zero by chance at one setting therefore does not count as accuracy.
    """
    ladder = [r for r in results if r.case == case and r.peer == peer and r.error is not None and r.cpu_s]
    points: list[tuple[float, float]] = []
    worst = 0.0
    for result in reversed(ladder):
        worst = max(worst, result.error or 0.0)
        points.append((worst, result.median_s))
    return points[::-1]


def time_at(points: list[tuple[float, float]], error: float) -> float | None:
    """Returns the time at which a curve reaches an error, interpolated in logarithms; None if it never does."""
    if not points or error < points[-1][0]:
        return None
    for (loose, early), (tight, late) in zip(points, points[1:], strict=False):
        if tight <= error <= loose and tight < loose:
            part = math.log(error / loose) / math.log(max(tight, 1e-300) / loose)
            return math.exp(math.log(early) + part * math.log(late / early))
    return points[0][1]
