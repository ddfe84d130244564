#!/usr/bin/python3
"""Runs CONTACT's own examples of basic contact (module 3) through the interface and compares what CONTACT printed.

usage: contact_examples.py LIBRARY CHECKOUT [NAME...] [--verbose]   CHECKOUT: a clone of github.com/eve70a/CONTACT

Of every case of CHECKOUT/examples/NAME.inp (all of them unless named) FN, FX, FY, MZ, PMAX and the numbers of elements
in contact, adhesion and slip are held against NAME.ref_out; the states of CONTACT's program test_table against
testbank/test_table_mx11.ref_fx. Prints a table; a case that is refused counts with the reason of its first refusal.
Exit code 1 where an accepted case differs by more than the printed digits."""
import argparse
import collections
import itertools
import math
import pathlib
import re
import sys

import contact_library
from contact_library import Contact

ROLLING = "CHI DQ VELOC"
FRICTION = {0: 2, 2: 7, 3: 7, 4: 7, 5: 3, 6: 6}
MORE_OF_MATERIAL = {0: 0, 1: 4, 3: 3, 4: 4, 5: 3}
SOLVER_LINES = {0: [5], 1: [], 2: [5, 4], 3: [5, 4], 4: [5, 2], 5: [5]}
CLOSE = 6e-4  # of a number of four digits


class Unread(Exception):
    """A form of input that this reader does not know."""


def numbers(line):
    """The numbers before the first word of a line; degrees (12d) as radians (0.2r)."""
    out = []
    for word in line.split("%")[0].replace(",", " ").split():
        angle = re.fullmatch(r"([-+\d.]+)([dr])", word, re.I)
        unit = {"d": math.radians(1), "r": 1}[angle[2].lower()] if angle else 1
        try:
            out.append(unit * float(re.sub("[dD]", "e", angle[1] if angle else word)))
        except ValueError:
            break
    return out


class Refusal(Exception):
    """What the library does not solve."""


class Input:
    """The lines of a case, comments left out."""

    def __init__(self, text):
        self.lines = [line for line in text.splitlines() if line.split("%")[0].strip()]
        self.at = 0

    def word(self):
        self.at += 1
        return self.lines[self.at - 1].split()[0]

    def take(self, count):
        """So many numbers, from as many lines as they fill."""
        out = []
        while len(out) < count:
            found = numbers(self.lines[self.at])
            if not found:
                raise Unread(self.lines[self.at])
            out += found
            self.at += 1
        return out[:count]

    def next_case(self):
        while self.at < len(self.lines):
            found = re.match(r"\s*(\d)\s+MODULE", self.lines[self.at], re.I)
            self.at += 1
            if found:
                if found[1] == "3":
                    return True
                if found[1] == "0":
                    return False
                raise Unread("module " + found[1])
        return False


def solver(c, text, digit):
    """Reads the lines of G and sets EPS."""
    if digit not in SOLVER_LINES:
        raise Unread(f"G = {digit}")
    lines = [text.take(count) for count in SOLVER_LINES[digit]]
    if not lines:
        return
    whole, others = [int(v) for v in lines[0][:4]], [lines[0][4]]
    if digit in (2, 3):
        omega_h, omega_s, slip, omega_slip = lines[1]
        whole, others = whole + [int(slip)], others + [omega_h, omega_s, omega_slip]
    elif digit == 4:
        whole, others = whole + [int(lines[1][0])], others + [lines[1][1]]
    else:
        digit = 0
    c.call("cntc_setsolverflags", digit, len(whole), whole, len(others), others)


def materials(c, text, t, m, heat):
    if t >= 2:
        chi, dq, velocity = text.take(3)
        c.call("cntc_setrollingstepsize", chi, dq)
        c.call("cntc_setreferencevelocity", velocity)
    text.at += "'" in text.lines[text.at]  # CFNAME, a file of influence coefficients
    values = text.take(4)
    if m not in MORE_OF_MATERIAL:
        raise Unread(f"M = {m}")
    c.set("cntc_setmaterialparameters", m, values + text.take(MORE_OF_MATERIAL[m]))
    if heat == 3:
        c.set("cntc_settemperaturedata", 3, text.take(8))


def grid(c, text):
    kind = int(text.take(1)[0])
    values = text.take(5 if kind < 0 else 6)
    c.cells = [int(v) for v in values[:2]]
    (c.hertz if kind < 0 else c.grid)(kind, values)
    return kind


