#!/usr/bin/env python3
"""cmake/optional_parts.cmake: MPI that is not there, half there, there, and came later. usage: ... SOURCE"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1]).resolve()
SCRIPT = """cmake_minimum_required(VERSION 3.25)
include({source}/cmake/optional_parts.cmake)
railstrata_probe_mpi({folder} missing)
message("answer: [${{missing}}]")
"""


class Mpi(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "tools").mkdir()
        self.script = self.folder / "probe.cmake"
        self.script.write_text(SCRIPT.format(source=SOURCE, folder=self.folder))

    def answer(self):
        cmake = subprocess.run(["which", "cmake"], capture_output=True, text=True, check=True).stdout.strip()
        out = subprocess.run([cmake, "-P", self.script], capture_output=True, text=True, cwd=self.folder,
                             env={**os.environ, "PATH": str(self.folder / "tools")})
        self.assertEqual(out.returncode, 0, out.stderr)
        return out.stderr.split("answer: [")[1].split("]")[0]

    def compiler(self, script):
        file = self.folder / "tools/mpicc"
        file.write_text(f"#!/bin/sh\n{script}\n")
        file.chmod(0o755)

    def test_without_a_compiler_it_says_what_to_install(self):
        self.assertEqual(self.answer(), "not there: apt-get install libopenmpi-dev openmpi-bin")

    def test_a_compiler_without_headers_is_half_there_and_one_that_comes_later_is_taken(self):
        self.compiler("exit 1")
        self.assertRegex(self.answer(), "^half there: .*mpicc cannot compile a program with mpi.h .*libopenmpi-dev")
        self.compiler("exit 0")
        self.assertEqual(self.answer(), "")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
