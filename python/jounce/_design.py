"""Design: values of keys with the largest power within limits."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import ArgumentError, FileError
from ._format import html_table
from ._quantity import toml
from ._result import Floats, Result, Variable, column

if TYPE_CHECKING:
    from ._spec import Spec
else:
    # The module of Spec imports this one, so the name is looked up when a dataset is made.
    Spec = Any


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class DesignResult(Result):
    """Best design with its limits, its robustness and, for several goals, the front."""

    #: Free keys, their best values and those in the spec, with units; the end of its range that a value has, ``"lower"``, ``"upper"`` or ``""``.
    key: list[str]
    value: list[str]
    before: list[str]
    at_end: list[str]
    #: Value of each goal by its name, in W or Hz, of the best design and of the spec as given.
    goals: dict[str, float]
    goals_before: dict[str, float]
    #: Mean power of the main orbit, W.
    mean_power_w: float
    #: Expected power of a start, W, with the ends of its 95 % interval.
    expected_power_w: float
    expected_power_low_w: float
    expected_power_high_w: float
    #: Share of the starts that reach the main orbit, with the ends of its 95 % interval.
    basin_fraction: float
    basin_fraction_low: float
    basin_fraction_high: float
    #: True where the main orbit is stable; its period in drive cycles, 0 without an orbit.
    stable: bool
    period_cycles: int
    #: Nearest fold of the main orbit over the frequency of the drive: ``key``, ``frequency_hz``, ``distance_hz``; ``None`` without one.
    nearest_fold: dict[str, Any] | None
    #: Limits: ``name``, ``value`` and ``limit`` in SI, ``active``, and the ``price``, W per SI unit, of one that binds.
    limits: list[dict[str, Any]]
    #: Quantiles and Sobol indices of the power under the tolerances; ``None`` without tolerances.
    robust: dict[str, Any] | None
    #: Designs that no other beats in all goals: ``set`` and ``goals``; empty for one goal.
    front: list[dict[str, Any]]
    #: True within all limits; else the sum of the relative violations.
    feasible: bool
    violation: float
    #: Reason of the end: ``"converged"``, ``"evaluations"``, ``"seconds"`` or ``"stopped"``.
    ended_by: str
    #: Better and better designs: number of evaluated designs, first goal, and violation; arrays of shape ``(step,)``.
    trace_evaluation: Floats
    trace_goal: Floats
    trace_violation: Floats
    #: Number of evaluated designs, and the seed.
    evaluations: int
    seed: int
    wall_time_s: float = dataclasses.field(compare=False)
    #: Harvester of the best design.
    spec: Spec

    def __len__(self) -> int:
        return len(self.key)

    def _summary(self) -> list[tuple[str, str]]:
        units = {name: "Hz" if name == "bandwidth" else "W" for name in self.goals}
        goals = [
            (name, f"{value:.6g} {units[name]}, before {self.goals_before.get(name, np.nan):.6g} {units[name]}")
            for name, value in self.goals.items()
        ]
        keys = [(key, f"{self.value[k]}, before {self.before[k]}") for k, key in enumerate(self.key)]
        orbit = f"period {self.period_cycles}, {self.mean_power_w:.6g} W, reached by {100 * self.basin_fraction:.1f} % of the starts"
        limits = [
            (one["name"], f"{one['value']:.6g} of {one['limit']:.6g}{', binds' if one['active'] else ''}")
            for one in self.limits
            if one["value"] is not None
        ]
        end = f"{self.evaluations} designs, ended by {self.ended_by}{'' if self.feasible else ', beyond the limits'}"
        return [*goals, *keys, *([("orbit", orbit)] if self.stable else []), *limits, ("search", end)]

    def _repr_html_(self) -> str:
        rows = [list(row) for row in zip(self.key, self.value, self.before, self.at_end)]
        return html_table("Design", ["", ""], self._summary()) + html_table("Keys", ["key", "value", "before", "at end"], rows)

    def to_xarray(self) -> Any:
        """Returns an ``xarray.Dataset`` of the better and better designs over ``step``."""
        variables = {
            "evaluation": Variable(("step",), self.trace_evaluation, "", "number of evaluated designs"),
            "goal": Variable(("step",), self.trace_goal, "", "first goal"),
            "violation": Variable(("step",), self.trace_violation, "", "sum of the relative violations"),
        }
        return self._dataset(variables, {})

    def to_pandas(self) -> Any:
        """Returns a ``pandas.DataFrame`` with a row for each free key."""
        return self._frame({"key": self.key, "value": self.value, "before": self.before, "at_end": self.at_end})

    def front_to_pandas(self) -> Any:
        """Returns a ``pandas.DataFrame`` with a row for each design of the front: its goals and its keys."""
        rows = [{**one["goals"], **one["set"]} for one in self.front]
        names = list(rows[0]) if rows else []
        return self._frame({name: [row[name] for row in rows] for name in names})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        pictures: dict[str, Callable[[Any], Any]] = {"trace": self.plot_trace}
        return {"front": self.plot_front, **pictures} if self.front else pictures

    def plot_trace(self, ax: Any = None) -> Any:
        """Draws the first goal of the best design within the limits over the number of evaluated designs."""
        from ._plot.design import plot_trace

        return plot_trace(self, ax)

    def plot_front(self, ax: Any = None) -> Any:
        """Draws the front over its first two goals."""
        from ._plot.design import plot_front

        return plot_front(self, ax)


def problem_text(problem: str | PathLike[str] | Mapping[str, Any]) -> tuple[str, str]:
    """Returns the text of a design problem, and its name for the manifest."""
    if isinstance(problem, Mapping):
        tables = dict(problem)
        conditions = tables.pop("conditions", [])
        return toml(tables) + "".join(map(_condition, conditions)), "problem"
    if isinstance(problem, (str, PathLike)):
        try:
            return Path(problem).read_text(encoding="utf-8"), Path(problem).name
        except (OSError, UnicodeDecodeError) as error:
            raise FileError(f"the design {problem} cannot be read: {error}", {"path": str(problem)}) from error
    raise ArgumentError(f"problem is of type {type(problem).__name__}; give the path of a design file, or a dict with the same contents")


def _condition(condition: Mapping[str, Any]) -> str:
    rest = {key: value for key, value in condition.items() if key != "set"}
    return f"\n[[conditions]]\n{toml(rest)}\n[conditions.set]\n{toml(dict(condition.get('set', {})))}"


def make_design(result: dict[str, Any], spec: Spec, manifest: dict[str, Any]) -> DesignResult:
    """Returns the design of a result of the library, with the best spec."""
    best, keys, trace = result["best"], result["best"]["keys"], result["trace"]
    of_best = {name: value for name, value in best.items() if name not in ("set", "keys")}
    names = ("limits", "robust", "front", "feasible", "violation", "ended_by", "evaluations", "seed", "wall_time_s")
    return DesignResult(
        manifest=manifest,
        key=[one["key"] for one in keys],
        value=[one["value"] for one in keys],
        before=[one["before"] for one in keys],
        at_end=[one["at_end"] or "" for one in keys],
        **of_best,
        goals_before=result["before"]["goals"],
        trace_evaluation=column(trace, "evaluation"),
        trace_goal=column(trace, "goal"),
        trace_violation=column(trace, "violation"),
        spec=spec,
        **{name: result[name] for name in names},
    )
