"""Datasets and data frames: units, names, origin, and the way through files and back."""

import dataclasses
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


def test_responses_are_complex_over_output_and_frequency(results):
    for name in ("frf", "measured frf"):
        dataset, frf = results[name].to_xarray(), results[name]
        assert dataset.response.dims == dataset.phase.dims == ("output", "frequency") and dataset.response.dtype == complex
        for output, values in frf.items():
            selected = dataset.sel(output=output)
            np.testing.assert_array_equal(selected.response, values)
            np.testing.assert_allclose(np.abs(values) * np.exp(1j * np.radians(selected.phase)), values, atol=1e-12 * np.abs(values).max())
            assert str(selected.unit.values) == frf.units[output]
    assert dataset.response.attrs["units"] == "m/s^2/N" and dataset.coherence.dims == ("output", "frequency")


def test_a_sweep_is_an_array_over_direction_and_key(results):
    dataset, sweep = results["sweep"].to_xarray(), results["sweep"]
    assert dict(dataset.sizes) == {"direction": 2, FREQUENCY: 3} and list(dataset.direction.values) == ["up", "down"]
    assert dataset[FREQUENCY].attrs == {"units": "Hz", "long_name": FREQUENCY} and dataset[FREQUENCY].values.tolist() == [10.0, 11.0, 12.0]
    for direction in ("up", "down"):
        np.testing.assert_array_equal(dataset.mean_power.sel(direction=direction), sweep.going(direction).mean_power_w)
    # A sweep that was stopped on its way down has no numbers there; its table is the same without the last two points.
    part = {field: getattr(sweep, field)[:4] for field in vars(sweep) if isinstance(getattr(sweep, field), np.ndarray)}
    stopped = dataclasses.replace(sweep, direction=sweep.direction[:4], **part).to_xarray()
    assert np.isnan(stopped.mean_power.values[1]).tolist() == [True, True, False] and stopped.settled.dtype == float
    # A direction that has a value twice has no array over the key.
    again = dataclasses.replace(sweep, direction=["up"] * 6).to_xarray()
    assert again.mean_power.dims == ("point",) and again[FREQUENCY].dims == ("point",)


def test_a_grid_of_starts_is_a_plane():
    harvester = jounce.examples()["impact-harvester-2019"]
    basins = harvester.basins(grid={"displacement": "-1.3 mm:1.7 mm:4x", "velocity": "-0.1 m/s:0.3 m/s:3x"}, max_cycles=1000)
    dataset = basins.to_xarray()
    assert dataset.attractor_index.dims == ("start_displacement", "start_velocity") and dataset.attractor_index.shape == (4, 3)
    place = dataset.sel(start_displacement=basins.start_displacement_m[5], start_velocity=basins.start_velocity_m_s[5])
    assert place.start == 5 and place.attractor_index == basins.attractor_index[5] and dataset.start_displacement.attrs["units"] == "m"


def test_a_tree_holds_a_dataset_for_each_part(results):
    import xarray

    history = results["run"].to_datatree()["history"].to_dataset().drop_vars(["load", "rectified", "device", "charge", "leak"])
    xarray.testing.assert_identical(history, results["history"].to_xarray())
    branches = results["branch"].to_datatree()
    assert [node.sizes["point"] for node in branches.children.values()] == [len(one) for one in results["branch"]]
    curve = results["bifurcations"].to_datatree()["curve_1"]
    np.testing.assert_array_equal(curve["stop.tip.gap"], results["bifurcations"][1].parameter_2)
    assert results["measured modes"].to_datatree()["frf/response"].dtype == complex
    assert len(results["power"].to_datatree().children) == 2 and len(results["contact"].to_datatree().children) == 2
    assert not results["modes"].to_datatree().children


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
        results["run"].save(other / "run.jounce")


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
