#!/usr/bin/env python3
"""The wheel and the tarball of an installed build. usage: wheel_test.py BUILD_DIR SOURCE_DIR PREFIX FOLDER GROUP

Wheel: installed by pip into a virtual environment that has numpy and nothing else of Debian's. Tarball: unpacked in a
folder of its own. Both are looked at for what they promise: no symbol newer than Debian 12's, no library that another
Linux may lack.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile

BUILD, SOURCE, PREFIX, FOLDER = (pathlib.Path(word).resolve() for word in sys.argv[1:5])
NO_REMOTE = BUILD / "lib/librailstrata-no-remote.so"
TAG = "py3-none-manylinux_2_36_x86_64"
# PEP 600, and the newest versions of symbols that glibc 2.36 and GCC 12 have
EVERYWHERE = {"libc.so.6", "libm.so.6", "libdl.so.2", "librt.so.1", "libpthread.so.0", "libstdc++.so.6", "libz.so.1",
              "libgcc_s.so.1", "ld-linux-x86-64.so.2"}
NEWEST = {"GLIBC": [2, 36], "GLIBCXX": [3, 4, 30], "CXXABI": [1, 3, 13], "GCC": [12, 0, 0]}
SMALL = {"mesh.element_size": "5 mm", "run.positions": ["40 mm"], "run.run_up": "20 mm"}


def environment():
    """That of this test without what leads to Debian's packages, the build folder or the checkout."""
    leading = ("PYTHON", "LD_", "RAILSTRATA_")
    return {key: value for key, value in os.environ.items() if not key.startswith(leading)}


def done(*words, **options):
    out = subprocess.run([str(w) for w in words], capture_output=True, text=True, timeout=600, env=environment(),
                         **options)
    assert out.returncode == 0, f"{words}: exit code {out.returncode}\n{out.stdout[-3000:]}{out.stderr[-3000:]}"
    return out.stdout


def packed(what):
    file = pathlib.Path(done("/usr/bin/python3", SOURCE / "tools/pack.py", what, PREFIX, FOLDER, "--no-remote",
                             NO_REMOTE, "--native").strip())
    assert file.parent == FOLDER
    return file


def numbers(summary):
    return {key: value for key, value in summary.items() if key != "run"}


class Promises:
    """Of a folder with binaries, `tree`."""

    def binaries(self):
        found = [f for f in self.tree.rglob("*") if f.is_file() and not f.is_symlink()
                 and f.read_bytes()[:4] == b"\x7fELF"]
        self.assertGreater(len(found), 5)
        return found

    def test_no_symbol_is_newer_than_those_of_debian_12(self):
        seen = set()
        for file in self.binaries():
            for name, number in re.findall(r"(GLIBC|GLIBCXX|CXXABI|GCC)_([\d.]+)", done("objdump", "-T", file)):
                self.assertLessEqual([int(n) for n in number.split(".")], NEWEST[name], file)
                seen.add(name)
        self.assertLessEqual({"GLIBC", "GLIBCXX"}, seen)

    def test_every_library_that_is_asked_for_is_inside_or_everywhere(self):
        inside = {f.name for f in self.tree.rglob("*.so*")}
        for file in self.binaries():
            asked = set(re.findall(r"\(NEEDED\).*\[(.*)\]", done("readelf", "-d", file)))
            self.assertLessEqual(asked, inside | EVERYWHERE, file)

    def test_nothing_of_this_machine_is_named(self):
        for file in self.tree.rglob("*"):
            if file.is_file():
                for folder in (SOURCE, BUILD):
                    self.assertNotIn(str(folder).encode(), file.read_bytes(), file)

    def test_the_licence_of_every_library_is_inside(self):
        texts = {f.name for f in next(self.tree.rglob("licenses")).iterdir()}
        self.assertLessEqual({"LICENSE", "explore-page.txt", "libfmt-dev.txt", "libeigen3-dev.txt", "libgomp1.txt",
                              "libaec0.txt", "libtomlplusplus-dev.txt"}, texts)
        self.assertTrue([name for name in texts if name.startswith("libhdf5")], texts)
        self.assertFalse(list(self.tree.rglob("libfftw*")))


