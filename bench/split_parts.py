#!/usr/bin/python3
"""Table of the last resort, `pavior mesh --method split`: every CAD file of some directories and files.

    /usr/bin/python3 bench/split_parts.py [--program build/release/pavior] [--check QUALITY.py] [--out DIR]
                                          [--divide 20] [--method split] [--timeout 120] [--table docs/split_parts.md]
                                          PARTS...

The size is the longest side of the box round the model, which Gmsh knows (Debian: python3-gmsh), by --divide. --method
auto shows what `pavior mesh` does with the last resort behind the other methods. --check names an independent checker
that is run on every mesh as `/usr/bin/python3 CHECK MESH` and must exit with 0. Exit code 1 if a part gave no valid mesh,
or if the checker disagrees.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import time

import gmsh

root = pathlib.Path(__file__).resolve().parent.parent
ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ap.add_argument("parts", nargs="+")
ap.add_argument("--program", default=str(root / "build/release/pavior"))
ap.add_argument("--check", help="independent checker")
ap.add_argument("--out", default=str(root / "build/split_parts"))
ap.add_argument("--divide", type=float, default=20)
ap.add_argument("--method", default="split")
ap.add_argument("--timeout", type=float, default=120)
ap.add_argument("--table", default=str(root / "docs/split_parts.md"))
args = ap.parse_args()
out = pathlib.Path(args.out)
out.mkdir(parents=True, exist_ok=True)


def files():
    for part in map(pathlib.Path, args.parts):
        yield from sorted(f for f in part.iterdir() if f.suffix.lower() in (".step", ".stp", ".brep")) \
            if part.is_dir() else [part]


def longest_side(part):
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.model.occ.importShapes(str(part))
    gmsh.model.occ.synchronize()
    box = gmsh.model.getBoundingBox(-1, -1)
    gmsh.finalize()
    return max(box[k + 3] - box[k] for k in range(3))


def mesh(part):
    """One row of the table, whether it is as it should be, and the least scaled Jacobian (None without a mesh)."""
    size = f"{longest_side(part) / args.divide:.4g}"
    target, report = out / f"{part.stem}.vtu", out / f"{part.stem}.json"
    for old in (target, report):
        old.unlink(missing_ok=True)
    start = time.perf_counter()
    code = subprocess.run([args.program, "mesh", str(part), "--size", size, "-o", str(target), "--report", str(report),
                           "--quiet", "--method", args.method, "--timeout", str(args.timeout)],
                          stderr=subprocess.DEVNULL).returncode
    seconds = f"{time.perf_counter() - start:.1f}"
    data = json.loads(report.read_text()) if report.exists() else {}
    if code != 0:
        reasons = [t["reason"].splitlines()[0] for d in data.get("decisions", []) for t in d["tries"] if t["reason"]]
        return [part.stem, size, "none", "", "", "", "", "", seconds, reasons[-1] if reasons else f"exit code {code}"], \
            False, None
    taken = [next(t for t in d["tries"] if t["method"] == d["method"]) for d in data["decisions"]]
    cad = sum(t["details"]["cad_volume"] for t in taken)
    splits = [t["details"] for t in taken if t["method"] == "split"]
    attempts = [d["attempts"][d["taken"]] for d in splits]
    jacobian = data["mesh"]["quality"]["scaled_jacobian"]
    row = [part.stem, size, ", ".join(sorted({t["method"] for t in taken})), str(sum(len(d["attempts"]) for d in splits)),
           str(data["mesh"]["hexahedra"]), f"{min(a['scaled_jacobian_as_split'] for a in attempts):.3f}" if attempts else "",
           f"{jacobian['min']:.3f}", f"{data['mesh']['volume'] / cad - 1:.1e}", seconds,
           "; ".join(d["limit"] for d in splits if d["limit"])]
    off = sum(a["nodes_off"] for a in attempts)
    row[-1] += f" {off} nodes off" if off else ""
    agrees = True
    if args.check:
        agrees = subprocess.run(["/usr/bin/python3", args.check, str(target)], stdout=subprocess.DEVNULL).returncode == 0
        row[-1] = ("agrees " if agrees else "DISAGREES ") + row[-1]
    return row, agrees, jacobian["min"]


rows, good, qualities = [], True, []
for part in files():
    row, fine, quality = mesh(part)
    rows.append(row)
    good = good and fine
    qualities += [] if quality is None else [quality]
    print(*row, sep=" | ", flush=True)

enough = sum(q >= 0.2 for q in qualities)
text = f"""# Parts by the last resort

Tetrahedra split in four, nodes on the CAD faces and edges, improved: `pavior mesh --method {args.method}` at the longest
side of each part by {args.divide:g}. Made by

    /usr/bin/python3 bench/split_parts.py --divide {args.divide:g} PARTS...

Tries: sets of tetrahedra; another follows where the least scaled Jacobian stays below 0.2. As split: before nodes were moved
onto the CAD and improved.

{len(rows)} parts: {len(qualities)} valid meshes, {enough} of them with a least scaled Jacobian of 0.2 or more.

| part | size | method | tries | hexahedra | as split | scaled Jacobian min | volume / CAD - 1 | seconds | checker; least at |
| --- | --: | --- | --: | --: | --: | --: | --: | --: | --- |
""" + "".join("| " + " | ".join(row) + " |\n" for row in rows)
pathlib.Path(args.table).write_text(text)
print(f"{len(rows)} parts: {len(qualities)} valid, {enough} with 0.2")
sys.exit(not good)
