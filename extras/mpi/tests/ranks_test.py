#!/usr/bin/env python3
"""One run over MPI: the bits of one process, by any number of ranks. usage: ranks_test.py BINARY [--slow]"""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[3] / "tests" / "program"))
from outside import BINARY, SMALL, FromOutside, fact, main, railstrata, results, rows, slow, wait_for

MPIRUN = shutil.which("mpirun")
PLUG_IN = BINARY.parent / "railstrata_mpi.so"
WORDS = ["--no-report"]
YAWED = ["--set", "geometry.yaw=\"3 mrad\""]
# A thin layer, whose rows get added mass; with YAWED of a yawed wheel.
LAYERED = SMALL + '\n[[layer]]\nthickness = "1 mm"\nwidth = "16 mm"\nyoung_ratio = 2.0\n'


def ranked(count, *words, **options):
    quiet = {"OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_btl_base_warn_component_unused": "0",
             "OMP_WAIT_POLICY": "passive", "OMPI_MCA_btl": "vader,self"}
    return subprocess.Popen([MPIRUN, "--oversubscribe", "--allow-run-as-root", "-n", str(count), BINARY,
                             *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            env=os.environ | quiet, **options)


def finished(process):
    out, err = process.communicate(timeout=500)
    return process.returncode, out, err


def process_of(mpirun, rank):
    """The process of a rank of this mpirun."""
    wanted = f"OMPI_COMM_WORLD_RANK={rank}".encode()
    end = time.monotonic() + 60
    while time.monotonic() < end:
        for entry in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                parent = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
                if parent == mpirun.pid and wanted in (entry / "environ").read_bytes().split(b"\0"):
                    return int(entry.name)
            except OSError:
                continue
        time.sleep(0.01)
    raise AssertionError(f"no process of rank {rank}")


@slow
class Ranks(FromOutside):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.whole = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        (cls.whole / "case.toml").write_text(SMALL)
        rc, _, err = railstrata("run", cls.whole / "case.toml", *WORDS, "-j", 1, "--out", cls.whole / "out")
        assert rc in (0, 1), err
        cls.rc, cls.reference, cls.rows = rc, results(cls.whole / "out"), rows(cls.whole / "out")

    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def expect_same(self, folder, reference=None):
        reference = reference or self.reference
        found = results(folder)
        self.assertEqual(sorted(found), sorted(reference))
        for name, content in reference.items():
            self.assertTrue(found[name] == content, name)

    def expect_bits_of_one(self, count, threads):
        out = self.folder / f"{count}-{threads}"
        rc, _, err = finished(ranked(count, "run", self.case(SMALL), *WORDS, "-j", threads, "--out", out))
        self.assertEqual(rc, self.rc, err)
        self.expect_same(out)
        self.assertEqual(err.count("static preload"), 1, err)  # one rank reports

    def test_two_ranks_give_the_bits_of_one(self):
        self.expect_bits_of_one(2, 1)

    def test_any_number_of_ranks_and_threads_gives_the_bits_of_one(self):
        for count, threads in ((2, 2), (3, 1), (4, 1)):
            self.expect_bits_of_one(count, threads)
        fact("ranks give the bits of one", ranks="2, 3, 4", files=len(self.reference))

    def test_with_a_layer_and_a_yawed_wheel_too(self):
        case = self.case(LAYERED)
        rc, _, err = railstrata("run", case, *WORDS, *YAWED, "-j", 1, "--out", self.folder / "one")
        self.assertIn(rc, (0, 1), err)
        found, _, err = finished(ranked(3, "run", case, *WORDS, *YAWED, "-j", 1, "--out", self.out))
        self.assertEqual(found, rc, err)
        self.expect_same(self.out, results(self.folder / "one"))

    def stop_at(self, process, row):
        wait_for(lambda: rows(self.out) >= row, process)
        os.kill(process_of(process, 0), signal.SIGTERM)
        return finished(process)

    def test_stopped_it_goes_on_with_another_number_of_ranks(self):
        words = [*WORDS, "-j", 1]
        rc, _, err = self.stop_at(ranked(2, "run", self.case(SMALL), *words, "--out", self.out), self.rows // 4)
        self.assertEqual(rc, 130, err)
        self.assertIn(f"go on with\n    railstrata run --resume {self.out}\n", err)
        rc, _, err = self.stop_at(ranked(3, "run", "--resume", self.out, *words), 2 * self.rows // 3)
        self.assertEqual(rc, 130, err)
        rc, _, err = railstrata("run", "--resume", self.out, *words)
        self.assertEqual(rc, self.rc, err)
        self.expect_same(self.out)

    def test_where_a_rank_is_lost_the_others_end_and_the_checkpoint_stands(self):
        words = [*WORDS, "-j", 1]
        process = ranked(3, "run", self.case(SMALL), *words, "--out", self.out, "--checkpoint-every", "0.2 s")
        wait_for((self.out / "checkpoint.h5").exists, process)
        lost = process_of(process, 1)
        os.kill(lost, signal.SIGKILL)
        begun = time.monotonic()
        rc, _, err = finished(process)
        self.assertNotIn(rc, (0, 1), err)
        self.assertLess(time.monotonic() - begun, 60)
        self.assertIn(f"rank 1 (process {lost}) has ended before the others", err)
        self.assertIn("checkpoints stay as they are", err)
        self.assertTrue((self.out / "checkpoint.h5").exists())
        rc, _, err = railstrata("run", "--resume", self.out, *words)
        self.assertEqual(rc, self.rc, err)
        self.expect_same(self.out)

    def test_where_a_rank_is_lost_before_the_rolling_the_others_end_too(self):
        process = ranked(3, "run", self.case(SMALL), *WORDS, "-j", 1, "--out", self.out)
        wait_for((self.out / "provenance.json").exists, process)  # all have joined by then
        lost = process_of(process, 2)
        os.kill(lost, signal.SIGKILL)
        rc, _, err = finished(process)
        self.assertNotIn(rc, (0, 1), err)
        self.assertIn(f"rank 2 (process {lost}) has ended before the others", err)
        self.assertFalse((self.out / "checkpoint.h5").exists())

    def test_a_mistake_is_told_once(self):
        wrong = self.case(SMALL.replace("[run]", "[run]\nwindwo = 1"))
        rc, _, err = finished(ranked(2, "run", wrong, "--out", self.out))
        self.assertEqual(rc, 2, err)
        self.assertEqual(err.count("did you mean"), 1, err)
        for words in (["--threads", "0"], ["--max-time", "soon"], ["--wrong"]):
            rc, _, err = finished(ranked(2, "run", self.case(SMALL), *words, "--out", self.out))
            self.assertEqual(rc, 2, err)
            self.assertEqual(err.count("error: "), 1, err)
        self.assertFalse(self.out.exists())

    def test_commands_that_share_no_work_are_refused(self):
        for command in ("bem", "check", "passes"):
            rc, _, err = finished(ranked(2, command, self.case(SMALL), "--out", self.out))
            self.assertEqual(rc, 2, err)
            self.assertEqual(err.count(f"error: {command} was started as several ranks, and shares no work"), 1, err)
            self.assertIn("remedy: start it without mpirun", err)
            self.assertFalse(self.out.exists())


class WithoutMpi(FromOutside):
    def test_the_program_does_not_link_mpi(self):
        done = subprocess.run(["ldd", BINARY], capture_output=True, text=True, check=True)
        self.assertNotIn("libmpi", done.stdout)

    def test_without_its_plug_in_it_says_so(self):
        alone = shutil.copy(BINARY, self.folder)
        done = subprocess.run([alone, "run", self.case(SMALL), "--out", self.folder / "out"], capture_output=True,
                              text=True, env=os.environ | {"OMPI_COMM_WORLD_SIZE": "2"})
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("started as one of several ranks, but its plug-in for MPI is not here", done.stderr)
        self.assertIn("libopenmpi-dev", done.stderr)


if __name__ == "__main__":
    if MPIRUN is None or not PLUG_IN.exists():
        print("SKIPPED: no mpirun, or the program was built without MPI (Debian: libopenmpi-dev openmpi-bin)")
        sys.exit(77)
    main()
