"""Frequency response functions."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Self

import numpy as np

from ._fields import About, Variable
from ._named import Named
from ._result import Complexes, Floats, Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class FrfResult(Result, Named[Complexes]):
    """Frequency responses without contact, per newton at a point or per m/s^2 of the base; sign convention ``e^{+i w t}``."""

    _noun = "response"

    frequency_hz: Annotated[Floats, About("frequencies", "Hz", axes="frequency")]
    input: Annotated[str, About('excitation point, or ``"base"``')]
    responses: Annotated[
        dict[str, Complexes],
        About('responses by name, ``"beam.tip.acceleration"``, ``"mfc.voltage"``, each of shape ``(frequency,)``, in ``units``'),
    ]
    units: Annotated[dict[str, str], About("unit of each response")]
    held: Annotated[list[str], About("masses that were fixed")]

    @classmethod
    def _from_core(cls, fields: dict[str, Any]) -> Self:
        responses = fields["responses"]
        by_name = {"responses": {k: v for k, (v, _) in responses.items()}, "units": {k: unit for k, (_, unit) in responses.items()}}
        return super()._from_core({**fields, **by_name})

    def _named(self) -> Mapping[str, Complexes]:
        return self.responses

    def _summary(self) -> list[tuple[str, str]]:
        span = [("frequencies", f"{len(self.frequency_hz)} from {self.frequency_hz.min():g} to {self.frequency_hz.max():g} Hz")]
        peaks = []
        for name, values in self.responses.items():
            highest = int(np.argmax(np.abs(values)))
            peaks.append((name, f"highest {abs(values[highest]):.5g} {self.units[name]} at {self.frequency_hz[highest]:.5g} Hz"))
        return [*span, ("input", self.input), *peaks]

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``output`` and ``frequency``: the complex ``response``, and its ``phase`` in degrees."""
        return self._dataset(*response_variables(self.frequency_hz, self.responses, self.units))

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each frequency."""
        return self._frame({"frequency_hz": self.frequency_hz, **self.responses})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        from ._plot.frf import plot_bode

        first = self._first()
        return {name: partial(plot_bode, self, response=name) for name in (first, *(name for name in self.responses if name != first))}

    def _first(self) -> str:
        """Returns the name of the first voltage, else of the first response."""
        return next((name for name in self.responses if name.endswith(".voltage")), next(iter(self.responses)))

    def plot_frf(self, ax: Axes | None = None, response: str | None = None) -> Axes:
        """Draws the magnitude of a response, by default of the first voltage (else of the first response)."""
        from ._plot.frf import plot_frf

        return plot_frf(self, ax, self._first() if response is None else response)


def response_variables(
    frequency_hz: Floats, responses: Mapping[str, Complexes], units: Mapping[str, str], several: Mapping[str, Sequence[str]] | None = None
) -> tuple[dict[str, Variable], dict[str, Variable]]:
    """Returns the variables and the coordinates of a dataset of responses; a unit that all have is that of the variable.

    With ``several`` outputs and excitation points, by the name of their axis, the responses are those of each output at each point.
    """
    axes = several or {"output": list(responses)}
    dims, shape = (*axes, "frequency"), (*map(len, axes.values()), len(frequency_hz))
    response_units = [units[name] for name in responses]
    values = np.array(list(responses.values()), np.complex128).reshape(shape)
    common = response_units[0] if len(set(response_units)) == 1 else ""
    variables = {
        "response": Variable(dims, values, common, "frequency response"),
        "phase": Variable(dims, np.degrees(np.angle(values)), "deg", "phase of the response"),
    }
    coords = {name: Variable((name,), names, "", name) for name, names in axes.items()}
    coords["unit"] = Variable(tuple(axes), np.array(response_units, object).reshape(shape[:-1]), "", "unit of the response")
    coords["frequency"] = Variable(("frequency",), frequency_hz, "Hz", "frequency")
    return variables, coords
