"""Contact laws and force tables of the pulses of a hammer."""

import numpy as np
import pytest
from conftest import assert_identical

import jounce

# Mass of the hammer times the square of the angular frequency of its pulses, N/m.
STIFFNESS = 0.1 * (np.pi / 3e-3) ** 2


@pytest.fixture
def recording():
    """Half sines: the pulses of a linear spring without loss."""
    pulse = 50.0 * np.sin(np.pi * np.arange(1, 60) / 60.0)
    force = np.concatenate([np.zeros(500), pulse, np.zeros(2000), 0.5 * pulse, np.zeros(500)])
    return jounce.Recording.of({"hammer": force}, 20_000.0, units="N", name="pulses")


@pytest.fixture
def expected(recording, command_line, tmp_path):
    recording.write(tmp_path / "pulses.csv")
    return command_line("contact", "--mass=0.1kg", spec=tmp_path / "pulses.csv")


def test_contacts_are_those_of_the_command_line(recording, expected):
    result = jounce.contact(recording, mass="100 g")
    for name in ("exponent", "exponent_deviation", "restitution", "stiffness", "speed_m_s", "relative_error", "allowed_laws"):
        assert_identical(getattr(result, name), [one[name] for one in expected["hits"]])
    assert_identical(result.peak_force_n, [one["peak_force_n"] for one in expected["hits"]])
    # The law is linear, gives all of the speed back, and its stiffness is m w^2: off by 9e-8, 3e-10 and 7e-7.
    assert result.exponent == pytest.approx([1.0, 1.0], abs=1e-6) and result.restitution == pytest.approx([1.0, 1.0], abs=1e-8)
    assert result.stiffness == pytest.approx([STIFFNESS] * 2, rel=1e-5) and result.allowed_laws == ["linear", "linear"]
    assert result.linear_stiffness == pytest.approx([STIFFNESS] * 2, rel=1e-5) and np.isnan(result.hertz_stiffness).all()
    assert_identical(result.linear_stiffness_low, [one["linear"]["stiffness_low"] for one in expected["hits"]])
    assert_identical(result.stiffness_high, [one["stiffness_high"] for one in expected["hits"]])
    assert (result.linear_stiffness_low <= result.linear_stiffness).all() and "as a linear spring" in repr(result)
    pulse = result.pulses[0]
    # Off by 2.3e-4 N of 50 N.
    assert np.interp(pulse.time_s, pulse.law_time_s, pulse.law_force_n) == pytest.approx(pulse.force_n, abs=1e-3)


def test_force_tables_are_those_of_the_command_line(recording, expected):
    result = jounce.contact(recording, mass="100 g")
    # The force is linear in the penetration, to 2e-3 of the largest force.
    for table, one, peak in zip(result.force_tables, expected["force_tables"], result.peak_force_n):
        assert_identical(table.force_n, one["force_n"])
        assert table.reason is None and np.abs(STIFFNESS * table.penetration_m - table.force_n).max() < 2e-3 * peak
    stop = jounce.Stop(at="ball", gap="1 mm", **result.force_tables[0].keys)
    ball = jounce.Mass(on="nothing", mass="0.1 kg")
    assert jounce.Spec(mass={"ball": ball}, stop={"s": stop})["stop.s.force_n"][0] == result.force_tables[0].force_n[0]
    assert jounce.contact(recording).force_tables == []
    fast = jounce.contact(recording, mass="100 g", speed="100 m/s").force_tables[0]
    assert "times the momentum" in fast.reason and len(fast.force_n) == 0 and np.isnan(fast.speed_m_s)
