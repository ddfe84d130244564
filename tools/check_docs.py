#!/usr/bin/env python3
"""Checks the pages of the project, and the files that hosting services and citation tools read.

usage: check_docs.py [--wrap] [ROOT]

- files and headings that a page names exist; prose is at most 120 characters a line (--wrap wraps what is longer);
- a page of docs/ that a person writes has at most 3,000 words, README.md at most 90 lines;
- docs/images/rooms.svg shows the rooms as they are (tools/draw_rooms.py);
- CHANGELOG.md: versions with dates, newest first, the version of CMakeLists.txt among them;
- CITATION.cff: the required keys of CFF 1.2.0, the newest version of CHANGELOG.md;
- YAML files below .github can be read, and commands of the project that they call exist.
Exit code: 0 all well, 1 something is wrong.
"""
import datetime
import pathlib
import re
import sys
import tempfile
import textwrap

import yaml

import check_layers
import draw_rooms

ROOT = pathlib.Path(__file__).resolve().parent.parent
WIDTH = 120
GENERATED = {"docs/case-reference.md", "docs/exclusions.md", "docs/validation.md"}
MOST_WORDS, MOST_LINES = 3000, {"README.md": 90}
REFERENCES = {"docs/results-reference.md"}  # written by the program, as long as they have to be
LEFT_OUT = re.compile(r"(^|/)(build[^/]*|results|runs|node_modules|dist|\.git)/")
LIST_ITEM = re.compile(r"^\s*([-*]|\d+\.)\s+")
CODE, KEPT = re.compile(r"`[^`]{1,60}`"), "\x00"  # code that is not broken; what stands for its blanks
RELEASE = re.compile(r"^## \[(\d+\.\d+\.\d+)\] - (\d{4}-\d\d-\d\d)$", re.M)


def pages(root):
    """All Markdown pages, those that the program writes left out."""
    found = {page: page.relative_to(root).as_posix() for page in root.rglob("*.md")}
    return sorted(page for page, name in found.items() if not LEFT_OUT.search(name) and name not in GENERATED)


# -- length of lines ------------------------------------------------------------------------------------------------


def blocks(text):
    """(is prose, lines): paragraphs and list items are prose; code, tables, headings and comments are not."""
    fenced = generated = False
    out = []
    for line in text.splitlines():
        fence = line.lstrip().startswith("```")
        generated = (generated or line.startswith("<!-- table of")) and not line.startswith("<!-- end")
        indented = line.startswith("    ") and not (out and out[-1][0])
        plain = fenced or fence or generated or indented or not line.strip() or re.match(r"\s*[|<#>!]", line)
        if plain or not out or not out[-1][0] or LIST_ITEM.match(line):
            out.append((not plain, [line]))
        else:
            out[-1][1].append(line)
        fenced ^= fence
    return out


def wrapped(lines):
    """A paragraph or list item with lines of at most WIDTH characters."""
    first = LIST_ITEM.match(lines[0])
    indent = " " * (len(first.group(0)) if first else len(lines[0]) - len(lines[0].lstrip()))
    words = CODE.sub(lambda code: code.group(0).replace(" ", KEPT), " ".join(line.strip() for line in lines))
    start = lines[0][: len(lines[0]) - len(lines[0].lstrip())]
    out = textwrap.wrap(
        words, WIDTH, initial_indent=start, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
    )
    return [line.replace(KEPT, " ") for line in out]


def wrap(text):
    out = []
    for prose, lines in blocks(text):
        longest = max(len(line) for line in lines)
        out += wrapped(lines) if prose and longest > WIDTH else lines
    return "\n".join(out) + "\n"


def long_lines(page, text):
    if wrap(text) == text:
        return []
    ours, theirs = text.splitlines(), wrap(text).splitlines()
    number = next((k for k, (a, b) in enumerate(zip(ours, theirs), 1) if a != b), len(theirs))
    return [f"{page}:{number}: a line is longer than {WIDTH}; tools/check_docs.py --wrap wraps it"]


