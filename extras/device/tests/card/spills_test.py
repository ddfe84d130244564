#!/usr/bin/env python3
"""Compiles every .cu of extras/ for sm_90 and fails where a kernel spills registers, keeps a stack or is missing.

spills_test.py SOURCE NVCC HOST_COMPILER; exit code 77 where there is no nvcc.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

ENTRY = re.compile(
    r"Compiling entry function '(?P<name>\S+)' for '\S+'"
    r".*?(?P<stack>\d+) bytes stack frame, (?P<stores>\d+) bytes spill stores, (?P<loads>\d+) bytes spill loads"
    r".*?Used (?P<registers>\d+) registers",
    re.DOTALL,
)


def kernels(text):
    """Of what ptxas -v says: name, registers and bytes of stack and spills of every kernel."""
    found = []
    for m in ENTRY.finditer(text):
        spilled = int(m["stores"]) + int(m["loads"])
        found.append((m["name"], int(m["registers"]), int(m["stack"]), spilled))
    return found


def self_test():
    said = (
        "ptxas info    : Compiling entry function '_Z3runv' for 'sm_90'\n"
        "ptxas info    : Function properties for _Z3runv\n"
        "    32 bytes stack frame, 8 bytes spill stores, 4 bytes spill loads\n"
        "ptxas info    : Used 255 registers, used 0 barriers\n"
    )
    assert kernels(said) == [("_Z3runv", 255, 32, 12)], kernels(said)


def main():
    source, nvcc, host = sys.argv[1:]
    self_test()
    if not nvcc or nvcc.endswith("-NOTFOUND"):
        print("SKIPPED: nvcc is not found, so no .cu can be compiled here")
        return 77
    failed = 0
    files = sorted(pathlib.Path(source, "extras").rglob("*.cu"))
    assert files, "no .cu in extras/"
    for file in files:
        with tempfile.TemporaryDirectory() as folder:
            command = [nvcc, "-std=c++20", "--expt-relaxed-constexpr", "-O3", "-ccbin", host, "-arch=sm_90", "-Xptxas"]
            wings = [f"-I{wing}" for wing in sorted(pathlib.Path(source, "src").iterdir()) if wing.is_dir()]
            command += ["-v", *wings, "-I", f"{source}/extras", "-c", str(file), "-o", f"{folder}/out.o"]
            run = subprocess.run(command, capture_output=True, text=True, check=False)
        if run.returncode:
            print(run.stdout + run.stderr)
            return 1
        found = kernels(run.stderr + run.stdout)
        assert found, f"ptxas named no kernel of {file}"
        for name, registers, stack, spilled in found:
            if stack or spilled:
                print(f"{file.name}: {name}: {registers} registers, {stack} bytes of stack, {spilled} bytes spilled")
                failed += 1
        print(f"{file.name}: {len(found)} kernels, at most {max(r for _, r, _, _ in found)} registers, {failed} spill")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
