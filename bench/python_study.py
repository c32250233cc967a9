"""Measures a study of many short runs over gap, frequency and load: its time relative to its integrations, its memory, and the loss by
kills. Writes STUDIES.md.

`python bench/python_study.py --help` lists the options. Needs the package with its extra `dask`. Other load on the machine changes all
figures. The table must have the same bits on threads, after the kills and through Dask; otherwise the program ends with an error. Only a
full run writes STUDIES.md.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import pickle
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any, NamedTuple

import jounce
import numpy as np

from harness import build, machine

HERE = Path(__file__).resolve().parent
SPEC = HERE.parent / "examples" / "impact-harvester-2019" / "harvester.toml"
KEYS = ("stop.tip.gap", "drive.shaker.frequency", "circuit.load.resistance")
KILLS = 5

#: Number of points of a full run.
FULL = 100_000

#: Largest allowed overhead of the study over its integrations, and of Dask over the study.
WANTED_STUDY, WANTED_DASK = 0.10, 0.15

#: Runs a study in its own process and prints its wall time, the integration time of all threads, s, and its peak memory, bytes.
CHILD = """
import pickle, resource, sys, time
study, out, threads = pickle.loads(sys.stdin.buffer.read())
begin = time.perf_counter()
result = study.run(out, threads=threads)
print(time.perf_counter() - begin, result.wall_time_s, 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


class Taken(NamedTuple):
    """Cost of a study: wall time and the integration time of all threads, s, and the peak memory of a process, bytes."""

    wall_s: float
    wall_time_s: float
    peak_bytes: int

    def beside_marches(self, threads: int) -> float:
        """Returns the wall time relative to the integration time per thread, minus 1."""
        return self.wall_s * threads / self.wall_time_s - 1.0


def options() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=FULL, help="about how many runs the study has; with fewer STUDIES.md stays")
    parser.add_argument("--duration", default="20 s", help="length of a run, that of the paper; power is averaged over its second half")
    parser.add_argument("--threads", type=int, default=2, help="threads of the study, and workers of Dask")
    parser.add_argument("--seed", type=int, default=1, help="of the times of the kills")
    parser.add_argument("--without-kills", action="store_true", help="leave out the kills")
    parser.add_argument("--without-dask", action="store_true", help="leave out Dask")
    return parser.parse_args()


def study_of(points: int, duration: str) -> jounce.Study:
    """Returns a study of gap times frequency times load, with about so many points."""
    side = max(2, round(points ** (1.0 / 3.0)))
    load = max(2, round(points / side**2))
    half = 0.5 * jounce.read(SPEC).changed({"run.duration": duration, "run.average_over": "1 ms"}).si("run.duration")
    spec = jounce.read(SPEC).changed({"run.duration": duration, "run.average_over": f"{half!r} s"})
    ranges = (f"0.5mm:1.5mm:{side}x", f"11Hz:13Hz:{side}x", f"100kohm:1Mohm:{load}log")
    return jounce.Study(spec, dict(zip(KEYS, ranges, strict=True)))


