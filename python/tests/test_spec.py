"""Specs: read, built, changed, written."""

import copy
import pickle
import re

import numpy as np
import pint
import pytest
from conftest import ROOT, SPEC, SYSTEM

import jounce


def test_a_spec_is_read_from_file_text_dict_and_objects(harvester):
    text = SPEC.read_text()
    tables = harvester.to_dict()
    objects = {**tables, "stop": {"tip": jounce.Stop(**tables["stop"]["tip"])}}
    for spec in (jounce.Spec(text), jounce.Spec(tables), jounce.Spec(**objects), jounce.Spec(tables, stop=objects["stop"])):
        assert spec == harvester and spec.sha256 == harvester.sha256
    assert jounce.examples()[SYSTEM] == harvester


def test_there_is_an_element_for_every_table_of_a_spec():
    tables_of_reference = re.findall(r"^## `\[(\w+)(?:\.NAME)?\]`", (ROOT / "book/src/keys.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert len(tables_of_reference) > 5
    for table in tables_of_reference:
        element_type = getattr(jounce, table.capitalize())
        assert issubclass(element_type, dict) and element_type(a=1) == {"a": 1}


def test_keywords_replace_a_table(harvester):
    tip = jounce.Stop(at="beam.tip", law="spring", gap="2 mm", stiffness="1 kN/m")
    assert jounce.Spec(harvester.to_dict(), stop={"tip": tip})["stop.tip.law"] == "spring"


def test_a_key_is_set_and_comments_stay(harvester):
    harvester.set("stop.tip.gap", "0.5 mm")
    assert harvester["stop.tip.gap"] == "0.5 mm" and harvester.si("stop.tip.gap") == 0.5e-3 and harvester.unit("stop.tip.gap") == "m"
    harvester["drive.shaker.frequency"] = "11 Hz"
    harvester.set({"damping.ratios": np.full(7, 0.01), "reduction.modes": 8})
    assert harvester["damping.ratios"] == (0.01,) * 7
    assert "# where the stop is struck" in harvester.to_toml()


def test_defaults_are_read_through_keys(harvester):
    assert harvester["run.tolerance"] == 1e-7
    with pytest.raises(KeyError):
        harvester["stop.tip.colour"]


def test_a_changed_copy_leaves_the_original(harvester):
    other = harvester.changed({"stop.tip.gap": "2 mm"})
    assert other != harvester and harvester.si("stop.tip.gap") == 1e-3
    twin = copy.deepcopy(harvester)
    twin["stop.tip.gap"] = "3 mm"
    assert harvester.si("stop.tip.gap") == 1e-3


@pytest.mark.parametrize(
    ("key", "quantity", "si"),
    [
        ("stop.tip.gap", "0.5 mm", 0.5e-3),
        ("drive.shaker.amplitude", "50 N", 50.0),
        ("drive.shaker.frequency", "660 / minute", 11.0),
        ("beam.beam.density", "2750 kg/m**3", 2750.0),
        ("patch.mfc.d31", "-170 pC/N", -170e-12),
        ("circuit.load.resistance", "1 Mohm", 1e6),
        ("patch.mfc.capacitance", "177 nF", 177e-9),
    ],
)
def test_quantities_of_pint_are_accepted(harvester, key, quantity, si):
    harvester[key] = pint.UnitRegistry()(quantity)
    assert harvester.si(key) == pytest.approx(si, rel=1e-15)


def test_a_contact_stiffness_of_pint_keeps_its_fractional_power(harvester):
    harvester["stop.tip.stiffness"] = pint.UnitRegistry()("2000 N/m**1.5")
    assert harvester.si("stop.tip.stiffness") == 2000.0


def test_a_spec_is_written_and_read_again(harvester, tmp_path):
    harvester["stop.tip.gap"] = "0.5 mm"
    harvester.write(tmp_path / "a.toml")
    assert jounce.read(tmp_path / "a.toml") == harvester
    assert jounce.Spec(harvester.to_toml(canonical=True)) == harvester


def test_specs_and_elements_pickle_and_print(harvester):
    assert pickle.loads(pickle.dumps(harvester)) == harvester
    drive = jounce.Drive(at="table", amplitude="1 N", frequency="2 Hz")
    assert pickle.loads(pickle.dumps(drive)) == drive and repr(drive).startswith("Drive(at='table'")
    assert "stop.tip" in repr(harvester) and "gap = 1 mm" in repr(harvester)
    html = harvester._repr_html_()
    assert "<svg" in html and "<table>" in html and "1 mm" in html


def test_unusual_names_survive_toml_and_invalid_ones_are_refused():
    keys = {"mass": "12 kg", "frequency": "1 Hz", "damping_ratio": 0.3}
    for name in ("my-table_2", "7", "true", "e5"):
        assert jounce.Spec({"mass": {name: keys}}).to_dict() == {"mass": {name: keys}}
    for name in ("my table", 'a"b', "a.b", "", "tischplättchen"):
        with pytest.raises(jounce.SpecError, match="use the letters"):
            jounce.Spec({"mass": {name: keys}})


def test_examples_are_named_after_their_system_and_file():
    examples = jounce.examples()
    assert examples["random-base"] == jounce.read(ROOT / "examples/random-base/harvester.toml")
    assert examples["random-base/ball"] == jounce.read(ROOT / "examples/random-base/ball.toml")
