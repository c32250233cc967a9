"""Structures of other programs: matrices in memory and in files, and the model as matrices."""

import itertools
import re
import shutil
import subprocess

import numpy as np
import pytest
from conftest import ROOT, assert_identical

import jounce

sparse = pytest.importorskip("scipy.sparse", reason="scipy is not installed, so matrices of scipy are not tested")
scipy_io = pytest.importorskip("scipy.io")

#: Stop, circuit, drive and run of the harvester of the paper, on the imported structure.
REST = {
    "stop": {"tip": {"at": "h.beam-tip", "frame": "ground", "law": "hertz", "gap": "1 mm", "stiffness": "1000 N/m^1.5"}},
    "circuit": {"load": {"patch": "h.mfc", "resistance": "1 Mohm"}},
    "drive": {"shaker": {"at": "h.table", "kind": "force", "amplitude": "200 N", "frequency": "13 Hz"}},
    "run": {"start": "rest", "duration": "5 s", "average_over": "2 s"},
}

#: Two equal masses and springs, clamped at one end.
MASS_KG, SPRING_N_M = 0.5, 100.0
STIFFNESS = SPRING_N_M * np.array([[2.0, -1.0], [-1.0, 1.0]])


def chain(**keywords):
    """Returns the modes of the chain with an electrode that pulls at its end."""
    electrical = {"coupling": {"mfc": [0.0, 1e-3]}, "capacitance": {"mfc": "30 nF"}, "leakage": {"mfc": "10 Mohm"}}
    given = {"points": {"tip": 1, "middle": [0.5, 0.5]}, "base": [1.0, 1.0], "modes": 2, **electrical, **keywords}
    return jounce.from_matrices(MASS_KG * np.eye(2), STIFFNESS, **given)


def test_matrices_of_an_export_are_the_same_harvester(harvester, tmp_path):
    files = harvester.export(matrices=tmp_path / "matrices", spice=tmp_path / "harvester.cir")
    assert len(files) == 10 and all(path.stat().st_size > 0 for path in files)
    imported = jounce.import_matrices(tmp_path / "matrices", name="h", modes=8)
    assert imported.electrodes == ["mfc"] and imported.warnings == [] and imported.orthogonality < 1e-14
    run = harvester.changed({"run.duration": "5 s", "run.average_over": "2 s"}).run()
    assert jounce.Spec(imported.tables, **REST).run().mean_power_w == pytest.approx(run.mean_power_w, rel=1e-10)
    with pytest.raises(jounce.ArgumentError, match="give a folder for the matrices"):
        harvester.export()


def test_imports_are_those_of_the_command_line(harvester, command_line, tmp_path):
    harvester.export(matrices=tmp_path)
    expected = command_line("import", tmp_path, "--name=h", "--modes=3", "--damping-ratio=0.02,0.01", "--mass-unit=1000kg", spec=None)
    result = jounce.import_matrices(tmp_path, name="h", modes=3, damping_ratio=[0.02, 0.01], mass_unit="1000 kg")
    assert result.spec == expected["spec"] and result.points == expected["points"]
    for field in ("frequency_hz", "damping_ratio", "frequency_error"):
        assert_identical(getattr(result, field), [mode[field] for mode in expected["modes"]])


def test_matrices_in_memory_have_the_modes_of_the_closed_form():
    result = chain(damping_ratio=[0.02, 0.03])
    # w^2 = (3 -+ sqrt 5) / 2 k / m; shapes (1, (1 +- sqrt 5) / 2).
    golden = (1.0 + np.sqrt(5.0)) / 2.0
    angular = np.sqrt(SPRING_N_M / MASS_KG) * np.array([1.0 / golden, golden])
    np.testing.assert_allclose(result.frequency_hz, angular / (2.0 * np.pi), rtol=1e-12)
    np.testing.assert_array_equal(result.damping_ratio, [0.02, 0.03])
    modal = result.tables["modal"]["structure"]
    shapes = np.array([[1.0, golden], [golden, -1.0]]) / np.sqrt(MASS_KG * (1.0 + golden**2))
    tip = np.array(modal["point"]["tip"])
    np.testing.assert_allclose(np.abs(tip), np.abs(shapes[:, 1]), rtol=1e-12)
    signs = np.sign(tip * shapes[:, 1])
    np.testing.assert_allclose(modal["point"]["middle"], signs * shapes.mean(axis=1), rtol=1e-12)
    np.testing.assert_allclose(modal["participation_sqrt_kg"], signs * MASS_KG * shapes.sum(axis=1), rtol=1e-12)
    np.testing.assert_allclose(modal["patch"]["mfc"]["coupling_n_per_v"], 1e-3 * tip, rtol=1e-12)
    harvester = jounce.Spec(result.tables, circuit={"load": {"patch": "structure.mfc", "resistance": "1 Mohm"}})
    assert harvester.si("modal.structure.patch.mfc.capacitance") == pytest.approx(30e-9)
    assert harvester.si("modal.structure.patch.mfc.leakage_resistance") == pytest.approx(10e6)


