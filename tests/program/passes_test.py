#!/usr/bin/env python3
"""The command passes seen from outside. usage: passes_test.py BINARY SOURCE_DIR"""
import csv
import json
import pathlib
import sys
import unittest

from outside import FromOutside, railstrata

SOURCE = pathlib.Path(sys.argv[2]).resolve()
BASE = SOURCE / "cases" / "paper" / "base.toml"
LAYERED = SOURCE / "cases" / "paper" / "layer_3mm_2E0.toml"
SMOOTH = ["--set", "drive.friction_coefficient=0.1", "--set", "drive.traction_coefficient=0.05"]
COARSE = ["--cell", "1 mm", "--threads", "1", "-q", *SMOOTH]


def strength(mpa, where="material.rail"):
    return ["--set", f'{where}.yield_strength="{mpa} MPa"']


def rows(file):
    return list(csv.DictReader(line for line in file.read_text().splitlines() if not line.startswith("#")))


class Passes(FromOutside):
    def passes(self, name, *words, case=BASE):
        out = self.folder / name
        rc, _, err = railstrata("passes", case, *COARSE, "--out", out, *words)
        self.assertEqual(rc, 0, err)
        return out

    def test_below_first_yield_nothing_yields_and_below_the_limit_it_settles(self):
        strong = json.loads((self.passes("strong", *strength(2000), "--passes", 2) / "passes.json").read_text())
        self.assertEqual(strong["class"], "elastic shakedown")
        self.assertEqual(strong["last_pass"]["accumulated_strain"], 0)
        # factors of the command shakedown: first yield below 1, one track above
        out = self.folder / "factors"
        rc, _, err = railstrata("shakedown", BASE, *COARSE, *strength(560), "--no-report", "--out", out)
        self.assertEqual(rc, 0, err)
        factors = json.loads((out / "shakedown.json").read_text())["bodies"][0]["factors"]
        self.assertLess(factors["first_yield"], 0.95)
        self.assertGreater(factors["single_track"], 1.05)
        settles = self.passes("settles", *strength(560), "--passes", 20)
        self.assertEqual(json.loads((settles / "passes.json").read_text())["class"], "elastic shakedown")
        first = rows(settles / "passes.csv")[0]
        self.assertGreater(float(first["accumulated_strain"]), 1e-5)
        self.assertLess(float(first["sigma_x_min_MPa"]), -5)
        self.assertLess(abs(float(first["balance"])), 1e-6)

    def test_resumed_passes_have_the_bits_of_passes_in_one_go(self):
        weak = strength(400)
        whole = self.passes("whole", *weak, "--passes", 4)
        self.passes("parts", *weak, "--passes", 2)
        parts = self.passes("parts", *weak, "--passes", 4, "--resume")
        for name in ["passes.csv", "residual.csv", "profile.csv", "state.csv", "passes.json"]:
            numbers = [[line for line in (out / name).read_text().splitlines() if not line.startswith("#")]
                       for out in [whole, parts]]
            self.assertEqual(*numbers, name)
        other = [*strength(410), "--passes", 5, "--resume", "--out", parts]
        self.refused(2, ["passes", BASE, *COARSE, *other],
                     "no passes of this very case")

    def test_a_layer_may_stay_elastic_and_the_rail_below_it_yield(self):
        out = self.passes("layer", *strength(400), "--passes", 1, case=LAYERED)
        zones = {}
        for row in rows(out / "residual.csv"):
            zones[row["zone"]] = max(zones.get(row["zone"], 0), float(row["plastic_p"]))
        self.assertEqual(zones["1.0" if "1.0" in zones else "1"], 0)
        self.assertGreater(zones["0.0" if "0.0" in zones else "0"], 0)

    def test_what_it_cannot_answer_is_refused_with_a_remedy(self):
        self.refused(2, ["passes", BASE, "--cell", "1 mm", *strength(400), "--out", self.folder / "none"],
                     "its material bears 231 MPa in shear", "friction_coefficient")
        self.refused(2, ["passes", BASE, *COARSE, "--out", self.folder / "none"], "does not say how strong",
                     "yield_strength")
        weak = [*strength(400), "--out", self.folder / "none"]
        self.refused(2, ["passes", BASE, "--engine", "fem", *weak], "bem")
        self.refused(2, ["passes", BASE, "--passes", "0", *weak], "--passes")
        self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
