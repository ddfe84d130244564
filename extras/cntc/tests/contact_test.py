#!/usr/bin/env python3
"""CONTACT's set-ups through CONTACT's interface. usage: contact_test.py LIBRARY HEADER REFERENCE_FOLDER [--slow]

Numbers to compare with: REFERENCE_FOLDER, and the printed results of CONTACT's own examples (eve70a/CONTACT, commit
d431cdb, examples/*.ref_out), four digits each.
"""
import csv
import ctypes
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import types
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "tests"))
from selected import main, slow

import contact_library
from contact_library import MM, SI, SIMPACK, Contact, c_int

LIBRARY, HEADER, REFERENCE = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1)), pathlib.Path(sys.argv.pop(1))
library = contact_library.load(LIBRARY)
SETS = pathlib.Path(__file__).resolve().parents[3] / "cases/validation"
SHEAR = 210000 / 2.6
LOAD = 84954.6


def setUpModule():
    """No file of messages in the working folder."""
    begin(None)


def begin(folder, output=-1, name=b" "):
    contact_library.begin(library, folder, output, name)


def tearDownModule():
    library.cntc_finalizelast()


def table(name):
    """A file of REFERENCE, or a whole path."""
    with open(REFERENCE / name) as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def number(row, key):
    return float(row[key]) if row[key] else None


def reference_contact(row, ire=1, icp=1):
    """The set-up of a row of half_space.csv, two cells wider than the patch."""
    A, B, dx = (number(row, key) for key in ("A_1_per_mm", "B_1_per_mm", "dx_mm"))
    half = [int(axis / dx) + 3 for axis in ((6.143980785, 6.143980785) if A == B else (4.344450, 8.688901))]
    c = Contact(library, ire, icp)
    c.materials(0.3, 0.3, SHEAR, SHEAR)
    c.friction(0.5)
    c.grid(3, [2 * half[0] + 1, 2 * half[1] + 1, -half[0] * dx, -half[1] * dx, dx, dx])
    c.gap(1, [A, 0, B, 0, 0, 0])
    c.call("cntc_setnormalforce", LOAD)
    force = number(row, "FX_rel")
    c.flags(P=2, T=0 if "norm" in row["name"] else 3, F=0 if force is None else 1)
    c.call("cntc_settangentialforces", force or 0.0, 0.0)
    c.call("cntc_setcreepages", *(number(row, key) or 0.0 for key in ("creep_x", "creep_y", "spin_rad_per_mm")))
    return c


def rows(*names):
    return [row for row in table("half_space.csv") if row["name"] in names]


def printed(test, value, text):
    """A value against a printed number: half of its last digit, and the 1e-4 that are asked for."""
    wanted = float(text)
    mantissa, _, exponent = text.upper().partition("E")
    last = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    test.assertLessEqual(abs(value - wanted), 0.5001 * last + 1e-4 * abs(wanted), f"{value} against {text}")


@slow
class Reference(unittest.TestCase):
    def test_forces_creepages_approach_pressure_and_every_count_are_those_of_contact(self):
        shapes = [r for r in table("half_space.csv") if number(r, "dx_mm") >= 0.5]
        self.assertEqual(len(shapes), 15)
        for row in shapes:
            with self.subTest(row["name"]):
                c = reference_contact(row)
                self.assertEqual(c.calculate(), 0, c.error())
                self.assertEqual(c.counts(), (int(row["contact_cells"]), int(row["slip_cells"])))
                fn, fx, fy, mz = c.forces()
                size = 1e-4 * 0.5 * LOAD
                for value, key, allowed in ((fn - LOAD, None, 1e-6 * LOAD), (fx, "FX_N", size), (fy, "FY_N", size),
                                            (mz, "MZ_Nmm", 6 * size)):
                    self.assertAlmostEqual(value, number(row, key) if key else 0, delta=allowed)
                self.assertAlmostEqual(c.p_max() / number(row, "p_max_MPa"), 1, delta=1e-6)
                self.assertAlmostEqual(c.approach() / number(row, "approach_mm"), 1, delta=1e-6)
                self.assertAlmostEqual(c.tau_max(), number(row, "tau_max_MPa"), delta=1e-3)
                if number(row, "out_creep_x"):
                    self.assertAlmostEqual(c.creepages()[0] / number(row, "out_creep_x"), 1, delta=1e-4)

    def test_from_cattaneos_shift_to_rolling_step_by_step(self):
        c = reference_contact(rows("circ_fx0.4_dx0.5")[0])
        steps = table("circ_cattaneo_to_carter_dx0.5.csv")[:12]
        c.flags(T=1, F=1, P=2)
        for k, row in enumerate(steps):
            if k == 1:
                c.flags(T=2, P=0)
                c.call("cntc_setrollingstepsize", 0.0, 0.5)
            self.assertEqual(c.calculate(), 0, c.error())
            self.assertEqual(c.counts(), (int(row["contact_cells"]), int(row["slip_cells"])), row)
            self.assertAlmostEqual(c.creepages()[0] / number(row, "creep_x_or_shift_mm"), 1, delta=2e-4)
            self.assertAlmostEqual(c.tau_max(), number(row, "tau_max_MPa"), delta=0.02)

    def test_stresses_below_the_patch_in_the_rail(self):
        c = reference_contact(rows("circ_fx0.4_dx0.5")[0])
        self.assertEqual(c.calculate(), 0)
        reference = [r for r in table("circ_subsurf_fx0.4_dx0.5_y0.csv") if abs(number(r, "x_mm")) <= 8]
        xs = sorted({number(r, "x_mm") for r in reference})
        depths = sorted({number(r, "depth_mm") for r in reference})[:4]
        c.block(9, xs, [0.0], [-z for z in depths])
        found = c.stresses()
        columns = {"sxx": 12, "sxz": 14, "syy": 16, "szz": 20, "von_mises": 7, "sigma1": 9, "sigma3": 11}
        for row in reference:
            if number(row, "depth_mm") not in depths:
                continue
            ix, iz = xs.index(number(row, "x_mm")), len(depths) - 1 - depths.index(number(row, "depth_mm"))
            self.assertAlmostEqual(found[2, iz, 0, ix], -number(row, "depth_mm"))
            for key, column in columns.items():
                # The table has z into the rail, the interface into body 1: shear with z has the other sign.
                sign = -1 if key == "sxz" else 1
                self.assertAlmostEqual(sign * found[column, iz, 0, ix], number(row, key), delta=0.05, msg=(key, row))


