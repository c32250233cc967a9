"""Recordings of a rig: the results of the command line, closed forms, and the same from files, arrays and SEP005 time series."""

import pickle

import numpy as np
import pint
import pytest
from conftest import SHORTER, assert_identical, sine

import jounce

#: A hammer test of the clamped beam.
HITS = {"hammer": "beam.hammer", "at": ["beam.tip"], "hold": ["table"], "hits": 4, "block": "8 s", "rate": "1024 Hz", "noise": 0.001}
HITS_OPTIONS = ["--hammer=beam.hammer", "--at=beam.tip", "--hold=table", "--hits=4", "--block=8s", "--rate=1024Hz", "--noise=0.001"]


@pytest.fixture(scope="module")
def hits():
    return jounce.examples()["impact-harvester-2019"].rig(**HITS)


@pytest.fixture(scope="module")
def run_recording():
    return jounce.examples()["impact-harvester-2019"].changed(SHORTER).rig(rate="2 kHz", noise=0.01, bits=16, seed=3)


def test_the_rig_is_that_of_the_command_line(hits, run_recording, command_line, tmp_path):
    hits.write(tmp_path / "own.parquet")
    command_line("rig", *HITS_OPTIONS, f"--to={tmp_path / 'command_line.parquet'}")
    actual, expected = (jounce.read_recordings(tmp_path / name)[0] for name in ("own.parquet", "command_line.parquet"))
    assert_identical(actual.places, expected.places)
    for name in ("force", "beam.tip.acceleration"):
        assert_identical(actual[name], expected[name])
    options = ["--rate=2kHz", "--noise=0.01", "--bits=16", "--seed=3", f"--to={tmp_path / 'run.parquet'}"]
    command_line("rig", *options, keys=SHORTER)
    assert_identical(run_recording["mfc.voltage"], jounce.read_recordings(tmp_path / "run.parquet")[0]["mfc.voltage"])
    assert run_recording.channel("1").quantity == "voltage" and run_recording.rate == 2000.0 and run_recording.samples == 1000
    assert run_recording.manifest["spec_sha256"] and run_recording.manifest["options"]["seed"] == "3"


def test_reading_is_that_of_the_command_line(hits, command_line, tmp_path):
    hits.write(tmp_path / "hits.csv")
    (expected,) = command_line("read", spec=tmp_path / "hits.csv")["recordings"]
    file = jounce.read_recordings(tmp_path / "hits.csv")
    (result,) = file
    assert (result.name, result.over, result.samples, result.rate) == (
        expected["name"],
        expected["over"],
        expected["samples"],
        expected["rate"],
    )
    for one, expected_channel in zip(result.channels, expected["channels"]):
        assert (one.name, one.quantity, one.unit) == (expected_channel["name"], expected_channel["quantity"], expected_channel["unit"])
        # Sums in another order: off by 1e-16.
        assert [one.rms, one.peak] == pytest.approx([expected_channel["rms"], expected_channel["peak"]], rel=1e-12)
    assert_identical(result["force"], hits["force"])
    assert file.over_time is result and "force" in repr(file) and file._repr_html_().startswith("<table>")
    assert pickle.loads(pickle.dumps(file)) == file and len(file.to_pandas()) == 2


def test_data_quality_issues_are_reported():
    samples = np.round(sine(0.8, 5.0, 1000.0, 1.0), 12)
    samples[[40, 41, 900]] = np.nan
    stamps = np.arange(1000) / 1000.0
    stamps[500:] += 0.0123
    options = {"time_s": stamps, "units": {"a": "g"}, "name": "floor", "allow_missing": True}
    result = jounce.Recording.of({"a": samples}, **options)
    assert {one.kind for one in result.issues} == {"jitter", "gap", "not-a-number", "converted"}
    (missing,) = [one for one in result.issues if one.kind == "not-a-number"]
    assert (missing.channel, missing.count, missing.first) == ("a", 3, "sample 40") and str(missing) in repr(result)
    assert result.channel("a").unit == "m/s^2" and result.channel("a").peak == pytest.approx(0.8 * 9.80665)
    # What is masked is missing as well.
    assert jounce.Recording.of({"a": np.ma.masked_invalid(samples)}, **options) == result
    even = result.even()
    assert even.step is not None and np.isfinite(even["a"]).all() and result.step is None
    assert {"bridged", "resampled"} < {one.kind for one in even.issues}
    assert "<table>" in result._repr_html_() and pickle.loads(pickle.dumps(result)) == result


