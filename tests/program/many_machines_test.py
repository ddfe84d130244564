#!/usr/bin/env python3
"""A study on several machines that share its folder. usage: many_machines_test.py BINARY FAULT_INJECTOR SOURCE_DIR
[KILLS [TESTS]]

The machines are processes with names and clocks of their own, by the library of fault_injector.c. KILLS: how many times
one of them is killed at a random moment (default 5)."""
import collections
import contextlib
import json
import os
import pathlib
import random
import re
import shutil
import signal
import sys
import time
import unittest

from outside import TINY, start
from shared_study import ONE, SharedStudy, wheel

INJECTOR, SOURCE = (pathlib.Path(word).resolve() for word in sys.argv[2:4])
KILLS = int(sys.argv[4]) if len(sys.argv) > 4 else 5
CLOCKS = {"north": -600, "south": 0, "west": 600}  # s ahead
WHEEL = wheel("24 mm")
LONG = TINY.replace('positions = ["30 mm"]', 'positions = ["900 mm"]')
STUDY = f"""{ONE}[group.vary]
"drive.traction_coefficient" = [0.1, 0.15, 0.2]
[[group]]
name = "layers"
base = "{SOURCE / "cases/paper/layer_3mm_2E0.toml"}"
engines = ["bem"]
[group.vary]
"layer.0.young_ratio" = [1.5, 2, 4]
""".replace('engines = ["fem"]', 'engines = ["fem"]\ncell = "1.5 mm"')


def machine(name):
    return {**os.environ, "LD_PRELOAD": str(INJECTOR), "ASAN_OPTIONS": "verify_asan_link_order=0",
            "RAILSTRATA_HOST": name, "RAILSTRATA_CLOCK": str(CLOCKS[name])}


class ManyMachines(SharedStudy):
    def setUp(self):
        super().setUp()
        self.started = []
        self.addCleanup(self.kill_all)

    def kill_all(self):
        for process in self.started:
            process.kill()
            process.communicate()

    def on(self, name, *words):
        process = start(*self.words(self.out, *words), env=machine(name))
        self.started.append(process)
        return process

    def stamps(self):
        found = {}
        for file in self.out.rglob("study.json"):
            if ".part-" not in str(file):
                with contextlib.suppress(FileNotFoundError):
                    found[str(file.relative_to(self.out))] = file.stat().st_mtime_ns
        return found

    def wait_for_it(self, condition, process):
        def ended():
            return "" if process.poll() is None else f"{process.returncode}: {process.communicate()[1]}"

        self.wait_until(condition, ended)

    def rolling(self, name):
        with contextlib.suppress(FileNotFoundError):
            return [folder for folder in self.out.rglob(f"fem.part-{name}-*") if (folder / "history.csv").exists()]
        return []

    def wait_for_a_checkpoint(self, name, process):
        self.wait_for_it(lambda: self.rolling(name), process)
        process.send_signal(signal.SIGUSR1)
        self.wait_for_it(lambda: any((folder / "checkpoint.h5").exists() for folder in self.rolling(name)), process)

    def end(self, process, code):
        out, err = process.communicate(timeout=300)
        self.assertEqual(process.returncode, code, err)
        return err


