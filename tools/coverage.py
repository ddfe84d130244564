#!/usr/bin/env python3
"""Which lines and branches of src/ the fast tests run, per room.

usage: coverage.py [--csv docs/reliability/coverage.csv] [--uncovered N] [--rooms contact,fem] [--counted] [-- ctest's
own options]

Builds and runs the preset `coverage` and asks gcovr. --counted: the counts of an earlier run are taken as they are.
--uncovered N: the N files with most lines that no test runs, with these lines. --rooms: only the unit tests of these
rooms; nothing is kept. Branches are those a source line decides, without those of exceptions passing through.
"""
import argparse
import collections
import json
import os
import pathlib
import subprocess
import sys

import check_layers
import records

BUILD = records.ROOT / "build-coverage"


def measure(rooms, jobs, ctest):
    targets = [word for room in rooms for word in ("--target", f"test_{room}")]
    chosen = ["-R", f"^({'|'.join(rooms)}):"] if rooms else []
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if subprocess.run(["sh", "-c", "command -v ccache"],
                                                                          capture_output=True).returncode == 0 else []
    for command in (["cmake", "--preset", "coverage", *launcher], ["cmake", "--build", "--preset", "coverage", "-j",
                                                                   str(jobs), *targets]):
        if subprocess.run(command, cwd=records.ROOT, stdout=sys.stderr).returncode:
            sys.exit(4)
    for counts in BUILD.rglob("*.gcda"):
        counts.unlink()
    return subprocess.run(["ctest", "--preset", "coverage", "-j", str(jobs), "--timeout", "3600", *chosen, *ctest],
                          cwd=records.ROOT, stdout=sys.stderr).returncode


def read(build, jobs):
    sources = f"{records.ROOT}/(src|extras/[a-z_]+/[a-z_]+[.])"
    done = subprocess.run(["gcovr", "--root", str(records.ROOT), "--filter", sources, "--exclude-throw-branches",
                           "--exclude-unreachable-branches", "-j", str(jobs), "--json", "-", str(build)],
                          cwd=records.ROOT, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"coverage: gcovr failed\n{done.stderr}")
    return json.loads(done.stdout)["files"]


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--csv", help="keep the numbers in this table")
    options.add_argument("--uncovered", type=int, default=0, metavar="N")
    options.add_argument("--rooms", default="", help="comma between them; default: all fast tests")
    options.add_argument("--counted", action="store_true")
    options.add_argument("--build", type=pathlib.Path, default=BUILD)
    options.add_argument("--jobs", type=int, default=os.cpu_count())
    own = sys.argv[1:]
    ctest = own[own.index("--") + 1:] if "--" in own else []
    given = options.parse_args(own[:own.index("--")] if "--" in own else own)
    failed = 0 if given.counted else measure([room for room in given.rooms.split(",") if room], given.jobs, ctest)
    rooms = collections.defaultdict(lambda: [0, 0, 0, 0])
    missed = []
    for file in read(given.build, given.jobs):
        lines = [line for line in file["lines"] if not line["gcovr/noncode"]]
        branches = [b for line in lines for b in line["branches"]]
        numbers = [len(lines), sum(line["count"] > 0 for line in lines), len(branches),
                   sum(b["count"] > 0 for b in branches)]
        name = pathlib.Path(file["file"])
        for room in (name.parts[-2], "all"):  # src/<wing>/<room>/…, extras/<extra>/…
            rooms[room] = [a + b for a, b in zip(rooms[room], numbers)]
        missed.append((name, [line["line_number"] for line in lines if line["count"] == 0]))
    order = [*check_layers.read_layers((records.ROOT / "src/LAYERS").read_text()),
             *check_layers.read_extras((records.ROOT / "extras/LAYERS").read_text()), "all"]
    rows = []
    print(f"{'room':10} {'lines':>7} {'run':>7}        {'branches':>8} {'run':>7}")
    for room in order:
        if room not in rooms:
            continue
        lines, run, branches, taken = rooms[room]
        print(f"{room:10} {lines:7} {run:7} {100 * run / max(lines, 1):5.1f} % {branches:8} {taken:7} "
              f"{100 * taken / max(branches, 1):5.1f} %")
        rows.append({"room": room, "lines": lines, "lines_run": run,
                     "lines_percent": f"{100 * run / max(lines, 1):.1f}", "branches": branches, "branches_run": taken,
                     "branches_percent": f"{100 * taken / max(branches, 1):.1f}", "commit": records.commit(),
                     "command": "./railstrata coverage"})
    for name, lines in sorted(missed, key=lambda m: -len(m[1]))[:given.uncovered]:
        if lines:
            print(f"{name}: {len(lines)} lines not run: {' '.join(map(str, lines))}")
    if given.csv and not given.rooms and not ctest:
        records.keep(given.csv, ["room"], rows)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