def started(study: jounce.Study, folder: Path, threads: int) -> subprocess.Popen[bytes]:
    """Starts a process that computes the study."""
    child = subprocess.Popen([sys.executable, "-c", CHILD], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert child.stdin is not None
    child.stdin.write(pickle.dumps((study, str(folder), threads)))
    child.stdin.close()
    return child


def finished(child: subprocess.Popen[bytes]) -> Taken:
    """Returns the cost of a process that ends normally."""
    assert child.stdout is not None
    said = child.stdout.read().split()
    if child.wait() != 0:
        sys.exit("the study broke off")
    return Taken(float(said[0]), float(said[1]), int(said[2]))


def digest(folder: Path) -> str:
    """Returns the SHA-256 of the table."""
    with open(jounce.StudyResult(folder).path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def killed(study: jounce.Study, folder: Path, threads: int, expected_s: float, seed: int) -> dict[str, Any]:
    """Runs the study with kills at random times spread over its length; it is resumed each time, and finished."""
    pauses_s = np.random.default_rng(seed).uniform(0.3, 1.0, KILLS) * expected_s / (KILLS + 1)
    parts = []
    for pause_s in pauses_s:
        child = started(study, folder, threads)
        time.sleep(pause_s)
        child.kill()
        if child.wait() != -signal.SIGKILL:
            build.say("a kill came after the end: give more points")
        parts.append(jounce.StudyStatus.read(folder).finished if (folder / "study.json").exists() else 0)
        if parts != sorted(parts):
            sys.exit("finished parts were lost")
    finished(started(study, folder, threads))
    return {"killed_after_s": pauses_s.tolist(), "parts_after_each_kill": parts, "parts": study.parts}


def through_dask(study: jounce.Study, folder: Path, workers: int) -> Taken:
    """Runs the study on a started cluster that has imported the package; its memory is the largest of this process and of a worker."""
    from distributed import Client, LocalCluster

    def peak_bytes() -> int:
        return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    cluster = {"n_workers": workers, "threads_per_worker": 1, "processes": True, "dashboard_address": ":0"}
    with LocalCluster(**cluster) as stands, Client(stands) as client:
        client.run(lambda: __import__("jounce").__version__)
        begin = time.perf_counter()
        result = study.run(folder, executor=client.get_executor())
        wall_s = time.perf_counter() - begin
        return Taken(wall_s, result.wall_time_s, max(peak_bytes(), *client.run(peak_bytes).values()))


def measured(chosen: argparse.Namespace, folder: Path) -> dict[str, Any]:
    """Measures every figure."""
    study, small = study_of(chosen.points, chosen.duration), study_of(max(1, chosen.points // 10), chosen.duration)
    build.say(f"{len(small)} points, then {len(study)} in {study.parts} parts")
    tenth = finished(started(small, folder / "small", chosen.threads))
    whole = finished(started(study, folder / "whole", chosen.threads))
    table = digest(folder / "whole")
    found = {"threads": chosen.threads, "duration": chosen.duration, "points": [len(small), len(study)], "tenth": tenth, "whole": whole}
    found["table_sha256"] = table
    if not chosen.without_kills:
        build.say(f"the same, killed {KILLS} times, about {whole.wall_s:.0f} s")
        found["killed"] = killed(study, folder / "killed", chosen.threads, whole.wall_s, chosen.seed)
        found["killed"]["same_table"] = digest(folder / "killed") == table
    if not chosen.without_dask:
        build.say(f"the same through Dask, about {whole.wall_s:.0f} s")
        found["dask"] = through_dask(study, folder / "dask", chosen.threads)
        found["dask_same_table"] = digest(folder / "dask") == table
    return found


def report(described: list[str], found: dict[str, Any]) -> str:
    """Returns the text of the report."""
    threads, whole = found["threads"], found["whole"]
    rows = {
        f"{found['points'][0]} points": found["tenth"],
        f"{found['points'][1]} points": whole,
        **({f"{found['points'][1]} points through Dask": found["dask"]} if "dask" in found else {}),
    }
    lines = [
        "# Studies",
        "",
        "Written by `bench/python_study.py`; `bench/README.md` explains it.",
        "",
        *(f"- {line}" for line in described),
    ]
    lines += [
        f"- Runs of {found['duration']} over gap, frequency and load.",
        "",
        f"| study | wall s | integration over {threads} threads s | overhead | peak memory MiB |",
    ]
    lines.append("|---|---|---|---|---|")
    for name, taken in rows.items():
        share, size = 100 * taken.beside_marches(threads), taken.peak_bytes / 2**20
        lines.append(f"| {name} | {taken.wall_s:.2f} | {taken.wall_time_s / threads:.2f} | {share:+.1f} % | {size:.0f} |")
    lines += ["", f"- Target: overhead below {100 * WANTED_STUDY:+.0f} %, and memory independent of the number of points."]
    if "dask" in found:
        over, same = 100 * (found["dask"].wall_s / whole.wall_s - 1.0), "the same table" if found["dask_same_table"] else "ANOTHER table"
        lines.append(f"- Dask relative to the study on threads: {over:+.1f} %, target below {100 * WANTED_DASK:+.0f} %; {same}.")
    if "killed" in found:
        parts, same = found["killed"]["parts_after_each_kill"], "the same table" if found["killed"]["same_table"] else "ANOTHER table"
        lines.append(
            f"- Killed {KILLS} times by SIGKILL, with {parts} of {found['killed']['parts']} parts complete, and resumed: {same}, bit by bit."
        )
    return "\n".join(lines) + "\n"


def main() -> None:
    """Measures and writes."""
    chosen = options()
    described = [
        f"CPU: {machine.processor()}, {os.cpu_count()} cores; load average at the start {os.getloadavg()[0]:.1f}",
        f"jounce {jounce.__version__}, Python {sys.version.split()[0]}, {chosen.threads} threads; Dask with as many running workers",
    ]
    with tempfile.TemporaryDirectory() as folder:
        found = measured(chosen, Path(folder))
    results = HERE / "results"
    results.mkdir(exist_ok=True)
    text = report(described, found)
    (results / time.strftime("python-study-%Y-%m-%dT%H-%M-%S.json")).write_text(json.dumps({"machine": described, **found}, indent=1))
    if chosen.points >= FULL and {"killed", "dask"} <= found.keys():
        (HERE / "STUDIES.md").write_text(text)
    print(text)
    if not (found.get("killed", {"same_table": True})["same_table"] and found.get("dask_same_table", True)):
        sys.exit("the tables are not the same")


if __name__ == "__main__":
    main()
