#!/usr/bin/env python3
"""What is passed on for Windows, run by wine, with the numbers of Linux.

usage: windows_test.py build SOURCE FOLDER       makes FOLDER/*-win64.zip by `./railstrata windows`, and the program for
                                                 Linux and the same processors
       windows_test.py run SOURCE FOLDER LIBRARY CONTACT [unittest...]

LIBRARY and CONTACT are those of Linux. Ends with 77 where mingw-w64 or wine is missing."""
import csv
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile

WHAT, SOURCE, FOLDER = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1)).resolve(), pathlib.Path(sys.argv.pop(1)).resolve()
COMPILER = "x86_64-w64-mingw32-gcc-posix"
WINE = shutil.which("wine64") or shutil.which("wine")
ALLOWED = 1e-12
RESIDUALS = ("balance", "error")  # of equations that are solved, as shares: compared with one
# What a result says of the machine and the time, not of the contact.
OF_THE_MACHINE = ("wall", "memory", "threads", "cores", "seconds", "program", "commit", "time", "file", "folder")

if not shutil.which(COMPILER) or not WINE:
    print(f"skipped: {'wine' if shutil.which(COMPILER) else COMPILER} is not there")
    sys.exit(77)
LINUX = FOLDER / "linux"
PROGRAM = LINUX / "railstrata-bin"
if WHAT == "build":
    shutil.rmtree(FOLDER, ignore_errors=True)
    subprocess.run([SOURCE / "railstrata", "windows", FOLDER], check=True)
    options = ("NATIVE=OFF", "TESTS=OFF", "LIBRARY=OFF", "MPI=OFF", "CUDA=OFF", "FFT=kiss")
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    subprocess.run(["cmake", "-S", SOURCE, "-B", LINUX, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", *launcher,
                    *(f"-DRAILSTRATA_{option}" for option in options)], check=True, stdout=subprocess.DEVNULL)
    sys.exit(subprocess.run(["cmake", "--build", LINUX, "--target", "railstrata"], check=False,
                            stdout=subprocess.DEVNULL).returncode)

LIBRARY, CONTACT = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
# The environment of wine: no messages of its own, nothing in the home folder.
# Its server, which outlives the programs, keeps a folder of its own.
ENVIRONMENT = {**os.environ, "WINEPREFIX": str(FOLDER.resolve() / "prefix"), "TMPDIR": str(FOLDER.resolve()),
               "WINEDEBUG": "-all", "LC_ALL": "C.UTF-8"}


def setUpModule():
    """The .zip unpacked, in a folder with a blank and a letter that is not ASCII in its name."""
    global HERE, WINDOWS
    HERE = tempfile.TemporaryDirectory()
    archive, = FOLDER.glob("*-win64.zip")
    place = pathlib.Path(HERE.name) / "Rad und Schiene für alle"
    with zipfile.ZipFile(archive) as files:
        files.extractall(place)
    WINDOWS = place / archive.stem


def tearDownModule():
    HERE.cleanup()


def wine(*words, **options):
    done = subprocess.run([WINE, *map(str, words)], capture_output=True, timeout=600, env=ENVIRONMENT, check=False,
                          **options)
    texts = (text.decode(errors="replace") for text in (done.stdout, done.stderr))
    return done.returncode, *(text.replace("\r\n", "\n") for text in texts)


def unit(name):
    return name.rpartition("_")[2]


def sizes(result, name="", found=None):
    """unit -> the largest number of that unit in a result, or a table."""
    found = {} if found is None else found
    if isinstance(result, dict):
        for key, value in result.items():
            sizes(value, key, found)
    elif isinstance(result, list):
        for value in result:
            sizes(value, name, found)
    elif isinstance(result, float) and math.isfinite(result):
        found[unit(name)] = max(found.get(unit(name), 0.0), abs(result))
    return found


def far_apart(a, b, largest, where=""):
    """Places at which two results differ by more than is allowed of the largest number of the same unit."""
    if isinstance(a, dict) and isinstance(b, dict):
        if list(a) != list(b):
            return [f"{where}: {set(a) ^ set(b)}"]
        return [w for k in a if not any(word in k for word in OF_THE_MACHINE)
                for w in far_apart(a[k], b[k], largest, f"{where}/{k}")]
    if isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        return [w for u, v in zip(a, b) for w in far_apart(u, v, largest, where)]
    if isinstance(a, float) and isinstance(b, float):
        name = where.rpartition("/")[2]
        if abs(a - b) <= ALLOWED * (1 if name in RESIDUALS else largest[unit(name)]):
            return []
    return [] if a == b else [f"{where}: {a!r} {b!r}"]


