"""Design: values of keys with the largest power within limits."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from ._errors import ArgumentError, FileError
from ._fields import About, Along
from ._format import html_table
from ._quantity import inline_toml, toml
from ._result import Floats, Result, column

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset

    from ._spec import Spec
else:
    # The module of Spec imports this one, so the name is looked up when a dataset is made.
    Spec = Any

# Reasons of the end of a search, in words.
#: Text and unit of each goal.
GOALS = {
    "expected-power": ("Expected power", "W"),
    "stable-power": ("Power of the best stable orbit", "W"),
    "mean-power": ("Mean power", "W"),
    "time-on": ("Share of the time on", ""),
    "power-margin": ("Power margin", "W"),
    "bandwidth": ("Half-power bandwidth", "Hz"),
}

_ENDS = {
    "converged": "ended because no better design is expected",
    "evaluations": "ended because the next step would exceed the number of evaluations",
    "seconds": "ended because its wall time was used up",
    "stopped": "stopped",
}


def _limit_text(limit: dict[str, Any]) -> str:
    state = ", not met" if limit["violation"] > 0 else ", binds" if limit["active"] else ""
    noise = limit["noise"]
    others = f", beyond it in {noise['exceeded']} of {noise['realisations']} other realisations of the noise" if noise else ""
    side = "at least" if limit["is_lower"] else "at most"
    return f"{limit['value']:.6g} of {side} {limit['limit']:.6g}{state}{others}"


def _noise_text(noise: dict[str, Any]) -> str:
    interval = f"({noise['mean_power_low_w']:.3g} to {noise['mean_power_high_w']:.3g})"
    return f"{noise['mean_power_w']:.6g} W {interval} under {noise['realisations']} other realisations of the noise"


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class DesignResult(Result):
    """Best design with its limits, its robustness and, for several goals, the front."""

    key: Annotated[list[str], About("free keys", axes="key")]
    value: Annotated[list[str], About("best values, with units", axes="key")]
    before: Annotated[list[str], About("values in the spec, with units", axes="key")]
    at_end: Annotated[list[str], About('end of its range that a value has, ``"lower"`` or ``"upper"``; empty inside', axes="key")]
    goals: Annotated[dict[str, float], About("value of each goal by its name: a power in W, a bandwidth in Hz, a share of the time")]
    goals_before: Annotated[dict[str, float], About("value of each goal of the spec as given")]
    mean_power_w: Annotated[float, About("mean power of the main orbit, or of the run of a goal ``mean-power``; NaN without either", "W")]
    expected_power_w: Annotated[float, About("expected power of a start", "W")]
    expected_power_low_w: Annotated[float, About("lower end of its 95 % interval", "W")]
    expected_power_high_w: Annotated[float, About("upper end of its 95 % interval", "W")]
    basin_fraction: Annotated[float, About("share of the starts that reach the main orbit")]
    basin_fraction_low: Annotated[float, About("lower end of its 95 % interval")]
    basin_fraction_high: Annotated[float, About("upper end of its 95 % interval")]
    stable: Annotated[bool, About("True where the main orbit is stable; False without an orbit")]
    period_cycles: Annotated[int, About("period of the main orbit in drive cycles; 0 without an orbit")]
    nearest_fold: Annotated[
        dict[str, Any] | None,
        About("nearest fold over the frequency of the drive: ``key``, ``frequency_hz``, ``distance_hz``"),
    ]
    noise: Annotated[
        dict[str, Any] | None,
        About(
            "mean power under realisations of the noise other than that of the search: ``realisations``, ``mean_power_w``, "
            "``mean_power_low_w``, ``mean_power_high_w``; ``None`` without a goal ``mean-power`` under noise"
        ),
    ]
    limits: Annotated[
        list[dict[str, Any]],
        About(
            "limits: ``name``, ``value``, ``limit``, ``is_lower``, ``violation``, ``active``, ``price``, ``noise``; SI. "
            "``value`` is the worst of all conditions, attractors and realisations, ``is_lower`` is True where it must be at "
            "least the limit; ``noise`` has ``realisations``, ``exceeded``, ``exceeded_fraction_low`` and "
            "``exceeded_fraction_high``, of other realisations than that of the search, or is ``None``"
        ),
    ]
    robust: Annotated[dict[str, Any] | None, About("quantiles and Sobol indices of the power; ``None`` without tolerances")]
    front: Annotated[list[dict[str, Any]], About("designs that no other beats in all goals: ``set`` and ``goals``; empty for one goal")]
    feasible: Annotated[bool, About("True within all limits")]
    violation: Annotated[float, About("sum of the violations of the limits, each from 0 within the limit to 1 for an unknown value")]
    ended_by: Annotated[str, About('reason of the end: ``"converged"``, ``"evaluations"``, ``"seconds"`` or ``"stopped"``')]
    warnings: Annotated[
        list[str],
        About(
            "free keys that change neither a goal nor a limit at the best design, and a bifurcation nearer than the nearest fold, "
            "one sentence each"
        ),
    ]
    trace_evaluation: Annotated[Floats, Along("step", "", "number of evaluated designs", "evaluation")]
    trace_goal: Annotated[Floats, Along("step", "", "first goal of the best design", "goal")]
    trace_violation: Annotated[Floats, Along("step", "", "sum of its relative violations", "violation")]
    evaluations: Annotated[int, About("number of evaluated designs")]
    seed: Annotated[int, About("seed")]
    spec: Annotated[Spec, About("harvester of the best design")]
    wall_time_s: Annotated[float, About("wall time", "s")] = dataclasses.field(compare=False)

    def __len__(self) -> int:
        return len(self.key)

    def _summary(self) -> list[tuple[str, str]]:
        interval = f" ({self.expected_power_low_w:.3g} to {self.expected_power_high_w:.3g})"
        goals = []
        for name, value in self.goals.items():
            now, before = (f"{number:.6g} {GOALS[name][1]}".rstrip() for number in (value, self.goals_before.get(name, np.nan)))
            goals.append((name, f"{now}{interval if name == 'expected-power' else ''}, before {before}"))
        keys = [(key, f"{self.value[k]}, before {self.before[k]}") for k, key in enumerate(self.key)]
        orbit = f"period {self.period_cycles}, {self.mean_power_w:.6g} W, reached by {100 * self.basin_fraction:.1f} % of the starts"
        limits = [(one["name"], _limit_text(one)) for one in self.limits if one["value"] is not None]
        orbits = [("orbit", orbit)] if self.stable else []
        noise = [("noise", _noise_text(self.noise))] if self.noise else []
        end = f"{self.evaluations} evaluations; {_ENDS[self.ended_by]}{'' if self.feasible else '; beyond the limits'}"
        warnings = [("warning", text) for text in self.warnings]
        return [*goals, *keys, *orbits, *noise, *limits, *warnings, ("search", end)]

    def _repr_html_(self) -> str:
        rows = [list(row) for row in zip(self.key, self.value, self.before, self.at_end)]
        return html_table("Design", ["", ""], self._summary()) + html_table("Keys", ["key", "value", "before", "at end"], rows)

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` of the better and better designs over ``step``."""
        return self._dataset(self._variables(), {})

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each free key."""
        return self._frame({"key": self.key, "value": self.value, "before": self.before, "at_end": self.at_end})

    def front_to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each design of the front: its goals and its keys."""
        rows = [{**one["goals"], **one["set"]} for one in self.front]
        # A design has the keys of its choices only.
        names = list(dict.fromkeys(name for row in rows for name in row))
        return self._frame({name: [row.get(name, "") for row in rows] for name in names})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        pictures: dict[str, Callable[[Any], Any]] = {"trace": self.plot_trace}
        return {"front": self.plot_front, **pictures} if self.front else pictures

    def plot_trace(self, ax: Axes | None = None) -> Axes:
        """Draws the first goal of the best design within the limits over the number of evaluated designs."""
        from ._plot.design import plot_trace

        return plot_trace(self, ax)

    def plot_front(self, ax: Axes | None = None) -> Axes:
        """Draws the front over its first two goals."""
        from ._plot.design import plot_front

        return plot_front(self, ax)


