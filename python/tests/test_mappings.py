"""Specs, recordings, examples and responses are mappings, as users of dicts expect."""

from collections.abc import Mapping, MutableMapping

import numpy as np
import pytest

import jounce

RIGID = {"at": "beam.tip", "law": "rigid", "gap": "2 mm", "restitution": 0.8}


def test_a_spec_is_a_mutable_mapping_of_its_tables(harvester):
    assert isinstance(harvester, MutableMapping)
    assert list(harvester) == list(harvester.to_dict()) and len(harvester) == len(list(harvester))
    assert all(key in harvester for key in ("stop", "stop.tip", "stop.tip.gap", "run.tolerance"))
    assert "stop.tip.gapp" not in harvester and 0 not in harvester and harvester.get("stop.below") is None
    assert jounce.Spec(dict(harvester)) == harvester and jounce.Spec({**harvester}) == harvester
    assert {"stop.tip", "stop.tip.gap", "run.tolerance"} <= set(harvester._ipython_key_completions_())


def test_a_nested_table_writes_through(harvester):
    tip = harvester["stop.tip"]
    tip["gap"] = "2 mm"
    harvester["stop"]["tip"]["frame"] = "ground"
    assert harvester["stop.tip.gap"] == "2 mm" == harvester["stop"]["tip"]["gap"] and harvester["stop.tip.frame"] == "ground"
    assert isinstance(tip, MutableMapping) and dict(tip) == tip.to_dict() == harvester.to_dict()["stop"]["tip"] == tip
    assert "gap" in tip and "gapp" not in tip and "gap" in tip._ipython_key_completions_() and "'2 mm'" in repr(tip)
    tip.update(gap="3 mm", side="negative")
    assert tip.pop("side") == "negative" and "side" not in list(tip) and harvester.si("stop.tip.gap") == 3e-3
    with pytest.raises(TypeError):
        harvester["damping.ratios"][0] = 0.5


def test_tables_are_assigned_added_and_deleted(harvester):
    harvester["stop.tip"] = RIGID
    harvester["stop.below"] = jounce.Stop(**{**RIGID, "side": "negative"})
    assert list(harvester["stop"]) == ["tip", "below"] and harvester["stop.tip"] == RIGID
    assert "# " in harvester.to_toml() and "[stop.below]" in harvester.to_toml()
    del harvester["stop.below"]
    assert list(harvester["stop"]) == ["tip"]
    harvester["stop"] = {"only": RIGID}
    assert harvester.pop("stop") == {"only": RIGID} and "stop" not in harvester.to_dict()
    harvester["run.tolerance"] = 1e-8
    del harvester["run"]["tolerance"]
    assert "tolerance" not in list(harvester["run"]) and harvester["run.tolerance"] == 1e-7


def test_invalid_changes_of_tables_change_nothing(harvester):
    before = harvester.to_toml()
    for change in (
        lambda: harvester.__delitem__("stop.tip.gap"),
        lambda: harvester["stop.tip"].clear(),
        lambda: harvester["stop.tip"].update(gap="2 mm", gapp="3 mm"),
        lambda: harvester.__setitem__("stop.tip", {**RIGID, "gap": 2}),
        lambda: harvester.__setitem__("stops.tip", RIGID),
        harvester.clear,
    ):
        with pytest.raises(jounce.SpecError):
            change()
    for key in ("stop.below", "stop.tip.gapp", "patch.mfc.strain_limit"):
        with pytest.raises(KeyError, match="such key"):
            del harvester[key]
    with pytest.raises(jounce.ArgumentError, match="expected a value"):
        harvester.set("stop.tip.gap")
    assert harvester.to_toml() == before


def test_a_contact_law_is_changed_in_place(harvester):
    law = {"stop.tip.law": "rigid", "stop.tip.restitution": 0.8}
    with pytest.raises(jounce.SpecError, match=r"stop\.tip\.stiffness"):
        harvester.changed(law)
    rigid = harvester.changed({**law, "stop.tip.stiffness": None})
    assert rigid["stop.tip.law"] == "rigid" and "stiffness" not in list(rigid["stop.tip"])
    assert rigid.changed({"patch.mfc.strain_limit": None}) == rigid


def test_lines_of_faults_are_those_of_the_text_of_the_spec():
    spec = jounce.Spec(jounce.examples()["impact-harvester-2019"].to_dict())
    spec.set({"patch.mfc.strain_limit": 1e-3, "patch.mfc.leakage_resistance": "1 Mohm"})
    with pytest.raises(jounce.SpecError) as excinfo:
        spec.changed({"stop.tip.law": "rigid", "stop.tip.restitution": 0.8})
    (fault,) = excinfo.value.faults
    assert spec.to_toml().splitlines()[fault.line - 1].startswith("stiffness = ")


def test_a_spec_is_made_of_a_spec(harvester):
    copied = jounce.Spec(harvester)
    copied["stop.tip.gap"] = "2 mm"
    assert harvester.si("stop.tip.gap") == 1e-3 and copied.to_toml().startswith(harvester.to_toml()[:40])
    assert jounce.Spec(harvester, stop={"tip": RIGID})["stop.tip"] == RIGID


def test_a_recording_is_a_mapping_of_channels():
    volts = np.sin(np.arange(100.0))
    recording = jounce.Recording.of({"tip": volts, "floor": 2.0 * volts}, 10.0, units="V")
    assert isinstance(recording, Mapping) and list(recording) == ["tip", "floor"] and len(recording) == 2 and recording.samples == 100
    assert "tip" in recording and "wall" not in recording and recording.get("wall") is None and 0 not in recording
    assert {name: values[1] for name, values in recording.items()} == {"tip": volts[1], "floor": 2.0 * volts[1]}
    assert recording._ipython_key_completions_() == ["tip", "floor"] and recording.channel(2) is recording.channel("floor")
    with pytest.raises(KeyError, match="no such channel; use one of tip, floor") as excinfo:
        recording["tap"]
    assert excinfo.value.details["nearest"] == "tip"


@pytest.mark.parametrize("named", [jounce.examples(), jounce.materials(), jounce.examples()["random-base"].noise(points=2)], ids=repr)
def test_other_collections_are_mappings_too(named):
    assert isinstance(named, Mapping) and len(named) == len(list(named)) > 0
    name = next(iter(named))
    assert name in named and named.get("nothing") is None and named._ipython_key_completions_() == list(named)
    with pytest.raises(KeyError):
        named["nothing"]
