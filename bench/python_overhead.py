"""Measures what the Python package adds to the library: one run, a study on threads and through Dask, and the memory of a study.

`python bench/python_overhead.py --help` lists the options. Needs the package with its extra `dask`, and cargo; load on the machine falls on
all figures, so leave it alone meanwhile.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from statistics import median
from typing import Any

import jounce
from harness import build, machine, process

HERE = Path(__file__).resolve().parent
SPEC = HERE.parent / "examples" / "impact-harvester-2019" / "harvester.toml"
#: A short run, so that what is not marching weighs much.
SHORT = {"run.duration": "2 s", "run.average_over": "1 s"}
KEYS = ("stop.tip.gap", "drive.shaker.frequency", "circuit.load.resistance")
UNITS = ("m", "Hz", "ohm")

#: Runs a study in a process of its own and prints the most memory that it held, bytes.
CHILD = """
import pickle, resource, sys
study, out, threads = pickle.loads(sys.stdin.buffer.read())
study.run(out, threads=threads)
print(1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


def options() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=101, help="repetitions of the single run")
    parser.add_argument("--side", type=int, default=13, help="values of gap, of frequency and of load: a study has the cube of it")
    parser.add_argument("--threads", type=int, default=2, help="threads of a study, and workers of Dask")
    parser.add_argument("--without-rust", action="store_true", help="leave out the library's own call, which cargo builds")
    return parser.parse_args()


def outside_python_s(repeats: int) -> list[float]:
    """Wall time of `run` on the paper's spec, warm, less the march inside it."""
    spec = jounce.read(SPEC)
    spec.run()
    outside_s = []
    for _ in range(repeats):
        begin = time.perf_counter()
        answer = spec.run()
        outside_s.append(time.perf_counter() - begin - answer.march_s)
    return outside_s


def outside_rust_s(program: Path, repeats: int) -> list[float]:
    """The same of `simulate` in Rust, each in a process that has marched a part of the run before."""
    outside_s = []
    for _ in range(repeats):
        done = process.finish([str(program), str(SPEC), "warm"], HERE, 300.0)
        if done.failed:
            sys.exit(f"peer-jounce failed: {done.failed}")
        found = json.loads(done.stdout)
        outside_s.append(found["wall_s"] - found["march_s"])
    return outside_s


def study_of(side: int) -> jounce.Study:
    """Gap times frequency times load."""
    ranges = (f"0.5mm:1.5mm:{side}x", f"11Hz:13Hz:{side}x", f"100kohm:1Mohm:{side}log")
    return jounce.Study(jounce.read(SPEC).changed(SHORT), dict(zip(KEYS, ranges, strict=True)))


def marches_s(study: jounce.Study, threads: int) -> float:
    """Sum of the march times of all points, with as many at a time as the study has threads."""
    spec = study.spec

    def march_s(index: int) -> float:
        keys = {key: f"{value!r} {unit}" for key, value, unit in zip(KEYS, study.point(index), UNITS, strict=True)}
        return spec.changed(keys).run().march_s

    with ThreadPoolExecutor(threads) as pool:
        return sum(pool.map(march_s, range(len(study))))


def on_threads(study: jounce.Study, threads: int) -> tuple[float, bytes]:
    """Wall time of the study, and its table."""
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        result = study.run(folder, threads=threads)
        return time.perf_counter() - begin, result.path.read_bytes()


