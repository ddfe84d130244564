#!/usr/bin/python3
"""Keeps the small results of a finished study: tables, centre lines and summaries as a few files of text, a picture.

    tools/record_study.py results/study cases/paper/recorded/study [--equal-cells results/equal_cells]

Copies study.csv, published.csv, claims.csv and, without folders, provenance.json; gathers every case's centre line in
centre_lines.csv (five digits) and every summary in summaries.json; with --equal-cells also the half-space cases on
cells as large as the elements and the agreement of the engines (tools/engine_agreement.py). Files that are not there
are left out and named.
"""
import argparse
import csv
import json
import pathlib
import shutil
import subprocess
import sys


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def five_digits(text):
    try:
        return f"{float(text):.5g}"
    except ValueError:
        return text


def without_folders(value):
    """The same with the names of files in place of their paths: where a study was computed is nobody's business."""
    if isinstance(value, dict):
        return {key: without_folders(v) for key, v in value.items() if key != "host"}
    if isinstance(value, list):
        return [without_folders(v) for v in value]
    return pathlib.Path(value).name if isinstance(value, str) and "/" in value else value


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=pathlib.Path)
    parser.add_argument("to", type=pathlib.Path)
    parser.add_argument("--equal-cells", type=pathlib.Path)
    args = parser.parse_args()
    args.to.mkdir(parents=True, exist_ok=True)

    missing = []
    for name in ("study.csv", "published.csv", "claims.csv"):
        if (args.study / name).exists():
            shutil.copyfile(args.study / name, args.to / name)
        else:
            missing.append(name)
    provenance = without_folders(json.loads((args.study / "provenance.json").read_text(encoding="utf-8")))
    (args.to / "provenance.json").write_text(json.dumps(provenance, indent=1) + "\n", encoding="utf-8")

    lines, summaries = [], {}
    for row in table(args.study / "study.csv"):
        folder = args.study / row["folder"]
        where = [row["group"], row["case"], row["engine"]]
        if row["state"] != "done":
            missing.append("/".join(where))
            continue
        lines += [where + [five_digits(value) for value in r.values()] for r in table(folder / "centre_line.csv")]
        names = ["group", "case", "engine", *table(folder / "centre_line.csv")[0].keys()]
        summaries["/".join(where)] = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    with open(args.to / "centre_lines.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([names, *lines])
    text = json.dumps(summaries, indent=1)
    (args.to / "summaries.json").write_text(text + "\n", encoding="utf-8")

    if args.equal_cells:
        shutil.copyfile(args.equal_cells / "study.csv", args.to / "equal_cells.csv")
        tool = pathlib.Path(__file__).with_name("engine_agreement.py")
        subprocess.run([tool, args.study / "study.csv", "--equal-cells", args.equal_cells / "study.csv", "--csv",
                        args.to / "agreement.csv"], check=False, stdout=subprocess.DEVNULL)
    for name in missing:
        print(f"not there: {name}", file=sys.stderr)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
