#!/usr/bin/env python3
"""The explorer's engine in web/dist is what its sources are built to. usage: bundle_test.py SOURCE_DIR"""
import gzip
import json
import pathlib
import subprocess
import sys
import unittest

SOURCES = pathlib.Path(sys.argv[1]).resolve()
DIST = SOURCES / "web/dist"
REMEDY = "run `./railstrata wasm`"


class Bundle(unittest.TestCase):
    def test_the_engine_is_built_from_the_sources_as_they_stand(self):
        listed = subprocess.run([sys.executable, SOURCES / "web/engine/build_engine.py", "--list"], capture_output=True,
                                text=True, check=True)
        now, then = json.loads(listed.stdout), json.loads((DIST / "engine_sources.json").read_text())
        moved = [name for name in sorted(now.keys() | then.keys()) if now.get(name) != then.get(name)]
        self.assertEqual(moved, [], f"the explorer's engine is older than these: {REMEDY}")

    def test_its_software_is_named_with_licences(self):
        licences = (DIST / "explore_licences.txt").read_text()
        for name in ("{fmt}", "Eigen", "toml++", "JSON", "musl"):
            self.assertIn(name, licences)
        self.assertNotIn("FFTW", licences)

    def test_the_engine_asks_for_no_place(self):
        engine = gzip.decompress((DIST / "engine.wasm.gz").read_bytes())
        for place in (str(SOURCES).encode(), b"/home/", b"/root/"):
            self.assertNotIn(place, engine)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
