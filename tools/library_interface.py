#!/usr/bin/env python3
"""What librailstrata.so shows of itself: the public headers and the symbols.

usage: library_interface.py headers --src FOLDER... --out FOLDER --version V --stamp FILE [--c HEADER.h] HEADER.hpp...
       library_interface.py exports --headers FOLDER --nm NM --version V --public-version V --out MAP
                                     --library A.a ... --users B.a ...

headers: copies the headers and every header they include to FOLDER/<room>/<name>.hpp, with `#include "room/x.hpp"`
turned into `#include "railstrata/room/x.hpp"`, and writes FOLDER/railstrata.hpp, which includes them all; copies the C
header to FOLDER. Refuses headers that a user could not compile with the standard library alone.
exports: writes a linker version script. Public are the functions, classes and constants of the archives that the public
headers declare, those of the C header too; private, under a version that no other release has, what the users'
archives call besides; all else is local.
"""
import argparse
import pathlib
import re
import subprocess
import sys

QUOTED = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)
ANGLED = re.compile(r"^\s*#\s*include\s*<([^>]+)>", re.M)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.S)


def placed(src, header):
    """"room/x.hpp" in one of the folders."""
    return next(folder / header for folder in src if (folder / header).exists())


def closure(src, headers):
    """The headers and all they include, sorted."""
    found, todo = set(), list(headers)
    while todo:
        header = todo.pop()
        if header in found:
            continue
        found.add(header)
        todo += QUOTED.findall(placed(src, header).read_text())
    return sorted(found)


def complaints(src, headers):
    """Headers that a user's compiler may not find: of third parties, and what the compiler only has with OpenMP."""
    out = []
    for header in headers:
        for name in ANGLED.findall(placed(src, header).read_text()):
            if "/" in name or "." in name:
                out.append(f"{header} includes <{name}>: public headers use the C++ standard library alone")
    return out


def write_if_new(file, text):
    if not file.exists() or file.read_text() != text:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)


def headers(args):
    names = closure(args.src, args.headers)
    for header in args.c:
        write_if_new(args.out / pathlib.Path(header).name, placed(args.src, header).read_text())
    wrong = complaints(args.src, names)
    if wrong:
        sys.exit("\n".join(wrong))
    for old in args.out.rglob("*.hpp"):
        if str(old.relative_to(args.out)) not in [*names, "railstrata.hpp"]:
            old.unlink()
    for name in names:
        text = placed(args.src, name).read_text()
        write_if_new(args.out / name, QUOTED.sub(lambda m: f'#include "railstrata/{m[1]}"', text))
    lines = ["#pragma once",
             f"// RailStrata {args.version}: all that the library offers. The C++ interface is unstable until 1.0.",
             f'#define RAILSTRATA_VERSION "{args.version}"',
             "",
             *(f'#include "railstrata/{header}"' for header in sorted(args.headers)),
             ""]
    write_if_new(args.out / "railstrata.hpp", "\n".join(lines))
    inputs = " ".join(str(placed(args.src, name)) for name in [*names, *args.c])
    args.stamp.with_name(args.stamp.name + ".d").write_text(f"{args.stamp}: {inputs}\n")
    args.stamp.touch()


def symbols(nm, archives, *options):
    """(mangled, type) of global symbols in namespace railstrata."""
    command = [nm, "--extern-only", "--format=posix", *options, *archives]
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    rows = (line.split() for line in text.splitlines())
    return {(row[0], row[1]) for row in rows if len(row) > 1 and "10railstrata" in row[0]}


def demangled(names):
    names = sorted(names)
    text = subprocess.run(["c++filt"], input="\n".join(names), capture_output=True, text=True, check=True).stdout
    return dict(zip(names, text.splitlines()))


def declared(folder):
    """Names of the functions, classes and constants that the public headers declare."""
    text = "\n".join(COMMENT.sub("", f.read_text()) for f in sorted(folder.rglob("*.hpp")))
    patterns = r"(~?\b\w+)\s*\(", r"\b(?:struct|class|namespace)\s+(\w+)", r"\bextern\b[^;]*?\b(\w+)\s*;"
    return [set(re.findall(pattern, text)) for pattern in patterns]


def is_public(name, functions, classes, constants):
    """A demangled name against what is declared: of a function, a member function, a constant, a class."""
    special = re.fullmatch(r"(?:vtable|typeinfo|typeinfo name) for railstrata::(\w+)", name)
    if special:
        return special[1] in classes
    match = re.match(r"railstrata::((?:\w+::)*)(~?\w+)(?:\[abi:cxx11\])?(\(|$)", name)
    if not match:
        return False
    scopes = [scope for scope in match[1].split("::") if scope]
    known = functions if match[3] else constants
    return all(scope in classes for scope in scopes) and match[2] in known


def c_functions(folder):
    """Names that the C headers declare with RS_API."""
    text = "\n".join(COMMENT.sub("", f.read_text()) for f in folder.glob("*.h"))
    return set(re.findall(r"RS_API\b[^;]*?\b(\w+)\s*\(", text))


def exports(args):
    strong = {name for name, kind in symbols(args.nm, args.library, "--defined-only") if kind in "TDBRVi"}
    every = {name for name, _ in symbols(args.nm, args.library, "--defined-only")}
    needed = {name for name, _ in symbols(args.nm, args.users, "--undefined-only")} & every
    known = declared(args.headers)
    public = {name for name, text in demangled(strong).items() if is_public(text, *known)}
    public |= c_functions(args.headers)
    if not public:
        sys.exit("no symbol of the archives is declared in a public header")

    def lines(names):
        return "".join(f"    {name};\n" for name in sorted(names))

    private = lines(needed - public)
    text = f"RAILSTRATA_{args.public_version} {{\n  global:\n{lines(public)}  local:\n    *;\n}};\n"
    text += f"RAILSTRATA_PRIVATE_{args.version} {{\n  global:\n{private}}};\n" if private else ""
    args.out.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    commands = parser.add_subparsers(required=True)
    make = commands.add_parser("headers")
    make.set_defaults(run=headers)
    make.add_argument("--src", type=pathlib.Path, nargs="+", required=True)
    make.add_argument("--stamp", type=pathlib.Path, required=True)
    make.add_argument("--c", action="append", default=[])
    make.add_argument("headers", nargs="+")
    make_map = commands.add_parser("exports")
    make_map.set_defaults(run=exports)
    make_map.add_argument("--headers", type=pathlib.Path, required=True)
    make_map.add_argument("--nm", required=True)
    make_map.add_argument("--public-version", required=True)
    make_map.add_argument("--library", nargs="+", required=True)
    make_map.add_argument("--users", nargs="+", required=True)
    for command in (make, make_map):
        command.add_argument("--out", type=pathlib.Path, required=True)
        command.add_argument("--version", required=True)
    args = parser.parse_args()
    args.run(args)


if __name__ == "__main__":
    main()
