#!/usr/bin/env python3
"""Wheel on rail, module 1 of CONTACT's interface. usage: contact_wheel_test.py LIBRARY REFERENCE_FOLDER [unittest...]

Numbers to compare with: REFERENCE_FOLDER/mbench_a22.csv, what CONTACT printed of the Manchester contact benchmark.
"""
import csv
import ctypes
import itertools
import math
import pathlib
import sys
import unittest

import contact_library
from contact_library import MM, SI, SIMPACK, Wheel, c_int

LIBRARY, REFERENCE = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1))
library = contact_library.load(LIBRARY)
CONFIG, DISCRETISATION, TIME, FORCE = 1967, 1977, 1970, 1974
LOAD = 10000.0
SPEED = 2000.0  # mm/s


def setUpModule():
    """No file of messages in the working folder."""
    contact_library.begin(library)


def tearDownModule():
    library.cntc_finalizelast()


def table(name):
    with open(REFERENCE / name) as file:
        return [{k: v if k == "side" else float(v) for k, v in row.items()}
                for row in csv.DictReader(line for line in file if not line.startswith("#"))]


def points(name):
    return [(row["y_mm"], row["z_mm"]) for row in table(name)]


def wheel(side, units=MM, ire=1, friction=None):
    """The benchmark's wheel in the middle of its track, in any units; rolling speeds are of `roll`."""
    length = {MM: 1.0, SI: 1e-3, SIMPACK: 1e-3}[units]
    c = Wheel(library, ire, units)
    c.flag(CONFIG, 0 if side == "left" else 1)
    c.materials(0.28, 0.28, 82000 / length ** 2, 82000 / length ** 2)
    c.set("cntc_setfrictionmethod", *(friction or (0, [0.3, 0.3])))
    c.grid(-1, [0.2 * length, 0.2 * length, math.pi / 2, 8 * length, 4 * length])
    c.wheel("cntc_settrackdimensions", 3, [14 * length, 0, 1435 * length] + 8 * [0.0])
    c.wheel("cntc_setwheelsetdimensions", 3, [1360 * length, -70 * length, 460 * length])
    c.profile_values(points("mbench_rail.csv"), 0)
    c.profile_values(points("mbench_wheel.csv"), 1)
    return c


def roll(c, y, turn, yaw, pitch_rate, units=MM, load=LOAD, forward=SPEED):
    length = {MM: 1.0, SI: 1e-3, SIMPACK: 1e-3}[units]
    c.wheel("cntc_setwheelsetposition", 2, [0, y * length, 0, turn, yaw, 0])
    c.wheel("cntc_setwheelsetvelocity", 2, [forward * length, 0, 0, 0, 0, pitch_rate])
    c.load(load)
    return c.calculate()


def place_of(row):
    return row["y_mm"], row["roll_rad"], row["yaw_rad"], row["pitch_rate_rad_per_s"]


