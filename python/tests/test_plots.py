"""Pictures: drawn into what is given, with units, and with something to see; the settings of matplotlib stay as they were."""

import io

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import recordings

import jounce

FREQUENCY = "drive.shaker.frequency"


@pytest.fixture(scope="module")
def plot_functions():
    harvester = jounce.examples()["impact-harvester-2019"]
    short = harvester.changed({"run.duration": "1 s", "run.average_over": "0.5 s"})
    run = short.run(record="0.5 s")
    noisy = jounce.examples()["random-base"].changed({"run.duration": "2 s", "run.average_over": "1 s"})
    branch = harvester.branch(FREQUENCY, "12 Hz:13 Hz", seeds=0)
    return {
        "harvester": harvester.plot_harvester,
        "modes": harvester.modes().plot_modes,
        "modes of a plate": plate().modes().plot_modes,
        "frf": harvester.frf().plot_frf,
        "time history": run.plot_time_history,
        "spectrum": run.plot_spectrum,
        "poincare": run.plot_poincare,
        "energy": run.plot_energy,
        "sweep": short.sweep(FREQUENCY, "10 Hz:12 Hz:5x", direction="both", fixed_duration=True).plot_sweep,
        "branch": branch.plot_branch,
        "bifurcations": harvester.bifurcations(FREQUENCY, "12 Hz:13 Hz", "stop.tip.gap", "0.99 mm:1.01 mm", seeds=0).plot_bifurcations,
        "basins": harvester.basins(starts=3).plot_basins,
        "diagram": harvester.diagram(FREQUENCY, "12 Hz:13 Hz:3x", direction="starts", starts=3, branches=False).plot_diagram,
        "ensemble": noisy.ensemble(members=8).plot_ensemble,
        "spectra": noisy.ensemble(members=8, spectrum=True).plot_spectra,
        "noise": noisy.noise().plot_noise,
        **measured(harvester),
    }


def plate():
    return jounce.examples()["plate-de-marqui-2009/stop"]


def response(harvester):
    """A response of a slightly thicker beam, as a feature."""
    lines = [f"{hz} Hz" for hz in np.linspace(20.0, 100.0, 41)]
    thicker = harvester.changed({"beam.beam.thickness": f"{1.02 * harvester.si('beam.beam.thickness')!r} m"})
    values = np.abs(thicker.frf(lines, input="beam.hammer")["beam.tip.acceleration"])
    return {
        "input": "beam.hammer",
        "output": "beam.tip.acceleration",
        "frequency": lines,
        "magnitude": [float(one) for one in values],
        "deviation": 0.05,
    }


def measured(harvester):
    hits, tones, pulses = recordings(harvester)
    power = jounce.power([tones, tones], ["1 kohm", "2 kohm"])
    modes = jounce.measured_modes(hits, end_ratio=0.01, between="20 Hz:200 Hz")
    fit = {"frequency_deviation": 0.01, "free": {"beam.beam.thickness": 0.05}, "mode": [{"number": 1, "frequency": "9 Hz"}]}
    return {
        "density": jounce.spectra(tones, drive="10 Hz").plot_density,
        "spectrogram": jounce.spectra(tones, drive="10 Hz", segment="0.5 s").plot_spectrogram,
        "recording": tones.plot_recording,
        "power": power.plot_power,
        "power spectra": power.plot_spectra,
        "segments": tones.segments("10 Hz").plot_segments,
        "contact": jounce.contact(pulses, sample_rate_hz=1e4).plot_contact,
        "measured frf": modes.frf.plot_frf,
        "coherence": modes.frf.plot_coherence,
        "stabilisation": modes.plot_stabilisation,
        "modal fit": modes.plot_fit,
        "fit": harvester.fit({"hold": ["table"], **fit}).plot_fit,
        "fitted curve": harvester.fit({"free": fit["free"], "response": [response(harvester)]}).plot_curve,
    }


NAMES = [
    "harvester",
    "modes",
    "modes of a plate",
    "frf",
    "time history",
    "spectrum",
    "poincare",
    "energy",
    "sweep",
    "branch",
    "bifurcations",
    "basins",
    "diagram",
    "ensemble",
    "spectra",
    "noise",
    "density",
    "spectrogram",
    "recording",
    "power",
    "power spectra",
    "segments",
    "contact",
    "measured frf",
    "coherence",
    "stabilisation",
    "modal fit",
    "fit",
    "fitted curve",
]


def pixels(figure):
    buffer = io.BytesIO()
    figure.savefig(buffer, format="rgba", dpi=100)
    return np.frombuffer(buffer.getvalue(), np.uint8).reshape(-1, 4)[:, :3]


