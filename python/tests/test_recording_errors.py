"""Bad recordings, rigs and fits: each a clear exception, nothing changed."""

import numpy as np
import pytest

import jounce

VOLTS = np.sin(0.1 * np.arange(4000))
SERIES = {"data": VOLTS, "name": "u", "unit_str": "V", "fs": 1000.0}


@pytest.mark.parametrize(
    ("call", "kind", "words"),
    [
        (lambda: jounce.power(VOLTS, "1 kg", sample_rate_hz=1e3), jounce.ArgumentError, "expected a resistance"),
        (lambda: jounce.power(VOLTS, "-1 ohm", sample_rate_hz=1e3), jounce.ArgumentError, "above 0"),
        (lambda: jounce.power(VOLTS, "1 ohm"), jounce.ArgumentError, "give sample_rate_hz"),
        (lambda: jounce.power(VOLTS, "1 ohm", sample_rate_hz="1 m"), jounce.ArgumentError, "expected a frequency"),
        (lambda: jounce.power(np.zeros((2, 100)), "1 ohm", sample_rate_hz=1.0), jounce.ArgumentError, "2 axes"),
        (lambda: jounce.power(1j * VOLTS, "1 ohm", sample_rate_hz=1e3), jounce.ArgumentError, "complex"),
        (lambda: jounce.power(object(), "1 ohm", sample_rate_hz=1e3), jounce.ArgumentError, "is of type object; give"),
        (lambda: jounce.power(None, "1 ohm", sample_rate_hz=1e3), jounce.ArgumentError, "is of type NoneType; give"),
        (lambda: jounce.power(VOLTS, 100, sample_rate_hz=1e3), jounce.ArgumentError, "resistance: 100 has no unit; expected a resistance"),
        (lambda: jounce.spectra(SERIES, segment=1), jounce.ArgumentError, "segment: 1 has no unit; expected a time"),
        (lambda: jounce.write_recording("a.xls", VOLTS, 1e3), jounce.ArgumentError, "ends in .csv"),
        (lambda: jounce.power([], "1 ohm"), jounce.ArgumentError, "no recording"),
        (lambda: jounce.power(VOLTS[:10], "1 ohm", sample_rate_hz=1e3), jounce.RecordingError, "too few"),
        (lambda: jounce.power(np.full(100, np.nan), "1 ohm", sample_rate_hz=1e3), jounce.RecordingError, "missing"),
        (lambda: jounce.spectrum([1.0, np.nan], 1.0), jounce.RecordingError, "at index 1: missing"),
        (lambda: jounce.write_recording("a.csv", [1.0, np.nan], 1.0), jounce.RecordingError, "at index 1: missing"),
        (lambda: jounce.power(SERIES, ["1 ohm", "2 ohm"]), jounce.ArgumentError, "2 values; there are 1 recordings"),
        (lambda: jounce.power(SERIES, "1 ohm", voltage="w"), jounce.ArgumentError, "give a name, u, or"),
        (lambda: jounce.power({**SERIES, "unit_str": "N"}, "1 ohm", voltage="u"), jounce.ArgumentError, "is in N"),
        (lambda: jounce.power({"data": VOLTS, "name": "u"}, "1 ohm"), jounce.ArgumentError, "missing: unit_str"),
        (lambda: jounce.power({"name": "u", "unit_str": "V", "fs": 1000.0}, "1 ohm"), jounce.ArgumentError, "missing: data"),
        (lambda: jounce.power([SERIES, {**SERIES, "name": "v", "fs": 9.0}], "1 ohm"), jounce.ArgumentError, "v and u are not sampled"),
        (lambda: jounce.Recording.of({"a": VOLTS, "b": VOLTS[1:]}, 1e3), jounce.RecordingError, "channel b has 3999 samples"),
        (lambda: jounce.Recording.of({"a": VOLTS}, 1e3, units={"b": "V"}), jounce.ArgumentError, "units are given for b"),
        (lambda: jounce.Recording.of(VOLTS, time_s=-np.arange(4000.0)), jounce.RecordingError, "before"),
        (lambda: jounce.Recording.of(VOLTS, 1e3, time_s=np.arange(4000.0)), jounce.ArgumentError, "both given"),
        (lambda: jounce.Recording.of({}, 1e3), jounce.ArgumentError, "at least one"),
        (lambda: jounce.Recording.of(VOLTS, 1e3)["w"], jounce.ArgumentError, "no such channel; use one of signal"),
        (lambda: jounce.spectra(SERIES, window="kaiser"), jounce.ArgumentError, "`hann`, `flat-top`, `rectangular`"),
        (lambda: jounce.spectra(SERIES, overlap=1.0), jounce.RecordingError, "from 0 to 0.95"),
        (lambda: jounce.spectra(SERIES, segment="1 h"), jounce.ArgumentError, "segment is 3600 s; it must be from 8 ms"),
        (lambda: jounce.spectra(SERIES, segment="1 m"), jounce.ArgumentError, "expected a time"),
        (lambda: jounce.spectra(SERIES, drive="0 Hz"), jounce.ArgumentError, "above 0"),
        (lambda: jounce.spectra(SERIES, drive="0.01 Hz"), jounce.RecordingError, "it must last at least"),
        (lambda: jounce.spectra(SERIES, channel="w"), jounce.ArgumentError, "w"),
        (lambda: jounce.segments(VOLTS, "1 Hz", sample_rate_hz=1e3), jounce.RecordingError, "at least 24"),
        (lambda: jounce.segments(VOLTS, "10 V", sample_rate_hz=1e3), jounce.ArgumentError, "expected a frequency"),
        (lambda: jounce.contact(np.random.default_rng(0).normal(size=4000), sample_rate_hz=1e3), jounce.RecordingError, "no hit"),
        (lambda: jounce.contact(VOLTS, sample_rate_hz=1e3, mass="1 m"), jounce.ArgumentError, "expected a mass"),
        (lambda: jounce.measured_frf(SERIES), jounce.RecordingError, "no channel in newtons"),
        (lambda: jounce.measured_frf(SERIES, estimator="h3"), jounce.ArgumentError, "`h1`, `h2`, `hv`"),
        (lambda: jounce.measured_frf(SERIES, end_ratio=2.0), jounce.ArgumentError, "end_ratio is 2"),
        (lambda: jounce.measured_modes(SERIES, order=1), jounce.ArgumentError, "from 2 to 400"),
        (lambda: jounce.measured_modes(SERIES, between="20 Hz:10 Hz"), jounce.ArgumentError, "the first below the second"),
        (lambda: jounce.measured_modes(SERIES, span="0 s:1 s"), jounce.ArgumentError, "needs `free_decay`"),
        (lambda: jounce.measured_modes(SERIES, free_decay=True, lags="1 s"), jounce.ArgumentError, "needs `output_only`"),
        (lambda: jounce.measured_modes(SERIES, free_decay=True, output_only=True), jounce.ArgumentError, "one of them"),
        (lambda: jounce.measured_modes(SERIES, output_only=True, force="u"), jounce.ArgumentError, "omit it, or omit them"),
        (lambda: jounce.measured_modes([VOLTS, VOLTS], sample_rate_hz=1e3, output_only=True), jounce.ArgumentError, "one recording"),
        (lambda: jounce.measured_modes(SERIES, output_only=True, lags="3 s"), jounce.RecordingError, "3"),
        (lambda: jounce.measured_modes(SERIES, free_decay=True, span="3.999 s:9 s"), jounce.RecordingError, "32"),
        (lambda: jounce.segments(SERIES, "10 Hz", model="a.toml"), jounce.ArgumentError, "of type str"),
        (lambda: jounce.segments(SERIES, "10 Hz", starts=-1), jounce.ArgumentError, "starts is -1"),
    ],
)
def test_unusable_recordings_raise_errors(call, kind, words):
    with pytest.raises(kind, match=words):
        call()


