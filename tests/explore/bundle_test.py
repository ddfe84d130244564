#!/usr/bin/env python3
"""explore/dist is what the sources are built to, the page's and the engine's. usage: bundle_test.py SOURCE_DIR"""
import gzip
import hashlib
import json
import pathlib
import subprocess
import sys
import unittest

SOURCES = pathlib.Path(sys.argv[1]).resolve()
EXPLORE = SOURCES / "explore"
REMEDY = "run `./railstrata wasm`"


class Bundle(unittest.TestCase):
    def setUp(self):
        self.hashes = json.loads((EXPLORE / "dist/sources.json").read_text())

    def test_the_engine_is_built_from_the_sources_as_they_stand(self):
        listed = subprocess.run([sys.executable, EXPLORE / "build_engine.py", "--list"], capture_output=True, text=True,
                                check=True)
        now, then = json.loads(listed.stdout), self.hashes["engine"]
        moved = [name for name in sorted(now.keys() | then.keys()) if now.get(name) != then.get(name)]
        self.assertEqual(moved, [], f"the explorer's engine is older than these: {REMEDY}")

    def test_the_page_is_built_from_the_sources_as_they_stand(self):
        files = {f"explore/src/{file.name}" for file in (EXPLORE / "src").iterdir()}
        named = {name for name in self.hashes["page"] if name.startswith("explore/src/")}
        self.assertEqual(files, named, REMEDY)
        for name, sha256 in self.hashes["page"].items():
            self.assertEqual(hashlib.sha256((SOURCES / name).read_bytes()).hexdigest(), sha256, f"{name}: {REMEDY}")

    def test_its_software_is_named_with_licences(self):
        licences = (EXPLORE / "dist/LICENSES.txt").read_text()
        for name in ("{fmt}", "Eigen", "toml++", "JSON", "musl"):
            self.assertIn(name, licences)
        self.assertNotIn("FFTW", licences)

    def test_scripts_cannot_end_their_elements(self):
        for name in ("explore.js", "worker.js", "LICENSES.txt"):
            text = (EXPLORE / "dist" / name).read_text()
            self.assertNotIn("</script", text.lower(), name)
            self.assertNotIn("<!--", text, name)
            self.assertNotIn("\r", text, name)

    def test_the_engine_asks_for_no_place(self):
        engine = gzip.decompress((EXPLORE / "dist/engine.wasm.gz").read_bytes())
        for place in (str(SOURCES).encode(), b"/home/", b"/root/"):
            self.assertNotIn(place, engine)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
