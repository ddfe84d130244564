#!/usr/bin/env python3
"""What the machine does to a run: full disks, folders that cannot be written, checkpoints that cannot be read, two runs
at once. usage: faults_test.py BINARY FAULT_INJECTOR

FAULT_INJECTOR: the library of fault_injector.c."""
import contextlib
import errno
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from outside import SMALL, TINY, FromOutside, broken_files, fact, main, railstrata, results, rows, slow, start, wait_for

INJECTOR = pathlib.Path(sys.argv[2]).resolve()
WORDS = ["--threads", "1", "--no-report"]
STILL = SMALL.replace("run_up =", "rolling = false\nrun_up =")
SOON = ["--checkpoint-every", "0.02 s"]
NO_ROOM = "No space left on device\n    remedy: make room on the disk"


def with_fault(call, name, reason, skip=0):
    """The environment of a program whose calls on a file of this name fail."""
    return {**os.environ, "LD_PRELOAD": str(INJECTOR), "ASAN_OPTIONS": "verify_asan_link_order=0",
            "RAILSTRATA_FAULT": f"{call} {name} {reason} {skip}"}


class Faults(FromOutside):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def run_words(self, text, out=None):
        return ["run", self.case(text), *WORDS, "--out", out or self.out]

    def whole(self, text):
        """What a run without faults leaves, and its exit code."""
        with tempfile.TemporaryDirectory() as folder:
            rc, _, err = railstrata(*self.run_words(text, pathlib.Path(folder) / "out"))
            self.assertIn(rc, (0, 1), err)
            return rc, results(pathlib.Path(folder) / "out")

    def assert_same(self, expected, out=None):
        found = results(out or self.out)
        self.assertEqual(sorted(found), sorted(expected))
        for name, content in expected.items():
            self.assertTrue(found[name] == content, name)

    def assert_unfinished_and_sound(self, out=None):
        self.assertFalse(((out or self.out) / "summary.json").exists())
        self.assertEqual(broken_files(out or self.out), [])


