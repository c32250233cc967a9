#!/usr/bin/env python3
"""Searches a front of designs, and checks each of its points by `jounce basins` and `jounce branch`.

Usage: campaigns/front.py [--seed 1] [--program PATH]

`basins` must give the expected power of a point, and one of the branches of `branch` its half-power bandwidth, within 1e-6.
Prints the number of points, the wall time of the search, and the largest differences. The exit code is 1 where a point
differs. Needs Python 3.11 or newer.
"""

import argparse
import json
import subprocess
import sys
import tomllib
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
PROBLEM = FOLDER / "front.toml"

# Largest relative difference.
ACCURACY = 1e-6


def results(program, *arguments):
    """Returns the JSON object that a command prints."""
    command = [program, *map(str, arguments), "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if not done.stdout.startswith("{") or done.returncode not in (0, 3):
        sys.exit(f"{' '.join(command)}: exit code {done.returncode}: {done.stdout}{done.stderr}")
    return json.loads(done.stdout)


def changes(*tables):
    """Returns the options that set the keys of some tables."""
    return [part for table in tables for key, value in table.items() for part in ("--set", f"{key}={value}")]


def widths(branches):
    """Returns the half-power bandwidth of each branch that has one, and the common one."""
    found = [branches["half_power_bandwidth"], *(branch["half_power_bandwidth"] for branch in branches["branches"])]
    return [each["width"] for each in found if each]


def differences(program, problem, point):
    """Returns the relative differences of power and bandwidth of a point of the front."""
    spec, condition = FOLDER / problem["spec"], problem["conditions"][0]["set"]
    starts = problem["goal"]["starts"]
    power_w, width_hz = point["goals"]["expected-power"], point["goals"]["bandwidth"]
    basins = results(program, "basins", spec, "--starts", starts, *changes(condition, point["set"]))
    frequency_hz = float(condition["drive.shaker.frequency"].split()[0])
    others = {key: value for key, value in condition.items() if key != "drive.shaker.frequency"}
    over = f"drive.shaker.frequency={0.5 * frequency_hz}Hz:{1.5 * frequency_hz}Hz"
    branches = results(program, "branch", spec, "--over", over, *changes(others, point["set"]))
    nearest_hz = min(widths(branches), key=lambda width: abs(width - width_hz), default=0.0)
    return abs(basins["expected_power_w"] / power_w - 1.0), abs(nearest_hz - width_hz) / max(width_hz, 1e-12)


def main():
    """Searches and checks."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1, help="seed of the search")
    parser.add_argument("--program", default=str(FOLDER.parent / "target/release/jounce"), help="the program")
    options = parser.parse_args()
    problem = tomllib.loads(PROBLEM.read_text(encoding="utf-8"))
    design = results(options.program, "design", PROBLEM, "--seed", options.seed)
    front = design["front"]
    print(f"{len(front)} designs after {design['evaluations']} evaluations and {design['wall_time_s']:.1f} s", flush=True)
    worst, others = [0.0, 0.0], 0
    for point in front:
        found = differences(options.program, problem, point)
        worst = [max(pair) for pair in zip(worst, found)]
        if max(found) > ACCURACY:
            others += 1
            print(f"power {found[0]:.1e}, bandwidth {found[1]:.1e}: {point}")
    print(f"largest difference of the power {worst[0]:.1e}, of the bandwidth {worst[1]:.1e}; {others} points differ")
    sys.exit(1 if others else 0)


if __name__ == "__main__":
    main()