class Processors(unittest.TestCase):
    """A prefix of three small libraries, which ask for a processor as those of a build do."""

    def refused(self, marks):
        with tempfile.TemporaryDirectory() as prefix:
            for folder, mark in marks.items():
                library = pathlib.Path(prefix, "lib", folder, "librailstrata.so.1.2.3")
                library.parent.mkdir(parents=True, exist_ok=True)
                done("gcc", "-shared", "-nostdlib", "-x", "c", "/dev/null", "-o", library, *mark)
            out = subprocess.run(["/usr/bin/python3", SOURCE / "tools/pack.py", "wheel", prefix, prefix, "--no-remote",
                                  "none"], capture_output=True, text=True)
            self.assertNotEqual(out.returncode, 0)  # there is nothing else to pack
            return "not built for all processors" in out.stderr

    def test_a_prefix_for_this_machine_is_refused(self):
        of = {level: [f"-Wl,-z,x86-64-{level}"] for level in ("v2", "v3", "v4")}
        every = {"": of["v2"], "glibc-hwcaps/x86-64-v3": of["v3"], "glibc-hwcaps/x86-64-v4": of["v4"]}
        self.assertFalse(self.refused(every))
        self.assertTrue(self.refused({"": []}), "a native build")
        self.assertTrue(self.refused({**every, "": of["v4"]}))
        self.assertTrue(self.refused({**every, "": []}), "a native library over those of an earlier build")
        self.assertTrue(self.refused({"": of["v2"]}), "one of three")


