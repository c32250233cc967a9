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


def test_a_run_is_that_of_the_command_line(short, command_line):
    answer = short.run(tolerance=1e-8)
    told = command_line("run", "--tolerance=1e-8", keys=SHORT)
    for name in (
        "mean_power_w",
        "max_penetration_m",
        "max_contact_force_n",
        "contacts",
        "contact_duty",
        "energy_residual_relative",
        "settled",
    ):
        assert getattr(answer, name) == told[name], name
    assert answer.voltage_rms_v == told["voltage_rms_v"] and answer.work == told["work"]
    assert answer.energies_j["damping_j"] == told["energies"]["damping_j"]
    assert answer.mean_power_w > 0.0 and abs(answer.energy_residual_relative) < 1e-6
    (tip,) = told["stops"]
    assert answer.stop == [tip["name"]] and answer.stop_contacts[0] == tip["contacts"]
    for name in ("contact_rate_hz", "mean_strike_m_s", "max_strike_m_s", "mean_dwell_s", "max_dwell_s", "impulse_n_s"):
        assert getattr(answer, f"stop_{name}")[0] == tip[name], name
    # The time in contact is that of so many contacts.
    assert answer.stop_mean_dwell_s[0] * answer.contacts == pytest.approx(answer.contact_duty * answer.average_over_s, rel=1e-9)
    assert not answer.nothing_happened and not told["nothing_happened"] and answer.stop_mean_strike_m_s[0] > 0.0


def test_leakage_of_a_patch_is_told_and_closes_the_balance(short, command_line):
    keys = {"patch.mfc.leakage_resistance": "2 Mohm"}
    answer, told = short.changed(keys).run(), command_line("run", keys={**SHORT, **keys})
    (leak,) = told["leaks"]
    assert answer.leak == [leak["patch"]] and answer.leak_power_w[0] == leak["mean_power_w"]
    # Load and leakage see one voltage: 1 Mohm takes twice what 2 Mohm takes.
    assert answer.leak_power_w[0] == pytest.approx(0.5 * answer.load_power_w[0], rel=1e-9)
    left = answer.energies_j["input_j"] - sum(value for name, value in answer.energies_j.items() if name != "input_j")
    assert abs(left) < 1e-6 * answer.energies_j["input_j"]
    assert "leakage (mfc)" in repr(answer) and "leak" in answer.to_xarray().dims and len(answer.plot_energy().patches) == 5


def test_a_run_in_which_nothing_happens_says_so(short):
    assert short.changed({"drive.shaker.amplitude": "0 N"}).run().nothing_happened


def test_limits_that_are_passed_are_told(harvester):
    weak = harvester.changed({**SHORT, "patch.mfc.strain_limit": 1e-6})
    for found in (weak.run(), weak.sweep(FREQUENCY, "10 Hz:11 Hz:2x", fixed_duration=True), weak.basins(starts=2)):
        (text,) = found.warnings
        assert "1 ppm are recommended" in text and text in repr(found)
    assert harvester.changed(SHORT).sweep(FREQUENCY, ["10 Hz"], fixed_duration=True).warnings == []


def test_the_fixed_table_is_every_mass_held(harvester):
    assert harvester.modes(fixed_table=True) == harvester.modes(hold=["table"])
    assert harvester.frf(["2 Hz"], input="beam.hammer", fixed_table=True) == harvester.frf(["2 Hz"], input="beam.hammer", hold="table")


def test_a_run_goes_on_from_the_end_of_another(short, tmp_path):
    half = short.changed({"run.duration": "1 s"})
    first = half.run(tolerance=1e-10)
    first.end.write(tmp_path / "half.json")
    again = half.run(tolerance=1e-10, start=jounce.State.read(tmp_path / "half.json"))
    whole = short.run(tolerance=1e-10)
    # Two ways of stepping through the same two seconds differ by the tolerance.
    assert again.mean_power_w == pytest.approx(whole.mean_power_w, rel=1e-8)


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
        for name in ("parameter", "mean_power_w", "stable", "floquet_max_abs", "contacts_per_period"):
            same(getattr(one, name), [point[name] for point in listed["points"]])
        same(one.bifurcation_parameter, [place["parameter"] for place in listed["bifurcations"]])
    assert len(found.bifurcations_to_pandas()) == sum(len(one.bifurcation_kind) for one in found)


def test_basins_are_those_of_the_command_line(harvester, command_line):
    told = command_line("basins", "--starts=4", "--seed=2")
    found = harvester.basins(starts=4, seed=2)
    assert found.attractor == [one["id"] for one in told["attractors"]]
    same(found.mean_power_w, [one["mean_power_w"] for one in told["attractors"]])
    same(found.fraction, [one["fraction"] for one in told["attractors"]])
    assert found.expected_power_w == told["expected_power_w"] and found.ends_in.shape == (4,)


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


