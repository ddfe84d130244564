#!/usr/bin/python3
"""Writes what follows from src/doors/capi/railstrata.h: types, bits and inputs of the Fortran module; in the Python
package the members of states and forces, with their meanings. Without --check, which names the files that are not up to
date."""
import argparse
import re
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
HEADER = "src/doors/capi/railstrata.h"
WIDTH = 120
FORTRAN = {"size_t": "integer(c_size_t)", "double": "real(c_double)", "int": "integer(c_int)",
           "unsigned": "integer(c_int)", "rs_wheel": "type(rs_wheel)"}
BITS = "RS_(?!WHEELSET)", "RS_WHEELSET_"


def structs(header):
    """Of each struct its declarations: type, [(name, count)], comment."""
    out = {}
    for name, body in re.findall(r"typedef struct (rs_\w+) \{\n(.*?)\n\} \1;", header, re.S):
        out[name] = [(kind, [(n, int(c or 1)) for n, c in re.findall(r"(\w+)(?:\[(\d+)\])?", names)], comment.strip())
                     for kind, names, comment in re.findall(r"(\w+) ([\w\[\], ]+);(?:\s*/\*(.*?)\*/)?", body)]
    return out


def bits(header, prefix):
    return re.findall(rf"#define ({prefix}\w+) (\d+)u", header)


def inputs(header):
    """Numbers of rs_wheelset_jacobian's inputs, and what is added for those of the right side."""
    return re.findall(r"#define (RS_BY_\w+|RS_OF_RIGHT) (\d+)\n", header)


def wrapped(text, indent, hang=None, width=WIDTH):
    return textwrap.fill(text, width, initial_indent=indent, subsequent_indent=hang or indent, break_on_hyphens=False)


def listed(head, items, indent, hang=None, width=WIDTH):
    """No line ends within an item."""
    return wrapped(head + ", ".join(item.replace(" ", "~") for item in items), indent, hang, width).replace("~", " ")


def fortran_line(head, items, indent="    "):
    return listed(f"{head} :: ", items, indent, indent + "  ", WIDTH - 2).replace("\n", " &\n") + "\n"


def fortran_type(name, declarations):
    runs = []
    for kind, names, _ in declarations:
        items = [n + (f"({c})" if c > 1 else "") + (" = 0" if name.endswith("state") and n != "size" else "")
                 for n, c in names]
        if runs and runs[-1][0] == FORTRAN[kind]:
            runs[-1][1].extend(items)
        else:
            runs.append((FORTRAN[kind], items))
    return f"  type, bind(c) :: {name}\n{''.join(fortran_line(*run) for run in runs)}  end type\n"


def fortran(text, header):
    for name, declarations in structs(header).items():
        if name != "rs_error":
            text = re.sub(rf"  type, bind\(c\) :: {name}\n.*?  end type\n",
                          lambda _: fortran_type(name, declarations), text, flags=re.S)
    for found in [inputs(header)] + [bits(header, prefix) for prefix in BITS]:
        items = [f"{bit.lower()} = {value}" for bit, value in found]
        text = re.sub(rf"  integer\(c_int\), parameter :: {found[0][0].lower()} = .*?\n(?=  integer|\n)",
                      lambda _: fortran_line("integer(c_int), parameter", items, "  "), text, flags=re.S)
    return text


def members(declarations):
    """(names, type, comment) as Python has them: force_x, force_y, force_z are one; checks_hold is `ok`."""
    for kind, names, comment in declarations:
        words = [n for n, _ in names if n not in ("size", "given") and not n.startswith("reserved")]
        if not words:
            continue
        if len(words) == 3 and {w[:-1] for w in words} == {words[0][:-1]}:
            yield [words[0][:-2]], "tuple[float, float, float]", comment
        elif words in (["checks_hold"], ["beyond"]):
            yield ["ok" if words == ["checks_hold"] else "beyond"], "bool", comment
        else:
            count = names[0][1]
            single = "float" if kind == "double" else kind
            yield words, single if count == 1 else f"tuple[{', '.join([single] * count)}]", comment


def meanings(declarations, indent):
    sentences = [f"{', '.join(words)}: {comment}." for words, _, comment in members(declarations) if comment]
    return wrapped(" ".join(sentences), indent).replace("m2", "m²")


def with_fields(text, name, declarations):
    """The members of a dataclass, after the first paragraph of its words; those that it has besides stay."""
    fields = [f"    {word}: {kind}" for words, kind, _ in members(declarations) for word in words]
    known = {field.split(":")[0] for field in fields}

    def made(found):
        more = [line for line in found[3].split("\n") if line.split(":")[0] not in known and line.startswith("    rem")]
        return f'{found[1]}{meanings(declarations, "    ")}\n    """\n\n' + "\n".join(fields + more)
    return re.sub(rf'(class {name}:\n    """.*?\n\n)(.*?)\n    """\n\n(.*?)(?=\n\n\n)', made, text, flags=re.S)


def with_signature(text, answer, parameters, declarations):
    """The keywords of `solve`, and its last paragraph, which has their meanings."""
    text = re.sub(rf"(    def solve\(\n).*?(\n    \) -> {answer}:)",
                  lambda found: found[1] + listed("self, *, ", parameters, " " * 8) + "," + found[2], text, flags=re.S)
    return re.sub(rf'(\) -> {answer}:\n        """(?:(?!""").)*\n\n)(?:(?!""").)*?(\n        """)',
                  lambda found: found[1] + meanings(declarations, " " * 8) + found[2], text, flags=re.S)


def python_contact(text, header):
    s = structs(header)
    for name, struct in (("ContactForces", "rs_forces"), ("PatchForces", "rs_patch"),
                         ("ContactDerivatives", "rs_derivatives")):
        text = with_fields(text, name, s[struct])
    names = [word for words, _, _ in members(s["rs_state"]) for word in words]
    return with_signature(text, "ContactForces", [f"{name}: Optional[float] = None" for name in names], s["rs_state"])


def python_wheelset(text, header):
    s = structs(header)
    given = [bit.removeprefix("RS_WHEELSET_").lower() for bit, _ in bits(header, BITS[1])]
    parameters = ["speed: float"] + [f"{name}: Optional[float] = None" for name in given]
    for words, kind, _ in members(s["rs_wheelset_state"]):
        parameters += [f"{word}: float = 0" if kind == "float" else f"{word}: Pair = (0, 0)"
                       for word in words if word not in ("speed", *given)]
    return with_signature(with_fields(text, "WheelForces", s["rs_wheel"]), "WheelsetForces", parameters,
                          s["rs_wheelset_state"])


WRITTEN = {"src/doors/capi/railstrata.f90": fortran, "python/railstrata/contact.py": python_contact,
           "python/railstrata/wheelset.py": python_wheelset}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true")
    check = parser.parse_args().check
    header = (ROOT / HEADER).read_text()
    old = []
    for name, write in WRITTEN.items():
        before = (ROOT / name).read_text()
        after = write(before, header)
        if after != before:
            old.append(name)
            if not check:
                (ROOT / name).write_text(after)
    for name in old:
        print(f"{name}: {'does not follow railstrata.h: run tools/write_interface.py' if check else 'written'}")
    return 1 if check and old else 0


if __name__ == "__main__":
    sys.exit(main())
