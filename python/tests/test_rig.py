"""A harvester on the virtual rig, its solutions in a record, and its keys fitted to what was measured."""

import pickle

import numpy as np
import pytest
from conftest import ROOT, SHORTER, SPEC, same, sine

import jounce


def test_every_option_of_the_rig_is_that_of_the_command_line(command_line, tmp_path):
    harvester = jounce.examples()["impact-harvester-2019"].changed(SHORTER)
    base = jounce.Recording.of({"floor": 9.81 + sine(2.0, 11.0, 500.0, 1.0)}, 500.0, units="m/s2", name="floor")
    base.write(tmp_path / "floor.csv")
    instruments = {"at": "beam.tip", "sensor_mass": "2 g", "cable": "1 nF", "cable_leakage": "10 Mohm"}
    wander = {"amplitude_wander": 0.01, "frequency_wander": 0.001, "wander_time": "2 s", "amplitude_drift": -0.1, "frequency_drift": 0.02}
    for number, keywords in enumerate([{**instruments, **wander}, {"base": base, "fixed_table": True}, {"base": base, "keep_mean": True}]):
        to = tmp_path / f"{number}.parquet"
        shown = {**keywords, "base": tmp_path / "floor.csv"} if "base" in keywords else keywords
        given = [f"--{key.replace('_', '-')}" + ("" if value is True else f"={value}") for key, value in shown.items()]
        command_line("rig", *given, f"--to={to}", keys=SHORTER)
        found, (told,) = harvester.rig(**keywords), jounce.read_recordings(to)
        assert [one.name for one in found] == [one.name for one in told]
        for one in found:
            same(one.values, told[one.name])
    # Amplitude and frequency of a shaker that drifts are those of its course; without mean the base moves about 0.
    assert abs(harvester.rig(base=base, fixed_table=True)["base.acceleration"].mean()) < 0.1
    assert found["base.acceleration"].mean() == pytest.approx(9.81, rel=0.01)


def test_solutions_of_a_model_are_recorded_and_named_again(harvester, command_line, tmp_path):
    # The paper's case of two solutions, of periods 1 and 3.
    case = {"drive.shaker.frequency": "13.5 Hz", "circuit.load.resistance": "100 kohm", "drive.shaker.amplitude": "42 N"}
    model, to = harvester.changed({**case, "run.average_over": "8 s"}), tmp_path / "two.parquet"
    made = model.rig(solution=["1a", ("3a", "4 s")], starts=8, rate="1536 Hz", noise=0.01)
    options = ["--solution=1a", "--solution=3a@4s", "--starts=8", "--rate=1536Hz", "--noise=0.01", f"--to={to}"]
    command_line("rig", *options, keys={**case, "run.average_over": "8 s"})
    same(made["mfc.voltage"], jounce.read_recordings(to)[0]["mfc.voltage"])
    assert any("another solution" in one.text for one in made.findings)
    # The model is put to the drive and the load of the record.
    told = command_line("regimes", "--drive=13.5Hz", "--resistance=100kohm", f"--model={SPEC}", "--starts=8", spec=to, keys=case)
    found = jounce.regimes(made, "13.5 Hz", resistance="100 kohm", model=harvester.changed({"drive.shaker.amplitude": "42 N"}), starts=8)
    assert found.candidates == [shown["candidates"] for shown in told["correspondences"]]
    assert found.solution == ["1a", "3a"] and found.period_cycles.tolist() == [1, 3] and abs(found.end_s[0] - 4.0) < found.uncertainty_s
    assert "solution: 3a" in repr(found) and len(found.candidates_to_pandas()) == sum(map(len, found.candidates))
    with pytest.raises(jounce.ArgumentError, match="the model's solutions are") as caught:
        model.rig(solution="9z", starts=2)
    assert caught.value.details["solution"] == "9z"


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
    told = command_line("fit", f"--to={tmp_path / 'features.toml'}", keys=keys)
    found = harvester.changed(keys).fit(tmp_path / "features.toml")
    (curve,), (listed,) = found.curves, told["curves"]
    for name in ("at", "measured", "before", "after", "low", "high"):
        same(getattr(curve, name), listed[name])
    assert (curve.name, curve.unit, curve.over) == (listed["name"], listed["unit"], listed["over"]) and found.curve("1") is curve
    (deviation,) = found.deviations
    assert vars(deviation) == told["deviations"][0] and found.quantile == told["quantile"] and deviation.degrees_of_freedom > 100
    assert 0.0 < curve.error_after <= curve.error_before and curve.name in repr(found)
    assert pickle.loads(pickle.dumps(found)) == found
    with pytest.raises(jounce.ArgumentError, match="no such curve"):
        found.curve("tip")


def test_a_fit_is_that_of_the_command_line(command_line):
    folder = ROOT / "examples/impact-harvester-2019"
    told = command_line("fit", f"--to={folder / 'measured.toml'}", keys={"patch.mfc.section": "laminate"})
    harvester = jounce.read(folder / "harvester.toml").changed({"patch.mfc.section": "laminate"})
    found = harvester.fit(folder / "measured.toml")
    assert found.key == [one["key"] for one in told["keys"]] and found.feature == [one["name"] for one in told["features"]]
    for name in ("before", "after", "low", "high", "deviation"):
        same(getattr(found, name), [one[name] for one in told["keys"]])
    same(found.feature_after, [one["after"] for one in told["features"]])
    assert found.chi_square == told["chi_square"] and found.warnings == told["warnings"]
    # Each key is set, and the fitted harvester has the predicted frequencies.
    assert [found.spec.si(key) for key in found.key] == pytest.approx(found.after, rel=1e-15)
    assert np.abs(found.error_after).max() < np.abs(found.error_before).max()
    assert len(found.features_to_pandas()) == len(found.feature) and pickle.loads(pickle.dumps(found)) == found


def test_a_key_comes_back_from_the_modes_of_a_changed_harvester(harvester):
    truth = 1.01 * harvester.si("beam.beam.thickness")
    modes = harvester.changed({"beam.beam.thickness": f"{truth!r} m"}).modes(hold=["table"])
    features = [{"number": number, "frequency": f"{modes.frequency_hz[number - 1]} Hz"} for number in (1, 2, 3)]
    free = {"beam.beam.thickness": 0.05}
    found = harvester.fit({"hold": ["table"], "frequency_deviation": 1e-3, "free": free, "mode": features})
    # Noiseless, but held towards where it began by a prior of 5 %: off by 1.5e-6 of itself.
    assert found.after == pytest.approx([truth], rel=1e-5) and found.low[0] < truth < found.high[0]
