"""Time of the marching alone, as jounce states it, for what has no peer: a second stop, noise, a recording."""

from __future__ import annotations

import json
import random
import re
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import Any

from .build import say
from .process import finish
from .report import span

TOLERANCE = ("--tolerance", "1e-8")
FREQUENCIES_HZ = (11, 6)
SECOND_GAPS = {"never reached": "1 m", "struck too": "1 mm"}
NOISE_S = 60
RECORDING_HZ = 3000

SECOND_STOP = """
[stop.other]
at = "harvester.tip"
frame = "ground"
law = "hertz"
gap = "{gap}"
stiffness = "1000 N/m^1.5"
side = "negative"
"""

NOISE = """
[drive.shaker]
at = "harvester.table"
signal = "noise"
psd = "100 N^2/Hz"
low = "2 Hz"
high = "30 Hz"
seed = 1
"""

RECORDING = """
[drive.floor]
kind = "base-acceleration"
signal = "recording"
file = "recording.csv"
scale = 5
"""


@dataclass
class March:
    """Times of marching, s, the steps of the march and the contacts in its averaging window; `failed` says why there are none."""

    task: str
    wall_time_s: list[float] = field(default_factory=list)
    steps: int = 0
    contacts: int = 0
    failed: str | None = None


def without(spec: str, table: str) -> str:
    """The spec without one of its tables."""
    return re.sub(rf"^\[{re.escape(table)}\]\n(?:(?!\[).*\n?)*", "", spec, flags=re.MULTILINE)


def with_drive(spec: str, drive: str, duration_s: int) -> str:
    """The spec with another drive and another duration; everything else stays."""
    run = f'[run]\nstart = "rest"\nduration = "{duration_s} s"\naverage_over = "{duration_s - 10} s"\n'
    return f"{without(without(spec, 'drive.shaker'), 'run')}{drive}\n{run}"


def recording(duration_s: int, rate_hz: int) -> str:
    """Filtered noise as a file of two columns, the same at every call."""
    drawn, value, lines = random.Random(1), 0.0, ["time_s,value"]
    for k in range(duration_s * rate_hz + 1):
        value += 0.02 * (drawn.gauss(0.0, 5.0) - value)
        lines.append(f"{k / rate_hz:.9f},{value:.9e}")
    return "\n".join(lines) + "\n"


def tasks(plant: str, harvester: str) -> list[tuple[str, str, tuple[str, ...]]]:
    """Name, text of the spec and options of every task: of the plant given by modes, and of the paper's harvester on a moving base."""
    found = []
    for hertz in FREQUENCIES_HZ:
        options = (*TOLERANCE, "--set", f"drive.shaker.frequency={hertz} Hz")
        found.append((f"one stop, {hertz} Hz, 20 s", plant, options))
        for kind, gap in SECOND_GAPS.items():
            found.append((f"a second stop that is {kind}, {hertz} Hz, 20 s", plant + SECOND_STOP.format(gap=gap), options))
    found.append((f"noise, one stop, 8 modes, {NOISE_S} s", with_drive(plant, NOISE, NOISE_S), ()))
    found.append((f"recording of {RECORDING_HZ} Hz, one stop, 8 modes, {NOISE_S} s", with_drive(harvester, RECORDING, NOISE_S), ()))
    return found


def marches(binary: Path, plant: Path, spec: Path, repeats: int, cap_s: float) -> list[March]:
    """Every task, interleaved, each in a process of its own on one thread."""
    wanted = tasks(plant.read_text(), spec.read_text())
    found = [March(name) for name, _, _ in wanted]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "recording.csv").write_text(recording(NOISE_S, RECORDING_HZ))
        for place, (_, text, _) in enumerate(wanted):
            (folder / f"{place}.toml").write_text(text)
        for _ in range(repeats):
            for place, (task, _, options) in enumerate(wanted):
                done = finish([str(binary), "run", f"{place}.toml", *options, "--json"], folder, cap_s)
                if done.failed:
                    say(f"failed: {task}: {done.failed}")
                    found[place].failed = done.failed
                    continue
                record(found[place], json.loads(done.stdout))
    return found


def record(march: March, result: dict[str, Any]) -> None:
    """Adds one repetition."""
    march.wall_time_s.append(float(result["integration_wall_time_s"]))
    march.steps = int(result["work"]["flight_steps"] + result["work"]["contact_steps"])
    march.contacts = int(result["contacts"])


def ratio_of_stops(found: list[March]) -> list[str]:
    """What a second stop costs per frequency: in all, and per step."""
    done = {march.task: march for march in found if march.wall_time_s}
    lines = []
    for hertz in FREQUENCIES_HZ:
        one = done.get(f"one stop, {hertz} Hz, 20 s")
        for kind in SECOND_GAPS:
            two = done.get(f"a second stop that is {kind}, {hertz} Hz, 20 s")
            if one and two:
                times = median(two.wall_time_s) / median(one.wall_time_s)
                steps = two.steps / one.steps
                lines.append(f"- At {hertz} Hz a second stop that is {kind} takes {times:.2g} times as long as one stop, in {steps:.2g} times as many steps.")
    return lines


def report(described: list[str], found: list[March]) -> str:
    """The whole file."""
    head = ["# Time integration of jounce alone", "", "Written by `bench/marches.py`; `bench/README.md` explains it.", "", *(f"- {line}" for line in described)]
    rows = ["", "| task | integration ms, median [min .. max] | steps | contacts |", "|---|---|---|---|"]
    for march in found:
        cells = f"{march.failed} | | " if march.failed else f"{span(march.wall_time_s)} | {march.steps} | {march.contacts}"
        rows.append(f"| {march.task} | {cells} |")
    return "\n".join([*head, *rows, "", *ratio_of_stops(found)]) + "\n"
