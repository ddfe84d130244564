#!/usr/bin/env python3
"""`study --batch slurm` in a real Slurm, which the test starts and ends. usage: slurm_test.py BINARY SOURCE_DIR"""
import json
import os
import pathlib
import signal
import sys
import tempfile
import unittest

import one_machine_slurm
sys.path.insert(0, str(pathlib.Path(__file__).parents[3] / "tests" / "program"))
from outside import railstrata, text_of
from shared_study import ONE, SharedStudy, wheel

SOURCE = pathlib.Path(sys.argv[2]).resolve()
PATIENCE = 560  # s, for all of it
WHEELS = ONE.replace('engines = ["fem"]', 'engines = ["fem"]\ncell = "1.5 mm"') + """[group.vary]
"drive.traction_coefficient" = [0.1, 0.2]
"""
HALF_SPACES = f"""[[group]]
name = "layers"
base = "{SOURCE / "cases/paper/layer_3mm_2E0.toml"}"
engines = ["bem"]
[group.vary]
"layer.0.young_ratio" = [2, 4]
"""


def give_up(*_):
    raise TimeoutError(f"more than {PATIENCE} s")


class SlurmTest(SharedStudy):
    @classmethod
    def setUpClass(cls):
        signal.signal(signal.SIGALRM, give_up)
        signal.alarm(PATIENCE)
        folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.slurm = cls.enterClassContext(one_machine_slurm.Slurm(pathlib.Path(folder)))

    def submit(self):
        rc, script, err = railstrata(*self.words(self.out, "--batch", "slurm"))
        self.assertEqual(rc, 0, err)
        return self.slurm.submit(script)

    def wait_for(self, array, task, state):
        def another():
            now = self.slurm.tasks(array).get(task, {"state": "PENDING"})
            over = now["state"] in ("COMPLETED", "FAILED", "CANCELLED", "TIMEOUT") and now["state"] != state
            return f"{now}, {self.said(array, task)}" if over else ""

        self.wait_until(lambda: self.slurm.state(array, task) == state, another, PATIENCE)

    def said(self, array, task):
        return text_of(self.slurm.folder / f"slurm-{array}_{task}.out")

    def claims(self, job):
        return [(file, claim) for file in self.out.rglob("*.claim")
                for claim in [json.loads(text_of(file) or "{}")] if claim.get("job") == job]

    def hold_at_a_checkpoint(self, array, task):
        """The processes of the study and of its run, which is held."""
        job = f"{array}_{task}"
        self.wait_for(array, task, "RUNNING")
        self.wait_until(lambda: self.rolling(job), seconds=PATIENCE)
        self.slurm.ask("scancel", "--signal=USR1", "--batch", job)
        self.wait_until(lambda: any((folder / "checkpoint.h5").exists() for folder in self.rolling(job)),
                        seconds=PATIENCE)
        study = self.claims(job)[0][1]["process"]
        return study, self.hold(study)

    def rolling(self, job):
        return [folder for file, claim in self.claims(job)
                for folder in file.parent.glob(f"fem.part-*-{claim['process']}") if (folder / "history.csv").exists()]

    def end(self, array, expected):
        """Every task has its results. One that is requeued is for a moment as it ended before: the results decide."""
        self.wait_until(lambda: self.results_of(self.out).keys() == expected.keys()
                        and all(t["state"] in ("COMPLETED", "FAILED") for t in self.slurm.tasks(array).values()),
                        seconds=PATIENCE)
        for task, seen in self.slurm.tasks(array).items():
            self.assertIn(seen["code"], (0, self.rc), f"{task}: {seen}, {self.said(array, task)}")

    def test_a_task_that_reaches_its_time_goes_on_after_a_turn_in_the_queue_and_the_others_are_left_alone(self):
        self.begin(wheel("120 mm"), WHEELS + HALF_SPACES)
        expected = self.alone()
        array = self.submit()
        _, run = self.hold_at_a_checkpoint(array, 2)
        task = self.slurm.tasks(array)[2]
        self.assertEqual(task["job"], array, "the last task has the number of the whole array")
        self.slurm.ask("scancel", "--signal=TERM", "--batch", f"{array}_2")  # as Slurm does a minute before its end
        self.wait_until_asked_to_end(run)
        self.let_go(run)
        self.wait_for(array, 2, "PENDING")
        self.assertEqual(self.claims(f"{array}_2"), [])
        self.slurm.begin_now(array, 2)
        self.wait_until(lambda: self.slurm.state(array, 2) != "PENDING")
        self.end(array, expected)
        self.assertEqual({n: t["again"] for n, t in self.slurm.tasks(array).items()}, {0: 0, 1: 0, 2: 1})
        self.assertEqual(len(self.goes_on()), 1)
        self.assert_whole(expected)
        rc, script, err = railstrata(*self.words(self.out, "--batch", "slurm"))
        self.assertEqual((rc, script), (0, ""))
        self.assertIn("nothing to submit", err)

    def test_tasks_that_are_killed_or_cancelled_stay_so_until_the_rest_is_submitted_again(self):
        self.begin(wheel("120 mm"), WHEELS)
        expected = self.alone()
        array = self.submit()
        (killed, _), (cancelled, run) = (self.hold_at_a_checkpoint(array, task) for task in (1, 2))
        os.kill(killed, signal.SIGKILL)
        self.slurm.ask("scancel", f"{array}_2")
        self.wait_until_asked_to_end(run)
        self.let_go(run)
        self.wait_for(array, 1, "FAILED")
        self.wait_for(array, 2, "CANCELLED")
        self.wait_until(lambda: not pathlib.Path(f"/proc/{cancelled}").exists())
        tasks = self.slurm.tasks(array)
        self.assertEqual((tasks[1]["code"], tasks[1]["again"], tasks[2]["again"]), (137, 0, 0))
        array = self.submit()
        self.wait_until(lambda: len(self.slurm.tasks(array)) == 2)
        self.end(array, expected)
        self.assertEqual(len(self.goes_on()), 2)
        self.assert_whole(expected)

    def test_a_case_of_a_lost_node_goes_on_from_its_checkpoint(self):
        self.begin(wheel("120 mm"), ONE)
        expected = self.alone()
        array = self.submit()
        self.hold_at_a_checkpoint(array, 1)
        self.slurm.ask("scontrol", "update", f"NodeName={self.slurm.node}", "State=DOWN", "Reason=lost")
        self.wait_for(array, 1, "PENDING")
        self.slurm.ask("scontrol", "update", f"NodeName={self.slurm.node}", "State=RESUME")
        self.slurm.begin_now(array, 1)
        self.wait_until(lambda: self.slurm.state(array, 1) != "PENDING")
        self.end(array, expected)
        self.assertEqual(self.slurm.tasks(array)[1]["again"], 1)
        self.assertEqual(len(self.goes_on()), 1)
        self.assert_whole(expected)


if __name__ == "__main__":
    if reason := one_machine_slurm.why_not():
        print(f"SKIPPED: {reason}")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
