"""Whether a hexahedral mesh keeps the feature edges of a CAD model and its volume: read by scoreboard.py.

A feature edge is one where two faces meet, all along, at an angle that differs from flat by FLAT degrees or more. It is
kept if the nodes of the mesh within 1e-6 sizes of it, in the order of the curve, are joined by edges of hexahedra one after
another, from end to end. Uses Gmsh's module for the model and VTK for the mesh; nothing of pavior.
"""
import math

import gmsh
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

FLAT = 20.0
TOLERANCE = 1e-6  # of the size
FACES = numpy.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
EDGES = numpy.array([[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]])


def read(file):
    """Nodes, hexahedra and their edges."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    nodes = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    first = vtk_to_numpy(grid.GetCells().GetOffsetsArray())[:-1][vtk_to_numpy(grid.GetCellTypesArray()) == 12]
    hexahedra = vtk_to_numpy(grid.GetCells().GetConnectivityArray())[first[:, None] + numpy.arange(8)]
    return nodes, hexahedra, numpy.unique(numpy.sort(hexahedra[:, EDGES].reshape(-1, 2), axis=1), axis=0)


def normal_at(face, curve, parameter):
    uv = gmsh.model.reparametrizeOnSurface(1, curve, [parameter], face)
    return numpy.array(gmsh.model.getNormal(face, uv))


def is_feature(curve):
    """Whether its faces meet at an angle all along, or are three or more; no seam, where a face meets itself, and no edge
    that fades into a smooth one."""
    faces = set(gmsh.model.getAdjacencies(1, curve)[0])
    if len(faces) < 2:
        return False
    if len(faces) > 2:
        return True
    low, high = gmsh.model.getParametrizationBounds(1, curve)
    for at in (0.01, 0.3, 0.7, 0.99):
        one, two = (normal_at(face, curve, low[0] + at * (high[0] - low[0])) for face in faces)
        if abs(float(one @ two)) > math.cos(math.radians(FLAT)):
            return False
    return True


def chain(curve, nodes, tolerance):
    """Nodes on a curve in its order."""
    box = numpy.array(gmsh.model.getBoundingBox(1, curve)).reshape(2, 3) + tolerance * numpy.array([[-1.0], [1.0]])
    near = numpy.flatnonzero(((nodes >= box[0]) & (nodes <= box[1])).all(axis=1))
    if not len(near):
        return near
    closest = numpy.array(gmsh.model.getClosestPoint(1, curve, nodes[near].ravel())[0]).reshape(-1, 3)
    near = near[numpy.linalg.norm(nodes[near] - closest, axis=1) <= tolerance]
    if not len(near):
        return near
    return near[numpy.argsort(gmsh.model.getParametrization(1, curve, nodes[near].ravel()), kind="stable")]


def lost_features(nodes, edges, size):
    """Tags of the feature edges of the current model of Gmsh that the mesh does not keep, and their number in all."""
    joined = {(a, b) for a, b in edges.tolist()}
    used = numpy.unique(edges)
    lost, count = [], 0
    for _, curve in gmsh.model.getEntities(1):
        if gmsh.model.getType(1, curve) == "Unknown" or not is_feature(curve):
            continue
        count += 1
        on = used[chain(curve, nodes[used], TOLERANCE * size)]
        ends = [tag for _, tag in gmsh.model.getBoundary([(1, curve)], combined=False, oriented=False)]
        closed = not ends or ends[0] == ends[-1]
        pairs = list(zip(on, numpy.roll(on, -1))) if closed else list(zip(on, on[1:]))
        kept = len(on) >= (3 if closed else 2) and all((min(p), max(p)) in joined for p in pairs)
        for end in ends:
            point = numpy.array(gmsh.model.getValue(0, end, []))
            kept = kept and numpy.linalg.norm(nodes[used] - point, axis=1).min() <= TOLERANCE * size
        if not kept:
            lost.append(curve)
    return lost, count


def volume_of(nodes, hexahedra):
    """By the flux through their bilinear sides, which is the mean of those of the two ways to halve them."""
    a, b, c, d = (nodes[hexahedra[:, FACES[:, k]]] - nodes[hexahedra[:, :1]] for k in range(4))

    def triangles(p, q, r):
        return float((numpy.cross(p, q) * r).sum()) / 6

    return (triangles(a, b, c) + triangles(a, c, d) + triangles(a, b, d) + triangles(b, c, d)) / 2


def chord_volume(longest):
    """What chords of this length may lose or add at the faces of the current model: area * curvature * chord^2 / 6."""
    total = 0.0
    for _, face in gmsh.model.getEntities(2):
        low, high = gmsh.model.getParametrizationBounds(2, face)
        uv = [low[k] + (at[k] + 0.5) / 5 * (high[k] - low[k]) for at in numpy.ndindex(5, 5) for k in range(2)]
        total += gmsh.model.occ.getMass(2, face) * numpy.median(gmsh.model.getCurvature(2, face, uv)) * longest**2 / 6
    return total


def judge(file, size):
    """Whether the mesh keeps the features and the volume of the current model of Gmsh: what is wrong, or nothing."""
    nodes, hexahedra, edges = read(file)
    lost, count = lost_features(nodes, edges, size)
    longest = numpy.linalg.norm(nodes[edges[:, 0]] - nodes[edges[:, 1]], axis=1).max()
    true = sum(gmsh.model.occ.getMass(3, solid) for _, solid in gmsh.model.getEntities(3))
    off = volume_of(nodes, hexahedra) - true
    wrong = [f"{len(lost)} of {count} feature edges lost: {', '.join(map(str, lost[:5]))}"] if lost else []
    if abs(off) > chord_volume(longest) + 1e-6 * true:
        wrong.append(f"volume off by {100 * off / true:.2f} %, more than chords explain")
    return wrong
