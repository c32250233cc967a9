"""Measures a study of many short runs over gap, frequency and load: its time beside that of its marches, its memory, what kills lose.

`python bench/python_study.py --help` lists the options. Needs the package with its extra `dask`; load on the machine falls on all
figures, so leave it alone meanwhile. The table must come out bit by bit the same on threads, after the kills and through Dask: where
it does not, this ends with an error.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import pickle
import resource
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import jounce
import numpy as np

from harness import build, machine

HERE = Path(__file__).resolve().parent
SPEC = HERE.parent / "examples" / "impact-harvester-2019" / "harvester.toml"
KEYS = ("stop.tip.gap", "drive.shaker.frequency", "circuit.load.resistance")
UNITS = ("m", "Hz", "ohm")
KILLS = 5

#: Runs a study in a process of its own and prints how long that took, s, and the most memory that it held, bytes.
CHILD = """
import pickle, resource, sys, time
study, out, threads = pickle.loads(sys.stdin.buffer.read())
begin = time.perf_counter()
study.run(out, threads=threads)
print(time.perf_counter() - begin, 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


def options() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=100_000, help="about how many runs the study has")
    parser.add_argument("--duration", default="2 s", help="length of a run; power is averaged over its second half")
    parser.add_argument("--sample", type=int, default=4000, help="points whose marches are timed alone, drawn at random; 0 for all")
    parser.add_argument("--threads", type=int, default=2, help="threads of the study, and workers of Dask")
    parser.add_argument("--seed", type=int, default=1, help="of the sample and of the times of the kills")
    parser.add_argument("--without-dask", action="store_true", help="leave out Dask")
    return parser.parse_args()


def study_of(points: int, duration: str) -> jounce.Study:
    """Gap times frequency times load, about so many points."""
    side = max(1, round(points ** (1.0 / 3.0)))
    load = max(1, round(points / side**2))
    half = 0.5 * jounce.read(SPEC).changed({"run.duration": duration, "run.average_over": "1 ms"}).si("run.duration")
    spec = jounce.read(SPEC).changed({"run.duration": duration, "run.average_over": f"{half!r} s"})
    ranges = (f"0.5mm:1.5mm:{side}x", f"11Hz:13Hz:{side}x", f"100kohm:1Mohm:{load}log")
    return jounce.Study(spec, dict(zip(KEYS, ranges, strict=True)))


def marches(study: jounce.Study, sample: int, threads: int, seed: int) -> tuple[float, float]:
    """Sum of the march times of all points, s, from those of a sample, as many at a time as the study has threads; its standard error."""
    spec, count = study.spec, len(study)
    chosen = np.arange(count) if not 0 < sample < count else np.random.default_rng(seed).choice(count, sample, replace=False)

    def march_s(index: int) -> float:
        keys = {key: f"{value!r} {unit}" for key, value, unit in zip(KEYS, study.point(index), UNITS, strict=True)}
        return spec.changed(keys).run().march_s

    with ThreadPoolExecutor(threads) as pool:
        times_s = np.array(list(pool.map(march_s, map(int, chosen))))
    left_out = 1.0 - len(chosen) / count
    error_s = 0.0 if len(chosen) < 2 else count * times_s.std(ddof=1) * np.sqrt(left_out / len(chosen))
    return count * float(times_s.mean()), float(error_s)


