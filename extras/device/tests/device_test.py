#!/usr/bin/env python3
"""run.device from outside: refused before any work where there is no card; stopped and resumed on the emulated one.
usage: device_test.py BINARY"""
import csv
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[3] / "tests" / "program"))
from outside import BINARY, SMALL, FromOutside, main, railstrata, rows, start, wait_for

MPIRUN = shutil.which("mpirun")
WORDS = ["--no-report", "--threads", "1"]
ON_CARD = SMALL.replace("[run]\n", '[run]\ndevice = "gpu"\n')
LINE = ON_CARD[:ON_CARD.index("device =")].count("\n") + 1
STUDY = '[study]\nbase = "case.toml"\nengines = ["fem"]\n[[group]]\nname = "g"\n'


def has_card():
    rc, out, _ = railstrata("check", "/dev/stdin", "--json", input=ON_CARD)
    assert rc == 0
    return "not_here" not in json.loads(out)


def history(folder):
    with (folder / "history.csv").open() as stream:
        return list(csv.DictReader(line for line in stream if not line.startswith("#")))


class WithoutACard(FromOutside):
    def setUp(self):
        super().setUp()
        if has_card():
            self.skipTest("there is a card here")
        self.out = self.folder / "out"
        self.place = f"{self.case(ON_CARD)}:{LINE}:10: run.device: "

    def said(self, err, place):
        self.assertIn(place, err)
        self.assertRegex(err, "run.device: (no card was found|this program was built without CUDA)")
        self.assertIn('remedy: run.device = "cpu"', err)
        for phase in ("meshing", "static preload", "results go to"):
            self.assertNotIn(phase, err)
        self.assertFalse(self.out.exists())

    def refused_here(self, *words, place=None):
        rc, _, err = railstrata(*words, *WORDS)
        self.assertEqual(rc, 4, err)
        self.said(err, place or self.place)

    def test_run_is_refused_before_any_work(self):
        self.refused_here("run", self.folder / "case.toml", "--out", self.out)
        self.refused_here("run", self.case(SMALL), "--set", "run.device=gpu", "--out", self.out,
                          place="--set run.device=gpu: run.device: ")

    def test_a_study_is_refused_and_no_case_fails(self):
        (self.folder / "study.toml").write_text(STUDY)
        self.refused_here("study", self.folder / "study.toml", "--out", self.out)
        rc, out, err = railstrata("study", self.folder / "study.toml", "--out", self.out, "--list")
        self.assertEqual(rc, 0, err)  # for machines that have one

    def test_a_run_that_is_to_go_on_is_refused_and_stays_as_it_is(self):
        process = start("run", self.case(SMALL), *WORDS, "--out", self.out)
        wait_for(lambda: rows(self.out) > 5, process)
        process.send_signal(signal.SIGTERM)
        process.communicate()
        file = self.out / "case.toml"
        file.write_text(file.read_text().replace('device = "cpu"', 'device = "gpu"'))
        before = (self.out / "checkpoint.h5").read_bytes()
        rc, _, err = railstrata("run", "--resume", self.out, *WORDS)
        self.assertEqual(rc, 4, err)
        self.assertRegex(err, rf"{file}:\d+:10: run.device: ")
        self.assertEqual((self.out / "checkpoint.h5").read_bytes(), before)

    def test_info_says_why_there_is_none(self):
        rc, out, err = railstrata("info", "--json")
        self.assertEqual(rc, 0, err)
        self.assertRegex(json.loads(out)["card"], "^none: (no card was found|this program was built without CUDA)")

    def test_check_says_so(self):
        rc, out, err = railstrata("check", self.folder / "case.toml")
        self.assertEqual(rc, 0, err)
        self.assertIn(f"not here       {self.place}", out)
        self.assertIn('remedy: run.device = "cpu"', out)
        rc, out, _ = railstrata("check", self.case(SMALL))
        self.assertEqual(rc, 0)
        self.assertNotIn("not here", out)


