#!/usr/bin/python3
"""Builds dist/engine.js and dist/engine.wasm.gz, the engine of the explorer's page, from the rooms of src/ and extras/
as they stand, with the licences of what is inside and the version that the page names. It is made at a release
(RELEASING.md): a change of a source does not ask for it.

usage: web/engine/build_engine.py [FOLDER FOR OBJECTS]

It needs Debian's packages emscripten, ninja-build, libfmt-dev, libeigen3-dev, libtomlplusplus-dev and
nlohmann-json3-dev. The sources are those that src/doors/explore/calls.cpp reaches by its #includes.
"""
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SRC = ROOT / "src"
EXTRAS = ROOT / "extras"
ENTRY = "explore/calls.cpp"
# Rooms whose headers others include for the types, and whose functions nobody calls here: the linker would say.
TYPES_ALONE = ("body/", "element/", "fem/", "contact/", "io/provenance.cpp")
CALLED_HERE = ("contact/patch_extent.cpp",)  # of these, what is called here
NOT_HERE = ("fft/fft_fftw.cpp", "halfspace/circular_pressure.cpp", "hdf5/")
# Whole libraries of headers beside the system's own, which are not for this compiler.
HEADERS = {"fmt": "/usr/include/fmt", "eigen3": "/usr/include/eigen3", "nlohmann": "/usr/include/nlohmann",
           "toml++": "/usr/include/toml++"}
FLAGS = ("-std=c++20 -O3 -msimd128 -fwasm-exceptions -fno-math-errno -ffp-contract=off -Wno-unknown-pragmas "
         "-DNDEBUG -DFMT_HEADER_ONLY -DEIGEN_DONT_VECTORIZE")
LINK = ("-O3 -fwasm-exceptions -sMODULARIZE -sEXPORT_NAME=railstrata_engine -sENVIRONMENT=web,worker,node "
        "-sALLOW_MEMORY_GROWTH -sINITIAL_MEMORY=33554432 -sMAXIMUM_MEMORY=1073741824 -sFORCE_FILESYSTEM "
        "-sINVOKE_RUN=0 -sDYNAMIC_EXECUTION=0 "
        "-sEXPORTED_FUNCTIONS=_rs_explore,_rs_explore_numbers,_rs_explore_count,_malloc,_free "
        "-sEXPORTED_RUNTIME_METHODS=FS,stringToUTF8,lengthBytesUTF8,UTF8ToString")
DOC = "/usr/share/doc"
LICENCES = {"{fmt}": f"{DOC}/libfmt-dev/copyright", "Eigen and kiss FFT": f"{DOC}/libeigen3-dev/copyright",
            "JSON for Modern C++": f"{DOC}/nlohmann-json3-dev/copyright",
            "toml++": f"{DOC}/libtomlplusplus-dev/copyright",
            "musl, the C library": "/usr/share/emscripten/system/lib/libc/musl/COPYRIGHT"}
# Products of complex numbers without a look at every one for NaN; elsewhere the engine works with infinity.
FAST_MATH = {"fft_kiss"}


def placed(file):
    """A file named by its room ("bem/solve_bem.hpp") below its wing or in extras/, or None."""
    return next((f for wing in (*SRC.glob("*/"), EXTRAS) if (f := wing / file).exists()), None)


def includes(file):
    return re.findall(r'^#include "([^"]+)"', placed(file).read_text(), re.M)


def sources():
    """Files to compile, by room, sorted: those whose first header is one of their room that is used."""
    defined_in = {}
    for source in (*SRC.glob("*/*/*.cpp"), *EXTRAS.glob("*/*.cpp")):
        name = "/".join(source.parts[-2:])
        header = next(iter(includes(name)), "")
        if header.startswith(f"{source.parts[-2]}/"):
            defined_in.setdefault(header, []).append(name)
    seen, todo = set(), [ENTRY]
    while todo:
        file = todo.pop()
        if file in seen:
            continue
        seen.add(file)
        for header in includes(file):
            todo.append(header)
            todo += [own for own in defined_in.get(header, ())
                     if own in CALLED_HERE or not own.startswith(TYPES_ALONE + NOT_HERE)]
    return sorted(f for f in seen if f.endswith(".cpp"))