def test_every_form_of_a_recording_gives_the_same():
    volts = sine(2.0, 13.0, 2000.0, 20.0)
    frozen = volts.copy()
    frozen.flags.writeable = False
    series = {"name": "u", "unit_str": "V", "fs": 2000.0, "data": volts}
    other = {"name": "a", "unit_str": "m/s2", "fs": 2000.0, "data": volts}
    forms = [
        (volts, 2000.0),
        (frozen, "2 kHz"),
        (np.repeat(volts, 3)[::3], pint.UnitRegistry()("2 kHz")),
        (list(volts), 2000),
        (series, None),
        ([other, series], None),
        ({**series, "fs": 2000.0, "time": np.arange(len(volts)) / 2000.0}, None),
        (jounce.Recording.of(volts, 2000.0, units="V"), None),
        (np.ma.masked_array(volts), 2000.0),
        (jounce.Recording.of(series).to_sep005(), None),
        (jounce.Recording.of({"a": other["data"], "u": 1e3 * volts}, 2000.0, units={"a": "g", "u": "mV"}), None),
        (jounce.Recording.of(pint.UnitRegistry().Quantity(1e3 * volts, "mV"), 2000.0), None),
    ]
    for values, rate in forms:
        result = jounce.power(values, "100 kohm", sample_rate_hz=rate, drive="13 Hz")
        # Whole cycles of a sine: its mean square is half the square of its peak, off by 1e-15.
        assert result.mean_power_w == pytest.approx([2.0**2 / 2.0 / 1e5], rel=1e-12)
        assert result.order_amplitude_peak_v[0, list(result.order).index(1.0)] == pytest.approx(2.0, rel=1e-9)
        # Its batches of 16.25 cycles differ a little.
        assert 0.0 < result.half_width_w[0] < 1e-3 * result.mean_power_w[0]
    two = jounce.power([volts, 2.0 * volts], ["100 kohm", "400 kohm"], sample_rate_hz=2000.0)
    assert two.mean_power_w[0] == two.mean_power_w[1] and len(two.to_pandas()) == 2


def test_power_against_the_load_is_that_of_the_command_line(run_recording, command_line, tmp_path):
    paths = [tmp_path / name for name in ("a.csv", "b.csv")]
    for path in paths:
        run_recording.write(path)
    expected = command_line("power", *map(str, paths), "--resistance=1Mohm", "--resistance=2Mohm", "--drive=11Hz", spec=None)["records"]
    result = jounce.power(paths, ["1 Mohm", "2 Mohm"], drive="11 Hz")
    assert_identical(result.resistance_ohm, [one["resistance_ohm"] for one in expected])
    for name in ("mean_power_w", "half_width_w", "batches", "batch_correlation", "effective_samples", "correlated", "mean_voltage_v"):
        assert_identical(getattr(result, name), [one[name] for one in expected])
    assert_identical(result.order_amplitude_peak_v, [[line["amplitude_peak_v"] for line in one["orders"]] for one in expected])
    assert result.record == ["a", "b"] and len(result.manifest["options"]["recording_sha256"].split()) == 2
    assert result.mean_power_w[0] == 2.0 * result.mean_power_w[1] > 0.0
    assert jounce.power([run_recording, run_recording], ["1 Mohm", "2 Mohm"]).mean_power_w.tolist() == result.mean_power_w.tolist()


