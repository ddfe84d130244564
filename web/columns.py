#!/usr/bin/env python3
"""src/columns.ts from the program's list of results: symbol, label, unit, factor and digits are said there alone.
usage: columns.py BINARY [--check]      --check: compares, writes nothing"""
import json
import pathlib
import subprocess
import sys

FILE = pathlib.Path(__file__).resolve().parent / "src/columns.ts"
HEAD = """// Written by columns.py from `railstrata schema --results`: numbers of summary.json, how they are shown.
// clang-format off

export interface Column {
  path: string;  // "contact/p_max_Pa"
  name: string;
  label: string;                                       // short
  unit: {si: string; shown: string; factor: number};  // factor: from SI to what is shown
  digits: number;
}

const column = (
    path: string, name: string, label: string, [si, shown, factor]: [string, string, number],
    digits: number): Column => ({path, name, label, unit: {si, shown, factor}, digits});

"""


def line_of(row):
    """A call of `column`, broken where it is too long for a line."""
    first, second, *rest = (json.dumps(row[key], ensure_ascii=False) for key in ("path", "name", "label", "digits"))
    unit = ", ".join(json.dumps(row["unit"][key], ensure_ascii=False) for key in ("si", "shown", "factor"))
    words = [first, second, rest[0], f"[{unit}]", rest[1]]
    line = f"  column({', '.join(words)}),"
    return line if len(line) <= 120 else f"  column(\n      {', '.join(words[:3])},\n      {', '.join(words[3:])}),"


def text_of(schema):
    lists = [("kColumns: Column[]", [line_of(row) for row in schema["numbers"]])]
    for name, rows in (("kZones", schema["zones"]), ("kMeasures", schema["measures"])):
        pairs = [f'  {row["key"]}: {json.dumps(row["name"], ensure_ascii=False)},' for row in rows]
        lists.append((f"{name}: Record<string, string>", pairs))
    texts = []
    for name, lines in lists:
        left, right = "[]" if name.endswith("[]") else "{}"
        texts.append(f"export const {name} = {left}\n" + "\n".join(lines) + f"\n{right};\n")
    return HEAD + "\n".join(texts)


def main():
    done = subprocess.run([sys.argv[1], "schema", "--results"], capture_output=True, text=True, check=True)
    text = text_of(json.loads(done.stdout))
    if "--check" not in sys.argv:
        FILE.write_text(text)
    elif FILE.read_text() != text:
        sys.exit("web/src/columns.ts is not the program's list of results: run web/columns.py, then `npm run build`")


if __name__ == "__main__":
    main()
