"""What the tests share."""

import json
import os
import subprocess
from pathlib import Path

import matplotlib
import numpy as np
import pytest

import jounce

matplotlib.use("agg")

ROOT = Path(__file__).parents[2]
SYSTEM = "impact-harvester-2019"
SPEC = ROOT / "examples" / SYSTEM / "harvester.toml"

#: The paper's harvester at 50 N and 11 Hz, for short.
SHORT = {"drive.shaker.amplitude": "50 N", "drive.shaker.frequency": "11 Hz", "run.duration": "2 s", "run.average_over": "1 s"}


#: The run that the rig records.
SHORTER = {**SHORT, "run.duration": "1 s", "run.average_over": "0.5 s"}


def pytest_addoption(parser):
    parser.addoption("--all", action="store_true", help="run the tests marked as long, too")


def pytest_collection_modifyitems(config, items):
    """The long ones first, so that at the end no process waits for one of them; only with --all."""
    items.sort(key=lambda item: item.get_closest_marker("long") is None)
    if not config.getoption("--all"):
        for item in items:
            if item.get_closest_marker("long"):
                item.add_marker(pytest.mark.skip(reason="long: runs with ./test --long"))


def sine(peak, frequency_hz, rate_hz, seconds):
    """Samples of a sine."""
    return peak * np.sin(2.0 * np.pi * frequency_hz * np.arange(int(rate_hz * seconds)) / rate_hz)


def assert_identical(actual, expected):
    """The same numbers, bit by bit."""
    np.testing.assert_array_equal(np.asarray(actual), np.asarray(expected))


def recordings(harvester):
    """A hammer test of the clamped beam, a tone that grows, and two pulses of force."""
    hammer_options = {"hammer": "beam.hammer", "at": ["beam.tip"], "hold": ["table"], "hits": 2, "block": "4 s", "contact": "8 ms"}
    time_s = np.arange(0.0, 8.0, 1e-3)
    tones = np.sin(20.0 * np.pi * time_s) * np.where(time_s < 4.0, 1.0, 3.0)
    pulses = np.tile(np.concatenate([np.zeros(2000), np.sin(np.pi * np.arange(1, 20) / 20.0), np.zeros(2000)]), 2)
    return harvester.rig(**hammer_options, rate="512 Hz", noise=0.001), jounce.Recording.of(tones, 1000.0, units="V"), pulses


@pytest.fixture
def harvester():
    return jounce.read(SPEC)


@pytest.fixture
def short(harvester):
    return harvester.changed(SHORT)


@pytest.fixture(scope="session")
def program():
    """Path of the program."""
    program_path = os.environ.get("JOUNCE_BIN")
    found = (
        Path(program_path)
        if program_path
        else next((p for p in (ROOT / "target/release/jounce", ROOT / "target/debug/jounce") if p.exists()), None)
    )
    assert found is not None, "the program is not built; run `cargo build --release`, or name it in JOUNCE_BIN"
    return found


@pytest.fixture(scope="session")
def command_line(tmp_path_factory, program):
    """Runs the program on the paper's spec and returns its JSON result."""
    cache = tmp_path_factory.mktemp("cache")

    def run_command(command, *arguments, keys=None, spec=SPEC):
        settings = [f"--set={key}={value}" for key, value in (keys or {}).items()]
        call = [str(program), command, *([] if spec is None else [str(spec)]), *arguments, *settings, "--json"]
        process = subprocess.run(call, capture_output=True, text=True, env={**os.environ, "JOUNCE_CACHE": str(cache)}, check=False)
        assert process.returncode == 0, process.stderr
        return json.loads(process.stdout)

    return run_command


@pytest.fixture(scope="session")
def report(tmp_path_factory):
    """The paper, reproduced once: it takes ten seconds."""
    return jounce.reproduce(tmp_path_factory.mktemp("reproduced") / "report")


@pytest.fixture(scope="session")
def results(tmp_path_factory, report):
    """One result of every class that has a picture, computed in short."""
    frequency, harvester = "drive.shaker.frequency", jounce.examples()["impact-harvester-2019"]
    short = harvester.changed({"run.duration": "1 s", "run.average_over": "0.5 s"})
    noisy = jounce.examples()["random-base"].changed({"run.duration": "2 s", "run.average_over": "1 s"})
    run = short.run(record="0.5 s")
    hits, tones, pulses = recordings(harvester)
    modes = jounce.measured_modes(hits, end_ratio=0.01, between="20 Hz:200 Hz")
    features = {"frequency_deviation": 0.01, "free": {"beam.beam.thickness": 0.05}, "mode": [{"number": 1, "frequency": "9 Hz"}]}
    design = {"free": {"circuit.load.resistance": "10kohm:3Mohm:log"}, "goal": {"maximise": "expected-power", "starts": 2}}
    study = jounce.Study(short, {"stop.tip.gap": "1 mm:2 mm:2x"})
    plane = jounce.Study(short, {"stop.tip.gap": "1 mm:2 mm:2x", frequency: "10 Hz:11 Hz:2x"})
    file = tmp_path_factory.mktemp("recorded") / "hits.csv"
    hits.write(file)
    return [
        harvester.modes(),
        jounce.from_matrices(np.eye(2), np.array([[2.0, -1.0], [-1.0, 1.0]]), points={"tip": 1}, modes=2),
        harvester.sensitivity("circuit.load.resistance", starts=2),
        harvester.design(design, evaluations=40),
        harvester.frf("1 Hz:100 Hz:50log"),
        run,
        short.run(),
        run.history,
        run.history.spectrum(),
        short.sweep(frequency, "10 Hz:12 Hz:3x", direction="both", fixed_duration=True),
        harvester.branch(frequency, "12 Hz:13 Hz", seeds=0),
        harvester.bifurcations(frequency, "12 Hz:13 Hz", "stop.tip.gap", "0.99 mm:1.01 mm", seeds=0),
        harvester.basins(starts=3),
        harvester.diagram(frequency, "12 Hz:13 Hz:3x", branches=False),
        noisy.ensemble(members=4, spectrum=True),
        noisy.noise(points=20),
        study.run(tmp_path_factory.mktemp("study")).table(),
        plane.run(tmp_path_factory.mktemp("plane")).table(),
        jounce.power([tones, tones], ["1 kohm", "2 kohm"]),
        jounce.spectra(tones, drive="10 Hz", segment="0.5 s"),
        tones,
        jounce.read_recordings(file),
        tones.segments("10 Hz"),
        jounce.contact(pulses, sample_rate_hz=1e4),
        modes,
        modes.frf,
        harvester.fit({"hold": ["table"], **features}),
        report,
    ]
