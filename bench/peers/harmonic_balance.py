"""Harmonic balance with a fixed number of harmonics, as is usual: alternating frequency/time, every mode an unknown.

The voltage is one more coordinate. A coordinate is a row [mean, cosines, sines]. The force of the stop is sampled over one period and
transformed back to harmonics, with the exact Jacobian. Pseudo-arclength continuation follows the branch from the linear response, without
stability.
Usage: harmonic_balance.py PLANT HARMONICS TO_HZ CHECK_HZ...  It starts at the plant's drive frequency. At each CHECK_HZ the orbit is
corrected at exactly that frequency. Prints one JSON line; cpu_s covers the continuation only.
"""

from __future__ import annotations

import json
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LENGTH, VOLT = 1e-4, 10.0  # units of the modal displacements (kg^1/2 m) and the voltage (V), which scale the unknowns to about 1
SAMPLES_PER_HARMONIC = 64  # fewer samples alias the force and cause false folds
RESIDUAL, MOST_ITERATIONS, WANTED_ITERATIONS = 1e-8, 8, 4
FLAT, MOST_TRIALS = 1e-6, 30  # a fold is found when the frequency component of the tangent is this small
FIRST_STEP, LEAST_STEP, LARGEST_STEP, MOST_POINTS = 0.1, 1e-5, 5.0, 5000


@dataclass
class Balance:
    """The plant in harmonics: M x'' + D x' + K x = drive + force of the stop, rows scaled by the stiffness of each mode."""

    mass: Array
    damping: Array
    stiffness: Array
    drive: Array
    tip: Array
    gap_m: float
    contact: float
    resistance_ohm: float
    harmonics: int
    derivative: Array = field(init=False)
    samples: Array = field(init=False)
    back: Array = field(init=False)

    def __post_init__(self) -> None:
        """Computes the tables of the transforms."""
        k = np.arange(1, self.harmonics + 1)
        count = 2 * self.harmonics + 1
        angle = 2.0 * np.pi * np.arange(SAMPLES_PER_HARMONIC * self.harmonics)[:, None] / (SAMPLES_PER_HARMONIC * self.harmonics) * k
        self.samples = np.hstack([np.ones((angle.shape[0], 1)), np.cos(angle), np.sin(angle)])
        self.back = 2.0 / angle.shape[0] * self.samples.T
        self.back[0] /= 2.0
        self.derivative = np.zeros((count, count))
        self.derivative[1 + np.arange(self.harmonics), 1 + self.harmonics + np.arange(self.harmonics)] = k
        self.derivative[1 + self.harmonics + np.arange(self.harmonics), 1 + np.arange(self.harmonics)] = -k

    def residual(self, unknowns: Array, frequency_hz: float) -> tuple[Array, Array, Array]:
        """Returns the residual, its derivative by the unknowns, its derivative by the frequency (1/Hz)."""
        omega, turn, one = 2.0 * np.pi * frequency_hz, self.derivative, np.eye(self.derivative.shape[0])
        rows = unknowns.reshape(self.mass.shape[0], -1)
        slope = np.kron(self.mass, omega**2 * turn @ turn) + np.kron(self.damping, omega * turn) + np.kron(self.stiffness, one)
        in_omega = (self.mass @ rows) @ (2.0 * omega * turn @ turn).T + (self.damping @ rows) @ turn.T
        value = slope @ unknowns
        sine = 1 + self.harmonics
        value[sine :: one.shape[0]] -= self.drive
        depth = np.maximum(self.samples @ (self.tip[1] @ rows) - self.gap_m, 0.0)
        value += np.kron(self.tip[0], self.back @ (self.contact * depth**1.5))
        slope += np.kron(np.outer(self.tip[0], self.tip[1]), self.back @ ((1.5 * self.contact * np.sqrt(depth))[:, None] * self.samples))
        return value, slope, 2.0 * np.pi * in_omega.ravel()

    def mean_power_w(self, unknowns: Array) -> float:
        """Returns the mean power in the resistor, W."""
        row = VOLT * unknowns.reshape(self.mass.shape[0], -1)[-1]
        return float((row[0] ** 2 + np.sum(row[1:] ** 2) / 2.0) / self.resistance_ohm)


