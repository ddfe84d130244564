#!/usr/bin/env python3
"""report/dist is what report/src is built to, and holds nothing that would leave the page. usage: bundle_test.py
REPORT_DIR"""
import hashlib
import json
import pathlib
import sys
import unittest

REPORT = pathlib.Path(sys.argv[1])


class Bundle(unittest.TestCase):
    def test_it_is_built_from_the_sources_as_they_stand(self):
        hashes = json.loads((REPORT / "dist/sources.json").read_text())
        files = {f"src/{file.name}" for file in (REPORT / "src").iterdir()} | {"package.json", "package-lock.json",
                                                                               "tsconfig.json", "build.mjs"}
        self.assertEqual(files, {name for name in hashes if not name.startswith("dist/")},
                         "run `npm ci && npm run build` in report/")
        for name, sha256 in hashes.items():
            self.assertEqual(hashlib.sha256((REPORT / name).read_bytes()).hexdigest(), sha256,
                             f"{name}: run `npm ci && npm run build` in report/")

    def test_its_software_is_named_with_licences(self):
        licences = (REPORT / "dist/LICENSES.txt").read_text()
        self.assertIn("plotly.js", licences)
        self.assertIn("Permission is hereby granted", licences)

    def test_the_lock_names_versions_and_no_place_to_fetch_them_from(self):
        lock = json.loads((REPORT / "package-lock.json").read_text())
        self.assertGreater(len(lock["packages"]), 50)
        for name, package in lock["packages"].items():
            self.assertNotIn("resolved", package, name)

    def test_the_script_cannot_end_its_element(self):
        script = (REPORT / "dist/report.js").read_text()
        self.assertNotIn("</script", script.lower())
        self.assertNotIn("<!--", script)
        self.assertNotIn("\r", script)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
