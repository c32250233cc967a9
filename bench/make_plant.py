"""Writes plant.toml (8 modes) and plant-24.toml (24 modes): the paper's harvester as modal plants.

The unknown is the curvature of the beam, a Legendre series on each of its three uniform pieces, together with
the displacement of the table. In these coordinates the stiffness is diagonal and no digits are lost in it, so the
lowest frequencies hold to roundoff and the series converge exponentially; no mesh enters.
    w(x) = s + integral_0^x (x - y) kappa(y) dy
    M = m s^2 + integral rho A w^2 dx,   K = k s^2 + sum over pieces of EI integral kappa^2 dx
Data: Table 1 and the text of the paper; section: thin skin on the mid-plane of the beam; patch mass neglected.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

Array = NDArray[np.float64]

BREAKS_M = (0.0, 0.009, 0.094, 0.315)
CONTACT_M = 0.305
WIDTH_M = 0.030
THICKNESS_M, MODULUS_PA, DENSITY_KG_M3 = 0.98e-3, 65e9, 2750.0
SKIN_M, SKIN_MODULUS_PA, D31_M_PER_V = 0.3e-3, 30.336e9, -170e-12
TABLE_KG = 12.0
TABLE_STIFFNESS_N_M = TABLE_KG * (2.0 * np.pi) ** 2
TABLE_DAMPING = 0.05
BEAM_DAMPING = (0.00194, 0.00925, 0.00864, 0.00359, 0.00126, 0.00274, 0.00160)
TERMS = 80


@dataclass(frozen=True)
class Modes:
    """Modes of the coupled structure, mass-normalised; shapes in kg^-1/2, coupling in N/V."""

    frequency_hz: Array
    damping_ratio: Array
    table: Array
    tip: Array
    coupling_n_per_v: Array


def bending_stiffness_n_m2() -> Array:
    """EI of the three pieces, N m^2: bare, under the patch, bare."""
    bare = MODULUS_PA * WIDTH_M * THICKNESS_M**3 / 12.0
    skin = SKIN_MODULUS_PA * WIDTH_M * SKIN_M * (THICKNESS_M / 2.0) ** 2
    return np.array([bare, bare + skin, bare])


def electromechanical_n_m_per_v() -> float:
    """gamma_p of eq. (2), with the neutral axis of the layered section."""
    beam, skin = MODULUS_PA * THICKNESS_M, SKIN_MODULUS_PA * SKIN_M
    axis = (beam * THICKNESS_M / 2.0 + skin * (THICKNESS_M + SKIN_M / 2.0)) / (beam + skin)
    return SKIN_MODULUS_PA * D31_M_PER_V * WIDTH_M * (THICKNESS_M + SKIN_M / 2.0 - axis)


def displacement_rows(x_m: Array) -> Array:
    """Returns the displacement at x per unit of each unknown: the table first, then the curvature terms piece by piece."""
    rows = np.zeros((x_m.size, 1 + 3 * TERMS))
    rows[:, 0] = 1.0
    for piece in range(3):
        start, end = BREAKS_M[piece], BREAKS_M[piece + 1]
        half = (end - start) / 2.0
        inside = np.clip((x_m - start) / half - 1.0, -1.0, 1.0)
        beyond = np.maximum(x_m - end, 0.0)
        for term in range(TERMS):
            series = np.eye(TERMS)[term]
            slope = legendre.legint(series, 1, lbnd=-1)
            twice = legendre.legint(series, 2, lbnd=-1)
            end_slope = half * legendre.legval(1.0, slope)
            rows[:, 1 + piece * TERMS + term] = half**2 * legendre.legval(inside, twice) + beyond * end_slope
    return rows


def mass_matrix() -> Array:
    """Returns the mass in the unknowns of `displacement_rows`, kg, by Gauss quadrature that is exact for these polynomials."""
    nodes, weights = legendre.leggauss(TERMS + 4)
    mass = np.zeros((1 + 3 * TERMS, 1 + 3 * TERMS))
    mass[0, 0] = TABLE_KG
    for start, end in zip(BREAKS_M[:-1], BREAKS_M[1:], strict=True):
        half = (end - start) / 2.0
        rows = displacement_rows(start + half * (nodes + 1.0))
        mass += rows.T @ (rows * (DENSITY_KG_M3 * WIDTH_M * THICKNESS_M * half * weights)[:, None])
    return mass


def stiffness_diagonal() -> Array:
    """Returns the diagonal stiffness in the same unknowns: the table's spring, then EI times the norm of each Legendre term."""
    norms = 2.0 / (2.0 * np.arange(TERMS) + 1.0)
    halves = np.diff(BREAKS_M) / 2.0
    return np.concatenate([[TABLE_STIFFNESS_N_M], *(ei * half * norms for ei, half in zip(bending_stiffness_n_m2(), halves, strict=True))])


