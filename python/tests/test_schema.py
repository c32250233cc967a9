"""The JSON Schema of a spec, by an independent validator."""

import tomllib

import jsonschema
import pytest
from conftest import ROOT, SPEC

import jounce

PAPER = SPEC.read_text(encoding="utf-8")


def valid(text):
    return jsonschema.Draft7Validator(jounce.schema()).is_valid(tomllib.loads(text))


def accepted(text):
    try:
        jounce.Spec(text)
    except jounce.JounceError:
        return False
    return True


def test_the_schema_is_draft_07_and_holds_for_the_examples():
    jsonschema.Draft7Validator.check_schema(jounce.schema())
    specs = [*ROOT.glob("examples/*/harvester.toml"), ROOT / "bench/plant.toml"]
    texts = [spec.read_text(encoding="utf-8") for spec in specs] + [jounce.new(kind).to_toml() for kind in jounce.starters()]
    assert len(specs) > 5 and any("[modal." in text for text in texts)
    for text in texts:
        assert valid(text) and valid(jounce.Spec(text).to_toml()), text
    assert not valid('[run]\nduration = "1 s"')


@pytest.mark.parametrize(
    "old, new",
    [
        ('"30 mm"', "30"),
        ('"30 mm"', '"-30 mm"'),
        ('"30 mm"', '"30"'),
        ('"30 mm"', '"mm"'),
        ('law = "hertz"', ""),
        ('law = "hertz"', 'law = "hertzz"'),
        ('law = "hertz"', 'law = "spring"\nexponent = 1.5'),
        ('law = "hertz"', 'law = "rigid"\nrestitution = 0.5'),
        ('law = "hertz"', 'law = "kelvin-voigt"'),
        ('law = "hertz"', 'law = "hertz"\nexponent = 0.5'),
        ('gap = "1 mm"', 'gapp = "1 mm"'),
        ('gap = "1 mm"', "gap = true"),
        ("damping_ratio = 0.3", "damping_ratio = -0.3"),
        ("damping_ratio = 0.3", 'damping_ratio = 0.3\nstiffness = "1 N/m"'),
        ('frequency = "1 Hz"', "frequency = 1"),
        ("modes = 8", "modes = 8.5"),
        ("modes = 8", "modes = 201"),
        ("[mass.table]", '[mass."my table"]'),
        ("[run]", "[runs]"),
    ],
)
def test_the_schema_refuses_what_the_reader_refuses(old, new):
    changed = PAPER.replace(old, new)
    assert changed != PAPER
    assert not valid(changed) and not accepted(changed)


def test_a_patch_of_the_default_section_needs_its_density():
    section, density = 'section = "thin-skin"', 'density = "5440 kg/m^3"'
    laminate = PAPER.replace(section, "")
    assert valid(laminate) and valid(PAPER.replace(density, ""))
    assert not valid(laminate.replace(density, ""))
    assert accepted(PAPER.replace(density, "")) and not accepted(laminate.replace(density, ""))
