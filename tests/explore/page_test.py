#!/usr/bin/env python3
"""The explorer as a reader meets it: in a browser, from the disk. The engine of the page is that of the last release:
its numbers are held against `railstrata bem` only while src/ is as it was then.
usage: page_test.py BINARY SOURCE_DIR"""
import json
import math
import pathlib
import re
import shlex
import statistics
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "report"))
from browser import SLOW, Browser, engine_is_todays, run, slow

BINARY, SOURCES = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()
TODAYS = engine_is_todays(SOURCES)
CASE = "layer_3mm.toml"
TEXT = """[[layer]]
thickness = "3 mm"
young_ratio = 2.0

[drive]
traction_coefficient = 0.2
friction_coefficient = 0.5
"""
CELL = "0.5 mm" if SLOW else "1 mm"  # engine and program have the same ones, whatever they are
SAME = 1e-6  # of a number here and there; of a stress, over the largest pressure


def half_space(arguments, folder):
    """summary.json of a `railstrata bem` as the page writes it."""
    words = shlex.split(arguments)
    assert words[:2] == ["railstrata", "bem"], words
    out = folder / "bem"
    run = subprocess.run([BINARY, *words[1:], "--out", str(out), "--force", "--no-report", "--no-single-track",
                          "--threads", "1"], cwd=folder, capture_output=True, text=True, check=False)
    assert run.returncode in (0, 1), run.stderr
    return json.loads((out / "summary.json").read_text())