def test_power_per_base_acceleration():
    recording = jounce.Recording.of(
        {"u": sine(2.0, 10.0, 1000.0, 10.0), "floor": 0.5 + sine(3.0, 10.0, 1000.0, 10.0)}, 1000.0, units={"u": "V", "floor": "m/s2"}
    )
    result = jounce.power(recording, "1 kohm", base="floor", remove_mean=True)
    assert result.mean_square_base_acceleration_m2_s4 == pytest.approx([3.0**2 / 2.0], rel=1e-12)
    assert result.mean_power_per_mean_square_w_s4_m2 == pytest.approx([2e-3 / 4.5], rel=1e-12)


def test_segments_are_those_of_the_command_line_and_find_a_known_change(command_line, tmp_path):
    quiet, loud = sine(1.0, 10.0, 1000.0, 20.0), sine(4.0, 5.0, 1000.0, 20.0) + sine(2.0, 10.0, 1000.0, 20.0)
    recording = jounce.Recording.of({"u": np.concatenate([quiet, loud])}, 1000.0, units="V", name="made")
    recording.write(tmp_path / "made.csv")
    expected = command_line("segments", "--drive=10Hz", "--resistance=1kohm", spec=tmp_path / "made.csv")
    result = recording.segments("10 Hz", resistance="1 kohm")
    segments = expected["segments"]
    for name in ("start_s", "end_s", "rms"):
        assert_identical(getattr(result, name), [one[name] for one in segments])
    for name in ("mean_power_w", "effective_samples"):
        assert_identical(getattr(result, name), [one[name] for one in segments])
    assert len(result.joint_at_s) == len(expected["joints"]) == 0
    # The change is found within a block, and the second segment repeats after two cycles.
    assert abs(result.end_s[0] - 20.0) <= result.uncertainty_s and result.period_cycles.tolist() == [1, 2]
    assert result.names() == ["period 1", "period 2"] and result.channel == "u"


def test_a_change_of_the_noise_is_a_joint_within_a_segment(command_line, tmp_path):
    stream = np.random.default_rng(1)
    noise = np.concatenate([0.02 * stream.standard_normal(20_000), 0.4 * stream.standard_normal(20_000)])
    recording = jounce.Recording.of({"u": sine(1.0, 10.0, 1000.0, 40.0) + noise}, 1000.0, units="V", name="noisy")
    recording.write(tmp_path / "noisy.csv")
    expected = command_line("segments", "--drive=10Hz", spec=tmp_path / "noisy.csv")
    result = recording.segments("10 Hz")
    assert len(result) == len(expected["segments"]) == 1 and np.isnan(result.effective_samples).all()
    assert_identical(result.joint_at_s, [one["at_s"] for one in expected["joints"]])
    assert result.joint_reason == [one["reason"] for one in expected["joints"]] == ["noise-changed"]
    assert abs(result.joint_at_s[0] - 20.0) <= result.uncertainty_s and "noise-changed, same solution" in str(result)
    assert result.to_xarray().sizes["joint"] == 1


def test_responses_of_a_hammer_test_are_those_of_the_model_and_of_the_command_line(harvester, hits, command_line, tmp_path):
    hits.write(tmp_path / "hits.csv")
    expected = command_line("frf", f"--measured={tmp_path / 'hits.csv'}", "--end-ratio=0.01", spec=None)
    result = jounce.measured_frf(hits, end_ratio=0.01)
    (name,) = result.responses
    assert_identical(result.frequency_hz, expected["frequency_hz"])
    assert_identical(result[name].real, expected["responses"][name]["re"])
    assert_identical(result.coherence[name], expected["responses"][name]["coherence"])
    assert result.units[name] == "m/s^2/N" and result.block_s == expected["block_s"] and len(result.hits) == 4
    # Between the resonances, where the window changes little, the response is that of the model: off by 0.58 % at most.
    band = (result.frequency_hz > 80.0) & (result.frequency_hz < 110.0)
    model = harvester.frf([f"{hz} Hz" for hz in result.frequency_hz[band]], input="beam.hammer", hold=["table"])[name]
    assert np.abs(result[name][band] / model - 1.0).max() < 0.01


