"""What must not be overlooked: results that have not settled, samples that are missing, arrays that results share."""

import pickle
import re
import subprocess
import sys
import time
import warnings
from importlib.metadata import requires

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from conftest import sine

import jounce

FREQUENCY = "drive.shaker.frequency"
TRANSIENT = {"run.duration": "0.5 s", "run.average_over": "0.2 s"}


def test_what_has_not_settled_warns(harvester):
    with pytest.warns(jounce.NotSettled, match="has not settled") as caught:
        run = harvester.changed(TRANSIENT).run()
    assert run.settled is False and run.is_transient and "NOT settled" in repr(run) and caught[0].filename == __file__
    with pytest.warns(jounce.NotSettled, match="2 of 2 points have not settled"):
        sweep = harvester.changed(TRANSIENT).sweep(FREQUENCY, "12 Hz:13 Hz:2x", fixed_duration=True)
    assert sweep.transient.all() and re.search("NOT settled +2 points", repr(sweep))


def test_what_has_settled_or_cannot_settle_does_not_warn(harvester):
    chirp = harvester.to_toml().replace('frequency = "13 Hz"', 'signal = "chirp"\nfrom = "9 Hz"\nto = "12 Hz"\nduration = "2 s"')
    with warnings.catch_warnings():
        warnings.simplefilter("error", jounce.NotSettled)
        assert harvester.changed({"stop.tip.gap": "1 m", "run.start": "linear"}).run().settled
        aperiodic = jounce.Spec(chirp).changed({"run.duration": "2 s", "run.average_over": "1 s"})
        assert aperiodic.run().settled is None and not aperiodic.sweep("stop.tip.gap", ["1 mm"]).transient.any()


def test_a_study_counts_what_failed_and_what_has_not_settled(harvester, tmp_path):
    study = jounce.Study(harvester.changed(TRANSIENT), {FREQUENCY: "12 Hz:13 Hz:2x"})
    result = study.run(tmp_path / "transient")
    with pytest.warns(jounce.NotSettled, match="2 of 2 points of the study have not settled"):
        table = result.table()
    assert re.search("NOT settled +2 points", repr(table)) and "without a result" not in repr(result)
    # A rigid stop that the harvester starts inside: the point fails.
    inside = harvester.changed({**TRANSIENT, "stop.tip.law": "rigid", "stop.tip.restitution": 0.8, "stop.tip.stiffness": None})
    with pytest.warns(jounce.PointsWithoutResult, match="points without a result: 1 of 2; the column `failure`") as caught:
        failed = jounce.Study(inside, {"stop.tip.gap": "-1 mm:1 mm:2x"}).run(tmp_path / "failed")
    assert caught[0].filename == __file__
    assert failed.status.failed_points == 1 and repr(failed).endswith("2 points, 1 without a result>")


SINE = sine(1.0, 10.0, 1000.0, 4.0)


def with_sample(value, values=SINE):
    """The sine as a masked array, whose sample 7 has another value."""
    changed = np.ma.masked_array(values, copy=True)
    changed[7] = value
    return changed


@pytest.mark.parametrize("form", [lambda values: values, lambda values: {"u": values}, lambda values: [*values.filled(np.nan)]])
@pytest.mark.parametrize(("value", "words"), [(np.nan, "missing"), (np.ma.masked, "missing"), (np.inf, "infinite"), (1e200, "too large")])
def test_samples_that_are_not_usable_numbers_are_named(form, value, words):
    values = form(with_sample(value))
    for call in (
        lambda: jounce.power(values, "1 kohm", sample_rate_hz=1e3),
        lambda: jounce.spectra(values, sample_rate_hz=1e3),
        lambda: jounce.Recording.of(values, 1e3),
        lambda: jounce.Drive(kind="base-acceleration", recording=values, sample_rate="1 kHz"),
        lambda: jounce.spectrum(values if not isinstance(values, dict) else values["u"], 1e3),
    ):
        with pytest.raises(jounce.RecordingError, match=f"1 sample of .+, at index 7: .*{words}") as caught:
            call()
        (fault,) = caught.value.details["faults"]
        assert (fault["count"], fault["first"]) == (1, [7])


@pytest.mark.parametrize("units", ["V", "GV"])
def test_overflow_is_refused_in_si(units):
    # 1e150 V can be squared, 1e150 GV cannot.
    values = with_sample(1e150)
    if units == "V":
        assert jounce.Recording.of(values, 1e3, units=units).channels[0].rms == pytest.approx(1e150 / np.sqrt(4000.0))
    else:
        with pytest.raises(jounce.RecordingError, match="1 sample of signal, at index 7: infinite, or too large to be squared"):
            jounce.Recording.of(values, 1e3, units=units)


