#!/usr/bin/python3
"""Random machined solids, one family a kind of machining, drawn with OpenCASCADE through Gmsh's Python module
(Debian: python3-gmsh; run with /usr/bin/python3).

    bench/families.py FAMILY SEED OUT.step [SEED2 OUT2.step ...]      --list      --all FOLDER FIRST LAST

The same family and seed give the same solid. Lengths in millimetres; the longest side is about 40. Where the kernel makes
no single valid solid of a draw, the draw is repeated with the next number of the generator, so every seed gives one.
"""
import math
import random
import sys

import gmsh

occ = gmsh.model.occ


def box(x, y, z, dx, dy, dz):
    return [(3, occ.addBox(x, y, z, dx, dy, dz))]


def cylinder(x, y, z, dx, dy, dz, r):
    return [(3, occ.addCylinder(x, y, z, dx, dy, dz, r))]


def cut(a, *tools):
    for t in tools:
        a, _ = occ.cut(a, t)
    return a


def fuse(a, *others):
    for t in others:
        a, _ = occ.fuse(a, t)
    return a


def edges_near(solids, test):
    """Edges of the solids whose bounding box passes the test."""
    occ.synchronize()
    found = []
    for _, e in gmsh.model.getBoundary(gmsh.model.getBoundary(solids, combined=False, oriented=False), combined=False, oriented=False):
        if e not in found and test(gmsh.model.getBoundingBox(1, e)):
            found.append(e)
    return found


def cross_drilled(u):
    """Block with two to four holes, through or blind, along two or three axes; some of them meet inside."""
    a, b, c = u(30, 40), u(18, 30), u(14, 24)
    s = box(0, 0, 0, a, b, c)
    for k in range(int(u(2, 4.99))):
        r = u(1.5, 0.16 * c)
        if k % 3 == 0:
            s = cut(s, cylinder(u(0.2, 0.8) * a, u(0.3, 0.7) * b, -1, 0, 0, c + 2 if u(0, 1) < 0.6 else 0.6 * c, r))
        elif k % 3 == 1:
            s = cut(s, cylinder(-1, u(0.3, 0.7) * b, u(0.35, 0.65) * c, a + 2 if u(0, 1) < 0.6 else 0.5 * a, 0, 0, r))
        else:
            s = cut(s, cylinder(u(0.2, 0.8) * a, -1, u(0.35, 0.65) * c, 0, b + 2, 0, r))
    return s


def crossing_slots(u):
    """Block with slots along x and y on top, one underneath, of different depths."""
    a, b, c = u(30, 40), u(24, 36), u(12, 20)
    s = box(0, 0, 0, a, b, c)
    for k in range(int(u(1, 2.99))):
        w = u(3, 6)
        s = cut(s, box(u(0.15, 0.7) * a, -1, c - u(0.2, 0.5) * c, w, b + 2, c))
    for k in range(int(u(1, 2.99))):
        w = u(3, 6)
        s = cut(s, box(-1, u(0.15, 0.7) * b, c - u(0.2, 0.5) * c, a + 2, w, c))
    return cut(s, box(-1, u(0.2, 0.6) * b, -1, a + 2, u(3, 6), 1 + u(0.15, 0.3) * c))


def chamfered(u):
    """Stepped block or plate with holes, chamfers on its outer edges (on top, upright, or both)."""
    a, b, c = u(30, 40), u(20, 30), u(8, 16)
    s = box(0, 0, 0, a, b, c)
    s = fuse(s, box(0.2 * a, 0.2 * b, c, u(0.3, 0.5) * a, u(0.3, 0.5) * b, u(4, 8)))
    for _ in range(int(u(0, 2.99))):
        s = cut(s, cylinder(u(0.8, 0.9) * a, u(0.3, 0.7) * b, -1, 0, 0, c + 2, u(1.2, 2.2)))
    d = u(0.8, 2.0)
    top = edges_near(s, lambda q: abs(q[2] - c) < 0.01 and abs(q[5] - c) < 0.01 and (q[0] < 0.1 or q[3] > a - 0.1 or q[1] < 0.1 or q[4] > b - 0.1))
    upright = edges_near(s, lambda q: q[5] - q[2] > 0.9 * c and (q[0] < 0.1 or q[3] > a - 0.1) and (q[1] < 0.1 or q[4] > b - 0.1) and q[5] < c + 0.1)
    chosen = top if u(0, 1) < 0.5 else upright if u(0, 1) < 0.5 else top + upright
    faces = []
    for e in chosen:
        faces.append(gmsh.model.getAdjacencies(1, e)[0][0])
    return occ.chamfer([s[0][1]], chosen, faces, [d])


