#!/usr/bin/env python3
"""Plain field English: words that make a program a person, constructions to read twice, and what to write instead.

usage: plain_words.py [FILE ...]

Looks at comments and strings of C, C++, JavaScript, TypeScript and Python (INSTEAD) and at the text of Markdown without
its code (also IN_PAGES, but for the history and pages that the program writes: NOT_BY_HAND). A pattern is listed only
if it is always wrong here. Without files: all that git knows. Exit code: 0 clean, 1 findings.
"""
import io
import pathlib
import re
import subprocess
import sys
import tokenize

import statement_lines

ROOT = statement_lines.ROOT
SUFFIXES = statement_lines.CPP | statement_lines.SCRIPTS | {".py", ".md"}

GAP = r"(?:[ ]|\n[ \t]*(?:///?<?|\*|#)?[ \t]*)"  # between two words, at a line's end too
INSTEAD = {
    r"[Tt]old(?! apart\b)": "reported, recorded, shown, given",
    r"[Tt]ells": "reports, records, shows, gives",
    r"[Tt]ell(?:ing)? (?:what|how|why|where|of|nothing)": "report, show",
    r"(?:does|do|did|will) not tell": "does not report, give or determine",
    r"[Ss]ays (?:so|why)": "gives the reason, reports it",
    r"[Ss]ays (?:what|which|how|where|whether)": "gives, names, lists, describes",
    r"(?:case|card|file|program|page|folder|table|text|message|heading) says": "gives, reports, names",
    r"(?:case|card|file|program|page|folder|table|text|message|heading) does not say": "does not give, has no",
    r"nothing (?:else )?is said": "by default, unless noted",
    r"[Ss]aid, not judged": "reported without a limit",
    r"(?:lends?|lent|lending)": "releases, passes, gives access to",
    r"gifts?": "what is sent, passed",
    r"stor(?:y|ies)": "history, record",
    r"forgets": "discards, resets, loses",
    r"wishes": "requests, settings, targets",
    r"(?:a|the) wish": "a request, a setting, a target",
    r"[Hh]ears": "receives, is notified",
    r"(?:is|are|be) heard": "is received, is handled",
    r"[Ss]omebody (?:who|has|else|asks|wants)": "the user, a caller, another process; or the passive",
    r"(?:ranks?|guard|that|[Ww]ho|which) speaks?": "reports, prints messages",
    r"without a word": "without a message or warning",
    r"leaves? words": "logs, reports",
    r"speaks against": "is a reason to doubt",
}
NOT_BY_HAND = {"CHANGELOG.md", "case-reference.md", "results-reference.md"}
IN_PAGES = {
    r"as (?:[\w`]+ ){1,4}(?:has|have) it": "as in …, like …",
    r"[Bb]eside": "next to, with, compared with, besides",
    r"[Hh]eld against": "compared with",
    r"[Ww]hat comes out": "the result",
    r"[Ww]hoever": "users, a caller, the reader",
    r"(?:that|which|it|text|value) (?:is|are) none": "is not one, is invalid",
    r"(?:is|are) no (?:numbers?|keys?|names?|dates?)": "is not a number, key, name or date",
    r"[Nn]othing else of (?:it|them)": "no other part",
    r"alone will do": "is enough",
    r"is to be (?:found|had|seen)": "is in …",
}
WORDS, PAGE_WORDS = ({re.compile(rf"(?<![\w/]){pattern.replace(' ', GAP)}(?![\w/])"): instead
                      for pattern, instead in patterns.items()} for patterns in (INSTEAD, INSTEAD | IN_PAGES))


def code_texts(text):
    """(line number, text) of comments and strings of the C family; adjacent lines of a comment are one text."""
    joined = re.compile(r"(?://[^\n]*(?:\n[ \t]*(?=//))?)+|" + statement_lines.HIDDEN.pattern,
                        statement_lines.HIDDEN.flags)
    for match in joined.finditer(text):
        if match[0].lstrip()[0] != "#":
            yield text.count("\n", 0, match.start()) + 1, match[0]


