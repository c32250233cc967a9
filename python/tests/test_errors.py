"""Bad input: each a clear exception, nothing changed."""

import errno
import pickle

import numpy as np
import pint
import pytest
from conftest import SPEC

import jounce


def test_every_fault_of_a_text_is_reported_with_its_position():
    text = SPEC.read_text().replace('length = "315 mm"', "length = 315").replace('gap = "1 mm"', 'gap = "1 kg"')
    with pytest.raises(jounce.SpecError) as excinfo:
        jounce.Spec(text)
    first, second = excinfo.value.faults
    lines = text.splitlines()
    assert (lines[first.line - 1], first.key) == ("length = 315", "beam.beam.length")
    assert (lines[second.line - 1], second.key) == ('gap = "1 kg"', "stop.tip.gap")
    assert str(first) in str(excinfo.value) and first.column == 10
    restored = pickle.loads(pickle.dumps(excinfo.value))
    assert restored.faults == excinfo.value.faults and str(restored) == str(excinfo.value)


def test_a_bare_number_is_refused_with_the_message_of_toml(harvester):
    with pytest.raises(jounce.SpecError) as from_toml:
        jounce.Spec(SPEC.read_text().replace('gap = "1 mm"', "gap = 0.5"))
    with pytest.raises(jounce.SpecError) as from_set:
        harvester["stop.tip.gap"] = 0.5
    with pytest.raises(jounce.SpecError) as from_dict:
        jounce.Spec({**harvester.to_dict(), "stop": {"tip": {**harvester.to_dict()["stop"]["tip"], "gap": 0.5}}})
    message = from_toml.value.faults[0].message
    assert from_set.value.faults[0].message == message == from_dict.value.faults[0].message
    assert from_dict.value.faults[0].line == 0 and harvester.si("stop.tip.gap") == 1e-3


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("stop.tip.gapp", "1 mm"),
        ("stop.tip.gap", "1 s"),
        ("stop.tip.gap", pint.UnitRegistry()("1 kg")),
        ("drive.shaker.frequency", "-1 Hz"),
        ("damping.ratios", [0.1, "a"]),
        ("damping.ratios", float("nan")),
        ("stop.tip.law", "rubber"),
        ("stop.tip.gap", None),
        ("stop.tip.gap", {"a": 1}),
        ("stop.other.gap", "1 mm"),
        ("run.duration", "1 s"),
    ],
)
def test_wrong_settings_change_nothing(harvester, key, value):
    toml_before = harvester.to_toml()
    with pytest.raises(jounce.SpecError):
        harvester.set(key, value)
    assert harvester.to_toml() == toml_before


def test_all_faults_of_several_settings_come_at_once(harvester):
    with pytest.raises(jounce.SpecError) as excinfo:
        harvester.set({"stop.tip.gapp": "1 mm", "no.such.key": 1})
    assert len(excinfo.value.faults) == 2 and "stop.tip.gap`" in str(excinfo.value)


@pytest.mark.parametrize("value", [object(), {1, 2}, b"1 mm", 1 + 2j])
def test_values_of_wrong_types_are_refused(harvester, value):
    with pytest.raises(jounce.ArgumentError):
        harvester.set("stop.tip.gap", value)


