#!/usr/bin/env python3
"""The documentation as a site: pages of docs/, cards of cases and rooms, tutorial, interfaces of Python and C.

usage: make_site.py [--out FOLDER] [--run] [ROOT]

Writes the site to FOLDER (default: ROOT/build/site) by MkDocs (Debian: mkdocs, mkdocs-material), strictly: a link to a
page that is not there ends it. --run executes the tutorial for its pictures, with the package in build/python. The
first page leads to web/explore.html, that of the last release. Pages ask for nothing from other machines; the search
needs a server (python3 -m http.server -d FOLDER).
Exit code: 0 done, 1 something is wrong, 77 a program is missing.
"""
import argparse
import ast
import os
import pathlib
import re
import shutil
import subprocess
import sys

# A link, or code, in which there is none.
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)|`[^`\n]+`")
LIST = re.compile(r"^\s*([-*]|\d+\.) ")

# Title, then pages by their place in the repository; those below cases/ and src/ follow by themselves.
SECTIONS = [
    ("Start", ["README.md", "docs/tutorial.ipynb", "docs/commands.md", "docs/windows.md", "docs/conventions.md"]),
    ("Use", ["docs/bem.md", "docs/finite-elements.md", "docs/friction.md", "docs/checks.md", "docs/damage.md",
             "docs/traffic-range.md", "docs/cracks.md", "docs/curve.md", "docs/passes.md", "docs/material.md",
             "docs/study.md",
             "docs/report.md", "docs/explorer.md", "docs/export.md", "docs/creep-table.md", "docs/track.md",
             "docs/validate.md", "docs/gpu.md"]),
    ("Theory", ["docs/bem-theory.md", "docs/bem-sections.md", "docs/finite-elements-theory.md", "docs/damage-theory.md",
                "docs/passes-theory.md"]),
    ("Verification", ["docs/validation.md", "docs/bem-verification.md", "docs/bem-sections-verification.md",
                      "docs/finite-elements-verification.md",
                      "docs/damage-verification.md", "docs/passes-verification.md"]),
    ("Reference", ["docs/case-reference.md", "docs/exclusions.md", "docs/results-reference.md", "CHANGELOG.md"]),
    ("Programming", ["docs/python.md", "python-interface.md", "docs/library.md", "docs/vehicle.md", "c-interface.md",
                     "docs/contact-interface.md"]),
    ("Cases", []),
    ("Development", ["CONTRIBUTING.md", "docs/architecture.md", "docs/reliability.md", "SECURITY.md", "RELEASING.md"]),
]
TITLES = {"README.md": "RailStrata", "docs/tutorial.ipynb": "Tutorial", "CHANGELOG.md": "Changelog",
          "SECURITY.md": "Security", "RELEASING.md": "Releasing"}

CONFIG = """site_name: RailStrata
site_description: Rolling contact of a wheel on a layered rail
docs_dir: pages
site_dir: {site}
use_directory_urls: false
strict: true
theme:
  name: material
  font: false
  icon: {{logo: material/layers}}
  features: [navigation.tabs, navigation.top, search.highlight]
  palette: {{primary: blue grey, accent: teal}}
extra: {{generator: false}}
extra_css: [site.css]
plugins: [search]
markdown_extensions:
  - tables
  - sane_lists
  - pymdownx.superfences
  - pymdownx.highlight
  - toc: {{permalink: true, slugify: !!python/object/apply:pymdownx.slugs.slugify {{kwds: {{case: lower}}}}}}
nav:
{nav}"""

STYLE = """/* names of files and keys in tables stay whole; long tables scroll */
.md-typeset td code { word-break: normal; }
"""


# -- pages that are written from code -------------------------------------------------------------------------------


def signature(node):
    text = ast.unparse(node.args)
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"({text}){returns}".replace("(self, ", "(").replace("(self)", "()")


def is_property(node):
    return any(isinstance(d, ast.Name) and d.id == "property" for d in node.decorator_list)


def python_class(node):
    out = [f"\n## {node.name}\n", ast.get_docstring(node) or "", ""]
    init = [f for f in node.body if isinstance(f, ast.FunctionDef) and f.name == "__init__"]
    if init:
        out.insert(1, f"```python\n{node.name}{signature(init[0])}\n```\n")
    rows = []
    for part in node.body:
        if isinstance(part, ast.FunctionDef) and not part.name.startswith("_"):
            name = f".{part.name}" if is_property(part) else f".{part.name}{signature(part)}"
            what = " ".join((ast.get_docstring(part) or "").split())
            rows.append(f"| `{name}` | {what} |".replace("||", "|"))
        elif isinstance(part, ast.AnnAssign) and isinstance(part.target, ast.Name):
            rows.append(f"| `.{part.target.id}: {ast.unparse(part.annotation)}` | |")
    return "\n".join(out + (["| member | what |", "|---|---|", *rows] if rows else [])) + "\n"


def python_function(level, name, owner, node):
    text = ast.get_docstring(node) or ""
    return f"\n{level} {name}\n\n```python\n{owner}.{name}{signature(node)}\n```\n\n{text}\n"


def python_module(name, tree):
    """A submodule: its text, its functions and the tuples that they give."""
    out = [f"\n## {name}\n\n```text\n{ast.get_docstring(tree)}\n```\n"]
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            out.append(python_function("###", node.name, f"rs.{name}", node))
        elif isinstance(node, ast.ClassDef):
            out.append(python_class(node).replace("\n## ", "\n### ", 1))
    return "\n".join(out)


def python_interface(root):
    """A page of every public name of the package, from its docstrings."""
    folder = root / "python/railstrata"
    trees = [ast.parse(file.read_text()) for file in sorted(folder.glob("*.py"))]
    defined = {node.name: node for tree in trees for node in tree.body
               if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    defined["open"] = defined.get("open_result")
    package = ast.parse((folder / "__init__.py").read_text())
    names = next(ast.literal_eval(node.value) for node in package.body
                 if isinstance(node, ast.Assign) and node.targets[0].id == "__all__")
    out = ["# Python interface\n", "```text", ast.get_docstring(package), "```\n"]
    modules = [name for name in names if (folder / f"{name}.py").exists() and name not in defined]
    missing = [name for name in names if defined.get(name) is None and name not in modules]
    if missing:
        raise SystemExit(f"make_site.py: no definition of {', '.join(missing)}")
    for name in names:
        if name in modules:
            out.append(python_module(name, ast.parse((folder / f"{name}.py").read_text())))
        elif isinstance(defined[name], ast.FunctionDef):
            out.append(python_function("##", name, "rs", defined[name]))
        else:
            out.append(python_class(defined[name]))
    return "\n".join(out)


def c_interface(root):
    """The C header: comments that stand alone as text, declarations with their own comments as code."""
    text = (root / "src/doors/capi/railstrata.h").read_text()
    out = ["# C interface\n", "`railstrata.h`, for C, Fortran and C++: [how to build with it](docs/library.md).\n"]
    for comment, code in re.findall(r"^/\*(.*?)\*/$|((?:^(?!/\*).*\n?)+)", text, re.S | re.M):
        if comment:
            lines = [re.sub(r"^\s*\*? ?", "", line) for line in comment.strip().split("\n")]
            out.append("\n".join(lines).replace("<", "&lt;") + "\n")
        elif code.strip():
            out.append(f"```c\n{code.strip()}\n```\n")
    return "\n".join(out)


def tutorial(root, folder, run):
    """The notebook as a page; with what it shows when it is run."""
    words = [sys.executable, "-m", "nbconvert", "--to", "markdown", "--output-dir", str(folder), "--output", "tutorial"]
    if run:
        words += ["--execute"]
    path = os.pathsep.join([str(root / "build/python"), os.environ.get("PYTHONPATH", "")])
    done = subprocess.run([*words, str(root / "docs/tutorial.ipynb")], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": path})
    if done.returncode:
        raise SystemExit(f"make_site.py: the tutorial could not be converted\n{done.stderr[-2000:]}")
    page = folder / "tutorial.md"
    page.write_text(re.sub(r"<style.*?</style>|<script.*?</script>", "", page.read_text(), flags=re.S))


# -- pages of the repository ----------------------------------------------------------------------------------------


def place(name):
    """Of a page of the repository: where it stands in the site."""
    return "index.md" if name == "README.md" else name.replace(".ipynb", ".md")


def with_site_links(name, text, root, pages):
    """Links to pages and pictures of the site stay links; those to other files of the repository become their names."""
    def of(match):
        picture, label, target = match.groups()
        if target is None:
            return match[0]
        file, _, heading = target.partition("#")
        if "://" in target or not file:
            return match[0]
        found = os.path.normpath(os.path.join(os.path.dirname(name), file))
        if found + "/README.md" in pages:
            found += "/README.md"
        if found in pages or picture or found.endswith((".png", ".svg", ".bib")):
            there = os.path.relpath(place(found), os.path.dirname(place(name)) or ".")
            return f"{picture}[{label}]({there}{'#' + heading if heading else ''})"
        return label if label.startswith("`") or "/" not in found else f"{label} (`{found}`)"
    parts = re.split(r"(^```.*?^```)", text, flags=re.S | re.M)
    return "".join(part if k % 2 else LINK.sub(of, part) for k, part in enumerate(parts))