def test_faulty_samples_of_every_channel_are_counted():
    faulty = np.where(np.arange(4000) % 400 == 0, np.nan, SINE)
    with pytest.raises(jounce.RecordingError, match="10 samples of a, at index 0, 400, 800, 1200, 1600, ...: missing") as caught:
        jounce.Recording.of({"a": faulty, "b": SINE, "c": with_sample(np.inf)}, 1e3)
    assert caught.value.details["faults"] == [
        {"channel": "a", "reason": "missing", "count": 10, "first": [0, 400, 800, 1200, 1600]},
        {"channel": "c", "reason": "too-large", "count": 1, "first": [7]},
    ]
    assert "1 sample of c, at index 7" in str(caught.value) and "allow_missing=True" in str(caught.value)
    response = np.exp(1j * SINE)
    response[3] = complex(0.0, np.nan)
    with pytest.raises(jounce.RecordingError, match="at index 3: missing"):
        jounce.Recording.of(response, frequency_hz=1.0 + np.arange(4000.0), units="m/s^2/N")


@pytest.mark.parametrize("frame_type", ["xarray", "pandas", "nullable"])
def test_missing_samples_of_labelled_arrays_are_named(frame_type):
    values, time_s = with_sample(np.nan).filled(), np.arange(4000) / 1e3
    labelled = {
        "xarray": lambda: xr.DataArray(values, {"time": time_s}, name="u"),
        "pandas": lambda: pd.Series(values, pd.Index(time_s, name="time"), name="u"),
        "nullable": lambda: pd.Series(values, pd.Index(time_s, name="time"), name="u").convert_dtypes(),
    }[frame_type]()
    with pytest.raises(jounce.RecordingError, match="1 sample of u, at index 7: missing"):
        jounce.power(labelled, "1 kohm")


@pytest.mark.parametrize("missing", [np.nan, np.ma.masked])
def test_missing_samples_that_are_allowed_are_interpolated_and_reported(missing):
    recording = jounce.Recording.of(with_sample(missing), 1e3, units="V", allow_missing=True)
    for result in (recording.power("1 kohm"), recording.spectra()):
        (issue,) = (one for one in result.issues if one.kind == "not-a-number")
        assert (issue.count, issue.first) == (1, "sample 7") and issue.text in repr(result)
    with pytest.raises(jounce.RecordingError, match="at index 7: infinite"):
        jounce.Recording.of(with_sample(np.inf), 1e3, allow_missing=True)


def test_a_file_has_the_same_rms_as_an_array_whatever_its_size(tmp_path):
    (tmp_path / "large.csv").write_text("time (s),u (V)\n" + "".join(f"{k / 1e3},{1e200 * SINE[k]:e}\n" for k in range(4000)))
    (recording,) = jounce.read_recordings(tmp_path / "large.csv")
    assert recording.channels[0].rms == pytest.approx(1e200 / np.sqrt(2.0))
    with pytest.raises(jounce.RecordingError, match="sample 1 of u is"):
        recording.power("1 kohm")


def test_the_arrays_of_a_result_are_read_only(short):
    result = short.run(record="0.1 s")
    for one in (result, pickle.loads(pickle.dumps(result))):
        with pytest.raises(ValueError, match="read-only"):
            one.load_mean_power_w[0] = 1.0
        with pytest.raises(ValueError, match="read-only"):
            one.history.voltage_v[0, 0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        short.frf("1 Hz:2 Hz:2x")["mfc.voltage"][0] = 1.0
    dataset, frame = result.history.to_xarray(), result.history.to_pandas()
    dataset.voltage[0, 0] = frame.loc[0, "mfc.voltage"] = 1.0
    assert result.history.voltage_v[0, 0] != 1.0


def test_wall_time_is_that_of_the_call(short):
    start = time.perf_counter()
    result = short.run(record="2 s", sample_rate="100 kHz")
    elapsed_s = time.perf_counter() - start
    assert result.integration_wall_time_s < result.wall_time_s <= elapsed_s


def test_counts_of_one_are_singular(harvester):
    assert "1 branch over" in harvester.branch(FREQUENCY, "8 Hz:8.1 Hz", seeds=0)._repr_html_()
    assert "1 point in 1 part," in repr(jounce.Study(harvester, {FREQUENCY: ["12 Hz"]}))


def test_an_option_of_a_wrong_type_is_named(harvester):
    for call in (harvester.run, harvester.basins, harvester.ensemble, lambda **options: harvester.sweep(FREQUENCY, "12 Hz", **options)):
        with pytest.raises(TypeError, match="tolerance: .*, expected a number"):
            call(tolerance="x")
    with pytest.raises(TypeError, match="starts: .*, expected a whole number"):
        harvester.basins(starts=2.5)


def test_the_package_has_only_public_names():
    code = "import jounce; print(sorted(set(n for n in dir(jounce) if not n.startswith('_')) - set(jounce.__all__)))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip() == "[]"
    with pytest.raises(AttributeError, match="harvester.run"):
        jounce.run(jounce.new("cantilever-with-stop"))


def test_a_bar_in_a_notebook_has_its_package():
    (progress,) = (one for one in requires("jounce") if one.startswith("ipywidgets"))
    assert "extra == 'progress'" in progress or 'extra == "progress"' in progress