def ninja_file(objects, compiled):
    wings = " ".join(f"-I{wing}" for wing in (*sorted(SRC.iterdir()), EXTRAS) if wing.is_dir())
    lines = ["rule cc", f"  command = em++ {FLAGS} $more {wings} -I{HERE}/stand_in -I{objects}/headers "
             f"-I{objects}/headers/eigen3 -MMD -MF $out.d -c $in -o $out", "  depfile = $out.d", "  deps = gcc",
             "rule link", f"  command = em++ {LINK} $in -o $out", ""]
    units = units_of(objects, compiled)
    for unit, source in units.items():
        lines.append(f"build {unit}.o: cc {source}")
        if unit in FAST_MATH:
            lines.append("  more = -ffast-math")
    lines += [f"build engine.js | engine.wasm: link {' '.join(f'{unit}.o' for unit in units)}", ""]
    return "\n".join(lines)


def units_of(objects, compiled):
    """{name: file}: the sources of a room compiled together, as in the program, those of FAST_MATH by themselves."""
    rooms = {}
    for file in compiled:
        room, name = file.removesuffix(".cpp").split("/")
        rooms.setdefault(name if name in FAST_MATH else room, []).append(f'#include "{placed(file)}"\n')
    for unit, lines in rooms.items():
        text, file = "".join(lines), objects / f"{unit}.cpp"
        if not file.exists() or file.read_text() != text:
            file.write_text(text)
    return {unit: objects / f"{unit}.cpp" for unit in rooms}


def version():
    """As the program names itself: "0.4.0 (48540c40454e)"."""
    def git(*words):
        return subprocess.run(["git", "-C", ROOT, *words], capture_output=True, text=True, check=True).stdout.strip()

    number = re.search(r"^project\(.*?VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.M | re.S)[1]
    dirty = "+dirty" if git("status", "--porcelain", "--", "src", "extras", "web/engine") else ""
    return f"{number} ({git('rev-parse', '--short=12', 'HEAD')}{dirty})"


def licences():
    text = ("Third-party software in the explorer's engine, with its licences. Further inside: LLVM's C++ library\n"
            "(Apache License 2.0 with LLVM Exceptions) and the runtime of Emscripten (MIT License, below).\n")
    for name, file in LICENCES.items():
        text += f"\n{'=' * 80}\n{name}\n\n{pathlib.Path(file).read_text().strip()}\n"
    return text


def build(objects):
    (objects / "headers").mkdir(parents=True, exist_ok=True)
    for name, folder in HEADERS.items():
        link = objects / "headers" / name
        if not link.exists():
            link.symlink_to(folder)
    (objects / "build.ninja").write_text(ninja_file(objects, sources()))
    # a Node that is not Debian's does not look where Debian has the parts that Emscripten asks for
    places = [os.environ.get("NODE_PATH", ""), "/usr/share/nodejs"]
    return subprocess.run(["ninja", "-C", objects, "-j2"], check=False,
                          env={**os.environ, "NODE_PATH": ":".join(filter(None, places))}).returncode


def main():
    objects = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/wasm").resolve()
    before = version()
    if build(objects):
        return 1
    if version() != before:
        print("a source has changed while this was built: start it again", file=sys.stderr)
        return 1
    dist = HERE.parent / "dist"
    dist.mkdir(exist_ok=True)
    shutil.copyfile(objects / "engine.js", dist / "engine.js")
    packed = gzip.compress((objects / "engine.wasm").read_bytes(), mtime=0)
    (dist / "engine.wasm.gz").write_bytes(packed)
    (dist / "explore_licences.txt").write_text(licences())
    (dist / "engine_version.txt").write_text(before + "\n")
    print(f"dist/engine.wasm.gz: {len(packed) / 1e6:.2f} MB from {len(sources())} sources, RailStrata {before}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
