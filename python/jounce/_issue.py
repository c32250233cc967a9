"""Data-quality issues of recordings."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from typing import Annotated

from ._fields import About


@dataclasses.dataclass(frozen=True)
class Issue:
    """Data-quality issue of a recording, or a correction made by a reader; every correction is reported."""

    kind: Annotated[str, About('kind: ``"jitter"``, ``"gap"``, ``"not-a-number"``, ``"clipping"``, ``"converted"``, ``"resampled"``, ...')]
    channel: Annotated[str | None, About("channel; ``None`` for all channels of the recording")]
    count: Annotated[int, About("number of samples, time stamps or lines")]
    first: Annotated[str | None, About('place of the first one, ``"sample 7"``')]
    text: Annotated[str, About("message in one sentence, with the numbers")]

    def __str__(self) -> str:
        return self.text


#: Kinds of issues that change no number of a result.
_NOTES = ("converted", "encoding", "non-ascii-unit")


def parse_issues(text: str) -> list[Issue]:
    """Returns the issues of a result of the compiled module."""
    return [Issue(**one) for one in json.loads(text)]


def issue_lines(issues: Sequence[Issue]) -> list[tuple[str, str]]:
    """Returns printable lines, each once; an issue that changes no number of a result is a note."""
    return list(dict.fromkeys(("note" if one.kind in _NOTES else "!", one.text) for one in issues))
