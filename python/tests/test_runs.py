"""A run: that of the command line, bit by bit, its balances and its record."""

import pickle

import numpy as np
import pytest
from conftest import ROOT, SHORT

import jounce


def test_a_run_is_that_of_the_command_line(short, command_line):
    result = short.run(tolerance=1e-8)
    expected = command_line("run", "--tolerance=1e-8", keys=SHORT)
    for name in (
        "mean_power_w",
        "max_penetration_m",
        "max_contact_force_n",
        "contacts",
        "contact_duty",
        "energy_residual_relative",
        "settled",
    ):
        assert getattr(result, name) == expected[name], name
    assert (
        result.voltage_rms_v == expected["voltage_rms_v"]
        and result.voltage_peak_v == expected["voltage_peak_v"]
        and result.work == expected["work"]
    )
    assert result.energies_j["damping_j"] == expected["energies"]["damping_j"]
    assert result.mean_power_w > 0.0 and abs(result.energy_residual_relative) < 1e-6
    (tip,) = expected["stops"]
    assert result.stop == [tip["name"]] and result.stop_contacts[0] == tip["contacts"]
    for name in (
        "contact_rate_hz",
        "mean_impact_velocity_m_s",
        "max_impact_velocity_m_s",
        "mean_contact_duration_s",
        "max_contact_duration_s",
        "impulse_n_s",
    ):
        assert getattr(result, f"stop_{name}")[0] == tip[name], name
    # The time in contact is that of so many contacts.
    assert result.stop_mean_contact_duration_s[0] * result.contacts == pytest.approx(result.contact_duty * result.average_over_s, rel=1e-9)
    assert not result.is_trivial and not expected["is_trivial"] and result.stop_mean_impact_velocity_m_s[0] > 0.0


def test_the_peak_voltage_is_that_of_the_record(short, command_line):
    result = short.run(record="1 s", sample_rate="50 kHz")
    last = result.history.time_s > 2.0 - (result.period_cycles if result.settled else 8) / 11.0
    highest = np.abs(result.history.voltage_v[0][last]).max()
    assert 0.0 <= 1.0 - highest / result.voltage_peak_v < 1e-5 and result.voltage_peak_v > result.voltage_rms_v
    assert result.load_voltage_peak_v == result.patch_voltage_peak_v and "voltage, peak (load)" in repr(result)
    expected, plain = command_line("run", keys=SHORT), short.run()
    (patch,) = expected["patches"]
    assert patch == {"name": "mfc", "voltage_peak_v": plain.voltage_peak_v, "strain_peak": plain.patch_strain_peak[0]}
    assert plain.point == [point["name"] for point in expected["points"]] and "displacement, peak" in repr(plain)
    assert list(plain.point_displacement_peak_m) == [point["displacement_peak_m"] for point in expected["points"]]
    assert expected["loads"][0]["voltage_peak_v"] == plain.load_voltage_peak_v[0]
    # A run that keeps a record stops where the record starts: the same motion in other steps.
    assert plain.voltage_peak_v == pytest.approx(result.voltage_peak_v, rel=1e-12)
    chirp = short.to_toml().replace('frequency = "11 Hz"', 'signal = "chirp"\nfrom = "9 Hz"\nto = "12 Hz"\nduration = "2 s"')
    run_without_record = jounce.Spec(chirp).run()
    assert run_without_record.voltage_peak_v is None and "peak (load)" not in repr(run_without_record)
    assert jounce.Spec(chirp).run(record="1 s").voltage_peak_v > 0.0


def test_leakage_of_a_patch_is_reported_and_closes_the_balance(short, command_line):
    keys = {"patch.mfc.leakage_resistance": "2 Mohm"}
    result, expected = short.changed(keys).run(), command_line("run", keys={**SHORT, **keys})
    (leak,) = expected["leaks"]
    assert result.leak == [leak["name"]] and result.leak_mean_power_w[0] == leak["mean_power_w"]
    # Load and leakage see one voltage: 1 Mohm takes twice what 2 Mohm takes.
    assert result.leak_mean_power_w[0] == pytest.approx(0.5 * result.load_mean_power_w[0], rel=1e-9)
    residual = result.energies_j["input_j"] - sum(value for name, value in result.energies_j.items() if name != "input_j")
    assert abs(residual) < 1e-6 * result.energies_j["input_j"]
    assert "leakage (mfc)" in repr(result) and "leak" in result.to_xarray().dims and len(result.plot_energy().patches) == 5