@slow
class Examples(unittest.TestCase):
    def test_cattaneo(self):
        c = Contact(library, 2, 1)
        c.materials(0.42, 0.42, 200, 200)
        c.friction(0.4)
        c.call("cntc_setnormalforce", 9.1954)
        c.hertz(-3, [19, 19, 1, 1, 1.26667])
        c.flags(T=0)
        self.assertEqual(c.calculate(), 0, c.error())
        self.assertEqual(c.counts(), (177, 0))
        printed(self, c.approach(), "1.998E-02")
        c.grid(1, [19, 19, -1.26667, -1.26667, 0.13333, 0.13333])
        c.gap(1, [0.01, 0, 0.01, 0, 0, 0])
        c.flags(T=1, F=2)
        c.call("cntc_settangentialforces", -0.875, 0.0)
        self.assertEqual(c.calculate(), 0, c.error())
        self.assertEqual(c.counts(), (177, 132))
        found = (*c.forces()[:2], c.creepages()[0], c.p_max())
        for value, text in zip(found, ("9.195", "-3.218", "8.155E-03", "4.393")):
            printed(self, value, text)

    def test_bentall(self):
        c = Contact(library, 2, 2)
        c.materials(0.31, 0.28, 23000, 82000)
        c.call("cntc_setnormalforce", 16201.9)
        c.call("cntc_setrollingstepsize", math.pi, 0.001)
        c.grid(1, [216, 1, -0.108, -500, 0.001, 1000])
        c.gap(1, [0.02, 0, 0, 0, 0, 0])
        c.flags(T=3, F=1)
        for friction, force, contact, slip, creep, p_max, true in (
                (10, 0, 200, 0, "3.591E-04", "103.8", 0), (0.05, 0, 200, 75, "4.294E-04", "103.6", 0),
                (0.05, 0.75, 200, 164, "2.108E-04", "103.2", 607.6),
                (0.05, -0.75, 201, 95, "5.392E-04", "103.3", -607.6)):
            c.friction(friction)
            c.call("cntc_settangentialforces", force, 0.0)
            self.assertEqual(c.calculate(), 0, c.error())
            self.assertEqual(c.counts(), (contact, slip))
            printed(self, c.creepages()[0], creep)
            printed(self, c.p_max(), p_max)
            self.assertAlmostEqual(c.forces()[1], true, delta=0.06)

    def test_spence_in_35_steps(self):
        c = Contact(library, 2, 3)
        c.materials(0, 0, 0.5, 100000)
        c.friction(0.2986)
        c.grid(1, [45, 45, -4.4999, -4.4999, 0.2, 0.2])
        c.gap(1, [0.004116, 0, 0.004116, 0, 0, 0])
        c.call("cntc_setsolverflags", 0, 4, [200, 30, 30, 10], 1, [1e-6])
        c.flags(T=1, F=0)
        for k in range(1, 36):
            c.flags(P=2 if k == 1 else 0)
            c.call("cntc_setnormalforce", round((k / 45) ** 3, 6))
            self.assertEqual(c.calculate(), 0, c.error())
        self.assertEqual(c.counts(), (921, 696))
        for value, text in zip((c.forces()[0], c.approach(), c.p_max()), ("0.4705", "9.874E-02", "2.392E-02")):
            printed(self, value, text)

    def test_first_curve_of_tractcurv(self):
        c = Contact(library, 2, 4)
        c.materials(0.28, 0.28, 82000, 82000)
        c.friction(0.33)
        c.call("cntc_setnormalforce", 106700.0)
        c.call("cntc_setrollingstepsize", 0.0, 0.5)
        c.hertz(-2, [48, 44, 0.0008, 0.5, 1.1])
        c.flags(T=3)
        for creep, force, slip in ((0.00001, "-7.015E-03", 2), (0.0004, "-0.2588", 202), (0.0008, "-0.4742", 408),
                                   (0.0012, "-0.6482", 602), (0.0016, "-0.7831", 788), (0.0020, "-0.8816", 962)):
            c.call("cntc_setcreepages", creep, 0.0, 0.0)
            self.assertEqual(c.calculate(), 0, c.error())
            self.assertIn("DQ = DX", c.error()[1])
            self.assertEqual(c.counts(), (1384, slip))
            printed(self, c.forces()[1] / (0.33 * 106700), force)
            printed(self, c.approach(), "7.651E-02")
        # The first point of the second curve, with a film, where friction is still that at rest.
        c.set("cntc_setmaterialparameters", 4, [0.28, 0.28, 82000, 82000, 8200, 1.25, 0, 0])
        c.call("cntc_setcreepages", 0.00001, 0.0, 0.0)
        self.assertEqual(c.calculate(), 0, c.error())
        printed(self, c.forces()[1] / (0.33 * 106700), "-1.869E-03")

    def test_rows_of_test_table_on_its_own_cells(self):
        """testbank/test_table_mx11.ref_fx, the rows of cases/validation/contact_table*; iterations end at 1e-6."""
        rows = [row for name in ("contact_table", "contact_table_spin")
                for row in table(SETS / name / "data.csv")]
        self.assertEqual(len(rows), 360)
        c = Contact(library, 2, 6)
        c.materials(0.28, 0.28, 82000, 82000)
        c.friction(0.3)
        c.call("cntc_setnormalforce", 82000.0)
        c.flags(P=2, T=3)
        for row in rows:
            ratio, angle = float(row["a_over_b"]), math.radians(float(row["direction_deg"]))
            a = {0.2: 4, 0.5: 6, 1: 9, 2: 12, 5: 20}[ratio]
            c.hertz(-3, [11, 11, a, a / ratio, 11 / 7])
            self.assertEqual(c.calculate(), 0, c.error())  # the ellipse's rho is known by then
            rho, radius = c.hertz_results()[4:]
            creepage = 0.3 * float(row["magnitude"]) * radius / rho
            c.call("cntc_setcreepages", creepage * math.cos(angle), creepage * math.sin(angle),
                   0.3 * float(row["spin_number"]) / rho)
            self.assertEqual(c.calculate(), 0, c.error())
            forces = [float(row["F_x"]), float(row["F_y"])]
            np.testing.assert_allclose(np.array(c.forces()[1:3]) / (0.3 * 82000), forces, rtol=0, atol=5e-6,
                                       err_msg=str(row))

    def test_stresses_under_one_element(self):
        c = Contact(library, 2, 5)
        c.materials(0.28, 0.28, 1, 1)
        c.friction(1)
        c.grid(1, [1, 1, -0.4999, -0.4998, 1, 1])
        c.gap(1, [2.16, 0, 2.16, 0, 0, 0])
        c.call("cntc_setnormalforce", 1.0)
        c.flags(T=0)
        self.assertEqual(c.calculate(), 0, c.error())
        printed(self, c.approach(), "0.807984")
        c.flags(T=3, F=1)
        c.call("cntc_settangentialforces", 0.999, 0.0)
        self.assertEqual(c.calculate(), 0, c.error())
        c.block(9, [1e-5], [1e-5], [0.0, 0.5, 1.0, 2.5])
        found = c.stresses()[:, :, 0, 0].T
        # UX, UZ, SIGHYD, SIGVM, SIGXX, SIGXZ, SIGZZ
        wanted = ("0.482073 0.403982 -0.853264 1.74426 -0.779815 -0.998999 -1.000000",
                  "0.175332 0.265146 -0.284416 0.676093 -7.6184E-02 -0.149363 -0.700842",
                  "9.4955E-02 0.170498 -0.109379 0.342630 3.9769E-03 -2.4183E-02 -0.336086",
                  "3.8692E-02 7.5855E-02 -2.0899E-02 7.6086E-02 4.4578E-03 -9.2701E-04 -7.1611E-02")
        for row, text in zip(found, wanted):
            for column, word in zip((3, 5, 6, 7, 12, 14, 20), text.split()):
                printed(self, row[column], word)


