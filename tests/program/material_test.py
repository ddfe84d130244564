#!/usr/bin/env python3
"""The command material seen from outside. usage: material_test.py BINARY SOURCE_DIR"""
import csv
import json
import math
import pathlib
import sys
import tomllib
import unittest
import xml.etree.ElementTree as xml

from outside import FromOutside, railstrata

SOURCE = pathlib.Path(sys.argv[2]).resolve()
SHIPPED = SOURCE / "cases" / "material"
REFERENCE = SOURCE / "tests" / "data" / "reference"
AF_VOCE = """[material.rail]
young = "207 GPa"
poisson = 0.29
yield_strength = "300 MPa"
isotropic_hardening = { saturation = "80 MPa", rate = 12 }
kinematic_hardening = [{ modulus = "60 GPa", recall = 250 }]
"""
STRESSES = [f"s_{c}_MPa" for c in ("xx", "yy", "zz", "xy", "yz", "xz")]


def rows(file):
    with open(file, newline="", encoding="utf-8") as f:
        return list(csv.DictReader(line for line in f if not line.startswith("#")))


class Material(FromOutside):
    def write(self, name, text):
        file = self.folder / name
        file.write_text(text, encoding="utf-8")
        return file

    def drive(self, *words, expected=0):
        rc, out, err = railstrata("material", *words)
        self.assertEqual(rc, expected, err)
        return out, err

    def test_a_strain_path_gives_the_references_stresses(self):
        card = self.write("card.toml", AF_VOCE)
        for name in ("cycles_isochoric", "random_0"):
            points = [r for r in rows(REFERENCE / "plastic_paths.csv") if r["path"] == name]
            strains = [k for k in points[0] if k.startswith("e_")]
            path = self.write("path.csv", ",".join(strains) + "\n" + "".join(
                ",".join(p[k] for k in strains) + "\n" for p in points))
            out = self.folder / f"{name}.csv"
            self.drive(card, "--strain", path, "--increments", "1000", "--out", out)
            found = rows(out)
            self.assertEqual(list(found[0]), STRESSES + ["p"])
            self.assertEqual(len(found), len(points))
            answers = [r for r in rows(REFERENCE / "plastic_answers.csv")
                       if r["material"] == "af_voce" and r["path"] == name]
            self.assertEqual(len(answers), len(points))
            for row, answer in zip(found, answers):
                for s in STRESSES:
                    self.assertAlmostEqual(float(row[s]), float(answer[s[:4]]), delta=0.5)
            self.assertTrue(xml.parse(out.with_suffix(".svg")).getroot().tag.endswith("svg"))

    def test_ratchetting_by_cycle_is_the_closed_form(self):
        card = self.write("card.toml", '[material.rail]\nyield_strength = "400 MPa"\n'
                          'kinematic_hardening = [{ modulus = "40 GPa", recall = 200 }]\n')
        path = self.write("path.csv", "s_xx [MPa]\n550\n-450\n")
        out = self.folder / "out.csv"
        text, _ = self.drive(card, "--stress", path, "--cycles", "7", "--out", out)
        cycles = rows(out.with_suffix(".cycles.csv"))
        self.assertEqual(len(cycles), 7)
        for c in cycles[1:]:
            self.assertAlmostEqual(float(c["net_xx"]), 3.8107003e-3, delta=1e-5)
            self.assertAlmostEqual(float(c["net_yy"]), -0.5 * float(c["net_xx"]), delta=1e-9)
        self.assertIn("cycle", text)
        self.assertAlmostEqual(float(rows(out)[0]["s_xx_MPa"]), 550, delta=1e-5)
        self.assertAlmostEqual(float(rows(out)[0]["s_yy_MPa"]), 0, delta=1e-5)

    def test_a_fit_to_the_answers_of_a_law_gives_the_law_back(self):
        known = tomllib.loads((SHIPPED / "test_steel.toml").read_text(encoding="utf-8"))["material"]["rail"]
        out = self.folder / "fit.toml"
        text, _ = self.drive(SHIPPED / "test_steel.toml", "--calibrate", SHIPPED / "loop.csv", "--monotonic",
                             SHIPPED / "tension.csv", "--out", out)
        self.assertEqual(text, out.read_text(encoding="utf-8"))
        found = tomllib.loads(text)["material"]["rail"]
        number = lambda v: float(str(v).split()[0]) * (1000 if str(v).endswith("GPa") else 1)
        self.assertAlmostEqual(number(found["yield_strength"]), 300, delta=6)
        for key, share in (("saturation", 0.1), ("rate", 0.3)):
            wanted = number(known["isotropic_hardening"][key])
            self.assertAlmostEqual(number(found["isotropic_hardening"][key]), wanted, delta=share * wanted)
        terms = sorted(found["kinematic_hardening"], key=lambda t: -t["recall"])
        self.assertEqual(len(terms), 2)
        for term, wanted in zip(terms, known["kinematic_hardening"]):
            modulus = number(wanted["modulus"])
            self.assertAlmostEqual(number(term["modulus"]), modulus, delta=0.1 * modulus)
        self.assertTrue(out.with_suffix(".svg").exists())
        self.drive(out, "--stress", self.write("p.csv", "e_xx\n0.01\n"), "--out", self.folder / "t.csv")
        tension = rows(self.folder / "t.csv")[0]
        plastic = 0.01 - float(tension["s_xx_MPa"]) / 210000
        law = 300 + 80 * (1 - math.exp(-12 * plastic)) + 240 * (1 - math.exp(-250 * plastic)) + \
            250 * (1 - math.exp(-20 * plastic))
        self.assertAlmostEqual(float(tension["s_xx_MPa"]), law, delta=0.01 * law)

    def test_a_cyclic_curve_is_fitted_and_said_how_well(self):
        out = self.folder / "fit.toml"
        text, _ = self.drive(SHIPPED / "r260.toml", "--cyclic-curve", SHIPPED / "amplitudes.csv", "--json", "--out",
                             out)
        fit = json.loads(text)
        self.assertLess(fit["error"], 0.005)
        self.assertIn("error", out.read_text(encoding="utf-8"))

    def test_yield_stresses_of_sheared_steel_give_the_law_behind_the_file_back(self):
        text, err = self.drive(SHIPPED / "r260.toml", "--shear-yield", SHIPPED / "shear_yield.csv", "--json", "--out",
                               self.folder / "sheared.toml")
        fit = json.loads(text)
        self.assertAlmostEqual(fit["yield_strength_Pa"], 420e6, delta=2e6)
        self.assertAlmostEqual(fit["yield_strength_Pa"] + fit["saturation_Pa"], 900e6, delta=2e6)
        self.assertAlmostEqual(fit["rate"], 3, delta=0.03)
        self.assertIn("231 %", err)

    def test_ready_sets_say_that_they_are_estimated(self):
        _, err = self.drive(SHIPPED / "r260.toml", "--stress", SHIPPED / "ratchetting.csv", "--out",
                            self.folder / "a.csv")
        self.assertIn("hardening of rail: set R260, estimated (FKM estimate", err)
        self.assertIn("scaled by hardness over the 275 HV", err)
        top, deep = (json.loads(self.drive(SHIPPED / "r260.toml", "--strain", SHIPPED / "strain_path.csv", "--json",
                                           "--depth", d, "--out", self.folder / "b.csv")[0]) for d in ("0 mm", "20 mm"))
        self.assertLess(top["points"]["p"][-1], deep["points"]["p"][-1])

    def test_mistakes_are_told_with_their_place(self):
        card = self.write("card.toml", AF_VOCE)
        good = self.write("path.csv", "e_xx,e_yy\n0.001,0\n")
        elastic = self.write("elastic.toml", '[material.rail]\nelastic = true\nyield_strength = "1 GPa"\n')
        for words, answer in (
                (["--strain", self.write("a.csv", "e_xx,e_yx\n0,0\n")],
                 "a.csv:1: error: unknown column \"e_yx\""),
                (["--strain", self.write("b.csv", "e_xx\n0.001\nx\n")],
                 "b.csv:3: error: \"x\" is not a number, in the column e_xx"),
                (["--strain", self.write("c.csv", "e_xx\n0.9\n")],
                 "c.csv:2: error: e_xx = 0.9: must be between -0.5 and 0.5"),
                (["--stress", self.write("d.csv", "s_xx\n1\n")], "d.csv:1: error: the column \"s_xx\" has no unit"),
                (["--stress", self.write("e.csv", "s_xx_MPa\n300\n900\n")],
                 "e.csv:3: error: no strain gives the stress"),
                (["--stress", self.write("f.csv", "s_xx_MPa,e_xx\n1,0\n")],
                 "f.csv:1: error: the table has s_xx and e_xx"),
                (["--strain", self.folder / "none.csv"], "none.csv"),
                ([], "neither a path nor a test is given"),
                (["--strain", good, "--of", "layer.0"], "the card has no such material"),
                (["--strain", good, "--out", self.folder / "x.txt"], "must end in .csv"),
                (["--strain", good, "--increments", "0"], "--increments"),
                (["--calibrate", good], "path.csv:1: error: no column of a curve among e_xx, e_yy"),
                (["--calibrate", self.write("g.csv", "strain,stress_MPa\n0,0\n0.001,200\n")],
                 "a loop needs ten points"),
                (["--shear-yield", self.write("h.csv", "pss,sys_MPa\n0,240\n0.1,-3\n")],
                 "h.csv:3: error: sys = -3 MPa"),
                (["--shear-yield", self.write("i.csv", "pss,tau\n0,240\n")],
                 "i.csv:1: error: the table needs two columns, pss and sys"),
                (["--shear-yield", self.write("j.csv", "pss,sys_MPa\n0,240\n0.1,250\n1,300\n")],
                 "fewer points than numbers sought")):
            fit = "--calibrate" in words or "--shear-yield" in words
            out = [] if "--out" in words else ["--out", self.folder / ("o.toml" if fit else "o.csv")]
            _, err = self.drive(card, *words, *out, expected=2)
            self.assertIn(answer, err)
            self.assertIn("remedy", err)
        self.assertIn("elastic on purpose", self.drive(elastic, "--strain", good, expected=2)[1])

    def test_half_a_loop_leaves_no_card(self):
        loop = [line for line in (SHIPPED / "loop.csv").read_text(encoding="utf-8").splitlines()
                if line and not line.startswith("#")]
        stress = [float(line.split(",")[1]) for line in loop[1:]]
        low, high = stress.index(min(stress)), stress.index(max(stress))
        points = loop[1:]
        rising = points[low:high + 1] if low < high else points[low:] + points[:high + 1]
        half = self.write("half.csv", "\n".join([loop[0], *rising]) + "\n")
        out = self.folder / "half.toml"
        _, err = self.drive(SHIPPED / "test_steel.toml", "--calibrate", half, "--out", out, expected=2)
        self.assertIn("the points go up only: give both branches", err)
        self.assertFalse(out.exists())

    def test_near_the_limit_the_increments_are_doubled_until_the_strain_is_known(self):
        """Armstrong and Frederick in tension: e^p = -ln(1 - (s - 300)/200)/150."""
        card = self.write("card.toml", '[material.rail]\nyield_strength = "300 MPa"\n'
                          'kinematic_hardening = [{ modulus = "30 GPa", recall = 150 }]\n')
        for stress in (450, 495, 499):
            path = self.write("path.csv", f"s_xx_MPa\n{stress}\n")
            text, _ = self.drive(card, "--stress", path, "--out", self.folder / "out.csv", "--json", "--force")
            found = json.loads(text)
            exact = -math.log(1 - (stress - 300) / 200) / 150
            self.assertLess(abs(found["points"]["p"][0] - exact), found["strain_error"])
            self.assertLess(found["strain_error"], 1e-3 * exact)

    def test_only_its_own_tables_are_made_anew(self):
        card, path = self.write("card.toml", AF_VOCE), self.write("path.csv", "e_xx\n0.003\n")
        out = self.folder / "new" / "out.csv"
        for _ in range(2):
            self.drive(card, "--strain", path, "--out", out)
        mine = self.write("mine.csv", "precious\n1\n")
        self.assertIn("there is a file of this name", self.drive(card, "--strain", path, "--out", mine, expected=2)[1])
        self.assertEqual(mine.read_text(encoding="utf-8"), "precious\n1\n")
        self.drive(card, "--strain", path, "--out", mine, "--force")
        self.assertEqual(len(rows(mine)), 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