def test_arguments_are_checked(harvester):
    frequency, noisy = "drive.shaker.frequency", jounce.examples()["random-base"]
    invalid_calls = [
        lambda: jounce.Spec(3),
        lambda: jounce.Spec("harvester.toml"),
        lambda: harvester[3],
        lambda: harvester.changed(["stop.tip.gap"]),
        lambda: harvester.changed({3: "1 mm"}),
        lambda: harvester.sweep(frequency, np.array([]), unit="Hz"),
        lambda: harvester.sweep(frequency, "10 Hz:14 Hz:1 Hz", direction="sideways"),
        lambda: harvester.sweep(frequency, [["10 Hz"]]),
        lambda: harvester.branch(frequency, "13 Hz:12 Hz"),
        lambda: harvester.branch(frequency, "12 Hz"),
        lambda: harvester.branch(frequency, "12 Hz:13 Hz", method="guessing"),
        lambda: harvester.branch(frequency, "12 Hz:13 Hz", harmonics=1),
        lambda: harvester.branch(frequency, "12 Hz:13 Hz", harmonics=64),
        lambda: harvester.branch("run.average_over", "1 s:5 s"),
        lambda: harvester.bifurcations(frequency, "12 Hz:13 Hz", "run.average_over", "1 s:5 s"),
        lambda: harvester.branch(frequency, "12 Hz:13 Hz", tolerance=0.0),
        lambda: harvester.bifurcations(frequency, "12 Hz:13 Hz", frequency, "12 Hz:13 Hz"),
        lambda: harvester.basins(starts=0),
        lambda: harvester.basins(starts=10**12),
        lambda: harvester.branch(frequency, "12 Hz:13 Hz", seeds=10**12),
        lambda: harvester.run(record="1 s", sample_rate="1 THz"),
        lambda: harvester.basins(spread=float("inf")),
        lambda: harvester.run(record="-1 s"),
        lambda: harvester.run(record="1 m"),
        lambda: harvester.run(record="100 s"),
        lambda: harvester.run(sample_rate="0 Hz"),
        lambda: harvester.run(start="state.json"),
        lambda: harvester.frf(["0 Hz"]),
        lambda: harvester.frf([]),
        lambda: harvester.basins(starts=1, progress=3),
        lambda: jounce.spectrum(np.zeros((2, 2)), 1.0),
        lambda: jounce.spectrum(["a"], 1.0),
        lambda: jounce.write_recording("a.csv", [1.0, 2.0]),
        lambda: jounce.write_recording("a.csv", [1.0, 2.0], 0.0),
        lambda: jounce.spectrum({"data": [1.0, 2.0], "name": "a", "unit_str": "V", "time": [0.0, 1.0, 3.0]}),
        lambda: jounce.examples()["no-such-system"],
        lambda: jounce.materials()["unobtainium"],
        lambda: harvester.ensemble(),
        lambda: harvester.ensemble(members=0),
        lambda: harvester.ensemble(relative_width=2.0),
        lambda: noisy.ensemble(members=1, spectrum=True),
        lambda: harvester.noise(),
        lambda: noisy.noise(points=1),
        lambda: noisy.noise(low="40 Hz"),
        lambda: noisy.noise(low="0 Hz"),
        lambda: noisy.noise(high="1 mm"),
        lambda: jounce.new("violin"),
        lambda: harvester.diagram(frequency, "12 Hz:13 Hz:3x", direction="sideways"),
        lambda: harvester.diagram(frequency, ["13 Hz", "12 Hz"]),
        lambda: harvester.diagram(frequency, "12 Hz:13 Hz:3x", direction="starts", starts=0),
        lambda: harvester.diagram(frequency, "12 Hz:13 Hz:3x", cycles=0),
        lambda: harvester.diagram(frequency, "12 Hz:13 Hz:3x", seed=2),
        lambda: harvester.diagram(frequency, "12 Hz:13 Hz:3x", direction="up", starts=5),
        lambda: harvester.diagram(frequency, "12 Hz:13 Hz:3x", branches=False, longest_period=2),
        lambda: harvester.basins(starts=9, grid={"velocity": "1 m/s:2 m/s:3x"}),
        lambda: harvester.basins(grid={"heat": "1 K:2 K:3x"}),
        lambda: harvester.basins(grid={"velocity": ("1 m/s", "2 m/s")}),
        lambda: harvester.basins(grid={"velocity": ("2 m/s", "1 m/s", 3)}),
        lambda: harvester.basins(grid="displacement=-1mm:1mm:2x"),
        lambda: harvester.frf(["1 Hz"], input="table", base=True),
    ]
    for call in invalid_calls:
        with pytest.raises(jounce.ArgumentError) as excinfo:
            call()
        # Who reads a number in the message finds it, and what it is the number of, without parsing the text.
        assert excinfo.value.details or not any(letter.isdigit() for letter in str(excinfo.value)), excinfo.value
    with pytest.raises(jounce.SpecError, match="unit"):
        harvester.sweep(frequency, np.linspace(10.0, 14.0, 3))
    with pytest.raises(jounce.SpecError, match="reversed"):
        harvester.sweep(frequency, "14 Hz:10 Hz:1 Hz")


