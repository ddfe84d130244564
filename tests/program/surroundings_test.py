#!/usr/bin/env python3
"""What lies around a run: standard streams that are closed, full or read by nobody, signals at odd moments, folders
that hold other things. usage: surroundings_test.py BINARY"""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

from outside import BINARY, SMALL, TWO, FromOutside, broken_files, railstrata, results, rows, start, wait_for

WORDS = ["--threads", "1", "--no-report"]


class Surroundings(FromOutside):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def shell(self, redirections, *words):
        return subprocess.run(["sh", "-c", f'exec "$0" "$@" {redirections}', BINARY, *map(str, words)],
                              capture_output=True, text=True, timeout=300)

    def finished(self, *words):
        rc, _, err = railstrata(*words)
        self.assertIn(rc, (0, 1), err)
        return rc


class Streams(Surroundings):
    def test_an_error_keeps_its_exit_code_wherever_its_message_goes(self):
        for redirection in ("2>&-", "2>/dev/full", "<&- >&- 2>&-"):
            self.assertEqual(self.shell(redirection, "check", self.folder / "no.toml").returncode, 2, redirection)

    def test_messages_never_reach_a_table(self):
        done = self.shell("<&- 2>&-", "run", self.case(SMALL), *WORDS, "--checkpoint-every", "0.02 s", "--out",
                          self.out)
        self.assertIn(done.returncode, (0, 1))
        self.assertEqual(broken_files(self.out), [])
        # the result is there, its summary could not be shown
        self.assertEqual(self.shell(">&-", "run", self.case(SMALL), *WORDS, "--out", self.folder / "second").returncode,
                         4)
        self.assertEqual(results(self.folder / "second"), results(self.out))

    def test_a_study_with_closed_streams_computes_its_cases(self):
        study = self.folder / "study.toml"
        self.case(SMALL)
        study.write_text('[study]\nbase = "case.toml"\nengines = ["bem"]\ncell = "1.5 mm"\n[[group]]\nname = "g"\n')
        self.shell("<&- >&- 2>&-", "study", study, "--no-report", "--out", self.out)
        self.assertEqual([json.loads(file.read_text())["fault"] for file in self.out.rglob("study.json")], [None])

    def test_a_reader_that_goes_away_stops_neither_the_run_nor_its_report(self):
        read, write = os.pipe()
        os.close(read)
        process = subprocess.Popen([BINARY, "run", self.case(SMALL), "--threads", "1", "--json", "--out", self.out],
                                   stdout=write, stderr=write)
        os.close(write)
        self.assertEqual(process.wait(300), 4)
        self.assertIn("</html>", (self.out / "report.html").read_text()[-100:])


class Signals(Surroundings):
    def test_a_wish_for_a_checkpoint_before_there_is_any_ends_nothing(self):
        def ignores(process, number):
            text = pathlib.Path(f"/proc/{process.pid}/status").read_text()
            return int(re.search(r"SigIgn:\s*(\w+)", text)[1], 16) >> (number - 1) & 1

        for pause in (0, 0.01, 0.03, 0.1):
            process = start("run", self.case(SMALL), *WORDS, "--out", self.out, "--force")
            wait_for(lambda: ignores(process, signal.SIGXFSZ), process)  # the first that the program does
            time.sleep(pause)
            process.send_signal(signal.SIGUSR1)
            err = process.communicate()[1]
            self.assertIn(process.returncode, (0, 1), err)

    def test_a_terminal_that_goes_away_is_a_request_to_stop_but_not_under_nohup(self):
        for ignored in (False, True):
            process = start("run", self.case(TWO), *WORDS, "--out", self.out, "--force",
                            preexec_fn=(lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)) if ignored else None)
            wait_for(lambda: rows(self.out) > 8, process)
            process.send_signal(signal.SIGHUP)
            err = process.communicate()[1]
            self.assertIn(process.returncode, (0, 1) if ignored else (130,), err)
            self.assertEqual((self.out / "checkpoint.h5").exists(), not ignored)