class Wheel(Promises, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        FOLDER.mkdir(parents=True)
        cls.file = packed("wheel")
        cls.tree = FOLDER / "wheel"
        zipfile.ZipFile(cls.file).extractall(cls.tree)
        cls.python = cls.bare_environment(FOLDER / "venv")
        done(cls.python, "-m", "pip", "install", "--no-index", "--no-deps", cls.file)

    @classmethod
    def bare_environment(cls, folder):
        """Python with pip, and Debian's numpy alone."""
        done("/usr/bin/python3", "-m", "venv", folder)
        site = next(folder.glob("lib/python3*/site-packages"))
        (site / "numpy").symlink_to("/usr/lib/python3/dist-packages/numpy")
        return folder / "bin/python"

    def run_python(self, code):
        return done(self.python, "-c", code, cwd=FOLDER)

    def test_name_and_record(self):
        self.assertTrue(self.file.name.endswith(f"-{TAG}.whl"))
        info = next(self.tree.glob("*.dist-info"))
        self.assertIn(f"Tag: {TAG}\n", (info / "WHEEL").read_text())
        listed = {row.rsplit(",", 2)[0] for row in (info / "RECORD").read_text().splitlines()}
        self.assertEqual(listed, {f.relative_to(self.tree).as_posix() for f in self.tree.rglob("*") if f.is_file()})
        self.assertIn("Requires-Python: >=3.9\nRequires-Dist: numpy\n", (info / "METADATA").read_text())

    def test_nothing_of_debians_packages_is_there(self):
        out = self.run_python("import importlib.util as u\nprint([n for n in ('pandas', 'matplotlib', 'h5py', 'xarray')"
                              " if u.find_spec(n)])")
        self.assertEqual(out.strip(), "[]")

    def test_a_solution_and_a_sweep_have_the_numbers_of_the_program(self):
        out = json.loads(self.run_python(
            "import json, railstrata as rs\nrs.threads(1)\ncase = rs.Case('cases/quick')\nr = rs.bem(case, cell=1e-3)\n"
            "t = rs.sweep(case, {'layer.0.thickness': ['1 mm', '2 mm']}, cell=1e-3)\n"
            "print(json.dumps([rs.__file__, r.summary, list(t['p_max_MPa']), float(r.patch.p.max())]))"))
        self.assertTrue(out[0].startswith(str(FOLDER)), out[0])
        done(PREFIX / "bin/railstrata", "bem", "cases/quick", "--cell", "1 mm", "--threads", "1", "--force", "--out",
             FOLDER / "bem", cwd=FOLDER)
        program = json.loads((FOLDER / "bem/summary.json").read_text())
        self.assertEqual(numbers(out[1]), numbers(program))
        self.assertAlmostEqual(out[2][1] * 1e6 / out[1]["contact"]["p_max_Pa"], 1, delta=1e-15)

    def test_a_run_is_stopped_and_goes_on_from_its_checkpoint_to_the_same_bits(self):
        out = self.run_python(
            f"import json, railstrata as rs\ncase = rs.Case('cases/quick', {SMALL!r})\n"
            "whole = rs.run(case, 'whole', force=True)\n"
            "def stop(phase, fraction):\n    if phase == 'rolling' and fraction > 0.2: raise RuntimeError('enough')\n"
            "try: rs.run(case, 'parts', force=True, progress=stop)\nexcept RuntimeError: pass\n"
            "import os\nprint(json.dumps([os.path.exists('parts/checkpoint.h5'), whole.summary,"
            " rs.resume('parts').summary]))")
        kept, whole, parts = json.loads(out)
        self.assertTrue(kept)
        self.assertEqual(numbers(whole), numbers(parts))

    def test_the_secure_sockets_of_python_are_its_own(self):
        """What stands in for OpenSSL behind HDF5 stands in nobody else's way."""
        out = self.run_python("import railstrata as rs\nr = rs.bem('cases/quick', cell=1e-3)\nimport os\n"
                              f"case = rs.Case('cases/quick', {SMALL!r})\nrs.run(case, 'first', force=True)\n"
                              "import ssl, hashlib\nprint(hashlib.sha256(b'abc').hexdigest()[:8], ssl.OPENSSL_VERSION)")
        self.assertRegex(out, r"^ba7816bf OpenSSL 3")


class Tarball(Promises, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        FOLDER.mkdir(parents=True)
        with tarfile.open(packed("tarball")) as packed_file:
            packed_file.extractall(FOLDER / "elsewhere")
        cls.tree = next((FOLDER / "elsewhere").iterdir())

    def test_the_program_runs_with_the_libraries_beside_it(self):
        program = self.tree / "bin/railstrata"
        done(program, "bem", "cases/quick", "--cell", "1 mm", "--threads", "1", "--out", FOLDER / "bem", cwd=FOLDER)
        self.assertGreater((FOLDER / "bem/report.html").stat().st_size, 100000)
        done(PREFIX / "bin/railstrata", "bem", "cases/quick", "--cell", "1 mm", "--threads", "1", "--out",
             FOLDER / "installed", cwd=FOLDER)
        summaries = [json.loads((FOLDER / name / "summary.json").read_text()) for name in ("bem", "installed")]
        self.assertEqual(*map(numbers, summaries))
        for name, place in re.findall(r"^\s*(\S+) => (\S+)", done("ldd", program), re.M):
            self.assertTrue(name in EVERYWHERE or place.startswith(str(self.tree)), f"{name} => {place}")

    def test_a_creep_table_is_written_by_hdf5(self):
        words = ["--axis", "creepage_x=-0.001,0,0.001", "--out", FOLDER / "table"]
        done(self.tree / "bin/railstrata", "creep", "cases/quick", "--cell", "2 mm", *words, cwd=FOLDER)
        self.assertEqual((FOLDER / "table/creep_table.h5").read_bytes()[:4], b"\x89HDF")

    def test_texts_headers_and_examples_are_there(self):
        for name in ("README.txt", "share/doc/railstrata/library.md", "share/man/man1/railstrata.1.gz",
                     "include/railstrata/railstrata.h", "share/railstrata/examples/mine.c",
                     "share/railstrata/cases/quick/case.toml"):
            self.assertTrue((self.tree / name).is_file(), name)
        self.assertFalse(list(self.tree.rglob("*.py[co]")) + list(self.tree.rglob("python3*")))


if __name__ == "__main__":
    if not shutil.which("patchelf"):
        print("patchelf is missing (Debian: patchelf): nothing was packed")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[5:]])
