#!/usr/bin/env python3
"""What `railstrata export` writes, by the programs that read it. usage: export_test.py BINARY SOURCES [GROUP]"""
import csv
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

BINARY, SOURCES = sys.argv[1], pathlib.Path(sys.argv[2])
CASE = SOURCES / "extras/export/tests/crossed_cylinders.toml"
ROLLING = SOURCES / "cases/paper/base.toml"


def railstrata(*words):
    return subprocess.run([BINARY, *map(str, words)], capture_output=True, text=True, timeout=500)


def table(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(lines)]


class Exported(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="export-"))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def export(cls, case, target, *words):
        out = cls.folder / target
        done = railstrata("export", case, "--to", target, "--out", out, *words)
        assert done.returncode == 0, done.stderr
        return out

    def says_what_it_lost(self, out, *words):
        text = (out / "README.txt").read_text()
        self.assertIn("Not carried over", text)
        for word in words:
            self.assertIn(word, text.split("Not carried over")[1])


def frd_blocks(path):
    """Positions of the nodes and the last block of each nodal field of a CalculiX result."""
    fields, nodes, current = {}, {}, None
    for line in path.read_text().splitlines():
        if line.startswith("    2C"):
            current = nodes
        elif line.startswith(" -4"):
            current = fields[line.split()[1]] = {}
        elif line.startswith(" -3"):
            current = None
        elif line.startswith(" -1") and current is not None:
            current[int(line[3:13])] = [float(line[i:i + 12]) for i in range(13, len(line.rstrip()), 12)]
    return nodes, fields


class Calculix(Exported):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        if shutil.which("ccx") is None:
            print("skipped: CalculiX (calculix-ccx) is not installed")
            sys.exit(77)
        cls.deck = cls.export(CASE, "calculix")
        cls.screen = subprocess.run(["ccx", "preload"], cwd=cls.deck, env={**os.environ, "OMP_NUM_THREADS": "1"},
                                    check=True, capture_output=True, text=True, timeout=500).stdout
        cls.nodes, cls.fields = frd_blocks(cls.deck / "preload.frd")
        cls.ours = cls.folder / "ours"
        done = railstrata("run", CASE, "--out", cls.ours, "--no-report")
        assert done.returncode in (0, 1), done.stderr
        cls.patch = [row for row in table(cls.ours / "patch.csv") if row["p_MPa"] > 0]

    def pressure_there(self, row):
        at = (row["x_mm"], row["y_mm"], row["z_mm"])
        node = min(self.nodes, key=lambda n: sum((a - b) ** 2 for a, b in zip(self.nodes[n], at)))
        self.assertLess(math.dist(self.nodes[node], at), 1e-3)
        return self.fields["CONTACT"][node][3]

    def test_the_largest_pressure_is_that_of_the_preload_here_and_so_are_its_neighbours(self):
        largest = max(row["p_MPa"] for row in self.patch)
        there = max(values[3] for values in self.fields["CONTACT"].values())
        print(f"p_max: CalculiX {there:.1f} MPa, here {largest:.1f} MPa")
        self.assertLess(abs(there / largest - 1), 0.004)
        for row in self.patch:
            self.assertLess(abs(self.pressure_there(row) - row["p_MPa"]), 0.01 * largest, row)

    def test_the_readme_bounds_how_far_the_largest_node_lies_below_the_summary(self):
        text = " ".join((self.deck / "README.txt").read_text().split())
        bound = float(text.split("lies up to ")[1].split(" %")[0])
        p_max = json.loads((self.ours / "summary.json").read_text())["contact"]["p_max_Pa"] / 1e6
        there = max(values[3] for values in self.fields["CONTACT"].values())
        self.assertLess(bound, 5)
        self.assertGreater(there, p_max * (1 - bound / 100 - 0.004))
        self.assertLess(there, p_max * 1.004)

    def test_the_axle_comes_down_as_far_but_for_the_heights_of_arcs_above_their_chords(self):
        contact = json.loads((self.ours / "summary.json").read_text())["contact"]
        after = (self.deck / "preload.dat").read_text().split("for set AXLE")[1].split("\n")[2]
        axle = float(after.split()[3])
        print(f"axle: CalculiX {-1e3 * axle:.2f} um, approach here {1e6 * contact['approach_m']:.2f} um")
        # the deck's bodies are polygons: on average 2/3 h^2/(8 R) further apart on each of them, h = 1 mm, R = 100 mm
        self.assertAlmostEqual(-axle - 1e3 * contact["approach_m"], 2 * 2 / 3 * 1 / 800, delta=0.3e-3)

    def test_the_rail_bears_the_load_and_its_weight(self):
        words = (self.deck / "preload.dat").read_text().split("total force")[1].split()
        self.assertLess(abs(float(words[-1]) / 60000 - 1), 0.001)

    def test_the_readme_has_the_number_of_equations(self):
        there = int(self.screen.split("number of equations")[1].split()[0])
        self.assertIn(f"\n  {there} equations", (self.deck / "README.txt").read_text())

    def test_the_folder_says_what_it_lost(self):
        self.says_what_it_lost(self.deck, "exact profiles")


