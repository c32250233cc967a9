"""Structures of other programs, reduced to modes: matrices in files and in memory."""

from __future__ import annotations

import dataclasses
import tomllib
from collections.abc import Callable, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from . import _core
from ._arguments import check_integers, options, to_si
from ._errors import ArgumentError
from ._fields import About, Along, Variable
from ._matrix_entries import MatrixEntries, entries_of, row_of, stacked
from ._result import Floats, Result, make_manifest

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from xarray import Dataset


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class ImportResult(Result):
    """Structure of another program as modes, in ascending frequency.

    :attr:`spec` is its part of a spec, :attr:`tables` the same as a dict.
    """

    frequency_hz: Annotated[Floats, Along("mode", "Hz", "natural frequency, short circuit", detail="0 for a rigid-body mode")]
    rayleigh_hz: Annotated[Floats, Along("mode", "Hz", "frequency of Rayleigh's quotient of the shape with stiffness and mass")]
    damping_ratio: Annotated[Floats, Along("mode", "1", "damping ratio")]
    frequency_error: Annotated[
        Floats, Along("mode", "1", "bound of the relative error of the frequency", detail="without roundoff; NaN for given shapes")
    ]
    points: Annotated[list[str], About("names of the points")]
    electrodes: Annotated[list[str], About("names of the electrodes, which are the patches of the structure")]
    has_given_shapes: Annotated[bool, About("True where the shapes were given with the matrices")]
    orthogonality: Annotated[float, About("largest deviation of the mass-normalised shapes from orthonormal ones")]
    stiffness_orthogonality: Annotated[
        float, About("largest product of two elastic shapes with the stiffness, relative to the root of the product of their own")
    ]
    damping_coupling: Annotated[float, About("largest damping between two modes relative to their own; the structure leaves it out")]
    spec: Annotated[str, About("part of a spec, ``[modal.NAME]``")]
    warnings: Annotated[
        list[str], About("modes set to 0 Hz, damping left out, shapes that are not orthogonal, frequencies that are not theirs")
    ]

    def __len__(self) -> int:
        return len(self.frequency_hz)

    @property
    def tables(self) -> dict[str, Any]:
        """Tables of :attr:`spec`, for ``jounce.Spec(result.tables, stop=..., drive=...)``."""
        return tomllib.loads(self.spec)

    def _summary(self) -> list[tuple[str, str]]:
        modes = zip(self.frequency_hz, self.damping_ratio)
        lines = [(f"mode {k + 1}", f"{f:.6g} Hz, damping ratio {z:.4g}") for k, (f, z) in enumerate(modes)]
        named = (("points", self.points), ("electrodes", self.electrodes))
        lines += [(kind, ", ".join(names)) for kind, names in named if names]
        if self.has_given_shapes:
            products = f"{100 * self.orthogonality:.3g} % in the mass, {100 * self.stiffness_orthogonality:.3g} % in the stiffness"
            lines.append(("given shapes", f"orthogonal to {products}"))
        return lines + [("warning", text) for text in self.warnings]

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``mode``."""
        return self._dataset(self._variables(), {"mode": Variable(("mode",), range(1, len(self) + 1), "1", "number of the mode")})

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for each mode."""
        return self._frame(self._columns("mode"))

    def _pictures(self) -> dict[str, Callable[[Any], Any]]:
        return {"frequency": self.plot_frequencies}

    def plot_frequencies(self, ax: Axes | None = None) -> Axes:
        """Draws the natural frequency of each mode."""
        from ._plot.modes import plot_frequencies

        return plot_frequencies(self, ax)


def import_matrices(
    folder: str | PathLike[str],
    *,
    name: str = "structure",
    modes: int = 10,
    damping_ratio: float | Sequence[float] = 0.01,
    mass_unit: Any = "1kg",
    length_unit: Any = "1m",
    names: str | PathLike[str] | None = None,
) -> ImportResult:
    """Reduces the matrices of a folder to the lowest modes of a structure, ``jounce import``; also reads the modes of a universal file.

    The folder holds ``mass.mtx`` and ``stiffness.mtx`` in the Matrix Market format, or ``.npz`` of ``scipy.sparse.save_npz``, and the
    other files of :meth:`Spec.export`, which writes such a folder. Instead of a folder, a universal file with modes (data set 55) may be
    given. ``names`` is the table of the names of points and electrodes, by default ``names.csv`` in the folder of the other files.
    """
    given = _options(name, modes, damping_ratio, mass_unit, length_unit)
    given["names"] = None if names is None else fspath(names)
    fields = _core.import_matrices(fspath(folder), options(**given))
    return _result(fields, {"folder": Path(folder).name, **given})


