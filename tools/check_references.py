#!/usr/bin/env python3
"""Every source named in a comment or a page ([Johnson1985 eq. 4.24]) stands in docs/references.bib.

usage: check_references.py ROOT
"""
import pathlib
import re
import sys

CITED = re.compile(r"\[([^\[\]\n]*)\]")
KEY = re.compile(r"\b[A-Z][A-Za-z]+(?:19|20)\d\d[a-z]?\b")


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    known = set(re.findall(r"^@\w+\{(\w+),", (root / "docs/references.bib").read_text(), re.M))
    missing = []
    places = ("src", "extras", "tests", "docs", "cases", "bench")
    for file in sorted(f for place in places for f in (root / place).rglob("*")):
        if file.suffix not in {".hpp", ".cpp", ".md", ".toml"}:
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            cited = {key for bracket in CITED.findall(line) for key in KEY.findall(bracket)}
            missing += [f"{file}:{number}: {key} is not in docs/references.bib" for key in sorted(cited - known)]
    print("\n".join(missing) or f"every citation is one of the {len(known)} entries of docs/references.bib")
    return 1 if missing or not known else 0


if __name__ == "__main__":
    sys.exit(main())
