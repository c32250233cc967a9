"""RESULTS.md: measurements, machine, and the ratios of the methods at the same error."""

from __future__ import annotations

from statistics import median

from .compare import curve, time_at
from .measure import Result
from .product import Whole

TARGETS = (1e-4, 1e-6, 1e-8, 1e-9)


def milliseconds(seconds: float) -> str:
    """Returns a time with three digits, in ms."""
    return f"{1e3 * seconds:.3g}" if seconds < 1.0 else f"{1e3 * seconds:.0f}"


def span(seconds: list[float]) -> str:
    """Returns median and extremes, ms."""
    return f"{milliseconds(median(seconds))} [{milliseconds(min(seconds))} .. {milliseconds(max(seconds))}]"


def base_of(results: list[Result]) -> str:
    """Returns the base of the ratios: jounce if it ran, else RK4."""
    ran = {result.peer for result in results if result.cpu_s}
    return "jounce" if "jounce" in ran else "RK4 (C)"


def row(result: Result, results: list[Result], base: str) -> str:
    """Returns one line of the long table."""
    setting = f"{result.setting:.0e}" if result.setting < 1.0 else f"{result.setting:.0f}"
    head = f"| {result.peer} | {setting} {result.setting_name} |"
    if result.error is None or not result.cpu_s:
        return f"{head} {result.failed} | | | |"
    own = curve(results, result.case, result.peer)
    ladder = [r.setting for r in results if (r.case, r.peer) == (result.case, result.peer) and r.error is not None]
    reached = own[ladder.index(result.setting)][0]
    other_s = time_at(curve(results, result.case, base), reached)
    ratio = f"{result.median_s / other_s:.3g}" if other_s else "not reached"
    each = f"{1e9 * result.median_s / result.evaluations:.3g}" if result.evaluations else ""
    return f"{head} {span(result.cpu_s)} | {result.error:.1e} | {ratio} | {each} |"


def at_the_same_error(results: list[Result], case: str, base: str) -> list[str]:
    """Returns the times of every method at a few errors, and their ratios to the base."""
    lines = ["| method | " + " | ".join(f"{target:.0e}" for target in TARGETS) + " |", "|---|" + "---|" * len(TARGETS)]
    for peer in dict.fromkeys(result.peer for result in results if result.case == case):
        cells = []
        for target in TARGETS:
            own_s, base_s = (time_at(curve(results, case, name), target) for name in (peer, base))
            ratio = f" ({own_s / base_s:.3g} x)" if own_s and base_s and peer != base else ""
            cells.append(f"{milliseconds(own_s)}{ratio}" if own_s else "not reached")
        lines.append(f"| {peer} | " + " | ".join(cells) + " |")
    return lines


def case_section(results: list[Result], case: str, reference: tuple[float, float], base: str) -> list[str]:
    """Returns one case of one plant: the short table, then the long one."""
    rows = [row(result, results, base) for result in results if result.case == case]
    return [
        f"### {case}",
        "",
        f"Reference {reference[0]:.13e} W; the two methods behind it differ by {reference[1]:.1e}.",
        "",
        f"CPU time, ms, at a relative error of the mean power (in brackets: times {base}):",
        "",
        *at_the_same_error(results, case, base),
        "",
        f"| method | setting | CPU ms, median [min .. max] | relative error | times {base} at the same error | ns per right-hand side |",
        "|---|---|---|---|---|---|",
        *rows,
        "",
    ]


def whole_section(wholes: list[Whole]) -> list[str]:
    """Returns the times of jounce only."""
    if not wholes:
        return []
    head = "| task | CPU ms, all cores, median [min .. max] | wall ms, median [min .. max] |"
    lines = ["## jounce alone", "", head, "|---|---|---|"]
    for whole in wholes:
        cells = f"{whole.failed} | " if whole.failed else f"{span(whole.cpu_s)} | {span(whole.wall_s)}"
        lines.append(f"| {whole.task} | {cells} |")
    return [*lines, ""]


def report(
    machine: list[str],
    results: dict[str, list[Result]],
    references: dict[str, dict[str, tuple[float, float]]],
    wholes: list[Whole],
    cap_s: float,
) -> str:
    """Returns the text of the file."""
    lines = ["# Results", "", "Written by `bench/run.py`; how to read it is in `bench/README.md`.", "", *(f"- {line}" for line in machine)]
    lines += [f"- A run was stopped after {cap_s:g} s of CPU time.", ""]
    for plant, found in results.items():
        lines += [f"## {plant}", ""]
        for case, reference in references[plant].items():
            lines += case_section(found, case, reference, base_of(found))
    return "\n".join([*lines, *whole_section(wholes)]).rstrip() + "\n"
