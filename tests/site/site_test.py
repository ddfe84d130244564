#!/usr/bin/env python3
"""The documentation's site. usage: site_test.py SOURCE_DIR SITE"""
import html.parser
import json
import pathlib
import re
import subprocess
import sys
import unittest
import urllib.parse

SOURCE, SITE = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
sys.path.insert(0, str(SOURCE / "tools"))
sys.dont_write_bytecode = True
import make_site  # noqa: E402

# What a browser fetches by itself, and what it follows on request.
FETCHED = {"script": "src", "img": "src", "iframe": "src", "source": "src", "link": "href"}


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.fetched, self.links, self.places = [], [], set()
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        if FETCHED.get(tag) in found:
            self.fetched.append(found[FETCHED[tag]])
        if tag == "a" and found.get("href"):
            self.links.append(found["href"])
        self.places.update(found[key] for key in ("id", "name") if found.get(key))


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pages = {file: Page(file) for file in SITE.rglob("*.html")}

    def test_pages_fetch_nothing_from_other_machines(self):
        for file, page in self.pages.items():
            self.assertEqual([word for word in page.fetched if "//" in word], [], file)
        for file in [*SITE.rglob("*.css"), *self.pages]:
            self.assertNotRegex(file.read_text(), r"url\(['\"]?(https?:)?//|fonts\.g(oogleapis|static)", file)

    def test_every_link_leads_to_a_page_and_a_heading(self):
        for file, page in self.pages.items():
            for link in page.links:
                target, _, heading = link.partition("#")
                if re.match(r"[a-z]+:", target) or file.name == "404.html":
                    continue
                found = (file.parent / urllib.parse.unquote(target)).resolve() if target else file
                found = found / "index.html" if found.is_dir() else found
                self.assertTrue(found.exists(), f"{file}: {link}")
                if heading and found in self.pages:
                    self.assertIn(urllib.parse.unquote(heading), self.pages[found].places, f"{file}: {link}")

    def test_theory_tutorial_references_interfaces_and_changes_are_there(self):
        for name in ("index", "docs/bem", "docs/finite-elements", "docs/tutorial", "docs/case-reference",
                     "docs/results-reference", "python-interface", "c-interface", "CHANGELOG"):
            self.assertIn(SITE / f"{name}.html", self.pages)
        for name in ("docs/bem", "docs/finite-elements"):
            pictures = [word for word in self.pages[SITE / f"{name}.html"].fetched if word.endswith((".svg", ".png"))]
            self.assertTrue([word for word in pictures if "images/" in word and "favicon" not in word], name)

    def test_the_first_page_leads_to_the_explorer(self):
        self.assertIn("explore.html", self.pages[SITE / "index.html"].links)
        page = (SITE / "explore.html").read_text()
        self.assertIn("default-src 'none'", page)
        self.assertIn('id="engine"', page)

    def test_every_public_name_of_python_and_c_is_there(self):
        text = (SITE / "python-interface.html").read_text()
        names = re.search(r"__all__ = \[(.*?)\]", (SOURCE / "python/railstrata/__init__.py").read_text(), re.S)[1]
        for name in re.findall(r'"(\w+)"', names):
            self.assertIn(f'id="{name.lower()}"', text, name)
        text = re.sub(r"<[^>]+>", "", (SITE / "c-interface.html").read_text())
        for name in re.findall(r"RS_API [^;]*?(rs_\w+)\(", (SOURCE / "src/doors/capi/railstrata.h").read_text()):
            self.assertIn(name, text)

    def test_the_search_knows_the_pages(self):
        index = json.loads((SITE / "search/search_index.json").read_text())
        for word in ("shakedown", "rs_contact_new", "layer.0.thickness", "Kalker"):
            found = [page["location"] for page in index["docs"] if word in page["text"] + page["title"]]
            self.assertTrue(found, word)


class Parts(unittest.TestCase):
    def test_links_within_the_site_stay_and_others_become_names(self):
        pages = {"README.md", "docs/bem.md"}
        text = "[a](docs/bem.md#layers) [b](src/base/core/vec.hpp) `[c](d)` [e](https://x.y/z)\n```\n[f](g)\n```\n"
        self.assertEqual(
            make_site.with_site_links("README.md", text, SOURCE, pages),
            "[a](docs/bem.md#layers) b (`src/base/core/vec.hpp`) `[c](d)` [e](https://x.y/z)\n```\n[f](g)\n```\n")

    def test_lists_get_a_blank_line_before_them(self):
        self.assertEqual(make_site.with_list_breaks("words:\n- a\n- b\n```\nx\n- c\n```"),
                         "words:\n\n- a\n- b\n```\nx\n- c\n```")


if __name__ == "__main__":
    SITE.parent.mkdir(parents=True, exist_ok=True)
    made = subprocess.run([sys.executable, SOURCE / "tools/make_site.py", SOURCE, "--out", SITE])
    if made.returncode:
        sys.exit(made.returncode)
    unittest.main(argv=[sys.argv[0], "-v"])
