"""jounce simulates, analyses and designs vibro-impact piezoelectric energy harvesters.

>>> import jounce
>>> harvester = jounce.examples()["impact-harvester-2019"]
>>> harvester["stop.tip.gap"] = "0.5 mm"
>>> answer = harvester.run(tolerance=1e-8)
>>> print(answer.mean_power_w, answer.settled)  # doctest: +SKIP
"""

from __future__ import annotations

from os import PathLike

from ._core import VERSION as __version__
from .basins import BasinsResult
from .branch import Branch, BranchResult
from .diagram import DiagramResult
from .ensemble import EnsembleResult
from .errors import (
    ArgumentError,
    ConvergenceError,
    Fault,
    FileError,
    Interrupted,
    JounceError,
    MarchError,
    OrbitError,
    PlantError,
    SpecError,
    StartError,
    StructureError,
    StudyError,
)
from .examples import Examples, examples
from .frf import FrfResult
from .history import History
from .jumps import JumpCurve, JumpsResult
from .materials import Material, Materials, materials
from .modes import ModesResult
from .run import RunResult, State
from .signal import Spectrum, spectrum, write_recording
from .spec import Spec
from .study import Study
from .study_result import StudyResult, StudyStatus, StudyTable
from .sweep import SweepResult
from .things import Beam, Circuit, Damping, Drive, Gravity, Mass, Modal, Patch, Reduction, Run, Stop

__all__ = [
    "ArgumentError",
    "BasinsResult",
    "Beam",
    "Branch",
    "BranchResult",
    "Circuit",
    "ConvergenceError",
    "Damping",
    "DiagramResult",
    "Drive",
    "EnsembleResult",
    "Examples",
    "Fault",
    "FileError",
    "FrfResult",
    "Gravity",
    "History",
    "Interrupted",
    "JounceError",
    "JumpCurve",
    "JumpsResult",
    "MarchError",
    "Mass",
    "Material",
    "Materials",
    "Modal",
    "ModesResult",
    "OrbitError",
    "Patch",
    "PlantError",
    "Reduction",
    "Run",
    "RunResult",
    "Spec",
    "SpecError",
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
    "__version__",
    "examples",
    "materials",
    "read",
    "spectrum",
    "write_recording",
]


def read(path: str | PathLike[str]) -> Spec:
    """Reads the spec of a harvester from a TOML file."""
    return Spec.read(path)
