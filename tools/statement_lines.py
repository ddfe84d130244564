#!/usr/bin/env python3
"""One statement a line, at most 120 columns: what clang-format does not see to.

usage: statement_lines.py [FILE ...]

C, C++, JavaScript and TypeScript: assignments joined by commas (`a = 1, b = 2;`) and declarations of more than six
names in one statement. These and Python: lines of more than 120 characters. Without files: all that git knows. Exit
code: 0 clean, 1 findings.
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
MOST_COLUMNS = 120
MOST_NAMES = 6  # a symmetric tensor has six components
CPP = {".cpp", ".hpp", ".c", ".h"}
SCRIPTS = {".ts", ".mjs", ".js"}
OTHERS = {".py"}
WRITTEN_BY_PROGRAMS = ("web/dist/",)

# comments, raw strings, strings, characters, templates and preprocessor lines, in the order in which they hide one
# another
HIDDEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|`(?:\\.|[^`\\])*`'
    r'|^[ \t]*#(?:\\\n|[^\n])*',
    re.DOTALL | re.MULTILINE)
HELD = "\0"  # stands for what was in brackets
LOOP = re.compile(r"\bfor\s*\(")
CONTROL = re.compile(
    rf"^(?:\s|(?:if(?:\s+constexpr)?|while|switch|for)\s*{HELD}|else\b|do\b|default\s*:|case [^:]+:(?!:))*")
WORD = rf"[A-Za-z_]\w*(?:(?:::|\.|->)\w+|\s?{HELD})*"
ASSIGNMENT = re.compile(rf"^\s*\**{WORD}\s*(?:[-+*/%&|^]|<<|>>)?=(?!=)")
STEP = re.compile(rf"^\s*(?:(?:\+\+|--){WORD}|{WORD}(?:\+\+|--))\s*$")
FIRST_NAME = re.compile(
    rf"^\s*(?:(?:const|static|constexpr|inline|mutable|volatile|alignas\s*{HELD})\s+)*"
    r"(?!(?:return|throw|using|goto|delete|typedef|template|namespace|friend|extern)\b)"
    rf"[A-Za-z_][\w:]*(?:\s?{HELD})?(?:::\w+)*[\s*&]+{WORD}\s*(?:=(?!=).*)?$", re.DOTALL)
NEXT_NAME = re.compile(rf"^\s*[*&]*\s*{WORD}\s*(?:=(?!=).*)?$", re.DOTALL)


def blanked(text):
    """The same lines without what is hidden."""
    return HIDDEN.sub(lambda m: ('""' if m[0][0] in "R\"'`" else "") + "\n" * m[0].count("\n"), text)


def without_loop_heads(text):
    out, at = [], 0
    while match := LOOP.search(text, at):
        depth, end = 1, match.end()
        while end < len(text) and depth:
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        out += [text[at:match.start()], "for" + HELD, "\n" * text[match.end():end].count("\n")]
        at = end
    return "".join(out) + text[at:]


def collapsed(text):
    """Brackets without statements inside become one sign, from the innermost out; line ends stay."""
    def hold(match):
        return HELD + "\n" * match[0].count("\n")

    before = None
    while before != text:
        before = text
        text = re.sub(r"\([^(){}\[\];]*\)|\[[^(){}\[\];]*\]|\{[^(){}\[\];]*\}", hold, text)
        text = re.sub(r"(?<=\w)<[^<>;{}()=&|+]*>", hold, text)
    return re.sub(rf"{HELD}(\s*{HELD})+", lambda m: HELD + "\n" * m[0].count("\n"), text)


def statements(text):
    """(line number, text) of what stands between ; { and }."""
    line = 1
    for piece in re.split(r"([;{}])", collapsed(without_loop_heads(blanked(text)))):
        yield line + re.match(r"\s*", piece)[0].count("\n"), piece
        line += piece.count("\n")


def joined_statements(text):
    """(line number, message) for languages whose statements end with a semicolon."""
    for line, statement in statements(text):
        parts = CONTROL.sub("", statement).split(",")
        if len(parts) < 2:
            continue
        rest = parts[1:]
        first_is_step = ASSIGNMENT.match(parts[0]) or STEP.match(parts[0])
        if first_is_step and any(ASSIGNMENT.match(p) or STEP.match(p) for p in rest):
            yield line, "assignments joined by a comma: one statement a line [one-statement]"
        elif len(parts) > MOST_NAMES and FIRST_NAME.match(parts[0]) and all(NEXT_NAME.match(p) for p in rest):
            yield line, f"{len(parts)} names declared in one statement, at most {MOST_NAMES} are wanted [many-names]"


def findings(files):
    """A line for each, as compilers write theirs."""
    found = []
    for file in files:
        text = file.read_text()
        for number, line in enumerate(text.splitlines(), 1):
            if len(line) > MOST_COLUMNS:
                found.append(
                    f"{file}:{number}: warning: {len(line)} columns, at most {MOST_COLUMNS} are wanted [columns]")
        if file.suffix in CPP | SCRIPTS:
            found += [f"{file}:{number}: warning: {message}" for number, message in joined_statements(text)]
    return found


def all_files():
    listed = subprocess.run(["git", "-C", ROOT, "ls-files"], capture_output=True, text=True,
                            check=True).stdout.splitlines()
    files = [ROOT / name for name in listed if not name.startswith(WRITTEN_BY_PROGRAMS)]
    return [f for f in files if f.suffix in CPP | SCRIPTS | OTHERS]


def self_test():
    def messages(text):
        return [f"{line} {message.split('[')[1][:-1]}" for line, message in joined_statements(text)]

    joined = ["a = 1, b = 2;", "if (x)\n  n += f(1, 2), v[i] = {1, 2};", "else p->x = 0, ++n;", "s.a *= 2, s.b -= 3;",
              "run([&](int i) { p[i] = 1, q[i] = 2; }, 2);", "case 1: x = a, y = b;",
              "for (const v of line)\n  if (v !== null) low = Math.min(low, v), high = Math.max(high, v);"]
    for text in joined:
        assert [m.split()[1] for m in messages("void f() {\n" + text + "\n}")] == ["one-statement"], (
            text, messages(text))
    assert messages("void f() {\n  int k;\n\n  // a = 1, b = 2;\n  a = 1, b = 2;\n}") == ["5 one-statement"]
    fine = ["int a = 1, b = 2;", "for (a = 1, b = 2; a < b; ++a, --b) f();", "f(a = 1, b = 2);",
            "return {.a = 1, .b = 2};",
            "enum class E { a = 1, b = 2 };", "const double x = f(a, b), y = 2;", 'print("a = 1, b = 2;");',
            "x = f(a, b = 2);",
            "template <class T = int, class U = long>\nvoid g();", "auto h = [a = 1, b = 2] { return a; };",
            "Plane xx, yy, zz, xy, yz, xz;",
            "void g(int a = 1, int b = 2, int c = 3, int d = 4, int e = 5, int f = 6);", "S s{a, b, c, d, e, f};",
            "return a, b, c, d, e, f;", "f(a, b, c, d, e, g), h(b);", "X() : a(1), b(2), c(3), d(4), e(5), f(6) {}",
            "x = `${a} = 1, b = ${f(`c`)};`;", "let low = 1, high = 2;"]
    for text in fine:
        assert not messages(text), (text, messages(text))
    many = ["double a = 0, b = 0, c, d, e = f(1, 2), g, h;", "std::vector<int> a, b, c, d, e, f, g;",
            "const char *a, *b, *c, *d, *e, *f, *g;",
            "struct S {\n  Plane a, b, c, d, e, f, g;\n};"]
    for text in many:
        assert [m.split()[1] for m in messages(text)] == ["many-names"], (text, messages(text))


def main():
    self_test()
    found = findings([pathlib.Path(f) for f in sys.argv[1:]] or all_files())
    print("\n".join(found) or "one statement a line, no line too long")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
