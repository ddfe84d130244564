#!/usr/bin/python3
"""A vehicle of OpenRailVehicleDynamics with the contact of librailstrata: examples/orvd.

usage: orvd_test.py LIBRARY EXAMPLE [CHECKOUT]   without a checkout of its sources everything is skipped"""
import pathlib
import re
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import selected

LIBRARY, EXAMPLE, *CHECKOUT = sys.argv[1:]
sys.path.insert(0, EXAMPLE)
import curve

FRICTION = 0.3 * 68296  # N, the most that a wheel of one_wheel bears along the contact
MISSING = "no sources of OpenRailVehicleDynamics: configure with -DRAILSTRATA_ORVD=CHECKOUT"


@unittest.skipUnless(CHECKOUT, MISSING)
class Vehicle(unittest.TestCase):
    """Their contact has the same profiles, material and friction, but Hertz's patch of the overlap and Kalker's
    simplified theory: tolerances are what these differ by, signs and places are shared."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder, cls.checkout = pathlib.Path(temporary.name), pathlib.Path(CHECKOUT[0]).resolve()
        cls.text, cls.code = curve.prepare(cls.checkout, pathlib.Path(LIBRARY).resolve(), cls.folder)

    def test_mirror_turned_track_and_moments_hold(self):
        self.assertEqual(self.code, 0, self.text)

    def test_one_wheel_has_the_forces_of_their_contact(self):
        rows = [line.split() for line in self.text.splitlines() if re.search(r" (theirs|ours) ", line)]
        self.assertEqual(len(rows), 14)
        for theirs, ours in zip(rows[::2], rows[1::2]):
            self.assertEqual(theirs[:3], ours[:3])
            self.assertEqual(theirs[4], ours[4])
            for k in (5, 6):
                self.assertLess(abs(float(theirs[k]) - float(ours[k])), 0.1 * FRICTION, (theirs, ours))
            self.assertLess(abs(float(theirs[8]) - float(ours[8])), 1.5, (theirs, ours))

    def test_vehicle_runs_through_a_curve_as_with_their_contact(self):
        raised = float(re.search(r"^raise (\S+)", self.text, re.M)[1])
        curve.write_startup(self.checkout, self.folder, raised)
        table = curve.compare(self.folder, radius=1000, seconds=8, cell=1e-3)
        for name, within in (("shift [mm]", 0.2), ("yaw [mrad]", 0.1), ("outer: Q [kN]", 1), ("inner: Q [kN]", 1),
                             ("outer: Y [kN]", 0.5), ("inner: Y [kN]", 0.5)):
            theirs, ours = table[name]
            self.assertLess(abs(theirs - ours), within, (name, theirs, ours))


if __name__ == "__main__":
    selected.main()
