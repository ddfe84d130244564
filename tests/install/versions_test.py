#!/usr/bin/env python3
"""One version everywhere. usage: versions_test.py BINARY SOURCE_DIR"""
import json
import pathlib
import re
import subprocess
import sys
import unittest

BINARY, SOURCE = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
VERSION = re.search(r"project\(railstrata VERSION (\d+\.\d+\.\d+)", (SOURCE / "CMakeLists.txt").read_text())[1]


class Versions(unittest.TestCase):
    def test_the_program_says_that_of_cmake(self):
        out = subprocess.run([BINARY, "--version"], capture_output=True, text=True, check=True).stdout
        self.assertRegex(out, rf"^railstrata {re.escape(VERSION)}\b")
        out = subprocess.run([BINARY, "info", "--json"], capture_output=True, text=True, check=True).stdout
        self.assertRegex(json.loads(out)["version"], rf"^{re.escape(VERSION)}\b")

    def test_the_changelog_begins_with_it(self):
        headings = re.findall(r"^## \[?v?(\d+\.\d+\.\d+)", (SOURCE / "CHANGELOG.md").read_text(), re.M)
        self.assertEqual(headings[0], VERSION)

    def test_the_citation_names_it(self):
        found = re.search(r"^version:\s*[\"']?v?([\d.]+)", (SOURCE / "CITATION.cff").read_text(), re.M)
        self.assertEqual(found[1], VERSION)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
