"""Progress reports of long calls."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from ._errors import ArgumentError
from ._optional import require

#: Function called with the parts done, the total (as far as known, else 0) and the seconds left (``None`` where unknown).
Progress = Callable[[int, int, float | None], object]


@contextmanager
def progress_callback(progress: bool | Progress | None) -> Iterator[Progress | None]:
    """Yields the progress callback: ``None``, the given function, or a tqdm bar for ``True``."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        bar: Any = require("tqdm.auto", "progress").tqdm(total=0)

        def update_bar(done: int, total: int, seconds_left: float | None) -> None:
            del seconds_left  # tqdm has its own estimate
            bar.total = total or None
            bar.update(done - bar.n)

        try:
            yield update_bar
        finally:
            bar.close()
    elif callable(progress):
        yield progress
    else:
        raise ArgumentError(f"progress is {progress!r}; give True, or a function of (done, total, seconds_left)", {"given": repr(progress)})
