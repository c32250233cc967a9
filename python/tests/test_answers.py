"""Answers are those of the command line, bit by bit, and behave as data."""

import json
import os
import pickle
import subprocess

import numpy as np
import pint
import pytest
from conftest import ROOT, SHORT, same

import jounce

FREQUENCY = "drive.shaker.frequency"


def test_limits_that_are_passed_are_told(harvester):
    weak = harvester.changed({**SHORT, "patch.mfc.strain_limit": 1e-6})
    for found in (weak.run(), weak.sweep(FREQUENCY, "10 Hz:11 Hz:2x", fixed_duration=True), weak.basins(starts=2)):
        (text,) = found.warnings
        assert "1 ppm are recommended" in text and text in repr(found)
    assert harvester.changed(SHORT).sweep(FREQUENCY, ["10 Hz"], fixed_duration=True).warnings == []


def test_the_fixed_table_is_every_mass_held(harvester):
    assert harvester.modes(fixed_table=True) == harvester.modes(hold=["table"])
    assert harvester.frf(["2 Hz"], input="beam.hammer", fixed_table=True) == harvester.frf(["2 Hz"], input="beam.hammer", hold="table")


def test_modes_are_those_of_the_command_line(harvester, command_line):
    modes = harvester.modes(hold=["table"])
    told = command_line("modes", "--hold=table")
    same(modes.frequency_hz, [mode["frequency_hz"] for mode in told["modes"]])
    same(modes.damping_ratio, [mode["damping_ratio"] for mode in told["modes"]])
    assert modes.shape.shape == (len(modes.point), len(modes)) and modes.held == ["table"]
    place_m, shape = modes.beams["beam"]
    # The shape along the beam passes through the shape at its named point: 305 mm of 315 mm, read between two of 201 places.
    tip = np.interp(0.305, place_m, shape[0])
    assert tip == pytest.approx(modes.shape[modes.point.index("beam.tip"), 0], rel=1e-5)


def test_frequency_responses_are_those_of_the_command_line(harvester, command_line):
    told = command_line("frf", "--from=2Hz", "--to=20Hz", "--points=2")
    found = harvester.frf(["2 Hz", "20 Hz"])
    assert list(found.responses) == list(told["responses"])
    for name, listed in told["responses"].items():
        same(found[name].real, listed["re"])
        same(found[name].imag, listed["im"])
        assert found.units[name] == listed["unit"]
    assert found == harvester.frf(pint.UnitRegistry().Quantity([2.0, 20.0], "Hz"))


def test_a_sweep_is_that_of_the_command_line(short, command_line):
    told = command_line("sweep", f"--over={FREQUENCY}=10Hz:11Hz:0.5Hz", "--direction=both", "--fixed-duration", keys=SHORT)
    found = short.sweep(FREQUENCY, "10 Hz:11 Hz:0.5 Hz", direction="both", fixed_duration=True)
    for name in ("parameter", "mean_power_w", "voltage_rms_v", "contact_rate_hz", "settled", "period_cycles", "energy_residual_relative"):
        same(getattr(found, name), [point[name] for point in told["points"]])
    assert found.direction == ["up"] * 3 + ["down"] * 3 and found.unit == told["unit"]


def test_values_of_a_sweep_are_taken_in_every_form(short):
    forms = [
        ("10 Hz:11 Hz:0.5 Hz", None),
        (["10 Hz", "10.5 Hz", "11 Hz"], None),
        (np.linspace(10.0, 11.0, 3), "Hz"),
        (np.linspace(10.0, 12.0, 5)[:3:1], "Hz"),
        (pint.UnitRegistry().Quantity(np.linspace(10.0, 11.0, 3), "Hz"), None),
    ]
    found = [short.sweep(FREQUENCY, values, unit=unit, direction="independent", fixed_duration=True) for values, unit in forms]
    for one in found[1:]:
        same(one.mean_power_w, found[0].mean_power_w)


def test_a_sweep_is_the_same_for_any_number_of_threads(short):
    one, three = (short.sweep(FREQUENCY, "10 Hz:11 Hz:5x", direction="independent", fixed_duration=True, threads=n) for n in (1, 3))
    assert one == three and one.manifest == three.manifest


def test_branches_are_those_of_the_command_line(harvester, command_line):
    told = command_line("branch", f"--over={FREQUENCY}=12Hz:13Hz", "--seeds=0")
    found = harvester.branch(FREQUENCY, "12 Hz:13 Hz", seeds=0)
    assert len(found) == len(told["branches"])
    for one, listed in zip(found, told["branches"]):
        assert one.period_cycles == listed["period_cycles"] and one.endings == listed["endings"]
        for name in ("parameter", "mean_power_w", "stable", "stability_undecided", "floquet_max_abs", "contacts_per_period"):
            same(getattr(one, name), [point[name] for point in listed["points"]])
        same(one.bifurcation_parameter, [place["parameter"] for place in listed["bifurcations"]])
    assert len(found.bifurcations_to_pandas()) == sum(len(one.bifurcation_kind) for one in found)


def test_basins_are_those_of_the_command_line(harvester, command_line):
    told = command_line("basins", "--starts=4", "--seed=2")
    found = harvester.basins(starts=4, seed=2)
    assert found.attractor == [one["id"] for one in told["attractors"]]
    same(found.mean_power_w, [one["mean_power_w"] for one in told["attractors"]])
    same(found.fraction, [one["fraction"] for one in told["attractors"]])
    assert found.expected_power_w == told["expected_power_w"] and found.attractor_index.shape == (4,)


