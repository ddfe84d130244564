#!/usr/bin/env python3
"""web/dist is what web/src is built to, the report's page and the explorer's, and holds nothing that would leave a
page. usage: bundle_test.py WEB_DIR"""
import hashlib
import json
import pathlib
import re
import sys
import unittest

WEB = pathlib.Path(sys.argv[1])
# made by `./railstrata wasm` at a release
ENGINE = {f"dist/{name}" for name in ("engine.js", "engine.wasm.gz", "engine_version.txt", "explore_licences.txt")}
REMEDY = "run `npm ci && npm run build` in web/"


def below(folder):
    return {str(file.relative_to(WEB)) for file in (WEB / folder).rglob("*") if file.is_file()}


class Bundle(unittest.TestCase):
    def test_it_is_built_from_the_sources_as_they_stand(self):
        hashes = json.loads((WEB / "dist/sources.json").read_text())
        files = below("src") | {"package.json", "package-lock.json", "tsconfig.json", "build.mjs"}
        made = below("dist") - ENGINE - {"dist/sources.json"}
        self.assertEqual(files | made, set(hashes), REMEDY)
        for name, sha256 in hashes.items():
            self.assertEqual(hashlib.sha256((WEB / name).read_bytes()).hexdigest(), sha256, f"{name}: {REMEDY}")

    def test_nothing_of_others_is_inside(self):
        """A package that a page took along would need its licence in the page."""
        manifest = json.loads((WEB / "package.json").read_text())
        self.assertNotIn("dependencies", manifest)
        self.assertEqual(set(manifest["devDependencies"]), {"esbuild", "typescript"})
        for file in (WEB / "src").rglob("*.ts"):
            for name in re.findall(r'^(?:import|\}).* from "([^"]+)";$', file.read_text(), re.M):
                self.assertTrue(name.startswith("."), f"{file.name}: {name}")

    def test_the_lock_names_versions_and_no_place_to_fetch_them_from(self):
        lock = json.loads((WEB / "package-lock.json").read_text())
        self.assertGreater(len(lock["packages"]), 3)
        for name, package in lock["packages"].items():
            self.assertNotIn("resolved", package, name)

    def test_scripts_cannot_end_their_elements(self):
        for name in ("report.js", "explore.js", "worker.js", "engine.js", "explore_licences.txt"):
            text = (WEB / "dist" / name).read_text()
            self.assertNotIn("</script", text.lower(), name)
            self.assertNotIn("<!--", text, name)
            self.assertNotIn("\r", text, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
