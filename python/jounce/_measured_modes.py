"""Modes of a hammer or shaker test, of free decays and of output-only tests."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from . import _core
from ._arguments import names, optional_range_si, optional_si, options
from ._call import recorded
from ._errors import ArgumentError
from ._fields import About, Along, Variable
from ._format import html_table, with_uncertainty
from ._inputs import Measured, responses
from ._issue import Issue, parse_issues
from ._measured_frf import MeasuredFrf, hammer_options, make_frf
from ._recording import names_of
from ._result import Complexes, Floats, Integers, Result, make_manifest

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class MeasuredModes(Result):
    """Identified modes in ascending frequency; arrays of shape ``(mode,)``."""

    frequency_hz: Annotated[Floats, Along("mode", "Hz", "undamped natural frequency")]
    frequency_deviation_hz: Annotated[Floats, Along("mode", "Hz", "standard deviation of the frequency")]
    damping_ratio: Annotated[Floats, Along("mode", "1", "damping ratio")]
    damping_deviation: Annotated[Floats, Along("mode", "1", "standard deviation of the damping ratio")]
    doubtful: Annotated[list[bool], About("True where the interval of the damping ratio includes 0: the mode may be noise")]
    response: Annotated[list[str], About("names of the responses")]
    shape: Annotated[Complexes, Along("output mode", "1", "shape, normalised to 1 at the largest response")]
    reference: Annotated[list[str], About("excitation points, where there are several")]
    participation: Annotated[
        Complexes,
        Along(
            "reference mode",
            "1",
            "participation of a force, by reciprocity the shape at its point",
            detail="1 at the largest; by reciprocity the shape at the excitation points",
        ),
    ]
    base_participation: Annotated[
        Complexes,
        Along(
            "output mode",
            "",
            "shape times participation of the base",
            detail="values of voltages are in V/m; the sum over all modes is 1 at each point of the structure; NaN where the input is not "
            "a motion of the base",
        ),
    ]
    mac: Annotated[Floats, Along("mode other_mode", "1", "modal assurance criterion")]
    misfit: Annotated[
        float, About("squared error relative to the variance from the coherence; above 1 the deviations are widened by its root")
    ]
    quantile_95: Annotated[
        Floats,
        Along("mode", "1", "half width of the 95 % interval in standard deviations", detail="above 1.96 where it is based on few blocks"),
    ]
    unexplained_hz: Annotated[
        Floats, About("peaks of the responses without a mode; try a band around them, or a larger order", "Hz", axes="peak")
    ]
    pole_order: Annotated[Integers, Along("pole", "1", "order of the denominator")]
    pole_frequency_hz: Annotated[Floats, Along("pole", "Hz", "frequency of the pole")]
    pole_damping_ratio: Annotated[Floats, Along("pole", "1", "damping ratio of the pole")]
    pole_stable: Annotated[list[str], About('agreement of each pole with the order below: ``"new"``, ``"frequency"`` or ``"pole"``')]
    function: Annotated[list[str], About("names of the functions that the modes were identified from")]
    line_hz: Annotated[Floats, About("frequencies of the band", "Hz", axes="line")]
    measured: Annotated[
        Complexes,
        Along(
            "function line",
            "",
            "function, measured",
            detail="of a hammer test as displacement per force; without a measured force one-sided spectra of decays",
        ),
    ]
    model: Annotated[Complexes, Along("function line", "", "function reconstructed from the modes")]
    frf: Annotated[MeasuredFrf | None, About("responses of a hammer test; ``None`` without a measured force")]
    warnings: Annotated[list[str], About("modes that may be noise, and peaks without a mode")]
    notes: Annotated[list[str], About("window and noise of the test")]
    issues: Annotated[list[Issue], About("data-quality issues of the recordings")]

    def __len__(self) -> int:
        return len(self.frequency_hz)

    def _summary(self) -> list[tuple[str, str]]:
        deviations = zip(self.quantile_95 * self.frequency_deviation_hz, self.quantile_95 * self.damping_deviation)
        lines = [
            (f"mode {k}", f"{with_uncertainty(hz, dhz, 'Hz')}, damping ratio {with_uncertainty(zeta, dzeta)} (95 %)")
            for k, (hz, zeta, (dhz, dzeta)) in enumerate(zip(self.frequency_hz, self.damping_ratio, deviations), 1)
        ]
        lines += [*(("warning", text) for text in self.warnings), *(("note", text) for text in self.notes)]
        return [*lines, ("misfit", f"{self.misfit:.3g}")]

    def _repr_html_(self) -> str:
        numbers = (self.frequency_hz, self.frequency_deviation_hz, self.damping_ratio, self.damping_deviation)
        rows = [[k + 1, *(f"{one[k]:.6g}" for one in numbers)] for k in range(len(self))]
        return html_table("Measured modes", ["mode", "frequency [Hz]", "deviation [Hz]", "damping ratio", "deviation"], rows)

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``mode``, ``output``, ``pole``, ``function`` and ``line``."""
        numbers = range(1, len(self) + 1)
        coords = {
            "mode": Variable(("mode",), numbers, "1", "number of the mode"),
            "other_mode": Variable(("other_mode",), numbers, "1", "number of another mode"),
            "output": Variable(("output",), self.response, "", "output"),
            "reference": Variable(("reference",), self.reference, "", "excitation point"),
            "function": Variable(("function",), self.function, "", "function that the modes were identified from"),
            "line": Variable(("line",), self.line_hz, "Hz", "frequency"),
        }
        stable = Variable(("pole",), self.pole_stable, "", "agreement with the order below")
        return self._dataset({**self._variables(), "pole_stable": stable}, coords)

    def _parts(self) -> dict[str, Dataset]:
        return {} if self.frf is None else {"frf": self.frf.to_xarray()}

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each mode."""
        return self._frame(self._columns("mode"))

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        functions = {name: partial(self.plot_fit, function=name) for name in self.function}
        return {"stabilisation": self.plot_stabilisation, **functions}

    def plot_stabilisation(self, ax: Axes | None = None) -> Axes:
        """Draws the stabilisation diagram: poles by order, filled where frequency and damping are stable."""
        from ._plot.measured import plot_stabilisation

        return plot_stabilisation(self, ax)

    def plot_fit(self, ax: Axes | None = None, function: str | None = None) -> Axes:
        """Draws a response or the spectrum of a decay, by default the first, with its reconstruction from the modes."""
        from ._plot.measured import plot_modal_fit

        name = self.function[0] if function is None else function
        if name not in self.function:
            raise ArgumentError(f"{name}: no such function; use one of {', '.join(self.function)}")
        return plot_modal_fit(self, ax, self.function.index(name))


@recorded
def measured_modes(
    records: Measured,
    *,
    between: Any = None,
    order: int = 40,
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
    free_decay: bool = False,
    span: Any = None,
    output_only: bool = False,
    reference: str | Sequence[str] = (),
    lags: Any = None,
) -> MeasuredModes:
    """Identifies modes of a hammer or shaker test, of free decays or of outputs only, with uncertainty, ``jounce modes --measured``.

    Damping of an exponential window is subtracted. With several excitation points the shapes at these points are also returned, in
    ``participation``, and close modes are separated that one point cannot separate. Options of a hammer are not allowed with
    ``free_decay`` or ``output_only``.

    References
    ----------
    B. Peeters and others, Shock and Vibration 11 (2004) 395 (poles); G. James, T. Carne, J. Lauffer, SAND92-1666 (1993) (output-only).
    """
    inputs = responses(records, sample_rate_hz)
    estimation = (estimator, noise_ratio, block, force_window, end_ratio, shaker)
    test = hammer_options(force, input, response, estimation, functions, bridge)
    given = {
        "free_decay": free_decay,
        "output_only": output_only,
        "span_s": optional_range_si("time", span, "span"),
        "reference": names(reference),
        "lags_s": optional_si("time", lags, "lags"),
        "between_hz": optional_range_si("frequency", between, "between"),
        "order": order,
    }
    result = _core.measured_modes([one._core() for one in inputs], options(**test), options(**given))
    manifest = make_manifest("modes", **names_of(inputs), **test, **given)
    core_frf = result.pop("frf")
    frf = None if core_frf is None else make_frf(inputs, core_frf, manifest)
    issues = [*(issue for one in inputs for issue in one.issues), *parse_issues(result.pop("issues"))]
    return MeasuredModes(manifest=manifest, frf=frf, issues=issues, **_with_array_shapes(result))


def _with_array_shapes(result: dict[str, Any]) -> dict[str, Any]:
    """Sets the shape of arrays without a mode or a line, which have an axis of length 0."""
    modes = len(result["frequency_hz"])
    shape = np.array(result["shape"]).reshape(modes, len(result["response"])).T
    participation = np.array(result["participation"], dtype=np.complex128).reshape(modes, len(result["reference"])).T
    base_values = np.array(result["base_participation"], dtype=np.complex128)
    size = (modes, len(result["response"]))
    base_participation = base_values.reshape(size).T if base_values.size == size[0] * size[1] else np.full(size[::-1], np.nan + 0j)
    return {
        **result,
        "shape": shape,
        "participation": participation,
        "base_participation": base_participation,
        "measured": np.array(result["measured"]),
        "model": np.array(result["model"]),
    }
