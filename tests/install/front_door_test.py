#!/usr/bin/env python3
"""The script ./railstrata, with a program and a builder that only note their calls. usage: front_door_test.py SOURCE"""
import os
import pathlib
import shutil
import stat
import subprocess
import sys
import tempfile
import time
import unittest

SOURCE = pathlib.Path(sys.argv[1]).resolve()
NOBODY = 65534


class FrontDoor(unittest.TestCase):
    def setUp(self):
        """A checkout with a program that was built a second after its sources."""
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.folder.chmod(0o755)
        self.root, self.tools, self.work = (self.folder / name for name in ("checkout", "tools", "work"))
        inside = [self.root / name
                  for name in ("src/base/core", "extras", "cmake", "src/results/report", "web/dist", "build")]
        for folder in (*inside, self.tools, self.work):
            folder.mkdir(parents=True)
        self.work.chmod(0o777)
        shutil.copy(SOURCE / "railstrata", self.root)
        for file in ("CMakeLists.txt", "src/base/core/vec.hpp", "src/results/report/view.py", "build/build.ninja"):
            (self.root / file).write_text("")
        self.script(self.root / "build/railstrata-bin", 'echo "program: $*"')
        for name in ("ninja", "cmake"):
            self.script(self.tools / name, f'echo "{name} $*" >>"{self.folder}/calls"')
        self.script(self.tools / "dpkg", 'echo "Status: install ok installed"')
        old = time.time() - 100
        for file in [self.root, *self.root.rglob("*")]:
            os.utime(file, (old, old))
        (self.root / "build/up-to-date").write_text("")

    def script(self, file, text):
        file.write_text(f"#!/bin/sh\n{text}\n")
        file.chmod(0o755)

    def call(self, *words, nobody=False):
        user = {"user": NOBODY, "group": NOBODY, "extra_groups": []} if nobody and os.getuid() == 0 else {}
        environment = {**os.environ, "PATH": f"{self.tools}:{os.environ['PATH']}"}
        return subprocess.run([self.root / "railstrata", *words], capture_output=True, text=True, cwd=self.work,
                              env=environment, **user)

    def calls(self):
        return (self.folder / "calls").read_text() if (self.folder / "calls").exists() else ""

    def test_a_program_newer_than_its_sources_is_not_built_again(self):
        out = self.call("info", "--json")
        self.assertEqual((out.returncode, out.stdout), (0, "program: info --json\n"), out.stderr)
        self.assertEqual(self.calls(), "")

    def test_only_the_first_build_of_a_folder_is_announced(self):
        (self.root / "build/railstrata-bin").unlink()  # Python alone is built: there is no program afterwards
        said = [self.call("python", "-c", "pass").stderr for _ in range(2)]
        self.assertIn("some minutes the first time", said[0])
        self.assertEqual(said[1], "")

    def test_a_changed_source_is_built_once(self):
        (self.root / "src/base/core/vec.hpp").write_text("changed")
        later = time.time() + 2
        os.utime(self.root / "src/base/core/vec.hpp", (later, later))
        self.call("info")
        self.assertIn("ninja", self.calls())
        (self.folder / "calls").unlink()
        os.utime(self.root / "src/base/core/vec.hpp")
        time.sleep(0.01)
        (self.root / "build/up-to-date").touch()
        self.call("info")
        self.assertEqual(self.calls(), "")

    def test_a_new_file_is_built(self):
        later = time.time() + 2
        os.utime(self.root / "src/base/core", (later, later))
        self.call("info")
        self.assertIn("ninja", self.calls())

    def test_another_user_runs_the_program_of_a_checkout_that_he_cannot_write(self):
        for file in [self.root, *self.root.rglob("*")]:
            file.chmod(file.stat().st_mode & ~(stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH))
        self.addCleanup(lambda: [f.chmod(0o755) for f in [self.root, *self.root.rglob("*")]])
        out = self.call("info", nobody=True)
        self.assertEqual((out.returncode, out.stdout), (0, "program: info\n"), out.stderr)
        self.assertEqual(out.stderr, "")

    def test_without_leave_to_build_an_older_program_runs_with_a_word_of_warning(self):
        later = time.time() + 2
        os.utime(self.root / "src/base/core/vec.hpp", (later, later))
        (self.root / "build").chmod(0o555)
        self.addCleanup((self.root / "build").chmod, 0o755)
        out = self.call("info", nobody=True)
        self.assertEqual((out.returncode, out.stdout), (0, "program: info\n"), out.stderr)
        self.assertIn("older than its sources", out.stderr)

    def test_without_a_program_and_without_leave_to_build_it_says_what_to_do(self):
        (self.root / "build/railstrata-bin").unlink()
        (self.root / "build").chmod(0o555)
        self.addCleanup((self.root / "build").chmod, 0o755)
        out = self.call("info", nobody=True)
        self.assertEqual(out.returncode, 4)
        self.assertIn("cannot be written", out.stderr)

    def test_alone_it_prints_help_and_builds_nothing(self):
        for words in ([], ["help"], ["--help"]):
            (self.root / "build/railstrata-bin").unlink(missing_ok=True)
            out = self.call(*words)
            self.assertEqual(out.returncode, 0, out.stderr)
            self.assertIn("./railstrata demo", out.stdout)
            self.assertEqual(self.calls(), "")

    def test_the_demo_goes_through_the_program_in_the_folder_of_the_caller(self):
        out = self.call("demo", "--out", "here")
        self.assertTrue(out.stdout.startswith(f"program: run {self.root}/cases/quick --out here\n"), out.stderr)
        self.assertIn("\nResults: here\n", out.stdout)
        self.assertEqual(self.call("demo", "--json").stdout, f"program: run {self.root}/cases/quick --json\n")
        self.assertFalse((self.root / "results").exists())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
