#!/usr/bin/env python3
"""Wrong input, one test each: the whole message and the exit code. usage: bad_input_test.py BINARY"""
import ctypes
import json
import subprocess

from outside import BINARY, TINY, FromOutside, main, railstrata

CROWN = [(0.8 * i, -0.0064 * i * i) for i in range(-40, 41)]  # mm


class Refusal(FromOutside):
    def answers(self, text, message, remedy):
        """`check` refuses the case, saying just this; the place is given within the message, FOLDER for the folder."""
        rc, out, err = railstrata("check", self.case(text))
        told = err.replace(str(self.folder), "FOLDER")
        without_source_lines = "\n".join(line for line in told.splitlines() if "|" not in line)
        self.assertEqual((rc, out, without_source_lines), (2, "", f"{message}\n    remedy: {remedy}"))


class InTheCase(Refusal):
    def test_an_unknown_key(self):
        self.answers('[drive]\nsped = "20 m/s"\n', "FOLDER/case.toml:2:1: error: unknown key drive.sped",
                     "did you mean speed? keys of [drive]: speed, rail_rotation, traction_coefficient, tractive_force, "
                     "friction_coefficient, torque_ramp, creepage_start, creepage, wheel_rotation, lateral_force, "
                     "lateral_traction_coefficient, lateral_creepage, creepage_of, spin")

    def test_a_wrong_unit(self):
        self.answers('[mesh]\nelement_size = "1 MPa"\n',
                     'FOLDER/case.toml:2:16: error: mesh.element_size = "1 MPa": "MPa" is not the unit of a length',
                     'write a length, e.g. "0.2 mm" (units: mm, m, µm, cm)')

    def test_a_missing_unit(self):
        self.answers("[mesh]\nelement_size = 1\n",
                     "FOLDER/case.toml:2:16: error: mesh.element_size = 1: a bare number has no unit",
                     'write a length, e.g. "0.2 mm", in quotes')

    def test_a_value_out_of_range(self):
        self.answers('[mesh]\nelement_size = "30 mm"\n',
                     'FOLDER/case.toml:2:16: error: mesh.element_size = "30 mm": must be between 0.05 mm and 20 mm',
                     "choose a value in this range")
        self.answers("[run]\nstep_safety = 1.5\n",
                     "FOLDER/case.toml:2:15: error: run.step_safety = 1.5: must be above 0 and at most 1",
                     "choose a value in this range")

    def test_layers_thicker_than_the_head(self):
        layers = "".join(f'[[layer]]\nname = "{name}"\nthickness = "10 mm"\nyoung_ratio = 2.0\n' for name in "abc")
        rc, _, err = railstrata("check", self.case(layers))
        self.assertEqual(rc, 2)
        self.assertRegex(err,
                         r"(?m)^error: layer thicker than the head: 30 mm of layers, the head carries \d+\.\d\d mm\n"
                         r"    remedy: make the layers thinner\n\Z")

    def test_a_wheel_that_misses_the_rail(self):
        self.answers('[geometry]\ngauge = "1.7 m"\n',
                     "error: wheel LMA on rail CN60: the wheel misses the rail; its tape circle stands -138.6 mm from "
                     "the rail's axis",
                     "check lateral_shift, gauge and back_to_back")


    def test_an_encoding_that_is_not_utf_8_is_read_and_named(self):
        (self.folder / "case.toml").write_bytes(b'[case]\ntitle = "Schie\xdfen"\n')
        rc, out, err = railstrata("check", self.folder / "case.toml")
        self.assertEqual(rc, 0, err)
        self.assertIn("Schießen", out)
        self.assertIn(f"warning: {self.folder}/case.toml is not in UTF-8: it was read as Windows-1252\n", err)

    def test_a_file_that_is_no_text(self):
        (self.folder / "case.toml").write_bytes(b"\x7fELF\x02\x00\x1b[31m = ")
        self.refused(2, ["check", self.folder / "case.toml"],
                     f"error: {self.folder}/case.toml is not a text: line 1 has the byte 0x7F\n    remedy: was ")

    def test_no_control_character_reaches_the_terminal(self):
        cases = {"case.toml": '[mesh]\nelement = "\\u001b[31m"\n', "b\x1b[2J.toml": '[mesh]\nlargest = "\x9b"\n',
                 "c\x1b[2J.toml": "run.rolling = true\n", "c\x1b[2J bem.toml": "[drive]\ncreepage = -0.001\n",
                 "d\x1b[2J.toml": ""}
        seen = ""
        for name, text in cases.items():
            (self.folder / name).write_text(text, encoding="utf-8")
            rc, out, err = railstrata("check", self.folder / name, "--threads", "1", "--set", "mesh.element_size=4 mm",
                                      "--set", "mesh.fine_depth=12 mm", "--set", "case.title=t\x1b[2J")
            self.assertEqual(rc, 0 if name.startswith("c\x1b") else 2, err)
            seen += out + err
        self.assertEqual([c for c in seen if ord(c) < 32 and c != "\n" or 0x7F <= ord(c) < 0xA0], [])
        self.assertIn('mesh.element = "\\x1b[31m"', seen)
        self.assertIn("d\\x1b[2J.toml: error: the case file has no key", seen)
        self.assertEqual(seen.count(": t\\x1b[2J\n"), 2, seen)

    def test_a_name_too_long(self):
        self.refused(2, ["check", "a" * 5000], "File name too long")

    def test_a_file_without_end(self):
        self.refused(2, ["check", "/dev/zero"], "error: /dev/zero is larger than 64 MiB")