def too_long(name, text):
    """Of a page by its name in the repository: more words than a page of docs/ has, more lines than README.md has."""
    words, lines = len(text.split()), len(text.splitlines())
    if name.startswith("docs/") and name not in REFERENCES and words > MOST_WORDS:
        return [f"{name}: {words} words, of at most {MOST_WORDS}; make two pages of it (theory, use, verification)"]
    if lines > MOST_LINES.get(name, lines):
        return [f"{name}: {lines} lines, of at most {MOST_LINES[name]}; move what is not for everybody to docs/"]
    return []


# -- links ----------------------------------------------------------------------------------------------------------


def anchors(text):
    """What a hosting service calls the headings of a page."""
    headings = re.findall(r"^#+ +(.*)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def missing_headings(page, text):
    out = []
    for number, line in enumerate(text.splitlines(), 1):
        for file, heading in re.findall(r"\]\(([^)\s#]*)#([^)\s]+)\)", line):
            target = page.parent / file if file else page
            if "://" in file or target.suffix != ".md" or not target.exists():
                continue
            if heading not in anchors(target.read_text()):
                out.append(f"{page}:{number}: {file or page.name} has no heading #{heading}")
    return out


# -- changelog, citation, hosting service -----------------------------------------------------------------------------


def check_changelog(text, version):
    releases = RELEASE.findall(text)
    out = []
    if not releases:
        return ["CHANGELOG.md: no release (\"## [1.2.3] - 2026-01-31\")"]
    numbers = [tuple(map(int, release.split("."))) for release, _ in releases]
    if numbers != sorted(numbers, reverse=True) or len(set(numbers)) != len(numbers):
        out.append("CHANGELOG.md: releases do not go from the newest to the oldest")
    for release, date in releases:
        try:
            datetime.date.fromisoformat(date)
        except ValueError:
            out.append(f"CHANGELOG.md: {release}: {date} is no date")
    headings = re.findall(r"^## (.*)$", text, re.M)
    odd = [h for h in headings if h != "[Unreleased]" and not RELEASE.match(f"## {h}")]
    out += [f"CHANGELOG.md: \"{h}\" is neither a release nor [Unreleased]" for h in odd]
    if version not in [release for release, _ in releases]:
        out.append(f"CHANGELOG.md: version {version} of CMakeLists.txt is not there")
    return out


def check_citation(text, newest):
    """Required keys of the Citation File Format 1.2.0: cff-version, message, title, authors (persons or entities)."""
    try:
        data = yaml.safe_load(text)
    except yaml.YAMLError as fault:
        return [f"CITATION.cff: {fault}"]
    missing = [key for key in ("cff-version", "message", "title", "authors") if not (data or {}).get(key)]
    if missing:
        return [f"CITATION.cff: {key} is missing" for key in missing]
    out = []
    if data["cff-version"] != "1.2.0":
        out.append("CITATION.cff: cff-version is not 1.2.0")
    if data.get("type", "software") not in ("software", "dataset"):
        out.append("CITATION.cff: type is neither software nor dataset")
    for author in data["authors"]:
        if not ({"name"} & set(author) or {"family-names", "given-names", "alias"} & set(author)):
            out.append("CITATION.cff: an author has no name")
    if str(data.get("version", newest)) != newest:
        out.append(f"CITATION.cff: version {data['version']} is not the newest of CHANGELOG.md, {newest}")
    date = data.get("date-released")
    if date is not None and not isinstance(date, datetime.date):
        out.append(f"CITATION.cff: date-released {date} is no date")
    return out


def check_yaml(file, root):
    """The file can be read; `./railstrata WORD` of its commands is a word of the front door."""
    try:
        yaml.safe_load(file.read_text())
    except yaml.YAMLError as fault:
        return [f"{file}: {fault}"]
    door = (root / "railstrata").read_text()
    known = set(re.findall(r"^  (\w+)\)", door, re.M))
    called = set(re.findall(r"\./railstrata (\w+)", file.read_text()))
    return [f"{file}: ./railstrata has no {word}" for word in sorted(called - known)]


def check(root):
    out = []
    for page in pages(root):
        text = page.read_text()
        out += check_layers.missing_files(page, [page.parent, root, *check_layers.wings_of([root]), root / "extras"])
        out += missing_headings(page, text) + long_lines(page, text)
        out += too_long(page.relative_to(root).as_posix(), text)
    if (root / "docs/images/rooms.svg").read_text() != draw_rooms.draw(root / "src"):
        out.append("docs/images/rooms.svg: not up to date; write it anew by tools/draw_rooms.py")
    changelog = (root / "CHANGELOG.md").read_text()
    version = re.search(r"^project\(\S+ VERSION (\S+)", (root / "CMakeLists.txt").read_text(), re.M).group(1)
    out += check_changelog(changelog, version)
    newest = (RELEASE.findall(changelog) or [("", "")])[0][0]
    out += check_citation((root / "CITATION.cff").read_text(), newest)
    for file in sorted([*root.glob(".github/**/*.yml"), *root.glob(".github/**/*.yaml")]):
        out += check_yaml(file, root)
    return out


# -- self test ------------------------------------------------------------------------------------------------------


def self_test():
    """Every check catches what it is for and passes what is right."""
    test_wrap()
    test_links()
    changelog = "# Changelog\n## [Unreleased]\n## [0.2.0] - 2026-11-22\n## [0.1.0] - 2026-11-21\n"
    assert check_changelog(changelog, "0.1.0") == []
    assert "not there" in check_changelog(changelog, "0.3.0")[0]
    assert "newest" in check_changelog("## [0.1.0] - 2026-01-01\n## [0.2.0] - 2026-01-01\n", "0.1.0")[0]
    assert "no date" in check_changelog("## [0.1.0] - 2026-13-01\n", "0.1.0")[0]
    assert "neither" in check_changelog(changelog + "## 0.0.1\n", "0.1.0")[0]
    citation = "cff-version: 1.2.0\nmessage: m\ntitle: t\nauthors:\n  - name: a\nversion: 0.2.0\n"
    assert check_citation(citation, "0.2.0") == []
    assert "message is missing" in check_citation(citation.replace("message: m\n", ""), "0.2.0")[0]
    assert "no name" in check_citation(citation.replace("name: a", "city: a"), "0.2.0")[0]
    assert "newest" in check_citation(citation, "0.3.0")[0]
    assert "CITATION.cff" in check_citation("a: [", "0.2.0")[0]


def test_wrap():
    long = "word " * 40
    table, code = f"| {long}|\n", f"```\n{long}\n```\n"
    assert wrap(table + "\n" + code) == table + "\n" + code
    assert wrap("short\nlines stay\n") == "short\nlines stay\n"
    lines = wrap(f"- {long}\n  {long}\n- next\n").splitlines()
    assert all(len(line) <= WIDTH for line in lines) and lines[1].startswith("  word") and lines[-1] == "- next"
    assert all(line.count("`") % 2 == 0 for line in wrap("`--cell \"1 mm\"` " * 20).splitlines())
    assert long_lines("page", f"short\n\n{long}\n")[0].startswith("page:3:")
    assert "3001 words" in too_long("docs/a.md", "word " * 3001)[0] and not too_long("docs/a.md", "word " * 3000)
    assert "91 lines" in too_long("README.md", "\n" * 91)[0] and not too_long("README.md", "\n" * 90)


def test_links():
    with tempfile.TemporaryDirectory() as name:
        page = pathlib.Path(name) / "page.md"
        text = "# One heading, with `code`\n[a](#one-heading-with-code)\n[b](#two) [c](page.md#three)\n"
        page.write_text(text)
        found = missing_headings(page, text)
        assert len(found) == 2 and "#two" in found[0] and "#three" in found[1], found
        bad = pathlib.Path(name) / "bad.yml"
        bad.write_text("steps:\n  - run: ./railstrata frobnicate\n")
        assert "frobnicate" in check_yaml(bad, ROOT)[0]
        bad.write_text("a: [")
        assert "bad.yml" in check_yaml(bad, ROOT)[0]


def main():
    self_test()
    words = [w for w in sys.argv[1:] if w != "--wrap"]
    root = pathlib.Path(words[0]) if words else ROOT
    if "--wrap" in sys.argv[1:]:
        for page in pages(root):
            text = page.read_text()
            if wrap(text) != text:
                page.write_text(wrap(text))
                print(f"wrapped {page}")
    found = check(root)
    print("\n".join(found) or f"{len(pages(root))} pages: files and headings named exist, lines are short")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
