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
        ('"30 mm"', '"30 kg"'),
        ('"30 mm"', '"30 mmm"'),
        ('"30 mm"', '"0 mm"'),
        ('"200 N"', '"200 mm"'),
        ('at = "table"\nkind = "force"', 'kind = "base-displacement"'),
        ('law = "hertz"', 'law = "cubic"\ncubic_stiffness = "-1 N"'),
        ('start = "rest"', 'start = "rset"'),
        ('d31 = "-170 pC/N"', 'd31 = "-170 pC/N"\nd33 = "400 pC/N"'),
    ],
)
def test_the_schema_refuses_what_the_reader_refuses(old, new):
    changed = PAPER.replace(old, new)
    assert changed != PAPER
    assert not valid(changed) and not accepted(changed)


@pytest.mark.parametrize(
    "old, new",
    [
        ('"30 mm"', '"30mm"'),
        ('"30 mm"', '" +3.e1 mm "'),
        ('"30 mm"', '"0.030 m"'),
        ('"30 mm"', '"30000 \u00b5m"'),
        ('"30 mm"', '"3 dam kN/MN"'),
        ('"13 Hz"', '"780 1/min"'),
        ('"13 Hz"', '"13 /s"'),
        ('"13 Hz"', '"13 s^-1"'),
        ('"200 N"', '"200 kg m/s^2"'),
        ('"200 N"', '"0 N"'),
        ('"1 Mohm"', '"1 M\u03a9"'),
        ('"1 Mohm"', '"1 V/\u00b5A"'),
        ('gap = "1 mm"', 'gap = "\u22121e\u22123 m"'),
        ('kind = "force"\namplitude = "200 N"', 'kind = "base-acceleration"\namplitude = "2 g"'),
        ('kind = "force"\namplitude = "200 N"', 'kind = "base-displacement"\namplitude = "2 mm"'),
        ('stiffness = "1000 N/m^1.5"', 'stiffness = "1000 Pa"\nexponent = 2.0'),
        ('start = "rest"', 'start = "linear"'),
    ],
)
def test_the_schema_accepts_what_the_reader_accepts(old, new):
    changed = PAPER.replace(old, new).replace('at = "table"\nkind = "base', 'at = "ground"\nkind = "base')
    assert changed != PAPER
    assert valid(changed) and accepted(changed)


def test_a_patch_of_the_default_section_needs_its_density():
    section, density = 'section = "thin-skin"', 'density = "5440 kg/m^3"'
    laminate = PAPER.replace(section, "")
    assert valid(laminate) and valid(PAPER.replace(density, ""))
    assert not valid(laminate.replace(density, ""))
    assert accepted(PAPER.replace(density, "")) and not accepted(laminate.replace(density, ""))
