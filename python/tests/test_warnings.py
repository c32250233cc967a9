"""What must not be overlooked: results that have not settled, samples that are missing, arrays that results share."""

import pickle
import re
import subprocess
import sys
import time
import warnings
from importlib.metadata import requires

import numpy as np
import pytest
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


@pytest.mark.parametrize(
    ("values", "words"),
    [
        (np.where(np.arange(4000) == 7, 1e200, sine(1.0, 10.0, 1000.0, 4.0)), "sample 7 of signal is 1e200"),
        (1e200 * sine(1.0, 10.0, 1000.0, 4.0), "sample 1 of signal is"),
    ],
)
def test_samples_too_large_are_named(values, words):
    for call in (lambda: jounce.power(values, "1 kohm", sample_rate_hz=1e3), lambda: jounce.spectra(values, sample_rate_hz=1e3)):
        with pytest.raises(jounce.JounceError, match=words):
            call()


@pytest.mark.parametrize("missing", [np.nan, np.inf, np.ma.masked])
def test_missing_samples_are_named(missing):
    values = np.ma.masked_array(sine(1.0, 10.0, 1000.0, 4.0))
    values[7] = missing
    for result in (jounce.power(values, "1 kohm", sample_rate_hz=1e3), jounce.spectra(values, sample_rate_hz=1e3)):
        (issue,) = (one for one in result.issues if one.kind == "not-a-number")
        assert (issue.count, issue.first) == (1, "sample 7") and issue.text in repr(result)
    with pytest.raises(jounce.ArgumentError, match="sample 7 of the signal is"):
        jounce.spectrum(values, 1e3)


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
        with pytest.raises(TypeError, match="tolerance: "):
            call(tolerance="x")


def test_the_package_has_only_public_names():
    code = "import jounce; print(sorted(set(n for n in dir(jounce) if not n.startswith('_')) - set(jounce.__all__)))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip() == "[]"
    with pytest.raises(AttributeError, match="harvester.run"):
        jounce.run(jounce.new("cantilever-with-stop"))


def test_a_bar_in_a_notebook_has_its_package():
    (progress,) = (one for one in requires("jounce") if one.startswith("ipywidgets"))
    assert "extra == 'progress'" in progress or 'extra == "progress"' in progress
