"""jounce simulates, analyses and designs vibro-impact piezoelectric energy harvesters.

>>> import jounce
>>> harvester = jounce.examples()["impact-harvester-2019"]
>>> harvester["stop.tip.gap"] = "0.5 mm"
>>> run = harvester.run(tolerance=1e-8)
>>> print(run.mean_power_w, run.settled)  # doctest: +SKIP
"""

import sys as _sys
from importlib import import_module as _import_module
from typing import TYPE_CHECKING as _TYPE_CHECKING

from ._core import VERSION as __version__
from ._docstrings import document as _document

if _TYPE_CHECKING:
    from ._basins import BasinsResult
    from ._bifurcations import BifurcationCurve, BifurcationsResult
    from ._branch import Branch, BranchResult
    from ._chips import Chip, Chips, chips
    from ._cite import Citation, CiteResult
    from ._contact import ContactResult, ForceTable, Pulse, contact
    from ._design import DesignResult
    from ._diagram import DiagramResult
    from ._elements import (
        Beam,
        Circuit,
        Damping,
        Device,
        Drive,
        Gravity,
        Layer,
        Mass,
        Modal,
        Patch,
        Plate,
        Reduction,
        Regulator,
        Run,
        Source,
        Stop,
    )
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
    from ._import import ImportResult, from_matrices, import_matrices
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
    from ._restitution import RestitutionResult, restitution
    from ._run import RunResult
    from ._saved import load, rerun
    from ._segments import SegmentsResult, segments
    from ._sensitivity import SensitivityResult
    from ._signal import Spectrum, spectrum, write_recording
    from ._spec import Spec, read
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
    "Chip",
    "Chips",
    "Circuit",
    "Citation",
    "CiteResult",
    "ContactResult",
    "ConvergenceError",
    "Damping",
    "DesignError",
    "DesignResult",
    "Device",
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
    "ForceTable",
    "FrfResult",
    "Gravity",
    "History",
    "ImpactHit",
    "ImportResult",
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
    "Plate",
    "PlantError",
    "PointsWithoutResult",
    "PowerResult",
    "Pulse",
    "RecordedFile",
    "Recording",
    "RecordingError",
    "Reduction",
    "Regulator",
    "ReproduceResult",
    "RestitutionResult",
    "Run",
    "RunResult",
    "SegmentsResult",
    "SensitivityResult",
    "Source",
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
    "chips",
    "contact",
    "examples",
    "explore",
    "from_matrices",
    "import_matrices",
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
    "rerun",
    "restitution",
    "schema",
    "segments",
    "spectra",
    "spectrum",
    "starters",
    "write_recording",
]

#: Public names of each module; a module is imported when one of them is used.
_MODULES = {
    "_basins": "BasinsResult",
    "_bifurcations": "BifurcationCurve BifurcationsResult",
    "_branch": "Branch BranchResult",
    "_chips": "Chip Chips chips",
    "_cite": "Citation CiteResult",
    "_contact": "ContactResult ForceTable Pulse contact",
    "_design": "DesignResult",
    "_diagram": "DiagramResult",
    "_elements": "Beam Circuit Damping Device Drive Gravity Layer Mass Modal Patch Plate Reduction Regulator Run Source Stop",
    "_ensemble": "EnsembleResult",
    "_errors": (
        "ArgumentError ConvergenceError DesignError ExploreError Fault FileError FitError IntegrationError Interrupted "
        "JounceError NotSettled OrbitError PlantError PointsWithoutResult RecordingError SpecError StartError "
        "StructureError StudyError UnknownKeyError"
    ),
    "_examples": "Examples examples",
    "_explore": "Explorer explore",
    "_fit": "FitCurve FitDeviation FitResult",
    "_frf": "FrfResult",
    "_history": "History",
    "_import": "ImportResult from_matrices import_matrices",
    "_issue": "Issue",
    "_materials": "Material Materials materials",
    "_measured_frf": "ImpactHit MeasuredFrf measured_frf",
    "_measured_modes": "MeasuredModes measured_modes",
    "_modes": "ModesResult",
    "_noise": "NoiseResult",
    "_power": "PowerResult power",
    "_recorded_file": "ModeShape RecordedFile read_recordings",
    "_recording": "Channel Recording",
    "_reproduce": "ReproduceResult reproduce",
    "_restitution": "RestitutionResult restitution",
    "_run": "RunResult",
    "_saved": "load rerun",
    "_segments": "SegmentsResult segments",
    "_sensitivity": "SensitivityResult",
    "_signal": "Spectrum spectrum write_recording",
    "_spec": "Spec read",
    "_spectra": "SpectraResult spectra",
    "_starters": "keys new schema starters",
    "_state": "State",
    "_study": "Study",
    "_study_result": "StudyResult StudyStatus StudyTable",
    "_sweep": "SweepResult",
}
_MODULE_OF = {name: module for module, names in _MODULES.items() for name in names.split()}


if not _TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        """Imports the module of a public name; the computations on a harvester are methods."""
        if name in _MODULE_OF:
            _import_module(f".{_MODULE_OF[name]}", __name__)
            _add_loaded()
            return globals()[name]
        hint = f"; it is a method of a harvester: harvester.{name}(...)" if hasattr(__getattr__("Spec"), name) else ""
        raise AttributeError(f"jounce has no {name!r}{hint}")

    def __dir__() -> list[str]:
        return [name for name in globals() if name.startswith("_")] + __all__

    def _add_loaded() -> None:
        """Adds the public names of all loaded modules, with their docstrings."""
        for module, names in _MODULES.items():
            loaded = _sys.modules.get(f"{__name__}.{module}")
            for public in names.split() if loaded else ():
                if public not in globals() and hasattr(loaded, public):
                    globals()[public] = getattr(loaded, public)
                    _document(globals()[public])
