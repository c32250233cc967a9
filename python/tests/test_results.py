"""Results equal those of the command line, bit by bit, and behave as data."""

import dataclasses
import json
import os
import pickle
import subprocess
from pathlib import Path

import numpy as np
import pint
import pytest
from conftest import ROOT, SHORT, assert_identical

import jounce
from jounce._result import Result

FREQUENCY = "drive.shaker.frequency"


def test_exceeded_limits_are_reported(harvester):
    weak = harvester.changed({**SHORT, "drive.shaker.amplitude": "20 N", "patch.mfc.strain_limit": 1e-6})
    for result in (weak.run(), weak.sweep(FREQUENCY, "10 Hz:11 Hz:2x", fixed_duration=True), weak.basins(starts=2)):
        (text,) = result.warnings
        assert "its limit is 1 ppm" in text and text in repr(result)
    assert harvester.changed(SHORT).sweep(FREQUENCY, ["10 Hz"], fixed_duration=True).warnings == []


def test_the_fixed_table_holds_every_mass(harvester):
    def results(**held):
        both = harvester.modes(**held), harvester.frf(["2 Hz"], input="beam.hammer", **held)
        return [dataclasses.replace(result, manifest={}) for result in both]

    assert results(fixed_table=True) == results(hold="table")


def test_modes_are_those_of_the_command_line(harvester, command_line):
    modes = harvester.modes(hold=["table"])
    expected = command_line("modes", "--hold=table")
    assert_identical(modes.frequency_hz, [mode["frequency_hz"] for mode in expected["modes"]])
    assert_identical(modes.damping_ratio, [mode["damping_ratio"] for mode in expected["modes"]])
    assert modes.shape.shape == (len(modes.point), len(modes)) and modes.held == ["table"]
    place_m, shape = modes.beams["beam"]
    # The shape along the beam passes through the shape at its named point: 305 mm of 315 mm, read between two of 201 places.
    tip = np.interp(0.305, place_m, shape[0])
    assert tip == pytest.approx(modes.shape[modes.point.index("beam.tip"), 0], rel=1e-5)


def test_frequency_responses_are_those_of_the_command_line(harvester, command_line):
    expected = command_line("frf", "--low=2Hz", "--high=20Hz", "--points=2")
    result = harvester.frf(["2 Hz", "20 Hz"])
    assert list(result.responses) == list(expected["responses"])
    for name, expected_item in expected["responses"].items():
        assert_identical(result[name].real, expected_item["re"])
        assert_identical(result[name].imag, expected_item["im"])
        assert result.units[name] == expected_item["unit"]
    assert result == harvester.frf(pint.UnitRegistry().Quantity([2.0, 20.0], "Hz"))


def test_a_sweep_is_that_of_the_command_line(short, command_line):
    keys = {key: value for key, value in SHORT.items() if key != FREQUENCY}
    expected = command_line("sweep", f"--over={FREQUENCY}=10Hz:11Hz:0.5Hz", "--direction=both", "--fixed-duration", keys=keys)
    result = short.sweep(FREQUENCY, "10 Hz:11 Hz:0.5 Hz", direction="both", fixed_duration=True)
    for name in ("parameter", "mean_power_w", "voltage_rms_v", "contact_rate_hz", "settled", "period_cycles", "energy_residual_relative"):
        assert_identical(getattr(result, name), [point[name] for point in expected["points"]])
    assert result.direction == ["up"] * 3 + ["down"] * 3 and result.unit == expected["unit"]


def test_values_of_a_sweep_are_accepted_in_every_form(short):
    forms = [
        ("10 Hz:11 Hz:0.5 Hz", None),
        (["10 Hz", "10.5 Hz", "11 Hz"], None),
        (np.linspace(10.0, 11.0, 3), "Hz"),
        (np.linspace(10.0, 12.0, 5)[:3:1], "Hz"),
        (pint.UnitRegistry().Quantity(np.linspace(10.0, 11.0, 3), "Hz"), None),
    ]
    result = [short.sweep(FREQUENCY, values, unit=unit, direction="independent", fixed_duration=True) for values, unit in forms]
    for one in result[1:]:
        assert_identical(one.mean_power_w, result[0].mean_power_w)


def test_a_sweep_is_the_same_for_any_number_of_threads(short):
    one, three = (short.sweep(FREQUENCY, "10 Hz:11 Hz:5x", direction="independent", fixed_duration=True, threads=n) for n in (1, 3))
    assert one == three and one.manifest == three.manifest


def test_branches_are_those_of_the_command_line(harvester, command_line):
    expected = command_line("branch", f"--over={FREQUENCY}=12Hz:13Hz", "--seeds=0")
    result = harvester.branch(FREQUENCY, "12 Hz:13 Hz", seeds=0)
    assert len(result) == len(expected["branches"])
    for one, expected_item in zip(result, expected["branches"]):
        assert one.period_cycles == expected_item["period_cycles"] and one.termination == expected_item["termination"]
        for name in ("parameter", "mean_power_w", "stable", "stability_undecided", "floquet_max_abs", "contacts_per_period"):
            assert_identical(getattr(one, name), [point[name] for point in expected_item["points"]])
        assert_identical(one.bifurcation_parameter, [place["parameter"] for place in expected_item["bifurcations"]])
    assert result.peak == expected["peak"] and result.half_power_bandwidth == expected["half_power_bandwidth"] and result.note
    assert len(result.bifurcations_to_pandas()) == sum(len(one.bifurcation_kind) for one in result)


