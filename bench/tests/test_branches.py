"""Output of jounce about a branch, and comparison of the folds of two methods."""

from __future__ import annotations

import json
import unittest

from harness.branches import Found, read_jounce
from harness.orbit_report import fold_table, matched, time_table
from harness.orbit_run import Cost, Drawn
from harness.process import Finished

FOLDS = [(5.8574, 1.7e-4), (12.3218, 1.7e-3)]


def said(*branches: dict[str, object]) -> Finished:
    """Returns a finished `jounce branch --json`."""
    return Finished(json.dumps({"branches": branches}), 0.3, 0.3, None)


class Jounce(unittest.TestCase):
    """The JSON of `jounce branch`."""

    def test_labels_of_the_longest_branch_and_points_of_all(self) -> None:
        fold = {"kind": "fold", "parameter": 12.3218, "mean_power_w": 1.7e-3}
        long, short = {"points": [{}] * 7, "bifurcations": [fold]}, {"points": [{}] * 2, "bifurcations": []}
        found = read_jounce(said(short, long))
        self.assertEqual((found.points, found.folds(), found.reached), (9, [(12.3218, 1.7e-3)], False))
        self.assertTrue(read_jounce(said(long)).reached)

    def test_a_failure_is_kept(self) -> None:
        self.assertEqual(read_jounce(Finished("", 0.1, 0.1, "over 1 s")).failed, "over 1 s")
        self.assertEqual(read_jounce(said()).failed, "no branch")


class Folds(unittest.TestCase):
    """Folds of a method compared with those of the base."""

    def test_nearest_label_is_taken_and_the_others_are_counted(self) -> None:
        own = [(12.3210, 1.6e-3), (12.3217, 1.7e-3), (11.0, 1e-5)]
        self.assertEqual(matched(own, FOLDS), ([None, (12.3217, 1.7e-3)], 2))

    def test_a_method_without_folds(self) -> None:
        self.assertEqual(matched([], FOLDS), ([None, None], 0))

    def test_table_says_where_a_label_is_missing(self) -> None:
        labels = [("fold", hz, watt) for hz, watt in FOLDS]
        base = Drawn("jounce, shooting", Found(3, labels), [0.5])
        peer = Drawn("peer", Found(3, labels[:1]), [5.0])
        self.assertIn("| peer | 5.857400, 1.70000e-04 | no label | 0 |", fold_table([base, peer]))
        self.assertIn("| peer | 5 [5 .. 5] | 10 | 3 | 1.67e+03 | 1 fold |", time_table([base, peer]))

    def test_time_per_point(self) -> None:
        self.assertEqual(Cost("jounce, shooting", 8, 10, [3.0, 1.0, 2.0]).per_point_s(), 0.2)
        self.assertIsNone(Cost("jounce, shooting", 8, failed="no branch").per_point_s())


if __name__ == "__main__":
    unittest.main()
