#!/usr/bin/env python3
"""Time and peak memory of `pavior mesh` on one part, from 10^4 to 10^7 hexahedra.

    python3 bench/mesh_scaling.py [PART] [--program build/release/pavior] [--method M] [--counts 1e4,1e5,1e6,1e7]
                                  [--table docs/mesh_scaling.md]

PART is examples/data/mfcad/0-1-13-19.step by default. The size for a wanted number of hexahedra is that of a cube with
its share of the volume. Peak memory is that of the largest process; the child process that meshes and its parent, which
receives the mesh, may be there at the same time.
"""
import argparse
import json
import os
import pathlib
import sys
import tempfile
import time

root = pathlib.Path(__file__).resolve().parent.parent
ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ap.add_argument("part", nargs="?", default=str(root / "examples/data/mfcad/0-1-13-19.step"))
ap.add_argument("--program", default=str(root / "build/release/pavior"))
ap.add_argument("--method", default="auto")
ap.add_argument("--counts", default="1e4,1e5,1e6,1e7")
ap.add_argument("--table", default=str(root / "docs/mesh_scaling.md"))
args = ap.parse_args()


def mesh(size, target, report):
    """Exit code, seconds and peak memory in bytes."""
    start = time.perf_counter()
    child = os.posix_spawn(args.program, [args.program, "mesh", args.part, "--size", f"{size:.6g}", "-o", str(target),
                                          "--report", str(report), "--method", args.method, "--timeout", "0", "--quiet"],
                           os.environ)
    _, status, usage = os.wait4(child, 0)
    return os.waitstatus_to_exitcode(status), time.perf_counter() - start, usage.ru_maxrss * 1024


rows = []
with tempfile.TemporaryDirectory() as folder:
    target, report = pathlib.Path(folder) / "part.vtu", pathlib.Path(folder) / "part.json"
    code, *_ = mesh(1, target, report)
    if code != 0:
        sys.exit(f"{args.part} cannot be meshed at size 1: exit code {code}")
    volume = json.loads(report.read_text())["mesh"]["volume"]
    for wanted in map(float, args.counts.split(",")):
        code, seconds, memory = mesh((volume / wanted) ** (1 / 3), target, report)
        if code != 0:
            sys.exit(f"exit code {code} at {wanted:g} hexahedra")
        data = json.loads(report.read_text())
        count = data["mesh"]["hexahedra"]
        rows.append([data["decisions"][0]["method"], f"{count:,}", f"{seconds:.2f}", f"{seconds / count * 1e6:.2f}",
                     f"{memory / 2 ** 20:,.0f}", f"{memory / count:,.0f}",
                     f"{data['mesh']['quality']['scaled_jacobian']['min']:.3f}",
                     f"{target.stat().st_size / 2 ** 20:,.0f}"])
        print(*rows[-1], flush=True)

text = f"""# Cost of `pavior mesh`

`{pathlib.Path(args.part).name}` from {rows[0][1]} to {rows[-1][1]} hexahedra: the whole program on two cores, reading, the
decision, checks and writing included. Made by

    python3 bench/mesh_scaling.py

| method | hexahedra | seconds | microseconds each | peak memory (MiB) | bytes each | scaled Jacobian min | file (MiB) |
| --- | --: | --: | --: | --: | --: | --: | --: |
""" + "".join("| " + " | ".join(row) + " |\n" for row in rows)
pathlib.Path(args.table).write_text(text)
