"""Studies: one quantity at many points over the keys of a spec, in parts, on any number of processes."""

from __future__ import annotations

import json
import math
import time
import warnings
from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from . import _core
from ._arguments import check_integers, options, without_places
from ._errors import ArgumentError, FileError, Interrupted, PointsWithoutResult, SpecError
from ._format import counted
from ._progress import Progress, progress_callback
from ._quantity import plain, toml
from ._ranges import check_units, naming_unit
from ._ranges import values as range_text
from ._spec import Spec
from ._study_result import StudyResult, StudyStatus

if TYPE_CHECKING:
    from concurrent.futures import Executor

#: Target duration of a task for an executor, s: long relative to its overhead.
TASK_S = 1.0

#: Times that an executor may lose a task with the same first part before the study ends with its error.
MAX_LOSSES = 3


class Study:
    """A spec, the keys to vary, and the quantity to compute at each point.

    Parameters
    ----------
    spec
        Harvester.
    vary
        Values of each key, ``{"stop.tip.gap": "0.5mm:1.5mm:20x", "circuit.load.resistance": ["1 kohm", "1 Mohm"]}``; with a sampling that
        draws points, its range ``"0.5mm:1.5mm"``, or ``"1kohm:1Mohm:log"``. Ranges are as in :meth:`Spec.sweep`.
    units
        Unit of each key whose values are numbers without one, ``{"stop.tip.gap": "mm"}``.
    sampling
        ``"grid"`` (every combination, the first key fastest), ``"list"`` (side by side), or drawn: ``"random"``, ``"latin-hypercube"``,
        ``"sobol"``.
    points, seed
        Number of drawn points, and their seed.
    quantity
        ``"run"``, ``"modes"``, ``"frf"``, ``"basins"``, ``"ensemble"``, ``"noise"``, or a dict of ``command`` and its options, as
        ``"sweep"``, ``"diagram"``, ``"branch"`` and ``"bifurcations"`` need:
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
        units: Mapping[str, Any] | None = None,
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
        keys = {"sampling": sampling, "points": points, "seed": seed, "points_per_part": points_per_part}
        tables: dict[str, Any] = {key: value for key, value in keys.items() if value is not None}
        check_units(units, vary, "key")
        tables["vary"] = {key: range_text(value, (units or {}).get(key), key) for key, value in vary.items()}
        tables["quantity"] = {"command": quantity} if isinstance(quantity, str) else plain(quantity, "quantity")
        with naming_unit('units={"KEY": "{}"}'), without_places():
            self._set(spec.copy(), toml(tables))

    @classmethod
    def read(cls, path: str | PathLike[str]) -> Study:
        """Reads the file of a study, as used by ``jounce study run``; the path of its spec is relative to its folder."""
        import tomllib

        file = Path(path)
        try:
            tables = tomllib.loads(file.read_text(encoding="utf-8"))
        except (OSError, UnicodeDecodeError) as error:
            raise FileError(f"the study {path} cannot be read: {error}", {"path": str(path)}) from error
        except tomllib.TOMLDecodeError as error:
            raise SpecError(f"{path}: {error}") from error
        spec_path = tables.pop("spec", None)
        if not isinstance(spec_path, str):
            raise SpecError(f'{path} names no spec; write spec = "harvester.toml"')
        study = cls.__new__(cls)
        study._set(Spec.read(file.parent / spec_path), toml(tables))
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
        check_integers(index=index)
        return self._study.point(index)

    def to_toml(self, spec: str | PathLike[str] | None = None) -> str:
        """Returns the text of the study; for the command line it needs the path of the ``spec``."""
        return self._text if spec is None else f"spec = {json.dumps(fspath(spec))}\n{self._text}"

    def __eq__(self, other: object) -> bool:
        return self.sha256 == other.sha256 if isinstance(other, Study) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.sha256)

    def __reduce__(self) -> tuple[Any, ...]:
        return (_rebuild, (self._spec, self._text))

    def __repr__(self) -> str:
        return f"<jounce.Study of {counted(len(self), 'point')} in {counted(self.parts, 'part')}, {self.sha256[:12]}>"

    def run(
        self,
        out: str | PathLike[str],
        *,
        executor: Executor | None = None,
        shard: str = "1/1",
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> StudyResult:
        """Computes the unfinished parts in the folder ``out``, and returns the table.

        Without an ``executor`` all threads of this process are used; with one its workers: a process pool, Dask's
        ``Client.get_executor()``. Parts are written when finished, completely or not at all, so that a stopped or killed call can be
        continued. A task that the executor loses, with a worker for example, is submitted again. ``shard="3/8"`` computes every eighth
        part; the table is written when no part is missing. Points without a result issue :class:`jounce.PointsWithoutResult`.
        """
        check_integers(threads=threads)
        if executor is not None and not callable(getattr(executor, "submit", None)):
            kind = type(executor).__name__
            raise ArgumentError(f"executor is of type {kind}; give one of concurrent.futures, or Dask's client.get_executor()")
        folder, given = fspath(out), options(shard=shard, threads=threads)
        with progress_callback(progress) as callback:
            if executor is None:
                result, error = self._study.run(folder, given, callback)
                if isinstance(error, KeyboardInterrupt):
                    raise Interrupted(StudyStatus.read(folder)) from None
                if error is not None:
                    raise error
                wall_time_s = float(result["wall_time_s"]) if result else 0.0
            else:
                wall_time_s = self._run_on_executor(folder, executor, given, callback)
        for warning in StudyStatus.read(folder).warnings:
            warnings.warn(warning, PointsWithoutResult, stacklevel=2)
        return StudyResult(Path(folder), wall_time_s)

    def _run_on_executor(self, folder: str, executor: Executor, given: str, callback: Progress | None) -> float:
        """Submits parts to an executor, a few at a time so that a study larger than memory works, and writes the results.

        Returns the integration time of the workers, s.
        """
        from concurrent.futures import FIRST_COMPLETED, wait

        pending = self._study.missing(folder, given)
        total = sum(self._study.points_of(part) for part in pending)
        done_points, wall_time_s, part_time_s, start_time = 0, 0.0, None, time.monotonic()
        tasks: dict[Any, list[int]] = {}
        losses: dict[int, int] = {}
        try:
            while pending or tasks:
                # The first tasks have one part each, from which the size of later tasks is computed.
                size = 1 if part_time_s is None else max(1, math.ceil(TASK_S / max(part_time_s, 1e-6)))
                max_tasks = 2 * _workers(executor) + 2
                while pending and len(tasks) < max_tasks:
                    batch, pending = pending[:size], pending[size:]
                    tasks[executor.submit(_compute_parts, self, batch)] = batch
                for task in wait(tasks, return_when=FIRST_COMPLETED).done:
                    batch = tasks.pop(task)
                    try:
                        elapsed_s, results, error = task.result()
                    except Exception:
                        # The executor lost the task, for example with its worker: any worker computes the same bytes.
                        losses[batch[0]] = losses.get(batch[0], 0) + 1
                        if losses[batch[0]] == MAX_LOSSES:
                            raise
                        pending = batch + pending
                        continue
                    if error is not None:
                        raise error
                    part_time_s = elapsed_s / len(batch)
                    for part, (content, part_s) in zip(batch, results):
                        self._study.keep(folder, part, content)
                        wall_time_s += part_s
                        done_points += self._study.points_of(part)
                    if callback is not None:
                        callback(done_points, total, (time.monotonic() - start_time) * (total - done_points) / done_points)
        except KeyboardInterrupt:
            raise Interrupted(StudyStatus.read(folder)) from None
        finally:
            for task in tasks:
                task.cancel()
        if StudyStatus.read(folder).missing == 0:
            _core.study_merge(folder)
        return wall_time_s


def _workers(executor: Any) -> int:
    """Returns the number of workers of an executor, as far as known; it limits the number of waiting tasks."""
    workers = getattr(executor, "_max_workers", None)
    if workers is None and hasattr(executor, "_client"):
        workers = sum(executor._client.nthreads().values())
    return int(workers or 8)


def _compute_parts(study: Study, parts: Sequence[int]) -> tuple[float, list[tuple[bytes, float]], BaseException | None]:
    """Computes parts in any process.

    Returns the elapsed time, of each part the bytes of its file and the integration time, s, and the error that ended the computation: as a
    value, so that an exception of the task is one of the executor.
    """
    start_time = time.monotonic()
    results: list[tuple[bytes, float]] = []
    for part in parts:
        result, error = study._study.part(part)
        if error is not None:
            return time.monotonic() - start_time, results, error
        assert result is not None, "a part without an error must have a result"
        results.append((result["bytes"], result["wall_time_s"]))
    return time.monotonic() - start_time, results, None


def _rebuild(spec: Spec, text: str) -> Study:
    study = Study.__new__(Study)
    study._set(spec, text)
    return study
