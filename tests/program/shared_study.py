"""A study whose folder several processes share, beside the same one computed by one process alone."""
import csv
import os
import pathlib
import re
import signal
import time

from outside import SMALL, FromOutside, railstrata, results

ONE = '[study]\nbase = "case.toml"\nengines = ["fem"]\n[[group]]\nname = "wheel"\n'


def wheel(length):
    """A case by finite elements that rolls so far."""
    return SMALL.replace('["6 mm", "12 mm"]', f'["{length}"]')


class SharedStudy(FromOutside):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def begin(self, base, text):
        self.case(base)
        self.file = self.folder / "study.toml"
        self.file.write_text(text)

    def words(self, out, *words):
        return ["study", self.file, "--out", out, "--no-report", "--threads", "1", *words]

    def alone(self):
        out = self.folder / "alone"
        self.rc, _, err = railstrata(*self.words(out))
        self.assertIn(self.rc, (0, 1), err)  # a check of so coarse a rolling may fail
        return self.results_of(out)

    def results_of(self, out):
        return {str(file.parent.relative_to(out)): results(file.parent) for file in out.rglob("study.json")
                if ".part-" not in str(file)}

    def assert_whole(self, expected):
        found = self.results_of(self.out)
        self.assertEqual({case: sorted(files) for case, files in found.items()},
                         {case: sorted(files) for case, files in expected.items()})
        for case, files in expected.items():
            for name, content in files.items():
                self.assertTrue(found[case][name] == content, f"{case}/{name}")
        self.assertEqual([str(f) for f in self.out.rglob("*") if ".part-" in f.name or ".claim" in f.name], [])
        lines = [line for line in (self.out / "study.csv").read_text().splitlines() if not line.startswith("#")]
        self.assertEqual({row["state"] for row in csv.DictReader(lines)}, {"done"})

    def goes_on(self):
        return [log for log in self.out.rglob("log.txt") if "goes on in" in log.read_text()]

    def hold(self, study):
        """The run that this process of a study has started stops where it is; its number. Without it the run may end
        before what the test does next arrives, which takes Slurm seconds on a busy machine."""
        run, = map(int, pathlib.Path(f"/proc/{study}/task/{study}/children").read_text().split())
        os.kill(run, signal.SIGSTOP)
        self.addCleanup(self.let_go, run)
        return run

    def let_go(self, run):
        try:
            os.kill(run, signal.SIGCONT)
        except ProcessLookupError:
            pass  # it was ended

    def wait_until_asked_to_end(self, run):
        """A SIGTERM waits for the run that is held, or another call has released or ended it."""
        def asked():
            try:
                status = pathlib.Path(f"/proc/{run}/status").read_text()
            except OSError:
                return True
            waiting = re.findall(r"^(?:Shd|Sig)Pnd:\s*(\w+)", status, re.MULTILINE)
            return "T (stopped)" not in status or any(int(w, 16) >> (signal.SIGTERM - 1) & 1 for w in waiting)

        self.wait_until(asked)

    def wait_until(self, condition, why_in_vain=lambda: "", seconds=120):
        """why_in_vain: the reason why the condition can come no more; nothing while it can."""
        end = time.monotonic() + seconds
        while not condition():
            if (why := why_in_vain()) or time.monotonic() > end:
                self.fail(f"waited in vain: {why or f'{seconds} s'}")
            time.sleep(0.01)
