#!/usr/bin/env python3
"""Checks every #include of src/ against src/LAYERS: a room sees itself and the rooms on lower floors, nothing else. A
room is a folder of its wing, src/<wing>/<room>. extras/LAYERS gives for each extra the floors of src/ it sees and the
rooms that see it. Every room has a card, README.md, whose first heading is the room's name; the files that a card names
exist. Below the highest room nothing prints, logs, ends the program or touches signals: others can call it. Nothing has
std::ranges algorithms, which the compiler of the explorer's engine (Emscripten of Debian 12) lacks.

usage: check_layers.py SRC
"""
import pathlib
import re
import sys
import tempfile

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')
SOURCES = {".hpp", ".cpp", ".cu", ".h"}
# a file of the project as pages name it: `body/ties.hpp`, `tests/mesh`, [the reference](docs/case-reference.md#mesh)
NAMED = re.compile(r"`([^`\s]+)`|\]\(([^)\s#]+)(?:#[^)]*)?\)")
ENDING = re.compile(r"\.(hpp|cpp|md|py|cmake|ts|svg|bib)$")
EXTRA = re.compile(r"(\w+) above (\w+)(?: seen by (.+))?")
RESULTS = {"view.py", "compare.svg"}  # written by the program into its results
FOLDERS = ("src/", "extras/", "tests/", "docs/", "tools/", "cases/", "web/src", "data/", "fuzz/", "cmake/", "bench/")
LOUD = re.compile(r"\bspdlog\b|\bfmt::print\b|\bstd::(?:cout|cerr|clog)\b|\bf?(?:printf|puts)\(|\bstd(?:out|err)\b"
                  r"|\b_?exit\(|\babort\(|\b(?:signal|sigaction)\(")
# SI prefixes and units are defined in record/unit.hpp alone
FACTOR = re.compile(r"\bconstexpr\b.*\bk(?:To)?(?:Milli|Micro|Nano|Mega|Kilo|Giga|Percent|Milli(?:metres?)"
                    r"|M(?:ega)?[Pp]a(?:scals?)?|Degrees?)\s*=\s*[-\d.(]")
LOUD_FILES = {"mpi/plug_in.cpp",  # the end of all ranks, where one has died
              "study/case_process.cpp",  # what a child does between fork and exec
              "cntc/message_file.cpp"}  # the screen, where a user of CONTACT's interface asks for it



