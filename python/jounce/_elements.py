"""Elements of a spec by their keywords: ``Stop(at="beam.tip", law="hertz", gap="1 mm", stiffness="1000 N/m^1.5")``.

Each is a dict of its keys, as in TOML. The keys, units and limits are those of the key reference; they are checked when the
:class:`jounce.Spec` is made.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Unpack

if TYPE_CHECKING:
    from . import _tables

__all__ = [
    "Beam",
    "Circuit",
    "Damping",
    "Device",
    "Drive",
    "Gravity",
    "Layer",
    "Mass",
    "Modal",
    "Patch",
    "Plate",
    "Reduction",
    "Regulator",
    "Run",
    "Source",
    "Stop",
]


class Element(dict[str, Any]):
    """Table of a spec."""

    def __init__(self, **keys: Any) -> None:
        super().__init__(keys)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{key}={value!r}' for key, value in self.items())})"

    def __reduce__(self) -> tuple[Any, ...]:
        return (_rebuild, (type(self), dict(self)))


def _rebuild(kind: type[Element], keys: dict[str, Any]) -> Element:
    return kind(**keys)


class Beam(Element):
    """Uniform beam, clamped at its root."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.BeamKeys]) -> None: ...


class Plate(Element):
    """Rectangular thin plate with clamped, simply supported or free edges."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.PlateKeys]) -> None: ...


class Patch(Element):
    """Piezoelectric patch on a beam or a plate."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.PatchKeys]) -> None: ...


class Layer(Element):
    """Passive layer on a face of a beam or a plate."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.LayerKeys]) -> None: ...


class Mass(Element):
    """Rigid mass: on a spring, fixed to a beam or a plate, or free."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.MassKeys]) -> None: ...


class Modal(Element):
    """Structure given by its modes."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.ModalKeys]) -> None: ...


class Stop(Element):
    """Contact of a point with a body or the ground after a gap."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.StopKeys]) -> None: ...


class Circuit(Element):
    """Circuit across one patch or several."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.CircuitKeys]) -> None: ...


class Regulator(Element):
    """Regulator between the storage of a circuit and a device."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.RegulatorKeys]) -> None: ...


class Device(Element):
    """Electronic device with a duty cycle, supplied by a regulator."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.DeviceKeys]) -> None: ...


class Drive(Element):
    """Excitation: a force, or a motion of the ground or of another base.

    ``recording`` holds samples in memory: a :class:`Recording`, a history, an array of xarray or pandas with its times and unit, or one of
    numpy with ``sample_rate`` and ``unit``. They are written to ``file``, by default to one in the folder of ``JOUNCE_CACHE`` that their
    digest names; :meth:`Spec.write` copies it next to the spec.
    """

    if TYPE_CHECKING:

        def __init__(self, *, recording: Any = None, **keys: Unpack[_tables.DriveKeys]) -> None: ...

    else:

        def __init__(self, *, recording: Any = None, **keys: Any) -> None:
            from ._recorded_drive import recorded

            super().__init__(**(keys if recording is None else recorded(recording, keys)))


class Gravity(Element):
    """Gravity on all moving parts."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.GravityKeys]) -> None: ...


class Damping(Element):
    """Damping ratios of the flexible modes."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.DampingKeys]) -> None: ...


class Reduction(Element):
    """Number of retained modes."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.ReductionKeys]) -> None: ...


class Run(Element):
    """Settings of a run."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.RunKeys]) -> None: ...


class Source(Element):
    """Origin of the harvester; it affects no result."""

    if TYPE_CHECKING:

        def __init__(self, **keys: Unpack[_tables.SourceKeys]) -> None: ...
