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


def same(found, wanted):
    """The same numbers, bit by bit."""
    np.testing.assert_array_equal(np.asarray(found), np.asarray(wanted))


@pytest.fixture
def harvester():
    return jounce.read(SPEC)


@pytest.fixture
def short(harvester):
    return harvester.changed(SHORT)


@pytest.fixture(scope="session")
def command_line(tmp_path_factory):
    """Runs the program on the paper's spec and gives its JSON answer."""
    named = os.environ.get("JOUNCE_BIN")
    program = (
        Path(named) if named else next((p for p in (ROOT / "target/release/jounce", ROOT / "target/debug/jounce") if p.exists()), None)
    )
    assert program is not None, "the program is not built; run `cargo build --release`, or name it in JOUNCE_BIN"
    cache = tmp_path_factory.mktemp("cache")

    def answer(command, *arguments, keys=None, spec=SPEC):
        settings = [f"--set={key}={value}" for key, value in (keys or {}).items()]
        call = [str(program), command, *([] if spec is None else [str(spec)]), *arguments, *settings, "--json"]
        done = subprocess.run(call, capture_output=True, text=True, env={**os.environ, "JOUNCE_CACHE": str(cache)}, check=False)
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    return answer