def gap(c, text):
    base, plan = (int(v) for v in text.take(2))
    if plan not in (0, 1):
        raise Unread(f"IPLAN = {plan}")
    if base == 2:
        head = text.take(5)
        values = head + text.take(int(head[0]))
    elif base == 9:
        values = text.take(math.prod(c.cells))
    else:
        if base not in (1, 3):
            raise Unread(f"IBASE = {base}")
        values = text.take({1: 6, 3: 8}[base])
    c.gap(base, values)


def set_case(c, text, kind):
    """One case: returns IPOTCN; None after a case that could not be read, until one sets everything anew."""
    p, b, t, n, f, stress = (int(d) for d in text.word().zfill(6))
    law, d, influence, m, z, e = (int(v) for v in text.word().zfill(6))
    heat, g, i, *_ = (int(v) for v in text.word().zfill(7))
    if kind is None and not (law != 1 and d == influence == z == 2):
        raise Unread("follows one that was not read")
    c.flags(P=p, T=t, N=n, F=f, B=b, I=i, E=min(e, 1))
    solver(c, text, g)
    normal, x, y, spin = text.take(4)
    c.call("cntc_setnormalforce" if n == 1 else "cntc_setpenetration", normal)
    c.call("cntc_setcreepages", 0.0 if f >= 1 else x, 0.0 if f == 2 else y, spin)
    c.call("cntc_settangentialforces", x if f >= 1 else 0.0, y if f == 2 else 0.0)
    if law != 1:
        if law not in FRICTION:
            raise Unread(f"L = {law}")
        c.set("cntc_setfrictionmethod", law, text.take(FRICTION[law]))
    if heat == 0:
        c.set("cntc_settemperaturedata", 0, [])
    if influence in (2, 9):
        c.flags(C=influence)
        materials(c, text, t, m, heat)
    elif influence not in (0, 1):
        raise Unread(f"C = {influence}")
    if d == 2:
        kind = grid(c, text)
    if z == 2 and kind > 0:
        gap(c, text)
    if e == 9:
        slip = text.take(2 * math.prod(c.cells))
        c.call("cntc_setextrarigidslip", len(slip) // 2, slip[::2], slip[1::2])
    elif e not in (0, 1):
        raise Unread(f"E = {e}")
    return kind


def printed(path):
    """What CONTACT printed of each case, by name."""
    out = []
    for case in re.split(r"^ *Case +\d+ *$", path.read_text(errors="replace"), flags=re.M)[1:]:
        lines = case.splitlines()
        found = {}
        for k, line in enumerate(lines):
            for names in ("FN FX FY MZ", "NPOT NCON NADH NSLIP"):
                if line.split()[:4] == names.split():
                    found.update(zip(line.split(), (float(v.replace("D", "E")) for v in numbers_or_nan(lines[k + 1]))))
            if "PMAX" in line and line.split()[0] == "FN/G":
                values = [float(v.replace("D", "E")) for v in numbers_or_nan(lines[k + 1])]
                found.update(zip(("APPROACH", "PMAX"), values[3:]))
                found.update(zip(("CREEPX", "CREEPY"), values[1:]) if "CREEP X" in line else {})
        out.append(found)
    return out


def numbers_or_nan(line):
    return [w if re.fullmatch(r"[-+\d.]+([eEdD][-+]?\d+)?", w) else "nan" for w in line.split()]


def answers(c):
    fn, fx, fy, mz = c.forces()
    kinds = collections.Counter(c.division().ravel().tolist())
    along, across, _ = c.creepages()
    return {"FN": fn, "FX": fx, "FY": fy, "MZ": mz, "CREEPX": along, "CREEPY": across, "APPROACH": c.approach(),
            "PMAX": c.p_max(), "NCON": kinds[1] + kinds[2] + kinds[3], "NADH": kinds[1], "NSLIP": kinds[2]}


def differences(found, wanted):
    creep = max(abs(wanted.get(name, 0)) for name in ("CREEPX", "CREEPY"))
    small = {"PMAX": 0, "APPROACH": 0, "CREEPX": 1e-3 * creep, "CREEPY": 1e-3 * creep}
    out = []
    for name, value in found.items():
        if name not in wanted:
            continue
        whole = name.startswith("N")
        allowed = 0 if whole else CLOSE * max(abs(wanted[name]), small.get(name, 1e-3 * abs(wanted.get("FN", 1))))
        if not abs(value - wanted[name]) <= allowed:
            out.append(f"{name} {value:.6g} for {wanted[name]:.6g}")
    return out


def run(library, file, verbose):
    text, wanted = Input(file.read_text(errors="replace")), printed(file.with_suffix(".ref_out"))
    c, kind, cases, good, off, reasons = Contact(library), 0, 0, 0, 0, []
    while True:
        try:
            if not text.next_case():
                break
            cases += 1
            kind = set_case(c, text, kind)
            code = c.calculate()
            if code < 0:
                raise Refusal(f"{code}: {c.error()[1].splitlines()[0][:110]}")
            wrong = differences(answers(c), wanted[cases - 1])
        except Refusal as e:
            reasons.append(str(e))
            continue
        except Unread as e:
            kind = None
            reasons.append(str(e))
            continue
        good += not wrong
        off += bool(wrong)
        if wrong and verbose:
            print(f"  {file.stem} case {cases}: {', '.join(wrong)}")
    print(f"{file.stem:20} {cases:5} {good:6} {off:5}  {'; '.join(dict.fromkeys(reasons))[:230]}")
    return cases, good, off


SEMI_AXES = {0.2: 4, 0.5: 6, 1: 9, 2: 12, 5: 20}  # a by a/b, mm
MAGNITUDES = [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 0.9, 1.1, 1.4, 1.7, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9, 10, 12]


def states_of_table(c):
    """The states of CONTACT's src/test_table.f90 in their order, each ready to be solved, with sqrt(a b), mm."""
    f, load = 0.3, 82000.0
    c.materials(0.28, 0.28, load, load)
    c.friction(f)
    c.call("cntc_setnormalforce", load)
    c.flags(P=2, T=3)
    c.call("cntc_setsolverflags", 0, 4, [299, 1, 30, 1], 1, [1e-6])  # MAXGS, MAXIN, MAXNR, MAXOUT, EPS
    for ratio, a in SEMI_AXES.items():
        c.hertz(-3, [11, 11, a, a / ratio, 11 / 7])
        c.calculate()
        rho, mean = c.hertz_results()[4:]
        for spin, angle in itertools.product((0, 0.5, 1, 2), range(-90, 91, 30)):
            along, across = (g(math.radians(angle)) * f * mean / rho for g in (math.cos, math.sin))
            for size in MAGNITUDES:
                c.call("cntc_setcreepages", size * along, size * across, f * spin / rho)
                yield f * load, mean


def run_table(library, checkout):
    """Cases, equal ones and others of test_table; forces over f F_n, moment over f F_n sqrt(a b), share of slip."""
    text = (checkout / "testbank/test_table_mx11.ref_fx").read_text()
    rows = [[float(v) for v in re.findall(r"= *(\S+?)(?:,|$)", line)]
            for line in text.splitlines() if line.startswith("Fx")]
    c, equal = Contact(library, 4), 0
    for row, (bound, mean) in zip(rows, states_of_table(c), strict=True):
        if c.calculate() != 0:
            continue
        _, x, y, moment = c.forces()
        contact, slip = c.counts()
        found = [x / bound, y / bound, moment / bound / mean, 100 * slip / contact]
        equal += all(abs(a - b) <= near for a, b, near in zip(found, row, (1.6e-6, 1.6e-6, 1.6e-6, 0.051)))
    print(f"{'test_table':20} {len(rows):5} {equal:6} {len(rows) - equal:5}")
    return len(rows) - equal


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("library")
    parser.add_argument("checkout", type=pathlib.Path)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    library = contact_library.load(options.library)
    print(f"{'example':20} {'cases':>5} {'equal':>6} {'off':>5}  refused")
    total = [0, 0, 0]
    for file in sorted(options.checkout.glob("examples/*.inp")):
        if options.names and file.stem not in options.names:
            continue
        if not re.search(r"^ *3 +MODULE", file.read_text(errors="replace"), re.M | re.I):
            continue
        total = [a + b for a, b in zip(total, run(library, file, options.verbose))]
    print(f"{'all':20} {total[0]:5} {total[1]:6} {total[2]:5}  accepted {total[1] + total[2]} of {total[0]}")
    off = 0 if options.names else run_table(library, options.checkout)
    return 1 if total[2] or off else 0


if __name__ == "__main__":
    sys.exit(main())