def filleted_pocket(u):
    """Block with a pocket whose upright corners are round, and perhaps its floor edge; an island perhaps."""
    a, b, c = u(30, 40), u(24, 34), u(10, 18)
    r = u(2, 4)
    p = box(4, 4, c - u(0.4, 0.7) * c, a - 8, b - 8, 2 * c)
    p = occ.fillet([p[0][1]], edges_near(p, lambda q: q[5] - q[2] > c), [r])
    if u(0, 1) < 0.4:
        low = gmsh.model.occ.getBoundingBox(3, p[0][1])[2]
        p = occ.fillet([p[0][1]], edges_near(p, lambda q: q[5] - low < 0.05), [u(0.8, 0.9 * r)])
    s = cut(box(0, 0, 0, a, b, c), p)
    if u(0, 1) < 0.4:
        s = fuse(s, cylinder(0.5 * a, 0.5 * b, 0.1 * c, 0, 0, u(0.5, 0.85) * c, u(2.5, 4)))
    return s


def angled_counterbore(u):
    """Wedge-topped block with stepped holes at right angles to the leaning face."""
    a, b, c, t = u(30, 40), u(20, 30), u(14, 20), math.radians(u(10, 30))
    s = box(0, 0, 0, a, b, c + a * math.tan(t))
    lid = box(-2 * a, -1, 0, 4 * a, b + 2, 3 * a)
    occ.rotate(lid, 0, 0, 0, 0, 1, 0, -t)
    occ.translate(lid, 0, 0, c)
    s = cut(s, lid)
    for k in range(int(u(1, 2.99))):
        x, y = (0.3 + 0.4 * k) * a, u(0.35, 0.65) * b
        z, n, r = c + x * math.tan(t), (-math.sin(t), 0, math.cos(t)), u(1.5, 2.2)
        long = -3 * c if u(0, 1) < 0.7 else -0.55 * c
        s = cut(s, cylinder(x + 5 * n[0], y, z + 5 * n[2], (long - 5) * n[0], 0, (long - 5) * n[2], r))
        s = cut(s, cylinder(x + 5 * n[0], y, z + 5 * n[2], -8 * n[0], 0, -8 * n[2], 1.8 * r))
    return s


def shaft(u):
    """Stepped shaft: grooves, chamfered or rounded ends, a keyway, a radial hole, a centre bore."""
    s, z, r = None, 0.0, u(4, 6)
    for k in range(int(u(2, 4.99))):
        h = u(8, 14)
        piece = cylinder(0, 0, z, 0, 0, h, r)
        s = piece if s is None else fuse(s, piece)
        last, z, r = (z, h, r), z + h, max(3.0, r + u(-2.0, 2.5))
    z0, h, r0 = last
    if u(0, 1) < 0.5:
        end = edges_near(s, lambda q: q[5] - q[2] < 0.01 and abs(q[5] - z) < 0.01)
        if u(0, 1) < 0.5:
            s = occ.chamfer([s[0][1]], end, [gmsh.model.getAdjacencies(1, e)[0][0] for e in end], [u(0.5, 1)])
        else:
            s = occ.fillet([s[0][1]], end, [u(0.5, 1)])
    if u(0, 1) < 0.7:
        s = cut(s, box(-1.2, 0.5 * r0, z0 + 0.2 * h, 2.4, r0, 0.6 * h))
    if u(0, 1) < 0.6:
        s = cut(s, cylinder(-20, 0, u(2, 6), 40, 0, 0, u(0.8, 1.6)))
    if u(0, 1) < 0.4:
        s = cut(s, cylinder(0, 0, -1, 0, 0, z + 2 if u(0, 1) < 0.5 else 0.4 * z, u(1, 1.8)))
    return s


