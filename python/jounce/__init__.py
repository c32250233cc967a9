"""jounce simulates, analyses and designs vibro-impact piezoelectric energy harvesters.

>>> import jounce
>>> harvester = jounce.examples()["impact-harvester-2019"]
>>> harvester["stop.tip.gap"] = "0.5 mm"
>>> run = harvester.run(tolerance=1e-8)
>>> print(run.mean_power_w, run.settled)  # doctest: +SKIP
"""

from os import PathLike as _PathLike

from ._core import VERSION as __version__
from .basins import BasinsResult
from .bifurcations import BifurcationCurve, BifurcationsResult
from .branch import Branch, BranchResult
from .contact import ContactResult, Pulse, contact
from .diagram import DiagramResult
from .elements import Beam, Circuit, Damping, Drive, Gravity, Layer, Mass, Modal, Patch, Reduction, Run, Stop
from .ensemble import EnsembleResult
from .errors import (
    ArgumentError,
    ConvergenceError,
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
    RecordingError,
    SpecError,
    StartError,
    StructureError,
    StudyError,
    UnknownKeyError,
)
from .examples import Examples, examples
from .explore import Explorer, explore
from .fit import FitCurve, FitDeviation, FitResult
from .frf import FrfResult
from .history import History
from .issue import Issue
from .materials import Material, Materials, materials
from .measured_frf import ImpactHit, MeasuredFrf, measured_frf
from .measured_modes import MeasuredModes, measured_modes
from .modes import ModesResult
from .noise import NoiseResult
from .power import PowerResult, power
from .recorded_file import ModeShape, RecordedFile, read_recordings
from .recording import Channel, Recording
from .reproduce import ReproduceResult, reproduce
from .run import RunResult, State
from .segments import SegmentsResult, segments
from .signal import Spectrum, spectrum, write_recording
from .spec import Spec
from .spectra import SpectraResult, spectra
from .starters import keys, new, schema, starters
from .study import Study
from .study_result import StudyResult, StudyStatus, StudyTable
from .sweep import SweepResult

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
