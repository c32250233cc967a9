"""Datasets and data frames: units, names, origin, and the way through files and back."""

import json
import re
import zipfile

import numpy as np
import pytest
from conftest import recordings

import jounce

FREQUENCY = "drive.shaker.frequency"


def noisy():
    """The example under noise, for short."""
    return jounce.examples()["random-base"].changed({"run.duration": "2 s", "run.average_over": "1 s"})


@pytest.fixture(scope="module")
def results():
    harvester = jounce.examples()["impact-harvester-2019"]
    short = harvester.changed({"run.duration": "1 s", "run.average_over": "0.5 s"})
    run = short.run(record="0.2 s", sample_rate="1 kHz")
    return {
        "modes": harvester.modes(),
        "frf": harvester.frf(["1 Hz", "10 Hz", "100 Hz"]),
        "run": run,
        "history": run.history,
        "spectrum": run.history.spectrum(),
        "sweep": short.sweep(FREQUENCY, "10 Hz:12 Hz:3x", direction="both", fixed_duration=True),
        "branch": harvester.branch(FREQUENCY, "12.9 Hz:13 Hz", seeds=0),
        "bifurcations": harvester.bifurcations(FREQUENCY, "12 Hz:13 Hz", "stop.tip.gap", "0.99 mm:1.01 mm", seeds=0),
        "basins": harvester.basins(starts=3),
        "diagram": harvester.diagram(FREQUENCY, "12.9 Hz:13 Hz:2x", direction="starts", starts=2, branches=False),
        "ensemble": noisy().ensemble(members=3, spectrum=True),
        "noise": noisy().noise(points=20),
        **measured(harvester),
    }


def measured(harvester):
    """What recordings give."""
    hits, tones, pulses = recordings(harvester)
    return {
        "recording": tones,
        "power": jounce.power([tones, tones], ["1 kohm", "2 kohm"], drive="10 Hz"),
        "segments": tones.segments("10 Hz", resistance="1 kohm"),
        "contact": jounce.contact(pulses, sample_rate_hz=1e4, mass="0.1 kg"),
        "measured frf": jounce.measured_frf(hits, end_ratio=0.01),
        "measured modes": jounce.measured_modes(hits, end_ratio=0.01, between="20 Hz:200 Hz"),
        "fit": harvester.fit(
            {
                "hold": ["table"],
                "frequency_deviation": 0.01,
                "free": {"beam.beam.thickness": 0.05, "beam.beam.density": 0.01},
                "mode": [{"number": 1, "frequency": "8.8 Hz"}, {"number": 2, "frequency": "51 Hz"}],
            }
        ),
    }


NAMES = ["modes", "frf", "run", "history", "spectrum", "sweep", "branch", "bifurcations", "basins", "diagram", "ensemble", "noise"]
NAMES += ["recording", "power", "segments", "contact", "measured frf", "measured modes", "fit"]


@pytest.mark.parametrize("name", NAMES)
def test_every_variable_has_units_and_a_name_and_every_dataset_its_origin(results, name):
    dataset = results[name].to_xarray()
    for variable in dataset.variables.values():
        assert "units" in variable.attrs and variable.attrs["long_name"]
    manifest = json.loads(dataset.attrs["manifest"])
    assert manifest == results[name].manifest and manifest["created_by"] == "jounce"


@pytest.mark.parametrize("name", NAMES)
def test_a_dataset_survives_netcdf_and_zarr(results, name, tmp_path):
    import xarray

    dataset = results[name].to_xarray()
    dataset.to_netcdf(tmp_path / "a.nc", engine="h5netcdf")
    with xarray.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as restored:
        xarray.testing.assert_identical(restored.load(), dataset)
    write_zarr_without_warnings(dataset, tmp_path / "a.zarr")
    with xarray.open_zarr(tmp_path / "a.zarr", consolidated=False) as restored:
        xarray.testing.assert_identical(restored.load(), dataset)


