"""Virtual test of a harvester, the fit of its keys to measurements, and its design."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from . import _core
from ._arguments import check_integers, names, options, to_si, without_places
from ._call import recorded
from ._errors import ArgumentError
from ._progress import Progress, progress_callback
from ._quantity import toml
from ._spec_text import SpecText

if TYPE_CHECKING:
    from ._design import DesignResult
    from ._fit import FitResult
    from ._inputs import Measured
    from ._recording import Recording
    from ._sensitivity import SensitivityResult
    from ._spec import Spec


class SpecOnRig(SpecText):
    """Spec with virtual tests, fits and designs."""

    __slots__ = ()

    @recorded
    def rig(
        self,
        *,
        rate: Any = "2048 Hz",
        noise: float = 0.0,
        bits: int | None = None,
        seed: int = 1,
        at: str | Sequence[str] = (),
        sensor_mass: Any = None,
        cable: Any = None,
        cable_leakage: Any = None,
        hold: str | Sequence[str] = (),
        fixed_table: bool = False,
        hammer: str | None = None,
        hits: int = 5,
        block: Any = "4 s",
        peak: Any = "20 N",
        contact: Any = "3 ms",
        solution: str | Sequence[str | tuple[str, Any]] = (),
        starts: int = 40,
        starts_seed: int = 1,
        amplitude_wander: float = 0.0,
        frequency_wander: float = 0.0,
        wander_time: Any = "5 s",
        amplitude_drift: float = 0.0,
        frequency_drift: float = 0.0,
        base: Measured | None = None,
        base_channel: str | None = None,
        keep_mean: bool = False,
    ) -> Recording:
        """Simulates the recordings of sensors in a test, so that the true parameters are known; ``jounce rig``.

        By default the run is integrated and its averaging window recorded: voltages, V, contact forces, N, the acceleration of the base and
        those of accelerometers ``at`` some points, m/s^2.

        References
        ----------
        D. Gillespie, Phys. Rev. E 54 (1996) 2084, equation 1.9 (fluctuation of the drive).
        """
        from ._inputs import recording
        from ._recording import Recording
        from ._result import make_manifest, result_or_raise

        check_integers(bits=bits, seed=seed, hits=hits, starts=starts, starts_seed=starts_seed)
        quantities = {
            "rate_hz": ("frequency", rate),
            "sensor_mass_kg": ("mass", sensor_mass),
            "cable_f": ("capacitance", cable),
            "cable_leakage_ohm": ("resistance", cable_leakage),
            "block_s": ("time", block),
            "peak_n": ("force", peak),
            "contact_s": ("time", contact),
            "wander_time_s": ("time", wander_time),
        }
        given: dict[str, Any] = {
            field: None if value is None else to_si(kind, value, field.rpartition("_")[0]) for field, (kind, value) in quantities.items()
        }
        given |= {"noise": noise, "bits": bits, "seed": seed, "at": names(at), "hold": names(hold), "fixed_table": fixed_table}
        given |= {"hammer": hammer, "hits": hits, "solution": _solutions(solution), "starts": starts, "starts_seed": starts_seed}
        given |= {"amplitude_wander": amplitude_wander, "frequency_wander": frequency_wander}
        given |= {"amplitude_drift": amplitude_drift, "frequency_drift": frequency_drift}
        given |= {"base_channel": base_channel, "keep_mean": keep_mean}
        base_recording = None if base is None else recording(base)
        fields = result_or_raise(_core.rig(self._spec, options(**given), None if base_recording is None else base_recording._core()))
        if base_recording is not None:
            given |= {"base": base_recording.name, "base_sha256": base_recording.manifest["options"]["recording_sha256"]}
        result = Recording._from_core_recording(fields, {**make_manifest("rig", **given), "spec_sha256": self.sha256})
        return result if base_recording is None else dataclasses.replace(result, issues=[*base_recording.issues, *result.issues])

    @recorded
    def fit(self, to: str | PathLike[str] | Mapping[str, Any], *, progress: bool | Progress | None = None) -> FitResult:
        """Fits keys to measured features: the path of a file of features, or a dict with the same contents.

        ``{"hold": ["table"], "frequency_deviation": 0.002, "free": {"beam.beam.thickness": 0.01}, "mode": [{"number": 1, "frequency": "9.01
        Hz"}]}`` frees a key with a relative standard deviation of 1 % and fits the first mode to 9.01 Hz with one of 0.2 %. ``progress``
        reports the number of computed models; their total is not known and reported as 0.
        """
        from ._fit import make_fit
        from ._result import make_manifest, result_or_raise

        if isinstance(to, Mapping):
            source, source_name = {"text": features(to)}, "features"
        elif isinstance(to, (str, PathLike)):
            source, source_name = {"path": fspath(to)}, Path(to).name
        else:
            raise ArgumentError(f"to is of type {type(to).__name__}; give the path of a file of features, or a dict with the same contents")
        with progress_callback(progress) as callback:
            text, fitted = result_or_raise(_core.fit(self._spec, **source, progress=callback))
        manifest = {**make_manifest("fit", to=source_name), "spec_sha256": self.sha256}
        return make_fit(json.loads(text), cast("Spec", self._from_core(fitted)), manifest)

    @recorded
    def sensitivity(
        self,
        key: str | Sequence[str] = (),
        *,
        at: str | None = None,
        fold: bool = False,
        peak: bool = False,
        starts: int = 50,
        seed: int = 1,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> SensitivityResult:
        """Computes the derivatives of the results of a stable periodic orbit with respect to keys; ``jounce sensitivity``.

        ``key`` is a key, a list of the spec such as ``"damping.ratios"``, or several; by default all numbers of the spec other than 0. The
        orbit is the one that most of the ``starts`` of a cloud with a ``seed`` reach, or that of the id ``at`` in :meth:`basins`. With
        ``fold`` the nearest fold of its branch over the frequency of the drive is another result, with ``peak`` the nearest peak of the
        mean power: its frequency and its power.

        Raises :class:`ArgumentError` for an unknown orbit, :class:`SpecError` for an unknown key.
        """
        from ._result import make_manifest, result_or_raise
        from ._sensitivity import make_sensitivity

        check_integers(starts=starts, seed=seed, threads=threads)
        given = {"key": names(key), "at": at, "fold": fold, "peak": peak, "starts": starts, "seed": seed}
        with progress_callback(progress) as callback:
            text = result_or_raise(_core.sensitivity(self._spec, options(**given, threads=threads), callback))
        return make_sensitivity(json.loads(text), {**make_manifest("sensitivity", **given), "spec_sha256": self.sha256})

    @recorded
    def design(
        self,
        problem: str | PathLike[str] | Mapping[str, Any],
        *,
        seed: int | None = None,
        evaluations: int | None = None,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> DesignResult:
        """Searches the values of keys with the largest power within limits, and examines the best design; ``jounce design``.

        ``problem`` is the path of a design file, or a dict with the same contents: ``{"free": {"stop.tip.gap": "0.2mm:3mm"},
        "goal": {"maximise": "expected-power", "starts": 100}, "limits": {"patch.mfc.strain": "600 ppm"},
        "tolerance": {"stop.tip.gap": "0.05 mm"}}``. A key ``spec`` in it must name this spec; omit it to design another one.
        ``seed`` and ``evaluations``, the largest number of evaluated designs, replace those of the problem.
        ``progress`` reports the number of evaluated designs; their total is not known and reported as 0.

        Raises :class:`SpecError` with all faults of the problem, :class:`DesignError` where no design can be evaluated.
        """
        from ._design import make_design, problem_text
        from ._result import make_manifest, result_or_raise

        check_integers(seed=seed, evaluations=evaluations, threads=threads)
        text, folder, name = problem_text(problem)
        given = {"seed": seed, "evaluations": evaluations, "threads": threads}
        # The text of a dict has lines that its writer does not know.
        places = without_places() if isinstance(problem, Mapping) else nullcontext()
        with places, progress_callback(progress) as callback:
            result, best = result_or_raise(_core.design(self._spec, text, folder, options(**given), callback))
        manifest = {**make_manifest("design", problem=name, seed=seed, evaluations=evaluations), "spec_sha256": self.sha256}
        return make_design(json.loads(result), cast("Spec", self._from_core(best)), manifest)


def _solutions(solution: str | Sequence[str | tuple[str, Any]]) -> list[str]:
    """Returns solutions as texts: the id, and the time of the record at which it begins, ``"3a@42.0 s"``."""

    def text(one: str | tuple[str, Any]) -> str:
        if isinstance(one, str):
            return one
        if len(one) != 2 or not isinstance(one[0], str):
            raise ArgumentError(f'solution: {one!r} is invalid; give an id, as in "1a", or an id with its time, as in ("3a", "42 s")')
        return f"{one[0]}@{to_si('time', one[1], f'the time of solution {one[0]}')!r} s"

    return [text(one) for one in ([solution] if isinstance(solution, str) else solution)]


def features(tables: Mapping[str, Any]) -> str:
    """Returns features as TOML; a list of dicts is an array of tables, ``[[mode]]``."""
    lists = {key: value for key, value in tables.items() if _is_list_of_tables(value)}
    text = toml({key: value for key, value in tables.items() if key not in lists})
    return text + "".join(f"\n[[{key}]]\n{toml(one)}" for key, tables_of_key in lists.items() for one in tables_of_key)


def _is_list_of_tables(value: Any) -> bool:
    is_list = isinstance(value, Sequence) and not isinstance(value, str) and len(value) > 0
    return is_list and all(isinstance(one, Mapping) for one in value)
