"""Import of the package: in addition to numpy it loads only what every call needs."""

import subprocess
import sys

import jounce


def loaded(program):
    """Returns the modules that a program loads in addition to those of numpy."""
    program = f"import sys, numpy\nbefore = set(sys.modules)\n{program}\nprint(*(set(sys.modules) - before))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


def test_the_import_loads_nothing_that_is_not_used():
    modules = loaded("import jounce")
    assert modules - {"__future__"} == {"jounce", "jounce._core", "jounce._docstrings"}


def test_a_call_loads_the_modules_that_it_needs():
    modules = loaded("import jounce; jounce.examples()['impact-harvester-2019'].modes()")
    assert "jounce._modes" in modules
    assert not {"jounce._run", "jounce._study", "jounce._inputs", "jounce._plot", "concurrent.futures", "hashlib", "zipfile"} & modules
    assert not {"matplotlib", "pandas", "xarray", "pint", "scipy", "tqdm", "distributed"} & modules


def test_results_are_documented_without_a_use_of_their_names():
    program = "import jounce; modes = jounce.examples()['impact-harvester-2019'].modes(); print(modes.__doc__, modes.plot.__doc__)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert "Attributes\n" in done.stdout and "Parameters\n" in done.stdout and "optional, optional" not in done.stdout


def test_every_name_is_that_of_its_module():
    assert set(jounce._MODULE_OF) == set(jounce.__all__) - {"__version__"}
    assert set(jounce.__all__) <= set(dir(jounce))
