"""Runs every peer at every setting, interleaved in a shuffled order, so that noise of the machine affects all equally."""

from __future__ import annotations

import json
import random
import time
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import Any

from .build import BUILD, say
from .peers import Peer
from .plant import Case, Plant
from .process import finish


@dataclass
class Result:
    """All repetitions of one peer at one setting on one case; `failed` is the reason of a failure."""

    plant: str
    case: str
    peer: str
    setting: float
    setting_name: str
    mean_power_w: float | None = None
    cpu_s: list[float] = field(default_factory=list)
    evaluations: float | None = None
    failed: str | None = None
    error: float | None = None

    @property
    def median_s(self) -> float:
        """Returns the median CPU time, s."""
        return median(self.cpu_s)


def outcome(command: list[str], cap_s: float) -> dict[str, Any]:
    """Returns the JSON that one process prints, or the reason of a failure; the process is stopped after `cap_s` of CPU time."""
    done = finish(command, BUILD, cap_s)
    if done.failed:
        return {"failed": done.failed}
    start = done.stdout.find("{")
    if start < 0:
        return {"failed": "no output"}
    try:
        found: dict[str, Any] = json.loads(done.stdout[start:])
    except json.JSONDecodeError:
        return {"failed": f"output is no JSON: {done.stdout[:80]!r}"}
    return found


def record(result: Result, found: dict[str, Any]) -> None:
    """Adds one repetition."""
    if "failed" in found:
        result.failed = str(found["failed"])
        return
    result.mean_power_w = float(found["mean_power_w"])
    result.cpu_s.append(float(found["cpu_s"]))
    if "evaluations" in found:
        result.evaluations = float(found["evaluations"])


def parameter_file(plant: Plant, case: Case) -> Path:
    """Writes the numbers of a case for the peers."""
    path = BUILD / f"{plant.path.stem}-{case.slug}.txt"
    path.write_text(plant.parameters(case))
    return path


def run_all(plant: Plant, cases: list[Case], peers: list[Peer], cap_s: float) -> list[Result]:
    """Returns all results, in the order of cases, peers, settings. A peer over the cap skips its tighter settings on that case."""
    pairs = [(case, peer) for case in cases for peer in peers if cases.index(case) < peer.cases]
    results = {
        (case, peer.name, setting): Result(plant.path.stem, case.title, peer.name, setting, peer.setting_name)
        for case, peer in pairs
        for setting in peer.settings
    }
    files = {case: parameter_file(plant, case) for case in cases}
    shuffled, began, over = random.Random(1), time.monotonic(), set()
    for repetition in range(max(peer.repeats for peer in peers)):
        ladders = [(case, peer) for case, peer in pairs if peer.repeats > repetition]
        jobs = [(shuffled.random(), case, peer, setting) for case, peer in ladders for setting in peer.settings]
        for done, (_, case, peer, setting) in enumerate(in_turn(jobs)):
            result = results[case, peer.name, setting]
            if (case, peer.name) in over and not result.cpu_s:
                result.failed = "left out: a looser setting ran over the cap"
            if result.failed is None:
                record(result, outcome(peer.command(files[case], case, setting), cap_s))
                if (result.failed or "").startswith("over"):
                    over.add((case, peer.name))
            if done % 50 == 0:
                say(f"{plant.path.stem}: repetition {repetition + 1}, run {done + 1} of {len(jobs)}, {time.monotonic() - began:.0f} s")
    return list(results.values())


def in_turn(jobs: list[tuple[float, Case, Peer, float]]) -> list[tuple[float, Case, Peer, float]]:
    """Returns the jobs shuffled, but with each ladder from loose to tight, so that a cap skips all slower settings."""
    slots = sorted(jobs, key=lambda job: job[0])
    waiting: dict[tuple[Case, str], list[tuple[float, Case, Peer, float]]] = {}
    for job in jobs:
        waiting.setdefault((job[1], job[2].name), []).append(job)
    return [waiting[slot[1], slot[2].name].pop(0) for slot in slots]
