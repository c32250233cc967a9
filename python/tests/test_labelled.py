"""Arrays that carry names, units and times."""

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr

import jounce

T = np.arange(0.0, 20.0, 1e-3)
V = 3.0 * np.sin(2 * np.pi * 12.0 * T)
POWER_W = 45e-6
REGISTRY = pint.UnitRegistry()


def array(factor=1e3, units="mV", time=T, time_unit=None):
    coords = {"time": ("time", time, {} if time_unit is None else {"units": time_unit})}
    return xr.DataArray(V * factor, dims="time", coords=coords, attrs={"units": units}, name="mfc")


def dated():
    return array(time=np.datetime64("2024-05-01", "ns") + (T * 1e9).round().astype("timedelta64[ns]"))


@pytest.mark.parametrize(
    "values",
    [
        array(),
        array(1.0, "V"),
        array(time=T * 1e3, time_unit="ms"),
        dated(),
        array().to_dataset(),
        pd.Series(V * 1e3, index=pd.Index(T, name="time")),
        pd.DataFrame({"time_s": T, "mfc": V * 1e3}),
        {"mfc": array()},
        {"data": V * 1e3, "name": "mfc", "unit_str": "mV", "fs": 1000.0, "time": T},
        {"data": REGISTRY.Quantity(V * 1e3, "mV"), "name": "mfc", "unit_str": "mV", "fs": 1000.0},
        xr.DataArray(REGISTRY.Quantity(V * 1e3, "mV"), dims="time", coords={"time": T}),
    ],
)
@pytest.mark.parametrize("sample_rate_hz", [None, 1000.0])
def test_units_and_times_are_read(values, sample_rate_hz):
    if isinstance(values, (pd.Series, pd.DataFrame)):
        values.attrs["units"] = "mV" if isinstance(values, pd.Series) else {"mfc": "mV"}
    result = jounce.power(values, "100 kohm", sample_rate_hz=sample_rate_hz)
    assert abs(result.mean_power_w[0] / POWER_W - 1.0) < 1e-3
    assert abs(jounce.Recording.of(values, sample_rate_hz).rate / 1000.0 - 1.0) < 1e-6


@pytest.mark.parametrize(
    ("values", "options", "words"),
    [
        (array(), {"sample_rate_hz": 500.0}, "sample_rate_hz is 500 Hz, but its times give 1000 Hz"),
        (array(), {"units": "V"}, "is in mV, but V is given"),
        (array(), {"time_s": 2 * T}, "time_s is given, but the array has different values"),
        ({"data": V, "name": "u", "unit_str": "V", "fs": 500.0, "time": T}, {}, "fs is 500 Hz, but its times give 1000 Hz"),
        ({"data": V, "name": "u", "unit_str": "V", "fs": 1000.0}, {"sample_rate_hz": 500.0}, "but fs gives 1000 Hz"),
        ({"data": REGISTRY.Quantity(V, "V"), "name": "u", "unit_str": "mV", "fs": 1e3}, {}, "is in V, but mV is given"),
        (array(time_unit="m"), {}, "is not a unit of time or frequency"),
        (pd.Series(V, index=T), {}, "the index of numbers has no name"),
        (array().rename(time="x").to_dataset().drop_vars("mfc"), {}, "the dataset has no variable"),
    ],
)
def test_contradictions_are_refused(values, options, words):
    with pytest.raises(jounce.ArgumentError, match=words):
        jounce.Recording.of(values, **options)


def test_exported_data_are_read_back():
    recording = jounce.Recording.of({"tip": V, "floor": 2.0 * V}, 1000.0, units={"tip": "g", "floor": "mV"})
    response = jounce.Recording.of({"H": np.exp(1j * T)}, frequency_hz=1.0 + T, units={"H": "m/s^2/N"})
    for original in (recording, response):
        for exported in (original.to_xarray(), original.to_pandas()):
            back = jounce.Recording.of(exported)
            assert back.over == original.over and list(back) == list(original)
            assert [one.unit for one in back.channels] == [one.unit for one in original.channels]
            assert np.allclose(back.places, original.places, rtol=1e-12)
            for name in original:
                assert np.array_equal(back[name], original[name])
    # Programs that write no complex numbers write two parts.
    parts = response.to_xarray()
    parts = parts.assign(H_re=parts.H.real, H_im=parts.H.imag).drop_vars("H")
    assert np.array_equal(jounce.Recording.of(parts)["H"], response["H"])


def test_the_history_of_a_run_is_a_recording(short):
    history = short.run(record="0.1 s").history
    for values in (history, history.to_xarray(), history.to_pandas()):
        recording = jounce.Recording.of(values)
        assert abs(recording.rate / history.sample_rate_hz - 1.0) < 1e-6
        units = {name: unit for name, (_, unit) in history.channels().items()}
        assert {one.name: one.unit for one in recording.channels} == units
        for name, (expected, _) in history.channels().items():
            assert np.array_equal(recording[name], expected)