class OfTheInterface(unittest.TestCase):
    def contact(self, icp=1, units=MM):
        """Creepage and spin on a small circular contact, in the units asked for."""
        mm, c = (1.0 if units == MM else 1e-3), Contact(library, 3, icp, units)
        c.flags(P=2, T=3, F=0)
        c.materials(0.3, 0.3, SHEAR / mm**2, SHEAR / mm**2)
        c.friction(0.3)
        c.grid(3, [29, 31, -14 * 0.5 * mm, -15 * 0.5 * mm, 0.5 * mm, 0.5 * mm])
        c.gap(1, [1 / 840 / mm, 0, 1 / 840 / mm, 0, 0, 0])
        c.call("cntc_setnormalforce", 60000.0)
        c.call("cntc_setrollingstepsize", 0.0, 0.5 * mm)
        c.call("cntc_setcreepages", -0.0005, 0.0008, 0.0002 / mm)
        return c


class Smoke(OfTheInterface):
    def test_exports_are_the_functions_of_the_header(self):
        listed = subprocess.run(["nm", "-D", "--defined-only", LIBRARY], capture_output=True, text=True, check=True)
        symbols = {line.split()[-1].split("@")[0] for line in listed.stdout.splitlines()}
        self.assertEqual(symbols, set(re.findall(r"RSCNTC_API void (\w+)\(", HEADER.read_text())))
        self.assertEqual(symbols, set(contact_library.PROTOTYPES))

    def test_units_and_bodies(self):
        c, si, simpack = self.contact(1), self.contact(2, SI), self.contact(3, SIMPACK)
        for each in (c, si, simpack):
            self.assertEqual(each.calculate(), 0, each.error())
        fn, fx, fy, mz = c.forces()
        for other, sign in ((si, 1), (simpack, -1)):
            for value, wanted in zip(other.forces(), (fn, sign * fx, sign * fy, sign * mz * 1e-3)):
                self.assertAlmostEqual(value / wanted, 1, delta=1e-9)
            wanted = np.multiply(c.creepages(), [sign, sign, sign * 1e3])
            np.testing.assert_allclose(other.creepages(), wanted, rtol=1e-12)
            np.testing.assert_allclose(other.field(3), sign * 1e6 * c.field(3), atol=1, rtol=1e-9)
            np.testing.assert_allclose(other.field(9), 1e-3 * c.field(9), rtol=1e-9)
            self.assertAlmostEqual(other.p_max() / c.p_max() / 1e6, 1, delta=1e-12)
            self.assertAlmostEqual(other.approach() / c.approach() * 1e3, 1, delta=1e-12)


