#!/usr/bin/env python3
"""clang-tidy and cppcheck over src/ and extras/, shellcheck over the shell scripts, layout and size of all sources:
what they find and a verdict.

usage: lint.py [--jobs N] [--csv docs/reliability/lint.csv] [FILE.cpp ...]

  clang-format      layout of src/, packaging/, tests/, fuzz/, bench/ and the report's TypeScript as in .clang-format,
                    by version 14 alone: others break lines elsewhere
  statement_lines   one statement a line, at most 120 columns (tools/statement_lines.py)
  function_lengths  no function of src/ over 60 lines, no file over 500, no type over 20 fields
                    (tools/function_lengths.py)
  plain_words       no private words in comments, messages and pages (tools/plain_words.py)

What clang-tidy and cppcheck do not look for, and why, stands in .clang-tidy and tools/cppcheck.txt. Without files: all
of them (some minutes); with files only these, by clang-tidy and the four above. --quick: the four above and
shellcheck. Exit code: 0 clean, 1 findings, 4 a tool is missing.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys

import function_lengths
import plain_words
import records
import statement_lines

ROOT = records.ROOT
BUILD = ROOT / "build-lint"
PLACES = [ROOT / "src", ROOT / "extras"]
FINDING = re.compile(r"^(\S+?):(\d+):(?:(\d+):)? (warning|error|style|performance|portability|note): (.*)$")
SCRIPTS = ["railstrata", ".ci/run"]
FORMATTED = ["src/**/*", "extras/**/*", "packaging/inside/*.cpp", "tests/**/*", "fuzz/**/*", "bench/**/*",
             "web/src/**/*", "web/*"]
FORMATTED_SUFFIXES = statement_lines.CPP | statement_lines.SCRIPTS
FORMAT_VERSION = "14."


def run(*command, cwd=ROOT):
    done = subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def configure():
    """A compilation database of clang++, so that its flags are those that clang-tidy knows."""
    code, out, err = run("cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                         "-DCMAKE_CXX_COMPILER=clang++", "-DRAILSTRATA_TESTS=OFF", "-DRAILSTRATA_UNITY=OFF")
    if code:
        sys.exit(f"lint: configuring failed\n{out}{err}")


def findings(text):
    """Each once: headers are seen from many files. What the analyzer sees in a library's headers is not ours."""
    return {line for line in text.splitlines() if (m := FINDING.match(line)) and m[4] != "note"
            and (ROOT / m[1]).is_relative_to(ROOT)}


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
    code, out, err = run("cppcheck", "--enable=warning,performance,portability", "--inline-suppr",
                         f"--suppressions-list={ROOT / 'tools/cppcheck.txt'}", "--std=c++20", "--language=c++",
                         "--library=googletest", "--template={file}:{line}:{column}: {severity}: {message} [{id}]",
                         "--quiet", f"--cppcheck-build-dir={folder}", "-j", jobs,
                         *(word for place in PLACES for word in ("-I", place)), *PLACES)
    found = findings(err)
    if code and not found:
        found = {f"cppcheck failed: {(err or out).strip()}"}
    print("\n".join(sorted(found)), end="\n" if found else "")
    return found


def shellcheck():
    _, out, _ = run("shellcheck", "--format=gcc", *SCRIPTS)
    print(out, end="")
    return {line for line in out.splitlines() if line}


def clang_format(files):
    if not files:
        return set()  # it would read its input
    _, out, err = run("clang-format", "--dry-run", "-Werror", *files)
    return shown({line for line in (out + err).splitlines() if FINDING.match(line)})


def shown(found):
    """Prints them with paths from the project's root."""
    found = {line.replace(f"{ROOT}/", "") for line in found}
    print("\n".join(sorted(found)), end="\n" if found else "")
    return found


def layout(files):
    """Findings of the four that read sources as text; no files: all."""
    code = files or [f for pattern in FORMATTED for f in sorted(ROOT.glob(pattern))]
    code = [f for f in code if f.suffix in FORMATTED_SUFFIXES]
    lines = files or statement_lines.all_files()
    statement_lines.self_test()
    function_lengths.self_test()
    plain_words.self_test()
    worded = files or plain_words.all_files()
    sized = files or sorted(f for place in PLACES for f in place.rglob("*") if f.suffix in {".cpp", ".hpp"})
    return {"clang-format": (code, clang_format(code)),
            "statement_lines": (lines, shown(set(statement_lines.findings(lines)))),
            "function_lengths": (sized, shown(set(function_lengths.findings(sized)))),
            "plain_words": (worded, shown(set(plain_words.findings(worded))))}


def version(tool):
    if (ROOT / "tools" / f"{tool}.py").exists():
        return "-"
    text = run(tool, "--version")[1]
    return re.search(r"\d+\.\d+(\.\d+)?", text)[0]


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("files", nargs="*", type=pathlib.Path)
    options.add_argument("--jobs", type=int, default=os.cpu_count())
    options.add_argument("--quick", action="store_true", help="layout, lengths and shell scripts alone: seconds")
    options.add_argument("--csv", help="keep the numbers in this table")
    given = options.parse_args()
    tools = ["clang-format", "ctags", "shellcheck"] + ([] if given.quick else ["clang++", "clang-tidy", "cppcheck"])
    missing = [t for t in tools if not shutil.which(t)]
    if not missing and not version("clang-format").startswith(FORMAT_VERSION):
        missing = [f"clang-format {FORMAT_VERSION}x"]
    if missing:
        print(f"lint: not installed: {', '.join(missing)}", file=sys.stderr)
        return 4
    files = [f.resolve() for f in given.files]
    sources = sorted(f for place in PLACES for f in place.rglob("*.cpp"))
    results = layout(files)
    if not files:
        results["shellcheck"] = (SCRIPTS, shellcheck())
    if not given.quick:
        configure()
        sources = [f for f in files if f.suffix == ".cpp"] if files else sources
        results["clang-tidy"] = (sources, clang_tidy(sources, given.jobs))
        if not files:
            results["cppcheck"] = (sources, cppcheck(given.jobs))
    rows = []
    for tool, (files, found) in results.items():
        print(f"{tool} {version(tool)}: {len(files)} files, {len(found)} findings")
        rows.append({"tool": tool, "version": version(tool), "files": len(files), "findings": len(found),
                     "commit": records.commit(), "command": "./railstrata lint"})
    if given.csv and not given.files and not given.quick:
        records.keep(given.csv, ["tool"], rows)
    clean = not any(found for _, found in results.values())
    print("clean" if clean
          else "findings: mend them, or name the check and the reason in .clang-tidy or tools/cppcheck.txt")
    return 0 if clean else 1


if __name__ == "__main__":
    sys.exit(main())
