#!/usr/bin/env python3
"""The command passes seen from outside. usage: passes_test.py BINARY SOURCE_DIR"""
import csv
import json
import pathlib
import sys

from outside import FromOutside, main, railstrata, slow

SOURCE = pathlib.Path(sys.argv[2]).resolve()
BASE = SOURCE / "cases" / "paper" / "base.toml"
LAYERED = SOURCE / "cases" / "paper" / "layer_3mm_2E0.toml"
SMOOTH = ["--set", "drive.friction_coefficient=0.1", "--set", "drive.traction_coefficient=0.05"]
COARSE = ["--cell", "1 mm", "--threads", "1", "-q", *SMOOTH]


def strength(mpa, where="material.rail"):
    return ["--set", f'{where}.yield_strength="{mpa} MPa"']


def rows(file):
    return list(csv.DictReader(line for line in file.read_text().splitlines() if not line.startswith("#")))


class Passes(FromOutside):
    def passes(self, name, *words, case=BASE, cell="1 mm"):
        out = self.folder / name
        rc, _, err = railstrata("passes", case, "--cell", cell, "--threads", "1", "-q", *SMOOTH, "--out", out, *words)
        self.assertEqual(rc, 0, err)
        return out

    def same_numbers(self, *folders):
        """But for titles, which name what --set changes."""
        for name in ["passes.csv", "residual.csv", "profile.csv", "loops.csv", "along.csv", "state.csv", "passes.json"]:
            lines = [(out / name).read_text().splitlines() for out in folders]
            numbers = [[line for line in of if not line.startswith(("#", '  "title"'))] for of in lines]
            self.assertEqual(*numbers, name)
            self.assertGreater(len(numbers[0]), 1, name)

    @slow
    def test_below_first_yield_nothing_yields_and_below_the_limit_it_settles(self):
        strong = json.loads((self.passes("strong", *strength(2000), "--passes", 2) / "passes.json").read_text())
        self.assertEqual(strong["class"], "elastic shakedown")
        self.assertEqual(strong["last_pass"]["accumulated_strain"], 0)
        # factors: first yield below 1, one track above
        out = self.folder / "factors"
        rc, _, err = railstrata("bem", BASE, *COARSE, *strength(560), "--no-report", "--out", out)
        self.assertEqual(rc, 0, err)
        factors = json.loads((out / "shakedown.json").read_text())["bodies"][0]["factors"]
        self.assertLess(factors["first_yield"], 0.95)
        self.assertGreater(factors["single_track"], 1.05)
        settles = self.passes("settles", *strength(560), "--passes", 20)
        _, _, err = railstrata("passes", BASE, *COARSE, "--set", "material.rail.hardening=R260", "--passes", 1, "--out",
                               self.folder / "quiet", "-q")
        self.assertNotIn("material.rail.hardening", err)
        self.assertEqual(json.loads((settles / "passes.json").read_text())["class"], "elastic shakedown")
        first = rows(settles / "passes.csv")[0]
        self.assertGreater(float(first["accumulated_strain"]), 1e-5)
        self.assertLess(float(first["sigma_x_min_MPa"]), -5)
        self.assertLess(abs(float(first["balance"])), 1e-6)

    @slow
    def test_resumed_passes_have_the_bits_of_passes_in_one_go(self):
        weak = strength(400)
        whole = self.passes("whole", *weak, "--passes", 2)
        self.passes("parts", *weak, "--passes", 1)
        parts = self.passes("parts", *weak, "--passes", 2, "--resume")
        self.same_numbers(whole, parts)
        other = [*strength(410), "--passes", 3, "--resume", "--out", parts]
        self.refused(2, ["passes", BASE, *COARSE, *other],
                     "no passes of this very case")

    @slow
    def test_pressure_that_follows_falls_as_the_rail_beds_in_and_resumes_to_the_same_bits(self):
        weak = [*strength(400), "--no-report"]
        follows = [*weak, "--set", 'passes.pressure="following"']
        elastic = rows(self.passes("elastic", *weak, "--passes", 1) / "passes.csv")[0]
        whole = self.passes("whole", *follows, "--passes", 2)
        first, second = rows(whole / "passes.csv")
        self.assertEqual(elastic["rounds"], "0")
        self.assertGreater(int(first["rounds"]), 1)
        self.assertLess(float(first["p_max_MPa"]), 0.97 * float(elastic["p_max_MPa"]))
        self.assertLess(float(second["p_max_MPa"]), float(first["p_max_MPa"]))
        self.assertLess(float(first["net_strain"]), float(elastic["net_strain"]))
        self.passes("parts", *follows, "--passes", 1)
        self.same_numbers(whole, self.passes("parts", *follows, "--passes", 2, "--resume"))

    @slow
    def test_passes_jumped_over_end_where_computed_ones_do_and_go_on_to_the_same_bits(self):
        weak = [*strength(350), "--set", 'material.rail.kinematic_hardening=[{modulus = "20 GPa", recall = 50}]',
                "--no-report"]
        jumps = [*weak, "--set", 'passes.jump="auto"']
        all_of_them = self.passes("all", *weak, "--passes", 60)
        jumped = self.passes("jumped", *jumps, "--passes", 60)
        computed, of_60 = (json.loads((out / "passes.json").read_text()) for out in (all_of_them, jumped))
        self.assertLess(of_60["jump"]["passes_in_table"], 60)
        self.assertEqual(len(rows(jumped / "passes.csv")), of_60["jump"]["passes_in_table"])
        self.assertLessEqual(of_60["jump"]["largest_error"], of_60["jump"]["tolerance"])
        self.assertEqual(of_60["class"], computed["class"])
        for key in ("accumulated_strain", "net_strain", "sigma_x_min_MPa", "sigma_y_min_MPa"):
            self.assertAlmostEqual(of_60["last_pass"][key] / computed["last_pass"][key], 1, delta=0.03, msg=key)
        # any number of threads; the beginning, which needs no jump, and then the rest
        threads = self.folder / "threads"
        rc, _, err = railstrata("passes", BASE, *COARSE[:2], "-q", *SMOOTH, "--threads", "2", *jumps, "--passes", 60,
                                "--out", threads)
        self.assertEqual(rc, 0, err)
        self.same_numbers(jumped, threads)
        self.passes("parts", *jumps, "--passes", 3)
        self.same_numbers(jumped, self.passes("parts", *jumps, "--passes", 60, "--resume"))
        self.refused(2, ["passes", BASE, *COARSE, *jumps, "--set", 'passes.lateral_deviation="2 mm"', "--out",
                         self.folder / "none"], "never repeat", "lateral_deviation")

    @slow
    def test_a_grid_four_times_finer_gives_numbers_within_the_bars(self):
        line = SOURCE / "cases" / "line" / "carter.toml"  # ratchets below 250 MPa: p0/k = 4
        hardens = 'material.rail.kinematic_hardening=[{modulus = "20 GPa", recall = 50}]'
        for name, words in (("above", strength(232)), ("near", strength(245)),
                            ("hardening", [*strength(250), "--set", hardens])):
            def passes(finer):
                keys = (f"passes.patch_cells={4 * finer}", f"passes.patch_rows={6 * finer}")
                grid = [word for key in keys for word in ("--set", key)]
                out = self.passes(f"{name}_{finer}", *words, *grid, "--passes", 2, "--no-report", case=line,
                                  cell=f"{0.4 / finer} mm")
                return json.loads((out / "passes.json").read_text())

            coarse, fine = passes(1), passes(4)
            bars = coarse["error"]["last_pass"]
            self.assertIn("net_strain", bars)
            for column, bar in bars.items():
                value, truth = (result["last_pass"][column] for result in (coarse, fine))
                self.assertLessEqual(abs(value - truth), bar, f"{name}: {column} {value} {truth}")
            self.assertIn(" ± ", coarse["verdict"])
            self.assertLess(fine["error"]["last_pass"]["net_strain"], 0.5 * bars["net_strain"])

    def test_the_coarsest_grid_has_no_bar_and_says_why(self):
        out = self.passes("coarsest", *strength(400), "--set", "passes.patch_cells=2", "--passes", 1, "--no-report")
        result = json.loads((out / "passes.json").read_text())
        self.assertIsNone(result["error"])
        self.assertIn("patch_cells", result["no_error"])
        self.assertNotIn("±", result["verdict"])

    def test_the_grid_has_the_rows_and_the_window_that_are_asked_for(self):
        few = [*strength(400), "--passes", 1, "--no-report"]
        usual = json.loads((self.passes("usual", *few) / "passes.json").read_text())["grid"]
        keys = ("patch_cells=4", 'first_row="0.05 mm"', "window=6")
        grid = [word for key in keys for word in ("--set", f"passes.{key}")]
        fine = json.loads((self.passes("fine", *few, *grid) / "passes.json").read_text())["grid"]
        self.assertEqual(usual["stations"], 12 * 6)
        self.assertEqual(fine["stations"], 14 * 4)
        self.assertLessEqual(fine["row_m"], 0.05e-3 * (1 + 1e-9))
        self.assertGreater(fine["rows"], usual["rows"])
        self.refused(2, ["passes", BASE, *few, "--engine", "fem", "--set", "passes.window=6", "--out",
                         self.folder / "none"], "passes.window", "--engine bem")
        self.refused(2, ["passes", BASE, *few, "--set", "passes.patch_cells=1", "--out", self.folder / "none"],
                     "passes.patch_cells", "2")

    @slow
    def test_the_window_grows_while_the_flow_lasts_and_resumes_to_the_same_bits(self):
        keys = ("drive.friction_coefficient=0.01", "drive.traction_coefficient=0.005", "passes.patch_cells=4",
                'material.rail.kinematic_hardening=[{modulus="11.5 GPa", recall=0}]')
        flows = [*strength(200), *(word for key in keys for word in ("--set", key)), "--no-report"]
        line = SOURCE / "cases" / "line" / "carter.toml"
        whole = self.passes("whole", *flows, "--passes", 2, case=line)
        grid = json.loads((whole / "passes.json").read_text())["grid"]
        self.assertGreater(grid["behind_m"], 7 * 4 * grid["dx_m"])
        self.assertLessEqual(max(float(row["late_flow"]) for row in rows(whole / "passes.csv")), 1e-3)
        self.passes("cut", *flows, "--passes", 1, case=line)
        cut = self.passes("cut", *flows, "--passes", 2, "--resume", case=line)
        self.same_numbers(whole, cut)

    @slow
    def test_wheels_that_wander_and_pull_in_turn_run_where_the_case_says_and_resume_to_the_same_bits(self):
        plan = [*strength(450), "--set", 'passes.lateral_positions=["0 mm", "4 mm"]', "--set",
                "passes.traction_coefficients=[0.05, -0.05]", "--no-report"]
        whole = self.passes("wander", *plan, "--passes", 4)
        table = rows(whole / "passes.csv")
        grid = json.loads((whole / "passes.json").read_text())["grid"]
        for row, place, traction in zip(table, [0, 4, 0, 4], [0.05, -0.05, 0.05, -0.05]):
            self.assertAlmostEqual(float(row["lateral_mm"]), place, delta=500 * grid["dy_m"])
            self.assertAlmostEqual(float(row["traction"]), traction, delta=2e-3)
        self.assertEqual([row["cycle_net"] == "" for row in table], [True, False, True, False])
        # the second wheel yields what the first one left alone, on its side
        self.assertGreater(float(table[1]["accumulated_strain"]), 0.5 * float(table[0]["accumulated_strain"]))
        sides = {}
        for row in rows(whole / "residual.csv"):
            sides[float(row["y_mm"])] = sides.get(float(row["y_mm"]), 0) + float(row["plastic_strain_accumulated"])
        middle = sum(y * p for y, p in sides.items()) / sum(sides.values())
        self.assertGreater(middle, 0.5)
        self.passes("cut", *plan, "--passes", 3)
        self.same_numbers(whole, self.passes("cut", *plan, "--passes", 4, "--resume"))

    def test_wheels_that_scatter_take_the_seeds_places(self):
        def places(seed):
            out = self.passes(f"seed{seed}", *strength(2000), "--passes", 6, "--no-report", "--set",
                              'passes.lateral_deviation="2 mm"', "--set", f"passes.lateral_seed={seed}")
            return [float(row["lateral_mm"]) for row in rows(out / "passes.csv")]
        one = places(1)
        self.assertGreater(len(set(one)), 2)
        self.assertLessEqual(max(abs(y) for y in one), 6.5)
        self.assertNotEqual(one, places(2))
        self.refused(2, ["passes", BASE, *COARSE, *strength(400), "--out", self.folder / "none", "--set",
                         'passes.lateral_positions=["0 mm", "200 mm"]'], "another part of the profile",
                     "passes.lateral_positions")

    @slow
    def test_strains_that_are_no_longer_small_are_said_in_result_screen_and_page(self):
        out = self.folder / "soft"
        for passes, words in ((4, "numbers are some percent off"), (8, "No claim of accuracy: plastic strain reaches")):
            rc, _, err = railstrata("passes", BASE, *COARSE, *strength(300), "--passes", passes, "--out", out,
                                    *(["--resume"] if passes > 4 else []))
            self.assertEqual(rc, 0, err)
            self.assertIn(words, err)
            self.assertIn(words, json.loads((out / "passes.json").read_text())["verdict"])
            self.assertIn(words, (out / "report.html").read_text())
        largest = max(sum((1 if c[-1] == c[-2] else 2) * float(row[f"plastic_{c}"])**2
                          for c in ("xx", "yy", "zz", "xy", "yz", "xz")) for row in rows(out / "residual.csv"))
        told = float(json.loads((out / "passes.json").read_text())["verdict"].split("reaches ")[1].split(" %")[0])
        self.assertAlmostEqual(told, 100 * (2 / 3 * largest)**0.5, delta=0.06)

    def test_the_page_the_loops_and_the_ductility_say_what_the_table_says(self):
        out = self.passes("page", *strength(400), "--passes", 2, "--set", "passes.ductility=0.3")
        page = (out / "report.html").read_text()
        summary = json.loads((out / "passes.json").read_text())
        self.assertIn(summary["verdict"], page)
        self.assertIn("perfect plasticity", summary["law"])
        self.assertLess(summary["shakedown"]["factors"]["first_yield"], 1)
        self.assertEqual(summary["ductility"]["strain"], 0.3)
        self.assertLessEqual(summary["ductility"]["earliest"], summary["ductility"]["passes"])
        self.assertEqual(summary["loops"][0]["name"], "governing")
        self.assertAlmostEqual(1e3 * summary["loops"][0]["depth_m"], summary["last_pass"]["net_depth_mm"], places=9)
        flow = {}
        for row in rows(out / "loops.csv"):
            flow.setdefault(row["point"], []).append(float(row["plastic_strain_accumulated"]))
        governing = next(iter(flow.values()))
        self.assertAlmostEqual(governing[-1] - governing[0], summary["last_pass"]["accumulated_strain"], delta=0.5 * (
            governing[-1] - governing[0]))
        # where it yields perfectly no stress lies above the yield strength, and the elastic one does
        along = rows(out / "along.csv")
        self.assertLess(max(float(row["von_mises_MPa"]) for row in along), 400.5)
        self.assertGreater(max(float(row["von_mises_elastic_MPa"]) for row in along), 450)
        both = self.folder / "both.html"
        rc, _, err = railstrata("report", out, out, "--out", both)
        self.assertEqual(rc, 0, err)
        self.assertEqual(both.read_text().count(summary["verdict"]), 2)
        self.assertFalse((self.passes("bare", *strength(2000), "--passes", 1, "--no-report") / "report.html").exists())

    @slow
    def test_a_layer_may_stay_elastic_and_the_rail_below_it_yield(self):
        out = self.passes("layer", *strength(400), "--passes", 1, case=LAYERED)
        zones = {}
        for row in rows(out / "residual.csv"):
            zones[row["zone"]] = max(zones.get(row["zone"], 0), float(row["plastic_strain_accumulated"]))
        self.assertEqual(zones["1.0" if "1.0" in zones else "1"], 0)
        self.assertGreater(zones["0.0" if "0.0" in zones else "0"], 0)

    def test_cells_too_coarse_for_the_patch_and_layers_without_strength_are_said(self):
        out = self.folder / "coarse"
        words = [word for word in COARSE if word != "-q"]
        words[words.index("1 mm")] = "5 mm"
        rc, _, err = railstrata("passes", LAYERED, *words, *strength(450), "--passes", 1, "--no-report", "--out", out)
        self.assertEqual(rc, 1, err)
        self.assertIn("a check of the contact fails: Patch resolved is ", err)
        self.assertRegex(err, "the case gives no strength, so it stays elastic: give layer.0.yield_strength")
        notes = " ".join(json.loads((out / "passes.json").read_text())["notes"])
        self.assertIn("Patch resolved", notes)
        self.assertIn("stays elastic", notes)
        self.assertIn("after 1 pass:", err)

    @slow
    def test_passes_roll_whatever_the_case_says_of_a_run(self):
        rolling = self.passes("rolling", *strength(450), "--passes", 1, "--no-report")
        still = self.passes("still", *strength(450), "--passes", 1, "--no-report", "--set", "run.rolling=false")
        self.same_numbers(rolling, still)

    def test_what_it_cannot_answer_is_refused_with_a_remedy(self):
        self.refused(2, ["passes", BASE, "--cell", "1 mm", *strength(400), "--out", self.folder / "none"],
                     "231 MPa in shear", "friction_coefficient")
        self.refused(2, ["passes", BASE, *COARSE, "--out", self.folder / "none"], "gives no strength",
                     "yield_strength")
        weak = [*strength(400), "--out", self.folder / "none"]
        self.refused(2, ["passes", BASE, *COARSE, *strength(400), "--set", "material.rail.elastic=true", "--out",
                         self.folder / "none"], "elastic = true", "yield_strength")
        self.refused(2, ["passes", BASE, *weak, "--roll-length", "80 mm"], "rolls no length", "--engine fem")
        self.refused(2, ["passes", BASE, *weak, "--engine", "fem", "--cell", "1 mm"], "--cell", "mesh.element_size")
        self.refused(2, ["passes", BASE, "--passes", "0", *weak], "--passes")
        self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    main()
