"""Reads the files written by tests/record/vtk_test.cpp with VTK's own readers and checks points, cells and fields."""
import sys
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

try:
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
    from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
except ImportError as missing:
    print(f"SKIPPED: {missing} (Debian package python3-vtk9)")
    sys.exit(77)

SAMPLES = Path(sys.argv.pop(1))


def read(reader, file):
    errors = []
    reader.AddObserver("ErrorEvent", lambda *event: errors.append(event))
    reader.SetFileName(str(file))
    reader.Update()
    assert not errors, f"VTK reported errors on {file}"
    return reader.GetOutput()


class Brick(unittest.TestCase):
    def setUp(self):
        self.grid = read(vtkXMLUnstructuredGridReader(), SAMPLES / "brick.vtu")
        self.points = vtk_to_numpy(self.grid.GetPoints().GetData())

    def test_points_are_exact_doubles(self):
        self.assertEqual(self.points.dtype, np.float64)
        self.assertEqual(self.points.shape, (21**3, 3))
        i = np.arange(21)
        z, y, x = np.meshgrid(3.0 * i / 20, 2.0 * i / 20, 1.0 * i / 20, indexing="ij")
        np.testing.assert_array_equal(self.points, np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1))

    def test_cells_are_hexahedra_with_the_brick_s_volume(self):
        self.assertEqual(self.grid.GetNumberOfCells(), 20**3)
        self.assertEqual({self.grid.GetCellType(i) for i in range(self.grid.GetNumberOfCells())}, {12})
        quality = vtkMeshQuality()
        quality.SetInputData(self.grid)
        quality.SetHexQualityMeasureToVolume()
        quality.Update()
        volumes = vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality"))
        np.testing.assert_allclose(volumes, 6.0 / 20**3, rtol=1e-12)

    def test_stress_is_a_named_symmetric_tensor(self):
        stress = self.grid.GetPointData().GetArray("stress_MPa")
        self.assertEqual([stress.GetComponentName(c) for c in range(6)], ["XX", "YY", "ZZ", "XY", "YZ", "XZ"])
        expected = 100.0 * np.arange(1, 7) + (self.points @ [1.0, 2.0, 3.0])[:, None]
        np.testing.assert_array_equal(vtk_to_numpy(stress), expected.astype(np.float32))

    def test_displacement_keeps_double_precision(self):
        displacement = vtk_to_numpy(self.grid.GetPointData().GetArray("displacement_m"))
        np.testing.assert_array_equal(displacement, self.points / 3 + [1e-9, 0, 0])

    def test_cell_fields_are_whole_numbers(self):
        material = vtk_to_numpy(self.grid.GetCellData().GetArray("material"))
        self.assertEqual(material.dtype, np.int32)
        np.testing.assert_array_equal(material, np.arange(20**3) % 7)


class Empty(unittest.TestCase):
    def test_a_mesh_without_points_opens(self):
        grid = read(vtkXMLUnstructuredGridReader(), SAMPLES / "empty.vtu")
        self.assertEqual((grid.GetNumberOfPoints(), grid.GetNumberOfCells()), (0, 0))


class Series(unittest.TestCase):
    def test_frames_named_by_the_collection_open_with_their_fields(self):
        frames = ElementTree.parse(SAMPLES / "patch.pvd").getroot().findall("Collection/DataSet")
        np.testing.assert_allclose([float(f.get("timestep")) for f in frames], [0.0, 0.1, 0.2])
        for number, frame in enumerate(frames):
            surface = read(vtkXMLPolyDataReader(), SAMPLES / frame.get("file"))
            self.assertEqual((surface.GetNumberOfPoints(), surface.GetNumberOfPolys()), (6, 2))
            self.assertEqual([surface.GetCell(1).GetPointId(c) for c in range(4)], [1, 4, 5, 2])
            self.assertEqual(surface.GetPoint(5), (2.0, 1.0, 0.5))
            pressure = vtk_to_numpy(surface.GetPointData().GetArray("pressure_MPa"))
            np.testing.assert_array_equal(pressure, (1.0 + number) * np.arange(6))


if __name__ == "__main__":
    unittest.main()
