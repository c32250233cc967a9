"""AUTO's constants and output files, compared with lines that AUTO has printed."""

from __future__ import annotations

import unittest

from harness import auto
from harness.branches import read_auto

DIAGRAM = """\
   0    PT  TY  LAB    PAR(1)             L2-NORM            PERIOD            PAR(12)
  -1    -1   9    1  2.0000000000E+001  1.2975105384E+002  5.0000000000E-002  8.9179199234E-008
  -1   -64   0    0  1.0600000000E+001  2.4900000000E+002  9.4339622642E-002  3.7798330839E-005
  -1   -65  -4    4  1.0499999996E+001  2.5028810173E+002  9.5238095270E-002  3.2798330839E-005
  -1   174   5    5  5.5208302785E+000  4.9265524424E+002  1.8113208000E-001  2.0921809063E-005
  -1   175  -9    6  5.4000000000E+000  7.1120298221E+002  1.8500000000E-001  9.2546002494E-006
"""
LOG = """\
   1    65         Multipliers:     Stable:  19
   1    65         Multiplier  1    5.00000E-01   8.00000E-01  Abs. Val.   9.43398E-01
   1    65         Multiplier  2    1.00000E+00   0.00000E+00  Abs. Val.   1.00000E+00
   1    65         Multiplier  1    1.00001E+00   0.00000E+00  Abs. Val.   1.00001E+00
   1    65         Multiplier  2   -9.12838E-01   3.92027E-01  Abs. Val.   9.93458E-01
   1    65         Multiplier  3   -9.12838E-01  -3.92027E-01  Abs. Val.   9.93458E-01
  BR    PT  TY  LAB    PAR(1)        L2-NORM       PERIOD       PAR(12)
  -1   -65  UZ    4   1.05000E+01   2.50288E+02   9.52381E-02   3.27983E-05
"""


class Files(unittest.TestCase):
    """fort.7 and fort.9."""

    def test_points_are_read_and_header_lines_are_not(self) -> None:
        rows = auto.rows(DIAGRAM)
        self.assertEqual([row.kind for row in rows], [9, 0, -4, 5, -9])
        self.assertEqual(rows[3], auto.Row(5, 5.5208302785, 2.0921809063e-05))

    def test_largest_multiplier_is_of_the_last_list_and_without_the_trivial_one(self) -> None:
        self.assertEqual(auto.largest_multipliers(LOG, (5.1, 10.5)), {10.5: 0.993458})

    def test_a_branch_that_stops_early_is_distinguished_from_a_complete_one(self) -> None:
        found = read_auto(DIAGRAM, LOG)
        self.assertFalse(found.reached)
        self.assertEqual(found.folds(), [(5.5208302785, 2.0921809063e-05)])
        self.assertEqual(found.power_w, {10.5: 3.2798330839e-05})
        self.assertEqual(found.points, 5)
        self.assertTrue(read_auto(DIAGRAM.replace("5.4000000000E+000", "4.0000000002E+000"), LOG).reached)


class Constants(unittest.TestCase):
    """fort.2."""

    def test_dimension_direction_and_stop_follow_the_plant_and_the_range(self) -> None:
        text = auto.constants(8, auto.Mesh("coarse", 30, 1e-5, 3), 20.0, 4.0, (10.5,))
        self.assertIn("NDIM= 19,", text)
        self.assertIn("NTST= 30,", text)
        self.assertIn("DS= -0.1,", text)
        self.assertIn("UZR= {1: [10.5]}, UZSTOP= {1: [4.0]}", text)


if __name__ == "__main__":
    unittest.main()