def with_list_breaks(text):
    """A blank line before a list, which Python's Markdown asks for; nested items by four blanks."""
    out, fenced = [], False
    for line in text.split("\n"):
        fenced ^= line.lstrip().startswith("```")
        if not fenced and LIST.match(line):
            if out and out[-1].strip() and not LIST.match(out[-1]) and not out[-1].startswith(" "):
                out.append("")
        out.append(line)
    return "\n".join(out)


def copy_page(name, root, folder, pages):
    target = folder / place(name)
    target.parent.mkdir(parents=True, exist_ok=True)
    text = (root / name).read_text()
    text = re.sub(r"^(```\w*)$", r"\1", text, flags=re.M)
    target.write_text(with_list_breaks(with_site_links(name, text, root, pages)))


def copy_pictures(root, folder, pages):
    for name in pages:
        if not name.endswith(".md") or not (root / name).exists():
            continue
        for file in re.findall(r"!?\[[^\]]*\]\(([^)\s#]+\.(?:png|svg|bib))\)", (root / name).read_text()):
            found = os.path.normpath(os.path.join(os.path.dirname(name), file))
            if (root / found).exists():
                (folder / found).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(root / found, folder / found)


def title_of(name, folder):
    if name in TITLES:
        return TITLES[name]
    found = re.search(r"^# +(.*)$", (folder / place(name)).read_text(), re.M)
    return (found[1] if found else name).replace('"', "'").replace("`", "")