def test_modes_of_a_hammer_test_are_those_of_the_model_and_of_the_command_line(harvester, hits, command_line, tmp_path):
    hits.write(tmp_path / "hits.csv")
    expected = command_line("modes", f"--measured={tmp_path / 'hits.csv'}", "--end-ratio=0.01", "--between=20Hz:350Hz", spec=None)
    result = jounce.measured_modes(hits, end_ratio=0.01, between="20 Hz:350 Hz")
    for name in ("frequency_hz", "frequency_deviation_hz", "damping_ratio", "damping_deviation"):
        assert_identical(getattr(result, name), [mode[name] for mode in expected["modes"]])
    assert_identical(result.mac, expected["mac"])
    assert result.shape.shape == (1, len(result)) and result.pole_stable[0] == expected["stabilisation"][0]["stable"]
    # The truth is known: with 1 Mohm the frequencies are nearly those of the open patch, which are off by 8e-5, 3e-5 and 3e-6.
    truth = harvester.modes(hold=["table"]).open_circuit_hz[0]
    assert result.frequency_hz == pytest.approx(truth[(truth > 20.0) & (truth < 350.0)], rel=2e-4)
    # The responses as arrays go the same way, without the noise given by the coherence: off by 6.6e-5.
    frf = result.frf
    recording = jounce.Recording.of(frf.responses, frequency_hz=frf.frequency_hz)
    repeated = jounce.measured_modes(recording, between=("20 Hz", "350 Hz"))
    assert repeated.frequency_hz == pytest.approx(result.frequency_hz, rel=2e-4)


def test_the_motion_of_a_base_is_an_input_and_that_of_the_command_line(command_line, tmp_path):
    """A base under noise and an oscillator of 40 Hz on it: absolute motion, voltage in V/(m/s^2) and per g, participation 1."""
    rng = np.random.default_rng(4)
    count, rate = 1 << 15, 500.0
    bins = np.fft.rfft(rng.normal(size=count))
    s = 2j * np.pi * np.fft.rfftfreq(count, 1.0 / rate)
    w = 2.0 * np.pi * 40.0
    relative = -1.0 / (s**2 + 2.0 * 0.02 * w * s + w**2)
    base, tip, volts = (np.fft.irfft(bins * h, count) for h in (np.ones_like(s), 1.0 + s**2 * relative, 300.0 * relative))
    recording = jounce.Recording.of(
        {"base": base / 9.80665, "tip": tip, "piezo": volts}, rate, units={"base": "g", "tip": "m/s^2", "piezo": "V"}, name="shaken"
    )
    recording.write(tmp_path / "shaken.csv")
    result = jounce.measured_frf(recording, input="base")
    assert (result.input, result.units) == ("base", {"tip": "m/s^2/(m/s^2)", "piezo": "V/(m/s^2)"})
    assert result.per_g == {"piezo": (9.80665, "V/g")}
    expected = command_line("frf", f"--measured={tmp_path / 'shaken.csv'}", "--input=base", spec=None)
    assert_identical(result["piezo"].real, expected["responses"]["piezo"]["re"])
    assert "V/g" in repr(result)
    modes = jounce.measured_modes(recording, input="base", between="10 Hz:100 Hz", order=8)
    k = int(np.argmin(abs(modes.frequency_hz - 40.0)))
    assert modes.frequency_hz[k] == pytest.approx(40.0, rel=1e-3) and modes.damping_ratio[k] == pytest.approx(0.02, rel=0.05)
    assert modes.base_participation.shape == (2, len(modes))
    assert modes.base_participation[:, k].real == pytest.approx([1.0, 300.0], rel=0.05)
    with pytest.raises(jounce.ArgumentError, match="give one of them"):
        jounce.measured_frf(recording, input="base", force="base")


