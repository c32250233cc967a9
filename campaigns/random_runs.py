#!/usr/bin/env python3
"""Draws random harvesters, runs each, and counts the runs that do not end as they should.

Usage: campaigns/random_runs.py [--count 2000] [--first 0] [--seed 26] [--limit 20] [--jobs 1] [--program PATH] [--keep FOLDER]

Each harvester has one or two beams, masses, patches, circuits of every kind, up to four stops of every law with gaps of
both signs and zero and a stiffness from 1e1 to 1e10, gravity or none, and a drive of every kind. It runs for 1.5 s of its own
time. A run must end within 2 s of processor time with an energy residual below its tolerance, or be refused with a reason.
Prints a table and the numbers of the others; with `--keep` their specs are written to a folder. The exit code is 1 where there
are others. Needs Python 3.11 or newer on Linux.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from random_spec import spec

ROOT = Path(__file__).resolve().parent.parent

# Processor time above which a run is slow, s.
SLOW_S = 2.0

# Reasons for which a run stops, each with words of its message.
REASONS = {
    "grows without bound": "is no longer finite|diverges|grows",
    "a contact that does not converge": "did not converge",
    "a circuit that changes without end": r"changed \d+ times at one instant",
    "impacts without end": "impacts|Zeno|chatter",
}


def run(text, program, limit_s):
    """Runs a spec; returns the exit code, the processor time in s, the output and the messages."""
    with tempfile.TemporaryDirectory() as folder:
        path, output, messages = (Path(folder) / name for name in ("random.toml", "output", "messages"))
        path.write_text(text, encoding="utf-8")
        command = ["bash", "-c", 'ulimit -S -t "$0"; exec "$@"', str(limit_s), program, "run", path, "--json"]
        with output.open("w") as to, messages.open("w") as to_messages:
            process = subprocess.Popen(command, stdout=to, stderr=to_messages)
            _, status, usage = os.wait4(process.pid, 0)
        # `Popen` would wait again for a process without an exit code.
        process.returncode = os.waitstatus_to_exitcode(status)
        return process.returncode, usage.ru_utime + usage.ru_stime, output.read_text(), messages.read_text().strip()


def outcome(text, program, limit_s):
    """Returns the class of a run, and what to report of it."""
    code, processor_s, output, message = run(text, program, limit_s)
    if code == -signal.SIGXCPU:
        return "does not end", f"after {limit_s} s"
    if "panicked" in message or code < 0 or code == 101:
        return "panics", message
    if code != 0:
        if re.search(r"line \d+|:\d+:\d+|move together in every mode", message):
            return "refused as a spec", message.split("\n")[0]
        reason = next((name for name, pattern in REASONS.items() if re.search(pattern, message)), "refused otherwise")
        return f"stopped: {reason}", message.split("\n")[0]
    result = json.loads(output)
    residual = abs(result["energy_residual_relative"])
    if not residual <= result["tolerance"]:
        return "energy residual", f"{residual:.2e}, tolerance {result['tolerance']:g}"
    if processor_s > SLOW_S:
        return "slow", f"{processor_s:.1f} s, {result['work']}"
    return "ends", ""


# Classes of runs that end as they should.
FINE = ("ends", "refused as a spec", "stopped: impacts without end")


def main():
    """Runs the harvesters and prints the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=2000, help="number of harvesters")
    parser.add_argument("--first", type=int, default=0, help="number of the first harvester")
    parser.add_argument("--seed", type=int, default=26, help="seed of all harvesters")
    parser.add_argument("--limit", type=int, default=20, help="processor time after which a run is stopped, s")
    parser.add_argument("--jobs", type=int, default=1, help="runs at the same time")
    parser.add_argument("--program", default=str(ROOT / "target/release/jounce"), help="the program")
    parser.add_argument("--keep", type=Path, help="folder for the specs of runs that do not end as they should")
    options = parser.parse_args()

    def trial(number):
        text = spec(random.Random(f"{options.seed}/{number}"))
        return number, text, outcome(text, options.program, options.limit)

    counts, others = collections.Counter(), []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for number, text, (kind, report) in pool.map(trial, range(options.first, options.first + options.count)):
            counts[kind] += 1
            if kind in FINE:
                continue
            others.append(number)
            print(f"{number}: {kind}: {report}", file=sys.stderr)
            if options.keep:
                options.keep.mkdir(parents=True, exist_ok=True)
                (options.keep / f"{number}.toml").write_text(text, encoding="utf-8")
    for kind, count in counts.most_common():
        print(f"{count:6} {kind}")
    sys.exit(1 if others else 0)


if __name__ == "__main__":
    main()
