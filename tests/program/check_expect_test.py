#!/usr/bin/env python3
"""tools/check_expect.py notices what it must. usage: check_expect_test.py SOURCE_DIR"""
import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

SOURCE = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(SOURCE / "tools"))
import check_expect  # noqa: E402

SUMMARY = {"contact": {"p_max_Pa": 1e9, "F_x_N": 20.0, "F_z_N": 100.0, "creepage_x": None, "zero": 0.0},
           "checks": [{"name": "energy_closure", "ok": True, "value": 0.004, "limit": 0.01}]}


def outcome(expectations, summary=SUMMARY):
    """Exit code of the program for one folder with a case, its expectations and its results."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "expect.toml").write_text(expectations)
        (folder / "summary.json").write_text(json.dumps(summary))
        with mock.patch.object(sys, "argv", ["check_expect.py", name, name]), contextlib.redirect_stdout(
                io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            return check_expect.main()


class CheckExpect(unittest.TestCase):
    def test_a_value_within_its_allowance_is_met_and_one_outside_is_not(self):
        entry = '["contact.p_max_Pa"]\nvalue = {}\nrelative = 0.03\nwhy = "w"\n'
        for value, code in [("0.98e9", 0), ("1.02e9", 0), ("0.96e9", 1), ("1.04e9", 1)]:
            self.assertEqual(outcome(entry.format(value)), code, value)
        self.assertEqual(outcome('["contact.F_z_N"]\nvalue = 101\nabsolute = 2\nwhy = "w"\n'), 0)
        self.assertEqual(outcome('["contact.F_z_N"]\nvalue = 101\nabsolute = 0.5\nwhy = "w"\n'), 1)

    def test_min_and_max_bound_alone_or_together(self):
        for text, code in [("min = 99", 0), ("min = 101", 1), ("max = 101", 0), ("max = 99", 1),
                           ("min = 99\nmax = 101", 0), ("min = 90\nmax = 99", 1)]:
            self.assertEqual(outcome(f'["contact.F_z_N"]\n{text}\nwhy = "w"\n'), code, text)

    def test_quotients_and_checks_are_found(self):
        self.assertEqual(outcome('["contact.F_x_N / contact.F_z_N"]\nvalue = 0.2\nrelative = 1e-9\nwhy = "w"\n'), 0)
        self.assertEqual(outcome('["checks.energy_closure"]\nmax = 0.003\nwhy = "w"\n'), 1)

    def test_what_is_null_missing_or_not_a_number_is_not_met(self):
        for name in ["contact.creepage_x", "contact.p_max", "contact", "checks.none", "contact.F_z_N / contact.zero",
                     "contact.F_z_N / contact.F_z_N / contact.F_z_N"]:
            self.assertEqual(outcome(f'["{name}"]\nmin = -1e300\nwhy = "w"\n'), 1, name)
        self.assertEqual(outcome('["contact.p_max_Pa"]\nmin = 0\nwhy = "w"\n', {"contact": {"p_max_Pa": float("nan")}}),
                         1)

    def test_one_unmet_entry_among_met_ones_fails(self):
        self.assertEqual(outcome('["contact.F_x_N"]\nmin = 30\nwhy = "w"\n["contact.F_z_N"]\nmin = 99\nwhy = "w"\n'), 1)

    def test_expectations_that_cannot_fail_or_say_no_why_are_refused(self):
        for text in ["", '["contact.F_z_N"]\nwhy = "w"\n', '["contact.F_z_N"]\nmin = 1\n',
                     '["contact.F_z_N"]\nvalue = 1\nwhy = "w"\n',
                     '["contact.F_z_N"]\nmin = 1\nmaximum = 2\nwhy = "w"\n',
                     '["contact.F_z_N"]\nmin = 2\nmax = 1\nwhy = "w"\n',
                     '["contact.F_z_N"]\nvalue = 1\nrelative = 1\nmin = 0\nwhy = "w"\n']:
            self.assertEqual(outcome(text), 2, text)

    def test_every_shipped_case_has_expectations_that_can_be_used(self):
        files = [c for c in sorted((SOURCE / "cases").glob("*/*.toml"))
                 if not c.name.endswith("expect.toml") and c.parent.name not in ("material", "along")]  # nothing rolls
        cases = [c for c in files if "study" not in check_expect.tomllib.loads(c.read_text())]
        self.assertGreaterEqual(len(cases), 6)
        for case in cases:
            entries = check_expect.tomllib.loads(check_expect.expect_file(case).read_text())
            self.assertGreaterEqual(len(entries), 3, case)
            for name, entry in entries.items():
                check_expect.bounds(name, entry)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
