"""A drive from samples in memory equals the drive from their file, and the samples stay with the spec."""

import pickle

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr

import jounce

TIME_S = np.arange(0.0, 2.0, 1e-3)
ACCELERATION = 2.0 * np.sin(2 * np.pi * 9.0 * TIME_S)


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("JOUNCE_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def driven(drive):
    tables = jounce.examples()["impact-harvester-2019"].to_dict()
    return jounce.Spec({**tables, "drive": {"floor": drive}, "run": {"duration": "2 s", "average_over": "1 s"}})


def test_every_form_of_samples_drives_as_their_file_does(tmp_path):
    jounce.write_recording(tmp_path / "floor.csv", {"name": "floor", "unit_str": "m/s^2", "fs": 1e3, "data": ACCELERATION})
    expected = driven(jounce.Drive(kind="base-acceleration", signal="recording", file=str(tmp_path / "floor.csv"))).run()
    frame = pd.DataFrame({"time_s": TIME_S, "floor": ACCELERATION / 9.80665})
    frame.attrs["units"] = {"floor": "g"}
    forms = [
        (ACCELERATION, {"sample_rate": "1 kHz", "unit": "m/s^2"}),
        (ACCELERATION / 9.80665, {"sample_rate": "1 kHz", "unit": "g"}),
        (xr.DataArray(ACCELERATION * 1e3, dims="time", coords={"time": TIME_S}, attrs={"units": "mm/s^2"}), {}),
        (pint.UnitRegistry().Quantity(ACCELERATION, "m/s^2"), {"sample_rate": "1 kHz"}),
        (frame, {}),
        (jounce.Recording.of(ACCELERATION, 1e3, units="m/s^2"), {}),
    ]
    for samples, keys in forms:
        result = driven(jounce.Drive(kind="base-acceleration", recording=samples, **keys)).run()
        assert result.mean_power_w == pytest.approx(expected.mean_power_w, rel=1e-9)


def test_samples_stay_with_the_spec(tmp_path, cache):
    samples = jounce.Recording.of({"floor": ACCELERATION}, 1e3, units="m/s^2")
    harvester = driven(jounce.Drive(kind="base-acceleration", recording=samples))
    assert pickle.loads(pickle.dumps(harvester)).sha256 == harvester.sha256
    assert jounce.Spec(harvester.to_toml()).sha256 == harvester.sha256
    # The same samples have the same file, and other samples another one.
    same, other = (jounce.Drive(kind="base-acceleration", recording=factor * ACCELERATION, sample_rate=1e3) for factor in (1.0, 1.1))
    assert len(list((cache / "recordings").glob("*.csv"))) == 3 and same["file"] != other["file"]
    # A written spec needs no cache.
    harvester.write(tmp_path / "mine.toml")
    written = (cache / "recordings").rename(tmp_path / "moved")
    assert written.exists() and 'file = "mine.floor.csv"' in (tmp_path / "mine.toml").read_text()
    assert jounce.read(tmp_path / "mine.toml").run().mean_power_w > 0.0
    # A spec whose samples were deleted is refused.
    with pytest.raises(jounce.SpecError, match="drive.floor.file"):
        jounce.Spec(harvester.to_toml())


def test_the_file_of_samples_can_be_named(tmp_path, cache):
    drive = jounce.Drive(kind="base-acceleration", recording=ACCELERATION, sample_rate=1e3, unit="g", file=str(tmp_path / "floor.csv"))
    assert drive["file"] == str(tmp_path / "floor.csv") and "unit" not in drive and not cache.exists()
    assert jounce.read_recordings(drive["file"])[0].channels[0].unit == "m/s^2"


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"recording": ACCELERATION}, "give sample_rate_hz"),
        ({"recording": "floor.csv"}, "give it as `file`"),
        ({"recording": ACCELERATION, "sample_rate": 1e3, "signal": "sine"}, "omit the signal"),
    ],
)
def test_ambiguous_samples_are_refused(keys, words):
    with pytest.raises(jounce.ArgumentError, match=words):
        jounce.Drive(kind="base-acceleration", **keys)