class FullDisk(Faults):
    @slow
    def test_at_any_file_of_a_run(self):
        injected = 0
        for text, wanted in ((STILL, lambda name: "history" not in name),
                             (SMALL, lambda name: re.search(r"history|patch_series.*(0|2)\.vtp|pvd|position_.*summary",
                                                            name))):
            rc, reference = self.whole(text)
            files = [*filter(wanted, reference), *(["provenance.json"] if text == STILL else [])]
            for name in files:
                code, _, err = railstrata(*self.run_words(text), "--force",
                                          env=with_fault("write", f"/out/{name}", errno.ENOSPC))
                self.assertEqual(code, 4, f"{name}: {err}")
                self.assertIn(f"error: cannot write {self.out}/{name}: {NO_ROOM}", err)
                if name not in ("case.toml", "case.original.toml", "provenance.json"):
                    self.assertIn(", then start the run again with --force\n", err)
                self.assert_unfinished_and_sound()
                injected += 1
            self.assertEqual(railstrata(*self.run_words(text), "--force")[0], rc)
            self.assert_same(reference)
        fact("disk_full_run", injected=injected, survived=injected)

    def test_at_any_file_of_a_half_space_result(self):
        words = ["bem", self.case(TINY), *WORDS, "--cell", "1.5 mm", "--out", self.out, "--force"]
        rc, _, err = railstrata(*words)
        self.assertIn(rc, (0, 1), err)
        reference = results(self.out)
        for name in reference:
            code, _, err = railstrata(*words, env=with_fault("write", f"/out/{name}", errno.ENOSPC))
            self.assertEqual(code, 4, f"{name}: {err}")
            self.assertIn(f"error: cannot write {self.out}/{name}: {NO_ROOM}, then start it again with --force\n", err)
            self.assert_unfinished_and_sound()
        self.assertEqual(railstrata(*words)[0], rc)
        self.assert_same(reference)
        fact("disk_full_bem", injected=len(reference), survived=len(reference))

    @slow
    def test_the_run_goes_on_from_its_checkpoint_when_there_is_room(self):
        rc, reference = self.whole(SMALL)
        faults = (("write", "history.csv", 60), ("write", "rail.vtu", 0), ("fsync", "wheel.vtu", 0),
                  ("rename", "summary.json", 0))
        for call, name, skip in faults:
            code, _, err = railstrata(*self.run_words(SMALL), "--force", *SOON,
                                      env=with_fault(call, f"/out/{name}", errno.ENOSPC, skip))
            self.assertEqual(code, 4, err)
            self.assertIn(
                f"error: cannot write {self.out}/{name}: {NO_ROOM}, then go on with\n    railstrata run --resume "
                f"{self.out}\n", err)
            self.assert_unfinished_and_sound()
            self.assertEqual(railstrata("run", "--resume", self.out, *WORDS)[0], rc)
            self.assert_same(reference)
        fact("disk_full_resumed", injected=len(faults), survived=len(faults))

    @slow
    def test_a_checkpoint_that_cannot_be_written_leaves_the_one_before(self):
        rc, reference = self.whole(SMALL)
        faults = [(call, reason, skip) for call, reason in (("write", errno.ENOSPC), ("fsync", errno.EIO),
                                                            ("rename", errno.EIO), ("open", errno.EDQUOT))
                  for skip in (0, 1)]
        for call, reason, skip in faults:
            code, _, err = railstrata(*self.run_words(SMALL), "--force", *SOON,
                                      env=with_fault(call, "/out/checkpoint.h5", reason, skip))
            self.assertEqual(code, rc, err)
            self.assertIn(
                f"warning: no checkpoint: cannot write {self.out}/checkpoint.h5: {os.strerror(reason)}; the run goes "
                f"on\n", err)
            self.assert_same(reference)
        fact("disk_full_checkpoint", injected=len(faults), survived=len(faults))

    def test_a_report_that_cannot_be_written_can_be_made_later(self):
        words = ["bem", self.case(TINY), "--cell", "1.5 mm", "--out", self.out]
        code, _, err = railstrata(*words, env=with_fault("write", "/out/report.html", errno.ENOSPC))
        self.assertIn(code, (0, 1), err)
        self.assertIn(f"warning: no report: cannot write {self.out}/report.html: {NO_ROOM}\n", err)
        self.assertEqual(broken_files(self.out), [])
        self.assertFalse((self.out / "report.html").exists())
        self.assertEqual(railstrata("report", self.out)[0], code)
        self.assertTrue((self.out / "report.html").exists())

    @slow
    def test_a_study_takes_up_again_when_there_is_room(self):
        base = self.folder / "base.toml"
        base.write_text(TINY)
        (self.folder / "study.toml").write_text(
            f'[study]\nbase = "{base}"\nengines = ["bem"]\ncell = "1.5 mm"\n[[group]]\nname = "g"\n[group.vary]\n'
            f'"drive.traction_coefficient" = [0.1, 0.2]\n')
        words = ["study", self.folder / "study.toml", "--out", self.out, "--no-report", "--jobs", "1"]
        for name, text in (("study.json", "cannot write"),
                           ("study.csv", f"cannot write {self.out}/study.csv: {NO_ROOM}\n"),
                           ("patch.csv", "2 of 2 cases failed")):
            code, _, err = railstrata(*words, env=with_fault("write", name, errno.ENOSPC))
            self.assertEqual(code, 1 if name == "patch.csv" else 4, err)
            self.assertIn(text, err)
            if name == "patch.csv":
                self.assertEqual((self.out / "study.csv").read_text().count(NO_ROOM.split("\n")[0]), 2)
            code, _, err = railstrata(*words)
            self.assertEqual(code, 0, err)
            self.assertEqual([str(f) for f in self.out.rglob("*") if ".part" in f.name or ".failed" in f.name], [])
            shutil.rmtree(self.out)

    def test_a_study_that_is_ended_before_its_first_case_leaves_no_claim(self):
        self.case(TINY)
        (self.folder / "study.toml").write_text(
            '[study]\nbase = "case.toml"\nengines = ["bem"]\ncell = "1.5 mm"\n[[group]]\nname = "g"\n')
        words = ["study", self.folder / "study.toml", "--out", self.out, "--no-report"]
        for place in ("provenance.json", "study.toml", ".claim"):
            code, _, err = railstrata(*words, env=with_fault("open", place, "term"))
            self.assertEqual(code, 130, f"{place}: {err}")
            self.assertIn("stopped; the same command goes on where it was", err)
            self.assertEqual([str(f) for f in self.out.rglob("*") if ".part" in f.name or ".claim" in f.name], [])
        code, _, err = railstrata(*words)
        self.assertEqual(code, 0, err)

    def test_standard_output_that_is_full_is_no_success(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([sys.argv[1], "info", "--json"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 4)
        self.assertIn("No space left on device", done.stderr)


@contextlib.contextmanager
def file_system(options):
    """A file system in memory of its own: its folder as everyone of this user sees it. Skips where the system does not
    let us mount one."""
    script = f"mount -t tmpfs -o {options} none /mnt && echo ready && exec sleep 1000"
    holder = subprocess.Popen(["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", script],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        if holder.stdout.readline() != "ready\n":
            raise unittest.SkipTest(f"SKIPPED: no file system can be mounted here: {holder.stderr.read().strip()}")
        yield pathlib.Path(f"/proc/{holder.pid}/root/mnt")
    finally:
        holder.kill()
        holder.communicate()


class SmallFileSystem(Faults):
    @slow
    def test_a_disk_that_is_really_full(self):
        rc, reference = self.whole(SMALL)
        size = sum(len(content) for content in reference.values())
        survived = 0
        for share in (0.02, 0.3, 0.8):
            with file_system("size=64m") as disk:
                out, ballast = disk / "out", disk / "ballast"
                ballast.write_bytes(bytes((64 << 20) - 4096 - int(share * size)))
                code, _, err = railstrata(*self.run_words(SMALL, out), "--checkpoint-every", "0.05 s")
                self.assertEqual(code, 4, err)
                self.assertRegex(err, f"error: cannot (write|make the folder) {out}/.*: {NO_ROOM}")
                self.assert_unfinished_and_sound(out)
                ballast.unlink()
                resumable = (out / "checkpoint.h5").exists() or (out / "checkpoint.h5.previous").exists()
                words = ["run", "--resume", out, *WORDS] if resumable else [*self.run_words(SMALL, out), "--force"]
                self.assertEqual(railstrata(*words)[0], rc)
                self.assert_same(reference, out)
                survived += 1
        fact("disk_really_full", injected=survived, survived=survived)

    def test_one_that_can_only_be_read(self):
        with file_system("ro") as disk:
            self.refused(4, self.run_words(SMALL, disk / "out"),
                         f"error: cannot make the output folder {disk}/out: Read-only file system\n    remedy: choose "
                         f"another with --out\n")
            self.refused(4, self.run_words(SMALL, disk),
                         f"error: cannot write {disk}/.writable: Read-only file system\n    remedy: choose a folder "
                         f"that can be written, with --out")


class ReadOnly(Faults):
    def test_a_folder_that_cannot_be_written_is_told_before_anything_is_computed(self):
        self.out.mkdir()
        code, _, err = railstrata(*self.run_words(SMALL), env=with_fault("open", "/out/", errno.EROFS))
        self.assertEqual(code, 4, err)
        self.assertIn(
            f"error: cannot write {self.out}/.writable: Read-only file system\n    remedy: choose a folder that can "
            f"be written, with --out", err)
        self.assertNotIn("meshing", err)
        self.assertEqual(list(self.out.iterdir()), [])

    def test_one_that_becomes_so_while_the_run_rolls(self):
        rc, reference = self.whole(SMALL)
        code, _, err = railstrata(*self.run_words(SMALL), *SOON, env=with_fault("open", "/out/patch", errno.EROFS, 2))
        self.assertEqual(code, 4, err)
        self.assertIn("Read-only file system\n    remedy: ", err)
        self.assert_unfinished_and_sound()
        self.assertEqual(railstrata("run", "--resume", self.out, *WORDS)[0], rc)
        self.assert_same(reference)
        fact("read_only", injected=2, survived=2)


class Checkpoints(Faults):
    def interrupted(self):
        """A run stopped on the way, with two checkpoints."""
        process = start(*self.run_words(SMALL), "--checkpoint-every", "0.02 s")
        wait_for((self.out / "checkpoint.h5.previous").exists, process)
        process.send_signal(signal.SIGTERM)
        process.communicate()
        self.assertEqual(process.returncode, 130)

    def test_a_second_signal_while_one_is_being_written_leaves_the_one_before(self):
        rc, reference = self.whole(SMALL)
        # the second takes its time
        process = start(*self.run_words(SMALL), "--checkpoint-every", "never",
                        env=with_fault("fsync", "/out/checkpoint.h5", "wait", 1))
        wait_for(lambda: rows(self.out) > 10, process)
        process.send_signal(signal.SIGUSR1)
        wait_for((self.out / "checkpoint.h5").exists, process)
        earlier = (self.out / "checkpoint.h5").read_bytes()
        process.send_signal(signal.SIGINT)
        wait_for(lambda: list(self.out.glob("checkpoint.h5.part*")), process)
        asked = time.monotonic()
        process.send_signal(signal.SIGINT)
        process.communicate()
        self.assertLess(time.monotonic() - asked, 8)
        self.assertEqual(process.returncode, 130)
        self.assertEqual((self.out / "checkpoint.h5").read_bytes(), earlier)
        self.assertFalse((self.out / "checkpoint.h5.previous").exists())
        self.assertEqual(railstrata("run", "--resume", self.out, *WORDS)[0], rc)
        self.assert_same(reference)
        fact("second_signal", signals=2)

    @slow
    def test_those_that_cannot_be_read_are_named_and_the_one_before_is_taken(self):
        rc, reference = self.whole(SMALL)
        self.interrupted()
        newest, previous = self.out / "checkpoint.h5", self.out / "checkpoint.h5.previous"
        good, older = newest.read_bytes(), previous.read_bytes()
        previous.unlink()
        resume = ["run", "--resume", self.out, *WORDS]
        remedy = "remedy: start the run anew with --force, or put a whole copy of the file back\n"
        dice, cuts = random.Random(3), 12
        for length in [0, 1, 511, 512, 513, len(good) - 1, *(dice.randrange(len(good)) for _ in range(cuts - 6))]:
            newest.write_bytes(good[:length])
            self.refused(2, resume, f"error: {newest}: this checkpoint cannot be used: it", remedy)
        newest.unlink()
        os.mkfifo(newest)  # whoever opens it waits for ever
        self.refused(2, resume, f"error: {newest}: it is not a file", remedy)
        newest.unlink()
        newest.mkdir()
        self.refused(2, resume, f"error: {newest}: it is not a file", remedy)
        newest.rmdir()
        unreadable = 2
        if os.geteuid() != 0:  # permissions do not bind the superuser
            newest.write_bytes(good)
            newest.chmod(0)
            self.refused(2, resume, f"error: {newest}: Permission denied", remedy)
            newest.chmod(0o600)
            newest.unlink()
            unreadable += 1
        os.mkfifo(newest)
        previous.write_bytes(older)
        code, _, err = railstrata(*resume)
        self.assertEqual(code, rc, err)
        self.assertIn("it is not a file; the checkpoint before it is taken", err)
        self.assert_same(reference)
        fact("checkpoint_unreadable", cuts=cuts, unreadable=unreadable, survived=cuts + unreadable)


class TwoAtOnce(Faults):
    def test_two_runs_never_mix_in_one_folder(self):
        rc, reference = self.whole(SMALL)
        first = start(*self.run_words(SMALL))
        wait_for((self.out / "provenance.json").exists, first)
        told = (f"error: another railstrata is writing into {self.out}\n    remedy: wait until it has ended, or choose "
                f"another folder with --out\n")
        for words in ([*self.run_words(SMALL), "--force"], ["run", "--resume", self.out],
                      ["bem", self.folder / "case.toml", "--cell", "1.5 mm", "--out", self.out, "--force"]):
            self.refused(2, words, told)
        first.communicate()
        self.assertEqual(first.returncode, rc)
        self.assert_same(reference)

    def test_of_many_that_start_together_one_runs(self):
        rc, reference = self.whole(SMALL)
        words = self.run_words(SMALL)
        together = [start(*words) for _ in range(6)]
        told = [process.communicate()[1] for process in together]
        self.assertEqual(sorted(process.returncode for process in together), sorted([rc] + [2] * 5), told)
        self.assert_same(reference)
        fact("runs_at_once", programs=len(together), ran=1)

    def test_a_killed_run_holds_nothing(self):
        first = start(*self.run_words(SMALL))
        wait_for((self.out / "provenance.json").exists, first)
        first.kill()
        first.communicate()
        self.assertIn(railstrata(*self.run_words(SMALL), "--force")[0], (0, 1))


if __name__ == "__main__":
    main(*sys.argv[3:])