def test_functions_of_plain_columns_and_their_gaps():
    hz = np.linspace(5.0, 60.0, 600)
    h = 1.0 / ((2 * np.pi * 20.0) ** 2 - (2 * np.pi * hz) ** 2 + 2j * 0.02 * 2 * np.pi * 20.0 * 2 * np.pi * hz)
    h[100] = np.nan
    recording = jounce.Recording.of(
        {"size": np.abs(h), "phase": np.angle(h, deg=True)}, frequency_hz=hz, units={"size": "m/N", "phase": ""}, allow_missing=True
    )
    options = {"functions": "size-degrees", "between": "6 Hz:50 Hz", "order": 8}
    with pytest.raises(jounce.RecordingError, match="bridge"):
        jounce.measured_modes(recording, **options)
    result = jounce.measured_modes(recording, bridge=True, **options)
    assert result.frequency_hz[0] == pytest.approx(20.0, rel=1e-4) and np.isnan(result.base_participation).all()
    with pytest.raises(jounce.ArgumentError, match="re-im"):
        jounce.measured_frf(recording, functions="polar")


def test_a_value_and_its_uncertainty_end_at_one_digit():
    from jounce._format import with_uncertainty

    texts = [with_uncertainty(*one) for one in ((6.9123e-6, 4.9e-6, "W"), (60.312341, 1.23e-4, "Hz"), (123.0, 45.0), (1.234e7, 3e4, "Hz"))]
    assert texts == ["(6.9 +- 4.9)e-6 W", "60.31234 +- 0.00012 Hz", "123 +- 45", "(1.2340 +- 0.0030)e7 Hz"]


def test_hits_at_two_points_give_one_response_for_each_sensor_and_point(harvester, command_line, tmp_path):
    points = ["beam.hammer", "beam.tip"]
    options = {"fixed_table": True, "hits": 1, "block": "8 s", "rate": "1024 Hz", "contact": "4 ms", "noise": 1e-4}
    records = [harvester.rig(hammer=point, at=["beam.tip", "beam.hammer"], **options) for point in points]
    files = [tmp_path / f"{point}.csv" for point in points]
    for record, file in zip(records, files):
        record.write(file)
    measured = ["--measured", *map(str, files), "--end-ratio=0.01"]
    expected = command_line("modes", *measured, "--between=20Hz:200Hz", spec=None)
    result = jounce.measured_modes(records, end_ratio=0.01, between="20 Hz:200 Hz")
    assert result.reference == result.frf.reference == expected["references"] == points and len(result.frf.responses) == 4
    assert_identical(result.frequency_hz, [mode["frequency_hz"] for mode in expected["modes"]])
    assert result.participation.shape == (2, len(result)) and result.to_datatree()["frf"].response.shape[:2] == (2, 2)
    # Reciprocity: sensors stand at tip and hammer, hits at hammer and tip.
    assert np.abs(result.shape[0] * result.participation[0] - result.shape[1] * result.participation[1]).max() < 0.02


