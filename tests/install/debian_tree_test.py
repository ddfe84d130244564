#!/usr/bin/env python3
"""The Debian packages of a build installed by apt into a fresh Debian 12, in a folder of its own.

usage: debian_tree_test.py BUILD_DIR SOURCE_DIR FOLDER [--packages FOLDER_WITH_DEBS] [--tree TREE]

Makes a minimal system by mmdebstrap, installs the packages with what they ask for, and goes the ways of
docs/commands.md there: the program, two of its ranks, Python, a C and a Fortran program; then takes the packages off
again. Needs root, mmdebstrap and an archive of Debian; skipped (77) without. --packages: those of another build
(build-install/packages: all processors); --tree: an existing minimal system, kept as it is left.
"""
import argparse
import pathlib
import re
import shutil
import sys

from debian_tree import Tree, done, made, missing

ARGUMENTS = argparse.ArgumentParser(description=__doc__.split("\n")[0])
for name in ("build", "source", "folder"):
    ARGUMENTS.add_argument(name, type=lambda word: pathlib.Path(word).resolve())
ARGUMENTS.add_argument("--packages", type=pathlib.Path)
ARGUMENTS.add_argument("--tree", type=pathlib.Path)
NAMES = ["railstrata", r"librailstrata[\d.]+", "librailstrata-dev", "python3-railstrata"]
PLUG_IN = "railstrata-mpi"


def packed(given):
    if given.packages:
        return list(given.packages.glob("*.deb"))
    folder = given.folder / "packages"
    folder.mkdir()
    done("cpack", "-G", "DEB", "--config", given.build / "CPackConfig.cmake", "-B", folder)
    return list(folder.glob("*.deb"))


def made_tree(given):
    return Tree(given.tree) if given.tree else made(given.folder / "tree")


def library_first(tree, debs):
    """A vehicle code needs the library alone: its packages come without the program."""
    names = [f"/packages/{d.name}" for d in debs if re.match(r"librailstrata", d.name)]
    tree.apt(*names, "gcc", "libc6-dev", "gfortran", "pkg-config")
    assert "railstrata" not in tree.run("ls /usr/bin").split()


def the_program(tree):
    tree.run("cd /root && railstrata --version && railstrata bem cases/quick --cell '1 mm' --out results/quick")
    assert (tree.folder / "root/results/quick/report.html").stat().st_size > 100000
    tree.run("cd /root && railstrata explore cases/quick --out explore.html")
    tree.run("cd /root && railstrata run cases/quick --out results/demo")
    assert (tree.folder / "root/results/demo/summary.json").exists()
    assert "cell" in tree.run("railstrata bem --help")


def the_ranks(tree, source):
    """The plug-in, with the MPI that apt brings along: a run by two processes, too short for its checks to hold."""
    tree.apt("openmpi-bin")
    shutil.copy(source / "tests/program/soak.toml", tree.folder / "root/small.toml")
    short = "--set run.run_up='2 mm' --set run.positions='[\"6 mm\"]' --set drive.speed='10 m/s'"
    tree.run("cd /root && OMPI_MCA_btl_vader_single_copy_mechanism=none "
             "mpirun --oversubscribe --allow-run-as-root -n 2 "
             f"railstrata run small.toml {short} --no-report -j 1 --out results/ranks || test $? = 1")
    assert (tree.folder / "root/results/ranks/summary.json").exists()


def the_ways_of_the_page(tree, source):
    """Its blocks as they are written, without `sudo apt install`."""
    page = (source / "docs/commands.md").read_text()
    code = re.search(r"\*\*A notebook.*?```python\n(.*?)```", page, re.S)[1]
    (tree.folder / "root/way.py").write_text(code)
    rows = tree.run("cd /root && python3 way.py").splitlines()
    assert [row.split()[:2] for row in rows] == [[t, "mm"] for t in ("0.5", "1", "2", "4")], rows
    commands = re.search(r"\*\*A program of your own.*?```sh\n(.*?)```", page, re.S)[1]
    lines = [line for line in commands.splitlines() if "apt install" not in line]
    out = tree.run("cd /root\n" + "\n".join(lines)).split()
    assert len(out) == 3 and all(float(word) for word in out), out
    flags = "$(pkg-config --cflags --libs railstrata)"
    by_c = tree.run("cd /root && gcc -std=c89 -pedantic -Wall -Werror /usr/share/railstrata/examples/mine.c -o by_c "
                    f"{flags} -lm && ./by_c /usr/share/railstrata/cases/quick/case.toml").split()
    assert len(by_c) == 3, by_c
    print("Fortran", *out, "C", *by_c)


def taken_off(tree):
    tree.run("apt-get purge -y -qq 'railstrata*' 'librailstrata*' 'python3-railstrata*'")
    left = tree.run("find /usr /etc /var/lib/python -path '*railstrata*' -not -path '/usr/share/doc/*' | head")
    assert not left, left


def main():
    given = ARGUMENTS.parse_args()
    if lacking := missing("cpack", "dpkg-shlibdeps"):
        print(f"skipped: needs {lacking}")
        return 77
    shutil.rmtree(given.folder, ignore_errors=True)
    given.folder.mkdir(parents=True)
    debs = packed(given)
    found = sorted(d.name.split("_")[0] for d in debs)
    assert all(any(re.fullmatch(name, f) for f in found) for name in NAMES), found
    tree = made_tree(given)
    (tree.folder / "packages").mkdir(exist_ok=True)
    for deb in debs:
        shutil.copy(deb, tree.folder / "packages")
    tree.run("apt-get update -qq")
    library_first(tree, debs)
    tree.apt(*(f"/packages/{d.name}" for d in debs))
    the_program(tree)
    if any(d.name.startswith(f"{PLUG_IN}_") for d in debs):
        the_ranks(tree, given.source)
    the_ways_of_the_page(tree, given.source)
    taken_off(tree)
    if not given.tree:
        shutil.rmtree(given.folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
