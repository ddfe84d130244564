#!/usr/bin/env python3
"""An installed program by each of the instruction sets it was built for: same numbers, and how long each takes.

usage: compare_variants.py PREFIX [--native BINARY] [--case CASE] [--set KEY=VALUE ...] [--rounds 3] [--record FILE.csv]

PREFIX comes from a build with RAILSTRATA_VARIANTS=ON (./railstrata install PREFIX). The loader is kept from the better
variants by GLIBC_TUNABLES, so one machine shows all that it can run. Each round runs every variant, and --native (the
developer's build, build/railstrata-bin) besides, one after the other on one thread; the medians of the rounds' times
and element steps per second count. Exits with 0 if every number lies within 1e-9 of the first row's. The numbers agree
only as far as the preload's iterations go, so compare with --set run.preload_tolerance=1e-10.
Example: tools/compare_variants.py /opt/railstrata --native build/railstrata-bin
           --set run.preload_tolerance=1e-10 --record bench/results/variants.csv
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

import records
from compare_builds import NUMBERS, TOLERANCE, at

# What is taken from the processor so that the loader chooses a variant, and the words of `railstrata info` then.
MASKS = {"x86-64-v4": ("", "AVX-512"), "x86-64-v3": ("-AVX512F", "AVX2"), "x86-64-v2": ("-AVX512F,-AVX2", "SSE2")}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("prefix", type=pathlib.Path)
    parser.add_argument("--native", type=pathlib.Path, help="a program of the developer's build")
    parser.add_argument("--case", type=pathlib.Path, default=records.ROOT / "cases/quick")
    parser.add_argument("--set", action="append", default=[], help="override a key of the case")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--record", type=pathlib.Path)
    return parser.parse_args()


def environment(mask):
    # with these set the program does not start itself once more (src/doors/app/main.cpp)
    out = {**os.environ, "OMP_WAIT_POLICY": "passive", "GOMP_SPINCOUNT": "3000"}
    if mask:
        out["GLIBC_TUNABLES"] = f"glibc.cpu.hwcaps={mask}"
    return out


def variants(options):
    """(name, program, environment) of each that this machine can run."""
    program = options.prefix / "bin/railstrata"
    out = [("native", options.native, environment(""))] if options.native else []
    best = len(MASKS)
    for name, (mask, isa) in MASKS.items():
        done = subprocess.run([program, "info", "--json"], env=environment(mask), capture_output=True, check=True)
        info = json.loads(done.stdout)
        if f"-march={name}" in info["flags"].split():
            if isa not in info["isa"]:
                sys.exit(f"{name} was compiled for {info['isa']}")
            out.append((name, program, environment(mask)))
        else:
            best -= 1
            print(f"{name}: the loader takes another here ({info['flags']})", file=sys.stderr)
    if best < 1:
        sys.exit("the prefix holds no variant; build with RAILSTRATA_VARIANTS=ON")
    return out


def run(program, env, options, folder):
    settings = [word for s in options.set for word in ("--set", s)]
    done = subprocess.run([program, "run", options.case, "--out", folder, "--force", "--quiet", "--no-report",
                           "--threads", "1", *settings], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          env=env)
    if done.returncode not in (0, 1):
        sys.exit(f"{program}: exit code {done.returncode}: {done.stderr}")
    return json.loads((folder / "summary.json").read_text()), json.loads((folder / "provenance.json").read_text())


def main():
    options = arguments()
    found = variants(options)
    times = {name: [] for name, *_ in found}
    rates = {name: [] for name, *_ in found}
    last = {}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            for name, program, env in found:
                summary, origin = run(program, env, options, pathlib.Path(folder) / name)
                times[name].append(summary["run"]["wall_s"])
                rates[name].append(summary["run"]["element_steps_per_s"])
                last[name] = summary, origin
    reference = last[found[0][0]][0]
    base = statistics.median(rates[found[0][0]])
    rows = []
    for name, *_ in found:
        summary, origin = last[name]
        rate = statistics.median(rates[name])
        row = {"variant": name, "isa": origin["isa"].split(",")[0], "wall_s": f"{statistics.median(times[name]):.4g}",
               "element_steps_per_s": f"{rate:.4g}", "rate_over_first": f"{rate / base:.3f}", "rounds": options.rounds}
        for number, pointer in NUMBERS.items():
            wanted = at(reference, pointer)
            row[f"{number}_relative_difference"] = f"{abs(at(summary, pointer) - wanted) / abs(wanted):.3g}"
        rows.append(row | {"case": options.case.name, "set": "; ".join(options.set),
                           "commit": origin["commit"] + ("+dirty" if origin["dirty"] else ""), "cpu": origin["cpu"]})
        print(", ".join(f"{k} {v}" for k, v in row.items()), flush=True)
    if options.record:
        records.keep(options.record, ["variant", "case", "set"], rows)
    worst = max(float(r[f"{number}_relative_difference"]) for r in rows for number in NUMBERS)
    print(f"largest relative difference {worst:.3g} (tolerance {TOLERANCE:.0e})")
    return worst > TOLERANCE


if __name__ == "__main__":
    sys.exit(main())
