#!/usr/bin/python3
"""Table of a benchmark run with shares of the machine's roofline, and its machine-stamped CSV.

    bench_table.py --csv bench/results/fem.csv --commit COMMIT run.json

run.json: --benchmark_out of a Google Benchmark program. Rates in GF/s and GB/s are divided by those of peak_arithmetic
and memory_traffic on as many threads in the same run; the larger share is what limits. Where a line has a bound,
limit/this above 1 keeps it; CONTACT/this is the factor over CONTACT's own time. Absolute numbers of a machine that
others use mean little: the load average stands in the first lines, and shares and ratios are more reliable.
"""
import argparse
import csv
import json
import platform
import re
import subprocess
import sys


def threads_of(name):
    found = re.search(r"threads:(\d+)", name) or re.search(r"/(\d+)/real_time", name)
    return int(found.group(1)) if found else 1


def compiler():
    try:
        return subprocess.run(["g++", "--version"], capture_output=True, text=True).stdout.splitlines()[0]
    except (OSError, IndexError):
        return "unknown"


def cpu():
    with open("/proc/cpuinfo") as f:
        names = [line.split(":", 1)[1].strip() for line in f if line.startswith("model name")]
    return names[0] if names else platform.machine()


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("run")
    options.add_argument("--csv", required=True)
    options.add_argument("--commit", default="unknown")
    options = options.parse_args()
    with open(options.run) as f:
        run = json.load(f)

    rows = [b for b in run["benchmarks"] if b.get("aggregate_name", "median") == "median"
            and not b.get("error_occurred")]
    peaks = {}  # (unit, number type, threads) -> rate
    for b in rows:
        for unit, kind in (("GF/s", "peak_arithmetic"), ("GB/s", "memory_traffic")):
            if b["name"].startswith(kind):
                peaks[unit, "float" if "float" in b["name"] else "double", threads_of(b["name"])] = b[unit]

    context = run["context"]
    stamp = [
        f"date: {context['date']}",
        f"cpu: {cpu()}, {context['num_cpus']} threads offered at {context['mhz_per_cpu']} MHz",
        f"load average at the start: {', '.join(f'{x:.2f}' for x in context['load_avg'])}",
        f"compiler: {compiler()}",
        f"commit: {options.commit}",
    ]
    columns = ["benchmark", "time", "unit", "Mel-steps/s", "GF/s", "share of arithmetic", "GB/s", "share of memory"]
    table = []
    for b in rows:
        single = "single" in b["name"] and "single:0" not in b["name"] or "float" in b["name"]
        line = {"benchmark": re.sub(r"railstrata::|_median|/real_time|/manual_time|/iterations:1", "", b["name"]),
                "time": f"{b['real_time']:.4g}", "unit": b["time_unit"]}
        for key, value in b.items():
            if isinstance(value, (int, float)) and key not in ("real_time", "cpu_time", "iterations", "repetitions",
                                                               "repetition_index", "family_index",
                                                               "per_family_instance_index", "threads"):
                line[key] = f"{value:.4g}"
        for unit, share in (("GF/s", "share of arithmetic"), ("GB/s", "share of memory")):
            peak = peaks.get((unit, "float" if single and unit == "GF/s" else "double", threads_of(b["name"])))
            if unit in b and peak:
                line[share] = f"{b[unit] / peak:.0%}"
        table.append(line)
    extra = sorted({k for line in table for k in line} - set(columns))
    with open(options.csv, "w", newline="") as f:
        for s in stamp:
            f.write(f"# {s}\n")
        writer = csv.DictWriter(f, columns + extra, lineterminator="\n")
        writer.writeheader()
        writer.writerows(table)

    print("\n".join(stamp))
    shown = [c for c in columns + extra if any(c in line for line in table)]
    widths = {c: max(len(c), *(len(line.get(c, "")) for line in table)) for c in shown}
    print("  ".join(c.ljust(widths[c]) if c == "benchmark" else c.rjust(widths[c]) for c in shown))
    for line in table:
        print("  ".join(line.get(c, "").ljust(widths[c]) if c == "benchmark" else line.get(c, "").rjust(widths[c])
                        for c in shown))
    print(f"kept in {options.csv}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
