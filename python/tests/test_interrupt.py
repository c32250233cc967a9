"""Interrupted work: a short campaign of `campaigns/interrupt.py`, and files that are written completely or not at all."""

import errno
import os
import shutil
import subprocess
import sys

import pytest
from conftest import ROOT

import jounce
from jounce._files import write_whole


@pytest.mark.skipif(os.name == "nt", reason="signals of Unix")
def test_work_that_is_interrupted_continues(program):
    script = [sys.executable, str(ROOT / "campaigns" / "interrupt.py"), "--kills=20", f"--program={program}"]
    done = subprocess.run(script, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.splitlines()[-1].startswith("all")


@pytest.mark.skipif(os.name == "nt", reason="signals of Unix")
def test_a_program_that_loses_work_is_found(program, tmp_path):
    """A program that removes its journal at each start, and one that writes its result in place."""
    loses = tmp_path / "loses"
    loses.write_text(f'#!/bin/sh\nrm -f "$JOUNCE_CACHE"/*.jsonl\nexec {program} "$@"\n')
    in_place = tmp_path / "in-place"
    in_place.write_text(f'#!/bin/sh\nmkdir -p disk/out\nprintf partial >disk/out/sweep.csv\nsleep 0.2\nexec {program} "$@"\n')
    for wrong, words in ((loses, "journal"), (in_place, "sweep.csv")):
        wrong.chmod(0o755)
        script = [sys.executable, str(ROOT / "campaigns" / "interrupt.py"), "--kills=10", "--only=sweep", f"--program={wrong}"]
        done = subprocess.run(script, capture_output=True, text=True, check=False)
        assert done.returncode == 1 and words in done.stdout, done.stdout + done.stderr


def test_a_file_is_written_completely_or_not_at_all(tmp_path):
    path = tmp_path / "new" / "folder" / "file"
    write_whole(path, "the file", lambda file: file.write(b"old"))

    def fill(file):
        file.write(b"a part")
        raise OSError(errno.ENOSPC, "No space left on device")

    with pytest.raises(jounce.FileError, match="the file .* cannot be written: .*No space left") as raised:
        write_whole(path, "the file", fill)
    assert raised.value.errno == errno.ENOSPC and raised.value.details["path"] == str(path)
    assert path.read_bytes() == b"old" and os.listdir(path.parent) == ["file"]
    ordinary = path.with_name("ordinary")
    ordinary.write_bytes(b"")
    assert path.stat().st_mode == ordinary.stat().st_mode
    shutil.rmtree(tmp_path / "new")
    csv = path.with_name("file.csv")
    jounce.write_recording(csv, [1.0, 2.0], 1.0)
    assert csv.read_text() == "time (s),value\n0.0,1.0\n1.0,2.0\n"
