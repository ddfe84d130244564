#!/usr/bin/env python3
"""The explorer's engine in web/dist can be passed on and names its sources; it need not be of today.
usage: bundle_test.py SOURCE_DIR"""
import gzip
import pathlib
import sys
import unittest

SOURCES = pathlib.Path(sys.argv[1]).resolve()
DIST = SOURCES / "web/dist"


class Engine(unittest.TestCase):
    def test_it_names_the_commit_that_it_was_compiled_from(self):
        version = (DIST / "engine_version.txt").read_text()
        self.assertRegex(version, r"^\d+\.\d+\.\d+ \([0-9a-f]{12}\)\n$", "commit src/, then run `./railstrata wasm`")

    def test_its_software_is_named_with_licences(self):
        licences = (DIST / "explore_licences.txt").read_text()
        for name in ("{fmt}", "Eigen", "toml++", "JSON", "musl"):
            self.assertIn(name, licences)
        self.assertNotIn("FFTW", licences)

    def test_it_holds_no_folder_of_this_machine(self):
        engine = gzip.decompress((DIST / "engine.wasm.gz").read_bytes())
        for place in (str(SOURCES).encode(), b"/home/", b"/root/"):
            self.assertNotIn(place, engine)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
