"""Branches of periodic orbits over one key."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Self

import numpy as np

from ._fields import About, Along, Variable, dataset_fields
from ._format import counted, html_table
from ._result import Data, Floats, Integers, Result, Truths

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False)
class Branch(Data):
    """Branch of periodic orbits; arrays of shape ``(point,)`` along it."""

    period_cycles: Annotated[int, About("period in drive cycles")]
    parameter: Annotated[Floats, About("value of the key", "SI", axes="point")]
    mean_power_w: Annotated[Floats, Along("point", "W", "mean power of all loads")]
    voltage_rms_v: Annotated[Floats, Along("point", "V", "rms voltage of the first load, else of the output of the first rectifier")]
    stable: Annotated[Truths, Along("point", "1", "attracts")]
    stability_undecided: Annotated[Truths, Along("point", "1", "a Floquet multiplier has modulus one within its error")]
    floquet_max_abs: Annotated[Floats, Along("point", "1", "largest modulus of a Floquet multiplier")]
    contacts_per_period: Annotated[Integers, Along("point", "1", "contacts per period")]
    max_penetration_m: Annotated[Floats, Along("point", "m", "largest penetration of the stop")]
    displacement_peak_m: Annotated[Floats, Along("point", "m", "half the peak-to-peak displacement at the first stop")]
    error_estimate: Annotated[Floats, Along("point", "1", "larger of the estimated relative errors of the state and the mean power")]
    bifurcation_kind: Annotated[
        list[str],
        About('``"fold"``, ``"period-doubling"``, ``"neimark-sacker"``, ``"branch-point"``, ``"grazing"``, ``"sticking"`` or ``"level"``'),
    ]
    bifurcation_level: Annotated[list[str | None], About("level that is crossed, as given; ``None`` for other kinds")]
    bifurcation_stop: Annotated[list[str | None], About("stop of a grazing or of sticking; ``None`` for other kinds")]
    bifurcation_parameter: Annotated[Floats, About("value of the key", "SI", axes="bifurcation")]
    bifurcation_parameter_error: Annotated[
        Floats, About("estimated error of the value of the key; NaN where the event ends the branch", "SI", axes="bifurcation")
    ]
    bifurcation_mean_power_w: Annotated[Floats, About("mean power of all loads", "W", axes="bifurcation")]
    bifurcation_displacement_peak_m: Annotated[
        Floats, About("half the peak-to-peak displacement at the first stop", "m", axes="bifurcation")
    ]
    bifurcation_contacts_per_period: Annotated[Integers, About("contacts in a period", axes="bifurcation")]
    not_proved: Annotated[
        list[dict[str, Any]],
        About("intervals on which the listed events of a kind are not proved: ``event``, ``from``, ``to``, ``message``"),
    ]
    not_followed: Annotated[
        int, About("period doublings whose branch was not continued: the budget was used up, or Newton iteration found no first orbit")
    ]
    termination: Annotated[
        list[dict[str, Any]],
        About(
            "termination at the first and the last point: ``reason``, and where continuation stopped early ``parameter`` and ``message``"
        ),
    ]
    peak: Annotated[
        dict[str, Any] | None,
        About("largest mean power of a stable orbit: ``parameter``, ``parameter_error``, ``mean_power_w``, ``at``; ``None`` without one"),
    ]
    half_power_bandwidth: Annotated[
        dict[str, Any] | None,
        About("half-power bandwidth of the stable part: ``width``, ``width_error``, ``intervals``; ``None`` without a peak"),
    ]

    @classmethod
    def _of(cls, fields: dict[str, Any]) -> Self:
        """Returns the branch of a dict of the library."""
        return cls(**cls._filled(fields))

    def __len__(self) -> int:
        return len(self.parameter)

    def _bifurcation_names(self) -> list[str | None]:
        """Returns the level or the stop of each bifurcation."""
        return [level or stop for level, stop in zip(self.bifurcation_level, self.bifurcation_stop)]


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class BranchResult(Result):
    """All branches that were found; can be iterated and indexed by number."""

    key: Annotated[str, About("key of the branches")]
    unit: Annotated[str, About("SI unit of the key")]
    branches: Annotated[list[Branch], About("branches that were found")]
    peak: Annotated[
        dict[str, Any] | None,
        About("largest mean power of a stable orbit on all branches: ``parameter``, ``parameter_error``, ``mean_power_w``, ``at``"),
    ]
    half_power_bandwidth: Annotated[
        dict[str, Any] | None,
        About("intervals where any stable orbit has at least half the power of the peak: ``width``, ``width_error``, ``intervals``"),
    ]
    note: Annotated[str, About("branches that the search may miss, and options that find more")]
    warnings: Annotated[
        list[str], About("branches that end early or are missing, events that are not proved, large errors, exceeded limits of patches")
    ]

    @classmethod
    def _from_core(cls, fields: dict[str, Any]) -> Self:
        return super()._from_core({**fields, "branches": [Branch._of(one) for one in fields["branches"]]})

    def __len__(self) -> int:
        return len(self.branches)

    def __getitem__(self, number: int) -> Branch:
        return self.branches[number]

    def __iter__(self) -> Iterator[Branch]:
        return iter(self.branches)

    def _summary(self) -> list[tuple[str, str]]:
        lines = [("over", f"{self.key} [{self.unit}]")]
        for number, one in enumerate(self.branches):
            points = f"{counted(len(one), 'point')}, {int(one.stable.sum())} of them stable"
            lines.append((f"branch {number}", f"period {one.period_cycles}: {points}"))
            for kind, name, at in zip(one.bifurcation_kind, one._bifurcation_names(), one.bifurcation_parameter):
                lines.append(("", f"{kind}{f' ({name})' if name else ''} at {at:.6g} {self.unit}"))
        if self.peak is not None and self.half_power_bandwidth is not None:
            lines.append(("highest stable power", f"{self.peak['mean_power_w']:.6e} W at {self.peak['parameter']:.6g} {self.unit}"))
            lines.append(("half-power bandwidth", f"{self.half_power_bandwidth['width']:.6g} {self.unit}"))
        return [*lines, *(("warning", text) for text in self.warnings), ("note", self.note)]

    def _repr_html_(self) -> str:
        rows = [
            [number, one.period_cycles, kind, f"{at:.6g}", f"{power:.5e}"]
            for number, one in enumerate(self.branches)
            for kind, at, power in zip(one.bifurcation_kind, one.bifurcation_parameter, one.bifurcation_mean_power_w)
        ]
        title = f"{counted(len(self), 'branch', 'branches')} over {self.key}"
        return html_table(title, ["branch", "period", "bifurcation", f"at [{self.unit}]", "mean power [W]"], rows)

    def _concatenated(self, field: str) -> Any:
        return np.concatenate([getattr(one, field) for one in self.branches]) if self.branches else np.empty(0)

    def _branch_numbers(self) -> Integers:
        return np.repeat(np.arange(len(self), dtype=np.int64), [len(one) for one in self.branches])

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``point`` (all branches in sequence, numbered by ``branch``) and ``bifurcation``."""
        variables = {along.name(field): along.of(self._concatenated(field)) for field, along in dataset_fields(Branch).items()}
        periods = np.repeat(np.array([one.period_cycles for one in self.branches], dtype=np.int64), [len(one) for one in self.branches])
        branch_numbers = [number for number, one in enumerate(self.branches) for _ in one.bifurcation_kind]
        variables |= {
            "branch": Variable(("point",), self._branch_numbers(), "1", "number of the branch"),
            "period_cycles": Variable(("point",), periods, "1", "period in drive cycles"),
            "bifurcation_mean_power": Variable(
                ("bifurcation",), self._concatenated("bifurcation_mean_power_w"), "W", "mean power of all loads"
            ),
            "bifurcation_branch": Variable(("bifurcation",), np.array(branch_numbers, dtype=np.int64), "1", "number of the branch"),
        }
        kinds = [kind for one in self.branches for kind in one.bifurcation_kind]
        coords = {
            self.key: Variable(("point",), self._concatenated("parameter"), self.unit, self.key),
            "bifurcation": Variable(("bifurcation",), kinds, "", "kind of the bifurcation"),
            "bifurcation_parameter": Variable(("bifurcation",), self._concatenated("bifurcation_parameter"), self.unit, self.key),
        }
        return self._dataset(variables, coords)

    def _root(self) -> Dataset:
        return self._dataset({}, {})

    def _parts(self) -> dict[str, Dataset]:
        alone = (dataclasses.replace(self, branches=[one]).to_xarray() for one in self.branches)
        return {f"branch_{number}": one for number, one in enumerate(alone)}

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each point of each branch."""
        periods = np.repeat([one.period_cycles for one in self.branches], [len(one) for one in self.branches])
        along = {field: self._concatenated(field) for field in ("parameter", *dataset_fields(Branch))}
        return self._frame({"branch": self._branch_numbers(), "period_cycles": periods, **along})

    def bifurcations_to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each bifurcation."""
        rows = [
            (number, *row)
            for number, one in enumerate(self.branches)
            for row in zip(
                one.bifurcation_kind,
                one.bifurcation_level,
                one.bifurcation_stop,
                one.bifurcation_parameter,
                one.bifurcation_mean_power_w,
            )
        ]
        names = ("branch", "kind", "level", "stop", "parameter", "mean_power_w")
        return self._frame({name: [row[k] for row in rows] for k, name in enumerate(names)})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        default = "mean_power_w" if any(one.mean_power_w.any() for one in self) else "displacement_peak_m"
        return {field: partial(self.plot_branch, quantity=field) for field in dict.fromkeys([default, *dataset_fields(Branch)])}

    def plot_branch(self, ax: Axes | None = None, *, quantity: str | None = None) -> Axes:
        """Draws a quantity over the key: stable solid, unstable dashed, bifurcations marked.

        The quantity is by default the mean power, or the displacement amplitude without power.
        """
        from ._plot.branch import plot_branch

        return plot_branch(self, ax, self.quantities[0] if quantity is None else quantity)