def test_a_run_without_motion_is_trivial(short):
    assert short.changed({"drive.shaker.amplitude": "0 N"}).run().is_trivial


def test_a_run_continues_from_the_end_of_another(short, tmp_path):
    half = short.changed({"run.duration": "1 s"})
    first = half.run(tolerance=1e-10)
    first.end.write(tmp_path / "half.json")
    repeated = half.run(tolerance=1e-10, start=jounce.State.read(tmp_path / "half.json"))
    full_run = short.run(tolerance=1e-10)
    # Two ways of stepping through the same two seconds differ by the tolerance.
    assert repeated.mean_power_w == pytest.approx(full_run.mean_power_w, rel=1e-8)


def test_a_record_is_the_motion_of_the_run(short):
    result = short.run(record="1 s", sample_rate="2000 Hz")
    history = result.recorded()
    assert history.time_s.shape == (2001,) and history.time_s[-1] == pytest.approx(2.0, abs=1e-12)
    assert history.displacement_m.shape == (len(history.point), 2001) and history.voltage_v.shape == (1, 2001)
    # Mean power is voltage squared over resistance; the trapezoidal rule of the samples is off by a few per mille at impacts.
    assert np.trapezoid(history.voltage_v[0] ** 2, history.time_s) / 1e6 == pytest.approx(result.mean_power_w, rel=0.01)
    # Velocity is the derivative of displacement.
    tip = history.point.index("beam.tip")
    slope = np.gradient(history.displacement_m[tip], history.time_s)
    assert np.abs(slope - history.velocity_m_s[tip]).max() < 0.05 * np.abs(history.velocity_m_s[tip]).max()
    # Once per cycle, ending with the run.
    assert np.diff(history.poincare_time_s) == pytest.approx(1.0 / 11.0) and history.poincare_time_s[-1] == 2.0
    assert (history.force_n >= 0.0).all() and history.force_n.max() <= result.max_contact_force_n * (1.0 + 1e-9)


def test_a_recording_drives_the_harvester_like_the_recorded_sine(tmp_path):
    tables = {key: table for key, table in jounce.examples()["impact-harvester-2019"].to_dict().items() if key != "stop"}
    tables["run"] = {"duration": "4 s", "average_over": "1 s", "tolerance": 1e-10}
    sine = {"shaker": jounce.Drive(at="table", amplitude="50 N", frequency="11 Hz")}
    series = {"name": "force", "unit_str": "N", "fs": 20000.0, "data": 50.0 * np.sin(2 * np.pi * 11.0 * np.arange(0.0, 4.1, 1 / 20000.0))}
    jounce.write_recording(tmp_path / "force.csv", series)
    recorded = {"shaker": jounce.Drive(at="table", signal="recording", file=str(tmp_path / "force.csv"))}
    # Straight lines between 1818 samples of a cycle lower a sine by 1e-6 of itself, and its power by 2e-6.
    power, repeated = (jounce.Spec({**tables, "drive": drive}).run().mean_power_w for drive in (sine, recorded))
    assert repeated == pytest.approx(power, rel=1e-5)
    # A file beside the spec is found from there, and after the way through pickle.
    (tmp_path / "beside.toml").write_text(jounce.Spec({**tables, "drive": recorded}).to_toml().replace(f"{tmp_path}/", ""))
    relative_spec = jounce.read(tmp_path / "beside.toml")
    assert pickle.loads(pickle.dumps(relative_spec)).changed({"run.average_over": "1 s"}).run().mean_power_w == repeated


def test_history_in_the_form_of_sep005(short):
    channels = short.run(record="0.1 s").history.to_sep005()
    voltage = next(channel for channel in channels if channel["name"] == "mfc.voltage")
    assert voltage["unit_str"] == "V" and voltage["fs"] == 4096.0 and len(voltage["data"]) == len(voltage["time"])
    assert jounce.spectrum(voltage).name == "mfc.voltage"


