#!/usr/bin/env python3
"""The command shakedown seen from outside. usage: shakedown_test.py BINARY SOURCE_DIR"""
import json
import pathlib
import re
import sys
import unittest

from outside import TINY, FromOutside, railstrata

SOURCE = pathlib.Path(sys.argv[2]).resolve()
LAYERED = SOURCE / "cases" / "paper" / "layer_3mm_2E0.toml"
STRONG = ["--set", 'material.rail.yield_strength="480 MPa"', "--set", 'layer.0.yield_strength="900 MPa"']
QUIET = ["--threads", "1", "--no-report", "-q"]
STUDY = f'''[study]
base = "{LAYERED}"
engines = ["bem"]
cell = "2 mm"
set = {{ "material.rail.yield_strength" = "480 MPa" }}
[[group]]
name = "g"
[group.vary]
"layer.0.thickness" = ["1 mm", "3 mm"]
"layer.0.young_ratio" = [1, 2]
"layer.0.yield_strength" = ["300 MPa", "2000 MPa"]
[[figure]]
id = "lasts"
kind = "verdict"
x = "layer.0.thickness"
y = "layer.0.young_ratio"
series = "layer.0.yield_strength"
'''
GRID = '''[[figure]]
id = "shear"
kind = "grid"
value = "layers_interface_shear_range_MPa"
x = "layer.0.thickness"
y = "layer.0.young_ratio"
where = { "layer.0.yield_strength" = ["2000 MPa"] }
'''
FACTORS = ["first_yield", "wandering", "single_track", "upper", "kinematic"]


