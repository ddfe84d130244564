#!/usr/bin/env python3
"""A million steps of a small wheel that rolls slowly: energy, memory, and the same bits in many sittings. usage:
soak_test.py BINARY [--distance "65 mm"] [--sittings 20] [--record FILE.csv]

Runs soak.toml twice at the same time, once in one go and once interrupted again and again, in turn by SIGTERM and by
kill -9. Exits with 0 if the energy balance closes, the memory does not grow and every result file is equal. --record
adds a line with what was seen.

The memory is that of the run in one go, anonymous only (RssAnon): pages of the program and its libraries are files'
(RssFile), which come in whenever code runs for the first time and go when the system wants; the first checkpoint alone
touches 3 MB of HDF5. It counts after the second checkpoint, when every kind of output has been written once, to where
the window of the result begins, whose samples are kept by design: the first fifth of that path against the last, by
medians, which do not see the moments in which a checkpoint is being made. By design the history alone grows: 200 bytes
a row, in a table up to twice as long as needed, 0.05 MB in 65 mm. A checkpoint that leaves one block of the history's
size behind is found."""
import argparse
import csv
import json
import pathlib
import signal
import statistics
import subprocess
import sys
import tempfile
import time
import typing

HERE = pathlib.Path(__file__).resolve().parent
CASE = HERE / "soak.toml"
MILLION = 1_000_000
ROW = 2 * 200  # bytes of a row of the history
LEAST_GROWTH = 1 << 18  # bytes, beyond the history; the heap's rounding
WARM = 2  # checkpoints
WINDOW = 4  # mm before the end: half of that in soak.toml, and a station


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("binary", type=pathlib.Path)
    parser.add_argument("--distance", default="65 mm", help="rolled; the default takes a million steps")
    parser.add_argument("--sittings", type=int, default=20)
    parser.add_argument("--record", type=pathlib.Path)
    return parser.parse_args()


def anonymous(pid):
    """Bytes of memory a process has for itself; None when it has none any more."""
    try:
        for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
            if line.startswith("RssAnon:"):
                return 1024 * int(line.split()[1])
    except (FileNotFoundError, ProcessLookupError):
        pass
    return None


class Moment(typing.NamedTuple):
    position: float  # mm
    rows: int
    checkpoints: int
    memory: int  # bytes


