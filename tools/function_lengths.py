#!/usr/bin/env python3
"""Functions, files and types of C++ that are too long to be read at once, found with Universal Ctags.

usage: function_lengths.py [--most LINES] [PATH ...]

PATH: files or folders, src/ and extras/ if none is given. Lines of a function count from the one with the name to the
closing brace; a type counts its members. Exit code: 0 none is too long, 1 some are, 4 Universal Ctags is missing.
"""
import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
MOST = 60
MOST_OF_FILE = 500
MOST_FIELDS = 20
COMMAND = [
    "ctags", "-R", "--languages=C++", "--langmap=C++:.cpp.hpp", "--kinds-C++=fm", "--fields=+neKs",
    "--output-format=json", "-f", "-"
]


def tags_of(paths):
    """Of functions and members."""
    done = subprocess.run([*COMMAND, *map(str, paths)], capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def functions(tags):
    """(file, line, name, number of lines) of every function body."""
    return [(t["path"], t["line"], t["name"], t["end"] - t["line"] + 1)
            for t in tags if t["kind"] == "function" and "end" in t]


def large_types(tags):
    """A line for each type of more than MOST_FIELDS members."""
    fields = collections.Counter((t["path"], t.get("scope")) for t in tags if t["kind"] == "member")
    return [f"{file}:1: warning: {name} has {n} fields, at most {MOST_FIELDS} are allowed [type-size]"
            for (file, name), n in fields.items() if n > MOST_FIELDS]


def long_files(tags):
    """A line for each file of more than MOST_OF_FILE lines."""
    lines = {f: len(pathlib.Path(f).read_text(encoding="utf-8").splitlines()) for f in {t["path"] for t in tags}}
    return [f"{file}:1: warning: {n} lines, at most {MOST_OF_FILE} are wanted [file-length]"
            for file, n in sorted(lines.items()) if n > MOST_OF_FILE]


def findings(paths, most=MOST):
    """A line for each function of more than `most` lines, as compilers write theirs, longest first; types; files."""
    tags = tags_of(paths)
    long = sorted((f for f in functions(tags) if f[3] > most), key=lambda f: -f[3])
    return [f"{file}:{line}: warning: {name} has {n} lines, at most {most} are wanted [function-length]"
            for file, line, name, n in long] + large_types(tags) + long_files(tags)


def self_test():
    """A function of one line too many is found, also a member, a template and one behind a raw string; others are
    not. Types and files likewise."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "sample.cpp"

        def function(head, lines):
            return head + " {\n" + "  step();\n" * (lines - 2) + "}\n"

        file.write_text(function("int fits(int a)", 10) + function("void too_long()", 11) +
                        'const char* text = R"(\nvoid none() {\n)";\n' +
                        "struct S {\n" + function("  double member() const", 12) + "};\n" +
                        "template <class T>\n" + function("auto made(T&& t) -> T", 13))
        found = findings([file], 10)
        names = [f.split(": warning: ")[1].split()[0] for f in found]
        assert names == ["made", "member", "too_long"], found
        assert found[2].startswith(f"{file}:11: "), found
        members = "".join(f"  int m{i};\n" for i in range(MOST_FIELDS + 1))
        file.write_text("struct Fits {\n  int a;\n};\nstruct Large {\n" + members + "};\n" + "\n" * MOST_OF_FILE)
        found = findings([file])
        assert ["Large has" in found[0], "lines, at most" in found[1], len(found)] == [True, True, 2], found


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("paths", nargs="*", type=pathlib.Path)
    options.add_argument("--most", type=int, default=MOST)
    given = options.parse_args()
    try:
        self_test()
        found = findings(given.paths or [ROOT / "src", ROOT / "extras"], given.most)
    except FileNotFoundError:
        print("function_lengths: Universal Ctags is not installed", file=sys.stderr)
        return 4
    print("\n".join(found) or f"no function of more than {given.most} lines, no file and no type too long")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