def problem_text(problem: str | PathLike[str] | Mapping[str, Any]) -> tuple[str, Path | None, str]:
    """Returns the text of a design problem, the folder of its file, and its name for the manifest."""
    if isinstance(problem, Mapping):
        tables = dict(problem)
        conditions = tables.pop("conditions", [])
        return toml(tables) + "".join(map(_condition, conditions)), None, "problem"
    if isinstance(problem, (str, PathLike)):
        try:
            return Path(problem).read_text(encoding="utf-8"), Path(problem).parent, Path(problem).name
        except (OSError, UnicodeDecodeError) as error:
            raise FileError(f"the design {problem} cannot be read: {error}", {"path": str(problem)}) from error
    raise ArgumentError(f"problem is of type {type(problem).__name__}; give the path of a design file, or a dict with the same contents")


def _condition(condition: Mapping[str, Any]) -> str:
    rest = {key: value for key, value in condition.items() if key != "set"}
    return f"\n[[conditions]]\nset = {inline_toml(condition.get('set', {}))}\n{toml(rest)}"


def make_design(result: dict[str, Any], spec: Spec, manifest: dict[str, Any]) -> DesignResult:
    """Returns the design of a result of the library, with the best spec."""
    best, keys, trace = result["best"], result["best"]["keys"], result["trace"]
    of_best = {name: value for name, value in best.items() if name not in ("set", "keys")}
    names = ("limits", "robust", "front", "feasible", "violation", "ended_by", "warnings", "evaluations", "seed", "wall_time_s")
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
