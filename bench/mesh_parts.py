#!/usr/bin/env python3
"""Table of parts meshed by `pavior mesh`: every CAD file of some directories and files at sizes 1 and 0.5.

    python3 bench/mesh_parts.py [--program build/release/pavior] [--check QUALITY.py] [--out DIR] [--sizes 1,0.5]
                                [--table docs/mesh_parts.md] [PARTS...]

PARTS are directories and files, by default examples/data/mfcad and one of hexme. --check names an independent checker
that is run on every mesh as `/usr/bin/python3 CHECK MESH` and must exit with 0. Exit code 1 if a part gave neither a
valid mesh nor a reasoned refusal (exit code 3), or if the checker disagrees.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import time

root = pathlib.Path(__file__).resolve().parent.parent
ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ap.add_argument("parts", nargs="*", default=[str(root / "examples/data/mfcad"),
                                             str(root / "examples/data/hexme/s11o_cube_cyl.stp")])
ap.add_argument("--program", default=str(root / "build/release/pavior"))
ap.add_argument("--check", help="independent checker")
ap.add_argument("--out", default=str(root / "build/mesh_parts"))
ap.add_argument("--sizes", default="1,0.5")
ap.add_argument("--table", default=str(root / "docs/mesh_parts.md"))
args = ap.parse_args()
out = pathlib.Path(args.out)
out.mkdir(parents=True, exist_ok=True)


def files():
    for part in map(pathlib.Path, args.parts):
        yield from sorted(f for f in part.iterdir() if f.suffix.lower() in (".step", ".stp", ".brep")) \
            if part.is_dir() else [part]


def refusals(report):
    """The reason of each method, its first line."""
    tries = [t for d in report["decisions"] if d["method"] is None for t in d["tries"]]
    return "; ".join(f"{t['method']}: {t['reason'].splitlines()[0]}" for t in tries if t["reason"])


def mesh(part, size):
    """One row of the table, whether it is as it should be, and the least scaled Jacobian (None without a mesh)."""
    target, report = out / f"{part.stem}_{size}.vtu", out / f"{part.stem}_{size}.json"
    for old in (target, report):
        old.unlink(missing_ok=True)
    start = time.perf_counter()
    code = subprocess.run([args.program, "mesh", str(part), "--size", size, "-o", str(target), "--report", str(report),
                           "--quiet"], stderr=subprocess.DEVNULL).returncode
    seconds = f"{time.perf_counter() - start:.2f}"
    data = json.loads(report.read_text()) if report.exists() else {}
    if code != 0:
        text = refusals(data) if code == 3 else f"exit code {code}"
        return [part.stem, size, "none", "", "", "", "", seconds, text], code == 3, None
    methods = sorted({d["method"] for d in data["decisions"]})
    cad = sum(d["tries"][[t["method"] for t in d["tries"]].index(d["method"])]["details"]["cad_volume"]
              for d in data["decisions"])
    jacobian = data["mesh"]["quality"]["scaled_jacobian"]
    row = [part.stem, size, ", ".join(methods), str(data["mesh"]["hexahedra"]), f"{jacobian['min']:.3f}",
           f"{jacobian['mean']:.3f}", f"{data['mesh']['volume'] / cad - 1:.1e}", seconds, ""]
    agrees = True
    if args.check:
        agrees = subprocess.run(["/usr/bin/python3", args.check, str(target)], stdout=subprocess.DEVNULL).returncode == 0
        row[-1] = "agrees" if agrees else "DISAGREES"
    return row, agrees, jacobian["min"]


rows, good, qualities, refused = [], True, [], 0
for part in files():
    for size in args.sizes.split(","):
        row, fine, quality = mesh(part, size)
        rows.append(row)
        good = good and fine
        refused += quality is None
        qualities += [] if quality is None else [quality]
        print(*row, flush=True)

enough = sum(q >= 0.2 for q in qualities)
text = f"""# Parts through `pavior mesh`

Every part at the sizes given, by the method that `pavior mesh` chose. Made by

    python3 bench/mesh_parts.py

(with `--check` naming an independent checker on VTK: "agrees" says that it finds the mesh conforming, without an inverted
hexahedron, closed, and its volume equal to the flux through its boundary). Seconds are for the whole program on two
cores, reading and writing included. The volume of planar parts is that of the CAD model; for curved ones the difference
is the chord error. Where there is no mesh the last column says why.

{len(rows)} runs: {len(qualities)} valid meshes, {enough} of them with a least scaled Jacobian of 0.2 or more; {refused} refused.

| part | size | method | hexahedra | scaled Jacobian min | mean | volume / CAD - 1 | seconds | checker, or reason |
| --- | --: | --- | --: | --: | --: | --: | --: | --- |
""" + "".join("| " + " | ".join(row) + " |\n" for row in rows)
pathlib.Path(args.table).write_text(text)
sys.exit(not good)
