#!/usr/bin/env python3
"""Tables of solids decomposed by `pavior block`: domains with known counts, tetrahedra with features, CAD parts.

    python3 bench/block_parts.py [--program build/release/pavior] [--check QUALITY.py] [--out DIR]
                                 [--table docs/block_parts.md] [PATHS...]

PATHS are directories and files, by default tests/data/block, examples/data/mc3d and examples/data/mfcad. Each solid is
decomposed with both markings, and refined with the default one. --check names an independent checker that is run on every
refined mesh as `/usr/bin/python3 CHECK MESH` and must exit with 0. Exit code 1 if a mesh was written that the checker
disagrees with, or if a solid with a known count misses it.
"""
import argparse
import json
import pathlib
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parent.parent
data = [root / "tests/data/block", root / "examples/data/mc3d", root / "examples/data/mfcad"]
ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ap.add_argument("paths", nargs="*", default=[str(path) for path in data])
ap.add_argument("--program", default=str(root / "build/release/pavior"))
ap.add_argument("--check", help="independent checker")
ap.add_argument("--out", default=str(root / "build/block_parts"))
ap.add_argument("--table", default=str(root / "docs/block_parts.md"))
ap.add_argument("--timeout", type=float, default=120, help="seconds for one run")
args = ap.parse_args()
out = pathlib.Path(args.out)
out.mkdir(parents=True, exist_ok=True)

# Blocks and block nodes: tables 5.2 to 5.8 of the thesis and hand counts, the same in tests/block.
known = {"c01_brick_tapered": (8, 27), "c02_L_rounded": (22, 57), "c03_triangular_protrusions": (132, 259),
         "c04_half_gear": (336, 633), "c05_plate_two_holes": (96, 201), "c06_closed_loop": (112, 240),
         "c07_pyramid4": (92, 177)}


def files():
    for path in map(pathlib.Path, args.paths):
        inside = sorted(path.iterdir()) if path.is_dir() else [path]
        yield from (f for f in inside if f.suffix.lower() in (".off", ".stl", ".vtk", ".step", ".stp"))


def run(part, name, *options):
    """Exit code and report of one run."""
    target, report = out / f"{part.stem}_{name}.vtu", out / f"{part.stem}_{name}.json"
    for old in (target, report):
        old.unlink(missing_ok=True)
    command = [args.program, "block", str(part), "-o", str(target), "--report", str(report), "--quiet", *options]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=args.timeout)
    except subprocess.TimeoutExpired:
        return None, {}, "time limit"
    error = done.stderr.strip().splitlines()
    return done.returncode, json.loads(report.read_text()) if report.exists() else {}, error[0] if error else ""


def counts(code, report):
    if code is None:
        return "time limit"
    blocks = report.get("blocks") or {}
    return f"{blocks['blocks']} / {blocks['nodes']}" if blocks.get("blocks") else "none"


def published_complex(part):
    """Blocks of the motorcycle complex that a file of tetrahedra carries as cell values."""
    lines = part.read_text().split() if part.suffix == ".vtk" else []
    if "LOOKUP_TABLE" not in lines:
        return ""
    types = [int(n) for n in lines[lines.index("CELL_TYPES") + 2:lines.index("CELL_DATA")]]
    values = lines[lines.index("LOOKUP_TABLE") + 2:]
    return str(len({v for v, kind in zip(values, types) if kind == 10}))


def solid(part):
    """One row of the table, and whether it is as it should be."""
    code, report, error = run(part, "sheets")
    published = run(part, "published", "--marking", "published")
    row = [part.stem, published_complex(part), counts(*published[:2]), counts(code, report), "", "", "", ""]
    expected = known.get(part.stem)
    good = expected is None or row[3] == f"{expected[0]} / {expected[1]}"
    volume = report.get("mesh", {}).get("volume", 0)
    if volume <= 0:
        row[-1] = error
        return row, good and (code == 3 or code is None)
    code, report, error = run(part, "fine", "--size", f"{(volume ** (1 / 3)) / 12:.4g}")
    if code != 0:
        row[-1] = error
        return row, good and code in (1, None)
    jacobian = report["mesh"]["quality"]["scaled_jacobian"]
    row[4:7] = [str(report["mesh"]["hexahedra"]), f"{jacobian['min']:.3f}", f"{jacobian['mean']:.3f}"]
    if args.check:
        target = out / f"{part.stem}_fine.vtu"
        agrees = subprocess.run(["/usr/bin/python3", args.check, str(target)], stdout=subprocess.DEVNULL).returncode == 0
        row[-1] = "agrees" if agrees else "DISAGREES"
        good = good and agrees
    return row, good


rows, good = [], True
for part in files():
    row, fine = solid(part)
    rows.append(row)
    good = good and fine
    print(*row, "" if fine else "NOT AS EXPECTED", sep=" | ", flush=True)

valid = sum(bool(row[4]) for row in rows)
text = f"""# Solids through `pavior block`

Blocks and block nodes with each marking, and the fine mesh inside the blocks of the default one, its size a twelfth of the
cube root of the volume. Made by

    python3 bench/block_parts.py

(with `--check` naming an independent checker on VTK: "agrees" says that it finds the fine mesh conforming, without an
inverted hexahedron, closed, and its volume equal to the flux through its boundary). The second column is the number of
blocks of the motorcycle complex that comes with the tetrahedra, where it does. The last column says why there is no mesh.

{len(rows)} solids: {valid} fine meshes are valid.

| solid | motorcycle complex | published marking | sheets | hexahedra | scaled Jacobian min | mean | checker, or reason |
| --- | --: | --: | --: | --: | --: | --: | --- |
""" + "".join("| " + " | ".join(row) + " |\n" for row in rows)
pathlib.Path(args.table).write_text(text)
sys.exit(not good)
