#!/usr/bin/python3
"""Runs CONTACT's own examples of wheel on rail (module 1) through the interface and compares what CONTACT printed.

usage: contact_wheel_examples.py LIBRARY CHECKOUT [NAME...] [--verbose]   CHECKOUT: a clone of github.com/eve70a/CONTACT

Of every case of module 1 in CHECKOUT/examples/*.inp and CHECKOUT/testbank/**/*.inp (all unless named) every patch is
compared by its place (0.1 mm) and its forces (1 % of FN, but not less than 0.01 % of the wheel's FZ), and the sums FX,
FY, FZ in the track (1 % of FZ). A case that is refused counts with the reason. Exit code 1 where an accepted case
differs by more."""
import argparse
import pathlib
import re
import sys

import contact_library
from contact_examples import FRICTION, MORE_OF_MATERIAL, Refusal, Unread, numbers, numbers_or_nan
from contact_library import Wheel

FORCE, LEAST, PLACE = 0.01, 1e-4, 0.1  # of the normal force, of the wheel's vertical force; mm
DIGITS = {"CONFIG": 1967, "P": 1970, "B": 1971, "T": 1972, "N": 1973, "F": 1974, "D": 1977, "C": 1978, "I": 1983}
MODULE = r"\s*(\d)\s+MODULE"
LOCATIONS = ["XCP(TR)", "YCP(TR)", "ZCP(TR)", "DELTCP(TR)"]


class Lines:
    """The lines of an input, comments left out. A case without a module is one of the module before it."""

    def __init__(self, text):
        self.lines, self.at, module = [], 0, None
        for line in (line for line in text.splitlines() if line.split("%")[0].strip()):
            if "P-B-T-N-F-S" in line and module and not re.match(MODULE, self.lines[-1], re.I):
                self.lines.append(module)
            if re.match(MODULE, line, re.I):
                module = line
            self.lines.append(line)

    def next(self):
        if re.match(MODULE, self.lines[self.at], re.I):
            raise Unread("a case that ends before this reader expects it")
        self.at += 1
        return self.lines[self.at - 1]

    def numbers(self, least):
        """All numbers of a line, and of as many more as it takes for so many."""
        out = []
        while len(out) < least:
            found = numbers(self.next())
            if not found:
                raise Unread(self.lines[self.at - 1].strip())
            out += found
        return out

    def module(self):
        """The number of the next case's module; 0 at the end."""
        while self.at < len(self.lines):
            found = re.match(MODULE, self.lines[self.at], re.I)
            self.at += 1
            if found:
                return int(found[1])
        return 0


def profile(c, lines, folder, kind):
    line = lines.next()
    file = re.match(r"\s*'([^']+)'(.*)", line)
    if not file:
        raise Unread(line.strip())
    options = numbers(file[2])
    mirror_z, more = (int(v) for v in (options[3:5] + [0, 0])[:2])
    spline, kinks = 0, []
    if more >= 1:
        spline, *angles = lines.numbers(5)[:5]
        kinks = [0.5, *angles]
    if more >= 2:
        lines.next()
    c.profile(folder / file[1].replace("\\", "/"), kind, int(options[0]), mirror_z, options[1], options[2],
              int(spline), kinks)


def friction(c, lines, varies, law):
    if law not in FRICTION:
        raise Unread(f"L = {law}")
    if varies == 0:
        return c.set("cntc_setfrictionmethod", law, lines.numbers(FRICTION[law])[:FRICTION[law]])
    count, of_memory = int(lines.numbers(1)[0]), 2 if law in (2, 3, 4, 6) else 0
    each = 1 + FRICTION[law] - of_memory
    slices = [lines.numbers(each)[:each] for _ in range(count)]
    memory = lines.numbers(of_memory)[:of_memory] if of_memory else []
    values = [float(count)] + [v for numbers_of_slice in slices for v in numbers_of_slice + memory]
    return c.set("cntc_setfrictionmethod", 10 * varies + law, values)


def subsurface(lines):
    lines.numbers(1)
    while int(lines.numbers(1)[0]) != 0:
        lines.numbers(1)


def design(values, roller):
    """GAUGHT and its two, cant, radius, curvature as the call takes them."""
    fourth = [0.0, values[3]] if roller else [values[3], 0.0]
    return values[:3] + fourth + [values[4] if len(values) > 4 else 0.0]


