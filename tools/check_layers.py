#!/usr/bin/env python3
"""Holds every #include of src/ against src/LAYERS: a room sees itself and the rooms on lines above its own, nothing else.
Below the highest room nothing prints, logs, ends the program or touches signals: others can call it.

usage: check_layers.py SRC
"""
import pathlib
import re
import sys
import tempfile

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')
LOUD = re.compile(r"\bspdlog\b|\bfmt::print\b|\bstd::(?:cout|cerr|clog)\b|\bf?(?:printf|puts)\(|\bstd(?:out|err)\b"
                  r"|\b_?exit\(|\babort\(|\b(?:signal|sigaction)\(")
LOUD_FILES = {"study/child_process.cpp"}  # what a child does between fork and exec


def read_layers(text):
    """Room name -> level, lowest first; rooms on one line share a level."""
    lines = [line.split() for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return {room: level for level, rooms in enumerate(lines) for room in rooms}


def complaint(room, target, levels):
    """Why `room` must not include `target` ("room/file.hpp"), or None."""
    other = target.split("/")[0]
    if "/" not in target or other not in levels:
        return "does not start with a room of LAYERS"
    if other == room or levels[other] < levels[room]:
        return None
    side = "is on the same line of LAYERS" if levels[other] == levels[room] else "is a higher room"
    return f"{other} {side}"


def loud_word(room, file, line, levels):
    """The word of the line by which a room below the highest prints, ends the program or touches signals, or None."""
    if levels[room] == max(levels.values()) or f"{room}/{file.name}" in LOUD_FILES:
        return None
    match = LOUD.search(line.split("//")[0])
    return match and match.group(0)


def check(src):
    levels = read_layers((src / "LAYERS").read_text())
    found = []
    for folder in sorted(p for p in src.iterdir() if p.is_dir()):
        if folder.name not in levels:
            found.append(f"{folder}: not a room of LAYERS")
            continue
        for file in sorted(f for f in folder.rglob("*") if f.suffix in {".hpp", ".cpp", ".cu", ".h"}):
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                reason = match and complaint(folder.name, match.group(1), levels)
                if reason:
                    found.append(f"{file}:{number}: {folder.name} must not include \"{match.group(1)}\": {reason}")
                word = loud_word(folder.name, file, line, levels)
                if word:
                    found.append(f"{file}:{number}: {folder.name} must not print, log, exit or handle signals: {word}")
    return found


def self_test():
    """The check catches an upward, a same-line, a roomless include, an unknown folder and a line that prints."""
    with tempfile.TemporaryDirectory() as name:
        src = pathlib.Path(name)
        (src / "LAYERS").write_text("# comment\nlow\nleft right\ntop\n")
        for room, include in [("low", "top/a.hpp"), ("left", "right/a.hpp"), ("top", "a.hpp"), ("right", "low/a.hpp"), ("stray", "low/a.hpp")]:
            (src / room).mkdir()
            (src / room / "a.hpp").write_text(f'#include <vector>\n#include "{room}/b.hpp"\n#include "{include}"\n')
        (src / "left" / "b.cpp").write_text('// puts("here")\nvoid f() { std::puts("there"); }\n')
        (src / "top" / "b.cpp").write_text('void f() { std::puts("here"); }\n')
        found = check(src)
        expected = ["left must not include \"right/a.hpp\"", "b.cpp:2: left must not print", "low must not include \"top/a.hpp\"", "stray: not a room", "top must not include \"a.hpp\""]
        assert len(found) == len(expected) and all(e in f for e, f in zip(expected, found)), found


def main():
    self_test()
    src = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "src")
    found = check(src)
    print("\n".join(found) or f"{src}: every include goes down the rooms of LAYERS, only the highest prints")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
