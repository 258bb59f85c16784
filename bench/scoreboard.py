#!/usr/bin/python3
"""Shares of solids that `pavior mesh` meshes, by set and family: docs/scoreboard.md.

    /usr/bin/python3 bench/scoreboard.py [--program build/release/pavior] [--check QUALITY.py] [--out DIR]
                                         [--seeds 1-5] [--only SET,...] [--timeout 120] [--arguments "--no-split"]
                                         [--table docs/scoreboard.md] [NAME=SIZE=PATH...]

Sets: the machined parts of examples/data/mfcad at size 1; examples/data/mambo, solids and hexme, the assemblies of
bench/assemblies.py, and the nine families of bench/families.py, drawn for --seeds, at the longest side / 20; and those
given. SIZE is a length, or "/20" for a part of the longest side. --check names an independent checker that is run on every mesh as `/usr/bin/python3 CHECK MESH` and must exit
with 0. Every mesh is checked against the CAD model: feature edges are chains of its edges, its volume is off by no more than
chords explain (features_kept.py). Exit code 1 if a check fails, or a part gave neither a valid mesh nor a refusal with its
reason.

Needs Gmsh's Python module (Debian: python3-gmsh) to draw and to measure, and VTK's (python3-vtk9).
"""
import argparse
import json
import pathlib
import shlex
import statistics
import subprocess
import sys
import time

import gmsh

import assemblies
import families
import features_kept

root = pathlib.Path(__file__).resolve().parent.parent
CAD = (".step", ".stp", ".brep", ".igs", ".iges")
SUFFICIENT = 0.2


def arguments():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("given", nargs="*", metavar="NAME=SIZE=PATH")
    ap.add_argument("--program", default=str(root / "build/release/pavior"))
    ap.add_argument("--check", help="independent checker")
    ap.add_argument("--out", type=pathlib.Path, default=root / "build/scoreboard")
    ap.add_argument("--seeds", default="1-5")
    ap.add_argument("--only", help="sets, by name")
    ap.add_argument("--timeout", type=float, default=120)
    ap.add_argument("--arguments", default="", help="more for `pavior mesh`")
    ap.add_argument("--table", default=str(root / "docs/scoreboard.md"))
    return ap.parse_args()


def draw(folder, seeds):
    """The families of solids, those that are not there yet."""
    first, last = map(int, seeds.split("-"))
    folder.mkdir(parents=True, exist_ok=True)
    wanted = [(family, seed, folder / f"{family}_{seed}.step")
              for family in families.FAMILIES for seed in range(first, last + 1)]
    for family, seed, file in wanted:
        if not file.exists() and not families.draw(family, seed, str(file)):
            raise SystemExit(f"{family} {seed} gives no solid")
    return [file for _, _, file in wanted]


