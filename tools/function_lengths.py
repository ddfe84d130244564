#!/usr/bin/env python3
"""Functions of C++ that are too long to be read at once, found with Universal Ctags.

usage: function_lengths.py [--most LINES] [PATH ...]

PATH: files or folders, src/ and extras/ if none is given. Lines count from the one with the name to the closing brace.
Exit code: 0 none is too long, 1 some are, 4 Universal Ctags is missing.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
MOST = 60
COMMAND = [
    "ctags", "-R", "--languages=C++", "--langmap=C++:.cpp.hpp", "--kinds-C++=f", "--fields=+ne", "--output-format=json",
    "-f", "-"
]


def functions(paths):
    """(file, line, name, number of lines) of every function body."""
    done = subprocess.run([*COMMAND, *map(str, paths)], capture_output=True, text=True, check=True)
    tags = [json.loads(line) for line in done.stdout.splitlines()]
    return [(t["path"], t["line"], t["name"], t["end"] - t["line"] + 1) for t in tags if "end" in t]


def findings(paths, most=MOST):
    """A line for each function of more than `most` lines, as compilers write theirs; longest first."""
    long = sorted((f for f in functions(paths) if f[3] > most), key=lambda f: -f[3])
    return [f"{file}:{line}: warning: {name} has {n} lines, at most {most} are wanted [function-length]"
            for file, line, name, n in long]


def self_test():
    """A function of one line too many is found, also a member, a template and one behind a raw string; others are
    not."""
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
    print("\n".join(found) or f"no function of more than {given.most} lines")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
