"""Texts of parameters that are no options of a question; those of options come from the questions of the library."""

from __future__ import annotations

from pathlib import Path
from typing import Final

#: Type and meaning by name, or by ``CALL.NAME`` where a name has several meanings.
PARAMETERS: Final[dict[str, tuple[str, str]]] = {
    "ax": ("matplotlib Axes", "Axes to draw into; by default new ones."),
    "base": ("recording", "Recorded motion that moves the base for its duration, instead of the drives."),
    "browser": ("bool", "``True`` opens the page in the browser, the default outside notebooks and without ``proxy``."),
    "canonical": ("bool", "``True`` includes every key that applies, with its default."),
    "channel": ("str", "Name of a channel; by default the first one."),
    "curve": ("str", "Name of a curve, ``FitCurve.name``; by default the first one."),
    "default": ("object", "Value for a key that the spec does not have; by default an error."),
    "density": ("str", "Name of an output in ``densities``; by default the first one."),
    "direction": ("str", 'Direction of the points: ``"up"``, ``"down"`` or ``"independent"``.'),
    "executor": (
        "concurrent.futures.Executor",
        "Executor for the parts: a process pool or Dask's; by default all threads of this process.",
    ),
    "folder": ("path", "Folder of a study."),
    "frequency_hz": ("array", "Frequencies of the samples, Hz; the values are then accelerations per force."),
    "function": ("str", "Name of a function in ``function``; by default the first one."),
    "high_hz": ("float", "Upper end of the band, Hz."),
    "hits": ("int", "Largest number of pulses in the figure."),
    "index": ("int", "Number of the point, from 0."),
    "key": ("str", 'Key of the spec, as in ``"stop.tip.gap"``.'),
    "key_2": ("str", "Second key of the spec."),
    "keys": ("dict", "New values by key; ``None`` removes a key."),
    "kind": ("str", "Kind of harvester, one of :func:`starters`."),
    "label": ("str", "Label of the curve in a legend."),
    "listen": ("str", 'Address of the server, ``"ADDRESS:PORT"``; by default a free port of this machine.'),
    "low_hz": ("float", "Lower end of the band, Hz."),
    "model": ("Spec", "Harvester whose attractors are matched to the segments; by default none."),
    "modes": ("int", "Number of modes in the figure."),
    "name": ("str", "Name."),
    "options": ("keywords", "Options of the function of this name in the package."),
    "other": ("dict", "New values by key."),
    "out": ("path", "Folder of the study; it is created if missing."),
    "path": ("path", "Name of the file."),
    "point": ("str", "Name of a point; by default the first one."),
    "points": ("int", "Number of drawn points, for a sampling that draws them."),
    "points_per_part": ("int", "Number of points of a part, which one process computes and writes in one file."),
    "progress": (
        "bool or callable",
        "``True`` shows a bar; a callable gets the number of finished parts, their total and the remaining time, s (``None`` "
        "where unknown). By default nothing is reported.",
    ),
    "quantity": ("str", "Quantity to draw, one of ``quantities``; by default the first one."),
    "range": (
        "str, list or array",
        'Values of the key: ``"10 Hz:14 Hz:0.5 Hz"`` (step), ``"10 Hz:14 Hz:9x"`` (number), ``"1 kohm:1 Mohm:9log"``, or quantities, or '
        "numbers with their ``unit``.",
    ),
    "record": ("recording", "Recording, file, SEP005 time series, or array with its ``sample_rate_hz``."),
    "records": ("recording or list of them", "Recordings, files, SEP005 time series, or arrays with their ``sample_rate_hz``."),
    "resistance": ("str or quantity (resistance)", 'Resistance of the load, as in ``"100 kohm"``.'),
    "response": ("str", "Name of a response; by default the first one."),
    "sample_rate_hz": ("float or quantity (frequency)", "Sampling rate, Hz, of samples without times."),
    "seed": ("int", "Seed of the drawn points."),
    "spec": ("path", "Path of the spec, which the command line needs."),
    "start": ("State", "State to start from, the ``end`` of another run; by default that of the spec."),
    "style": ("keywords", 'Properties of lines of matplotlib: ``color="k"``, ``linestyle=":"``.'),
    "time_s": ("array", "Times of the samples, s; they are checked for jitter and gaps."),
    "title": ("str", "Title of the drawing."),
    "to": ("path or dict", "File of features, or a dict with its contents."),
    "unit": ("str or pint unit", "Unit of the values of ``range`` that are numbers without one."),
    "unit_2": ("str or pint unit", "Unit of the values of ``range_2`` that are numbers without one."),
    "units": ("dict", "Unit of each key or side whose values are numbers without one."),
    "value": ("object", "Text with a unit, quantity, number, or a table; ``None`` removes the key."),
    "values": ("array", "Samples at even steps, or a time series in the form of SEP005."),
    "Drive.recording": ("recording", "Samples in memory, with their times and unit, or with ``sample_rate`` and ``unit``."),
    "Recording.segments.drive": ("str or quantity (frequency)", 'Frequency of the drive, ``"13 Hz"``.'),
    "Recording.channel.name": ("str or int", "Name of the channel, or its number from 1."),
    "Recording.of.allow_missing": ("bool", "``True`` accepts NaN and masked samples as missing; by default they are refused."),
    "Recording.of.name": ("str", "Name of the recording."),
    "Recording.of.units": (
        "str or dict",
        'Unit of one array, or of each channel: ``"g"``, ``"m/s2"``, ``"lbf"``; values are converted to SI.',
    ),
    "Recording.of.values": (
        "array, dict of them, or time series",
        "Samples, by channel, or time series in the form of SEP005, or a history.",
    ),
    "Spec.basins.grid": (
        "dict",
        'Plane or box of starts instead of the cloud: ``{"displacement": "-5 mm:5 mm:21x", "velocity": ("-1 m/s", "1 m/s", 21)}``, and '
        '``"voltage"``; a side may also be an array of evenly spaced values.',
    ),
    "Spec.bifurcations.range": ("str or pair", 'Range of the first key, ``"12 Hz:13 Hz"``, or a pair of quantities.'),
    "Spec.bifurcations.range_2": ("str or pair", "Range of the second key."),
    "Spec.branch.range": (
        "str or pair",
        'Range of the key, ``"12 Hz:13 Hz"``, or a pair of quantities, or of numbers with their ``unit``.',
    ),
    "Spec.frf.frequency": ("str, list or array", "Frequencies, a range as in :meth:`sweep`, instead of a band."),
    "Spec.frf.unit": ("str or pint unit", "Unit of the values of ``frequency`` that are numbers without one."),
    "Spec.rig.solution": (
        "str or list",
        'Solutions of the model as starts, by their ids in :meth:`basins`: ``["1a", ("3a", "42 s")]`` changes to another one at a time of '
        "the record. By default the run of the spec.",
    ),
    "Spec.set.key": ("str or dict", "Key or table, or several with their values."),
    "Spec.update.keys": ("keywords", "Further values by name of a table."),
    "Spec.tables": ("tables", 'Tables by keyword, ``stop={"tip": jounce.Stop(at="beam.tip", ...)}``; they replace those of a dict.'),
    "explore.height": ("int", "Height of the frame of a notebook, pixels."),
    "explore.proxy": (
        "str",
        "Address of a proxy in the browser, with ``{port}`` for the port of the server, "
        '``"https://hub.example.org/user/me/proxy/{port}/"``; by default none.',
    ),
    "explore.harvester": ("Spec or path", "Harvester, or the file of its spec, which the page can then save."),
    "problem": ("path or dict", "Design file without the key ``spec``, or a dict with the same contents."),
    "Spec.design.progress": ("bool or callable", "Reports the number of evaluated designs; their total is not known and reported as 0."),
    "Spec.fit.progress": ("bool or callable", "Reports the number of computed models; their total is not known and reported as 0."),
    "FitResult.curve.name": ("str", "Name of the curve; by default the first one."),
    "History.channel.name": ("str", "Name of the channel, one of :meth:`channels`; by default the first one."),
    "DiagramResult.section.quantity": ("str", "Quantity of the section, one of ``quantities``."),
    "spectrum.name": ("str", "Name of the signal in figures."),
    "spectrum.unit": ("str", "Unit of the samples in figures."),
    "BranchResult.plot_branch.quantity": ("str", "Field of a branch along ``point``; by default the mean power."),
}