def test_basins_of_a_grid_are_those_of_the_command_line(harvester, command_line):
    told = command_line("basins", "--grid=displacement=-1mm:1mm:2x", "--grid=velocity=-0.1m/s:0.1m/s:2x")
    ureg = pint.UnitRegistry()
    sides = {"displacement": "-1 mm:1 mm:2x", "velocity": (ureg("-10 cm/s"), ureg("10 cm/s"), 2)}
    found = harvester.basins(grid=sides)
    same(found.fraction, [one["fraction"] for one in told["attractors"]])
    # The stop's point is bent by 1 mm to both sides; the first side runs fastest.
    assert found.start_displacement_m == pytest.approx([-1e-3, 1e-3, -1e-3, 1e-3], rel=1e-12)
    assert found.start_velocity_m_s == pytest.approx([-0.1, -0.1, 0.1, 0.1], rel=1e-12)


def test_diagrams_are_those_of_the_command_line(harvester, command_line):
    over = "12 Hz:13 Hz:3x"
    told = command_line("diagram", f"--over={FREQUENCY}={over}", "--no-branches")
    found = harvester.diagram(FREQUENCY, over, branches=False)
    for name in ("parameter", "direction", "motion", "period_cycles", "mean_power_w"):
        same(getattr(found, name), [point[name] for point in told["points"]])
    section = [point for visit in told["points"] for point in visit["section"]]
    same(found.section_displacement_m, [point["displacement_m"] for point in section])
    same(np.bincount(found.section_visit), [len(visit["section"]) for visit in told["points"]])


def test_diagrams_from_starts_name_their_attractors(harvester, command_line):
    over = "12 Hz:12.2 Hz:2x"
    told = command_line("diagram", f"--over={FREQUENCY}={over}", "--no-branches", "--direction=starts", "--starts=3")
    found = harvester.diagram(FREQUENCY, over, direction="starts", starts=3, branches=False)
    assert found.attractors == told["attractors"] and len(found.attractors) > 0
    assert [found.attractors[k]["id"] for k in found.attractor_number] == [point["attractor"] for point in told["points"]]


def test_starters_are_those_of_the_command_line(command_line):
    told = command_line("new", spec=None)["kinds"]
    assert jounce.starters() == {one["kind"]: one["summary"] for one in told}
    for kind in jounce.starters():
        spec = jounce.new(kind)
        assert spec.to_toml() == command_line("new", kind, spec=None)["spec"]
        assert spec.modes().frequency_hz.size > 0, kind


def test_the_schema_is_that_of_the_command_line():
    program = os.environ.get("JOUNCE_BIN") or next(p for p in (ROOT / "target/release/jounce", ROOT / "target/debug/jounce") if p.exists())
    told = subprocess.run([program, "schema"], capture_output=True, check=True).stdout
    assert jounce.schema() == json.loads(told) and "stop" in jounce.schema()["properties"]


def test_the_reference_of_keys_is_that_of_the_command_line():
    program = os.environ.get("JOUNCE_BIN") or next(p for p in (ROOT / "target/release/jounce", ROOT / "target/debug/jounce") if p.exists())
    assert jounce.keys() == subprocess.run([program, "keys"], capture_output=True, check=True, text=True).stdout.removesuffix("\n")


def test_responses_to_the_base_are_those_of_the_command_line(command_line):
    spec = ROOT / "examples/unimorph-erturk-2008/harvester.toml"
    told = command_line("frf", "--base", "--from=40Hz", "--to=60Hz", "--points=2", spec=spec)
    found = jounce.read(spec).frf(["40 Hz", "60 Hz"], base=True)
    assert found.input == "base" and list(found.responses) == list(told["responses"])
    for name, listed in told["responses"].items():
        same(found[name].real, listed["re"])
        assert found.units[name] == listed["unit"]


def test_materials_are_those_of_the_command_line(command_line):
    told = {one["name"]: one for one in command_line("materials", spec=None)["materials"]}
    found = jounce.materials()
    assert list(found) == list(told)
    for name, one in found.items():
        assert one.youngs_modulus_pa == told[name]["youngs_modulus_pa"] and one.source == told[name]["source"]
        assert one.charge_coefficient_m_per_v == (told[name]["active"] or {}).get("charge_coefficient_m_per_v")


def test_every_example_is_a_spec():
    for name, spec in jounce.examples().items():
        assert spec.modes().frequency_hz[0] >= 0.0, name


def test_a_spectrum_finds_a_known_line():
    time = np.arange(4000) / 1000.0
    wave = np.stack([3.0 * np.sin(2 * np.pi * 50.0 * time), time])[0][::1]
    wave.flags.writeable = False
    for found in (jounce.spectrum(wave, 1000.0), jounce.spectrum({"data": wave, "name": "u", "unit_str": "V", "time": time})):
        highest = int(found.amplitude_peak.argmax())
        assert found.frequency_hz[highest] == pytest.approx(50.0) and found.amplitude_peak[highest] == pytest.approx(3.0, rel=1e-9)
    strided = jounce.spectrum(np.repeat(wave, 2)[::2], 1000.0)
    assert strided == jounce.spectrum(wave, 1000.0)


def test_results_pickle_compare_and_print(short):
    run = short.run(record="0.5 s")
    modes, frf = short.modes(), short.frf(["1 Hz", "5 Hz"])
    sweep = short.sweep(FREQUENCY, ["10 Hz", "11 Hz"], fixed_duration=True)
    for result in (run, run.history, run.history.spectrum(), modes, frf, sweep):
        again = pickle.loads(pickle.dumps(result))
        assert again == result and repr(again) == repr(result) and "jounce." in repr(result)
        assert result._repr_html_().startswith("<table>")
    assert run == short.run(record="0.5 s"), "the wall time does not count"
    assert run != short.changed({"stop.tip.gap": "2 mm"}).run(record="0.5 s") and run != modes
    assert sweep.manifest["options"]["command"] == "sweep" and sweep.manifest["spec_sha256"] == short.sha256
