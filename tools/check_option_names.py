#!/usr/bin/env python3
"""Holds every option that a string of src/ or extras/ names ("a smaller run.step_safety") against those of a case.

usage: check_option_names.py RAILSTRATA FOLDER...

RAILSTRATA is the program: its `info --schema` lists tables, keys and the words of choices.
"""
import json
import pathlib
import re
import subprocess
import sys

TEXT = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
FILE_ENDINGS = (".toml", ".json", ".csv", ".h5", ".html", ".md")
PLACEHOLDER = "key"  # "layer.0.key" stands for any key


def keys_of(schema):
    """Full name of every key ("drive.speed", "layer.width", "material.rail.young") -> its words, or None."""
    out = {}

    def add(name, node):
        node = (node.get("items", node) if node.get("type") == "array" and "properties" in node.get("items", {})
                else node)
        if "properties" not in node:
            out[name] = node.get("enum")
            return
        for key, child in node["properties"].items():
            add(f"{name}.{key}" if name else key, child)

    add("", schema)
    return out


def texts_of(source):
    """String literals without comments and includes, adjacent ones joined; with the line where each begins."""
    source = re.sub(r"^\s*#include[^\n]*$|//[^\n]*", "", source, flags=re.M)
    source = re.sub(r'"(\s*\n\s*)"', lambda m: "\0" * m.group(1).count("\n"), source)
    for match in TEXT.finditer(source):
        line = source.count("\n", 0, match.start()) + source.count("\0", 0, match.start()) + 1
        yield line, match.group(1).replace("\0", "").replace("\\n", " ").replace('\\"', '"')


def complaints(text, keys):
    """What a text names that no case has."""
    tables = sorted({key.rsplit(".", 1)[0] for key in keys}, key=len, reverse=True)
    named = re.compile(r"(?<![\w./])(?:" + "|".join(map(re.escape, tables)) + r")\.[\w.{}]*\w(?: = \"\w+\")?")
    for match in named.finditer(text):
        name, _, word = match.group(0).partition(" = ")
        if name.endswith(FILE_ENDINGS):
            continue
        key = re.sub(r"\.(\d+|\{\})\.", ".", name)
        if key.endswith("." + PLACEHOLDER):
            continue
        if key not in keys:
            yield f"there is no option {name}"
        elif word and keys[key] and word.strip('"') not in keys[key]:
            yield f"{name} is never {word}: {', '.join(keys[key])}"


def check(folders, keys):
    found, names = [], 0
    for file in sorted(f for folder in folders for f in folder.rglob("*")
                       if f.suffix in {".hpp", ".cpp"} and "tests" not in f.relative_to(folder).parts):
        for line, text in texts_of(file.read_text()):
            names += any(key in text for key in keys)
            found += [f"{file}:{line}: {reason}" for reason in complaints(text, keys)]
    assert names > 20, "the strings of src/ name options: none was seen"
    return found


def self_test():
    schema = {"properties": {"run": {"properties": {"step_safety": {}, "precision": {"enum": ["double", "single"]}}},
                             "layer": {"type": "array", "items": {"properties": {"width": {}}}},
                             "material": {"properties": {"rail": {"properties": {"young": {}}}}}}}
    keys = keys_of(schema)
    assert sorted(keys) == ["layer.width", "material.rail.young", "run.precision", "run.step_safety"], keys
    source = ('#include "run.hpp"\nf("a smaller run.step_safety, "\n  "or run.step_safty");  // "run.comment"\n'
              'g("run.precision = \\"half\\"");\n')
    wrong = [(line, reason) for line, text in texts_of(source) for reason in complaints(text, keys)]
    assert wrong == [(2, "there is no option run.step_safty"),
                     (4, 'run.precision is never "half": double, single')], wrong
    for fine in ["layer.0.width", "layer.{}.width of layer.key", "case.toml", "run.json", 'run.precision = "single"',
                 "material.rail.young"]:
        assert not list(complaints(fine, keys)), fine


def main():
    self_test()
    program, folders = sys.argv[1], [pathlib.Path(word) for word in sys.argv[2:]]
    schema = json.loads(subprocess.run([program, "info", "--schema"], capture_output=True, text=True,
                                       check=True).stdout)
    found = check(folders, keys_of(schema))
    print("\n".join(found) or f"{', '.join(map(str, folders))}: every option that a text names is there")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