class Run:
    def __init__(self, binary, distance, out):
        self.binary, self.out, self.distance, self.memory, self.sittings = binary, out, distance, [], 1
        self.checkpoints, self.checkpoint_time = 0, None
        self.process = self.start([CASE, "--set", f'run.positions=["{distance}"]', "--out", out])

    def start(self, words):
        return subprocess.Popen([self.binary, "run", *words, "--no-report", "--quiet", "--threads", "1",
                                 "--checkpoint-every", "5 s"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                text=True)

    def rows(self):
        """Of the history, as (position / mm)."""
        try:
            lines = (self.out / "history.csv").read_text().splitlines()
        except FileNotFoundError:
            return []  # none yet, or a run that goes on is just writing it anew
        return [float(line.split(",")[1]) for line in lines if line[:1].isdigit()
                and line.count(",") == lines[-1].count(",") > 3]

    def count_checkpoints(self):
        try:
            written = (self.out / "checkpoint.h5").stat().st_mtime_ns
        except FileNotFoundError:
            return  # none yet, or it is just being renamed
        if written != self.checkpoint_time:
            self.checkpoints, self.checkpoint_time = self.checkpoints + 1, written

    def watch(self):
        self.count_checkpoints()
        rows, bytes_ = self.rows(), anonymous(self.process.pid)
        if rows and bytes_:
            self.memory.append(Moment(rows[-1], len(rows), self.checkpoints, bytes_))
        return rows[-1] if rows else 0

    def interrupt(self):
        hard = self.sittings % 2 == 0
        self.process.send_signal(signal.SIGKILL if hard else signal.SIGTERM)
        err = self.process.communicate()[1]
        if self.process.returncode in (0, 1):
            return  # it was just done
        if self.process.returncode != (-signal.SIGKILL if hard else 130):
            sys.exit(f"soak: exit code {self.process.returncode}: {err}")
        self.process = self.start(["--resume", self.out])
        self.sittings += 1


def summary_of(run):
    err = run.process.communicate()[1]
    if run.process.returncode not in (0, 1):
        sys.exit(f"soak: exit code {run.process.returncode}: {err}")
    return json.loads((run.out / "summary.json").read_text())


def drift(out):
    """Change of the energy balance between the first and the last fifth of the path, over the strain energy."""
    table = list(csv.DictReader(line for line in (out / "history.csv").read_text().splitlines()
                                if not line.startswith("#")))
    fifth = len(table) // 5
    mean = lambda rows, key: statistics.fmean(float(r[key]) for r in rows)
    return (mean(table[-fifth:], "closure_J") - mean(table[:fifth], "closure_J")) / mean(table, "strain_J")


def growth(moments, end):
    """The memory in the first and in the last fifth of the warm path, and how much of its growth is more than the
    history's."""
    warm = [m for m in moments if m.checkpoints > WARM and m.position < end - WINDOW]
    if not warm or warm[-1].checkpoints < 5 * WARM:
        sys.exit("soak: too few checkpoints to tell whether the memory grows: choose a longer distance")
    begin, length = warm[0].position, warm[-1].position - warm[0].position
    first = [m for m in warm if m.position <= begin + 0.2 * length]
    last = [m for m in warm if m.position >= begin + 0.8 * length]
    before, after = (statistics.median(m.memory for m in part) for part in (first, last))
    return before, after, after - before - ROW * (last[-1].rows - first[0].rows)


def main():
    options = arguments()
    sys.argv[1:] = [str(options.binary)]  # outside.py takes the program from there
    from outside import fact, keep_record, origin, results
    end = 1e3 * float(options.distance.split()[0]) / {"mm": 1e3, "m": 1}[options.distance.split()[1]]
    with tempfile.TemporaryDirectory() as folder:
        whole = Run(options.binary.resolve(), options.distance, pathlib.Path(folder) / "whole")
        parts = Run(options.binary.resolve(), options.distance, pathlib.Path(folder) / "parts")
        while whole.process.poll() is None or parts.process.poll() is None:
            if whole.process.poll() is None:
                whole.watch()
            if parts.process.poll() is None:
                due = parts.watch() >= end * parts.sittings / options.sittings
                if due and parts.sittings < options.sittings:
                    parts.interrupt()
            time.sleep(0.2)
        summary, again = summary_of(whole), summary_of(parts)
        first, last, more = growth(whole.memory, end)
        expected, found = results(whole.out), results(parts.out)
        different = sorted(name for name in expected.keys() | found.keys() if expected.get(name) != found.get(name))
        closure = next(c for c in summary["checks"] if c["name"] == "energy_closure")
        seen = {"steps": summary["run"]["steps"], "elements": summary["run"]["elements"], "sittings": parts.sittings,
                "checkpoints": whole.checkpoints, "files": len(expected), "files_different": len(different),
                "energy_closure": float(f"{closure['value']:.3g}"),
                "energy_drift_over_strain": float(f"{drift(whole.out):.3g}"), "memory_start_MB": round(1e-6 * first, 2),
                "memory_end_MB": round(1e-6 * last, 2), **origin(whole.out)}
    fact("soak", **seen)
    if options.record:
        keep_record(options.record, seen)
    faults = [f"{name} differs" for name in different]
    if not closure["ok"]:
        faults.append("the energy balance does not close")
    if more > LEAST_GROWTH:
        faults.append(f"the memory grew by {last - first:.0f} bytes, {more:.0f} more than the history")
    if options.distance == "65 mm" and seen["steps"] < MILLION:
        faults.append(f"{seen['steps']} steps are no million")
    if again["run"]["steps"] != summary["run"]["steps"]:
        faults.append("the numbers of steps differ")
    print("\n".join(faults) or "sound")
    return len(faults) > 0


if __name__ == "__main__":
    sys.exit(main())