def through_dask(study: jounce.Study, workers: int) -> tuple[float, bytes]:
    """Wall time of the study on a cluster that stands and has imported the package, and its table."""
    from distributed import Client, LocalCluster

    cluster = {"n_workers": workers, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
    with LocalCluster(**cluster) as stands, Client(stands) as client, tempfile.TemporaryDirectory() as folder:
        client.run(lambda: __import__("jounce").__version__)
        begin = time.perf_counter()
        result = study.run(folder, executor=client.get_executor())
        return time.perf_counter() - begin, result.path.read_bytes()


def memory_bytes(study: jounce.Study, threads: int) -> int:
    """The most memory that a process held that ran the study."""
    import pickle
    import subprocess

    with tempfile.TemporaryDirectory() as folder:
        given = pickle.dumps((study, folder, threads))
        done = subprocess.run([sys.executable, "-c", CHILD], input=given, capture_output=True, check=True)
    return int(done.stdout)


def run_figures(chosen: argparse.Namespace) -> dict[str, Any]:
    """What a single run costs beside its march."""
    python_s = median(outside_python_s(chosen.repeats))
    found: dict[str, Any] = {"run_outside_march_python_s": python_s}
    program = None if chosen.without_rust else build.compile_jounce()
    if program:
        rust_s = median(outside_rust_s(program, chosen.repeats))
        found |= {"run_outside_march_rust_s": rust_s, "run_overhead_s": python_s - rust_s}
    return found


def study_figures(chosen: argparse.Namespace) -> dict[str, Any]:
    """A study beside its marches, through Dask, and in memory."""
    study, threads = study_of(chosen.side), chosen.threads
    build.say(f"{len(study)} points, their marches")
    ideal_s = marches_s(study, threads) / threads
    build.say("the study on threads")
    threads_s, table = on_threads(study, threads)
    build.say("the study through Dask")
    dask_s, again = through_dask(study, threads)
    build.say("memory")
    small = study_of(max(1, round(chosen.side / 2)))
    return {
        "study_points": len(study),
        "study_threads": threads,
        "marches_over_threads_s": ideal_s,
        "study_s": threads_s,
        "study_over_marches": threads_s / ideal_s - 1.0,
        "dask_s": dask_s,
        "dask_over_marches": dask_s / ideal_s - 1.0,
        "dask_over_study": dask_s / threads_s - 1.0,
        "same_table": table == again,
        "memory_small_points": len(small),
        "memory_small_bytes": memory_bytes(small, threads),
        "memory_bytes": memory_bytes(study, threads),
    }


def told(figures: dict[str, Any]) -> str:
    """The figures for reading."""
    ms, share, mib = (lambda s: f"{1e3 * s:.3f} ms"), (lambda part: f"{100 * part:+.1f} %"), (lambda size: f"{size / 2**20:.0f} MiB")
    lines = [f"run, what is not marching: {ms(figures['run_outside_march_python_s'])} in Python"]
    if "run_overhead_s" in figures:
        lines[0] += f", {ms(figures['run_outside_march_rust_s'])} in Rust; overhead {ms(figures['run_overhead_s'])}"
    size = f"{figures['study_points']} runs of {SHORT['run.duration']} on {figures['study_threads']} threads"
    return "\n".join(
        [
            *figures["machine"],
            *lines,
            f"study, {size}: marches over threads {figures['marches_over_threads_s']:.3f} s, "
            f"study {figures['study_s']:.3f} s ({share(figures['study_over_marches'])})",
            f"through Dask: {figures['dask_s']:.3f} s ({share(figures['dask_over_marches'])} of the marches, "
            f"{share(figures['dask_over_study'])} of the study); {'the same' if figures['same_table'] else 'ANOTHER'} table",
            f"most memory: {mib(figures['memory_small_bytes'])} at {figures['memory_small_points']} points, "
            f"{mib(figures['memory_bytes'])} at {figures['study_points']}",
        ]
    )


def main() -> None:
    """Measures and writes."""
    chosen = options()
    described = [f"CPU: {machine.processor()}", f"jounce {jounce.__version__}, Python {sys.version.split()[0]}"]
    figures = {"machine": described, **run_figures(chosen), **study_figures(chosen)}
    folder = HERE / "results"
    folder.mkdir(exist_ok=True)
    stem = folder / time.strftime("python-%Y-%m-%dT%H-%M-%S")
    stem.with_suffix(".json").write_text(json.dumps(figures, indent=1))
    print(told(figures))


if __name__ == "__main__":
    main()
