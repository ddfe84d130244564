#!/usr/bin/env python3
"""The explorer inside a report, in a browser: it begins with the case of the report and is compared with its numbers.
usage: what_if_page_test.py BINARY RESULTS"""
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from browser import Browser, engine_is_todays, run

BINARY, RESULTS = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
TODAYS = engine_is_todays(pathlib.Path(__file__).resolve().parents[2])


def report(folder, page, *arguments):
    return subprocess.run([BINARY, "report", str(folder), "--out", str(page), "--force", *arguments],
                          capture_output=True, text=True, check=False)


class WhatIf(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.page = cls.folder / "what_if.html"
        done = report(RESULTS / "bem", cls.page, "--what-if")
        assert done.returncode in (0, 1), done.stderr
        cls.said = done.stderr + done.stdout
        cls.summary = json.loads((RESULTS / "bem" / "summary.json").read_text())
        cls.is_open = False

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def open(self):
        """The page with its explorer, opened once, as it begins; what follows is said to the frame."""
        if self.is_open:
            for button in ("b-unpin", "b-reset"):
                BROWSER.js("document.getElementById(arguments[0]).click()", button)
            return self.settle()
        BROWSER.open(self.page)
        type(self).is_open = True
        BROWSER.js("document.getElementById('what-if-fold').open = true")
        frame = BROWSER.wait(lambda: BROWSER.js("return document.querySelector('iframe.what-if')"), "the frame")
        BROWSER.driver.switch_to.frame(frame)
        self.settle()

    def settle(self):
        BROWSER.wait(lambda: self.data("state") in ("settled", "refused", "broken"), "the explorer comes to rest", 90)
        self.assertEqual(self.data("state"), "settled", BROWSER.text("#faults"))

    def data(self, name):
        return BROWSER.js("return document.documentElement.dataset[arguments[0]]", name)

    def move(self, knob, value):
        BROWSER.js("const f = document.getElementById('n-' + arguments[0]); f.value = arguments[1]; "
                   "f.dispatchEvent(new Event('input', {bubbles: true}))", knob, str(value))
        self.settle()

    def row(self, name):
        return BROWSER.js(
            "return [...document.querySelectorAll('table.numbers tr')].map(r => [...r.children].map(c => c.innerText))"
            ".find(r => r[0].startsWith(arguments[0]))", name)

    def test_it_begins_with_the_report_and_compares_with_it(self):
        self.open()
        p_max = self.summary["contact"]["p_max_Pa"]
        if TODAYS:
            self.assertAlmostEqual(float(self.data("pMax")), p_max, delta=1e-6 * p_max)
            self.assertEqual(self.row("Largest pressure")[3], "±0 %")
        self.assertIn("vs report", BROWSER.text(".tiles"))
        self.assertIn("report", BROWSER.text("table.numbers thead"))
        self.move("load", 60)
        name, now, then, change = self.row("Largest pressure")
        self.assertAlmostEqual(float(then), 1e-6 * p_max, delta=1)
        self.assertLess(float(now), float(then), name)
        self.assertTrue(change.startswith("−"), change)

    def test_the_page_has_the_border_and_the_stresses_of_the_report(self):
        self.open()
        seed = json.loads(BROWSER.js("return document.getElementById('data').textContent"))
        patch, section = seed["reported"]["patch"], seed["reported"]["section"]
        self.assertEqual(len(patch["pressed"]), patch["stations"] * patch["columns"])
        lines = [line for line in (RESULTS / "bem" / "patch.csv").read_text().splitlines() if not line.startswith("#")]
        pressed = [float(row["p_MPa"]) > 0 for row in csv.DictReader(lines)]
        self.assertEqual((len(patch["pressed"]), patch["pressed"].count("1")), (len(pressed), sum(pressed)))
        self.assertEqual(section["depth"], sorted(section["depth"]))
        largest = self.summary["stress"]["rail"]["subsurface"]["von_mises_max"]["value_Pa"]
        self.assertAlmostEqual(max(section["von_mises"]), largest, delta=0.1 * largest)

    def test_a_pin_takes_the_report_s_place_until_it_is_taken_away(self):
        self.open()
        BROWSER.js("document.getElementById('b-pin').click()")
        self.assertIn("vs pin", BROWSER.text(".tiles"))
        BROWSER.js("document.getElementById('b-unpin').click()")
        self.assertIn("vs report", BROWSER.text(".tiles"))

    def test_it_asks_for_nothing_and_complains_of_nothing(self):
        self.open()
        self.move("load", 70)
        asked = [url for url in BROWSER.requests() if not url.startswith(("blob:", "data:", "about:"))]
        self.assertEqual(asked, [self.page.resolve().as_uri()])
        self.assertEqual(BROWSER.console(), [])

    def test_it_fits_a_telephone(self):
        BROWSER.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                       {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True})
        try:
            self.open()
            inner = BROWSER.js("return [document.documentElement.scrollWidth, innerWidth]")
            self.assertLessEqual(inner[0], inner[1])
            BROWSER.driver.switch_to.parent_frame()
            self.assertLessEqual(BROWSER.js("return document.documentElement.scrollWidth"), 390)
            BROWSER.driver.switch_to.frame(BROWSER.driver.find_element("css selector", "iframe.what-if"))
        finally:
            BROWSER.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    def test_the_size_is_told_and_the_page_holds_no_folder_of_this_machine(self):
        told = re.search(r"with the explorer: ([\d.]+) MB", self.said)
        self.assertAlmostEqual(float(told[1]), 1e-6 * self.page.stat().st_size, delta=0.06)
        self.assertNotIn(str(RESULTS), self.page.read_text())

    def test_without_it_the_page_may_do_no_more_than_before(self):
        page = self.folder / "plain.html"
        self.assertIn(report(RESULTS / "bem", page).returncode, (0, 1))
        text = page.read_text()
        self.assertNotIn("wasm-unsafe-eval", text)
        self.assertNotIn('id="what-if-page"', text)

    def test_what_it_cannot_show_is_refused(self):
        page = self.folder / "never.html"
        done = report(RESULTS / "rest", page, "--what-if")
        self.assertEqual(done.returncode, 2)
        self.assertIn("transient.kind is not supported by the explorer", done.stderr)
        self.assertFalse(page.exists())


if __name__ == "__main__":
    with Browser() as BROWSER:
        code = run(*sys.argv[3:])
    sys.exit(code)
