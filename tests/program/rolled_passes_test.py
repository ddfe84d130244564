#!/usr/bin/env python3
"""passes --engine fem seen from outside. usage: rolled_passes_test.py BINARY"""
import csv
import json
import signal

from outside import TINY, FromOutside, main, railstrata, slow, start, wait_for

WEAK = ["--set", 'material.rail.yield_strength="450 MPa"', "--set",
        'material.rail.kinematic_hardening=[{modulus = "20 GPa", recall = 50}]', "--set",
        "drive.traction_coefficient=0.1"]
# For what does not depend on the elements: a sixth of the time of those of tiny.toml.
COARSE = ["--set", 'mesh.element_size="6 mm"']
# Elements as long as half the patch mean over its peaks: with the 450 MPa of WEAK they flow by 3e-5, those of 3 mm by
# 2e-3. With this they flow by 4e-4.
COARSE_AND_WEAK = [*WEAK, *COARSE, "--set", 'material.rail.yield_strength="400 MPa"']
FILES = ["passes.csv", "residual.csv", "profile.csv", "loops.csv", "state.csv", "passes.json"]


def table(file):
    return list(csv.DictReader(line for line in file.read_text().splitlines() if not line.startswith("#")))


def numbers(folder):
    return {name: [line for line in (folder / name).read_text().splitlines() if not line.startswith("#")]
            for name in FILES}


