#!/usr/bin/python3
"""Keeps the small results of a finished study: tables, centre lines and summaries as a few files of text, a picture.

    tools/record_study.py results/study cases/paper/recorded/study [--equal-cells results/equal_cells]
    tools/record_study.py results/study cases/paper/recorded/study --anew bem [--equal-cells results/equal_cells]

Copies study.csv and, without folders, provenance.json; gathers every case's centre line in centre_lines.csv (five
digits) and every summary in summaries.json; with --equal-cells also the half-space cases on cells as large as the
elements and the agreement of the engines (tools/engine_agreement.py). Cases without a result are left out and named.

--anew bem records the half-space results alone (`railstrata study … --engine bem`); what is there of the finite
elements stays, with the program that computed it in provenance.json, that of the half-spaces in provenance_bem.json.
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
    """The same with the names of files in place of their paths: the place where a study was computed is private."""
    if isinstance(value, dict):
        return {key: without_folders(v) for key, v in value.items() if key != "host"}
    if isinstance(value, list):
        return [without_folders(v) for v in value]
    return pathlib.Path(value).name if isinstance(value, str) and "/" in value else value


def remarks(path):
    with open(path, encoding="utf-8") as file:
        return [line for line in file if line.startswith("#")]


def write_table(path, head, names, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        file.writelines(head)
        out = csv.DictWriter(file, names, restval="", lineterminator="\n")
        out.writeheader()
        out.writerows(rows)


def case_of(row):
    return row["group"], row["case"], row["engine"]


def study_anew(old, new, to):
    """Rows of half-spaces from `new`, the others of `old`, in the order of `old`; the columns of `new`."""
    theirs = {case_of(row): row for row in table(new)}
    rows = [theirs[case_of(row)] if row["engine"] == "bem" else row for row in table(old)]
    names = list(next(iter(theirs.values())))
    lost = [name for name in rows[0] if name not in names]
    if lost:
        sys.exit(f"columns that are no more: {', '.join(lost)}")
    program = remarks(new)[0].removeprefix("# ")
    head = [line for line in remarks(old) if not line.startswith("# half-spaces: ")] + [f"# half-spaces: {program}"]
    write_table(to, head, names, rows)
    return {case_of(row): row for row in rows}


def half_spaces_anew(args):
    """Returns the study's rows for what follows."""
    study = study_anew(args.to / "study.csv", args.study / "study.csv", args.to / "study.csv")
    recorded = table(args.to / "centre_lines.csv")
    names, lines = list(recorded[0]), []
    summaries = json.loads((args.to / "summaries.json").read_text(encoding="utf-8"))
    for (group, case, engine), row in study.items():
        if engine != "bem":
            lines += [line for line in recorded if case_of(line) == (group, case, engine)]
            continue
        folder = args.study / row["folder"]
        where = dict(zip(names, (group, case, engine)))
        lines += [where | {name: five_digits(r[name]) for name in names if name in r}
                  for r in table(folder / "centre_line.csv")]
        summaries[f"{group}/{case}/bem"] = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    write_table(args.to / "centre_lines.csv", [], names, lines)
    (args.to / "summaries.json").write_text(json.dumps(summaries, indent=1) + "\n", encoding="utf-8")
    provenance = without_folders(json.loads((args.study / "provenance.json").read_text(encoding="utf-8")))
    (args.to / "provenance_bem.json").write_text(json.dumps(provenance, indent=1) + "\n", encoding="utf-8")


def record_agreement(args, study):
    shutil.copyfile(args.equal_cells / "study.csv", args.to / "equal_cells.csv")
    tool = pathlib.Path(__file__).with_name("engine_agreement.py")
    subprocess.run([tool, study, "--equal-cells", args.equal_cells / "study.csv", "--csv", args.to / "agreement.csv"],
                   check=False, stdout=subprocess.DEVNULL)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=pathlib.Path)
    parser.add_argument("to", type=pathlib.Path)
    parser.add_argument("--equal-cells", type=pathlib.Path)
    parser.add_argument("--anew", choices=["bem"])
    args = parser.parse_args()
    if args.anew:
        half_spaces_anew(args)
        if args.equal_cells:
            record_agreement(args, args.to / "study.csv")
        return 0
    args.to.mkdir(parents=True, exist_ok=True)

    shutil.copyfile(args.study / "study.csv", args.to / "study.csv")
    provenance = without_folders(json.loads((args.study / "provenance.json").read_text(encoding="utf-8")))
    (args.to / "provenance.json").write_text(json.dumps(provenance, indent=1) + "\n", encoding="utf-8")

    missing, lines, summaries = [], [], {}
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
        record_agreement(args, args.study / "study.csv")
    for name in missing:
        print(f"not there: {name}", file=sys.stderr)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
