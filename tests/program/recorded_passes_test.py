#!/usr/bin/env python3
"""The recorded passes of cases/plastic are whole and say what its README says. usage: recorded_passes_test.py SOURCE"""
import csv
import pathlib
import re
import sys
import unittest

FOLDER = pathlib.Path(sys.argv.pop(1)) / "cases" / "plastic"
NAMES = {"R260": "r260", "R350HT": "r350ht", "clad": "clad_2mm", "brittle layer": "brittle_0.5mm",
         "paper's layer": "paper_3mm"}


def rows(name):
    lines = (FOLDER / "recorded" / name).read_text().splitlines()
    return [{k: float(v) for k, v in row.items() if v} for row in csv.DictReader(l for l in lines if l[0] != "#")]


class RecordedPasses(unittest.TestCase):
    def test_every_case_has_twenty_settled_passes_in_equilibrium(self):
        without_records = {"scattered", "wandering"}
        cases = {f.stem for f in FOLDER.glob("*.toml") if "expect" not in f.name}
        self.assertEqual(cases, {*NAMES.values(), *without_records})
        for name in NAMES.values():
            passes = rows(f"{name}.passes.csv")
            self.assertEqual([int(p["pass"]) for p in passes], list(range(1, 21)))
            self.assertLessEqual(max(p["error"] for p in passes), 1e-4)
            self.assertLess(max(abs(p["balance"]) for p in passes), 1e-9)

    def test_the_readme_has_their_numbers(self):
        text = (FOLDER / "README.md").read_text().replace("−", "-")
        for title, name in NAMES.items():
            last = rows(f"{name}.passes.csv")[-1]
            cells = [c.strip() for c in re.search(rf"^\| {title} \|(.*)\|$", text, re.M).group(1).split("|")]
            self.assertEqual(cells[0], f"{last['accumulated_strain']:.1e}".replace("e-0", "e-"))
            self.assertEqual(cells[1], f"{last['net_strain']:.1e}".replace("e-0", "e-"))
            self.assertAlmostEqual(float(cells[3]), last["net_depth_mm"], delta=0.051)
            self.assertEqual(cells[4], f"{last['sigma_x_min_MPa']:.0f}, {last['sigma_y_min_MPa']:.0f}")

    def test_rolled_passes_flow_on_slower_than_stationary_ones(self):
        rolled, stationary = rows("r260_rolled.passes.csv"), rows("r260.passes.csv")
        self.assertEqual([int(p["pass"]) for p in rolled], list(range(1, len(rolled) + 1)))
        self.assertGreaterEqual(len(rolled), 10)
        self.assertLess(max(p["error"] for p in rolled), 0.1)  # as steady as `passes` asks for
        self.assertLess(max(abs(p["balance"]) for p in rolled), 1e-4)
        for mine, theirs in zip(rolled[1:], stationary[1:]):
            self.assertLess(mine["net_strain"], 0.8 * theirs["net_strain"])
            self.assertGreater(mine["net_strain"], 0.4 * theirs["net_strain"])
        for before, after in zip(rolled, rolled[1:]):
            self.assertLess(after["p_max_MPa"], before["p_max_MPa"])  # the rail beds in
        text = (FOLDER / "README.md").read_text().replace("−", "-")
        cells = [c.strip() for c in re.search(r"^\| R260, rolled \|(.*)\|$", text, re.M).group(1).split("|")]
        last = rolled[-1]
        self.assertEqual(cells, [f"{last['accumulated_strain']:.1e}".replace("e-0", "e-"),
                                 f"{last['net_strain']:.1e}".replace("e-0", "e-"), f"{last['net_depth_mm']:.1f}",
                                 f"{last['sigma_x_min_MPa']:.0f}, {last['sigma_y_min_MPa']:.0f}",
                                 f"{last['p_max_MPa']:.0f}"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
