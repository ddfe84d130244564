#!/usr/bin/env python3
"""The files of `mesh` and `run` open in VTK's own readers, with the fields they should have. usage: vtk_files_test.py
BINARY SOURCE_DIR"""
import json
import pathlib
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

from outside import TINY, main, railstrata, slow

try:
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
except ImportError as missing:
    print(f"SKIPPED: {missing} (Debian package python3-vtk9)")
    sys.exit(77)

SOURCE = pathlib.Path(sys.argv[2]).resolve()
HEXAHEDRON = 12
LAYER = '[[layer]]\nname = "clad"\nthickness = "2 mm"\nyoung_ratio = 2.0\n'


def read(file):
    reader = {".vtu": vtkXMLUnstructuredGridReader, ".vtp": vtkXMLPolyDataReader}[file.suffix]()
    faults = []
    reader.AddObserver("ErrorEvent", lambda *event: faults.append(event))
    reader.SetFileName(str(file))
    reader.Update()
    assert not faults, f"VTK reported errors on {file}"
    return reader.GetOutput()


def names(fields):
    return {fields.GetArrayName(i) for i in range(fields.GetNumberOfArrays())}


def array(fields, name):
    return vtk_to_numpy(fields.GetArray(name))


def hexahedra_volumes(grid):
    quality = vtkMeshQuality()
    quality.SetInputData(grid)
    quality.SetHexQualityMeasureToVolume()
    quality.Update()
    return array(quality.GetOutput().GetCellData(), "Quality")


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.make()

    @classmethod
    def call(cls, *words):
        rc, out, err = railstrata(*words, "--threads", "1")
        assert rc in (0, 1), err  # 1: a check of a result so coarse may fail
        return out


class Mesh(Results):
    """`check cases/quick --mesh`."""

    @classmethod
    def make(cls):
        cls.rows = json.loads(cls.call("check", SOURCE / "cases" / "quick", "--mesh", "--out", cls.folder,
                                       "--json"))["blocks"]

    def test_bodies_are_hexahedra_as_many_as_the_table_says_and_none_is_inverted(self):
        for body in ["rail", "wheel"]:
            grid = read(self.folder / f"{body}.vtu")
            self.assertEqual(grid.GetNumberOfCells(), sum(row["elements"] for row in self.rows if row["body"] == body))
            self.assertEqual({grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}, {HEXAHEDRON})
            self.assertGreater(hexahedra_volumes(grid).min(), 0)
            self.assertGreater(array(grid.GetCellData(), "scaled_jacobian").min(), 0)

    def test_the_layer_of_2_mm_is_a_material_of_its_own_under_the_rail_s_surface(self):
        grid = read(self.folder / "rail.vtu")
        self.assertEqual(set(array(grid.GetCellData(), "material")), {0, 1})
        self.assertEqual(set(array(read(self.folder / "wheel.vtu").GetCellData(), "material")), {0})
        volumes, material = hexahedra_volumes(grid), array(grid.GetCellData(), "material")
        length = np.ptp(vtk_to_numpy(grid.GetPoints().GetData())[:, 0])
        # thickness x width x length; the surface is curved
        self.assertAlmostEqual(volumes[material == 1].sum() / (2e-3 * 60e-3 * length), 1, delta=0.05)


