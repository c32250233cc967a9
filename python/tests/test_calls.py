"""Long calls: Ctrl-C, progress, other threads and processes."""

import multiprocessing
import signal
import subprocess
import sys
import textwrap
import threading
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import pytest
from conftest import SPEC

import jounce

FREQUENCY = "drive.shaker.frequency"

#: Starts a call, and prints the processor time that the process used from the signal to the end of the call, the wall time, and what was
#: kept. The signal comes from inside, at a known time. A machine that is busy with something else stretches the wall time, but not the
#: processor time: the marches use it all the while until they hear of the signal.
CHILD = """
import os, signal, threading, time
import jounce
import numpy as np

# A process that a shell has started in the background ignores the signal, and so would what it starts.
signal.signal(signal.SIGINT, signal.default_int_handler)
# All modules are loaded, so that the signal interrupts the call and not an import.
names = [getattr(jounce, name) for name in jounce.__all__]
harvester = jounce.read({spec!r})
{setup}
sent = []

def interrupt():
    time.sleep({after})
    sent.extend((time.process_time(), time.perf_counter()))
    os.kill(os.getpid(), signal.SIGINT)

threading.Thread(target=interrupt, daemon=True).start()
try:
    # Again where it ends before the signal comes: how long it takes is no matter of this test.
    while True:
        {call}
except jounce.Interrupted as stopped:
    print(time.process_time() - sent[0], time.perf_counter() - sent[1], type(stopped.result).__name__, {result_size})
"""

#: A second stop below the first, and a run without end.
TWO_STOPS = {
    "stop": {
        "tip": {"at": "beam.tip", "law": "hertz", "gap": "1 mm", "stiffness": "1000 N/m^1.5"},
        "below": {"at": "beam.tip", "side": "negative", "law": "hertz", "gap": "1 mm", "stiffness": "1000 N/m^1.5"},
    },
    "run": {"duration": "100000 s"},
}

#: The patch behind a bridge of diodes, so that the march goes from one regime to another, and a run without end.
RECTIFIED = {
    "circuit": {"load": {"patch": "mfc", "interface": "bridge", "storage": "1 uF", "resistance": "1 Mohm", "diode_resistance": "1 ohm"}},
    "run": {"duration": "100000 s"},
}

#: Mean powers to fit, each of a run.
POWERS = {
    "free": {"stop.tip.stiffness": 0.1},
    "power": [{"over": "stop.tip.gap", "values": ["1 mm", "2 mm"], "mean_power_w": [1e-4, 1e-4], "deviation": 0.1}],
}

CALLS = {
    "run": ('changed({"run.duration": "100000 s"}).run()', 0.5, "0"),
    "run against two stops": (f"__class__({{**harvester.to_dict(), **{TWO_STOPS}}}).run()", 0.5, "0"),
    "run behind a rectifier": (f"__class__({{**harvester.to_dict(), **{RECTIFIED}}}).run()", 0.5, "0"),
    "sweep": ('sweep("drive.shaker.frequency", "4 Hz:20 Hz:0.001 Hz", direction="both", threads=2)', 3.0, "len(stopped.result)"),
    "independent sweep": (
        'sweep("drive.shaker.frequency", "4 Hz:20 Hz:0.001 Hz", direction="independent", threads=2)',
        3.0,
        "len(stopped.result)",
    ),
    "branch": ('branch("drive.shaker.frequency", "4 Hz:20 Hz", threads=2)', 0.4, "0"),
    "harmonic balance": ('branch("drive.shaker.frequency", "4 Hz:20 Hz", method="harmonic-balance", seeds=0, threads=2)', 0.4, "0"),
    "bifurcations": ('bifurcations("drive.shaker.frequency", "4 Hz:20 Hz", "stop.tip.gap", "0.5 mm:2 mm", threads=2)', 0.8, "0"),
    "diagram": ('diagram("drive.shaker.frequency", "4 Hz:20 Hz:0.001 Hz", threads=2)', 3.0, "len(stopped.result)"),
    "diagram of starts": (
        'diagram("drive.shaker.frequency", "4 Hz:20 Hz:0.001 Hz", direction="starts", threads=2)',
        2.0,
        "len(stopped.result)",
    ),
    "ensemble": ('jounce.examples()["random-base"].ensemble(members=20000, threads=2)', 2.0, "len(stopped.result)"),
    "noise": ('jounce.examples()["random-base"].noise(points=1000000)', 0.5, "0"),
    "noise of a long run": ('jounce.examples()["random-base"].changed({"run.duration": "100000 s"}).run()', 0.5, "0"),
    "power": (
        'jounce.power(recording, "1 Mohm", drive="13.5 Hz")',
        1.0,
        "0",
    ),
    "basins": ("basins(starts=100000, threads=2)", 3.0, "(stopped.result.attractor_index >= 0).sum()"),
    "rig on a solution": ('rig(solution="1a", starts=100000)', 1.0, "0"),
    "fit": (f'changed({{"run.duration": "100000 s"}}).fit({POWERS})', 0.5, "0"),
    "reproduce": ('jounce.reproduce("out", threads=2)', 2.0, "0"),
}

