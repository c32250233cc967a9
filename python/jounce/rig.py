"""A harvester on the test rig: what sensors would record of it, and its keys fitted to what they did record."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from . import _core
from .arguments import check_wholes, names, positive_si
from .errors import ArgumentError, Interrupted
from .fit import FitResult, made_fit
from .quantity import toml
from .recording import Recording
from .result import made_manifest
from .spec_text import SpecText

if TYPE_CHECKING:
    from .spec import Spec


class SpecOnRig(SpecText):
    """A spec with what a test rig gives and takes."""

    __slots__ = ()

    def rig(
        self,
        *,
        rate: Any = "2048 Hz",
        noise: float = 0.0,
        bits: int | None = None,
        seed: int = 1,
        hammer: str | None = None,
        at: Sequence[str] = (),
        hits: int = 5,
        block: Any = "4 s",
        peak: Any = "20 N",
        contact: Any = "3 ms",
        hold: Sequence[str] = (),
    ) -> Recording:
        """What the sensors of a virtual rig would record, so that the truth behind a recording is known.

        By default the run is marched and its averaging window recorded: voltages, contact forces, the acceleration of the base, and
        those of accelerometers ``at`` some points. With ``hammer``, the point that is
        struck, stops and drives are taken away, masses in ``hold`` held still, and the force and the accelerations ``at`` some points
        recorded, by default at all and of the voltages too: so many ``hits``, one every ``block``, with a force of ``peak`` for a time of
        ``contact``. ``rate`` is the sample rate, ``noise`` that of every sensor, rms over that of its signal, ``bits`` those of the
        converters.
        """
        check_wholes(bits=bits, seed=seed, hits=hits)
        sensors = {"rate_hz": positive_si("frequency", rate, "rate"), "noise": noise, "bits": bits, "seed": seed}
        manifest = {**made_manifest("rig", **sensors, hammer=hammer), "spec_sha256": self.sha256}
        if hammer is not None:
            test = {"point": hammer, "at": names(at), "hold": names(hold), "hits": hits, "block_s": positive_si("time", block, "block")}
            test |= {"peak_force_n": positive_si("force", peak, "peak"), "contact_time_s": positive_si("time", contact, "contact")}
            return Recording._of(_core.rig_struck(self._spec, sensors, test), manifest)
        if hold:
            raise ArgumentError("hold is that of a hammer test; name the point to strike with hammer=")
        answer, ended = _core.rig_shaken(self._spec, sensors, names(at))
        if ended is not None:
            raise Interrupted(None) if isinstance(ended, KeyboardInterrupt) else ended
        assert answer is not None, "a call that nothing ended has an answer"
        return Recording._of(answer, manifest)

    def fit(self, to: str | PathLike[str] | Mapping[str, Any]) -> FitResult:
        """Fits keys to measured features: a file of them, or a dict that says the same.

        ``{"hold": ["table"], "frequency_deviation": 0.002, "free": {"beam.beam.thickness": 0.01}, "mode": [{"number": 1, "frequency":
        "9.01 Hz"}]}`` frees a key within 1 % of itself and holds the first mode to 9.01 Hz within 0.2 %, standard deviations both.
        """
        if isinstance(to, Mapping):
            text = features(to)
            answer, about = _core.fit(self._spec, text=text), "features"
        elif isinstance(to, (str, PathLike)):
            answer, about = _core.fit(self._spec, path=fspath(to)), Path(to).name
        else:
            raise ArgumentError(f"to is of type {type(to).__name__}; give the path of a file of features, or a dict that says the same")
        manifest = {**made_manifest("fit", to=about), "spec_sha256": self.sha256}
        return made_fit(cast("Spec", self), answer, manifest)


def features(tables: Mapping[str, Any]) -> str:
    """Features as TOML; a list of dicts is an array of tables, ``[[mode]]``."""
    lists = {key: value for key, value in tables.items() if _is_list_of_tables(value)}
    text = toml({key: value for key, value in tables.items() if key not in lists})
    return text + "".join(f"\n[[{key}]]\n{toml(one)}" for key, each in lists.items() for one in each)


def _is_list_of_tables(value: Any) -> bool:
    is_list = isinstance(value, Sequence) and not isinstance(value, str) and len(value) > 0
    return is_list and all(isinstance(one, Mapping) for one in value)