class Run(Results):
    """`run` of a small rolling with a layer: the files a run of cases/quick writes."""

    @classmethod
    def make(cls):
        case = cls.folder / "case.toml"
        case.write_text(TINY + LAYER)
        cls.out = cls.folder / "out"
        cls.call("run", case, "--out", cls.out, "--quiet")
        cls.summary = json.loads((cls.out / "summary.json").read_text())

    def test_the_patch_has_the_summary_s_pressure_at_the_wheel_s_place(self):
        patch = read(self.out / "patch.vtp")
        self.assertEqual(names(patch.GetPointData()), {"pressure_MPa", "traction_MPa", "slip_velocity_mm_s", "state"})
        pressure, x = array(patch.GetPointData(), "pressure_MPa"), vtk_to_numpy(patch.GetPoints().GetData())[:, 0]
        # the peak between points is interpolated
        self.assertAlmostEqual(pressure.max() / (1e-6 * self.summary["contact"]["p_max_Pa"]), 1, delta=0.1)
        self.assertAlmostEqual((pressure * x).sum() / pressure.sum(), self.summary["position_m"], delta=1e-3)
        self.assertGreater(patch.GetNumberOfPolys(), 0)

    def test_volumes_are_hexahedra_with_stress_displacement_and_material(self):
        for body, materials in [("rail", {0, 1}), ("wheel", {0})]:
            grid = read(self.out / f"{body}.vtu")
            self.assertEqual({grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}, {HEXAHEDRON})
            self.assertGreater(hexahedra_volumes(grid).min(), 0)
            self.assertEqual(names(grid.GetPointData()), {"displacement_mm", "von_mises_smooth_MPa"})
            self.assertEqual(names(grid.GetCellData()), {"stress_MPa", "von_mises_MPa", "sigma_1_MPa", "material"})
            self.assertEqual(set(array(grid.GetCellData(), "material")), materials)
            stress, equivalent = array(grid.GetCellData(), "stress_MPa").astype(float), array(grid.GetCellData(),
                                                                                              "von_mises_MPa")
            xx, yy, zz, xy, yz, xz = stress.T
            np.testing.assert_allclose(equivalent, np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2)
                                                           + 3 * (xy**2 + yz**2 + xz**2)), rtol=1e-4, atol=1e-3)
            self.assertLess(zz.min(), -300)  # the patch presses with some 1000 MPa

    def test_the_series_names_frames_that_open_and_follow_the_wheel(self):
        frames = ElementTree.parse(self.out / "patch.pvd").getroot().findall("Collection/DataSet")
        self.assertGreaterEqual(len(frames), 10)
        times = [float(frame.get("timestep")) for frame in frames]
        self.assertEqual(times, sorted(set(times)))
        places = []
        for frame in frames:
            patch = read(self.out / frame.get("file"))
            pressure, x = array(patch.GetPointData(), "pressure_MPa"), vtk_to_numpy(patch.GetPoints().GetData())[:, 0]
            places.append((pressure * x).sum() / pressure.sum())
        np.testing.assert_allclose(np.diff(places) / np.diff(times), 27.78, rtol=0.25)  # 4 mm elements
        self.assertAlmostEqual((places[-1] - places[0]) / (times[-1] - times[0]), 27.78, delta=0.3)


