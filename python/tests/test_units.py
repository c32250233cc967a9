"""Drawn combinations of kind, unit and rate of a voltage give the power that is computed by hand, or are refused."""

import dataclasses
import random

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr

import jounce

REGISTRY = pint.UnitRegistry()
#: Volts of each unit; the last two are written as pint and as instruments write them.
UNITS = {"V": 1.0, "mV": 1e-3, "uV": 1e-6, "kV": 1e3, "µV": 1e-6, "volt": 1.0}
RESISTANCES = {"470 ohm": 470.0, "100 kohm": 1e5, "1.2 Mohm": 1.2e6}
RATES = {"200 Hz": 200.0, "1 kHz": 1e3, "5.12 kHz": 5120.0}
COMBINATIONS = 500


def times(samples, rate_hz):
    return np.arange(samples) / rate_hz


def as_numpy(values, unit, rate, given):
    return jounce.Recording.of(values, rate, units=given or unit)


def as_xarray(values, unit, rate, given):
    rate_hz, samples = RATES[rate], len(values)
    coordinates = [
        ("time", times(samples, rate_hz), {"units": "s"}),
        ("time", times(samples, rate_hz) * 1e3, {"units": "ms"}),
        ("time", np.datetime64("2026-01-01", "ns") + (times(samples, rate_hz) * 1e9).round().astype("timedelta64[ns]"), {}),
    ]
    array = xr.DataArray(values, dims="time", coords={"time": coordinates[samples % 3]}, attrs={"units": unit}, name="u")
    return jounce.Recording.of(array.to_dataset() if samples % 2 else array, units=given)


def as_pandas(values, unit, rate, given):
    time_s = times(len(values), RATES[rate])
    if len(values) % 2:
        frame = pd.DataFrame({"time_s": time_s, "u": values})
        frame.attrs["units"] = {"u": unit}
    else:
        frame = pd.Series(values, index=pd.Index(time_s, name="time"), name="u")
        frame.attrs["units"] = unit
    return jounce.Recording.of(frame, units=given)


def as_pint(values, unit, rate, given):
    return jounce.Recording.of(REGISTRY.Quantity(values, unit), REGISTRY.Quantity(rate), units=given)


def as_sep005(values, unit, rate, given):
    clock = {"fs": RATES[rate]} if len(values) % 2 else {"time": times(len(values), RATES[rate])}
    return jounce.Recording.of({"data": values, "name": "u", "unit_str": unit, **clock}, units=given)


def as_recording(values, unit, rate, given):
    return jounce.Recording.of(as_sep005(values, unit, rate, given).to_xarray())


KINDS = [as_numpy, as_xarray, as_pandas, as_pint, as_sep005, as_recording]


@pytest.fixture(scope="module")
def history():
    harvester = jounce.examples()["impact-harvester-2019"].changed({"run.duration": "1 s", "run.average_over": "0.5 s"})
    return harvester.run(record="0.1 s").history


def test_drawn_combinations_of_kind_unit_and_rate_give_the_power_computed_by_hand(history):
    draw = random.Random(28)
    refused = 0
    for number in range(COMBINATIONS):
        unit, rate, resistance = draw.choice(list(UNITS)), draw.choice(list(RATES)), draw.choice(list(RESISTANCES))
        mean_v, peak_v, samples = draw.uniform(-2.0, 2.0), draw.uniform(0.1, 20.0), draw.randrange(200, 400)
        # Seven cycles of a sine: its mean is zero and its mean square half the square of its peak.
        volts = mean_v + peak_v * np.sin(2.0 * np.pi * 7.0 * np.arange(samples) / samples)
        power_w = (mean_v**2 + peak_v**2 / 2.0) / RESISTANCES[resistance]
        load = REGISTRY.Quantity(resistance) if draw.random() < 0.3 else resistance
        make = draw.choice([*KINDS, None])
        if make is None:
            source = dataclasses.replace(history, time_s=times(samples, RATES[rate]), voltage_v=volts[None], sample_rate_hz=RATES[rate])
            source = dataclasses.replace(source, point=[], stop=[])
        else:
            given = draw.choice([None, None, unit, draw.choice(list(UNITS))])
            try:
                source = make(volts / UNITS[unit], unit, rate, given)
            except jounce.ArgumentError as error:
                assert given not in (None, unit), f"{number}: {make.__name__}, {unit}, {given}: {error}"
                refused += 1
                continue
            if make is as_numpy and given is not None:
                power_w *= (UNITS[given] / UNITS[unit]) ** 2
        result = jounce.power(source, load)
        assert result.mean_power_w[0] == pytest.approx(power_w, rel=1e-9), f"{number}: {make}, {unit}, {rate}, {resistance}"
        assert np.median(np.diff(source.time_s if make is None else source.places)) * RATES[rate] == pytest.approx(1.0, rel=1e-6)
    assert 20 < refused < 120
