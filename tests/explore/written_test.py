#!/usr/bin/env python3
"""The page as `railstrata explore` writes it. usage: written_test.py BINARY SOURCE_DIR"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

BINARY, SOURCES = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()


def seed(page):
    """The case inside of a page."""
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S).group(1))


class Written(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.case = (SOURCES / "cases/quick/case.toml").read_text()
        (self.folder / "mine.toml").write_text(self.case)

    def explore(self, *words, rc=0):
        run = subprocess.run([BINARY, "explore", *words], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, rc, run.stderr)
        return run.stderr

    def test_a_case_of_the_current_folder(self):
        for k, words in enumerate((["mine.toml"], ["./mine.toml"], [str(self.folder / "mine.toml")])):
            page = self.folder / f"{k}.html"
            self.explore(*words, "--out", page.name)
            found = seed(page.read_text())
            self.assertEqual((found["case"], found["name"]), (self.case, "mine"), words)
            self.assertNotIn(str(self.folder), page.read_text())

    def test_the_current_folder_itself(self):
        (self.folder / "mine.toml").rename(self.folder / "case.toml")
        for words in ([], ["."], ["case.toml"], [str(self.folder)]):
            self.explore(*words, "--force")
            found = seed((self.folder / "explore.html").read_text())
            if words:  # without words it is a shipped case
                self.assertEqual((found["case"], found["name"]), (self.case, self.folder.name), words)

    def test_the_title_says_what_set_changes_unless_it_is_set_itself(self):
        for words, title in ((["--set", "layer.0.thickness=0.3 mm"], "2 E0 [layer.0.thickness=0.3 mm]"),
                             (["--set", "layer.0.thickness=0.3 mm", "--set", "case.title=thin"], "thin")):
            self.explore("mine.toml", *words, "--force")
            self.assertTrue(seed((self.folder / "explore.html").read_text())["title"].endswith(title), words)

    def test_profiles_beside_the_case_go_with_it_under_their_names(self):
        profile = "".join(f"{y} {y * y / 600}\n" for y in range(-30, 31))
        (self.folder / "head.txt").write_text(profile)
        self.explore("mine.toml", "--set", 'geometry.rail_profile="head.txt"')
        found = seed((self.folder / "explore.html").read_text())
        self.assertEqual(found["files"], {"rail_profile/head.txt": profile})

    def test_a_page_that_is_there_is_replaced_only_when_asked(self):
        self.explore("mine.toml")
        self.assertIn("--force", self.explore("mine.toml", rc=2))
        self.explore("mine.toml", "--force")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
