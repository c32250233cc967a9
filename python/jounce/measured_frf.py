"""Frequency responses of a hammer test."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np

from . import _core
from .arguments import names, optional_si
from .contact import kind_of
from .errors import ArgumentError
from .inputs import Measured, responses
from .issue import Finding, found, told
from .recording import Recording, names_of
from .result import Complexes, Floats, Result, Variable, html_table, made_manifest


@dataclasses.dataclass(frozen=True)
class ImpactHit:
    """A hit: number of its record, largest force, N, time in contact, s, whether it was averaged, and what is wrong with it."""

    record: int
    peak_force_n: float
    contact_time_s: float
    used: bool
    warnings: tuple[str, ...]


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class MeasuredFrf(Result):
    """Responses per input of a hammer or shaker test with their coherence; sign convention ``e^{+i w t}``."""

    frequency_hz: Floats
    #: Names of the sensors, and the places of the force, or its channel where no place is told; empty where responses were given
    #: that tell none.
    output: list[str]
    reference: list[str]
    #: Each response by its channel, ``"tip from beam.mid"`` where the force acts at several places, of shape ``(frequency,)``,
    #: its unit, and its coherence, 1 throughout where one block tells nothing.
    responses: dict[str, Complexes]
    units: dict[str, str]
    coherence: dict[str, Floats]
    #: Channel of the input; empty where responses were given.
    input: str
    #: For responses to an acceleration the factor that makes them per g, and their unit then: ``(9.80665, "V/g")``.
    per_g: dict[str, tuple[float, str]]
    hits: list[ImpactHit]
    #: Length of a block, s; ``None`` where responses were given.
    block_s: float | None
    #: Damping that the exponential window adds to every mode, 1/s.
    window_decay_per_s: float
    findings: list[Finding]

    def __getitem__(self, name: str) -> Complexes:
        if name not in self.responses:
            raise ArgumentError(f"{name}: no such response; there are {', '.join(self.responses)}")
        return self.responses[name]

    def _summary(self) -> list[tuple[str, str]]:
        used = sum(hit.used for hit in self.hits)
        lines = [] if self.block_s is None else [("hits", f"{used} of {len(self.hits)} averaged, blocks of {self.block_s:.6g} s")]
        lines += [("warning", f"hit {k} is {kind}") for k, hit in enumerate(self.hits, 1) for kind in hit.warnings]
        lines += [("left out", f"hit {k}, its block would reach beyond the record") for k, hit in enumerate(self.hits, 1) if not hit.used]
        return [*lines, *((name, text) for name, text in zip(self.responses, self._peaks())), *told(self.findings)]

    def _peaks(self) -> list[str]:
        """The highest line of each response; that at 0 Hz is the sensor's offset."""
        lines = []
        for name, values in self.responses.items():
            k = 1 + int(np.argmax(np.abs(values[1:])))
            where = f"{self.frequency_hz[k]:.5g} Hz, coherence {self.coherence[name][k]:.5f}"
            factor, unit = self.per_g.get(name, (1.0, ""))
            per_g = f" ({factor * abs(values[k]):.5e} {unit})" if unit else ""
            lines.append(f"highest {abs(values[k]):.5e} {self.units[name]}{per_g} at {where}")
        return lines

    def _repr_html_(self) -> str:
        return html_table("Measured responses", ["response", ""], list(zip(self.responses, self._peaks())))

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over ``frequency``: each response as ``_re`` and ``_im``, its coherence as ``NAME_coherence``."""
        of = ("frequency",)
        variables = {name: Variable(of, values, self.units[name], name) for name, values in self.responses.items()}
        variables |= {f"{name}_coherence": Variable(of, values, "1", f"{name}, coherence") for name, values in self.coherence.items()}
        return self._dataset(variables, {"frequency": Variable(of, self.frequency_hz, "Hz", "frequency")})

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each frequency."""
        coherence = {f"{name}_coherence": values for name, values in self.coherence.items()}
        return self._frame({"frequency_hz": self.frequency_hz, **self.responses, **coherence})

    def plot_frf(self, ax: Any = None, response: str | None = None) -> Any:
        """Draws the magnitude of a response, by default of the first."""
        from .plot.measured import plot_measured_frf

        return plot_measured_frf(self, ax, next(iter(self.responses)) if response is None else response)

    def plot_coherence(self, ax: Any = None) -> Any:
        """Draws the coherence of every response."""
        from .plot.measured import plot_coherence

        return plot_coherence(self, ax)


