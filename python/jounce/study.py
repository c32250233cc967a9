"""Studies: one quantity at many points over the keys of a spec, in parts, on any number of processes."""

from __future__ import annotations

import concurrent.futures
import json
import math
import time
import tomllib
from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any, Literal

from . import _core
from .arguments import check_wholes
from .errors import ArgumentError, FileError, Interrupted, SpecError
from .progress import Progress, told
from .quantity import plain, toml
from .quantity import values as range_text
from .spec import Spec
from .study_result import StudyResult, StudyStatus

#: Target duration of a task for an executor, s: long relative to its overhead.
TASK_S = 1.0


class Study:
    """A spec, the keys to vary, and the quantity to compute at each point.

    Parameters
    ----------
    spec
        Harvester.
    vary
        Values of each key, ``{"stop.tip.gap": "0.5mm:1.5mm:20x", "circuit.load.resistance": ["1 kohm", "1 Mohm"]}``; with a sampling that
        draws points, its range ``"0.5mm:1.5mm"``, or ``"1kohm:1Mohm:log"``.
    sampling
        ``"grid"`` (every combination, the first key fastest), ``"list"`` (side by side), or drawn: ``"random"``, ``"latin-hypercube"``,
        ``"sobol"``.
    points, seed
        Number of drawn points, and their seed.
    quantity
        ``"run"``, ``"modes"``, ``"frf"``, ``"basins"``, ``"ensemble"``, ``"noise"``, or a dict of ``command`` and its options, as
        ``"sweep"``, ``"diagram"``, ``"branch"`` and ``"jumps"`` need:
        ``{"command": "sweep", "over": "drive.shaker.frequency=10Hz:14Hz:0.1Hz"}``.
    points_per_part
        Number of points of a part, which one process computes and writes in one file.

    :meth:`Study.to_toml` returns the equivalent file for the command line.
    """

    def __init__(
        self,
        spec: Spec,
        vary: Mapping[str, Any],
        *,
        sampling: Literal["grid", "list", "random", "latin-hypercube", "sobol"] = "grid",
        points: int | None = None,
        seed: int | None = None,
        quantity: str | Mapping[str, Any] = "run",
        points_per_part: int | None = None,
    ) -> None:
        if not isinstance(spec, Spec):
            raise ArgumentError(f"spec is of type {type(spec).__name__}; give a jounce.Spec")
        if not isinstance(vary, Mapping):
            raise ArgumentError(f'vary is of type {type(vary).__name__}; give a dict, {{"stop.tip.gap": "0.5mm:1.5mm:20x"}}')
        options = {"sampling": sampling, "points": points, "seed": seed, "points_per_part": points_per_part}
        tables: dict[str, Any] = {key: value for key, value in options.items() if value is not None}
        tables["vary"] = {key: range_text(value, None, key) for key, value in vary.items()}
        tables["quantity"] = {"command": quantity} if isinstance(quantity, str) else plain(quantity, "quantity")
        self._set(spec.copy(), toml(tables))

    @classmethod
    def read(cls, path: str | PathLike[str]) -> Study:
        """Reads the file of a study, as used by ``jounce study run``; the path of its spec is relative to its folder."""
        file = Path(path)
        try:
            tables = tomllib.loads(file.read_text(encoding="utf-8"))
        except (OSError, UnicodeDecodeError) as error:
            raise FileError(f"the study {path} cannot be read: {error}", {"path": str(path)}) from error
        except tomllib.TOMLDecodeError as error:
            raise SpecError(f"{path}: {error}") from error
        named = tables.pop("spec", None)
        if not isinstance(named, str):
            raise SpecError(f'{path} names no spec; write spec = "harvester.toml"')
        study = cls.__new__(cls)
        study._set(Spec.read(file.parent / named), toml(tables))
        return study

    def _set(self, spec: Spec, text: str) -> None:
        self._spec = spec
        self._text = text
        self._study = _core.Study(spec._spec, text)

    @property
    def spec(self) -> Spec:
        """Copy of the harvester."""
        return self._spec.copy()

    @property
    def sha256(self) -> str:
        """Digest of all inputs of the table."""
        return self._study.hash_hex()

    @property
    def parts(self) -> int:
        """Number of parts."""
        return self._study.parts()

    def __len__(self) -> int:
        return self._study.points()

    def point(self, index: int) -> list[float]:
        """Returns the values of the keys at a point, SI."""
        check_wholes(index=index)
        return self._study.point(index)

    def to_toml(self, spec: str | PathLike[str] | None = None) -> str:
        """Returns the text of the study; for the command line it needs the path of the ``spec``."""
        return self._text if spec is None else f"spec = {json.dumps(fspath(spec))}\n{self._text}"

    def __eq__(self, other: object) -> bool:
        return self.sha256 == other.sha256 if isinstance(other, Study) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.sha256)

    def __reduce__(self) -> tuple[Any, ...]:
        return (_again, (self._spec, self._text))

    def __repr__(self) -> str:
        return f"<jounce.Study of {len(self)} points in {self.parts} parts, {self.sha256[:12]}>"

    def run(
        self,
        out: str | PathLike[str],
        *,
        executor: concurrent.futures.Executor | None = None,
        shard: str = "1/1",
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> StudyResult:
        """Computes the unfinished parts in the folder ``out``, and returns the table.

        Without an ``executor`` all threads of this process are used; with one its workers: a process pool, Dask's
        ``Client.get_executor()``. Parts are written when finished, completely or not at all, so that a stopped or killed call can be
        continued. ``shard="3/8"`` computes every eighth part; the table is written when no part is missing.
        """
        check_wholes(threads=threads)
        if executor is not None and not callable(getattr(executor, "submit", None)):
            kind = type(executor).__name__
            raise ArgumentError(f"executor is of type {kind}; give one of concurrent.futures, or Dask's client.get_executor()")
        folder = fspath(out)
        with told(progress) as tell:
            if executor is None:
                answer, ended = self._study.run(folder, shard, threads, tell)
                if isinstance(ended, KeyboardInterrupt):
                    raise Interrupted(StudyStatus.read(folder)) from None
                if ended is not None:
                    raise ended
                wall_time_s = float(answer["wall_time_s"]) if answer else 0.0
            else:
                wall_time_s = self._spread(folder, executor, shard, tell)
        if StudyStatus.read(folder).missing == 0:
            _core.study_merge(folder)
        return StudyResult(Path(folder), wall_time_s)

    def _spread(self, folder: str, executor: concurrent.futures.Executor, shard: str, tell: Progress | None) -> float:
        """Submits parts to an executor, a few at a time so that a study larger than memory works, and writes the results.

        Returns the integration time of the workers, s.
        """
        index, of = _shard(shard)
        waiting = [part for part in self._study.missing(folder) if part % of == index - 1]
        total = sum(self._study.points_of(part) for part in waiting)
        done, wall_time_s, each_s, begun = 0, 0.0, None, time.monotonic()
        tasks: dict[Any, list[int]] = {}
        try:
            while waiting or tasks:
                # The first tasks have one part each, from which the size of later tasks is computed.
                size = 1 if each_s is None else max(1, math.ceil(TASK_S / max(each_s, 1e-6)))
                most = 2 * _workers(executor) + 2
                while waiting and len(tasks) < most:
                    batch, waiting = waiting[:size], waiting[size:]
                    tasks[executor.submit(_parts, self, batch)] = batch
                for task in concurrent.futures.wait(tasks, return_when=concurrent.futures.FIRST_COMPLETED).done:
                    batch = tasks.pop(task)
                    seconds, found = task.result()
                    each_s = seconds / len(batch)
                    for part, (content, part_s) in zip(batch, found):
                        self._study.keep(folder, part, content)
                        wall_time_s += part_s
                        done += self._study.points_of(part)
                    if tell is not None:
                        tell(done, total, (time.monotonic() - begun) * (total - done) / done)
        except KeyboardInterrupt:
            raise Interrupted(StudyStatus.read(folder)) from None
        finally:
            for task in tasks:
                task.cancel()
        return wall_time_s


def _workers(executor: Any) -> int:
    """Returns the number of workers of an executor, as far as known; it limits the number of waiting tasks."""
    known = getattr(executor, "_max_workers", None)
    if known is None and hasattr(executor, "_client"):
        known = sum(executor._client.nthreads().values())
    return int(known or 8)


def _shard(text: str) -> tuple[int, int]:
    index, slash, of = text.partition("/")
    if slash and index.isdecimal() and of.isdecimal() and 1 <= int(index) <= int(of):
        return int(index), int(of)
    raise ArgumentError(f'"{text}" is not a shard; write I/N with I from 1 to N, as in 3/8')


def _parts(study: Study, parts: Sequence[int]) -> tuple[float, list[tuple[bytes, float]]]:
    """Computes parts in any process; returns the elapsed time, and of each part the bytes of its file and the integration time, s."""
    begun = time.monotonic()
    found = []
    for part in parts:
        answer, ended = study._study.part(part)
        if ended is not None:
            raise ended
        assert answer is not None, "a part without an error must have a result"
        found.append((answer["bytes"], answer["wall_time_s"]))
    return time.monotonic() - begun, found


def _again(spec: Spec, text: str) -> Study:
    study = Study.__new__(Study)
    study._set(spec, text)
    return study
