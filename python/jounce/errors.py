"""What can go wrong: a small tree of exceptions that carry the numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

__all__ = [
    "ArgumentError",
    "ConvergenceError",
    "ExploreError",
    "Fault",
    "FileError",
    "FitError",
    "Interrupted",
    "JounceError",
    "MarchError",
    "OrbitError",
    "PlantError",
    "RecordingError",
    "SpecError",
    "StartError",
    "StructureError",
    "StudyError",
    "UnknownKeyError",
]


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong in a spec.

    ``line`` and ``column`` count from 1 and are 0 where the fault is in no text: in a key that was set, or in a spec of Python objects.
    """

    line: int
    column: int
    key: str
    message: str

    def __str__(self) -> str:
        return f"line {self.line}, column {self.column}: {self.message}" if self.line else self.message


class JounceError(Exception):
    """Every error of jounce. ``details`` holds the numbers and names of the message, units in their keys (``time_s``)."""

    def __init__(self, message: str, details: dict[str, Any] | None = None) -> None:
        super().__init__(message)
        self.details: dict[str, Any] = details or {}

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (self.args[0], self.details))


class ArgumentError(JounceError, ValueError):
    """An argument that is out of range or of a wrong kind."""


class FileError(JounceError, OSError):
    """A file that cannot be read or written. ``details`` holds its ``path``, ``errno`` what the system says, where it says anything."""

    def __init__(self, message: str, details: dict[str, Any] | None = None) -> None:
        super().__init__(message, details)
        self.errno = self.details.get("errno")


class UnknownKeyError(JounceError, KeyError):
    """A key that a spec does not have; ``details`` holds it and the ``nearest`` one."""

    # A KeyError would show its message as the name of a key, between quotes.
    __str__ = Exception.__str__


class SpecError(JounceError, ValueError):
    """A spec with faults: all of them, in the order of their places."""

    def __init__(self, message: str, details: dict[str, Any] | None = None) -> None:
        super().__init__(message, details)
        found = self.details.get("faults", [])
        self.faults: list[Fault] = [Fault(f["line"], f["column"], f["key"], f["message"]) for f in found]


class StructureError(JounceError):
    """A structure that has no modes as they are asked for."""


class PlantError(JounceError):
    """A harvester that has no usable linear plant."""


class StartError(JounceError):
    """A start state that cannot be read or does not fit the harvester."""


class MarchError(JounceError):
    """A march that could not go on."""


class StudyError(JounceError):
    """A folder that does not fit a study, parts that are missing or damaged, another process at work."""


class RecordingError(JounceError, ValueError):
    """A recording that cannot give what is asked of it: too short, without a signal, without a hit, its samples not where they could be."""


class FitError(JounceError, ValueError):
    """Features that say nothing clear, a key or a mode that the harvester has not, or a fit that does not converge."""


class ExploreError(JounceError):
    """A live page that cannot be served."""


class OrbitError(JounceError):
    """Orbits are asked of a harvester that can have none of that kind."""


class ConvergenceError(JounceError):
    """A computation that did not converge, or found nothing."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C. ``result`` holds what was finished, of the type that the call would have returned; ``None`` where nothing was."""

    def __init__(self, result: Any = None) -> None:
        super().__init__("interrupted; what was finished is in `result`" if result is not None else "interrupted")
        self.result = result