def test_impossible_rigs_and_fits_raise_errors(harvester, tmp_path):
    features = {"free": {"beam.beam.thickness": 0.1}, "frequency_deviation": 0.01, "mode": [{"number": 1, "frequency": "9 Hz"}]}
    invalid_calls = [
        (lambda: harvester.rig(hammer="nowhere"), jounce.PlantError, "beam.tip"),
        (lambda: harvester.rig(hammer="beam.tip", hold=["beam"]), jounce.StructureError, "only a mass"),
        (lambda: harvester.rig(hammer="beam.tip", noise=-1.0), jounce.ArgumentError, "noise"),
        (lambda: harvester.rig(hammer="beam.tip", hits=-1), jounce.ArgumentError, "hits is -1"),
        (lambda: harvester.rig(sensor_mass="2 g"), jounce.ArgumentError, "accelerometers"),
        (lambda: harvester.rig(at="beam.tip", sensor_mass="2 m"), jounce.ArgumentError, "expected a mass"),
        (lambda: harvester.rig(cable="1 m"), jounce.ArgumentError, "expected a capacitance"),
        (lambda: harvester.rig(cable="-1 nF"), jounce.ArgumentError, "above 0"),
        (lambda: harvester.rig(amplitude_wander=0.9), jounce.ArgumentError, "from 0 to 0.3"),
        (lambda: harvester.rig(solution=["1a", "3a"]), jounce.ArgumentError, "add the time"),
        (lambda: harvester.rig(solution="1a", hold="table"), jounce.ArgumentError, "complete model"),
        (lambda: harvester.rig(hammer="beam.tip", frequency_drift=0.1), jounce.ArgumentError, "applies to a shaker test"),
        (lambda: harvester.rig(hammer="beam.tip", base=SERIES), jounce.ArgumentError, "replaces the drives"),
        (lambda: harvester.rig(base=SERIES), jounce.ArgumentError, "the channels are u \\(V\\)"),
        (lambda: harvester.rig(base=tmp_path / "none.csv"), jounce.FileError, "does not exist"),
        (lambda: jounce.reproduce(tmp_path / "file" / "below"), jounce.FileError, "cannot write into the folder"),
        (lambda: harvester.rig(rate="1 kg"), jounce.ArgumentError, "expected a frequency"),
        (lambda: harvester.fit(3), jounce.ArgumentError, "of type int"),
        (lambda: harvester.fit({}), jounce.FitError, "(?s)no key is free: .*nothing is measured"),
        (lambda: harvester.fit({**features, "free": {"beam.none.length": 0.1}}), jounce.FitError, "beam.none.length"),
        (lambda: harvester.fit({**features, "mode": [{"number": 99, "frequency": "9 Hz"}]}), jounce.FitError, "mode 99"),
        (lambda: harvester.fit(tmp_path / "none.toml"), jounce.FileError, "does not exist"),
    ]
    (tmp_path / "file").write_text("")
    for call, kind, words in invalid_calls:
        with pytest.raises(kind, match=words):
            call()


