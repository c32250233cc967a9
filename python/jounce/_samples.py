"""Samples in memory: those that are refused."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from ._errors import RecordingError
from ._format import counted
from ._result import Complexes, Floats

#: Largest magnitude whose square is a number.
MAX_SAMPLE = math.sqrt(sys.float_info.max)

#: Largest number of samples that an error lists.
MAX_LISTED_SAMPLES = 5

#: Advice of a message on missing samples.
ADVICE = "replace missing samples, or give jounce.Recording.of(..., allow_missing=True): analyses interpolate them linearly"


def check_samples(channels: Iterable[tuple[str, Floats | Complexes]], *, allow_missing: bool = False) -> None:
    """Raises RecordingError for samples of named channels that are missing, infinite or too large to be squared; lists all faults."""
    faults = [fault for name, values in channels for fault in _faults(name, values, allow_missing)]
    if faults:
        message = "\n".join(text for text, _ in faults)
        if any(fault["reason"] == "missing" for _, fault in faults):
            message += f"\n{ADVICE}"
        raise RecordingError(message, {"faults": [fault for _, fault in faults]})


def _faults(name: str, values: Floats | Complexes, allow_missing: bool) -> Iterator[tuple[str, dict[str, Any]]]:
    missing = np.isnan(values)
    with np.errstate(over="ignore"):
        too_large = ~missing & ~(np.abs(values) <= MAX_SAMPLE)
    for reason, words, faulty in (
        ("missing", "missing (NaN or masked)", missing & (not allow_missing)),
        ("too-large", "infinite, or too large to be squared; is the unit right?", too_large),
    ):
        indices = np.flatnonzero(faulty)
        first, count = indices[:MAX_LISTED_SAMPLES].tolist(), len(indices)
        if count > 0:
            listed = ", ".join(map(str, first)) + (", ..." if count > len(first) else "")
            text = f"{counted(count, 'sample')} of {name}, at index {listed}: {words}"
            yield text, {"channel": name, "reason": reason, "count": count, "first": first}
