#!/usr/bin/env python3
"""Wheel, rail, layer and stress of the result folder in which this file lies, written there by RailStrata.

    paraview --script=view.py          in ParaView, to go on from there (in the folder where it was written)
    pvpython view.py --png view.png    a picture by ParaView
    python3 view.py [--png view.png]   a window, or a picture, by VTK alone (Debian: python3-vtk9); without a display
                                       xvfb-run -a python3 view.py --png view.png

Both bodies are cut lengthwise through the largest pressure; the half on the field side is shown, seen from the track.
Colours are von Mises stresses of the elements (--field sigma_1_MPa: largest principal stresses); the black lines are
the border of the layer. A half-space result has no elements: its patch is shown on the rail.
Axes: x rolling direction, y to the field side, z up; metres. The arrows in the lower left corner of VTK's picture are
10 mm long."""
import argparse
import json
import math
import os
import pathlib
import subprocess
import sys

WRITTEN_TO = ""  # filled in by RailStrata; ParaView's window does not pass a script its own path
FOLDER = pathlib.Path(__file__).resolve().parent if "__file__" in globals() else pathlib.Path(WRITTEN_TO)
STEEL = (0.72, 0.75, 0.78)
DARK = (0.2, 0.2, 0.2)
SIZE = (1400, 1000)
HALF_HEIGHT = 0.026  # m, of what is seen


def read_arguments():
    parser = argparse.ArgumentParser(description="Shows a RailStrata result")
    parser.add_argument("--png", help="write a picture instead of opening a window")
    parser.add_argument("--field", default="von_mises_MPa", choices=["von_mises_MPa", "sigma_1_MPa"])
    return parser.parse_known_args()[0]


def read_place():
    """The wheel's position, the contact point's height and the name of the result."""
    summary = json.loads((FOLDER / "summary.json").read_text())
    geometry = json.loads((FOLDER / "geometry.json").read_text())
    contact = geometry["contact"]
    text = f"{summary['title']}\np_max {summary['contact']['p_max_Pa'] / 1e6:.0f} MPa"
    return (summary["position_m"] or 0.0, contact["y_m"], contact["z_m"]), text


def bodies():
    return [FOLDER / f"{body}.vtu" for body in ("rail", "wheel") if (FOLDER / f"{body}.vtu").exists()]


def colours(field, top, low):
    """(value, r, g, b) of a scale: Viridis for von Mises, blue and red about zero for the principal stress."""
    if field == "von_mises_MPa":
        scale = [(0, 0.267, 0.005, 0.329), (0.25, 0.230, 0.322, 0.546), (0.5, 0.128, 0.567, 0.551),
                 (0.75, 0.369, 0.789, 0.383), (1, 0.993, 0.906, 0.144)]
        return [(t * top, r, g, b) for t, r, g, b in scale]
    size = max(top, 0.1 * abs(low))
    scale = [(-1, 0.13, 0.40, 0.67), (-0.5, 0.40, 0.66, 0.81), (0, 0.97, 0.97, 0.97), (0.5, 0.94, 0.54, 0.38),
             (1, 0.70, 0.09, 0.17)]
    return [(t * size, r, g, b) for t, r, g, b in scale]


def shown(wanted, ranges, p_max):
    """Field, whether it is one of cells, name on the bar and colours: the wanted stress where bodies have it over these
    ranges, else the pressure of the bare patch."""
    if not ranges:
        return "pressure_MPa", False, "pressure [MPa]", colours("von_mises_MPa", p_max, 0)
    name = "von Mises [MPa]" if wanted == "von_mises_MPa" else "sigma_1 [MPa]"
    return wanted, True, name, colours(wanted, max(r[1] for r in ranges), min(r[0] for r in ranges))


def camera(place):
    """Position and view-up: from the track side, a little from the front and from above."""
    x, y, z = place
    return (x + 0.12, y - 0.5, z + 0.13), (x, y, z - 0.001), (0, 0, 1)


def arrows(place):
    """Where the axes stand, in the lower left corner and nearer to the eye than the bodies; (turn about z or y in
    degrees, name) of each, 10 mm long."""
    eye, focus, _ = camera(place)
    back = [a - b for a, b in zip(eye, focus)]
    size = math.hypot(*back)
    back = [v / size for v in back]
    level = math.hypot(back[0], back[1])
    right = [-back[1] / level, back[0] / level, 0]
    up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2],
          back[0] * right[1] - back[1] * right[0]]
    at = [f - 0.030 * r - 0.021 * u + 0.08 * b for f, r, u, b in zip(focus, right, up, back)]
    return at, [((0, 0, 0), (1, 0, 0), "x rolling"), ((0, 0, 90), (0, 1, 0), "y field side"),
                ((0, -90, 0), (0, 0, 1), "z up, 10 mm")]