def navigation(sections, folder):
    lines = []
    for section, names in sections:
        lines.append(f'  - "{section}":')
        for name in names:
            lines.append(f'      - "{title_of(name, folder)}": {place(name)}')
    return "\n".join(lines) + "\n"


def sections_of(root):
    cases = sorted(f.relative_to(root).as_posix() for f in root.glob("cases/**/README.md"))
    cards = sorted(f.relative_to(root).as_posix() for f in [
        *root.glob("src/*/*/README.md"), *root.glob("extras/*/README.md"), *root.glob("*/README.md")])
    profiles = [f.relative_to(root).as_posix() for f in root.glob("data/*/README.md")]
    out = []
    for title, names in SECTIONS:
        kept = [name for name in names if (root / name).exists() or "interface.md" in name]
        out.append((title, kept + (cases + profiles if title == "Cases" else cards if title == "Development" else [])))
    named = {name for _, names in out for name in names}
    rest = sorted(f"docs/{f.name}" for f in (root / "docs").glob("*.md") if f"docs/{f.name}" not in named)
    next(names for title, names in out if title == "Use").extend(rest)
    return out


def with_explorer(page, folder):
    """The page with the engine inside, and the first page's link to that of the repository as one to it."""
    shutil.copy(page, folder / "explore.html")
    first = folder / "index.md"
    there = r"(\[web/explore\.html\]\([^)]*\)|`web/explore\.html`)"
    text, count = re.subn(there, "[explore.html](explore.html)", first.read_text())
    if not count:
        sys.exit("make_site.py: README.md has no link to web/explore.html")
    first.write_text(text)


def make(root, site, run):
    work = site.parent / (site.name + "-pages")
    shutil.rmtree(work, ignore_errors=True)
    folder = work / "pages"
    folder.mkdir(parents=True)
    sections = sections_of(root)
    pages = {name for _, names in sections for name in names}
    for name in sorted(pages):
        if name.endswith(".md") and (root / name).exists():
            copy_page(name, root, folder, pages)
    copy_pictures(root, folder, pages)
    with_explorer(root / "web/explore.html", folder)
    (folder / "python-interface.md").write_text(python_interface(root))
    (folder / "c-interface.md").write_text(c_interface(root))
    (folder / "site.css").write_text(STYLE)
    tutorial(root, folder / "docs", run)
    (work / "mkdocs.yml").write_text(CONFIG.format(site=site, nav=navigation(sections, folder)))
    done = subprocess.run(["mkdocs", "build", "--strict", "--clean", "--quiet", "-f", str(work / "mkdocs.yml")],
                          capture_output=True, text=True)
    sys.stderr.write(done.stdout + done.stderr)
    return done.returncode != 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("root", nargs="?", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--run", action="store_true")
    args = parser.parse_args()
    if not shutil.which("mkdocs"):
        print("make_site.py: mkdocs is missing (Debian: mkdocs, mkdocs-material)", file=sys.stderr)
        return 77
    root = args.root.resolve()
    return int(make(root, (args.out or root / "build/site").resolve(), args.run))


if __name__ == "__main__":
    sys.exit(main())
