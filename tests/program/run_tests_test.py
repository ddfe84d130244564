#!/usr/bin/env python3
"""tools/run_tests.py on a folder of four small tests. usage: run_tests_test.py SOURCE_DIR"""
import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
TESTS = """
add_test(room:plain /bin/sh -c "echo fine")
add_test(room:leaves /bin/sh -c "echo x >$TMPDIR/wear_2")
add_test(other:skipped /bin/sh -c "echo 'SKIPPED: no mpirun (Debian: openmpi-bin)'; exit 77")
set_tests_properties(other:skipped PROPERTIES SKIP_RETURN_CODE 77)
add_test(other:suite /bin/sh -c "printf 'a_test.cpp:20: Skipped\\nthere is no card\\n\\n'")
add_test(other:deep /bin/sh -c "echo deep")
set_tests_properties(other:deep PROPERTIES LABELS slow)
add_test(other:hours /bin/sh -c "exit 1")
set_tests_properties(other:hours PROPERTIES LABELS long)
"""


class RunTests(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "CTestTestfile.cmake").write_text(TESTS)
        (self.folder / "CMakeCache.txt").write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={SOURCE}\n")

    def run_tests(self, *words):
        done = subprocess.run([sys.executable, SOURCE / "tools/run_tests.py", self.folder, *words],
                              capture_output=True, text=True)
        return done.returncode, done.stdout, done.stderr

    def test_a_file_left_behind_fails_and_is_named(self):
        rc, out, err = self.run_tests()
        self.assertIn("100% tests passed, 0 tests failed out of 4", out)
        self.assertEqual(rc, 1)
        self.assertIn("wear_2", err)
        self.assertEqual(self.run_tests("-E", "leaves")[0], 0)

    def test_what_is_skipped_is_named_with_its_reason(self):
        _, out, _ = self.run_tests("-E", "leaves")
        self.assertIn("skipped: other:skipped: no mpirun (Debian: openmpi-bin)\n", out)
        self.assertIn("skipped: other:suite: there is no card\n", out)
        self.assertEqual(out.count("\nskipped: "), 2)

    def test_slow_tests_run_apart_and_long_ones_not_at_all(self):
        rc, out, _ = self.run_tests("--slow")
        self.assertEqual(rc, 0, out)
        self.assertIn("other:deep", out)
        self.assertIn("out of 1", out)

    def test_processor_time_is_kept_by_room(self):
        table = self.folder / "cost.csv"
        for _ in range(2):
            rc, out, err = self.run_tests("-E", "leaves", "--costs", table)
            self.assertEqual(rc, 0, err)
            self.assertIn("skipped: other:skipped", out)
        with table.open() as file:
            rows = [(row["tests_of"], row["room"], row["tests"]) for row in csv.DictReader(file)]
        self.assertEqual(rows, [("default", "other", "2"), ("default", "room", "1")])


if __name__ == "__main__":
    unittest.main()
