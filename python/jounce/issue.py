"""What is odd about a recording."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence


@dataclasses.dataclass(frozen=True)
class Finding:
    """Something that a reader noticed or did; nothing is repaired in silence."""

    #: What it is: ``"jitter"``, ``"gap"``, ``"not-a-number"``, ``"clipping"``, ``"converted"``, ``"resampled"``, ...
    kind: str
    #: The channel; ``None`` where it concerns the whole recording.
    channel: str | None
    #: How many samples, stamps or lines.
    count: int
    #: Where the first one is, ``"sample 7"``.
    first: str | None
    #: One sentence with the numbers.
    text: str

    def __str__(self) -> str:
        return self.text


#: Kinds of findings that change no number of an answer.
_NOTES = ("converted", "encoding", "non-ascii-unit")


def found(text: str) -> list[Finding]:
    """From what the compiled module answers."""
    return [Finding(**one) for one in json.loads(text)]


def told(findings: Sequence[Finding]) -> list[tuple[str, str]]:
    """Lines for people, each once; what changes no number of an answer is a note."""
    return list(dict.fromkeys(("note" if one.kind in _NOTES else "!", one.text) for one in findings))
