#!/usr/bin/env python3
"""Draws the rooms of cmake/architecture.cmake: docs/images/rooms.svg.

    python3 cmake/draw_rooms.py [--check]    --check writes nothing and fails where the picture is not up to date

A room stands above all that it may include. An arrow that others imply is left out, and so are those to the ground
floor, on which every room may stand.
"""
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
GROUND = ["core", "math", "mesh"]
WIDTH, HEIGHT, GAP, FLOOR, MARGIN = 124, 34, 22, 84, 16


def read_rooms():
    """The rooms, those that are compiled, and which each may include."""
    text = re.sub(r"#.*", "", (root / "cmake/architecture.cmake").read_text())
    lists = {name: words.split() for name, words in re.findall(r"set\((\w+)\s+([^)]*)\)", text)}
    rooms = lists["rooms"]
    return rooms, lists["compiled_rooms"], {room: [r for r in lists["may_include_" + room] if r in rooms]
                                            for room in rooms}


def floors_of(rooms, uses):
    """The floor of each room: one above the highest room that it may include; the ground floor is 0."""
    floors = dict.fromkeys(GROUND, 0)

    def floor(room):
        if room not in floors:
            floors[room] = 1 + max((floor(r) for r in uses[room]), default=0)
        return floors[room]

    for room in rooms:
        floor(room)
    return floors


def arrows_of(rooms, uses):
    """Pairs (upper, lower) that no chain of other pairs implies."""
    below = {}

    def all_below(room):
        if room not in below:
            below[room] = set().union(*({r} | all_below(r) for r in uses[room]))
        return below[room]

    return [(room, r) for room in rooms for r in uses[room] if r not in GROUND and room not in GROUND
            and not any(r in all_below(other) for other in uses[room] if other != r)]


def chains_of(floors, arrows):
    """Each arrow as what it passes floor by floor, upwards: a room, points (number of the arrow, floor), a room."""
    return [[lower, *((k, f) for f in range(floors[lower] + 1, floors[upper])), upper]
            for k, (upper, lower) in enumerate(arrows)]


def places_of(rooms, floors, chains):
    """The middle of each room and point: every floor centred, in the order that what lies below asks for."""
    top = max(floors.values())
    rows = [[room for room in rooms if floors[room] == f] for f in range(top + 1)]
    below = {}
    for chain in chains:
        for lower, upper in zip(chain, chain[1:]):
            below.setdefault(upper, []).append(lower)
            if not isinstance(upper, str):
                rows[upper[1]].append(upper)
    size = {item: WIDTH if isinstance(item, str) else 0 for row in rows for item in row}
    width = max(sum(size[item] + GAP for item in row) for row in rows) - GAP + 2 * MARGIN
    x = {}
    for row in rows:
        row.sort(key=lambda item: sum(x[i] for i in below[item]) / len(below[item]) if item in below else width / 2)
        free = (width - 2 * MARGIN - sum(size[item] for item in row)) / (len(row) + 1)
        left = MARGIN
        for item in row:
            left += free + size[item]
            x[item] = left - size[item] / 2
    return x, width, top


def draw():
    rooms, compiled, uses = read_rooms()
    floors, arrows = floors_of(rooms, uses), arrows_of(rooms, uses)
    chains = chains_of(floors, arrows)
    x, width, top = places_of(rooms, floors, chains)
    height = top * FLOOR + HEIGHT + 2 * MARGIN + 24
    y = {room: MARGIN + (top - floors[room]) * FLOOR for room in rooms}
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}" '
           f'height="{height:.0f}" font-family="sans-serif" font-size="14">',
           "<!-- drawn by cmake/draw_rooms.py from cmake/architecture.cmake -->",
           '<defs><marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
           '<path d="M0 0 8 4 0 8z" fill="#667"/></marker></defs>',
           f'<rect width="{width:.0f}" height="{height:.0f}" fill="#fff"/>']
    for chain in reversed(chains):
        upper = chain[-1]
        at, path = y[upper] + HEIGHT, f"M{x[upper]:.0f} {y[upper] + HEIGHT:.0f}"
        for item, above in zip(chain[-2::-1], chain[::-1]):
            to = y[item] if isinstance(item, str) else MARGIN + (top - item[1]) * FLOOR
            bend = (to - at) / 2
            path += f"C{x[above]:.0f} {at + bend:.0f} {x[item]:.0f} {to - bend:.0f} {x[item]:.0f} {to:.0f}"
            at = to
            if not isinstance(item, str):
                at += HEIGHT
                path += f"V{at:.0f}"
        out.append(f'<path d="{path}" fill="none" stroke="#667" stroke-width="1.2" marker-end="url(#tip)"/>')
    for room in rooms:
        fill = "#d5e2f3" if room in compiled else "#ececec" if room in GROUND else "#f6e3e6"
        out.append(f'<rect x="{x[room] - WIDTH / 2:.0f}" y="{y[room]:.0f}" width="{WIDTH}" height="{HEIGHT}" rx="4" '
                   f'fill="{fill}" stroke="#445"/>'
                   f'<text x="{x[room]:.0f}" y="{y[room] + 22:.0f}" text-anchor="middle">{room}</text>')
    out.append(f'<text x="{MARGIN}" y="{height - MARGIN + 4:.0f}" font-size="12" fill="#445">'
               "red: headers that need Eigen alone; blue: headers of compiled parts; grey: the ground for all"
               "</text>")
    return "\n".join([*out, "</svg>", ""])


picture = root / "docs/images/rooms.svg"
if sys.argv[1:] == ["--check"]:
    if not picture.exists() or picture.read_text() != draw():
        sys.exit(f"{picture} is not what cmake/architecture.cmake says: run python3 cmake/draw_rooms.py")
elif sys.argv[1:]:
    sys.exit(__doc__)
else:
    picture.write_text(draw())
