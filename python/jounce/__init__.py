"""jounce simulates, analyses and designs vibro-impact piezoelectric energy harvesters.

>>> import jounce
>>> harvester = jounce.examples()["impact-harvester-2019"]
>>> harvester["stop.tip.gap"] = "0.5 mm"
>>> run = harvester.run(tolerance=1e-8)
>>> print(run.mean_power_w, run.settled)  # doctest: +SKIP
"""

import typing as _typing
from os import PathLike as _PathLike

from ._basins import BasinsResult
from ._bifurcations import BifurcationCurve, BifurcationsResult
from ._branch import Branch, BranchResult
from ._contact import ContactResult, Pulse, contact
from ._core import VERSION as __version__
from ._design import DesignResult
from ._diagram import DiagramResult
from ._docstrings import apply as _apply_docstrings
from ._elements import Beam, Circuit, Damping, Drive, Gravity, Layer, Mass, Modal, Patch, Reduction, Run, Stop
from ._ensemble import EnsembleResult
from ._errors import (
    ArgumentError,
    ConvergenceError,
    DesignError,
    ExploreError,
    Fault,
    FileError,
    FitError,
    IntegrationError,
    Interrupted,
    JounceError,
    NotSettled,
    OrbitError,
    PlantError,
    PointsWithoutResult,
    RecordingError,
    SpecError,
    StartError,
    StructureError,
    StudyError,
    UnknownKeyError,
)
from ._examples import Examples, examples
from ._explore import Explorer, explore
from ._fit import FitCurve, FitDeviation, FitResult
from ._frf import FrfResult
from ._history import History
from ._issue import Issue
from ._materials import Material, Materials, materials
from ._measured_frf import ImpactHit, MeasuredFrf, measured_frf
from ._measured_modes import MeasuredModes, measured_modes
from ._modes import ModesResult
from ._noise import NoiseResult
from ._power import PowerResult, power
from ._recorded_file import ModeShape, RecordedFile, read_recordings
from ._recording import Channel, Recording
from ._reproduce import ReproduceResult, reproduce
from ._run import RunResult
from ._saved import load
from ._segments import SegmentsResult, segments
from ._sensitivity import SensitivityResult
from ._signal import Spectrum, spectrum, write_recording
from ._spec import Spec
from ._spectra import SpectraResult, spectra
from ._starters import keys, new, schema, starters
from ._state import State
from ._study import Study
from ._study_result import StudyResult, StudyStatus, StudyTable
from ._sweep import SweepResult

__all__ = [
    "ArgumentError",
    "BasinsResult",
    "Beam",
    "BifurcationCurve",
    "BifurcationsResult",
    "Branch",
    "BranchResult",
    "Channel",
    "Circuit",
    "ContactResult",
    "ConvergenceError",
    "Damping",
    "DesignError",
    "DesignResult",
    "DiagramResult",
    "Drive",
    "EnsembleResult",
    "Examples",
    "ExploreError",
    "Explorer",
    "Fault",
    "FileError",
    "FitCurve",
    "FitDeviation",
    "FitError",
    "FitResult",
    "FrfResult",
    "Gravity",
    "History",
    "ImpactHit",
    "Interrupted",
    "Issue",
    "JounceError",
    "Layer",
    "IntegrationError",
    "Mass",
    "Material",
    "Materials",
    "MeasuredFrf",
    "MeasuredModes",
    "Modal",
    "ModeShape",
    "ModesResult",
    "NoiseResult",
    "NotSettled",
    "OrbitError",
    "Patch",
    "PlantError",
    "PointsWithoutResult",
    "PowerResult",
    "Pulse",
    "RecordedFile",
    "Recording",
    "RecordingError",
    "Reduction",
    "ReproduceResult",
    "Run",
    "RunResult",
    "SegmentsResult",
    "SensitivityResult",
    "Spec",
    "SpecError",
    "SpectraResult",
    "Spectrum",
    "StartError",
    "State",
    "Stop",
    "StructureError",
    "Study",
    "StudyError",
    "StudyResult",
    "StudyStatus",
    "StudyTable",
    "SweepResult",
    "UnknownKeyError",
    "__version__",
    "contact",
    "examples",
    "explore",
    "keys",
    "load",
    "materials",
    "measured_frf",
    "measured_modes",
    "new",
    "power",
    "read",
    "read_recordings",
    "reproduce",
    "schema",
    "segments",
    "spectra",
    "spectrum",
    "starters",
    "write_recording",
]


def read(path: str | _PathLike[str]) -> Spec:
    """Reads the spec of a harvester from a TOML file."""
    return Spec.read(path)


if not _typing.TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        """Raises AttributeError; the computations on a harvester are methods."""
        hint = f"; it is a method of a harvester: harvester.{name}(...)" if hasattr(Spec, name) else ""
        raise AttributeError(f"jounce has no {name!r}{hint}")


_apply_docstrings({name: globals()[name] for name in __all__})
