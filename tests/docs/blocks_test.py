#!/usr/bin/env python3
"""Every block of code of README.md, of docs/ and of the Python package's docstrings runs as it is printed.

usage: blocks_test.py SOURCE_DIR BUILD_DIR BINARY FOLDER PAGE... | --all-but PAGE...

A page is one folder with the shipped cases in it; its blocks are run in their order, those of Python in one namespace.
What is long is made short here (SHORT, CELL, passes over ten), what cannot run is marked before the block (blocks.py).
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
import blocks  # noqa: E402

SOURCE, BUILD, BINARY, FOLDER = (pathlib.Path(word).resolve() for word in sys.argv[1:5])
PAGES = sys.argv[5:]
MOST_LEFT_OUT = 30  # blocks and lines of all pages together

# What makes a finite element run one of a second: a coarse disc on a block, 8 mm of way.
SHORT = {"mesh.element_size": "4 mm", "mesh.fine_depth": "8 mm", "mesh.end_length": "40 mm", "mesh.coarse_ratio": 3,
         "mesh.largest": "40 mm", "geometry.wheel_shape": "disc", "geometry.rail_shape": "block",
         "run.positions": ["8 mm"], "run.run_up": "2 mm", "run.window": "4 mm", "run.preload_tolerance": 1e-3,
         "drive.torque_ramp": "0.05 ms"}
CELL = "1 mm"
# The program as pages call it: shorter, and content with a check that does not hold on so coarse a mesh.
SHIM = """#!/bin/sh
case " $* " in
  *" --help "* | *" --cell "* | " run --resume "*) ;;
  " python "*) shift; exec /usr/bin/python3 "$@" ;;
  " run "* | *" --engine fem "*) set -- "$@" {sets} ;;
  " bem "* | " passes "* | " creep "* | " sweep "* | " collective "*)
    set -- "$@" --cell "{cell}" ;;
