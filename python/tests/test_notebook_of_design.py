"""The notebook of the tutorial's design runs in a kernel from beginning to end and finds the design that it describes."""

import json
import shutil

import nbformat
import pytest
from conftest import ROOT
from nbclient import NotebookClient

NOTEBOOK = ROOT / "examples/pump-sensor/design.ipynb"

RESULT = """
import json
print(json.dumps({
    "before_w": before.expected_power_w,
    "best_w": result.mean_power_w,
    "feasible": result.feasible,
    "least_w": float(speeds.mean_power_w.min()),
    "folds_hz": [hz for each in branch for kind, hz in zip(each.bifurcation_kind, each.bifurcation_parameter.tolist()) if kind == "fold"],
    "weakest_w": weakest.mean_power_w,
    "warnings": reached.warnings,
}))
"""


@pytest.fixture(scope="module")
def notebook():
    return nbformat.read(NOTEBOOK, as_version=4)


def test_it_is_stored_without_outputs(notebook):
    nbformat.validate(notebook)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert code
    assert all(not cell.outputs and cell.execution_count is None for cell in code)


@pytest.mark.long
# The kernel and its client warn of their own future changes.
@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::ResourceWarning")
def test_it_leads_from_the_question_to_a_drawing(notebook, tmp_path):
    shutil.copy(NOTEBOOK.parent / "fitted.toml", tmp_path)
    copy = nbformat.from_dict(notebook)
    copy.cells.append(nbformat.v4.new_code_cell(RESULT))
    NotebookClient(copy, timeout=600, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}).execute()
    found = json.loads(copy.cells[-1].outputs[0]["text"])
    # The need is 0.3 mW, and the highest speed 26.5 Hz.
    assert found["before_w"] < 1e-4
    assert found["feasible"] and found["best_w"] > 20.0 * found["before_w"]
    assert found["least_w"] > 3e-4 and found["weakest_w"] > 3e-4
    assert max(found["folds_hz"]) > 26.5 + 0.5
    assert not found["warnings"]
    drawing = next(cell for cell in copy.cells if cell.get("id") == "build")
    assert any("image/png" in output.get("data", {}) for output in drawing.outputs)
