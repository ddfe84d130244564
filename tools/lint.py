#!/usr/bin/env python3
"""clang-tidy and cppcheck over src/, shellcheck over the shell scripts: what they find and a verdict.

usage: lint.py [--jobs N] [--csv docs/reliability/lint.csv] [FILE.cpp ...]

What is not looked for, and why, stands in .clang-tidy and tools/cppcheck.txt. Without files: all of src/ (some minutes); with files only these, by clang-tidy alone.
Exit code: 0 clean, 1 findings, 4 a tool is missing.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys

import records

ROOT = records.ROOT
BUILD = ROOT / "build-lint"
FINDING = re.compile(r"^(\S+?):(\d+):(?:(\d+):)? (warning|error|style|performance|portability|note): (.*)$")
SCRIPTS = ["railstrata", ".ci/run"]


def run(*command, cwd=ROOT):
    done = subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def configure():
    """A compilation database of clang++, so that its flags are those that clang-tidy knows."""
    code, out, err = run("cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_COMPILER=clang++", "-DRAILSTRATA_TESTS=OFF")
    if code:
        sys.exit(f"lint: configuring failed\n{out}{err}")


def findings(text):
    """Each once: headers are seen from many files. What the analyzer sees in a library's headers is not ours."""
    return {line for line in text.splitlines() if (m := FINDING.match(line)) and m[4] != "note" and (ROOT / m[1]).is_relative_to(ROOT)}


def clang_tidy(files, jobs):
    found = set()

    def one(file):
        code, out, err = run("clang-tidy", "--quiet", "-p", BUILD, file)
        here = findings(out)
        return here if here or code == 0 else {f"{file}: clang-tidy failed: {err.strip().splitlines()[-1]}"}

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for here in pool.map(one, files):
            for line in sorted(here - found):
                print(line, flush=True)
            found |= here
    return found


def cppcheck(jobs):
    folder = BUILD / "cppcheck"
    folder.mkdir(parents=True, exist_ok=True)
    code, out, err = run("cppcheck", "--enable=warning,performance,portability", "--inline-suppr", f"--suppressions-list={ROOT / 'tools/cppcheck.txt'}", "--std=c++20", "--language=c++",
                         "--library=googletest", "--template={file}:{line}:{column}: {severity}: {message} [{id}]", "--quiet", f"--cppcheck-build-dir={folder}", "-j", jobs, "-I", ROOT / "src",
                         ROOT / "src")
    found = findings(err)
    if code and not found:
        found = {f"cppcheck failed: {(err or out).strip()}"}
    print("\n".join(sorted(found)), end="\n" if found else "")
    return found


def shellcheck():
    _, out, _ = run("shellcheck", "--format=gcc", *SCRIPTS)
    print(out, end="")
    return {line for line in out.splitlines() if line}


def version(tool):
    text = run(tool, "--version")[1]
    return re.search(r"\d+\.\d+(\.\d+)?", text)[0]


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("files", nargs="*", type=pathlib.Path)
    options.add_argument("--jobs", type=int, default=os.cpu_count())
    options.add_argument("--csv", help="keep the numbers in this table")
    given = options.parse_args()
    missing = [t for t in ("clang++", "clang-tidy", "cppcheck", "shellcheck") if not shutil.which(t)]
    if missing:
        print(f"lint: not installed: {', '.join(missing)}", file=sys.stderr)
        return 4
    configure()
    sources = sorted((ROOT / "src").rglob("*.cpp"))
    results = {"clang-tidy": (given.files or sources, clang_tidy([f.resolve() for f in given.files] or sources, given.jobs))}
    if not given.files:
        results["cppcheck"] = (sources, cppcheck(given.jobs))
        results["shellcheck"] = (SCRIPTS, shellcheck())
    rows = []
    for tool, (files, found) in results.items():
        print(f"{tool} {version(tool)}: {len(files)} files, {len(found)} findings")
        rows.append({"tool": tool, "version": version(tool), "files": len(files), "findings": len(found), "commit": records.commit(), "command": "./railstrata lint"})
    if given.csv and not given.files:
        records.keep(given.csv, ["tool"], rows)
    clean = not any(found for _, found in results.values())
    print("clean" if clean else "findings: mend them, or name the check and the reason in .clang-tidy or tools/cppcheck.txt")
    return 0 if clean else 1


if __name__ == "__main__":
    sys.exit(main())
