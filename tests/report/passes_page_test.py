#!/usr/bin/env python3
"""The page of passes in a browser, held against the files of its folder. usage: passes_page_test.py BINARY SOURCE"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from browser import Browser, run
from tables import read_table

BINARY, CASE = sys.argv[1], pathlib.Path(sys.argv[2]).resolve() / "cases" / "plastic" / "brittle_0.5mm.toml"


class PassesPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.place.name) / "passes"
        words = [BINARY, "passes", CASE, "--cell", "1 mm", "--passes", "3", "-q", "--out", cls.folder]
        subprocess.run(words, check=True, timeout=300)
        cls.summary = json.loads((cls.folder / "passes.json").read_text())
        BROWSER.open(cls.folder / "report.html")
        cls.first_words, cls.asked = BROWSER.console(), BROWSER.requests()

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def text(self, place):
        return BROWSER.js("return document.querySelector(arguments[0]).textContent", place)

    def trace(self, plot, k=0):
        return BROWSER.trace(plot, k)

    def test_it_asks_for_nothing_and_has_nothing_to_complain_of(self):
        self.assertEqual(self.first_words, [])
        self.assertEqual([a for a in self.asked if not str(a).startswith(("file:", "data:", "blob:"))], [])

    def test_the_verdict_stands_first_in_words_with_the_law_the_factors_and_the_ductility(self):
        words = self.text("#verdict-of-passes")
        self.assertTrue(words.startswith(self.summary["verdict"]), words)
        for part in [self.summary["law"], self.summary["shakedown"]["verdict"], "An equivalent strain of 0.5"]:
            self.assertIn(part, words)

    def test_maps_have_the_tables_values_and_say_nothing_where_nothing_has_yielded(self):
        table = read_table(self.folder / "residual.csv")
        drawn = self.trace("plot-passes-sigma-xx-1")
        flat = [v for row in drawn["z"] for v in row]
        self.assertEqual(len(flat), len(table["sigma_xx_MPa"]))
        for shown, value in zip(flat, table["sigma_xx_MPa"]):
            self.assertAlmostEqual(shown, value, delta=1e-5 * max(1, abs(value)))
        classes = [v for row in self.trace("plot-passes-class-1")["z"] for v in row]
        self.assertEqual([v is None for v in classes], [p == 0 for p in table["plastic_strain_accumulated"]])

    def test_curves_loops_and_both_stress_maps_are_those_of_the_tables(self):
        passes = read_table(self.folder / "passes.csv")
        net = self.trace("plot-passes-strain", 1)
        for shown, value in zip(net["y"], passes["net_strain"]):
            self.assertAlmostEqual(shown, value, delta=1e-5 * value)
        loops = read_table(self.folder / "loops.csv")
        shear = self.trace("plot-passes-loop-xz-1")
        self.assertIn("governing", shear["name"])
        mine = [k for k, p in enumerate(loops["point"]) if p == 0]
        self.assertAlmostEqual(shear["x"][3], 2e3 * loops["strain_xz"][mine[3]], delta=1e-5)
        along = read_table(self.folder / "along.csv")
        for plot, column in [("elastic", "von_mises_elastic_MPa"), ("yielding", "von_mises_MPa")]:
            most = max(v for row in self.trace(f"plot-passes-{plot}-1")["z"] for v in row)
            self.assertAlmostEqual(most, max(along[column]), delta=1e-2)

    def test_the_border_of_the_layer_is_drawn(self):
        border = self.trace("plot-passes-plastic-strain-accumulated-1", 1)
        self.assertEqual(border["y"], [0.5, 0.5])


if __name__ == "__main__":
    with Browser() as BROWSER:
        code = run()
    sys.exit(code)
