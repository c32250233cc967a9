"""The branch of period-1 orbits over the drive frequency, by jounce and by its peers: runs and results."""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from . import auto
from .build import BUILD, HERE
from .plant import Case, Plant
from .process import Finished, finish

FORCE_N, LOWEST_HZ, HIGHEST_HZ = 50.0, 4.0, 20.0
CHECKS_HZ = (5.1, 10.5)
MESHES = (auto.Mesh("AUTO-07p, 30 intervals", 30, 1e-5, 3), auto.Mesh("AUTO-07p, 100 intervals", 100, 1e-7, 1))
HARMONICS = 10
JOUNCE_METHODS = {"jounce, shooting": "shooting", "jounce, harmonic balance": "harmonic-balance"}


@dataclass
class Found:
    """A branch by one method: labels in order, and at each frequency of CHECKS_HZ its power and largest multiplier."""

    points: int = 0
    labels: list[tuple[str, float, float]] = field(default_factory=list)
    power_w: dict[float, float] = field(default_factory=dict)
    multiplier: dict[float, float] = field(default_factory=dict)
    reached: bool = True
    failed: str | None = None

    def folds(self) -> list[tuple[float, float]]:
        """Returns frequency, Hz, and mean power, W, of each fold."""
        return [(hz, watt) for kind, hz, watt in self.labels if kind == "fold"]


@dataclass(frozen=True)
class Method:
    """One method for the complete branch: `follow` returns its result and the CPU time of its process."""

    name: str
    repeats: int
    follow: Callable[[float], tuple[Found, float]]


def jounce_words(spec: Path, method: str, from_hz: float, to_hz: float) -> list[str]:
    """Returns the arguments of `jounce branch` for the branch across a range, on one core as for its peers."""
    over = f"drive.shaker.frequency={from_hz!r}Hz:{to_hz!r}Hz"
    return ["branch", str(spec), "--over", over, "--longest-period", "1", "--seeds", "0", "--threads", "1", "--method", method, "--json"]


def read_jounce(done: Finished) -> Found:
    """Reads the branch with the most points; other branches, if any, count as not reached."""
    if done.failed:
        return Found(failed=done.failed)
    branches = json.loads(done.stdout)["branches"]
    if not branches:
        return Found(failed="no branch")
    longest = max(branches, key=lambda each: len(each["points"]))
    names = {"period-doubling": "period doubling", "neimark-sacker": "Neimark-Sacker", "branch-point": "branch point"}
    labels = [(names.get(each["kind"], each["kind"]), each["parameter"], each["mean_power_w"]) for each in longest["bifurcations"]]
    return Found(sum(len(each["points"]) for each in branches), labels, reached=len(branches) == 1)


def jounce(program: Path, plant: Plant, name: str, repeats: int, cap_s: float) -> Method:
    """jounce by one of its methods. Results at CHECKS_HZ come from separate runs outside the timed interval."""
    method = JOUNCE_METHODS[name]
    checked: dict[float, tuple[float, float]] = {}

    def check() -> None:
        for hz in CHECKS_HZ:
            done = finish([str(program), *jounce_words(plant.path, method, hz, hz + 0.1)], BUILD, cap_s)
            points = [] if done.failed else [point for branch in json.loads(done.stdout)["branches"] for point in branch["points"]]
            exact = [point for point in points if abs(point["parameter"] - hz) < 1e-6 * hz]
            if exact:
                checked[hz] = (exact[0]["mean_power_w"], exact[0]["floquet_max_abs"])

    def follow(limit_s: float) -> tuple[Found, float]:
        done = finish([str(program), *jounce_words(plant.path, method, LOWEST_HZ, HIGHEST_HZ)], BUILD, limit_s)
        found = read_jounce(done)
        if not checked and not found.failed:
            check()
        found.power_w = {hz: values[0] for hz, values in checked.items()}
        found.multiplier = {hz: values[1] for hz, values in checked.items()}
        return found, done.cpu_s

    return Method(name, repeats, follow)


def auto_07p(program: Path, plant: Plant, mesh: auto.Mesh) -> Method:
    """AUTO-07p downwards from the linear response at the upper end, in an empty folder; the time includes reading and writing."""

    def follow(limit_s: float) -> tuple[Found, float]:
        with tempfile.TemporaryDirectory(dir=BUILD) as name:
            folder = Path(name)
            (folder / "plant.txt").write_text(plant.parameters(Case(FORCE_N, HIGHEST_HZ)))
            (folder / "fort.2").write_text(auto.constants(plant.modes, mesh, HIGHEST_HZ, LOWEST_HZ, CHECKS_HZ))
            done = finish([str(program)], folder, limit_s)
            if done.failed:
                return Found(failed=done.failed), done.cpu_s
            found = read_auto((folder / "fort.7").read_text(), (folder / "fort.9").read_text())
            for file in ("fort.7", "fort.9"):
                shutil.copy(folder / file, BUILD / f"auto-{mesh.intervals}.{file}")
        return found, done.cpu_s

    return Method(mesh.name, mesh.repeats, follow)


def read_auto(diagram: str, log: str) -> Found:
    """Reads AUTO's files."""
    rows = auto.rows(diagram)
    labels = [(auto.KINDS[row.kind], row.frequency_hz, row.mean_power_w) for row in rows if row.kind in auto.KINDS]
    exact = [row for row in rows if row.kind == auto.AT_A_GIVEN_FREQUENCY]
    power_w = {hz: row.mean_power_w for hz in CHECKS_HZ for row in exact if abs(row.frequency_hz - hz) < 1e-6 * hz}
    reached = bool(rows) and abs(rows[-1].frequency_hz - LOWEST_HZ) < 1e-3
    return Found(len(rows), labels, power_w, auto.largest_multipliers(log, CHECKS_HZ), reached)


def numpy_balance(python: str, plant: Plant, repeats: int) -> Method:
    """The NumPy peer; its time covers only the continuation, which favours it by the start time of Python."""

    def follow(limit_s: float) -> tuple[Found, float]:
        file = BUILD / f"{plant.path.stem}-orbits.txt"
        file.write_text(plant.parameters(Case(FORCE_N, HIGHEST_HZ)))
        script = str(HERE / "peers" / "harmonic_balance.py")
        done = finish([python, script, str(file), str(HARMONICS), repr(LOWEST_HZ), *map(repr, CHECKS_HZ)], BUILD, limit_s)
        said = {"failed": done.failed} if done.failed else json.loads(done.stdout)
        if "failed" in said:
            return Found(failed=said["failed"]), done.cpu_s
        labels = [("fold", hz, watt) for hz, watt in said["folds"]]
        power_w = {float(hz): watt for hz, watt in said["checks_w"].items()}
        return Found(said["points"], labels, power_w, reached=said["end_hz"] <= LOWEST_HZ), said["cpu_s"]

    return Method(f"harmonic balance (NumPy), {HARMONICS} harmonics", repeats, follow)
