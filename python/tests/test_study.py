"""Studies: the same table whoever computes it, on disk as it grows, and clear words where something is wrong."""

import itertools
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import textwrap
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool

import numpy as np
import pytest
from conftest import ROOT

import jounce

VARY = {"stop.tip.gap": "0.5mm:1.5mm:4x", "drive.shaker.frequency": "11Hz:13Hz:4x", "circuit.load.resistance": "100kohm:1Mohm:2log"}


@pytest.fixture
def study(short):
    return jounce.Study(short.changed({"run.duration": "0.5 s", "run.average_over": "0.25 s"}), VARY, points_per_part=4)


@pytest.fixture
def table(study, tmp_path):
    return study.run(tmp_path / "alone").path.read_bytes()


def test_a_study_is_a_table(study, tmp_path):
    result = study.run(tmp_path, progress=lambda done, total, left: None)
    study_table = result.table()
    assert len(study_table) == 32 == len(study) and study.parts == 8 and study_table.keys == list(VARY)
    assert list(study_table["stop.tip.gap"][:4]) == [0.5e-3, *np.linspace(0.5e-3, 1.5e-3, 4)[1:]]
    # Finished runs are not repeated.
    assert result.wall_time_s > 0.0 and study.run(tmp_path).wall_time_s == 0.0
    # A row is the run of the changed spec, bit by bit.
    gap, frequency, load = study.point(13)
    single = study.spec
    single.set({"stop.tip.gap": f"{gap!r} m", "drive.shaker.frequency": f"{frequency!r} Hz", "circuit.load.resistance": f"{load!r} ohm"})
    assert single.run().mean_power_w == study_table["mean_power_w"][13]
    frame, dataset = result.to_pandas(), result.to_xarray()
    assert len(frame) == 32 and dataset.mean_power.attrs["units"] == "W" and dataset["stop.tip.gap"].attrs["units"] == "m"
    place = dict(zip(VARY, (gap, frequency, load)))
    assert dataset.mean_power.dims == tuple(VARY) and dataset.mean_power.sel(place) == study_table["mean_power_w"][13]
    assert (
        result.status.finished == 8 and result.status.failed_points == 0 and study_table.manifest["options"]["study_sha256"] == study.sha256
    )
    restored = pickle.loads(pickle.dumps(study))
    assert restored == study and restored.sha256 == study.sha256 and pickle.loads(pickle.dumps(study_table)) == study_table
    assert "32 points" in repr(study) and study_table._repr_html_().startswith("<table>") and "32" in repr(study_table)


def test_the_command_line_computes_the_same_table(study, tmp_path):
    (tmp_path / "harvester.toml").write_text(study.spec.to_toml(), encoding="utf-8")
    (tmp_path / "study.toml").write_text(study.to_toml("harvester.toml"), encoding="utf-8")
    program = os.environ.get("JOUNCE_BIN") or next(p for p in (ROOT / "target/release/jounce", ROOT / "target/debug/jounce") if p.exists())
    for shard in ("2/2", "1/2"):
        subprocess.run([program, "study", "run", tmp_path / "study.toml", "--out", tmp_path / "out", "--shard", shard], check=True)
    own, computed = (study.run(tmp_path / folder).table() for folder in ("alone", "out"))
    assert list(own.columns) == list(computed.columns)
    for name, values in own.columns.items():
        one, other = np.asarray(values), np.asarray(computed[name])
        # Texts as texts, numbers bit by bit.
        is_same = one.tolist() == other.tolist() if one.dtype == object else one.tobytes() == other.tobytes()
        assert one.dtype == other.dtype and is_same, name
    # The table of a command leads back to it.
    manifests = own.manifest, computed.manifest
    assert manifests[1].pop("record") and manifests[0] == manifests[1]


@pytest.mark.parametrize("executor", [lambda: ThreadPoolExecutor(2), lambda: pool()], ids=["threads", "processes"])
def test_an_executor_computes_the_same_table(study, table, tmp_path, executor):
    reports = []
    with executor() as workers:
        result = study.run(tmp_path, executor=workers, progress=lambda *report: reports.append(report))
    assert result.path.read_bytes() == table and reports[-1][:2] == (32, 32) and result.wall_time_s > 0.0


def pool():
    return ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn"))


