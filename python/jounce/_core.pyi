"""The compiled module; the package around it is what people use."""

from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Any, Final, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Spec",
    "Study",
    "VERSION",
    "basins",
    "branch",
    "diagram",
    "ensemble",
    "examples",
    "frf",
    "jumps",
    "materials",
    "modes",
    "quantity_si",
    "run",
    "spectrum",
    "study_merge",
    "study_status",
    "sweep",
    "table_read",
]

VERSION: Final[str]

_Handed = tuple[dict[str, Any] | None, BaseException | None]
_Progress = Callable[[int, int, float | None], object] | None

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
    def part(self, part: int) -> _Handed: ...
    def run(self, folder: str | PathLike[str], shard: str, threads: int | None, progress: _Progress) -> _Handed: ...
    def missing(self, folder: str | PathLike[str]) -> list[int]: ...
    def keep(self, folder: str | PathLike[str], part: int, bytes: bytes) -> None: ...

def study_merge(folder: str | PathLike[str]) -> Path: ...
def study_status(folder: str | PathLike[str]) -> str: ...
def table_read(path: str | PathLike[str]) -> tuple[dict[str, Any], dict[str, tuple[str, str]], str]: ...
def quantity_si(kind: str, text: str) -> float: ...
def materials() -> str: ...
def examples() -> list[tuple[str, str, str]]: ...
def spectrum(values: NDArray[np.float64], sample_rate_hz: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def modes(spec: Spec, hold: list[str]) -> dict[str, Any]: ...
def frf(
    spec: Spec, frequency_hz: NDArray[np.float64], input: str | None, base: bool, hold: list[str], open_circuit: bool
) -> dict[str, Any]: ...
def run(spec: Spec, tolerance: float | None, start: str | None, record_s: float, sample_rate_hz: float) -> _Handed: ...
def sweep(
    spec: Spec,
    key: str,
    values: str,
    direction: str,
    fixed_duration: bool,
    tolerance: float | None,
    threads: int | None,
    progress: _Progress,
) -> _Handed: ...
def branch(
    spec: Spec,
    key: str,
    range: tuple[str, str],
    method: str,
    harmonics: int,
    tolerance: float,
    seeds: int,
    longest_period: int,
    threads: int | None,
    progress: _Progress,
) -> _Handed: ...
def jumps(
    spec: Spec,
    keys: tuple[str, str],
    over: tuple[str, str],
    against: tuple[str, str],
    tolerance: float,
    seeds: int,
    longest_period: int,
    peaks: bool,
    threads: int | None,
    progress: _Progress,
) -> _Handed: ...
def basins(
    spec: Spec,
    starts: int,
    seed: int,
    spread: float,
    grid: list[str],
    tolerance: float,
    threads: int | None,
    progress: _Progress,
) -> _Handed: ...
def diagram(
    spec: Spec,
    key: str,
    values: str,
    direction: str,
    starts: int,
    seed: int,
    spread: float,
    cycles: int,
    tolerance: float,
    branches: bool,
    longest_period: int,
    threads: int | None,
    progress: _Progress,
) -> _Handed: ...
def ensemble(
    spec: Spec,
    members: int,
    seed: int,
    relative_width: float | None,
    tolerance: float | None,
    threads: int | None,
    progress: _Progress,
) -> _Handed: ...
