#!/usr/bin/env python3
"""Table of swept parts: every one-to-one part in examples/data at three sizes.

    python3 bench/sweep_parts.py [--program build/release/pavior] [--check QUALITY.py] [--out DIR] > TABLE.md

Sizes are s/2, s/4 and s/8 for the shortest edge s of the part: at least 2, 4 and 8 elements on it. --check names an
independent checker that is run on every mesh as `/usr/bin/python3 CHECK MESH` and must exit with 0.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import time

SHORTEST = {  # length of the shortest edge
    "0-0-6-8-19": 1.08686, "0-1-19": 1.5998, "0-1-3-4-6-23": 1.0, "0-8-8-13-14-23": 1.78182, "1-3-5-19": 1.0897,
    "2-6-19": 2.0, "4-4-19": 2.2301, "4-8-8-8-13-23": 1.0, "6-6-8-8-12-23": 1.30686, "6-8-8-8-19": 1.24679,
    "s09o_bridge": 2.5, "n11o_limit_cycle": 3.0, "s15o_cylinder": 30.0}
AREA_RATIO = {"0-0-6-8-19": 0.932, "0-8-8-13-14-23": 0.734, "6-8-8-8-19": 0.790, "4-8-8-8-13-23": 0.711}

root = pathlib.Path(__file__).resolve().parent.parent
ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ap.add_argument("--program", default=str(root / "build/release/pavior"))
ap.add_argument("--check", help="independent checker")
ap.add_argument("--out", default=str(root / "build/parts"))
args = ap.parse_args()
out = pathlib.Path(args.out)
out.mkdir(parents=True, exist_ok=True)

print("| part | caps (area ratio) | size | hexahedra | inverted | scaled Jacobian min | mean | volume / CAD - 1 "
      "| seconds |" + (" checker |" if args.check else ""))
print("| --- | --- | --: | --: | --: | --: | --: | --: | --: |" + (" --- |" if args.check else ""))
failed = 0
files = {f.stem: f for f in sorted((root / "examples/data").glob("*/*.st*p"))}
for name, shortest in SHORTEST.items():
    for divisor in (2, 4, 8):
        size = shortest / divisor
        mesh, report = out / f"{name}_{divisor}.vtu", out / f"{name}_{divisor}.json"
        start = time.perf_counter()
        code = subprocess.run([args.program, "sweep", str(files[name]), "--size", str(size), "-o", str(mesh), "--report",
                               str(report), "--quiet"]).returncode
        seconds = time.perf_counter() - start
        if code != 0:
            print(f"| {name} | | {size:.4g} | exit code {code} | | | | | {seconds:.1f} |")
            failed += 1
            continue
        data = json.loads(report.read_text())
        jacobian = data["mesh"]["quality"]["scaled_jacobian"]
        cad = sum(solid["cad_volume"] for solid in data["solids"])
        row = [name, f"not affine ({AREA_RATIO[name]})" if name in AREA_RATIO else "affine", f"{size:.4g}",
               str(data["mesh"]["hexahedra"]), str(data["mesh"]["inverted"]), f"{jacobian['min']:.3f}",
               f"{jacobian['mean']:.3f}", f"{data['mesh']['volume'] / cad - 1:.1e}", f"{seconds:.2f}"]
        if args.check:
            agrees = subprocess.run(["/usr/bin/python3", args.check, str(mesh)], stdout=subprocess.DEVNULL).returncode == 0
            row.append("agrees" if agrees else "DISAGREES")
            failed += not agrees
        print("| " + " | ".join(row) + " |", flush=True)
sys.exit(failed != 0)