esac
{binary} "$@" || {{ code=$?; test $code = 1 || exit $code; }}
"""


def text_of(value):
    return "[" + ", ".join(f'"{v}"' for v in value) + "]" if isinstance(value, list) else str(value)


def environment(folder):
    return {**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}", "MPLBACKEND": "Agg",
            "PYTHONPATH": str(BUILD / "python"), "PYTHONDONTWRITEBYTECODE": "1", "LD_LIBRARY_PATH": str(BUILD / "lib"),
            "OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}


def made_folder(name):
    folder = FOLDER / name.replace("/", "_")
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "bin").mkdir(parents=True)
    shutil.copytree(SOURCE / "cases", folder / "cases", ignore=shutil.ignore_patterns("recorded"))
    for study in folder.glob("cases/*/study.toml"):
        study.write_text(study.read_text().replace("[study]\n", f'[study]\ncell = "{CELL}"\n'))
    for shared in ("data", "docs"):
        (folder / shared).symlink_to(SOURCE / shared)
    sets = " ".join(f"--set '{key}={text_of(value)}'" for key, value in SHORT.items())
    program = folder / "bin/railstrata"
    program.write_text(SHIM.format(sets=sets, cell=CELL, binary=BINARY))
    program.chmod(0o755)
    (folder / "railstrata").symlink_to(program)
    (folder / "bin/python3").symlink_to("/usr/bin/python3")  # the one that Debian's packages are for
    return folder


def done(block, folder, *words):
    ran = subprocess.run(words, cwd=folder, env=environment(folder), stdin=subprocess.DEVNULL, capture_output=True,
                         text=True, timeout=600)
    if ran.returncode:
        said = (ran.stdout + ran.stderr)[-3000:]
        raise AssertionError(f"{block}: exit code {ran.returncode}\n{block.kept()}\n{said}")


def run_sh(block, folder):
    text = re.sub(r"--passes (\d+)", lambda m: f"--passes {max(2, int(m[1]) // 10)}", block.kept())
    done(block, folder, "sh", "-euc", text)


def file_name(block):
    return pathlib.PurePath(block.file).name


def run_toml(block, folder, rs):
    """A file that begins with [study] is listed as a study, a validation.toml is run on its own or the locomotive's
    case and data; all else is a case, whole or in part."""
    text = block.text
    if block.file:
        file = folder / block.file
        file.parent.mkdir(exist_ok=True)
        text = (file.read_text() if file.exists() else "") + text
        file.write_text(text)
    if text.startswith("[study]"):
        done(block, folder, folder / "railstrata", "study", block.file, "--dry-run")
    elif file_name(block) == "validation.toml":
        for name in ("case.toml", "data.csv"):
            if not (file.parent / name).exists():
                shutil.copy(folder / "cases/validation/locomotive" / name, file.parent)
        done(block, folder, folder / "railstrata", "validate", file.parent.name)
    else:
        rs.Case.from_text(text, str(folder / "case.toml"))


def run_compiled(block, folder, compiler, *flags):
    """Lines that include stay ahead of main()."""
    lines = block.text.splitlines()
    head = [line for line in lines if line.startswith("#")]
    body = "\n".join(line for line in lines if not line.startswith("#"))
    source = folder / f"block{block.line}.{block.language}"
    source.write_text("\n".join(["#include <stdio.h>", *head, "int main() {", body, "return 0;", "}"]) + "\n")
    program = source.with_suffix("")
    done(block, folder, compiler, *flags, "-I", BUILD / "public/include", source, "-o", program, "-L", BUILD / "lib",
         "-lrailstrata")
    done(block, folder, program)


def run_matlab(block, folder):
    script = folder / f"block{block.line}.m"
    no_screen = "contourf = @(x, y, p) assert(size(p), size(x));"  # where Octave has no toolkit to draw with
    script.write_text(f"addpath('{SOURCE}/matlab'); {no_screen}\n{block.text}")
    done(block, folder, "octave-cli", "--no-gui", "-q", script)


def shortened(rs):
    """The package with shorter runs and fewer passes, once for the process."""
    run, passes = rs.run, rs.passes
    rs.run = lambda case, folder, **more: run(case.with_(SHORT), folder, **more)
    rs.passes = lambda case, folder, count=20, **more: passes(case, folder, max(2, count // 10), cell=CELL, **more)
    return rs


def run_python(block, folder, names):
    before = pathlib.Path.cwd()
    os.chdir(folder)
    try:
        exec(compile("\n" * (block.line - 1) + block.text, block.page, "exec"), names)
    except Exception as fault:
        raise AssertionError(f"{block}: {type(fault).__name__}: {fault}") from fault
    finally:
        os.chdir(before)


def run(block, folder, names):
    for command in block.first:
        done(block, folder, "sh", "-euc", command)
    if block.language == "sh":
        run_sh(block, folder)
    elif block.language == "python":
        run_python(block, folder, names)
    elif block.language == "toml":
        run_toml(block, folder, names["rs"])
    elif block.language == "c":
        run_compiled(block, folder, "gcc", "-std=c99")
    elif block.language == "cpp":
        run_compiled(block, folder, "g++", "-std=c++20")
    elif block.language == "matlab":
        run_matlab(block, folder)
    elif block.language != "text":
        raise AssertionError(f"{block}: a block of \"{block.language}\": write sh, python, …, or text for no code")


def all_pages():
    """The blocks of every page by its name; the docstrings of the package are a page each."""
    markdown = [SOURCE / "README.md", *sorted((SOURCE / "docs").glob("*.md"))]
    modules = sorted((SOURCE / "python/railstrata").glob("*.py"))
    named = [(file.relative_to(SOURCE).as_posix(), file.read_text()) for file in (*markdown, *modules)]
    return {name: blocks.of_page(name, text) if name.endswith(".md") else blocks.of_docstrings(name, text)
            for name, text in named}


def left_out(found):
    """What is not run, block by block and line by line, with its reason."""
    out = []
    for block in (b for page in found.values() for b in page):
        out += [f"{block}: {block.left_out}"] if block.left_out else []
        out += [f"{block}: `{begin}`: {why}" for begin, why in block.lines_left_out.items()]
    return out


class Blocks(unittest.TestCase):
    def test_the_blocks_of_a_page_run_as_they_are_printed(self):
        os.environ |= environment(FOLDER)
        sys.path.insert(0, str(BUILD / "python"))
        import railstrata
        rs = shortened(railstrata)
        found = all_pages()
        chosen = [name for name in found if name not in PAGES] if PAGES[:1] == ["--all-but"] else PAGES
        for name in (name for name in chosen if found[name]):
            folder, names = made_folder(name), {"rs": rs}
            for block in (b for b in found[name] if not b.left_out):
                begun = os.times()
                with self.subTest(str(block)):
                    run(block, folder, names)
                seconds = sum(now - then for now, then in zip(os.times()[:4], begun))
                print(f"{block}: {block.language}, {seconds:.1f} s of processor time", flush=True)
            shutil.rmtree(folder)

    def test_few_blocks_are_left_out_and_they_say_why(self):
        listed = left_out(all_pages())
        print(f"{len(listed)} blocks and lines are not run:", *listed, sep="\n  ")
        self.assertLessEqual(len(listed), MOST_LEFT_OUT)
        for page in all_pages().values():
            for block in page:
                for begin in block.lines_left_out:
                    self.assertRegex(block.text, f"(?m)^{re.escape(begin)}", f"{block}: no line begins so")


class Parts(unittest.TestCase):
    PAGE = ('text\n<!-- not run `sudo`: asks -->\n<!-- first: mkdir a -->\n```sh\nsudo a \\\n  b\nls a\n```\n'
            '<!-- not run: no card -->\n```python\n1 / 0\n```\n')

    def test_marks_belong_to_the_next_block(self):
        shell, python = blocks.of_page("page", self.PAGE)
        self.assertEqual((shell.kept(), shell.first, shell.line), ("ls a\n", ["mkdir a"], 5))
        self.assertEqual(python.left_out, "no card")
        with self.assertRaisesRegex(ValueError, "page:2"):
            blocks.of_page("page", "<!-- first: ls -->\n\n```sh\n```\n")
        with self.assertRaisesRegex(ValueError, "page:1"):
            blocks.of_page("page", "    ./railstrata info\n")

    def test_a_block_that_fails_is_named_with_its_line(self):
        folder = made_folder("parts")
        page = blocks.of_page("page", "```sh\nrailstrata bem cases/quick --set layer.0.thickness=2\n```\n"
                              "```python\nundefined\n```\n```fortran\nend\n```\n```toml\n[mesh]\nsize = 1\n```\n")
        import railstrata
        for block, said in zip(page, ("page:2: exit code 2", "page:5: NameError", "page:8: a block of", "mesh.size")):
            with self.assertRaisesRegex(Exception, said):
                run(block, folder, {"rs": railstrata})
        shutil.rmtree(folder)

    def test_examples_of_docstrings_are_found(self):
        text = ('"""Words.\n\n    import a as rs\n    rs.b()\n\nMore.\n"""\n'
                'def f():\n    """g\n\n        y = x\n    """\n')
        self.assertEqual([b.text for b in blocks.of_docstrings("m", text)], ["import a as rs\nrs.b()\n"])


if __name__ == "__main__":
    sys.path.insert(0, str(BUILD / "python"))
    unittest.main(argv=sys.argv[:1])
