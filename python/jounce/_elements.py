"""Elements of a spec by their keywords: ``Stop(at="beam.tip", law="hertz", gap="1 mm", stiffness="1000 N/m^1.5")``.

Each is a dict of its keys, as in TOML. The keys, units and limits are those of the key reference; they are checked when the
:class:`jounce.Spec` is made.
"""

from __future__ import annotations

from typing import Any

__all__ = ["Beam", "Circuit", "Damping", "Drive", "Gravity", "Layer", "Mass", "Modal", "Patch", "Reduction", "Run", "Stop"]


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
    """Uniform beam: ``length``, ``width``, ``thickness``, ``material`` or ``youngs_modulus``, ``density``; ``root``, ``point={...}``."""


class Patch(Element):
    """Piezoelectric patch: ``on``, ``start``, ``length``, ``width``, ``thickness``, ``material`` or ``d31`` and ``capacitance``."""


class Layer(Element):
    """Passive layer on a face of a beam: ``on``, ``face``, ``start``, ``length``, ``width``, ``thickness``, ``material``."""


class Mass(Element):
    """Rigid mass: ``mass``, ``on``; on a spring also ``frequency`` or ``stiffness``, and ``damping_ratio``."""


class Modal(Element):
    """Structure given by its modes: ``frequency_hz``, ``damping_ratio``, ``point={name: shape}``, ``patch={name: {...}}``."""


class Stop(Element):
    """Stop with a gap: ``at``, ``frame``, ``side``, ``gap``, ``law`` and the keys of the law."""


class Circuit(Element):
    """Electrical load: ``patch`` or ``patches`` with their ``wiring``, ``resistance``, ``inductance``."""


class Drive(Element):
    """Excitation: ``kind``, ``at``, ``signal`` and the keys of the signal, by default ``amplitude`` (zero to peak), ``frequency``."""


class Gravity(Element):
    """Gravity on all moving parts: ``acceleration``."""


class Damping(Element):
    """Damping ratios of the flexible modes: ``ratios``, ``beyond``."""


class Reduction(Element):
    """Number of retained modes: ``modes``, ``mesh_tolerance``."""


class Run(Element):
    """Settings of a run: ``start``, ``duration``, ``average_over``, ``tolerance``."""
