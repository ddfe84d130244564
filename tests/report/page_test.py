#!/usr/bin/env python3
"""The report as a reader meets it: in a browser, from the disk, its numbers held against the files of the result
folder. usage: page_test.py BINARY RESULTS"""
import csv
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from browser import Browser, run, slow
from tables import read_table, row_borders

BINARY, RESULTS = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
FEM, BEM, HALF_SPACE = RESULTS / "fem", RESULTS / "bem", RESULTS / "fem" / "half_space"


def summary_of(folder):
    return json.loads((folder / "summary.json").read_text())


def at(summary, path):
    for key in path.split("/"):
        summary = summary[key]
    return summary


def number_in(text):
    """The first number of a text, as the page writes numbers."""
    found = re.search(r"(−?\d[\d ]*\.?\d*)(?: × 10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?", text)
    power = int("".join("-" if c == "⁻" else str("⁰¹²³⁴⁵⁶⁷⁸⁹".index(c)) for c in found[2])) if found[2] else 0
    return float(found[1].replace("−", "-").replace(" ", "")) * 10.0**power


def cells(table, value):
    """(place, value) of the largest value of a section's or patch's table."""
    return max(range(len(table[value])), key=lambda k: table[value][k])


class Page(unittest.TestCase):
    file: pathlib.Path

    @classmethod
    def setUpClass(cls):
        cls.browser = BROWSER
        cls.browser.open(cls.file)
        cls.first_words, cls.asked = cls.browser.console(), cls.browser.requests()
        cls.folded = cls.browser.js("const all = [...document.querySelectorAll('#verdict details')], was = "
                                    "all.map(d => !d.open); all.forEach(d => d.open = true); return was")

    def js(self, script, *arguments):
        return self.browser.js(script, *arguments)

    def trace(self, plot, k=0):
        return self.browser.trace(plot, k)

    def saved(self, figure):
        """The rows of a figure's table as the CSV button offers them."""
        lines = [line for line in self.browser.download(figure).read_text().splitlines() if not line.startswith("#")]
        self.browser.downloads.joinpath(f"{figure}.csv").unlink()
        return list(csv.DictReader(lines))

    def under(self, plot, *shares):
        """What a painted picture shows at these shares (x, y) of its width and height, and its colours there."""
        return self.js(
            """const host = document.getElementById(arguments[0]), canvas = host.querySelector('canvas');
               const box = canvas.getBoundingClientRect();
               const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
               return arguments[1].map(([x, y]) => {
                 const at = {clientX: box.left + x * box.width, clientY: box.top + y * box.height};
                 host.dispatchEvent(new PointerEvent('pointermove', at));
                 const words = host.querySelector('.under');
                 const first = 4 * (Math.floor(y * canvas.height) * canvas.width + Math.floor(x * canvas.width));
                 return [words.hidden ? null : words.textContent, [...data.slice(first, first + 3)]];
               })""", plot, shares)

    def map_peak(self, plot):
        t = self.trace(plot)
        value, i, j = max((v, i, j) for j, row in enumerate(t["z"]) for i, v in enumerate(row) if v is not None)
        return t["at"]["x"][i], t["at"]["y"][j], value


