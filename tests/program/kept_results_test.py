#!/usr/bin/env python3
"""A result folder stands for itself: it can be computed again anywhere, what was changed in it is seen, and what is no
result is called by its name. usage: kept_results_test.py BINARY"""
import json
import signal
import sys
import time
import unittest

from outside import SMALL, FromOutside, railstrata, rows, start, wait_for

HALF_SPACE = """
[geometry]
rail_profile = "flat"
wheel_profile = "{}"
rail_shape = "block"
wheel_shape = "disc"
cant = 0.0
bore_radius = "250 mm"
"""
COARSE = ["--threads", "1", "--cell", "1 mm", "--no-report"]


def arc(radius):
    """A crowned tread, in mm."""
    return "".join(f"{y:.6f}, {radius - (radius**2 - y * y) ** 0.5:.9f}\n" for y in [0.5 * i for i in range(-60, 61)])


def numbers(file):
    """The lines of a table without those that say where it comes from."""
    return [line for line in file.read_text().splitlines() if not line.startswith("#")]


class Profiles(FromOutside):
    def setUp(self):
        super().setUp()
        self.profile = self.folder / "elsewhere" / "w.csv"
        self.profile.parent.mkdir()
        self.profile.write_text(arc(430))
        self.out = self.folder / "out"

    def done(self, *words):
        rc, _, err = railstrata(*words)
        self.assertIn(rc, (0, 1), err)
        return err

    def test_a_result_moved_elsewhere_gives_the_same_bits_without_the_profile_it_was_made_from(self):
        self.done("bem", self.case(HALF_SPACE.format("elsewhere/w.csv")), *COARSE, "--out", self.out)
        self.assertEqual((self.out / "inputs" / "w.csv").read_bytes(), self.profile.read_bytes())
        self.assertIn('wheel_profile = "inputs/w.csv"', (self.out / "case.toml").read_text())
        kept = [i for i in json.loads((self.out / "provenance.json").read_text())["inputs"] if "kept" in i]
        self.assertEqual([(i["file"], i["kept"]) for i in kept], [(str(self.profile.resolve()), "inputs/w.csv")])
        self.profile.unlink()
        moved = self.folder / "moved"
        self.out.rename(moved)
        self.done("bem", moved / "case.toml", *COARSE, "--out", self.folder / "again")
        for name in ("patch.csv", "depth_line.csv", "rail_cross_section.csv"):
            self.assertEqual(numbers(moved / name), numbers(self.folder / "again" / name), name)
        self.assertEqual((moved / "case.toml").read_text(), (self.folder / "again" / "case.toml").read_text())

    def test_files_of_one_name_are_kept_apart_and_nobody_s_file_is_replaced(self):
        (self.folder / "rail").mkdir()
        rail = "".join(f"{y:.6f}, {-y * y / 70:.9f}\n" for y in [0.5 * i for i in range(-72, 73)])
        (self.folder / "rail" / "w.csv").write_text(rail)
        (self.out / "inputs").mkdir(parents=True)
        (self.out / "inputs" / "w.csv").write_text("mine")
        case = HALF_SPACE.replace('"flat"', '"rail/w.csv"').format("elsewhere/w.csv")
        for _ in range(2):  # the second time the copies are found again
            self.done("bem", self.case(case), *COARSE, "--out", self.out, "--force")
            self.assertEqual((self.out / "inputs" / "w.csv").read_text(), "mine")
            self.assertEqual((self.out / "inputs" / "w-2.csv").read_bytes(),
                             (self.folder / "rail" / "w.csv").read_bytes())
            self.assertEqual((self.out / "inputs" / "w-3.csv").read_bytes(), self.profile.read_bytes())
            self.assertEqual(sorted(f.name for f in (self.out / "inputs").iterdir()), ["w-2.csv", "w-3.csv", "w.csv"])

    def test_a_built_in_profile_leaves_no_copy(self):
        self.done("bem", self.case(HALF_SPACE.format("arc:R=430 mm")), *COARSE, "--out", self.out)
        self.assertFalse((self.out / "inputs").exists())

    def test_a_study_keeps_the_profiles_of_its_cases_and_finds_its_results_again(self):
        (self.folder / "base.toml").write_text(HALF_SPACE.format("elsewhere/w.csv"))
        (self.folder / "study.toml").write_text(
            '[study]\ntitle = "s"\nbase = "base.toml"\nengines = ["bem"]\ncell = "1 mm"\n[[group]]\nname = "g"\n'
            '[group.vary]\n"drive.traction_coefficient" = [0.1, 0.2]\n')
        study = ["study", self.folder / "study.toml", "--out", self.out, "--no-report"]
        err = self.done(*study)
        self.assertIn("2 of them to compute", err)
        copies = list(self.out.glob("g/*/bem/inputs/w.csv"))
        self.assertEqual(len(copies), 2)
        self.assertIn("0 of them to compute", self.done(*study))

    def test_an_interrupted_run_goes_on_in_another_place_without_its_profile(self):
        self.profile.write_text(arc(100))
        text = SMALL.replace('"arc:R=100 mm"', '"elsewhere/w.csv"')
        self.assertNotEqual(text, SMALL)
        whole = self.folder / "whole"
        self.done("run", self.case(text), "--threads", "1", "--no-report", "--out", whole)
        process = start("run", self.folder / "case.toml", "--threads", "1", "--no-report", "--out", self.out)
        wait_for(lambda: rows(self.out) >= rows(whole) // 2, process)
        process.send_signal(signal.SIGTERM)
        err = process.communicate()[1]
        self.assertEqual(process.returncode, 130, err)
        self.profile.unlink()
        moved = self.folder / "moved"
        self.out.rename(moved)
        self.done("run", "--resume", moved, "--threads", "1", "--no-report")
        self.assertEqual(numbers(moved / "patch.csv"), numbers(whole / "patch.csv"))


class Edited(FromOutside):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"
        rc, _, err = railstrata("bem", self.case(HALF_SPACE.format("arc:R=430 mm")), *COARSE, "--out", self.out)
        self.assertEqual(rc, 0, err)

    def edit(self, file, old, new):
        text = (self.out / file).read_text()
        self.assertIn(old, text)
        (self.out / file).write_text(text.replace(old, new, 1))

    def messages_of(self, command, *words, code=0):
        rc, _, err = railstrata(command, *words)
        self.assertEqual(rc, code, err)
        return err

    def checks(self):
        page = (self.out / "report.html").read_text()
        return {c["name"]: c for c in json.loads(page.split('id="data">', 1)[1].split("</script>", 1)[0])["checks"]}

    def test_as_it_is_written_nothing_is_said(self):
        err = self.messages_of("report", self.out)
        self.assertNotIn("warning", err)
        self.assertRegex(err, r"info: checks of the page: all \d+ checks hold\n")
        self.assertNotIn("case_edited", self.checks())

    def test_a_case_changed_after_the_run_fails_on_page_and_terminal(self):
        self.edit("case.toml", 'speed = "', 'speed = "1')
        err = self.messages_of("report", self.out, code=1)
        self.assertIn(f"warning: {self.out}: case.toml was changed after the run", err)
        self.assertRegex(err, r"warning: checks of the page: 1 of \d+ checks fails: Case unchanged since the run\n")
        self.assertFalse(self.checks()["case_edited"]["ok"])
        self.assertIn("case.toml was changed after the run",
                      self.messages_of("report", "--no-report", self.out, self.out, "--out", self.folder / "c"))

    def doubted(self, text):
        err = self.messages_of("report", self.out, code=1)
        self.assertIn(f"warning: {self.out}: {text}", err)
        self.assertRegex(err, r"warning: checks of the page: \d of \d+ checks fails?: ")
        self.assertFalse(self.checks()["summary_contradicted"]["ok"])
        self.assertIn(f"warning: {self.out}: {text}",
                      self.messages_of("report", "--no-report", self.out, self.out, "--force", "--out",
                                       self.folder / "c"))

    def test_a_check_that_is_said_to_hold_beyond_its_limit_fails(self):
        summary = json.loads((self.out / "summary.json").read_text())
        summary["checks"][0]["value"] = 0.5
        (self.out / "summary.json").write_text(json.dumps(summary))
        name = summary["checks"][0]["name"]
        self.doubted(f"summary.json reports that the check {name} holds, but its value is 0.5, its limit ")
        self.assertFalse(self.checks()[name]["ok"])

    def test_another_largest_pressure_than_that_of_the_patch_is_named(self):
        summary = json.loads((self.out / "summary.json").read_text())
        p_max = summary["contact"]["p_max_Pa"]
        summary["contact"]["p_max_Pa"] = 1.001 * p_max
        (self.out / "summary.json").write_text(json.dumps(summary))
        self.doubted(f"summary.json has p_max [MPa] {1.001e-6 * p_max:.6g}, but patch.csv gives {1e-6 * p_max:.6g}: ")

    def test_a_patch_that_is_cut_off_at_the_end_of_a_line_is_named(self):
        lines = (self.out / "patch.csv").read_text().splitlines(keepends=True)
        table = [line for line in lines if not line.startswith("#")][1:]
        pressure = [float(row.split(",")[4]) for row in table]
        columns = next(i for i, row in enumerate(table) if row.split(",")[0] != table[0].split(",")[0])
        kept = (pressure.index(max(pressure)) // columns + 2) * columns  # the largest pressure and its neighbours stay
        self.assertLess(kept, len(table))
        (self.out / "patch.csv").write_text("".join(lines[:len(lines) - len(table) + kept]))
        self.doubted("summary.json has a normal force [kN] of ")

    def test_another_version_is_named(self):
        version = json.loads((self.out / "provenance.json").read_text())["version"]
        self.edit("provenance.json", f'"version": "{version}"', '"version": "9.7.3"')
        err = self.messages_of("report", self.out)
        self.assertIn(f"warning: {self.out}: written by RailStrata 9.7.3, newer than this one ({version})", err)
        self.assertFalse(self.checks()["other_version"]["judged"])

    def test_an_unknown_engine_is_refused(self):
        self.edit("summary.json", '"engine": "bem"', '"engine": "abc"')
        self.refused(2, ["report", self.out], f'{self.out}/summary.json: error: the engine is "abc"',
                     "fem, bem, sections\n    remedy: ")

    def test_a_text_where_a_number_belongs_is_refused(self):
        summary = json.loads((self.out / "summary.json").read_text())
        summary["contact"]["p_max_Pa"] = "1.1 GPa"
        (self.out / "summary.json").write_text(json.dumps(summary))
        for words in (["report", self.out], ["report", self.out, self.out, "--out", self.folder / "c"]):
            self.refused(2, words, f"{self.out}/summary.json: error: contact.p_max_Pa is a text, not a number\n    "
                                   f"remedy: ")

    def test_a_section_with_lines_missing_says_so(self):
        file = self.out / "rail_cross_section.csv"
        file.write_text("\n".join(file.read_text().splitlines()[:-1]) + "\n")
        self.refused(2, ["report", self.out], "rail_cross_section.csv: error: this section cannot be drawn: ",
                     "remedy: lines were removed or sorted")


class NoResults(FromOutside):
    def refused_by_both(self, folder, message, remedy):
        for words in (["report", folder], ["report", folder, folder, "--out", self.folder / "c"]):
            self.refused(2, words, f"error: {folder}{message}", f"remedy: {remedy}")

    def test_an_unfinished_run_is_told_how_to_go_on(self):
        out = self.folder / "my run"
        process = start("run", self.case(SMALL), "--threads", "1", "--no-report", "--out", out)
        wait_for(lambda: rows(out) >= 10, process)
        process.send_signal(signal.SIGTERM)
        process.communicate()
        self.refused_by_both(out, ": this run is not finished", f"railstrata run --resume '{out}'\n")
        for file in out.glob("checkpoint*"):
            file.unlink()
        self.refused_by_both(out, ": this folder was begun and has no results yet",
                             "wait until it has ended; if it was stopped, start it again: railstrata run ")

    def test_a_result_without_its_case_says_what_is_missing(self):
        out = self.folder / "run"
        rc, _, err = railstrata("run", self.case(SMALL), "--threads", "1", "--no-report", "--out", out)
        self.assertIn(rc, (0, 1), err)
        (out / "case.toml").unlink()
        again, _, err = railstrata("report", out)
        self.assertEqual(again, rc, err)
        self.assertIn(f"no half-space reference: {out} has no case.toml; put back the one of the run", err)
        self.assertNotIn("shipped cases", err)

    def test_studies_sweeps_and_creep_curves_are_called_so(self):
        case = self.case(HALF_SPACE.format("arc:R=430 mm"))
        sweep, creep = self.folder / "sweep", self.folder / "creep"
        self.assertEqual(railstrata("sweep", case, "--cell", "1 mm", "--vary", "drive.traction_coefficient=0.1,0.2",
                                    "--out", sweep)[0], 0)
        self.refused_by_both(sweep, ": this is a sweep", "its table is sweep.csv")
        self.assertEqual(railstrata("creep", case, "--cell", "1 mm", "--points", "2", "--out", creep)[0], 0)
        self.refused_by_both(creep, ": this is a creep curve", "its table is creep_curve.csv")
        (self.folder / "study.toml").write_text(
            '[study]\ntitle = "s"\nbase = "case.toml"\nengines = ["bem"]\ncell = "1 mm"\n[[group]]\nname = "g"\n')
        study = self.folder / "study"
        self.assertEqual(railstrata("study", self.folder / "study.toml", "--out", study, "--no-report")[0], 0)
        self.refused_by_both(study, ": this is a study", "its page is report.html in it; for one case")
        one = next(study.glob("g/*/bem"))
        self.refused_by_both(one.parent, " is not a result folder: it has no summary.json",
                             f"give a folder that has one, for example {one}")

    def test_a_folder_that_is_not_there(self):
        self.refused_by_both(self.folder / "gone", " is not a result folder: there is no such folder",
                             "give a folder that")


class Waiting(FromOutside):
    FINE = ["--threads", "1", "--cell", "0.03 mm", "--no-report"]

    def test_a_grid_that_memory_cannot_hold_is_refused(self):
        case = self.case(HALF_SPACE.format("arc:R=430 mm"))
        self.refused_in(400_000_000, ["bem", case, "--cell", "0.02 mm", "--out", self.folder / "out"])
        self.assertFalse((self.folder / "out").exists())

    def refused_in(self, limit, words):
        import resource
        rc, _, err = railstrata(*words, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual(rc, 4, err)
        self.assertRegex(err, r"error: half-spaces on cells of 0.02 mm need about [\d.]+ GB of memory \([\d.]+ million "
                              r"cells\), [\d.]+ GB are at hand\n    remedy: choose larger cells")

    def test_a_long_solution_says_what_it_takes_and_ctrl_c_is_answered(self):
        process = start("bem", self.case(HALF_SPACE.format("arc:R=430 mm")), *self.FINE, "--out", self.folder / "out")
        time.sleep(4)
        self.assertIsNone(process.poll(), "too fast for this test")
        process.send_signal(signal.SIGINT)
        _, err = process.communicate()
        self.assertEqual(process.returncode, 130, err)
        self.assertRegex(err, r"half-spaces, [\d.]+ million cells, about [\d.]+ GB of memory and \d+ \w+: \d s so "
                              r"far\n")
        self.assertTrue(err.endswith("stopped: nothing was written\n"), err)
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
