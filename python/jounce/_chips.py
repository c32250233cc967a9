"""The library of chips of regulators."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping
from typing import Annotated

from . import _core
from ._fields import About
from ._format import html_table
from ._named import Named


@dataclasses.dataclass(frozen=True)
class Chip:
    """Integrated circuit of the library, selected in a regulator of a spec by ``chip = "NAME"``."""

    name: Annotated[str, About("name in a spec")]
    start_v: Annotated[float, About("storage voltage at which the regulator starts", "V")]
    stop_v: Annotated[float, About("storage voltage at which it stops", "V")]
    output_v: Annotated[float, About("output voltage", "V")]
    efficiency: Annotated[float, About("efficiency of the converter, 0 to 1")]
    idle_a: Annotated[float, About("current from the storage while off, at the start voltage", "A")]
    quiescent_a: Annotated[float, About("current from the storage while on, in addition to that for the device", "A")]
    source: Annotated[str, About("source of the numbers")]


class Chips(Named[Chip]):
    """Chips by name."""

    _noun = "chip"

    def __init__(self) -> None:
        self._chips = {one["name"]: Chip(**one) for one in json.loads(_core.chips())}

    def _named(self) -> Mapping[str, Chip]:
        return self._chips

    def __repr__(self) -> str:
        return f"<jounce.chips: {', '.join(self._chips)}>"

    def _repr_html_(self) -> str:
        rows = [[one.name, f"{one.start_v:g}", f"{one.stop_v:g}", f"{one.output_v:g}", one.source] for one in self._chips.values()]
        return html_table("Chips", ["name", "starts [V]", "stops [V]", "output [V]", "source"], rows)


def chips() -> Chips:
    """Returns the chips that a regulator can name, with their sources: ``jounce.chips()["BQ25570"]``."""
    return Chips()
