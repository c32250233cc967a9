"""A harvester: what is said of it, and what can be asked of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np

from . import _core
from .arguments import check_wholes, frequencies, names
from .arguments import si as in_si
from .basins import BasinsResult
from .branch import BranchResult
from .diagram import DiagramResult
from .ensemble import EnsembleResult
from .errors import ArgumentError
from .frf import FrfResult
from .jumps import JumpsResult
from .modes import ModesResult
from .noise import NoiseResult
from .progress import Progress, told
from .quantity import sides, span, values
from .rig import SpecOnRig
from .run import RunResult, State
from .sweep import SweepResult


class Spec(SpecOnRig):
    """A harvester, always valid: a change that would make it wrong raises :class:`jounce.SpecError` with every fault, and changes nothing.

    Parameters
    ----------
    source
        The text of a spec in TOML, or a dict of its tables. Files are read with :meth:`Spec.read`.
    tables
        Tables by keyword, ``stop={"tip": jounce.Stop(at="beam.tip", ...)}``; they take the place of those of a dict.

    Quantities are text with a unit, ``"0.5 mm"``, or quantities of pint. A number without a unit is refused.
    """

    __slots__ = ()

    def modes(self, hold: str | Sequence[str] = (), *, fixed_table: bool = False) -> ModesResult:
        """Natural frequencies, damping ratios, couplings and shapes, with some masses held still, with ``fixed_table`` all of them."""
        return ModesResult._made(_core.modes(self._spec, self._held(hold, fixed_table)))

    def frf(
        self,
        frequency: Any = None,
        *,
        input: str | None = None,
        base: bool = False,
        hold: str | Sequence[str] = (),
        fixed_table: bool = False,
        open_circuit: bool = False,
    ) -> FrfResult:
        """Frequency responses without contact, per newton on ``input`` (by default the point of the first force).

        With ``base`` the base is accelerated instead: displacements relative to it and voltages, per m/s^2. Masses in ``hold`` are held
        still, with ``fixed_table`` all of them; with ``open_circuit`` the patches have no circuit.

        ``frequency``: text or quantities, ``["1 Hz", "2 Hz"]``, or a pint array; by default 2000 from 1 to 1000 Hz.
        """
        return FrfResult._handed(_core.frf(self._spec, frequencies(frequency), input, base, self._held(hold, fixed_table), open_circuit))

    def noise(self, *, low: Any = None, high: Any = None, points: int = 1000) -> NoiseResult:
        """What the noises of the spec do without contact, exact: means, mean squares, bandwidths, how often each gap would be reached.

        Densities are told at ``points`` frequencies from ``low`` to ``high``, by default over the band of the noise, and at more about each
        resonance.
        """
        check_wholes(points=points)
        low_hz = None if low is None else in_si("frequency", low, "low")
        high_hz = None if high is None else in_si("frequency", high, "high")
        return NoiseResult._handed(_core.noise(self._spec, low_hz, high_hz, points))

    def run(
        self,
        *,
        tolerance: float | None = None,
        start: State | None = None,
        record: Any = None,
        sample_rate: Any = "4096 Hz",
        progress: bool | Progress | None = None,
    ) -> RunResult:
        """Marches one run.

        ``tolerance`` overrides ``run.tolerance``; ``start`` is the ``end`` of another run; ``record`` is how much of the end of the run is
        kept as samples, ``"1 s"``. The parts that ``progress`` tells of are thousandths of the duration.
        """
        record_s = 0.0 if record is None else in_si("time", record, "record")
        rate_hz = in_si("frequency", sample_rate, "sample_rate")
        if record_s < 0.0 or not 0.0 < rate_hz < np.inf:
            given = {"record_s": record_s, "sample_rate_hz": rate_hz, "least_record_s": 0, "least_sample_rate_hz": 0}
            raise ArgumentError(
                f"record is {record_s} s, sample_rate {rate_hz} Hz; give a record of at least 0 s and a rate above 0 Hz", given
            )
        if start is not None and not isinstance(start, State):
            raise ArgumentError(f"start is of type {type(start).__name__}; give the `end` of another run, or jounce.State.read(PATH)")
        with told(progress) as tell:
            answer, ended = _core.run(self._spec, tolerance, start.json if start else None, record_s, rate_hz, tell)
        return RunResult._handed((answer and {**answer, "sample_rate_hz": rate_hz}, ended))

    def sweep(
        self,
        key: str,
        range: Any,
        *,
        unit: str | None = None,
        direction: Literal["up", "down", "both", "independent"] = "up",
        fixed_duration: bool = False,
        tolerance: float | None = None,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> SweepResult:
        """Marches a run at every value of a key, the state carried over unless the points are ``"independent"``.

        ``range``: ``"10 Hz:14 Hz:0.5 Hz"`` (step), ``"10 Hz:14 Hz:9x"`` (number), ``"1 kohm:1 Mohm:9log"``, a list of quantities, or
        numbers with their ``unit``. Each point marches until it has settled, or for ``run.duration`` with ``fixed_duration``.
        """
        check_wholes(threads=threads)
        text = values(range, unit, key)
        with told(progress) as tell:
            return SweepResult._handed(_core.sweep(self._spec, key, text, direction, fixed_duration, tolerance, threads, tell))

    def branch(
        self,
        key: str,
        range: Any,
        *,
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
        """Follows every branch of periodic answers over ``range = "12 Hz:13 Hz"`` of a key, stable or not.

        Branches that no march of the ``seeds`` settles on are not found, and none of a period above ``longest_period`` cycles; more of
        both find more. ``harmonics`` is where harmonic balance begins, 64 if left out.

        ``levels`` are labelled where a branch passes them: ``"mean_power=50 uW"``, ``"voltage.PATCH=5 V"``, ``"strain.PATCH=3e-4"``,
        ``"contact_force.STOP=2 N"``. ``largest_step`` is in relative changes of the state or twentieths of the range. After orbits of
        ``budget`` drive cycles no further branch is followed; the rest is counted in ``not_followed``.
        """
        check_wholes(harmonics=harmonics, seeds=seeds, longest_period=longest_period, budget=budget, threads=threads)
        ends = span(range, key)
        with told(progress) as tell:
            options = (method, harmonics, tolerance, seeds, longest_period, names(levels), (largest_step, budget))
            found = _core.branch(self._spec, key, ends, *options, threads, tell)
            return BranchResult._handed(found)

    def jumps(
        self,
        key: str,
        range: Any,
        key_2: str,
        range_2: Any,
        *,
        tolerance: float = 1e-9,
        seeds: int = 4,
        longest_period: int = 2,
        peaks: bool = True,
        levels: str | Sequence[str] = (),
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> JumpsResult:
        """Follows the places where the answer jumps (folds, doublings, tori, grazings) over two keys, and the ``peaks`` of power.

        ``levels`` are followed too, given as in :meth:`branch`.

        Curves that pass neither an edge of the two ranges nor the spec's own value of ``key_2`` are not found, nor those of branches that
        no march of the ``seeds`` settles on or of a period above ``longest_period`` cycles.
        """
        check_wholes(seeds=seeds, longest_period=longest_period, threads=threads)
        over, against = span(range, key), span(range_2, key_2)
        with told(progress) as tell:
            options = (tolerance, seeds, longest_period, peaks, names(levels))
            found = _core.jumps(self._spec, (key, key_2), over, against, *options, threads, tell)
            return JumpsResult._handed(found)

    def basins(
        self,
        *,
        starts: int | None = None,
        seed: int | None = None,
        spread: float | None = None,
        grid: Mapping[str, Any] | None = None,
        tolerance: float = 1e-8,
        longest_period: int | None = None,
        max_cycles: int | None = None,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> BasinsResult:
        """Finds the attractors, the share of the starts that each takes, and the power to be expected.

        The starts are a cloud of ``starts`` (200) starts with the ``seed`` 1, ``spread`` (10) gaps wide, or every combination of the
        sides of a ``grid``: ``{"displacement": "-5 mm:5 mm:21x", "velocity": ("-1 m/s", "1 m/s", 21)}``, and ``"voltage"``.

        A start belongs to the orbit that its motion is proved to reach, of a period of up to ``longest_period`` (64) drive cycles. A start
        without a proved attractor after ``max_cycles`` (20000) is chaos or undecided.
        """
        check_wholes(starts=starts, seed=seed, longest_period=longest_period, max_cycles=max_cycles, threads=threads)
        with told(progress) as tell:
            cloud = (starts, seed, spread, sides(grid))
            return BasinsResult._handed(_core.basins(self._spec, *cloud, tolerance, longest_period, max_cycles, threads, tell))

    def diagram(
        self,
        key: str,
        range: Any,
        *,
        unit: str | None = None,
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
        """Marches to where the motion is at the start of each drive cycle, over rising values of a key.

        ``"starts"`` marches at each value from a cloud of ``starts`` (20) starts with the ``seed`` 1 and the size ``spread`` (10 gaps),
        and follows the attractors from value to value; the other directions carry the state over and have no cloud. ``range`` is as in
        :meth:`sweep`; ``cycles`` is how many points a motion without a period shows, ``longest_period`` (4) that of a continued branch.
        """
        check_wholes(starts=starts, seed=seed, cycles=cycles, longest_period=longest_period, threads=threads)
        text = values(range, unit, key)
        cloud = (starts, seed, spread)
        with told(progress) as tell:
            found = _core.diagram(self._spec, key, text, direction, *cloud, cycles, tolerance, branches, longest_period, threads, tell)
            return DiagramResult._handed(found)

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
        """Marches realisations of the noise and answers with 95 % intervals.

        With ``relative_width``, rounds of so many ``members`` are added until half the interval of the mean power is this share of it.
        With ``spectrum``, of two members at least, the power spectral density of every voltage and its bandwidth are estimated as well.
        """
        check_wholes(members=members, seed=seed, threads=threads)
        with told(progress) as tell:
            found = _core.ensemble(self._spec, members, seed, relative_width, spectrum, tolerance, threads, tell)
            return EnsembleResult._handed(found)
