#!/usr/bin/env python3
"""One case by builds of other compilers and for other instruction sets: how far the results lie apart.

usage: compare_builds.py WORK_DIR [--case CASE] [--set KEY=VALUE ...] [--variant NAME ...] [--jobs 2] [--record
FILE.csv]

Builds each variant in WORK_DIR/<name>, runs the case twice with each, with one and two threads, and compares: the two
runs must have the same bits in every file, and the numbers may differ from those of the first variant by the tolerance
only. A tolerance below that of the preload (run.preload_tolerance) compares where its iterations end. Exits with
0 if both hold. --record keeps the rows in the table. Example: tools/compare_builds.py build-variants --set
run.preload_tolerance=1e-10 --variant g++-native --variant g++-sse2
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys

import records

SOURCE = records.ROOT
VARIANTS = {  # compiler, instruction set; the first is the reference
    "g++-native": ("g++", None),
    "g++-avx2": ("g++", "-march=x86-64-v3"),
    "g++-sse2": ("g++", "-march=x86-64"),
    "clang++-native": ("clang++", None),
}
TOLERANCE = 1e-9  # relative; single precision would differ by 1e-6, another step by more
NUMBERS = {"p_max": "/contact/p_max_Pa", "q_max": "/contact/q_max_Pa", "F_x": "/contact/F_x_N", "F_z": "/contact/F_z_N",
           "creepage": "/contact/creepage_x"}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("work", type=pathlib.Path, help="folder for the builds")
    parser.add_argument("--case", type=pathlib.Path, default=SOURCE / "cases/quick")
    parser.add_argument("--set", action="append", default=[], help="override a key of the case")
    parser.add_argument("--variant", action="append", choices=VARIANTS,
                        help="only these; the first is the reference (default: all)")
    parser.add_argument("--jobs", type=int, default=2, help="of each build")
    parser.add_argument("--record", type=pathlib.Path)
    return parser.parse_args()


def build(folder, compiler, march, jobs):
    words = ["cmake", "-S", SOURCE, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DRAILSTRATA_TESTS=OFF",
             f"-DCMAKE_CXX_COMPILER={compiler}",
             f"-DRAILSTRATA_NATIVE={'OFF' if march else 'ON'}", f"-DCMAKE_CXX_FLAGS={march or ''}"]
    if shutil.which("ccache"):
        words.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
    for command in (words, ["ninja", "-C", folder, "-j", str(jobs), "railstrata"]):
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            sys.exit(
                f"{folder.name}: {' '.join(map(str, command))} failed:\n{done.stdout[-2000:]}{done.stderr[-2000:]}\n"
                f"clang++ needs libomp-dev for OpenMP")
    return folder / "railstrata-bin"


def run(binary, case, settings, threads, out):
    done = subprocess.run([binary, "run", case, "--out", out, "--force", "--quiet", "--no-report", "--threads",
                           str(threads), *(word for s in settings for word in ("--set", s))],
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode not in (0, 1):
        sys.exit(f"{binary}: exit code {done.returncode}: {done.stderr}")
    return json.loads((out / "summary.json").read_text()), json.loads((out / "provenance.json").read_text())


def at(summary, pointer):
    for key in pointer.strip("/").split("/"):
        summary = summary[key]
    return summary


def main():
    options = arguments()
    sys.argv[1:] = ["unused"]
    sys.path.insert(0, str(SOURCE / "tests/program"))
    from outside import results
    rows, reference = [], None
    for name in options.variant or VARIANTS:
        folder = options.work / name
        print(f"{name}: building", file=sys.stderr, flush=True)
        binary = build(folder, *VARIANTS[name], options.jobs)
        print(f"{name}: running", file=sys.stderr, flush=True)
        one, two = folder / "one", folder / "two"
        summary, origin = run(binary, options.case, options.set, 1, one)
        run(binary, options.case, options.set, 2, two)
        first, second = results(one), results(two)
        reference = reference or summary
        row = {"variant": name, "compiler": origin["compiler"], "isa": origin["isa"].split(",")[0],
               "steps": summary["run"]["steps"],
               "files_different_on_same_path": sum(first.get(f) != second.get(f) for f in first.keys() | second.keys())}
        for number, p in NUMBERS.items():
            difference = abs(at(summary, p) - at(reference, p)) / abs(at(reference, p))
            row[f"{number}_relative_difference"] = f"{difference:.3g}"
        rows.append(row | {"case": options.case.name, "set": "; ".join(options.set), "commit": origin["commit"]
                           + ("+dirty" if origin["dirty"] else ""), "cpu": origin["cpu"]})
        print(", ".join(f"{k} {v}" for k, v in row.items()), flush=True)
    if options.record:
        records.keep(options.record, ["variant", "case", "set"], rows)
    worst = max(float(r[f"{number}_relative_difference"]) for r in rows for number in NUMBERS)
    different = sum(r["files_different_on_same_path"] for r in rows)
    print(f"largest relative difference {worst:.3g} (tolerance {TOLERANCE:.0e}); files that differ between two runs "
          f"of one build: {different}")
    return worst > TOLERANCE or different > 0


if __name__ == "__main__":
    sys.exit(main())
