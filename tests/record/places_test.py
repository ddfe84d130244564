"""A number of the summary is said once: its symbol stands in a row of src/results/result."""
import json
import pathlib
import re
import subprocess
import sys
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
ROWS = {"src/results/result/result_table.cpp", "src/results/result/damage_rows.cpp"}
# columns of every table, lines of screen and page, axes of a study's trends, rows of `compare`
ALONE = {"layers/critical_flaw_m", "layers/interface_tension_Pa", "layers/interface_shear_Pa",
         "layers/interface_shear_range_Pa"}
MOST_ELSEWHERE = 54  # that checks, pictures and selections name besides, or whose symbol is a common word: not to grow


def texts():
    for place, ending in (("src", "*.?pp"), ("extras", "*.?pp"), ("web/src", "*.ts"), ("python", "*.py")):
        for file in sorted((SOURCE / place).rglob(ending)):
            yield str(file.relative_to(SOURCE)), " ".join(re.findall(r'"(?:[^"\\\n]|\\.)*"', file.read_text()))


class Places(unittest.TestCase):
    def test_a_number_of_the_summary_stands_in_one_file(self):
        done = subprocess.run([PROGRAM, "info", "--schema", "--results"], capture_output=True, check=True)
        listed = json.loads(done.stdout)
        sources = list(texts())
        many = {}
        for number in listed["numbers"]:
            key = number["path"].split("/")[-1]
            words = "|".join(re.escape(w) for w in {key, number["column"] or key})
            files = {name for name, text in sources if re.search(rf"(?<![\w.])(?:{words})(?!\w)", text)} - ROWS
            if files:
                many[number["path"]] = files
        for path in ALONE:
            self.assertNotIn(path, many)
        self.assertTrue(ALONE <= {number["path"] for number in listed["numbers"]})
        self.assertLessEqual(len(many), MOST_ELSEWHERE, sorted(many))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
