"""Branches of periodic orbits over one key."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterator
from typing import Annotated, Any, Self

import numpy as np

from .result import Along, Data, Floats, Integers, Result, Truths, Variable, dataset_fields, html_table


@dataclasses.dataclass(frozen=True, eq=False)
class Branch(Data):
    """Branch of periodic orbits; arrays of shape ``(point,)`` along it."""

    period_cycles: int
    #: Value of the key, SI.
    parameter: Floats
    mean_power_w: Annotated[Floats, Along("point", "W", "mean power of all loads")]
    voltage_rms_v: Annotated[Floats, Along("point", "V", "rms voltage of the first load, else of the output of the first rectifier")]
    stable: Annotated[Truths, Along("point", "1", "attracts")]
    stability_undecided: Annotated[Truths, Along("point", "1", "a Floquet multiplier has modulus one within its error")]
    #: Largest modulus of a Floquet multiplier.
    floquet_max_abs: Annotated[Floats, Along("point", "1", "largest modulus of a Floquet multiplier")]
    contacts_per_period: Annotated[Integers, Along("point", "1", "contacts per period")]
    max_penetration_m: Annotated[Floats, Along("point", "m", "largest penetration of the stop")]
    displacement_peak_m: Annotated[Floats, Along("point", "m", "half the peak-to-peak displacement at the first stop")]
    #: Estimated relative error of the state.
    error_estimate: Annotated[Floats, Along("point", "1", "estimated relative error of the state")]
    #: ``"fold"``, ``"period-doubling"``, ``"neimark-sacker"``, ``"branch-point"``, ``"grazing"``, ``"sticking"``, ``"level"``.
    bifurcation_kind: list[str]
    #: Level of the event, or stop of a grazing; ``None`` for the others.
    bifurcation_name: list[str | None]
    bifurcation_parameter: Floats
    bifurcation_power_w: Floats
    bifurcation_displacement_peak_m: Floats
    #: Segments that may contain two more events of a kind than are listed: ``event``, ``from``, ``to``, ``why``.
    not_proved: list[dict[str, Any]]
    #: Number of period doublings whose branch was not continued: the budget was used up, or Newton iteration found no first orbit.
    not_followed: int
    #: Terminations of the two ends of the branch.
    endings: list[dict[str, Any]]
    #: Peak and half-power bandwidth of the stable part; ``None`` without a stable part.
    half_power: dict[str, Any] | None

    @classmethod
    def made(cls, one: dict[str, Any]) -> Self:
        """Returns the branch of a result of the compiled module."""
        return cls(**{**one, **{name: json.loads(one[name]) for name in ("not_proved", "endings", "half_power")}})

    def __len__(self) -> int:
        return len(self.parameter)


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class BranchResult(Result):
    """All branches that were found; can be iterated and indexed by number."""

    key: str
    unit: str
    branches: list[Branch]
    #: Warnings about exceeded limits of patches over a period.
    warnings: list[str]
    #: Peak of all branches combined, and the intervals where a stable orbit has at least half of it: ``peak``, ``width``, ``width_error``,
    #: ``intervals``.
    half_power: dict[str, Any] | None

    @classmethod
    def _from_core(cls, result: dict[str, Any]) -> Self:
        branches = [Branch.made(one) for one in result["branches"]]
        return super()._from_core({**result, "branches": branches, "half_power": json.loads(result["half_power"])})

    def __len__(self) -> int:
        return len(self.branches)

    def __getitem__(self, number: int) -> Branch:
        return self.branches[number]

    def __iter__(self) -> Iterator[Branch]:
        return iter(self.branches)

    def _summary(self) -> list[tuple[str, str]]:
        lines = [("over", f"{self.key} [{self.unit}]")]
        for number, one in enumerate(self.branches):
            lines.append((f"branch {number}", f"period {one.period_cycles}: {len(one)} points, {int(one.stable.sum())} of them stable"))
            for kind, name, at in zip(one.bifurcation_kind, one.bifurcation_name, one.bifurcation_parameter):
                lines.append(("", f"{kind}{f' ({name})' if name else ''} at {at:.6g} {self.unit}"))
            for segment in one.not_proved:
                lines.append(
                    (
                        "warning",
                        f"from {segment['from']:.6g} to {segment['to']:.6g} {self.unit} two more events {segment['event']} are possible",
                    )
                )
            if one.not_followed:
                lines.append(("warning", f"the branches of {one.not_followed} period doublings were not continued"))
        if self.half_power is not None:
            peak, width = self.half_power["peak"], self.half_power["width"]
            lines.append(("highest stable power", f"{peak['mean_power_w']:.6e} W at {peak['parameter']:.6g} {self.unit}"))
            lines.append(("half-power bandwidth", f"{width:.6g} {self.unit}"))
        return [*lines, *(("warning", text) for text in self.warnings)]

    def _repr_html_(self) -> str:
        rows = [
            [number, one.period_cycles, kind, f"{at:.6g}", f"{power:.5e}"]
            for number, one in enumerate(self.branches)
            for kind, at, power in zip(one.bifurcation_kind, one.bifurcation_parameter, one.bifurcation_power_w)
        ]
        title = f"{len(self)} branches over {self.key}"
        return html_table(title, ["branch", "period", "bifurcation", f"at [{self.unit}]", "mean power [W]"], rows)

    def _concatenated(self, field: str) -> Any:
        return np.concatenate([getattr(one, field) for one in self.branches]) if self.branches else np.empty(0)

    def _branch_numbers(self) -> Integers:
        return np.repeat(np.arange(len(self), dtype=np.int64), [len(one) for one in self.branches])

    def to_xarray(self) -> Any:
        """Returns an ``xarray.Dataset`` over ``point`` (all branches in sequence, numbered by ``branch``) and ``bifurcation``."""
        variables = {"parameter": Variable(("point",), self._concatenated("parameter"), self.unit, self.key)}
        variables |= {along.name(field): along.of(self._concatenated(field)) for field, along in dataset_fields(Branch).items()}
        periods = np.repeat(np.array([one.period_cycles for one in self.branches], dtype=np.int64), [len(one) for one in self.branches])
        branch_numbers = [number for number, one in enumerate(self.branches) for _ in one.bifurcation_kind]
        variables |= {
            "branch": Variable(("point",), self._branch_numbers(), "1", "number of the branch"),
            "period_cycles": Variable(("point",), periods, "1", "period in drive cycles"),
            "bifurcation_parameter": Variable(("bifurcation",), self._concatenated("bifurcation_parameter"), self.unit, self.key),
            "bifurcation_power": Variable(("bifurcation",), self._concatenated("bifurcation_power_w"), "W", "mean power of all loads"),
            "bifurcation_branch": Variable(("bifurcation",), np.array(branch_numbers, dtype=np.int64), "1", "number of the branch"),
        }
        kinds = [kind for one in self.branches for kind in one.bifurcation_kind]
        coords = {"bifurcation": Variable(("bifurcation",), kinds, "", "kind of the bifurcation")}
        return self._dataset(variables, coords)

    def to_pandas(self) -> Any:
        """Returns a ``pandas.DataFrame`` with a row for each point of each branch."""
        periods = np.repeat([one.period_cycles for one in self.branches], [len(one) for one in self.branches])
        along = {field: self._concatenated(field) for field in ("parameter", *dataset_fields(Branch))}
        return self._frame({"branch": self._branch_numbers(), "period_cycles": periods, **along})

    def bifurcations_to_pandas(self) -> Any:
        """Returns a ``pandas.DataFrame`` with a row for each bifurcation."""
        rows = [
            (number, kind, name, at, power)
            for number, one in enumerate(self.branches)
            for kind, name, at, power in zip(one.bifurcation_kind, one.bifurcation_name, one.bifurcation_parameter, one.bifurcation_power_w)
        ]
        names = ("branch", "kind", "name", "parameter", "mean_power_w")
        return self._frame({name: [row[k] for row in rows] for k, name in enumerate(names)})

    def plot_branch(self, ax: Any = None) -> Any:
        """Draws mean power, or displacement amplitude without power, over the key: stable solid, unstable dashed, bifurcations marked."""
        from .plot.branch import plot_branch

        return plot_branch(self, ax)