def read_wings(text):
    """Wing -> its floors, lowest first, each a list of rooms."""
    lines = [line.split(":") for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return {wing: [floor.split() for floor in floors.split("<")] for wing, floors in lines}


def read_layers(text):
    """Room name -> level, lowest first; rooms on one floor share a level."""
    floors = [floor for wing in read_wings(text).values() for floor in wing]
    return {room: level for level, rooms in enumerate(floors) for room in rooms}


def room_folders(src):
    """Room name -> its folder below src/."""
    wings = read_wings((src / "LAYERS").read_text())
    return {room: src / wing / room for wing, floors in wings.items() for floor in floors for room in floor}


def read_extras(text):
    """Extra -> (room of src/ on whose floor it stands, rooms of src/ that see it)."""
    matches = [EXTRA.fullmatch(line) for line in text.splitlines() if line.strip() and not line.startswith("#")]
    assert all(matches), "a line of extras/LAYERS is not NAME above ROOM [seen by ROOM...]"
    return {m.group(1): (m.group(2), (m.group(3) or "").split()) for m in matches}


def complaint(room, target, levels, extras):
    """Why `room` must not include `target` ("room/file.hpp"), or None."""
    other = target.split("/")[0]
    if "/" not in target or other not in {*levels, *extras}:
        return "does not start with a room of LAYERS"
    if other in extras:
        return None if room == other or room in extras[other][1] else f"{other} is an extra that {room} does not see"
    if room in extras:
        floor = extras[room][0]
        return None if levels[other] <= levels[floor] else f"{other} is higher than {floor}"
    if other == room or levels[other] < levels[room]:
        return None
    side = "is on the same floor of LAYERS" if levels[other] == levels[room] else "is a higher room"
    return f"{other} {side}"


def source_lines(folder):
    """Every line of source below a folder: (file, number, line)."""
    for file in sorted(f for f in folder.rglob("*") if f.suffix in SOURCES):
        for number, line in enumerate(file.read_text().splitlines(), 1):
            yield file, number, line


def includes(folder):
    """Every #include "..." below a folder: (file, line, target)."""
    for file, number, line in source_lines(folder):
        match = INCLUDE.match(line)
        if match:
            yield file, number, match.group(1)


def named_files(text):
    """(line, name, whether it is a link) of what looks like a file or folder of the project, patterns left out."""
    for number, line in enumerate(text.splitlines(), 1):
        for match in NAMED.finditer(line):
            name, link = match.group(1) or match.group(2), bool(match.group(2))
            looks_so = link or ENDING.search(name) or name.startswith(FOLDERS)
            if looks_so and name not in RESULTS and "://" not in name and not re.search(r"[<>*$]|NAME|…", name):
                yield number, name, link


def missing_files(page, places):
    """Complaints about files that a page names and that are at none of the places; links go from the page's folder."""
    return [
        f"{page}:{number}: {name} does not exist"
        for number, name, link in named_files(page.read_text())
        if not any((place / name).exists() for place in ([page.parent] if link else places))
    ]


def card_complaints(room):
    """What is wrong with a room's card."""
    card = room / "README.md"
    if not card.exists():
        return [f"{room}: no card, README.md"]
    headings = [line for line in card.read_text().splitlines() if line.startswith("#")]
    wrong = []
    if headings[:1] != [f"# {room.name}"]:
        wrong.append(f'{card}: the first heading is not "# {room.name}"')
    above = [room.parent, room.parent.parent, room.parent.parent.parent]
    return wrong + missing_files(card, [room, *above, *wings_of(above)])


def wings_of(places):
    """The wings of src/, from which #includes start, where one of the places holds src/ or is it."""
    folders = [p for place in places for p in (place, place / "src") if (p / "LAYERS").exists()]
    return [wing for p in folders for wing in p.iterdir() if wing.is_dir()]


def loud_word(room, file, line, level, highest):
    """The word of the line by which a room below the highest prints, ends the program or touches signals, or None."""
    if level == highest or f"{room}/{file.name}" in LOUD_FILES:
        return None
    match = LOUD.search(line.split("//")[0])
    return match and match.group(0)


def check(src):
    levels = read_layers((src / "LAYERS").read_text())
    apart = src.parent / "extras"
    extras = read_extras((apart / "LAYERS").read_text()) if apart.exists() else {}
    rooms = {*room_folders(src).values(), *(apart / extra for extra in extras)}
    there = {p for place in [*(w for w in src.iterdir() if w.is_dir()), *([apart] if extras else [])]
             for p in place.iterdir() if p.is_dir()}
    found = [f"{folder}: not a room of LAYERS" for folder in sorted(there - rooms)]
    for folder in sorted(there & rooms):
        found += card_complaints(folder) + room_complaints(folder, levels, extras)
    return found


def room_complaints(folder, levels, extras):
    """What is wrong with the sources of a room; tests beside it may include what they want."""
    found = []
    level = levels[extras[folder.name][0] if folder.name in extras else folder.name]
    for file, number, line in source_lines(folder):
        if "tests" in file.relative_to(folder).parts:
            continue
        word = loud_word(folder.name, file, line, level, max(levels.values()))
        if word:
            found.append(f"{file}:{number}: {folder.name} must not print, log, exit or handle signals: {word}")
        if folder.name != "record" and FACTOR.search(line.split("//")[0]):
            found.append(f"{file}:{number}: factors of units stand in record/unit.hpp alone")
        if "std::ranges::" in line:
            found.append(f"{file}:{number}: std::ranges is not in the explorer's compiler: use the algorithms of std::")
        include = INCLUDE.match(line)
        reason = include and complaint(folder.name, include.group(1), levels, extras)
        if reason:
            found.append(f"{file}:{number}: {folder.name} must not include \"{include.group(1)}\": {reason}")
    return found


def self_test():
    """The check catches an upward, a same-line, a roomless include and an unknown folder, and passes the rest."""
    test_includes()
    test_extras()
    test_cards()


def test_includes():
    with tempfile.TemporaryDirectory() as name:
        src = pathlib.Path(name)
        (src / "LAYERS").write_text("# comment\nground: low < left right\nroof: top\n")
        wing = {"top": "roof"}
        included = {"low": "top/a.hpp", "left": "right/a.hpp", "top": "a.hpp", "right": "low/a.hpp",
                    "stray": "low/a.hpp"}
        for room, include in included.items():
            folder = src / wing.get(room, "ground") / room
            folder.mkdir(parents=True)
            (folder / "README.md").write_text(f"# {room}\n")
            (folder / "a.hpp").write_text(f'#include <vector>\n#include "{room}/b.hpp"\n#include "{include}"\n')
        (src / "ground/left/b.cpp").write_text('// puts("here")\nvoid f() { std::puts("there"); }\n')
        (src / "roof/top/b.cpp").write_text('void f() { std::puts("here"); }\nconstexpr double kToMilli = 1e3;\n'
                                         'std::ranges::sort(a);\n')
        found = check(src)
        expected = [
            "stray: not a room",
            'left must not include "right/a.hpp"',
            "b.cpp:2: left must not print",
            'low must not include "top/a.hpp"',
            'top must not include "a.hpp"',
            "b.cpp:2: factors of units",
            "b.cpp:3: std::ranges",
        ]
        assert len(found) == len(expected) and all(e in f for e, f in zip(expected, found)), found


def test_extras():
    """An extra sees its floor and those below, no other extra; the rooms that see it are named."""
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        included = {"src/house/low": "one/a.hpp", "src/house/middle": "one/a.hpp", "src/house/top": "low/a.hpp",
                    "extras/one": "middle/a.hpp", "extras/two": "top/a.hpp", "extras/three": "one/a.hpp",
                    "extras/stray": "low/a.hpp"}
        for room, include in included.items():
            (root / room).mkdir(parents=True)
            (root / room / "README.md").write_text(f"# {pathlib.Path(room).name}\n")
            (root / room / "a.hpp").write_text(f'#include "{include}"\n')
        (root / "src/LAYERS").write_text("house: low < middle < top\n")
        (root / "extras/LAYERS").write_text("one above middle seen by middle top\ntwo above middle\nthree above top\n")
        found = check(root / "src")
        expected = ["stray: not a room", "one is an extra that three does not", "top is higher than middle",
                    "one is an extra that low does not see"]
        assert len(found) == len(expected) and all(e in f for e, f in zip(expected, found)), found


def test_cards():
    """Finds a room without a card, the card of another room and names of files that do not exist; passes the rest."""
    with tempfile.TemporaryDirectory() as name:
        src = pathlib.Path(name) / "src"
        cards = {
            "good": "# good\n`a.hpp`, `bad/a.hpp`, `src/house/good/a.hpp`, `<name>.cpp`, [rooms](../../LAYERS), "
                    "`patch.csv`\n",
            "bad": "# good\n`a.hpp`\n`gone.hpp`, `tests/gone`, [page](gone.md#part), `Body`\n",
            "none": None,
        }
        src.mkdir()
        (src / "LAYERS").write_text("house: good bad none\n")
        for room, card in cards.items():
            (src / "house" / room).mkdir(parents=True)
            (src / "house" / room / "a.hpp").write_text("")
            if card:
                (src / "house" / room / "README.md").write_text(card)
        found = check(src)
        expected = ['is not "# bad"', ":3: gone.hpp", ":3: tests/gone", ":3: gone.md", "none: no card"]
        assert len(found) == len(expected) and all(e in f for e, f in zip(expected, found)), found


def main():
    self_test()
    src = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "src")
    found = check(src)
    print("\n".join(found) or f"{src}: every include goes down the rooms of LAYERS, every room has its card")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