class Explorer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.page = cls.folder / "explore.html"
        (cls.folder / CASE).write_text(TEXT)
        subprocess.run([BINARY, "explore", CASE, "--cell", CELL, "--out", str(cls.page)], cwd=cls.folder, check=True,
                       capture_output=True)
        BROWSER.open(cls.page)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def setUp(self):
        """The case as it was given: a page opened once for all costs each test a second less."""
        for button in ("b-unpin", "b-reset"):
            BROWSER.js("document.getElementById(arguments[0]).click()", button)
        self.settle()
        BROWSER.console(), BROWSER.requests()

    def data(self, name):
        return BROWSER.js("return document.documentElement.dataset[arguments[0]]", name)

    def settle(self, seconds=60):
        BROWSER.wait(lambda: self.data("state") in ("settled", "refused", "broken"), "the page comes to rest", seconds)
        return self.data("state")

    def move(self, **knobs):
        """Sliders by their fields' ids, then rest."""
        for knob, value in knobs.items():
            BROWSER.js(
                "const f = document.getElementById('n-' + arguments[0]); f.value = arguments[1]; "
                "f.dispatchEvent(new Event('input', {bubbles: true}))", knob, str(value))
        return self.settle()

    def agrees_with_the_program(self):
        """The summary that is shown; that of the program has the same numbers if the engine is of today."""
        shown = json.loads(self.data("summary"))
        if not TODAYS:
            return shown
        expected = half_space(self.data("command"), self.folder)
        for key, value in expected["contact"].items():
            if value is not None:
                self.assertAlmostEqual(shown["contact"][key], value, delta=SAME * max(abs(value), 1e-3), msg=key)
        pressure = expected["contact"]["p_max_Pa"]
        for body, zones in expected["stress"].items():
            for zone, measures in zones.items():
                for measure, largest in (measures or {}).items():
                    here = shown["stress"][body][zone][measure]["value_Pa"]
                    self.assertAlmostEqual(here, largest["value_Pa"], delta=SAME * pressure,
                                           msg=f"{body} {zone} {measure}")
        if "shakedown" in expected:
            for key in ("wandering", "upper", "first_yield"):
                self.assertAlmostEqual(shown["shakedown"]["factors"][key], expected["shakedown"]["factors"][key],
                                       delta=SAME, msg=key)
        return shown

    def test_it_asks_for_nothing_and_complains_of_nothing(self):
        BROWSER.driver.get("about:blank")
        BROWSER.open(self.page)
        asked = BROWSER.requests()
        self.assertEqual(self.settle(), "settled")
        self.assertEqual([url for url in asked if not url.startswith("blob:")], [self.page.resolve().as_uri()])
        self.move(h1=1.5)
        self.assertEqual([url for url in BROWSER.requests() if not url.startswith("blob:")], [])
        self.assertEqual(BROWSER.console(), [])

    def test_a_heavier_wheel_presses_as_hertz_says(self):
        pressures = []
        for load in (60, 120):
            self.assertEqual(self.move(h1=0, t=0, load=load), "settled")
            contact = json.loads(self.data("summary"))["contact"]
            self.assertAlmostEqual(contact["F_z_N"], 1e3 * load, delta=1e-2 * load)  # BemOptions::balance
            pressures.append(contact["p_max_Pa"])
        self.assertAlmostEqual(math.log2(pressures[1] / pressures[0]), 1 / 3, delta=0.05)

    @unittest.skipUnless(TODAYS, "src/ has changed since the engine was compiled: its numbers are those of its release")
    def test_its_numbers_are_those_of_the_program(self):
        self.agrees_with_the_program()
        for change in ({"h1": 1.35}, {"e1": 0.5}, {"load": 60}, {"t": 0.1}, {"y": -2}, {"h2": 1, "e2": 3}, {"f": 0.3}):
            with self.subTest(change=change):
                self.assertEqual(self.move(**change), "settled")
                self.agrees_with_the_program()

    def test_layers_come_and_go(self):
        self.move(h1=0)
        self.assertIn("layer=[]", self.data("command"))
        without = self.agrees_with_the_program()
        self.assertIsNone(without["stress"]["rail"]["layer"])
        self.move(h1=0, h2=2, e2=0.5)
        self.agrees_with_the_program()

    def test_strengths_give_the_reserve(self):
        self.move(sr=480, s1=800)
        answer = self.agrees_with_the_program()["shakedown"]["answer"]
        self.assertEqual(BROWSER.text("#lasting .answer"), f"{answer['lasts']}: {answer['reason']}")

    def test_a_slider_shows_the_same_number_as_its_field(self):
        BROWSER.js("const s = document.getElementById('s-h1'); s.value = '1.2'; "
                   "s.dispatchEvent(new Event('input', {bubbles: true}))")
        self.assertEqual(self.settle(), "settled")
        self.assertEqual(BROWSER.js("return document.getElementById('n-h1').value"), "1.2")
        self.assertIn("layer.0.thickness=1.2 mm", self.data("command"))
        self.agrees_with_the_program()

    def dimmed(self):
        """Opacity of tiles and figures, and whether the button is off."""
        return BROWSER.js("const of = (s) => getComputedStyle(document.querySelector(s)).opacity;"
                          "return [of('.tiles'), of('.results'), document.getElementById('b-command').disabled]")

    def test_what_cannot_be_is_said_and_can_be_taken_back(self):
        self.assertEqual(self.move(t=0.49, f=0.2), "refused")
        self.assertEqual(self.dimmed(), ["0.35", "0.35", True], "the old answer is dimmed, its state has no command")
        words = BROWSER.text("#faults")
        self.assertIn("friction", words)
        self.assertIn("What to do", words)
        self.assertEqual(self.move(t=0.1), "settled")
        self.assertEqual(BROWSER.text("#faults"), "")
        self.assertEqual(self.dimmed(), ["1", "1", False])

    def test_a_thickness_below_zero_is_not_none(self):
        self.assertEqual(self.move(h1=-5), "refused")
        self.assertIn("thickness", BROWSER.text("#faults"))
        self.assertEqual(self.move(h1=0), "settled")
        self.assertIn("layer=[]", self.data("command"))

    def choose(self, kind, name, text):
        file = self.folder / name
        file.write_text(text)
        BROWSER.driver.find_element("id", f"profile-{kind}").send_keys(str(file))
        BROWSER.wait(lambda: self.data("state") == "moving" or BROWSER.text("#faults"), "the profile is read")
        return self.settle()

    def test_a_profile_that_is_none_gives_the_reader_s_words(self):
        BROWSER.js("document.querySelectorAll('aside details').forEach(d => d.open = true)")
        self.assertEqual(self.choose("rail", "nonsense.txt", "this is\nno profile\n"), "refused")
        said = BROWSER.text("#faults")
        self.assertIn("nonsense.txt", said)
        if TODAYS:
            run = subprocess.run([BINARY, "bem", CASE, "--set", "geometry.rail_profile=nonsense.txt", "--out", "never"],
                                 cwd=self.folder, capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 2)
            self.assertIn(run.stderr.split("error: ")[1].split("\n")[0], said)
        BROWSER.js("document.getElementById('b-reset').click()")
        self.assertEqual(self.settle(), "settled")

    def test_a_profile_of_one_s_own(self):
        BROWSER.js("document.querySelectorAll('aside details').forEach(d => d.open = true)")
        shipped, before = "uic60_60e1_head.csv", float(self.data("pMax"))
        text = (SOURCES / "data/profiles" / shipped).read_text()
        self.assertEqual(self.choose("rail", shipped, text), "settled")
        command = self.data("command")
        self.assertIn(f"geometry.rail_profile=rail/{shipped}", command)
        p_max = float(self.data("pMax"))
        self.assertNotAlmostEqual(p_max, before, delta=SAME * p_max)
        if TODAYS:
            command = command.replace("rail_profile=rail/", f"rail_profile={SOURCES}/data/profiles/")
            expected = half_space(command, self.folder)["contact"]["p_max_Pa"]
            self.assertAlmostEqual(p_max, expected, delta=SAME * expected)

    def test_case_file_csv_and_link_say_the_same(self):
        self.move(h1=1.7, t=-0.1)
        p_max = float(self.data("pMax"))
        BROWSER.js("document.getElementById('b-case-file').click()")
        case = BROWSER.downloads / "layer_3mm-explored.toml"
        BROWSER.wait(case.exists, "the case file is saved", 10)
        self.assertIn('thickness = "1.7 mm"', case.read_text())
        if TODAYS:
            command = f"railstrata bem {shlex.quote(str(case))} --cell '{CELL}'"
            again = half_space(command, self.folder)["contact"]["p_max_Pa"]
            self.assertAlmostEqual(p_max, again, delta=SAME * again)
        BROWSER.js("document.querySelector('dialog')?.remove(); document.getElementById('b-csv').click()")
        table = BROWSER.downloads / "layer_3mm-explored.csv"
        BROWSER.wait(table.exists, "the table is saved", 10)
        self.assertIn("x_m,y_m,p_Pa", table.read_text())
        numbers = table.read_text().split("# numbers\n")[1].split("\n\n")[0].splitlines()
        self.assertEqual(numbers[0], "number,value,unit")
        shown = {path: (float(value), unit) for path, value, unit in (line.split(",") for line in numbers[1:])}
        summary = json.loads(self.data("summary"))
        for path, unit in (("contact/p_max_Pa", "Pa"), ("contact/contact_angle_rad", "rad"),
                           ("contact/approach_m", "m"), ("stress/rail/subsurface/von_mises_max/value_Pa", "Pa")):
            value = summary
            for key in path.split("/"):
                value = value[key]
            self.assertAlmostEqual(shown[path][0], value, delta=1e-9 * abs(value), msg=path)
            self.assertEqual(shown[path][1], unit)
        link = BROWSER.js("return location.href")
        self.assertIn("#h1=1.7&t=-0.1", link)
        BROWSER.driver.get("about:blank")
        BROWSER.driver.get(link)
        BROWSER.wait(lambda: self.data("ready") == "true", "the page of the link")
        self.settle()
        self.assertAlmostEqual(float(self.data("pMax")), p_max, delta=SAME * p_max)

    def test_pins_compare(self):
        BROWSER.js("document.getElementById('b-pin').click()")
        self.move(h1=1)
        self.assertIn("vs pin", BROWSER.text(".tiles"))
        self.assertIn("%", BROWSER.text(".numbers"))

    @slow
    def test_sixty_changes_leave_the_memory_as_it_is(self):
        def change(k):
            self.move(h1=0.5 + 0.05 * k, load=60 + k % 7)
            return int(self.data("memory")), BROWSER.js("return performance.memory?.usedJSHeapSize ?? 0")

        after = [change(k) for k in range(60)]
        engine = [e for e, _ in after]
        print(f"memory of the engine: {engine[9] / 2**20:.1f} MiB after 10 changes, {engine[-1] / 2**20:.1f} after 60")
        self.assertLessEqual(engine[-1], engine[14])
        self.assertLess(engine[-1], 256 * 2**20)

    def test_it_fits_a_telephone(self):
        BROWSER.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                       {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True})
        try:
            time.sleep(0.3)
            self.move(h1=2.5)
            self.assertLessEqual(BROWSER.js("return document.documentElement.scrollWidth"), 390)
            for width in BROWSER.js("return [...document.querySelectorAll('canvas')].map(c => c.clientWidth)"):
                self.assertGreater(width, 250)
        finally:
            BROWSER.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    @slow
    def test_times(self):
        """Printed, not judged: this machine may be busy. The browser compiles what is used often once more, and better,
        so that the first update is the slowest: it is printed beside the median of those of a slider that moves."""
        for cell in ("0.0005", "0.00025"):
            BROWSER.js("const c = document.getElementById('cell'); c.value = arguments[0]; "
                       "c.dispatchEvent(new Event('change'))", cell)
            moves = 5 if cell == "0.0005" else 3
            for name, knob, values in (("another traction", "t", (0.15, 0.17, 0.12, 0.18, 0.14)),
                                       ("another layer", "h1", (2.15, 2.3, 2.5, 2.2, 2.7)),
                                       ("no layer", "t", (0.16, 0.13, 0.19, 0.11, 0.2))):
                if name == "no layer":
                    self.move(h1=0)
                here = []
                for value in values[:moves]:
                    self.move(**{knob: value})
                    here.append(float(self.data("contactMilliseconds")))
                there = 1e3 * half_space(self.data("command"), self.folder)["run"]["wall_s"]
                print(f"cells of {1e3 * float(cell)} mm, {name}: {statistics.median(here):.0f} ms in the page (first "
                      f"{here[0]:.0f}, quickest {min(here):.0f}), {there:.0f} ms natively")


class OfTheRelease(unittest.TestCase):
    def test_the_page_in_the_repository_opens_and_computes(self):
        page = SOURCES / "web/explore.html"
        self.assertNotIn("+dirty", re.search(r'"version":"([^"]*)"', page.read_text())[1])
        BROWSER.open(page)
        BROWSER.js("const c = document.getElementById('cell'); c.value = '0.0005'; "
                   "c.dispatchEvent(new Event('change'))")
        data = "return document.documentElement.dataset[arguments[0]]"
        BROWSER.wait(lambda: BROWSER.js(data, "state") == "settled", "the page comes to rest", 60)
        self.assertGreater(float(BROWSER.js(data, "pMax")), 0)
        self.assertEqual(BROWSER.console(), [])


if __name__ == "__main__":
    with Browser() as BROWSER:
        code = run(*sys.argv[3:])
    sys.exit(code)
