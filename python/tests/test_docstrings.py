"""Docstrings of all public objects: sections, defaults, limits, and examples that run."""

import dataclasses
import doctest
import inspect
import json
import re
import subprocess
import sys
import warnings

import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import ROOT

import jounce
from jounce import _core


def public_objects():
    """Yields the name and the object of every public class, method, property and function."""
    for name in jounce.__all__:
        member = getattr(jounce, name)
        if not callable(member):
            continue
        yield name, member
        if inspect.isclass(member):
            for attribute in (one for one in dir(member) if not one.startswith("_")):
                owner = next(base for base in member.__mro__ if attribute in vars(base))
                found = inspect.getattr_static(member, attribute)
                if owner.__module__.startswith("jounce") and isinstance(found, (property, classmethod, staticmethod, type(public_objects))):
                    yield f"{name}.{attribute}", found if isinstance(found, property) else getattr(member, attribute)


OBJECTS = dict(public_objects())


def section(documented, title):
    """Returns the text of a section of a docstring."""
    found = re.search(rf"^{title}\n-+\n(.*?)(?=^\w[\w ]*\n---|\Z)", inspect.getdoc(documented) or "", re.MULTILINE | re.DOTALL)
    return found.group(1) if found else ""


def call_parameters(documented):
    return [one for one in inspect.signature(documented).parameters.values() if one.name not in ("self", "cls")]


@pytest.mark.parametrize("name", OBJECTS)
def test_every_object_has_a_sentence_and_its_sections(name):
    documented = OBJECTS[name]
    assert "\n\n\n" not in documented.__doc__
    first = (inspect.getdoc(documented) or "").split("\n\n")[0]
    assert re.match(r"[A-Z`]", first) and re.search(r"[.:]``?$|\.$", first), first
    if isinstance(documented, property):
        assert documented.fget.__annotations__["return"] != "Any"
        return
    assert section(documented, "Examples").startswith(">>> import jounce\n")
    if dataclasses.is_dataclass(documented) and inspect.isclass(documented):
        attributes = section(documented, "Attributes")
        for field in dataclasses.fields(documented):
            assert re.search(rf"^{field.name} : .+\n    [A-Z`]", attributes, re.MULTILINE), field.name
    if not inspect.isclass(documented):
        for parameter in call_parameters(documented):
            entry = re.search(rf"^\**{parameter.name} : (.+)\n    [A-Z`]", section(documented, "Parameters"), re.MULTILINE)
            assert entry and "Any" not in entry.group(1), parameter.name
        if inspect.signature(documented).return_annotation not in ("None", None):
            assert re.match(r"\S.*\n    [A-Z`]", section(documented, "Returns")), "Returns"


@pytest.mark.parametrize("name", [name for name, one in OBJECTS.items() if callable(one) and not inspect.isclass(one)])
def test_documented_defaults_are_those_of_the_call(name):
    options = {}
    for question in json.loads(_core.questions()):
        if question["python"] == name:
            options = {key: one for one in question["options"] for key in (one["name"], one["argument"].replace("-", "_"))}
    for parameter in call_parameters(OBJECTS[name]):
        kind = re.search(rf"^\**{parameter.name} : (.+)$", section(OBJECTS[name], "Parameters"), re.MULTILINE).group(1)
        default = re.search(r", default (.*)$", kind)
        real = parameter.default
        if real is inspect.Parameter.empty:
            assert default is None and not kind.endswith("optional")
        elif real is None:
            assert default is None or default.group(1) == options[parameter.name]["default"]
        elif real not in ((), ...):
            assert default and default.group(1) == (json.dumps(real) if isinstance(real, str) else str(real))
        library = options.get(parameter.name, {}).get("default", "")
        if library and real not in (None, (), inspect.Parameter.empty):
            assert str(real) == library or float(real) == float(library)


@pytest.mark.parametrize("name", [name for name, one in OBJECTS.items() if not isinstance(one, property)])
def test_examples_run(name, tmp_path, monkeypatch, report):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(jounce, "reproduce", lambda out: report)
    test = doctest.DocTestParser().get_doctest(inspect.getdoc(OBJECTS[name]), {}, name, None, 0)
    assert test.examples
    output = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", jounce.NotSettled)
        doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test, out=output.append)
    plt.close("all")
    assert not output, "".join(output)