#: Least and largest value of the counts of a call.
LIMITS: Final[dict[str, tuple[int, int]]] = {
    "Spec.frf.points": (2, 1_000_000),
    "Spec.branch.harmonics": (4, 2048),
    "Spec.branch.longest_period": (1, 2**32 - 1),
    "Spec.bifurcations.longest_period": (1, 2**32 - 1),
    "Spec.basins.starts": (1, 100_000_000),
    "Spec.basins.longest_period": (1, 2**32 - 1),
    "Spec.diagram.cycles": (1, 100_000),
    "Spec.diagram.longest_period": (1, 2**32 - 1),
    "Spec.ensemble.members": (1, 1_000_000),
    "Spec.rig.bits": (2, 32),
    "Spec.sensitivity.starts": (1, 100_000_000),
    "Spec.design.evaluations": (1, 2**32 - 1),
    "measured_modes.order": (2, 400),
}

#: Page of the book that describes a call, a method or a class.
PAGES: Final[dict[str, str]] = {
    "Spec.modes": "howto/linear.md",
    "Spec.frf": "howto/linear.md",
    "Spec.noise": "howto/linear.md",
    "Spec.run": "howto/run.md",
    "Spec.sweep": "howto/sweep.md",
    "Spec.branch": "howto/branches.md",
    "Spec.bifurcations": "howto/branches.md",
    "Spec.diagram": "howto/branches.md",
    "Spec.basins": "howto/branches.md",
    "Spec.ensemble": "howto/drives.md",
    "Spec.rig": "howto/measured.md",
    "Spec.fit": "howto/measured.md",
    "Spec.sensitivity": "howto/design.md",
    "Spec.design": "howto/design.md",
    "Spec": "spec.md",
    "Study": "howto/studies.md",
    "Study.run": "howto/studies.md",
    "StudyResult": "howto/studies.md",
    "contact": "howto/measured.md",
    "explore": "howto/explore.md",
    "keys": "keys.md",
    "measured_frf": "howto/measured.md",
    "measured_modes": "howto/measured.md",
    "new": "howto/new.md",
    "power": "howto/measured.md",
    "read": "spec.md",
    "read_recordings": "howto/measured.md",
    "reproduce": "validation.md",
    "segments": "howto/measured.md",
    "spectra": "howto/measured.md",
}