class Run(Page):
    """A finite element run beside the half-space solution of its case."""

    file = FEM / "report.html"

    def test_nothing_is_fetched_and_nothing_is_wrong(self):
        self.browser.console()
        self.js("document.querySelector('#wheel').open = true; window.scrollTo(0, document.body.scrollHeight)")
        self.browser.wait(lambda: self.js("return document.querySelectorAll('#wheel .plot canvas').length > 0"),
                          "the wheel's sections are drawn")
        self.assertEqual(self.first_words + self.browser.console(), [])
        self.js("document.querySelector('#wheel').open = false")
        self.assertEqual([address for address in self.asked if not address.startswith(("data:", "blob:"))],
                         [self.file.as_uri()])

    def test_the_page_could_not_reach_out_if_it_wanted(self):
        blocked = self.browser.driver.execute_async_script(
            """const done = arguments[arguments.length - 1], seen = [];
               document.addEventListener('securitypolicyviolation', e => {
                 seen.push(e.effectiveDirective);
                 if (seen.length === 3) done(seen);
               });
               fetch('https://example.org/').catch(() => {});
               document.body.append(Object.assign(new Image(), {src: 'https://example.org/a.png'}));
               const script = document.createElement('script');
               document.head.append(Object.assign(script, {textContent: 'window.intruder = true'}));
               setTimeout(() => done(seen), 5000);""")
        self.assertEqual(sorted(blocked), ["connect-src", "img-src", "script-src-elem"])
        self.assertIsNone(self.js("return window.intruder ?? null"))
        self.browser.console()  # it has just complained about this

    @slow
    def test_a_telephone_needs_no_sideways_scrolling(self):
        device = self.browser.driver.execute_cdp_cmd
        device("Emulation.setDeviceMetricsOverride", {"width": 390, "height": 844, "deviceScaleFactor": 2,
                                                      "mobile": False})
        try:
            self.browser.wait(lambda: self.js("return document.getElementById('plot-map-p-0').drawn.width <= "
                                              "document.getElementById('plot-map-p-0').clientWidth"),
                              "figures have followed")
            self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), 390)
            right = self.js("return Math.max(...[...document.querySelectorAll('nav a')].map(a => "
                            "a.getBoundingClientRect().right))")
            self.assertLessEqual(right, 390)
        finally:
            device("Emulation.clearDeviceMetricsOverride", {})
            self.browser.wait(lambda: self.js("return document.getElementById('plot-map-p-0').drawn.width > 400"),
                              "figures have followed back")

    def test_names_of_checks_are_those_of_the_program_s_table(self):
        checks = json.loads(subprocess.run([BINARY, "info", "--schema", "--results"], capture_output=True, text=True,
                                           check=True).stdout)["checks"]
        names = {row["key"]: row["name"] for row in checks}
        for name, key in self.js("return [...document.querySelectorAll('#verdict tr[data-check] th')].map(e => "
                                 "[e.innerText, e.parentElement.dataset.check])"):
            self.assertEqual(name, names[key])

    def test_it_fits_into_six_megabytes(self):
        self.assertLess(self.file.stat().st_size, 6e6)

    def test_the_title_is_text(self):
        self.assertEqual(self.browser.text("h1"), summary_of(FEM)["title"])
        self.assertIn("<b>", summary_of(FEM)["title"])

    def test_the_verdict_is_that_of_the_checks(self):
        rows = self.js(
            "return [...document.querySelectorAll('#verdict tr[data-check]')].map(r => ({name: r.dataset.check, runs: "
            "r.dataset.runs, ok: r.dataset.ok === 'true', judged: r.dataset.judged === 'true', "
                       "mark: r.querySelector('.mark').innerText, value: r.querySelector('.value').innerText}))")
        for run, folder in [("0", FEM), ("1", HALF_SPACE)]:
            for check in summary_of(folder)["checks"]:
                row = next(r for r in rows if r["name"] == check["name"] and r["runs"] == run)
                self.assertEqual(row["ok"], check["ok"], check["name"])
                self.assertIn("holds" if check["ok"] else "fails", row["mark"])
                if row["value"] in ("inside", "outside"):
                    self.assertEqual(row["value"], "outside" if check["value"] else "inside")
                    continue
                scale = 100 if "%" in row["value"] else 1
                self.assertAlmostEqual(number_in(row["value"]) / scale, check["value"],
                                       delta=6e-3 * abs(check["value"]) + 1e-6 * check["limit"])
        failed = [r for r in rows if r["judged"] and not r["ok"]]
        self.assertGreater(len(failed), 0, "30 mm of rolling on 3 mm elements are not enough")
        self.assertTrue(self.browser.text("#verdict h2").startswith(
            f"✗ {len(failed)} of {sum(r['judged'] for r in rows)} checks"))
        colour = self.js("return getComputedStyle(document.querySelector('#verdict')).backgroundColor")
        red, green, blue = map(int, re.findall(r"\d+", colour)[:3])
        self.assertTrue(red > green and red > blue)

    def test_finite_elements_are_held_against_half_spaces(self):
        fem, bem = summary_of(FEM), summary_of(HALF_SPACE)
        schema = subprocess.run([BINARY, "info", "--schema", "--results"], capture_output=True, text=True, check=True)
        limits = {row["key"]: row["fem_limit"] for row in json.loads(schema.stdout)["checks"]}
        with tempfile.TemporaryDirectory() as place:  # shear: on cells as large as the elements
            size = re.search(r'element_size = "(.*)"', (FEM / "case.toml").read_text())[1]
            subprocess.run(
                [BINARY, "bem", FEM / "case.toml", "--cell", size, "--set", 'bem.leading_edge="whole_cell"',
                 "--no-report", "--quiet", "--out", f"{place}/equal"],
                check=True, capture_output=True, timeout=60)
            equal = summary_of(pathlib.Path(place, "equal"))
        for check, key in [("p_max", "p_max_Pa"), ("patch_length", "patch_length_m"), ("q_max", "q_max_Pa")]:
            limit = limits[check]
            theirs = equal["contact"]["q_max_point_Pa"] if check == "q_max" else bem["contact"][key]
            ours = fem["contact"]["q_max_point_Pa" if check == "q_max" else key]
            value = abs(ours / theirs - 1)
            row = self.js(
                "const r = document.querySelector(`tr[data-check='${arguments[0]}'][data-runs='0,1']`); return {ok: "
                "r.dataset.ok === 'true', value: r.querySelector('.value').innerText, limit: "
                "r.querySelector('.limit').innerText}", check)
            self.assertAlmostEqual(number_in(row["value"]) / 100, value, delta=6e-3 * value)
            self.assertAlmostEqual(number_in(row["limit"]) / 100, limit)
            self.assertEqual(row["ok"], value <= limit)

    def test_the_cards_say_whose_numbers_they_are(self):
        self.assertTrue(self.browser.text("#tiles-of").startswith("Numbers of fem (finite elements)"))

    def test_the_numbers_are_those_of_the_summaries(self):
        shown = self.js(
            "return [...document.querySelectorAll('#contact-numbers td[data-path]')].map(c => [c.dataset.path, "
            "c.innerText, c.parentElement.cells[1].innerText])")
        self.assertGreater(len(shown), 20)
        units = {"MPa": 1e6, "mm": 1e-3, "mm²": 1e-6, "%": 1e-2, "kN": 1e3, "10⁻³": 1e-3, "1/m": 1, "µm": 1e-6,
                 "nm": 1e-9, "N m": 1, "N": 1, "K": 1, "": 1}
        summaries = [summary_of(folder) for folder in (FEM, HALF_SPACE, FEM / "sections")]
        seen, barred = {}, set()
        for path, text, unit in shown:
            run = seen[path] = seen.get(path, -1) + 1
            value = at(summaries[run], path)
            text, _, bar = text.partition(" ± ")
            if bar:
                error = at(summaries[run], re.sub("(_Pa|_N|)$", r"_error\1", path, count=1))
                self.assertAlmostEqual(number_in(bar) * units[unit], error, delta=0.06 * error, msg=path)
                barred.add(path)
            if value is None:
                self.assertEqual(text, "–", path)
            elif text == "0":  # also for what round-off leaves
                self.assertLessEqual(abs(value), 1e-7 * (summaries[run]["contact"]["normal_force_N"] if "F_" in path
                                                         or "force" in path or "moment" in path else 1e-3), path)
            else:
                self.assertAlmostEqual(number_in(text) * units[unit], value, delta=6e-4 * abs(value), msg=path)
        self.assertEqual(barred, {"contact/p_max_Pa", "contact/q_max_Pa", "contact/slip_area_fraction", "contact/F_y_N",
                                  "contact/creepage_x"})

    def test_the_maxima_are_those_of_the_summary_with_their_places(self):
        rows = self.js(
            "return [...document.querySelectorAll('#maxima-rail tbody tr')].map(r => [...r.cells].map(c => "
            "c.innerText))")
        zones = {"at the surface": "surface", "below the surface": "subsurface", "in the layers": "layer",
                 "at the interfaces": "interface", "in the matrix": "matrix"}
        self.assertEqual(len(rows), 10)
        for row in rows:
            wanted = summary_of(FEM)["stress"]["rail"][zones[row[0]]]["von_mises_max" if row[1] == "von Mises"
                                                                      else "sigma1_max"]
            self.assertAlmostEqual(number_in(row[2]), 1e-6 * wanted["value_Pa"],
                                   delta=6e-4 * abs(1e-6 * wanted["value_Pa"]))
            place = [number_in(part) for part in row[3].split(",")]
            for text, key in zip(place, ["x_m", "y_m", "depth_m"]):
                self.assertAlmostEqual(text, 1e3 * wanted[key], delta=0.0051)

    def test_the_maps_have_the_patch_s_peaks_where_they_are(self):
        contact = json.loads((FEM / "geometry.json").read_text())["contact"]
        for n, folder in enumerate([FEM, HALF_SPACE]):
            patch = read_table(folder / "patch.csv")
            patch["q"] = [(a * a + b * b) ** 0.5 for a, b in zip(patch["q_x_MPa"], patch["q_y_MPa"])]
            for kind, column in [("p", "p_MPa"), ("q", "q")]:
                k = cells(patch, column)
                x, y, value = self.map_peak(f"plot-map-{kind}-{n}")
                self.assertAlmostEqual(value, patch[column][k], delta=1e-3 * patch[column][k])
                # a symmetric patch has several
                near = [i for i, v in enumerate(patch[column]) if v > (1 - 1e-3) * patch[column][k]]
                self.assertTrue(any(abs(patch["x_mm"][i] - x) < 1e-4
                                    and abs(patch["y_mm"][i] - 1e3 * contact["y_m"] - y) < 1e-4 for i in near), (x, y))
            states = [v for row in self.trace(f"plot-map-state-{n}")["z"] for v in row]
            for state in (1, 2):
                self.assertEqual(states.count(state), patch["state_0separated_1stick_2slip"].count(state))

    def test_the_pictures_stand_first_and_show_the_patch(self):
        order = self.js("return [...document.querySelector('main').querySelectorAll('#glance, #verdict, #numbers')]"
                        ".map(e => e.id)")
        self.assertEqual(order, ["glance", "verdict", "numbers"])
        shown = self.js("return [...document.querySelectorAll('#glance figure')].map(f => f.id)")
        self.assertEqual(shown, ["hero-p", "hero-q", "hero-state", "hero-section"])
        bottom = self.js("return document.querySelector('#glance').getBoundingClientRect().bottom + scrollY")
        self.assertLess(bottom, 700)
        patch = read_table(FEM / "patch.csv")
        y = 1e3 * json.loads((FEM / "geometry.json").read_text())["contact"]["y_m"]
        wanted = {(round(a, 3), round(b - y, 3)): p for a, b, p in zip(patch["x_mm"], patch["y_mm"], patch["p_MPa"])
                  if p > 0}
        saved = {(round(float(r["x_mm"]), 3), round(float(r["y_mm"]), 3)): float(r["p_MPa"]) for r in
                 self.saved("hero-p") if r["p_MPa"]}
        self.assertEqual(saved.keys(), wanted.keys())
        for place, p in wanted.items():
            self.assertAlmostEqual(saved[place], p, delta=2e-5 * max(wanted.values()))

    def test_a_picture_says_what_is_under_the_pointer_in_its_colour(self):
        peak = max(read_table(FEM / "patch.csv")["p_MPa"])
        found = self.under("plot-hero-p", *((0.3 + 0.02 * i, 0.1 + 0.03 * j) for i in range(25) for j in range(26)))
        told = [(float(re.search(r"p ([\d.]+) MPa", words)[1]), pixel) for words, pixel in found if words]
        self.assertGreater(len(told), 20)
        value, pixel = max(told)
        self.assertAlmostEqual(value, peak, delta=0.06)
        self.assertIn([253, 231, 37], [p for v, p in told if v == value])
        self.assertIsNone(self.under("plot-hero-p", (0.01, 0.5))[0][0])

    def test_tractions_have_their_signs_and_arrows_their_direction(self):
        for n, folder in enumerate([FEM, HALF_SPACE]):
            patch = read_table(folder / "patch.csv")
            for plot, column in [("qx", "q_x_MPa"), ("qy", "q_y_MPa")]:
                shown = [v for row in self.trace(f"plot-map-{plot}-{n}")["z"] for v in row if v is not None]
                size = max(map(abs, patch[column]))
                self.assertAlmostEqual(min(shown), min(v for v, p in zip(patch[column], patch["p_MPa"]) if p > 0),
                                       delta=1e-3 * size + 1e-6)
                self.assertAlmostEqual(sum(shown), sum(v for v, p in zip(patch[column], patch["p_MPa"]) if p > 0),
                                       delta=1e-3 * size * len(shown) + 1e-6)
            lines = self.trace(f"plot-map-q-{n}", 1)
            self.assertGreater(len(lines["x"]), 70)
            self.assertTrue(all(x is None for x in lines["x"][2::3]), "of equal value, in pieces of two points")
            arrows = self.trace(f"plot-map-q-{n}", 2)
            self.assertGreater(len(arrows["x"]), 70)
            for k in range(0, len(arrows["x"]), 7):  # a shaft, then its head
                self.assertLess(arrows["x"][k + 1], arrows["x"][k], "a driving wheel pushes the rail backwards")

    def test_shear_stresses_are_those_of_the_tables(self):
        self.js("document.querySelector('#shear-rail').open = true")
        self.browser.wait(lambda: self.js("return document.querySelectorAll('#shear-rail .plot canvas').length > 0"),
                          "the sections are drawn")
        table = read_table(FEM / "rail_cross_section.csv")
        shown = [v for row in self.trace("plot-section-rail-cross-sigma_xz-0")["z"] for v in row]
        self.assertAlmostEqual(min(shown), min(table["sigma_xz_MPa"]), delta=0.02)
        along = read_table(FEM / "rail_longitudinal_section.csv")["sigma_xz_MPa"]
        self.assertLess(min(along), -max(along), "a driving wheel drags the surface backwards")
        import numpy as np
        rows = zip(*(table[f"sigma_{c}_MPa"] for c in ("xx", "yy", "zz", "xy", "yz", "xz")))
        principal = [np.linalg.eigvalsh([[a, d, f], [d, b, e], [f, e, c]]) for a, b, c, d, e, f in rows]
        self.assertAlmostEqual(self.map_peak("plot-section-rail-cross-tau_max-0")[2],
                               max(0.5 * (p[2] - p[0]) for p in principal), delta=0.1)
        self.js("document.querySelector('#shear-rail').open = false")

    def test_the_slider_moves_the_section_along_the_rail(self):
        table = read_table(FEM / "rail_slices.csv")
        places = sorted(set(table["x_mm"]))
        self.assertEqual(self.js("return document.getElementById('slices-slider').max"), str(len(places) - 1))
        for k, quantity, column in [(0, "von_mises", "von_mises_MPa"), (len(places) // 2, "tau_max", "tau_max_MPa")]:
            self.js("""const list = document.getElementById('slices-quantity');
                       list.value = arguments[1]; list.dispatchEvent(new Event('change'));
                       const s = document.getElementById('slices-slider'); s.value = arguments[0];
                       s.dispatchEvent(new Event('input'));""", str(k), quantity)
            self.assertAlmostEqual(number_in(self.browser.text("#slices-at").split("=")[1]), places[k], delta=0.006)
            wanted = sorted(v for x, v in zip(table["x_mm"], table[column]) if x == places[k])
            saved = sorted(float(r[column]) for r in self.saved("slices"))
            self.assertEqual(len(saved), len(wanted))
            for a, b in zip(saved, wanted):
                self.assertAlmostEqual(a, b, delta=1e-4 * max(table[column]))

    def test_the_bodies_turn_in_space(self):
        picture = "return document.querySelector('#plot-space canvas').toDataURL()"
        before = self.js(picture)
        self.js("document.getElementById('space-above').click()")
        above = self.js(picture)
        self.assertNotEqual(before, above)
        self.js("""const host = document.getElementById('plot-space');
                   host.setPointerCapture = () => {};
                   const at = (type, x, y) => host.dispatchEvent(new PointerEvent(type, {clientX: x, clientY: y}));
                   at('pointerdown', 100, 100); at('pointermove', 160, 80); at('pointerup', 160, 80);""")
        self.assertNotIn(self.js(picture), (before, above))
        self.js("document.getElementById('space-reset').click()")
        self.assertEqual(self.js(picture), before)

    def test_millimetres_are_equally_long_on_both_axes(self):
        for plot in ["plot-map-p-0", "plot-section-rail-longitudinal-von_mises-0", "plot-section-rail-cross-sigma_1-1",
                     "plot-profiles"]:
            scale = self.js(
                "const p = document.getElementById(arguments[0]).drawn.plane; return [[p.width, p.x], [p.height, p.y]]"
                ".map(([length, range]) => length / Math.abs(range[1] - range[0]))", plot)
            self.assertAlmostEqual(scale[0] / scale[1], 1, delta=0.01, msg=plot)

    def test_the_words_over_a_map_tell_value_and_units(self):
        t = self.trace("plot-map-p-1")
        # away from the cross at the contact point
        x, y = t["at"]["x"], t["at"]["y"]
        i, j = (min(range(len(line)), key=lambda k: abs(line[k] - wanted)) for line, wanted in ((x, 3), (y, -2)))
        words = self.browser.hover("plot-map-p-1", x[i], y[j]).replace("−", "-")
        self.assertEqual(re.findall(r"(-?[\d.]+) (mm|MPa)", words),
                         [(f"{x[i]:.2f}", "mm"), (f"{y[j]:.2f}", "mm"), (f"{t['z'][j][i]:.1f}", "MPa")])

    def test_the_sections_have_the_tables_peaks_and_the_layer_s_border(self):
        for n, folder in enumerate([FEM, HALF_SPACE]):
            for plane in ["longitudinal", "cross"]:
                table = read_table(folder / f"rail_{plane}_section.csv")
                for kind, column in [("von_mises", "von_mises_MPa"), ("sigma_1", "sigma_1_MPa")]:
                    plot = f"plot-section-rail-{plane}-{kind}-{n}"
                    k = cells(table, column)
                    _, _, value = self.map_peak(plot)
                    self.assertAlmostEqual(value, table[column][k],
                                           delta=1e-4 * (max(table[column]) - min(table[column])))
                    edges = self.trace(plot)["y"]
                    for a, b in zip(edges, row_borders(sorted(set(table["depth_mm"])))):
                        self.assertAlmostEqual(a, b, delta=1e-3)
                    self.assertEqual(edges[0], 0)
                    border = self.trace(plot, 1)
                    self.assertTrue(all(abs(d - 3) < 2e-3 for d in border["y"] if d is not None),
                                    "the layer is 3 mm thick")
                    self.assertAlmostEqual(max(v for v in border["x"] if v is not None), self.trace(plot)["x"][-1])

    def test_the_centre_lines_are_those_of_both_engines_and_hertz(self):
        names = self.js("return document.getElementById('plot-centre-p').drawn.data.map(t => t.name)")
        self.assertEqual(len(names), 3)
        for n, folder in enumerate([FEM, HALF_SPACE]):
            line, shown = read_table(folder / "centre_line.csv"), self.trace("plot-centre-p", n)
            self.assertEqual(len(shown["x"]), len(line["x_mm"]))
            for a, b in zip(shown["x"] + shown["y"], line["x_mm"] + line["p_MPa"]):
                self.assertAlmostEqual(a, b, delta=1e-5 * abs(b) + 1e-9)
            shear = self.trace("plot-centre-q", n)["y"]
            for q, qx, qy in zip(shear, line["q_x_MPa"], line["q_y_MPa"]):
                self.assertAlmostEqual(q, (qx * qx + qy * qy) ** 0.5, delta=1e-4 * q + 1e-9)
        hertz = json.loads((FEM / "geometry.json").read_text())["hertz"]
        reference = self.trace("plot-centre-p", 2)
        self.assertAlmostEqual(max(reference["y"]), 1e-6 * hertz["p0_Pa"], delta=1e-3)
        self.assertAlmostEqual(reference["x"][-1], 1e3 * hertz["a_m"], delta=1e-6)

    def test_depth_line_and_history_are_the_folder_s(self):
        depth = read_table(FEM / "depth_line.csv")
        shown = self.trace("plot-depth", 0)
        points = [(x, y) for x, y in zip(shown["x"], shown["y"]) if x is not None]
        self.assertEqual(len(points), len(depth["depth_mm"]))
        for (x, y), stress, d in zip(points, depth["von_mises_MPa"], depth["depth_mm"]):
            self.assertAlmostEqual(x, stress, delta=1e-5 * stress)
            self.assertAlmostEqual(y, d, delta=1e-5 * d)
        history = read_table(FEM / "history.csv")
        shown = self.trace("plot-history-forces", 0)
        self.assertAlmostEqual(shown["y"][0], 1e-3 * history["F_z_N"][0], delta=1e-3)
        self.assertAlmostEqual(shown["x"][-1], history["position_mm"][-1], delta=0.5)

    def test_the_film_shows_the_frames_of_the_rolling(self):
        film = read_table(FEM / "patch_film.csv")
        steps = sorted(set(film["step"]))
        self.assertEqual(len(steps), len(list((FEM / "patch_series").glob("*.vtp"))))
        for k in (3, len(steps) - 1):
            self.js("""const s = document.getElementById('film-slider'); s.value = arguments[0];
                       s.dispatchEvent(new Event('input'));""", str(k))
            rows = [i for i, s in enumerate(film["step"]) if s == steps[k]]
            self.assertEqual(self.browser.text("#film-at"), f"wheel at {film['distance_mm'][rows[0]]:.1f} mm")
            shown = self.trace("plot-film-q")
            for x, wanted in zip(shown["at"]["x"], sorted({film["x_mm"][i] for i in rows}), strict=True):
                self.assertAlmostEqual(x, wanted, delta=1e-4)
            values = [v for row in shown["z"] for v in row if v is not None]
            self.assertEqual(len(values), len(rows))
            peak = max((film["q_x_MPa"][i]**2 + film["q_y_MPa"][i]**2)**0.5 for i in rows)
            self.assertAlmostEqual(max(values), peak, delta=1e-3 * peak + 1e-6)

    def test_every_figure_offers_its_numbers(self):
        figures = self.js("return [...document.querySelectorAll('figure')].map(f => f.id)")
        self.assertGreater(len(figures), 25)
        self.assertEqual(self.js("return [...document.querySelectorAll('[data-csv]')].map(b => b.dataset.csv)"),
                         figures)

    def test_saved_numbers_are_the_folder_s(self):
        lines = self.browser.download("map-p-1").read_text().splitlines()
        self.assertIn("# Pressure p", "\n".join(lines))
        rows = [line.split(",") for line in lines if not line.startswith("#")]
        self.assertEqual(rows[0], ["x_mm", "y_mm", "p_MPa"])
        saved = {(round(float(x), 3), round(float(y), 3)): float(p) for x, y, p in rows[1:] if p}
        patch = read_table(HALF_SPACE / "patch.csv")
        shift = 1e3 * json.loads((HALF_SPACE / "geometry.json").read_text())["contact"]["y_m"]
        touching = [k for k, p in enumerate(patch["p_MPa"]) if p > 0]
        self.assertEqual(len(saved), len(touching))
        for k in touching:
            self.assertAlmostEqual(saved[round(patch["x_mm"][k], 3), round(patch["y_mm"][k] - shift, 3)],
                                   patch["p_MPa"][k], delta=2e-5 * max(patch["p_MPa"]))

    def test_no_button_sends_anything_away(self):
        buttons = self.js("return [...document.querySelectorAll('.tool')].map(b => b.title)")
        self.assertGreater(len(buttons), 50)
        self.assertEqual({b for b in buttons if re.search("cloud|share|edit|send", b, re.I)}, set())
        self.assertEqual(len(set(buttons)), 4, set(buttons))

    def view(self, plot):
        return self.js("const p = document.getElementById(arguments[0]).drawn.plane; return [...p.x, ...p.y]", plot)

    def pixels(self, plot):
        return self.js("return document.querySelector('#' + arguments[0] + ' canvas').toDataURL()", plot)

    def test_a_drag_shows_a_part_large_and_a_double_click_the_whole_again(self):
        for plot, equal in [("plot-history-forces", False), ("plot-map-p-1", True)]:
            whole, before = self.view(plot), self.pixels(plot)
            inside = [whole[0] + share * (whole[1] - whole[0]) for share in (0.3, 0.6)]
            across = [whole[2] + share * (whole[3] - whole[2]) for share in (0.4, 0.8)]
            start, end = (self.browser.place(plot, x, y) for x, y in zip(inside, across))
            self.browser.drag(start, end)
            large = self.view(plot)
            if equal:  # as much more as keeps both units of one length
                self.assertAlmostEqual((large[1] - large[0]) / (whole[1] - whole[0]),
                                       (large[3] - large[2]) / (whole[3] - whole[2]), delta=1e-6)
            self.assertLess(large[0], inside[0] + 0.02 * (whole[1] - whole[0]))
            self.assertAlmostEqual((large[2] + large[3]) / 2, sum(across) / 2, delta=0.02 * (whole[3] - whole[2]))
            self.assertAlmostEqual((large[0] + large[1]) / 2, sum(inside) / 2, delta=0.02 * (whole[1] - whole[0]))
            self.assertLess(large[1] - large[0], 0.5 * (whole[1] - whole[0]))
            self.assertNotEqual(self.pixels(plot), before)
            middle = self.browser.place(plot, sum(inside) / 2, sum(across) / 2)
            self.browser.drag(middle, [middle[0] + 30, middle[1]], modifiers=8)  # with shift it moves
            moved = self.view(plot)
            self.assertAlmostEqual(moved[1] - moved[0], large[1] - large[0], delta=1e-9 * (whole[1] - whole[0]))
            self.assertLess(moved[0], large[0])
            self.browser.double_click(middle)
            self.assertEqual(self.view(plot), whole)
            self.browser.mouse("Moved", [1, 1])
            self.assertEqual(self.pixels(plot), before)

    def test_a_line_tells_the_values_of_the_point_under_the_pointer(self):
        line = self.trace("plot-centre-p", 1)
        k = max(range(len(line["y"])), key=lambda i: line["y"][i])
        words = self.browser.hover("plot-centre-p", line["x"][k], line["y"][k]).replace("−", "-")
        told = re.search(r"x (-?[\d.]+) mm\np ([\d.]+) MPa\n(.*)", words)
        self.assertAlmostEqual(float(told[1]), line["x"][k], delta=0.3)
        self.assertAlmostEqual(float(told[2]), line["y"][k], delta=0.01 * line["y"][k])
        self.assertIn("half-space", told[3])

    def test_the_marks_of_the_verdict_have_the_room_that_they_need(self):
        self.js("document.querySelectorAll('#verdict details').forEach(d => d.open = true)")
        for needed, there in self.js("return [...document.querySelectorAll('#verdict .mark')].map(m => [m.scrollWidth, "
                                     "m.clientWidth])"):
            self.assertGreater(there, 20)
            self.assertLessEqual(needed, there + 1)

    def test_the_legend_hides_a_curve_and_shows_it_again(self):
        before = self.pixels("plot-history-forces")
        key = "document.querySelectorAll('#history-forces .keys button')[1]"
        self.assertEqual(self.js(f"return [{key}.textContent, {key}.getAttribute('aria-pressed')]"), ["F_x", "true"])
        self.js(f"{key}.click()")
        self.assertEqual(self.js(f"return {key}.getAttribute('aria-pressed')"), "false")
        self.assertNotEqual(self.pixels("plot-history-forces"), before)
        x, y = self.trace("plot-history-forces", 1)["x"][-1], self.trace("plot-history-forces", 1)["y"][-1]
        self.browser.mouse("Moved", self.browser.place("plot-history-forces", x, y))
        self.assertNotIn("F_x", self.browser.words("plot-history-forces") or "")
        self.js(f"{key}.click()")
        self.browser.mouse("Moved", [1, 1])
        self.assertEqual(self.pixels("plot-history-forces"), before)

    def test_keys_lead_from_point_to_point_and_make_larger(self):
        key = ("document.getElementById(arguments[0]).dispatchEvent(new KeyboardEvent('keydown', {key: arguments[1], "
               "bubbles: true, shiftKey: !!arguments[2]}))")
        line = self.trace("plot-history-forces", 0)
        self.js(key, "plot-history-forces", "ArrowRight")
        first = number_in(self.browser.words("plot-history-forces").split("wheel at ")[1])
        self.js(key, "plot-history-forces", "ArrowRight")
        second = number_in(self.browser.words("plot-history-forces").split("wheel at ")[1])
        at = min(range(len(line["x"])), key=lambda k: abs(line["x"][k] - first))
        self.assertAlmostEqual(second, line["x"][at + 1], delta=0.11)
        whole = self.view("plot-history-forces")
        self.js(key, "plot-history-forces", "+")
        large = self.view("plot-history-forces")
        self.assertAlmostEqual((whole[1] - whole[0]) / (large[1] - large[0]), 1.5, delta=1e-6)
        self.js(key, "plot-history-forces", "ArrowRight", True)
        self.assertGreater(self.view("plot-history-forces")[0], large[0])
        self.js(key, "plot-history-forces", "0")
        self.assertEqual(self.view("plot-history-forces"), whole)
        self.js(key, "plot-map-p-1", "ArrowUp")
        there = self.browser.words("plot-map-p-1")
        self.js(key, "plot-map-p-1", "ArrowLeft")
        a, b = (re.findall(r"(-?[\d.]+) mm", w.replace("−", "-")) for w in (there, self.browser.words("plot-map-p-1")))
        step = self.trace("plot-map-p-1")["at"]["x"]
        self.assertAlmostEqual(float(b[0]) - float(a[0]), step[0] - step[1], delta=0.011)
        self.assertEqual(a[1], b[1])

    def test_a_finger_is_told_the_values_and_two_make_larger(self):
        def touch(kind, *points):
            self.browser.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {
                "type": f"touch{kind}", "touchPoints": [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(points)]})

        t = self.trace("plot-map-p-1")
        place = self.browser.place("plot-map-p-1", t["at"]["x"][len(t["at"]["x"]) // 2 + 2], -1)
        touch("Start", place)
        touch("End")
        self.assertIn("MPa", self.browser.wait(lambda: self.browser.words("plot-map-p-1"), "words at the finger", 10))
        whole, (x, y) = self.view("plot-map-p-1"), place
        touch("Start", (x - 20, y), (x + 20, y))
        touch("Move", (x - 30, y), (x + 30, y))
        touch("Move", (x - 40, y), (x + 40, y))
        touch("End")
        large = self.view("plot-map-p-1")
        self.assertAlmostEqual((whole[1] - whole[0]) / (large[1] - large[0]), 2, delta=0.2)
        for _ in range(2):  # two taps: the whole again
            touch("Start", place)
            touch("End")
        self.browser.wait(lambda: self.view("plot-map-p-1") == whole, "the whole", 10)

    def test_every_figure_can_be_saved_as_a_picture(self):
        self.assertEqual(self.js("return [...document.querySelectorAll('[data-png]')].map(b => b.dataset.png)"),
                         self.js("return [...document.querySelectorAll('figure')].map(f => f.id)"))
        for figure in ("centre-p", "hero-section"):
            data = self.browser.download(figure, "png").read_bytes()
            self.assertTrue(data.startswith(b"\x89PNG"))
            width, height = (int.from_bytes(data[k:k + 4], "big") for k in (16, 20))
            canvas = self.js("const c = document.querySelector(`#${arguments[0]} canvas`); return [c.width, c.height]",
                             figure)
            self.assertEqual(width, canvas[0])
            self.assertGreater(height, canvas[1], "with its title")
            self.browser.downloads.joinpath(f"{figure}.png").unlink()

    @slow
    def test_light_dark_and_light_again_in_print(self):
        def look():
            return self.js(
                "return [document.documentElement.dataset.theme, getComputedStyle(document.body).backgroundColor, "
                "document.getElementById('plot-map-p-0').drawn.paper]")

        light = look()
        self.js("document.getElementById('theme').click()")
        dark = look()
        self.assertEqual([light[0], dark[0]], ["light", "dark"])
        self.assertTrue(all(a != b for a, b in zip(light, dark)))
        self.js("window.printed = []; window.addEventListener('beforeprint', () => "
                "document.querySelectorAll('.plot').forEach(g => g.clientWidth !== 0 && g.drawn && "
                "window.printed.push([g.drawn.width, g.drawn.paper])))")
        pdf = self.browser.pdf()
        self.assertTrue(pdf.startswith(b"%PDF"))
        self.assertIn(len(re.findall(rb"/Type\s*/Page\b", pdf)), range(4, 16))
        printed = self.js("return window.printed")
        self.assertGreater(len(printed), 20)
        self.assertLess(max(width for width, _ in printed), 186 / 25.4 * 96, "A4 between margins of 12 mm")
        self.assertEqual({colour for _, colour in printed}, {light[2]})
        self.assertEqual(look(), dark, "as it was before")
        self.js("document.getElementById('theme').click()")
        self.assertEqual(look(), light)


class Yields(Page):
    """A rail that yields beside the same rail that does not."""

    file = RESULTS / "yields.html"

    def words(self):
        return self.js("return [...document.querySelectorAll('#yielded p.yielded')].map(p => p.textContent)")

    def test_words_say_what_yielded_where_and_how_much(self):
        told = summary_of(RESULTS / "yields")["plastic"]
        yields, elastic = self.words()
        self.assertIn(f"{round(told['elements'])} elements have yielded", yields)
        self.assertIn(f"{1e3 * told['depth_m']:.2f} mm deep", yields)
        self.assertAlmostEqual(number_in(yields.split("accumulated plastic strain ")[1]) / told["accumulated"], 1,
                               delta=0.05)
        self.assertAlmostEqual(number_in(yields.split("Plastic work ")[1]) / told["work_J"], 1, delta=0.01)
        self.assertIn("no plasticity: every stress is elastic", elastic)

    def test_maps_have_the_sections_values(self):
        section = read_table(RESULTS / "yields" / "rail_longitudinal_section.csv")
        x, depth, value = self.map_peak("plot-section-rail-longitudinal-plastic_strain_accumulated-0")
        k = cells(section, "plastic_strain_accumulated")
        self.assertAlmostEqual(value / section["plastic_strain_accumulated"][k], 1, delta=1e-4)
        depths = sorted(set(section["depth_mm"]))
        self.assertAlmostEqual(depth, section["depth_mm"][k], delta=1e-2)

    def test_pictures_on_the_profiles_stand_beside_each_other_on_one_scale(self):
        shown = self.js("return [...document.querySelectorAll('#yielded figure h3, #yielded figcaption, #yielded h3')]"
                        ".map(h => h.textContent)")
        for title in ["Accumulated plastic strain", "Von Mises stress"]:
            self.assertTrue(any(title in text for text in shown), shown)
        strains = self.saved("yielded-strain-1")
        section = read_table(RESULTS / "yields" / "rail_cross_section.csv")
        largest = max(float(row["plastic_strain_accumulated"]) for row in strains if row["body"] == "rail")
        self.assertAlmostEqual(largest / max(section["plastic_strain_accumulated"]), 1, delta=1e-3)
        for k in (1, 2):
            self.assertGreater(max(float(row["von_mises_MPa"]) for row in self.saved(f"yielded-stress-{k}")), 300)
        self.assertEqual(self.js("return document.getElementById('plot-yielded-strain-2')"), None)

    def test_it_has_nothing_to_complain_of(self):
        self.assertEqual(self.first_words, [])


class HalfSpace(Page):
    """A half-space result by itself, with two layers."""

    file = BEM / "report.html"

    def test_its_verdict_is_green(self):
        self.assertTrue(all(check["ok"] for check in summary_of(BEM)["checks"]))
        self.assertRegex(self.browser.text("#verdict h2"), r"^✓ All \d+ checks hold")
        colour = self.js("return getComputedStyle(document.querySelector('#verdict')).backgroundColor")
        red, green, blue = map(int, re.findall(r"\d+", colour)[:3])
        self.assertTrue(green > red and green > blue)

    def test_checks_that_hold_are_folded_and_notes_are_told(self):
        self.assertEqual(self.folded, [True])
        self.assertRegex(self.browser.text("#verdict summary"), r"^\d+ checks that hold")
        self.assertIn("Von Mises stress above common rail yield", self.browser.text("#verdict .minded"))

    def test_the_section_stands_on_the_profile_with_both_layers(self):
        self.assertIn("hard on the rail, bond on the rail", self.browser.text("#hero-section figcaption"))
        table = read_table(BEM / "rail_cross_section.csv")
        saved = [r for r in self.saved("hero-section") if r["body"] == "rail"]
        self.assertEqual(len(saved), len(table["y_mm"]))
        for row, y, depth, stress in zip(saved, table["y_mm"], table["depth_mm"], table["von_mises_MPa"]):
            self.assertAlmostEqual(float(row["y_mm"]), y, delta=1e-3)
            self.assertAlmostEqual(float(row["depth_mm"]), depth, delta=1e-3)
            self.assertAlmostEqual(float(row["von_mises_MPa"]), stress, delta=0.02)

    def test_it_has_no_history_and_says_nothing_of_it(self):
        self.assertIsNone(self.browser.text("#history"))
        self.assertNotIn("history", self.browser.text("nav"))

    def test_both_layers_have_their_borders(self):
        depths = {round(d, 3) for d in self.trace("plot-section-rail-longitudinal-von_mises-0", 1)["y"]
                  if d is not None}
        self.assertEqual(depths, {0.5, 2.0})
        levels = self.js("return document.getElementById('plot-depth').drawn.chart.levels")
        self.assertEqual([round(d, 3) for d in levels], [0.5, 2.0])

    def test_the_console_is_silent(self):
        self.assertEqual(self.first_words + self.browser.console(), [])


class Rest(Page):
    """Rolling from rest by half-spaces: its history and its film."""

    file = RESULTS / "rest" / "report.html"

    def show(self, k):
        self.js("""const s = document.getElementById('film-slider'); s.value = arguments[0];
                   s.dispatchEvent(new Event('input'));""", str(k))

    def film_peak(self):
        return max(v for row in self.trace("plot-film-q")["z"] for v in row if v is not None)

    def test_its_charts_are_the_folder_s_history(self):
        history = read_table(RESULTS / "rest" / "history.csv")
        for plot, k, column, scale in [("transient-forces", 0, "F_z_N", 1e-3), ("transient-forces", 1, "F_x_N", 1e-3),
                                       ("transient-creepage", 0, "creepage", 1e3),
                                       ("transient-stress", 1, "q_max_MPa", 1),
                                       ("transient-areas", 2, "slip_area_mm2", 1),
                                       ("transient-work", 0, "friction_work_J", 1)]:
            shown = self.trace(f"plot-{plot}", k)
            self.assertEqual(len(shown["x"]), len(history["step"]))
            for at, value, d, want in zip(shown["x"], shown["y"], history["distance_mm"], history[column]):
                self.assertAlmostEqual(at, d, delta=1e-4)
                if want == want:  # the beginning has no creepage
                    self.assertAlmostEqual(value, scale * want, delta=1e-5 * abs(scale * want))
                else:
                    self.assertIsNone(value)

    def test_the_film_shows_the_state_that_the_slider_names(self):
        film = read_table(RESULTS / "rest" / "patch_film.csv")
        steps = sorted(set(film["step"]))
        self.assertEqual(len(steps), 9)
        self.assertEqual(self.js("return document.getElementById('film-slider').max"), "8")
        for k in (8, 0, 4):
            self.show(k)
            frame = [i for i, s in enumerate(film["step"]) if s == steps[k]]
            self.assertEqual(self.browser.text("#film-at"), f"after {film['distance_mm'][frame[0]]:.2f} mm")
            q = max((film["q_x_MPa"][i]**2 + film["q_y_MPa"][i]**2)**0.5 for i in frame)
            self.assertAlmostEqual(self.film_peak(), q, delta=1e-3 * q)
            slipping = sum(film["state_0separated_1stick_2slip"][i] == 2 for i in frame)
            states = [v for row in self.trace("plot-film-state")["z"] for v in row if v is not None]
            self.assertEqual((states.count(2), len(states)), (slipping, len(frame)))

    def test_the_film_plays_to_its_end(self):
        self.show(0)
        self.js("document.getElementById('film-play').click()")
        self.browser.wait(lambda: self.js("return document.getElementById('film-slider').value === '8'"), "the end", 10)
        self.browser.wait(lambda: self.browser.text("#film-play") == "play", "the film stands", 10)

    def test_the_page_says_which_state_its_numbers_are(self):
        self.assertIn("after 40 mm of rolling from rest", self.browser.text(".sub"))
        self.assertRegex(self.browser.text("#verdict h2"), r"^✓ All \d+ checks hold")

    def test_the_console_is_silent(self):
        self.assertEqual(self.first_words + self.browser.console(), [])


class UnevenWay(Page):
    """A shipped transient over a hollow of the rail."""

    file = RESULTS / "uneven" / "report.html"

    def test_the_answer_is_the_largest_pressure_of_the_way(self):
        history = read_table(RESULTS / "uneven" / "history.csv")
        most = max(history["p_max_MPa"])
        at = history["distance_mm"][history["p_max_MPa"].index(most)]
        self.assertGreater(most, 1.2 * history["p_max_MPa"][-1])
        self.assertTrue(self.browser.text("#verdict h2").startswith(
            f"On its way: largest pressure {most:.4g} MPa with the wheel at {at:.4g} mm"))
        self.assertRegex(self.browser.text("#verdict .held"), r"All \d+ checks hold")

    def test_the_way_stands_before_the_pictures_of_its_end(self):
        shown = self.js("return [...document.querySelectorAll('main figure')].map(f => f.id)")
        self.assertEqual(shown[:3], ["way-heights", "way-pressure", "hero-p"], "the force is given")
        heights = self.trace("plot-way-heights")
        self.assertAlmostEqual(min(heights["y"]), -200, delta=0.1)
        self.assertAlmostEqual(heights["x"][heights["y"].index(min(heights["y"]))], 20, delta=0.1)

    def test_the_film_begins_at_the_largest_pressure(self):
        self.assertNotEqual(self.js("return document.getElementById('film-slider').value"),
                            self.js("return document.getElementById('film-slider').max"))


@slow
class ThreePatches(Page):
    """A wheel that touches on two lobes of the tread, which have one plane, and in the flange's root."""

    file = RESULTS / "two" / "report.html"

    def test_each_contact_is_in_the_picture_with_its_own_load_and_hertz(self):
        summary = summary_of(RESULTS / "two")
        geometry = json.loads((RESULTS / "two" / "geometry.json").read_text())
        self.assertEqual(len(geometry["patches"]), 3)
        self.assertAlmostEqual(sum(p["load_N"] for p in geometry["patches"]),
                               sum(p["normal_force_N"] for p in summary["patches"]), delta=1)
        names = self.js("return document.getElementById('plot-profiles').drawn.data.map(t => t.name)")
        self.assertEqual(names[-3:], [f"place of patch {k}" for k in (1, 2, 3)])
        for k, patch in enumerate(summary["patches"]):
            self.assertAlmostEqual(self.trace("plot-profiles", len(names) - 3 + k)["x"][0], 1e3 * patch["y_m"],
                                   delta=1e-3)
        self.assertIsNotNone(self.browser.text("#profiles-near-2"))
        self.assertIn("Near the contact point of patch 1", self.browser.text("#profiles-near"))
        table = self.browser.text("#geometry table")
        for k, patch in enumerate(summary["patches"]):
            self.assertIn(f"{1e-3 * patch['normal_force_N']:.2f} kN", table)
        self.assertEqual(table.count("p₀"), 3)

    def test_the_centre_lines_are_those_of_all_with_hertz_under_the_load_of_each(self):
        geometry = json.loads((RESULTS / "two" / "geometry.json").read_text())
        names = self.js("return document.getElementById('plot-centre-p').drawn.data.map(t => t.name)")
        self.assertEqual(names, [f"{name}, patch {k}" for name in ("two (half-space)", "Hertz, no layer")
                                 for k in (1, 2, 3)])
        for k, patch in enumerate(geometry["patches"]):
            self.assertAlmostEqual(max(self.trace("plot-centre-p", 3 + k)["y"]), 1e-6 * patch["hertz"]["p0_Pa"],
                                   delta=1)
        patches = summary_of(RESULTS / "two")["patches"]
        for k, patch in enumerate(patches):
            peak = max(self.trace("plot-centre-p", k)["y"])
            self.assertAlmostEqual(peak / (1e-6 * patch["p_max_Pa"]), 1, delta=0.05)

    def test_the_first_pictures_have_all_where_they_are(self):
        patch = read_table(RESULTS / "two" / "patch.csv")
        y = 1e3 * summary_of(RESULTS / "two")["patches"][0]["y_m"]
        wanted = sorted(round(b - y, 3) for b, p in zip(patch["y_mm"], patch["p_MPa"]) if p > 0)
        saved = sorted(round(float(r["y_mm"]), 3) for r in self.saved("hero-p") if r["p_MPa"])
        self.assertEqual(len(saved), len(wanted))
        for a, b in zip(saved, wanted):
            self.assertAlmostEqual(a, b, delta=1e-3)

    def test_the_page_says_whose_the_numbers_are(self):
        self.assertIn("The numbers are those of patch 1", self.browser.text("#tiles-patches"))
        self.assertIn("F_x, F_y and F_z are of all patches", self.browser.text("#tiles-patches"))
        self.assertIsNotNone(self.browser.text("#patches"))

    def test_the_console_is_silent(self):
        self.assertEqual(self.first_words + self.browser.console(), [])


@slow
class WheelLayer(Page):
    """A layer on the wheel alone is shown as one of the rail."""

    file = RESULTS / "wheel" / "report.html"

    def test_the_wheel_stands_open_with_the_layer_s_border(self):
        self.assertTrue(self.js("return document.getElementById('wheel').open"))
        depths = {round(d, 3) for d in self.trace("plot-section-wheel-longitudinal-von_mises-0", 1)["y"]
                  if d is not None}
        self.assertEqual(depths, {1.5})
        self.assertEqual([round(y, 3) for y in
                          self.js("return document.getElementById('plot-depth-wheel').drawn.chart.levels")], [1.5])
        self.assertIn("tyre on the wheel", self.browser.text("#hero-section figcaption"))
        self.assertIn("Wheel, von Mises below the surface", self.browser.text(".tiles"))

    def test_its_depth_line_is_where_its_sections_cross(self):
        along, across = (read_table(RESULTS / "wheel" / f"wheel_{plane}_section.csv") for plane in ("longitudinal",
                                                                                                     "cross"))
        wanted = [(d, s) for x, d, s in zip(along["x_mm"], along["depth_mm"], along["von_mises_MPa"])
                  if x == across["x_mm"][0]]
        shown = self.trace("plot-depth-wheel")
        points = [(d, s) for d, s in zip(shown["y"], shown["x"]) if d is not None]
        self.assertEqual(len(points), len(wanted))
        for (a, b), (c, d) in zip(points, wanted):
            self.assertAlmostEqual(a, c, delta=1e-4)
            self.assertAlmostEqual(b, d, delta=1e-3 * d)

    def test_the_slices_have_the_wheel_too(self):
        bodies = {r["body"] for r in self.saved("slices")}
        self.assertEqual(bodies, {"rail", "wheel"})
        self.assertEqual(self.first_words + self.browser.console(), [])


def rows_of(file):
    return list(csv.DictReader(line for line in file.read_text().splitlines() if not line.startswith("#")))


class Sweep(Page):
    """The page of a sweep: lines over the key with most values."""

    file = RESULTS / "sweep" / "report.html"

    def test_its_charts_are_its_table(self):
        rows = rows_of(RESULTS / "sweep" / "sweep.csv")
        for k, friction in enumerate(("0.3", "0.5")):
            shown = self.trace("plot-p_max_MPa", k)
            self.assertEqual(shown["name"], f"friction coefficient {friction}")
            self.assertEqual(shown["x"], [0.5, 1, 2])
            for x, y in zip(shown["x"], shown["y"]):
                wanted = next(r for r in rows if float(r["layer.0.thickness"].split()[0]) == x
                              and r["drive.friction_coefficient"] == friction)
                self.assertAlmostEqual(y, float(wanted["p_max_MPa"]), delta=1e-5 * y)
        self.assertEqual(len(self.js("return [...document.querySelectorAll('#table-cases tbody tr')].map(r => 1)")), 6)
        self.assertIn("6 of 6 cases", self.js("return document.getElementById('verdict').textContent"))
        self.assertIn("thickness h [mm]", self.js(
            "return document.getElementById('plot-p_max_MPa').drawn.chart.x.title"))
        self.assertEqual(self.first_words + self.browser.console(), [])


class Creep(Page):
    """The page of a creep curve."""

    file = RESULTS / "creep" / "report.html"

    def test_its_curves_are_its_table(self):
        rows = rows_of(RESULTS / "creep" / "creep_curve.csv")
        self.assertEqual(len(rows), 7)
        for k, column in enumerate(("full", "fastsim", "polach", "vermeulen_johnson")):
            shown = self.trace("plot-creep", k)
            for x, y, row in zip(shown["x"], shown["y"], rows, strict=True):
                self.assertAlmostEqual(x, float(row["creepage"]), delta=1e-5 * abs(x))
                self.assertAlmostEqual(y, float(row[column]), delta=1e-5)
        self.assertEqual(self.first_words + self.browser.console(), [])


@slow
class Fretting(Page):
    """A cycle of fretting: its loop."""

    file = RESULTS / "fretting" / "report.html"

    def test_the_loop_is_that_of_the_history_and_closes(self):
        history = read_table(RESULTS / "fretting" / "history.csv")
        shown = self.trace("plot-loop-x")
        for x, y, d, force in zip(shown["x"], shown["y"], history["displacement_um"], history["F_x_N"]):
            self.assertAlmostEqual(x, d, delta=1e-4)
            self.assertAlmostEqual(y, -1e-3 * force, delta=1e-3)
        self.assertAlmostEqual(shown["x"][-1], shown["x"][12], delta=1e-2)
        self.assertGreater(min(y for x, y in zip(shown["x"], shown["y"]) if x > 19), 0, "force and displacement agree")
        self.assertIsNone(self.js("return document.getElementById('loop-y')"), "nothing moves sideways")

    def test_slip_is_a_distance(self):
        self.assertEqual(self.browser.text("#map-slip-0 h3"), "Slip of the last increment")
        patch = read_table(RESULTS / "fretting" / "patch.csv")
        slip = 1e3 * max((x * x + y * y)**0.5 for x, y in zip(patch["slip_x_mm"], patch["slip_y_mm"]))
        self.assertAlmostEqual(self.map_peak("plot-map-slip-0")[2], slip, delta=1e-3 * slip)

    def test_round_off_is_zero(self):
        numbers = dict(self.js("return [...document.querySelectorAll('#contact-numbers td[data-path]')].map(c => "
                               "[c.dataset.path, c.innerText])"))
        self.assertNotEqual(summary_of(RESULTS / "fretting")["contact"]["F_y_N"], 0)
        for path in ("F_y_N", "lateral_force_N", "spin_moment_N_m", "displacement_y_m"):
            self.assertEqual(numbers[f"contact/{path}"], "0")
        self.assertNotRegex(self.browser.text("#verdict"), r"10⁻¹\d")

    def test_no_creepage_is_told(self):
        numbers = self.browser.text("#contact-numbers")
        self.assertNotIn("creepage", numbers)
        self.assertIn("Friction work", numbers)

    def test_the_console_is_silent(self):
        self.assertEqual(self.first_words + self.browser.console(), [])


class Old(Page):
    """A folder from before there were sections and geometry."""

    file = RESULTS / "old" / "report.html"

    def test_it_shows_what_there_is_and_says_what_is_missing(self):
        self.assertEqual(self.first_words, [])
        self.assertIn("No geometry in this folder", self.browser.text("#geometry"))
        self.assertIn("No sections of the rail", self.browser.text("#stress"))
        self.assertEqual(self.js("return document.querySelectorAll('#patch figure').length"), 8)

    def test_a_narrow_window_needs_no_sideways_scrolling(self):
        self.browser.driver.set_window_size(760, 900)
        try:
            self.browser.wait(
                lambda: self.js(
                "return document.getElementById('plot-map-p-0').drawn.width <= "
                "document.getElementById('plot-map-p-0').clientWidth"), "figures have followed")
            self.assertLessEqual(
                self.js("return document.documentElement.scrollWidth - document.documentElement.clientWidth"), 1)
        finally:
            self.browser.driver.set_window_size(1366, 900)


class Study(Page):
    """More than two runs, of which any two are looked at side by side, and tables and charts over all of them."""

    file = RESULTS / "study.html"

    @classmethod
    def setUpClass(cls):
        table = [{"id": "trend", "title": "Trend", "note": "A note.", "columns": ["layer", "p_max [MPa]"],
                  "rows": [["1 mm", 1101.48], ["2 mm <i>", None]]}]
        chart = [{"id": "fig", "title": "Pressure against thickness", "note": "", "x": "h [mm]", "y": "p_max [MPa]",
                  "series": [{"name": "2 E0", "x": [0.5, 1, 3], "y": [1090, 1100, 1130], "markers": True, "colour": -1,
                              "dash": "solid"}, {"name": "<b>4</b> E0 & more", "x": [0.5, 1, 3],
                                                 "y": [1100, 1150, 1250], "markers": True, "colour": -1,
                                                 "dash": "solid"}]}]
        data = f'"tables":{json.dumps(table)},"charts":{json.dumps(chart)}'.replace("<", "\\u003c")
        page = (RESULTS / "three.html").read_text().replace('"tables":[],"charts":[]', data, 1)
        cls.file.write_text(page)
        super().setUpClass()

    def test_its_chart_has_the_lines(self):
        self.assertEqual(self.trace("plot-fig", 1)["y"], [1100, 1150, 1250])
        self.assertEqual(
            self.js("return [...document.querySelectorAll('#fig .keys button')].map(e => e.textContent)"),
            ["2 E0", "<b>4</b> E0 & more"])

    def test_its_table_has_the_cells(self):
        rows = self.js(
            "return [...document.querySelectorAll('#table-trend tr')].map(r => [...r.cells].map(c => c.innerText))")
        self.assertEqual(rows, [["layer", "p_max [MPa]"], ["1 mm", "1101"], ["2 mm <i>", "–"]])

    def test_the_chosen_runs_are_shown(self):
        self.assertEqual(self.browser.text("header .sub").split(" · ")[0], "3 runs")
        self.assertAlmostEqual(self.map_peak("plot-map-p-0")[2], max(read_table(FEM / "patch.csv")["p_MPa"]), delta=0.1)
        self.js("const s = document.querySelectorAll('.chooser select'); s[0].value = '1'; s[1].value = ''; "
                "s[0].dispatchEvent(new Event('change'))")
        self.assertAlmostEqual(self.map_peak("plot-map-p-0")[2], max(read_table(BEM / "patch.csv")["p_MPa"]), delta=0.1)
        self.assertIsNone(self.browser.text("#plot-map-p-1"))
        self.assertEqual(self.first_words + self.browser.console(), [])


class WholeStudy(Page):
    """What `study` writes: figures, maps, answers and verdict over all cases."""

    file = RESULTS / "study" / "report.html"

    def rows(self, group="", engine=""):
        lines = [line for line in (RESULTS / "study" / "study.csv").read_text().splitlines()
                 if not line.startswith("#")]
        return [row for row in csv.DictReader(lines) if group in row["group"] and engine in row["engine"]]

    def folder(self, row):
        return RESULTS / "study" / row["folder"]

    def cells_of(self, table):
        return self.js(
            "return [...document.querySelectorAll('#table-' + arguments[0] + ' tr')].map(r => [...r.cells].map(c => "
            "c.innerText))", table)

    def test_nothing_is_fetched_and_nothing_is_wrong(self):
        self.assertEqual(self.first_words, [])
        self.assertEqual([address for address in self.asked if not address.startswith(("data:", "blob:"))],
                         [self.file.as_uri()])
        self.assertLess(self.file.stat().st_size, 6e6)
        self.assertEqual(self.browser.text("h1"), "a small <i>study</i>")

    def test_a_chart_for_each_thickness_has_a_line_for_each_stiffness_and_the_plain_case(self):
        for n, thickness in [(1, "0.5 mm"), (2, "10 mm")]:
            names = self.js("return document.getElementById(arguments[0]).drawn.data.map(t => t.name)",
                            f"plot-lines-{n}")
            self.assertEqual(names, ["E₁ = E₀, half-space", "E₁ = 1.5 E₀, half-space", "E₁ = 4 E₀, half-space"])
            wanted = [*self.rows("plain"), *(r for r in self.rows("grid") if r["layer.0.thickness"] == thickness)]
            for k, row in enumerate(wanted):
                line, shown = read_table(self.folder(row) / "centre_line.csv"), self.trace(f"plot-lines-{n}", k)
                for q, qx, qy in zip(shown["y"], line["q_x_MPa"], line["q_y_MPa"], strict=True):
                    self.assertAlmostEqual(q, (qx * qx + qy * qy) ** 0.5, delta=1e-4 * q + 1e-9)

    def test_the_trend_is_that_of_the_table(self):
        plain = float(self.rows("plain")[0]["p_max_MPa"])
        shown = [self.trace("plot-trend", k) for k in range(3)]
        self.assertEqual([s["x"] for s in shown], [[0.5, 10]] * 3)
        for s, ratio in zip(shown, ["1", "1.5", "4"]):
            wanted = [plain, plain] if ratio == "1" else [float(r["p_max_MPa"]) for r in self.rows("grid")
                                                          if r["layer.0.young_ratio"] == ratio]
            for a, b in zip(s["y"], wanted, strict=True):
                self.assertAlmostEqual(a, b, delta=1e-5 * b)

    def test_maps_show_their_cases(self):
        grid = self.rows("grid")
        for n, row in enumerate(r for r in grid if r["layer.0.thickness"] == "10 mm"):
            states = [v for line in self.trace(f"plot-states-{n + 1}")["z"] for v in line]
            patch = read_table(self.folder(row) / "patch.csv")["state_0separated_1stick_2slip"]
            self.assertEqual([states.count(s) for s in (1, 2)], [patch.count(s) for s in (1, 2)])
        for n, row in enumerate(r for r in grid if r["layer.0.thickness"] == "0.5 mm"):
            self.assertAlmostEqual(self.map_peak(f"plot-stress-{n + 1}")[2], float(row["section_von_mises_MPa"]),
                                   delta=0.1)
            depths = {round(d, 3) for d in self.trace(f"plot-stress-{n + 1}", 1)["y"] if d is not None}
            self.assertEqual(depths, {0.5, 2.0})

    def test_every_case_has_a_line_and_the_failed_one_its_reason(self):
        cases = self.cells_of("cases")[1:]
        self.assertEqual(len(cases), len(self.rows()))
        self.assertRegex(next(c for c in cases if c[0].startswith("broken"))[-1], "^failed: .*misses the rail")

    def test_the_verdict_counts_the_cases_and_names_the_worst(self):
        rows = self.js(
            "return [...document.querySelectorAll('#verdict tr[data-check]')].map(r => ({name: r.dataset.check, ok: "
            "r.dataset.ok === 'true', words: r.cells[4].innerText, value: r.querySelector('.value').innerText}))")
        traction = next(r for r in rows if r["name"] == "traction_coefficient_reached")
        checks = [(self.folder(r), k) for r in self.rows() if r["state"] == "done"
                  for k in summary_of(self.folder(r))["checks"] if k["name"] == "traction_coefficient_reached"]
        self.assertIn(
            f"{sum(k['ok'] for _, k in checks)} of {len(checks)} cases; the worst: wheel/case, finite elements",
            traction["words"])
        self.assertAlmostEqual(number_in(traction["value"]) / 100, max(k["value"] for _, k in checks),
                               delta=5e-3 * max(k["value"] for _, k in checks))
        fem, bem = (summary_of(self.folder(r))["contact"] for r in self.rows("wheel"))
        pressure = next(r for r in rows if r["name"] == "p_max")
        self.assertAlmostEqual(number_in(pressure["value"]) / 100, abs(fem["p_max_Pa"] / bem["p_max_Pa"] - 1),
                               delta=6e-3)
        self.assertEqual(self.cells_of("engines")[1][0], "wheel/case")


class Command(unittest.TestCase):
    def refused(self, code, words, *messages):
        done = subprocess.run([BINARY, "report", *map(str, words)], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, code, done.stderr)
        for message in messages:
            self.assertIn(message, done.stderr)

    def test_what_is_no_result_is_refused(self):
        self.refused(2, [RESULTS / "nowhere"], "is not a result folder",
                     "remedy: give a folder that `railstrata run` or `railstrata bem` has written")

    def test_no_report_is_written_where_none_is_wanted(self):
        with tempfile.TemporaryDirectory() as place:
            for word, wanted in [("--no-report", False), ("--force", True)]:
                done = subprocess.run([BINARY, "bem", RESULTS / "layers.toml", "--cell", "0.8 mm", "--out",
                                       f"{place}/bem", word, "--quiet"], capture_output=True, text=True, timeout=60)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(pathlib.Path(place, "bem", "report.html").exists(), wanted)

    def test_the_reference_is_that_of_the_folder_s_case(self):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place, "changed")
            shutil.copytree(FEM, folder)
            case = (folder / "case.toml").read_text()
            (folder / "case.toml").write_text(case.replace("friction_coefficient = 0.5", "friction_coefficient = 0.4"))
            done = subprocess.run([BINARY, "report", folder, "--quiet"], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 1, done.stderr)  # the case is not the one of the run
            self.assertIn("friction_coefficient = 0.4", (folder / "half_space" / "case.toml").read_text())
            self.assertNotEqual(summary_of(folder / "half_space")["contact"]["slip_area_fraction"],
                                summary_of(HALF_SPACE)["contact"]["slip_area_fraction"])

    def test_the_terminal_gives_the_verdict_of_the_page(self):
        with tempfile.TemporaryDirectory() as place:
            done = subprocess.run([BINARY, "report", FEM, "--out", f"{place}/page.html"], capture_output=True,
                                  text=True, timeout=60)
            self.assertEqual(done.returncode, 1, "as on the page: " + done.stderr)
            told = re.search(r"warning: checks of the page: (\d+) of (\d+) checks fails?: ", done.stderr)
            checks = json.loads(re.search(r'id="data">(.*?)</script>', pathlib.Path(place, "page.html").read_text(),
                                          re.S)[1])["checks"]
            judged = [c for c in checks if c["judged"]]
            self.assertEqual((int(told[1]), int(told[2])), (sum(not c["ok"] for c in judged), len(judged)))

    def test_a_page_says_nothing_of_the_machine_s_folders(self):
        text = (FEM / "report.html").read_text()
        data = re.search(r'id="data">(.*?)</script>', text, re.S)[1]
        self.assertNotIn(str(RESULTS), data)
        self.assertNotIn(json.loads((FEM / "provenance.json").read_text())["host"],
                         json.dumps(json.loads(data)["runs"][0]["provenance"]))
        self.assertNotIn("cpu", json.loads(data)["runs"][0]["provenance"])

    def test_several_folders_need_a_place(self):
        self.refused(2, [FEM, BEM, FEM], "3 folders are given and no --out",
                     "remedy: say where the page is to be written, e.g. --out comparison.html")


del Page  # only its heirs are tests

if __name__ == "__main__":
    with Browser() as BROWSER:
        code = run()
    sys.exit(code)
