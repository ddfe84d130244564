#!/usr/bin/env python3
"""The program seen from outside: exit codes, messages, files. usage: program_test.py BINARY SOURCE_DIR"""
import hashlib
import json
import math
import pathlib
import re
import sys
import tomllib
import unittest

from outside import TINY, FromOutside, railstrata

SOURCE = pathlib.Path(sys.argv[2]).resolve()
COARSE = ["--threads", "1", "--set", "mesh.element_size=4 mm", "--set", "mesh.fine_depth=12 mm"]


def commands():
    return railstrata("?")[2].split("commands: ")[1].strip().split(", ")


class Program(FromOutside):
    def test_a_case_error_exits_2_with_place_caret_and_remedy(self):
        case = self.case('[mesh]\nelement_size = "1 MPa"\n[geometry]\nguage = "1.4 m"\n')
        self.refused(2, ["check", case],
                     f'{case}:2:16: error: mesh.element_size = "1 MPa": "MPa" is not the unit of a length\n    2 | '
                     f'element_size = "1 MPa"\n      |                ^\n'
                     '    remedy: write a length', f"{case}:4:1: error: unknown key geometry.guage\n",
                     "did you mean gauge?")

    def test_errors_come_as_json_on_request(self):
        out = self.refused(2, ["check", self.case("[mesh]\nelement_size = 1\n"), "--json"], "a bare number has no unit")
        self.assertEqual(len(json.loads(out)["errors"]), 1)

    def test_unknown_commands_and_options_exit_2(self):
        self.refused(2, ["chekc"], 'error: unknown command "chekc"\n    remedy: did you mean check?')
        self.refused(2, ["check"], "case is required")
        self.refused(2, ["check", "a.toml", "--colour"], "error: railstrata check has no option --colour\n"
                                                         "    remedy: options: ")
        self.refused(2, ["bem", "a.toml", "--cel", "1 mm"], "error: railstrata bem has no option --cel\n    remedy: "
                                                            "did you mean --cell? options: --cell, --force, --help, ")
        self.refused(2, ["bem", "a.toml", "--cell", "1", "mm"], 'error: "mm" is one word too many for railstrata bem\n'
                                                                '    remedy: put what has blanks into quotes')
        self.refused(2, ["check", "a.toml", "--set", "case.title=a", "mesh.element_size=2 mm"],
                     'error: "mesh.element_size=2 mm" is one word too many for railstrata check\n    remedy: write '
                     "--set once for each key: --set 'mesh.element_size=2 mm'\n")
        self.assertRegex(railstrata("check", "--help")[1], r"--set KEY=VALUE +Override")
        self.refused(2, ["--json"], "error: no command is given\n    remedy: commands: check, run, bem, ")
        self.refused(2, ["check"], "error: railstrata check: case is required (Case file, a folder with case.toml, or "
                                   "NAME.inp of CONTACT)\n    remedy: what it takes: railstrata check --help\n")
        self.refused(2, ["check", "a.toml", "--threads", "many"], "error: railstrata check: ", "--threads", "remedy: ")
        errors = json.loads(self.refused(2, ["bem", "a.toml", "--cel", "1 mm", "--json"]))["errors"]
        self.assertEqual(errors[0]["message"], "railstrata bem has no option --cel")

    def test_an_empty_out_is_refused(self):
        for words in (["bem", "a"], ["study", "a"], ["report", "a"], ["report", "a", "b"]):
            for out in (["--out", ""], ["-o", ""], ["--out="]):
                self.refused(2, [*words, *out], f"error: railstrata {words[0]}: --out", f"railstrata {words[0]} --help")

    def test_the_bare_program_shows_its_commands(self):
        rc, out, err = railstrata()
        self.assertEqual((rc, err), (2, ""))
        self.assertEqual(out, railstrata("--help")[1])
        self.assertIn("collective", out)

    def test_help_is_a_word_too(self):
        self.assertEqual(railstrata("help"), railstrata("--help"))
        self.assertEqual(railstrata("help", "bem"), railstrata("bem", "--help"))
        self.refused(2, ["help", "bme"], 'unknown command "bme"', "did you mean bem?")

    def test_help_shows_options_as_they_are_written(self):
        for command in ["run", "bem", "study", "report"]:  # {false} is how CLI11 shows a flag that clears
            out = railstrata(command, "--help")[1]
            self.assertNotIn("{false}", out, command)
            self.assertIn("--no-re", out)

    def test_a_missing_case_exits_2(self):
        self.refused(2, ["check", "no/such.toml"], "cannot read no/such.toml: No such file or directory")

    def test_a_folder_that_is_not_empty_exits_2_and_force_writes_into_it(self):
        (self.folder / "out").mkdir()
        (self.folder / "out" / "mine.txt").write_text("keep")
        words = ["check", self.case("run.rolling = true"), *COARSE, "--mesh", "--out", self.folder / "out"]
        self.refused(2, words,
                     "is not empty\n    remedy: choose another with --out, or overwrite files of the same name with "
                     "--force")
        rc, _, err = railstrata(*words, "--force")
        self.assertEqual(rc, 0, err)
        self.assertEqual((self.folder / "out" / "mine.txt").read_text(), "keep")

    def test_check_tells_the_contact_point_and_the_mesh(self):
        rc, out, err = railstrata("check", self.case("run.rolling = true"), *COARSE, "--json")
        self.assertEqual(rc, 0, err)
        report = json.loads(out)
        # half-space contact scripts' rigid contact point, LMA on CN60 at 1:40
        self.assertAlmostEqual(report["contact"]["wheel_y_m"], 6.06e-3, delta=0.01e-3)
        self.assertAlmostEqual(report["contact"]["angle_rad"], 0.025, delta=0.1e-3)
        self.assertAlmostEqual(report["load_N"], 8660 * 9.81, places=6)
        self.assertLess(report["step_s"], report["stable_step_s"])
        self.assertGreaterEqual(report["stable_step_s"], report["element_step_bound_s"])

    def test_check_of_a_profile_alone_tells_draws_and_converts_it(self):
        rail = SOURCE / "data" / "profiles" / "cn60_head.csv"
        rows = [line.split(",") for line in rail.read_text().splitlines() if line[0] != "#"]
        turned = self.folder / "turned.csv"
        turned.write_text("".join(f"{float(y) + float(z) / 40:.4f},{float(z) - float(y) / 40:.4f}\n" for y, z in rows))
        rc, out, err = railstrata("check", turned, "--json", "--out", self.folder / "read")
        self.assertEqual(rc, 0, err)
        read = json.loads(out)
        self.assertEqual(read["kind"], "rail")
        self.assertAlmostEqual(read["inclination"], 1 / 40, delta=5e-4)
        self.assertIn("set cant = 0", read["warnings"][0])
        self.assertEqual({file.suffix for file in (self.folder / "read").glob("profile.*")},
                         {".svg", ".csv", ".prr", ".ban"})
        for name in "profile.csv", "profile.prr", "profile.ban":
            again = json.loads(railstrata("check", self.folder / "read" / name, "--json")[1])
            self.assertAlmostEqual(again["inclination"], read["inclination"], places=9)
        wheel = json.loads(railstrata("check", SOURCE / "data" / "profiles" / "lma_wheel.csv", "--json")[1])
        self.assertEqual((wheel["kind"], wheel["warnings"]), ("wheel", []))
        self.assertAlmostEqual(wheel["flange_back_m"], 0.07, places=6)

    def test_without_friction_the_force_of_both_engines_stands_on_the_contact_plane(self):
        case = self.case(TINY.replace("cant = 0.0", 'cant = "1:40"'))
        for engine, words in [("run", ["--threads", "1", "--set", "mesh.element_size=8 mm", "--set",
                                       "mesh.largest=30 mm"]), ("bem", ["--cell", "1 mm"])]:
            rc, _, err = railstrata(engine, case, *words, "--set", "run.rolling=false", "--quiet", "--out",
                                    self.folder / engine)
            self.assertIn(rc, (0, 1), err)  # 1: a check of a result so coarse may fail
            contact = json.loads((self.folder / engine / "summary.json").read_text())["contact"]
            self.assertAlmostEqual(abs(contact["contact_angle_rad"]), 0.025, delta=1e-4)
            self.assertAlmostEqual(contact["F_y_N"] / contact["F_z_N"], -math.tan(contact["contact_angle_rad"]),
                                   delta=1e-6, msg=engine)
            self.assertAlmostEqual(contact["lateral_force_N"] / contact["normal_force_N"], 0, delta=1e-6, msg=engine)
            self.assertAlmostEqual(contact["F_z_N"], 8500 * 9.81, delta=5)

    def test_an_axle_load_is_carried_by_the_contact_of_both_engines(self):
        coarse = ["--set", "mesh.element_size=8 mm", "--set", "mesh.largest=30 mm", "--set", "run.rolling=false"]
        for engine, words in [("run", ["--threads", "1"]), ("bem", ["--cell", "1 mm"])]:
            rc, _, err = railstrata(engine, self.case(TINY), *words, *coarse, "--set", "vehicle.axle_load=20 t",
                                    "--quiet", "--out", self.folder / engine)
            self.assertIn(rc, (0, 1), err)  # 1: a check of a result so coarse may fail
            contact = json.loads((self.folder / engine / "summary.json").read_text())["contact"]
            self.assertAlmostEqual(contact["F_z_N"] / (10e3 * 9.81), 1, delta=1e-4, msg=engine)

    def test_mesh_writes_its_files_and_where_they_come_from(self):
        case = self.case('[case]\ntitle = "m"\n')
        rc, out, err = railstrata("check", case, *COARSE, "--mesh", cwd=self.folder)
        self.assertEqual(rc, 0, err)
        self.assertIn("limits the step", out)
        results = self.folder / "results" / f"{self.folder.name}-mesh"
        self.assertTrue({"rail.vtu", "wheel.vtu", "case.toml", "case.original.toml",
                         "provenance.json"} <= {f.name for f in results.iterdir()})
        provenance = json.loads((results / "provenance.json").read_text())
        self.assertEqual(provenance["inputs"][0]["sha256"], hashlib.sha256(case.read_bytes()).hexdigest())
        self.assertEqual(provenance["overrides"], COARSE[3::2])

    def test_the_resolved_case_of_a_run_is_accepted_and_says_the_same(self):
        railstrata("check", self.case('[[layer]]\nyoung_ratio = 2\n'), *COARSE, "--mesh", "--out",
                   self.folder / "first")
        rc, _, err = railstrata("check", self.folder / "first" / "case.toml", "--mesh", "--out",
                                self.folder / "second")
        self.assertEqual(rc, 0, err)
        self.assertEqual((self.folder / "first" / "case.toml").read_text(),
                         (self.folder / "second" / "case.toml").read_text())

    def test_version_names_the_commit_of_the_sources(self):
        rc, out, _ = railstrata("--version")
        self.assertEqual(rc, 0)
        self.assertRegex(out, r"^railstrata \d+\.\d+\.\d+( \([0-9a-f]{12}(\+dirty)?\))?\n$")

    def test_every_command_has_help_with_examples(self):
        for command in commands():
            rc, out, _ = railstrata(command, "--help")
            self.assertEqual(rc, 0)
            self.assertIn(f"railstrata {command}", out.split("Examples:")[1])

    def test_every_command_stands_on_its_page_with_an_example(self):
        page = (SOURCE / "docs/commands.md").read_text()
        for command in commands():
            self.assertIn(f"\n./railstrata {command}", page)

    def test_an_old_name_answers_with_the_new_one(self):
        for old, now, words in [("mesh", "check --mesh", [self.case(TINY)]), ("schema", "info --schema", [])]:
            rc, _, err = railstrata(old, *words, cwd=self.folder)
            self.assertEqual(rc, 0, err)
            self.assertIn(f"warning: `railstrata {old}` is now `railstrata {now}`\n", err)
        self.refused(2, ["manual"], "there is no command manual any more", "--help")
        self.refused(2, ["wear-loop", "a.toml", "--stepps", 2], "railstrata collective has no option --stepps",
                     "did you mean --steps?")

    def test_info_lists_the_built_in_profiles(self):
        info = json.loads(railstrata("info", "--json")[1])
        self.assertIn("LMA", info["wheel_profiles"])
        self.assertIn("CN60", info["rail_profiles"])
        text = railstrata("info")[1]
        names = [name for key in info for name in (info["parts"] if key == "parts" else [key])]
        self.assertEqual([line.split()[0] for line in text.splitlines()], names)
        self.assertEqual(set(info["parts"]), {"ranks", "cards", "python", "benchmarks"})
        self.assertRegex(text, r"\nwheel_profiles +LMA, ")
        self.assertRegex(text, r"\nlibraries .*hdf5 \d")

    def test_the_schema_is_json(self):
        self.assertIn("geometry", json.loads(railstrata("info", "--schema")[1])["properties"])

    def test_every_shipped_case_is_accepted(self):
        cases = sorted(SOURCE.glob("cases/**/*.toml"))
        # studies: study_test.py; sets: validate_test.py
        cases = [c for c in cases if not c.name.endswith("expect.toml") and "validation" not in c.parts
                 and "study" not in tomllib.loads(c.read_text())]
        self.assertGreaterEqual(len(cases), 4)
        for case in cases:
            size = tomllib.loads(case.read_text()).get("mesh", {}).get("element_size", "1 mm")
            coarse = [] if size.startswith("0.") else COARSE  # small bodies take no coarse elements
            rc, _, err = railstrata("check", case, *coarse)
            self.assertEqual(rc, 0, f"{case}: {err}")

    def test_every_key_stands_in_a_shipped_case(self):
        """Or is varied by a shipped study or set, or is the column of a case's table. Rail, wheel and layers share
        their keys of materials."""
        def leaves(place, schema):
            inner = schema.get("items", {}) if schema.get("type") == "array" else schema
            if "properties" not in inner:
                return [place]
            return [leaf for key, value in inner["properties"].items() for leaf in leaves([*place, key], value)]

        def keys(place, table):
            for key, value in table.items():
                rows = [value] if isinstance(value, dict) else value
                if isinstance(rows, list) and rows and all(isinstance(row, dict) for row in rows):
                    for row in rows:
                        yield from keys([*place, key], row)
                yield ".".join([*place, key])

        def shared(key):
            return re.sub(r"^(material\.(rail|wheel)|layer)\.", "body.", re.sub(r"\.\d+\.", ".", key))

        shipped = set()
        for file in [*SOURCE.glob("cases/**/*.toml"), *SOURCE.glob("examples/**/*.toml")]:
            text = file.read_text()
            case = tomllib.loads(text)
            words = [*keys([], case), *re.findall(r"\b[a-z]+(?:\.[a-z_0-9]+)+", text)]
            if table := case.get("transient", {}).get("history_file"):
                head = (file.parent / table).read_text().splitlines()[0]
                words += ["transient." + re.split(r"[ \[]", column)[0] for column in head.split(",")]
            shipped |= {shared(word) for word in words}
        found = leaves([], json.loads(railstrata("info", "--schema")[1]))
        missing = [key for key in map(".".join, found) if shared(key) not in shipped]
        self.assertEqual(missing, [], "a case each, or out")

    def test_a_receptance_has_its_table_page_and_refusals(self):
        case = SOURCE / "cases" / "along" / "receptance.toml"
        out = self.folder / "receptance"
        rc, text, err = railstrata("check", case, "--receptance", "--beam", "--largest", 100, "--set",
                                   "track.pad_length=0 mm", "--out", out, "--json")
        self.assertEqual(rc, 0, err)
        curves = json.loads(text)
        self.assertEqual(curves["frequency_Hz"], [10.0 * k for k in range(11)])
        # an endless UIC60 of 3038 cm4 on pads as points: 9.74 and 9.38 nm/N; this one has CN60's foot at its height
        self.assertAlmostEqual(curves["beam_midspan_nm_per_N"][0] / 9.74, 1, delta=0.03)
        self.assertAlmostEqual(curves["beam_sleeper_nm_per_N"][0] / 9.38, 1, delta=0.03)
        for name in "report.html", "receptance.csv":
            self.assertTrue((out / name).is_file(), name)
        self.refused(2, ["bem", case, "--out", self.folder / "no"], "receptance.toml:", "railstrata run")
        self.refused(2, ["check", self.case(TINY), "--receptance", "--out", self.folder / "no"],
                     "the foot of this rail is held")
        self.refused(2, ["check", case, "--beam"], "--beam")

    def test_every_command_named_on_the_first_pages_exists(self):
        pages = (SOURCE / "README.md").read_text() + (SOURCE / "docs/commands.md").read_text()
        of_the_front_door = {"demo", "test", "install", "python", "packages", "site", "wasm"}
        for word in set(re.findall(r"\./railstrata ([a-z]+)", pages)) - of_the_front_door:
            self.assertEqual(railstrata(word, "--help")[0], 0, word)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
