#!/usr/bin/env python3
"""What the steps of the explicit time loop ask of the heap, once they have run in: the numbers of the tests Allocation
in test_fem.

usage: allocations.py BUILD [--csv docs/reliability/allocations.csv]

With one thread g++'s OpenMP library makes its team anew for every parallel loop: requests of its own, a small block
given back at once, are counted apart.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import records


def per_thousand(test, counted):
    return f"{1000 * int(test[counted]) / int(test['steps']):g}"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("build", type=pathlib.Path)
    options.add_argument("--csv", default=str(records.ROOT / "docs/reliability/allocations.csv"))
    given = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "tests.json"
        done = subprocess.run([str(given.build / "tests/test_fem"), "--gtest_filter=Stepper/Allocation.*",
                               f"--gtest_output=json:{out}"], stdout=sys.stderr)
        suites = json.loads(out.read_text())["testsuites"]
    rows = []
    for test in (t for suite in suites for t in suite["testsuite"] if "allocations" in t):
        rows.append({"case": test["name"].split("/")[-1], "steps_before": test["steps_before"], "steps": test["steps"],
                     "allocations": test["allocations"],
                     "allocations_per_1000_steps": per_thousand(test, "allocations"),
                     "by_openmp_library_per_1000_steps": per_thousand(test, "allocations_of_openmp"),
                     "commit": records.commit(), "command": "tools/allocations.py build"})
        print(f"{rows[-1]['case']}: {rows[-1]['allocations']} in {rows[-1]['steps']} steps")
    if not rows:
        print("allocations: no test counted any (built with a sanitizer?)", file=sys.stderr)
        return 1
    records.keep(given.csv, ["case"], rows)
    return 1 if done.returncode else 0


if __name__ == "__main__":
    sys.exit(main())
