#!/usr/bin/env python3
"""Runs what needs a card and keeps the record in tests/records/gpu.csv: `./railstrata test --gpu`.

gpu_record.py BUILD [--csv FILE] [--case FILE]

The tests with the label gpu, the same under compute-sanitizer (memory and races) where that is installed, and whole
steps against the card's memory, whose rate a copy kernel measures in the same run. Exit code 77 without a card.
"""

import argparse
import csv
import datetime
import json
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
COLUMNS = [
    "date",
    "commit",
    "device",
    "tests",
    "compute_sanitizer",
    "elements",
    "precision",
    "steps",
    "element_steps_per_s",
    "us_per_step",
    "copy_bytes_per_s",
    "counted_bytes",
    "share_of_copy",
]


def commit():
    said = subprocess.run(
        ["git", "-C", str(ROOT), "describe", "--always", "--dirty"], capture_output=True, text=True, check=False
    )
    return said.stdout.strip() or "unknown"


def passed(command):
    """Runs a test program; True if it passed. A skipped test is no passed one here."""
    said = subprocess.run(command, capture_output=True, text=True, check=False)
    print(said.stdout[-4000:] + said.stderr[-2000:])
    return said.returncode == 0 and "[  SKIPPED ]" not in said.stdout


def sanitized(tests):
    tool = shutil.which("compute-sanitizer") or "/usr/local/cuda/bin/compute-sanitizer"
    if not pathlib.Path(tool).exists():
        return "not installed"
    for check in ("memcheck", "racecheck", "initcheck"):
        if not passed([tool, "--tool", check, "--error-exitcode", "1", tests, "--gtest_filter=*Forces*:*Steps*"]):
            return f"{check} failed"
    return "passed"


def rows_of(text, common):
    """A row for each line of measure_card that has a speed; the line with the device's name goes to all of them."""
    lines = [json.loads(line) for line in text.splitlines()]
    device = next(line["device"] for line in lines if "device" in line)
    return [{**common, "device": device, **line} for line in lines if "elements" in line]


def self_test():
    text = '{"device": "card"}\n{"elements": 5, "precision": "double"}\n'
    assert rows_of(text, {"date": "d"}) == [{"date": "d", "device": "card", "elements": 5, "precision": "double"}]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--csv", type=pathlib.Path, default=ROOT / "tests/records/gpu.csv")
    parser.add_argument("--case", type=pathlib.Path, default=ROOT / "cases/paper/base.toml")
    given = parser.parse_args()
    self_test()
    measured = subprocess.run(
        [str(given.build / "tests/measure_card"), str(given.case)], stdout=subprocess.PIPE, text=True, check=False
    )
    if measured.returncode == 77:
        print("SKIPPED: no card; nothing is recorded", file=sys.stderr)
        return 77
    if measured.returncode:
        return 1
    tests = str(given.build / "tests/test_card")
    common = {
        "date": datetime.date.today().isoformat(),
        "commit": commit(),
        "tests": "passed" if passed([tests]) else "failed",
        "compute_sanitizer": sanitized(tests),
    }
    is_new = not given.csv.exists()
    with given.csv.open("a", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS)
        if is_new:
            writer.writeheader()
        writer.writerows(rows_of(measured.stdout, common))
    print(f"kept in {given.csv}")
    return 0 if common["tests"] == "passed" and "failed" not in common["compute_sanitizer"] else 1


if __name__ == "__main__":
    sys.exit(main())
