#!/usr/bin/env python3
"""Interrupts jounce at random moments and checks that nothing is lost, nothing is computed twice and no file is incomplete.

Usage: campaigns/interrupt.py [--kills 1000] [--seed 1] [--only NAME] [--program PATH] [--mount] [--reproduce]

Each trial runs a command in a new folder, interrupts it up to six times, then lets it end, and compares every file with
those of an uninterrupted run, byte by byte. Interruptions are SIGKILL, SIGTERM and SIGINT; a disk that becomes full (with
`--mount` a small tmpfs, else a limit of the file size); a folder that vanishes: removed, renamed, replaced by a file, made read-only.
Half of them come at a random time, half just after a file has appeared or grown. Prints a table; the exit code is 1 after a
violation. Needs Linux or macOS, and Python 3.11 or newer.
"""

import argparse
import collections
import contextlib
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from scenarios import REPRODUCE, ROOT, SCENARIOS
from trial import BUSY, Trial, Violation

SIGNALS = ("SIGKILL", "SIGTERM", "SIGINT")
PROGRESS = re.compile(r"^continuing after| so far$| left$")
FULL = ("no space left on device", "file too large")


def is_whole(name, content):
    """Whether a file ends as its format does."""
    if name.endswith(".json"):
        json.loads(content)
    ends = {"csv": b"\n", "svg": b"</svg>\n", "png": b"IEND\xaeB`\x82", "pdf": b"%%EOF", "parquet": b"PAR1", "toml": b"\n"}
    return content.endswith(ends.get(name.rpartition(".")[2], b""))


def check_files(trial, reference):
    """Every file that is there has the content that it has at the end, or is that of a stopped command."""
    for name, content in trial.files().items():
        begun = name == "study.json" and json.loads(content)["study_sha256"] == json.loads(reference.files[name])["study_sha256"]
        if content != reference.files.get(name) and not begun and not (trial.may_be_partial and is_whole(name, content)):
            raise Violation(f"{name}, of {len(content)} bytes, is not that of an uninterrupted run")


def check_kept(trial, before, lines, names):
    """Finished work is still there, and was not computed again."""
    after = trial.parts()
    if {path: after.get(path) for path in before} != before:
        raise Violation("a finished part was lost or written again")
    now, is_complete = trial.journal(), set(trial.files()) == set(names)
    if lines and now is not None and now[: len(lines)] != lines and not is_complete:
        raise Violation(f"of {len(lines)} finished points in the journal, {len(now)} others are left")
    if lines and now is None and not is_complete:
        raise Violation("the journal was removed before the result was complete")


def moment(trial, processes, rng, duration_s):
    """Waits for a random moment of the work."""
    if rng.random() < 0.5:
        time.sleep(rng.uniform(0.0, 1.05 * duration_s))
        return
    changes, last = rng.randint(1, 12), trial.size()
    while changes and any(process.poll() is None for process, _ in processes):
        time.sleep(2e-4)
        if (size := trial.size()) != last:
            changes, last = changes - 1, size
    time.sleep(rng.choice([0.0, rng.uniform(0.0, 3e-3)]))


def kill(trial, rng, reference, count):
    """Ends one or all commands by a signal."""
    processes = trial.start()
    moment(trial, processes, rng, reference.duration_s)
    kind = rng.choices([signal.SIGKILL, signal.SIGTERM, signal.SIGINT], [6, 2, 2])[0]
    for process, _ in processes if rng.random() < 0.5 else [rng.choice(processes)]:
        if process.poll() is None:
            count[kind.name] += 1
            process.send_signal(kind)
    trial.finish(processes, {0, -kind, *([130] if kind == signal.SIGINT else [])})
    trial.may_be_partial |= kind == signal.SIGINT and trial.scenario.partial
    check_files(trial, reference)


def check_message(trial, ends, reference, words):
    """An error is one line, and exit code 4."""
    for code, text in ends:
        lines = [line for line in text.splitlines() if line not in reference.lines and not PROGRESS.search(line)]
        if code == 4 and BUSY not in text and not (len(lines) == 1 and any(word in lines[0] for word in words)):
            raise Violation(f"the message is {lines}")
    check_files(trial, reference)


def fill(trial, rng, reference, count):
    """Lets the disk become full."""
    count["full disk"] += 1
    if trial.is_mounted:
        trial.remount(f"size={(trial.used_pages() + rng.randint(1, reference.pages + 4)) * 4}k")
        ends = trial.finish(trial.start(), {0, 4})
        trial.remount("size=256m")
    else:
        largest = max(len(content) for content in reference.files.values())
        ends = trial.finish(trial.start(rng.randint(4096, max(largest, 4096))), {0, 4})
    check_message(trial, ends, reference, FULL)


