"""The notebooks run from beginning to end and draw."""

import runpy

import matplotlib.pyplot as plt
import pytest
from conftest import ROOT

NOTEBOOKS = sorted((ROOT / "python/notebooks").glob("*.py"))


@pytest.mark.long
@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(notebook):
    runpy.run_path(str(notebook))
    assert plt.get_fignums()
    plt.close("all")
