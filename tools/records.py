"""Small tables of what a campaign found, kept in docs/reliability/*.csv: one row for each key, with the commit it was found at."""
import csv
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent


def commit():
    """Short hash of the checkout, with a + when files of the program differ from it."""
    def git(*args):
        return subprocess.run(["git", "-C", str(ROOT), *args], capture_output=True, text=True).stdout.strip()

    return (git("rev-parse", "--short=10", "HEAD") or "unknown") + ("+" if git("status", "--porcelain", "--", "src", "tests", "cmake", "CMakeLists.txt") else "")


def keep(path, key, rows):
    """Puts rows (dicts of the same columns) into the table at `path`, in place of those with the same values in the columns `key`."""
    path = pathlib.Path(path)
    columns = list(rows[0])
    kept = []
    if path.exists():
        with path.open(newline="") as f:
            reader = csv.DictReader(f)
            if reader.fieldnames == columns:
                kept = list(reader)
    table = {tuple(str(r[k]) for k in key): r for r in kept + rows}
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="") as f:
        writer = csv.DictWriter(f, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(table.values())
