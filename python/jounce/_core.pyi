"""The compiled module; the package around it is what people use. Written by ``python/stubs.py``."""

from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Any, Final, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Explorer",
    "Spec",
    "Study",
    "VERSION",
    "basins",
    "branch",
    "diagram",
    "ensemble",
    "examples",
    "fit",
    "frf",
    "jumps",
    "keys",
    "materials",
    "measured_contact",
    "measured_decays",
    "measured_frf",
    "measured_modes",
    "measured_power",
    "measured_regimes",
    "measured_spectra",
    "modes",
    "noise",
    "quantity_si",
    "recording_even",
    "recording_from_arrays",
    "recording_read",
    "recording_write",
    "reproduce",
    "rig_shaken",
    "rig_struck",
    "run",
    "schema",
    "spectrum",
    "starter",
    "starters",
    "study_merge",
    "study_status",
    "sweep",
    "table_read",
]

VERSION: Final[str]

_CallResult = tuple[dict[str, Any] | None, BaseException | None]
_Progress = Callable[[int, int, float | None], object] | None

@final
class Explorer:
    def __new__(cls, *, spec: Spec | None = None, path: str | PathLike[str] | None = None, listen: str | None = None) -> Explorer: ...
    @property
    def address(self) -> str: ...
    @property
    def running(self) -> bool: ...
    def open(self) -> None: ...
    def stop(self) -> None: ...
    def wait(self) -> None: ...

@final
class Spec:
    def __new__(cls, text: str, folder: str | PathLike[str]) -> Spec: ...
    @staticmethod
    def read(path: str | PathLike[str]) -> Spec: ...
    def with_keys(self, keys: list[tuple[str, str]]) -> Spec: ...
    @property
    def text(self) -> str: ...
    @property
    def folder(self) -> Path: ...
    def to_toml(self) -> str: ...
    def findings(self) -> str: ...
    def hash_hex(self) -> str: ...
    def number(self, key: str) -> tuple[float, str]: ...
    def drawing(self, title: str) -> tuple[str, bytes]: ...
    def write(self, path: str | PathLike[str]) -> None: ...

@final
class Study:
    def __new__(cls, spec: Spec, text: str) -> Study: ...
    def hash_hex(self) -> str: ...
    def points(self) -> int: ...
    def parts(self) -> int: ...
    def points_of(self, part: int) -> int: ...
    def point(self, index: int) -> list[float]: ...
    def part(self, part: int) -> _CallResult: ...
    def run(self, folder: str | PathLike[str], shard: str, threads: int | None, progress: _Progress) -> _CallResult: ...
    def missing(self, folder: str | PathLike[str]) -> list[int]: ...
    def keep(self, folder: str | PathLike[str], part: int, bytes: bytes) -> None: ...

def basins(spec: Spec, options: str, progress: _Progress) -> _CallResult: ...
def branch(
    spec: Spec,
    key: str,
    range: tuple[str, str],
    method: str,
    harmonics: int | None,
    tolerance: float,
    seeds: int,
    longest_period: int,
    levels: list[str],
    step_and_budget: tuple[float, int],
    threads: int | None,
    progress: _Progress,
) -> _CallResult: ...
def diagram(
    spec: Spec,
    key: str,
    values: str,
    direction: str,
    starts: int | None,
    seed: int | None,
    spread: float | None,
    cycles: int,
    tolerance: float,
    branches: bool,
    longest_period: int | None,
    threads: int | None,
    progress: _Progress,
) -> _CallResult: ...
def ensemble(
    spec: Spec,
    members: int,
    seed: int,
    relative_width: float | None,
    spectrum: bool,
    tolerance: float | None,
    threads: int | None,
    progress: _Progress,
) -> _CallResult: ...
def examples() -> list[tuple[str, str, str]]: ...
def fit(
    spec: Spec, *, text: str | None = None, path: str | PathLike[str] | None = None, progress: _Progress = None
) -> tuple[tuple[str, Spec] | None, BaseException | None]: ...
def frf(spec: Spec, options: str) -> _CallResult: ...
def jumps(
    spec: Spec,
    keys: tuple[str, str],
    over: tuple[str, str],
    against: tuple[str, str],
    tolerance: float,
    seeds: int,
    longest_period: int,
    peaks: bool,
    levels: list[str],
    threads: int | None,
    progress: _Progress,
) -> _CallResult: ...
def materials() -> str: ...
def measured_contact(recording: dict[str, Any], force: str | None, mass_kg: float | None) -> dict[str, Any]: ...
def measured_decays(
    recordings: list[dict[str, Any]], unforced: dict[str, Any], between_hz: tuple[float, float] | None, order: int
) -> dict[str, Any]: ...
def measured_frf(recordings: list[dict[str, Any]], hammer: dict[str, Any]) -> dict[str, Any]: ...
def measured_modes(
    recordings: list[dict[str, Any]], hammer: dict[str, Any], between_hz: tuple[float, float] | None, order: int
) -> dict[str, Any]: ...
def measured_power(
    recording: dict[str, Any],
    resistance_ohm: float,
    voltage: str | None,
    base: str | None,
    drive_hz: float | None,
    orders: list[float],
    remove_mean: bool,
) -> _CallResult: ...
def recording_even(recording_input: dict[str, Any]) -> dict[str, Any]: ...
def recording_from_arrays(recording_input: dict[str, Any]) -> dict[str, Any]: ...
def recording_read(path: str | PathLike[str]) -> dict[str, Any]: ...
def recording_write(recording_input: dict[str, Any], path: str | PathLike[str]) -> None: ...
def measured_regimes(
    recording: dict[str, Any],
    drive_hz: float,
    channel: str | None,
    resistance_ohm: float | None,
    model: Spec | None,
    comparison: dict[str, Any],
) -> _CallResult: ...
def measured_spectra(recording: dict[str, Any], channel: str | None, segment_options: dict[str, Any]) -> _CallResult: ...
def modes(spec: Spec, options: str) -> dict[str, Any]: ...
def noise(spec: Spec, options: str) -> _CallResult: ...
def reproduce(options: str, progress: _Progress) -> _CallResult: ...
def rig_shaken(spec: Spec, sensors: dict[str, Any], shaker: dict[str, Any], base: dict[str, Any] | None) -> _CallResult: ...
def rig_struck(spec: Spec, sensors: dict[str, Any], hits: dict[str, Any]) -> dict[str, Any]: ...
def run(spec: Spec, options: str, start: str | None, progress: _Progress) -> _CallResult: ...
def spectrum(values: NDArray[np.float64], sample_rate_hz: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def keys() -> str: ...
def quantity_si(kind: str, text: str) -> float: ...
def schema() -> str: ...
def starter(kind: str) -> str: ...
def starters() -> list[tuple[str, str]]: ...
def study_merge(folder: str | PathLike[str]) -> Path: ...
def study_status(folder: str | PathLike[str]) -> str: ...
def table_read(path: str | PathLike[str]) -> tuple[dict[str, Any], dict[str, Any], str]: ...
def sweep(
    spec: Spec,
    key: str,
    values: str,
    direction: str,
    fixed_duration: bool,
    tolerance: float | None,
    threads: int | None,
    progress: _Progress,
) -> _CallResult: ...
