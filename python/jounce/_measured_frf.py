"""Frequency responses of a hammer test."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from . import _core
from ._arguments import names, optional_si, options
from ._call import recorded
from ._contact import kind_of
from ._fields import About, Variable
from ._format import html_table
from ._frf import response_variables
from ._inputs import Measured, responses
from ._issue import Issue, issue_lines, parse_issues
from ._named import Named
from ._recording import Recording, names_of
from ._result import Complexes, Floats, Result, make_manifest

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True)
class ImpactHit:
    """Hit: number of its record, largest force, N, contact time, s, True where it was averaged, and its warnings."""

    record: Annotated[int, About("number of its record, from 1")]
    peak_force_n: Annotated[float, About("largest force", "N")]
    contact_time_s: Annotated[float, About("contact time", "s")]
    used: Annotated[bool, About("True where the hit is part of the averages")]
    warnings: Annotated[tuple[str, ...], About("warnings of the hit")]


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class MeasuredFrf(Result, Named[Complexes]):
    """Frequency responses of a hammer or shaker test with their coherence; sign convention ``e^{+i w t}``."""

    _noun = "response"

    frequency_hz: Annotated[Floats, About("frequencies", "Hz", axes="frequency")]
    output: Annotated[list[str], About("names of the sensors; empty for given responses without names")]
    reference: Annotated[
        list[str], About("excitation points, or the channel of the force without points; empty for given responses without names")
    ]
    responses: Annotated[
        dict[str, Complexes],
        About('responses by channel, ``"tip from beam.mid"`` with several excitation points, each of shape ``(frequency,)``, in ``units``'),
    ]
    units: Annotated[dict[str, str], About("unit of each response")]
    coherence: Annotated[dict[str, Floats], About("coherence of each response, of shape ``(frequency,)``; 1 for a single block")]
    input: Annotated[str, About("channel of the input; empty for given responses")]
    per_g: Annotated[
        dict[str, tuple[float, str]],
        About('for responses to an acceleration: factor of the response per g, and its unit, ``(9.80665, "V/g")``'),
    ]
    hits: Annotated[list[ImpactHit], About("hits of a hammer test")]
    block_s: Annotated[float | None, About("length of a block; ``None`` for given responses", "s")]
    window_decay_per_s: Annotated[float, About("damping that the exponential window adds to every mode", "1/s")]
    issues: Annotated[list[Issue], About("data-quality issues of the recordings")]

    def _named(self) -> Mapping[str, Complexes]:
        return self.responses

    def _summary(self) -> list[tuple[str, str]]:
        used = sum(hit.used for hit in self.hits)
        lines = [] if self.block_s is None else [("hits", f"{used} of {len(self.hits)} averaged, blocks of {self.block_s:.6g} s")]
        lines += [("warning", f"hit {k} is {kind}") for k, hit in enumerate(self.hits, 1) for kind in hit.warnings]
        lines += [("left out", f"hit {k}, its block would extend beyond the record") for k, hit in enumerate(self.hits, 1) if not hit.used]
        return [*lines, *((name, text) for name, text in zip(self.responses, self._peaks())), *issue_lines(self.issues)]

    def _peaks(self) -> list[str]:
        """Returns the highest line of each response, without the offset of the sensor at 0 Hz."""
        lines = []
        for name, values in self.responses.items():
            k = 1 + int(np.argmax(np.abs(values[1:])))
            position = f"{self.frequency_hz[k]:.5g} Hz, coherence {self.coherence[name][k]:.5f}"
            factor, unit = self.per_g.get(name, (1.0, ""))
            per_g = f" ({factor * abs(values[k]):.5e} {unit})" if unit else ""
            lines.append(f"highest {abs(values[k]):.5e} {self.units[name]}{per_g} at {position}")
        return lines

    def _repr_html_(self) -> str:
        return html_table("Measured responses", ["response", ""], list(zip(self.responses, self._peaks())))

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``output`` and ``frequency``: complex ``response``, its ``phase`` in degrees, ``coherence``.

        With several excitation points there is a third axis, ``reference``.
        """
        several = {"output": self.output, "reference": self.reference} if len(self.reference) > 1 else None
        variables, coords = response_variables(self.frequency_hz, self.responses, self.units, several)
        response = variables["response"]
        coherence = np.reshape(list(self.coherence.values()), response.values.shape)
        variables["coherence"] = Variable(response.dims, coherence, "1", "coherence")
        return self._dataset(variables, coords)

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each frequency."""
        coherence = {f"{name}_coherence": values for name, values in self.coherence.items()}
        return self._frame({"frequency_hz": self.frequency_hz, **self.responses, **coherence})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        from ._plot.frf import plot_bode

        return {**{name: partial(plot_bode, self, response=name) for name in self.responses}, "coherence": self.plot_coherence}

    def plot_frf(self, ax: Axes | None = None, response: str | None = None) -> Axes:
        """Draws the magnitude of a response, by default of the first."""
        from ._plot.measured import plot_measured_frf

        return plot_measured_frf(self, ax, next(iter(self.responses)) if response is None else response)

    def plot_coherence(self, ax: Axes | None = None) -> Axes:
        """Draws the coherence of every response."""
        from ._plot.measured import plot_coherence

        return plot_coherence(self, ax)


def hammer_options(
    force: str | None,
    input: str | None,
    response: str | Sequence[str],
    estimation: tuple[str, float, Any, bool, float | None, bool],
    functions: str | None,
    bridge: bool,
) -> dict[str, Any]:
    """Returns the options of a hammer or shaker test by their names in the library."""
    estimator, noise_ratio, block, force_window, end_ratio, shaker = estimation
    return {
        "force": force,
        "input": input,
        "response": names(response),
        "estimator": estimator,
        "noise_ratio": noise_ratio,
        "block_s": optional_si("time", block, "block"),
        "force_window": force_window,
        "end_ratio": end_ratio,
        "shaker": shaker,
        "functions": functions,
        "bridge": bridge,
    }


def make_frf(inputs: list[Recording], result: dict[str, Any], manifest: dict[str, Any]) -> MeasuredFrf:
    """Returns the responses of a result of the compiled module."""
    response_tuples = result.pop("responses")
    hits = [
        ImpactHit(one["record"], one["peak_force_n"], one["contact_time_s"], one["used"], tuple(map(kind_of, one["warnings"])))
        for one in result.pop("hits")
    ]
    issues = [*(issue for one in inputs for issue in one.issues), *parse_issues(result.pop("issues"))]
    return MeasuredFrf(
        manifest=manifest,
        responses={name: values for name, (values, _, _) in response_tuples.items()},
        units={name: unit for name, (_, unit, _) in response_tuples.items()},
        coherence={name: coherence for name, (_, _, coherence) in response_tuples.items()},
        hits=hits,
        issues=issues,
        **result,
    )


@recorded
def measured_frf(
    records: Measured,
    *,
    sample_rate_hz: Any = None,
    force: str | None = None,
    input: str | None = None,
    response: str | Sequence[str] = (),
    estimator: Literal["h1", "h2", "hv"] = "h1",
    noise_ratio: float = 1.0,
    block: Any = None,
    force_window: bool = False,
    end_ratio: float | None = None,
    shaker: bool = False,
    functions: Literal["re-im", "size-degrees", "size-radians"] | None = None,
    bridge: bool = False,
) -> MeasuredFrf:
    """Estimates frequency responses from a hammer or shaker test, ``jounce frf --measured``.

    Each recording has one or more hits; one file of responses over frequency is accepted too. With several excitation points, one in each
    recording, there is a response for each sensor and point. Responses are in the unit of their channel per unit of the input,
    ``V/(m/s^2)``; ``per_g`` gives those per g.
    """
    inputs = responses(records, sample_rate_hz)
    estimation = (estimator, noise_ratio, block, force_window, end_ratio, shaker)
    given = hammer_options(force, input, response, estimation, functions, bridge)
    result = _core.measured_frf([one._core() for one in inputs], options(**given))
    return make_frf(inputs, result, make_manifest("frf", **names_of(inputs), **given))