def columns(file):
    """Name -> values of a table; what is no number stays a text."""
    lines = [line for line in file.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    out = {}
    for row in csv.DictReader(lines):
        for name, text in row.items():
            try:
                out.setdefault(name, []).append(float(text))
            except ValueError:
                out.setdefault(name, []).append(text)
    return out


class Program(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)
        self.folder = pathlib.Path(self.place.name)

    def windows(self, *words, **options):
        return wine(WINDOWS / "railstrata.exe", *words, cwd=self.folder, **options)

    def compared(self, *words):
        """The folders that both programs have written, with the same names of files and the same numbers."""
        done = subprocess.run([PROGRAM, *words, "--out", "linux"], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, "RAILSTRATA_DATA": str(SOURCE)}, check=False)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        code, _, errors = self.windows(*words, "--out", "windows")
        self.assertEqual(code, done.returncode, errors)
        ours, theirs = self.folder / "windows", self.folder / "linux"
        names = sorted(str(p.relative_to(theirs)) for p in theirs.rglob("*") if p.is_file())
        self.assertEqual(sorted(str(p.relative_to(ours)) for p in ours.rglob("*") if p.is_file()), names)
        for name in names:
            if name.endswith(".csv"):
                read = [columns(folder / name) for folder in (theirs, ours)]
                self.assertEqual(far_apart(*read, sizes(read[0]), name), [])
            if name.endswith(".json") and name != "provenance.json":
                read = [json.loads((folder / name).read_text(encoding="utf-8")) for folder in (theirs, ours)]
                self.assertEqual(far_apart(*read, sizes(read[0]), name), [])
        return ours

    def test_bem_has_the_numbers_of_linux(self):
        self.compared("bem", "cases/quick")

    def test_a_sphere_has_the_numbers_of_linux(self):
        self.compared("bem", "cases/verification/hertz_sphere.toml")

    def test_shakedown_has_the_numbers_of_linux(self):
        self.compared("bem", "cases/quick", "--maps", "--set", 'material.rail.yield_strength="480 MPa"', "--cell",
                      "0.5 mm")

    def test_passes_have_the_numbers_of_linux(self):
        self.compared("passes", "cases/plastic/r260.toml", "--cell", "1 mm", "--passes", "3")

    def test_a_sweep_has_the_numbers_of_linux(self):
        self.compared("sweep", "cases/quick", "--vary", "drive.traction_coefficient=0.1,0.2", "--cell", "0.5 mm")

    def test_explore_writes_the_page_of_linux(self):
        code, _, errors = self.windows("explore", "cases/quick", "--out", "page.html")
        self.assertEqual(code, 0, errors)
        subprocess.run([PROGRAM, "explore", "cases/quick", "--out", "linux.html"], cwd=self.folder, check=True,
                       capture_output=True, env={**os.environ, "RAILSTRATA_DATA": str(SOURCE)})
        self.assertEqual(*(len((self.folder / name).read_text(encoding="utf-8").splitlines())
                           for name in ("page.html", "linux.html")))

    def test_a_case_with_lines_of_windows_in_a_folder_with_a_letter_and_a_blank(self):
        case = self.folder / "Fälle für uns" / "fall eins.toml"
        case.parent.mkdir()
        case.write_bytes((SOURCE / "cases/quick/case.toml").read_bytes().replace(b"\n", b"\r\n"))
        code, out, errors = self.windows("bem", "Fälle für uns\\fall eins.toml", "--cell", "0.5 mm", "--json", "--out",
                                         "Ergebnis für uns")
        self.assertEqual(code, 0, errors)
        self.assertIn("contact", json.loads(out))
        self.assertTrue((self.folder / "Ergebnis für uns" / "summary.json").exists())
        code, _, errors = self.windows("bem", "Fälle für uns\\fall eins.toml", "--out", "Ergebnis für uns")
        self.assertEqual(code, 2)
        self.assertIn("the output folder Ergebnis für uns is not empty", errors)

    def test_a_mistake_is_told_with_its_place_and_a_remedy(self):
        code, _, errors = self.windows("bem", "cases/quick", "--set", 'drive.traction_coeficient=0.1')
        self.assertEqual(code, 2)
        self.assertIn("traction_coefficient", errors)
        code, _, errors = self.windows("bme", "cases/quick")
        self.assertEqual(code, 2)
        self.assertIn("did you mean bem?", errors)

    def test_what_is_not_offered_is_said_in_a_sentence(self):
        for words, said in ((("study", "cases/paper/study.toml"), "study runs every case in a process of its own"),
                            (("creep", "cases/quick", "--axis", "creepage_x=+-0.02:3"), "no HDF5")):
            with self.subTest(words[0]):
                code, _, errors = self.windows(*words, "--out", "nothing")
                self.assertEqual(code, 4)
                self.assertIn(said, errors)
                self.assertIn("remedy: ", errors)
                self.assertFalse((self.folder / "nothing").exists())

    def test_cmd_runs_it_and_gets_its_exit_code(self):
        shutil.copytree(WINDOWS / "cases" / "quick", self.folder / "quick")
        script = self.folder / "run.bat"
        script.write_text('@%1 check quick\r\n@if errorlevel 1 exit 9\r\n@exit 7\r\n')
        code, _, errors = wine("cmd", "/c", "run.bat", f"Z:{WINDOWS}\\railstrata.exe".replace("/", "\\"),
                               cwd=self.folder)
        self.assertEqual(code, 7, errors)

    def test_a_second_program_is_kept_out_of_the_folder_of_the_first(self):
        first = subprocess.Popen([WINE, WINDOWS / "railstrata.exe", "passes", "cases/plastic/r260.toml", "--cell",
                                  "1 mm", "--passes", "500", "--out", "results"], cwd=self.folder, env=ENVIRONMENT,
                                 stderr=subprocess.PIPE)
        try:
            end = time.monotonic() + 120
            while not (self.folder / "results" / "case.toml").exists():
                self.assertLess(time.monotonic(), end, "the first one has not begun")
                time.sleep(0.05)
            code, _, errors = self.windows("bem", "cases/quick", "--force", "--out", "results")
            self.assertEqual(code, 2)
            self.assertIn("another railstrata is writing into results", errors)
        finally:
            first.kill()
            first.communicate()


