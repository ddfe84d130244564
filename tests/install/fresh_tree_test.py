#!/usr/bin/env python3
"""What someone meets who has none of the project's packages: a minimal Debian 12, a clean clone, the README's commands.

usage: fresh_tree_test.py SOURCE FOLDER [--test-first] [--keep]

Clones the commit of SOURCE into a new system and runs `./railstrata demo` there to its exit code; then
`./railstrata test` with the tests that need each optional part (MPI, Python, a browser, Fortran), none of which may be
skipped. What this machine's ccache has compiled of the same sources with the same options
(RAILSTRATA_CMAKE) is not compiled again. --test-first: in the other order. --keep: the tree stays. Needs root,
mmdebstrap and an archive of Debian; skipped (77) without.
"""
import argparse
import functools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

from debian_tree import done, made, missing

HOME = "/root/checkout"
CACHE = "/root/.cache/ccache"
# Of every optional part a test that needs it: tests/program, tests/python, tests/report, tests/install.
PARTS = {"MPI": "mpi:ranks", "Python": "python", "browser": "report:page", "Fortran": "install:CConsumer"}


def share_cache(tree):
    where = subprocess.run(["ccache", "--get-config", "cache_dir"], capture_output=True, text=True, check=True).stdout
    pathlib.Path(where.strip()).mkdir(parents=True, exist_ok=True)  # of who has ccache and has not used it
    tree.shared[where.strip()] = CACHE
    tree.environment["RAILSTRATA_CMAKE"] = os.environ.get("RAILSTRATA_CMAKE", "")


def words_and_numbers(line):
    """A line's words, and its numbers with the unit of their last digit; runs of blanks count as one."""
    number = r"[-+]?\d+(?:\.(\d+))?(?![\w⁻])"
    numbers = [(float(m[0]), 10.0 ** -len(m[1] or "")) for m in re.finditer(number, line)]
    return re.sub(number, "#", " ".join(line.split())), numbers


def missing_lines(shown, printed):
    """Lines of a page that begin none of an output's lines, to three units of the last digit (processors differ)."""
    there = [words_and_numbers(line) for line in printed.splitlines()]
    return [line for line in shown.splitlines() if not any(
        words.startswith(words_and_numbers(line)[0])
        and all(abs(a - b) <= 3 * last for (a, last), (b, _) in zip(words_and_numbers(line)[1], numbers))
        for words, numbers in there)]


def demo(tree, source):
    printed = tree.run(f"cd {HOME} && ./railstrata demo 2>&1")
    shown = re.search(r"```text\n(  p_max.*?)```", (source / "README.md").read_text(), re.S)[1]
    missed = missing_lines(shown, printed)
    assert not missed, ("README.md shows what demo does not print", missed)
    results = tree.folder / HOME[1:] / "results/quick"
    assert json.loads((results / "summary.json").read_text())["contact"]["p_max_Pa"] > 1e9
    assert (results / "report.html").stat().st_size > 100000


def test(tree):
    names = "|".join(f"^{name}$" for name in PARTS.values())
    out = tree.run(f"cd {HOME} && ./railstrata test -R '{names}'")
    for part, name in PARTS.items():
        found = re.search(rf"Test +#\d+: {re.escape(name)} \.+ *(\S+)", out)
        assert found and found[1] == "Passed", f"{part}: {name}: {found[1] if found else 'no such test'}\n{out[-3000:]}"


def parts(tree):
    """Every part reports what it is."""
    said = json.loads(tree.run(f"cd {HOME} && ./railstrata info --json"))["parts"]
    print(json.dumps(said, indent=1))
    assert set(said) >= {"ranks", "cards", "python", "benchmarks"}, said
    for part, state in said.items():
        assert re.match("there|not there: |half there: |not asked for: ", state), (part, state)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("source", type=pathlib.Path)
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--test-first", action="store_true")
    arguments.add_argument("--keep", action="store_true")
    given = arguments.parse_args()
    if lacking := missing("git"):
        print(f"skipped: install:fresh_tree: needs {lacking}")
        return 77
    shutil.rmtree(given.folder, ignore_errors=True)
    given.folder.mkdir(parents=True)
    cached = shutil.which("ccache")
    tree = made(given.folder / "tree", "git", "ca-certificates", *(["ccache"] if cached else []))
    if cached:
        share_cache(tree)
    done("git", "clone", "--quiet", given.source, tree.folder / HOME[1:])
    first = functools.partial(demo, source=given.source)
    for step in [test, parts, first] if given.test_first else [first, parts, test, parts]:
        step(tree)
    if not given.keep:
        shutil.rmtree(given.folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
