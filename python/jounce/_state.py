"""State at the end of a run, from which another can start."""

from __future__ import annotations

import dataclasses
import json
from os import PathLike
from pathlib import Path
from typing import Annotated, Any, Self

from ._errors import FileError, StartError
from ._fields import About


@dataclasses.dataclass(frozen=True)
class State:
    """State that another run can start from, in the file format of ``jounce run --save-state``."""

    json: Annotated[str, About("contents of the state file")]

    @classmethod
    def read(cls, path: str | PathLike[str]) -> Self:
        """Reads a state file."""
        try:
            return cls(Path(path).read_text(encoding="utf-8"))
        except (OSError, UnicodeDecodeError) as error:
            raise StartError(f"the start state {path} cannot be read: {error}", {"path": str(path)}) from error

    def write(self, path: str | PathLike[str]) -> None:
        """Writes a state file."""
        try:
            Path(path).write_text(self.json, encoding="utf-8")
        except OSError as error:
            raise FileError(f"the state {path} cannot be written: {error}", {"path": str(path), "errno": error.errno}) from error

    def to_dict(self) -> dict[str, Any]:
        """Modal displacements and velocities, voltages and drive angles, SI."""
        values: dict[str, Any] = json.loads(self.json)
        return values
