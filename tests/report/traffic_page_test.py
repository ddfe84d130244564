#!/usr/bin/env python3
"""The page of a rail that was followed through its traffic, with the range of its life, held against the files of its
folder. usage: traffic_page_test.py BINARY"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from browser import Browser, run

BINARY = sys.argv[1]
# a layer that is worn and ground, and metal that stays elastic: a run takes a second
CASE = """
[geometry]
rail_profile = "arc:R=80 mm"
wheel_profile = "arc:R=-400 mm"
cant = 0
[material.rail]
yield_strength = "3000 MPa"
fatigue_limit = "180 MPa"
dang_van_coefficient = 0.23
fatigue_exponent = 8
[[layer]]
name = "clad"
thickness = "2 mm"
young_ratio = 1.0
yield_strength = "3000 MPa"
[drive]
traction_coefficient = 0.1
friction_coefficient = 0.3
spin = "0 1/m"
[grinding]
every = "0.5 Mt"
depth = "0.02 mm"
[life]
wear_scatter = 0
place_scatter = "0 mm"
[[load]]
passages = 1000
wheel_load = "100 kN"
"""


class TrafficPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        case, cls.folder = pathlib.Path(cls.place.name) / "a.toml", pathlib.Path(cls.place.name) / "out"
        case.write_text(CASE)
        subprocess.run([BINARY, "collective", case, "--cell", "1 mm", "--until", "2 Mt", "--range", "-q", "--out",
                        cls.folder], check=True, timeout=300)
        cls.traffic = json.loads((cls.folder / "collective.json").read_text())["traffic"]
        lines = (cls.folder / "range.csv").read_text().splitlines()
        cls.runs = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        BROWSER.open(cls.folder / "report.html")
        cls.first_words = BROWSER.console()

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def series(self, chart):
        count = BROWSER.js("return document.getElementById(arguments[0]).drawn.data.length", f"plot-{chart}")
        return {t["name"]: t for t in (BROWSER.trace(f"plot-{chart}", k) for k in range(count))}

    def test_the_verdict_stands_first_with_the_range_and_what_decides(self):
        first = self.traffic["range"]["first_damage"]
        words = BROWSER.text("#verdict")
        self.assertEqual(self.first_words, [])
        best, low = (f"{first[key]:.3g}" for key in ("best_MGT", "low_MGT"))
        self.assertTrue(words.startswith(f"! First crack: after {best} MGT ({low} to "), words)
        self.assertIn(self.traffic["range"]["decides"], words)
        self.assertIn("Layer: ", words)

    def test_a_row_of_the_table_for_each_run_and_the_range_holds_every_life(self):
        self.assertEqual([r["changed"] for r in self.runs], ["", "friction", "friction", "strength", "strength"])
        best, *others = [float(r["first_damage_MGT"]) for r in self.runs]
        first = self.traffic["range"]["first_damage"]
        self.assertEqual(first["best_MGT"], best)
        for life in others:
            self.assertTrue(first["low_MGT"] <= life <= first["high_MGT"])
        self.assertAlmostEqual(sum(i["share"] for i in self.traffic["range"]["inputs"]), 1)

    def test_the_way_ends_at_the_crack_and_shows_depths_and_grindings(self):
        lines = self.series("traffic")
        used = lines["fatigue used"]
        self.assertAlmostEqual(used["x"][-1], self.traffic["range"]["first_damage"]["best_MGT"], delta=1e-5)
        self.assertEqual(used["y"][-1], 1)
        self.assertEqual(lines["layer left (1 = 2 mm)"]["y"][0], 1)
        removed = next(t for name, t in lines.items() if name.startswith("removed depth"))
        for shown, moment in zip(removed["x"], self.traffic["history"], strict=True):
            self.assertAlmostEqual(shown, 1e-9 * moment["traffic_kg"], delta=1e-5)
        self.assertEqual(lines["grinding"]["x"][::3], [0.5, 1, 1.5, 2])

    def test_the_head_shows_the_place_below_the_layer_that_fails(self):
        lines = self.series("head")
        place = next(t for name, t in lines.items() if name.startswith("first crack: fatigue"))
        self.assertEqual(len(place["x"]), 1)
        self.assertLess(place["y"][0], max(lines["bottom of the layer"]["y"]))

    def test_bars_go_from_the_best_life_to_those_at_the_ends(self):
        ends = [self.series("decides")[f"at the {end} value"] for end in ("lower", "higher")]
        best = self.traffic["range"]["first_damage"]["best_MGT"]
        inputs = self.traffic["range"]["inputs"][::-1]  # from below
        for bars, key in zip(ends, ("life_at_low_MGT", "life_at_high_MGT")):
            for k, one in enumerate(inputs):
                self.assertAlmostEqual(bars["x"][3 * k], best, delta=1e-5 * best)
                self.assertAlmostEqual(bars["x"][3 * k + 1], one[key], delta=1e-5 * one[key])
                self.assertEqual(bars["y"][3 * k], k)

    def test_every_assumption_has_its_key(self):
        rows = BROWSER.js("return [...document.querySelectorAll('#table-assumptions tbody tr')].map(r => "
                          "[...r.children].map(c => c.textContent))")
        keys = " ".join(row[-1] for row in rows)
        for key in ["drive.friction_coefficient", "passes.ductility", "layer.0.hardening",
                    "material.rail.fatigue_limit", "collective.wear_law", "grinding.every", "life.until"]:
            self.assertIn(key, keys)
        self.assertIn("0.21 to 0.39 (life.friction_scatter)", [row[2] for row in rows])


if __name__ == "__main__":
    with Browser() as BROWSER:
        code = run()
    sys.exit(code)
