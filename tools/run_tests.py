#!/usr/bin/python3
"""Runs the tests of a build by CTest: what `./railstrata test` does once all is built.

usage: run_tests.py BUILD [--slow | --windows] [--costs CSV] [CTEST'S OWN OPTION]...

Tests without a label of LABELS, or those with the label slow or windows. Tests get a temporary
folder (TMPDIR) of their own; what they leave there is a fault. After CTest's lines those that were skipped are named,
with their reasons.
--costs: measures the processor time of each test, children included, and keeps the sums by room in CSV
(bench/results/test_cost.csv), in place of those of the same commit.
Exit code: CTest's; 1 if only files were left.
"""
import argparse
import collections
import ctypes
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml

sys.dont_write_bytecode = True
import records

LABELS = ("slow", "windows", "long")

# Tests share the cores: a thread that spins while it waits takes one from another test, and on a busy machine a test of
# two threads of 4 s takes 19 s of processor time.
WAIT = {"OMP_WAIT_POLICY": "passive", "GOMP_SPINCOUNT": "0"}
# of unittest, of scripts that end with 77, of GoogleTest
REASON = re.compile(r"\.\.\. skipped '(.*)'$|^SKIPPED(?: \[\d+\])?:? (.*)$|: Skipped\n(.*)$", re.M)


def skipped(results):
    """(test, reason), once each, in CTest's table."""
    for test in xml.parse(results).getroot().iter("testcase"):
        text = "".join(test.itertext()).strip()
        reasons = dict.fromkeys("".join(found) for found in REASON.findall(text))
        whole = any(mark.get("message", "").startswith("SKIP_") for mark in test.iter("skipped"))
        if whole and not reasons:
            reasons = [text.splitlines()[-1] if text else "it gives no reason"]
        yield from ((test.get("name"), reason) for reason in reasons)


def listed(build, words):
    text = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1", *words], capture_output=True, text=True,
                          check=True).stdout
    return json.loads(text)["tests"]


def measured(build, words, folder):
    """The tests of a build in a CTest folder where each runs under this script, which notes its processor time."""
    def quoted(value):
        items = value if isinstance(value, list) else [value]
        return f"[==[{';'.join(map(str, items))}]==]"

    lines = []
    for test in listed(build, words):
        command = [sys.executable, __file__, "--one", folder / "costs", test["name"], *test["command"]]
        lines.append(f"add_test({quoted(test['name'])} {' '.join(map(quoted, command))})")
        lines += [f"set_tests_properties({quoted(test['name'])} PROPERTIES {p['name']} {quoted(p['value'])})"
                  for p in test["properties"]]
    (folder / "CTestTestfile.cmake").write_text("\n".join(lines) + "\n")
    return folder


def one(costs, name, *command):
    """A test as CTest called it; its processor time, with that of whom it left behind, is added as a line."""
    ctypes.CDLL(None).prctl(36, 1, 0, 0, 0)  # PR_SET_CHILD_SUBREAPER: its browser's processes are ours to wait for
    code = subprocess.run(command).returncode
    end = time.monotonic() + 3
    try:
        while time.monotonic() < end:
            if os.waitpid(-1, os.WNOHANG)[0] == 0:
                time.sleep(0.02)
    except ChildProcessError:
        pass
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(costs, "a") as file:
        file.write(f"{used.ru_utime + used.ru_stime:.3f} {name}\n")
    return code if code >= 0 else 128 - code


def commit_of(build):
    cache = (build / "CMakeCache.txt").read_text()
    return records.commit(re.search(r"^CMAKE_HOME_DIRECTORY:\w+=(.*)$", cache, re.M)[1])


def keep_costs(csv, commit, tests, costs):
    rooms = collections.defaultdict(list)
    for line in costs.read_text().splitlines():
        seconds, name = line.split(" ", 1)
        rooms[name.split(":")[0]].append((float(seconds), name))
    rows = []
    for room, found in sorted(rooms.items()):
        most, dearest = max(found)
        rows.append({"commit": commit, "tests_of": tests, "room": room, "tests": len(found),
                     "processor_s": f"{sum(s for s, _ in found):.1f}", "dearest": dearest, "its_s": f"{most:.1f}"})
    records.keep(csv, ["commit", "tests_of", "room"], rows)
    print(f"processor time: {sum(float(row['processor_s']) for row in rows):.0f} s, by room in {csv}")


def run(given, words, folder):
    label = next((name for name in LABELS if vars(given).get(name)), None)
    chosen = [*(["-L", f"^{label}$"] if label else ["-LE", f"^({'|'.join(LABELS)})$"]), *words]
    build = measured(given.build, chosen, folder) if given.costs else given.build
    results, temporary = folder / "results.xml", folder / "tmp"
    temporary.mkdir()
    folders = {"TMPDIR": str(temporary), "TEST_TMPDIR": str(temporary)}
    code = subprocess.run(["ctest", "--test-dir", build, "-j", "2", "--output-on-failure", "--output-junit", results,
                           "--test-output-size-passed", "100000", *chosen],
                          env={**os.environ, **WAIT, **folders}).returncode
    for name, reason in skipped(results) if results.exists() else ():
        print(f"skipped: {name}: {reason}")
    left = sorted(file.name for file in temporary.iterdir())
    if left:
        print(f"left in the temporary folder by tests: {', '.join(left)}", file=sys.stderr)
    if given.costs:
        keep_costs(given.costs, commit_of(given.build), label or "default", folder / "costs")
    return code or bool(left)


def main():
    if sys.argv[1:2] == ["--one"]:
        return one(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--slow", action="store_true")
    which.add_argument("--windows", action="store_true")
    parser.add_argument("--costs", metavar="CSV", type=pathlib.Path)
    given, words = parser.parse_known_args()
    given.build = given.build.resolve()
    # not in the build: sockets of browsers and daemons allow no long names
    with tempfile.TemporaryDirectory(prefix="railstrata-tests-") as folder:
        os.chmod(folder, 0o755)  # some tests become another user
        return run(given, words, pathlib.Path(folder))


if __name__ == "__main__":
    sys.exit(main())