#: Errors of a call besides ArgumentError.
RAISES: Final[dict[str, tuple[str, ...]]] = {
    "Spec.modes": ("StructureError",),
    "Spec.frf": ("StructureError", "PlantError"),
    "Spec.noise": ("PlantError",),
    "Spec.run": ("IntegrationError", "StartError", "Interrupted"),
    "Spec.sweep": ("IntegrationError", "Interrupted"),
    "Spec.branch": ("OrbitError", "ConvergenceError", "Interrupted"),
    "Spec.bifurcations": ("OrbitError", "ConvergenceError", "Interrupted"),
    "Spec.diagram": ("OrbitError", "Interrupted"),
    "Spec.basins": ("OrbitError", "Interrupted"),
    "Spec.ensemble": ("IntegrationError", "Interrupted"),
    "Spec.rig": ("IntegrationError", "RecordingError"),
    "Spec.fit": ("FitError", "Interrupted"),
    "Spec.sensitivity": ("OrbitError", "Interrupted"),
    "Spec.design": ("SpecError", "DesignError", "FileError", "Interrupted"),
    "Spec.read": ("SpecError", "FileError"),
    "Spec.set": ("SpecError",),
    "Spec.changed": ("SpecError",),
    "Spec.update": ("SpecError",),
    "Spec.clear": ("SpecError",),
    "Spec.pop": ("UnknownKeyError", "SpecError"),
    "Spec.popitem": ("SpecError",),
    "Spec.si": ("UnknownKeyError", "SpecError"),
    "Spec.unit": ("UnknownKeyError", "SpecError"),
    "Spec.write": ("FileError",),
    "State.read": ("StartError",),
    "State.write": ("FileError",),
    "Study.read": ("FileError", "SpecError"),
    "Study.run": ("StudyError", "FileError", "Interrupted"),
    "StudyStatus.read": ("StudyError",),
    "RunResult.recorded": ("ArgumentError",),
    "contact": ("RecordingError",),
    "measured_frf": ("RecordingError",),
    "measured_modes": ("RecordingError", "ConvergenceError"),
    "power": ("RecordingError",),
    "read": ("SpecError", "FileError"),
    "read_recordings": ("FileError", "RecordingError"),
    "reproduce": ("FileError", "Interrupted"),
    "segments": ("RecordingError", "Interrupted"),
    "spectra": ("RecordingError",),
    "spectrum": ("ArgumentError",),
    "write_recording": ("FileError", "ArgumentError"),
    "new": ("UnknownKeyError",),
    "explore": ("ExploreError",),
}


def _examples() -> dict[str, list[str]]:
    """Returns the lines of each example by the name of its object; a method continues the example of its class."""
    text = Path(__file__).with_name("examples.txt").read_text(encoding="utf-8")
    blocks = (block.strip().split("\n") for block in f"\n{text}".split("\n==== ")[1:])
    return {name: lines for name, *lines in blocks}


EXAMPLES: Final = _examples()
