"""The package is typed: mypy and pyright accept it and a program that uses it; its stubs and tables are those of their sources."""

import subprocess
import sys

import pytest
from conftest import ROOT

#: The compiled module imports nothing of the package; without this the package and all libraries that it uses would be read too.
STUBTEST_SETTINGS = "[mypy]\n[mypy-jounce]\nfollow_imports = skip\n"


@pytest.mark.long
@pytest.mark.parametrize("tool", ["mypy", "stubtest"])
def test_types(tool, tmp_path):
    settings = tmp_path / "stubtest.ini"
    settings.write_text(STUBTEST_SETTINGS, encoding="utf-8")
    arguments = {
        "mypy": ["mypy", f"--cache-dir={tmp_path / 'cache'}"],
        "stubtest": ["mypy.stubtest", "jounce._core", f"--mypy-config-file={settings}"],
    }
    done = subprocess.run([sys.executable, "-m", *arguments[tool]], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_stubs_equal_the_sources():
    generated = subprocess.run([sys.executable, "-P", ROOT / "python/stubs.py"], capture_output=True, text=True, check=True).stdout
    stored = (ROOT / "python/jounce/_core.pyi").read_text(encoding="utf-8")
    assert stored == generated, "make them again: python -P python/stubs.py > python/jounce/_core.pyi"


@pytest.mark.long
def test_pyright_accepts_the_package_and_a_program():
    pytest.importorskip("pyright")
    command = [sys.executable, "-m", "pyright", "--pythonpath", sys.executable]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_types_of_the_tables_are_those_of_the_schema():
    generated = subprocess.run([sys.executable, "-P", ROOT / "python/tables.py"], capture_output=True, text=True, check=True).stdout
    stored = (ROOT / "python/jounce/_tables.py").read_text(encoding="utf-8")
    assert stored == generated, "make them again: python -P python/tables.py > python/jounce/_tables.py"
