#!/usr/bin/env python3
"""Draws random harvesters with many events, and compares each run with an independent method.

Usage: campaigns/independent_runs.py [--count 1000] [--first 0] [--seed 1] [--program PATH] [--keep FOLDER]

The independent method takes matrices that jounce exports, reads stops, circuits and drives from the spec, and integrates them by
Dormand and Prince's pair. Patch voltages and motions towards the stops are compared 200 times in 0.2 s. Where they differ, both
methods are run again, jounce at a tenth of the accuracy and the other with shorter steps. A run is `equal` within 1e-6 of the largest
value, or within 1e-5 with the shorter steps, and `equal as far as compared` where the independent method ends early, because a point
sticks to a rigid stop or the steps are too many; `sensitive` where jounce itself changes as much; `inaccurate` where the independent
method does; and else `different`. Prints a table and the numbers of those that are not equal or sensitive. The exit code is 1 where there
is a different one.
Needs numpy, scipy and numba, and Python 3.11 or newer.
"""

import argparse
import collections
import random
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import independent_method as method
import numpy as np
from independent_model import number, read_model
from random_events import spec

ROOT = Path(__file__).resolve().parent.parent
LENGTH_S = 0.2
NORMAL, SHORT = (1e-11, 0.3, 400_000), (2e-13, 0.02, 800_000)
SAME, SAME_WITH_SHORT_STEPS = 1e-6, 1e-5
#: Fraction of a difference at which the change of one method explains it.
EXPLAINS = 1 / 30


def jounce(program, folder, tolerance):
    """Times and columns of a run of jounce; raises `CalledProcessError` where it has none."""
    output = folder / f"run-{tolerance}"
    options = ["--tolerance", tolerance, "--record", f"{LENGTH_S} s", "--sample-rate", "1000 Hz", "--out", output]
    subprocess.run([program, "run", folder / "spec.toml", *options], check=True, capture_output=True, text=True, timeout=120)
    with (output / "run.csv").open(encoding="utf-8") as file:
        names = file.readline().strip().split(",")
        values = np.loadtxt(file, delimiter=",", ndmin=2)
    return values[:, 0], {name: column for name, column in zip(names[1:], values.T[1:]) if not name.startswith("contact_force")}


def independent(spec_tables, model, times, accuracy):
    """Columns of the independent method up to the time at which it ends."""
    tolerance, part, most_steps = accuracy
    eq = model.equations
    modes, patches = eq.stiffness.size, eq.capacitance.size
    state = np.zeros(2 * modes + patches + 2 * eq.circuits.shape[0])
    state[modes : 2 * modes] = model.velocity
    state[2 * modes + patches :: 2] = [number(one.get("battery", 0.0)) for _, one in sorted(spec_tables.get("circuit", {}).items())]
    closed = (eq.stops @ state[:modes] > eq.gaps) & (eq.laws != method.RIGID)
    rising = np.array([method.displaced_current(eq, state, circuit) > 0 for circuit in range(eq.circuits.shape[0])], dtype=bool)
    breaks = {time for time, _ in model.impulses} | {time for one in model.recordings for time in one[0]} | set(times)
    longest, sizes, counts = part / np.sqrt(max(eq.stiffness.max(), 1.0)), np.full(state.size, 1e-12), np.zeros(2)
    time, length, rows = 0.0, 1e-7, []
    for until in sorted(one for one in breaks if one <= times[-1]):
        force, slope = forces(model, time, until)
        reason, time, length = method.integrate(
            eq, time, until, state, force, slope, closed, rising, counts, sizes, tolerance, longest, length, most_steps
        )
        if reason != method.DONE:
            break
        for at, change in model.impulses:
            state[modes : 2 * modes] += change if at == until else 0.0
        if until in times:
            rows.append(state.copy())
    states = np.array(rows)
    columns = {f"voltage_of_{name}": states[:, 2 * modes + k] for k, name in enumerate(model.patches)}
    return columns | {f"towards_{name}": states[:, :modes] @ eq.stops[k] for k, name in enumerate(model.stops)}


