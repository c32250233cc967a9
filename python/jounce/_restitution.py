"""Restitution estimated from the materials of two bodies."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Annotated, Any

from . import _core
from ._arguments import optional_si, options
from ._call import recorded
from ._fields import About, Along, Variable
from ._result import Floats, Result, make_manifest

if TYPE_CHECKING:
    from pandas import DataFrame
    from xarray import Dataset

#: Names of the two values of a range.
ENDS = ["lowest", "highest"]


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class RestitutionResult(Result):
    """Estimate of the coefficient of restitution; each pair belongs to the lowest and the highest yield strength."""

    restitution: Annotated[Floats, Along("strength", "1", "coefficient of restitution, lowest and highest of both theories")]
    perfectly_plastic: Annotated[Floats, Along("strength", "1", "coefficient with the pressure at the yield limit, Thornton (1997)")]
    fully_plastic: Annotated[Floats, Along("strength", "1", "coefficient with the fully plastic pressure, Johnson (1985)")]
    yield_speed_m_s: Annotated[Floats, Along("strength", "m/s", "speed of first yield, below which the coefficient is 1")]
    yield_strength_pa: Annotated[Floats, Along("strength", "Pa", "yield strength of the softer body")]
    effective_modulus_pa: Annotated[float, About("effective modulus of both bodies", "Pa")]
    effective_radius_m: Annotated[float, About("effective radius of both bodies", "m")]
    effective_mass_kg: Annotated[float, About("effective mass of both bodies", "kg")]
    speed_m_s: Annotated[float, About("speed of approach", "m/s")]
    sources: Annotated[list[str], About("sources of theories and materials")]

    def _summary(self) -> list[tuple[str, str]]:
        def text(pair: Floats, scale: float = 1.0) -> str:
            return " to ".join(f"{value * scale:.4g}" for value in pair)

        lines = [("restitution", text(self.restitution)), ("yield strength", f"{text(self.yield_strength_pa, 1e-6)} MPa")]
        return [*lines, ("first yield at", f"{text(self.yield_speed_m_s)} m/s"), *(("source", source) for source in self.sources)]

    def to_xarray(self) -> Dataset:
        """Returns an ``xarray.Dataset`` over ``strength``, the lowest and the highest."""
        return self._dataset(self._variables(), {"strength": Variable(("strength",), ENDS, "", "yield strength of the softer body")})

    def to_pandas(self) -> DataFrame:
        """Returns a ``pandas.DataFrame`` with a row for the lowest and one for the highest yield strength."""
        return self._frame(self._columns("strength"))


@recorded
def restitution(
    material: str,
    stop_material: str,
    *,
    radius: Any,
    mass: Any,
    speed: Any,
    stop_radius: Any = None,
    stop_mass: Any = None,
    yield_strength: Any = None,
) -> RestitutionResult:
    """Estimates the coefficient of restitution of a ball on a stop from their materials, with its scatter.

    The softer body yields. Its strength has the range of the common tempers of its material, unless ``yield_strength`` gives it.
    """
    given = {
        "material": material,
        "stop_material": stop_material,
        "radius_m": optional_si("length", radius, "radius"),
        "stop_radius_m": optional_si("length", stop_radius, "stop_radius"),
        "mass_kg": optional_si("mass", mass, "mass"),
        "stop_mass_kg": optional_si("mass", stop_mass, "stop_mass"),
        "speed_m_s": optional_si("speed", speed, "speed"),
        "yield_strength_pa": optional_si("pressure", yield_strength, "yield_strength"),
    }
    fields = RestitutionResult._filled(_core.restitution(options(**given)))
    return RestitutionResult(manifest=make_manifest("restitution", **given), **fields)