class InProfiles(Refusal):
    def profile(self, rows, message, remedy, heading="", place=""):
        (self.folder / "rail.csv").write_text(heading + "".join(f"{y:.6f}, {z:.6f}\n" for y, z in rows))
        self.answers('[geometry]\nrail_profile = "rail.csv"\n', f"FOLDER/rail.csv{place}: error: {message}", remedy)

    def test_a_missing_file(self):
        self.answers('[geometry]\nrail_profile = "rail.csv"\n',
                     'FOLDER/case.toml:2:16: error: geometry.rail_profile = "rail.csv": neither a built-in profile '
                     'nor a file (looked for FOLDER/rail.csv)',
                     "built in: CN60, UIC54, UIC60, flat, arc:R=300 mm")

    def test_a_file_that_is_no_text(self):
        (self.folder / "rail.csv").write_bytes(bytes(range(256)))
        self.answers('[geometry]\nrail_profile = "rail.csv"\n',
                     "FOLDER/rail.csv: error: this is not a text: line 1 has the byte 0x00",
                     "give a table of y and z as a text, or a file of Simpack or MiniProf")

    def test_metres_under_a_heading_of_millimetres(self):
        self.profile([(1e-3 * y, 1e-3 * z) for y, z in CROWN],
                     "the heading gives millimetres, but the curve would then be 6.813e-05 m long",
                     "correct the heading or the numbers", heading="y [mm], z [mm]\n")

    def test_one_column_in_metres(self):
        self.profile([(1e-3 * y, z) for y, z in CROWN],
                     "y spans 0.064 and z spans 10.24: the columns seem to be in different units",
                     "give both columns in millimetres or both in metres")

    def test_a_unit_that_is_neither(self):
        self.profile([(1e3 * y, 1e3 * z) for y, z in CROWN],
                     "the curve is 6.813e+04 long, which fits a profile neither in millimetres (20 to 500) nor in "
                     "metres (0.02 to 0.5)",
                     "give y and z in millimetres or metres; these seem to be micrometres")

    def test_a_loop(self):
        loop = [(-30, 5), (-20, 2), (-10, 0.5), (0, 0), (10, 0.5), (12, 3), (5, 4), (3, -2), (20, 2), (30, 5)]
        self.profile(loop, "the curve crosses itself: point 7 meets point 4",
                     "a profile is one open curve walked once from end to end: remove the loop, or cut a closed "
                     "outline down to its running surface", place=":7")

    def test_plain_metres_are_understood(self):
        (self.folder / "rail.csv").write_text("".join(f"{1e-3 * y:.9f}, {1e-3 * z:.9f}\n" for y, z in CROWN))
        rc, out, err = railstrata("check",
                                  self.case(TINY.replace('rail_profile = "flat"', 'rail_profile = "rail.csv"')))
        self.assertEqual(rc, 0, err)
        self.assertIn("rail.csv: The numbers were taken as metres.", err + out)


