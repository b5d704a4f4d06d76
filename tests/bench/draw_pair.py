#!/usr/bin/python3
"""Draws two tet meshes side by side, coloured by their field: the picture of the README. Above the surfaces, below
a cut through the tets at half the height.

    xvfb-run -a /usr/bin/python3 draw_pair.py ORIGINAL.vtu SIMPLIFIED.vtu PICTURE.png

needs python3-vtk9, and xvfb with libgl1-mesa-dri where there is no screen.
"""
import os
import sys

import vtk

SIZE = (1500, 900)
SMOOTHING = 8  # samples a pixel
BACKGROUND = (0.97, 0.97, 0.96)
INK = (0.13, 0.13, 0.15)
# From yellow to dark violet: the lightness alone tells the values apart, without red against green.
ANCHORS = ((0.99, 0.91, 0.14), (0.37, 0.79, 0.38), (0.13, 0.57, 0.55), (0.23, 0.32, 0.55), (0.27, 0.00, 0.33))
STRIP = 0.08  # height of the colour bar's part
LOG_FROM = 10  # a field above zero whose greatest is so many times its least gets a logarithmic scale


def read(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    data = grid.GetPointData()
    if grid.GetNumberOfCells() == 0 or data.GetNumberOfArrays() == 0:
        sys.exit(f"draw_pair: {path}: no mesh with a field in it")
    if data.GetScalars() is None:
        data.SetActiveScalars(data.GetArrayName(0))
    return grid


def colours(low, high):
    between = vtk.vtkColorTransferFunction()
    between.SetColorSpaceToLab()
    for i, colour in enumerate(ANCHORS):
        between.AddRGBPoint(low + (high - low) * i / (len(ANCHORS) - 1), *colour)
    table = vtk.vtkLookupTable()
    if low > 0 and high > LOG_FROM * low:
        table.SetScaleToLog10()
    table.SetNumberOfTableValues(256)
    table.SetRange(low, high)
    for i in range(256):
        table.SetTableValue(i, *between.GetColor(low + (high - low) * i / 255), 1)
    return table


def cut_of(grid):
    low, high = grid.GetBounds()[4:]
    plane = vtk.vtkPlane()
    plane.SetOrigin(0, 0, 0.5 * (low + high))
    plane.SetNormal(0, 0, 1)
    cut = vtk.vtkCutter()
    cut.SetInputData(grid)
    cut.SetCutFunction(plane)
    cut.GenerateTrianglesOff()
    return cut


def surface_of(grid):
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(grid)
    return surface


def painted(surface, table):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    mapper.InterpolateScalarsBeforeMappingOn()
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(2, 8)  # behind the edges
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetInterpolationToFlat()
    actor.GetProperty().SetAmbient(0.55)
    actor.GetProperty().SetDiffuse(0.45)
    return actor


def edges_of(surface):
    edges = vtk.vtkExtractEdges()
    edges.SetInputConnection(surface.GetOutputPort())
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(edges.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*INK)
    actor.GetProperty().SetOpacity(0.35)
    actor.GetProperty().SetLineWidth(1)
    actor.GetProperty().LightingOff()
    return actor


def text(words, size, x, y):
    actor = vtk.vtkTextActor()
    actor.SetInput(words)
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(x, y)
    style = actor.GetTextProperty()
    style.SetFontSize(size)
    style.SetColor(*INK)
    style.SetJustificationToCentered()
    return actor


def panel(surface, table, caption, where):
    renderer = vtk.vtkRenderer()
    renderer.SetViewport(*where)
    renderer.SetBackground(*BACKGROUND)
    renderer.AddActor(painted(surface, table))
    renderer.AddActor(edges_of(surface))
    renderer.AddActor2D(text(caption, 24, 0.5, 0.92))
    return renderer


def bar(table, title):
    actor = vtk.vtkScalarBarActor()
    actor.SetLookupTable(table)
    actor.SetOrientationToHorizontal()
    actor.SetNumberOfLabels(5)
    actor.SetLabelFormat("%.1f")
    actor.SetTitle("")
    actor.UnconstrainedFontSizeOn()
    actor.GetLabelTextProperty().SetColor(*INK)
    actor.GetLabelTextProperty().SetFontSize(22)
    actor.GetLabelTextProperty().ShadowOff()
    actor.GetLabelTextProperty().ItalicOff()
    actor.GetLabelTextProperty().BoldOff()
    actor.SetPosition(0.35, 0.15)
    actor.SetWidth(0.4)
    actor.SetHeight(0.8)
    strip = vtk.vtkRenderer()
    strip.SetViewport(0, 0, 1, STRIP)
    strip.SetBackground(*BACKGROUND)
    strip.AddActor2D(actor)
    words = title + (", logarithmic" if table.GetScale() == vtk.VTK_SCALE_LOG10 else "")
    strip.AddActor2D(text(words, 22, 0.24, 0.5))
    return strip


def same_camera(renderers, position, zoom):
    camera = renderers[0].GetActiveCamera()
    camera.SetViewUp(0, 0.1, 1)
    camera.SetPosition(*position)
    camera.SetFocalPoint(0, 0, 0)
    camera.SetViewAngle(22)
    renderers[0].ResetCamera()
    camera.Zoom(zoom)
    for renderer in renderers[1:]:
        renderer.SetActiveCamera(camera)


def save(window, path):
    window.Render()
    shot = vtk.vtkWindowToImageFilter()
    shot.SetInput(window)
    shot.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetCompressionLevel(9)
    writer.SetInputConnection(shot.GetOutputPort())
    writer.Write()


def main(original_path, simplified_path, picture_path):
    original, simplified = read(original_path), read(simplified_path)
    field = original.GetPointData().GetScalars()
    table = colours(*field.GetRange())
    n, m = original.GetNumberOfCells(), simplified.GetNumberOfCells()
    middle = 0.5 * (1 + STRIP)
    caption = f"tetlod: {m:,} tets, {100 * m / n:.1f} %"
    whole = [panel(surface_of(original), table, f"original: {n:,} tets", (0, middle, 0.5, 1)),
             panel(surface_of(simplified), table, caption, (0.5, middle, 1, 1))]
    inside = [panel(cut_of(original), table, "cut at half the height", (0, STRIP, 0.5, middle)),
              panel(cut_of(simplified), table, "cut at half the height", (0.5, STRIP, 1, middle))]
    same_camera(whole, (-0.75, -1.6, 0.95), 1.5)
    same_camera(inside, (0, -0.02, 1), 1.6)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(SMOOTHING)
    window.SetSize(*SIZE)
    for renderer in [*whole, *inside, bar(table, field.GetName())]:
        window.AddRenderer(renderer)
    save(window, picture_path)
    if not os.path.exists(picture_path):
        sys.exit(f"draw_pair: cannot write {picture_path}")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
