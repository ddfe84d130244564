#!/usr/bin/env python3
"""CONTACT's case files of `railstrata export`, computed through CONTACT's interface. usage: exported_test.py LIBRARY
PROGRAM [unittest...]
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import contact_library
from contact_library import Contact, c_int

LIBRARY, PROGRAM = sys.argv.pop(1), sys.argv.pop(1)
library = contact_library.load(LIBRARY)
# A ball of a wheel on a flat block: everything about its rolling radius has a closed form.
BALL = """
[geometry]
rail_profile = "flat"
wheel_profile = "arc:R=80 mm"
rail_shape = "block"
wheel_shape = "disc"
cant = 0.0
bore_radius = "250 mm"
[drive]
friction_coefficient = 0.3
creepage = 0.0004
[bem]
leading_edge = "whole_cell"
"""
RADIUS, ARC, CREEPAGE = 430.0, 80.0, 0.0004
RAIL = """
[geometry]
lateral_shift = "-1.5 mm"
[drive]
friction_coefficient = 0.3
traction_coefficient = 0.1
[bem]
leading_edge = "whole_cell"
"""


def setUpModule():
    version, error = c_int(), c_int(77)
    library.cntc_initializefirst(version, error, c_int(-1), b" ", b" ", b" ", c_int(1), c_int(1), c_int(1))
    assert error.value == 0


class Input:
    """A case file of module 3 as `export` writes it."""

    def __init__(self, file):
        lines = [line for line in file.read_text().splitlines() if not line.startswith("%")]
        heads = [line.split("   ")[0].split() for line in lines]
        self.extra_digit = heads[2][0][-1]
        self.normal, self.ksi, self.eta, self.phi = map(float, heads[5])
        self.friction = float(heads[6][0])
        self.step, self.speed = map(float, heads[7][1:3])
        self.materials = list(map(float, heads[8]))
        self.grid = list(map(float, heads[10]))
        self.mx, self.my = int(self.grid[0]), int(self.grid[1])
        numbers = [float(word) for line in lines[12:-1] for word in line.split()]
        cells = self.mx * self.my
        self.gap, self.extra = numbers[:cells], np.reshape(numbers[cells:], (-1, 2))
        assert len(self.extra) in (0, cells) and lines[-1].split() == ["0", "MODULE"]

    def y(self):
        """mm, to the right, of the cells."""
        row = np.arange(self.mx * self.my) // self.mx
        return self.grid[3] + (row + 0.5) * self.grid[5]

    def solved(self, extra=True):
        """(F_x, F_y) on the rail by the library."""
        c = Contact(library)
        c.flags(P=2, T=3, N=1, F=0)
        c.materials(*self.materials)
        c.friction(self.friction)
        c.grid(1, self.grid)
        c.gap(9, self.gap)
        c.call("cntc_setrollingstepsize", 0.0, self.step)
        c.call("cntc_setreferencevelocity", self.speed)
        c.call("cntc_setnormalforce", self.normal)
        c.call("cntc_setcreepages", self.ksi, self.eta, self.phi)
        cells = self.mx * self.my
        columns = self.extra.T.copy() if extra else np.zeros((2, cells))
        c.call("cntc_setextrarigidslip", cells, columns[0].copy(), columns[1].copy())
        error = c.calculate()
        assert error == 0, c.error()
        return c.forces()[1:3]


class ExportedCases(unittest.TestCase):
    def solved(self, text, *words):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "case.toml").write_text(text)
        for command in (["export", folder / "case.toml", "--to", "contact", "--cell", "0.5 mm", "--out", folder / "to"],
                        ["bem", folder / "case.toml", "--cell", "0.5 mm", "--no-single-track", "--no-report", "--out",
                         folder / "bem"]):
            done = subprocess.run([PROGRAM, *map(str, command), *words], capture_output=True, text=True)
            assert done.returncode in (0, 1), done.stderr
        return Input(folder / "to/rail.inp"), json.loads((folder / "bem/summary.json").read_text())["contact"]

    def test_rigid_slip_of_a_ball_is_that_of_its_radii(self):
        """xi + (r0 - r(y))/r0, r in the middle of the gap, where they meet: r0 - r = (R - sqrt(R² - y²))/2"""
        given, _ = self.solved(BALL)
        self.assertEqual(given.extra_digit, "9")
        y = given.y()
        inward = 0.5 * (ARC - np.sqrt(ARC**2 - y**2))
        slip = given.ksi - given.phi * y + given.extra[:, 0]  # of the rail over the wheel
        np.testing.assert_allclose(slip, -(CREEPAGE + inward / RADIUS), rtol=0, atol=2e-8)
        self.assertGreater(inward.max() / RADIUS, 0.25 * CREEPAGE)

    def test_forces_are_the_programs(self):
        for text in (BALL, RAIL):
            given, contact = self.solved(text)
            wanted = np.array([-contact["F_x_N"], contact["lateral_force_N"]])
            error = [np.hypot(*(given.solved(extra) - wanted)) / np.hypot(*wanted) for extra in (True, False)]
            print(f"forces differ by {error[0]:.2e}, without the extra slip by {error[1]:.2e}")
            self.assertLess(error[0], 1e-4)
            self.assertGreater(error[1], 1e-2)  # what it is there for

    def test_with_the_spin_of_the_contact_plane_the_lateral_term_is_zero(self):
        given, _ = self.solved(RAIL, "--set", "bem.spin_angle=patch")
        self.assertTrue(np.all(given.extra[:, 1] == 0) and np.any(given.extra[:, 0] != 0))


if __name__ == "__main__":
    unittest.main()
