"""A minimal Debian 12 in a folder, made by mmdebstrap; commands in it see nothing of this machine but its network."""
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import time

TOOLS = ("mmdebstrap", "unshare")


def missing(*further):
    """What keeps a tree from being made here, in words; empty if nothing does."""
    lacking = [tool for tool in (*TOOLS, *further) if not shutil.which(tool)]
    return ", ".join([*(["root"] if os.geteuid() != 0 else []), *lacking])


def done(*words, **options):
    """The output of a command that must succeed; its time is printed."""
    begun = time.monotonic()
    out = subprocess.run([str(w) for w in words], capture_output=True, text=True, timeout=3600, **options)
    print(f"{time.monotonic() - begun:7.1f} s  {' '.join(map(str, words))[:150]}", flush=True)
    if out.returncode:
        sys.exit(f"exit code {out.returncode}\n{out.stdout[-4000:]}{out.stderr[-4000:]}")
    return out.stdout


class Tree:
    """A system in a folder; it sees folders of this machine at the places that `shared` maps them to."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.shared, self.environment = {}, {}

    def run(self, command):
        shared = "".join(f'mkdir -p "$0"{shlex.quote(inside)}; mount --bind {shlex.quote(outside)} '
                         f'"$0"{shlex.quote(inside)}; ' for outside, inside in self.shared.items())
        environment = " ".join(shlex.quote(f"{name}={value}") for name, value in self.environment.items())
        return done("unshare", "--mount", "--pid", "--fork", "sh", "-ec",
                    'mount -t proc proc "$0/proc"; mount --bind /dev "$0/dev"; mount -t tmpfs tmpfs "$0/dev/shm"; '
                    f'{shared}exec chroot "$0" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 '
                    f'DEBIAN_FRONTEND=noninteractive {environment} sh -ec "$1"', self.folder, command)

    def apt(self, *names):
        return self.run("apt-get install -y -qq --no-install-recommends " + " ".join(names))


def made(folder, *packages):
    """A new system with apt alone and these packages; it reaches the archive as this machine does."""
    options = [f"--include={','.join(packages)}"] if packages else []
    done("mmdebstrap", "--quiet", "--mode=root", "--variant=minbase", *options, "bookworm", folder)
    for file in pathlib.Path("/etc/apt/apt.conf.d").glob("*proxy*"):
        shutil.copy(file, pathlib.Path(folder) / "etc/apt/apt.conf.d")
    if pathlib.Path("/etc/resolv.conf").exists():
        shutil.copy("/etc/resolv.conf", pathlib.Path(folder) / "etc/resolv.conf")
    return Tree(folder)
