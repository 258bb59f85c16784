#!/usr/bin/python3
"""Picture of a hexahedral mesh: outside with its edges, and cut open, coloured by scaled Jacobian.

    xvfb-run -a /usr/bin/python3 picture.py MESH.vtu PICTURE.png [--size 1400x700] [--groups]

Needs Debian's python3-vtk9, xvfb and xauth. --groups colours by the cell array "group" instead.
"""
import argparse

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (registers the renderer)
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkThreshold
from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkColorTransferFunction, vtkDataSetMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)

ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ap.add_argument("mesh")
ap.add_argument("picture")
ap.add_argument("--size", default="1400x700")
ap.add_argument("--groups", action="store_true")
ap.add_argument("--view", default="1,-1.6,1.1", help="direction from the mesh to the eye")
args = ap.parse_args()
width, height = (int(n) for n in args.size.split("x"))
view = [float(n) for n in args.view.split(",")]

reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(args.mesh)
reader.Update()
quality = vtkMeshQuality()
quality.SetHexQualityMeasureToScaledJacobian()
quality.SetInputConnection(reader.GetOutputPort())
quality.Update()
grid = quality.GetOutput()

colours = vtkColorTransferFunction()
if args.groups:
    low, high = grid.GetCellData().GetArray("group").GetRange()
    palette = [(0.36, 0.56, 0.78), (0.93, 0.69, 0.35), (0.53, 0.72, 0.45), (0.80, 0.45, 0.45), (0.60, 0.50, 0.72)]
    for i in range(int(low), int(high) + 1):
        colours.AddRGBPoint(i, *palette[i % len(palette)])
else:
    for value, rgb in ((0.0, (0.70, 0.15, 0.15)), (0.3, (0.93, 0.60, 0.30)), (0.6, (0.95, 0.90, 0.55)),
                       (0.85, (0.55, 0.78, 0.60)), (1.0, (0.30, 0.52, 0.72))):
        colours.AddRGBPoint(value, *rgb)


def volume_cells():
    keep = vtkThreshold()
    from vtkmodules.vtkCommonCore import vtkIntArray
    kind = vtkIntArray()
    kind.SetName("kind")
    for i in range(grid.GetNumberOfCells()):
        kind.InsertNextValue(grid.GetCellType(i))
    grid.GetCellData().AddArray(kind)
    keep.SetInputData(grid)
    keep.SetInputArrayToProcess(0, 0, 0, 1, "kind")
    keep.SetLowerThreshold(12)
    keep.SetUpperThreshold(12)
    keep.Update()
    return keep.GetOutput()


def actor(data):
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputData(data)
    mapper = vtkDataSetMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.SetLookupTable(colours)
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("group" if args.groups else "Quality")
    mapper.UseLookupTableScalarRangeOn()
    result = vtkActor()
    result.SetMapper(mapper)
    result.GetProperty().EdgeVisibilityOn()
    result.GetProperty().SetEdgeColor(0.15, 0.15, 0.15)
    result.GetProperty().SetLineWidth(1.0)
    result.GetProperty().SetAmbient(0.25)
    return result


volume = volume_cells()
centre = volume.GetCenter()
plane = vtkPlane()
plane.SetOrigin(*centre)
plane.SetNormal(view[0] * 0.3, view[1], 0.0)
cut = vtkExtractGeometry()
cut.SetInputData(volume)
cut.SetImplicitFunction(plane)
cut.ExtractInsideOn()
cut.Update()

window = vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetSize(width, height)
window.SetMultiSamples(8)
for data, left, right in ((volume, 0.0, 0.5), (cut.GetOutput(), 0.5, 1.0)):
    renderer = vtkRenderer()
    renderer.SetViewport(left, 0, right, 1)
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor(data))
    if not args.groups and left > 0:
        bar = vtkScalarBarActor()
        bar.SetLookupTable(colours)
        bar.SetTitle("scaled Jacobian")
        bar.SetNumberOfLabels(5)
        bar.SetMaximumWidthInPixels(70)
        bar.SetMaximumHeightInPixels(height // 3)
        bar.SetPosition(0.88, 0.03)
        for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
            text.SetColor(0.1, 0.1, 0.1)
            text.ShadowOff()
            text.ItalicOff()
        renderer.AddActor2D(bar)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(*centre)
    camera.SetPosition(*(c + 10 * v for c, v in zip(centre, view)))
    camera.SetViewUp(0, 0, 1)
    bounds = volume.GetBounds()
    renderer.ResetCamera(bounds)
    camera.Zoom(1.0 if args.groups else 0.95)

window.Render()
image = vtkWindowToImageFilter()
image.SetInput(window)
image.ReadFrontBufferOff()
writer = vtkPNGWriter()
writer.SetFileName(args.picture)
writer.SetInputConnection(image.GetOutputPort())
writer.Write()
print(f"{args.picture}: {volume.GetNumberOfCells()} hexahedra")