def test_a_record_is_the_motion_of_the_run(short):
    answer = short.run(record="1 s", sample_rate="2000 Hz")
    history = answer.recorded()
    assert history.time_s.shape == (2001,) and history.time_s[-1] == pytest.approx(2.0, abs=1e-12)
    assert history.displacement_m.shape == (len(history.point), 2001) and history.voltage_v.shape == (1, 2001)
    # Mean power is voltage squared over resistance; the trapezoidal rule of the samples is off by a few per mille at impacts.
    assert np.trapezoid(history.voltage_v[0] ** 2, history.time_s) / 1e6 == pytest.approx(answer.mean_power_w, rel=0.01)
    # Velocity is the derivative of displacement.
    tip = history.point.index("beam.tip")
    slope = np.gradient(history.displacement_m[tip], history.time_s)
    assert np.abs(slope - history.velocity_m_s[tip]).max() < 0.05 * np.abs(history.velocity_m_s[tip]).max()
    # Once per cycle, ending with the run.
    assert np.diff(history.strobed_time_s) == pytest.approx(1.0 / 11.0) and history.strobed_time_s[-1] == 2.0
    assert (history.force_n >= 0.0).all() and history.force_n.max() <= answer.max_contact_force_n * (1.0 + 1e-9)


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


def test_a_recording_drives_the_harvester_as_the_sine_that_it_is_of(tmp_path):
    tables = {key: table for key, table in jounce.examples()["impact-harvester-2019"].to_dict().items() if key != "stop"}
    tables["run"] = {"duration": "4 s", "average_over": "1 s", "tolerance": 1e-10}
    sine = {"shaker": jounce.Drive(at="table", amplitude="50 N", frequency="11 Hz")}
    series = {"name": "force", "unit_str": "N", "fs": 20000.0, "data": 50.0 * np.sin(2 * np.pi * 11.0 * np.arange(0.0, 4.1, 1 / 20000.0))}
    jounce.write_recording(tmp_path / "force.csv", series)
    recorded = {"shaker": jounce.Drive(at="table", signal="recording", file=str(tmp_path / "force.csv"), scale="1 N")}
    # Straight lines between 1818 samples of a cycle lower a sine by 1e-6 of itself, and its power by 2e-6.
    power, again = (jounce.Spec({**tables, "drive": drive}).run().mean_power_w for drive in (sine, recorded))
    assert again == pytest.approx(power, rel=1e-5)
    # A file beside the spec is found from there, and after the way through pickle.
    (tmp_path / "beside.toml").write_text(jounce.Spec({**tables, "drive": recorded}).to_toml().replace(f"{tmp_path}/", ""))
    beside = jounce.read(tmp_path / "beside.toml")
    assert pickle.loads(pickle.dumps(beside)).changed({"run.average_over": "1 s"}).run().mean_power_w == again


def test_history_in_the_form_of_sep005(short):
    channels = short.run(record="0.1 s").history.to_sep005()
    voltage = next(channel for channel in channels if channel["name"] == "mfc.voltage")
    assert voltage["unit_str"] == "V" and voltage["fs"] == 4096.0 and len(voltage["data"]) == len(voltage["time"])
    assert jounce.spectrum(voltage).name == "mfc.voltage"


def test_a_rectified_circuit_is_that_of_the_command_line(command_line):
    spec = ROOT / "examples/rectified-shu-lien-2006/harvester.toml"
    keys = {"run.duration": "600 s", "run.average_over": "300 s"}
    answer = jounce.read(spec).changed(keys).run()
    told = command_line("run", keys=keys, spec=spec)
    (circuit,) = told["rectified"]
    assert answer.rectified == [circuit["name"]] and answer.load == []
    for name in ("mean_power_w", "voltage_rms_v", "mean_current_a", "storage_w", "diode_loss_w", "switch_loss_w", "leakage_w"):
        field = {"mean_power_w": "power_w", "mean_current_a": "current_a"}.get(name, name)
        assert getattr(answer, f"rectified_{field}")[0] == circuit[name], name
    assert answer.mean_power_w == told["mean_power_w"] > 0.0 and answer.rectified_diode_loss_w[0] > 0.0
    (charge,) = told["charges"]
    for name in ("passed_c", "load_c", "leakage_c", "storage_c", "residual_relative"):
        assert getattr(answer, f"rectified_charge_{name}")[0] == charge[name], name
    # What the diodes passed is their mean current over the window, and nothing of it is lost: off by 2e-11.
    assert answer.rectified_charge_passed_c[0] == pytest.approx(answer.rectified_current_a[0] * answer.average_over_s, rel=1e-12)
    assert abs(answer.rectified_charge_residual_relative[0]) < 1e-9
    (flows,) = told["energies"]["rectified"]
    assert answer.energies_j["rectified_j"] == flows["load_j"] + flows["battery_j"]
    # What goes in comes out, is lost or stays.
    left = answer.energies_j["input_j"] - sum(value for name, value in answer.energies_j.items() if name != "input_j")
    assert abs(left) < 1e-9 * answer.energies_j["input_j"]
    dataset = answer.to_xarray()
    assert dataset.rectified_voltage_rms.sel(rectified="rectifier") == circuit["voltage_rms_v"]
    assert pickle.loads(pickle.dumps(answer)) == answer and "storage" in repr(answer)
    assert len(answer.plot_energy().patches) == 6
