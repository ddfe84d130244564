#!/usr/bin/env python3
"""Packs an installed RailStrata as a wheel or as a .tar.gz that need nothing but the C and C++ libraries of a Linux.

usage: pack.py wheel|tarball PREFIX FOLDER --no-remote FILE [--native]

PREFIX: what `cmake --install` has made on Debian 12. Libraries that others may lack (OpenMP, HDF5) are copied beside
those of RailStrata, with their licences; --no-remote: the library that stands in for curl and OpenSSL, which HDF5 asks
for. Refused is what the wheel's tag does not promise: a build for this machine's processor (--native, of tests, packs
it all the same), symbols newer than those of Debian 12, and FFTW, whose licence is the GPL. Prints the file's name.
"""
import argparse
import base64
import hashlib
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TAG = "manylinux_2_36_x86_64"
# Libraries that every Linux of the tag has [PEP 600], and the newest symbols of Debian 12 (glibc 2.36, GCC 12).
EVERYWHERE = re.compile(r"(libc|libm|libdl|librt|libpthread|libstdc\+\+|libgcc_s|libz|ld-linux-x86-64)\.so\.\d+")
NEWEST = {"GLIBC": (2, 36), "GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13), "GCC": (12, 0, 0)}
REMOTE = {"libcurl.so.4", "libcrypto.so.3"}
# What is compiled in, by the Debian packages whose copyright files give its licence.
INSIDE = ["libfmt-dev", "libtomlplusplus-dev", "nlohmann-json3-dev", "libeigen3-dev", "zlib1g-dev", "libcli11-dev"]
EPOCH = (1980, 1, 1, 0, 0, 0)


def output(*words):
    return subprocess.run([str(w) for w in words], capture_output=True, text=True, check=True).stdout


def version():
    return re.search(r"project\(railstrata VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def is_binary(file):
    return file.is_file() and not file.is_symlink() and file.read_bytes()[:4] == b"\x7fELF"


def binaries(folder):
    return sorted(f for f in folder.rglob("*") if is_binary(f))


def needed(file):
    return re.findall(r"\(NEEDED\).*\[(.*)\]", output("readelf", "-d", file))


def of_system(name):
    """The system's library of this name."""
    match = re.search(rf"^\s*{re.escape(name)} .*=> (\S+)$", output("/sbin/ldconfig", "-p"), re.M)
    if not match:
        sys.exit(f"pack.py: {name} is not among the system's libraries")
    return pathlib.Path(match[1])


def package_of(file):
    """The Debian package of a file of the system, which may be known by its name before /usr was merged."""
    real = file.resolve()
    for name in (real, pathlib.Path("/") / real.relative_to("/usr") if real.is_relative_to("/usr") else real):
        found = subprocess.run(["dpkg", "-S", str(name)], capture_output=True, text=True)
        if found.returncode == 0:
            return found.stdout.split(":")[0]
    return sys.exit(f"pack.py: no Debian package has {file}, so its licence is not known")


def take_along(tree, libraries, no_remote):
    """Copies what binaries of the tree need and others may lack into `libraries`; returns the packages it is from."""
    packages, todo = [], binaries(tree)
    while todo:
        file = todo.pop()
        for name in needed(file):
            if name in REMOTE:
                subprocess.run(["patchelf", "--replace-needed", name, no_remote.name, str(file)], check=True)
                name = no_remote.name
            target = libraries / name
            if EVERYWHERE.fullmatch(name) or target.exists():
                continue
            if name.startswith("libfftw"):
                sys.exit("pack.py: this build has FFTW, which is under the GPL: configure with -DRAILSTRATA_FFT=kiss")
            source = no_remote if name == no_remote.name else of_system(name)
            shutil.copyfile(source, target)
            subprocess.run(["patchelf", "--set-rpath", "$ORIGIN", str(target)], check=True)
            if source != no_remote:
                packages.append(package_of(source))
            todo.append(target)
    return packages


def check_processor(prefix):
    """librailstrata.so asks the loader for x86-64-v2 and no more, and stands there for -v3 and -v4 too."""
    files = [f for f in prefix.rglob("librailstrata.so.*.*.*") if not f.is_symlink()]
    levels = {f.parent.name.removeprefix("x86-64-") if "glibc-hwcaps" in f.parts else "v2":
              re.findall(r"x86 ISA needed:.*x86-64-(v\d)", output("readelf", "-nW", f)) for f in files}
    if levels != {level: [level] for level in ("v2", "v3", "v4")}:
        sys.exit(f"pack.py: {prefix} was not built for all processors: build it with -DRAILSTRATA_VARIANTS=ON "
                 "(./railstrata wheel, ./railstrata tarball or cmake --preset install)")


def too_new(file):
    """Versions of symbols that Debian 12 does not have."""
    found = re.findall(r"\b(GLIBC|GLIBCXX|CXXABI|GCC)_([\d.]+)", output("readelf", "-V", "--wide", file))
    return sorted({f"{name}_{number}" for name, number in found if tuple(map(int, number.split("."))) > NEWEST[name]})


def check_symbols(tree):
    wrong = {file.name: too_new(file) for file in binaries(tree)}
    wrong = [f"{name}: {', '.join(versions)}" for name, versions in wrong.items() if versions]
    if wrong:
        sys.exit("pack.py: newer than Debian 12, on which this has to be built:\n" + "\n".join(wrong))


def add_licences(folder, packages):
    """RailStrata's, those of what is inside, and those of what has come along."""
    folder.mkdir(parents=True)
    shutil.copy(ROOT / "LICENSE", folder / "LICENSE")
    shutil.copy(ROOT / "web/dist/explore_licences.txt", folder / "explore-page.txt")
    for name in sorted({*INSIDE, *packages}):
        shutil.copyfile(f"/usr/share/doc/{name}/copyright", folder / f"{name}.txt")


def strip(tree):
    """Before patchelf: what strip makes of a file that patchelf has changed cannot be loaded."""
    for file in binaries(tree):
        subprocess.run(["strip", "--strip-unneeded", str(file)], check=True)


def copy_libraries(source, target, names):
    """Libraries with a version of their soname, under that name: a wheel has no links."""
    for file in source.rglob("librailstrata*.so.*.*.*"):
        if file.is_symlink() or not any(file.name.startswith(f"lib{name}.so") for name in names):
            continue
        soname = re.search(r"\(SONAME\).*\[(.*)\]", output("readelf", "-d", file))[1]
        place = target / file.relative_to(source).parent / soname
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, place)


def metadata(licences):
    texts = "".join(f"License-File: {name}\n" for name in licences)
    return f"""Metadata-Version: 2.4
Name: railstrata
Version: {version()}
Summary: Rolling contact of a railway wheel on a rail whose surface carries layers
License-Expression: BSD-3-Clause
{texts}Requires-Python: >=3.9
Requires-Dist: numpy
Description-Content-Type: text/markdown

{(ROOT / "docs/python.md").read_text()}"""


def record(files):
    rows = []
    for name, data in files:
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        rows.append(f"{name},sha256={digest},{len(data)}\n")
    return "".join(rows)


def zipped(tree, file, info):
    names = sorted(f.relative_to(tree).as_posix() for f in tree.rglob("*") if f.is_file())
    files = [(name, (tree / name).read_bytes()) for name in names]
    rows = record(files) + f"{info}/RECORD,,\n"
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as out:
        for name, data in [*files, (f"{info}/RECORD", rows.encode())]:
            entry = zipfile.ZipInfo(name, EPOCH)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            out.writestr(entry, data)


def wheel(given, tree):
    package = tree / "railstrata"
    source = next(given.prefix.rglob("railstrata/__init__.py")).parent
    shutil.copytree(source, package, ignore=shutil.ignore_patterns("__pycache__"))
    libraries = package / "lib"
    libraries.mkdir()
    installed = next(f for f in given.prefix.rglob("librailstrata-bridge.so.*") if "glibc-hwcaps" not in f.parts).parent
    copy_libraries(installed, libraries, ("railstrata", "railstrata-bridge", "railstrata-hdf5"))
    shutil.copytree(given.prefix / "share/railstrata", package / "share/railstrata")
    strip(package)
    packages = take_along(package, libraries, given.no_remote)
    check_symbols(package)
    info = tree / f"railstrata-{version()}.dist-info"
    add_licences(info / "licenses", packages)
    (info / "METADATA").write_text(metadata(sorted(f.name for f in (info / "licenses").iterdir())))
    (info / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: RailStrata tools/pack.py\nRoot-Is-Purelib: false\n"
                                f"Tag: py3-none-{TAG}\n")
    file = given.folder / f"railstrata-{version()}-py3-none-{TAG}.whl"
    zipped(tree, file, info.name)
    return file


def readme(name):
    return f"""RailStrata {version()} for Linux on x86-64 processors (glibc 2.36 and later).

Unpack it anywhere and run bin/railstrata:

    {name}/bin/railstrata run cases/quick
    {name}/bin/railstrata bem cases/quick

Cases and profiles are in share/railstrata, the documentation in share/doc/railstrata, with the licences of all that is
inside in share/doc/railstrata/licenses. A C, C++ or Fortran program links lib/librailstrata.so (include/railstrata,
share/railstrata/examples).
"""


def ordinary(entry):
    """Without the name of the packer; two of one build are the same."""
    entry.uid = entry.gid = entry.mtime = 0
    entry.uname = entry.gname = "root"
    return entry


def tarball(given, tree):
    name = f"railstrata-{version()}-linux-x86_64"
    root = tree / name
    unwanted = shutil.ignore_patterns("python3*", "railstrata_mpi.so", "librailstrata-bridge.so*")
    shutil.copytree(given.prefix, root, symlinks=True, ignore=unwanted)
    strip(root)
    packages = take_along(root, next(root.rglob("librailstrata.so")).parent, given.no_remote)
    check_symbols(root)
    add_licences(root / "share/doc/railstrata/licenses", packages)
    (root / "README.txt").write_text(readme(name))
    file = given.folder / f"{name}.tar.gz"
    with tarfile.open(file, "w:gz", compresslevel=6) as out:
        out.add(root, name, filter=ordinary)
    return file


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("what", choices=("wheel", "tarball"))
    parser.add_argument("prefix", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--no-remote", type=pathlib.Path, required=True)
    parser.add_argument("--native", action="store_true")
    given = parser.parse_args()
    if not shutil.which("patchelf"):
        sys.exit("pack.py: patchelf is missing (Debian: patchelf)")
    if not given.native:
        check_processor(given.prefix)
    given.folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=given.folder) as tree:
        print({"wheel": wheel, "tarball": tarball}[given.what](given, pathlib.Path(tree)))


if __name__ == "__main__":
    main()