def from_matrices(
    mass: Any,
    stiffness: Any = None,
    *,
    shapes: Any = None,
    frequency_hz: Any = None,
    damping: Any = None,
    points: Mapping[str, Any] | None = None,
    base: Any = None,
    coupling: Mapping[str, Any] | None = None,
    capacitance: Mapping[str, Any] | None = None,
    leakage: Mapping[str, Any] | None = None,
    name: str = "structure",
    modes: int = 10,
    damping_ratio: float | Sequence[float] = 0.01,
    mass_unit: Any = "1kg",
    length_unit: Any = "1m",
) -> ImportResult:
    """Reduces the matrices of a finite-element program to the lowest modes of a structure.

    Matrices are sparse ones of scipy or arrays of numpy, vectors have a value for each degree of freedom. Fixed degrees of freedom must
    be removed first. :func:`import_matrices` reads the same from files. With ``shapes`` the structure has these modes; how far they are
    from orthogonal ones is in the result. An object with the attributes ``M`` and ``K``, and perhaps ``shapes`` and ``frequency_hz``,
    takes the place of ``mass`` and ``stiffness``.
    """
    if stiffness is None:
        mass, stiffness, shapes, frequency_hz = _parts_of(mass, shapes, frequency_hz)
    given = _options(name, modes, damping_ratio, mass_unit, length_unit)
    size = int(np.shape(mass)[0]) if np.ndim(mass) == 2 else 0
    square = {"mass": mass, "stiffness": stiffness, "damping": damping}
    matrices = [entries_of(key, matrix) for key, matrix in square.items() if matrix is not None]
    points, coupling = dict(points or {}), dict(coupling or {})
    if points:
        matrices.append(stacked("points", [row_of(f"points[{key!r}]", value, size) for key, value in points.items()], size))
    if base is not None:
        matrices.append(stacked("base", [row_of("base", base, size)], size, as_columns=True))
    if coupling:
        rows = [row_of(f"coupling[{key!r}]", value, size) for key, value in coupling.items()]
        matrices.append(stacked("coupling", rows, size, as_columns=True))
    if shapes is not None:
        matrices.append(entries_of("shapes", shapes))
    if frequency_hz is not None:
        values = np.asarray(frequency_hz)
        matrices.append(entries_of("frequency_hz", values.reshape(-1, 1) if values.ndim <= 1 else values))
    matrices += _electrical(list(coupling), capacitance, leakage)
    fields = _core.reduce_matrices(matrices, list(points), list(coupling), options(**given))
    return _result(fields, given)


def _parts_of(model: Any, shapes: Any, frequency_hz: Any) -> tuple[Any, Any, Any, Any]:
    """Returns mass, stiffness, shapes and frequencies of an object; the last two may be given instead."""
    missing = [name for name in ("M", "K") if getattr(model, name, None) is None]
    if missing:
        raise ArgumentError(
            f"stiffness is missing, and the first argument, of type {type(model).__name__}, has no {' and no '.join(missing)}; "
            "give two matrices, or an object with M and K"
        )
    shapes = getattr(model, "shapes", None) if shapes is None else shapes
    frequency_hz = getattr(model, "frequency_hz", None) if frequency_hz is None else frequency_hz
    return model.M, model.K, shapes, frequency_hz


def _options(name: str, modes: int, damping_ratio: float | Sequence[float], mass_unit: Any, length_unit: Any) -> dict[str, Any]:
    """Returns the options of the library."""
    check_integers(modes=modes)
    ratios = np.atleast_1d(np.asarray(damping_ratio, dtype=np.float64)).tolist()
    units = {"mass_unit_kg": to_si("mass", mass_unit, "mass_unit"), "length_unit_m": to_si("length", length_unit, "length_unit")}
    return {"name": name, "modes": modes, "damping_ratio": ratios, **units}


def _electrical(electrodes: list[str], capacitance: Mapping[str, Any] | None, leakage: Mapping[str, Any] | None) -> list[MatrixEntries]:
    """Returns the diagonal matrices of the capacitances and of the conductances."""
    matrices = []
    for what, name, values in (("capacitance", "capacitance", capacitance), ("leakage", "conductance", leakage)):
        unknown = sorted(set(values or {}) - set(electrodes))
        if unknown:
            raise ArgumentError(
                f"{what} is given for {', '.join(unknown)}, but coupling has {', '.join(electrodes) or 'no electrodes'}",
                {"unknown": unknown, "electrodes": electrodes},
            )
        if not values:
            continue
        kind = "capacitance" if what == "capacitance" else "resistance"
        by_electrode = {key: to_si(kind, value, f"{what} of {key}") for key, value in values.items()}
        zero = [key for key, value in by_electrode.items() if value == 0.0]
        if zero:
            raise ArgumentError(f"{what} of {zero[0]} is {values[zero[0]]}; it must be above 0", {"given": repr(values[zero[0]])})
        if what == "leakage":
            by_electrode = {key: 1.0 / value for key, value in by_electrode.items()}
        matrices.append(entries_of(name, np.diag([by_electrode.get(key, 0.0) for key in electrodes])))
    return matrices


def _result(fields: dict[str, Any], given: Mapping[str, Any]) -> ImportResult:
    return ImportResult(manifest=make_manifest("import", **given), **ImportResult._filled(fields))