def test_a_rectified_circuit_is_that_of_the_command_line(command_line):
    spec = ROOT / "examples/rectified-shu-lien-2006/harvester.toml"
    keys = {"run.duration": "600 s", "run.average_over": "300 s"}
    result = jounce.read(spec).changed(keys).run()
    expected = command_line("run", keys=keys, spec=spec)
    (circuit,) = expected["rectified"]
    assert result.rectified == [circuit["name"]] and result.load == []
    for name in ("mean_power_w", "voltage_rms_v", "mean_current_a", "storage_w", "diode_loss_w", "switch_loss_w", "leakage_w"):
        assert getattr(result, f"rectified_{name}")[0] == circuit[name], name
    assert result.mean_power_w == expected["mean_power_w"] > 0.0 and result.rectified_diode_loss_w[0] > 0.0
    (charge,) = expected["charges"]
    for name in ("passed_c", "load_c", "leakage_c", "storage_c", "residual_relative"):
        assert getattr(result, f"charge_{name}")[0] == charge[name], name
    # What the diodes passed is their mean current over the window, and nothing of it is lost: off by 2e-11.
    assert result.charge_passed_c[0] == pytest.approx(result.rectified_mean_current_a[0] * result.average_over_s, rel=1e-12)
    assert abs(result.charge_residual_relative[0]) < 1e-9
    (flows,) = expected["energies"]["rectified"]
    assert result.energies_j["rectified_j"] == flows["load_j"] + flows["battery_j"]
    # What goes in comes out, is lost or stays.
    residual = result.energies_j["input_j"] - sum(value for name, value in result.energies_j.items() if name != "input_j")
    assert abs(residual) < 1e-9 * result.energies_j["input_j"]
    dataset = result.to_xarray()
    assert dataset.rectified_voltage_rms.sel(rectified="rectifier") == circuit["voltage_rms_v"]
    assert pickle.loads(pickle.dumps(result)) == result and "storage" in repr(result)
    assert len(result.plot_energy().patches) == 6


def test_a_device_behind_a_regulator_is_that_of_the_command_line(command_line):
    spec = ROOT / "examples/wireless-sensor/harvester.toml"
    keys = {"run.duration": "40 s", "run.average_over": "20 s"}
    harvester = jounce.read(spec).changed(keys)
    result = harvester.run(record="20 s", sample_rate="10 Hz")
    expected = command_line("run", keys=keys, spec=spec)
    (device,), (circuit,) = expected["devices"], expected["rectified"]
    assert result.device == ["store"] and 0.0 < device["on_fraction"] < 1.0
    names = ("cold_start_s", "on_fraction", "starts", "longest_outage_s", "completed_tasks", "interrupted_tasks")
    for name in (*names, "energy_per_day_j", "available_w", "needed_w", "margin_w"):
        assert getattr(result, f"device_{name}")[0] == device[name], name
    assert result.rectified_regulator_loss_w[0] == circuit["regulator_loss_w"] > 0.0
    residual = result.energies_j["input_j"] - sum(value for name, value in result.energies_j.items() if name != "input_j")
    assert abs(residual) < 1e-9 * result.energies_j["input_j"]
    voltage, unit = result.recorded().channels()["store.storage"]
    assert unit == "V" and 3.6 < voltage.max() < 5.1
    assert "a regulator switches" in repr(result) and "margin" in repr(result)
    assert result.to_xarray().device_margin.sel(device="store") == device["margin_w"]
    never = harvester.changed({"circuit.store.storage": "10 mF"}).run()
    assert np.isnan(never.device_cold_start_s[0]) and "never starts" in never.warnings[0]


def test_an_ensemble_has_the_time_on_of_a_device():
    keys = {"run.duration": "40 s", "run.average_over": "20 s"}
    result = jounce.read(ROOT / "examples/wireless-sensor/harvester.toml").changed(keys).ensemble(members=3)
    assert result.device == ["store"] and 0.0 < result.device_on_fraction[0] < 1.0
    assert result.device_on_fraction_half_width[0] > 0.0 and result.device_never_started[0] == 0
    assert "margin" in repr(result) and result.device_completed_tasks[0] > 0
