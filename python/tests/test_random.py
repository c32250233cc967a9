"""Noise and ensembles: the results of the command line, and a closed form."""

import pickle

import numpy as np
import pint
import pytest
from conftest import ROOT, assert_identical

import jounce

SHAKER = ROOT / "examples/random-base/shaker.toml"


def test_ensembles_are_those_of_the_command_line(command_line):
    keys = {"run.duration": "2 s", "run.average_over": "1 s"}
    spec = ROOT / "examples/random-base/harvester.toml"
    expected = command_line("ensemble", "--members=4", "--seed=3", keys=keys, spec=spec)
    result = jounce.read(spec).changed(keys).ensemble(members=4, seed=3)
    assert result.mean_power_w == expected["mean_power_w"] and result.interval_over == expected["interval_over"]
    assert_identical(result.member_mean_power_w, [member["mean_power_w"] for member in expected["members"]])
    assert result == jounce.read(spec).changed(keys).ensemble(members=4, seed=3, threads=1)
    assert result.patch == [] and result.voltage_psd_v2_hz.shape == (0, 0)


def test_spectra_and_stops_of_an_ensemble_are_those_of_the_command_line(command_line):
    keys = {"run.duration": "2 s", "run.average_over": "1 s"}
    expected = command_line("ensemble", "--members=8", "--seed=3", "--spectrum", keys=keys, spec=SHAKER)
    result = jounce.read(SHAKER).changed(keys).ensemble(members=8, seed=3, spectrum=True)
    assert result.interval_over == "members" and result.stop == [one["name"] for one in expected["stops"]]
    for name, unit in (("contact_rate", "_hz"), ("mean_impact_velocity", "_m_s"), ("mean_contact_duration", "_s"), ("contact_duty", "")):
        for quantity in (f"{name}{unit}", f"{name}_half_width{unit}"):
            assert_identical(getattr(result, f"stop_{quantity}"), [one[quantity] for one in expected["stops"]])
    for name in ("max_impact_velocity_m_s", "max_contact_duration_s", "max_contact_force_n", "max_penetration_m"):
        assert_identical(getattr(result, f"stop_{name}"), [one[name] for one in expected["stops"]])
    assert result.stop_contact_rate_hz[0] > 0.0
    (patch,) = expected["patches"]
    assert result.patch == [patch["name"]] and result.bandwidth_hz[0] == patch["bandwidth_hz"] > 0.0
    assert result.bandwidth_half_width_hz[0] == patch["bandwidth_half_width_hz"]
    assert result.voltage_psd_v2_hz.shape == (1, len(result.frequency_hz))
    # The density sums to the mean square of the voltage on the load of 1 Mohm, but for the Hann window: off by 2.2e-2.
    square = result.voltage_psd_v2_hz[0].sum() * np.diff(result.frequency_hz)[0]
    assert square / 1e6 == pytest.approx(result.mean_power_w, rel=0.05)
    dataset = result.to_xarray()
    assert dataset.voltage_psd.dims == ("patch", "frequency") and dataset.stop_contact_rate.attrs["units"] == "1/s"
    assert pickle.loads(pickle.dumps(result)) == result and "bandwidth of mfc" in repr(result) and "stop tip" in result._repr_html_()


def test_the_response_to_noise_is_that_of_the_command_line(command_line, tmp_path):
    expected = command_line("noise", "--low=4Hz", "--high=20Hz", "--points=50", f"--out={tmp_path}", spec=SHAKER)
    result = jounce.read(SHAKER).noise(low="4 Hz", high=pint.UnitRegistry()("20 Hz"), points=50)
    assert result.mean_power_w == expected["mean_power_w"] and (result.drive, result.left_out) == (expected["drives"], expected["left_out"])
    tables = {"load": "loads", "patch": "patches", "point": "points", "stop": "stops"}
    for axis, group in tables.items():
        assert getattr(result, axis) == [one["name"] for one in expected[group]]
    fields = {
        "load_mean_power_w": ("loads", "mean_power_w"),
        "load_spectral_power_w": ("loads", "spectral_power_w"),
        "load_difference_relative": ("loads", "difference_relative"),
        "load_voltage_rms_v": ("loads", "voltage_rms_v"),
        "load_noise_bandwidth_hz": ("loads", "noise_bandwidth_hz"),
        "load_statistical_bandwidth_hz": ("loads", "statistical_bandwidth_hz"),
        "patch_voltage_rms_v": ("patches", "voltage_rms_v"),
        "point_displacement_rms_m": ("points", "displacement_rms_m"),
        "point_velocity_rms_m_s": ("points", "velocity_rms_m_s"),
        **{f"stop_{name}": ("stops", name) for name in ("gap_m", "mean_m", "displacement_rms_m", "reached_hz", "share_beyond")},
    }
    for field, (group, name) in fields.items():
        assert_identical(getattr(result, field), [one[name] for one in expected[group]])
    table, _, _ = jounce._core.table_read(tmp_path / "noise.parquet")
    assert_identical(result.frequency_hz, table["frequency_hz"])
    for name, values in result.densities.items():
        assert_identical(values, table[f"{name}.psd"])
    # Fifty and those about each resonance, over the band that was asked for.
    assert len(result.frequency_hz) > 50 and (result.frequency_hz[0], result.frequency_hz[-1]) == (4.0, 20.0)
    assert result["mfc.voltage"] is result.densities["mfc.voltage"] and result.units["mfc.voltage"] == "V^2/Hz"
    assert result.manifest["options"]["command"] == "noise" and "LEFT OUT" in repr(result)
    assert result._repr_html_().startswith("<table>") and pickle.loads(pickle.dumps(result)) == result


def test_an_oscillator_in_noise_equals_its_closed_form():
    # Mean squares S pi f / (4 zeta w^4) and S pi f / (4 zeta w^2) of white noise, of which 3e-12 and 2e-5 lie above 10 kHz. The rms
    # values are off by 1.5e-12 and 8.9e-6.
    zeta, frequency_hz, density = 0.02, 7.0, 0.3
    spec = jounce.Spec(
        mass={"ball": jounce.Mass(mass="1 kg", frequency=f"{frequency_hz} Hz", damping_ratio=zeta)},
        drive={"floor": {"kind": "base-acceleration", "signal": "noise", "psd": f"{density} (m/s^2)^2/Hz", "high": "10 kHz"}},
        run={"duration": "1 s", "average_over": "1 s"},
    )
    result = spec.noise(low="10 mHz", high="100 Hz", points=20_000)
    square = density * np.pi * frequency_hz / (4.0 * zeta)
    w = 2.0 * np.pi * frequency_hz
    assert result.point_displacement_rms_m == pytest.approx([square**0.5 / w**2], rel=1e-10)
    assert result.point_velocity_rms_m_s == pytest.approx([square**0.5 / w], rel=1e-5)
    # The density sums to the mean square, by straight lines between the frequencies from 10 mHz: off by 3.5e-5.
    summed = np.trapezoid(result["ball.displacement"], result.frequency_hz)
    assert summed == pytest.approx(square / w**4, rel=1e-4)
    assert result.load == [] and result.load_noise_bandwidth_hz.shape == (0, 1) and result.mean_power_w == 0.0


def test_a_run_under_noise_has_no_period_to_settle_to():
    result = jounce.examples()["random-base"].changed({"run.duration": "2 s", "run.average_over": "1 s"}).run()
    assert result.settled is None and result.period_cycles is None and "no drives with a common period" in repr(result)
