#!/usr/bin/env python3
"""Holds every #include of src/ against src/LAYERS: a room sees itself and the rooms on lines above its own, nothing
else.

usage: check_layers.py SRC
"""
import pathlib
import re
import sys
import tempfile

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')


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
    return found


def self_test():
    """The check catches an upward, a same-line, a roomless include and an unknown folder, and passes the rest."""
    with tempfile.TemporaryDirectory() as name:
        src = pathlib.Path(name)
        (src / "LAYERS").write_text("# comment\nlow\nleft right\ntop\n")
        for room, include in [("low", "top/a.hpp"), ("left", "right/a.hpp"), ("top", "a.hpp"), ("right", "low/a.hpp"),
                              ("stray", "low/a.hpp")]:
            (src / room).mkdir()
            (src / room / "a.hpp").write_text(f'#include <vector>\n#include "{room}/b.hpp"\n#include "{include}"\n')
        found = check(src)
        expected = ["left must not include \"right/a.hpp\"", "low must not include \"top/a.hpp\"", "stray: not a room",
                    "top must not include \"a.hpp\""]
        assert len(found) == len(expected) and all(e in f for e, f in zip(expected, found)), found


def main():
    self_test()
    src = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "src")
    found = check(src)
    print("\n".join(found) or f"{src}: every include goes down the rooms of LAYERS")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