def write_zarr_without_warnings(dataset, path):
    """Texts are stored as variable-length strings, which Zarr 3 warns are not yet in its specification."""
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        dataset.to_zarr(path, consolidated=False)


def test_complex_values_are_stored_as_two_parts(results):
    dataset, frf = results["frf"].to_xarray(), results["frf"]
    for name, values in frf.responses.items():
        np.testing.assert_array_equal(dataset[f"{name}_re"] + 1j * dataset[f"{name}_im"], values)
        assert dataset[f"{name}_re"].attrs["units"] == frf.units[name]


def test_a_sweep_is_one_dataset(results):
    dataset = results["sweep"].to_xarray()
    assert dict(dataset.sizes) == {"visit": 6} and list(dataset.direction.values) == ["up"] * 3 + ["down"] * 3
    assert dataset.parameter.attrs == {"units": "Hz", "long_name": FREQUENCY}
    down = results["sweep"].going("down")
    assert down.parameter.tolist() == [10.0, 11.0, 12.0]


@pytest.mark.parametrize("name", NAMES)
def test_data_frames_hold_the_same_numbers(results, name):
    frame = results[name].to_pandas()
    assert len(frame) > 0 and frame.attrs["manifest"] == results[name].manifest
    if "mean_power_w" in frame:
        assert (frame["mean_power_w"] > 0.0).all()


@pytest.mark.parametrize("name", NAMES)
def test_every_result_pickles_and_prints(results, name):
    import pickle

    assert pickle.loads(pickle.dumps(results[name])) == results[name]
    assert repr(results[name]).startswith("<jounce.") and "<table>" in results[name]._repr_html_()


@pytest.mark.parametrize("name", NAMES)
def test_a_saved_result_is_the_same(results, name, tmp_path):
    path = tmp_path / "result.jounce"
    results[name].save(path)
    restored = jounce.load(path)
    assert restored == results[name] and repr(restored) == repr(results[name])
    assert [entry.name for entry in tmp_path.iterdir()] == ["result.jounce"]


def test_a_file_that_is_no_result_is_named(results, tmp_path):
    damaged, other = tmp_path / "damaged.jounce", tmp_path / "other.jounce"
    results["run"].save(damaged)
    content = bytearray(damaged.read_bytes())
    content[len(content) // 2] ^= 1
    damaged.write_bytes(content)
    other.write_text("run")
    harmful = tmp_path / "harmful.jounce"
    with zipfile.ZipFile(harmful, "w") as archive:
        archive.writestr("result.json", '{"format": 1, "result": {"class": ["jounce._errors", "Interrupted"], "fields": {}}}')
    for path in (damaged, other, harmful, tmp_path / "missing.jounce", tmp_path):
        with pytest.raises(jounce.FileError, match=re.escape(str(path))):
            jounce.load(path)
    with pytest.raises(jounce.FileError, match="cannot be written"):
        results["run"].save(tmp_path / "missing" / "run.jounce")


def test_bifurcation_curves_pass_through_the_bifurcations_and_peaks_of_a_branch(results):
    harvester = jounce.examples()["impact-harvester-2019"]
    branch = harvester.branch(FREQUENCY, "12 Hz:13 Hz", seeds=0, longest_period=2)
    curves = results["bifurcations"]
    assert len(curves) > 0 and all(len(curve) > 1 for curve in curves)
    highest = {}
    for curve in curves:
        order = np.argsort(curve.parameter_2)
        # The curve is read linearly between its points.
        value_at_gap = np.interp(1e-3, curve.parameter_2[order], curve.parameter[order])
        if curve.kind == "peak":
            highest[curve.mean_power_w.max()] = value_at_gap
            continue
        candidates = [at for one in branch for kind, at in zip(one.bifurcation_kind, one.bifurcation_parameter) if kind == curve.kind]
        assert min(abs(value_at_gap - at) for at in candidates) < 2e-3
    # The higher of the two peaks is that of the branch; they differ by 2e-7 Hz.
    assert highest[max(highest)] == pytest.approx(branch.peak["parameter"], abs=1e-5)