#: What is made before the time until the signal is counted.
SETUP = {"power": 'recording = jounce.Recording.of(np.tile(np.sin(0.05 * np.arange(1000.0)), 20000), 1536.0, units="V")'}


@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c_ends_a_call_at_once_and_returns_the_finished_part(name, tmp_path):
    call, after, result_size = CALLS[name]
    call = call if call.startswith("jounce.") else f"harvester.{call}"
    setup = SETUP.get(name, "")
    code = textwrap.dedent(CHILD.format(spec=str(SPEC), setup=setup, call=call, after=after, result_size=result_size))
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    cpu_time_s, wall_time_s, kind, count = done.stdout.split()
    # A tenth of a second for each thread at work. Measured on two cores that ten other jobs shared: 0.001 s to 0.02 s. With a signal half a
    # second late `run` uses 0.16 s even so; a process that gets little of a busy machine uses less, so only an idle machine is conclusive.
    threads = 2 if "threads=2" in call else 1
    assert float(cpu_time_s) < 0.1 * threads, f"{cpu_time_s} s of processor time, {wall_time_s} s in all"
    # Waiting without work uses no processor time; no machine should be so busy that this fails of itself.
    assert float(wall_time_s) < 5.0, f"{wall_time_s} s, of which {cpu_time_s} s of processor time"
    if "sweep" in name:
        assert kind == "SweepResult" and int(count) > 0
    if name == "basins":
        assert kind == "BasinsResult" and int(count) > 0


def test_progress_is_reported_and_can_end_the_call(short):
    reports = []
    short.sweep(FREQUENCY, "10 Hz:11 Hz:21x", progress=lambda *report: reports.append(report))
    done, total, left = reports[-1]
    assert (done, total, left) == (21, 21, 0.0) and all(a[0] <= b[0] for a, b in zip(reports, reports[1:]))

    class StopRequest(Exception):
        pass

    def stop(done, total, seconds_left):
        raise StopRequest

    with pytest.raises(StopRequest):
        short.sweep(FREQUENCY, "10 Hz:11 Hz:10001x", progress=stop)


def test_progress_of_a_run_is_the_simulated_time(harvester):
    reports = []
    # The longest run ends soon enough, and the first is long enough for several looks on any machine.
    for seconds in (20_000, 200_000):
        reports.clear()
        harvester.changed({"run.duration": f"{seconds} s"}).run(progress=lambda *report: reports.append(report))
        if len(reports) > 2:
            break
    assert reports[-1] == (1000, 1000, 0.0) and 0 < reports[0][0] < 1000
    assert all(a[0] <= b[0] and b[1] == 1000 for a, b in zip(reports, reports[1:]))
    short = harvester.changed({"run.duration": "2 s", "run.average_over": "1 s"})
    assert short.run(progress=lambda *report: None) == short.run()


def test_progress_of_a_fit_is_the_number_of_models(harvester):
    reports = []
    features = {"hold": ["table"], "frequency_deviation": 0.01, "free": {"beam.beam.thickness": 0.05}}
    result = harvester.fit({**features, "mode": [{"number": 1, "frequency": "8.8 Hz"}]}, progress=lambda *report: reports.append(report))
    # How many more there will be nobody knows.
    assert reports[-1] == (result.evaluations, 0, None)


def test_progress_of_the_paper_is_reported_and_can_end_it(tmp_path):
    class StopRequest(Exception):
        pass

    reports = []

    def stop(*report):
        reports.append(report)
        if len(reports) == 3:
            raise StopRequest

    with pytest.raises(StopRequest):
        jounce.reproduce(tmp_path / "out", progress=stop)
    assert 0 < reports[-1][0] < reports[-1][1] and reports[-1][2] > 0.0


def test_a_bar_is_shown_on_demand(short, capsys):
    short.sweep(FREQUENCY, "10 Hz:11 Hz:3x", fixed_duration=True, progress=True)
    assert "3/3" in capsys.readouterr().err


def test_other_threads_run_during_a_call(harvester):
    iterations, done = 0, threading.Event()

    def work():
        harvester.changed({"run.duration": "20000 s"}).run()
        done.set()

    worker = threading.Thread(target=work)
    worker.start()
    while not done.wait(0.001):
        iterations += 1
    worker.join()
    # The run takes most of a second; with the lock held, the loop would turn once or twice.
    assert iterations > 10


def test_threads_and_processes_give_the_same_bits(short):
    gaps = [f"{gap} mm" for gap in (0.5, 1.0, 1.5, 2.0)]
    specs = [short.changed({"stop.tip.gap": gap}) for gap in gaps]
    one = [spec.run() for spec in specs]
    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(jounce.Spec.run, specs)) == one
    for start_method in ("spawn", "forkserver"):
        with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(start_method)) as pool:
            assert list(pool.map(jounce.Spec.run, specs)) == one


def test_interrupted_is_a_keyboard_interrupt():
    assert issubclass(jounce.Interrupted, KeyboardInterrupt)
    # What the interpreter itself sets: nothing, where a shell has started the tests in the background.
    assert signal.getsignal(signal.SIGINT) in (signal.default_int_handler, signal.SIG_IGN)
