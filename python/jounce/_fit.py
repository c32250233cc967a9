"""Fit of keys of a spec to measured features."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from ._errors import ArgumentError
from ._fields import About, Along, Variable
from ._format import html_table
from ._result import Data, Floats, Result, column

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset

    from ._spec import Spec
else:
    # The module of Spec imports this one, so the name is looked up when a dataset is made.
    Spec = Any


@dataclasses.dataclass(frozen=True, eq=False)
class FitCurve(Data):
    """Measured curve with the curves of the model before and after a fit; arrays of shape ``(place,)`` in the unit of the curve."""

    name: Annotated[str, About('name of the curve, ``"mfc.voltage"``')]
    unit: Annotated[str, About("unit of the curve")]
    over: Annotated[str, About('axis of the curve, ``"frequency_hz"`` or ``"time_s"``')]
    at: Annotated[Floats, About("values of the axis, Hz or s", axes="point")]
    measured: Annotated[Floats, About("measured values, in ``unit``", axes="point")]
    before: Annotated[Floats, About("values of the model before the fit, in ``unit``", axes="point")]
    after: Annotated[Floats, About("values of the model after the fit, in ``unit``", axes="point")]
    low: Annotated[Floats, About("lower end of the 95 % prediction interval of a further measurement, in ``unit``", axes="point")]
    high: Annotated[Floats, About("upper end of this interval, in ``unit``", axes="point")]

    def __len__(self) -> int:
        return len(self.at)

    @property
    def error_before(self) -> float:
        """Rms error of the model before the fit, relative to the rms of the measured curve."""
        return float(np.linalg.norm(self.before - self.measured) / np.linalg.norm(self.measured))

    @property
    def error_after(self) -> float:
        """Rms error of the model after the fit, relative to the rms of the measured curve."""
        return float(np.linalg.norm(self.after - self.measured) / np.linalg.norm(self.measured))


@dataclasses.dataclass(frozen=True, eq=False)
class FitDeviation(Data):
    """Relative standard deviation shared by features, and its source.

    ``degrees_of_freedom`` is ``None`` where the deviation was given; else it is estimated from the residuals.
    """

    name: Annotated[str, About("name of the deviation")]
    deviation: Annotated[float, About("relative standard deviation of the features")]
    degrees_of_freedom: Annotated[
        float | None, About("degrees of freedom where the deviation is estimated from residuals; ``None`` where it was given")
    ]


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class FitResult(Result):
    """Keys and features before and after a fit, with their uncertainty; arrays of shape ``(key,)`` and ``(feature,)``."""

    key: Annotated[list[str], About("fitted keys")]
    key_unit: Annotated[list[str], About("SI unit of each key")]
    before: Annotated[Floats, About("values before the fit, in ``key_unit``", axes="key")]
    after: Annotated[Floats, About("values after the fit, in ``key_unit``", axes="key")]
    low: Annotated[Floats, About("lower end of the 95 % interval, in ``key_unit``", axes="key")]
    high: Annotated[Floats, About("upper end of the 95 % interval, in ``key_unit``", axes="key")]
    prior_deviation: Annotated[Floats, Along("key", "1", "relative standard deviation of the prior")]
    deviation: Annotated[Floats, Along("key", "1", "relative standard deviation after the fit")]
    correlation: Annotated[Floats, Along("key other_key", "1", "correlation of two keys")]
    feature: Annotated[list[str], About('features, ``"mode 1 frequency"``')]
    feature_unit: Annotated[list[str], About("unit of each feature")]
    feature_measured: Annotated[Floats, About("measured values, in ``feature_unit``", axes="feature")]
    feature_before: Annotated[Floats, About("values of the model before the fit, in ``feature_unit``", axes="feature")]
    feature_after: Annotated[Floats, About("values of the model after the fit, in ``feature_unit``", axes="feature")]
    feature_deviation: Annotated[Floats, Along("feature", "1", "relative standard deviation of the measurement")]
    feature_predicted_deviation: Annotated[Floats, Along("feature", "1", "relative standard deviation of the model after the fit")]
    feature_low: Annotated[
        Floats, About("lower end of the 95 % prediction interval of a further measurement, in ``feature_unit``", axes="feature")
    ]
    feature_high: Annotated[Floats, About("upper end of this interval, in ``feature_unit``", axes="feature")]
    curves: Annotated[list[FitCurve], About("features that are curves: frequency responses and time histories")]
    deviations: Annotated[list[FitDeviation], About("deviations of the features, given or estimated from the residuals")]
    quantile: Annotated[
        float,
        About(
            "half width of a 95 % interval in standard deviations; from Student's distribution where a deviation is estimated from "
            "residuals"
        ),
    ]
    chi_square: Annotated[float, About("sum of the squared errors of the features, each divided by its variance")]
    objective: Annotated[float, About("this sum with the terms of the priors of the keys")]
    warnings: Annotated[list[str], About("quantities that the data do not determine, one sentence each")]
    evaluations: Annotated[int, About("number of model evaluations")]
    spec: Annotated[Spec, About("harvester with the fitted values")]

    def __len__(self) -> int:
        return len(self.key)

    @property
    def error_before(self) -> Floats:
        """Relative error of each feature before the fit."""
        return self.feature_before / self.feature_measured - 1.0

    @property
    def error_after(self) -> Floats:
        """Relative error of each feature after the fit."""
        return self.feature_after / self.feature_measured - 1.0

    def _summary(self) -> list[tuple[str, str]]:
        keys = [
            (key, f"{self.before[k]:.6e} -> {self.after[k]:.6e} {unit}, 95 % from {self.low[k]:.6e} to {self.high[k]:.6e}")
            for k, (key, unit) in enumerate(zip(self.key, self.key_unit))
        ]
        features = [
            (name, f"{self.feature_measured[k]:.6g} measured, error {100 * before:.3f} % before and {100 * after:.3f} % after")
            for k, (name, before, after) in enumerate(zip(self.feature, self.error_before, self.error_after))
        ]
        curves = [
            (one.name, f"{len(one)} points, rms error {100 * one.error_before:.3f} % before and {100 * one.error_after:.3f} % after")
            for one in self.curves
        ]
        deviations = [
            (f"deviation of {one.name}", f"{one.deviation:.3e} from residuals, {one.degrees_of_freedom:.1f} degrees of freedom")
            for one in self.deviations
            if one.degrees_of_freedom is not None
        ]
        return [*keys, *features, *curves, *deviations, *(("warning", text) for text in self.warnings)]

    def curve(self, name: str | None = None) -> FitCurve:
        """Returns the curve of a name or of a number from 1; by default the first."""
        curves_by_name = {**{str(number): one for number, one in enumerate(self.curves, 1)}, **{one.name: one for one in self.curves}}
        if not curves_by_name:
            raise ArgumentError("no curve was fitted; add [[response]] or [[history]] tables to the features")
        curve = curves_by_name.get("1" if name is None else str(name))
        if curve is None:
            raise ArgumentError(f"{name}: no such curve; use one of {', '.join(one.name for one in self.curves)}")
        return curve

    def _repr_html_(self) -> str:
        numbers = (self.before, self.after, self.low, self.high)
        rows = [[key, unit, *(f"{one[k]:.6g}" for one in numbers)] for k, (key, unit) in enumerate(zip(self.key, self.key_unit))]
        errors = zip(self.feature, self.feature_measured, 100 * self.error_before, 100 * self.error_after)
        feature_rows = [[name, f"{measured:.6g}", f"{before:.3f}", f"{after:.3f}"] for name, measured, before, after in errors]
        head = ["feature", "measured", "error before [%]", "error after [%]"]
        return html_table("Keys", ["key", "unit", "before", "after", "95 % from", "to"], rows) + html_table("Features", head, feature_rows)

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``key`` and ``feature``; values are in the units of ``key_unit`` and ``feature_unit``."""
        variables = self._variables()
        for axis, names in (("key", ("before", "after", "low", "high")), ("feature", ("measured", "before", "after", "low", "high"))):
            for name in names:
                field = name if axis == "key" else f"feature_{name}"
                variables[field] = Variable((axis,), getattr(self, field), "", f"{axis}, {name}, in {axis}_unit")
        coords = {
            "key": Variable(("key",), self.key, "", "key"),
            "other_key": Variable(("other_key",), self.key, "", "another key"),
            "key_unit": Variable(("key",), self.key_unit, "", "unit of the key"),
            "feature": Variable(("feature",), self.feature, "", "feature"),
            "feature_unit": Variable(("feature",), self.feature_unit, "", "unit of the feature"),
        }
        return self._dataset(variables, coords)

    def _parts(self) -> dict[str, Dataset]:
        def dataset(curve: FitCurve) -> Dataset:
            axis, _, unit = curve.over.rpartition("_")
            names = ("measured", "before", "after", "low", "high")
            variables = {name: Variable((axis,), getattr(curve, name), curve.unit, f"{curve.name}, {name}") for name in names}
            return self._dataset(variables, {axis: Variable((axis,), curve.at, {"hz": "Hz"}.get(unit, unit), axis)})

        return {f"curve_{number}": dataset(one) for number, one in enumerate(self.curves)}

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each key."""
        values = {name: getattr(self, name) for name in ("before", "after", "low", "high")}
        return self._frame({"key": self.key, "unit": self.key_unit, **values, **self._columns("key")})

    def features_to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each feature."""
        names = ("measured", "before", "after", "low", "high", "deviation", "predicted_deviation")
        values = {name: getattr(self, f"feature_{name}") for name in names}
        return self._frame({"feature": self.feature, "unit": self.feature_unit, **values})

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {"error": self.plot_fit, **{one.name: partial(self.plot_curve, curve=one.name) for one in self.curves}}

    def plot_fit(self, ax: Axes | None = None) -> Axes:
        """Draws the relative error of every feature before and after, over the 95 % interval of its measurement."""
        from ._plot.fit import plot_fit

        return plot_fit(self, ax)

    def plot_curve(self, ax: Axes | None = None, curve: str | None = None) -> Axes:
        """Draws a measured curve, by default the first, with those of the model before and after and the 95 % interval as a band."""
        from ._plot.fit import plot_curve

        return plot_curve(self.curve(curve), ax)