def test_an_unknown_key_is_reported_with_the_nearest_one(harvester):
    for read in (lambda key: harvester[key], harvester.si, harvester.unit):
        with pytest.raises(jounce.UnknownKeyError, match="did you mean stop.tip.gap") as excinfo:
            read("stop.tip.gapp")
        assert isinstance(excinfo.value, KeyError) and excinfo.value.details == {"wanted": "stop.tip.gapp", "nearest": "stop.tip.gap"}
        assert str(pickle.loads(pickle.dumps(excinfo.value))).startswith("stop.tip.gapp: this spec has no such key")
    with pytest.raises(jounce.UnknownKeyError, match="stop.tip.gap"):
        harvester.si("stop.nope.gap")
    with pytest.raises(jounce.SpecError, match="no key with a number"):
        harvester.si("stop.tip.law")
    with pytest.raises(jounce.ArgumentError, match="or compute one run"):
        harvester.ensemble()


def test_wrong_python_types_are_type_errors(harvester):
    for call in (
        lambda: harvester.run(tolerance="small"),
        lambda: harvester.basins(starts=1.5),
        lambda: harvester.modes(hold=[1]),
        lambda: harvester.run("1 s"),
    ):
        with pytest.raises(TypeError):
            call()


def test_errors_carry_their_numbers(harvester):
    with pytest.raises(jounce.StructureError) as excinfo:
        harvester.modes(hold=["beam"])
    assert excinfo.value.details["names"] == ["beam"]
    state = harvester.changed({"run.duration": "0.2 s", "run.average_over": "0.1 s"}).run().end
    with pytest.raises(jounce.StartError) as excinfo:
        harvester.changed({"reduction.modes": 5}).run(start=state)
    assert (excinfo.value.details["modes"], excinfo.value.details["wanted_modes"]) == (8, 5)
    with pytest.raises(jounce.PlantError) as excinfo:
        harvester.frf(["10 Hz"], input="beam.nowhere")
    assert excinfo.value.details["name"] == "beam.nowhere"
    with pytest.raises(jounce.ArgumentError, match='did you mean "two-beams"') as excinfo:
        jounce.new("two-beam")
    assert excinfo.value.details == {"kind": "two-beam", "nearest": "two-beams"}
    with pytest.raises(jounce.PlantError, match="not linear") as excinfo:
        jounce.examples()["rectified-shu-lien-2006"].noise()
    assert excinfo.value.details == {"circuit": "rectifier"}
    noisy = jounce.examples()["random-base"]
    for orbits in (noisy.basins, lambda: noisy.diagram("stop.tip.gap", "1 mm:2 mm:3x")):
        with pytest.raises(jounce.OrbitError, match="is not periodic"):
            orbits()


def test_errors_of_arguments_and_recordings_contain_the_limits(harvester):
    frequency, volts = "drive.shaker.frequency", np.sin(np.arange(100.0))
    for call, details in (
        (lambda: harvester.basins(starts=-1), {"starts": -1, "least": 0, "most": 2**32 - 1}),
        (lambda: harvester.branch(frequency, "12 Hz:13 Hz", tolerance=1.0), {"option": "tolerance", "value": "1e0"}),
        (lambda: harvester.run(record="1000 s"), {"option": "record", "value": "1000 s"}),
        (lambda: harvester.run(record="1 s", sample_rate="1e12 Hz"), {"option": "sample_rate", "value": "1000000000000 Hz"}),
        (lambda: jounce.spectra(volts, sample_rate_hz=100.0, overlap=1.5), {"overlap": 1.5}),
        (lambda: jounce.spectra(volts, sample_rate_hz=100.0, segment="20 s"), {"option": "segment", "value": "20 s"}),
        (lambda: jounce.segments(volts, "12 Hz", sample_rate_hz=100.0), {"cycles": 12.0, "needed": 24.0}),
    ):
        with pytest.raises(jounce.JounceError) as excinfo:
            call()
        assert excinfo.value.details == details, excinfo.value
        restored = pickle.loads(pickle.dumps(excinfo.value))
        assert (str(restored), restored.details) == (str(excinfo.value), details)


def test_files_that_cannot_be_read_or_written(harvester, tmp_path):
    missing, file = tmp_path / "no-such-file.toml", tmp_path / "file"
    file.write_text("")
    with pytest.raises(jounce.FileError, match="does not exist") as excinfo:
        jounce.read(missing)
    assert (excinfo.value.details["path"], excinfo.value.errno) == (str(missing), errno.ENOENT)
    restored = pickle.loads(pickle.dumps(excinfo.value))
    assert (str(restored), restored.errno) == (str(excinfo.value), errno.ENOENT)
    for call in (lambda: jounce.read_recordings(missing), lambda: harvester.write(file / "no" / "folder.toml")):
        with pytest.raises(jounce.FileError) as excinfo:
            call()
        assert str(tmp_path) in excinfo.value.details["path"]
    with pytest.raises(jounce.FileError, match="not a folder"):
        harvester.write(file / "folder.toml")
    with pytest.raises(jounce.FileError):
        jounce.write_recording(file / "a.csv", [1.0, 2.0], 1.0)
    with pytest.raises(jounce.StartError):
        jounce.State.read(tmp_path / "none.json")
    with pytest.raises(jounce.StartError, match="not one that a run has saved"):
        harvester.run(start=jounce.State("{"))