class YieldingRun(Results):
    """`run` of the small rolling over a rail that yields."""

    @classmethod
    def make(cls):
        case = cls.folder / "case.toml"
        case.write_text(TINY + LAYER)
        cls.out = cls.folder / "out"
        cls.call("run", case, "--set", "run.plasticity=true", "--set", 'material.rail.yield_strength="350 MPa"',
                 "--set", 'material.rail.kinematic_hardening=[{modulus = "20 GPa", recall = 0}]', "--out", cls.out,
                 "--quiet", "--no-report")
        cls.summary = json.loads((cls.out / "summary.json").read_text())

    def table(self, name):
        lines = [line for line in (self.out / name).read_text().splitlines() if not line.startswith("#")]
        return np.genfromtxt(lines, delimiter=",", names=True)

    def test_the_rail_has_plastic_strain_and_backstress_where_it_has_yielded_and_the_layer_has_none(self):
        cells = read(self.out / "rail.vtu").GetCellData()
        self.assertEqual(names(cells), {"stress_MPa", "von_mises_MPa", "sigma_1_MPa", "material",
                                        "plastic_strain_accumulated", "plastic_strain", "backstress_MPa"})
        p, material = array(cells, "plastic_strain_accumulated").astype(float), array(cells, "material")
        strain, back = (array(cells, name).astype(float) for name in ("plastic_strain", "backstress_MPa"))
        self.assertGreater(p.max(), 1e-4)
        self.assertEqual(p[material == 1].max(), 0)  # the case gives it no strength
        np.testing.assert_allclose(strain[:, :3].sum(axis=1), 0, atol=1e-6 * p.max())
        size = np.sqrt(2 / 3 * ((strain[:, :3] ** 2).sum(axis=1) + 2 * (strain[:, 3:] ** 2).sum(axis=1)))
        self.assertTrue((size <= p * (1 + 1e-5)).all())
        self.assertGreater((size / np.maximum(p, 1e-12))[p > 0.1 * p.max()].min(), 0.3)
        self.assertEqual(np.abs(back[p == 0]).max(), 0)
        np.testing.assert_allclose(back, 2 / 3 * 20e3 * strain, atol=1e-5 * np.abs(back).max())  # alpha = (2/3) C Ep

    def test_sections_and_depth_line_have_the_same_numbers(self):
        cells = read(self.out / "rail.vtu").GetCellData()
        p = array(cells, "plastic_strain_accumulated").astype(float)
        for name in ["rail_longitudinal_section.csv", "rail_cross_section.csv", "depth_line.csv"]:
            table = self.table(name)
            for value in table["plastic_strain_accumulated"][table["plastic_strain_accumulated"] > 0][:5]:
                self.assertLess(np.abs(p / value - 1).min(), 1e-6)
            tensors = {f"{what}_{c}{unit}" for c in ("xx", "yy", "zz", "xy", "yz", "xz")
                       for what, unit in (("plastic", ""), ("backstress", "_MPa"))}
            self.assertEqual({c for c in table.dtype.names if c.startswith(("plastic", "backstress"))},
                             {"plastic_strain_accumulated"} | tensors)
        self.assertGreater(self.table("rail_longitudinal_section.csv")["plastic_strain_accumulated"].max(), 0)

    def test_the_summary_says_where_and_with_how_much_work(self):
        told = self.summary["plastic"]
        self.assertEqual((told["body"], told["zone"]), ("rail", "rail"))
        self.assertGreater(told["depth_m"], 2e-3)  # below the layer
        self.assertLess(abs(told["y_m"]), 8e-3)
        self.assertGreater(told["accumulated"], 1e-4)
        self.assertGreater(told["work_J"], told["dissipated_J"])
        self.assertGreater(told["dissipated_J"], 0)
        history = self.table("history.csv")
        self.assertAlmostEqual(history["plastic_J"][-1] / told["work_J"], 1, delta=0.1)
        self.assertTrue(next(c for c in self.summary["checks"] if c["name"] == "plastic_strain")["ok"])

    def test_why_a_short_run_has_no_residual_stress_is_said(self):
        why = json.loads((self.out / "residual.json").read_text())["none"]
        self.assertRegex(why, r"^the run is too short: .*; let run.positions end at 7\d.* mm or more$")
        self.assertFalse((self.out / "residual.csv").exists() or (self.out / "section.vtp").exists())


@slow
class Residual(Results):
    """What a single run of 82 mm leaves in a rail that yields, beside the first of rolled passes."""

    @classmethod
    def make(cls):
        case = cls.folder / "case.toml"
        case.write_text(TINY.replace('["30 mm"]', '["82 mm"]'))
        weak = ["--set", 'material.rail.yield_strength="450 MPa"', "--set",
                'material.rail.kinematic_hardening=[{modulus = "20 GPa", recall = 50}]', "--set",
                "drive.traction_coefficient=0", "--quiet", "--no-report"]
        cls.rolled, cls.passed = cls.folder / "run", cls.folder / "passes"
        cls.call("run", case, "--set", "run.plasticity=true", *weak, "--out", cls.rolled)
        cls.call("passes", case, "--engine", "fem", "--roll-length", "50 mm", "--passes", "1", *weak, "--out",
                 cls.passed)

    @staticmethod
    def table(folder):
        lines = (folder / "residual.csv").read_text().splitlines()
        return np.genfromtxt([line for line in lines if not line.startswith("#")], delimiter=",", names=True)

    def test_the_section_has_the_cells_and_numbers_of_the_table(self):
        for folder, own in ((self.rolled, set()), (self.passed, {"accumulated_strain", "net_strain", "class"})):
            section, table = read(folder / "section.vtp"), self.table(folder)
            fields = section.GetCellData()
            self.assertEqual(section.GetNumberOfPolys(), len(table))
            self.assertEqual(names(fields), {"residual_stress_MPa", "plastic_strain", "plastic_strain_accumulated",
                                             "zone"} | own)
            self.assertEqual({"class"} & set(table.dtype.names), own & {"class"})
            np.testing.assert_allclose(array(fields, "residual_stress_MPa")[:, 1], table["sigma_yy_MPa"], rtol=1e-12)
            np.testing.assert_allclose(array(fields, "plastic_strain")[:, 5], table["plastic_xz"], rtol=1e-12)
            places = np.column_stack([table["y_mm"], -table["depth_mm"]])
            for k in range(len(table)):
                corners = np.array([section.GetCell(k).GetPoints().GetPoint(c) for c in range(4)])
                np.testing.assert_allclose(1e3 * corners.mean(axis=0)[1:], places[k], atol=1e-9)

    def test_it_is_what_the_first_pass_leaves(self):
        told = json.loads((self.rolled / "residual.json").read_text())
        table, other = self.table(self.rolled), self.table(self.passed)
        for key, column in (("sigma_x_min_Pa", "sigma_xx_MPa"), ("sigma_y_min_Pa", "sigma_yy_MPa")):
            self.assertAlmostEqual(1e-6 * told[key], table[column].min(), places=6)
            self.assertAlmostEqual(table[column].min() / other[column].min(), 1, delta=0.1)
        self.assertLess(told["sigma_x_min_Pa"], -50e6)
        self.assertLess(told["uneven"], 0.2)
        self.assertLess(told["balance"], 1e-3)

    def test_every_number_of_its_file_stands_in_the_schema(self):
        told = json.loads((self.rolled / "residual.json").read_text())
        schema = json.loads(railstrata("info", "--schema", "--results")[1])["residual"]
        self.assertEqual(list(told), ["none", *(number["key"] for number in schema)])


