"""Small tables of what a campaign found, CSV files with a row for each key and the commit it was found at."""
import csv
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent


def commit(root=ROOT):
    """Short hash of the checkout, with a + when files of the program differ from it."""
    def git(*args):
        return subprocess.run(["git", "-C", str(root), *args], capture_output=True, text=True).stdout.strip()

    changed = git("status", "--porcelain", "--", "src", "extras", "tests", "cmake", "CMakeLists.txt")
    return (git("rev-parse", "--short=10", "HEAD") or "unknown") + ("+" if changed else "")


def rows_of(path):
    if not path.exists():
        return []
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def write(path, rows):
    """The whole table at once: an interrupted call leaves the one before."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_suffix(".part")
    with part.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    part.replace(path)


def keep(path, key, rows):
    """Puts rows (dicts of the same columns) into the table at `path`, in place of those with the same values in the
    columns `key`. A table of other columns begins anew."""
    path = pathlib.Path(path)
    kept = [row for row in rows_of(path) if list(row) == list(rows[0])]
    write(path, list({tuple(str(row[k]) for k in key): row for row in kept + rows}.values()))


def add(path, key, row):
    """Like keep, but what is counted (the numbers in `row`) is added to the row that is there."""
    path = pathlib.Path(path)
    rows = rows_of(path)
    for same in rows:
        if all(same[k] == str(row[k]) for k in key):
            same.update({column: int(same[column]) + value for column, value in row.items() if isinstance(value, int)})
            return write(path, rows)
    write(path, [*rows, row])
