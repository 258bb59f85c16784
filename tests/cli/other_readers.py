"""Meshes a part to every format and reads the files with meshio and with VTK's reader, which is ParaView's.

usage: other_readers.py PROGRAM PART.step SCRATCH
"""

import json
import pathlib
import subprocess
import sys
import warnings

import meshio
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

VTK_KINDS = {12: "hexahedron", 9: "quad"}


def mesh(program, part, output, *options):
    """Runs the program; the groups of its report, {(dimension, number): name in the file}."""
    report = output.with_suffix(".json")
    subprocess.run([program, "mesh", part, "--size", "0.5", "--quiet", "-o", output, "--report", report, *options],
                   check=True)
    groups = json.loads(report.read_text(encoding="utf-8"))["mesh"]["groups"]
    return {(group["dimension"], group["number"]): group["written_as"] for group in groups}


def with_vtk(file):
    """Points, cells {kind: (corners, group)}, groups {(dimension, number): name}."""
    reader = vtkXMLUnstructuredGridReader() if file.suffix == ".vtu" else vtkUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    assert reader.GetErrorCode() == 0, file
    group = vtk_to_numpy(grid.GetCellData().GetArray("group"))
    cells = {kind: ([], []) for kind in VTK_KINDS.values()}
    for i in range(grid.GetNumberOfCells()):
        corners, numbers = cells[VTK_KINDS[grid.GetCellType(i)]]
        ids = grid.GetCell(i).GetPointIds()
        corners.append([ids.GetId(k) for k in range(ids.GetNumberOfIds())])
        numbers.append(group[i])
    fields = grid.GetFieldData()
    groups = {}
    for a in range(fields.GetNumberOfArrays()):
        number, dimension = vtk_to_numpy(fields.GetAbstractArray(a))
        groups[dimension, number] = fields.GetAbstractArray(a).GetName()
    return vtk_to_numpy(grid.GetPoints().GetData()), cells, groups


def with_meshio(file):
    """The same by meshio."""
    read = meshio.read(file)
    key = "gmsh:physical" if file.suffix == ".msh" else "group"
    cells = {kind: ([], []) for kind in VTK_KINDS.values()}
    for block, numbers in zip(read.cells, read.cell_data[key]):
        cells[block.type][0].extend(block.data.tolist())
        cells[block.type][1].extend(np.asarray(numbers).reshape(-1).tolist())
    groups = {}
    for name, value in read.field_data.items():
        number, dimension = np.asarray(value).reshape(-1)
        groups[dimension, number] = name
    return read.points, cells, groups


def check_abaqus(file, groups, cells):
    """meshio reads sets of nodes and elements of Abaqus, not surfaces."""
    read = meshio.read(file)
    assert {block.type for block in read.cells} == set(cells), file
    assert sum(len(block.data) for block in read.cells) == sum(len(corners) for corners, _ in cells.values())
    names = {name.upper() for name in groups.values()}
    assert {name.upper() for name in read.point_sets} == names, (sorted(read.point_sets), names)
    for (dimension, number), name in groups.items():
        corners, numbers = cells["hexahedron" if dimension == 3 else "quad"]
        nodes = {i for corner, own in zip(corners, numbers) if own == number for i in corner}
        sets = {key.upper(): value for key, value in read.point_sets.items()}
        assert set(np.asarray(sets[name.upper()]).tolist()) == nodes, name


def same(one, other, file):
    """Whether two readers found the same; the order of cells may differ, .msh files have them by group."""
    assert np.array_equal(one[0], other[0]), (file, "points")
    for kind in VTK_KINDS.values():
        sort = lambda cells: sorted(zip(map(tuple, cells[0]), map(int, cells[1])))
        assert sort(one[1][kind]) == sort(other[1][kind]), (file, kind)
    ours, theirs = ({tuple(map(int, key)): name for key, name in read[2].items()} for read in (one, other))
    assert ours == theirs, (file, ours, theirs)


def main():
    program, part, scratch = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    warnings.simplefilter("ignore")
    scratch.mkdir(parents=True, exist_ok=True)
    reference = None
    for name, options in {"a.vtu": [], "a.vtk": [], "a.msh": [], "b.msh": ["--format", "msh4-ascii"],
                          "c.msh": ["--format", "msh2"], "d.msh": ["--format", "msh2-ascii"], "a.inp": []}.items():
        file = scratch / name
        groups = mesh(program, part, file, *options)
        assert len(set(groups.values())) == len(groups) == 14, groups
        if reference is None:
            reference = with_vtk(file)
            assert len(reference[1]["hexahedron"][0]) > 0 and len(reference[1]["quad"][0]) > 0
        if file.suffix == ".inp":
            check_abaqus(file, groups, reference[1])
            print(name, "read by meshio, sets of nodes and elements")
            continue
        read = with_meshio(file)
        if file.suffix == ".vtk":  # meshio reads the fields of .vtk files and does not hand them on
            read = (read[0], read[1], groups)
        same((reference[0], reference[1], groups), read, file)
        if file.suffix != ".msh":
            same((reference[0], reference[1], groups), with_vtk(file), file)
        print(name, "read by meshio" + ("" if file.suffix == ".msh" else " and VTK"), "alike")


main()
