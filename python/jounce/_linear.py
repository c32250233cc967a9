"""Responses of a harvester without contact."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from . import _core
from ._arguments import check_integers, frequencies, names, optional_hz, options
from ._call import recorded
from ._rig import SpecOnRig

if TYPE_CHECKING:
    from ._frf import FrfResult
    from ._modes import ModesResult
    from ._noise import NoiseResult


class LinearSpec(SpecOnRig):
    """Spec with its modes, frequency responses and responses to noise without contact."""

    __slots__ = ()

    @recorded
    def modes(self, hold: str | Sequence[str] = (), *, fixed_table: bool = False) -> ModesResult:
        """Computes natural frequencies, damping ratios, couplings and shapes without contact."""
        from . import ModesResult

        given = options(hold=names(hold), fixed_table=fixed_table)
        return ModesResult._from_core(_core.modes(self._spec, given))

    @recorded
    def frf(
        self,
        frequency: Any = None,
        *,
        unit: Any = None,
        low: Any = None,
        high: Any = None,
        points: int | None = None,
        input: str | None = None,
        base: bool = False,
        hold: str | Sequence[str] = (),
        fixed_table: bool = False,
        open_circuit: bool = False,
    ) -> FrfResult:
        """Computes frequency responses without contact, per newton on ``input``, or per m/s^2 of the ``base``."""
        from . import FrfResult

        check_integers(points=points)
        given = options(
            frequency_hz=frequencies(frequency, unit),
            low_hz=optional_hz(low, "low"),
            high_hz=optional_hz(high, "high"),
            points=points,
            input=input,
            base=base,
            hold=names(hold),
            fixed_table=fixed_table,
            open_circuit=open_circuit,
        )
        return FrfResult._from_core_call(_core.frf(self._spec, given))

    @recorded
    def noise(self, *, low: Any = None, high: Any = None, points: int = 1000) -> NoiseResult:
        """Computes the exact response to the noises of the spec without contact: means, mean squares, bandwidths, gap crossing rates."""
        from . import NoiseResult

        check_integers(points=points)
        given = options(low_hz=optional_hz(low, "low"), high_hz=optional_hz(high, "high"), points=points)
        return NoiseResult._from_core_call(_core.noise(self._spec, given))