class HalfSpace(Results):
    """`bem` of the same case."""

    @classmethod
    def make(cls):
        case = cls.folder / "case.toml"
        case.write_text(TINY)
        cls.call("bem", case, "--cell", "0.5 mm", "--out", cls.folder / "out", "--quiet")
        cls.summary = json.loads((cls.folder / "out" / "summary.json").read_text())

    def test_the_patch_stands_where_the_case_wants_the_wheel(self):
        patch = read(self.folder / "out" / "patch.vtp")
        self.assertEqual(names(patch.GetPointData()), {"pressure_MPa", "traction_MPa", "slip_velocity_mm_s", "state"})
        pressure, x = array(patch.GetPointData(), "pressure_MPa"), vtk_to_numpy(patch.GetPoints().GetData())[:, 0]
        self.assertEqual(self.summary["position_m"], 0.03)
        self.assertAlmostEqual((pressure * x).sum() / pressure.sum(), 0.03, delta=1e-5)
        self.assertAlmostEqual(pressure.max() / (1e-6 * self.summary["contact"]["p_max_Pa"]), 1, delta=1e-3)


class Passes(Results):
    """The section of a rail that yields, one cell a point of residual.csv, in its order."""

    @classmethod
    def make(cls):
        cls.call("passes", SOURCE / "cases" / "plastic" / "r260.toml", "--cell", "1 mm", "--passes", "1", "--no-report",
                 "--out", cls.folder / "passes")
        cls.section = read(cls.folder / "passes" / "section.vtp")
        lines = (cls.folder / "passes" / "residual.csv").read_text().splitlines()
        cls.table = np.genfromtxt([line for line in lines if not line.startswith("#")], delimiter=",", names=True)

    def test_stress_strain_and_class_are_those_of_the_table_at_its_places(self):
        fields = self.section.GetCellData()
        self.assertEqual(self.section.GetNumberOfPolys(), len(self.table))
        self.assertEqual(names(fields), {"residual_stress_MPa", "plastic_strain", "plastic_strain_accumulated",
                                         "accumulated_strain", "net_strain", "class", "zone"})
        np.testing.assert_allclose(array(fields, "residual_stress_MPa")[:, 0], self.table["sigma_xx_MPa"], rtol=1e-12)
        np.testing.assert_allclose(array(fields, "plastic_strain")[:, 5], self.table["plastic_xz"], rtol=1e-12)
        np.testing.assert_allclose(array(fields, "plastic_strain_accumulated"),
                                   self.table["plastic_strain_accumulated"], rtol=1e-12)
        np.testing.assert_array_equal(array(fields, "class"), self.table["class"])
        for k in (0, len(self.table) - 1):
            corners = np.array([self.section.GetCell(k).GetPoints().GetPoint(c) for c in range(4)])
            np.testing.assert_allclose(corners.mean(axis=0)[1:],
                                       [1e-3 * self.table["y_mm"][k], -1e-3 * self.table["depth_mm"][k]], atol=1e-9)


del Results  # only its heirs are tests

if __name__ == "__main__":
    main()
