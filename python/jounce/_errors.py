"""Exceptions of jounce, which carry the numbers of their messages, and its warning."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Annotated, Any

from ._fields import About

__all__ = [
    "ArgumentError",
    "ConvergenceError",
    "ExploreError",
    "Fault",
    "FileError",
    "DesignError",
    "FitError",
    "Interrupted",
    "JounceError",
    "IntegrationError",
    "NotSettled",
    "OrbitError",
    "PlantError",
    "PointsWithoutResult",
    "RecordingError",
    "SpecError",
    "StartError",
    "StructureError",
    "StudyError",
    "UnknownKeyError",
]


@dataclass(frozen=True)
class Fault:
    """Fault in a spec.

    ``line`` and ``column`` are 0 where the fault has no place in a text: in a key that was set, or a spec of Python objects.
    """

    line: Annotated[int, About("line, from 1")]
    column: Annotated[int, About("column, from 1")]
    key: Annotated[str, About("key of the fault")]
    message: Annotated[str, About("message in one sentence")]

    def __str__(self) -> str:
        return f"line {self.line}, column {self.column}: {self.message}" if self.line else self.message


class JounceError(Exception):
    """Base class of the errors of jounce. ``details`` holds the numbers and names of the message, with units in the keys (``time_s``)."""

    def __init__(self, message: str, details: dict[str, Any] | None = None) -> None:
        super().__init__(message)
        self.details: dict[str, Any] = details or {}

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (self.args[0], self.details))


class ArgumentError(JounceError, ValueError):
    """An argument out of range or of a wrong type."""


class FileError(JounceError, OSError):
    """A file that cannot be read or written. ``details`` holds its ``path``, ``errno`` the error number of the system, if any."""

    def __init__(self, message: str, details: dict[str, Any] | None = None) -> None:
        super().__init__(message, details)
        self.errno = self.details.get("errno")


class UnknownKeyError(ArgumentError, KeyError):
    """A name that a mapping does not have: a key of a spec, a channel, an example; ``details`` holds it and the ``nearest`` one."""

    # A KeyError would print its message in quotes, as the name of a key.
    __str__ = Exception.__str__


class SpecError(JounceError, ValueError):
    """A spec with faults; all faults are listed in the order of their places."""

    def __init__(self, message: str, details: dict[str, Any] | None = None) -> None:
        super().__init__(message, details)
        fault_dicts = self.details.get("faults", [])
        self.faults: list[Fault] = [Fault(f["line"], f["column"], f["key"], f["message"]) for f in fault_dicts]


class StructureError(JounceError):
    """A structure without the requested modes."""


class PlantError(JounceError):
    """A harvester that has no usable linear plant."""


class StartError(JounceError):
    """A start state that cannot be read or does not match the harvester."""


class IntegrationError(JounceError):
    """An integration that could not continue."""


class StudyError(JounceError):
    """A folder that does not match the study, missing or damaged parts, or another process at work on them."""


class RecordingError(JounceError, ValueError):
    """A recording without the requested quantity: too short, without a signal or a hit, with unusable sample times or samples."""


class DesignError(JounceError):
    """A design file that cannot be read, or a design of which nothing can be evaluated."""


class FitError(JounceError, ValueError):
    """Features that are ambiguous, a key or a mode that the harvester does not have, or a fit that does not converge."""


class ExploreError(JounceError):
    """A live page that cannot be served."""


class OrbitError(JounceError):
    """A harvester that cannot have orbits of the requested kind."""


class ConvergenceError(JounceError):
    """A computation that did not converge or found no result."""


class Interrupted(KeyboardInterrupt):
    """Interruption by Ctrl-C. ``result`` holds the finished part, of the type that the call returns; ``None`` without one."""

    def __init__(self, result: Any = None) -> None:
        finished = "; the attribute `result` of this exception is the finished part"
        super().__init__("interrupted" + (finished if result is not None else ""))
        self.result = result


class NotSettled(UserWarning):
    """Warning that a run, or points of a sweep or study, have not reached steady state: their means are those of a transient."""


class PointsWithoutResult(UserWarning):
    """Warning that points of a study have no result; the column ``failure`` of its table gives the reasons."""


def warn_not_settled(message: str, *, frames: int = 1) -> None:
    """Warns at the place from which a method of the package was called, which has some frames in the package."""
    advice = "give a longer run.duration, or find with basins() whether the motion is a torus or chaos, which has no period"
    warnings.warn(f"{message}: {advice}", NotSettled, stacklevel=frames + 2)
