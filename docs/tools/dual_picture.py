#!/usr/bin/python3
"""Picture of local dual contributions, dual regions and blocks, side by side.

    pavior block part.off -o blocks.vtu --dual dual.vtu
    xvfb-run -a /usr/bin/python3 dual_picture.py dual.vtu blocks.vtu PICTURE.png [--size 1800x560]

Left: the contributions (red of faces; orange and cyan of edges, hard and soft; yellow and blue of vertices) in the
outline of the solid. Middle: the regions, each shrunk towards its middle. Right: the blocks, shrunk likewise.
Needs Debian's python3-vtk9, python3-numpy, xvfb and xauth.
"""
import argparse

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (registers the renderer)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkSelection, vtkSelectionNode, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkFiltersExtraction import vtkExtractSelection
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkDataSetMapper, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)

ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ap.add_argument("dual")
ap.add_argument("blocks")
ap.add_argument("picture")
ap.add_argument("--size", default="1800x560")
ap.add_argument("--view", default="1,-1.6,1.1", help="direction from the solid to the eye")
ap.add_argument("--shrink", type=float, default=0.86, help="size of regions and blocks, 1 to leave them as they are")
args = ap.parse_args()
width, height = (int(n) for n in args.size.split("x"))
view = [float(n) for n in args.view.split(",")]


def read(file):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutput()


def cells(grid, keep):
    """The cells where keep is true."""
    ids = vtkIdTypeArray()
    for i in np.flatnonzero(keep):
        ids.InsertNextValue(int(i))
    node = vtkSelectionNode()
    node.SetFieldType(vtkSelectionNode.CELL)
    node.SetContentType(vtkSelectionNode.INDICES)
    node.SetSelectionList(ids)
    selection = vtkSelection()
    selection.AddNode(node)
    extract = vtkExtractSelection()
    extract.SetInputData(0, grid)
    extract.SetInputData(1, selection)
    extract.Update()
    return extract.GetOutput()


def shrunk(grid, group):
    """Copies the cells with points of their own, those of one group drawn towards their middle."""
    old = vtk_to_numpy(grid.GetPoints().GetData())
    middles = {}
    for g in np.unique(group):
        ids = [p for c in np.flatnonzero(group == g) for p in corners(grid, c)]
        middles[g] = old[ids].mean(axis=0)
    result = vtkUnstructuredGrid()
    points, known = [], {}
    for c in range(grid.GetNumberOfCells()):
        ids = []
        for p in corners(grid, c):
            key = (group[c], p)
            if key not in known:
                known[key] = len(points)
                points.append(middles[group[c]] + args.shrink * (old[p] - middles[group[c]]))
            ids.append(known[key])
        result.InsertNextCell(grid.GetCellType(c), len(ids), ids)
    data = vtkPoints()
    data.SetData(numpy_to_vtk(np.array(points), deep=True))
    result.SetPoints(data)
    result.GetCellData().ShallowCopy(grid.GetCellData())
    return result


def corners(grid, cell):
    points = grid.GetCell(cell).GetPointIds()
    return [points.GetId(i) for i in range(points.GetNumberOfIds())]


def actor(data, colour=None, edges=True):
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputData(data)
    mapper = vtkDataSetMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    if colour is None:
        mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray("rgb")
        mapper.SetColorModeToDirectScalars()
    else:
        mapper.ScalarVisibilityOff()
    result = vtkActor()
    result.SetMapper(mapper)
    if colour is not None:
        result.GetProperty().SetColor(*colour)
    result.GetProperty().SetEdgeVisibility(edges)
    result.GetProperty().SetEdgeColor(0.15, 0.15, 0.15)
    result.GetProperty().SetAmbient(0.3)
    return result


def outline(data):
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputData(data)
    edges = vtkFeatureEdges()
    edges.SetInputConnection(surface.GetOutputPort())
    edges.SetFeatureAngle(20)
    edges.ColoringOff()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(edges.GetOutputPort())
    result = vtkActor()
    result.SetMapper(mapper)
    result.GetProperty().SetColor(0.1, 0.1, 0.1)
    result.GetProperty().SetLineWidth(1.5)
    return result


dual = read(args.dual)
part = vtk_to_numpy(dual.GetCellData().GetArray("part"))
region = vtk_to_numpy(dual.GetCellData().GetArray("region"))
contributions, pieces = cells(dual, part == 0), cells(dual, part == 1)
mesh = read(args.blocks)
kinds = np.array([mesh.GetCellType(i) for i in range(mesh.GetNumberOfCells())])
blocks = cells(mesh, kinds == 12)
panels = ([actor(contributions), outline(pieces)],
          [actor(shrunk(pieces, region[part == 1]), edges=False)],
          [actor(shrunk(blocks, np.arange(blocks.GetNumberOfCells())), colour=(0.72, 0.80, 0.90))])

window = vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetSize(width, height)
window.SetMultiSamples(8)
for i, actors in enumerate(panels):
    renderer = vtkRenderer()
    renderer.SetViewport(i / 3, 0, (i + 1) / 3, 1)
    renderer.SetBackground(1, 1, 1)
    for each in actors:
        renderer.AddActor(each)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    centre = blocks.GetCenter()
    camera.SetFocalPoint(*centre)
    camera.SetPosition(*(c + 10 * v for c, v in zip(centre, view)))
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera()
    camera.Zoom(1.05)

window.Render()
image = vtkWindowToImageFilter()
image.SetInput(window)
image.ReadFrontBufferOff()
writer = vtkPNGWriter()
writer.SetFileName(args.picture)
writer.SetInputConnection(image.GetOutputPort())
writer.Write()
print(f"{args.picture}: {contributions.GetNumberOfCells()} contributions, {len(np.unique(region[part == 1]))} regions, "
      f"{blocks.GetNumberOfCells()} blocks")
