#!/usr/bin/python3
"""Finite elements against half-spaces, case by case, from the table of a study:

    tools/engine_agreement.py results/study/study.csv [--equal-cells results/equal_cells/study.csv]
                              [--csv agreement.csv] [--element-mm 1]

Differences in per cent of the half-space value, with the limits of the study's page, asked of the program
(`railstrata info --schema --results`). --equal-cells: a table of the same half-space cases on cells as large as the
elements;
a q_max that differs from the study's fine cells and agrees there is a matter of resolution. The von Mises stress is the
largest deeper than an element, border of the layer included; in brackets, and not judged, where the half-space's
largest lies shallower. Prints a Markdown table, one row a case. Exit code 1 if a case has no row by one of the engines.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import sys

PROGRAM = pathlib.Path(__file__).resolve().parent.parent / "railstrata"
COLUMNS = {"p_max": "p_max_MPa", "patch_length": "patch_length_mm", "q_max": "q_max_MPa",
           "von_mises_below_surface": "von_mises"}


def limits(program):
    """Per cent by column, as the program has them."""
    checks = json.loads(subprocess.run([program, "info", "--schema", "--results"], check=True, capture_output=True,
                                       text=True).stdout)["checks"]
    return {COLUMNS[c["key"]]: 100 * c["fem_limit"] for c in checks if c["kind"] == "engines"}


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return {(r["group"], r["case"], r["engine"]): r
                for r in csv.DictReader(line for line in file if not line.startswith("#"))}


def difference(a, b, column):
    """Per cent of b; None where one of the values is missing."""
    if not a or not b or not a.get(column) or not b.get(column):
        return None
    return 100 * (float(a[column]) / float(b[column]) - 1)


def point_difference(fem, equal):
    """Of the largest |q| of a point; tables without that column have it as q_max."""
    def of_point(row):
        return row and (row | {"q_max_MPa": row.get("q_max_point_MPa") or row["q_max_MPa"]})
    return difference(of_point(fem), of_point(equal), "q_max_MPa")


def von_mises_below(row, element_mm):
    """The largest below the surface and whether it lies deeper than an element: (MPa, bool)."""
    return (float(row["rail_subsurface_von_mises_MPa"]),
            float(row["rail_subsurface_von_mises_depth_mm"]) > element_mm)


def reason(values, bounds):
    """The cause of an exception, as far as the runs show it."""
    beyond = [c for c, bound in bounds.items() if values[c] is not None and abs(values[c]) > bound
              and (c != "von_mises" or values["deep"])]
    if not beyond:
        return "agrees"
    said = []
    for column in beyond:
        if column == "q_max_MPa" and values["q_equal"] is not None and abs(values["q_equal"]) <= bounds[column]:
            said.append("q_max: resolution, agrees on equal cells")
        else:
            said.append(f"{column.rsplit('_', 1)[0]}: not explained by these runs")
    return "; ".join(said)


def agreement(study, equal, element_mm, bounds):
    out, missing = [], []
    for group, case, engine in study:
        if engine != "fem" or (group, case, "bem") not in study:
            continue
        fem, bem = study[group, case, "fem"], study[group, case, "bem"]
        if fem["state"] != "done" or bem["state"] != "done":
            missing.append(f"{group}/{case}")
            continue
        values = {c: difference(fem, bem, c) for c in bounds if c != "von_mises"}
        (ours, _), (theirs, deep) = von_mises_below(fem, element_mm), von_mises_below(bem, element_mm)
        values["von_mises"], values["deep"] = 100 * (ours / theirs - 1), deep
        values["q_equal"] = point_difference(fem, equal.get((group, case, "bem")))
        out.append({"group": group, "case": case, **values, "verdict": reason(values, bounds)})
    return out, missing


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study")
    parser.add_argument("--equal-cells")
    parser.add_argument("--csv")
    parser.add_argument("--element-mm", type=float, default=1.0)
    parser.add_argument("--program", default=PROGRAM, help="whose limits are taken (default: the front door)")
    args = parser.parse_args()
    table, missing = agreement(rows(args.study), rows(args.equal_cells) if args.equal_cells else {},
                               args.element_mm, limits(args.program))

    def text(value):
        return "" if value is None else f"{value:+.1f} %"

    print("| case | p_max | patch length | q_max, fine cells | q_max, equal cells | von Mises below an element | |")
    print("|---|---|---|---|---|---|---|")
    for r in table:
        print(f"| {r['group']}, {r['case']} | {text(r['p_max_MPa'])} | {text(r['patch_length_mm'])} | "
              f"{text(r['q_max_MPa'])} | {text(r['q_equal'])} | "
              f"{text(r['von_mises']) if r['deep'] else '(' + text(r['von_mises']) + ')'} | {r['verdict']} |")
    if args.csv:
        with open(args.csv, "w", newline="", encoding="utf-8") as file:
            names = {"p_max_MPa": "p_max_percent", "patch_length_mm": "patch_length_percent",
                     "q_max_MPa": "q_max_percent", "q_equal": "q_max_equal_cells_percent",
                     "von_mises": "von_mises_percent", "deep": "von_mises_judged"}
            out = csv.writer(file)
            out.writerow(["group", "case", *names.values(), "verdict"])
            for r in table:
                out.writerow([r["group"], r["case"], *("" if r[c] is None else str(int(r[c])) if isinstance(r[c], bool)
                                                       else f"{r[c]:.2f}" for c in names), r["verdict"]])
    for case in missing:
        print(f"no result by both engines: {case}", file=sys.stderr)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