# ---- VTK -------------------------------------------------------------------------------------------------------------


def window_class(for_picture):
    """The name of VTK's window that works here. VTK ends the whole program where it finds no display, so another one
    tries."""
    if not for_picture:
        if os.environ.get("DISPLAY"):
            return "vtkRenderWindow"
        sys.exit("view.py: a window needs a display; a picture without one: xvfb-run -a python3 view.py --png view.png")
    for name in ("vtkRenderWindow", "vtkEGLRenderWindow", "vtkOSOpenGLRenderWindow"):
        attempt = (f"import sys, vtk; w = vtk.{name}(); w.SetOffScreenRendering(1); w.Render(); "
                   "sys.exit(not w.SupportsOpenGL())")
        tried = subprocess.run([sys.executable, "-c", attempt], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        if tried.returncode == 0:
            return name
    sys.exit("view.py: VTK needs a display, e.g. xvfb-run -a python3 view.py --png view.png")


def show_with_vtk(arguments):
    try:
        import vtk
    except ImportError:
        sys.exit(f"view.py: {sys.executable} has neither ParaView nor VTK; Debian: apt install python3-vtk9, then "
                 "/usr/bin/python3 view.py")
    window_name = window_class(bool(arguments.png))
    place, text = read_place()
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    keep = []  # Python's hold on the pipeline

    def read(reader, file):
        reader.SetFileName(str(file))
        reader.Update()
        keep.append(reader)
        return reader

    def polygons(source):
        surface = vtk.vtkDataSetSurfaceFilter()
        surface.SetInputConnection(source.GetOutputPort())
        keep.append(surface)
        return surface

    def add(source, colour=None, opacity=1.0, width=None, field=None, table=None, edges=False):
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputConnection(source.GetOutputPort())
        if field:
            (mapper.SetScalarModeToUseCellFieldData() if of_cells else mapper.SetScalarModeToUsePointFieldData())
            mapper.SelectColorArray(field)
            mapper.SetLookupTable(table)
            mapper.UseLookupTableScalarRangeOn()
        else:
            mapper.ScalarVisibilityOff()
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        look = actor.GetProperty()
        if field:
            look.LightingOff()  # colours as on the bar
        if colour:
            look.SetColor(colour)
        look.SetOpacity(opacity)
        if width:
            look.SetLineWidth(width)
            look.LightingOff()
        if edges:
            look.EdgeVisibilityOn()
            look.SetEdgeColor(0.25, 0.25, 0.25)
            look.SetLineWidth(0.3)
        renderer.AddActor(actor)
        return actor

    patch = read(vtk.vtkXMLPolyDataReader(), FOLDER / "patch.vtp")
    pressure = patch.GetOutput().GetPointData().GetArray("pressure_MPa")
    peak = max(range(pressure.GetNumberOfTuples()), key=pressure.GetValue)
    cut = vtk.vtkPlane()
    cut.SetOrigin(place[0], patch.GetOutput().GetPoint(peak)[1] - 1e-5, place[2])
    cut.SetNormal(0, 1, 0)

    grids = []
    for file in bodies():
        half = vtk.vtkExtractGeometry()  # whole elements on the field side
        half.SetInputConnection(read(vtk.vtkXMLUnstructuredGridReader(), file).GetOutputPort())
        half.SetImplicitFunction(cut)
        half.ExtractInsideOff()
        half.ExtractBoundaryCellsOff()
        half.Update()
        grids.append(half)
    ranges = [g.GetOutput().GetCellData().GetArray(arguments.field).GetRange() for g in grids]
    field, of_cells, name, scale = shown(arguments.field, ranges, pressure.GetRange()[1])
    table = vtk.vtkColorTransferFunction()
    for point in scale:
        table.AddRGBPoint(*point)
    for half in grids:
        add(polygons(half), field=field, table=table, edges=True)
        layer = vtk.vtkThreshold()
        layer.SetInputConnection(half.GetOutputPort())
        layer.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS, "material")
        layer.SetThresholdFunction(vtk.vtkThreshold.THRESHOLD_UPPER)
        layer.SetUpperThreshold(1)
        layer.Update()
        keep.append(layer)
        if layer.GetOutput().GetNumberOfCells():
            edges = vtk.vtkFeatureEdges()
            edges.SetInputConnection(polygons(layer).GetOutputPort())
            edges.BoundaryEdgesOn()
            edges.FeatureEdgesOn()
            edges.SetFeatureAngle(50)
            edges.ManifoldEdgesOff()
            edges.ColoringOff()
            keep.append(edges)
            add(edges, colour=(0, 0, 0), width=3)
    if not grids:
        patch.GetOutput().GetPointData().SetActiveScalars("pressure_MPa")
        contact = vtk.vtkClipPolyData()
        contact.SetInputConnection(patch.GetOutputPort())
        contact.SetValue(1e-6)
        keep.append(contact)
        add(contact, field=field, table=table)
    behind = vtk.vtkPlane()  # around a bare patch the bodies begin behind it, so that it is seen whole
    behind.SetOrigin(place[0], cut.GetOrigin()[1] if grids else patch.GetOutput().GetBounds()[3], place[2])
    behind.SetNormal(0, 1, 0)
    for body in ("rail", "wheel"):
        file = FOLDER / f"{body}_surface.vtp"
        if not file.exists():
            continue
        half = vtk.vtkClipPolyData()
        half.SetInputConnection(read(vtk.vtkXMLPolyDataReader(), file).GetOutputPort())
        half.SetClipFunction(behind)
        keep.append(half)
        add(half, colour=STEEL, opacity=0.45)

    corner, axes = arrows(place)
    for turn, way, words in axes:
        arrow = vtk.vtkArrowSource()
        arrow.SetTipLength(0.25)
        arrow.SetTipRadius(0.06)
        arrow.SetShaftRadius(0.018)
        actor = add(arrow, colour=DARK)
        actor.SetPosition(corner)
        actor.SetOrientation(*turn)
        actor.SetScale(0.01)
        actor.GetProperty().LightingOff()
        label = vtk.vtkBillboardTextActor3D()
        label.SetInput(words)
        label.SetPosition([c + 0.0107 * w for c, w in zip(corner, way)])
        label.GetTextProperty().SetColor(DARK)
        label.GetTextProperty().SetFontSize(17)
        renderer.AddActor(label)

    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(name)
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.0f")
    bar.UnconstrainedFontSizeOn()
    bar.SetPosition(0.90, 0.2)
    bar.SetWidth(0.07)
    bar.SetHeight(0.6)
    for style in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        style.SetColor(0, 0, 0)
        style.SetFontSize(18)
        style.ItalicOff()
        style.ShadowOff()
    renderer.AddActor2D(bar)
    title = vtk.vtkTextActor()
    title.SetInput(text)
    title.GetTextProperty().SetColor(0, 0, 0)
    title.GetTextProperty().SetFontSize(20)
    title.SetPosition(20, SIZE[1] - 70)
    renderer.AddActor2D(title)

    view = renderer.GetActiveCamera()
    position, focus, up = camera(place)
    view.SetPosition(position)
    view.SetFocalPoint(focus)
    view.SetViewUp(up)
    view.ParallelProjectionOn()
    view.SetParallelScale(HALF_HEIGHT)
    renderer.ResetCameraClippingRange()

    window = getattr(vtk, window_name)()
    window.SetSize(*SIZE)
    window.SetMultiSamples(4)
    window.AddRenderer(renderer)
    if arguments.png:
        window.SetOffScreenRendering(1)
        window.Render()
        picture = vtk.vtkWindowToImageFilter()
        picture.SetInput(window)
        picture.ReadFrontBufferOff()
        writer = vtk.vtkPNGWriter()
        writer.SetFileName(arguments.png)
        writer.SetInputConnection(picture.GetOutputPort())
        writer.Write()
        return
    hand = vtk.vtkRenderWindowInteractor()
    hand.SetInteractorStyle(vtk.vtkInteractorStyleTrackballCamera())
    hand.SetRenderWindow(window)
    window.Render()
    hand.Start()