def test_every_form_of_a_matrix_is_the_same():
    full = chain()
    for form in (sparse.csr_matrix, sparse.csc_matrix, sparse.coo_matrix, sparse.csr_array, sparse.dia_matrix, sparse.lil_matrix):
        mass, stiffness = form(MASS_KG * np.eye(2)), form(STIFFNESS)
        vectors = {"points": {"tip": 1, "middle": np.array([0.5, 0.5])}, "base": sparse.csr_matrix([[1.0], [1.0]]), "modes": 2}
        electrical = {"coupling": {"mfc": form([[0.0, 1e-3]])}, "capacitance": {"mfc": "30 nF"}, "leakage": {"mfc": "10 Mohm"}}
        assert jounce.from_matrices(mass, stiffness, **vectors, **electrical) == full, form


@pytest.mark.parametrize("form", ["csr", "csc", "coo"])
@pytest.mark.parametrize("compressed", [True, False])
def test_archives_of_scipy_are_those_of_the_matrix_market(tmp_path, form, compressed):
    mass = sparse.random(30, 30, 0.05, random_state=np.random.default_rng(1))
    mass = mass + mass.T + 9.0 * sparse.eye(30)
    stiffness = sparse.diags([-np.ones(29), 2.5 * np.ones(30), -np.ones(29)], [-1, 0, 1])
    folders = [tmp_path / "npz", tmp_path / "mtx"]
    for folder in folders:
        folder.mkdir()
        (folder / "names.csv").write_text("kind,index,name\npoint,30,tip\n", encoding="utf-8")
    for name, matrix in (("mass", mass), ("stiffness", stiffness)):
        sparse.save_npz(folders[0] / f"{name}.npz", matrix.asformat(form), compressed=compressed)
        scipy_io.mmwrite(folders[1] / f"{name}.mtx", matrix.tocoo(), symmetry="general", precision=17)
    archive, market = (jounce.import_matrices(folder, modes=5) for folder in folders)
    assert archive.spec == market.spec and archive.points == ["tip"]


def test_modes_of_a_universal_file_are_those_of_the_command_line(command_line):
    folder = ROOT / "examples/bouncing-and-impact-oscillators"
    expected = command_line("import", f"--names={folder / 'chain-names.csv'}", spec=folder / "chain.uff")
    result = jounce.import_matrices(folder / "chain.uff", names=folder / "chain-names.csv")
    assert result.spec == expected["spec"] and result.points == ["below", "middle", "tip"]
    shapes = jounce.read_recordings(folder / "chain.uff").shapes
    tip = [mode.shape[1, 2].real / np.sqrt(mode.modal_mass) for mode in shapes]
    np.testing.assert_allclose(np.abs(result.tables["modal"]["structure"]["point"]["tip"]), np.abs(tip), rtol=1e-12)
    with pytest.raises(jounce.ArgumentError, match="absent.csv"):
        jounce.import_matrices(folder / "chain.uff", names="absent.csv")


