"""The package is typed: mypy accepts it and a program that uses it, and its stubs are those of the compiled module."""

import subprocess
import sys

import pytest
from conftest import ROOT


@pytest.mark.parametrize("arguments", [["mypy"], ["mypy.stubtest", "jounce._core"]], ids=["mypy", "stubtest"])
def test_types(arguments, tmp_path):
    cache = [f"--cache-dir={tmp_path}"] if arguments == ["mypy"] else []
    done = subprocess.run([sys.executable, "-m", *arguments, *cache], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