class Folders(FromOutside):
    def run_into(self, out, *words):
        return ["run", self.case(TINY), "--set", "run.rolling=false", "--out", out, *words]

    def test_one_that_is_not_empty(self):
        (self.folder / "out").mkdir()
        (self.folder / "out" / "mine.txt").write_text("keep")
        self.refused(2, self.run_into(self.folder / "out"),
                     f"error: the output folder {self.folder}/out is not empty\n    remedy: choose another with "
                     f"--out, or overwrite files of the same name with --force\n")
        self.assertEqual([f.name for f in (self.folder / "out").iterdir()], ["mine.txt"])

    def test_no_command_overwrites_a_file_without_force(self):
        case, results, out = self.case(TINY), self.folder / "results", self.folder / "out"
        study = self.folder / "study.toml"
        study.write_text(
            '[study]\nbase = "case.toml"\nengines = ["bem"]\n[[group]]\nname = "g"\n[group.vary]\n"drive.speed" = '
            '["20 m/s"]\n')
        rc, _, err = railstrata("bem", case, "--cell", "3 mm", "--out", results, "--no-report")
        self.assertIn(rc, (0, 1), err)
        out.mkdir()
        (out / "case.toml").write_text("mine")
        (out / "report.html").write_text("mine")
        commands = [["run", case], ["bem", case], ["check", case, "--mesh"],
                    ["sweep", case, "--vary", "drive.speed=20 m/s"],
                    ["creep", case, "--points", "2", "--cell", "3 mm"], ["report", results, results],
                    ["study", study]]
        for words in commands:
            with self.subTest(words[0]):
                self.refused(2, [*words, "--out", out], "is not empty", "--force")
        self.refused(2, ["report", results, "--out", out / "report.html"],
                     f"error: --out {out}/report.html: there is a file of this name\n    remedy: choose another name, "
                     f"or replace it with --force\n")
        for name in ("case.toml", "summary.json", "patch.csv", "page"):
            self.refused(2, ["report", results, "--out", out / name, "--force"],
                         f"error: --out {out}/{name}: a page has a name that ends in .html\n    remedy: write for "
                         f"example --out {(out / name).with_suffix('.html')}\n")
        self.assertEqual({f.name: f.read_text() for f in out.iterdir()}, {"case.toml": "mine", "report.html": "mine"})
        rc, _, err = railstrata("report", results, "--out", out / "report.html", "--force", "--no-reference")
        self.assertEqual(rc, 0, err)
        self.assertIn("<html", (out / "report.html").read_text()[:1000])

    def test_one_that_cannot_be_made(self):
        (self.folder / "file").write_text("")
        self.refused(4, self.run_into(self.folder / "file" / "out"),
                     f"error: cannot make the output folder {self.folder}/file/out: Not a directory\n")
        self.refused(4, self.run_into("/proc/railstrata"),
                     "error: cannot make the output folder /proc/railstrata: No such file or directory\n")

    def test_one_without_the_permission_to_write(self):
        def as_anybody():
            """Permissions do not bind the superuser while he may override them."""
            for capability in (1, 2):  # CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH
                ctypes.CDLL(None).prctl(24, capability, 0, 0, 0)  # PR_CAPBSET_DROP: what exec() leaves him

        (self.folder / "out").mkdir(mode=0o555)
        rc, _, err = railstrata(*self.run_into(self.folder / "out"), preexec_fn=as_anybody)
        self.assertEqual(rc, 4, err)
        self.assertIn("Permission denied", err)


