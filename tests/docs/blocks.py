"""Blocks of code of a Markdown page, and of the docstrings of a Python package.

A comment before a block, which a reader does not see, gives the difference in a test:

  <!-- not run: REASON -->              the whole block
  <!-- not run `WORDS`: REASON -->      lines that begin so
  <!-- first: COMMAND -->               is run before, in the page's folder
  <!-- file: NAME -->                   the block is appended to that file there
"""
import ast
import dataclasses
import re
import textwrap

MARK = re.compile(r"^<!-- (not run|first|file)(?: `(.+)`)?: (.*) -->$")
FENCE = re.compile(r"^```(\w*)$")
COMMAND = re.compile(r"^ *(?:\./)?railstrata +[a-z]|^ *\$ ", re.M)


@dataclasses.dataclass
class Block:
    page: str
    line: int  # of its first line, from 1
    language: str
    text: str
    first: list
    file: str = ""
    left_out: str = ""  # why the whole block is not run
    lines_left_out: dict = dataclasses.field(default_factory=dict)  # beginning of a line: why it is not run

    def __str__(self):
        return f"{self.page}:{self.line}"

    def kept(self):
        """Its lines that are run; a line that goes on with a backslash is one with what follows."""
        lines = re.findall(r"(?:[^\n]*\\\n)*[^\n]*\n", self.text)
        return "".join(line for line in lines if not line.startswith(tuple(self.lines_left_out)))


def marked(block, marks):
    for kind, words, said in marks:
        if kind == "first":
            block.first.append(said)
        elif kind == "file":
            block.file = said
        elif words:
            block.lines_left_out[words] = said
        else:
            block.left_out = said
    return block


def of_page(name, text):
    """All fenced blocks in their order; ValueError at an indented command or a mark without a block."""
    out, marks, begun = [], [], None
    for number, line in enumerate(text.splitlines(), 1):
        fence = FENCE.match(line)
        if begun:
            if line == "```":
                out.append(marked(Block(name, begun[0], begun[1], "".join(begun[2]), []), marks))
                marks, begun = [], None
            else:
                begun[2].append(line + "\n")
        elif fence:
            begun = (number + 1, fence[1], [])
        elif mark := MARK.match(line):
            marks.append(mark.groups())
        elif marks:
            raise ValueError(f"{name}:{number}: a mark stands right before its block")
        elif line.startswith("    ") and COMMAND.match(line):
            raise ValueError(f"{name}:{number}: a command stands in a block of its own, ```sh")
    return out


def of_docstrings(name, text):
    """Indented paragraphs with `rs.` of the docstrings of a module, as blocks of Python."""
    out = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node):
            for part in re.findall(r"(?:^    .*\n?)+", ast.get_docstring(node), re.M):
                if "rs." in part:
                    out.append(Block(name, getattr(node, "lineno", 1), "python", textwrap.dedent(part), []))
    return out
