"""ORBITS.md: the cost of the complete branch for each method, its folds, the error of its power, and the cost per point."""

from __future__ import annotations

from statistics import median

from .branches import CHECKS_HZ, FORCE_N, HIGHEST_HZ, JOUNCE_METHODS, LOWEST_HZ
from .orbit_run import MODES, SHORT_HZ, WALKS, Cost, Drawn

SAME_HZ = 0.01  # a label farther than this from every fold of the base counts as extra


def span(seconds: list[float]) -> str:
    """Returns median and extremes."""
    return f"{median(seconds):.3g} [{min(seconds):.3g} .. {max(seconds):.3g}]"


def base_of(drawn: list[Drawn]) -> Drawn | None:
    """Returns jounce by shooting, the base of times and folds."""
    return next((each for each in drawn if each.method in JOUNCE_METHODS and each.cpu_s), None)


def time_table(drawn: list[Drawn]) -> list[str]:
    """Returns one line for each method."""
    base = base_of(drawn)
    lines = ["| method | CPU s, median [min .. max] | times jounce | points | ms per point | labels |", "|---|---|---|---|---|---|"]
    for each in drawn:
        if not each.cpu_s:
            lines.append(f"| {each.method} | {each.found.failed} | | | | |")
            continue
        taken_s = median(each.cpu_s)
        ratio = f"{taken_s / median(base.cpu_s):.3g}" if base else ""
        kinds = [label[0] for label in each.found.labels]
        labels = ", ".join(f"{kinds.count(kind)} {kind}" for kind in dict.fromkeys(kinds))
        ends = "" if each.found.reached else "; the branch ends inside the range, or is in pieces"
        varies = "; differs between repetitions" if each.varies else ""
        per_point = f"{1e3 * taken_s / each.found.points:.3g}"
        lines.append(f"| {each.method} | {span(each.cpu_s)} | {ratio} | {each.found.points} | {per_point} | {labels}{ends}{varies} |")
    return lines


def matched(folds: list[tuple[float, float]], base: list[tuple[float, float]]) -> tuple[list[tuple[float, float] | None], int]:
    """Returns for each fold of the base the nearest one within SAME_HZ, and the number of unmatched folds."""
    nearest = [min(folds, key=lambda own: abs(own[0] - hz), default=None) for hz, _ in base]
    close = [own if own and abs(own[0] - hz) < SAME_HZ else None for own, (hz, _) in zip(nearest, base, strict=True)]
    return close, len(folds) - len({own for own in close if own})


def fold_table(drawn: list[Drawn]) -> list[str]:
    """Returns frequency and mean power at each fold of the base, and the number of extra folds of the method."""
    base = base_of(drawn)
    if base is None:
        return []
    folds = sorted(base.found.folds())
    head = " | ".join(f"fold {number + 1}: Hz, W" for number in range(len(folds)))
    lines = [f"| method | {head} | further folds |", "|---|" + "---|" * (len(folds) + 1)]
    for each in drawn:
        if each.cpu_s:
            own, more = matched(each.found.folds(), folds)
            cells = " | ".join(f"{fold[0]:.6f}, {fold[1]:.5e}" if fold else "no label" for fold in own)
            lines.append(f"| {each.method} | {cells} | {more} |")
    return lines


def check_table(drawn: list[Drawn], references: dict[float, tuple[float, float]]) -> list[str]:
    """Returns the relative error of the mean power, and the largest multiplier, at the checked frequencies."""
    head = " | ".join(f"error at {hz:g} Hz | largest multiplier" for hz in CHECKS_HZ)
    lines = [f"| method | {head} |", "|---|" + "---|---|" * len(CHECKS_HZ)]
    for each in drawn:
        if each.cpu_s:
            cells = []
            for hz in CHECKS_HZ:
                power_w, multiplier = each.found.power_w.get(hz), each.found.multiplier.get(hz)
                cells += [f"{abs(power_w / references[hz][0] - 1.0):.1e}" if power_w else "", f"{multiplier:.6f}" if multiplier else ""]
            lines.append(f"| {each.method} | {' | '.join(cells)} |")
    return lines


def cost_table(costs: list[Cost]) -> list[str]:
    """Returns milliseconds per point against the number of modes."""
    found = {(cost.method, cost.modes): cost for cost in costs}
    names = [name for name in (*JOUNCE_METHODS, *WALKS) if (name, MODES[0]) in found]
    lines = ["| modes | " + " | ".join(f"{name}: ms per point (points)" for name in names) + " |", "|---|" + "---|" * len(names)]
    for modes in MODES:
        cells = []
        for name in names:
            cost = found[name, modes]
            each_s = cost.per_point_s()
            cells.append(f"{1e3 * each_s:.3g} ({cost.points})" if each_s else str(cost.failed))
        lines.append(f"| {modes} | {' | '.join(cells)} |")
    return lines


def report(machine: list[str], drawn: list[Drawn], references: dict[float, tuple[float, float]], costs: list[Cost], cap_s: float) -> str:
    """Returns the text of the file."""
    known = "; ".join(f"{hz:g} Hz: {watt:.12e} W, {apart:.1e} apart" for hz, (watt, apart) in references.items())
    lines = [
        "# Periodic orbits",
        "",
        "Written by `bench/orbits.py`; `bench/README.md` explains it.",
        "",
        *(f"- {line}" for line in machine),
        f"- Each run was limited to {cap_s:g} s of CPU time.",
        "",
        f"## The branch of period 1, {LOWEST_HZ:g} to {HIGHEST_HZ:g} Hz at {FORCE_N:g} N",
        "",
        *time_table(drawn),
        "",
        "Folds:",
        "",
        *fold_table(drawn),
        "",
        "Mean power, relative to a run of 300 s in steady state on the orbit"
        f" (RK4, confirmed by DOP853; {known}), and the largest Floquet multiplier:"
        if references
        else "No reference could be computed:",
        "",
        *(check_table(drawn, references) if references else []),
        "",
        f"## Cost per point against the number of modes, {SHORT_HZ[0]:g} to {SHORT_HZ[1]:g} Hz",
        "",
        *(cost_table(costs) if costs else ["Not measured."]),
    ]
    return "\n".join(lines).rstrip() + "\n"