# ---- ParaView --------------------------------------------------------------------------------------------------------


def show_with_paraview(arguments):
    from paraview import simple

    place, text = read_place()
    view = simple.GetActiveViewOrCreate("RenderView")
    view.ViewSize = list(SIZE)
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 1
    text += "\nx rolling direction, y field side, z up"

    def show(source, colour, opacity=1.0):
        display = simple.Show(source, view)
        display.ColorArrayName = [None, ""]
        display.AmbientColor = display.DiffuseColor = list(colour)
        display.Opacity = opacity
        return display

    patch = simple.XMLPolyDataReader(registrationName="patch", FileName=[str(FOLDER / "patch.vtp")])
    patch.UpdatePipeline()
    from paraview import servermanager

    points = servermanager.Fetch(patch)
    pressure = points.GetPointData().GetArray("pressure_MPa")
    peak = max(range(pressure.GetNumberOfTuples()), key=pressure.GetValue)
    cut = points.GetPoint(peak)[1] - 1e-5

    def field_side(source, name, y, whole_elements):
        half = simple.Clip(registrationName=name, Input=source, ClipType="Plane", Invert=0)
        half.ClipType.Origin, half.ClipType.Normal = [place[0], y, place[2]], [0, 1, 0]
        half.Crinkleclip = int(whole_elements)
        half.UpdatePipeline()
        return half

    halves, ranges = [], []
    for file in bodies():
        body = simple.XMLUnstructuredGridReader(registrationName=file.stem, FileName=[str(file)])
        half = field_side(body, f"{file.stem}, field side", cut, True)
        halves.append(half)
        ranges.append(half.CellData[arguments.field].GetRange())
    field, of_cells, name, scale = shown(arguments.field, ranges, pressure.GetRange()[1])
    table = simple.GetColorTransferFunction(field)
    if not halves:
        patch = simple.Clip(registrationName="contact", Input=patch, ClipType="Scalar",
                            Scalars=["POINTS", "pressure_MPa"], Value=1e-6, Invert=0)
    for source in halves or [patch]:
        display = simple.Show(source, view)
        display.Ambient, display.Diffuse = 1, 0  # colours as on the bar
        if halves:
            display.SetRepresentationType("Surface With Edges")
            display.EdgeColor = [0.25, 0.25, 0.25]
        simple.ColorBy(display, ("CELLS" if of_cells else "POINTS", field))
        display.SetScalarBarVisibility(view, source is (halves or [patch])[-1])
    table.ColorSpace, table.AutomaticRescaleRangeMode = "RGB", "Never"
    table.RGBPoints = [number for point in scale for number in point]
    for half in halves:
        if half.CellData["material"].GetRange()[1] < 1:
            continue
        layer = simple.Threshold(registrationName="layer", Input=half, Scalars=["CELLS", "material"],
                                 ThresholdMethod="Above Upper Threshold", UpperThreshold=1)
        surface = simple.ExtractSurface(Input=layer)
        edges = simple.FeatureEdges(registrationName="border of the layer", Input=surface, FeatureAngle=50,
                                    NonManifoldEdges=0, Coloring=0)
        simple.Hide(layer, view)
        simple.Hide(surface, view)
        show(edges, (0, 0, 0)).LineWidth = 3
    for body in ("rail", "wheel"):
        file = FOLDER / f"{body}_surface.vtp"
        if file.exists():
            whole = simple.XMLPolyDataReader(registrationName=f"{file.stem}, whole", FileName=[str(file)])
            # around a bare patch the bodies begin behind it, so that it is seen whole
            half = field_side(whole, file.stem, cut if halves else points.GetBounds()[3], False)
            show(half, STEEL, 0.45)
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = name, ""
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.0f", "%.0f"
    title = simple.Show(simple.Text(registrationName="title", Text=text), view)
    title.Color, title.FontSize, title.WindowLocation = [0, 0, 0], 16, "Upper Left Corner"
    simple.Render(view)  # the first one moves the camera
    position, focus, up = camera(place)
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = position, focus, up
    view.CameraParallelProjection, view.CameraParallelScale = 1, HALF_HEIGHT
    simple.Render(view)
    if arguments.png:
        simple.SaveScreenshot(arguments.png, view, ImageResolution=list(SIZE))
    elif "__file__" in globals():  # pvpython; ParaView's own window stays open by itself
        simple.Interact(view)


def main():
    arguments = read_arguments()
    try:
        import paraview.simple  # noqa: F401
    except ImportError:
        show_with_vtk(arguments)
    else:
        show_with_paraview(arguments)


main()
