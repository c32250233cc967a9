"""Runs one process and measures its CPU time (user and system, all its threads) and its wall time from start to exit."""

from __future__ import annotations

import os
import resource
import signal
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS")}


@dataclass(frozen=True)
class Finished:
    """Output and times of a process; `failed` is the reason of a failure."""

    stdout: str
    cpu_s: float
    wall_s: float
    failed: str | None


def finish(command: list[str], folder: Path, cap_s: float, threads: dict[str, str] = ONE_THREAD) -> Finished:
    """Runs a process to its end in a folder, by default on one thread; it is stopped after `cap_s` of CPU time."""

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (round(cap_s), round(cap_s)))

    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        begin = time.perf_counter()
        child = subprocess.Popen(command, stdout=out, stderr=err, cwd=folder, env=os.environ | threads, preexec_fn=limit)
        _, status, usage = os.wait4(child.pid, 0)
        wall_s = time.perf_counter() - begin
        child.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        err.seek(0)
        printed, complaint = out.read(), err.read()
    failed = None
    if child.returncode in (-signal.SIGKILL, -signal.SIGXCPU):
        failed = f"over {cap_s:g} s"
    elif child.returncode:
        failed = (complaint.strip().splitlines() or [f"exit code {child.returncode}"])[-1][:160]
    return Finished(printed, usage.ru_utime + usage.ru_stime, wall_s, failed)
