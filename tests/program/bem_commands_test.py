#!/usr/bin/env python3
"""The half-space commands seen from outside. usage: bem_commands_test.py BINARY SOURCE_DIR"""
import csv
import json
import math
import pathlib
import shutil
import signal
import sys
import tomllib
import xml.etree.ElementTree

from outside import FromOutside, main, railstrata, rows, slow, start, wait_for

SOURCE = pathlib.Path(sys.argv[2]).resolve()
BASE = SOURCE / "cases" / "paper" / "base.toml"
LOADS = SOURCE / "cases" / "collective" / "mixed_traffic.toml"
COARSE = ["--threads", "1", "--cell", "1 mm"]
LOAD = 8660 * 9.81
TWO_PATCHES = """
[geometry]
rail_profile = "UIC60"
wheel_profile = "S1002"
cant = 0.05
gauge_depth = "14 mm"
back_to_back = "1353 mm"
wheel_radius = "430 mm"
lateral_shift = "9.7 mm"
[drive]
traction_coefficient = 0.02
"""


def table(file):
    return list(csv.DictReader(line for line in file.read_text().splitlines() if not line.startswith("#")))


class HalfSpaceCommands(FromOutside):
    def done(self, *words):
        rc, out, err = railstrata(*words)
        self.assertEqual(rc, 0, err)
        return out

    def bem(self, name, *words):
        self.done("bem", BASE, *COARSE, "--out", self.folder / name, *words)
        return self.folder / name

    # bem

    def test_bem_writes_the_files_of_a_run_and_its_summary_reaches_load_and_traction(self):
        out = self.bem("base")
        files = {f.name for f in out.iterdir()}
        self.assertLessEqual({"summary.json", "patch.csv", "centre_line.csv", "depth_line.csv", "patch.vtp",
                              "case.toml", "case.original.toml", "provenance.json"}, files)
        self.assertNotIn("history.csv", files)
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(summary["run"]["engine"], "bem")
        contact = summary["contact"]
        self.assertAlmostEqual(contact["F_z_N"] / LOAD, 1, delta=1e-5)
        self.assertAlmostEqual(contact["F_x_N"] / LOAD, 0.2, delta=1e-5)
        self.assertAlmostEqual(contact["p_max_Pa"] / 1074e6, 1, delta=0.02)  # 1072.9 MPa at 0.25 mm
        self.assertLess(contact["creepage_x"], 0)
        for key in ["penetration_max_m", "p_max_scatter"]:
            self.assertIsNone(contact[key])
        self.assertEqual(summary["position_m"], 0)
        self.assertTrue(all(check["ok"] for check in summary["checks"]))
        resultant = sum(float(row["p_MPa"]) * float(row["area_mm2"]) for row in table(out / "patch.csv"))
        self.assertAlmostEqual(resultant / contact["normal_force_N"], 1, delta=1e-6)

    @slow
    def test_the_shipped_cases_are_within_the_domain_of_validity(self):
        # the elastic stresses of wheel and rail are above yield, which is said; nothing else is. Validation sets go
        # beyond it on purpose.
        for case in sorted((SOURCE / "cases").rglob("*.toml")):
            if (case.name.endswith("expect.toml") or case.is_relative_to(SOURCE / "cases/validation")
                    or case.is_relative_to(SOURCE / "cases/along")  # half-spaces refuse a track
                    or "study" in tomllib.loads(case.read_text())):
                continue
            small = ["--cell", "0.1 mm"] if case.parent.name == "rigs" else []  # patches of discs
            summary = json.loads(self.done("bem", case, *small, "--threads", "1", "--json", "--no-report", "--force",
                                           "--out", self.folder / "shipped"))
            names = {w["name"] for w in summary["warnings"]}
            # stresses below a taper are those of half-spaces, which is said
            tapers = {"layer_varies_below_patch"} if "thickness_table" in case.read_text() else set()
            self.assertLessEqual(names, {"von_mises_above_common_rail_yield", *tapers}, case)

    def test_a_transient_leaves_its_history_a_series_for_paraview_and_its_last_state(self):
        out = self.folder / "rest"
        text = self.done("bem", SOURCE / "cases" / "transient" / "from_rest.toml", *COARSE, "--set",
                         "output.series_frames=4", "--out", out)
        self.assertIn("From rest to rolling, after 40 mm of rolling from rest", text)
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(summary["state"], "after 40 mm of rolling from rest")
        self.assertEqual(summary["run"]["steps"], 40)
        history = table(out / "history.csv")
        self.assertEqual([round(float(row["distance_mm"]), 9) for row in history], list(range(41)))
        self.assertEqual(float(history[-1]["creepage"]), summary["contact"]["creepage_x"])
        self.assertAlmostEqual(1e6 * float(history[-1]["p_max_MPa"]) / summary["contact"]["p_max_Pa"], 1, delta=1e-12)
        self.assertEqual(float(history[-1]["friction_work_J"]), summary["contact"]["friction_work_J"])
        frames = [f.get("file") for f in xml.etree.ElementTree.parse(out / "patch.pvd").iter("DataSet")]
        self.assertEqual(frames, [f"patch_series/patch_{k:04d}.vtp" for k in range(5)])
        self.assertTrue(all((out / frame).exists() for frame in frames))
        again = self.done("bem", out / "case.toml", *COARSE, "--out", self.folder / "again", "--json", "-q")
        self.assertEqual(json.loads(again)["contact"], summary["contact"], "the resolved case is the same case")

    def test_the_finite_elements_refuse_a_transient_and_an_approach(self):
        rc, _, err = railstrata("run", SOURCE / "cases" / "transient" / "fretting.toml", "--out", self.folder / "no")
        self.assertEqual(rc, 2)
        self.assertIn("transient.kind is not supported by", err)
        rc, _, err = railstrata("run", BASE, "--set", "vehicle.approach=0.09 mm", "--out", self.folder / "no")
        self.assertEqual(rc, 2)
        self.assertIn("vehicle.approach is not supported by", err)
        self.assertFalse((self.folder / "no").exists())

    def test_a_transient_that_is_stopped_keeps_its_way_and_says_the_command(self):
        process = start("bem", SOURCE / "cases" / "transient" / "from_rest.toml", "--threads", 1, "--cell", "0.1 mm",
                        "--out", self.folder / "stopped")
        history = self.folder / "stopped" / "history.csv"
        wait_for(lambda: history.exists() and len(history.read_text().splitlines()) > 8, process)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertRegex(err, r"stopped after [\d.]+ mm of rolling from rest: history.csv and the patch on its way")
        self.assertIn("--force", err)
        self.assertFalse((self.folder / "stopped" / "summary.json").exists())

    def test_an_approach_gives_the_load(self):
        out = self.bem("approach", "--set", "vehicle.approach=0.09 mm")
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(summary["contact"]["approach_m"], 0.09e-3)
        self.assertAlmostEqual(summary["contact"]["F_x_N"] / summary["contact"]["F_z_N"], 0.2, delta=1e-5)
        self.assertNotIn("F_z_relative_to_weight", {c["name"] for c in summary["checks"]})

    def test_what_symmetry_cancels_is_zero_on_the_screen_and_whole_in_the_file(self):
        out = self.done("bem", SOURCE / "cases" / "transient" / "from_rest.toml", *COARSE, "--set",
                        "transient.distance=3 mm", "--no-report", "--out", self.folder / "rest")
        self.assertRegex(out, r"F_y +0 kN")
        self.assertRegex(out, r"spin +0 1/m")
        self.assertNotRegex(out, r"e-\d\d k?N|-0\.00[ ,;]")
        self.assertNotEqual(json.loads((self.folder / "rest" / "summary.json").read_text())["contact"]["F_y_N"], 0)

    def test_the_table_is_that_of_run_and_json_is_the_summary(self):
        out = self.done("bem", BASE, *COARSE, "--out", self.folder / "a")
        for word in ["p_max", "q_max", "slip area", "F_x/F_z", "creepage", "rail below the surface", "Vertical load",
                     "checks"]:
            self.assertIn(word, out)
        self.assertNotIn("nan", out)
        out = self.done("bem", BASE, *COARSE, "--out", self.folder / "b", "--json", "-q")
        self.assertEqual(json.loads(out)["contact"],
                         json.loads((self.folder / "b" / "summary.json").read_text())["contact"])

    def test_a_static_case_is_hertzian(self):
        self.done("bem", SOURCE / "cases" / "verification" / "hertz_crossed_cylinders.toml", "--threads", 1, "--cell",
                  "0.5 mm", "--out", self.folder / "hertz")
        contact = json.loads((self.folder / "hertz" / "summary.json").read_text())["contact"]
        # [Johnson1985 sec. 4.2]
        a = (3 * LOAD * 0.42 / (4 * 210e9 / (2 * (1 - 0.09)))) ** (1 / 3)
        self.assertAlmostEqual(contact["p_max_Pa"] / (1.5 * LOAD / (math.pi * a * a)), 1, delta=5e-3)
        self.assertEqual((contact["q_max_Pa"], contact["F_x_N"]), (0, 0))
        self.assertIsNone(contact["creepage_x"])

    def test_creepages_forces_and_yaw_drive_half_spaces(self):
        drive = ["--set", "drive.creepage=-0.001", "--set", "drive.lateral_force=-5 kN", "--set", "geometry.yaw=5 mrad",
                 "--set", "vehicle.axle_load=20 t"]
        out = self.bem("driven", *drive)
        summary = json.loads((out / "summary.json").read_text())
        contact = summary["contact"]
        self.assertEqual(contact["creepage_x"], -0.001)
        self.assertAlmostEqual(contact["lateral_force_N"], -5000, delta=1)
        self.assertAlmostEqual(contact["F_z_N"] / (1e4 * 9.81), 1, delta=1e-5)
        self.assertNotIn("traction_coefficient_reached", [check["name"] for check in summary["checks"]])
        self.assertIsNotNone(contact["spin_moment_N_m"])
        again = json.loads(self.done("bem", out / "case.toml", *COARSE, "--out", self.folder / "again", "--json", "-q"))
        self.assertEqual(again["contact"], contact)
        beyond = [*drive, "--set", "geometry.curve_radius=300 m", "--set", "drive.spin=0.1 1/m"]
        for words in [["run"], ["check", "--mesh"]]:
            self.refused(2, [*words, BASE, *beyond, "--out", self.folder / words[0]],
                         "--set geometry.curve_radius=300 m: error: geometry.curve_radius is not supported by",
                         "drive.spin is not supported by",
                         "remedy: take it out, or solve the case with `railstrata bem`")
        told = self.done("check", BASE, *beyond)
        for words in ["static load    98.100 kN", "yaw            5.000 mrad", "`run` refuses it"]:
            self.assertIn(words, told)
        self.assertNotIn("not_in_fem", json.loads(self.done("check", BASE, *drive, "--json")))
        self.assertEqual(len(json.loads(self.done("check", BASE, *beyond, "--json"))["not_in_fem"]), 2)

    def test_check_estimates_the_commands_that_take_the_case(self):
        told = json.loads(self.done("check", BASE, *COARSE, "--json", "--vary", "drive.traction_coefficient=0.1,0.2",
                                    "--set", "load=[{passages=9}, {passages=4, wheel_load='70 kN'}]"))
        times = {row["command"]: row for row in told["times"]}
        self.assertEqual(set(times), {"bem", "collective", "sweep"})
        self.assertEqual([times["collective"]["of"], times["sweep"]["of"]], ["for 2 loads", "for 2 cases"])
        for row in times.values():
            self.assertGreater(row["seconds"], 0, row)

    def test_check_of_a_contact_that_cannot_be_meshed_names_the_engine_that_takes_it(self):
        flange = ["--set", "geometry.wheel_profile=S1002", "--set", "geometry.rail_profile=UIC60", "--set",
                  "geometry.track=CN", "--set", "geometry.lateral_shift=11 mm"]
        self.refused(2, ["check", BASE, *flange], "`railstrata bem` makes no mesh and takes it",
                     "too close to the end of the rail's running surface")
        self.done("bem", BASE, "--threads", "1", "--cell", "0.2 mm", *flange, "--out", self.folder / "flange")

    def test_bem_refuses_what_half_space_theory_cannot_answer(self):
        out = ["--out", self.folder / "out"]
        self.refused(2, ["bem", BASE, *COARSE, *out, "--set", "drive.traction_coefficient=0.6"],
                     "drive.traction_coefficient = 0.6: must be below drive.friction_coefficient = 0.5",
                     "lower the traction")
        self.refused(2, ["bem", BASE, *COARSE, *out, "--set", "drive.friction_coefficient=0"],
                     "drive.traction_coefficient = 0.2: must be below drive.friction_coefficient = 0",
                     "lower the traction")
        self.refused(2, ["bem", BASE, *COARSE, *out, "--set", "geometry.gauge=1.7 m"], "error: ", "remedy: ")
        self.refused(2, ["bem", BASE, *COARSE, *out, "--set", "vehicle.sprung_mass=200 t", "--set",
                         "material.rail.young=5 GPa"], "flattens the whole potential contact area")
        self.assertFalse((self.folder / "out").exists(), "no folder for a case that is refused")

    def test_a_case_without_friction_and_traction_is_frictionless(self):
        self.done("bem", BASE, *COARSE, "--out", self.folder / "smooth", "--set", "drive.friction_coefficient=0",
                  "--set", "drive.traction_coefficient=0")
        summary = json.loads((self.folder / "smooth" / "summary.json").read_text())
        contact = summary["contact"]
        self.assertEqual((contact["q_max_Pa"], contact["F_x_N"]), (0, 0))
        self.assertIsNone(contact["creepage_x"])
        self.assertIsNone(contact["slip_area_fraction"])
        self.assertAlmostEqual(contact["F_y_N"] / contact["F_z_N"], -math.tan(contact["contact_angle_rad"]), delta=1e-9,
                               msg="only the pressure acts")
        self.assertTrue(all(check["ok"] for check in summary["checks"]))
        self.assertEqual({row["q_x_MPa"] for row in table(self.folder / "smooth" / "patch.csv")}, {"0"})

    def test_the_potential_contact_area_grows_by_itself_and_says_so(self):
        rc, _, err = railstrata("bem", SOURCE / "cases/quick", *COARSE, "--out", self.folder / "heavy", "--set",
                                "layer.0.young_ratio=0.2", "--set", "layer.0.thickness=8 mm")
        self.assertEqual(rc, 0, err)
        self.assertRegex(err, r"info: the potential contact area was grown to \d+\.\d mm x \d+\.\d mm")
        summary = json.loads((self.folder / "heavy" / "summary.json").read_text())
        self.assertEqual([check["value"] for check in summary["checks"]
                          if check["name"] == "patch_reaches_edge_of_grid"], [0])
        rows = table(self.folder / "heavy" / "patch.csv")
        resultant = sum(float(row["p_MPa"]) * float(row["area_mm2"]) for row in rows)
        self.assertAlmostEqual(resultant / summary["contact"]["normal_force_N"], 1, delta=1e-6)

    def test_cells_are_lengths_in_range(self):
        self.refused(2, ["bem", BASE, "--cell", "3 MPa"], '--cell "3 MPa": "MPa" is not the unit of a length')
        self.refused(2, ["bem", BASE, "--cell", "3 m"], '--cell "3 m" is out of range', "from 0.02 mm to 5 mm")

    def test_layers_of_both_bodies_and_a_graded_one_go_through(self):
        case = self.case(BASE.read_text() + """
[[layer]]
name = "clad"
young_table = [["0 mm", "420 GPa"], ["1 mm", "420 GPa"], ["3 mm", "210 GPa"]]
[[layer]]
name = "soft"
thickness = "1 mm"
young_ratio = 0.5
[[layer]]
name = "tread"
on = "wheel"
thickness = "2 mm"
young_ratio = 2.0
""")
        self.done("bem", case, *COARSE, "--out", self.folder / "stack")
        summary = json.loads((self.folder / "stack" / "summary.json").read_text())
        for body in ["rail", "wheel"]:
            for zone in ["layer", "interface", "matrix"]:
                self.assertGreater(summary["stress"][body][zone]["von_mises_max"]["value_Pa"], 1e8, f"{body} {zone}")
        self.assertTrue(all(check["ok"] for check in summary["checks"]))
        rows = table(self.folder / "stack" / "depth_line.csv")
        last = {m: max(float(row["depth_mm"]) for row in rows if row["material"] == m) for m in ["1", "2"]}
        self.assertEqual((round(last["1"], 9), round(last["2"], 9)), (3, 4))
        self.refused(2, ["bem", case, "--set", "layer.0.young_table=[[\"0 mm\", \"420 GPa\"]]"],
                     "layer.0.young_table: needs at least two rows",
                     "remedy: write a table whose rows have a depth and a modulus")

    @slow
    def test_a_note_of_one_of_two_patches_names_it(self):
        words = ["--set", "friction.law=falling_exponential", "--set", "friction.kinetic_coefficient=0.1", "--set",
                 "friction.half_velocity=1 m/s"]
        _, _, err = railstrata("bem", self.case(TWO_PATCHES), *COARSE, *words, "--no-report", "--out",
                               self.folder / "two")
        for place in ("-28.0", "-12.7"):
            self.assertIn(f"info: patch at y = {place} mm of the rail: friction falls with slip by", err)

    # report of two

    def test_a_result_compared_with_itself_differs_by_nothing(self):
        base = self.bem("base")
        self.done("report", "--no-report", base, base, "--out", self.folder / "same")
        result = json.loads((self.folder / "same" / "compare.json").read_text())
        for name, row in result["numbers"].items():
            self.assertEqual(row["a"], row["b"], name)
            self.assertIn(row["relative_difference"], (0, None), name)  # None: of round-off
        for field in result["fields"].values():
            self.assertEqual((field["rms_relative"], field["largest_relative"]), (0, 0))

    def test_compare_tells_the_difference_that_two_cases_have(self):
        a, b = self.bem("a", "--set", "drive.traction_coefficient=0.1"), self.bem("b")
        out = self.done("report", "--no-report", a, b, "--out", self.folder / "ab")
        self.assertIn("-50.00 %", out)
        result = json.loads((self.folder / "ab" / "compare.json").read_text())
        self.assertAlmostEqual(result["numbers"]["F_x_N"]["relative_difference"], -0.5, places=5)
        # friction changes the pressure of equal bodies only by the weight that its lateral force bears
        self.assertLess(result["fields"]["pressure"]["largest_relative"], 1e-4)
        self.assertGreater(result["fields"]["traction"]["rms_relative"], 0.1)
        rows = {row["quantity"]: row for row in table(self.folder / "ab" / "compare.csv")}
        self.assertAlmostEqual(float(rows["F_x_kN"]["a"]), 0.1e-3 * LOAD, places=3)
        self.assertEqual(set(table(self.folder / "ab" / "fields.csv")[0]),
                         {"x_mm", "y_mm", "p_a_MPa", "p_b_MPa", "q_a_MPa", "q_b_MPa"})
        picture = xml.etree.ElementTree.parse(self.folder / "ab" / "compare.svg").getroot()
        lines = [e for e in picture.iter() if e.tag.endswith("polyline")]
        self.assertEqual(len(lines), 4, "p and |q| of both")

    def test_compare_gives_no_shares_of_round_off_and_says_which_patch(self):
        for name, cell in (("one", "1 mm"), ("other", "0.8 mm")):
            self.done("bem", SOURCE / "cases" / "transient" / "from_rest.toml", "--threads", 1, "--cell", cell, "--set",
                      "transient.distance=3 mm", "--no-report", "--out", self.folder / name)
        out = self.done("report", "--no-report", self.folder / "one", self.folder / "other", "--out", self.folder / "c")
        numbers = json.loads((self.folder / "c" / "compare.json").read_text())["numbers"]
        for key, name in (("F_y_N", "F_y, kN"), ("spin_per_m", "spin, 1/m")):
            self.assertLess(abs(numbers[key]["a"]), 1e-3)
            self.assertIsNone(numbers[key]["relative_difference"])
            self.assertRegex(out, rf"{name} +0 +0 +-\n")
        self.assertNotIn("patch 1", out)
        self.done("bem", self.case(TWO_PATCHES), *COARSE, "--no-report", "--out", self.folder / "two")
        out = self.done("report", "--no-report", self.folder / "two", self.folder / "one", "--out", self.folder / "d")
        result = json.loads((self.folder / "d" / "compare.json").read_text())
        self.assertEqual((result["a"]["patches"], result["b"]["patches"]), (3, 1))
        self.assertEqual((result["numbers"]["p_max_Pa"]["of_a"], result["numbers"]["p_max_Pa"]["of_b"]),
                         ("patch 1 of 3", "patch"))
        self.assertEqual(result["numbers"]["F_x_N"]["of_a"], "3 patches")
        self.assertEqual(len(result["notes"]), 2, "three patches, and at another place")
        self.assertIn("A: patch 1 of 3, B: patch", out)

    def test_compare_refuses_what_is_no_result_folder(self):
        base = self.bem("base")
        self.refused(2, ["report", self.folder, base], f"{self.folder} is not a result folder: it has no summary.json",
                     "remedy: give a folder that")
        self.refused(2, ["report", base, self.folder / "nothing"], "is not a result folder")
        (base / "patch.csv").write_text("x_mm,y_mm\n1,2\n1,3\n2\n")
        self.refused(2, ["report", base, base], "patch.csv:4", "a row of 2 numbers is expected")
        (base / "patch.csv").write_text("x_mm,y_mm\n1,2\n")
        self.refused(2, ["report", base, base], "there is no column z_mm")
        (base / "summary.json").write_text("{")
        self.refused(2, ["report", base, base], "summary.json: error: this is not a summary")

    # creep

    def test_a_creep_curve_rises_from_the_linear_theory_to_the_bound(self):
        case = SOURCE / "cases" / "verification" / "hertz_crossed_cylinders.toml"
        out = self.done("creep", case, "--threads", 1, "--cell", "0.5 mm", "--points", 9, "--out",
                        self.folder / "creep")
        self.assertIn("vermeulen_johnson", out)
        rows = [{k: float(v) for k, v in row.items()} for row in table(self.folder / "creep" / "creep_curve.csv")]
        self.assertEqual(len(rows), 9)
        self.assertAlmostEqual(rows[-1]["creepage"], -0.02)
        self.assertAlmostEqual(rows[0]["creepage"], -0.02 * 10**-2.5)
        full = [row["full"] for row in rows]
        self.assertEqual(full, sorted(full))
        self.assertAlmostEqual(rows[-1]["full"], 1, delta=1e-3)
        # Kalker's C11. Slopes, because the rolling radius varies over the patch: some force is there without creepage.
        # The curve bends by 2 % between these points.
        slope = {name: rows[1][name] - rows[0][name] for name in ["full", "linear"]}
        self.assertAlmostEqual(slope["full"] / slope["linear"], 1, delta=0.03)
        for row in rows:
            for theory in ["fastsim", "polach", "vermeulen_johnson"]:
                self.assertAlmostEqual(row[theory], row["full"], delta=0.12, msg=f"{theory} at {row['creepage']}")

    def curve(self, name, *words):
        case = SOURCE / "cases" / "verification" / "hertz_crossed_cylinders.toml"
        self.done("creep", case, "--threads", 1, "--cell", "0.75 mm", "--points", 5, "--out", self.folder / name,
                  "--set", "layer.0.young_ratio=2", "--set", "layer.0.thickness=2 mm", *words)
        return [{k: float(v) for k, v in row.items()} for row in table(self.folder / name / "creep_curve.csv")]

    def test_lateral_and_spin_curves_have_two_sides_under_layers(self):
        rows = self.curve("lateral", "--of", "lateral_creepage", "--both-sides", "--set", "drive.creepage=-0.0005")
        self.assertEqual([row["lateral_creepage"] for row in rows], sorted(row["lateral_creepage"] for row in rows))
        self.assertEqual((len(rows), rows[5]["lateral_creepage"]), (11, 0))
        for left, right in zip(rows, reversed(rows)):
            self.assertAlmostEqual(left["full"], -right["full"], delta=2e-3)
            self.assertAlmostEqual(left["full_across"], right["full_across"], delta=2e-3)
            self.assertLessEqual(math.hypot(left["full"], left["full_across"]), 1 + 1e-5)
        self.assertAlmostEqual(rows[-1]["full"], -0.02 / math.hypot(0.02, 0.0005), delta=2e-3)
        bem = ["--set", "layer.0.young_ratio=2", "--set", "layer.0.thickness=2 mm", "--set", "run.rolling=true",
               "--set", "drive.creepage=-0.0005", "--set", f"drive.lateral_creepage={rows[7]['lateral_creepage']!r}"]
        case = SOURCE / "cases" / "verification" / "hertz_crossed_cylinders.toml"
        contact = json.loads(self.done("bem", case, "--threads", 1, "--cell", "0.75 mm", *bem, "--json", "-q", "--out",
                                       self.folder / "point"))["contact"]
        self.assertAlmostEqual(contact["lateral_force_N"] / (0.5 * LOAD), rows[7]["full"], delta=1e-4)
        self.assertAlmostEqual(contact["F_x_N"] / (0.5 * LOAD), rows[7]["full_across"], delta=1e-4)

    def test_spin_alone_makes_a_lateral_force_that_falls_again_and_a_moment_that_grows(self):
        rows = self.curve("spin", "--of", "spin", "--set", "drive.traction_coefficient=0")
        self.assertAlmostEqual(rows[-1]["spin_per_m"], 5)
        force, moment = [-row["full"] for row in rows], [-row["full_moment_mm"] for row in rows]
        self.assertLess(force[-1], max(force))
        self.assertEqual(moment, sorted(moment))
        self.assertAlmostEqual(rows[0]["full"] / rows[0]["linear"], 1, delta=0.2)  # Kalker's C23, without the layer

    def test_a_creep_curve_needs_a_range(self):
        self.refused(2, ["creep", BASE, "--largest", 0.6], "--largest 0.6 is out of range")
        self.refused(2, ["creep", BASE, "--of", "yaw"], "--of")
        self.refused(2, ["creep", BASE, "--points", 1], "--points")
        self.refused(2, ["creep", BASE, "--largest", 0], "--largest")
        self.refused(2, ["creep", BASE, *COARSE, "--set", "drive.friction_coefficient=0", "--set",
                         "drive.traction_coefficient=0"], "error: ")

    def test_a_creep_curve_is_of_steady_rolling_and_of_one_patch(self):
        out = self.folder / "creep"
        rc, text, err = railstrata("creep", SOURCE / "cases" / "transient" / "fretting.toml", *COARSE, "--points",
                                   2, "--json", "--out", out)
        self.assertEqual(rc, 0, err)
        self.assertIn("warning: transient.kind has no effect on a creep curve", err)
        self.assertIn("transient.kind has no effect", json.loads(text)["notes"][0])
        self.assertIn("# transient.kind has no effect", (out / "creep_curve.csv").read_text())
        _, _, err = railstrata("creep", BASE, *COARSE, "--points", 2, "--set", "run.rolling=false", "--out", out,
                               "--force")
        self.assertIn("run.rolling = false has no effect", err)
        self.refused(2, ["creep", self.case(TWO_PATCHES), *COARSE, "--out", self.folder / "no"],
                     "the wheel touches at y = -27.6 mm", "at another angle at y = -12.7 mm",
                     "a creep curve needs a single contact patch")

    # sweep

    def test_a_drive_that_a_case_at_rest_makes_void_is_warned_of(self):
        still = SOURCE / "cases" / "verification" / "hertz_sphere.toml"
        void = "drive.creepage has no effect with run.rolling = false"
        out = ["--out", self.folder / "still", "--force", "--no-report"]
        _, _, err = railstrata("bem", still, *COARSE, *out)
        self.assertNotIn("warning", err)
        _, _, err = railstrata("bem", still, *COARSE, "--set", "drive.creepage=0.001", *out)
        self.assertIn(void, err)
        _, _, err = railstrata("sweep", still, *COARSE, "--vary", "drive.creepage=0.001,0.002", *out)
        self.assertEqual(err.count(void), 1, err)
        _, _, err = railstrata("creep", still, *COARSE, "--axis", "creepage_x=-0.001,0.001", "--places", 1,
                                  "--out", self.folder / "table")
        self.assertIn("run.rolling = false has no effect on a creep table", err)
        self.assertNotIn("drive.", err)
        self.assertGreater(float(table(self.folder / "table" / "creep_table.csv")[0]["force_x_N"]), 1000)

    def test_a_sweep_says_how_many_patches_a_case_has_and_what_its_columns_are_of(self):
        out = self.folder / "sweep"
        text = self.done("sweep", self.case(TWO_PATCHES), *COARSE, "--vary", "geometry.lateral_shift=2 mm,9.7 mm",
                         "--out", out)
        self.assertIn("# where a wheel touches at several places (column patches): F_x_kN, F_y_kN, F_z_kN of all",
                      (out / "sweep.csv").read_text())
        one, two = table(out / "sweep.csv")
        self.assertEqual(list(one)[-4:], ["fault", "patches", "checks", "warnings"])
        self.assertEqual([(row["patches"], row["checks"], row["fault"]) for row in (one, two)],
                         [("1", "ok", ""), ("3", "ok", "")])
        self.assertIn("patches_near_each_other", two["warnings"])
        self.assertAlmostEqual(1e3 * float(two["F_z_kN"]) / LOAD, 1, delta=1e-5)
        self.assertLess(1e3 * float(two["normal_force_kN"]), 0.6 * LOAD, "that of one patch")
        self.assertIn("of several patches: the numbers of the one with the largest pressure", text)
        self.assertIn("1 of 2 cases: Patches near each other", text)

    def test_a_sweep_s_table_runs_nothing_in_a_spreadsheet(self):
        out = self.folder / "sweep"
        self.done("sweep", BASE, *COARSE, "--vary", "case.title==cmd|calc,@x", "--vary", "geometry.lateral_shift=-1 mm",
                  "--out", out)
        self.assertEqual([(row["case.title"], row["geometry.lateral_shift"]) for row in table(out / "sweep.csv")],
                         [("'=cmd|calc", "-1 mm"), ("'@x", "-1 mm")])

    def test_a_sweep_solves_every_combination_and_its_rows_are_those_of_bem(self):
        out = self.folder / "sweep"
        self.done("sweep", SOURCE / "cases" / "paper" / "layer_3mm_2E0.toml", *COARSE, "--vary",
                  "layer.0.thickness=1 mm, 3 mm", "--vary", "layer.0.young_ratio=0.5,1,2", "--out", out, "--stresses")
        rows = table(out / "sweep.csv")
        self.assertEqual([(row["layer.0.thickness"], row["layer.0.young_ratio"]) for row in rows],
                         [(t, r) for t in ["1 mm", "3 mm"] for r in ["0.5", "1", "2"]])
        self.assertTrue(all(row["fault"] == "" for row in rows))
        self.assertAlmostEqual(float(rows[1]["p_max_MPa"]), float(rows[4]["p_max_MPa"]), places=6,
                               msg="a layer of the rail's own steel: its thickness changes nothing")
        self.done("bem", SOURCE / "cases" / "paper" / "layer_3mm_2E0.toml", *COARSE, "--set", "layer.0.thickness=3 mm",
                  "--set", "layer.0.young_ratio=2", "--out", self.folder / "one")
        one = json.loads((self.folder / "one" / "summary.json").read_text())
        self.assertEqual(float(rows[5]["p_max_MPa"]), 1e-6 * one["contact"]["p_max_Pa"])
        self.assertEqual(float(rows[5]["rail_interface_von_mises_MPa"]),
                         1e-6 * one["stress"]["rail"]["interface"]["von_mises_max"]["value_Pa"])

    def test_a_sweep_gives_the_same_numbers_with_two_threads(self):
        tables = []
        for threads in [1, 2]:
            out = self.folder / f"sweep{threads}"
            self.done("sweep", BASE, "--cell", "1 mm", "--threads", threads, "--vary",
                      "drive.traction_coefficient=0,0.1,0.2,0.3", "--out", out)
            tables.append([{k: v for k, v in row.items() if k != "wall_s"} for row in table(out / "sweep.csv")])
        self.assertEqual(*tables)

    def test_the_json_of_a_sweep_has_the_tables_rows(self):
        out = self.folder / "sweep"
        rc, text, err = railstrata("sweep", BASE, *COARSE, "--vary", "drive.traction_coefficient=0.1,0.7", "--out", out,
                                   "--json")
        self.assertEqual(rc, 1, err)
        rows = json.loads(text)
        self.assertEqual([list(row) for row in rows], [list(row) for row in table(out / "sweep.csv")])
        for row, cells in zip(rows, table(out / "sweep.csv")):
            self.assertEqual({key: "" if value is None else value for key, value in row.items()},
                             {key: float(cells[key]) if isinstance(row[key], float | int) else cells[key]
                              for key in row})
        self.assertIsNone(rows[0]["fault"])
        self.assertIsNone(rows[1]["p_max_MPa"])

    def test_a_failing_case_is_told_in_its_row_and_does_not_stop_the_others(self):
        out = self.folder / "sweep"
        self.refused(1, ["sweep", BASE, *COARSE, "--vary", "drive.traction_coefficient=0.1,0.7", "--vary",
                         "geometry.gauge=1.435 m,1.7 m", "--out", out], "3 of 4 cases failed")
        rows = table(out / "sweep.csv")
        self.assertEqual([row["fault"] == "" for row in rows], [True, False, False, False])
        self.assertIn("must be below drive.friction_coefficient", rows[2]["fault"])
        self.assertEqual(rows[1]["p_max_MPa"], "")
        self.assertGreater(float(rows[0]["p_max_MPa"]), 1000)

    def test_a_sweep_refuses_unknown_keys_and_odd_lists_before_it_starts(self):
        out = ["--out", self.folder / "sweep"]
        self.refused(2, ["sweep", BASE, "--vary", "drive.traction=0.1,0.2", *out], "unknown key drive.traction",
                     "traction_coefficient")
        self.refused(2, ["sweep", BASE, "--vary", "drive.speed", *out], '--vary "drive.speed"',
                     "remedy: write --vary key=value,value")
        self.refused(2, ["sweep", BASE, "--vary", "drive.speed=10 m/s,,20 m/s", *out], "has an empty value")
        self.refused(2, ["sweep", BASE, "--vary", "drive.speed=10 m/s", "--vary", "drive.speed=20 m/s", *out],
                     "names drive.speed twice")
        self.refused(2, ["sweep", BASE, *out], "--vary is required")
        self.assertFalse((self.folder / "sweep").exists())

    # collective, wear-loop

    def test_a_collective_tells_the_load_it_cannot_solve_and_sums_the_others(self):
        out = self.folder / "collective"
        rc, text, err = railstrata("collective", LOADS, *COARSE, "--set", "load.3.lateral_shift=50 mm", "--out", out)
        self.assertEqual(rc, 1, err)
        result = json.loads((out / "collective.json").read_text())
        totals, worst = result["totals"], result["worst_shakedown"]
        self.assertEqual((totals["passages"], totals["passages_left_out"]), (1490000 - 350000, 350000))
        self.assertIn("coach", text)
        self.assertEqual(worst["load"], "locomotive, driving")  # the one left out has less, and does not count
        for name in ["collective.csv", "rail_damage.csv", "report.html", "shown_load/summary.json"]:
            self.assertTrue((out / name).exists(), name)
        self.refused(2, ["collective", BASE, "--out", self.folder / "none"], "`railstrata collective` needs load")

    @slow
    def test_answers_of_collectives_on_cells_half_as_large_lie_within_their_bars(self):
        def within(bars, here, there, place):
            if isinstance(bars, dict):
                for key in set(bars) - {"loads", "share_of_friction_energy", "wheel"}:
                    within(bars[key], here[key], there[key], f"{place}/{key}")
            elif isinstance(bars, list):
                for k, bar in enumerate(bars):
                    within(bar, here[k], there[k], f"{place}/{k}")
            elif bars is not None:
                self.assertLessEqual(abs(here - there), bars, place)

        for name in "mixed_traffic", "measured_wheels", "vehicle_code":
            results = []
            for cell in "0.5 mm", "0.25 mm":
                out = self.folder / f"{name} {cell}"
                rc, text, err = railstrata("collective", LOADS.parent / f"{name}.toml", "--cell", cell, "-q",
                                           "--no-report", "--out", out)
                self.assertEqual(rc, 0, err)
                self.assertRegex(text, "Wear: .* ± ")
                results.append(json.loads((out / "collective.json").read_text()))
            within(results[0]["error"], *results, name)

    def test_a_curve_has_a_collective_of_either_rail(self):
        curve = self.case("[geometry]\nwheel_profile = \"S1002\"\nrail_profile = \"UIC60\"\n[curve]\n"
                          "radius = \"1500 m\"\nrail = \"both\"\n[[bogie]]\ntype = \"wagon\"\nmgt = 10\n")
        err = railstrata("collective", curve, "--cell", "1 mm", "--out", self.folder / "both", "--no-report")[2]
        self.assertIn("estimated", err)
        for rail in "outer", "inner":
            wheels = table(self.folder / "both" / rail / "curving.csv")
            self.assertEqual([w["rail"] for w in wheels], 2 * ["outer", "inner"])
            loads = table(self.folder / "both" / rail / "collective.csv")
            for load, wheel in zip(loads, [w for w in wheels if w["rail"] == rail]):
                self.assertAlmostEqual(float(load["F_z_kN"]) / float(wheel["Q_kN"]), 1, delta=1e-3)
        loop = ["collective", curve, "--steps", 1, "--out", self.folder / "loop"]
        self.refused(2, loop, "a collective is of one rail")

    @slow
    def test_a_wear_loop_goes_on_where_it_stopped_to_the_same_profile(self):
        loop = ["collective", LOADS, *COARSE, "--max-wear", "4 um"]
        self.done(*loop, "--steps", 2, "--out", self.folder / "whole")
        self.done(*loop, "--steps", 1, "--out", self.folder / "parts")
        self.done(*loop, "--steps", 2, "--out", self.folder / "parts", "--resume")
        whole, parts = (self.folder / name / "step_0002" / "rail_profile.csv" for name in ["whole", "parts"])
        self.assertEqual(whole.read_text(), parts.read_text())
        other = ["--set", "drive.speed=10 m/s", "--steps", 3, "--resume", "--out", self.folder / "parts"]
        self.refused(2, [*loop, *other], "no wear loop of this very case")
        self.refused(2, [*loop, "--out", self.folder / "none"], "--max-wear belongs to wear", "give --steps 10")
        pressures = []
        for ending in ["csv", "prr", "ban"]:
            worn = whole.with_suffix(f".{ending}")
            self.done("bem", LOADS, *COARSE, "--set", f"geometry.rail_profile={worn}", "--out", self.folder / ending)
            pressures.append(json.loads((self.folder / ending / "summary.json").read_text())["contact"]["p_max_Pa"])
        self.assertAlmostEqual(pressures[1] / pressures[0], 1, delta=1e-6)
        self.assertAlmostEqual(pressures[2] / pressures[0], 1, delta=1e-6)
        page = (self.folder / "parts" / "report.html").read_text()
        for words in ["Worn off so far, over the rail", "Where each load touches", "locomotive, driving"]:
            self.assertIn(words, page)
        end = json.loads(self.done(*loop, "--steps", 1, "--out", self.folder / "whole", "--force", "--json"))
        self.assertEqual(end["steps"], 1)
        self.assertFalse((self.folder / "whole" / "step_0002").exists())  # of the older loop

    # A small rail that yields and wears under two loads, in seconds.
    TRAFFIC = """
[geometry]
rail_profile = "arc:R=80 mm"
wheel_profile = "arc:R=-400 mm"
cant = 0
[material.rail]
grade = "R260"
hardening = "R260"
[passes]
ductility = 3
[drive]
traction_coefficient = 0.1
friction_coefficient = 0.35
[[load]]
name = "a"
passages = 1000
wheel_load = "50 kN"
[[load]]
name = "b"
passages = 500
wheel_load = "40 kN"
"""

    @slow
    def test_traffic_that_is_stopped_or_killed_goes_on_to_the_same_bits(self):
        traffic = ["collective", self.case(self.TRAFFIC), "--cell", "1 mm", "--until", "3 Mt", "-q", "--no-report"]
        whole, parts = self.folder / "whole", self.folder / "parts"
        self.done(*traffic, "--out", whole)
        history = (whole / "history.csv").read_text()
        names = history[:history.index("\ntraffic_MGT")].count("\n") + 2  # with the lines of origin before them
        self.assertGreater(rows(whole), names + 2)  # the beginning, two stretches

        def until(stretches, sent, *words):
            process = start(*traffic, "--out", parts, *words)
            wait_for(lambda: rows(parts) >= names + 1 + stretches, process)
            process.send_signal(sent)
            return process.communicate()[1], process.returncode

        until(0, signal.SIGKILL)
        self.assertTrue(history.startswith((parts / "history.csv").read_text()))
        err, rc = until(1, signal.SIGINT, "--resume")
        self.assertEqual(rc, 130, err)
        self.assertIn("go on with --resume", err)
        self.assertTrue(history.startswith((parts / "history.csv").read_text()))
        self.assertFalse((parts / "life.csv").exists())
        self.refused(2, [*traffic, "--set", "drive.speed=10 m/s", "--out", parts, "--resume"],
                     'traffic.cbor: error: this traffic is of another case: drive.speed = "10 m/s" instead of',
                     "begin anew with --force")
        self.done(*traffic, "--out", parts, "--resume")
        for name in ["history.csv", "worn_rail.csv", "life.csv", "collective.json", "traffic.cbor"]:
            self.assertEqual((whole / name).read_bytes(), (parts / name).read_bytes(), name)
        self.refused(2, [*traffic, "--out", self.folder / "none", "--resume"], "there is nothing to resume")

    # inputs of CONTACT

    INPUT = """
  1 MODULE
 {side}203100    C-P-B-T-N-F-S
 0022033    V-L-D-C-M-Z-E
 0000321    H-G-I-A-O-W-R
    999     100    30    1     1e-5
  0.3   0.3
  0.28  0.28  82000.  82000.
  0.2   0.2   1.0   90d   8.0   4.0
  14.0  0    1435.0   0.0
  'rail.csv'   0     1.0   0.0
  0.0  0.0  0.0   0.0   0.0   0.0
  1360.0  -70.0   460.0
  'wheel.csv'   0     1.0   0.0
  0.0  {y_mm}  10000.  {roll_rad} {yaw_rad}  0.0
  2000. 0.0    0.0   0.0    0.0  {pitch_rate_rad_per_s}
"""

    def contact_input(self, row):
        for body in ["rail", "wheel"]:
            shutil.copy(SOURCE / f"tests/data/reference/mbench_{body}.csv", self.folder / f"{body}.csv")
        file = self.folder / "position.inp"
        file.write_text(self.INPUT.format_map({**row, "side": {"left": 0, "right": 1}[row["side"]]}))
        return file

    def test_an_input_of_contact_has_contact_s_answer(self):
        for row in table(SOURCE / "tests/data/reference/mbench_a22.csv"):
            if (row["side"], row["y_mm"]) == ("right", "5"):
                continue  # two patches, which CONTACT's D_SEP couples in part and takes for one
            with self.subTest(side=row["side"], y=row["y_mm"]):
                file, side = self.contact_input(row), -1 if row["side"] == "left" else 1
                rc, out, err = railstrata("bem", file, "--cell", "0.2 mm", "--json", "--no-report", "--force", "--out",
                                          self.folder / "out")
                self.assertIn(rc, [0, 1], err)  # 1: on the flange the half-space is not what the bodies are
                contact = json.loads(out)["contact"]
                wanted = {name: float(value) for name, value in row.items() if name != "side"}
                fn, flange = wanted["fn_N"], abs(wanted["angle_rad"]) > 0.3  # there CONTACT's wheel is a polygon
                self.assertAlmostEqual(1e-6 * contact["p_max_Pa"] / wanted["pmax_MPa"], 1,
                                       delta=0.01 if flange else 0.002)
                self.assertAlmostEqual(contact["contact_angle_rad"], -side * wanted["angle_rad"], delta=1e-3)
                self.assertAlmostEqual(contact["normal_force_N"] / fn, 1, delta=0.003)
                # Without yaw slips of both signs leave little: a case has each row's rolling radius (CONTACT's D = 3).
                self.assertAlmostEqual(-contact["F_x_N"] / fn, wanted["track_fx_N"] / fn,
                                       delta=0.015 if wanted["yaw_rad"] == 0 else 0.004)
                self.assertAlmostEqual(-side * contact["F_y_N"] / fn, wanted["track_fy_N"] / fn, delta=0.004)

    def test_every_command_that_takes_a_case_takes_an_input_of_contact(self):
        row = next(r for r in table(SOURCE / "tests/data/reference/mbench_a22.csv") if r["y_mm"] == "2.5")
        file, out = f"{self.contact_input(row)}#1", self.folder / "out"
        written = ["--cell", "1 mm", "--out", out, "--force"]
        self.assertIn("contact angle  11.5", self.done("check", file))
        self.done("bem", file, *written)
        self.assertIn("lateral_shift = ", (out / "case.toml").read_text())
        self.done("bem", out / "case.toml", "--cell", "1 mm", "--out", self.folder / "again")
        self.done("sweep", file, "--vary", "vehicle.wheel_load=10 kN,20 kN", *written)
        self.done("creep", file, "--points", 3, *written)
        self.done("explore", file, "--out", self.folder / "page.html")
        study = self.folder / "study.toml"
        study.write_text('[study]\nbase = "position.inp#1"\nengines = ["bem"]\n[[group]]\nname = "a"\n')
        self.done("study", study, "--dry-run")
        rc, _, err = railstrata("bem", file, "--cell", "1 mm", "--no-report", cwd=self.folder)
        self.assertEqual(rc, 0, err)
        self.assertTrue((self.folder / "results" / "position-1-bem" / "summary.json").exists())
        self.refused(2, ["run", f"{self.folder / 'position.inp'}#2"], "there is no case 2: the number of cases is 1")

    # all

    def test_results_go_to_a_folder_named_after_the_case_and_are_not_overwritten(self):
        rc, _, err = railstrata("bem", BASE, *COARSE, cwd=self.folder)
        self.assertEqual(rc, 0, err)
        self.assertTrue((self.folder / "results" / "base-bem" / "summary.json").exists())
        rc, _, err = railstrata("bem", BASE, *COARSE, cwd=self.folder)
        self.assertEqual(rc, 2)
        self.assertIn("is not empty", err)


if __name__ == "__main__":
    main()
