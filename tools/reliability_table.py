#!/usr/bin/env python3
"""The table of tests/records/README.md: each promise of docs/reliability.toml, its tests, what was seen, the command
that repeats it.

usage: reliability_table.py collect BUILD [--only WORD]   run the commands (those with WORD in them) and keep what they
print in tests/records/facts.json
       reliability_table.py write [--partly]              the table from facts and records into the page; a promise
       without a figure is an error, or with --partly "not seen yet"
       reliability_table.py check BUILD                   the page has a line for each promise, every test that they
       name is one of CTest, every command is there

Tests print facts as lines `RELIABILITY {"fact": NAME, ...}`; long campaigns keep records, CSV files with a line each.
"""
import collections
import csv
import datetime
import json
import pathlib
import re
import subprocess
import sys
import tomllib
import types

SOURCE = pathlib.Path(__file__).resolve().parent.parent
PAGE, PROMISES = SOURCE / "tests/records/README.md", SOURCE / "docs/reliability.toml"
FACTS = SOURCE / "tests/records/facts.json"
START, END = "<!-- table of tools/reliability_table.py -->", "<!-- end of the table -->"


def number(text):
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


class Column:
    """A column of a record, for the words of a promise: `tests.sum`, `preset[tsan].tests.sum` (of the lines with this
    cell), `executions.sums_by[reader].min`."""

    def __init__(self, name, rows):
        self.name, self.rows = name, rows
        self.values = [number(r[name]) for r in rows]
        self.last, self.count = self.values[-1], len(self.values)
        self.all = ", ".join(dict.fromkeys(map(str, self.values)))

    min = property(lambda self: min(self.values))
    max = property(lambda self: max(self.values))
    sum = property(lambda self: sum(self.values))

    def __getitem__(self, cell):
        return of_rows([r for r in self.rows if r[self.name] == cell], f"{self.name} {cell}")

    @property
    def sums_by(self):
        return SumsBy(self)


class SumsBy:
    """Sums of a column over the lines that have the same cell in another."""

    def __init__(self, column):
        self.column = column

    def __getitem__(self, other):
        sums = collections.Counter()
        for row, value in zip(self.column.rows, self.column.values):
            sums[row[other]] += value
        return Column("sum", [{"sum": value} for value in sums.values()])


def of_rows(rows, of_what):
    if not rows:
        raise LookupError(f"{of_what} has no line")
    return types.SimpleNamespace(**{name: Column(name, rows) for name in rows[0]})


def record(file):
    return of_rows(list(csv.DictReader(line for line in file.read_text().splitlines() if not line.startswith("#"))),
                   file)


def known_facts():
    return json.loads(FACTS.read_text()) if FACTS.exists() else {}


def figure(promise, facts):
    """What was seen; LookupError if nothing was."""
    if "records" in promise:
        names = {name: record(SOURCE / file) for name, file in promise["records"].items()}
    else:
        names = {name: types.SimpleNamespace(**values) for name, values in facts[promise["command"]]["facts"].items()}
    try:
        return promise["seen"].format(**names)
    except (AttributeError, KeyError) as e:
        raise LookupError(f"no {e}") from e


def cell(text):
    return text.replace("|", "\\|")


def table(partly):
    facts, lines, missing = known_facts(), ["| promise | tests | seen | command |", "|---|---|---|---|"], []
    for promise in tomllib.loads(PROMISES.read_text())["promise"]:
        try:
            seen = figure(promise, facts)
        except (LookupError, OSError) as e:
            seen = "not seen yet"
            missing.append(f"no figure for \"{promise['text']}\": {e}")
        cells = [promise["text"], ", ".join(f"`{t}`" for t in promise["tests"]), seen, f"`{promise['command']}`"]
        lines.append("| " + " | ".join(map(cell, cells)) + " |")
    if missing:
        print("\n".join(missing), file=sys.stderr)
        if not partly:
            sys.exit(1)
    stamps = sorted({f"{f['program']} on {f['cpu']}" for f in facts.values()})
    lines += ["", f"Seen by the tests of {', '.join(stamps)}; the records say their own."]
    return "\n".join(lines)


def page_with(text):
    page = PAGE.read_text()
    if page.count(START) != 1 or page.count(END) != 1:
        sys.exit(f"{PAGE}: no place for the table ({START} ... {END})")
    return page[:page.index(START)] + f"{START}\n{text}\n" + page[page.index(END):]


def collect(build, only):
    facts = known_facts()
    promises = tomllib.loads(PROMISES.read_text())["promise"]
    wanted = {p["command"] for p in promises if "records" not in p}
    facts = {command: f for command, f in facts.items() if command in wanted}
    info = json.loads(subprocess.run([build / "railstrata-bin", "info", "--json"], capture_output=True, text=True,
                                     check=True).stdout)
    for command in dict.fromkeys(p["command"] for p in promises if p["command"] in wanted and only in p["command"]):
        print(command, file=sys.stderr, flush=True)
        done = subprocess.run(re.sub(r"(?<=[ =])build(?=[ /]|$)", str(build), command), shell=True, cwd=SOURCE,
                              capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{command}: exit code {done.returncode}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
        seen = {}
        for text in re.findall(r"RELIABILITY (\{.*\})", done.stdout):
            fact = json.loads(text)
            seen[fact.pop("fact")] = fact
        if passed := re.search(r"% tests passed, (\d+) tests? failed out of (\d+)", done.stdout):
            seen["ctest"] = {"passed": int(passed[2]) - int(passed[1]), "tests": int(passed[2])}
        facts[command] = {"facts": seen, "program": info["version"], "cpu": info["cpu"],
                          "date": datetime.date.today().isoformat()}
        FACTS.parent.mkdir(exist_ok=True)
        FACTS.write_text(json.dumps(facts, indent=1, sort_keys=True) + "\n")


def check(build):
    faults = []
    page = PAGE.read_text()
    listed = subprocess.run(["ctest", "--test-dir", build, "-N"], capture_output=True, text=True).stdout
    tests = re.findall(r"Test +#\d+: (\S+)", listed)
    for promise in tomllib.loads(PROMISES.read_text())["promise"]:
        if f"| {cell(promise['text'])} |" not in page:
            faults.append(f"{PAGE} lacks \"{promise['text']}\": tools/reliability_table.py write")
        for name in promise["tests"]:
            if not any(t == name or t.startswith(name + ".") for t in tests):
                faults.append(f"there is no test {name}")
        for script in re.findall(r"^(?:tests|tools)/\S+", promise["command"]):
            if not (SOURCE / script).exists():
                faults.append(f"there is no {script}")
    print("\n".join(faults) or f"{len(tests)} tests known, the promises name none but them")
    return len(faults) > 0


def main():
    match sys.argv[1:]:
        case ["collect", build, *rest] if rest[:1] in ([], ["--only"]) and len(rest) in (0, 2):
            collect(pathlib.Path(build).resolve(), rest[1] if rest else "")
        case ["write", *rest] if rest in ([], ["--partly"]):
            PAGE.write_text(page_with(table(bool(rest))))
        case ["check", build]:
            return check(pathlib.Path(build).resolve())
        case _:
            sys.exit(__doc__)


if __name__ == "__main__":
    sys.exit(main())