class Refused(FromOutside):
    def test_passes_by_finite_elements_and_several_ranks_are_in_words(self):
        out = self.folder / "out"
        case = self.case(ON_CARD)
        self.refused(2, ["passes", case, "--engine", "fem", "--out", out], f"{case}:{LINE}:10: ",
                     'run.device = "gpu" cannot be combined with run.plasticity = true')
        if MPIRUN is None or not (BINARY.parent / "railstrata_mpi.so").exists():
            return
        quiet = {"OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_btl_base_warn_component_unused": "0",
                 "OMP_WAIT_POLICY": "passive", "OMPI_MCA_btl": "vader,self"}
        done = subprocess.run([MPIRUN, "--oversubscribe", "--allow-run-as-root", "-n", "2", BINARY, "run", case, *WORDS,
                               "--out", out], capture_output=True, text=True, timeout=300, env=os.environ | quiet)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(f'{case}:{LINE}:10: error: run.device = "gpu" is not supported by several ranks', done.stderr)
        self.assertIn('remedy: start one rank, or give run.device = "cpu"', done.stderr)
        self.assertNotIn("meshing", done.stderr)
        self.assertFalse(out.exists())

    def test_half_spaces_say_that_it_has_no_effect(self):
        case = self.case(ON_CARD)
        for words in (["bem"], ["sweep", "--vary", "drive.friction_coefficient=0.3"]):
            rc, _, err = railstrata(words[0], case, *words[1:], "--cell", "1 mm", "--no-report", "--out",
                                    self.folder / words[0])
            self.assertIn(rc, (0, 1), err)
            self.assertIn("run.device = \"gpu\" has no effect on half-spaces", err)


class Emulated(FromOutside):
    """Stopped on a device, on on the processor, and back."""

    def sit(self, device, row, how):
        """Goes on (or begins) on `device` up to a row of the history; False if the run was over before it was asked."""
        if self.out.exists():
            file = self.out / "case.toml"
            text = file.read_text()
            other = next(d for d in ("cpu", "gpu") if f'device = "{d}"' in text)
            file.write_text(text.replace(f'device = "{other}"', f'device = "{device}"'))
            words = ["run", "--resume", self.out]
        else:
            words = ["run", self.case(ON_CARD if device == "gpu" else SMALL), "--out", self.out]
        if row is None:
            rc, _, err = railstrata(*words, *WORDS)
            self.assertIn(rc, (0, 1), err)
            return False
        process = start(*words, *WORDS, "--checkpoint-every", "0.05 s")
        wait_for(lambda: process.poll() is not None or rows(self.out) >= row and (self.out / "checkpoint.h5").exists(),
                 process)
        process.send_signal(how)
        err = process.communicate()[1]
        if process.returncode in (0, 1):
            return False
        if how != signal.SIGKILL:
            self.assertEqual(process.returncode, 130, err)
            self.assertIn(f"go on with\n    railstrata run --resume {self.out}\n", err)
        return True

    def test_interrupted_and_killed_runs_go_on_by_the_other(self):
        os.environ["RAILSTRATA_EMULATED_DEVICE"] = "1"
        self.addCleanup(os.environ.pop, "RAILSTRATA_EMULATED_DEVICE")
        self.out = self.folder / "whole"
        self.sit("cpu", None, None)
        whole = history(self.out)
        self.out = self.folder / "out"
        n = len(whole)
        sittings = [("gpu", n // 5, signal.SIGINT), ("cpu", 2 * n // 5, signal.SIGKILL),
                    ("gpu", 3 * n // 5, signal.SIGKILL), ("gpu", 4 * n // 5, signal.SIGTERM),
                    ("cpu", None, None)]
        all(self.sit(*sitting) for sitting in sittings)
        here = history(self.out)
        self.assertEqual(len(here), n)
        name = next(k for k in whole[0] if k.startswith("p_max"))
        largest = max(float(r[name]) for r in whole)
        worst = max(abs(float(a[name]) - float(b[name])) for a, b in zip(whole, here))
        self.assertLess(worst, 1e-9 * largest)


if __name__ == "__main__":
    main()