def test_a_killed_worker_of_a_pool_loses_nothing(study, table, tmp_path):
    with pool() as workers:
        victims = [workers.submit(os.getpid).result()]

        def kill(done, total, left):
            while victims:
                os.kill(victims.pop(), signal.SIGKILL)

        with pytest.raises(BrokenProcessPool):
            study.run(tmp_path, executor=workers, progress=kill)
    assert 0 < jounce.StudyStatus.read(tmp_path).finished < 8
    with pool() as workers:
        assert study.run(tmp_path, executor=workers).path.read_bytes() == table


class Losing(ThreadPoolExecutor):
    """Loses some of its tasks after they were computed."""

    def __init__(self, lost):
        super().__init__(2)
        self.lost = iter(lost)

    def submit(self, function, /, *args, **kwargs):
        """Submits a task, which may be lost."""
        is_lost = next(self.lost, False)

        def task():
            result = function(*args, **kwargs)
            if is_lost:
                raise ValueError("the task was lost")
            return result

        return super().submit(task)


def test_tasks_that_an_executor_loses_are_submitted_again(study, table, tmp_path):
    with Losing([True, False, True, True, False]) as workers:
        assert study.run(tmp_path / "some", executor=workers).path.read_bytes() == table
    with Losing(itertools.repeat(True)) as workers, pytest.raises(ValueError, match="the task was lost"):
        study.run(tmp_path / "all", executor=workers)


def test_dask_computes_the_same_table_and_survives_a_killed_worker(study, table, tmp_path):
    distributed = pytest.importorskip("distributed")
    import dask

    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 100, "distributed.worker.memory.terminate": False}),
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0") as cluster,
        distributed.Client(cluster) as client,
    ):
        workers = list(client.run(os.getpid).values())
        killed = []

        def kill(done, total, left):
            if not killed:
                killed.append(workers[0])
                os.kill(workers[0], signal.SIGKILL)

        result = study.run(tmp_path, executor=client.get_executor(), progress=kill)
        assert killed and result.path.read_bytes() == table


def test_killed_five_times_and_resumed_it_is_the_same_table(study, table, tmp_path):
    spec = tmp_path / "spec.pickle"
    spec.write_bytes(pickle.dumps(study))
    code = textwrap.dedent(f"""
        import pickle, pathlib
        study = pickle.loads(pathlib.Path({str(spec)!r}).read_bytes())
        study.run({str(tmp_path / "out")!r}, threads=1)
    """)

    def parts():
        return len(list((tmp_path / "out/parts").glob("part-*.parquet")))

    for _ in range(5):
        n_parts, child = parts(), subprocess.Popen([sys.executable, "-c", code])
        # At work: a part more than before is there, and the next one is being made.
        while parts() == n_parts and child.poll() is None:
            time.sleep(0.001)
        child.kill()
        child.wait()
    assert study.run(tmp_path / "out").path.read_bytes() == table


def test_the_file_of_a_study_is_read_and_its_shards_are_merged(command_line, tmp_path):
    file = ROOT / "examples/impact-harvester-2019/study.toml"
    study = jounce.Study.read(file)
    study.run(tmp_path / "out", shard="1/2")
    result = jounce.StudyResult(tmp_path / "out")
    with pytest.raises(jounce.StudyError, match="missing"):
        result.merge()
    command_line("study", "run", str(file), f"--out={tmp_path / 'out'}", "--shard=2/2", spec=None)
    # The command line has merged it, being the last; so does this.
    result.path.unlink()
    assert result.merge() == result.path and len(result.table()) == len(study) == 18
    assert pickle.loads(pickle.dumps(study)) == study
    for text, kind in (("[vary]", jounce.SpecError), ("vary = ", jounce.SpecError), ('spec = "none.toml"', jounce.FileError)):
        (tmp_path / "wrong.toml").write_text(text)
        with pytest.raises(kind):
            jounce.Study.read(tmp_path / "wrong.toml")
    with pytest.raises(jounce.FileError, match="cannot be read"):
        jounce.Study.read(tmp_path / "no-such-study.toml")


