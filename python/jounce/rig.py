"""Virtual test of a harvester: simulated sensor recordings, and the fit of its keys to measurements."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from . import _core
from .arguments import check_integers, names, optional_si, positive_si
from .errors import ArgumentError
from .fit import FitResult, make_fit
from .inputs import Measured, recording
from .progress import Progress, progress_callback
from .quantity import toml
from .recording import Recording
from .result import make_manifest, result_or_raise
from .spec_text import SpecText

if TYPE_CHECKING:
    from .spec import Spec


class SpecOnRig(SpecText):
    """Spec with virtual tests and fits."""

    __slots__ = ()

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
        those of accelerometers ``at`` some points, m/s^2. ``rate`` is the sampling rate, ``noise`` the rms noise of every sensor relative
        to the rms of its signal, ``bits`` the resolution of the converters. An accelerometer loads the structure with its ``sensor_mass``,
        ``"2 g"``; a ``cable``, ``"1 nF"``, with its ``cable_leakage``, ``"10 Mohm"``, lowers the voltage of each patch. Masses in ``hold``
        are fixed, with ``fixed_table`` all of them.

        ``hammer`` is the excitation point of a hammer test: stops and drives are removed, and the force and the accelerations ``at`` some
        points are recorded, by default all points and the voltages. There are ``hits``, one every ``block``, with a force of ``peak`` and a
        duration of ``contact``.

        ``solution`` selects solutions of the model instead of its run, by their ids in :meth:`basins`: ``["1a", ("3a", "42 s")]`` changes
        to another one at a time of the record. They are found from random ``starts`` with a seed. Amplitude and frequency of the drive
        fluctuate with the relative standard deviations ``amplitude_wander`` and ``frequency_wander`` and the correlation time
        ``wander_time``, and drift by ``amplitude_drift`` and ``frequency_drift`` from begin to end. ``base`` moves the base as in a
        recording, for its duration, instead of the drives: a :class:`Recording`, a file or SEP005 time series. Its ``base_channel`` is by
        default the first acceleration, its mean is subtracted unless ``keep_mean``.

        Raises :class:`ArgumentError` for a number out of range or an unknown name or solution, :class:`IntegrationError` for a failed
        integration. Source of the fluctuation: D. Gillespie, Phys. Rev. E 54 (1996) 2084, equation 1.9.
        """
        check_integers(bits=bits, seed=seed, hits=hits, starts=starts, starts_seed=starts_seed)
        sensors: dict[str, Any] = {"rate_hz": positive_si("frequency", rate, "rate"), "noise": noise, "bits": bits, "seed": seed}
        sensors |= {"at": names(at), "hold": self._fixed_masses(hold, fixed_table)}
        sensors["sensor_mass_kg"] = optional_si("mass", sensor_mass, "sensor_mass")
        sensors["cable_f"] = optional_si("capacitance", cable, "cable")
        sensors["cable_leakage_ohm"] = optional_si("resistance", cable_leakage, "cable_leakage")
        if sensor_mass is not None and not sensors["at"]:
            raise ArgumentError('sensor_mass needs accelerometers; name their points with at=["beam.tip"]')
        shaker: dict[str, Any] = {
            "solution": _solutions(solution),
            "starts": starts,
            "starts_seed": starts_seed,
            "amplitude_wander": amplitude_wander,
            "frequency_wander": frequency_wander,
            "wander_time_s": positive_si("time", wander_time, "wander_time"),
            "amplitude_drift": amplitude_drift,
            "frequency_drift": frequency_drift,
            "base_channel": base_channel,
            "keep_mean": keep_mean,
        }
        if hammer is not None:
            shaker_options = [
                key for key in ("solution", "amplitude_wander", "frequency_wander", "amplitude_drift", "frequency_drift") if shaker[key]
            ]
            if shaker_options or base is not None:
                raise ArgumentError(f"{', '.join(shaker_options) or 'base'} needs a shaker test, without hammer; give one of them")
            test = {"point": hammer, "hits": hits, "block_s": positive_si("time", block, "block")}
            test |= {"peak_force_n": positive_si("force", peak, "peak"), "contact_time_s": positive_si("time", contact, "contact")}
            return Recording._from_core_recording(_core.rig_struck(self._spec, sensors, test), self._rig_manifest(sensors, test))
        if shaker["solution"] and (base is not None or sensors["hold"]):
            raise ArgumentError("solution needs the complete model under its own drive; give it without base, hold and fixed_table")
        base_recording = None if base is None else recording(base)
        core_result = _core.rig_shaken(self._spec, sensors, shaker, None if base_recording is None else base_recording._core())
        base_options = (
            {}
            if base_recording is None
            else {"base": base_recording.name, "base_sha256": base_recording.manifest["options"]["recording_sha256"]}
        )
        result = Recording._from_core_recording(result_or_raise(core_result), self._rig_manifest(sensors, {**shaker, **base_options}))
        return result if base_recording is None else dataclasses.replace(result, findings=[*base_recording.findings, *result.findings])

    def _rig_manifest(self, sensors: Mapping[str, Any], test: Mapping[str, Any]) -> dict[str, Any]:
        """Returns the origin of a recording of the rig."""
        return {**make_manifest("rig", **sensors, **test), "spec_sha256": self.sha256}

    def fit(self, to: str | PathLike[str] | Mapping[str, Any], *, progress: bool | Progress | None = None) -> FitResult:
        """Fits keys to measured features: the path of a file of features, or a dict with the same contents.

        ``{"hold": ["table"], "frequency_deviation": 0.002, "free": {"beam.beam.thickness": 0.01}, "mode": [{"number": 1, "frequency": "9.01
        Hz"}]}`` frees a key with a relative standard deviation of 1 % and fits the first mode to 9.01 Hz with one of 0.2 %. ``progress``
        reports the number of computed models; their total is not known and reported as 0.
        """
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


def _solutions(solution: str | Sequence[str | tuple[str, Any]]) -> list[tuple[str, float]]:
    """Returns ids of solutions and the times of the record at which they begin, s; the first one begins with the record."""
    items = [solution] if isinstance(solution, str) else list(solution)
    solutions = []
    for number, one in enumerate(items):
        pair = (one, None) if isinstance(one, str) else tuple(one)
        if len(pair) != 2 or not isinstance(pair[0], str) or (number > 0 and pair[1] is None):
            raise ArgumentError(f'solution: {one!r} is invalid; give the id of the first, as in "1a", then pairs, as in ("3a", "42 s")')
        solutions.append((pair[0], 0.0 if number == 0 else positive_si("time", pair[1], f"the time of solution {pair[0]}")))
    return solutions


def features(tables: Mapping[str, Any]) -> str:
    """Returns features as TOML; a list of dicts is an array of tables, ``[[mode]]``."""
    lists = {key: value for key, value in tables.items() if _is_list_of_tables(value)}
    text = toml({key: value for key, value in tables.items() if key not in lists})
    return text + "".join(f"\n[[{key}]]\n{toml(one)}" for key, tables_of_key in lists.items() for one in tables_of_key)


def _is_list_of_tables(value: Any) -> bool:
    is_list = isinstance(value, Sequence) and not isinstance(value, str) and len(value) > 0
    return is_list and all(isinstance(one, Mapping) for one in value)
