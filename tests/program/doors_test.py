#!/usr/bin/env python3
"""One question, one answer: a case through every door. usage: doors_test.py BINARY SOURCE_DIR PYTHON_FOLDER"""
import csv
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

from outside import FromOutside, railstrata

SOURCE, PYTHON = pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3]).resolve()
CELL = 1.0  # mm: coarser, and no "yes" stands beside the warning
CLAD = """[material.rail]
yield_strength = "{rail}"
[material.wheel]
{wheel}
[[layer]]
name = "clad"
thickness = "1 mm"
young_ratio = 2.0
{clad}
[drive]
traction_coefficient = 0.2
friction_coefficient = 0.4
[[load]]
passages = 1
"""
ELASTIC = "elastic = true"
CASES = {  # answer and zone that decides
    "it cracks": (CLAD.format(rail="2500 MPa", wheel=ELASTIC, clad=ELASTIC + '\ntensile_strength = "200 MPa"'),
                  "no", "rail: clad"),
    "it shears off": (CLAD.format(rail="2500 MPa", wheel=ELASTIC, clad='yield_strength = "3000 MPa"\n'
                                  'bond_shear = "200 MPa"\nbond_tension = "100 MPa"'), "no", "rail: clad"),
    "it is too narrow": (CLAD.format(rail="2500 MPa", wheel=ELASTIC, clad=ELASTIC + '\nwidth = "8 mm"'),
                         "withheld", None),
    "the wheel yields": (CLAD.format(rail="2500 MPa", wheel='yield_strength = "150 MPa"', clad=ELASTIC),
                         "no", "wheel"),
    "it lasts": (CLAD.format(rail="2500 MPa", wheel='yield_strength = "2500 MPa"', clad=ELASTIC +
                             '\ntensile_strength = "2000 MPa"'), "yes", None)}
NUMBERS = ("layers_share_of_tensile", "layers_delamination", "shakedown_wandering")
STUDY = """[study]
base = "case.toml"
engines = ["bem"]
cell = "{} mm"
[[group]]
name = "g"
[group.vary]
"drive.traction_coefficient" = [0.2]
"""
VALIDATION = """title = "t"
source = "s"
reference = "measured"
uncertainty = "not known"
fitted = "nothing"
cell = "{} mm"
[[vary]]
column = "traction"
key = "drive.traction_coefficient"
[[compare]]
column = "asked"
title = "asked"
result = "{}"
bar = 0.001
"""
RS = """
import json, sys
import railstrata as rs
case = rs.Case(sys.argv[1])
bem, table = rs.bem(case, float(sys.argv[2])), rs.sweep(case, {"drive.traction_coefficient": 0.2}, float(sys.argv[2]),
                                                        stresses=True)
print(json.dumps([bem.summary, table.summaries[0]]))
"""

# Who may solve a contact, or judge one, besides the room `ask`, and why.
SOLVES, JUDGES = r"\b(solve_bem|solve_transient)\(", (
    r"\b(bem_(rail|wheel)_stress|bem_warnings|half_space_shakedown|shakedown_summary|add_single_track|sliding_maps"
    r"|zone_lives|damage_summary)\(|\.fatigue\.(push|emplace)_back|\bbem_contact_summary\(")
ALLOWED = {
    "src/engines/bem": "the engine itself",
    "src/results/judge/bem_summary": "the parts that ask/judge.cpp puts together",
    "src/results/fatigue": "the same",
    "src/results/lives": "the same",
    "src/results/passes/following_contact.cpp": "each round of a pass solves its contact anew: forces alone",
    "src/work/ask": "the one that is asked",
    "src/work/runs/solve_fem.cpp": "finite elements: damage, and the fatigue of a way; shakedown by judge_sections",
    "src/work/collective/collective.cpp": "the life of all rows together",
}