def test_basins_are_those_of_the_command_line(harvester, command_line):
    expected = command_line("basins", "--starts=4", "--seed=2")
    result = harvester.basins(starts=4, seed=2)
    assert result.attractor == [one["id"] for one in expected["attractors"]]
    assert_identical(result.mean_power_w, [one["mean_power_w"] for one in expected["attractors"]])
    assert_identical(result.fraction, [one["fraction"] for one in expected["attractors"]])
    assert result.expected_power_w == expected["expected_power_w"] and result.attractor_index.shape == (4,)


def test_basins_of_a_grid_are_those_of_the_command_line(harvester, command_line):
    expected = command_line("basins", "--grid=displacement=-1mm:1mm:2x", "--grid=velocity=-0.1m/s:0.1m/s:2x")
    ureg = pint.UnitRegistry()
    sides = {"displacement": "-1 mm:1 mm:2x", "velocity": (ureg("-10 cm/s"), ureg("10 cm/s"), 2)}
    result = harvester.basins(grid=sides)
    assert_identical(result.fraction, [one["fraction"] for one in expected["attractors"]])
    # The stop's point is bent by 1 mm to both sides; the first side runs fastest.
    assert result.start_displacement_m == pytest.approx([-1e-3, 1e-3, -1e-3, 1e-3], rel=1e-12)
    assert result.start_velocity_m_s == pytest.approx([-0.1, -0.1, 0.1, 0.1], rel=1e-12)


def test_diagrams_are_those_of_the_command_line(harvester, command_line):
    over = "12 Hz:13 Hz:3x"
    expected = command_line("diagram", f"--over={FREQUENCY}={over}", "--no-branches")
    result = harvester.diagram(FREQUENCY, over, branches=False)
    for name in ("parameter", "direction", "motion", "period_cycles", "mean_power_w"):
        assert_identical(getattr(result, name), [point[name] for point in expected["points"]])
    section = [point for visit in expected["points"] for point in visit["section"]]
    assert_identical(result.section_displacement_m, [point["displacement_m"] for point in section])
    assert_identical(np.bincount(result.section_point), [len(visit["section"]) for visit in expected["points"]])


def test_diagrams_from_starts_name_their_attractors(harvester, command_line):
    over = "12 Hz:12.2 Hz:2x"
    expected = command_line("diagram", f"--over={FREQUENCY}={over}", "--no-branches", "--direction=starts", "--starts=3")
    result = harvester.diagram(FREQUENCY, over, direction="starts", starts=3, branches=False)
    assert result.attractors == expected["attractors"] and len(result.attractors) > 0
    assert result.attractor == [point["attractor"] for point in expected["points"]]


def test_starters_are_those_of_the_command_line(command_line):
    expected = command_line("new", spec=None)["kinds"]
    assert jounce.starters() == {one["kind"]: one["summary"] for one in expected}
    for kind in jounce.starters():
        spec = jounce.new(kind)
        assert spec.to_toml() == command_line("new", kind, spec=None)["spec"]
        assert spec.modes().frequency_hz.size > 0, kind


def test_the_schema_is_that_of_the_command_line():
    program = os.environ.get("JOUNCE_BIN") or next(p for p in (ROOT / "target/release/jounce", ROOT / "target/debug/jounce") if p.exists())
    expected = subprocess.run([program, "schema"], capture_output=True, check=True).stdout
    assert jounce.schema() == json.loads(expected) and "stop" in jounce.schema()["properties"]


def test_the_reference_of_keys_is_that_of_the_command_line():
    program = os.environ.get("JOUNCE_BIN") or next(p for p in (ROOT / "target/release/jounce", ROOT / "target/debug/jounce") if p.exists())
    assert jounce.keys() == subprocess.run([program, "keys"], capture_output=True, check=True, text=True).stdout.removesuffix("\n")


def test_responses_to_the_base_are_those_of_the_command_line(command_line):
    spec = ROOT / "examples/unimorph-erturk-2008/harvester.toml"
    expected = command_line("frf", "--base", "--low=40Hz", "--high=60Hz", "--points=2", spec=spec)
    result = jounce.read(spec).frf(["40 Hz", "60 Hz"], base=True)
    assert result.input == "base" and list(result.responses) == list(expected["responses"])
    for name, expected_item in expected["responses"].items():
        assert_identical(result[name].real, expected_item["re"])
        assert result.units[name] == expected_item["unit"]


def test_materials_are_those_of_the_command_line(command_line):
    expected = {one["name"]: one for one in command_line("materials", spec=None)["materials"]}
    result = jounce.materials()
    assert list(result) == list(expected)
    for name, one in result.items():
        assert one.youngs_modulus_pa == expected[name]["youngs_modulus_pa"] and one.source == expected[name]["source"]
        assert one.charge_coefficient_m_per_v == (expected[name]["active"] or {}).get("charge_coefficient_m_per_v")


