"""The library of materials."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping
from typing import Annotated, Any

from . import _core
from ._fields import About
from ._format import html_table
from ._named import Named


@dataclasses.dataclass(frozen=True)
class Material:
    """Material of the library, selected in a spec by ``material = "NAME"``."""

    name: Annotated[str, About("name in a spec")]
    youngs_modulus_pa: Annotated[float, About("Young's modulus along the beam, at short circuit", "Pa")]
    poisson_ratio: Annotated[float | None, About("Poisson's ratio of contacts and plates; ``None`` where unknown or not isotropic")]
    density_kg_m3: Annotated[float, About("density", "kg/m^3")]
    yield_strength_pa: Annotated[
        tuple[float, float] | None, About("yield strength from the softest to the hardest common temper; ``None`` where unknown", "Pa")
    ]
    strain_limit: Annotated[float | None, About("recommended strain limit; ``None`` where unknown")]
    voltage_limits_v: Annotated[tuple[float, float] | None, About("lowest and highest permitted voltage; ``None`` where unknown", "V")]
    charge_coefficient_m_per_v: Annotated[
        float | None, About("strain along the beam per field; ``None`` for a material that is not piezoelectric", "m/V")
    ]
    permittivity_f_m: Annotated[
        float | None, About("permittivity at constant strain; ``None`` for a material that is not piezoelectric", "F/m")
    ]
    electrode_spacing_m: Annotated[
        float | None, About("distance between interdigitated electrodes; ``None`` for electrodes on the two faces", "m")
    ]
    in_plane_poisson_ratio: Annotated[
        float | None, About("Poisson's ratio in the plane of the electrodes at short circuit, for plates; ``None`` where unknown")
    ]
    source: Annotated[str, About("source of the numbers")]


class Materials(Named[Material]):
    """Materials by name."""

    _noun = "material"

    def __init__(self) -> None:
        self._materials = {one["name"]: _material(one) for one in json.loads(_core.materials())}

    def _named(self) -> Mapping[str, Material]:
        return self._materials

    def __repr__(self) -> str:
        return f"<jounce.materials: {', '.join(self._materials)}>"

    def _repr_html_(self) -> str:
        rows = [
            [one.name, f"{one.youngs_modulus_pa / 1e9:.4g}", f"{one.density_kg_m3:.4g}", one.source] for one in self._materials.values()
        ]
        return html_table("Materials", ["name", "Young's modulus [GPa]", "density [kg/m³]", "source"], rows)


def _material(one: dict[str, Any]) -> Material:
    active = one.pop("active") or dict.fromkeys(
        ("charge_coefficient_m_per_v", "permittivity_f_m", "electrode_spacing_m", "in_plane_poisson_ratio")
    )
    yield_strength_pa, voltage_limits_v = (_pair(one.pop(name)) for name in ("yield_strength_pa", "voltage_limits_v"))
    return Material(**one, **active, yield_strength_pa=yield_strength_pa, voltage_limits_v=voltage_limits_v)


def _pair(values: list[float] | None) -> tuple[float, float] | None:
    return None if values is None else (values[0], values[1])


def materials() -> Materials:
    """Returns the materials that a spec can name, with their sources: ``jounce.materials()["PZT-5A"]``."""
    return Materials()
