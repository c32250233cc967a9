"""Derivatives of the results of a periodic orbit with respect to keys of the spec."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from functools import partial
from typing import Annotated, Any

import numpy as np

from ._named import look_up
from ._result import Along, Floats, Result, Variable


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class SensitivityResult(Result):
    """Derivatives of the results of an orbit; arrays of shape ``(key, quantity)``, the largest relative one of the mean power first."""

    #: Id of the orbit, as in ``basins``; its period in drive cycles, and its mean power, W.
    at: str
    period_cycles: int
    mean_power_w: float
    #: Keys, their SI units and values.
    key: list[str]
    key_unit: list[str]
    value: Floats
    #: Results of the orbit, ``"mean_power"`` first, their SI units and values.
    quantity: list[str]
    quantity_unit: list[str]
    quantity_value: Floats
    #: Derivatives in SI units; relative change of the result per relative change of the key, and its estimated error.
    derivative: Annotated[Floats, Along("key quantity", "", "derivative, SI")]
    relative: Annotated[Floats, Along("key quantity", "1", "relative change of the result per relative change of the key")]
    relative_error: Annotated[Floats, Along("key quantity", "1", "estimated error of the relative change")]
    #: Keys without derivatives, with the reason.
    failed: dict[str, str]

    def __len__(self) -> int:
        return len(self.key)

    def _summary(self) -> list[tuple[str, str]]:
        rows = [(key, f"{self.relative[k, 0]:+.4f} % of power for 1 % more of {self.value[k]:.6g} {self.key_unit[k]}") for k, key in enumerate(self.key)]
        return [("orbit", f"{self.at}, {self.mean_power_w:.6g} W"), *rows, *((key, f"no derivative: {reason}") for key, reason in self.failed.items())]

    def to_xarray(self) -> Any:
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

    def to_pandas(self) -> Any:
        """Returns a ``pandas.DataFrame`` with a row for each key: its value, and the relative derivative of each result."""
        relative = {name: self.relative[:, k] for k, name in enumerate(self.quantity)}
        return self._frame({"key": self.key, "unit": self.key_unit, "value": self.value, **relative})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {name: partial(self.plot_sensitivity, quantity=name) for name in self.quantity}

    def plot_sensitivity(self, ax: Any = None, quantity: str = "mean_power") -> Any:
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
        failed={one["key"]: one["reason"] for one in result["failed"]},
    )
