#!/usr/bin/env python3
"""Holds a run's summary.json against what its case is expected to give.

usage: check_expect.py CASE RESULTS            CASE: a case file, or a folder with case.toml; RESULTS: the run's folder
       check_expect.py CASE --run BINARY       runs the case first, in a folder of its own, and wants exit code 0; one
                                               of the folder contact, with a [transient] table, a line contact or a
                                               yawed wheel on a roller by half-spaces, one with [[load]] or
                                               [[bogie]] as a collective, whose numbers stand in collective.json, one
                                               with [collective] too, on coarse cells and without passes for its lives,
                                               one with [passes] as a few passes on coarse cells: passes.json

The expectations of NAME.toml stand beside it in NAME.expect.toml, those of case.toml in expect.toml; one table a
quantity:

    ["contact.F_x_N / contact.F_z_N"]          a path in summary.json, or the quotient of two; checks.NAME is the value
    of a check
    value = 0.2                                with relative or absolute, the allowed difference; or min, max or both
    relative = 0.01
    why = "the case's own demand"              the reference; never left out

Exit code: 0 all met, 1 some not, 2 the expectations or the results cannot be used.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib

KEYS = {"value", "relative", "absolute", "min", "max", "why"}


class Unusable(Exception):
    pass


def case_file(path):
    return path / "case.toml" if path.is_dir() else path


def expect_file(case):
    return case.with_name("expect.toml" if case.name == "case.toml" else case.stem + ".expect.toml")


def bounds(name, entry):
    """Least and largest value an entry allows."""
    if unknown := set(entry) - KEYS:
        raise Unusable(f"{name}: unknown {', '.join(sorted(unknown))}; known: {', '.join(sorted(KEYS))}")
    if not entry.get("why"):
        raise Unusable(f"{name}: says no why")
    if "value" in entry:
        if ("relative" in entry) == ("absolute" in entry) or {"min", "max"} & set(entry):
            raise Unusable(f"{name}: value goes with either relative or absolute")
        allowed = entry["absolute"] if "absolute" in entry else entry["relative"] * abs(entry["value"])
        low, high = entry["value"] - allowed, entry["value"] + allowed
    elif {"min", "max"} & set(entry) and not {"relative", "absolute"} & set(entry):
        low, high = entry.get("min", -math.inf), entry.get("max", math.inf)
    else:
        raise Unusable(f"{name}: needs value, min or max")
    if not low <= high:
        raise Unusable(f"{name}: allows nothing")
    return low, high


def look_up(summary, path):
    """The number at a dotted path; None where the summary has null or nothing."""
    found = {**summary, "checks": {check["name"]: check["value"] for check in summary.get("checks", [])}}
    for key in path.strip().split("."):
        if isinstance(found, list) and key.isdigit() and int(key) < len(found):
            found = found[int(key)]
            continue
        if not isinstance(found, dict) or key not in found:
            return None
        found = found[key]
    return found if isinstance(found, (int, float)) else None


def quantity(summary, name):
    numbers = [look_up(summary, path) for path in name.split(" / ")]
    if None in numbers or len(numbers) > 2:
        return None
    if len(numbers) == 1:
        return numbers[0]
    return numbers[0] / numbers[1] if numbers[1] else None


def compare(summary, expectations):
    """One (met, line of the report) per entry."""
    if not expectations:
        raise Unusable("no expectations")
    for name, entry in expectations.items():
        low, high = bounds(name, entry)
        found = quantity(summary, name)
        met = found is not None and low <= found <= high
        shown = "nothing" if found is None else f"{found:.6g}"
        yield met, f"{'ok    ' if met else 'FAILED'} {name} = {shown}, wanted {low:.6g} to {high:.6g}: {entry['why']}"


def command_for(case):
    tables = tomllib.loads(case.read_text())
    geometry = tables.get("geometry", {})
    yawed_on_roller = {"yaw", "rail_radius"} <= set(geometry)
    by_half_spaces = (case.absolute().parent.name in ("contact", "crack") or "transient" in tables or yawed_on_roller or
                      geometry.get("contact") == "line")
    if "collective" in tables:
        return ["collective", "--set", "life.until=0 Mt", "--cell", "1 mm"]
    if "bogie" in tables:
        return ["collective", "--cell", "0.5 mm"]
    if "passes" in tables:
        return ["passes", "--passes", "8", "--cell", "1 mm"]
    return ["collective" if "load" in tables else "bem" if by_half_spaces else "run"]


def results_in(folder):
    """The file with the numbers of a folder."""
    others = [folder / name for name in ("collective.json", "passes.json") if (folder / name).exists()]
    return others[0] if others else folder / "summary.json"


def run_case(binary, case, out):
    words = [binary, "--quiet", *command_for(case), case, "--no-report", "--out", out]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        print(f"{done.stdout}{done.stderr}FAILED exit code {done.returncode}, wanted 0")
    return done.returncode == 0


def check(case, results):
    expectations = tomllib.loads(expect_file(case).read_text())
    all_met = True
    for met, line in compare(json.loads(results_in(results).read_text()), expectations):
        all_met = all_met and met
        print(line)
    return all_met


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=pathlib.Path)
    parser.add_argument("results", type=pathlib.Path, nargs="?")
    parser.add_argument("--run", metavar="BINARY", type=pathlib.Path)
    words = parser.parse_args()
    if (words.results is None) == (words.run is None):
        parser.error("either RESULTS or --run BINARY")
    case = case_file(words.case)
    try:
        if words.results:
            return 0 if check(case, words.results) else 1
        with tempfile.TemporaryDirectory() as out:
            ran = run_case(words.run.resolve(), case, out)
            met = results_in(pathlib.Path(out)).exists() and check(case, pathlib.Path(out))
            return 0 if ran and met else 1
    except (Unusable, OSError, ValueError) as fault:
        print(f"error: {fault}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