def make_fit(result: dict[str, Any], spec: Spec, manifest: dict[str, Any]) -> FitResult:
    """Returns the fit of a result of the library, with the fitted spec."""
    keys, features = result["keys"], result["features"]
    key_fields = ("before", "after", "low", "high", "prior_deviation", "deviation")
    feature_fields = ("measured", "deviation", "before", "after", "predicted_deviation", "low", "high")
    numbers: dict[str, Any] = {name: column(keys, name) for name in key_fields}
    numbers |= {f"feature_{name}": column(features, name) for name in feature_fields}
    return FitResult(
        manifest=manifest,
        key=[one["key"] for one in keys],
        key_unit=[one["unit"] for one in keys],
        **numbers,
        feature=[one["name"] for one in features],
        feature_unit=[one["unit"] for one in features],
        curves=[_curve(one) for one in result["curves"]],
        deviations=[FitDeviation(**one) for one in result["deviations"]],
        correlation=np.array(result["correlation"], dtype=np.float64),
        spec=spec,
        **{name: result[name] for name in ("quantile", "chi_square", "objective", "warnings", "evaluations")},
    )


def _curve(fields: dict[str, Any]) -> FitCurve:
    numbers = {name: np.array(fields[name], dtype=np.float64) for name in ("at", "measured", "before", "after", "low", "high")}
    return FitCurve(name=fields["name"], unit=fields["unit"], over=fields["over"], **numbers)