class Doors(FromOutside):
    def table(self, file):
        lines = [line for line in file.read_text().splitlines() if not line.startswith("#")]
        (row,) = csv.DictReader(lines)
        return (row["lasts"], row["decided_by"], *(float(row.get(n) or "nan") for n in NUMBERS))

    def summary(self, summary):
        answer, layers = summary["shakedown"]["answer"], summary.get("layers", {})
        numbers = (layers.get("share_of_tensile"), layers.get("delamination"),
                   summary["shakedown"]["factors"]["wandering"])
        return (answer["lasts"], answer["zone"], *(float("nan") if n is None else n for n in numbers))

    def asked(self, *words, expected=0):
        rc, out, err = railstrata(*words, "--threads", "1", "--no-report", "--force", "--out", self.folder / "out")
        self.assertEqual(rc, expected, out + err)

    def through_python(self):
        done = subprocess.run([sys.executable, "-c", RS, self.folder / "case.toml", str(1e-3 * CELL)],
                              capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(PYTHON)})
        self.assertEqual(done.returncode, 0, done.stderr)
        return map(self.summary, json.loads(done.stdout))

    def through(self, case):
        cell = ("--cell", f"{CELL} mm")
        (self.folder / "case.toml").write_text(case)
        (self.folder / "study.toml").write_text(STUDY.format(CELL))
        file, out = self.folder / "case.toml", self.folder / "out"
        self.asked("bem", file, *cell, "--no-single-track")
        yield "bem", self.summary(json.loads((out / "summary.json").read_text()))
        self.asked("sweep", file, *cell, "--vary", "drive.traction_coefficient=0.2", "--stresses")
        yield "sweep", self.table(out / "sweep.csv")
        self.asked("collective", file, *cell)
        yield "collective", self.table(out / "collective.csv")
        self.asked("study", self.folder / "study.toml")
        yield "study", self.table(out / "study.csv")
        if (PYTHON / "railstrata").exists():
            bem, sweep = self.through_python()
            yield "rs.bem", bem
            yield "rs.sweep", sweep

    def test_a_case_has_one_answer_through_every_door(self):
        for name, (case, lasts, decided_by) in CASES.items():
            first = None
            for door, found in self.through(case):
                with self.subTest(case=name, door=door):
                    first = first or found
                    self.assertEqual(found[0], lasts)
                    self.assertEqual(found[1], decided_by or first[1])
                    for a, b in zip(found[2:], first[2:]):
                        self.assertTrue(a == b or a != a and b != b, (found, first))

    def test_a_validation_set_is_given_the_layers_that_fail(self):
        for name, column in (("it cracks", NUMBERS[0]), ("it shears off", NUMBERS[1])):
            folder = self.folder / column
            folder.mkdir()
            (folder / "case.toml").write_text(CASES[name][0])
            self.asked("bem", folder / "case.toml", "--cell", f"{CELL} mm", "--no-single-track")
            expected = json.loads((self.folder / "out" / "summary.json").read_text())["layers"]
            (folder / "validation.toml").write_text(VALIDATION.format(CELL, column))
            (folder / "data.csv").write_text(f"traction,asked\n0.2,{expected[column.removeprefix('layers_')]}\n")
            rc, out, err = railstrata("validate", folder, "--out", self.folder / "v", "--force")
            self.assertEqual(rc, 0, out + err)

    def test_nobody_solves_or_judges_without_asking(self):
        for file in sorted([*(SOURCE / "src").rglob("*.?pp"), *(SOURCE / "extras").rglob("*.?pp")]):
            name = str(file.relative_to(SOURCE))
            if "/tests/" in name or any(name.startswith(place) for place in ALLOWED):
                continue
            code = re.sub(r"//.*", "", file.read_text())
            for words in (SOLVES, JUDGES):
                found = re.search(words, code)
                self.assertIsNone(found, f"{name} calls {found and found[0]}: ask() of src/work/ask/answer.hpp does")
        for place in ALLOWED:
            self.assertTrue(list(SOURCE.glob(place + "*")), f"{place} is gone")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
