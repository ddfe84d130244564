#!/usr/bin/env python3
"""The quick case again and again, with 1, 2 and 4 threads in turn: every result file has the same bits. usage:
repeat_test.py BINARY SOURCE_DIR [--repeats 10] [--set KEY=VALUE ...] [--record FILE.csv]"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

THREADS = (1, 2, 4)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split(". usage")[0])
    parser.add_argument("binary", type=pathlib.Path)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--repeats", type=int, default=10)
    parser.add_argument("--set", action="append", default=[], help="override a key of the case")
    parser.add_argument("--record", type=pathlib.Path)
    options = parser.parse_args()
    sys.argv[1:] = [str(options.binary)]  # outside.py takes the program from there
    from outside import fact, keep_record, origin, results
    reference, faults = None, []
    for k in range(options.repeats):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "out"
            words = ["run", options.source / "cases/quick", "--out", out, "--no-report", "--quiet", "--threads",
                     str(THREADS[k % len(THREADS)])]
            done = subprocess.run([options.binary.resolve(), *words,
                                   *(word for s in options.set for word in ("--set", s))], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, text=True)
            if done.returncode not in (0, 1):
                sys.exit(f"repeats: exit code {done.returncode}: {done.stderr}")
            found, source = results(out), origin(out)
            steps = json.loads((out / "summary.json").read_text())["run"]["steps"]
        reference = reference or found
        faults += [f"repeat {k + 1} with {THREADS[k % len(THREADS)]} threads: {name} differs"
                   for name in sorted(reference.keys() | found.keys()) if reference.get(name) != found.get(name)]
        print(f"repeat {k + 1} of {options.repeats} done", file=sys.stderr, flush=True)
    seen = {"repeats": options.repeats, "threads": "/".join(map(str, THREADS)), "steps": steps, "files": len(reference),
            "files_different": len(faults), "set": "; ".join(options.set), **source}
    fact("repeats", **seen)
    if options.record:
        keep_record(options.record, seen)
    print("\n".join(faults) or "identical")
    return len(faults) > 0


if __name__ == "__main__":
    sys.exit(main())