class WheelOnRail(unittest.TestCase):
    def test_patches_of_the_manchester_benchmark_are_those_of_contact(self):
        """To the digits that it printed: places 1e-3 mm, forces 0.1 % of FN; flange and tread, left and right."""
        worst = {"place": 0.0, "force": 0.0}
        for (side, *_), rows in itertools.groupby(table("mbench_a22.csv"), lambda r: (r["side"], r["y_mm"])):
            rows = list(rows)
            c = wheel(side)
            self.assertEqual(roll(c, *place_of(rows[0])), 0, c.error())
            self.assertEqual(c.patches(), len(rows), rows[0])
            total = c.global_forces()
            self.assertAlmostEqual(total[0], rows[0]["track_fx_N"], delta=1e-3 * LOAD)
            self.assertAlmostEqual(total[1], rows[0]["track_fy_N"], delta=1e-3 * LOAD)
            self.assertAlmostEqual(total[2], LOAD, delta=2e-5 * LOAD)
            for row in rows:
                patch, place = c.patch(int(row["patch"])), c.location(int(row["patch"]))
                found = dict(zip(["xcp_mm", "ycp_mm", "zcp_mm", "angle_rad"], place))
                found.update(y_rail_mm=place[5], y_wheel_mm=place[10], z_wheel_mm=place[11])
                for name, value in found.items():
                    self.assertAlmostEqual(value, row[name], delta=1e-3, msg=f"{name} {row}")
                forces = dict(zip(["fn_N", "fx_N", "fs_N"], patch.forces()))
                for name, value in forces.items():
                    self.assertAlmostEqual(value, row[name], delta=1e-3 * row["fn_N"], msg=f"{name} {row}")
                for name, value in zip(["cksi", "ceta", "cphi_1_per_mm"], patch.creepages()):
                    self.assertAlmostEqual(value, row[name], delta=2e-3 * abs(row[name]) + 1e-8, msg=f"{name} {row}")
                self.assertAlmostEqual(patch.approach(), row["approach_mm"], delta=2e-3 * row["approach_mm"])
                self.assertAlmostEqual(patch.p_max(), row["pmax_MPa"], delta=2e-3 * row["pmax_MPa"])

    def test_a_left_and_a_right_wheel_are_mirror_images(self):
        a, b = wheel("left", ire=1), wheel("right", ire=2)
        self.assertEqual(roll(a, 2.0, -1e-4, 0.005, -4.346), 0)
        self.assertEqual(roll(b, -2.0, 1e-4, -0.005, -4.346), 0)
        signs = [1, -1, 1, -1, 1, -1]
        for of_a, of_b, sign in zip(a.global_forces(), b.global_forces(), signs):
            self.assertAlmostEqual(of_a, sign * of_b, delta=1e-6 * LOAD)
        for k, sign in enumerate([1, -1, 1, -1]):
            self.assertAlmostEqual(a.location(1)[k], sign * b.location(1)[k], places=9)
        p_left, p_right = a.patch(1).field(5), b.patch(1).field(5)
        self.assertLess(abs(p_left - p_right[::-1]).max(), 1e-9 * p_left.max())
        self.assertLess(abs(a.patch(1).field(4) + b.patch(1).field(4)[::-1]).max(), 1e-9 * p_left.max())

    def test_units_change_numbers_and_nothing_else(self):
        c = wheel("right")
        self.assertEqual(roll(c, 5.0, -3.554e-4, 0.012, -4.3353637), 0)
        expected, creep = c.global_forces(), c.patch(1).creepages()
        for units, length, body in ((SI, 1e-3, 1), (SIMPACK, 1e-3, -1)):
            other = wheel("right", units, ire=2)
            self.assertEqual(roll(other, 5.0, -3.554e-4, 0.012, -4.3353637, units), 0)
            for k, (a, b) in enumerate(zip(expected, other.global_forces())):
                unit, arm = (length, 760) if k % 6 >= 3 else (1, 1)
                self.assertAlmostEqual(body * unit * a, b, delta=2e-5 * LOAD * arm * unit, msg=f"{units} {k}")
            found = other.patch(1).creepages()
            for a, b, unit in zip(creep, found, (1, 1, 1 / length)):
                self.assertAlmostEqual(body * unit * a, b, delta=1e-4 * abs(unit * a))

    def test_moments_belong_to_the_forces(self):
        """About the wheel's and the rail's origin they differ by the way between them."""
        c = wheel("right")
        self.assertEqual(roll(c, 5.0, -3.554e-4, 0.012, -4.3353637), 0)
        place, f = c.location(1), c.global_forces()
        yaw, turn = 0.012, -3.554e-4
        way = [place[20], place[21] - place[25], place[22] - place[26]]  # from the rail's origin to the wheel's
        force = f[:3]
        moment = [f[3] - (way[1] * force[2] - way[2] * force[1]), f[4] - (way[2] * force[0] - way[0] * force[2]),
                  f[5] - (way[0] * force[1] - way[1] * force[0])]
        axes = [[math.cos(yaw), math.cos(turn) * math.sin(yaw), math.sin(turn) * math.sin(yaw)],
                [-math.sin(yaw), math.cos(turn) * math.cos(yaw), math.sin(turn) * math.cos(yaw)],
                [0, -math.sin(turn), math.cos(turn)]]
        for axis, found in zip(axes, f[9:12]):
            self.assertAlmostEqual(sum(a * m for a, m in zip(axis, moment)), found, delta=1e-4 * LOAD)
        for axis, found in zip(axes, f[6:9]):
            self.assertAlmostEqual(sum(a * v for a, v in zip(axis, force)), found, delta=1e-9 * LOAD)

    def test_a_height_gives_the_force_that_needs_it(self):
        c = wheel("left")
        self.assertEqual(roll(c, 0.0, 0, 0, -4.3481181), 0)
        position = (ctypes.c_double * 6)()
        library.cntc_getwheelsetposition(c_int(1), c_int(6), position)
        self.assertAlmostEqual(position[2], 0.1981, delta=1e-4)  # mm, as CONTACT printed
        c.flag(contact_library.N, 0)
        c.wheel("cntc_setwheelsetposition", 2, list(position))
        self.assertEqual(c.calculate(), 0)
        self.assertAlmostEqual(c.global_forces()[2], LOAD, delta=2e-5 * LOAD)
        lifted = list(position)
        lifted[2] = 0.0
        c.wheel("cntc_setwheelsetposition", 2, lifted)
        self.assertEqual(c.calculate(), 0)
        self.assertEqual(c.patches(), 0)
        self.assertEqual(c.global_forces()[2], 0)

    def test_friction_varies_with_the_inclination(self):
        """A patch between two slices has what lies between them; all of it slips, spin turns a little of it."""
        slices = [2.0, math.radians(-20), 0.2, 0.2, math.radians(-10), 0.3, 0.3]
        c = wheel("right", friction=(10, slices))
        self.assertEqual(roll(c, 5.0, -3.554e-4, 0.012, -4.3353637), 0)
        for number in range(1, c.patches() + 1):
            angle = c.location(number)[13]
            expected = 0.2 + 0.1 * min(max((angle + math.radians(20)) / math.radians(10), 0), 1)
            fn, fx, fs, _ = c.patch(number).forces()
            self.assertLess(math.hypot(fx, fs) / fn, expected * (1 + 1e-5))
            self.assertGreater(math.hypot(fx, fs) / fn, 0.97 * expected)

    def test_shifts_go_on_from_the_case_before(self):
        """CONTACT's test m1_catt_shift, cases 1 to 3: a flat wheel on a round rail, yawed and rolled, P = 2, then 0."""
        c = Wheel(library)
        c.flag(CONFIG, 1)
        c.flags(T=1, N=0)
        c.materials(0.28, 0.28, 200, 200)
        c.friction(0.4)
        c.grid(-1, [0.2, 0.2, math.pi / 2, 8, 4])
        c.wheel("cntc_settrackdimensions", 3, [-1.0] + 10 * [0.0])
        c.wheel("cntc_setwheelsetdimensions", 3, [0, 0, 100])
        c.profile_values([(0.1 * k, 100 - math.sqrt(100 ** 2 - (0.1 * k) ** 2)) for k in range(-600, 601)], 0)
        c.profile_values([(0.5 * k, 0.0) for k in range(-100, 101)], 1)
        c.wheel("cntc_setwheelsetflexibility", 4, [0, 0, 0, math.radians(5)] + 8 * [0.0])
        printed = [(-23.19, -26.15, 286.0), (-23.92, -26.29, 288.6), (-24.62, -26.40, 290.8)]
        for number, (fx, fs, moment) in enumerate(printed):
            c.flag(TIME, 2 if number == 0 else 0)
            c.wheel("cntc_setwheelsetposition", 2, [0.2 * number, 0, -0.2201, 0, 0.004, -0.002 * number])
            way = 4.0 if number == 0 else 0.2
            c.wheel("cntc_setwheelsetvelocity", 2, [way, 0, 0, 0, 0, -0.00996 * way])
            self.assertEqual(c.calculate(), 0, c.error())
            found, place = c.patch(1).forces(), c.location(1)
            # CONTACT prints the moment about the origin of its elements, here it is about the patch's own.
            about = found[3] + (0.2 * number + place[0]) * found[2] - place[7] * found[1]
            self.assertAlmostEqual(found[0], 239.8, delta=1e-3 * 239.8)
            for value, expected, arm in ((found[1], fx, 1), (found[2], fs, 1), (about, moment, 4)):  # mm, a half axis
                self.assertAlmostEqual(value, expected, delta=1e-3 * 239.8 * arm, msg=number)

    def test_what_is_not_offered_is_refused_in_contacts_names(self):
        def refused(code, words, change):
            c = wheel("left")
            change(c)
            self.assertEqual(roll(c, 0.0, 0, 0, -4.3481181), code)
            self.assertIn(words, c.error()[1])

        refused(-99, "D = 4", lambda c: c.flag(DISCRETISATION, 4))
        refused(-99, "F = 3", lambda c: c.wheel("cntc_settrackdimensions", 33, [0, 0, 0, 0]))
        refused(-32, "slcs", lambda c: c.profile("nose.slcs", 0, 0, 0, 1.0, 0.0))
        refused(-32, "SMOOTH", lambda c: c.profile("rail.prr", 0, 0, 0, 1.0, 2.0))
        refused(-25, "does not stand over the rail",
                lambda c: c.wheel("cntc_setwheelsetdimensions", 3, [1860, -70, 460]))
        c = Wheel(library)
        self.assertEqual(c.calculate(), -32)
        self.assertEqual(c.patches(), 0)

    def test_profiles_come_back_as_they_were_given(self):
        c = wheel("right")
        self.assertEqual(roll(c, 0.0, 0, 0, -4.3481181), 0)
        count = (ctypes.c_double * 1)()
        kind, step = (c_int * 2)(0, 1), (ctypes.c_double * 1)(0.5)
        library.cntc_getprofilevalues(c_int(1), c_int(0), c_int(2), kind, c_int(1), step, c_int(1), count)
        n = int(count[0])
        values = (ctypes.c_double * (2 * n))()
        library.cntc_getprofilevalues(c_int(1), c_int(1), c_int(2), kind, c_int(1), step, c_int(2 * n), values)
        listed = points("mbench_rail.csv")
        for y, z in list(zip(values[:n], values[n:]))[5:-5]:
            k = next(k for k in range(1, len(listed)) if listed[k][0] >= y)
            (y0, z0), (y1, z1) = listed[k - 1], listed[k]
            if y1 - y0 > 0.05:
                self.assertAlmostEqual(z, z0 + (y - y0) / (y1 - y0) * (z1 - z0), delta=0.02)


if __name__ == "__main__":
    unittest.main()