def vanish(trial, rng, reference, count):
    """Lets the folder of the result, or that of the journals, vanish."""
    count["vanished"] += 1
    how = rng.choice(["remove", "rename", "replace", "cache", *(["read-only"] if trial.is_mounted else [])])
    processes, away = trial.start(), trial.disk / "away"
    moment(trial, processes, rng, reference.duration_s)
    if how == "read-only":
        # A disk with a file open for writing cannot be made read-only.
        count["vanished"] -= not trial.remount("ro")
    elif how == "cache":
        shutil.rmtree(trial.disk / "cache", ignore_errors=True)
    elif trial.out.is_dir():
        trial.out.rename(away)
        if how == "replace":
            trial.out.write_text("a file")
        elif how == "remove":
            shutil.rmtree(away)
    ends = trial.finish(processes, {0, 4})
    if how == "read-only":
        trial.remount("rw")
    if trial.out.is_file():
        trial.out.unlink()
    words = ["cannot write", "cannot read", "cannot be used", "missing", "holds no study", "damaged"]
    check_message(trial, ends, reference, words)
    if away.is_dir():
        shutil.rmtree(trial.out, ignore_errors=True)
        away.rename(trial.out)
        check_files(trial, reference)
    (trial.disk / "cache").mkdir(exist_ok=True)


def run_trial(trial, reference, rng, count, faults):
    """Interrupts a command, then lets it end and compares its result."""
    for _ in range(rng.randint(1, 6)):
        parts, lines, files = trial.parts(), trial.journal(), reference.files
        fault = rng.choices([kill, fill, vanish], faults)[0]
        fault(trial, rng, reference, count)
        is_kept = fault is not vanish
        if is_kept:
            check_kept(trial, parts, lines, files)
    for path in trial.abandoned():
        os.utime(path, (time.time() - 60.0,) * 2)
    parts, lines = trial.parts(), trial.journal()
    ends = trial.complete()
    check_kept(trial, parts, None, reference.files)
    if lines and not any(f"continuing after {len(lines)} " in text for _, text in ends) and "two" not in trial.scenario.name:
        raise Violation(f"{len(lines)} points of the journal were not used: {ends[0][1].strip()[-300:]}")
    if trial.files() != reference.files:
        names = [name for name, content in reference.files.items() if trial.files().get(name) != content]
        raise Violation(f"the result differs from that of an uninterrupted run: {', '.join(names)}")
    if trial.journal() is not None:
        raise Violation("the journal of a complete result remains")
    if trial.abandoned():
        raise Violation(f"abandoned files remain: {', '.join(path.name for path in trial.abandoned())}")


class Reference:
    """The result of an uninterrupted run."""

    def __init__(self, scenario, program, folder):
        with Trial(scenario, program, folder, False) as trial:
            start = time.monotonic()
            ends = trial.complete()
            self.duration_s = time.monotonic() - start
            self.files, self.lines = trial.files(), {line for _, text in ends for line in text.splitlines()}
            self.pages = sum(len(content) // 4096 + 1 for content in self.files.values())


def arguments():
    """The options of the command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--kills", type=int, default=1000, help="number of signals")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", help="text in the name of the scenarios")
    parser.add_argument("--program", type=Path, default=ROOT / "target" / "release" / "jounce")
    parser.add_argument("--mount", action="store_true", help="half of the trials on a small tmpfs, which root can mount")
    parser.add_argument("--reproduce", action="store_true", help="with `jounce reproduce`, which takes longest")
    return parser.parse_args()


def run_trials(options, folder, counts, violations):
    """Runs trials until there are enough signals."""
    rng, references = random.Random(options.seed), {}
    scenarios = [one for one in SCENARIOS + [REPRODUCE] * options.reproduce if not options.only or options.only in one.name]
    program, place = options.program.resolve(), Path(folder) / "trial"
    while sum(count[name] for count in counts.values() for name in SIGNALS) < options.kills:
        scenario, seed = rng.choices(scenarios, [one.weight for one in scenarios])[0], rng.random()
        if scenario.name not in references:
            references[scenario.name] = Reference(scenario, program, place)
        count = counts.setdefault(scenario.name, collections.Counter())
        try:
            with Trial(scenario, program, place, options.mount and seed < 0.5) as trial:
                run_trial(trial, references[scenario.name], random.Random(seed), count, [8, 1, 1])
        except (Violation, OSError, ValueError, KeyError, subprocess.SubprocessError) as violation:
            violations[scenario.name] += 1
            print(f"{scenario.name}: {type(violation).__name__}: {violation}", flush=True)


def main():
    """Runs the campaign, until Ctrl-C if that is earlier, and prints its table."""
    signal.signal(signal.SIGINT, signal.default_int_handler)  # Shells let background jobs ignore it.
    options, counts, violations = arguments(), {}, collections.Counter()
    with tempfile.TemporaryDirectory(prefix="jounce-interrupt-") as folder, contextlib.suppress(KeyboardInterrupt):
        run_trials(options, folder, counts, violations)
    heads = [*SIGNALS, "full disk", "vanished"]
    print(f"{'scenario':22}  " + "  ".join(f"{head:>9}" for head in [*heads, "violation"]))
    for name, count in [*counts.items(), ("all", sum(counts.values(), collections.Counter()))]:
        wrong = violations.total() if name == "all" else violations[name]
        print(f"{name:22}  " + "  ".join(f"{number:>9}" for number in [*(count[head] for head in heads), wrong]))
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