class Claims(ManyMachines):
    def test_the_checkpoint_of_a_dead_machine_is_gone_on_from_on_another_to_the_same_bits(self):
        self.begin(WHEEL, ONE)
        expected = self.alone()
        for dead, heir in (("west", "north"), ("north", "west")):
            process = self.on(dead, "--lease", "2 s")
            self.wait_for_a_checkpoint(dead, process)
            process.kill()
            process.wait()
            (self.rolling(dead)[0] / f"patch.pvd.part-{dead}-{process.pid}").write_text("half written")
            err = self.end(self.on(heir, "--lease", "2 s"), self.rc)
            self.assertEqual(len(self.goes_on()), 1, err)
            self.assert_whole(expected)
            shutil.rmtree(self.out)

    def test_a_living_machine_keeps_its_case_however_wrong_its_clock_is(self):
        self.begin(LONG, ONE)
        for owner, other in (("north", "west"), ("west", "north")):
            process = self.on(owner, "--lease", "20 s")
            self.wait_for_it(lambda: self.rolling(owner), process)
            claim = json.loads((next(self.out.rglob("*.claim"))).read_text())
            self.assertEqual((claim["host"], claim["process"]), (owner, process.pid))
            self.assertAlmostEqual(claim["time"] - time.time(), CLOCKS[owner], delta=100)
            err = self.end(self.on(other, "--no-wait", "--lease", "20 s"), 0)
            self.assertIn(f"left to {owner}, process {process.pid}", err)
            process.send_signal(signal.SIGINT)
            self.end(process, 130)
            self.assertEqual(list(self.out.rglob("*.claim")), [], "who stops in good order gives its case back")
            shutil.rmtree(self.out)

    def test_a_machine_that_slept_leaves_the_case_to_who_has_taken_it(self):
        self.begin(WHEEL, ONE)
        expected = self.alone()
        sleeper = self.on("south", "--lease", "1 s")
        self.wait_for_a_checkpoint("south", sleeper)
        children = pathlib.Path(f"/proc/{sleeper.pid}/task/{sleeper.pid}/children").read_text().split()
        for pid in (sleeper.pid, *map(int, children)):
            os.kill(pid, signal.SIGSTOP)
        heir = self.on("west", "--lease", "1 s")
        self.end(heir, self.rc)
        self.assertEqual(len(self.goes_on()), 1)
        self.assert_whole(expected)
        before = self.stamps()
        for pid in (*map(int, children), sleeper.pid):
            os.kill(pid, signal.SIGCONT)
        err = self.end(sleeper, self.rc)
        self.assertIn("1 more cases have been computed by other processes", err)
        self.assertEqual(self.stamps(), before)
        self.assert_whole(expected)

    def test_a_failing_case_is_not_tried_by_every_machine(self):
        self.begin(WHEEL, STUDY[STUDY.index("[[group]]\nname = \"layers\""):].replace(
            "[[group]]", '[study]\nbase = "case.toml"\ncell = "1.5 mm"\n[[group]]').replace(
            '"layer.0.young_ratio" = [1.5, 2, 4]', '"geometry.gauge" = ["1.7 m", "1.436 m"]'))
        errors = [self.end(process, 1) for process in [self.on(name) for name in CLOCKS]]
        self.assertLessEqual(sum(err.count("failed: ") for err in errors), 3)
        self.assertEqual(list(self.out.rglob("*.claim")), [])

    def test_of_a_full_disk_the_claim_tells_the_reason(self):
        self.begin(WHEEL, ONE)
        process = start(*self.words(self.out), env={**machine("south"), "RAILSTRATA_FAULT": "write .claim 28 0"})
        self.started.append(process)
        self.assertIn("fem.claim: No space left on device", self.end(process, 4))
        self.assertEqual(list(self.out.rglob("*.claim")), [])

    def test_a_lease_that_makes_no_sense(self):
        self.begin(WHEEL, ONE)
        self.refused(2, self.words(self.out, "--lease", "0.1 s"), "--lease 0.1 s: too short")


class Killed(ManyMachines):
    LEASE = ["--lease", "3 s"]

    def collect(self, process, done):
        """Which cases it says to have computed."""
        done.update(re.findall(r"\d+/\d+  (.*\)): ", process.communicate()[1]))

    def next_victim(self, running, chance, with_checkpoint):
        """At a random moment; or while it writes a checkpoint, or soon after."""
        time.sleep(chance.uniform(0.1, 0.8))
        end = time.monotonic() + (20 if with_checkpoint else 0)
        while time.monotonic() < end and any(process.poll() is None for process in running.values()):
            for name in running:
                if running[name].poll() is None and self.rolling(name):
                    running[name].send_signal(signal.SIGUSR1)
                    time.sleep(chance.uniform(0, 0.3))
                    return name
            time.sleep(0.01)
        return chance.choice(sorted(running))

    def test_each_case_is_done_once_and_to_the_bits_of_a_study_alone(self):
        self.begin(WHEEL, STUDY)
        expected, chance, kills, resumed = self.alone(), random.Random(11), 0, 0
        while kills < KILLS:
            running = {name: self.on(name, *self.LEASE) for name in CLOCKS}
            done, kept = collections.Counter(), {}
            while kills < KILLS and any(process.poll() is None for process in running.values()):
                name = self.next_victim(running, chance, kills % 2 == 0)
                if running[name].poll() is not None:
                    continue  # it has ended by itself: all cases are done
                kills += 1
                running[name].kill()
                self.collect(running[name], done)
                resumed += sum(".part-" in str(log) for log in self.goes_on())
                running[name] = self.on(name, *self.LEASE)
                now = self.stamps()
                self.assertEqual({k: now.get(k) for k in kept}, kept, "a finished case has been lost or done again")
                kept = now
            for process in running.values():
                self.collect(process, done)
                self.assertEqual(process.returncode, self.rc)
            self.assertEqual({k: v for k, v in self.stamps().items() if k in kept}, kept)
            self.assertLessEqual(max(done.values()), 1, done)
            resumed += len(self.goes_on())
            self.assert_whole(expected)
            shutil.rmtree(self.out)
        self.assertGreater(resumed, 0)
        print(f"{kills} kills, {resumed} cases gone on with, {len(expected)} cases")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[5:])
