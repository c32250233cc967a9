"""SciPy's solve_ivp (any of its methods by name) and odeint on the modal plant, one run.

The linear part is one matrix, so a right-hand side is a handful of NumPy calls. State: modal displacements, modal velocities, the voltage
(V), the energy in the resistor (J).
Usage: scipy_peer.py PLANT METHOD RELATIVE ABSOLUTE.  Prints one JSON line; cpu_s covers the integration only.
"""

from __future__ import annotations

import json
import math
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import odeint, solve_ivp

Array = NDArray[np.float64]
Rate = Callable[[float, Array], Array]


def read(path: str) -> dict[str, Array]:
    """Reads the rows of a parameter file by name."""
    lines = (line.split() for line in Path(path).read_text().splitlines())
    return {name: np.array([float(word) for word in words]) for name, *words in lines}


def linear_part(plant: dict[str, Array]) -> Array:
    """Returns the matrix of the linear part, and a zero row for the energy."""
    omega = 2.0 * np.pi * plant["frequency_hz"]
    count = omega.size
    matrix = np.zeros((2 * count + 2, 2 * count + 2))
    matrix[:count, count : 2 * count] = np.eye(count)
    matrix[count : 2 * count, :count] = -np.diag(omega**2)
    matrix[count : 2 * count, count : 2 * count] = -np.diag(2.0 * plant["damping_ratio"] * omega)
    matrix[count : 2 * count, 2 * count] = plant["coupling_n_per_v"]
    matrix[2 * count, count : 2 * count] = -plant["coupling_n_per_v"] / plant["capacitance_f"]
    matrix[2 * count, 2 * count] = -1.0 / float(plant["resistance_ohm"][0] * plant["capacitance_f"][0])
    return matrix


def rate_of(plant: dict[str, Array]) -> Rate:
    """Returns dy/dt as a function of time and state."""
    matrix, count = linear_part(plant), plant["tip"].size
    tip, drive, push = plant["tip"], np.zeros(2 * count + 2), np.zeros(2 * count + 2)
    drive[count : 2 * count] = plant["table"] * plant["amplitude_n"]
    push[count : 2 * count] = -plant["contact_n_per_m15"] * tip
    omega, gap_m = 2.0 * math.pi * float(plant["frequency_drive_hz"][0]), float(plant["gap_m"][0])
    per_ohm = 1.0 / float(plant["resistance_ohm"][0])

    def rate(t: float, y: Array) -> Array:
        dy = matrix @ y
        dy += math.sin(omega * t) * drive
        depth = float(tip @ y[:count]) - gap_m
        if depth > 0.0:
            dy += depth**1.5 * push
        dy[-1] = y[-2] ** 2 * per_ohm
        return dy

    return rate


def advance(rate: Rate, method: str, span_s: tuple[float, float], y: Array, tolerances: tuple[float, float]) -> tuple[Array, int]:
    """Returns the state at the end of the span, and the number of right-hand sides."""
    relative, absolute = tolerances
    if method == "odeint":
        states, info = odeint(rate, y, span_s, tfirst=True, rtol=relative, atol=absolute, mxstep=10**8, full_output=True)
        return states[-1], int(info["nfe"][-1])
    solution = solve_ivp(rate, span_s, y, method=method, t_eval=[span_s[1]], rtol=relative, atol=absolute)
    if not solution.success:
        raise ArithmeticError(solution.message)
    return solution.y[:, -1], int(solution.nfev)


def mean_power_w(plant: dict[str, Array], method: str, tolerances: tuple[float, float]) -> tuple[float, int]:
    """Returns the mean power over the averaging window, W, and the number of right-hand sides."""
    rate, duration_s, window_s = rate_of(plant), float(plant["duration_s"][0]), float(plant["average_over_s"][0])
    y, first = advance(rate, method, (0.0, duration_s - window_s), np.zeros(2 * plant["tip"].size + 2), tolerances)
    y[-1] = 0.0
    y, second = advance(rate, method, (duration_s - window_s, duration_s), y, tolerances)
    return float(y[-1]) / window_s, first + second


def main() -> None:
    """Runs once and prints the outcome."""
    path, method, relative, absolute = sys.argv[1:]
    plant, tolerances = read(path), (float(relative), float(absolute))
    try:
        start = time.process_time()
        power_w, evaluations = mean_power_w(plant, method, tolerances)
        taken_s = time.process_time() - start
        print(json.dumps({"mean_power_w": power_w, "cpu_s": taken_s, "evaluations": evaluations}))
    except (ArithmeticError, ValueError) as error:
        print(json.dumps({"failed": str(error)}))


if __name__ == "__main__":
    main()
