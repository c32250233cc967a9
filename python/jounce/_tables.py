"""Types of the tables of a spec, for editors and type checkers. Written by ``python/tables.py`` from the JSON schema."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, Protocol, Required, TypedDict

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from . import _elements


class QuantityLike(Protocol):
    """Number with a unit, as defined by pint."""

    @property
    def magnitude(self) -> Any:
        """Number without its unit."""

    def to_base_units(self) -> Any:
        """Returns the quantity in base units."""


#: Text with a unit, ``"0.5 mm"``, or a quantity of pint.
Quantity = str | QuantityLike
Numbers = Sequence[float] | NDArray[np.float64]


class BeamKeys(TypedDict, total=False):
    """Keys of a table of a spec: beam."""

    material: Literal["aluminium", "steel", "brass", "bronze", "silicon"]
    length: Required[Quantity]
    width: Required[Quantity]
    thickness: Required[Quantity]
    youngs_modulus: Quantity
    density: Quantity
    root: str
    root_stiffness: Quantity
    point: Mapping[str, Quantity]


class PlatePointKeys(TypedDict, total=False):
    """Keys of a table of a spec: platepoint."""

    x: Required[Quantity]
    y: Required[Quantity]


class PlateKeys(TypedDict, total=False):
    """Keys of a table of a spec: plate."""

    material: Literal["aluminium", "steel", "brass", "bronze", "silicon"]
    length: Required[Quantity]
    width: Required[Quantity]
    thickness: Required[Quantity]
    youngs_modulus: Quantity
    poisson_ratio: float
    density: Quantity
    on: str
    left: Literal["clamped", "simply-supported", "free"]
    right: Literal["clamped", "simply-supported", "free"]
    front: Literal["clamped", "simply-supported", "free"]
    back: Literal["clamped", "simply-supported", "free"]
    point: Mapping[str, PlatePointKeys]


class PatchKeys(TypedDict, total=False):
    """Keys of a table of a spec: patch."""

    on: Required[str]
    face: Literal["top", "bottom"]
    material: Literal["PZT-5A", "PZT-5H", "PSI-5A4E", "PVDF", "MFC-P1", "MFC-P2"]
    pore_shape: Literal["spheres", "spheroids", "cylinders"]
    pore_aspect_ratio: float
    porosity_scheme: Literal["mori-tanaka", "self-consistent"]
    porosity: float
    section: Literal["laminate", "thin-skin"]
    start: Required[Quantity]
    length: Required[Quantity]
    width: Required[Quantity]
    thickness: Required[Quantity]
    foil_thickness: Quantity
    foil_youngs_modulus: Quantity
    foil_density: Quantity
    foil_poisson_ratio: float
    youngs_modulus: Quantity
    density: Quantity
    d31: Quantity
    d33: Quantity
    electrode_spacing: Quantity
    d32: Quantity
    capacitance: Quantity
    permittivity: Quantity
    electrodes: Literal["circuit", "open"]
    leakage_resistance: Quantity
    strain_limit: float | str
    across_start: Quantity
    poisson_ratio: float
    transverse_youngs_modulus: Quantity
    shear_modulus: Quantity


class LayerKeys(TypedDict, total=False):
    """Keys of a table of a spec: layer."""

    on: Required[str]
    face: Literal["top", "bottom"]
    material: Literal["aluminium", "steel", "brass", "bronze", "silicon"]
    section: Literal["laminate", "thin-skin"]
    start: Quantity
    length: Required[Quantity]
    width: Required[Quantity]
    thickness: Required[Quantity]
    youngs_modulus: Quantity
    density: Quantity
    across_start: Quantity
    poisson_ratio: float


class MassKeys(TypedDict, total=False):
    """Keys of a table of a spec: mass."""

    on: str
    mass: Required[Quantity]
    rotary_inertia: Quantity
    frequency: Quantity
    stiffness: Quantity
    damping_ratio: float
    velocity: Quantity
    friction: Quantity


class ModalPatchKeys(TypedDict, total=False):
    """Keys of a table of a spec: modalpatch."""

    coupling_n_per_v: Required[Numbers]
    capacitance: Required[Quantity]
    electrodes: Literal["circuit", "open"]
    leakage_resistance: Quantity


class ModalKeys(TypedDict, total=False):
    """Keys of a table of a spec: modal."""

    frequency_hz: Required[Numbers]
    damping_ratio: Required[Numbers]
    participation_sqrt_kg: Numbers
    point: Mapping[str, Numbers]
    patch: Mapping[str, ModalPatchKeys]


class StopKeys(TypedDict, total=False):
    """Keys of a table of a spec: stop."""

    at: Required[str]
    frame: str
    side: Literal["positive", "negative"]
    gap: Required[Quantity]
    law: Required[Literal["hertz", "spring", "kelvin-voigt", "hunt-crossley", "cubic", "table", "rigid"]]
    exponent: float
    stiffness: Quantity
    cubic_stiffness: Quantity
    damping: Quantity
    penetration_m: Numbers
    penetration: Sequence[str]
    force_n: Numbers
    force: Sequence[str]
    file: str
    restitution: float
    radius: Quantity
    shape: Literal["sphere", "cylinder", "ellipsoid"]
    cross_radius: Quantity
    material: Literal["aluminium", "steel", "brass", "bronze"]
    youngs_modulus: Quantity
    poisson_ratio: float
    stop_radius: Quantity
    stop_shape: Literal["sphere", "cylinder", "ellipsoid"]
    stop_cross_radius: Quantity
    stop_material: Literal["aluminium", "steel", "brass", "bronze"]
    stop_youngs_modulus: Quantity
    stop_poisson_ratio: float
    crossing_angle: Quantity


class CircuitKeys(TypedDict, total=False):
    """Keys of a table of a spec: circuit."""

    patch: str
    patches: Sequence[str]
    wiring: Literal["parallel", "series"]
    interface: Literal["resistor", "bridge", "parallel-sshi", "series-sshi", "sece"]
    storage: Quantity
    battery: Quantity
    diode_drop: Quantity
    diode_resistance: Quantity
    leakage_resistance: Quantity
    quality_factor: float
    efficiency: float
    resistance: Quantity
    regulator: str
    device: str
    inductance: Quantity
    inductor: Literal["parallel", "series"]


class RegulatorKeys(TypedDict, total=False):
    """Keys of a table of a spec: regulator."""

    chip: Literal["LTC3588-1", "BQ25570"]
    start_voltage: Quantity
    stop_voltage: Quantity
    output_voltage: Quantity
    efficiency: float
    idle_current: Quantity
    quiescent_current: Quantity


class DeviceKeys(TypedDict, total=False):
    """Keys of a table of a spec: device."""

    sleep_current: Required[Quantity]
    measure_current: Quantity
    measure_time: Quantity
    send_current: Quantity
    send_time: Quantity
    period: Quantity


DriveKeys = TypedDict(
    "DriveKeys",
    {
        "kind": Literal["force", "base-acceleration", "base-displacement"],
        "signal": Literal["sine", "chirp", "half-sine", "velocity-step", "noise", "recording"],
        "at": str,
        "amplitude": Quantity,
        "frequency": Quantity,
        "from": Quantity,
        "to": Quantity,
        "sweep": Literal["linear", "logarithmic"],
        "phase": Quantity,
        "velocity": Quantity,
        "start": Quantity,
        "duration": Quantity,
        "psd": Quantity,
        "low": Quantity,
        "high": Quantity,
        "seed": int,
        "file": str,
        "channel": str,
        "unit": str,
        "scale": float,
        "mean": Literal["kept", "removed"],
        "sample_rate": Quantity,
    },
    total=False,
)


class GravityKeys(TypedDict, total=False):
    """Keys of a table of a spec: gravity."""

    acceleration: Required[Quantity]


class DampingKeys(TypedDict, total=False):
    """Keys of a table of a spec: damping."""

    ratios: Numbers
    beyond: float


class ReductionKeys(TypedDict, total=False):
    """Keys of a table of a spec: reduction."""

    modes: int
    mesh_tolerance: float


class RunKeys(TypedDict, total=False):
    """Keys of a table of a spec: run."""

    start: str
    duration: Quantity
    average_over: Quantity
    tolerance: float


class SourceKeys(TypedDict, total=False):
    """Keys of a table of a spec: source."""

    publications: Sequence[str]


class SpecKeys(TypedDict, total=False):
    """Tables of a spec."""

    beam: Mapping[str, BeamKeys | _elements.Beam]
    plate: Mapping[str, PlateKeys | _elements.Plate]
    patch: Mapping[str, PatchKeys | _elements.Patch]
    layer: Mapping[str, LayerKeys | _elements.Layer]
    mass: Mapping[str, MassKeys | _elements.Mass]
    modal: Mapping[str, ModalKeys | _elements.Modal]
    stop: Mapping[str, StopKeys | _elements.Stop]
    circuit: Mapping[str, CircuitKeys | _elements.Circuit]
    regulator: Mapping[str, RegulatorKeys | _elements.Regulator]
    device: Mapping[str, DeviceKeys | _elements.Device]
    drive: Mapping[str, DriveKeys | _elements.Drive]
    gravity: GravityKeys | _elements.Gravity
    damping: DampingKeys | _elements.Damping
    reduction: ReductionKeys | _elements.Reduction
    run: RunKeys | _elements.Run
    source: SourceKeys | _elements.Source