def python_texts(text):
    """The same of Python."""
    kinds = {tokenize.COMMENT, tokenize.STRING, getattr(tokenize, "FSTRING_MIDDLE", tokenize.STRING)}
    comments = []
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT and comments and token.start[0] == comments[-1][0] + len(comments):
            comments.append((comments[0][0], token.string))
        elif token.type == tokenize.COMMENT:
            yield from whole(comments)
            comments = [(token.start[0], token.string)]
        elif token.type in kinds:
            yield token.start[0], without_values(token.string)
    yield from whole(comments)


def without_values(text):
    """An f-string without what is computed in it; other strings as they are."""
    return re.sub(r"\{[^{}\n]*\}", "{}", text) if re.match(r"[rR]?[fF]", text) else text


def whole(comments):
    if comments:
        yield comments[0][0], "\n".join(text for _, text in comments)


def page_texts(text):
    """Markdown without code, whose line ends stay."""
    def blank(match):
        return "\n" * match[0].count("\n")

    yield 1, re.sub(r"`[^`\n]*`", "``", re.sub(r"^[ \t]*```.*?^[ \t]*```", blank, text, flags=re.DOTALL | re.MULTILINE))


TEXTS = {".py": python_texts, ".md": page_texts}


def messages(text, suffix, words=None):
    """(line number, message), each place once."""
    found = set()
    words = words or (PAGE_WORDS if suffix == ".md" else WORDS)
    for first, piece in TEXTS.get(suffix, code_texts)(text):
        for word, instead in words.items():
            for match in word.finditer(piece):
                line = first + piece.count("\n", 0, match.start())
                said = " ".join(re.sub(r"\n[ \t]*(?:///?<?|\*|#)?", " ", match[0]).split())
                found.add((line, f'"{said}": write {instead} [plain-words]'))
    return sorted(found)


def findings(files):
    """A line for each, as compilers write theirs."""
    found = []
    for file in files:
        if file.suffix not in SUFFIXES or file.resolve() == pathlib.Path(__file__).resolve():
            continue
        words = WORDS if file.name in NOT_BY_HAND else None
        listed = messages(file.read_text(), file.suffix, words)
        found += [f"{file}:{line}: warning: {message}" for line, message in listed]
    return found


def all_files():
    listed = subprocess.run(["git", "-C", ROOT, "ls-files"], capture_output=True, text=True,
                            check=True).stdout.splitlines()
    files = [ROOT / name for name in listed if not name.startswith(statement_lines.WRITTEN_BY_PROGRAMS)]
    return [f for f in files if f.suffix in SUFFIXES and f.exists()]


def self_test():
    def lines(text, suffix):
        return [line for line, _ in messages(text, suffix)]

    for pattern in ("told", "tells", "says so", "lends", "a gift", "the story", "says why"):
        assert lines(f"int a;\n/// It is {pattern} here.\n", ".hpp") == [2], pattern
        assert lines(f'int a;\nf("x {pattern} y");\n', ".ts") == [2], pattern
        assert lines(f'a = 1\n"""A {pattern} b."""\n# c\n# {pattern}\n', ".py") == [2, 4], pattern
        assert lines(f"# Head\n\nA {pattern} b.\n", ".md") == [3], pattern
    for pattern in ("as the\ncase has it", "beside it", "a text that is none", "held against"):
        assert lines(f"# Head\n\nA {pattern} b.\n", ".md") and not lines(f"// A {pattern}".replace("\n", " "), ".cpp")
    assert lines("int a;\n// What the case\n// says of it.\n", ".cpp") == [2]
    assert lines("x = 1\n# what the case\n# says of it\n", ".py") == [2]
    fine = {".cpp": ["const auto told = tell(gift);", "#include \"told/story.hpp\"", "// colours told apart, a history",
                     "// unfold, foretold, /home/somebody/case.toml", "f(\"you say so\"); bool nobody = lent;"],
            ".py": ["told = story(gift)", "# docs/history, mortar", "f'{told[0]} of {story}'"],
            ".md": ["`told` and\n```\ngift\n```\n", "If you wish, we say so.", "Besides, none is as it has to be."]}
    for suffix, texts in fine.items():
        for text in texts:
            assert not lines(text, suffix), (text, messages(text, suffix))


def main():
    self_test()
    found = findings([pathlib.Path(f) for f in sys.argv[1:]] or all_files())
    print("\n".join(found) or "plain words")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