def test_faults_of_archives_name_the_file(tmp_path):
    def message(**arrays):
        np.savez(tmp_path / "mass.npz", **arrays)
        with pytest.raises(jounce.ArgumentError) as error:
            jounce.import_matrices(tmp_path)
        return str(error.value)

    sparse.save_npz(tmp_path / "stiffness.npz", sparse.csr_matrix(STIFFNESS))
    (tmp_path / "stiffness.mtx").write_text("", encoding="utf-8")
    both = "stiffness.npz both exist; remove one"
    good = {"format": b"csr", "shape": [2, 2], "indices": [0, 1], "indptr": [0, 1, 2], "data": [1.0, 1.0]}
    for change, expected in [
        ({"format": b"bsr"}, "the format bsr is not read"),
        ({"format": "csr"}, "the text `format` is missing"),
        ({"shape": [2, 2, 2]}, "`shape` must have two numbers"),
        ({"indices": [0, 2]}, "`indices` contains 2; it must be a whole number from 0 to 1"),
        ({"indices": [0, -1]}, "`indices` contains -1"),
        ({"indptr": [0, 2, 1]}, "`indptr` must ascend from 0 to 2 in 3 numbers"),
        ({"indptr": [0, 2]}, "`indptr` must ascend from 0 to 2 in 3 numbers"),
        ({"data": [1j, 1.0]}, "`data` cannot be read: its numbers are complex"),
        ({"data": [[1.0], [1.0]]}, "`data` cannot be read: it has 2 dimensions"),
        ({"indices": [0]}, "2 values, but 2 rows and 1 columns"),
    ]:
        found = message(**{**good, **change})
        assert "mass.npz: " in found and expected in found and both in found, found
    (tmp_path / "mass.npz").write_bytes((tmp_path / "stiffness.npz").read_bytes()[:200])
    with pytest.raises(jounce.ArgumentError, match="truncated"):
        jounce.import_matrices(tmp_path)
    (tmp_path / "mass.npz").unlink()
    with pytest.raises(jounce.ArgumentError, match="mass.mtx does not exist, nor does mass.npz"):
        jounce.import_matrices(tmp_path)


def test_all_faults_of_matrices_are_reported():
    with pytest.raises(jounce.ArgumentError) as error:
        jounce.from_matrices(np.eye(2), np.array([[1.0, 0.5], [0.4, np.inf]]), points={"my tip": 1}, base=[1.0, np.nan])
    assert len(error.value.details["faults"]) == 3
    for part in ("stiffness: entry (2, 2) is inf", "base: entry (2, 1) is NaN", 'the name "my tip" must consist of letters'):
        assert part in str(error.value)
    for keywords, message in [
        ({"points": {"tip": 2}}, r"points\['tip'\] is 2; the indices of the 2 degrees of freedom are 0 to 1"),
        ({"points": {"tip": [1.0]}}, r"points\['tip'\] is 1; give 2 numbers"),
        ({"coupling": {"mfc": np.eye(2)}}, r"coupling\['mfc'\] is 2 x 2; give 2 numbers"),
        ({"capacitance": {"mfs": "1 nF"}}, "capacitance is given for mfs, but coupling has mfc"),
        ({"capacitance": None}, "capacitance is missing; coupling needs it"),
        ({"capacitance": {"mfc": "30 nm"}}, "capacitance"),
        ({"leakage": {"mfc": "0 ohm"}}, "leakage of mfc is 0 ohm; it must be above 0"),
        ({"damping": 1j * np.eye(2)}, "damping is complex"),
        ({"damping": np.eye(3)}, "damping has 3 rows, but must have 2"),
        ({"damping": np.ones(2)}, "damping has 1 axes"),
        ({"base": ["a", "b"]}, "base does not consist of numbers"),
        ({"modes": 3}, "3 modes are wanted, but the matrices have 2"),
        ({"name": "my beam"}, "name"),
        ({"damping_ratio": -0.1}, "damping_ratio"),
        ({"mass_unit": "1 mm"}, "mass"),
    ]:
        with pytest.raises(jounce.ArgumentError, match=message):
            chain(**keywords)