class DuringTheRun(FromOutside):
    def breaks_off(self, *settings):
        out = self.folder / "out"
        words = [word for setting in settings for word in ("--set", setting)]
        rc, _, err = railstrata("run", self.case(TINY), "--threads", "1", "--quiet", "--out", out, *words)
        self.assertEqual(rc, 3, err)
        self.assertFalse((out / "summary.json").exists())
        self.assertNotIn("nan", (out / "history.csv").read_text().lower())
        return err

    def test_numbers_that_grow_beyond_all_bounds(self):
        # a dashpot far too stiff for its mass and the step
        err = self.breaks_off('vehicle.sprung_mass="1 g"', 'vehicle.suspension_damping="1e8 N s/m"')
        self.assertRegex(err,
                         r"^error: the run became unstable at t = [\d.]+ ms, x = -?[\d.]+ mm: numbers are no longer "
                         r"finite or beyond all bounds \(.+\); dt = [\d.]+ us\n    try a smaller run\.step_safety\n   "
                         r" the last good state is in .+/out/checkpoint\.h5\n$")

    def test_a_suspension_too_stiff_for_the_step(self):
        err = self.breaks_off('vehicle.suspension_stiffness="10000 MN/m"', "run.step_safety=1.0")
        self.assertRegex(err,
                         r"^error: the energy balance drifts at t = [\d.]+ ms, x = [\d.]+ mm \([\d.e+-]+ J beside "
                         r"[\d.e+-]+ J of strain energy or torque work\)\n    try a smaller run\.step_safety\n    the "
                         r"last good state is in .+/out/checkpoint\.h5\n$")

    def test_a_mesh_that_the_machine_has_no_memory_for_is_refused_beforehand(self):
        for command in ("check", "run"):
            words = ["--out", self.folder / "big"] if command == "run" else []
            self.refused(4, [command, self.case(TINY), "--set", "mesh.element_size=0.05 mm", "--set",
                             "mesh.fine_depth=8 mm", *words], "error: this mesh needs about ",
                         " GB are at hand\n    try a larger mesh.element_size")

    def test_what_is_not_plausible_has_a_name_in_the_summary(self):
        layer = '[[layer]]\nyoung_ratio = 1.5\nthickness = "8 mm"\nwidth = "10 mm"\n'
        rc, out, err = railstrata("run", self.case(TINY + layer), "--threads", "1", "--quiet", "--no-report", "--out",
                                  self.folder / "out", "--set", "run.rolling=false")
        self.assertIn(rc, (0, 1), err)
        summary = json.loads((self.folder / "out" / "summary.json").read_text())
        names = [w["name"] for w in summary["warnings"]]
        wide = summary["contact"]["patch_width_m"] > 10e-3
        self.assertEqual("patch_wider_than_layer" in names, wide)
        self.assertEqual("von_mises_above_common_rail_yield" in names,
                         max(s["von_mises_max"]["value_Pa"] for s in summary["stress"]["rail"].values() if s
                             and s["von_mises_max"]) > 500e6)
        self.assertTrue(names)
        reference = json.loads(railstrata("info", "--schema", "--results")[1])
        words = {row["key"]: row["name"] for row in reference["checks"]}
        for name in names:
            self.assertIn(f"warn   {words[name]}", out)

    def test_a_wheel_braked_to_a_stand_is_not_waited_for(self):
        err = self.breaks_off('drive.speed="5 mm/s"', "drive.traction_coefficient=-0.2", 'drive.torque_ramp="0 s"')
        self.assertRegex(err,
                         r"^error: the wheel came to a stand at t = [\d.]+ ms, x = [\d.]+ mm\n    try a higher "
                         r"drive\.speed, less braking by drive\.traction_coefficient, or nearer run\.positions\n    "
                         r"the last good state is in .+/out/checkpoint\.h5\n$")


if __name__ == "__main__":
    main()
