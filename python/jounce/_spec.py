"""Harvesters and the computations on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from . import _core
from ._arguments import check_integers, names, optional_hz, options, to_si
from ._call import recorded
from ._errors import ArgumentError, warn_not_settled
from ._linear import LinearSpec
from ._progress import Progress, progress_callback
from ._ranges import naming_unit, sides, span, values

if TYPE_CHECKING:
    from ._basins import BasinsResult
    from ._bifurcations import BifurcationsResult
    from ._branch import BranchResult
    from ._cite import CiteResult
    from ._diagram import DiagramResult
    from ._ensemble import EnsembleResult
    from ._run import RunResult
    from ._state import State
    from ._sweep import SweepResult


class Spec(LinearSpec):
    """Harvester, always valid: an invalid change raises :class:`jounce.SpecError` with every fault, and changes nothing.

    Parameters
    ----------
    source
        Text of a spec in TOML, or a dict of its tables. Files are read with :meth:`Spec.read`.
    tables
        Tables by keyword, ``stop={"tip": jounce.Stop(at="beam.tip", ...)}``; they replace those of a dict.

    Quantities are text with a unit, ``"0.5 mm"``, or quantities of pint. A number without a unit is refused.
    """

    __slots__ = ()

    @recorded
    def cite(self) -> CiteResult:
        """Lists the publications behind the harvester, its models and the methods that it admits, each with its reasons."""
        from . import CiteResult

        return CiteResult._from_core_cite(_core.cite(self._spec))

    @recorded
    def run(
        self,
        *,
        tolerance: float | None = None,
        start: State | None = None,
        record: Any = None,
        sample_rate: Any = None,
        progress: bool | Progress | None = None,
    ) -> RunResult:
        """Integrates one run from a start in time.

        The parts reported to ``progress`` are thousandths of the duration.

        Warns
        -----
        NotSettled
            The run has not reached steady state.
        """
        from . import RunResult, State

        given = options(
            tolerance=tolerance,
            record_s=0.0 if record is None else to_si("time", record, "record"),
            sample_rate_hz=optional_hz(sample_rate, "sample_rate"),
        )
        if start is not None and not isinstance(start, State):
            raise ArgumentError(f"start is of type {type(start).__name__}; give the `end` of another run, or jounce.State.read(PATH)")
        with progress_callback(progress) as callback:
            result = RunResult._from_core_call(_core.run(self._spec, given, start.json if start else None, callback))
        if result.is_transient:
            warn_not_settled(f"the run has not settled: its state changes by {result.periodicity_change:.1e} over its period", frames=2)
        return result

    @recorded
    def sweep(
        self,
        key: str,
        range: Any,
        *,
        unit: Any = None,
        direction: Literal["up", "down", "both", "independent"] = "up",
        fixed_duration: bool = False,
        tolerance: float | None = None,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> SweepResult:
        """Runs the model at every value of a key, from the last state of the point before unless ``"independent"``.

        Each point is integrated until it has settled. ``range`` may be an array of numpy, pandas, xarray or pint.

        Warns
        -----
        NotSettled
            Some points have not reached steady state.
        """
        from . import SweepResult

        check_integers(threads=threads)
        over = f"{key}={values(range, unit, key)}"
        given = options(over=over, direction=direction, fixed_duration=fixed_duration, tolerance=tolerance, threads=threads)
        with naming_unit('unit="{}"'), progress_callback(progress) as callback:
            result = SweepResult._from_core_call(_core.sweep(self._spec, given, callback))
        if result.transient.any():
            warn_not_settled(f"{int(result.transient.sum())} of {len(result)} points have not settled; `transient` marks them", frames=2)
        return result

    @recorded
    def branch(
        self,
        key: str,
        range: Any,
        *,
        unit: Any = None,
        method: Literal["shooting", "harmonic-balance"] = "shooting",
        harmonics: int | None = None,
        tolerance: float = 5e-10,
        seeds: int = 12,
        longest_period: int = 12,
        levels: str | Sequence[str] = (),
        largest_step: float = 0.4,
        budget: int = 10000,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> BranchResult:
        """Continues every branch of periodic orbits over a range of a key, stable or unstable.

        Branches that none of the ``seeds`` converges to, and branches of a period above ``longest_period`` cycles, are not found; larger
        values of both find more. ``not_followed`` of a branch counts those beyond the ``budget``.
        """
        from . import BranchResult

        check_integers(harmonics=harmonics, seeds=seeds, longest_period=longest_period, budget=budget, threads=threads)
        given = options(
            over=f"{key}={span(range, unit, key)}",
            method=method,
            harmonics=harmonics,
            tolerance=tolerance,
            seeds=seeds,
            longest_period=longest_period,
            levels=names(levels),
            largest_step=largest_step,
            budget=budget,
            threads=threads,
        )
        with naming_unit('unit="{}"'), progress_callback(progress) as callback:
            return BranchResult._from_core_call(_core.branch(self._spec, given, callback))

    @recorded
    def bifurcations(
        self,
        key: str,
        range: Any,
        key_2: str,
        range_2: Any,
        *,
        unit: Any = None,
        unit_2: Any = None,
        tolerance: float = 1e-9,
        seeds: int = 4,
        longest_period: int = 2,
        peaks: bool = True,
        levels: str | Sequence[str] = (),
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> BifurcationsResult:
        """Continues bifurcation curves (folds, period doublings, tori, grazings) in two keys, and the ``peaks`` of power.

        The search misses curves that pass neither an edge of the two ranges nor the value of ``key_2`` in the spec. It also misses curves
        of branches that none of the ``seeds`` converges to, and of periods above ``longest_period`` cycles.
        """
        from . import BifurcationsResult

        check_integers(seeds=seeds, longest_period=longest_period, threads=threads)
        given = options(
            over=f"{key}={span(range, unit, key)}",
            against=f"{key_2}={span(range_2, unit_2, key_2)}",
            tolerance=tolerance,
            seeds=seeds,
            longest_period=longest_period,
            peaks=peaks,
            levels=names(levels),
            threads=threads,
        )
        with naming_unit('unit="{}" or unit_2="{}"'), progress_callback(progress) as callback:
            return BifurcationsResult._from_core_call(_core.bifurcations(self._spec, given, callback))

    @recorded
    def basins(
        self,
        *,
        starts: int = 200,
        seed: int = 1,
        spread: float = 10.0,
        grid: Mapping[str, Any] | None = None,
        units: Mapping[str, Any] | None = None,
        tolerance: float = 1e-8,
        longest_period: int = 64,
        max_cycles: int = 20000,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> BasinsResult:
        """Finds the attractors, the share of the starts that reach each, and the expected power.

        A start belongs to the orbit that its motion is proven to reach.
        """
        from . import BasinsResult

        check_integers(starts=starts, seed=seed, longest_period=longest_period, max_cycles=max_cycles, threads=threads)
        given = options(
            starts=starts,
            seed=seed,
            spread=spread,
            grid=sides(grid, units),
            tolerance=tolerance,
            longest_period=longest_period,
            max_cycles=max_cycles,
            threads=threads,
        )
        with naming_unit('units={"SIDE": "{}"}'), progress_callback(progress) as callback:
            return BasinsResult._from_core_call(_core.basins(self._spec, given, callback))

    @recorded
    def diagram(
        self,
        key: str,
        range: Any,
        *,
        unit: Any = None,
        direction: Literal["up", "down", "both", "starts"] = "both",
        starts: int | None = None,
        seed: int | None = None,
        spread: float | None = None,
        cycles: int = 64,
        tolerance: float = 1e-8,
        branches: bool = True,
        longest_period: int | None = None,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> DiagramResult:
        """Computes the state at the start of each drive cycle, over increasing values of a key.

        ``"starts"`` integrates at each value from a cloud of starts and matches the attractors between values. The other directions start
        from the state of the value before and have no cloud.
        """
        from . import DiagramResult

        check_integers(starts=starts, seed=seed, cycles=cycles, longest_period=longest_period, threads=threads)
        given = options(
            over=f"{key}={values(range, unit, key)}",
            direction=direction,
            starts=starts,
            seed=seed,
            spread=spread,
            cycles=cycles,
            tolerance=tolerance,
            branches=branches,
            longest_period=longest_period,
            threads=threads,
        )
        with naming_unit('unit="{}"'), progress_callback(progress) as callback:
            return DiagramResult._from_core_call(_core.diagram(self._spec, given, callback))

    @recorded
    def ensemble(
        self,
        *,
        members: int = 16,
        seed: int = 1,
        relative_width: float | None = None,
        spectrum: bool = False,
        tolerance: float | None = None,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> EnsembleResult:
        """Integrates realisations of the noise and estimates means with 95 % intervals."""
        from . import EnsembleResult

        check_integers(members=members, seed=seed, threads=threads)
        given = options(members=members, seed=seed, relative_width=relative_width, spectrum=spectrum, tolerance=tolerance, threads=threads)
        with progress_callback(progress) as callback:
            return EnsembleResult._from_core_call(_core.ensemble(self._spec, given, callback))

    def export(self, *, matrices: str | PathLike[str] | None = None, spice: str | PathLike[str] | None = None) -> list[Path]:
        """Writes the model for other programs, ``jounce export``, and returns the written files.

        Matrices are those of the modes, without loads, stops and drives; :func:`jounce.import_matrices` reads them back.
        """
        paths = {name: None if path is None else fspath(path) for name, path in (("matrices", matrices), ("spice", spice))}
        return _core.export(self._spec, options(**paths))


def read(path: str | PathLike[str]) -> Spec:
    """Reads the spec of a harvester from a TOML file."""
    return Spec.read(path)