def test_files_of_recordings_that_cannot_be_read_or_written(tmp_path):
    recording = jounce.Recording.of(np.array([1.0, np.nan] * 5), 10.0, allow_missing=True)
    (tmp_path / "cut.uff").write_text("    -1\n    58\nabc")
    (tmp_path / "empty.csv").write_text("")
    invalid_calls = [
        (lambda: jounce.read_recordings(tmp_path / "none.csv"), jounce.FileError, "does not exist"),
        (lambda: jounce.read_recordings(tmp_path), jounce.FileError, "not a file"),
        (lambda: jounce.read_recordings(tmp_path / "cut.uff"), jounce.FileError, "is the file truncated"),
        (lambda: jounce.power(tmp_path / "empty.csv", "1 ohm"), jounce.FileError, "it is empty"),
        (lambda: recording.write(tmp_path / "a.xyz"), jounce.FileError, "the extension must be"),
        (lambda: recording.write(tmp_path / "empty.csv/a.csv"), jounce.FileError, "not a folder"),
        (lambda: recording.write(tmp_path / "a.uff"), jounce.RecordingError, "sample 1 of signal is NaN"),
        (lambda: jounce.State("{}").write(tmp_path / "empty.csv/state.json"), jounce.FileError, "cannot be written"),
    ]
    for call, kind, words in invalid_calls:
        with pytest.raises(kind, match=words):
            call()
    assert {path.name for path in tmp_path.iterdir()} == {"cut.uff", "empty.csv"}