def hammer_options(
    force: str | None,
    input: str | None,
    response: str | Sequence[str],
    cut: tuple[str, float, Any, bool, float | None, bool],
    functions: str | None,
    bridge: bool,
) -> dict[str, Any]:
    """How a hammer or shaker test is taken to responses, for the compiled module."""
    estimator, noise_ratio, block, force_window, end_ratio, shaker = cut
    return {
        "force": force,
        "input": input,
        "responses": names(response),
        "estimator": estimator,
        "noise_ratio": noise_ratio,
        "block_s": optional_si("time", block, "block"),
        "force_window": force_window,
        "end_ratio": end_ratio,
        "shaker": shaker,
        "functions": functions,
        "bridge": bridge,
    }


def made_frf(given: list[Recording], answer: dict[str, Any], manifest: dict[str, Any]) -> MeasuredFrf:
    """From what the compiled module answers."""
    told = answer["responses"]
    hits = [
        ImpactHit(one["record"], one["peak_force_n"], one["contact_time_s"], one["used"], tuple(map(kind_of, one["warnings"])))
        for one in json.loads(answer["hits"])
    ]
    return MeasuredFrf(
        manifest=manifest,
        frequency_hz=answer["frequency_hz"],
        output=answer["outputs"],
        reference=answer["references"],
        responses={name: values for name, (values, _, _) in told.items()},
        units={name: unit for name, (_, unit, _) in told.items()},
        coherence={name: coherence for name, (_, _, coherence) in told.items()},
        input=answer["input"],
        per_g={name: one for name, one in zip(told, answer["per_g"]) if one is not None},
        hits=hits,
        block_s=answer["block_s"],
        window_decay_per_s=answer["window_decay_per_s"],
        findings=[*(finding for one in given for finding in one.findings), *found(answer["findings"])],
    )


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
    """Frequency responses of a hammer or shaker test, ``jounce frf --measured``.

    ``records``: one recording or a list of them, each a :class:`Recording`, a file, or SEP005 time series over one time, with one or more
    hits; or one file of responses over frequency. Hits at several places, each recording telling its own, give one response for each sensor
    and place. ``force`` and ``response`` name channels, by default the first in newtons and all others. ``input`` names a channel that
    excites without being a force: the acceleration, velocity or displacement of the base, or a voltage. It excites all the time, as a
    shaker does. Responses are in the unit of their channel per its unit, ``V/(m/s^2)``, with ``per_g`` for those per g.
    ``estimator``: where the noise is, ``"h1"`` on the responses, ``"h2"`` on the force, ``"hv"`` on both, with ``noise_ratio`` of their
    densities. ``block``: ``"2 s"``, by default the shortest distance of two hits. ``force_window`` takes away the force after each hit,
    ``end_ratio`` is where an exponential window ends. A force that goes on, both ways, is taken for that of a shaker, as any is with
    ``shaker``: half-overlapping blocks, by default an eighth of the shortest record long, weighed by a Hann window.

    Of a file over frequency the complex channels are the responses; ``functions`` says what every two real columns hold where no header
    does, and ``bridge`` puts lines that are no numbers on straight lines between their neighbours.
    """
    given = responses(records, sample_rate_hz)
    cut = (estimator, noise_ratio, block, force_window, end_ratio, shaker)
    options = hammer_options(force, input, response, cut, functions, bridge)
    answer = _core.measured_frf([one._core() for one in given], options)
    return made_frf(given, answer, made_manifest("frf", **names_of(given), **options))