def started(study: jounce.Study, folder: Path, threads: int) -> subprocess.Popen[bytes]:
    """A process at work on the study."""
    child = subprocess.Popen([sys.executable, "-c", CHILD], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert child.stdin is not None
    child.stdin.write(pickle.dumps((study, str(folder), threads)))
    child.stdin.close()
    return child


def finished(child: subprocess.Popen[bytes]) -> tuple[float, int]:
    """Seconds and bytes of a process that ends by itself."""
    assert child.stdout is not None
    said = child.stdout.read().split()
    if child.wait() != 0:
        sys.exit("the study broke off")
    return float(said[0]), int(said[1])


def digest(folder: Path) -> str:
    """SHA-256 of the table."""
    with open(jounce.StudyResult(folder).path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def killed(study: jounce.Study, folder: Path, threads: int, expected_s: float, seed: int) -> dict[str, Any]:
    """The study killed at random times that are spread over its length, resumed each time, and finished."""
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


def through_dask(study: jounce.Study, folder: Path, workers: int) -> tuple[float, int]:
    """Seconds of the study on a cluster that stands and has imported the package, and the most memory of this process and of a worker."""
    from distributed import Client, LocalCluster

    def peak_bytes() -> int:
        return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    cluster = {"n_workers": workers, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
    with LocalCluster(**cluster) as stands, Client(stands) as client:
        client.run(lambda: __import__("jounce").__version__)
        begin = time.perf_counter()
        study.run(folder, executor=client.get_executor())
        return time.perf_counter() - begin, max(peak_bytes(), *client.run(peak_bytes).values())


def measured(chosen: argparse.Namespace, folder: Path) -> dict[str, Any]:
    """Every figure."""
    study, small = study_of(chosen.points, chosen.duration), study_of(max(1, chosen.points // 10), chosen.duration)
    build.say(f"{len(study)} points in {study.parts} parts; marches of a sample")
    sum_s, error_s = marches(study, chosen.sample, chosen.threads, chosen.seed)
    ideal_s = sum_s / chosen.threads
    build.say(f"the study, about {ideal_s:.0f} s")
    _, small_bytes = finished(started(small, folder / "small", chosen.threads))
    study_s, bytes_held = finished(started(study, folder / "whole", chosen.threads))
    found = {
        "points": len(study),
        "threads": chosen.threads,
        "marches_s": sum_s,
        "marches_standard_error_s": error_s,
        "study_s": study_s,
        "study_over_marches": study_s / ideal_s - 1.0,
        "memory_points": [len(small), len(study)],
        "memory_bytes": [small_bytes, bytes_held],
        "table_sha256": digest(folder / "whole"),
    }
    build.say(f"the same, killed {KILLS} times")
    found["killed"] = killed(study, folder / "killed", chosen.threads, study_s, chosen.seed)
    found["killed"]["same_table"] = digest(folder / "killed") == found["table_sha256"]
    if not chosen.without_dask:
        build.say("the same through Dask")
        dask_s, dask_bytes = through_dask(study, folder / "dask", chosen.threads)
        same = digest(folder / "dask") == found["table_sha256"]
        over = {"over_marches": dask_s / ideal_s - 1.0, "over_study": dask_s / study_s - 1.0}
        found["dask"] = {"study_s": dask_s, **over, "memory_bytes": dask_bytes, "same_table": same}
    return found


def told(found: dict[str, Any]) -> str:
    """The figures for reading."""
    share, mib = (lambda part: f"{100 * part:+.1f} %"), (lambda size: f"{size / 2**20:.0f} MiB")
    ideal_s, error_s = (found[name] / found["threads"] for name in ("marches_s", "marches_standard_error_s"))
    lines = [
        *found["machine"],
        f"{found['points']} runs, marches over {found['threads']} threads: {ideal_s:.2f} s +- {error_s:.2f} s (standard error)",
        f"study: {found['study_s']:.2f} s ({share(found['study_over_marches'])})",
        "most memory: " + ", ".join(f"{mib(b)} at {n} points" for n, b in zip(found["memory_points"], found["memory_bytes"], strict=True)),
        f"killed {KILLS} times, with {found['killed']['parts_after_each_kill']} of {found['killed']['parts']} parts there: "
        + ("the same table" if found["killed"]["same_table"] else "ANOTHER table"),
    ]
    if "dask" in found:
        dask = found["dask"]
        over = f"{share(dask['over_marches'])} of the marches, {share(dask['over_study'])} of the study"
        same = "the same" if dask["same_table"] else "ANOTHER"
        lines.append(f"through Dask: {dask['study_s']:.2f} s ({over}), {mib(dask['memory_bytes'])}; {same} table")
    return "\n".join(lines)


def main() -> None:
    """Measures and writes."""
    chosen = options()
    described = [f"CPU: {machine.processor()}", f"jounce {jounce.__version__}, Python {sys.version.split()[0]}"]
    with tempfile.TemporaryDirectory() as folder:
        found = {"machine": described, **measured(chosen, Path(folder))}
    results = HERE / "results"
    results.mkdir(exist_ok=True)
    (results / time.strftime("python-study-%Y-%m-%dT%H-%M-%S.json")).write_text(json.dumps(found, indent=1))
    print(told(found))
    if not (found["killed"]["same_table"] and found.get("dask", {"same_table": True})["same_table"]):
        sys.exit("the tables are not the same")


if __name__ == "__main__":
    main()