def bracket(u):
    """L or U bracket, holes in both legs, round or sharp bend, a rib perhaps."""
    a, b, t, h = u(28, 40), u(16, 28), u(3, 5), u(18, 30)
    s = fuse(box(0, 0, 0, a, b, t), box(0, 0, 0, t, b, h))
    if u(0, 1) < 0.4:
        s = fuse(s, box(a - t, 0, 0, t, b, u(0.5, 1) * h))
    if u(0, 1) < 0.5:
        inner = edges_near(s, lambda q: abs(q[0] - t) < 0.01 and abs(q[3] - t) < 0.01 and abs(q[2] - t) < 0.01 and abs(q[5] - t) < 0.01)
        s = occ.fillet([s[0][1]], inner, [u(1, 3)])
    for k in range(int(u(1, 2.99))):
        s = cut(s, cylinder(u(0.45, 0.75) * a, (0.3 + 0.4 * k) * b, -1, 0, 0, t + 2, u(1.5, 2.5)))
    s = cut(s, cylinder(-1, 0.5 * b, u(0.6, 0.75) * h, t + 2, 0, 0, u(1.5, 3)))
    if u(0, 1) < 0.35:
        p = [occ.addPoint(t, 0.5 * b - 1, t), occ.addPoint(t + 0.3 * a, 0.5 * b - 1, t), occ.addPoint(t, 0.5 * b - 1, 0.45 * h)]
        lines = [occ.addLine(p[i], p[(i + 1) % 3]) for i in range(3)]
        f = occ.addPlaneSurface([occ.addCurveLoop(lines)])
        s = fuse(s, [x for x in occ.extrude([(2, f)], 0, 2, 0) if x[0] == 3])
    return s


def flange(u):
    """Flange with a hub (neck fillet or not), bolt holes on a circle, a bore."""
    r, t, q, h, n = u(14, 20), u(3, 6), u(6, 9), u(8, 16), int(u(3, 8.99))
    s = fuse(cylinder(0, 0, 0, 0, 0, t, r), cylinder(0, 0, 0, 0, 0, t + h, q))
    if u(0, 1) < 0.5:
        neck = edges_near(s, lambda e: abs(e[2] - t) < 0.01 and abs(e[5] - t) < 0.01 and e[3] < q + 0.1)
        s = occ.fillet([s[0][1]], neck, [u(0.6, 0.35 * (r - q))])
    s = cut(s, cylinder(0, 0, -1, 0, 0, t + h + 2, u(0.4, 0.7) * q))
    for k in range(n):
        w = 2 * math.pi * k / n
        m = 0.5 * (r + q) + 0.12 * (r - q)
        s = cut(s, cylinder(m * math.cos(w), m * math.sin(w), -1, 0, 0, t + 2, min(1.6, 0.2 * (r - q))))
    return s


def junction(u):
    """Pipe junction: two or three branches, hollow or solid, equal or not."""
    r, l = u(4, 6), u(16, 22)
    hollow, q = u(0, 1) < 0.6, u(0.7, 1.0) * r
    t = math.radians(90 if u(0, 1) < 0.6 else u(50, 75))
    d = (l * math.cos(t), 0, l * math.sin(t))
    s = fuse(cylinder(-l, 0, 0, 2 * l, 0, 0, r), cylinder(0, 0, 0, *d, q))
    if u(0, 1) < 0.3:
        s = fuse(s, cylinder(0, 0, 0, 0, l, 0, u(0.6, 0.9) * r))
    if hollow:
        w = u(0.6, 0.75)
        d2 = tuple(1.1 * x for x in d)
        s = cut(s, cylinder(-l - 1, 0, 0, 2 * l + 2, 0, 0, w * r), cylinder(0, 0, 0, *d2, w * q))
    return s


FAMILIES = {f.__name__: f for f in (cross_drilled, crossing_slots, chamfered, filleted_pocket, angled_counterbore, shaft, bracket, flange, junction)}


def draw(family, seed, out):
    dice = random.Random(f"{family}:{seed}")
    for _ in range(50):
        gmsh.model.add("part")
        try:
            solids = FAMILIES[family](lambda a, b: a + (b - a) * dice.random())
            occ.synchronize()
            if len(gmsh.model.getEntities(3)) == 1 and occ.getMass(3, gmsh.model.getEntities(3)[0][1]) > 1:
                occ.remove([e for d in (2, 1, 0) for e in gmsh.model.getEntities(d) if len(gmsh.model.getAdjacencies(*e)[0]) == 0], True)
                occ.synchronize()
                gmsh.write(out)
                return True
        except Exception:
            pass
        finally:
            gmsh.model.remove()
    return False


if __name__ == "__main__":
    args = sys.argv[1:]
    if args == ["--list"]:
        print("\n".join(f"{n}: {f.__doc__}" for n, f in FAMILIES.items()))
        sys.exit()
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    if args[:1] == ["--all"]:
        jobs = [(n, s, f"{args[1]}/{n}_{s}.step") for n in FAMILIES for s in range(int(args[2]), int(args[3]) + 1)]
    else:
        jobs = [(args[0], int(args[i]), args[i + 1]) for i in range(1, len(args) - 1, 2)]
    failed = [j for j in jobs if not draw(*j)]
    gmsh.finalize()
    print(f"{len(jobs) - len(failed)} of {len(jobs)} solids drawn", *failed)
    sys.exit(bool(failed))
