#!/usr/bin/python3
"""What a build from nothing costs: processor time of the compiler, by room.

usage: build_cost.py [--csv FILE] [--source CHECKOUT] [--target NAME] FOLDER [CMAKE OPTION]...

Configures FOLDER, which must not exist, as `./railstrata` does, without a compiler cache, and builds it with this
script in front of every compiler call. --target: railstrata is what `demo` needs; all, the default, what `test` needs.
--csv: keeps the sums, in place of those of the same commit and target (bench/results/build_cost.csv). --source: a
checkout of another commit, for a comparison. On a machine that does other work, times of the processor are longer
too: compare two builds made beside the same.
"""
import argparse
import collections
import pathlib
import re
import resource
import subprocess
import sys
import time

sys.dont_write_bytecode = True
import records

COSTS = "compiler_costs"


def one(costs, *command):
    """A call of the compiler; the processor time of one with an output is added as a line."""
    code = subprocess.run(command).returncode
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    if "-o" in command:
        with open(costs, "a") as file:
            file.write(f"{used.ru_utime + used.ru_stime:.2f} {command[command.index('-o') + 1]}\n")
    return code if code >= 0 else 128 - code


def by_room(lines):
    """room -> [calls, seconds]; of a file's name only the target counts."""
    rooms = collections.defaultdict(lambda: [0, 0.0])
    for line in lines:
        seconds, output = line.split(" ", 1)
        target = re.search(r"CMakeFiles/([^/]+)\.dir", output)
        room = rooms[target[1].removeprefix("room_") if target else "other"]
        room[0] += 1
        room[1] += float(seconds)
    return rooms


def main():
    if sys.argv[1:2] == ["--one"]:
        return one(*sys.argv[2:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--csv", type=pathlib.Path)
    parser.add_argument("--source", type=pathlib.Path, default=pathlib.Path(__file__).parent.parent)
    parser.add_argument("--target", default="all")
    parser.add_argument("folder", type=pathlib.Path)
    given, options = parser.parse_known_args()
    if given.folder.exists():
        parser.error(f"{given.folder} exists: name a new folder")
    costs = given.folder.resolve() / COSTS
    launcher = f"-DCMAKE_CXX_COMPILER_LAUNCHER={sys.executable};{pathlib.Path(__file__).resolve()};--one;{costs}"
    begun = time.monotonic()
    tests = "OFF" if given.target == "railstrata" else "ON"
    for command in (["cmake", "-S", given.source, "-B", given.folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                     f"-DRAILSTRATA_TESTS={tests}", launcher, *options],
                    ["ninja", "-C", given.folder, "-j", "2", given.target]):
        if subprocess.run([str(word) for word in command], stdout=subprocess.DEVNULL).returncode:
            sys.exit(f"failed: {' '.join(map(str, command))}")
    rooms = by_room(costs.read_text().splitlines())
    commit = records.commit(given.source)
    rows = [{"commit": commit, "target": given.target, "room": room, "calls": calls, "processor_s": f"{seconds:.1f}"}
            for room, (calls, seconds) in sorted(rooms.items())]
    for row in rows:
        print(f"{row['room']:24} {row['calls']:4} {row['processor_s']:>8} s")
    print(f"sum {sum(seconds for _, seconds in rooms.values()):.0f} s of processor time, "
          f"{time.monotonic() - begun:.0f} s on the clock")
    if given.csv:
        records.keep(given.csv, ["commit", "target", "room"], rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
