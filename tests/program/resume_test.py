#!/usr/bin/env python3
"""Interrupted runs go on with the same bits, however they were interrupted. usage: resume_test.py BINARY [KILLS]

KILLS: how many times the run is killed at a random moment (default 4)."""
import pathlib
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from outside import TWO, FromOutside, fact, main, railstrata, results, rows, slow, start, wait_for

KILLS = int(sys.argv[2]) if len(sys.argv) > 2 else 4
WORDS = ["--threads", "1", "--no-report"]


class Resume(FromOutside):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.whole = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        (cls.whole / "case.toml").write_text(TWO)
        rc, _, err = railstrata("run", cls.whole / "case.toml", *WORDS, "--out", cls.whole / "out")
        assert rc in (0, 1), err
        cls.rc, cls.reference, cls.rows = rc, results(cls.whole / "out"), rows(cls.whole / "out")

    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def begin(self, *words, **options):
        return start("run", self.case(TWO), *WORDS, "--out", self.out, *words, **options)

    def resume(self, *words):
        return ["run", "--resume", self.out, *WORDS, *words]

    def finish(self):
        rc, _, err = railstrata(*self.resume())
        self.assertEqual(rc, self.rc, err)
        self.same_as_whole()
        return err

    def same_as_whole(self):
        found = results(self.out)
        self.assertEqual(sorted(found), sorted(self.reference))
        for name, content in self.reference.items():
            self.assertTrue(found[name] == content, name)

    def stop_at(self, process, row, signals=(signal.SIGTERM,)):
        wait_for(lambda: rows(self.out) >= row, process)
        for s in signals:
            process.send_signal(s)
        return process.communicate()[1]

    def test_stopped_twice_it_ends_as_in_one_go(self):
        process = self.begin()
        err = self.stop_at(process, self.rows // 4)
        self.assertEqual(process.returncode, 130, err)
        self.assertIn(f"go on with\n    railstrata run --resume {self.out}\n", err)
        self.assertFalse((self.out / "summary.json").exists())
        early = rows(self.out)
        process = start(*self.resume())
        err = self.stop_at(process, 3 * self.rows // 4, (signal.SIGINT,))
        self.assertEqual(process.returncode, 130, err)
        self.assertGreater(rows(self.out), early)
        # the finished position; the half measured one is not there
        self.assertTrue((self.out / "position_12mm" / "summary.json").exists())
        self.assertFalse((self.out / "summary.json").exists())
        self.finish()
        self.refused(2, self.resume(), "there is nothing to resume", "holds a finished run")

    def test_a_signal_asks_for_a_checkpoint_and_the_run_goes_on(self):
        try:
            import h5py
        except ImportError:
            h5py = None
        process = self.begin("--checkpoint-every", "never")
        wait_for(lambda: rows(self.out) >= self.rows // 4, process)
        self.assertFalse((self.out / "checkpoint.h5").exists())
        process.send_signal(signal.SIGUSR1)
        wait_for((self.out / "checkpoint.h5").exists, process)
        held = h5py.File(self.out / "checkpoint.h5", "r") if h5py else None
        process.send_signal(signal.SIGUSR1)
        wait_for((self.out / "checkpoint.h5.previous").exists, process)
        process.communicate()
        self.assertEqual(process.returncode, self.rc)
        self.same_as_whole()  # checkpoints are gone: there is nothing to go on with
        if held:  # a reader keeps what it has opened
            self.assertEqual(held["result/history"].attrs["columns"].decode().split(",")[0], "time")
            self.assertGreater(abs(held["state/u_rail"][:]).max(), 1e-6)
            held.close()

    def test_the_signals_of_batch_systems_end_a_run_with_a_checkpoint(self):
        for number in (signal.SIGUSR2, signal.SIGXCPU):
            self.out = self.folder / number.name
            process = self.begin()
            wait_for(lambda: rows(self.out) >= self.rows // 4, process)
            for _ in range(3):
                process.send_signal(number)
            process.communicate()
            self.assertEqual(process.returncode, 130)
            self.assertTrue((self.out / "checkpoint.h5").exists())

    @slow
    def test_killed_at_random_moments(self):
        dice = random.Random(20)
        kills = 0
        words = ["--checkpoint-every", "0.05 s"]
        process = self.begin(*words)
        while kills < KILLS:
            wait_for((self.out / "checkpoint.h5").exists, process)
            try:
                process.wait(timeout=dice.uniform(0.02, 0.5))
            except subprocess.TimeoutExpired:
                process.kill()
                kills += 1
            process.communicate()
            if process.returncode == -signal.SIGKILL:
                self.assertFalse((self.out / "summary.json").exists() and rows(self.out) < self.rows)
                finished = not any(self.out.glob("checkpoint.h5*"))  # killed between its last file and its end
                process = self.begin("--force", *words) if finished else start(*self.resume(*words))
            else:  # it was done before the next kill: once more
                self.assertEqual(process.returncode, self.rc)
                self.same_as_whole()
                process = self.begin("--force", *words)
        process.communicate()
        self.assertEqual(process.returncode, self.rc)
        self.same_as_whole()
        fact("run_killed", kills=kills, files=len(self.reference))

    @slow
    def test_a_time_limit_is_kept_with_a_checkpoint(self):
        rc, _, err = railstrata("run", self.case(TWO), *WORDS, "--out", self.out, "--max-time", "1 ms")
        self.assertEqual(rc, 4, err)
        self.assertIn("the static preload alone takes longer than --max-time allows: there is nothing to resume yet",
                      err)
        limit, codes = 1.5, [4]
        # the preload takes as long as the machine is slow, the rolling a hundred times as long; the last limit is at
        # least twice what comes before the rolling
        while 4 in codes[-2:]:
            limit *= 2
            began = time.time()
            rc, _, err = railstrata("run", self.case(TWO), *WORDS, "--out", self.out, "--force", "--set",
                                    'run.positions=["4 m"]', "--max-time", f"{limit} s")
            codes.append(rc)
        self.assertEqual(rc, 5, err)
        self.assertLess((self.out / "checkpoint.h5").stat().st_mtime - began, limit + 0.5)
        self.assertLess(time.time() - began, limit + 1)
        self.assertIn(f"stopped for --max-time; go on with\n    railstrata run --resume {self.out}\n", err)
        self.assertTrue((self.out / "checkpoint.h5").exists())

    @slow
    def test_a_signal_during_the_preload_leaves_nothing_half_done(self):
        message = "error: stopped during the static preload: there is nothing to resume yet\n"
        for _ in range(20):  # on a busy machine the preload may be over before the signal is sent
            shutil.rmtree(self.out, ignore_errors=True)
            process = self.begin()
            wait_for((self.out / "provenance.json").exists, process)
            process.send_signal(signal.SIGTERM)
            err = process.communicate()[1]
            self.assertEqual(process.returncode, 130, err)
            if message in err:
                break
        self.assertIn(message, err)
        self.assertEqual(sorted(f.name for f in self.out.iterdir()),
                         ["case.original.toml", "case.toml", "provenance.json"])
        again = re.search(r"\n    remedy: start it again: railstrata (.+)\n$", err)[1]
        self.refused(2, self.resume(), "there is nothing to resume in", f"remedy: start it again: railstrata {again}\n")
        self.refused(2, ["report", self.out], f"start it again: railstrata {again}\n")
        rc, _, err = railstrata(*shlex.split(again))
        self.assertEqual(rc, self.rc, err)
        self.same_as_whole()

    @slow
    def test_a_full_disk_costs_a_checkpoint_and_not_the_run(self):
        def small_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (700_000, 700_000))
        process = self.begin("--checkpoint-every", "0.1 s", preexec_fn=small_files)
        err = process.communicate()[1]
        self.assertEqual(process.returncode, self.rc, err)
        self.assertIn("warning: no checkpoint: cannot write", err)
        self.assertIn("checkpoint.h5: File too large; the run goes on\n", err)
        self.same_as_whole()
        process = self.begin("--force", "--checkpoint-every", "never", preexec_fn=small_files)
        wait_for(lambda: not (self.out / "summary.json").exists(), process)
        err = self.stop_at(process, self.rows // 4)
        self.assertEqual(process.returncode, 4, err)
        self.assertRegex(err, "error: cannot write .*checkpoint.h5: File too large\n")
        self.assertFalse(list(self.out.glob("checkpoint*")))

    def test_a_changed_case_and_contradictory_words_are_refused(self):
        process = self.begin()
        self.stop_at(process, self.rows // 4)
        file = self.out / "case.toml"
        text = file.read_text()
        file.write_text(text.replace("\ntraction_coefficient = 0.2", "\ntraction_coefficient = 0.1"))
        self.assertNotEqual(file.read_text(), text)
        self.refused(2, self.resume(), "this checkpoint belongs to another case")
        file.write_text(text)
        self.refused(2, self.resume("--set", "mesh.element_size=2 mm"),
                     "--resume goes on with the run of a folder as it was begun")
        self.refused(2, ["run", "--resume", self.folder / "no"], "there is no such folder")
        (self.folder / "empty").mkdir()
        self.refused(2, ["run", "--resume", self.folder / "empty"], f"error: {self.folder}/empty has no case.toml",
                     "remedy: name the result folder of a run that was interrupted")
        self.refused(2, ["run"], "run: no case was named")
        self.refused(2, ["run", self.case(TWO), "--checkpoint-every", "5 mm"],
                     '--checkpoint-every "5 mm": "mm" is not the unit of a time')
        checkpoint = bytearray((self.out / "checkpoint.h5").read_bytes())
        checkpoint[len(checkpoint) // 3] ^= 4
        (self.out / "checkpoint.h5.previous").write_bytes((self.out / "checkpoint.h5").read_bytes())
        (self.out / "checkpoint.h5").write_bytes(checkpoint)
        self.assertIn(
            "its checksum does not agree with its bytes: it is cut off or was changed; the checkpoint before it is "
            "taken", self.finish())


if __name__ == "__main__":
    main()
