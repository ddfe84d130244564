#!/usr/bin/env python3
"""Completion in bash and manual pages. usage: completion_test.py BINARY"""
import re
import shutil
import subprocess
import sys
import unittest

from outside import FromOutside, main, railstrata, slow

# What bash itself does before it calls a completion function: words are split at blanks and, with "=" in
# COMP_WORDBREAKS, at "=", which is a word of its own.
DRIVER = r"""
source "$1"; line=$2; shift 2
COMP_LINE=$line COMP_POINT=${#line} COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_railstrata
printf '%s\n' "${COMPREPLY[@]}"
"""


def pieces(line):
    """Words of a line as bash hands them to the function; the last one is under the cursor."""
    words = []
    for word in re.findall(r"""(?:[^\s"'\\]|\\.|"[^"]*"?|'[^']*'?)+""", line):
        words += [part for part in re.split(r"(=)", word) if part]
    return words + [""] if line.endswith((" ", "=")) else words


class Completion(FromOutside):
    def setUp(self):
        super().setUp()
        code, text, _ = railstrata("completion", "bash")
        self.assertEqual(code, 0)
        self.script = self.folder / "completion"
        self.script.write_text(text)

    def after(self, line):
        """What TAB offers at the end of a line."""
        out = subprocess.run(["bash", "-c", DRIVER, "driver", self.script, line, *pieces(line)], cwd=self.folder,
                             capture_output=True, text=True, check=True)
        self.assertEqual(out.stderr, "", line)
        return [word for word in out.stdout.split("\n") if word]

    def test_the_script_is_free_of_faults(self):
        subprocess.run(["bash", "-n", self.script], check=True)
        if shutil.which("shellcheck"):
            out = subprocess.run(["shellcheck", "-s", "bash", "-S", "warning", "-e", "SC2034,SC2207", self.script],
                                 capture_output=True, text=True)
            self.assertEqual(out.stdout, "")

    def test_commands_are_those_of_the_program(self):
        commands = self.after("railstrata ")
        _, _, err = railstrata("--json")
        self.assertEqual(set(commands) - {"help"}, set(re.findall(r"[a-z-]+", err.split("commands:")[1].split(";")[0])))
        self.assertEqual(self.after("railstrata shake"), ["shakedown"])
        self.assertEqual(self.after("railstrata --threads 2 creep-c"), ["creep-curve"])

    def test_options_are_those_of_the_help(self):
        for command in ("run", "bem", "study", "export"):
            _, text, _ = railstrata(command, "--help")
            offered = self.after(f"railstrata {command} --")
            own = set(re.findall(r"(?<!\w)(--[a-z-]+)", text.split("Options:")[1].split("\n\n")[0]))
            self.assertLessEqual(own & {"--set", "--out", "--force", "--resume", "--to", "--jobs"}, set(offered))
            self.assertLessEqual({"--json", "--threads", "--help"}, set(offered))
            self.assertEqual(len(offered), len(set(offered)))

    def test_words_of_options_are_offered(self):
        self.assertEqual(self.after("railstrata shakedown case.toml --engine "), ["fem", "bem"])
        self.assertEqual(self.after("railstrata export a --to cal"), ["calculix"])
        self.assertEqual(self.after("railstrata completion "), ["bash"])

    def test_keys_come_table_by_table(self):
        tables = self.after("railstrata run case.toml --set ")
        self.assertIn("mesh.", tables)
        self.assertIn("layer.", tables)
        self.assertEqual(self.after("railstrata run case.toml --set mesh.element_s"), ["mesh.element_size="])
        self.assertEqual(self.after("railstrata run case.toml --set layer.3.young_r"), ["layer.3.young_ratio="])
        self.assertEqual(self.after("railstrata sweep case.toml --vary layer.0.thickn"), ["layer.0.thickness="])
        self.assertIn("material.rail.", self.after("railstrata run case.toml --set material."))

    def test_values_of_keys(self):
        self.assertEqual(self.after("railstrata bem c --set geometry.rail_shape="), ["rail", "block"])
        self.assertEqual(self.after("railstrata bem c --set geometry.rail_shape=b"), ["block"])
        self.assertIn("R350HT", self.after("railstrata bem c --set material.rail.grade="))
        self.assertIn("CN60", self.after("railstrata bem c --set geometry.rail_profile="))
        self.assertLessEqual({"true", "false"}, set(self.after("railstrata bem c --set run.plasticity=")))

    def test_units_follow_a_number(self):
        self.assertEqual(self.after("railstrata bem c --set layer.0.thickness=2"),
                         [r"2\ mm", r"2\ m", r"2\ µm", r"2\ cm"])
        self.assertEqual(self.after('railstrata bem c --set layer.2.thickness="2 m'), ["2 mm", "2 m"])
        self.assertEqual(self.after(r"railstrata bem c --set vehicle.wheel_load=85\ k"), [r"85\ kN"])

    @slow
    def test_every_default_and_unit_offered_is_taken(self):
        """The default of a quantity, read back by the program."""
        case = self.folder / "case.toml"
        case.write_text("")
        for key in ("mesh.element_size", "vehicle.gravity", "drive.speed", "geometry.cant"):
            offered = self.after(f"railstrata check {case} --set {key}=")
            self.assertEqual(len(offered), 1, key)
            code, _, err = railstrata("check", case, "--set", f"{key}={offered[0]}".replace("\\", ""))
            self.assertEqual(code, 0, err)

    def test_files_where_a_case_is_wanted(self):
        (self.folder / "mine.toml").write_text("")
        self.assertEqual(self.after("railstrata run mi"), ["mine.toml"])
        self.assertEqual(self.after("railstrata run x.toml --out mi"), ["mine.toml"])


class Manual(FromOutside):
    def test_a_page_for_every_command_that_man_reads_without_a_warning(self):
        railstrata("manual", "--out", self.folder)
        pages = sorted(self.folder.glob("man*/*"))
        names = {page.name for page in pages}
        self.assertLessEqual({"railstrata.1", "railstrata-run.1", "railstrata-manual.1", "railstrata-case.5"}, names)
        if not shutil.which("man") or not shutil.which("groff"):
            self.skipTest("man and groff are not installed: the pages were written, not read")
        for page in pages:
            out = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", page], capture_output=True,
                                 text=True, env={"MANWIDTH": "80", "LC_ALL": "C.UTF-8", "PATH": "/usr/bin:/bin"})
            self.assertEqual((out.returncode, out.stderr), (0, ""), page.name)

    def test_what_the_help_says_is_there(self):
        code, text, _ = railstrata("manual", "bem")
        self.assertEqual(code, 0)
        for word in (".SH NAME", ".SH SYNOPSIS", ".SH OPTIONS", ".SH EXAMPLES", r"\-\-cell", r"\-\-threads"):
            self.assertIn(word, text)

    def test_the_case_page_has_keys_units_and_words(self):
        _, text, _ = railstrata("manual", "case")
        self.assertRegex(text, r"\\fBlayer\.0\.thickness\\fR\n.*\n(Allowed: .*\n)?(Default: .*\n)?Units: mm, m")
        self.assertIn("Allowed: rail, block.", text)

    def test_an_unknown_page_is_refused(self):
        code, _, err = railstrata("manual", "nothing")
        self.assertEqual(code, 2)
        self.assertIn("nothing", err)


if __name__ == "__main__":
    main()
