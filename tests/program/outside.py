"""The program as a user meets it: words in, exit code and texts out."""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
from selected import main, slow  # noqa: F401 (for the scripts; it takes --slow from the words)

BINARY = pathlib.Path(sys.argv[1]).resolve()

# A disc with a crowned tread on a block, 30 mm of rolling: the whole chain in a second.
TINY = (pathlib.Path(__file__).parents[1] / "data" / "tiny.toml").read_text()


# Smaller still, a fifth of the time: the wheel of soak.toml with two positions.
SMALL = (pathlib.Path(__file__).parent / "soak.toml").read_text()
for old, new in (("100 mm/s", "10 m/s"), ('["65 mm"]', '["6 mm", "12 mm"]'), ('run_up = "5 mm"', 'run_up = "2 mm"'),
                 ("0.5 mm", "0.1 mm")):
    assert SMALL.count(old) == 1, old
    SMALL = SMALL.replace(old, new)

# Two positions, the first after a run-up.
TWO = TINY.replace('["30 mm"]', '["12 mm", "24 mm"]').replace('run_up = "0 mm"', 'run_up = "8 mm"')


def railstrata(*words, cwd=None, **options):
    done = subprocess.run([BINARY, *map(str, words)], capture_output=True, text=True, timeout=300, cwd=cwd, **options)
    return done.returncode, done.stdout, done.stderr


def start(*words, **options):
    return subprocess.Popen([BINARY, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            **options)


def wait_for(condition, process):
    end = time.monotonic() + 250
    while not condition():
        if process.poll() is not None or time.monotonic() > end:
            raise AssertionError(f"waited in vain; {process.poll()}: {process.communicate()[1]}")
        time.sleep(0.002)


def text_of(file):
    """Empty where there is no such file, or not at this moment: a run that is resumed writes its history anew."""
    try:
        return file.read_text()
    except FileNotFoundError:
        return ""


def rows(folder):
    return text_of(folder / "history.csv").count("\n")


def results(folder):
    """Every file's bytes; without wall times, memory, threads and where it was run."""
    out = {}
    for file in sorted(p for p in folder.rglob("*") if p.is_file()):
        name = str(file.relative_to(folder))
        if name in ("provenance.json", "log.txt", "study.json"):
            continue
        out[name] = file.read_bytes()
        for place in (folder.absolute(), folder.resolve()):  # view.py has its place
            out[name] = out[name].replace(str(place).encode(), b"FOLDER")
        if file.name == "summary.json":
            summary = json.loads(out[name])
            for key in ("wall_s", "preload_wall_s", "output_wall_s", "element_steps_per_s", "peak_memory_bytes",
                        "threads"):
                del summary["run"][key]
            out[name] = json.dumps(summary)
    return out


def broken_files(folder):
    """Files of a result folder that are not whole, by their own format."""
    def whole(file):
        text = file.read_bytes()
        match file.suffix:
            case ".json":
                return bool(json.loads(text))
            case ".csv":
                table = [line for line in text.decode().splitlines() if not line.startswith("#")]
                grows = file.name in ("history.csv", "patch_film.csv")  # row by row
                return text == b"" and grows or text.endswith(b"\n") and len(
                    {len(row) for row in csv.reader(table)}) == 1
            case ".vtp" | ".vtu" | ".pvd":
                return text.rstrip().endswith(b"</VTKFile>")
            case ".html":
                return text.rstrip().endswith(b"</html>")
            case ".toml" | ".py":
                return text.endswith(b"\n")
        # a whole one is resumed from; anything else has no business there
        return file.name in ("checkpoint.h5", "checkpoint.h5.previous")
    found = []
    for file in sorted(p for p in folder.rglob("*") if p.is_file()):
        try:
            ok = whole(file)
        except ValueError:
            ok = False
        if not ok:
            found.append(str(file.relative_to(folder)))
    return found


def fact(promise, **figures):
    """A line for tools/reliability_table.py: what was seen."""
    print("RELIABILITY", json.dumps({"fact": promise, **figures}), flush=True)


def origin(folder):
    """What a result comes from, in the words of a record."""
    p = json.loads((folder / "provenance.json").read_text())
    return {"commit": p["commit"] + ("+dirty" if p["dirty"] else ""), "cpu": p["cpu"], "compiler": p["compiler"],
            "isa": p["isa"].split(",")[0]}


def keep_record(file, seen):
    """Adds a line to a record, a CSV file of long campaigns."""
    new = not file.exists()
    with file.open("a", newline="") as stream:
        writer = csv.DictWriter(stream, seen, lineterminator="\n")
        if new:
            writer.writeheader()
        writer.writerow(seen)


class FromOutside(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def case(self, text):
        file = self.folder / "case.toml"
        file.write_text(text)
        return file

    def refused(self, code, words, *messages):
        rc, out, err = railstrata(*words)
        self.assertEqual(rc, code, err)
        for message in messages:
            self.assertIn(message, err)
        return out