class Dyna(Exported):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.cards = {}
        keyword = None
        for line in (cls.export(CASE, "lsdyna") / "preload.k").read_text().splitlines():
            if line.startswith("*"):
                keyword = line
                cls.cards.setdefault(keyword, []).append([])
            elif not line.startswith("$"):
                cls.cards[keyword][-1].append(line)

    def rows(self, keyword):
        return [line for block in self.cards[keyword] for line in block]

    @staticmethod
    def numbers(line, width=10):
        return [int(line[i:i + width]) for i in range(0, len(line), width)]

    def test_columns_have_the_widths_of_the_standard_format(self):
        for line in self.rows("*NODE"):
            self.assertEqual(len(line), 8 + 3 * 16)
        for line in self.rows("*ELEMENT_SOLID"):
            self.assertEqual(len(line), 10 * 8)
        for line in self.rows("*CONSTRAINED_LINEAR_GLOBAL"):
            self.assertIn(len(line), (10, 30))
        for keyword, blocks in self.cards.items():
            for block in blocks:
                for line in block:
                    self.assertLessEqual(len(line), 80, keyword)

    def test_every_number_that_is_referred_to_exists_once(self):
        nodes = [int(line[:8]) for line in self.rows("*NODE")]
        self.assertEqual(len(nodes), len(set(nodes)))
        known = set(nodes)
        elements = [self.numbers(line, 8) for line in self.rows("*ELEMENT_SOLID")]
        self.assertEqual(len(elements), len({row[0] for row in elements}))
        parts = {self.numbers(block[1])[0] for block in self.cards["*PART"]}
        self.assertEqual({row[1] for row in elements}, parts)
        self.assertTrue(all(set(row[2:]) <= known and len(set(row[2:])) == 8 for row in elements))
        for block in self.cards["*PART"]:
            part, section, material = self.numbers(block[1])
            self.assertEqual({part}, {section, material})
        self.assertEqual({int(b[0][:10]) for b in self.cards["*MAT_ELASTIC"]}, parts)
        self.assertEqual({int(b[0][:10]) for b in self.cards["*SECTION_SOLID"]}, parts)
        for keyword in ("*SET_NODE_LIST", "*SET_SEGMENT"):
            for block in self.cards[keyword]:
                for line in block[1:]:
                    self.assertLessEqual(set(self.numbers(line)), known)

    def test_hanging_nodes_hang_once_and_on_free_ones_with_weights_that_sum_to_one(self):
        slaves, masters = set(), set()
        for block in self.cards["*CONSTRAINED_LINEAR_GLOBAL"]:
            terms = [(int(line[:10]), int(line[10:20]), float(line[20:30])) for line in block[1:]]
            self.assertEqual(len({dof for _, dof, _ in terms}), 1)
            self.assertAlmostEqual(sum(c for _, _, c in terms), 0, places=5)
            slave = terms[0][:2]
            self.assertNotIn(slave, slaves)
            slaves.add(slave)
            masters |= {term[:2] for term in terms[1:]}
        self.assertGreater(len(slaves), 1000)
        self.assertFalse(slaves & masters)

    def test_elements_are_not_inside_out_and_surfaces_look_at_each_other(self):
        at = {int(line[:8]): [float(line[8 + 16 * k:24 + 16 * k]) for k in range(3)] for line in self.rows("*NODE")}

        def normal(a, b, c):
            u = [at[b][k] - at[a][k] for k in range(3)]
            v = [at[c][k] - at[a][k] for k in range(3)]
            return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]

        for line in self.rows("*ELEMENT_SOLID")[::7]:
            n = self.numbers(line, 8)[2:]
            up = [at[n[4]][k] - at[n[0]][k] for k in range(3)]
            self.assertGreater(sum(a * b for a, b in zip(normal(n[0], n[1], n[3]), up)), 0, line)
        rail, wheel = ([normal(*self.numbers(line)[:3])[2] for line in block[1:]]
                       for block in self.cards["*SET_SEGMENT"])
        self.assertGreater(min(rail), 0)
        self.assertLess(max(wheel), 0)


