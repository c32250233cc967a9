"""Files that are written completely or not at all."""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import BinaryIO

from ._errors import FileError


def write_whole(path: str | PathLike[str], what: str, fill: Callable[[BinaryIO], object]) -> None:
    """Writes what ``fill`` writes: under a temporary name, flushed to the disk, then renamed; creates a missing folder.

    Raises
    ------
    FileError
        For a file that cannot be written; ``what`` names it. An older file is then unchanged.
    """
    target = Path(os.path.realpath(path))
    temporary = target.with_name(f".{target.name}.{secrets.token_hex(4)}")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        try:
            with temporary.open("xb") as file:
                fill(file)
                file.flush()
                os.fsync(file.fileno())
            os.replace(temporary, target)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise FileError(f"{what} {os.fspath(path)} cannot be written: {error}", {"path": os.fspath(path), "errno": error.errno}) from error
