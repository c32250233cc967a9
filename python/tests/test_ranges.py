"""One grammar of ranges and units for all calls."""

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr
from conftest import assert_identical

import jounce

FREQUENCY = "drive.shaker.frequency"
UREG = pint.UnitRegistry()
HZ = np.linspace(10.0, 11.0, 3)

#: The same three frequencies with their units, or with the unit that the call is given.
FORMS = {
    "step": ("10 Hz:11 Hz:0.5 Hz", None),
    "number": ("10 Hz:11 Hz:3x", None),
    "text with unit=": ("10:11:0.5", "Hz"),
    "text list": ("10 Hz,10.5 Hz,11 Hz", None),
    "list": (["10 Hz", "10.5 Hz", "11 Hz"], None),
    "array": (HZ, "Hz"),
    "array with a unit of pint": (HZ, UREG.Hz),
    "index": (pd.Index(HZ), "Hz"),
    "series": (pd.Series(HZ), UREG.Hz),
    "pint": (UREG.Quantity(HZ * 1e-3, "kHz"), None),
    "xarray": (xr.DataArray(HZ, attrs={"units": "Hz"}), None),
    "xarray of pint": (xr.DataArray(UREG.Quantity(HZ, "Hz")), None),
    "list of pint": ([hz * UREG.Hz for hz in HZ], None),
}


@pytest.mark.parametrize("form", FORMS)
def test_every_call_accepts_every_form_of_values(form, short):
    values, unit = FORMS[form]
    sweep = short.sweep(FREQUENCY, values, unit=unit, direction="independent", fixed_duration=True)
    assert sweep.parameter == pytest.approx(HZ, rel=1e-12)
    assert short.frf(values, unit=unit).frequency_hz == pytest.approx(HZ, rel=1e-12)
    study = jounce.Study(short, {FREQUENCY: values}, units={FREQUENCY: unit})
    assert [study.point(k)[0] for k in range(len(study))] == pytest.approx(HZ, rel=1e-12)
    diagram = short.diagram(FREQUENCY, values, unit=unit, direction="up", cycles=1, branches=False)
    assert diagram.parameter == pytest.approx(HZ, rel=1e-12)


@pytest.mark.parametrize(
    ("ends", "unit"),
    [
        ("12 Hz:13 Hz", None),
        ("12:13", "Hz"),
        (("12 Hz", "13 Hz"), None),
        (np.array([12.0, 13.0]), UREG.Hz),
        (pd.Index([12.0, 13.0]), "Hz"),
        (UREG.Quantity([12.0, 13.0], "Hz"), None),
        (xr.DataArray([12.0, 13.0], attrs={"units": "Hz"}), None),
    ],
)
def test_continuous_ranges_have_two_ends_in_every_form(harvester, ends, unit):
    branches = harvester.branch(FREQUENCY, ends, unit=unit, seeds=0)
    assert branches.branches == harvester.branch(FREQUENCY, "12 Hz:13 Hz", seeds=0).branches


def test_sides_of_a_grid_have_the_same_forms(harvester):
    text = harvester.basins(grid={"displacement": "-1 mm:1 mm:3x", "velocity": "-0.1 m/s:0.1 m/s:3x"})
    arrays = harvester.basins(
        grid={"displacement": UREG.Quantity(np.linspace(-1.0, 1.0, 3), "mm"), "velocity": np.linspace(-0.1, 0.1, 3)},
        units={"velocity": UREG("m/s").units},
    )
    assert_identical(text.attractor_index, arrays.attractor_index)


@pytest.mark.parametrize(
    ("values", "unit", "words"),
    [
        (xr.DataArray(HZ, attrs={"units": "Hz"}), "kHz", "is in Hz, but kHz is given"),
        (np.ma.masked_array(HZ, [False, True, False]), "Hz", "value 1 is masked"),
        (pd.date_range("2024-01-01", periods=2), None, "an array of datetime64"),
        (HZ + 1j, "Hz", "an array of complex128"),
        (HZ, 3, "unit is of type int"),
        ([], "Hz", "list of values is empty"),
        ([["10 Hz"]], None, "without nested lists"),
    ],
)
def test_unclear_ranges_are_refused(harvester, values, unit, words):
    for call in (harvester.frf, lambda values, unit: harvester.sweep(FREQUENCY, values, unit=unit)):
        with pytest.raises(jounce.ArgumentError, match=words):
            call(values, unit=unit)
    with pytest.raises(jounce.ArgumentError, match="is not a continuous range"):
        harvester.branch(FREQUENCY, HZ, unit="Hz")
    with pytest.raises(jounce.ArgumentError, match="evenly spaced"):
        harvester.basins(grid={"velocity": ["0 m/s", "1 m/s", "3 m/s"]})


@pytest.mark.parametrize(
    ("key", "quantity", "text"),
    [
        ("circuit.load.resistance", UREG("100 kohm"), "100.0 kΩ"),
        ("stop.tip.gap", UREG("0.5 mm"), "0.5 mm"),
        ("drive.shaker.frequency", UREG("660 / minute"), "660.0 1/min"),
        ("stop.tip.gap", UREG("0.1 inch"), "0.00254 m"),
        ("stop.tip.gap", np.float64(0.5) * UREG.mm, "0.5 mm"),
    ],
)
def test_a_quantity_of_pint_keeps_its_unit(harvester, key, quantity, text):
    harvester[key] = quantity
    assert harvester[key] == text and jounce.Spec(harvester.to_toml())[key] == text
    assert harvester.si(key) == pytest.approx(quantity.to_base_units().magnitude, rel=1e-14)


def test_grams_are_no_acceleration(harvester):
    with pytest.raises(jounce.SpecError, match="is a mass"):
        harvester["gravity.acceleration"] = UREG("5 g")
    harvester["gravity.acceleration"] = UREG("1 standard_gravity")
    assert harvester.si("gravity.acceleration") == 9.80665


def test_a_number_without_a_unit_gets_all_candidates_and_no_guess(harvester):
    with pytest.raises(jounce.SpecError, match="0.001 has no unit; expected a length in quotes with a unit: mm, um, cm, m$"):
        harvester["stop.tip.gap"] = 0.001


def test_a_sweep_over_the_number_of_modes_is_computed_point_by_point(short):
    sweep = short.sweep("reduction.modes", [2, 4, 8], fixed_duration=True)
    assert sweep.direction == ["independent"] * 3 and list(sweep.parameter) == [2, 4, 8]
    for modes, power_w in zip((2, 4, 8), sweep.mean_power_w):
        assert power_w == short.changed({"reduction.modes": modes}).sweep(FREQUENCY, ["11 Hz"], fixed_duration=True).mean_power_w[0]


def test_the_direction_of_a_point_is_that_of_the_step_to_it(short):
    def directions(values, direction):
        return short.sweep(FREQUENCY, values, unit="Hz", direction=direction, fixed_duration=True).direction

    assert directions([13, 12], "up") == ["down", "down"] and directions([13, 12], "both") == ["down"] * 2 + ["up"] * 2
    assert directions([12, 13, 12.5], "up") == ["up", "up", "down"] and directions([12, 13], "down") == ["down", "down"]
    assert directions([12], "up") == ["up"] and directions([12], "down") == ["down"]