def solve(count: int) -> Modes:
    """Returns the lowest `count` modes; damping beyond the measured seven repeats the last measured ratio."""
    scale = 1.0 / np.sqrt(stiffness_diagonal())
    squared_periods, shapes = np.linalg.eigh(mass_matrix() * scale[:, None] * scale[None, :])
    squared_periods, shapes = squared_periods[::-1][:count], shapes[:, ::-1][:, :count]
    unknowns = scale[:, None] * shapes / np.sqrt(squared_periods)
    unknowns *= np.sign(unknowns[0])
    patch_rotation = unknowns[1 + TERMS] * (BREAKS_M[2] - BREAKS_M[1])
    beyond = (BEAM_DAMPING[-1],) * max(0, count - 1 - len(BEAM_DAMPING))
    return Modes(
        frequency_hz=1.0 / (2.0 * np.pi * np.sqrt(squared_periods)),
        damping_ratio=np.array((TABLE_DAMPING, *BEAM_DAMPING, *beyond)[:count]),
        table=unknowns[0],
        tip=(displacement_rows(np.array([CONTACT_M])) @ unknowns)[0],
        coupling_n_per_v=electromechanical_n_m_per_v() * patch_rotation,
    )


def numbers(values: Array) -> str:
    """Returns a TOML array whose numbers read back to the same bits."""
    return "[" + ", ".join(repr(float(value)) for value in values) + "]"


def spec(modes: Modes) -> str:
    """Returns the plant as a jounce spec."""
    count = modes.frequency_hz.size
    return f"""# The harvester of "Experimental validation of an impact off-resonance energy harvester" (2019) by {count} of its modes:
# one of the table (damping ratio {TABLE_DAMPING}) and {count - 1} of the beam. Written by make_plant.py; do not edit.

[modal.harvester]
frequency_hz = {numbers(modes.frequency_hz)}
damping_ratio = {numbers(modes.damping_ratio)}

[modal.harvester.point]                  # kg^-1/2
table = {numbers(modes.table)}
tip = {numbers(modes.tip)}

[modal.harvester.patch.mfc]
coupling_n_per_v = {numbers(modes.coupling_n_per_v)}
capacitance = "177 nF"

[stop.tip]
at = "harvester.tip"
frame = "ground"
law = "hertz"
gap = "1 mm"
stiffness = "1000 N/m^1.5"

[circuit.load]
patch = "harvester.mfc"
resistance = "1 Mohm"

[drive.shaker]
at = "harvester.table"
kind = "force"
amplitude = "50 N"
frequency = "11 Hz"

[run]
start = "rest"
duration = "20 s"
average_over = "10 s"
"""


def main() -> None:
    """Writes both plants next to this file."""
    here = Path(__file__).parent
    (here / "plant.toml").write_text(spec(solve(8)))
    (here / "plant-24.toml").write_text(spec(solve(24)))


if __name__ == "__main__":
    main()
