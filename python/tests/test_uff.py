"""Universal files that jounce writes, read back by pyuff."""

import numpy as np
import pytest

import jounce

pyuff = pytest.importorskip("pyuff", reason="pyuff is not installed, so no other program reads back the universal files")


def read_back(recording, path):
    recording.write(path)
    sets = pyuff.UFF(str(path)).read_sets()
    return sets if isinstance(sets, list) else [sets]


def relative_error(actual, expected):
    """Largest error over the largest size."""
    return np.abs(np.asarray(actual) - np.asarray(expected)).max() / np.abs(expected).max()


def channels():
    """Samples over six decades, 301 of them, and a stamp for each."""
    time_s = np.arange(301) / 1536.0
    large = np.sin(2.0 * np.pi * 13.0 * time_s) * 1000.0 ** (np.arange(301) % 3 - 1)
    return time_s, large, np.random.default_rng(1).standard_normal(301)


def test_even_records_come_back(tmp_path):
    time_s, force, acceleration = channels()
    recording = jounce.Recording.of({"hammer": force, "tip": acceleration}, 1536.0, units={"hammer": "N", "tip": "m/s^2"})
    sets = read_back(recording, tmp_path / "a.uff")
    assert [one["id4"] for one in sets] == ["hammer", "tip"]
    for one, values, unit in zip(sets, (force, acceleration), ("N", "m/s^2")):
        assert (one["type"], one["func_type"], one["abscissa_spacing"], one["ordinate_axis_units_lab"]) == (58, 1, 1, unit)
        # Twelve digits behind the point; seven of the step.
        assert relative_error(one["data"], values) < 5e-13 and relative_error(one["x"], time_s) < 1e-6


def test_stamped_records_come_back(tmp_path):
    time_s, values, noise = channels()
    stamps = time_s + 1e-4 * np.sin(noise)
    (one,) = read_back(jounce.Recording.of({"a": values}, time_s=stamps, units={"a": "g"}), tmp_path / "a.uff")
    # Stamps have seven digits.
    assert (
        one["abscissa_spacing"] == 0 and relative_error(one["data"], 9.80665 * values) < 1e-12 and relative_error(one["x"], stamps) < 1e-6
    )


@pytest.mark.parametrize("power", [1.0, 1.5])
def test_responses_come_back(tmp_path, power):
    frequency_hz = (0.5 * np.arange(1, 200)) ** power
    response = 1.0 / (100.0 - frequency_hz**2 + 2j * frequency_hz)
    recording = jounce.Recording.of({"H": response}, frequency_hz=frequency_hz, units={"H": "m/s^2/N"})
    (one,) = read_back(recording, tmp_path / "a.uff")
    assert (one["func_type"], one["ord_data_type"], one["abscissa_spacing"]) == (4, 6, int(power == 1.0))
    assert relative_error(one["data"], response) < 5e-13 and relative_error(one["x"], frequency_hz) < 1e-6