def parts(value):
    """Yields the dataclasses in a result, itself included."""
    if dataclasses.is_dataclass(value) and type(value).__module__.startswith("jounce"):
        yield value
        for field in dataclasses.fields(value):
            yield from parts(getattr(value, field.name))
    elif isinstance(value, (list, tuple)):
        for one in value:
            yield from parts(one)


def test_documented_axes_are_those_of_the_arrays(results):
    checked = 0
    for part in (part for result in results for part in parts(result)):
        lengths = {}
        documented = dict(re.findall(r"^(\w+) : .*shape \((.*?),?\)$", section(type(part), "Attributes"), re.MULTILINE))
        for field, axes in documented.items():
            shape = np.shape(getattr(part, field))
            names = axes.split(", ")
            assert len(shape) == len(names), (type(part), field)
            for name, length in zip(names, shape):
                assert lengths.setdefault(name.removeprefix("other_"), length) == length, (type(part), field, name)
            checked += 1
        values = {field.name: getattr(part, field.name) for field in dataclasses.fields(part)}
        arrays = {name for name, value in values.items() if isinstance(value, np.ndarray) and value.dtype != object}
        assert arrays <= documented.keys(), (type(part), arrays - documented.keys())
    assert checked > 300


FREQUENCY = "drive.shaker.frequency"
GAP = "stop.tip.gap"
LIMITED = {
    "Spec.frf.points": {},
    "Spec.branch.harmonics": {"key": FREQUENCY, "range": "11 Hz:11.1 Hz", "method": "harmonic-balance"},
    "Spec.branch.longest_period": {"key": FREQUENCY, "range": "11 Hz:11.1 Hz"},
    "Spec.bifurcations.longest_period": {"key": FREQUENCY, "range": "11 Hz:11.1 Hz", "key_2": GAP, "range_2": "1 mm:2 mm"},
    "Spec.basins.starts": {},
    "Spec.basins.longest_period": {},
    "Spec.diagram.cycles": {"key": FREQUENCY, "range": "11 Hz"},
    "Spec.diagram.longest_period": {"key": FREQUENCY, "range": "11 Hz"},
    "Spec.ensemble.members": {},
    "Spec.rig.bits": {},
    "Spec.sensitivity.starts": {"key": GAP},
    "Spec.design.evaluations": {"problem": {"free": {GAP: "1mm:2mm"}, "goal": {"maximise": "stable-power"}}},
    "measured_modes.order": {"records": jounce.Recording.of({"force": np.eye(1, 999)[0]}, 1e3, units="N")},
}


@pytest.mark.parametrize("limit", LIMITED)
def test_documented_limits_are_those_of_the_call(limit, harvester):
    call, _, name = limit.rpartition(".")
    least, most = map(int, re.search(rf"^{name} : int from (\d+) to (\d+)", section(OBJECTS[call], "Parameters"), re.MULTILINE).groups())
    spec = (harvester,) if call.startswith("Spec.") else ()
    for value in (least - 1, most + 1):
        with pytest.raises(jounce.ArgumentError, match=f"{least} to {most}"):
            OBJECTS[call](*spec, **LIMITED[limit], **{name: value})


def test_every_documented_limit_is_tested():
    calls = [name for name, one in OBJECTS.items() if inspect.isroutine(one)]
    limited = {f"{name}.{one}" for name in calls for one in re.findall(r"^(\w+) : int from", section(OBJECTS[name], "Parameters"), re.M)}
    assert limited == LIMITED.keys()


def test_the_docstrings_equal_those_made_from_the_definitions():
    generated = subprocess.run([sys.executable, "-P", ROOT / "python/docstrings"], capture_output=True, text=True, check=True).stdout
    stored = (ROOT / "python/jounce/docstrings.txt").read_text(encoding="utf-8")
    assert stored == generated, "make them again: python -P python/docstrings > python/jounce/docstrings.txt"