def test_the_tree_of_exceptions():
    for kind in (jounce.ArgumentError, jounce.SpecError, jounce.IntegrationError, jounce.ConvergenceError, jounce.FileError):
        assert issubclass(kind, jounce.JounceError)
    assert issubclass(jounce.SpecError, ValueError) and issubclass(jounce.FileError, OSError)
    assert issubclass(jounce.Interrupted, KeyboardInterrupt) and not issubclass(jounce.Interrupted, Exception)


def test_invalid_counts_are_refused_by_name(harvester):
    frequency, noisy = "drive.shaker.frequency", jounce.examples()["random-base"]
    invalid_calls = [
        (lambda: harvester.basins(starts=-1), "starts is -1"),
        (lambda: harvester.basins(starts=1, seed=-1), "seed is -1"),
        (lambda: harvester.sweep(frequency, "10 Hz:11 Hz:2x", threads=-1), "threads is -1"),
        (lambda: harvester.branch(frequency, "12 Hz:13 Hz", longest_period=-1), "longest_period is -1"),
        (lambda: harvester.branch(frequency, "12 Hz:13 Hz", longest_period=0), "longest_period is 0; give a whole number from 1"),
        (lambda: harvester.bifurcations(frequency, "12 Hz:13 Hz", "stop.tip.gap", "1 mm:2 mm", seeds=10**10), "seeds is 10000000000"),
        (lambda: harvester.diagram(frequency, "12 Hz:13 Hz:2x", cycles=-1), "cycles is -1"),
        (lambda: noisy.ensemble(members=-1), "members is -1"),
        (lambda: noisy.noise(points=-1), "points is -1"),
        (lambda: harvester.modes().plot_modes(modes=0), "modes is 0"),
    ]
    for call, message in invalid_calls:
        with pytest.raises(jounce.ArgumentError, match=message):
            call()


def test_numbers_without_a_unit_name_the_argument_that_gives_it(harvester):
    gap, numbers = "stop.tip.gap", [1e-3, 2e-3]
    with pytest.raises(jounce.SpecError, match='has no unit; .* or give unit="mm" for numbers'):
        harvester.sweep(gap, numbers)
    with pytest.raises(jounce.SpecError, match=r'has no unit; .* or give units=\{"KEY": "mm"\} for numbers') as excinfo:
        jounce.Study(harvester, {gap: numbers})
    assert "line" not in str(excinfo.value)
    with pytest.raises(jounce.ArgumentError, match="units: there is no key stop.tip.gpa"):
        jounce.Study(harvester, {gap: numbers}, units={"stop.tip.gpa": "mm"})


def test_messages_use_the_words_of_python(harvester, tmp_path):
    with pytest.raises(jounce.SpecError) as excinfo:
        harvester.changed({"run.average_over": "40 s"})
    assert "--set" not in str(excinfo.value)
    with pytest.raises(jounce.ArgumentError, match="direction: unknown choice `left`, expected one of `up`"):
        harvester.sweep("stop.tip.gap", "1 mm,2 mm", direction="left")
    with pytest.raises(TypeError, match="threads: the number `1.5`, expected a whole number"):
        harvester.sweep("stop.tip.gap", "1 mm,2 mm", threads=1.5)
    with pytest.raises(jounce.ArgumentError, match="threads is 0"):
        harvester.sweep("stop.tip.gap", "1 mm,2 mm", threads=0)
    with pytest.raises(jounce.StartError, match=r"State\.write"):
        jounce.State.read(SPEC)
    with pytest.raises(jounce.FileError, match="a spec is read with jounce.read"):
        jounce.load(SPEC)
    wrong = tmp_path / "wrong.toml"
    wrong.write_text("[run]\nfoo = 1\n")
    with pytest.raises(jounce.SpecError, match=f"{wrong}: line 2"):
        jounce.read(wrong)
