#!/usr/bin/env python3
"""The Debian packages of a build. usage: packages_test.py BUILD_DIR SOURCE_DIR FOLDER

Packs them into FOLDER, unpacks them into one tree, and runs the program, a C program and Python from there.
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

BUILD, SOURCE, FOLDER = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
VERSION = re.search(r"project\(railstrata VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]
TREE = FOLDER / "tree"
LIBRARY = f"librailstrata{VERSION.rsplit('.', 1)[0]}"
PLUG_IN = (BUILD / "railstrata_mpi.so").exists()
NAMES = [LIBRARY, "railstrata", "librailstrata-dev", "python3-railstrata", *["railstrata-mpi"] * PLUG_IN]


def done(*words, **options):
    out = subprocess.run([str(w) for w in words], capture_output=True, text=True, timeout=600, **options)
    assert out.returncode == 0, f"{words}: exit code {out.returncode}\n{out.stdout[-3000:]}{out.stderr[-3000:]}"
    return out.stdout


def environment(**changes):
    """Libraries and Python files of the tree, as they are found once packages are installed."""
    kept = {key: value for key, value in os.environ.items() if key not in ("RAILSTRATA_DATA", "PYTHONPATH")}
    return {**kept, "LD_LIBRARY_PATH": str(libraries()), "PYTHONPATH": str(TREE / "usr/lib/python3/dist-packages"),
            "PYTHONDONTWRITEBYTECODE": "1", **changes}


def packages():
    return {re.match(r"[^_]+", file.name)[0]: file for file in FOLDER.glob("*.deb")}


def libraries():
    return next((TREE / "usr/lib").glob("*/librailstrata.so.*")).parent


def fields(file):
    return dict(re.findall(r"^([A-Z][\w-]*): (.*)$", done("dpkg-deb", "--field", file), re.M))


def pack():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    done("cpack", "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", FOLDER)
    for file in FOLDER.glob("*.deb"):
        done("dpkg-deb", "-x", file, TREE)


class Packages(unittest.TestCase):
    def test_they_are_of_this_version_and_ask_for_each_other(self):
        self.assertEqual(set(packages()), set(NAMES))
        for name, file in packages().items():
            found = fields(file)
            self.assertEqual(found["Version"], f"{VERSION}-1", name)
            if name == "railstrata-mpi":
                self.assertIn(f"railstrata (= {VERSION}-1)", found["Depends"])
                self.assertIn("libopenmpi", found["Depends"])
            elif name != LIBRARY:
                self.assertIn(f"{LIBRARY} (= {VERSION}-1)", found["Depends"])
        self.assertIn("libhdf5", fields(packages()[LIBRARY])["Depends"])
        self.assertNotIn("libfftw3", fields(packages()[LIBRARY])["Depends"])
        self.assertRegex(fields(packages()["python3-railstrata"])["Depends"], r"python3 \(>= 3.*python3-numpy")

    def test_apt_finds_what_they_ask_for(self):
        if not shutil.which("apt-get"):
            self.skipTest("no apt here")
        out = done("apt-get", "--simulate", "--no-install-recommends", "install", *packages().values())
        self.assertEqual({line.split()[1] for line in out.splitlines() if line.startswith("Inst ")} & set(NAMES),
                         set(NAMES))

    def test_every_file_is_in_one_package(self):
        seen = {}
        for name, file in packages().items():
            for line in done("dpkg-deb", "-c", file).splitlines():
                path = line.split()[5]
                if not path.endswith("/"):
                    self.assertNotIn(path, seen)
                    seen[path] = name
        where = {pathlib.Path(path).name: name for path, name in seen.items()}
        self.assertEqual(where["railstrata.h"], "librailstrata-dev")
        self.assertEqual(where["librailstrata.so"], "librailstrata-dev")
        self.assertEqual(where["railstrata.1.gz"], "railstrata")
        self.assertEqual(where["__init__.py"], "python3-railstrata")
        if PLUG_IN:
            self.assertEqual(where["railstrata_mpi.so"], "railstrata-mpi")

    def test_no_library_has_a_path_of_its_own(self):
        for file in [*libraries().rglob("*.so*"), TREE / "usr/bin/railstrata"]:
            self.assertNotRegex(done("readelf", "-d", file), r"R(UN)?PATH", file)

    def test_lintian_finds_no_error(self):
        if not shutil.which("lintian"):
            self.skipTest("lintian is not installed (Debian: lintian)")
        with tempfile.TemporaryDirectory() as folder:  # it leaves files there
            out = subprocess.run(["lintian", "--no-cfg", "--allow-root", "--fail-on", "error", *packages().values()],
                                 capture_output=True, text=True, env={**os.environ, "TMPDIR": folder})
        self.assertEqual(out.returncode, 0, out.stdout)


class Installed(unittest.TestCase):
    def test_the_program_runs_a_shipped_case(self):
        work = FOLDER / "work"
        work.mkdir()
        done(TREE / "usr/bin/railstrata", "bem", "cases/quick", "--cell", "1 mm", "--threads", "1", cwd=work,
             env=environment())
        self.assertTrue((work / "results/quick-bem/report.html").is_file())
        out = done("/usr/bin/python3", "-c", "import railstrata as rs; rs.threads(1); print(repr(rs.bem("
                   "rs.Case('cases/quick'), cell=1e-3).p_max), rs.__file__)", cwd=work, env=environment()).split()
        summary = json.loads((work / "results/quick-bem/summary.json").read_text())
        self.assertEqual(float(out[0]), summary["contact"]["p_max_Pa"])
        self.assertTrue(out[1].startswith(str(TREE)))

    def test_a_c_program_is_built_and_runs(self):
        pc = libraries() / "pkgconfig"
        flags = done("pkg-config", "--cflags", "--libs", "railstrata",
                     env=environment(PKG_CONFIG_PATH=str(pc))).split()
        done("gcc", "-std=c89", "-pedantic", TREE / "usr/share/railstrata/examples/mine.c", "-o", FOLDER / "mine",
             *flags, "-lm")
        out = done(FOLDER / "mine", TREE / "usr/share/railstrata/cases/quick/case.toml", env=environment())
        self.assertEqual(len(out.split()), 3, out)

    def test_the_ways_in_from_the_packages_as_they_are_written(self):
        """Its blocks of the notebook and of the vehicle code, with the tree in place of /; each within five minutes."""
        page = (SOURCE / "docs/commands.md").read_text()
        folder = FOLDER / "ways"
        folder.mkdir()
        here = environment(LIBRARY_PATH=str(libraries()))
        code = re.search(r"\*\*A notebook.*?```python\n(.*?)```", page, re.S)[1]
        rows = done("/usr/bin/python3", "-c", code, cwd=folder, env=here).splitlines()
        self.assertEqual([row.split()[:2] for row in rows], [[t, "mm"] for t in ("0.5", "1", "2", "4")])
        commands = re.search(r"\*\*A program of your own.*?```sh\n(.*?)```", page, re.S)[1]
        lines = [line for line in commands.replace("/usr/", f"{TREE}/usr/").splitlines() if "apt install" not in line]
        out = done("sh", "-ec", "\n".join(lines), cwd=folder, env=here).split()
        self.assertEqual(len(out), 3, out)
        self.assertTrue((TREE / "usr/share/doc/railstrata/tutorial.ipynb").is_file())

    def test_cmake_finds_the_library(self):
        text = next(libraries().glob("cmake/RailStrata/RailStrataTargets-*.cmake")).read_text()
        for name in re.findall(r"\$\{_IMPORT_PREFIX\}/(\S+?)\"", text):
            self.assertTrue((TREE / "usr" / name).exists(), name)

    def test_the_manual_is_read(self):
        if not shutil.which("man"):
            self.skipTest("man is not installed (Debian: man-db)")
        out = done("man", "-M", TREE / "usr/share/man", "railstrata",
                   env=environment(MANWIDTH="80", LC_ALL="C.UTF-8"))
        self.assertIn("railstrata bem cases/quick", out)


if __name__ == "__main__":
    for tool in ("cpack", "dpkg-deb", "dpkg-shlibdeps", "fakeroot"):
        if not shutil.which(tool):
            print(f"{tool} is missing (Debian: cmake, dpkg-dev, fakeroot): nothing was packed")
            sys.exit(77)
    if not (BUILD / "CPackConfig.cmake").exists():
        print("the build makes no packages (RAILSTRATA_LIBRARY)")
        sys.exit(77)
    pack()
    unittest.main(argv=[sys.argv[0], "-v"])