class Contact(Exported):
    WORDS = ("--cell", "1 mm")

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.out = cls.export(ROLLING, "contact", *cls.WORDS)
        cls.rows = [[float(w) for w in line.split()] for line in (cls.out / "rail.0001.mat").read_text().splitlines()]
        cls.bem = cls.folder / "bem"
        done = railstrata("bem", ROLLING, *cls.WORDS, "--no-single-track", "--no-report", "--out", cls.bem)
        assert done.returncode in (0, 1), done.stderr
        cls.summary = json.loads((cls.bem / "summary.json").read_text())["contact"]

    def cells(self):
        return self.rows[6:]

    def test_the_table_has_equal_columns_and_the_number_of_its_format(self):
        self.assertEqual({len(row) for row in self.rows}, {11})
        self.assertEqual(self.rows[0][-1], 2410)

    def test_the_table_adds_up_to_the_forces_with_contact_s_signs(self):
        area = self.rows[3][4] * self.rows[3][5]
        normal = area * sum(row[4] for row in self.cells())
        self.assertAlmostEqual(normal / self.summary["normal_force_N"], 1, places=5)
        self.assertAlmostEqual(area * sum(row[5] for row in self.cells()) / -self.summary["F_x_N"], 1, places=3)
        lateral = -area * sum(row[6] for row in self.cells())  # on the rail, y to the right
        self.assertAlmostEqual(lateral / -self.summary["lateral_force_N"] if lateral else 1, 1, places=2)

    def test_places_and_states_are_those_of_the_patch(self):
        mx, _, xl, yl, dx, dy = self.rows[3][:6]
        patch = {(round(row["x_mm"], 3), row["y_mm"]): row for row in table(self.bem / "patch.csv")}
        largest = max(self.cells(), key=lambda row: row[4])
        number = int(largest[0]) - 1
        x, y = xl + (number % mx + 0.5) * dx, -(yl + (number // mx + 0.5) * dy)
        there = max(patch.values(), key=lambda row: row["p_MPa"])
        self.assertAlmostEqual(x, there["x_mm"], places=3)
        middle = sum(row[4] * -(yl + ((int(row[0]) - 1) // mx + 0.5) * dy) for row in self.cells())
        middle /= sum(row[4] for row in self.cells())
        at = sum(row["p_MPa"] * row["y_mm"] for row in patch.values()) / sum(row["p_MPa"] for row in patch.values())
        self.assertAlmostEqual(y - middle, there["y_mm"] - at, delta=0.02)
        self.assertAlmostEqual(largest[4], there["p_MPa"], places=2)
        self.assertEqual({int(row[1]) for row in self.cells()}, {1, 2})

    def test_slip_pulls_the_rail_along(self):
        friction = self.rows[5][3]
        for row in self.cells():
            bound = friction * row[4]
            if row[1] == 2:
                self.assertAlmostEqual(math.hypot(row[5], row[6]) / bound, 1, places=4)
            else:
                self.assertLess(math.hypot(row[5], row[6]), bound * 1.0001)

    def test_stresses_are_blocks_of_fourteen_columns_that_bear_the_pressure_at_the_surface(self):
        rows = [[float(w) for w in line.split()] for line in (self.out / "rail.0001.subs").read_text().splitlines()]
        self.assertEqual({len(row) for row in rows}, {14})
        nx, ny, nz = map(int, rows[0][:3])
        self.assertEqual(len(rows) - 1, nx * ny * nz)
        surface = [row for row in rows[1:] if row[2] == 0]
        largest = max(row[4] for row in self.cells())
        self.assertLess(abs(min(row[13] for row in surface) / -largest - 1), 0.01)

    def test_the_case_has_the_digits_grid_and_distances_of_module_3(self):
        lines = [line.split("   ")[0].split() for line in (self.out / "rail.inp").read_text().splitlines()
                 if not line.startswith("%")]
        self.assertEqual(lines[0][0], "3")
        self.assertEqual([line[0] for line in lines[1:4]], ["203100", "022029", "0001341"])
        normal, ksi, eta, _ = map(float, lines[5])
        self.assertAlmostEqual(normal / self.summary["normal_force_N"], 1, places=6)
        self.assertAlmostEqual(ksi, -self.summary["creepage_x"], places=8)
        self.assertAlmostEqual(eta, self.summary["creepage_y"], places=8)
        grid = lines[10]
        numbers, cells = [float(w) for line in lines[12:-1] for w in line], int(grid[0]) * int(grid[1])
        self.assertEqual(len(numbers), 3 * cells)  # distances, then the extra slip (extras/cntc/tests/exported_test.py)
        self.assertGreaterEqual(min(numbers[:cells]), -1e-9)
        self.says_what_it_lost(self.out, "UN, UX, UY", "`railstrata bem` of the same case")


class Refusals(Exported):
    def test_what_cannot_be_exported_is_said_with_a_remedy(self):
        for case, target in (("cases/line/carter.toml", "contact"), ("cases/transient/fretting.toml", "contact"),
                             ("cases/line/carter.toml", "calculix"), ("cases/transient/fretting.toml", "lsdyna")):
            done = railstrata("export", SOURCES / case, "--to", target, "--out", self.folder / "no")
            self.assertEqual(done.returncode, 2, (case, target))
            self.assertIn("remedy", done.stderr)
            self.assertFalse((self.folder / "no").exists())

    def test_options_of_the_other_kind_of_program_are_refused(self):
        for target, words in (("contact", ["--friction"]), ("calculix", ["--cell", "1 mm"])):
            done = railstrata("export", CASE, "--to", target, *words, "--out", self.folder / "no")
            self.assertEqual(done.returncode, 2, target)
            self.assertIn(words[0], done.stderr)
            self.assertFalse((self.folder / "no").exists())

    def test_a_layered_case_has_results_for_contact_but_no_input(self):
        out = self.export(SOURCES / "cases/paper/layer_3mm_2E0.toml", "contact", "--cell", "2 mm")
        self.assertTrue((out / "rail.0001.mat").exists())
        self.assertFalse((out / "rail.inp").exists())
        self.says_what_it_lost(out, "layers")


class Octave(Exported):
    def test_a_result_is_read_as_matrices_with_units(self):
        if shutil.which("octave-cli") is None:
            print("skipped: Octave is not installed")
            sys.exit(77)
        out = self.folder / "bem"
        done = railstrata("bem", ROLLING, "--cell", "1 mm", "--no-single-track", "--no-report", "--out", out)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        rows = table(out / "patch.csv")
        script = self.folder / "read.m"
        script.write_text(f"""
          addpath('{SOURCES}/matlab');
          r = railstrata_read('{out}');
          printf('%d %d %.10g %.10g %s %d %d\\n', size(r.patch.p_MPa), max(r.patch.p_MPa(:)), ...
                 r.summary.contact.p_max_Pa, r.patch.units.p_MPa, ...
                 all(all(diff(r.patch.x_mm) > 0)) && all(all(diff(r.patch.y_mm, 1, 2) > 0)), ...
                 all(all(diff(r.sections.rail_cross_section.depth_mm) > 0)));
          try
            railstrata_read('{self.folder}');
          catch mistake
            disp(mistake.identifier);
          end
        """)
        done = subprocess.run(["octave-cli", "--no-gui", "-q", script], capture_output=True, text=True, timeout=300)
        words = done.stdout.split()
        stations = len({row["x_mm"] for row in rows})
        self.assertEqual([int(words[0]), int(words[1])], [stations, len(rows) // stations], done.stderr)
        self.assertAlmostEqual(float(words[2]), max(row["p_MPa"] for row in rows), places=5)
        p_max = json.loads((out / "summary.json").read_text())["contact"]["p_max_Pa"]
        self.assertAlmostEqual(float(words[3]) / p_max, 1, places=9)
        self.assertEqual(words[4:], ["MPa", "1", "1", "railstrata:no_result"])

    def test_each_patch_of_a_wheel_is_a_struct_and_a_film_is_no_patch(self):
        if shutil.which("octave-cli") is None:
            print("skipped: Octave is not installed")
            sys.exit(77)
        out = self.folder / "two"
        out.mkdir()
        (out / "summary.json").write_text("{}")
        (out / "patch.csv").write_text("patch,x_mm,p_MPa\n" + "".join(f"{k},{x},{10 * k + x}\n" for k, x in
                                                                      [(1, 0), (1, 0), (1, 1), (1, 1), (2, 5), (2, 6)]))
        (out / "patch_film.csv").write_text("at_mm,x_mm,p_MPa\n0,1,2\n")
        script = f"addpath('{SOURCES}/matlab'); r = railstrata_read('{out}'); " \
                 "printf('%d ', numel(r.patch), size(r.patch(1).p_MPa), r.patch(2).p_MPa, r.patch_film.p_MPa);"
        done = subprocess.run(["octave-cli", "-q", "--eval", script], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.stdout.split(), ["2", "2", "2", "25", "26", "2"], done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
