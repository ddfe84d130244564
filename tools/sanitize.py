#!/usr/bin/env python3
"""The fast tests under the sanitizers: `debug` (address, undefined behaviour, asserts) and `tsan` (threads), each
configured, built and run.

usage: sanitize.py [debug|tsan ...] [--rooms contact,fem] [--csv docs/reliability/sanitizers.csv] [--jobs N] [-- ctest's
own options]

--rooms: only the unit tests of these rooms are built and run (lines of their own in the table).

A finding ends its test, so that the tests fail with it; the findings are counted in their output all the same.
Exit code: 0 clean, 1 a finding or a failed test, 4 the build failed.
"""
import argparse
import os
import re
import shlex
import subprocess
import sys
import xml.etree.ElementTree as xml

import records

PRESETS = {"debug": "address, undefined, leak; standard library asserts (g++)", "tsan": "thread (clang++)"}
FINDING = re.compile(r"ERROR: (?:Address|Leak)Sanitizer|WARNING: ThreadSanitizer|runtime error:|Assertion .* failed")


def campaign(preset, rooms, jobs, ctest):
    # some rooms' tests start the program
    targets = ["--target", "railstrata", *(f"test_{room}" for room in rooms)] if rooms else []
    chosen = ["-R", f"^({'|'.join(rooms)}):"] if rooms else []
    build = records.ROOT / f"build-{preset}"
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if subprocess.run(["sh", "-c", "command -v ccache"],
                                                                          capture_output=True).returncode == 0 else []
    for command in (["cmake", "--preset", preset, *launcher], ["cmake", "--build", "--preset", preset, "-j", str(jobs),
                                                               *targets]):
        if subprocess.run(command, cwd=records.ROOT, stdout=sys.stderr).returncode:
            return None
    results = build / "tests.xml"
    results.unlink(missing_ok=True)
    subprocess.run(["ctest", "--preset", preset, "-j", str(jobs), "--timeout", "3600", "--output-junit", str(results),
                    *chosen, *ctest], cwd=records.ROOT, stdout=sys.stderr)
    return count(results)


def count(results):
    suite = xml.parse(results).getroot()
    texts = ["".join(case.itertext()) for case in suite.iter("testcase")]
    return {"tests": int(suite.get("tests")), "failed": int(suite.get("failures")),
            "skipped": int(suite.get("skipped")) + int(suite.get("disabled")),
            "findings": sum(len(FINDING.findall(t)) for t in texts)}


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("presets", nargs="*", choices=[[], *PRESETS], help="default: all")
    options.add_argument("--rooms", default="", help="comma between them; default: all fast tests")
    options.add_argument("--jobs", type=int, default=os.cpu_count())
    options.add_argument("--csv", help="keep the numbers in this table")
    own = sys.argv[1:]
    ctest = own[own.index("--") + 1:] if "--" in own else []
    given = options.parse_args(own[:own.index("--")] if "--" in own else own)
    worst = 0
    rooms = [room for room in given.rooms.split(",") if room]
    for preset in given.presets or PRESETS:
        numbers = campaign(preset, rooms, given.jobs, ctest)
        if numbers is None:
            print(f"{preset}: the build failed", file=sys.stderr)
            return 4
        print(f"{preset} ({PRESETS[preset]}): {numbers['tests']} tests, {numbers['failed']} failed, "
              f"{numbers['skipped']} skipped, {numbers['findings']} findings")
        worst = max(worst, 1 if numbers["failed"] or numbers["findings"] or numbers["tests"] == 0 else 0)
        if given.csv:
            scope, command = " ".join([*rooms, *ctest]) or "all fast tests", " ".join(["./railstrata sanitize", preset,
                                                                                       *(["--rooms", given.rooms]
                                                                                         if rooms else []),
                                                                                       *(["--", *map(
                shlex.quote, ctest)] if ctest else [])])
            records.keep(given.csv, ["preset", "tests_of"],
                         [{"preset": preset, "sanitizers": PRESETS[preset], "tests_of": scope, **numbers,
                           "commit": records.commit(), "command": command}])
    return worst


if __name__ == "__main__":
    sys.exit(main())
