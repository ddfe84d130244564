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

    def test_conformal_contact_is_that_of_contact(self):
        """CONTACT's example mbench_conf, the wheel in the gauge corner: forces 0.1 % of FN, creepages 0.1 %."""
        slices = [2.0, math.radians(-20), 0.2, 0.2, math.radians(-10), 0.3, 0.3]
        c = wheel("right", friction=(10, slices))
        c.flag(DISCRETISATION, 4)
        c.flags(N=0)
        c.grid(-1, [0.2, 0.2, math.pi / 2, 9, 6])
        c.wheel("cntc_settrackdimensions", 3, [14, 0, 1435, 0.025] + 7 * [0.0])
        c.wheel("cntc_setwheelsetposition", 2, [0, 6.25, 0.1720, 0, 0.024, 0])
        c.wheel("cntc_setwheelsetvelocity", 2, [SPEED, 0, 0, 0, 0, -4.3481124])
        self.assertEqual(c.calculate(), 0, c.error())
        printed = [((8677, -573.0, -1669), (9.357e-3, 2.659e-2, 9.007e-4), (-12.2183, 724.9451, 4.5350, -0.4232)),
                   ((3310, -220.4, -626.1), (2.540e-2, 7.204e-2, 2.042e-3), (14.0993, 718.0626, 11.9436, -1.2220))]
        self.assertEqual(c.patches(), len(printed))
        for number, (forces, creepages, place) in enumerate(printed, 1):
            for value, expected in zip(c.patch(number).forces(), forces):
                self.assertAlmostEqual(value, expected, delta=1e-3 * forces[0])
            for value, expected in zip(c.patch(number).creepages(), creepages):
                self.assertAlmostEqual(value, expected, delta=1e-3 * expected)
            for value, expected in zip(c.location(number), place):
                self.assertAlmostEqual(value, expected, delta=5e-3)

    def test_slip_on_the_surfaces_is_that_of_the_plane_on_the_tread(self):
        """D = 3 for D = 2, to the part of the creepage that the tread's curvature makes."""
        plane, surface = wheel("right", ire=1), wheel("right", ire=2)
        surface.flag(DISCRETISATION, 3)
        for c in (plane, surface):
            self.assertEqual(roll(c, 2.0, 0, 0, -4.3481181), 0, c.error())
        for a, b in zip(plane.global_forces()[:3], surface.global_forces()[:3]):
            self.assertAlmostEqual(a, b, delta=2e-3 * LOAD)

    def test_a_force_along_the_track_gives_the_pitch_rate_that_needs_it(self):
        for side in ("left", "right"):
            c = wheel(side)
            c.flag(FORCE, 1)
            for wanted in (-1500.0, 0.0, 800.0):
                c.call("cntc_settangentialforces", wanted, 0.0)
                self.assertEqual(roll(c, 1.0, 0, 0, 0.0), 0, c.error())
                self.assertAlmostEqual(c.global_forces()[6], wanted, delta=1e-4 * LOAD)
                self.assertAlmostEqual(c.global_forces()[2], LOAD, delta=2e-5 * LOAD)
            found = c.list_of_wheel("cntc_getwheelsetvelocity", 6)
            free = wheel(side, ire=2)
            self.assertEqual(roll(free, 1.0, 0, 0, found[5]), 0)
            self.assertAlmostEqual(free.global_forces()[6], wanted, delta=1e-4 * LOAD)
        c.call("cntc_settangentialforces", 0.5 * LOAD, 0.0)  # friction carries 0.3 of it
        self.assertEqual(roll(c, 1.0, 0, 0, 0.0), -26)
        self.assertIn("no pitch rate has the given force", c.error()[1])

    def test_a_rail_gives_way_until_its_springs_carry_the_wheel(self):
        for side in ("left", "right"):
            across, down, extra = 2e4, 5e4, (300.0, -700.0)
            c = wheel(side)
            c.flag(FORCE, 3)
            c.wheel("cntc_settrackdimensions", 32, [across, extra[0], down, extra[1]])
            self.assertEqual(roll(c, 2.0 if side == "right" else -2.0, 0, 0.005, -4.3481181), 0, c.error())
            way, force = c.location(1)[17:19], c.global_forces()
            self.assertAlmostEqual(force[1] + extra[0], across * way[0], delta=1e-4 * LOAD)
            self.assertAlmostEqual(force[2] + extra[1], down * way[1], delta=1e-4 * LOAD)
            height = c.list_of_wheel("cntc_getwheelsetposition", 6)
            c.flags(N=0)
            c.wheel("cntc_setwheelsetposition", 2, height)
            self.assertEqual(c.calculate(), 0, c.error())
            self.assertAlmostEqual(c.global_forces()[2], LOAD, delta=1e-3 * LOAD)
            self.assertAlmostEqual(c.location(1)[18], way[1], delta=1e-3 * way[1])

    def test_smoothing_takes_noise_out_of_a_profile(self):
        """Points of the tread up and down by 3 um, 0.1 mm apart: pressures as without, with SMOOTH of both kinds."""
        listed = points("mbench_wheel.csv")
        near = [k for k, (y, _) in enumerate(listed) if abs(y) < 30]
        fine = [(y, z0 + (y - y0) / (y1 - y0) * (z1 - z0)) for k in near[:-1]
                for (y0, z0), (y1, z1) in [(listed[k], listed[k + 1])]
                for y in [y0 + (y1 - y0) * i / 5 for i in range(5)]]
        rough = [(y, z + (0.003 if k % 2 else -0.003)) for k, (y, z) in enumerate(fine)]
        found = {}
        for name, values, smooth, spline in (("fine", fine, 0, 0), ("old", rough, 2.0, 0), ("new", rough, 5.0, 1)):
            c = wheel("right")
            c.profile_values(values, 1, smooth=smooth, spline=spline)
            self.assertEqual(roll(c, 0.0, 0, 0, -4.3481181), 0, c.error())
            found[name] = c.patch(1).p_max()
        self.assertAlmostEqual(found["old"], found["fine"], delta=0.03 * found["fine"])
        self.assertAlmostEqual(found["new"], found["fine"], delta=0.03 * found["fine"])

    def test_a_wheel_in_the_side_of_a_rail_is_refused(self):
        """The back of its flange in a guard rail."""
        c = wheel("right")
        c.flags(N=0)
        back = [(-70.0, 4.0), (-69.7, 15.0), (-67.0, 22.0), (-62.0, 26.5), (-55.0, 27.5)]
        c.profile_values(back + points("mbench_wheel.csv"), 1)
        corner = [(25 + 5 * math.sin(a), 5 - 5 * math.cos(a)) for a in [math.radians(6 * k) for k in range(16)]]
        half = [(2.5 * k, 0.0) for k in range(10)] + corner + [(30.0, 5.0 + 2.5 * k) for k in range(1, 11)]
        c.profile_values([(-y, z) for y, z in half[:0:-1]] + half, 0)
        c.wheel("cntc_settrackdimensions", 3, [-1.0, 651.0, 2.0] + 8 * [0.0])
        c.wheel("cntc_setwheelsetposition", 2, [0, 0, 0, 0, 0, 0])
        c.wheel("cntc_setwheelsetvelocity", 2, [SPEED, 0, 0, 0, 0, -4.3481181])
        self.assertEqual(c.calculate(), -25)
        self.assertRegex(c.error()[1], "end of a profile|contacts on the side of a rail are not offered")

    def test_what_is_not_offered_is_refused_in_contacts_names(self):
        def refused(code, words, change):
            c = wheel("left")
            change(c)
            self.assertEqual(roll(c, 0.0, 0, 0, -4.3481181), code, words)
            self.assertIn(words, c.error()[1])

        refused(-99, "D = 6", lambda c: c.flag(DISCRETISATION, 6))
        refused(-99, "F = 0 to 2 (module 3), 0, 1 and 3 (module 1)", lambda c: c.flag(FORCE, 2))
        refused(-99, "KZRAIL", lambda c: c.wheel("cntc_settrackdimensions", 33, [0, 0, -1, 0]))
        refused(-32, "slcs", lambda c: c.profile("nose.slcs", 0, 0, 0, 1.0, 0.0))
        refused(-32, "ISMOOTH", lambda c: c.profile("rail.prr", 0, 0, 0, 1.0, 2.0, spline=2))
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
