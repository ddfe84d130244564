"""The recorded study: complete, its tables of one piece, and the engines as close as cases/paper/README.md says."""
import csv
import json
import pathlib
import sys
import unittest

SOURCE, PROGRAM = pathlib.Path(sys.argv.pop(1)), sys.argv.pop(1)
FOLDER = SOURCE / "cases/paper/recorded/study"
sys.path.insert(0, str(SOURCE / "tools"))
import engine_agreement  # noqa: E402
import layer_table  # noqa: E402


class RecordedStudy(unittest.TestCase):
    def setUp(self):
        self.limits = engine_agreement.limits(PROGRAM)
        self.study = engine_agreement.rows(FOLDER / "study.csv")
        self.table, self.missing = engine_agreement.agreement(
            self.study, engine_agreement.rows(FOLDER / "equal_cells.csv"), 1.0, self.limits)

    def test_every_case_of_the_study_has_its_result(self):
        self.assertEqual({r["state"] for r in self.study.values()}, {"done"})
        self.assertEqual(sum(engine == "fem" for _, _, engine in self.study), 39)  # one of them under two names
        self.assertEqual(sum(engine == "bem" for _, _, engine in self.study), 19)
        self.assertEqual(self.missing, [])
        summaries = json.loads((FOLDER / "summaries.json").read_text(encoding="utf-8"))
        self.assertEqual({"/".join(key) for key in self.study}, set(summaries))
        for (group, case, engine), row in self.study.items():
            self.assertAlmostEqual(float(row["p_max_MPa"]),
                                   1e-6 * summaries[f"{group}/{case}/{engine}"]["contact"]["p_max_Pa"], delta=1e-6)
        with open(FOLDER / "centre_lines.csv", newline="", encoding="utf-8") as file:
            self.assertEqual({(r["group"], r["case"], r["engine"]) for r in csv.DictReader(file)}, set(self.study))

    def test_finite_elements_agree_with_half_spaces(self):
        self.assertEqual(len(self.table), 19)
        for row in self.table:
            with self.subTest(row["case"]):
                self.assertLess(abs(row["p_max_MPa"]), self.limits["p_max_MPa"])
                self.assertLess(abs(row["patch_length_mm"]), self.limits["patch_length_mm"])
                if row["deep"]:
                    self.assertLess(abs(row["von_mises"]), self.limits["von_mises"])
                self.assertLess(abs(row["q_max_MPa"]), self.limits["q_max_MPa"])
                self.assertLess(abs(row["q_equal"]), 10)
        # README.md there: where the front of slip lies between nodes
        thin = {("layers", f"thickness {mm} mm, young_ratio {ratio}")
                for mm in (0.2, 0.5) for ratio in (1.67, 2, 4)}
        told = thin | {("base", "traction_coefficient 0.2"), ("control", "thickness 0.2 mm"),
                       ("control", "thickness 6 mm"), ("layers", "thickness 1 mm, young_ratio 4"),
                       ("layers", "thickness 6 mm, young_ratio 4")}
        too_far = {(r["group"], r["case"]) for r in self.table if abs(r["q_equal"]) > self.limits["q_max_MPa"]}
        self.assertEqual(too_far, told)

    def test_the_recorded_agreement_is_that_of_the_tables(self):
        with open(FOLDER / "agreement.csv", newline="", encoding="utf-8") as file:
            recorded = list(csv.DictReader(file))
        self.assertEqual([(r["group"], r["case"], r["verdict"]) for r in recorded],
                         [(r["group"], r["case"], r["verdict"]) for r in self.table])

    def test_the_first_page_shows_what_is_recorded(self):
        shown, _ = layer_table.of_page((SOURCE / "README.md").read_text())
        self.assertEqual(shown, layer_table.table(self.study), "write it anew: tools/layer_table.py --write")


if __name__ == "__main__":
    unittest.main()