class RolledPasses(FromOutside):
    def words(self, name, *words, threads=1):
        return ["passes", self.case(TINY), "--engine", "fem", "--roll-length", "50 mm", "-q", "--threads", threads,
                "--out", self.folder / name, *words]

    def passes(self, name, *words, threads=1):
        rc, _, err = railstrata(*self.words(name, *words, threads=threads))
        self.assertEqual(rc, 0, err)
        return self.folder / name

    def test_below_yield_nothing_accumulates(self):
        out = self.passes("strong", *COARSE, "--set", 'material.rail.yield_strength="3 GPa"', "--passes", 2)
        told = json.loads((out / "passes.json").read_text())
        self.assertEqual(told["class"], "elastic shakedown")
        self.assertEqual(told["last_pass"]["accumulated_strain"], 0)
        for row in table(out / "residual.csv"):
            self.assertEqual(float(row["plastic_strain_accumulated"]), 0)
            self.assertEqual(float(row["sigma_xx_MPa"]), 0)

    @slow
    def test_has_the_same_bits_however_it_is_cut_and_for_any_threads(self):
        weak = COARSE_AND_WEAK
        whole = numbers(self.passes("whole", *weak, "--passes", 2))
        rows = table(self.folder / "whole" / "passes.csv")
        self.assertGreater(float(rows[0]["accumulated_strain"]), 1e-4)
        self.assertLess(float(rows[1]["accumulated_strain"]), float(rows[0]["accumulated_strain"]))
        self.assertLess(float(rows[0]["sigma_x_min_MPa"]), -10)
        self.assertAlmostEqual(float(rows[1]["traction"]), 0.1, delta=0.01)
        self.assertEqual(whole, numbers(self.passes("threads", *weak, "--passes", 2, threads=2)))
        self.passes("parts", *weak, "--passes", 1)
        parts = self.folder / "parts"
        # killed inside pass 2, with a checkpoint of it
        process = start(*self.words("parts", *weak, "--passes", 2, "--resume", "--checkpoint-every", "0.01 s"))
        wait_for((parts / "checkpoint.h5").exists, process)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        self.assertEqual(len(table(parts / "passes.csv")), 1)
        self.passes("parts", *weak, "--passes", 2, "--resume")
        self.assertEqual(whole, numbers(parts))
        self.assertFalse((parts / "checkpoint.h5").exists())
        self.refused(2, self.words("parts", *WEAK, "--set", "drive.speed=\"20 m/s\"", "--resume"),
                     "no passes of this very case")

    @slow
    def test_killed_in_the_middle_of_pass_7_of_10_it_goes_on_to_the_same_bits(self):
        coarse = [*COARSE_AND_WEAK, "--passes", 10, "--no-report"]
        whole = numbers(self.passes("whole", *coarse))
        cut = self.folder / "cut"
        rows = lambda: len(table(cut / "passes.csv"))

        def within_pass_7():
            files = [cut / name for name in ("passes.csv", "state.csv", "checkpoint.h5.previous")]
            try:
                written, kept, checkpoint = (file.stat().st_mtime_ns for file in files)
            except FileNotFoundError:
                return False
            return rows() >= 6 and written <= kept < checkpoint

        process = start(*self.words("cut", *coarse, "--checkpoint-every", "0.05 s"))
        wait_for(within_pass_7, process)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        self.assertEqual(rows(), 6)
        resume = [word for word in self.words("cut", *coarse, "--resume") if word != "-q"]
        _, _, told = railstrata(*resume)
        self.assertNotIn("begins anew", told)  # but from its checkpoint
        self.assertIn("pass 7:", told)
        self.assertNotIn("pass 6:", told)
        self.assertEqual(whole, numbers(cut))
        self.assertEqual(rows(), 10)

    @slow
    def test_above_shakedown_it_flows_on_as_the_stationary_method_says_at_some_half_of_its_rate(self):
        """R260's cyclic law; rolled, pressure falls to 0.84 of the elastic one and elements of 4 mm take means."""
        strong = ["--set", 'material.rail.hardening="R260"', "--set", "drive.friction_coefficient=0.3", "--set",
                  "drive.traction_coefficient=0.1", "--passes", 4, "--no-report"]
        rolled = self.passes("rolled", *strong)
        steady = self.folder / "steady"
        rc, _, err = railstrata("passes", self.case(TINY), "--cell", "1 mm", "-q", "--threads", 1, "--out", steady,
                                "--set", 'passes.pressure="elastic"', *strong)
        self.assertEqual(rc, 0, err)
        classes = [json.loads((out / "passes.json").read_text())["class"] for out in (rolled, steady)]
        self.assertEqual(*classes)
        net = [[float(row["net_strain"]) for row in table(out / "passes.csv")] for out in (rolled, steady)]
        for mine, theirs in zip(net[0][1:], net[1][1:]):
            self.assertLess(0.4 * theirs, mine)
            self.assertLess(mine, 0.8 * theirs)
        self.assertAlmostEqual(net[0][3] / net[0][2], net[1][3] / net[1][2], delta=0.05)  # falling alike
        self.assertLess(float(table(rolled / "passes.csv")[-1]["p_max_MPa"]), 950)

    @slow
    def test_loops_are_those_of_the_section(self):
        out = self.passes("loops", *WEAK, "--passes", 2)
        told = json.loads((out / "passes.json").read_text())
        self.assertEqual(told["loops"][0]["name"], "governing")
        self.assertEqual(told["zones"], [{"name": "rail", "zone": 0, "top_m": 0}])
        rows = table(out / "loops.csv")
        for k, point in enumerate(told["loops"]):
            mine = [row for row in rows if float(row["point"]) == k]
            x = [float(row["x_mm"]) for row in mine]
            self.assertEqual(x, sorted(x, reverse=True))  # the load comes and goes
            self.assertGreater(x[0], 8)
            self.assertLess(x[-1], -20)
            p = [float(row["plastic_strain_accumulated"]) for row in mine]
            self.assertLess(max(before - now for before, now in zip(p, p[1:])), 0.05 * max(p))  # steady but for ringing
            section = min(table(out / "residual.csv"), key=lambda row: abs(float(row["y_mm"]) - 1e3 * point["y_m"]) +
                          abs(float(row["depth_mm"]) - 1e3 * point["depth_m"]))
            after, flowed = float(section["plastic_strain_accumulated"]), float(section["accumulated_strain"])
            self.assertAlmostEqual(p[-1], after, delta=0.1 * after)
            self.assertAlmostEqual(p[0], after - flowed, delta=0.1 * after)  # as the pass before has left it
            # under the wheel the rail is pressed down hardest
            pressed = min(mine, key=lambda row: float(row["sigma_zz_MPa"]))
            self.assertLess(abs(float(pressed["x_mm"])), 4)
            self.assertLess(float(pressed["sigma_zz_MPa"]), -200)
            if k == 0:  # behind the wheel what is left is the residual stress, but for the wheel's own field
                self.assertAlmostEqual(float(mine[-1]["sigma_xx_MPa"]), float(section["sigma_xx_MPa"]), delta=5)

    def test_the_contact_moves_with_a_wheel_that_wanders(self):
        sides = ["--set", 'passes.lateral_positions=["-3 mm", "3 mm"]']
        out = self.passes("wanders", *WEAK, *COARSE, *sides, "--passes", 2)
        rows = table(out / "passes.csv")
        self.assertEqual([float(row["lateral_mm"]) for row in rows], [-3, 3])
        self.assertLess(float(rows[0]["net_y_mm"]), 0)
        self.assertGreater(float(rows[1]["net_y_mm"]), 0)

    def test_what_it_cannot_answer_is_refused_with_a_remedy(self):
        self.refused(2, self.words("none"), "run.plasticity = true needs material.rail.yield_strength",
                     "grade = \"R260\"")
        short = [word if word != "50 mm" else "40 mm" for word in self.words("none", *WEAK)]
        self.refused(2, short, "leaves no steady stations", "roll 49.2 mm or more")
        self.refused(2, self.words("none", *WEAK, "--set", 'mesh.element="one_point"'), 'mesh.element = "full"')


if __name__ == "__main__":
    main()