def track(c, lines, folder, digit, roller, gives_way):
    values = design(lines.numbers(4), roller) if digit in (1, 3) else []
    if digit == 3:
        profile(c, lines, folder, 0)
    if digit in (2, 3):
        values += lines.numbers(6)[:6]
    c.wheel("cntc_settrackdimensions", digit, values)
    if digit in (2, 3) and gives_way:
        c.wheel("cntc_settrackdimensions", 30 + digit, lines.numbers(4))


def wheelset(c, lines, folder, digit, normal, forces):
    if digit in (3, 5):
        values = lines.numbers(3)
        c.wheel("cntc_setwheelsetdimensions", digit, values[:4])
        profile(c, lines, folder, 1)
    if digit >= 1:
        values = lines.numbers(6)[:6]
        if normal == 1:
            c.load(values[2])
            values[2] = 0.0
        c.wheel("cntc_setwheelsetposition", digit, values)
    if digit >= 2:
        values = lines.numbers(6)[:6]
        if forces == 1:
            c.call("cntc_settangentialforces", values[5], 0.0)
            values[5] = 0.0
        c.wheel("cntc_setwheelsetvelocity", digit, values)
    if digit >= 4:
        c.wheel("cntc_setwheelsetflexibility", digit, lines.numbers(6)[:6] + lines.numbers(6)[:6])


def set_case(c, lines, folder):
    config, p, b, t, n, f, stress = (int(v) for v in lines.next().split()[0].zfill(7)[-7:])
    varies, law, d, influence, m, z, e = (int(v) for v in lines.next().split()[0].zfill(7)[-7:])
    extra, heat, g, i, *_ = (int(v) for v in lines.next().split()[0].zfill(8)[-8:])
    if extra >= 1:
        lines.next()
    for name, value in {"CONFIG": config, "P": p, "B": b, "T": t, "N": n, "F": f, "I": i}.items():
        c.flag(DIGITS[name], value)
    if d != 1:
        c.flag(DIGITS["D"], d)
    if influence > 1:
        c.flag(DIGITS["C"], influence)
    if g not in (0, 1):
        raise Unread(f"G = {g}")
    if g == 0:
        values = lines.numbers(5)
        c.call("cntc_setsolverflags", 0, 4, [int(v) for v in values[:4]], 1, [values[4]])
    if law != 1:
        friction(c, lines, varies, law)
    if influence == 4:
        raise Unread("C = 4")
    if influence >= 2:
        if m not in MORE_OF_MATERIAL:
            raise Unread(f"M = {m}")
        c.elastic = lines.numbers(4)[:4]
        more = MORE_OF_MATERIAL[m]
        c.set("cntc_setmaterialparameters", m, c.elastic + lines.numbers(more)[:more])
    elif m != c.material:
        c.set("cntc_setmaterialparameters", m, c.elastic + [0] * MORE_OF_MATERIAL[m])
    c.material = m
    if heat == 3:
        c.set("cntc_settemperaturedata", 3, lines.numbers(4)[:4] + lines.numbers(4)[:4])
    if d >= 2:
        values = lines.numbers(6)
        c.call("cntc_setrollingstepsize", 0.0, values[2])
        c.grid(-1, values[:2] + values[3:])
    track(c, lines, folder, z, config >= 4, f == 3)
    wheelset(c, lines, folder, e, n, f)
    if stress >= 2:
        subsurface(lines)


def rows(lines, k):
    return dict(zip(lines[k].split(), (float(v) for v in numbers_or_nan(lines[k + 1]))))


def printed(path):
    """Of each case by its number: the sums, and of each patch the numbers by name."""
    out = {}
    cases = re.split(r"^ *Case +(\d+) *$", path.read_text(errors="replace"), flags=re.M)[1:]
    for number, case in zip(cases[::2], cases[1::2]):
        parts = re.split(r"^ *-+ DATA FOR CONTACT PATCH.*$", case, flags=re.M)
        found = []
        for part in parts:
            lines, values = part.splitlines(), {}
            for k, line in enumerate(lines[:-1]):
                if re.match(r" +(FX\(TR\)|XCP\(TR\)|XCP\(W\)|CHI|FN|FN/G|BAR_FN|TILDE_FN|NPOT) ", line):
                    values.update(rows(lines, k))
            # Of a conformal contact: the forces in the reference's axes.
            found.append({name.removeprefix("BAR_"): value for name, value in values.items()})
        out[int(number)] = found
    return out