def read(path: str, harmonics: int) -> tuple[Balance, float]:
    """Reads the plant of a parameter file, and its drive frequency, Hz."""
    lines = (line.split() for line in Path(path).read_text().splitlines())
    plant = {name: np.array([float(word) for word in words]) for name, *words in lines}
    one = {name: float(values[0]) for name, values in plant.items()}
    w, coupling, count = 2.0 * np.pi * plant["frequency_hz"], plant["coupling_n_per_v"], plant["tip"].size
    mass, damping, stiffness = (np.diag(np.append(each, 0.0)) for each in (np.ones(count), 2.0 * plant["damping_ratio"] * w, w**2))
    stiffness[:count, count] = -coupling * VOLT / LENGTH
    damping[count, :count], damping[count, count] = coupling * LENGTH / VOLT, one["capacitance_f"]
    stiffness[count, count] = 1.0 / one["resistance_ohm"]
    rows = 1.0 / np.append(w**2, stiffness[count, count])
    force = rows / LENGTH
    balance = Balance(
        mass * rows[:, None],
        damping * rows[:, None],
        stiffness * rows[:, None],
        np.append(plant["table"], 0.0) * one["amplitude_n"] * force,
        np.array([np.append(plant["tip"], 0.0) * force, np.append(plant["tip"], 0.0) * LENGTH]),
        one["gap_m"],
        one["contact_n_per_m15"],
        one["resistance_ohm"],
        harmonics,
    )
    return balance, one["frequency_drive_hz"]


def correct(balance: Balance, guess: Array, row: Array) -> tuple[Array, Array, int] | None:
    """Newton on the balance and on `row . (point - guess) = 0`; returns the point, its unit tangent along `row`, the iterations."""
    point = guess.copy()
    for iteration in range(1, MOST_ITERATIONS + 1):
        value, slope, in_frequency = balance.residual(point[:-1], point[-1])
        bordered = np.block([[slope, in_frequency[:, None]], [row[None, :]]])
        point -= np.linalg.solve(bordered, np.append(value, row @ (point - guess)))
        if np.linalg.norm(value) < RESIDUAL:
            tangent = np.linalg.solve(bordered, np.append(np.zeros(value.size), 1.0))
            return point, tangent / np.linalg.norm(tangent), iteration
    return None


def at_frequency(balance: Balance, near: Array, frequency_hz: float) -> float | None:
    """Returns the mean power of the orbit at a frequency, W, from a point of the branch close to it."""
    fixed = np.append(np.zeros(near.size - 1), 1.0)
    found = correct(balance, np.append(near[:-1], frequency_hz), fixed)
    return None if found is None else balance.mean_power_w(found[0][:-1])


def fold(balance: Balance, point: Array, tangent: Array, far: float, end_slope: float) -> tuple[float, float] | None:
    """Returns frequency (Hz) and mean power (W) at the fold within a step of length `far`, by the Illinois rule."""
    (near, begin), (beyond, end) = (0.0, tangent[-1]), (far, end_slope)
    for _ in range(MOST_TRIALS):
        at = (near * end - beyond * begin) / (end - begin)
        found = correct(balance, point + at * tangent, tangent)
        if found is None:
            return None
        middle, ahead, _ = found
        if abs(ahead[-1]) < FLAT:
            return float(middle[-1]), balance.mean_power_w(middle[:-1])
        if ahead[-1] * end > 0.0:
            beyond, end, begin = at, ahead[-1], begin / 2.0
        else:
            near, begin, end = at, ahead[-1], end / 2.0
    return None


def follow(balance: Balance, start_hz: float, end_hz: float, checks_hz: list[float]) -> dict[str, object]:
    """Returns the branch between two frequencies, starting downwards."""
    size = balance.mass.shape[0] * (2 * balance.harmonics + 1)
    found = correct(balance, np.append(np.zeros(size), start_hz), np.append(np.zeros(size), 1.0))
    if found is None:
        return {"failed": "no orbit at the start"}
    point, tangent, _ = found
    tangent, step = -tangent, FIRST_STEP
    points, folds, checks_w = 1, [], {}
    while end_hz < point[-1] <= start_hz and points < MOST_POINTS:
        found = correct(balance, point + step * tangent, tangent)
        if found is None:
            step /= 2.0
            if step < LEAST_STEP:
                return {"failed": f"stuck at {point[-1]:.6g} Hz after {points} points"}
            continue
        after, ahead, iterations = found
        if tangent[-1] * ahead[-1] < 0.0:
            folds.append(fold(balance, point, tangent, step, ahead[-1]))
        for check_hz in checks_hz:
            if (point[-1] - check_hz) * (after[-1] - check_hz) <= 0.0:
                checks_w[check_hz] = at_frequency(balance, point, check_hz)
        point, tangent, points = after, ahead, points + 1
        step = min(LARGEST_STEP, step * 2.0 ** ((WANTED_ITERATIONS - iterations) / 3.0))
    return {"points": points, "folds": [each for each in folds if each], "checks_w": checks_w, "end_hz": float(point[-1])}


def main() -> None:
    """Follows the branch and prints the outcome."""
    path, harmonics, end_hz, *checks_hz = sys.argv[1:]
    balance, start_hz = read(path, int(harmonics))
    begin = time.process_time()
    outcome = follow(balance, start_hz, float(end_hz), [float(each) for each in checks_hz])
    print(json.dumps(outcome | {"cpu_s": time.process_time() - begin}))


if __name__ == "__main__":
    main()
