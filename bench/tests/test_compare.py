"""Time at the same error: the envelope of a ladder and interpolation between its points."""

from __future__ import annotations

import sys
import unittest
from pathlib import Path

from harness.compare import curve, set_errors, time_at
from harness.marches import SECOND_STOP, with_drive, without
from harness.measure import Result, in_turn
from harness.peers import Peer
from harness.plant import Case, SpecError, quantity
from harness.process import finish


def ladder(errors: list[float], seconds: list[float]) -> list[Result]:
    """Returns results of one peer from loose to tight."""
    pairs = zip(errors, seconds, strict=True)
    return [Result("plant", "case", "peer", 1.0, "", error=error, cpu_s=[taken]) for error, taken in pairs]


class Curve(unittest.TestCase):
    """The envelope."""

    def test_a_lucky_error_is_not_taken_for_accuracy(self) -> None:
        found = curve(ladder([1e-4, 1e-9, 1e-6], [1.0, 2.0, 4.0]), "case", "peer")
        self.assertEqual(found, [(1e-4, 1.0), (1e-6, 2.0), (1e-6, 4.0)])

    def test_time_between_two_settings_is_read_in_logarithms(self) -> None:
        points = [(1e-4, 1.0), (1e-8, 100.0)]
        self.assertAlmostEqual(time_at(points, 1e-6) or 0.0, 10.0)
        self.assertEqual(time_at(points, 1e-2), 1.0)
        self.assertIsNone(time_at(points, 1e-9))


    def test_a_power_that_is_no_number_is_a_failure_and_no_point_of_a_curve(self) -> None:
        results = ladder([0.0, 0.0, 0.0], [1.0, 2.0, 4.0])
        for result, power_w in zip(results, (float("inf"), float("nan"), 2.0), strict=True):
            result.mean_power_w, result.error = power_w, None
        set_errors(results, {"case": 1.0})
        self.assertEqual(curve(results, "case", "peer"), [(1.0, 4.0)])
        self.assertEqual([result.failed is None for result in results], [False, False, True])


class Specs(unittest.TestCase):
    """Specs made from other specs."""

    def test_a_table_is_taken_out_with_its_keys_and_nothing_else(self) -> None:
        spec = "[a.b]\nx = [1, 2]\n\n[c]\ny = 1\n[a.d]\nz = 2\n"
        self.assertEqual(without(spec, "c"), "[a.b]\nx = [1, 2]\n\n[a.d]\nz = 2\n")
        self.assertEqual(without(spec, "a.d"), "[a.b]\nx = [1, 2]\n\n[c]\ny = 1\n")

    def test_another_drive_leaves_the_rest(self) -> None:
        made = with_drive("[drive.shaker]\nat = \"p\"\n[run]\nstart = \"rest\"\n[damping]\nr = 1\n" + SECOND_STOP.format(gap="1 mm"), "[drive.x]\nk = 1\n", 60)
        self.assertNotIn("drive.shaker", made)
        self.assertEqual(made.count("[run]"), 1)
        for part in ("[damping]\nr = 1\n", SECOND_STOP.format(gap="1 mm").strip(), "[drive.x]\nk = 1\n", 'duration = "60 s"'):
            self.assertIn(part, made)


class Order(unittest.TestCase):
    """Shuffled, but each ladder from loose to tight."""

    def test_ladders_are_climbed_in_order(self) -> None:
        case, peers = Case(50.0, 11.0), [Peer(name, (1.0, 2.0, 3.0), lambda _p, _c, _s: [], 1) for name in ("a", "b")]
        slots = iter([0.9, 0.1, 0.5, 0.2, 0.8, 0.3])
        done = in_turn([(next(slots), case, peer, setting) for peer in peers for setting in peer.settings])
        self.assertEqual([job[2].name for job in done], ["a", "b", "b", "a", "b", "a"])
        for name in ("a", "b"):
            self.assertEqual([job[3] for job in done if job[2].name == name], [1.0, 2.0, 3.0])


class Process(unittest.TestCase):
    """CPU time, caps and failures."""

    def test_cpu_time_is_that_of_the_process_and_sleep_is_not_in_it(self) -> None:
        code = "import time; time.sleep(0.3); t = time.process_time()\nwhile time.process_time() < t + 0.2: pass"
        done = finish([sys.executable, "-c", code], Path.cwd(), 10.0)
        self.assertIsNone(done.failed)
        self.assertGreater(done.cpu_s, 0.2)
        self.assertGreater(done.wall_s, done.cpu_s)

    def test_a_run_over_its_cap_is_stopped_and_named(self) -> None:
        self.assertEqual(finish([sys.executable, "-c", "while True: pass"], Path.cwd(), 1.0).failed, "over 1 s")

    def test_the_last_line_of_a_failure_is_kept(self) -> None:
        done = finish([sys.executable, "-c", "raise SystemExit('no such plant')"], Path.cwd(), 10.0)
        self.assertEqual(done.failed, "no such plant")


class Quantities(unittest.TestCase):
    """Numbers with units."""

    def test_prefixes(self) -> None:
        self.assertAlmostEqual(quantity("177 nF", "F"), 177e-9)
        self.assertEqual(quantity("1000 N/m^1.5", "N/m^1.5"), 1000.0)

    def test_a_wrong_unit_is_refused(self) -> None:
        with self.assertRaises(SpecError):
            quantity("1 mm", "s")


if __name__ == "__main__":
    unittest.main()