def test_chips_are_those_of_the_command_line(command_line):
    expected = {one["name"]: one for one in command_line("materials", spec=None)["chips"]}
    assert {name: dataclasses.asdict(one) for name, one in jounce.chips().items()} == expected


def test_every_example_is_a_spec():
    for name, spec in jounce.examples().items():
        assert spec.modes().frequency_hz[0] >= 0.0, name


def test_a_spectrum_finds_a_known_line():
    time = np.arange(4000) / 1000.0
    wave = np.stack([3.0 * np.sin(2 * np.pi * 50.0 * time), time])[0][::1]
    wave.flags.writeable = False
    for result in (jounce.spectrum(wave, 1000.0), jounce.spectrum({"data": wave, "name": "u", "unit_str": "V", "time": time})):
        highest = int(result.amplitude_peak.argmax())
        assert result.frequency_hz[highest] == pytest.approx(50.0) and result.amplitude_peak[highest] == pytest.approx(3.0, rel=1e-9)
    strided = jounce.spectrum(np.repeat(wave, 2)[::2], 1000.0)
    assert strided == jounce.spectrum(wave, 1000.0)


def test_results_pickle_compare_and_print(short):
    run = short.run(record="0.5 s")
    modes, frf = short.modes(), short.frf(["1 Hz", "5 Hz"])
    sweep = short.sweep(FREQUENCY, ["10 Hz", "11 Hz"], fixed_duration=True)
    for result in (run, run.history, run.history.spectrum(), modes, frf, sweep):
        restored = pickle.loads(pickle.dumps(result))
        assert restored == result and repr(restored) == repr(result) and "jounce." in repr(result)
        assert result._repr_html_().startswith("<table>")
    assert run == short.run(record="0.5 s"), "the wall time does not count"
    assert run != short.changed({"stop.tip.gap": "2 mm"}).run(record="0.5 s") and run != modes
    assert sweep.manifest["options"]["command"] == "sweep" and sweep.manifest["spec_sha256"] == short.sha256


def test_every_class_of_results_is_saved_and_becomes_a_tree(results, tmp_path):
    public = [getattr(jounce, name) for name in jounce.__all__]
    restitution = jounce.restitution("steel", "brass", radius="5 mm", mass="4 g", speed="1 m/s")
    results = [*results, jounce.examples()["impact-harvester-2019"].cite(), restitution]
    assert {type(result) for result in results} == {one for one in public if isinstance(one, type) and issubclass(one, Result)}
    for result in results:
        result.save(tmp_path / "result.jounce")
        assert jounce.load(tmp_path / "result.jounce") == result
        assert json.loads(result.to_datatree().attrs["manifest"]) == result.manifest
        if result._call is not None:
            assert jounce.rerun(tmp_path / "result.jounce") == result, result._call


def test_a_saved_result_is_made_again_from_its_call(short, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    harvester = jounce.Spec(short)
    run = harvester.run(record="0.5 s", progress=False)
    harvester["stop.tip.gap"] = "2 mm"
    run.save("run.jounce")
    assert jounce.rerun("run.jounce") == run, "a later change of the spec does not change the call"
    start = harvester.run(start=run.end)
    start.save("start.jounce")
    assert jounce.rerun("start.jounce") == start
    recording = harvester.rig(at="beam.tip", seed=3)
    recording.save("rig.jounce")
    assert jounce.rerun("rig.jounce") == recording
    recording.write("rec.csv")
    power = jounce.read_recordings("rec.csv").over_time.power("100 kohm")
    power.save("power.jounce")
    assert jounce.rerun("power.jounce") == power, "the recording is in the file"
    channels = jounce.read_recordings("rec.csv")
    channels.save("channels.jounce")
    assert jounce.rerun("channels.jounce") == channels


def test_results_that_cannot_be_made_again_are_named(short, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run = short.run(record="0.5 s")
    run.history.save("history.jounce")
    with pytest.raises(jounce.FileError, match=r"history\.jounce: the file has no record of its call"):
        jounce.rerun("history.jounce")
    modes = short.modes()
    other = dataclasses.replace(modes, frequency_hz=2 * modes.frequency_hz)
    object.__setattr__(other, "_call", modes._call)
    other.save("other.jounce")
    with pytest.raises(jounce.FileError, match=r"different: frequency_hz; computed with jounce\.Spec\.modes\(Spec\)") as caught:
        jounce.rerun("other.jounce")
    assert caught.value.details["field"] == "frequency_hz"
    short.rig().write("rec.csv")
    file = jounce.read_recordings("rec.csv")
    file.save("file.jounce")
    with Path("rec.csv").open("a") as added:
        added.write("\n")
    with pytest.raises(jounce.FileError, match=r"rec\.csv: the file has changed"):
        jounce.rerun("file.jounce")
    Path("rec.csv").unlink()
    with pytest.raises(jounce.FileError, match=r"rec\.csv: there is no such file"):
        jounce.rerun("file.jounce")
