"""Modes of a hammer test."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Annotated, Any, Literal

import numpy as np

from . import _core
from .arguments import check_wholes, si
from .errors import ArgumentError
from .given import Measured, responses
from .measured_frf import MeasuredFrf, hammer_options, made_frf
from .quantity import span
from .recording import names_of
from .result import Along, Complexes, Floats, Integers, Result, Variable, html_table, made_manifest


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class MeasuredModes(Result):
    """Modes that were identified, in ascending frequency; arrays of shape ``(mode,)``."""

    frequency_hz: Annotated[Floats, Along("mode", "Hz", "undamped natural frequency")]
    frequency_deviation_hz: Annotated[Floats, Along("mode", "Hz", "standard deviation of the frequency")]
    damping_ratio: Annotated[Floats, Along("mode", "1", "damping ratio")]
    damping_deviation: Annotated[Floats, Along("mode", "1", "standard deviation of the damping ratio")]
    #: Names of the responses, and the shapes there, of size 1 at the largest.
    response: list[str]
    shape: Annotated[Complexes, Along("response mode", "1", "shape, of size 1 at the largest response")]
    mac: Annotated[Floats, Along("mode other_mode", "1", "modal assurance criterion")]
    #: Squared error over the variance that the coherence tells; above 1 the deviations are widened by its root.
    misfit: float
    #: Deviations from a value to an end of its 95 % interval.
    quantile_95: float
    #: The stabilisation diagram, of shape ``(pole,)``; ``pole_stable`` is ``"new"``, ``"frequency"`` or ``"pole"``, for what has stayed.
    pole_order: Annotated[Integers, Along("pole", "1", "order of the denominator")]
    pole_frequency_hz: Annotated[Floats, Along("pole", "Hz", "frequency of the pole")]
    pole_damping_ratio: Annotated[Floats, Along("pole", "1", "damping ratio of the pole")]
    pole_stable: list[str]
    #: Lines of the band, Hz, the responses there as displacement per force, and what the modes give, of shape ``(response, line)``.
    line_hz: Floats
    measured: Annotated[Complexes, Along("response line", "", "displacement per force, measured")]
    model: Annotated[Complexes, Along("response line", "", "displacement per force that the modes give")]
    #: The responses that the modes were sought in.
    frf: MeasuredFrf

    def __len__(self) -> int:
        return len(self.frequency_hz)

    def _summary(self) -> list[tuple[str, str]]:
        deviations = zip(self.quantile_95 * self.frequency_deviation_hz, self.quantile_95 * self.damping_deviation)
        lines = [
            (f"mode {k}", f"{hz:.6g} Hz +- {dhz:.1e} Hz, damping ratio {zeta:.5g} +- {dzeta:.1e} (95 %)")
            for k, (hz, zeta, (dhz, dzeta)) in enumerate(zip(self.frequency_hz, self.damping_ratio, deviations), 1)
        ]
        if self.frf.window_decay_per_s > 0.0:
            lines.append(("window", f"its damping, {self.frf.window_decay_per_s:.5g} 1/s, was taken off"))
        return [*lines, ("misfit", f"{self.misfit:.3g}")]

    def _repr_html_(self) -> str:
        numbers = (self.frequency_hz, self.frequency_deviation_hz, self.damping_ratio, self.damping_deviation)
        rows = [[k + 1, *(f"{one[k]:.6g}" for one in numbers)] for k in range(len(self))]
        return html_table("Measured modes", ["mode", "frequency [Hz]", "deviation [Hz]", "damping ratio", "deviation"], rows)

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over ``mode``, ``response``, ``pole`` and ``line``; complex values as ``_re`` and ``_im``."""
        numbers = range(1, len(self) + 1)
        coords = {
            "mode": Variable(("mode",), numbers, "1", "number of the mode"),
            "other_mode": Variable(("other_mode",), numbers, "1", "number of another mode"),
            "response": Variable(("response",), self.response, "", "response"),
            "line": Variable(("line",), self.line_hz, "Hz", "frequency"),
        }
        stable = Variable(("pole",), self.pole_stable, "", "what stays from the order below")
        return self._dataset({**self._variables(), "pole_stable": stable}, coords)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each mode."""
        return self._frame(self._columns("mode"))

    def plot_stabilisation(self, ax: Any = None) -> Any:
        """Draws the stabilisation diagram: poles by order, filled where frequency and damping stay."""
        from .plot.measured import plot_stabilisation

        return plot_stabilisation(self, ax)

    def plot_fit(self, ax: Any = None, response: str | None = None) -> Any:
        """Draws a response, by default the first, beside what the modes give."""
        from .plot.measured import plot_modal_fit

        name = self.response[0] if response is None else response
        if name not in self.response:
            raise ArgumentError(f"{name}: no such response; there are {', '.join(self.response)}")
        return plot_modal_fit(self, ax, self.response.index(name))


def measured_modes(
    records: Measured,
    *,
    between: Any = None,
    order: int = 40,
    sample_rate_hz: Any = None,
    force: str | None = None,
    response: str | Sequence[str] = (),
    estimator: Literal["h1", "h2", "hv"] = "h1",
    noise_ratio: float = 1.0,
    block: Any = None,
    force_window: bool = False,
    end_ratio: float | None = None,
) -> MeasuredModes:
    """Modes of a hammer test with their uncertainty, ``jounce modes --measured``.

    They are sought ``between = "500 Hz:4300 Hz"``, by default over all lines, with denominators up to an ``order``. ``records`` and the
    other options are those of :func:`measured_frf`; damping that an exponential window adds is taken off.
    """
    check_wholes(order=order)
    given = responses(records, sample_rate_hz)
    options = hammer_options(force, response, estimator, noise_ratio, block, force_window, end_ratio)
    band = None
    if between is not None:
        low, high = (si("frequency", end, "between") for end in span(between, "between"))
        if not low < high:
            raise ArgumentError(f"between is {between!r}; the first frequency must be the smaller one")
        band = (low, high)
    answer = _core.measured_modes([one._core() for one in given], options, band, order)
    manifest = made_manifest("modes", **names_of(given), **options, between_hz=band, order=order)
    names, frf = answer["response"], made_frf(given, answer.pop("frf"), manifest)
    # Without a mode or a line the arrays have an axis of length 0.
    for name, wide in (("shape", len(answer["frequency_hz"])), ("measured", None), ("model", None)):
        rows = np.array(answer[name])
        answer[name] = rows.reshape(wide, len(names)).T if wide is not None else rows
    return MeasuredModes(manifest=manifest, frf=frf, **answer)
