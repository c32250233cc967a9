"""Every Python block of README and book runs; the one of README in an empty environment after the command that it gives."""

import importlib.util
import os
import re
import shlex
import subprocess
import sys
import venv
from pathlib import Path

import pytest
from conftest import ROOT

BLOCK = re.compile(r"^```python\n(.*?)^```", re.MULTILINE | re.DOTALL)
#: Libraries of recipes that jounce does not need.
RECIPE_LIBRARY = re.compile(r"^(?:from|import) (pyuff|sfepy|skfem)\b", re.MULTILINE)
DOCUMENTS = [ROOT / "README.md", *sorted((ROOT / "book/src").rglob("*.md"))]


def blocks(document):
    return BLOCK.findall(document.read_text(encoding="utf-8"))


def run(python, code, folder):
    environment = {**os.environ, "MPLBACKEND": "agg"}
    environment.pop("PYTHONPATH", None)
    (folder / "block.py").write_text(code, encoding="utf-8")
    return subprocess.run([python, "block.py"], cwd=folder, env=environment, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("document", [d for d in DOCUMENTS if blocks(d)], ids=lambda d: d.relative_to(ROOT).as_posix())
def test_the_blocks_of_a_document_run_in_sequence(document, tmp_path):
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    missing = {name for name in RECIPE_LIBRARY.findall("\n".join(blocks(document))) if importlib.util.find_spec(name) is None}
    code = [block for block in blocks(document) if not missing & set(RECIPE_LIBRARY.findall(block))]
    done = run(sys.executable, "\n".join(code), tmp_path)
    assert done.returncode == 0, done.stderr
    if missing:
        pytest.skip(f"{', '.join(sorted(missing))} is not installed, so its recipes in {document.name} did not run")


@pytest.mark.long
def test_readme_works_in_an_empty_environment(tmp_path):
    """The install command of README, run with the wheel that the tests were given in place of the sources where there is one."""
    command = re.search(r"^(pip install .*)$", (ROOT / "README.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert command, "README gives no install command"
    *_, target = shlex.split(command.group(1))
    wheel = os.environ.get("JOUNCE_WHEEL")
    if wheel is None:
        pytest.skip("./test builds the wheel and names it in JOUNCE_WHEEL")
    assert target.startswith(".["), "README installs this folder with an extra"
    venv.create(tmp_path / "venv")
    python = tmp_path / "venv" / ("Scripts" if os.name == "nt" else "bin") / "python"
    pip = [sys.executable, "-m", "pip", "--python", str(python)]
    installed = [*pip, "install", "--quiet", "--no-compile", str(Path(wheel).resolve()) + target.removeprefix(".")]
    subprocess.run(installed, check=True)
    (block,) = blocks(ROOT / "README.md")
    done = run(str(python), block, tmp_path)
    assert done.returncode == 0, done.stderr
    (picture,) = tmp_path.glob("*.png")
    assert picture.read_bytes().startswith(b"\x89PNG") and picture.stat().st_size > 5000 and done.stdout


def test_the_reference_equals_the_docstrings():
    generated = subprocess.run([sys.executable, "-P", ROOT / "python/reference.py"], capture_output=True, text=True, check=True).stdout
    stored = (ROOT / "book/src/python-reference.md").read_text(encoding="utf-8")
    assert stored == generated, "make it again: python -P python/reference.py > book/src/python-reference.md"


def test_citation_changelog_and_sources_have_one_version():
    def version(name, pattern):
        return re.search(pattern, (ROOT / name).read_text(encoding="utf-8"), re.MULTILINE)[1]

    cargo = version("Cargo.toml", r'^version = "(.*)"$')
    assert version("CITATION.cff", r"^version: (.*)$") == cargo
    assert version("CHANGELOG.md", r"^## \[(.*)\]") == cargo
