#!/usr/bin/env python3
"""`validate` from outside: shipped sets, one of one's own, mistakes. usage: validate_test.py BINARY SOURCE_DIR"""
import csv
import pathlib
import shutil
import sys

from outside import FromOutside, main, railstrata, slow

SOURCE = pathlib.Path(sys.argv[2]).resolve()
SETS = sorted(f.parent for f in SOURCE.glob("cases/validation/*/validation.toml"))
QUICK = ("carter", "conformal_grooves", "ellea", "ertz_knothe", "hertz", "kenpave", "material_path", "r260_yield")
OWN = """title = "My disc"
source = "my bench"
reference = "measured"
uncertainty = "not known"
fitted = "nothing"
cell = "0.4 mm"
[[vary]]
column = "load_kN"
key = "load"
unit = "kN"
[[compare]]
column = "p_MPa"
title = "largest pressure"
result = "p_max_MPa"
relative = true
bar = 0.02
"""


class Validate(FromOutside):
    def own(self, text=OWN, data="load_kN,p_MPa\n20,653.2\n40,823.0\n"):
        folder = self.folder / "my disc"
        folder.mkdir(exist_ok=True)
        shutil.copy(SOURCE / "cases/validation/hertz/case.toml", folder)
        (folder / "validation.toml").write_text(text, encoding="utf-8")
        (folder / "data.csv").write_text(data, encoding="utf-8")
        return folder

    def validate(self, *words, expected=0):
        rc, out, err = railstrata("validate", *words, "--out", self.folder / "out", "--force")
        self.assertEqual(rc, expected, out + err)
        return out, err

    def test_shipped_sets_of_a_second_are_within_their_bars(self):
        out, _ = self.validate(*QUICK)
        for name in QUICK:
            self.assertIn(name, out)
            self.assertTrue((self.folder / "out" / name / "report.html").exists())
        self.assertNotIn("outside", out)
        self.assertNotIn("not solved", out)
        self.assertIn("<title>", (self.folder / "out/report.html").read_text(encoding="utf-8"))

    @slow
    def test_every_shipped_set_is_within_its_bar_but_for_cracks_of_r260(self):
        out, _ = self.validate("--all", expected=1)
        for folder in SETS:
            self.assertIn(folder.name, out)
            self.assertTrue((self.folder / "out" / folder.name / "report.html").exists())
        self.assertNotIn("not solved", out)
        outside = [line for line in out.splitlines() if "outside" in line]
        self.assertEqual([line.split()[0] for line in outside], ["field_crack", "field_r260"])
        self.assertIn("first crack", outside[1])

    def test_the_page_of_the_documentation_has_every_set(self):
        page = (SOURCE / "docs/validation.md").read_text(encoding="utf-8")
        for folder in SETS:
            self.assertIn(f"`railstrata validate {folder.name}`", page)

    def test_the_list_names_the_sets(self):
        rc, out, _ = railstrata("validate")
        self.assertEqual(rc, 0)
        self.assertEqual([line.split()[0] for line in out.splitlines()], [f.name for f in SETS])

    def test_a_set_of_ones_own_needs_no_code(self):
        out, _ = self.validate(self.own())
        self.assertIn("within the bar", out)
        with open(self.folder / "out/my disc/comparison.csv", newline="", encoding="utf-8") as f:
            rows = list(csv.DictReader(line for line in f if not line.startswith("#")))
        self.assertEqual(list(rows[0]), ["load_kN", "p_MPa", "ours of p_MPa"])
        self.assertAlmostEqual(float(rows[0]["ours of p_MPa"]) / 653.2, 1, delta=0.005)

    def test_the_usual_folder_takes_later_answers_and_another_is_kept(self):
        folder = self.own()
        for _ in range(2):
            rc, out, err = railstrata("validate", folder, cwd=self.folder)
            self.assertEqual(rc, 0, out + err)
        for expected in (0, 2):
            rc, out, err = railstrata("validate", folder, "--out", "mine", cwd=self.folder)
            self.assertEqual(rc, expected, out + err)
        self.assertIn("--force", err)

    def test_two_sets_of_one_name_have_a_folder_of_results_each(self):
        first = self.own()
        second = self.folder / "elsewhere" / "my disc"
        shutil.copytree(first, second)
        out, _ = self.validate(first, second, first)
        folders = sorted(f.name for f in (self.folder / "out").iterdir() if f.is_dir())
        self.assertEqual(folders, ["my disc", "my disc-2"])
        self.assertEqual(out.count("largest pressure"), 2, "a set that is named twice runs once")

    def test_a_spreadsheet_with_decimal_commas_is_read(self):
        text = OWN.replace('column = "load_kN"', 'column = "Last_kN"')
        data = "\ufeffLast_kN;Bemerkung;p_MPa\r\n20,0;erste Messung;653,2\r\n40,0;;823,0\r\n"
        out, _ = self.validate(self.own(text, data))
        self.assertIn("within the bar", out)

    def test_data_without_rows_are_refused(self):
        _, err = self.validate(self.own(data="load_kN,p_MPa\n"), expected=2)
        self.assertIn("data.csv:1: ", err)
        self.assertIn("the table has no rows", err)

    def test_what_is_outside_ends_with_failed_checks(self):
        out, _ = self.validate(self.own(data="load_kN,p_MPa\n20,600\n"), expected=1)
        self.assertIn("outside", out)

    def test_within_the_scatter_is_better_than_within_the_bar(self):
        text = OWN.replace('bar = 0.02', 'bar = 0.02\ndeviation = "sd"')
        out, _ = self.validate(self.own(text, "load_kN,p_MPa,sd\n20,650,10\n"))
        self.assertIn("within the scatter", out)

    def test_a_row_without_an_answer_is_named(self):
        out, _ = self.validate(self.own(data="load_kN,p_MPa\n20,653\n-1,600\n"), expected=1)
        self.assertIn("not solved", out)
        self.assertIn("row 2: vehicle.wheel_load", out)

    def test_mistakes_are_named_with_their_place_and_a_remedy(self):
        for old, new, message in (('"p_max_MPa"', '"pmax"', 'toml:14:10: error: result = "pmax" is no number'),
                                  ('"load_kN"', '"load"', 'column = "load" is no column of data.csv'),
                                  ('"measured"', '"guess"', 'reference = "guess" is unknown'),
                                  ('source =', 'sauce =', 'unknown key sauce'),
                                  ('[[vary]]', '[vary]', 'vary must be a list of tables'),
                                  ('relative = true', 'relative = "yes"', 'relative must be true or false'),
                                  ('bar = 0.02', '', 'bar must be a finite number')):
            _, err = self.validate(self.own(OWN.replace(old, new)), expected=2)
            self.assertIn(message, err)
            self.assertIn("remedy", err)
        _, err = self.validate("no_such_set", expected=2)
        self.assertIn("neither a folder with validation.toml nor a set that comes with the program", err)
        self.assertIn("locomotive", err)


if __name__ == "__main__":
    main()