def answers(c, number):
    patch, place = c.patch(number), c.location(number)
    fn, fx, fs, _ = patch.forces()
    cksi, ceta, cphi = patch.creepages()
    out = dict(zip(LOCATIONS, place))
    out.update({"FN": fn, "FX": fx, "FS": fs, "YCP(R)": place[5], "ZCP(R)": place[6], "YCP(W)": place[10],
                "ZCP(W)": place[11], "CKSI": cksi, "CETA": ceta, "CPHI": cphi, "APPROACH": patch.approach(),
                "PMAX": patch.p_max()})
    return out


def differences(c, wanted):
    total, patches = wanted[0], wanted[1:]
    sums = dict(zip(["FX(TR)", "FY(TR)", "FZ(TR)"], c.global_forces()[:3]))
    out = [f"{k} {v:.5g} for {total[k]:.5g}" for k, v in sums.items()
           if not abs(v - total[k]) <= FORCE * abs(total["FZ(TR)"])]
    if c.patches() != len(patches):
        return out + [f"{c.patches()} patches for {len(patches)}"], {}
    worst = {"place": 0.0, "force": 0.0}
    for number, patch in enumerate(patches, 1):
        found = answers(c, number)
        for name, value in found.items():
            is_place = "CP(" in name and not name.startswith("DELT")
            if name not in patch or not (is_place or name in ("FN", "FX", "FS")):
                continue
            scale = max(abs(patch["FN"]), LEAST / FORCE * abs(total["FZ(TR)"]))
            off = abs(value - patch[name]) / (1 if is_place else scale)
            worst["place" if is_place else "force"] = max(worst["place" if is_place else "force"], off)
            if not off <= (PLACE if is_place else FORCE):
                out.append(f"patch {number} {name} {value:.5g} for {patch[name]:.5g}")
    return out, worst


def run(library, file, options):
    lines, wanted = Lines(file.read_text(errors="replace")), printed(file.with_suffix(".ref_out"))
    listed = Lines(file.read_text(errors="replace"))
    count = sum(1 for _ in iter(listed.module, 0))
    if count != len(wanted):
        raise SystemExit(f"{file}: {count} cases, printed results of {len(wanted)}")
    c = Wheel(library)
    number = cases = good = off = 0
    reasons, worst = [], {"place": 0.0, "force": 0.0}
    while (module := lines.module()) != 0:
        number += 1
        if module != 1:
            continue
        cases += 1
        try:
            set_case(c, lines, file.parent)
            code = c.calculate()
            if code < 0:
                raise Refusal(f"{code}: {c.error()[1].splitlines()[0][:400]}")
            wrong, most = differences(c, wanted[number])
        except (Refusal, Unread, IndexError, KeyError) as e:
            reasons.append(str(e))
            if options.verbose:
                print(f"  {file.stem} case {number}: {e}")
            continue
        good += not wrong
        off += bool(wrong)
        for name, value in most.items():
            worst[name] = max(worst[name], value)
        if options.verbose:
            print(f"  {file.stem} case {number}: {', '.join(wrong) or 'equal'}")
            if wrong or options.numbers:
                for k, patch in enumerate(wanted[number][1:], 1):
                    for name, value in answers(c, k).items():
                        print(f"      {k} {name:12} {value:14.6g} {patch.get(name, float('nan')):14.6g}")
    print(f"{file.stem:22} {cases:5} {good:6} {off:5}  {worst['place']:8.4f} {100 * worst['force']:8.3f}  "
          f"{'; '.join(dict.fromkeys(reasons))[:400]}", flush=True)
    return cases, good, off


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("library")
    parser.add_argument("checkout", type=pathlib.Path)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--verbose", action="store_true")
    parser.add_argument("--numbers", action="store_true", help="all numbers of every case")
    options = parser.parse_args()
    library = contact_library.load(options.library)
    contact_library.begin(library)
    print(f"{'example':22} {'cases':>5} {'equal':>6} {'off':>5}  {'mm':>8} {'% of FN':>8}  refused")
    total = [0, 0, 0]
    files = sorted(options.checkout.glob("examples/*.inp")) + sorted(options.checkout.glob("testbank/**/*.inp"))
    for file in files:
        if options.names and file.stem not in options.names:
            continue
        text = file.read_text(errors="replace")
        if not re.search(r"^ *1 +MODULE", text, re.M | re.I) or not file.with_suffix(".ref_out").exists():
            continue
        total = [a + b for a, b in zip(total, run(library, file, options))]
    print(f"{'all':22} {total[0]:5} {total[1]:6} {total[2]:5}")
    return 1 if total[2] else 0


if __name__ == "__main__":
    sys.exit(main())
