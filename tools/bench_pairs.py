#!/usr/bin/python3
"""Two builds of a benchmark program, run alternately: what a change of code or of compiler flags costs.

usage: bench_pairs.py OLD NEW [--filter REGEX] [--rounds 7] [--record FILE.csv --change WORDS]

OLD and NEW are bench_fem or bench_bem of two builds. Each round runs both, the other one first in every second round. A
line's figure is new / old of the medians of processor time over the rounds; processor time because others use the
machine too. Also printed is the spread of OLD's rounds, half the distance of its quartiles over its median: a
difference below it is noise.
Example: tools/bench_pairs.py build-a/bench/bench_fem build-b/bench/bench_fem --filter 'swept_lines.*threads:1'
"""
import argparse
import json
import statistics
import subprocess
import sys

import records


def measure(program, pattern):
    """name -> processor time of every benchmark that the pattern names."""
    command = [program, f"--benchmark_filter={pattern}", "--benchmark_format=json"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{program}: {done.stderr[-2000:]}")
    found = json.loads(done.stdout)["benchmarks"]
    if not found:
        sys.exit(f"{program}: no benchmark matches {pattern}")
    return {b["name"]: b["cpu_time"] for b in found}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--filter", default=".")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--record", help="keeps the ratios in this table")
    parser.add_argument("--change", default="", help="what the new build does otherwise: a column of the record")
    options = parser.parse_args()
    times = {options.old: {}, options.new: {}}
    for turn in range(options.rounds):
        for program in (options.old, options.new) if turn % 2 == 0 else (options.new, options.old):
            for name, value in measure(program, options.filter).items():
                times[program].setdefault(name, []).append(value)
    rows = []
    for name, old in times[options.old].items():
        new = times[options.new].get(name)
        if new is None or len(old) < 2:
            continue
        quartiles = statistics.quantiles(old, n=4)
        middle = statistics.median(old)
        rows.append({"change": options.change, "benchmark": name,
                     "new_over_old": f"{statistics.median(new) / middle:.3f}",
                     "spread_of_old": f"{(quartiles[2] - quartiles[0]) / 2 / middle:.3f}",
                     "rounds": options.rounds, "commit": records.commit()})
        print(f"{name:70} {rows[-1]['new_over_old']} (spread {rows[-1]['spread_of_old']})", flush=True)
    if options.record:
        records.keep(options.record, ["change", "benchmark"], rows)


if __name__ == "__main__":
    main()