class Shakedown(FromOutside):
    def shakedown(self, case, *words, command=("bem", "--maps")):
        out = self.folder / "out"
        rc, _, err = railstrata(*command, case, *QUIET, "--force", "--out", out, *words)
        self.assertEqual(rc, 0, err)
        return json.loads((out / "shakedown.json").read_text()), json.loads((out / "summary.json").read_text())

    def check_levels(self, found):
        """Melan: a wider choice of residual stresses never lowers the limit."""
        f = found["factors"]
        self.assertEqual(list(f), FACTORS)
        self.assertLess(0, f["first_yield"])
        self.assertLessEqual(f["wandering"], f["single_track"])
        self.assertLessEqual(f["single_track"], f["upper"])
        self.assertLessEqual(f["upper"], f["kinematic"])

    def test_factors_stand_in_both_files_with_what_governs(self):
        found, summary = self.shakedown(LAYERED, "--cell", "1 mm", *STRONG)
        self.check_levels(found)
        self.assertEqual(summary["shakedown"], found)
        governing = found["governing"]
        zones = {z["zone"]: z for z in found["bodies"][0]["zones"]}
        self.assertEqual(set(zones), {"rail", "layer"})
        self.assertEqual(governing["zone"], min(zones, key=lambda z: zones[z]["factors"]["wandering"]))
        self.assertEqual(governing["depth_m"], zones[governing["zone"]]["depth_m"])
        self.assertEqual(governing["zone"] == "layer", governing["depth_m"] < 3e-3)
        self.assertIn(found["verdict"], ["shakes down in one track", "may shake down in one track", "shakes down",
                                         "stays elastic", "yields in every passage", "ratchets"])
        limits = [line for line in (self.folder / "out" / "shakedown_rail_sliding.csv").read_text().splitlines()
                  if not line.startswith("#")]
        self.assertEqual(limits[0].split(",")[:3], ["traction_coefficient", "first_yield", "wandering"])
        self.assertEqual(len(limits), 14)
        self.assertEqual(found["factors"]["wandering"], zones[governing["zone"]]["factors"]["wandering"])

    def test_twice_the_strength_doubles_every_factor(self):
        single, _ = self.shakedown(LAYERED, "--cell", "1 mm", "--set", 'material.rail.yield_strength="400 MPa"')
        double, _ = self.shakedown(LAYERED, "--cell", "1 mm", "--set", 'material.rail.yield_strength="800 MPa"')
        for name in FACTORS:
            # one track: a program that ends at 0.1 %
            self.assertAlmostEqual(double["factors"][name] / single["factors"][name], 2,
                                   delta=4e-3 if name == "single_track" else 1e-9)

    def test_without_a_strength_maps_ask_for_one(self):
        self.refused(2, ["bem", "--maps", LAYERED, "--out", self.folder / "no"],
                     "the case gives no strength of rail, wheel or layers", "remedy: give yield_strength",
                     str(LAYERED))
        self.assertFalse((self.folder / "no").exists())
        rc, _, err = railstrata("bem", LAYERED, *QUIET, "--cell", "1 mm", "--out", self.folder / "bem")
        self.assertEqual(rc, 0, err)
        self.assertFalse((self.folder / "bem" / "shakedown.json").exists())
        self.assertNotIn("shakedown", json.loads((self.folder / "bem" / "summary.json").read_text()))

    def test_a_table_that_ends_too_early_is_told_with_its_key(self):
        table = 'material.rail.strength_table=[["0 mm", "800 MPa"], ["2 mm", "500 MPa"]]'
        self.refused(2, ["bem", "--maps", LAYERED, *QUIET, "--cell", "1 mm", "--set", table, "--out",
                         self.folder / "no"],
                     "material.rail.strength_table: ends at 2 mm", "remedy: add a row at")
        self.assertFalse((self.folder / "no").exists())

    def test_a_weak_bond_and_a_brittle_layer_end_what_shakes_down(self):
        strong = ["--set", 'material.rail.yield_strength="1500 MPa"', "--set", 'layer.0.yield_strength="2000 MPa"']
        found, summary = self.shakedown(LAYERED, "--cell", "1 mm", *strong)
        self.assertEqual(found["fails_by"], [])
        self.assertIsNone(summary["layers"]["delamination"])
        stress, shear = summary["layers"]["sigma_1_Pa"], summary["layers"]["interface_shear_Pa"]
        weak = ["--set", "layer.0.tensile_strength=" + f'"{0.9e-6 * stress} MPa"',
                "--set", 'layer.0.bond_tension="900 MPa"', "--set", f'layer.0.bond_shear="{0.8e-6 * shear} MPa"']
        strong[-1] = f'layer.0.yield_strength="{0.85e-6 * stress} MPa"'
        found, summary = self.shakedown(LAYERED, "--cell", "1 mm", *strong, *weak)
        self.assertEqual(found["fails_by"][-2:], ["brittle layer cracks", "interface shears"])
        self.assertAlmostEqual(summary["layers"]["share_of_tensile"], 1 / 0.9, delta=1e-3)
        self.assertAlmostEqual(summary["layers"]["delamination"], 1 / 0.64, delta=0.01)

    def test_finite_elements_answer_too(self):
        case = self.case(TINY.replace("[run]", "[run]\nrolling = false") +
                         '[material.rail]\nyield_strength = "500 MPa"\n')
        found, summary = self.shakedown(case, command=["run"])
        self.assertEqual(summary["run"]["engine"], "fem")
        self.assertEqual(summary["shakedown"], found)
        f = found["factors"]
        self.assertLess(0, f["first_yield"])
        self.assertLessEqual(f["wandering"], f["single_track"])
        self.assertLessEqual(f["single_track"], f["upper"])
        self.assertEqual(found["governing"]["zone"], "rail")

    def test_a_study_draws_what_lasts(self):
        file = self.folder / "study.toml"
        file.write_text(STUDY)
        out = self.folder / "study"
        rc, _, err = railstrata("study", file, "--out", out)
        self.assertLess(rc, 2, err)
        data = re.search(r'<script[^>]*id="data"[^>]*>(.*?)</script>', (out / "report.html").read_text(), re.S)
        row, = json.loads(data.group(1))["grids"]
        self.assertEqual([g["name"] for g in row["grids"]],
                         ["yield strength 300 MPa, half-space", "yield strength 2000 MPa, half-space"])
        self.assertEqual(row["x"], "thickness h [mm]")
        for grid, strength in zip(row["grids"], ["300_MPa", "2000_MPa"]):
            self.assertEqual((grid["x"], grid["y"]), (["1", "3"], ["1", "2"]))
            names = [f"thickness_{x}_mm_young_ratio_{y}_yield_strength_{strength}" for y in (1, 2) for x in (1, 3)]
            for name, cell in zip(names, grid["cells"]):
                found = json.loads((out / "g" / name / "bem" / "shakedown.json").read_text())
                self.assertEqual(cell["verdict"], found["verdict"])
                self.assertAlmostEqual(cell["factor"], found["factors"]["wandering"], delta=1e-9)
        file.write_text(STUDY + GRID)
        rc, _, err = railstrata("study", file, "--out", out)
        self.assertLess(rc, 2, err)
        data = re.search(r'<script[^>]*id="data"[^>]*>(.*?)</script>', (out / "report.html").read_text(), re.S)
        _, row = json.loads(data.group(1))["grids"]
        self.assertEqual(row["value"], "interface Δτ [MPa]")
        found = json.loads((out / "g" / "thickness_1_mm_young_ratio_1_yield_strength_2000_MPa" / "bem" /
                            "summary.json").read_text())
        self.assertAlmostEqual(row["grids"][0]["cells"][0]["factor"],
                               1e-6 * found["layers"]["interface_shear_range_Pa"], delta=1e-6)
        file.write_text(STUDY + GRID.replace("shear_range", "shear_rang"))
        self.refused(2, ["study", file, "--out", out], 'no column "layers_interface_shear_rang_MPa"', "did you mean")
        file.write_text(STUDY.replace('y = "layer', '# '))
        self.refused(2, ["study", file, "--out", out], 'shows verdicts over two keys and has no y')


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
