"""The package is typed: mypy accepts it and a program that uses it, and its stubs are those of the compiled module and of its sources."""

import subprocess
import sys

import pytest
from conftest import ROOT


@pytest.mark.parametrize("arguments", [["mypy"], ["mypy.stubtest", "jounce._core"]], ids=["mypy", "stubtest"])
def test_types(arguments, tmp_path):
    cache = [f"--cache-dir={tmp_path}"] if arguments == ["mypy"] else []
    done = subprocess.run([sys.executable, "-m", *arguments, *cache], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_stubs_equal_the_sources():
    generated = subprocess.run([sys.executable, "-P", ROOT / "python/stubs.py"], capture_output=True, text=True, check=True).stdout
    stored = (ROOT / "python/jounce/_core.pyi").read_text(encoding="utf-8")
    assert stored == generated, "make them again: python -P python/stubs.py > python/jounce/_core.pyi"
