"""Peers: their command lines, and their settings from loose to tight."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from . import build
from .plant import Case, Plant

# Absolute tolerance over relative tolerance, for every adaptive peer: the ratio of Octave's defaults. Ratios from 1e-6 to 1 move the
# work-precision curve of DOP853 by less than a fifth.
ABSOLUTE_PER_RELATIVE = 1e-3
JOUNCE_STARTS = {"jounce": "warm", "jounce, first run": "first"}


@dataclass(frozen=True)
class Peer:
    """One method; `command(parameter_file, case, setting)` returns its command line."""

    name: str
    settings: tuple[float, ...]
    command: Callable[[Path, Case, float], list[str]]
    repeats: int
    setting_name: str = "tolerance"
    cases: int = 99  # number of cases of a plant, the first ones


def tolerances(first: int, last: int, step: int = 1) -> tuple[float, ...]:
    """Returns powers of ten, from 10^-first to 10^-last."""
    return tuple(float(f"1e-{power}") for power in range(first, last + 1, step))


def adaptive(prefix: list[str]) -> Callable[[Path, Case, float], list[str]]:
    """Returns a command that takes the plant, the relative and the absolute tolerance."""

    def command(plant: Path, _case: Case, tolerance: float) -> list[str]:
        head, *tail = prefix
        return [head, *(str(plant) if word == "PLANT" else word for word in tail), repr(tolerance), repr(tolerance * ABSOLUTE_PER_RELATIVE)]

    return command


def steps_ladder(modes: int) -> tuple[float, ...]:
    """Returns steps per second from just above the stability limit, by factors near the square root of 2; even, so windows are hit."""
    first, count = (2_400, 15) if modes <= 8 else (26_000, 8)
    return tuple(float(2 * round(first * 2 ** (i / 2) / 2)) for i in range(count))


def compiled(modes: int, repeats: int) -> list[Peer]:
    """Returns the C and Rust peers that could be built."""
    peers = []
    if rk4 := build.compile_c("rk4", modes):
        peers.append(Peer("RK4 (C)", steps_ladder(modes), lambda p, _c, s: [str(rk4), str(p), repr(s)], repeats, "steps/s"))
    if dop853 := build.compile_c("dop853", modes):
        peers.append(Peer("DOP853 (C)", tolerances(4, 12), adaptive([str(dop853), "PLANT"]), repeats))
    if rust := build.compile_rust():
        for method, name in {"dop853": "DOP853 (differential-equations)", "tsit45": "TSIT45 (diffsol)"}.items():
            peers.append(Peer(name, tolerances(4, 12), adaptive([str(rust), "PLANT", method]), repeats))
        implicit = {"bdf": "BDF (diffsol)", "tr-bdf2": "TR-BDF2 (diffsol)", "esdirk34": "ESDIRK34 (diffsol)"}
        for method, name in implicit.items() if modes <= 8 else ():
            peers.append(Peer(name, tolerances(4, 8), adaptive([str(rust), "PLANT", method]), min(repeats, 2), cases=2))
    return peers


def interpreted(python: str) -> list[Peer]:
    """Returns SciPy and Octave: minutes per run, so one repetition."""
    script = str(build.HERE / "peers" / "scipy_peer.py")
    peers = [
        Peer(f"{method} (SciPy)", tolerances(4, 10, 2), adaptive([python, script, "PLANT", method]), 1, cases=2)
        for method in ("DOP853", "LSODA", "odeint")
    ]
    if octave := build.find_octave():
        command = adaptive([str(octave), "--norc", "--quiet", str(build.HERE / "peers" / "ode45_peer.m"), "PLANT"])
        peers.append(Peer("ode45 (Octave)", (1e-3, 1e-6, 1e-8), command, 1, cases=2))
    return peers


def jounce(plant: Plant, repeats: int) -> list[Peer]:
    """Returns jounce on the spec: with the tables that the same run has made before, and without."""
    program = build.compile_jounce()
    return [jounce_peer(program, plant, name, start, repeats) for name, start in JOUNCE_STARTS.items()] if program else []


def jounce_peer(program: Path, plant: Plant, name: str, start: str, repeats: int) -> Peer:
    """Returns jounce with one of the starts of its peer program."""

    def command(_parameters: Path, case: Case, tolerance: float) -> list[str]:
        drive = f"drive.{plant.drive}"
        changes = [f"{drive}.amplitude={case.amplitude_n:g} N", f"{drive}.frequency={case.frequency_hz:g} Hz", f"run.tolerance={tolerance!r}"]
        return [str(program), str(plant.path), start, *changes]

    # Two settings per decade, because the steps of RK4 have more than two.
    ladder = tuple(float(f"{lead}e-{power}") for power in range(4, 12) for lead in (1, 0.3))
    return Peer(name, ladder, command, repeats)
