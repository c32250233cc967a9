"""Equations of a harvester for the independent method: matrices that jounce exports, and stops, circuits and drives from the spec."""

import csv
from dataclasses import dataclass

import independent_method as method
import numpy as np
import scipy.io

UNITS = {"mm": 1e-3, "ms": 1e-3, "uF": 1e-6}
LAWS = {
    "spring": (method.POWER, ("stiffness",)),
    "hertz": (method.POWER, ("stiffness", "exponent")),
    "kelvin-voigt": (method.KELVIN_VOIGT, ("stiffness", "damping")),
    "hunt-crossley": (method.HUNT_CROSSLEY, ("stiffness", "exponent", "damping")),
    "cubic": (method.CUBIC, ("stiffness", "cubic_stiffness")),
    "rigid": (method.RIGID, ("restitution",)),
}
INTERFACES = {
    "resistor": method.RESISTOR,
    "bridge": method.BRIDGE,
    "parallel-sshi": method.PARALLEL_SSHI,
    "series-sshi": method.SERIES_SSHI,
    "sece": method.SECE,
}


@dataclass
class Model:
    """Equations with the drives that are no sinusoids."""

    equations: method.Equations
    #: Constant force on the modes.
    constant: np.ndarray
    #: Times and changes of the modal velocities.
    impulses: list
    #: Times, values and columns of the recordings.
    recordings: list
    velocity: np.ndarray
    stops: list
    patches: list


def number(value):
    """Number of a quantity in SI units."""
    if not isinstance(value, str):
        return float(value)
    size, unit = value.split(" ", 1)
    return float(size) * UNITS.get(unit, 1.0)


def read_matrix(folder, name):
    """Dense matrix of a file."""
    matrix = scipy.io.mmread(folder / f"{name}.mtx")
    return np.atleast_2d(matrix.toarray() if hasattr(matrix, "toarray") else matrix)


def read_model(spec, folder):
    """Model of a spec; its exported matrices are in the subfolder `matrices`."""
    names = list(csv.DictReader((folder / "matrices" / "names.csv").open(encoding="utf-8")))
    patches = [row["name"] for row in names if row["kind"] == "electrode"]
    points = [row["name"] for row in names if row["kind"] == "point"]
    stiffness, damping, rows, base = (read_matrix(folder / "matrices", one) for one in ("stiffness", "damping", "points", "base"))
    shapes, base = dict(zip(points, rows)), base[:, 0]
    shapes["ground"] = np.zeros(base.size)
    electric = (
        [read_matrix(folder / "matrices", one) for one in ("coupling", "capacitance", "conductance")]
        if patches
        else [np.zeros((base.size, 0)), np.zeros((0, 0)), np.zeros((0, 0))]
    )
    velocity = np.zeros(base.size)
    for name, mass in spec.get("mass", {}).items():
        if "velocity" in mass:
            velocity += shapes[name] * number(mass["velocity"]) / (shapes[name] @ shapes[name])
    tones, forces, impulses, recordings = read_drives(spec, folder, shapes, base)
    stops, laws = read_stops(spec, shapes)
    constant = base * number(spec.get("gravity", {}).get("acceleration", 0.0))
    equations = method.Equations(
        np.diag(stiffness).copy(),
        np.diag(damping).copy(),
        *stops,
        *laws,
        np.ascontiguousarray(electric[0].T),
        np.diag(electric[1]).copy(),
        np.diag(electric[2]).copy(),
        *read_circuits(spec, patches),
        tones,
        forces,
    )
    return Model(equations, constant, impulses, recordings, velocity, sorted(spec.get("stop", {})), patches)


def read_stops(spec, shapes):
    """Rows and gaps of the stops; their laws and the numbers of these."""
    stops = [stop for _, stop in sorted(spec.get("stop", {}).items())]
    sign = {"positive": 1.0, "negative": -1.0}
    rows = [sign[stop.get("side", "positive")] * (shapes[stop["at"]] - shapes[stop.get("frame", "ground")]) for stop in stops]
    numbers = np.zeros((len(stops), 3))
    for row, stop in zip(numbers, stops):
        row[1] = 1.0
        for place, key in enumerate(LAWS[stop["law"]][1]):
            row[place] = number(stop[key])
    modes = shapes["ground"].size
    geometry = np.array(rows).reshape(len(stops), modes), np.array([number(stop["gap"]) for stop in stops])
    return geometry, (np.array([LAWS[stop["law"]][0] for stop in stops], dtype=int), numbers)


def read_circuits(spec, names):
    """Kinds, numbers, patches and signs of the circuits."""
    circuits = [circuit for _, circuit in sorted(spec.get("circuit", {}).items())]
    kinds, numbers = np.zeros((len(circuits), 3), dtype=int), np.zeros((len(circuits), 7))
    patches, signs = np.zeros((len(circuits), 2), dtype=int), np.zeros((len(circuits), 2))
    for k, circuit in enumerate(circuits):
        own = circuit.get("patches") or [circuit["patch"]]
        for j, name in enumerate(own):
            patches[k, j], signs[k, j] = names.index(name.lstrip("-")), -1.0 if name.startswith("-") else 1.0
        kind = INTERFACES[circuit.get("interface", "resistor")]
        if "inductance" in circuit:
            kind = method.SERIES_INDUCTOR if circuit["inductor"] == "series" else method.PARALLEL_INDUCTOR
        kinds[k] = kind, circuit.get("wiring") == "series", len(own)
        leakage_ohm = number(circuit.get("leakage_resistance", np.inf))
        inversion = np.exp(-np.pi / (2 * circuit["quality_factor"])) if "quality_factor" in circuit else circuit.get("efficiency", 1.0)
        numbers[k] = (
            number(circuit.get("resistance", np.inf)),
            number(circuit.get("inductance", circuit.get("storage", np.inf))),
            2 * number(circuit.get("diode_drop", 0.0)),
            2 * number(circuit.get("diode_resistance", 1.0)),
            inversion,
            number(circuit.get("battery", 0.0)),
            1 / leakage_ohm,
        )
    return kinds, numbers, patches, signs


def read_drives(spec, folder, shapes, base):
    """Sinusoids with their columns, impulses and recordings."""
    tones, forces, impulses, recordings = [], [], [], []
    for drive in spec["drive"].values():
        column = shapes[drive["at"]] if drive["kind"] == "force" else -base
        if drive["signal"] == "sine":
            omega, amplitude = 2 * np.pi * number(drive["frequency"]), number(drive["amplitude"])
            factor = -(omega**2) if drive["kind"] == "base-displacement" else 1.0
            tones.append([omega, number(drive.get("phase", 0.0))])
            forces.append(factor * amplitude * column)
        elif drive["signal"] == "velocity-step":
            impulses.append((number(drive["start"]), number(drive["velocity"]) * column))
        else:
            times, values = np.loadtxt(folder / drive["file"], delimiter=",", skiprows=1, unpack=True)
            recordings.append((times + number(drive["start"]), values, column))
    return np.array(tones).reshape(len(tones), 2), np.array(forces).reshape(len(tones), base.size), impulses, recordings
