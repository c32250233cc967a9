"""A harvester on the virtual rig, its solutions in a record, and its keys fitted to what was measured."""

import pickle

import numpy as np
import pytest
from conftest import ROOT, SHORTER, SPEC, assert_identical, sine

import jounce


def test_every_option_of_the_rig_is_that_of_the_command_line(command_line, tmp_path):
    harvester = jounce.examples()["impact-harvester-2019"].changed(SHORTER)
    base = jounce.Recording.of({"floor": 9.81 + sine(2.0, 11.0, 500.0, 1.0)}, 500.0, units="m/s2", name="floor")
    base.write(tmp_path / "floor.csv")
    instruments = {"at": "beam.tip", "sensor_mass": "2 g", "cable": "1 nF", "cable_leakage": "10 Mohm"}
    wander = {"amplitude_wander": 0.01, "frequency_wander": 0.001, "wander_time": "2 s", "amplitude_drift": -0.1, "frequency_drift": 0.02}
    for number, keywords in enumerate([{**instruments, **wander}, {"base": base, "fixed_table": True}, {"base": base, "keep_mean": True}]):
        to = tmp_path / f"{number}.parquet"
        arguments = {**keywords, "base": tmp_path / "floor.csv"} if "base" in keywords else keywords
        options = [f"--{key.replace('_', '-')}" + ("" if value is True else f"={value}") for key, value in arguments.items()]
        command_line("rig", *options, f"--to={to}", keys=SHORTER)
        result, (expected,) = harvester.rig(**keywords), jounce.read_recordings(to)
        assert list(result) == list(expected)
        for name, values in result.items():
            assert_identical(values, expected[name])
    # Amplitude and frequency of a shaker that drifts are those of its course; without mean the base moves about 0.
    assert abs(harvester.rig(base=base, fixed_table=True)["base.acceleration"].mean()) < 0.1
    assert result["base.acceleration"].mean() == pytest.approx(9.81, rel=0.01)


def test_solutions_of_a_model_are_recorded_and_identified(harvester, command_line, tmp_path):
    # The paper's case of two solutions, of periods 1 and 3.
    case = {"drive.shaker.frequency": "13.5 Hz", "circuit.load.resistance": "100 kohm", "drive.shaker.amplitude": "42 N"}
    model, to = harvester.changed({**case, "run.average_over": "8 s"}), tmp_path / "two.parquet"
    recording = model.rig(solution=["1a", ("3a", "4 s")], starts=8, rate="1536 Hz", noise=0.01)
    options = ["--solution=1a", "--solution=3a@4s", "--starts=8", "--rate=1536Hz", "--noise=0.01", f"--to={to}"]
    command_line("rig", *options, keys={**case, "run.average_over": "8 s"})
    assert_identical(recording["mfc.voltage"], jounce.read_recordings(to)[0]["mfc.voltage"])
    assert any("another solution" in one.text for one in recording.issues)
    # The model is put to the drive and the load of the record.
    expected = command_line("segments", "--drive=13.5Hz", "--resistance=100kohm", f"--model={SPEC}", "--starts=8", spec=to, keys=case)
    result = recording.segments("13.5 Hz", resistance="100 kohm", model=harvester.changed({"drive.shaker.amplitude": "42 N"}), starts=8)
    assert result.candidates == [segment["candidates"] for segment in expected["segments"]]
    assert result.solution == ["1a", "3a"] and result.period_cycles.tolist() == [1, 3] and abs(result.end_s[0] - 4.0) < result.uncertainty_s
    assert "solution: 3a" in repr(result) and len(result.candidates_to_pandas()) == sum(map(len, result.candidates))
    with pytest.raises(jounce.ArgumentError, match="the model's solutions are") as excinfo:
        model.rig(solution="9z", starts=2)
    assert excinfo.value.details == {"option": "solution", "value": "9z"}


def test_a_fit_has_the_curves_and_deviations_of_the_command_line(harvester, command_line, tmp_path):
    # The first tenth of a second of a run with another gap, as its sensors record it.
    keys = {"run.duration": "0.3 s", "run.average_over": "0.3 s", "drive.shaker.amplitude": "50 N", "drive.shaker.frequency": "11 Hz"}
    harvester.changed({**keys, "beam.beam.thickness": "1.01 mm"}).rig(rate="1 kHz", noise=0.02).write(tmp_path / "run.csv")
    text = f"""
[free]
"drive.shaker.amplitude" = 0.05
[[history]]
file = "{tmp_path / "run.csv"}"
channel = "mfc.voltage"
output = "mfc.voltage"
deviation = "residuals"
"""
    (tmp_path / "features.toml").write_text(text)
    expected = command_line("fit", f"--to={tmp_path / 'features.toml'}", keys=keys)
    result = harvester.changed(keys).fit(tmp_path / "features.toml")
    (curve,), (expected_curve,) = result.curves, expected["curves"]
    for name in ("at", "measured", "before", "after", "low", "high"):
        assert_identical(getattr(curve, name), expected_curve[name])
    assert (curve.name, curve.unit, curve.over) == (
        expected_curve["name"],
        expected_curve["unit"],
        expected_curve["over"],
    ) and result.curve("1") is curve
    (deviation,) = result.deviations
    assert vars(deviation) == expected["deviations"][0] and result.quantile == expected["quantile"] and deviation.degrees_of_freedom > 100
    assert 0.0 < curve.error_after <= curve.error_before and curve.name in repr(result)
    assert pickle.loads(pickle.dumps(result)) == result
    with pytest.raises(jounce.ArgumentError, match="no such curve"):
        result.curve("tip")


def test_a_fit_is_that_of_the_command_line(command_line):
    folder = ROOT / "examples/impact-harvester-2019"
    expected = command_line("fit", f"--to={folder / 'measured.toml'}", keys={"patch.mfc.section": "laminate"})
    harvester = jounce.read(folder / "harvester.toml").changed({"patch.mfc.section": "laminate"})
    result = harvester.fit(folder / "measured.toml")
    assert result.key == [one["key"] for one in expected["keys"]] and result.feature == [one["name"] for one in expected["features"]]
    for name in ("before", "after", "low", "high", "deviation"):
        assert_identical(getattr(result, name), [one[name] for one in expected["keys"]])
    assert_identical(result.feature_after, [one["after"] for one in expected["features"]])
    assert result.chi_square == expected["chi_square"] and result.warnings == expected["warnings"]
    # Each key is set, and the fitted harvester has the predicted frequencies.
    assert [result.spec.si(key) for key in result.key] == pytest.approx(result.after, rel=1e-15)
    assert np.abs(result.error_after).max() < np.abs(result.error_before).max()
    assert len(result.features_to_pandas()) == len(result.feature) and pickle.loads(pickle.dumps(result)) == result


def test_a_key_is_recovered_from_the_modes_of_a_changed_harvester(harvester):
    truth = 1.01 * harvester.si("beam.beam.thickness")
    modes = harvester.changed({"beam.beam.thickness": f"{truth!r} m"}).modes(hold=["table"])
    features = [{"number": number, "frequency": f"{modes.frequency_hz[number - 1]} Hz"} for number in (1, 2, 3)]
    free = {"beam.beam.thickness": 0.05}
    result = harvester.fit({"hold": ["table"], "frequency_deviation": 1e-3, "free": free, "mode": features})
    # Noiseless, but held towards where it began by a prior of 5 %: off by 1.5e-6 of itself.
    assert result.after == pytest.approx([truth], rel=1e-5) and result.low[0] < truth < result.high[0]
