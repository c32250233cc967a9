"""Numbers of the comparison of optimisers: ranges, evaluations of attractors, counted evaluations, traces, fronts and tables."""

from __future__ import annotations

import json
import tempfile
import unittest
from pathlib import Path
from typing import Any

from harness.design_evaluation import Evaluation, judged, strain_ppm
from harness.design_peers import BudgetUsedError, Counted, search
from harness.design_picture import at, band
from harness.design_problems import LOAD, PROBLEMS
from harness.design_report import (
    OF_RUN,
    Run,
    best,
    best_so_far,
    complete,
    front,
    front_table,
    hypervolume,
    near_s,
    power_table,
    read_runs,
    trap_table,
)


def point(first: float, violation: float = 0.0, cpu_s: float = 1.0, second: float = 0.0) -> dict[str, Any]:
    """Returns a point of a search."""
    return {"place": (0.5,), "goals": (first, second), "violation": violation, "cpu_s": cpu_s, "wall_s": cpu_s}


def run(method: str, seed: int, points: list[dict[str, Any]], fresh_w: float = 1e-3) -> Run:
    """Returns a stored search."""
    judge = {"own_w": fresh_w, "own_violation": 0.0, "fresh_w": fresh_w, "basin_fraction": 0.9, "limits": {}, "long_run_w": 0.5 * fresh_w}
    record = {"points": points, "evaluations": len(points), "cpu_s": points[-1]["cpu_s"], "wall_s": 1.0, "front": front(points)}
    return Run(method, len(points), seed, record | {"judged": judge})


class Problems(unittest.TestCase):
    """Ranges of keys, and problems as a design file has them."""

    def test_a_place_and_a_value_lead_to_each_other(self) -> None:
        self.assertAlmostEqual(LOAD.value(0.5), (1e4 * 3e6) ** 0.5)
        for problem in PROBLEMS:
            places = problem.start()
            self.assertTrue(all(0.0 < place < 1.0 for place in places), problem.name)
            for key, place in zip(problem.keys, places, strict=True):
                self.assertAlmostEqual(key.place(key.value(place)), place)

    def test_a_design_has_the_ranges_with_units(self) -> None:
        found = PROBLEMS[0].design(80)
        self.assertEqual(found["free"]["circuit.load.resistance"], "10000.0:3000000.0:log ohm")
        self.assertEqual(found["goal"], {"maximise": "expected-power", "starts": 20})
        self.assertEqual(PROBLEMS[-1].design(80)["goal"]["maximise"], ["expected-power", "bandwidth"])


class Evaluations(unittest.TestCase):
    """Attractors to goal and violation."""

    def test_a_start_without_a_period_has_no_power(self) -> None:
        found = judged([2.0, 8.0], [0.9, 0.1], [1, 0], 0.9, None)
        self.assertEqual(found, Evaluation((1.8,), 0.0))

    def test_violations_of_share_strain_and_unknown_starts_add_up(self) -> None:
        found = judged([2.0, 8.0], [0.45, 0.55], [1, 0], 0.9, (1200.0, 600.0))
        self.assertAlmostEqual(found.violation, 0.5 + 0.5 + 0.55)
        self.assertEqual(judged([], [], [], 0.9, (1.0, 1.0)).violation, 3.0)

    def test_the_main_orbit_contributes_most_and_need_not_be_the_most_frequent(self) -> None:
        self.assertAlmostEqual(judged([5.0, 1.0], [0.3, 0.7], [1, 1], 0.9, None).violation, 1.0 - 0.3 / 0.9)

    def test_strain_is_read_with_either_sign(self) -> None:
        texts = ["patch mfc: its strain reaches -75 ppm; its limit is 0 ppm", "patch b: its strain reaches 60 ppm; x"]
        self.assertEqual((strain_ppm(texts), strain_ppm([])), (75.0, 0.0))


class Budgets(unittest.TestCase):
    """Counted evaluations."""

    def test_a_known_place_costs_nothing_and_the_budget_ends_the_search(self) -> None:
        calls: list[tuple[float, ...]] = []

        def evaluate(place: tuple[float, ...]) -> Evaluation:
            calls.append(place)
            return Evaluation((place[0],), 0.0)

        counted = Counted(evaluate, 2)
        counted([0.5])
        counted([0.5])
        counted([1.5])
        self.assertEqual(calls, [(0.5,), (1.0,)])
        with self.assertRaises(BudgetUsedError):
            counted([0.1])

    def test_a_search_keeps_its_points_in_order(self) -> None:
        def method(_problem: object, counted: Counted, seed: int) -> None:
            for step in range(100):
                counted([step / 100 + seed / 1000])

        found = search(method, PROBLEMS[0], lambda place: Evaluation(place, 0.0), 3, 2)
        self.assertEqual([each.goals[0] for each in found.points], [0.002, 0.012, 0.022])