class Library(unittest.TestCase):
    def test_a_program_in_c_has_the_numbers_of_linux(self):
        with tempfile.TemporaryDirectory() as place:
            mine, case = WINDOWS / "examples" / "mine.c", SOURCE / "cases/quick/case.toml"
            include = ["-I", WINDOWS / "include"]
            subprocess.run([COMPILER, "-std=c89", mine, *include, WINDOWS / "railstrata.lib", "-o",
                            f"{place}/mine.exe"], check=True)
            subprocess.run(["gcc", "-std=c89", mine, *include, LIBRARY, f"-Wl,-rpath,{LIBRARY.parent}", "-lm", "-o",
                            f"{place}/mine"], check=True)
            shutil.copy(WINDOWS / "railstrata.dll", place)
            code, out, errors = wine(f"{place}/mine.exe", case)
            self.assertEqual(code, 0, out + errors)
            linux = subprocess.run([f"{place}/mine", case], check=True, capture_output=True, text=True).stdout
            for ours, theirs in zip(out.split(), linux.split(), strict=True):  # printed with 13 digits
                self.assertLessEqual(abs(float(ours) - float(theirs)), 1.01 * ALLOWED * abs(float(theirs)))


class Contact(unittest.TestCase):
    def set_ups(self):
        """The rows of half_space.csv up to 0.5 mm, as extras/cntc/tests/contact_test.py sets them up."""
        with open(SOURCE / "tests/data/reference/half_space.csv", encoding="utf-8") as file:
            for row in csv.DictReader(line for line in file if not line.startswith("#")):
                number = lambda key, of=row: float(of[key]) if of[key] else 0.0
                a, b, dx = number("A_1_per_mm"), number("B_1_per_mm"), number("dx_mm")
                if dx >= 0.5:
                    axes = (6.143980785, 6.143980785) if a == b else (4.344450, 8.688901)
                    yield (a, b, dx, *(int(axis / dx) + 3 for axis in axes), 0 if "norm" in row["name"] else 3,
                           1 if row["FX_rel"] else 0, *map(number, ("FX_rel", "creep_x", "creep_y", "spin_rad_per_mm")))

    def test_the_set_ups_of_contact_have_the_numbers_of_linux(self):
        lines = "\n".join(" ".join(map(str, row)) for row in self.set_ups()) + "\n"
        driver = SOURCE / "tests/windows/contact_driver.c"
        with tempfile.TemporaryDirectory() as place:
            for compiler, program in ((COMPILER, "driver.exe"), ("gcc", "driver")):
                subprocess.run([compiler, "-Wall", "-Werror", "-I", SOURCE / "extras", driver, "-o",
                                f"{place}/{program}", *(["-ldl"] if compiler == "gcc" else [])], check=True)
            code, out, errors = wine(f"{place}/driver.exe", WINDOWS / "contact/contact_addon_win64.dll",
                                     input=lines.encode())
            self.assertEqual(code, 0, out + errors)
            linux = subprocess.check_output([f"{place}/driver", CONTACT], input=lines, text=True)
        ours, theirs = ([[float(v) for v in line.split()] for line in text.splitlines()] for text in (out, linux))
        self.assertEqual(len(ours), 15)
        for row, (a, b) in enumerate(zip(ours, theirs, strict=True)):
            self.assertEqual(a[0], 0)
            for k, (u, v) in enumerate(zip(a, b, strict=True)):  # of the size that the number has in any of the set-ups
                size = max(abs(other[k]) for other in theirs)
                self.assertLessEqual(abs(u - v), ALLOWED * size, (row, k))


if __name__ == "__main__":
    unittest.main()