@slow
class Interface(OfTheInterface):
    def test_rolling_backwards_is_rolling_forwards_turned_by_half(self):
        ahead, back = self.contact(1), self.contact(2)
        back.call("cntc_setcreepages", 0.0005, -0.0008, 0.0002)
        back.call("cntc_setrollingstepsize", math.pi, 0.5)
        self.assertEqual((ahead.calculate(), back.calculate()), (0, 0))
        np.testing.assert_allclose(back.field(3), -ahead.field(3)[::-1, ::-1], atol=1e-9)
        np.testing.assert_allclose(back.field(16), -ahead.field(16)[::-1, ::-1], atol=1e-14)
        np.testing.assert_array_equal(back.division(), ahead.division()[::-1, ::-1])
        np.testing.assert_allclose(back.forces(), np.multiply(ahead.forces(), [1, -1, -1, 1]), rtol=1e-9)

    def test_slip_opposes_traction_and_displacements_carry_it(self):
        c = self.contact()
        self.assertEqual(c.calculate(), 0)
        px, py, sx, sy, slips = c.field(3), c.field(4), c.field(15), c.field(16), c.division() == 2
        self.assertTrue((px * sx + py * sy <= 0)[slips].all())
        np.testing.assert_allclose(np.hypot(px, py)[slips], 0.3 * c.field(5)[slips], rtol=1e-9)
        self.assertEqual(np.abs(sx[~slips]).max(), 0)
        # s = w + du/dx of body 1 over body 2, over the step of one element that ends here; x fastest.
        ux, y = c.field(7), (np.arange(31) - 15)[:, None] * 0.5
        wx = -0.0005 - 0.0002 * y
        step = wx + (ux[:, :-1] - ux[:, 1:]) / 0.5
        sticks = (c.division() == 1)[:, :-1]
        self.assertLess(np.abs(step[sticks]).max(), 2e-4 * np.abs(wx).max())
        np.testing.assert_allclose(step[slips[:, :-1]], sx[:, :-1][slips[:, :-1]], atol=1e-7)

    def test_approach_gives_the_load_back_and_forces_count_over_it(self):
        c = self.contact()
        c.flags(F=2)
        c.call("cntc_settangentialforces", 0.3, -0.4)
        self.assertEqual(c.calculate(), 0)
        forces, approach = c.forces(), c.approach()
        c.call("cntc_setpenetration", approach)
        self.assertEqual(c.calculate(), 0, c.error())
        np.testing.assert_allclose(c.forces()[:3], forces[:3], rtol=1e-5)
        np.testing.assert_allclose(c.forces()[1:3], [0.3 * 0.3 * forces[0], -0.4 * 0.3 * forces[0]], rtol=1e-4)

    def test_extra_rigid_slip_is_a_creepage_element_by_element(self):
        c = self.contact()
        self.assertEqual(c.calculate(), 0)
        forces = c.forces()
        c.call("cntc_setcreepages", 0.0, 0.0, 0.0002)
        c.call("cntc_setextrarigidslip", 29 * 31, np.full(29 * 31, -0.0005), np.full(29 * 31, 0.0008))
        self.assertEqual(c.calculate(), 0)
        np.testing.assert_allclose(c.forces(), forces, rtol=1e-9)

    def test_a_layer_of_the_material_changes_nothing_and_a_stiff_one_raises_the_pressure(self):
        c = self.contact()
        self.assertEqual(c.calculate(), 0)
        plain, forces = c.p_max(), c.forces()
        layer = lambda young: c.call("rscntc_setlayers", 2, 1, [1.0], [young], [0.3])
        layer(210000.0)
        self.assertEqual(c.calculate(), 0, c.error())
        self.assertAlmostEqual(c.p_max() / plain, 1, delta=1e-5)
        np.testing.assert_allclose(c.forces()[:3], forces[:3], rtol=1e-4)
        layer(420000.0)
        self.assertEqual(c.calculate(), 0, c.error())
        self.assertGreater(c.p_max(), 1.02 * plain)
        c.call("rscntc_setlayers", 2, 0, [], [], [])
        self.assertEqual(c.calculate(), 0)
        self.assertEqual(c.p_max(), plain)

    def test_the_lines_of_the_page_set_a_layer_through_the_wrapper_s_library(self):
        c = self.contact()
        self.assertEqual(c.calculate(), 0)
        plain = c.p_max()
        page = (SETS.parents[1] / "docs/contact-interface.md").read_text()
        lines = re.search(r"```python\n(from ctypes.*?)```", page, re.S).group(1)
        lines = lines.replace("setlayers(whole(1)", f"setlayers(whole({c.ire})")
        exec(lines, {"cntc": types.SimpleNamespace(cntc_dll=ctypes.CDLL(LIBRARY))})  # as the wrapper loads it
        self.assertEqual(c.calculate(), 0, c.error())
        self.assertGreater(c.p_max(), 1.01 * plain)

    def test_falling_friction_without_memory(self):
        c = self.contact()
        c.call("cntc_setcreepages", -0.02, 0.0, 0.0)
        c.call("cntc_setreferencevelocity", 30000.0)
        c.set("cntc_setfrictionmethod", 4, [0.15, 0.15, 600, 0, 1000, 0, 0])
        self.assertEqual(c.calculate(), 0, c.error())
        # Full sliding: everywhere the slip is nearly the creepage, 600 mm/s, where half of the fall is done.
        self.assertAlmostEqual(c.forces()[1] / 60000, 0.225, delta=0.004)
        self.assertAlmostEqual(c.field(2)[15, 14], 0.225, delta=0.004)
        polach = c.forces()[1]
        c.set("cntc_setfrictionmethod", 5, [0.3, 0.5, math.log(2) / 600])
        self.assertEqual(c.calculate(), 0, c.error())
        self.assertAlmostEqual(c.forces()[1] / polach, 1, delta=1e-6)
        c.set("cntc_setfrictionmethod", 4, [0.15, 0.15, 60, 0, 1000, 1e-6, 1])
        c.set("cntc_setmaterialparameters", 4, [0.28, 0.28, 82000, 82000, 820, 1.0, 0, 0])
        self.assertEqual(c.calculate(), -33)
        self.assertIn("MEMDST", c.error()[1])
        self.assertNotIn("friction.", c.error()[1])

    def locomotive(self):
        """CONTACT's example tractcurv: wheel of 625 mm, a/b = 0.5, 106.7 kN, 10 m/s."""
        c = Contact(library)
        c.set("cntc_setmaterialparameters", 0, [0.28, 0.28, 82000, 82000])
        c.set("cntc_setfrictionmethod", 0, [0.33, 0.33])
        c.set("cntc_sethertzcontact", -2, [48, 44, 0.0008, 0.5, 1.1])
        c.call("cntc_setnormalforce", 106700.0)
        c.call("cntc_setreferencevelocity", 10000.0)
        return c

    def against_curve(self, c, name, column, most, each=lambda c, row: None):
        """Rows of a validation set, whose forces CONTACT prints with four digits."""
        rows = table(SETS / name / "data.csv")
        self.assertGreater(len(rows), 25)
        for row in rows:
            each(c, row)
            c.call("cntc_setcreepages", -0.01 * float(row["creepage_percent"]), 0.0, 0.0)
            self.assertGreaterEqual(c.calculate(), 0, c.error())
            self.assertAlmostEqual(c.forces()[1] / 106700, float(row[column]), delta=most, msg=str(row))

    def test_a_film_under_friction_with_a_memory_is_that_of_tractcurv(self):
        c = self.locomotive()
        c.set("cntc_setfrictionmethod", 4, [0.14, 0.19, 1250, 0, 1, 0.003, 1])
        c.set("cntc_setmaterialparameters", 4, [0.28, 0.28, 82000, 82000, 8200, 1.25, 0, 0])
        self.against_curve(c, "locomotive_contact", "traction", 1e-4)

    def test_simplified_theories_are_those_of_fastsim_and_tractcurv(self):
        shear = [0.28, 0.28, 82000, 82000]
        self.addCleanup(Contact(library).flags, B=0)
        for row in table("contact_simplified.csv"):
            c, case = self.locomotive(), int(row["case"])
            slope = [1, 1, 1]
            if row["example"] == "fastsim":
                c.set("cntc_setfrictionmethod", 0, [0.3, 0.3])
                c.call("cntc_setnormalforce", 82000.0)
                c.set("cntc_sethertzcontact", -3, [int(row["mx"]), int(row["my"]), 8, 4, 1.1])
            elif case > 90:
                c.set("cntc_setfrictionmethod", 4, [0.1368, 0.2232, 990, 0, 1, 0.003, 1])
                slope = [0.54, 0.02, 0.62]
            c.set("cntc_setmaterialparameters", int(row["M"]), shear + slope)
            c.flags(B=int(row["B"]))
            c.call("cntc_setrollingstepsize", math.pi * int(row["back"]), 0.4)
            c.call("cntc_setcreepages", *(float(row[key]) for key in ("xi", "eta", "phi_1_per_mm")))
            self.assertGreaterEqual(c.calculate(), 0, c.error())
            found = [*c.forces()[1:], c.p_max()]
            for key, value in zip(("Fx_N", "Fy_N", "Mz_Nmm", "p_max_MPa"), found):
                self.assertAlmostEqual(value, float(row[key]), delta=6e-4 * abs(float(row[key])) + 1e-3, msg=str(row))
            self.assertEqual(c.counts(), (int(row["contact"]), int(row["slip"])), row)
            if case == 91:
                numbers = np.zeros(14)
                c.call("cntc_getparameters", 2, 14, numbers)
                self.assertAlmostEqual(numbers[13], 0.5391, delta=5e-5)  # K_EFF
            if row["example"] == "tractcurv":  # springs: u(x) - u(x + dx) = dx (s - w)
                inside, dx = c.division()[:, :-1] > 0, c.numbers("cntc_getgriddiscretization", 2)[0]
                change, slip = -np.diff(c.field(7), axis=1), c.field(15)[:, :-1]
                np.testing.assert_allclose(change[inside], dx * (slip[inside] - float(row["xi"])), atol=1e-9)

    def test_steps_under_steep_friction_are_those_of_veldep_fric(self):
        c = Contact(library, 7)
        c.materials(0.28, 0.28, 82000, 82000)
        c.set("cntc_setfrictionmethod", 4, [0.18, 0.12, 100, 0, 1, 0, 1])
        c.call("cntc_setnormalforce", 622216.0)
        c.call("cntc_setreferencevelocity", 45000.0)
        c.call("cntc_setrollingstepsize", 0.0, 0.1)
        c.grid(3, [92, 1, -4.6, 0, 0.1, 200])
        c.gap(2, [2, 0, 460, -10, 20, 0, 0])
        for row in table("contact_steep_friction.csv"):
            c.flags(P=2 if row["T"] == "3" else 0, T=int(row["T"]))
            c.call("cntc_setsolverflags", 4, 5, [5000, 2000, 30, 1, int(row["INISLP"])], 2, [1e-7, 1.1])
            c.call("cntc_setcreepages", float(row["xi"]), 0.0, 0.0)
            self.assertEqual(c.calculate(), 0, c.error())
            self.assertAlmostEqual(c.forces()[1], float(row["Fx_N"]), delta=51, msg=row)
            if row["slip"]:
                self.assertEqual(c.counts()[1], int(row["slip"]), row)
            slip = 45 * np.abs(c.field(15)).ravel()
            friction = (0.18 + 0.12 * 2 ** (-slip / 0.1))[slip > 0]
            carried = (np.abs(c.field(3)) / np.maximum(c.field(5), 1e-9)).ravel()[slip > 0]
            np.testing.assert_allclose(carried, friction, rtol=1e-4)

    def test_viscoelastic_cylinders_are_those_of_visc_cylindr(self):
        c = Contact(library, 8)
        c.friction(0.3)
        c.call("cntc_setnormalforce", 600000.0)
        c.call("cntc_setreferencevelocity", 1000.0)
        c.grid(3, [99, 1, -7.92, 0, 0.16, 1000])
        c.gap(1, [0.01, 0, 0, 0, 0, 0])
        c.call("cntc_settangentialforces", -0.6, 0.0)
        c.flags(F=2)
        for row in table("contact_viscoelastic.csv"):
            time = float(row["TC_s"])
            c.set("cntc_setmaterialparameters", 1, [0.4, 0.4, 1143, 1143, 1, 1, time, time])
            self.assertEqual(c.calculate(), 0, c.error())
            self.assertAlmostEqual(c.creepages()[0], float(row["creepage"]), delta=6e-4 * float(row["creepage"]))
            self.assertAlmostEqual(c.approach(), float(row["approach_mm"]), delta=5e-5)
            self.assertAlmostEqual(c.p_max(), float(row["p_max_MPa"]), delta=0.02)  # CONTACT integrates to 1e-3
            self.assertEqual(c.counts(), (int(row["contact"]), int(row["slip"])), row)
            inside = c.field(5) > 0  # the surfaces touch: h + u_n = approach
            np.testing.assert_allclose((c.field(1) + c.field(9))[inside], c.approach(), rtol=1e-5)
            both = c.division()[0, 1:] * c.division()[0, :-1] == 1  # they stick: u(x) - u(x + dx) = -dx w
            step = -np.diff(c.field(7), axis=1)[0][both]
            np.testing.assert_allclose(step, -0.16 * c.creepages()[0], rtol=1e-4)
        c.set("cntc_setmaterialparameters", 1, [0.4, 0.4, 1143, 1143, 1, 1, 0.009, 0.009])
        c.grid(3, [99, 1, -7.84, 0, 0.16, 1000])
        self.assertEqual(c.calculate(), 0, c.error())
        forward, moved = c.field(5), c.field(7)
        self.assertGreater(np.abs(forward - forward[:, ::-1]).max(), 0.1 * c.p_max())
        c.call("cntc_setrollingstepsize", math.pi, 0.16)
        c.call("cntc_settangentialforces", 0.6, 0.0)
        self.assertEqual(c.calculate(), 0, c.error())
        np.testing.assert_allclose(c.field(5)[:, ::-1], forward, atol=1e-4 * c.p_max())
        np.testing.assert_allclose(c.field(7)[:, ::-1], -moved, atol=1e-4 * np.abs(moved).max())
        c.block(9, [1], [1], [1])
        error = c_int(0)
        c.call("subs_calculate", error)
        self.assertEqual(error.value, -99)
        c.materials(0.4, 0.4, 1143, 1143)
        c.flags(P=0, T=2)
        self.assertEqual(c.calculate(), -99)
        self.assertIn("P = 2", c.error()[1])

    def test_films_that_yield_are_those_of_tractcurve_plast(self):
        c = self.locomotive()
        c.set("cntc_sethertzcontact", -2, [44, 44, 0.0008, 0.5, 1.1])

        def film(c, row):
            c.set("cntc_setmaterialparameters", 4,
                  [0.28, 0.28, 82000, 82000, 1, 0, 150, float(row["k_MPa_per_mm"])])

        self.against_curve(c, "film_plastic", "traction", 1e-4, film)
        self.assertIn(3, c.division())

    def test_temperatures_of_a_sliding_wheel(self):
        c = self.locomotive()
        steel = [450.0, 50e-3, 7.85e-6]
        c.set("cntc_settemperaturedata", 3, [0.0, *steel, 0.0, *steel])
        c.call("cntc_setcreepages", -0.05, 0.0, 0.0)
        self.assertEqual(c.calculate(), 0, c.error())
        hot = c.numbers("cntc_getmaximumtemperature", 2)[0]
        self.assertGreater(hot, 100)
        cold = c.forces()[1]
        c.set("cntc_setfrictionmethod", 6, [0.33, 0, -0.19, 400, 0, 1])
        self.assertEqual(c.calculate(), 0, c.error())
        self.assertLess(c.numbers("cntc_getmaximumtemperature", 2)[0], hot)
        self.assertLess(c.forces()[1], 0.97 * cold)
        c.set("cntc_settemperaturedata", 0, [])
        self.assertEqual(c.calculate(), -33)
        self.assertIn("cntc_settemperaturedata", c.error()[1])

    def test_calls_of_programs_in_fortran_answer(self):
        c = self.contact()
        threads = c_int(0)
        library.cntc_getmaxnumthreads(threads)
        self.assertGreaterEqual(threads.value, 1)
        library.cntc_setfileunits(c_int(5), (c_int * 5)(61, 62, 63, 64, 65))
        self.assertEqual(c.calculate(), 0)

    def test_border_cells_are_counted(self):
        c = self.contact()
        c.grid(3, [29, 15, -7, -3.5, 0.5, 0.5])
        self.assertGreater(c.calculate(), 10)
        self.assertIn("too small", c.error()[1])

    def test_blocks_of_points(self):
        c = self.contact()
        self.assertEqual(c.calculate(), 0)
        c.block(1, [-999], [-999], [2, 0.1, 1.0])
        self.assertEqual(c.stresses().shape, (21, 2, 31, 29))
        c.block(6, [3, 5, 99], [16, 1, 16], [-2.0, 3.0], number=2)
        c.block(3, [14, 2, 14, 70], [15], [1, 0.5, 1], number=3)
        found = c.stresses(2)
        self.assertEqual(found.shape, (21, 2, 1, 6))
        np.testing.assert_allclose(found[0, 0, 0], [-6, -3.5, -1, 1.5, 4, 6.5])
        np.testing.assert_allclose(found[2, :, 0, 0], [-2, 3])
        self.assertEqual(c.stresses(3).shape, (21, 1, 1, 2))
        xyz, displacement = found[:3], found[3:6]
        self.assertGreater(displacement[2, 1, 0, 2], 0)  # pressed away from each other's body
        self.assertLess(displacement[2, 0, 0, 2], 0)
        # Layers of the body's own material, by another method, at an element's centre.
        c.call("rscntc_setlayers", 1, 1, [1.0], [210000.0], [0.3])
        self.assertEqual(c.calculate(), 0)
        layered = c.stresses(2)
        np.testing.assert_allclose(layered[6:, 1], found[6:, 1], atol=2e-3 * c.p_max())
        c.block(4, [1], [1], [1])
        error = c_int(0)
        c.call("subs_calculate", error)
        self.assertEqual(error.value, -34)

    def test_what_is_not_offered_is_refused_with_a_code_and_a_line(self):
        refusals = [
            (lambda c: c.flags(B=3), -99, "B = 0"), (lambda c: c.flags(C=4), -99, "C3 = 2"),
            (lambda c: c.flag(1988, 3), -99, "sensitivities"), (lambda c: c.flag(1933, 1937), -99, "units"),
            (lambda c: c.set("cntc_setmaterialparameters", 1, [0.3, 0.3, 1, 1, 1, 2, 1, 1]), -99, "M = 1"),
            (lambda c: c.set("cntc_setmaterialparameters", 2, [0.3] * 8), -99, "M = 2"),
            (lambda c: c.set("cntc_setmaterialparameters", 3, [0.3, 0.3, SHEAR, SHEAR, 2, 1, 1]), -99, "K0_MF"),
            (lambda c: c.set("cntc_setmaterialparameters", 0, [0.3] * 3), -99, "4 numbers"),
            (lambda c: c.set("cntc_setfrictionmethod", 2, [0.1] * 7), -33, "L = 2"),
            (lambda c: c.set("cntc_setfrictionmethod", 10, [1, 0, 0.3, 0.3]), -33, "V = 1"),
            (lambda c: c.hertz(-6, [20, 20, 1, 1, 1, 1]), -34, "IPOTCN = -6"),
            (lambda c: c.grid(1, [20, 20, 0, 0, -1, 1]), -34, "without a size"),
            (lambda c: c.gap(9, [0.0] * 7), -34, "899 elements"), (lambda c: c.gap(4, [0]), -99, "IBASE = 4"),
            (lambda c: c.call("cntc_setrollingstepsize", 1.0, 0.5), -34, "direction"),
            (lambda c: (c.flags(T=2), c.call("cntc_setrollingstepsize", 0.0, 0.7)), -34, "DQ has to be DX"),
            (lambda c: c.call("cntc_setcreepages", math.nan, 0.0, 0.0), -99, "not finite"),
            (lambda c: (c.flags(F=1), c.call("cntc_settangentialforces", 1.0, 0.0)), -26, "friction"),
            (lambda c: (c.flags(F=1), c.call("cntc_settangentialforces", -1.2, 0.0)), -26, "friction"),
            (lambda c: (c.flags(F=2), c.call("cntc_settangentialforces", 0.8, 0.8)), -26, "friction"),
            (lambda c: c.friction(-1), -33, "not -1 and -1"), (lambda c: c.friction(math.nan), -33, "not finite"),
            (lambda c: c.set("cntc_setfrictionmethod", 0, [0.3, -0.1]), -33, "0.3 and -0.1"),
            (lambda c: c.set("cntc_setfrictionmethod", 4, [-0.1, 0.15, 600, 0, 1, 0, 0]), -33, "FKIN > 0"),
            (lambda c: c.materials(0.3, 0.6, SHEAR, SHEAR), -99, "0.6"),
            (lambda c: c.materials(0.3, -0.1, SHEAR, SHEAR), -99, "-0.1"),
            (lambda c: c.materials(0.3, 0.3, 0, SHEAR), -99, "above 0"),
            (lambda c: c.materials(0.3, 0.3, SHEAR, -SHEAR), -99, "above 0"),
            (lambda c: c.materials(0.3, 0.3, SHEAR, math.nan), -99, "not finite"),
            (lambda c: c.materials(0.3, 0.3, SHEAR, math.inf), -99, "not finite"),
            (lambda c: c.grid(3, [0, 31, -7, -7.5, 0.5, 0.5]), -34, "MX = 0"),
            (lambda c: c.grid(3, [29, -31, -7, -7.5, 0.5, 0.5]), -34, "MY = -31"),
            (lambda c: c.grid(3, [29, math.nan, -7, -7.5, 0.5, 0.5]), -34, "not finite"),
            (lambda c: c.grid(3, [29, 31, -7, -7.5, 0, 0.5]), -34, "without a size"),
            (lambda c: c.hertz(-2, [29, 31, 0.0008, 0, 1.1]), -34, "above 0"),
            (lambda c: c.gap(1, [math.nan, 0, 1, 0, 0, 0]), -99, "not finite"),
            (lambda c: c.call("cntc_setnormalforce", -6e4), -99, "-60000"),
            (lambda c: c.call("cntc_setnormalforce", 0.0), -99, "above 0"),
            (lambda c: c.call("cntc_setnormalforce", math.nan), -99, "nan"),
            (lambda c: c.call("cntc_setpenetration", math.inf), -99, "not finite"),
            (lambda c: c.call("cntc_setreferencevelocity", -3e4), -99, "-30000"),
            (lambda c: c.call("cntc_setrollingstepsize", 0.0, 0.0), -34, "step of 0"),
            (lambda c: c.call("cntc_settangentialforces", math.nan, 0.0), -26, "not finite"),
            (lambda c: c.call("cntc_setsolverflags", 0, 4, [200, 30, 30, 10], 1, [0.0]), -99, "EPS"),
            (lambda c: c.call("cntc_setsolverflags", 0, 4, [200, 30, 30, 10], 1, [math.nan]), -99, "not finite"),
            (lambda c: c.call("cntc_setextrarigidslip", 5, [0.0] * 5, [0.0] * 5), -34, "899 elements"),
            (lambda c: c.call("rscntc_setlayers", 1, -1, [1.0], [2e5], [0.3]), -99, "-1 layers"),
            (lambda c: c.call("rscntc_setlayers", 1, 1, [1.0], [2e5], [0.6]), -99, "0 to 0.5"),
            (lambda c: c.call("rscntc_setlayers", 3, 1, [1.0], [2e5], [0.3]), -99, "not 3"),
        ]
        for refuse, code, words in refusals:
            with self.subTest(words):
                begin(None)
                c = self.contact()
                refuse(c)
                self.assertEqual(c.calculate(), code, c.error())
                self.assertEqual(c.error()[0], code)
                self.assertIn(words, c.error()[1])
                self.assertTrue(np.isnan(c.forces()).all())

    def test_friction_too_small_to_compute_with_is_raised_and_said_to_be(self):
        c = self.contact()
        c.friction(0)
        self.assertEqual(c.error()[0], 0)
        self.assertIn("taken as 1e-06", c.error()[1])
        self.assertEqual(c.calculate(), 0, c.error())
        self.assertLess(abs(c.forces()[1]), 1.01e-6 * 60000)

    def test_forces_that_are_not_asked_for_leave_the_others_as_they_are(self):
        c = self.contact()
        c.flags(F=1)
        for lateral in (0.0, 0.9):
            c.call("cntc_settangentialforces", 0.8, lateral)
            self.assertEqual(c.calculate(), 0, c.error())
            self.assertAlmostEqual(c.forces()[1] / (0.3 * 60000), 0.8, delta=1e-4)

    def test_blocks_without_points_are_refused(self):
        c = self.contact()
        self.assertEqual(c.calculate(), 0)
        for block in ((1, [-999], [-999], [0, 0.1, 1.0]), (2, [1, 0, 9], [1, 1, 9], [1, 0.1, 1.0]),
                      (9, [0.0], [0.0], [math.nan])):
            c.block(*block)
            error = c_int(0)
            c.call("subs_calculate", error)
            self.assertEqual(error.value, -34, block)

    def test_refusals_end_when_the_setting_is_taken(self):
        c = self.contact()
        c.flags(B=3)
        self.assertEqual(c.calculate(), -99)
        c.flags(B=0)
        self.assertEqual(c.calculate(), 0, c.error())
        self.assertEqual(c.error(), (0, ""))

    def test_messages_stand_in_the_out_file(self):
        with tempfile.TemporaryDirectory() as folder:
            begin(folder, output=0, name=b"drive")
            c = self.contact()
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])
            c.flags(B=4)
            c.calculate()
            text = (pathlib.Path(folder) / "drive.out").read_text()
            self.assertIn("ire 3, icp 1: cntc_calculate: error -99: cntc_setflags: flag 1971 (B, BOUND) = 4", text)
            begin(None)

    def test_other_modules_and_wrong_numbers(self):
        version, error, npatch = c_int(), c_int(77), c_int(77)
        library.cntc_initialize(c_int(5), c_int(11), version, error, b" ", c_int(1))
        self.assertEqual(error.value, -99)
        library.cntc_initialize(c_int(5), c_int(3), version, error, b" ", c_int(1))
        library.cntc_initialize(c_int(5), c_int(1), version, error, b" ", c_int(1))
        self.assertEqual(error.value, -31)
        library.cntc_getnumcontactpatches(c_int(5), npatch)
        self.assertEqual(npatch.value, -1)
        library.cntc_readinpfile(c_int(5), c_int(1988), b"a.inp", c_int(5), error)
        self.assertEqual(error.value, -39)
        for ire, icp in ((0, 1), (1000, 1), (1, 0), (1, 10), (1, -1)):
            library.cntc_calculate(c_int(ire), c_int(icp), error)
            self.assertEqual(error.value, -31)

    def test_eight_contacts_on_four_threads_have_the_bits_of_one_thread(self):
        cases = [row for row in table("half_space.csv") if number(row, "dx_mm") == 0.5][:8]

        def solved(index, ire):
            c = reference_contact(cases[index], ire, 1 + index)
            assert c.calculate() == 0, c.error()
            return [c.field(k) for k in (3, 4, 5, 15)] + [np.array(c.forces())]

        alone = [solved(k, 7) for k in range(8)]
        with ThreadPoolExecutor(4) as pool:
            together = list(pool.map(lambda k: solved(k, 8), range(8)))
        for one, other in zip(alone, together):
            for a, b in zip(one, other):
                np.testing.assert_array_equal(a, b)


if __name__ == "__main__":
    main()