def test_free_structures_warn_of_what_is_left_out():
    size, spring = 40, 1e4
    free = spring * (np.diag(np.r_[1.0, 2.0 * np.ones(size - 2), 1.0]) - np.eye(size, k=1) - np.eye(size, k=-1))
    mass = 0.1 * np.eye(size)
    assert jounce.from_matrices(mass, free, damping=1e-5 * free, modes=4).warnings == []
    (text,) = jounce.from_matrices(mass, free, damping=2.0 * mass, modes=4).warnings
    assert text.startswith("mode 1 is without damping") and "up to 2.000e0 1/s" in text
    # A soft support: 4 kg on 1e-7 N/m, sqrt(k / m) / (2 pi) = 2.52e-5 Hz.
    soft = jounce.from_matrices(mass, free + np.diag(np.r_[1e-7, np.zeros(size - 1)]), modes=4)
    (text,) = soft.warnings
    assert text.startswith("mode 1 is set to 0 Hz") and "up to 25.16 uHz" in text and text in repr(soft)


def brick_beam(elements, size_mm):
    """Returns the input of CalculiX for a clamped row of 20-node bricks in t, mm and N, and its node at the far upper corner."""
    numbers = {}
    ends = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
    edges = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
    middles = [tuple((a + b) // 2 for a, b in zip(ends[i], ends[j])) for i, j in edges]
    bricks = [[(i + 2 * k, *rest) for i, *rest in ends + middles] for k in range(elements)]
    for place in itertools.chain(*bricks):
        numbers.setdefault(place, len(numbers) + 1)
    scale = np.array(size_mm) / [2 * elements, 2, 2]
    nodes = [f"{number}, " + ", ".join(map(str, np.array(place) * scale)) for place, number in numbers.items()]
    rows = [f"{k}, " + ", ".join(str(numbers[place]) for place in brick) for k, brick in enumerate(bricks, 1)]
    # Lines hold 16 entries at most.
    rows = [re.sub(r"^((?:[^,]*,){10})", r"\1\n", row) for row in rows]
    root = [f"{number}," for place, number in numbers.items() if place[0] == 0]
    material = ["*MATERIAL, NAME=ALU", "*ELASTIC", "70000., 0.33", "*DENSITY", "2.7E-9", "*SOLID SECTION, ELSET=BEAM, MATERIAL=ALU"]
    step = ["*BOUNDARY", "ROOT, 1, 3", "*STEP", "*FREQUENCY, SOLVER=MATRIXSTORAGE", "5", "*END STEP"]
    mesh = ["*NODE, NSET=ALL", *nodes, "*ELEMENT, TYPE=C3D20, ELSET=BEAM", *rows, "*NSET, NSET=ROOT", *root]
    return "\n".join([*mesh, *material, *step, ""]), numbers[2 * elements, 2, 2]


def test_a_solid_of_calculix_bends_as_a_beam(tmp_path):
    if shutil.which("ccx") is None:
        pytest.skip("CalculiX is not installed (on Debian and Ubuntu: apt install calculix-ccx), so the recipe for it did not run")
    text, corner = brick_beam(30, [200.0, 10.0, 4.0])
    (tmp_path / "beam.inp").write_text(text, encoding="utf-8")
    subprocess.run(["ccx", "beam"], cwd=tmp_path, check=True, capture_output=True)
    book = (ROOT / "book/src/howto/exchange.md").read_text(encoding="utf-8")
    (recipe,) = (block for block in re.findall(r"^```python\n(.*?)^```", book, re.MULTILINE | re.DOTALL) if "read_calculix" in block)
    defined = {}
    exec(recipe, defined)
    solid = defined["read_calculix"](str(tmp_path / "beam"), {"tip": f"{corner}.3"}, 8)
    modal = solid.tables["modal"]["structure"]
    participation_kg = np.square(modal["participation_sqrt_kg"])
    bending = np.flatnonzero(participation_kg > 1e-8)[:3]
    moment_m4, area_m2, length_m = 0.01 * 0.004**3 / 12.0, 0.01 * 0.004, 0.2
    roots = np.array([1.875104068711961, 4.694091132974174, 7.854757438237613])
    exact_hz = (roots / length_m) ** 2 * np.sqrt(70e9 * moment_m4 / (2700.0 * area_m2)) / (2.0 * np.pi)
    np.testing.assert_allclose(solid.frequency_hz[bending], exact_hz, rtol=0.01)
    # The first mode of a beam carries 61.3 % of the mass, and its end moves by 2 over the root of the mass.
    beam_kg = 2700.0 * area_m2 * length_m
    assert participation_kg[bending[0]] == pytest.approx(0.6131 * beam_kg, rel=0.01)
    assert abs(modal["point"]["tip"][bending[0]]) == pytest.approx(2.0 / np.sqrt(beam_kg), rel=0.01)


def test_given_shapes_are_checked(tmp_path, command_line):
    golden = (1.0 + np.sqrt(5.0)) / 2.0
    exact = np.array([[1.0, golden], [golden, -1.0]])
    computed, given = chain(), chain(shapes=exact)
    assert given.has_given_shapes and not computed.has_given_shapes and given.warnings == []
    assert given.orthogonality < 1e-14 and given.stiffness_orthogonality < 1e-14 and np.isnan(given.frequency_error).all()
    np.testing.assert_allclose(given.frequency_hz, computed.frequency_hz, rtol=1e-14)
    np.testing.assert_allclose(given.rayleigh_hz, computed.rayleigh_hz, rtol=1e-14)
    # The second shape contains a tenth of the first: 0.1 / sqrt(1.01) in the mass.
    mixed = exact + 0.1 * np.outer(exact[:, 0], [0.0, 1.0])
    first_hz, second_hz = computed.frequency_hz
    rough = chain(shapes=mixed, frequency_hz=[first_hz, 1.01 * second_hz])
    assert rough.orthogonality == pytest.approx(0.1 / np.sqrt(1.01), rel=1e-12)
    mass, stiffness, frequency = rough.warnings
    assert "in the mass only to 9.95 %" in mass and "in the stiffness only to" in stiffness and "mode 2" in frequency
    assert "mode 1" not in frequency and "9.95 % in the mass" in repr(rough)
    np.testing.assert_array_equal(rough.frequency_hz, [first_hz, 1.01 * second_hz])

    class Model:
        M, K, shapes = MASS_KG * np.eye(2), STIFFNESS, exact

    plain = {"coupling": {}, "capacitance": {}, "leakage": {}, "base": None, "points": {"tip": 1}}
    assert jounce.from_matrices(Model(), points={"tip": 1}).spec == chain(shapes=exact, **plain).spec
    with pytest.raises(jounce.ArgumentError, match="of type list, has no M and no K; give two matrices, or an object with M and K"):
        jounce.from_matrices([])
    for keywords, message in [
        ({"shapes": exact[:1]}, "shapes has 1 rows, one per degree of freedom, but must have 2"),
        ({"shapes": 1j * exact}, "shapes is complex"),
        ({"frequency_hz": [1.0, 2.0]}, "frequency_hz belongs to shapes, which are missing"),
        ({"shapes": exact, "frequency_hz": [1.0]}, "frequency_hz is 1 x 1, but must be 2 x 1"),
    ]:
        with pytest.raises(jounce.ArgumentError, match=message):
            chain(**keywords)
    for name, matrix in {"mass": MASS_KG * np.eye(2), "stiffness": STIFFNESS, "shapes": exact}.items():
        scipy_io.mmwrite(tmp_path / f"{name}.mtx", matrix, precision=17)
    expected = command_line("import", tmp_path, spec=None)
    assert expected["has_given_shapes"] and expected["orthogonality"] < 1e-14
    assert [mode["frequency_error"] for mode in expected["modes"]] == [None, None]


def test_restitution_is_that_of_the_command_line(command_line):
    arguments = ("--material=steel", "--stop-material=brass", "--radius=5mm", "--mass=4g", "--speed=1m/s", "--stop-radius=-50mm")
    expected = command_line("restitution", *arguments, spec=None)
    result = jounce.restitution("steel", "brass", radius="5 mm", mass="4 g", speed="1 m/s", stop_radius="-50 mm")
    for field in ("restitution", "perfectly_plastic", "fully_plastic", "yield_speed_m_s", "yield_strength_pa"):
        assert_identical(getattr(result, field), expected[field])
    assert result.sources == expected["sources"] and "to" in repr(result)
    with pytest.raises(jounce.ArgumentError, match='stop_material is "gold"; it must be one of aluminium, steel, brass, bronze'):
        jounce.restitution("steel", "gold", radius="5 mm", mass="4 g", speed="1 m/s")