class Folders(Surroundings):
    def stopped_run(self):
        process = start("run", self.case(TWO), *WORDS, "--out", self.out)
        wait_for(lambda: rows(self.out) > 8, process)
        process.send_signal(signal.SIGTERM)
        process.communicate()
        self.assertTrue((self.out / "checkpoint.h5").exists())
        return results(self.out)

    def test_force_replaces_nothing_before_the_new_case_is_known_to_do(self):
        before = self.stopped_run()
        too_large = ["--set", "mesh.element_size=0.05 mm", "--set", "mesh.fine_depth=8 mm"]
        for settings, code in ((["--set", "vehicle.wheel_mass=1 g"], 2), (too_large, 4)):
            rc, _, err = railstrata("run", self.case(TWO), *WORDS, "--out", self.out, "--force", *settings)
            self.assertEqual(rc, code, err)
            self.assertEqual(results(self.out), before)

    def test_nothing_of_an_older_result_stands_beside_a_newer_one(self):
        self.finished("run", self.case(TWO), "--threads", "1", "--out", self.out)
        (self.out / "mine.txt").write_text("mine")
        (self.out / "position_12mm" / "mine.txt").write_text("mine")
        words = ["bem", self.case(SMALL), "--cell", "1.5 mm", "--threads", "1", "--no-report", "--out"]
        self.finished(*words, self.folder / "fresh")
        self.finished(*words, self.out, "--force")
        old = {name: text for name, text in results(self.out).items() if name.endswith("mine.txt")}
        self.assertEqual(sorted(old), ["mine.txt", "position_12mm/mine.txt"])
        self.assertEqual(results(self.out), {**results(self.folder / "fresh"), **old})

    def test_every_position_has_a_folder_of_its_own(self):
        self.finished("run", self.case(SMALL), *WORDS, "--set", 'run.positions=["6.1 mm", "6.4 mm", "12 mm"]', "--out",
                      self.out)
        for position in ("6.1", "6.4"):
            self.assertEqual(json.loads((self.out / f"position_{position}mm" / "summary.json").read_text())[
                "position_m"], float(position + "e-3"))

    def test_half_a_result_is_not_written_where_a_folder_was_moved_away(self):
        process = start("run", self.case(TWO), *WORDS, "--out", self.out)
        wait_for(lambda: rows(self.out) > 8, process)
        self.out.rename(self.folder / "moved")
        err = process.communicate()[1]
        self.assertEqual(process.returncode, 4, err)
        self.assertRegex(err,
                         f"error: cannot write {self.out}/.*: No such file or directory\n    remedy: leave the folder "
                         f"where it is")
        self.assertFalse(self.out.exists())

    def test_the_case_file_itself_is_never_replaced(self):
        case = self.case(SMALL)
        for command in ("run", "bem"):
            self.refused(2, [command, case, "--out", case.parent, "--force"], "would replace the case file itself",
                         "choose another folder")
        self.assertEqual(case.read_text(), SMALL)

    def test_a_study_takes_only_a_study_s_folder_for_its_own(self):
        case, other, study = self.case(SMALL), self.folder / "other.toml", self.folder / "study.toml"
        text = '[study]\nbase = "case.toml"\nengines = ["bem"]\ncell = "1.5 mm"\n[[group]]\nname = "g"\n'
        other.write_text(text)
        study.write_text(text + "# by hand\n")
        self.refused(2, ["study", other, "--out", case.parent], "is not empty", "--force")
        self.assertTrue(study.read_text().endswith("# by hand\n"))
        for _ in range(2):
            self.finished("study", other, "--no-report", "--out", self.out)
        next(self.out.rglob("g/**/summary.json")).write_text("")  # not a result any more
        self.finished("study", other, "--no-report", "--out", self.out)
        self.assertTrue(json.loads(next(self.out.rglob("g/**/summary.json")).read_text()))

    def test_a_page_is_replaced_with_force_only(self):
        self.finished("bem", self.case(SMALL), "--cell", "1.5 mm", "--threads", "1", "--no-report", "--out", self.out)
        page = self.folder / "pages" / "report.html"
        page.parent.mkdir()
        page.write_text("mine")
        self.refused(2, ["report", self.out, "--out", page.parent], "there is a file of this name", "--force")
        self.assertEqual(page.read_text(), "mine")
        rc, out, err = railstrata("report", self.out, "--out", self.folder / 'a "quoted" name.html', "--json")
        self.assertIn(rc, (0, 1), err)
        self.assertEqual(json.loads(out)["report"], str(self.folder / 'a "quoted" name.html'))
        self.refused(2, ["report", self.folder / "nothing", "--out", self.folder / "new" / "page.html"],
                     "is not a result folder")
        self.assertFalse((self.folder / "new").exists())

    def test_a_title_of_several_lines_heads_every_table(self):
        text = SMALL.replace('title = "', 'title = "one\\ntwo,\\rthree ')
        study = self.folder / "study.toml"
        study.write_text(
            '[study]\ntitle = "one\\ntwo,three"\nbase = "case.toml"\nengines = ["bem"]\ncell = "2 mm"\n[[group]]\n'
            'name = "g"\n')
        self.finished("sweep", self.case(text), "--vary", "drive.traction_coefficient=0.01", "--cell", "2 mm", "--out",
                      self.out / "sweep")
        self.finished("bem", self.case(text), "--cell", "2 mm", "--out", self.out / "bem")
        self.finished("study", study, "--out", self.out / "study")
        self.assertEqual([name for name in broken_files(self.out) if not name.endswith("log.txt")], [])

    def test_a_table_that_grows_does_not_follow_a_link(self):
        elsewhere = self.folder / "elsewhere.csv"
        elsewhere.write_text("mine")
        self.out.mkdir()
        (self.out / "sweep.csv").symlink_to(elsewhere)
        self.finished("sweep", self.case(SMALL), "--vary", "drive.traction_coefficient=0.01", "--cell", "2 mm", "--out",
                      self.out, "--force")
        self.assertEqual(elsewhere.read_text(), "mine")
        self.assertEqual(broken_files(self.out), [])

    def test_names_that_are_not_utf_8(self):
        case, odd = self.case(SMALL), os.fsencode(self.folder) + b"/od\xff"
        for words in ([b"bem", os.fsencode(case), b"--out", odd], [b"check", odd]):
            done = subprocess.run([os.fsencode(BINARY), *words], capture_output=True, timeout=300)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(b"is not UTF-8", done.stderr)
        self.assertFalse(os.path.exists(odd))
        os.mkdir(odd)
        shutil.copy(os.fsencode(case), odd)
        done = subprocess.run([BINARY, "bem", "case.toml", "--cell", "1.5 mm", "--out", "out"], cwd=odd,
                              capture_output=True, timeout=300)
        self.assertIn(done.returncode, (0, 1), done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