def test_drawn_points_and_other_quantities(harvester, tmp_path):
    vary = {"stop.tip.gap": "0.5 mm:1.5 mm", "circuit.load.resistance": "1 kohm:1 Mohm:log"}
    for sampling in ("random", "latin-hypercube", "sobol"):
        study = jounce.Study(harvester, vary, sampling=sampling, points=16, seed=3, quantity={"command": "modes", "count": 2})
        study_table = study.run(tmp_path / sampling).table()
        assert len(study_table) == 16 and ((study_table["stop.tip.gap"] >= 0.5e-3) & (study_table["stop.tip.gap"] <= 1.5e-3)).all()
        assert study_table["frequency_2_hz"] == pytest.approx(harvester.modes().frequency_hz[1])
        assert study != jounce.Study(harvester, vary, sampling=sampling, points=16, seed=4, quantity={"command": "modes", "count": 2})


def test_bifurcations_as_a_quantity_end_at_the_folds_of_branches(tmp_path):
    plant, key, over = jounce.read(ROOT / "bench/plant.toml"), "drive.shaker.frequency", "12Hz:12.35Hz"
    quantity = {
        "command": "bifurcations",
        "over": f"{key}={over}",
        "against": "stop.tip.gap=0.99mm:1.01mm",
        "seeds": 0,
        "longest_period": 1,
    }
    study_table = jounce.Study(plant, {"drive.shaker.amplitude": "50 N"}, quantity=quantity).run(tmp_path).table()
    folds = []
    for gap in ("0.99 mm", "1.01 mm"):
        for branch in plant.changed({"stop.tip.gap": gap}).branch(key, over, seeds=0, longest_period=1):
            folds += [at for kind, at in zip(branch.bifurcation_kind, branch.bifurcation_parameter) if kind == "fold"]
    assert study_table["folds"][0] == study_table["curves"][0] == 1 and len(folds) == 2
    # The fold moves with the gap in one direction, so that its ends are the folds at the ends of the range of gaps: off by 2.3e-10 Hz.
    assert [study_table["fold_low"][0], study_table["fold_high"][0]] == pytest.approx(sorted(folds), abs=1e-8)


def test_noise_as_a_quantity_equals_the_response_to_noise(tmp_path):
    noisy = jounce.examples()["random-base"]
    study_table = jounce.Study(noisy, {"stop.tip.gap": "1mm:2mm:2x"}, quantity="noise").run(tmp_path).table()
    for row, gap in enumerate(("1 mm", "2 mm")):
        response = noisy.changed({"stop.tip.gap": gap}).noise(points=2)
        assert study_table["mean_power_w"][row] == response.mean_power_w > 0.0
        assert study_table["voltage_rms_v"][row] == response.load_voltage_rms_v[0]
        assert study_table["statistical_bandwidth_hz"][row] == response.load_statistical_bandwidth_hz[0]
        assert (study_table["reached_hz"][row], study_table["share_beyond"][row]) == (
            response.stop_reached_hz[0],
            response.stop_share_beyond[0],
        )


def test_invalid_studies_raise_errors(study, harvester, tmp_path):
    with pytest.raises(jounce.SpecError) as excinfo:
        jounce.Study(harvester, {"stop.tip.gapp": "1mm", "stop.tip.gap": "1kg"})
    assert len(excinfo.value.faults) == 2
    for invalid_call in (
        lambda: jounce.Study("harvester.toml", VARY),
        lambda: jounce.Study(harvester, "stop.tip.gap"),
        lambda: study.point(99),
    ):
        with pytest.raises(jounce.ArgumentError):
            invalid_call()
    for invalid_call in (
        lambda: study.run(tmp_path / "a", executor=3),
        lambda: study.run(tmp_path / "a", threads=-1),
        lambda: study.point(-1),
    ):
        with pytest.raises(jounce.ArgumentError):
            invalid_call()
    with pytest.raises(jounce.SpecError, match='"0.5mm:1.5mm:4x" cannot be drawn from; drawn values need a range FROM:TO'):
        jounce.Study(harvester, {"stop.tip.gap": "0.5mm:1.5mm:4x"}, sampling="random", points=4)
    with pytest.raises(jounce.SpecError, match="noise needs a drive"):
        jounce.Study(harvester, {"stop.tip.gap": "1mm"}, quantity="noise")
    with pytest.raises(jounce.ArgumentError, match="write I/N"):
        study.run(tmp_path / "a", shard="9/8")
    partial_result = study.run(tmp_path / "b", shard="1/8")
    with pytest.raises(jounce.ArgumentError, match="lacks 7 parts"):
        partial_result.to_pandas()
    other = jounce.Study(harvester, VARY)
    with pytest.raises(jounce.StudyError, match="another study"):
        other.run(tmp_path / "b")
    with pytest.raises(jounce.StudyError, match="holds no study"):
        jounce.StudyStatus.read(tmp_path / "none")
    (tmp_path / "file").write_text("")
    with pytest.raises(jounce.StudyError, match="cannot write into"):
        study.run(tmp_path / "file/below")
    part = tmp_path / "b/parts/part-000000.parquet"
    part.write_bytes(part.read_bytes()[:100])
    assert partial_result.status.damaged == [str(part)]
    full_result = study.run(tmp_path / "b")
    assert full_result.status.finished == 8 and not full_result.status.damaged


