"""State at the end of a run, from which another can start."""

from __future__ import annotations

import dataclasses
import json
from os import PathLike
from pathlib import Path
from typing import Annotated, Any, Self

from ._errors import StartError
from ._fields import About
from ._files import write_whole


@dataclasses.dataclass(frozen=True)
class State:
    """State that another run can start from, in the file format of ``jounce run --save-state``."""

    json: Annotated[str, About("contents of the state file")]

    @classmethod
    def read(cls, path: str | PathLike[str]) -> Self:
        """Reads a state file."""
        try:
            state = cls(Path(path).read_text(encoding="utf-8"))
            json.loads(state.json)
        except (OSError, ValueError) as error:
            raise StartError(f"the start state {path} cannot be read: {error}; State.write writes one", {"path": str(path)}) from error
        return state

    def write(self, path: str | PathLike[str]) -> None:
        """Writes a state file."""
        write_whole(path, "the state", lambda file: file.write(self.json.encode()))

    def to_dict(self) -> dict[str, Any]:
        """Modal displacements and velocities, voltages and drive angles, SI."""
        values: dict[str, Any] = json.loads(self.json)
        return values