def forces(model, time, until):
    """Force on the modes from a time to the next break, and its slope."""
    force, slope, middle = model.constant.copy(), np.zeros_like(model.constant), 0.5 * (time + until)
    for times, values, column in model.recordings:
        if times[0] <= middle <= times[-1]:
            k = np.searchsorted(times, middle) - 1
            rate = (values[k + 1] - values[k]) / (times[k + 1] - times[k])
            force += column * (values[k] + rate * (time - times[k]))
            slope += column * rate
    return force, slope


def difference(one, other):
    """Largest difference of common columns, relative to their largest values."""
    worst = 0.0
    for name in one.keys() & other.keys():
        count = min(len(one[name]), len(other[name]))
        a, b = one[name][:count], other[name][:count]
        worst = max(worst, np.abs(a - b).max() / max(np.abs(a).max(), np.abs(b).max(), 1e-12))
    return worst


def equal(columns, times):
    """Class of a harvester for which the methods agree."""
    compared = min(map(len, columns.values()), default=0)
    return "equal" if compared == len(times) else "equal as far as compared"


def outcome(text, program, folder):
    """Class of a harvester, and what to report of it."""
    (folder / "spec.toml").write_text(text, encoding="utf-8")
    try:
        export = [program, "export", folder / "spec.toml", "--matrices", folder / "matrices"]
        subprocess.run(export, check=True, capture_output=True, text=True)
        times, fine = jounce(program, folder, "1e-9")
    except subprocess.CalledProcessError as error:
        return "refused or stopped", error.stderr.strip().split("\n")[-1]
    except subprocess.TimeoutExpired:
        return "does not end", ""
    tables = tomllib.loads(text)
    model = read_model(tables, folder)
    other = independent(tables, model, times, NORMAL)
    apart = difference(fine, other)
    if apart < SAME:
        return equal(other, times), ""
    short = independent(tables, model, times, SHORT)
    apart_short = difference(fine, short)
    if apart_short < SAME_WITH_SHORT_STEPS:
        return equal(short, times), ""
    changes = difference(fine, jounce(program, folder, "1e-8")[1]), difference(other, short)
    report = f"{apart:.1e} apart, {apart_short:.1e} with shorter steps; jounce changes by {changes[0]:.1e}, the other by {changes[1]:.1e}"
    if changes[0] > EXPLAINS * apart_short:
        return "sensitive", report
    return ("inaccurate" if changes[1] > EXPLAINS * apart else "different"), report


def main():
    """Compares the harvesters and prints the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=1000, help="number of harvesters")
    parser.add_argument("--first", type=int, default=0, help="number of the first harvester")
    parser.add_argument("--seed", type=int, default=1, help="seed of all harvesters")
    parser.add_argument("--program", default=str(ROOT / "target/release/jounce"), help="the program")
    parser.add_argument("--keep", type=Path, help="folder for the specs of different runs")
    options = parser.parse_args()
    counts = collections.Counter()
    for trial in range(options.first, options.first + options.count):
        with tempfile.TemporaryDirectory() as name:
            text = spec(random.Random(f"{options.seed}/{trial}"), Path(name))
            kind, report = outcome(text, options.program, Path(name))
        counts[kind] += 1
        if kind not in ("equal", "equal as far as compared", "sensitive"):
            print(f"{trial}: {kind}: {report}", file=sys.stderr)
        if kind == "different" and options.keep:
            options.keep.mkdir(parents=True, exist_ok=True)
            (options.keep / f"{trial}.toml").write_text(text, encoding="utf-8")
    for kind, count in counts.most_common():
        print(f"{count:6} {kind}")
    sys.exit(1 if counts["different"] else 0)


if __name__ == "__main__":
    main()