def test_two_processes_at_one_study_lose_nothing(study, table, tmp_path):
    code = textwrap.dedent("""
        import pickle, sys, jounce
        study, out, shard = pickle.loads(sys.stdin.buffer.read())
        try:
            study.run(out, shard=shard, threads=1)
        except jounce.StudyError as error:
            print(error)
    """)

    def run_shard(shard):
        payload = pickle.dumps((study, str(tmp_path / "out"), shard))
        return subprocess.run([sys.executable, "-c", code], input=payload, stdout=subprocess.PIPE, check=True).stdout.decode()

    with ThreadPoolExecutor(2) as pool:
        # Two processes on the complete study: the second fails with the name of the first, or starts when that is done.
        outputs = list(pool.map(run_shard, ["1/1", "1/1"]))
        assert all(text == "" or "another process works on shard 1/1" in text for text in outputs) and "" in outputs
        assert (tmp_path / "out/study.parquet").read_bytes() == table
        # Two halves share it.
        (tmp_path / "out/parts/part-000003.parquet").unlink()
        assert list(pool.map(run_shard, ["1/2", "2/2"])) == ["", ""]
        assert (tmp_path / "out/study.parquet").read_bytes() == table


@pytest.mark.skipif(os.name == "nt" or os.getuid() == 0, reason="whoever may write everywhere is refused nowhere")
def test_a_folder_that_cannot_be_written_raises_an_error(study, tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(jounce.StudyError, match="cannot write into"):
        study.run(tmp_path / "out")


@pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="there is no folder in which even root makes none")
def test_a_folder_that_nobody_can_write_raises_an_error(study, harvester):
    with pytest.raises(jounce.StudyError, match="cannot write into"):
        study.run("/proc/study")
    for write in (harvester.write, jounce.State("{}").write, jounce.Recording.of([1.0, 2.0], 1.0).write):
        with pytest.raises(jounce.FileError, match="/proc/"):
            write("/proc/jounce.csv")


def test_a_damaged_table_is_reported_and_rebuilt(study, table, tmp_path):
    result = study.run(tmp_path)
    result.path.write_bytes(table[:50])
    with pytest.raises(jounce.FileError, match="cannot read the table"):
        result.table()
    assert study.run(tmp_path).path.read_bytes() == table


def test_ctrl_c_keeps_finished_parts(study, tmp_path):
    code = textwrap.dedent(f"""
        import os, signal, threading, time, jounce
        signal.signal(signal.SIGINT, signal.default_int_handler)
        # Some hundred seconds of work, however fast the machine.
        spec = jounce.Spec.read({str(ROOT / "examples/impact-harvester-2019/harvester.toml")!r}).changed({{"run.duration": "1000 s"}})
        study = jounce.Study(spec, {{"stop.tip.gap": "0.5mm:1.5mm:4000x"}}, points_per_part=1)
        sent = []
        def interrupt():
            time.sleep(2.0)
            sent.append(time.process_time())
            os.kill(os.getpid(), signal.SIGINT)
        threading.Thread(target=interrupt, daemon=True).start()
        try:
            study.run({str(tmp_path)!r}, threads=2)
        except jounce.Interrupted as stopped:
            print(time.process_time() - sent[0], stopped.result.finished)
    """)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)
    seconds, finished = done.stdout.split()
    # A tenth of a second for each thread, of processor time, which other work on the machine does not stretch. Measured: 0.02 s.
    assert float(seconds) < 0.2 and int(finished) > 0
