#!/usr/bin/python3
"""Assemblies as they come from practice, drawn with OpenCASCADE through Gmsh's Python module (Debian: python3-gmsh).

    bench/assemblies.py NAME OUT.step      --list

Lengths in millimetres. Solids that touch share no faces in the file, as CAD systems write them.
"""
import math
import sys

import gmsh

from families import box, cut, cylinder, fuse

occ = gmsh.model.occ


def ring(z, height, outer, inner):
    return cut(cylinder(0, 0, z, 0, 0, height, outer), cylinder(0, 0, z - 1, 0, 0, height + 2, inner))


def hexagon(x, y, z, height, across):
    """A prism of six sides, `across` from flat to flat."""
    r = across / math.sqrt(3)
    points = [occ.addPoint(x + r * math.cos(k * math.pi / 3), y + r * math.sin(k * math.pi / 3), z) for k in range(6)]
    lines = [occ.addLine(points[k], points[(k + 1) % 6]) for k in range(6)]
    face = occ.addPlaneSurface([occ.addCurveLoop(lines)])
    return [s for s in occ.extrude([(2, face)], 0, 0, height) if s[0] == 3]


def flange_joint():
    """Two flanged pipes, a gasket between them, six bolts with heads and nuts in clearance holes."""
    places = [(22 * math.cos(k * math.pi / 3), 22 * math.sin(k * math.pi / 3)) for k in range(6)]
    holes = [cylinder(x, y, -20, 0, 0, 40, 3.3) for x, y in places]

    def flange(side):
        s = fuse(cylinder(0, 0, 0.75 * side, 0, 0, 6 * side, 30), cylinder(0, 0, 0.75 * side, 0, 0, 18 * side, 14))
        return cut(s, cylinder(0, 0, -30, 0, 0, 60, 10), *(occ.copy(hole) for hole in holes))

    solids = flange(1) + flange(-1) + ring(-0.75, 1.5, 16, 10)
    for hole in holes:
        occ.remove(hole, True)
    for x, y in places:
        solids += fuse(hexagon(x, y, 6.75, 4, 10), cylinder(x, y, -12, 0, 0, 18.75, 3))
        solids += cut(hexagon(x, y, -10.75, 4, 10), cylinder(x, y, -12, 0, 0, 6, 3))
    return solids


def bearing_housing():
    """A plummer block with a bearing (the rolling elements as one ring, as analysts model them) on a stepped shaft."""
    s = fuse(box(-22, -12, -20, 44, 24, 20), cut(cylinder(0, -12, 0, 0, 24, 0, 22), box(-30, -20, -40, 60, 40, 40)))
    s = fuse(s, box(-40, -12, -20, 80, 24, 6))
    s = cut(s, cylinder(0, -20, 0, 0, 40, 0, 15), cylinder(-31, 0, -30, 0, 0, 20, 3.5), cylinder(31, 0, -30, 0, 0, 20, 3.5))

    def along(outer, inner):
        return cut(cylinder(0, -5, 0, 0, 10, 0, outer), cylinder(0, -9, 0, 0, 18, 0, inner))

    shaft = fuse(cylinder(0, -25, 0, 0, 30, 0, 8), cylinder(0, 5, 0, 0, 20, 0, 10))
    return s + along(15, 13) + along(13, 10.5) + along(10.5, 8) + shaft


def heat_sink():
    """A board with four holes, a chip, a pad, a finned heat sink on it, and two capacitors."""
    board = box(0, 0, 0, 60, 50, 1.6)
    for x in (4, 56):
        for y in (4, 46):
            board = cut(board, cylinder(x, y, -1, 0, 0, 4, 1.6))
    sink = box(12, 10, 4.1, 30, 30, 3)
    for k in range(7):
        sink = fuse(sink, box(12 + 4.8 * k, 10, 7.1, 1.2, 30, 12))
    return (board + box(20, 18, 1.6, 14, 14, 2) + box(20, 18, 3.6, 14, 14, 0.5) + sink
            + cylinder(50, 16, 1.6, 0, 0, 11, 4) + cylinder(50, 34, 1.6, 0, 0, 11, 4))


ASSEMBLIES = {f.__name__: f for f in (flange_joint, bearing_housing, heat_sink)}


def draw(name, out):
    gmsh.model.add(name)
    ASSEMBLIES[name]()
    occ.synchronize()
    gmsh.write(out)
    gmsh.model.remove()


if __name__ == "__main__":
    if sys.argv[1:] == ["--list"]:
        print("\n".join(f"{n}: {f.__doc__}" for n, f in ASSEMBLIES.items()))
        sys.exit()
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    draw(*sys.argv[1:])
    gmsh.finalize()
