"""``plot`` of every result: quantities, axes, styling, and units on every axis."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_rgba

import jounce


def has_unit(axis):
    """True where the label or the ticks of an axis show a unit, or it names categories."""
    formatter = axis.get_major_formatter()
    is_named = any(text.get_text().strip(" 0123456789.−e-") for text in axis.get_ticklabels())
    return "[" in axis.get_label_text() or bool(getattr(formatter, "unit", "")) or is_named


@pytest.mark.long
def test_every_quantity_of_every_result_is_drawn_with_units_on_every_axis(results):
    for result in results:
        assert result.quantities and len(set(result.quantities)) == len(result.quantities), type(result)
        for quantity in result.quantities:
            drawn = result.plot(quantity=quantity)
            for ax in np.ravel(drawn):
                assert ax.has_data(), (type(result), quantity)
                ax.figure.canvas.draw()
                for axis in (ax.xaxis, ax.yaxis):
                    assert has_unit(axis) or not axis.get_label_text(), (type(result), quantity, axis.get_label_text())
            plt.close("all")


def test_it_draws_into_axes_with_a_style(results):
    for result in results:
        figure, (left, right) = plt.subplots(1, 2)
        assert result.plot(right, color="#123456") is right
        assert not left.has_data() and right.has_data()
        lines = [line for line in right.lines if line.get_gid() != "guide"]
        assert all(to_rgba(line.get_color()) == to_rgba("#123456") for line in lines), type(result)
        plt.close(figure)


def test_a_response_has_its_phase_beside_its_magnitude(results):
    (result,) = (one for one in results if isinstance(one, jounce.FrfResult))
    magnitude, phase = result.plot(quantity="beam.tip.acceleration", label="model")
    assert phase.get_ylabel() == "Phase of beam.tip.acceleration [deg]" and phase.get_xlabel() == "Frequency [Hz]"
    values = result["beam.tip.acceleration"]
    assert np.allclose(phase.lines[0].get_ydata(), np.degrees(np.angle(values))) and magnitude.lines[0].get_label() == "model"
    assert np.allclose(magnitude.lines[0].get_ydata(), np.abs(values))
    figure, pair = plt.subplots(2, 1)
    assert result.plot(pair) is pair and all(ax.has_data() for ax in pair)
    plt.close("all")


def test_unknown_quantities_and_styles_are_refused(results):
    run = next(one for one in results if isinstance(one, jounce.RunResult))
    with pytest.raises(jounce.UnknownKeyError, match="no such quantity; use one of mfc.voltage"):
        run.plot(quantity="colour")
    with pytest.raises(AttributeError, match="gap"):
        run.plot(gap=3)
    plt.close("all")


def test_a_sweep_is_drawn_by_any_of_its_fields(results):
    sweep = next(one for one in results if isinstance(one, jounce.SweepResult))
    ax = sweep.plot(quantity="max_penetration_m")
    assert ax.get_ylabel() == "Largest penetration of the stop" and ax.yaxis.get_major_formatter().unit == "m"
    assert np.allclose(ax.lines[0].get_ydata(), sweep.going("up").max_penetration_m)
    plt.close("all")
