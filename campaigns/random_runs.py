#!/usr/bin/env python3
"""Draws random harvesters, runs each, and counts the runs that do not end as they should.

Usage: campaigns/random_runs.py [--count 2000] [--first 0] [--seed 26] [--limit 20] [--jobs 1] [--program PATH] [--keep FOLDER]

Each harvester has one or two beams, masses, patches, circuits of every kind, up to four stops of every law with gaps of
both signs and zero and a stiffness from 1e1 to 1e10, gravity or none, and a drive of every kind. It runs for 1.5 s of its own
time. A run must end within 2 s with an energy residual below its tolerance, or be refused with a reason. Prints a table and
the numbers of the others; with `--keep` their specs are written to a folder. The exit code is 1 where there are others.
Needs Python 3.11 or newer.
"""

import argparse
import collections
import concurrent.futures
import json
import random
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from random_spec import spec

ROOT = Path(__file__).resolve().parent.parent

# Wall time above which a run is slow, s.
SLOW_S = 2.0

# Reasons for which a run stops, each with words of its message.
REASONS = {
    "grows without bound": "is no longer finite|diverges|grows",
    "a contact that does not converge": "did not converge",
    "a circuit that changes without end": r"changed \d+ times at one instant",
    "impacts without end": "impacts|Zeno|chatter",
}


def outcome(text, program, limit_s):
    """Returns the class of a run, and what to report of it."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "random.toml"
        path.write_text(text, encoding="utf-8")
        start = time.monotonic()
        try:
            run = subprocess.run([program, "run", path, "--json"], capture_output=True, text=True, timeout=limit_s)
        except subprocess.TimeoutExpired:
            return "does not end", f"after {limit_s:g} s"
        wall_s = time.monotonic() - start
    message = run.stderr.strip()
    if "panicked" in message or run.returncode < 0 or run.returncode == 101:
        return "panics", message
    if run.returncode != 0:
        if re.search(r"line \d+|:\d+:\d+|move together in every mode", message):
            return "refused as a spec", message.split("\n")[0]
        reason = next((name for name, pattern in REASONS.items() if re.search(pattern, message)), "refused otherwise")
        return f"stopped: {reason}", message.split("\n")[0]
    result = json.loads(run.stdout)
    residual = abs(result["energy_residual_relative"])
    if not residual <= result["tolerance"]:
        return "energy residual", f"{residual:.2e}, tolerance {result['tolerance']:g}"
    if wall_s > SLOW_S:
        return "slow", f"{wall_s:.1f} s, {result['work']}"
    return "ends", ""


# Classes of runs that end as they should.
FINE = ("ends", "refused as a spec", "stopped: impacts without end")


def main():
    """Runs the harvesters and prints the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=2000, help="number of harvesters")
    parser.add_argument("--first", type=int, default=0, help="number of the first harvester")
    parser.add_argument("--seed", type=int, default=26, help="seed of all harvesters")
    parser.add_argument("--limit", type=float, default=20.0, help="wall time after which a run is stopped, s")
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
