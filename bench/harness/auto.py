"""AUTO-07p: the constants of a run, and readers of its two output files."""

from __future__ import annotations

from dataclasses import dataclass

KINDS = {5: "fold", 6: "branch point", 7: "period doubling", 8: "Neimark-Sacker"}  # LP, BP, PD, TR
AT_A_GIVEN_FREQUENCY = -4  # UZ
FAILED = -9  # MX


@dataclass(frozen=True)
class Mesh:
    """Collocation on `intervals` with 4 points each, adapted at every step, and the tolerance of Newton's method."""

    name: str
    intervals: int
    tolerance: float
    repeats: int


@dataclass(frozen=True)
class Row:
    """One point of the branch: its AUTO type (0 without one), its frequency and the mean power of the orbit."""

    kind: int
    frequency_hz: float
    mean_power_w: float


def constants(modes: int, mesh: Mesh, from_hz: float, to_hz: float, at_hz: tuple[float, ...]) -> str:
    """Returns the constants file `fort.2`: periodic orbits (IPS 2) from the one in the code (IRS 0), with folds and multipliers."""
    listed = ", ".join(repr(each) for each in at_hz)
    return f"""\
NDIM= {2 * modes + 3}, IPS= 2, IRS= 0, ILP= 1, ISP= 2, ISW= 1
ICP= [1, 11, 12]
NTST= {mesh.intervals}, NCOL= 4, IAD= 1, IPLT= 0, NBC= 0, NINT= 0
NMX= 3000, NPR= 0, MXBF= 0, IID= 2, ITMX= 9, ITNW= 7, NWTN= 3, JAC= 1
EPSL= {mesh.tolerance!r}, EPSU= {mesh.tolerance!r}, EPSS= 1e-05
DS= {0.1 if to_hz > from_hz else -0.1}, DSMIN= 1e-05, DSMAX= 10.0, IADS= 1
NPAR= 12, THL= {{11: 0.0}}, THU= {{}}
UZR= {{1: [{listed}]}}, UZSTOP= {{1: [{to_hz!r}]}}
"""


def rows(diagram: str) -> list[Row]:
    """Reads the points in `fort.7`; header lines begin with 0. AUTO writes a number below 1e-99 without E; here that can only be a norm."""
    found = []
    for line in diagram.splitlines():
        words = line.split()
        if len(words) > 4 and words[0] != "0":
            found.append(Row(int(words[2]), float(words[4]), float(words[-1])))
    return found


def largest_multipliers(log: str, frequencies_hz: tuple[float, ...]) -> dict[float, float]:
    """Returns the largest modulus at each frequency from `fort.9`, without the trivial multiplier 1.

    The last list before the line of a user-defined point (UZ) belongs to its orbit.
    """
    found: dict[float, float] = {}
    moduli: list[tuple[float, float]] = []
    for line in log.splitlines():
        words = line.split()
        if "Multiplier" in words and "Abs." in words:
            if words[words.index("Multiplier") + 1] == "1":
                moduli = []
            at = words.index("Multiplier")
            real, imaginary = float(words[at + 2]), float(words[at + 3])
            moduli.append((abs(complex(real, imaginary) - 1.0), float(words[-1])))
        elif len(words) > 4 and words[2] == "UZ" and moduli:
            near = min(frequencies_hz, key=lambda each: abs(each - float(words[4])))
            if abs(near - float(words[4])) < 1e-3:
                found[near] = max(modulus for _, modulus in sorted(moduli)[1:])
    return found
