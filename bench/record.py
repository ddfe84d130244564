#!/usr/bin/python3
"""Runs a benchmark program and keeps its lines, stamped with machine, compiler and commit.

    bench/record.py build/bench/bench_bem            prints a table, writes bench/results/bem.csv
    bench/record.py build/bench/bench_bem --filter steady --out /tmp/bem.csv

Times in milliseconds. limit/this and CONTACT/this above 1 are in the program's favour; a ratio with a bound counts as kept likewise. Exit code 1 when a bound is not kept."""
import argparse
import csv
import datetime
import json
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
COLUMNS = ["line", "cells", "ms", "limit_ms", "limit/this", "CONTACT_ms", "CONTACT/this", "ratio", "bound", "worst"]


def cpu_model():
    with open("/proc/cpuinfo", encoding="utf-8") as info:
        found = re.search(r"model name\s*:\s*(.+)", info.read())
    return found.group(1) if found else "unknown"


def commit():
    def git(*words):
        return subprocess.run(["git", "-C", ROOT, *words], capture_output=True, text=True, check=False).stdout.strip()

    return (git("rev-parse", "--short=12", "HEAD") or "unknown") + (" with changes" if git("status", "--porcelain", "--", "src/core", "src/halfspace", "src/bem", "bench") else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--filter", default=".")
    parser.add_argument("--out", help="CSV file, bench/results/<room>.csv if nothing is said")
    options = parser.parse_args()
    room = os.path.basename(options.program).removeprefix("bench_")
    out = options.out or os.path.join(ROOT, "bench", "results", room + ".csv")
    load = os.getloadavg()[0]
    run = subprocess.run([options.program, "--benchmark_format=json", "--benchmark_filter=" + options.filter], stdout=subprocess.PIPE, text=True, check=True)
    result = json.loads(run.stdout)
    rows = []
    for line in result["benchmarks"]:
        row = {"line": re.sub(r"/(manual_time|iterations:\d+)", "", line["name"])}
        row.update({name: f"{line[name]:.4g}" if name != "cells" else f"{line[name]:.0f}" for name in COLUMNS[1:] if name in line})
        rows.append(row)
    width = {name: max([len(name)] + [len(row.get(name, "")) for row in rows]) for name in COLUMNS}
    for row in [dict(zip(COLUMNS, COLUMNS)), *rows]:
        print("  ".join(row.get(name, "").ljust(width[name]) if name == "line" else row.get(name, "").rjust(width[name]) for name in COLUMNS).rstrip())
    os.makedirs(os.path.dirname(os.path.abspath(out)), exist_ok=True)
    with open(out, "w", encoding="utf-8", newline="") as file:
        file.write(f"# cpu: {cpu_model()}, {os.cpu_count()} cores\n# compiler: g++ {result['context'].get('compiler', 'unknown')}\n# commit: {commit()}\n"
                   f"# date: {datetime.date.today()}\n# load average before the run: {load:.1f}\n")
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    print(f"written: {os.path.relpath(out)}")
    return 1 if any(float(row.get("limit/this", 1)) < 1 for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
