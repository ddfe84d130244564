#!/usr/bin/env python3
"""Drives the readers by libFuzzer and adds up what was executed.

usage: fuzz.py BUILD [SECONDS] [--runs N] [--reader NAME]... [--merge]

SECONDS: of each reader, 60 by default; --runs: until results.csv has so many executions of the reader, all runs
together. BUILD holds the targets (cmake --preset fuzz). What libFuzzer learns stays in BUILD/learned/READER and is
taken up again; finds stay in BUILD/finds. Each run adds to fuzz/results.csv.
--merge: puts what was learned into fuzz/corpus, as few inputs as cover the same code.

Exit code: 0 nothing found, 1 a reader broke, 2 the targets are not there.
"""
import argparse
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time

import records

ROOT = records.ROOT
READERS = ["profile", "case_file", "history_table", "study_file", "results", "checkpoint", "checkpoint_content"]
# bytes of an input
LONGEST = {"profile": 1200, "case_file": 1200, "history_table": 600, "study_file": 1600,
           "results": 1200, "checkpoint": 700, "checkpoint_content": 700}
LIMITS = ["-timeout=20", "-rss_limit_mb=2048", "-malloc_limit_mb=512"]
# HDF5 asks for the sizes in a forged file, is refused, and reports it
OWN_LIMITS = {"checkpoint_content": ["-malloc_limit_mb=2147483647"]}
# less paging than the defaults
ENVIRONMENT = {**os.environ, "ASAN_OPTIONS": "quarantine_size_mb=8:malloc_context_size=8"}
CHECKS = "address undefined libstdc++ leaks"
KINDS = {"crash": "crashes", "timeout": "hangs", "oom": "out_of_memory", "leak": "leaks", "slow": "hangs"}
RESULTS = ROOT / "fuzz" / "results.csv"
ONE_CALL = 300  # seconds: a row of the table is lost at most


def commit(build):
    """What the targets were built from."""
    named = re.search(r'info\{"[^"]*", "([^"]*)", (true|false)', (build / "generated" / "build_info.cpp").read_text())
    return (named[1] or "unknown") + ("+dirty" if named[2] == "true" else "")


def executed(reader):
    return sum(int(row["executions"]) for row in records.rows_of(RESULTS) if row["reader"] == reader)


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def limits(reader):
    return LIMITS + OWN_LIMITS.get(reader, [])


def breaks_again(target, reader, find, kind):
    """A process that someone stopped for a while looks like one that hangs: a find counts when it is one again, by
    itself."""
    before = processor_seconds()
    done = subprocess.run([target, *limits(reader), find], capture_output=True, text=True, errors="replace",
                          env=ENVIRONMENT)
    return done.returncode != 0 and (kind != "timeout" or processor_seconds() - before > 10)


def run_once(target, reader, build, seconds, runs):
    """One call of libFuzzer: its row of the table, and the finds."""
    learned, finds = build / "learned" / reader, build / "finds" / reader
    learned.mkdir(parents=True, exist_ok=True)
    finds.mkdir(parents=True, exist_ok=True)
    before = set(finds.glob(f"{reader}-*"))  # a folder a reader: two may be driven at the same time
    begin = time.monotonic()
    words = [target, *limits(reader), f"-max_len={LONGEST[reader]}", f"-max_total_time={max(1, round(seconds))}",
             f"-runs={runs}", "-print_final_stats=1", "-reload=0", f"-artifact_prefix={finds}/{reader}-",
             learned, ROOT / "fuzz" / "corpus" / reader]
    done = subprocess.run(words, capture_output=True, text=True, errors="replace", env=ENVIRONMENT)
    executions = max((int(n) for n in re.findall(r"(?:number_of_executed_units: |^#)(\d+)", done.stderr, re.M)),
                     default=0)
    row = {"reader": reader, "executions": executions, "seconds": round(time.monotonic() - begin),
           "commit": commit(build), "checks": CHECKS, "crashes": 0, "hangs": 0, "out_of_memory": 0, "leaks": 0}
    found = []
    for find in sorted(set(finds.glob(f"{reader}-*")) - before):
        kind = find.name.removeprefix(reader + "-").split("-")[0]
        if not breaks_again(target, reader, find, kind):
            print(f"{reader:12} {find.name} does not break again", flush=True)
            find.rename(find.with_name("unrepeated-" + find.name))
            (find.parent / ("unrepeated-" + find.name + ".log")).write_text(done.stderr[-20000:])
            continue
        row[KINDS.get(kind, "crashes")] += 1
        found.append(find)
        (find.parent / (find.name + ".log")).write_text(done.stderr[-20000:])
    if row["executions"] == 0 and not found:
        sys.exit(f"{target.name} did not run:\n{done.stderr[-2000:]}")
    return row, found


def fuzz(reader, build, seconds, runs):
    target, found, total = build / "fuzz" / f"fuzz_{reader}", [], 0
    end = time.monotonic() + seconds
    while not found and (executed(reader) < runs if runs else time.monotonic() < end):
        left = ONE_CALL if runs else min(ONE_CALL, end - time.monotonic())
        row, found = run_once(target, reader, build, left, runs - executed(reader) if runs else -1)
        # counts of one reader as one commit has it are one row
        records.add(RESULTS, ["reader", "commit", "checks"], row)
        total += row["executions"]
        print(f"{reader:12} {row['executions']:>10} executions in {row['seconds']} s, {executed(reader)} in all",
              flush=True)
    for find in found:
        print(f"{reader:12} FOUND {find} (and its .log)", flush=True)
    return found


def merge(reader, build):
    """As few inputs as cover what the kept and the learned ones cover; the kept ones stay."""
    kept = ROOT / "fuzz" / "corpus" / reader
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([build / "fuzz" / f"fuzz_{reader}", "-merge=1", f"-max_len={LONGEST[reader]}", folder, kept,
                        build / "learned" / reader], check=True, capture_output=True)
        size = sum(f.stat().st_size for f in kept.iterdir())
        old = {f.read_bytes() for f in kept.iterdir()}
        for file in sorted(pathlib.Path(folder).iterdir(), key=lambda f: f.stat().st_size):
            if size + file.stat().st_size > 45_000:
                break
            if file.read_bytes() not in old:
                shutil.copy(file, kept / file.name[:16])
                size += file.stat().st_size
    print(f"{reader:12} {len(list(kept.iterdir()))} kept inputs, {size} bytes")


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("build", type=pathlib.Path)
    words.add_argument("seconds", type=float, nargs="?", default=60)
    words.add_argument("--runs", type=int, default=0)
    words.add_argument("--reader", action="append", choices=READERS)
    words.add_argument("--merge", action="store_true")
    given = words.parse_args()
    build, found = given.build.resolve(), []
    for reader in given.reader or READERS:
        if not (build / "fuzz" / f"fuzz_{reader}").exists():
            print(f"there is no {build}/fuzz/fuzz_{reader}: cmake --preset fuzz && cmake --build --preset fuzz",
                  file=sys.stderr)
            return 2
        if given.merge:
            merge(reader, build)
        else:
            found += fuzz(reader, build, given.seconds, given.runs)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
