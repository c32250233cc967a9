"""Derivatives of the results of a periodic orbit with respect to keys of the spec."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from ._fields import About, Along, Variable
from ._named import look_up
from ._result import Floats, Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class SensitivityResult(Result):
    """Derivatives of the results of an orbit; arrays of shape ``(key, quantity)``, the largest relative one of the mean power first."""

    at: Annotated[str, About("id of the orbit, as in :meth:`Spec.basins`")]
    period_cycles: Annotated[int, About("period in drive cycles")]
    mean_power_w: Annotated[float, About("mean power of the orbit", "W")]
    key: Annotated[list[str], About("keys", axes="key")]
    key_unit: Annotated[list[str], About("SI units of the keys", axes="key")]
    value: Annotated[Floats, About("values of the keys, SI", axes="key")]
    quantity: Annotated[list[str], About('results of the orbit, ``"mean_power"`` first', axes="quantity")]
    quantity_unit: Annotated[list[str], About("SI units of the results", axes="quantity")]
    quantity_value: Annotated[Floats, About("values of the results, SI", axes="quantity")]
    derivative: Annotated[Floats, Along("key quantity", "", "derivative of the result by the key, SI")]
    relative: Annotated[Floats, Along("key quantity", "1", "relative change of the result per relative change of the key")]
    relative_error: Annotated[Floats, Along("key quantity", "1", "estimated error of the relative change")]
    grazing_change: Annotated[Floats, Along("key", "", "change of the key that leads to the nearest grazing, to first order, SI")]
    grazing: Annotated[
        dict[str, str] | None,
        About(
            "nearest grazing: ``stop``; ``turning_point``, ``maximum`` where a contact appears or ``minimum`` where one is divided; "
            "``side`` of the orbit, ``contact`` or ``no-contact``; derivatives ``across`` the grazing, ``continuous``, ``jump`` or "
            "``unbounded``"
        ),
    ]
    failed: Annotated[dict[str, str], About("keys without derivatives, with the reason")]

    def __len__(self) -> int:
        return len(self.key)

    def _summary(self) -> list[tuple[str, str]]:
        def text(k: int) -> str:
            return f"{self.relative[k, 0]:+.4f} % of power for 1 % more of {self.value[k]:.6g} {self.key_unit[k]}"

        rows = [(key, text(k)) for k, key in enumerate(self.key)]
        failed = [(key, f"no derivative: {reason}") for key, reason in self.failed.items()]
        return [("orbit", f"{self.at}, {self.mean_power_w:.6g} W"), *rows, *failed]

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``key`` and ``quantity``."""
        coords = {
            "key": Variable(("key",), self.key, "", "key"),
            "key_unit": Variable(("key",), self.key_unit, "", "SI unit of the key"),
            "value": Variable(("key",), self.value, "", "value of the key, SI"),
            "quantity": Variable(("quantity",), self.quantity, "", "result of the orbit"),
            "quantity_unit": Variable(("quantity",), self.quantity_unit, "", "SI unit of the result"),
            "quantity_value": Variable(("quantity",), self.quantity_value, "", "value of the result, SI"),
        }
        return self._dataset(self._variables(), coords)

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each key: its value, and the relative derivative of each result."""
        relative = {name: self.relative[:, k] for k, name in enumerate(self.quantity)}
        return self._frame({"key": self.key, "unit": self.key_unit, "value": self.value, **relative})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {name: partial(self.plot_sensitivity, quantity=name) for name in self.quantity}

    def plot_sensitivity(self, ax: Axes | None = None, quantity: str = "mean_power") -> Axes:
        """Draws the relative derivatives of a result as bars, the largest first."""
        from ._plot.sensitivity import plot_sensitivity

        columns = {name: k for k, name in enumerate(self.quantity)}
        return plot_sensitivity(self, look_up(columns, quantity, "quantity"), ax)


def make_sensitivity(result: dict[str, Any], manifest: dict[str, Any]) -> SensitivityResult:
    """Returns the result of the library."""
    keys, quantities = result["keys"], result["quantities"]

    def table(name: str) -> Floats:
        rows = [[np.nan if one[name] is None else one[name] for one in key["derivatives"]] for key in keys]
        return np.array(rows, dtype=np.float64).reshape(len(keys), len(quantities))

    return SensitivityResult(
        manifest=manifest,
        at=result["at"],
        period_cycles=result["period_cycles"],
        mean_power_w=result["mean_power_w"],
        key=[one["key"] for one in keys],
        key_unit=[one["unit"] for one in keys],
        value=np.array([one["value"] for one in keys], dtype=np.float64),
        quantity=[one["name"] for one in quantities],
        quantity_unit=[one["unit"] for one in quantities],
        quantity_value=np.array([np.nan if one["value"] is None else one["value"] for one in quantities], dtype=np.float64),
        derivative=table("derivative"),
        relative=table("relative"),
        relative_error=table("relative_error"),
        grazing_change=np.array([np.nan if one["grazing_change"] is None else one["grazing_change"] for one in keys], dtype=np.float64),
        grazing=result["grazing"],
        failed={one["key"]: one["reason"] for one in result["failed"]},
    )