@pytest.mark.parametrize("name", NAMES)
def test_a_picture_shows_something_and_changes_no_setting(plot_functions, name):
    settings_before = dict(matplotlib.rcParams)
    ax = plot_functions[name]()
    assert dict(matplotlib.rcParams) == settings_before
    colours = pixels(ax.figure)
    lightness = colours.max(axis=1).astype(int) - colours.min(axis=1)
    assert (colours.min(axis=1) < 250).mean() > 0.005, "next to nothing is drawn"
    assert (lightness > 60).sum() > 20, "no coloured mark is drawn"
    assert ax.get_xlabel() or name == "harvester"
    plt.close("all")


@pytest.mark.parametrize("name", NAMES)
def test_a_picture_is_drawn_into_the_specified_axes(plot_functions, name):
    figure, (left, right) = plt.subplots(1, 2)
    assert plot_functions[name](ax=right) is right
    assert not left.has_data() and right.has_data()
    plt.close(figure)


def test_axes_name_their_units(plot_functions):
    ax = plot_functions["branch"]()
    assert ax.get_xlabel() == f"{FREQUENCY} [Hz]" and ax.get_ylabel() == "Mean power [W]" and ax.get_yscale() == "log"
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert "fold" in labels and any("unstable" in label for label in labels)
    dashed = [line for line in ax.lines if line.get_linestyle() == "--" and np.isfinite(line.get_ydata()).any()]
    assert dashed
    plt.close("all")


def test_a_range_at_equal_ratios_has_a_logarithmic_axis():
    short = jounce.examples()["impact-harvester-2019"].changed({"run.duration": "0.4 s", "run.average_over": "0.2 s"})
    for values, scale in (("10 kohm:1 Mohm:3log", "log"), ("10 kohm:1 Mohm:3x", "linear")):
        sweep = short.sweep("circuit.load.resistance", values, direction="both", fixed_duration=True)
        assert sweep.plot_sweep().get_xscale() == scale
    plt.close("all")


def test_a_settled_orbit_is_drawn_as_a_point():
    settled = jounce.examples()["impact-harvester-2019"].changed({"stop.tip.gap": "1 m", "run.start": "linear"}).run(record="2 s")
    history, ax = settled.recorded(), settled.plot_poincare(point="beam.tip")
    row = history.point.index("beam.tip")
    assert np.ptp(history.poincare_displacement_m[row]) < 1e-6 * np.ptp(history.displacement_m[row])
    for limits, motion in ((ax.get_xlim(), history.displacement_m[row]), (ax.get_ylim(), history.velocity_m_s[row])):
        assert np.ptp(limits) == pytest.approx(0.01 * np.ptp(motion))
    plt.close("all")


def test_pictures_without_data_raise_errors(plot_functions):
    run = jounce.examples()["impact-harvester-2019"].changed({"run.duration": "0.2 s", "run.average_over": "0.1 s"}).run()
    with pytest.raises(jounce.ArgumentError, match="record"):
        run.plot_time_history()
    noisy = jounce.examples()["random-base"].changed({"run.duration": "2 s", "run.average_over": "1 s"})
    with pytest.raises(jounce.ArgumentError, match="spectrum=True"):
        noisy.ensemble(members=2).plot_spectra()
    with pytest.raises(jounce.ArgumentError, match="no such density"):
        plot_functions["noise"](density="mfc.heat")
    with pytest.raises(jounce.ArgumentError, match="no such channel"):
        plot_functions["time history"](channel="temperature")


def test_shapes_over_a_plate_are_those_at_its_points():
    """The corner lies half a cell outside the middle of the last cell; the values around it continue to the corner."""
    modes = plate().modes()
    size_m, shapes = modes.plates["plate"]
    assert size_m.tolist() == pytest.approx([0.1, 0.06]) and shapes.shape[0] == len(modes) and shapes.shape[1] > shapes.shape[2]
    corner = 2 * shapes[:, -1, -1] - (shapes[:, -2, -1] + shapes[:, -1, -2]) / 2
    exact = modes.shape[modes.point.index("plate.corner")]
    assert corner == pytest.approx(exact, abs=2e-3 * np.abs(shapes).max())
    dataset = modes.to_xarray()
    assert dataset["shape_plate"].dims == ("mode", "x_plate", "y_plate")


def test_a_plate_is_drawn_with_its_nodal_lines():
    """The first mode of a cantilevered plate has one sign, the second, a twist of a symmetric plate, is zero along the middle."""
    ax = plate().modes().plot_modes(modes=2)
    assert [text.get_text()[:2] for text in ax.texts] == ["1:", "2:"]
    lines = [path.vertices for one in ax.collections if hasattr(one, "levels") for path in one.get_paths() if len(path.vertices)]
    (line,) = lines
    assert line[:, 1] == pytest.approx(np.full(len(line), line[:, 1].mean()), abs=1e-6) and np.ptp(line[:, 0]) > 0.09
    plt.close("all")
