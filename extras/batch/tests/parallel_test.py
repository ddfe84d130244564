#!/usr/bin/env python3
"""The recipes of docs/study.md for GNU parallel. usage: parallel_test.py BINARY FAULT_INJECTOR SOURCE_DIR

What ssh would reach are processes here that see another host name, by the library of fault_injector.c."""
import csv
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[3] / "tests" / "program"))
from outside import BINARY
from shared_study import ONE, SharedStudy, wheel

INJECTOR, SOURCE = (pathlib.Path(word).resolve() for word in sys.argv[2:4])
WHEELS = f"""{ONE}[group.vary]
"drive.traction_coefficient" = [0.1, 0.15, 0.2]
"""
SSH = """#!/bin/sh
host=$1
shift 2  # and --
export LD_PRELOAD={injector} ASAN_OPTIONS=verify_asan_link_order=0 RAILSTRATA_HOST=$host
exec sh -c "$*"
"""


def recipes():
    """The lines of the page's blocks that name it."""
    blocks = re.findall(r"```sh\n(.*?)```", (SOURCE / "docs/study.md").read_text(), re.DOTALL)
    return [block for block in blocks if re.search("(^| )parallel ", block, re.MULTILINE)]


class Parallel(SharedStudy):
    def setUp(self):
        super().setUp()
        (self.folder / "railstrata").symlink_to(BINARY)
        (self.folder / "ssh").write_text(SSH.format(injector=INJECTOR))
        (self.folder / "ssh").chmod(0o755)
        self.environment = {**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}", "HOME": str(self.folder),
                            "PARALLEL_SSH": str(self.folder / "ssh")}

    def begin_recipe(self, recipe):
        """As on the page, for this study."""
        for said, ours in (("cases/paper/study.toml", self.file), ("/shared/study.toml", self.file),
                           ("/shared/study", self.out)):
            recipe = recipe.replace(said, str(ours))
        process = subprocess.Popen(["sh", "-ec", recipe], cwd=self.folder, env=self.environment, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
        self.addCleanup(process.communicate)
        self.addCleanup(lambda: process.poll() is None and os.killpg(process.pid, signal.SIGKILL))
        return process

    def end(self, process, code):
        out, err = process.communicate(timeout=300)
        self.assertEqual(process.returncode, code, out + err)
        return err

    def test_several_machines_share_a_study(self):
        self.begin(wheel("24 mm"), WHEELS)
        expected = self.alone()
        recipe = recipes()[0]
        nodes = re.search("--sshlogin (\\S+)", recipe)[1].split(",")
        err = self.end(self.begin_recipe(recipe), self.rc * len(nodes))
        self.assert_whole(expected)
        self.assertEqual(len(re.findall(r"\d/\d  wheel.*: ", err)), 3, err)

    def test_a_killed_case_goes_on_when_the_failed_are_repeated(self):
        self.begin(wheel("60 mm"), WHEELS)
        expected = self.alone()
        process = self.begin_recipe(recipes()[1])
        self.wait_until(lambda: list(self.out.rglob("fem.part-*/history.csv")), seconds=60)
        folder = next(self.out.rglob("fem.part-*/history.csv")).parent
        victim = json.loads((folder.parent / "fem.claim").read_text())["process"]
        os.kill(victim, signal.SIGUSR1)
        self.wait_until((folder / "checkpoint.h5").exists, seconds=60)
        self.hold(victim)
        os.kill(victim, signal.SIGKILL)
        failed = 3 if self.rc else 1  # a failed check is reported too
        self.end(process, failed)
        with (self.folder / "log").open() as log:
            tasks = list(csv.DictReader(log, delimiter="\t"))
        ends = [(int(t["Exitval"]), int(t["Signal"])) for t in tasks]
        self.assertEqual(sum(end in ((137, 0), (0, 9)) for end in ends), 1, ends)  # by a shell or without one
        again = recipes()[1].splitlines()[-1]
        self.end(self.begin_recipe(again), failed - (self.rc == 0))
        self.assertEqual(len(self.goes_on()), 1)
        self.assert_whole(expected)


if __name__ == "__main__":
    for program in ("parallel", "jq"):
        if not shutil.which(program):
            print(f"SKIPPED: no {program} (Debian package {program})")
            sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