def test_free_decays_and_outputs_alone_are_those_of_the_command_line(harvester, command_line, tmp_path):
    # One hit alone is a free decay from its largest size on; its channel of force is left out.
    hit = harvester.rig(hammer="beam.hammer", at="beam.tip", fixed_table=True, hits=1, block="8 s", rate="512 Hz", contact="8 ms")
    hit.write(tmp_path / "hit.csv")
    (name,) = [name for name in hit if name != "force"]
    cases = [
        (["--free-decay", "--span=0.1s:6s"], {"free_decay": True, "span": "0.1 s:6 s"}),
        (["--output-only", f"--reference={name}", "--lags=1.5s"], {"output_only": True, "reference": name, "lags": "1.5 s"}),
    ]
    truth = harvester.modes(fixed_table=True).open_circuit_hz[0]
    for options, keywords in cases:
        call = [f"--measured={tmp_path / 'hit.csv'}", f"--response={name}", "--between=5Hz:100Hz", "--order=20", *options]
        expected = command_line("modes", *call, spec=None)
        result = jounce.measured_modes(hit, response=name, between="5 Hz:100 Hz", order=20, **keywords)
        for field in ("frequency_hz", "frequency_deviation_hz", "damping_ratio", "damping_deviation"):
            assert_identical(getattr(result, field), [mode[field] for mode in expected["modes"]])
        assert result.frf is None and result.response == [name] and len(result.function) == 1
        assert pickle.loads(pickle.dumps(result)) == result and result.to_xarray().sizes["function"] == 1
        # The truth is known; without noise the free decay is off by 3e-4 and less.
        if "free_decay" in keywords:
            assert result.frequency_hz == pytest.approx(truth[(truth > 5.0) & (truth < 100.0)], rel=2e-3)


def test_spectra_are_those_of_the_command_line_and_of_closed_form(command_line, tmp_path):
    volts = sine(2.0, 12.0, 1000.0, 20.0) + sine(1.0, 6.0, 1000.0, 20.0)
    recording = jounce.Recording.of({"u": volts}, 1000.0, units="V", name="tones")
    recording.write(tmp_path / "tones.csv")
    expected = command_line("spectra", "--drive=12Hz", "--overlap=0.75", "--window=flat-top", spec=tmp_path / "tones.csv")
    result = jounce.spectra(recording, drive="12 Hz", overlap=0.75, window="flat-top")
    for name in ("frequency_hz", "density"):
        assert_identical(getattr(result, name), expected[name])
    assert_identical(result.order_amplitude_peak, [line["amplitude_peak"] for line in expected["orders"]])
    assert (result.segment_s, result.step_s, result.resolution_hz, result.mean) == tuple(
        expected[name] for name in ("segment_s", "step_s", "resolution_hz", "mean")
    )
    # Amplitudes are 2 V and 1 V, and the variance half their squares: lines of a flat top are off by 1e-4.
    peaks = dict(zip(result.order.round(3), result.order_amplitude_peak))
    assert [peaks[1.0], peaks[0.5]] == pytest.approx([2.0, 1.0], rel=1e-9) and max(peaks[2.0], peaks[3.0]) < 1e-9
    assert result.variance_between(0.0, 500.0) == pytest.approx(2.5, rel=1e-3)
    at = [int(np.argmin(abs(result.frequency_hz - hz))) for hz in (12.0, 6.0)]
    assert result.amplitude_peak.shape == (len(result.time_s), len(result.frequency_hz))
    assert result.amplitude_peak[:, at] == pytest.approx(np.tile([2.0, 1.0], (len(result), 1)), rel=2e-3)
    assert result.peak_frequency_hz.tolist()[:2] == [12.0, 6.0] and len(result.peak_density) == len(result.peak_frequency_hz)
    dataset = result.to_xarray()
    assert dataset.density.attrs["units"] == "V^2/Hz" and dataset.amplitude_peak.dims == ("time", "frequency")
    assert pickle.loads(pickle.dumps(result)) == result and "order 0.5" in repr(result) and len(result.orders_to_pandas()) == 10
    # The same from an array, from a SEP005 time series, and from one that is strided and may not be written.
    series = {"name": "u", "unit_str": "V", "fs": 1000.0, "data": np.repeat(volts, 2)[::2]}
    series["data"].flags.writeable = False
    for samples, rate in ((volts, 1000.0), (series, None), ([series], None)):
        repeated = jounce.spectra(samples, sample_rate_hz=rate, drive="12 Hz", overlap=0.75, window="flat-top")
        assert_identical(repeated.density, result.density)
