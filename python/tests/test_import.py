"""Import of the package: beside numpy it loads only what every call needs."""

import subprocess
import sys

#: Modules of the standard library that the package needs at import, with those that they load.
NEEDED = {"__future__", "_json", "atexit", "copy", "dataclasses", "json"}
#: Loaded by pathlib, unless numpy has loaded it.
OF_PATHLIB = {"errno", "fnmatch", "glob", "ipaddress", "ntpath", "pathlib", "urllib"}

PROGRAM = """
import sys, numpy
before = set(sys.modules)
import jounce
print(*sorted({name.partition(".")[0] for name in set(sys.modules) - before}))
"""


def test_the_import_loads_nothing_that_is_not_used():
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True)
    assert set(done.stdout.split()) - NEEDED - OF_PATHLIB - {"numpy"} == {"jounce"}


def test_pictures_and_optional_packages_are_loaded_by_the_calls_that_need_them():
    program = "import sys, jounce; jounce.examples()['impact-harvester-2019'].modes(); print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    loaded = set(done.stdout.split())
    assert "jounce" in loaded
    assert not {"matplotlib", "pandas", "xarray", "pint", "scipy", "tqdm", "distributed", "concurrent", "jounce._plot"} & loaded