def draw_assemblies(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name in assemblies.ASSEMBLIES:
        assemblies.draw(name, str(folder / f"{name}.step"))
    return parts_in(folder)


def longest_side():
    box = gmsh.model.getBoundingBox(-1, -1)
    return max(box[k + 3] - box[k] for k in range(3))


def parts_in(place):
    place = pathlib.Path(place)
    return sorted(f for f in place.iterdir() if f.suffix.lower() in CAD) if place.is_dir() else [place]


def sets(args):
    """(name, size, parts), and what to call a part's family."""
    data = root / "examples/data"
    known = {"mfcad": ("1", data / "mfcad"), "mambo": ("/20", data / "mambo"), "solids": ("/20", data / "solids"),
             "hexme": ("/20", data / "hexme")}
    only = args.only.split(",") if args.only else [*known, "assemblies", "families"]
    for name, (size, place) in known.items():
        if name in only:
            yield name, size, parts_in(place)
    if "assemblies" in only:
        yield "assemblies", "/20", draw_assemblies(args.out / "assemblies")
    if "families" in only:
        yield "families", "/20", draw(args.out / "families", args.seeds)
    for text in args.given:
        name, size, place = text.split("=", 2)
        yield name, size, parts_in(place)


def reason(report, code):
    """Of the first method that says one, its first line."""
    reasons = [f"{t['method']}: {t['reason'].splitlines()[0]}" for d in report.get("decisions", [])
               if d["method"] is None for t in d["tries"] if t["reason"]]
    return reasons[-1] if reasons else f"exit code {code}"


def mesh(args, name, size, part):
    """What became of one part, which is the current model of Gmsh."""
    length = longest_side() / float(size[1:]) if size.startswith("/") else float(size)
    target, report = args.out / f"{name}_{part.stem}.vtu", args.out / f"{name}_{part.stem}.json"
    for old in (target, report):
        old.unlink(missing_ok=True)
    start = time.perf_counter()
    code = subprocess.run([args.program, "mesh", str(part), "--size", f"{length:.4g}", "-o", str(target), "--report",
                           str(report), "--quiet", "--timeout", str(args.timeout), *shlex.split(args.arguments)],
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
    row = {"set": name, "part": part.stem, "size": length, "seconds": time.perf_counter() - start, "valid": code == 0,
           "agrees": True, "wrong": [], "told": code in (0, 3), "methods": [], "jacobian": -1.0, "hexahedra": 0, "note": ""}
    data = json.loads(report.read_text()) if report.exists() else {}
    if code != 0:
        row["note"] = reason(data, code)
        return row
    row["methods"] = sorted({d["method"] for d in data["decisions"]})
    row["jacobian"] = data["mesh"]["quality"]["scaled_jacobian"]["min"]
    row["hexahedra"] = data["mesh"]["hexahedra"]
    off = data["deviation"]
    row["note"] = f"{100 * off['relative_volume']:.2f} %" if off.get("relative_volume") is not None else ""
    row["wrong"] = features_kept.judge(target, length)
    if args.check:
        row["agrees"] = subprocess.run(["/usr/bin/python3", args.check, str(target)],
                                       stdout=subprocess.DEVNULL).returncode == 0
    target.unlink()
    return row


def share(rows, test):
    count = sum(map(test, rows))
    return f"{count} ({100 * count / len(rows):.0f} %)"


def summary(name, rows):
    """One line of a table of shares."""
    seconds = [row["seconds"] for row in rows]
    unsplit = [row["valid"] and "split" not in row["methods"] for row in rows]
    good = [one and row["jacobian"] >= SUFFICIENT for one, row in zip(unsplit, rows)]
    return [name, str(len(rows)), share(rows, lambda r: r["valid"]), share(rows, lambda r: r["jacobian"] >= SUFFICIENT),
            f"{sum(unsplit)} ({100 * sum(unsplit) / len(rows):.0f} %)", f"{sum(good)} ({100 * sum(good) / len(rows):.0f} %)",
            f"{statistics.median(seconds):.1f}", f"{max(seconds):.0f}"]


def table(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "| --- |" + " --: |" * (len(head) - 1),
                      *("| " + " | ".join(row) + " |" for row in rows)]) + "\n"


def page(rows, args):
    head = ["", "parts", "valid", "0.2 and more", "without split: valid", "0.2 and more", "median s", "longest s"]
    names = list(dict.fromkeys(row["set"] for row in rows))
    by_set = [summary(name, [r for r in rows if r["set"] == name]) for name in names]
    drawn = [r for r in rows if r["set"] == "families"]
    kinds = list(dict.fromkeys(r["part"].rsplit("_", 1)[0] for r in drawn))
    by_kind = [summary(kind, [r for r in drawn if r["part"].rsplit("_", 1)[0] == kind]) for kind in kinds]
    lost = "; ".join(f"{r['part']}: {', '.join(r['wrong'])}" for r in rows if r["wrong"])
    kept = ("Each mesh keeps the feature edges of its part" if not lost else "The meshes keep the feature edges of their parts"
            ) + f""" as chains of mesh edges within {features_kept.TOLERANCE:g} sizes (edges where
faces meet at {features_kept.FLAT:g} degrees or more), and its volume within what chords explain{"" if not lost else ", but for " + lost}.

"""
    each = [[r["part"], r["set"], f"{r['size']:.3g}", ", ".join(r["methods"]) or "none",
             str(r["hexahedra"]) if r["valid"] else "", f"{r['jacobian']:.3f}" if r["valid"] else "",
             f"{r['seconds']:.1f}", r["note"]] for r in rows]
    checked = ("An independent checker on VTK agrees that each mesh is conforming, closed and without inverted hexahedra"
               + ("" if all(r["agrees"] for r in rows) else ", but for "
                  + ", ".join(r["part"] for r in rows if not r["agrees"])) + ".\n\n") if args.check else ""
    return f"""# Scoreboard

Shares of solids that `pavior mesh` gives a valid mesh, and one with a least scaled Jacobian of 0.2 or more. "Without split"
are those that need no last resort (tetrahedra split in four). Sets: random machined parts of MFCAD at size 1; parts of MAMBO,
drawings of hard features, CAD models of HexMe, three assemblies from practice (a bolted flange joint, a bearing in its
housing, a heat sink on a board) and nine families of random machined solids at their longest side / 20. Made by

    /usr/bin/python3 bench/scoreboard.py --seeds {args.seeds}

Seconds are for the whole program on two cores.

{checked}{kept}{table(head, by_set)}
{'By family:' + chr(10) + chr(10) + table(head, by_kind) if by_kind else ''}
## What is published of others

| system | set | share | source |
| --- | --- | --: | --- |
| frame fields and integer-grid maps, state of the art of 2022 | the 189 tagged tetrahedral meshes of HexMe | 10 % (19) with all features right | Beaufort et al., Hex Me If You Can, Computer Graphics Forum 41(5), 2022 |

Maps of theirs are not meshes yet: extraction can fail after them.

## Each part

{table(["part", "set", "size", "method", "hexahedra", "scaled Jacobian min", "seconds", "volume off, or reason"], each)}"""


def main():
    args = arguments()
    args.out.mkdir(parents=True, exist_ok=True)
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    rows = []
    for name, size, parts in sets(args):
        for part in parts:
            gmsh.model.add("part")
            gmsh.model.occ.importShapes(str(part))
            gmsh.model.occ.synchronize()
            row = mesh(args, name, size, part)
            gmsh.model.remove()
            rows.append(row)
            print(name, part.stem, ", ".join(row["methods"]) or "none", f"{row['jacobian']:.3f}", f"{row['seconds']:.1f} s",
                  row["note"], *row["wrong"], "" if row["agrees"] else "DISAGREES", flush=True)
    gmsh.finalize()
    pathlib.Path(args.table).write_text(page(rows, args))
    sys.exit(not all(row["agrees"] and row["told"] and not row["wrong"] for row in rows))


main()