class Traces(unittest.TestCase):
    """Best so far, fronts and hypervolume."""

    def test_a_design_beyond_its_limits_is_never_the_best_so_far(self) -> None:
        points = [point(9.0, 0.1, 1.0), point(1.0, 0.0, 2.0), point(0.5, 0.0, 3.0), point(2.0, 0.0, 4.0)]
        self.assertEqual(best_so_far(points), [(2, 2.0, 1.0), (4, 4.0, 2.0)])
        self.assertEqual(best(points)["goals"][0], 2.0)
        self.assertEqual(best(points[:1])["violation"], 0.1)

    def test_front_and_hypervolume_of_three_designs(self) -> None:
        points = [point(1.0, second=3.0), point(2.0, second=1.0), point(1.5, second=0.5), point(9.0, 0.1, second=9.0)]
        self.assertEqual(front(points), [[1.0, 3.0], [2.0, 1.0]])
        self.assertEqual(hypervolume(front(points)), 1.0 * 3.0 + 1.0 * 1.0)
        self.assertEqual(hypervolume([]), 0.0)

    def test_the_band_holds_each_value_until_the_next(self) -> None:
        traces = [[(1, 1.0, 1.0), (3, 3.0, 5.0)], [(2, 2.0, 2.0)]]
        self.assertEqual([at(traces[0], 0, place) for place in (0, 1, 2, 3)], [0.0, 1.0, 1.0, 5.0])
        self.assertEqual(band(traces, 0), [(1, 0.5, 0.0, 1.0), (2, 1.5, 1.0, 2.0), (3, 3.5, 2.0, 5.0)])


class Tables(unittest.TestCase):
    """Rows of DESIGN.md."""

    def test_time_to_the_best_known_value_of_the_same_starts(self) -> None:
        group = [run("a", 1, [point(1e-3, cpu_s=2.0), point(2e-3, cpu_s=4.0)]), run("a", 2, [point(1e-3, cpu_s=3.0)])]
        self.assertEqual(near_s(group, {1: 2.05e-3, 2: 2e-3}), [4.0])

    def test_seeds_that_a_method_lacks_are_left_out(self) -> None:
        found = complete([run("a", 1, [point(1e-3)]), run("a", 2, [point(1e-3)]), run("b", 2, [point(1e-3)])])
        self.assertEqual([(each.method, each.seed) for each in found], [("a", 2), ("b", 2)])
        self.assertEqual(complete([]), [])

    def test_a_search_without_a_design_within_the_limits_is_counted(self) -> None:
        rows = power_table(PROBLEMS[0], [run("a", 1, [point(1e-3)]), run("a", 2, [point(9e-3, 0.2)])])
        self.assertIn("| 100% [100% .. 100%] | 1 of 2 |", rows[-1])

    def test_the_claims_of_runs_are_in_their_own_table(self) -> None:
        runs = [run("a", 1, [point(1e-3)]), run("a" + OF_RUN, 1, [point(8e-3)])]
        self.assertEqual(len(power_table(PROBLEMS[1], runs)), 3)
        self.assertIn("| a | 8 [8 .. 8] | 0.5 [0.5 .. 0.5] | 1 [1 .. 1] |", trap_table(PROBLEMS[1], runs)[-1])

    def test_a_front_has_its_hypervolume(self) -> None:
        rows = front_table(PROBLEMS[-1], [run("a", 1, [point(1e-3, second=0.5), point(2e-3, second=0.2)])])
        self.assertIn("| 0.7 [0.7 .. 0.7] | 2 [2 .. 2] |", rows[-1])

    def test_what_is_stored_is_read_by_method_budget_and_seed(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            for name in ("NSGA-II (pymoo)-80-2", "jounce design-20-1"):
                (Path(folder) / f"{name}.json").write_text(json.dumps({"points": []}))
            found = [(each.method, each.budget, each.seed) for each in read_runs(Path(folder))]
        self.assertEqual(found, [("jounce design", 20, 1), ("NSGA-II (pymoo)", 80, 2)])


if __name__ == "__main__":
    unittest.main()
