#!/usr/bin/env python3
"""What `cmake --install` gives. usage: install_test.py BUILD_DIR SOURCE_DIR INSTALLED CMAKE CXX GROUP

The group Install makes INSTALLED/prefix and INSTALLED/destdir; the others look at them.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD, SOURCE, INSTALLED = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
CMAKE, CXX = sys.argv[4:6]
PREFIX = INSTALLED / "prefix"
VERSION = re.search(r"project\(railstrata VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]
# A case that is over in seconds.
SMALL = ["--set", "mesh.element_size=4 mm", "--set", 'run.positions=["30 mm"]', "--set", "run.run_up=0 mm"]


def done(*words, code=0, **options):
    """Output of a command that has to end with `code`."""
    out = subprocess.run([str(w) for w in words], capture_output=True, text=True, timeout=600, **options)
    assert out.returncode == code, f"{words}: exit code {out.returncode}\n{out.stdout[-3000:]}{out.stderr[-3000:]}"
    return out.stdout


def environment(**changes):
    """That of this test, with variables set, or taken out by None."""
    return {key: value for key, value in {**os.environ, **changes}.items() if value is not None}


def only(pattern, folder=PREFIX):
    found = [f for f in folder.rglob(pattern) if not f.is_symlink() and "glibc-hwcaps" not in f.parts]
    assert len(found) == 1, f"{pattern}: {found}"
    return found[0]


def libraries():
    return only("librailstrata.so.*"), only("librailstrata-commands.so.*")


def numbers(folder):
    summary = json.loads((folder / "summary.json").read_text())
    return {key: summary[key] for key in ("contact", "stress", "energy")}


class Install(unittest.TestCase):
    def test_install_into_a_prefix_and_under_destdir(self):
        shutil.rmtree(INSTALLED, ignore_errors=True)
        INSTALLED.mkdir(parents=True)
        done(CMAKE, "--install", BUILD, "--prefix", PREFIX)
        staged = INSTALLED / "destdir"
        done(CMAKE, "--install", BUILD, "--prefix", "/opt/railstrata", env=environment(DESTDIR=str(staged)))
        roots = PREFIX, staged / "opt/railstrata"
        self.assertEqual(*[sorted(str(f.relative_to(root)) for f in root.rglob("*")) for root in roots])


    def test_what_is_built_for_it_is_looked_for_first(self):
        """A tree of which ./railstrata has built the program alone is built as far as it is installed."""
        rules = (BUILD / "cmake_install.cmake").read_text()
        looked_for = re.search(r"foreach\(file IN ITEMS (.*)\)\n.*\n.*Building what is installed", rules)[1]
        ends = rf"(?:\.so|\.so\.{re.escape(VERSION)}|bin/railstrata)"
        built = set(re.findall(rf'"{re.escape(str(BUILD))}/([^"]*?{ends})"', rules))
        links = {name for name in built if (BUILD / name).is_symlink()}
        self.assertGreater(len(built - links), 5)
        for name in built - links:
            self.assertIn(f'"{BUILD / name}"', looked_for)


class Tree(unittest.TestCase):
    def test_program_library_headers_packages_data_and_texts_are_there(self):
        shared = ["cases/quick/case.toml", "cases/paper/study.toml", "data/profiles/lma_wheel.csv",
                  "report/view.py", "report/report.js"]
        headers = ["railstrata.hpp", "railstrata.h", "railstrata_cntc.h", "ask/library.hpp"]
        for name in ["bin/railstrata", *(f"include/railstrata/{h}" for h in headers),
                     *(f"share/railstrata/{s}" for s in shared)]:
            self.assertTrue((PREFIX / name).is_file(), name)
        for name in ["RailStrataConfig.cmake", "RailStrataConfigVersion.cmake", "railstrata.pc", "LICENSE"]:
            only(name)
        libraries()
        self.assertEqual(only("contact_addon_linux64.so").parent.parts[-2:], ("railstrata", "contact"))
        recorded = [f.name for f in PREFIX.rglob("*") if f.is_file() and "recorded" in f.parts]
        self.assertEqual(recorded, ["study.csv"], "what the validation set `paper` reads")

    def test_the_manual_page_is_there(self):
        self.assertTrue((PREFIX / "share/man/man1/railstrata.1.gz").is_file())

    def test_no_file_names_the_source_or_the_build_folder(self):
        for file in PREFIX.rglob("*"):
            if file.is_file():
                text = file.read_bytes()
                for folder in (SOURCE, BUILD):
                    self.assertNotIn(str(folder).encode(), text, f"{file} names {folder}")


class Symbols(unittest.TestCase):
    def exported(self, library):
        """(version, demangled name) of every symbol that others can bind to."""
        lines = done("nm", "-DC", "--defined-only", "--with-symbol-versions", library).splitlines()
        out = []
        for _, kind, name in (line.split(maxsplit=2) for line in lines):
            if kind == "A":  # the versions themselves
                continue
            name, _, version = name.partition("@")
            out.append((version.lstrip("@"), name))
        return out

    def test_the_library_exports_names_of_its_own_alone(self):
        for version, name in self.exported(libraries()[0]):
            self.assertRegex(name, r"^(((vtable|typeinfo|typeinfo name) for )?railstrata::|rs_)", version)
            self.assertRegex(version, rf"^RAILSTRATA_(PRIVATE_)?{re.escape(VERSION.rsplit('.', 1)[0])}")

    def test_the_public_version_has_what_the_headers_declare_and_no_more(self):
        names = [name for version, name in self.exported(libraries()[0])
                 if "PRIVATE" not in version and not name.startswith("rs_")]
        public = {re.match(r"railstrata::((?:\w+::)*~?\w+)", name)[1] for name in names if " for " not in name}
        self.assertLessEqual({"load_case", "parse_case", "solve_by_half_spaces", "build_info", "version_text"}, public)
        headers = "\n".join(f.read_text() for f in (PREFIX / "include/railstrata").rglob("*.hpp"))
        for name in public:
            self.assertRegex(headers, rf"\b{name.split('::')[-1]}\s*\(", name)

    def test_the_functions_of_the_c_header_are_public(self):
        names = {name for version, name in self.exported(libraries()[0])
                 if name.startswith("rs_") and "PRIVATE" not in version}
        header = (PREFIX / "include/railstrata/railstrata.h").read_text()
        self.assertEqual(names, set(re.findall(r"RS_API [^;]*?(rs_\w+)\(", header)))

    def test_what_the_program_calls_besides_is_bound_to_this_very_release(self):
        private = {version for version, _ in self.exported(libraries()[0]) if "PRIVATE" in version}
        self.assertEqual(private, {f"RAILSTRATA_PRIVATE_{VERSION}"})

    def test_the_commands_export_one_function(self):
        names = [name for _, name in self.exported(libraries()[1])]
        self.assertEqual(names, ["railstrata::run_program(int, char const* const*)"])

    def test_the_library_needs_no_library_of_the_command_line(self):
        needed = re.findall(r"\(NEEDED\).*\[(.*)\]", done("readelf", "-d", libraries()[0]))
        self.assertFalse([name for name in needed if "spdlog" in name or "railstrata" in name], needed)

    def test_the_library_needs_the_compilers_own_libraries_alone(self):
        needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", done("readelf", "-d", libraries()[0])))
        own = {"libc.so.6", "libm.so.6", "libstdc++.so.6", "libgcc_s.so.1", "libgomp.so.1", "ld-linux-x86-64.so.2"}
        self.assertLessEqual(needed, own)

    def test_the_name_the_loader_asks_for_changes_with_every_minor_version_before_1(self):
        self.assertIn(f"[librailstrata.so.{VERSION.rsplit('.', 1)[0]}]", done("readelf", "-d", libraries()[0]))


class Headers(unittest.TestCase):
    def test_each_compiles_alone_with_the_standard_library(self):
        for header in (PREFIX / "include/railstrata").rglob("*.hpp"):
            done(CXX, "-std=c++20", "-Wall", "-Wextra", "-Wpedantic", "-Werror",
                 "-fsyntax-only", "-I", PREFIX / "include", "-include", header, "-x", "c++", "/dev/null")

    def test_they_have_no_simd_pack(self):
        for header in (PREFIX / "include/railstrata").rglob("*.hpp"):
            self.assertNotRegex(header.read_text(), r"simd\.hpp|\bPackOf\b|\bkLanes\b", header)


class Consumer(unittest.TestCase):
    """A program of another project, built against the prefix in a folder of its own."""
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        shutil.copytree(SOURCE / "tests/install/consumer", self.folder / "source")

    def run_it(self, program):
        out = done(program, PREFIX / "share/railstrata/cases/quick/case.toml",
                   env=environment(LD_LIBRARY_PATH=str(libraries()[0].parent)))
        self.assertIn(VERSION, out)


class CMakeConsumer(Consumer):
    def configure(self):
        return subprocess.run([CMAKE, "-S", self.folder / "source", "-B", self.folder / "build",
                               f"-DCMAKE_PREFIX_PATH={PREFIX}", f"-DCMAKE_CXX_COMPILER={CXX}"],
                              capture_output=True, text=True)

    def test_find_package(self):
        out = self.configure()
        self.assertEqual(out.returncode, 0, out.stderr)
        done(CMAKE, "--build", self.folder / "build")
        self.run_it(self.folder / "build/consumer")

    def test_another_minor_version_is_not_taken(self):
        file = self.folder / "source/CMakeLists.txt"
        file.write_text(file.read_text().replace("RailStrata 0.4", "RailStrata 0.3"))
        out = self.configure()
        self.assertNotEqual(out.returncode, 0)
        self.assertIn("RailStrata", out.stderr)


class PkgConfigConsumer(Consumer):
    def test_the_compiler_alone(self):
        here = environment(PKG_CONFIG_PATH=str(only("railstrata.pc").parent))
        flags = done("pkg-config", "--cflags", "--libs", "railstrata", env=here).split()
        self.assertEqual(done("pkg-config", "--modversion", only("railstrata.pc")).strip(), VERSION)
        done(CXX, "-std=c++20", self.folder / "source/main.cpp", "-o", self.folder / "consumer", *flags)
        self.run_it(self.folder / "consumer")


    def test_the_example_of_the_manual_runs_as_the_manual_says(self):
        manual = (SOURCE / "docs/library.md").read_text()
        rpath = "-Wl,-rpath,$(pkg-config --variable=libdir railstrata)"
        self.assertIn(rpath, manual)
        for header in re.findall(r"`#include <(.*?)>`", manual):
            self.assertTrue((PREFIX / "include" / header).exists(), header)
        includes, body = re.search(r"```cpp\n(.*?)```", manual, re.S)[1].split("\n\n", 1)
        (self.folder / "mine.cpp").write_text(f"{includes}\nint main() {{\n{body}}}\n")
        shutil.copy(PREFIX / "share/railstrata/cases/quick/case.toml", self.folder)
        here = environment(PKG_CONFIG_PATH=str(only("railstrata.pc").parent), LD_LIBRARY_PATH=None)
        done("sh", "-c", f"{CXX} -std=c++20 mine.cpp $(pkg-config --cflags --libs railstrata) {rpath} -o mine",
             cwd=self.folder, env=here)
        done(self.folder / "mine", cwd=self.folder, env=here)


class CConsumer(Consumer):
    """Programs in C89, Fortran and C++ that solve the same contact; they print what they found."""
    def setUp(self):
        super().setUp()
        self.source = self.folder / "source"
        self.links = ["-L", libraries()[0].parent, "-lrailstrata", f"-Wl,-rpath,{libraries()[0].parent}"]
        self.case = PREFIX / "share/railstrata/cases/quick/case.toml"
        self.fortran = ["gfortran", "-std=f2008", "-Wall", "-Werror", PREFIX / "include/railstrata/railstrata.f90"]

    def test_c89_fortran_and_cpp_find_the_same_forces(self):
        include = ["-I", PREFIX / "include"]
        done("gcc", "-std=c89", "-pedantic", "-Wall", "-Wextra", "-Werror", *include, self.source / "mine.c",
             "-o", self.folder / "mine_c", *self.links, "-lm")
        done(CXX, "-std=c++11", "-Wall", "-Werror", *include, "-x", "c++", self.source / "mine.c",
             "-o", self.folder / "mine_cpp", *self.links)
        done(*self.fortran, self.source / "mine.f90", "-o", self.folder / "mine_f", *self.links, cwd=self.folder)
        in_c, in_cpp, in_fortran = (done(self.folder / name, self.case) for name in ("mine_c", "mine_cpp", "mine_f"))
        self.assertEqual(in_c, in_cpp)
        numbers_of = [[float(word) for word in out.split()] for out in (in_c, in_fortran)]
        self.assertEqual(len(numbers_of[0]), 3)
        for c, fortran in zip(*numbers_of):
            self.assertAlmostEqual(c, fortran, delta=1e-9 * abs(c))

    def test_a_wheelset_hunts_alike_in_four_languages(self):
        examples, c = PREFIX / "share/railstrata/examples/vehicle", ["gcc", "-std=c89", "-pedantic", "-Wall", "-Werror"]
        include = ["-I", PREFIX / "include"]
        for name in ("hunting", "wheelset_pipe"):
            done(*c, *include, examples / f"{name}.c", "-o", self.folder / name, *self.links, "-lm")
        done(*self.fortran, examples / "hunting.f90", "-o", self.folder / "hunting_f", *self.links, cwd=self.folder)
        drive = [examples / "case.toml", "10", "0", "0.25", "4"]  # m/s, no springs, m, m

        package = next(PREFIX.rglob("railstrata/libbridge.so")).parent.parent
        here = environment(PYTHONPATH=str(package), PYTHONDONTWRITEBYTECODE="1")

        def trajectory(*program):
            return [list(map(float, row.split(","))) for row in done(*program, *drive, env=here).splitlines()[1:]]

        by_c = trajectory(self.folder / "hunting")
        self.assertEqual(len(by_c), 16)
        self.assertGreater(by_c[-1][1], 0.1)  # mm aside
        self.assertEqual(by_c, trajectory(self.folder / "hunting_f"))
        self.assertEqual(by_c, trajectory("/usr/bin/python3", examples / "hunting.py"))
        self.assertEqual(by_c, trajectory("octave-cli", "--no-gui", "-q", examples / "hunting.m",
                                          self.folder / "wheelset_pipe"))

    def test_a_bogie_needs_few_newton_steps(self):
        examples = PREFIX / "share/railstrata/examples/vehicle"
        done("gcc", "-std=c89", "-pedantic", "-Wall", "-Werror", "-I", PREFIX / "include", examples / "bogie.c",
             "-o", self.folder / "bogie", *self.links, "-lm")
        aside = {}
        for given in ("load", "height"):
            run = subprocess.run([self.folder / "bogie", examples / "bogie.toml", given, "0.001", "0.05"],
                                 capture_output=True, text=True, check=True)
            aside[given] = float(run.stdout.splitlines()[1].split(",")[1])
            steps, newton, unfinished, failed, beyond = (
                int(re.search(rf"(\d+) {what}\b", run.stderr)[1])
                for what in ("steps", "of Newton", "without end", "failed", "beyond"))
            self.assertEqual((steps, unfinished, failed, beyond), (50, 0, 0, 0), run.stderr)
            self.assertLess(newton, 2.5 * steps)
        self.assertAlmostEqual(aside["load"], aside["height"], delta=2e-3)  # mm; the roll has inertia in one

    def test_the_c_of_the_manuals_compiles(self):
        for page in ("library", "creep-table"):
            lines = re.search(r"```c\n(.*?)```", (SOURCE / f"docs/{page}.md").read_text(), re.S)[1].splitlines()
            includes = [line for line in lines if line.startswith("#")]
            body = [line for line in lines if not line.startswith("#")]
            (self.folder / "page.c").write_text("\n".join(["#include <stdio.h>", *includes, "int main(void) {", *body,
                                                           "return 0;", "}", ""]))
            done("gcc", "-std=c89", "-pedantic-errors", "-fsyntax-only", "-I", PREFIX / "include",
                 self.folder / "page.c")


class Python(unittest.TestCase):
    """The installed package in another place than it was installed to, without the build folder."""
    def setUp(self):
        packages = list(PREFIX.rglob("railstrata/libbridge.so"))
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        shutil.copytree(PREFIX, self.folder / "tree", symlinks=True)
        self.path = self.folder / "tree" / packages[0].parent.parent.relative_to(PREFIX)

    def python(self, code, **changes):
        here = environment(PYTHONPATH=str(self.path), PYTHONDONTWRITEBYTECODE="1", LD_LIBRARY_PATH=None,
                           RAILSTRATA_DATA=None, **changes)
        return done("/usr/bin/python3", "-c", code, cwd=self.folder, env=here)

    def test_it_gives_the_bits_of_the_program_beside_it(self):
        out = json.loads(self.python(
            "import json, railstrata as rs\nrs.threads(1)\nr = rs.bem(rs.Case('cases/quick'), cell=1e-3)\n"
            "print(json.dumps([rs.__version__, rs.__file__, r.summary['contact']]))"))
        self.assertEqual(out[0], VERSION)
        self.assertTrue(out[1].startswith(str(self.folder)), out[1])
        done(self.folder / "tree/bin/railstrata", "bem", "cases/quick", "--cell", "1 mm", "--threads", "1", "--out",
             self.folder / "out", cwd=self.folder)
        self.assertEqual(out[2], json.loads((self.folder / "out/summary.json").read_text())["contact"])

    def test_faults_of_a_case_keep_their_places(self):
        out = self.python("import railstrata as rs\ntry: rs.Case.from_text('[mesh]\\nelement_size = 1')\n"
                          "except rs.CaseError as e: print(e.diagnostics[0].remedy)")
        self.assertIn("in quotes", out)

    def test_the_loader_takes_the_library_for_the_processor(self):
        """The library stands once more where the loader looks first on this processor, as in a build of all levels."""
        level = next(line.split()[0] for line in done("/lib64/ld-linux-x86-64.so.2", "--help").splitlines()
                     if re.search(r"x86-64-v\d.*supported, searched", line))
        folder = only("librailstrata-bridge.so.*", self.folder / "tree").parent / "glibc-hwcaps" / level
        if not folder.exists():
            folder.mkdir(parents=True)
            for file in folder.parent.parent.glob("librailstrata.so*"):
                shutil.copy(file, folder, follow_symlinks=False)
        out = self.python("import railstrata\nprint(*{line.split()[-1] for line in open('/proc/self/maps') "
                          "if 'librailstrata.so' in line})").split()
        self.assertEqual({str(pathlib.Path(name).parent) for name in out}, {str(folder)})


class Moved(unittest.TestCase):
    """The prefix in another place than it was installed to, the program called from a folder where nothing is."""
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        shutil.copytree(PREFIX, self.folder / "elsewhere/tree", symlinks=True)
        self.program = self.folder / "elsewhere/tree/bin/railstrata"
        self.work = self.folder / "work"
        self.work.mkdir()

    def start(self, *words):
        return subprocess.run([self.program, *words], capture_output=True, text=True, timeout=600, cwd=self.work,
                              env=environment(LD_LIBRARY_PATH=None, RAILSTRATA_DATA=None))

    def run_it(self, *words):
        out = self.start(*words)
        self.assertIn(out.returncode, (0, 1), out.stderr)  # 1: a check of a result so coarse may fail
        return out.stdout

    def test_it_loads_its_own_library(self):
        loaded = done("ldd", self.program)
        for name in ("librailstrata.so", "librailstrata-commands.so"):
            place = re.escape(str(self.folder.resolve()))
            self.assertRegex(loaded, rf"{re.escape(name)}\S* => {place}/elsewhere/tree/")
        self.assertIn(VERSION, self.run_it("--version"))

    def test_a_shipped_case_runs_in_any_folder(self):
        self.run_it("run", "cases/quick", *SMALL)
        for name in ("report.html", "summary.json", "patch.csv", "view.py", "rail.vtu"):
            self.assertTrue((self.work / "results/quick" / name).is_file(), name)
        refused = self.start("run", "cases/quick", *SMALL)
        self.assertEqual(refused.returncode, 2, refused.stderr)

    def test_a_shipped_case_is_found_and_gives_the_bits_of_the_program_in_the_build_folder(self):
        self.run_it("bem", "cases/quick", "--cell", "1 mm", "--threads", "1")
        if (BUILD / "railstrata-bin").exists() and not list(PREFIX.rglob("glibc-hwcaps")):
            done(BUILD / "railstrata-bin", "bem", SOURCE / "cases/quick", "--cell", "1 mm", "--threads", "1", "--out",
                 self.work / "static")
            self.assertEqual(numbers(self.work / "results/quick-bem"), numbers(self.work / "static"))

    def test_a_folder_of_the_user_goes_before_the_shipped_one(self):
        (self.work / "cases/quick").mkdir(parents=True)
        (self.work / "cases/quick/case.toml").write_text("[mesh]\nelement_size = 1\n")
        out = self.start("check", "cases/quick")
        self.assertEqual(out.returncode, 2)
        self.assertIn("a bare number has no unit", out.stderr)


class Variants(unittest.TestCase):
    """A build with RAILSTRATA_VARIANTS=ON; the masks take from the processor what a variant needs."""
    MASKS = {"x86-64-v4": "", "x86-64-v3": "-AVX512F", "x86-64-v2": "-AVX512F,-AVX2"}

    def test_the_loader_takes_the_best_that_the_processor_can_run(self):
        results, seen = {}, set()
        for level, mask in self.MASKS.items():
            masked = environment(OMP_WAIT_POLICY="passive", GLIBC_TUNABLES=f"glibc.cpu.hwcaps={mask}")
            info = json.loads(done(PREFIX / "bin/railstrata", "info", "--json", env=masked))
            taken = re.search(r"-march=(\S+)", info["flags"])[1]
            self.assertLessEqual(taken, level)
            lanes = {"x86-64-v4": 8, "x86-64-v3": 4, "x86-64-v2": 2}[taken]
            self.assertIn(f"{lanes} doubles a vector", info["isa"])
            loaded = done("ldd", PREFIX / "bin/railstrata", env=masked)
            library = pathlib.Path(re.search(r"=> (\S*librailstrata\.so\S*)", loaded)[1])
            self.assertEqual(library.parent.name, "lib" if lanes == 2 else taken, loaded)
            for user in ("commands", "bridge", "hdf5"):  # built once, they find all they call in each of the libraries
                found = done("ldd", "-r", only(f"librailstrata-{user}.so.*"), env=masked)
                self.assertNotIn("undefined symbol", found)
            folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
            done(PREFIX / "bin/railstrata", "bem", "cases/quick", "--cell", "1 mm", "--no-report", "--out",
                 folder / "out", cwd=folder, env=masked)
            results[taken] = numbers(folder / "out")["contact"]
            seen.add(taken)
        first = next(iter(results.values()))
        for level, contact in results.items():
            for key in ("p_max_Pa", "q_max_Pa", "F_x_N", "F_z_N", "creepage_x"):
                self.assertAlmostEqual(contact[key] / first[key], 1, delta=1e-9, msg=f"{level} {key}")
        self.assertIn("x86-64-v2", seen)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[6:]])
