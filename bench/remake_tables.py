#!/usr/bin/env python3
"""Remakes the tables of docs/ that scripts make, and says which rows changed.

    python3 bench/remake_tables.py [--program build/release/pavior] [--check QUALITY.py] [--only parts,mesh_parts,...]

Tables: parts, mesh_parts, block_parts, benchmarks (what it costs to compile). A row in which only seconds differ stays
as it was; without --check (see the scripts) so does what the checker said. Exit code 1 if a script found something that
is not as it should be, 3 if rows changed.
"""
import argparse
import pathlib
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parent.parent
ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ap.add_argument("--program", default=str(root / "build/release/pavior"))
ap.add_argument("--check", help="independent checker")
ap.add_argument("--only", default="parts,mesh_parts,block_parts,benchmarks")
args = ap.parse_args()
work = root / "build/tables"
work.mkdir(parents=True, exist_ok=True)


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def split(text):
    """What comes before the first table, its lines, and what follows."""
    lines = text.splitlines(keepends=True)
    first = next((i for i, line in enumerate(lines) if line.startswith("| ")), len(lines))
    last = next((i for i in range(first, len(lines)) if not lines[i].startswith("|")), len(lines))
    return lines[:first], lines[first:last], lines[last:]


def as_rows(table, keys):
    """Rows by their first cells: name of the column -> cell."""
    names = cells(table[0])
    return {tuple(cells(line)[:keys]): dict(zip(names, cells(line))) for line in table[2:]}


def merge(old, new, keys):
    """The lines of the new table, old ones where nothing but seconds differs, and what changed."""
    before, after = as_rows(old, keys), as_rows(new, keys)
    names = cells(old[0])
    lines, changes = old[:2], []
    for key, row in after.items():
        known = before.get(key)
        silent = {"seconds"} | {n for n in names if not args.check and n.startswith("checker") and not row.get(n)}
        differ = [n for n in names if n not in silent and (known is None or known[n] != row.get(n, ""))]
        if known is None:
            changes.append(f"{' '.join(key)}: new")
        elif differ:
            changes.append(f"{' '.join(key)}: " + ", ".join(f"{n} {known[n]} -> {row.get(n, '')}" for n in differ))
        shown = known if known and not differ else {n: row.get(n, "") for n in names}
        lines.append("| " + " | ".join(shown[n] for n in names) + " |\n")
    changes += [f"{' '.join(key)}: gone" for key in before if key not in after]
    return lines, changes


def remake(name, keys):
    """Runs a script and puts its table into its page; whether all was well, and the number of rows that changed."""
    script = root / f"bench/{'sweep_parts' if name == 'parts' else name}.py"
    page, made = root / f"docs/{name}.md", work / f"{name}.md"
    command = [sys.executable, str(script), "--program", args.program, "--out", str(work / name)]
    command += ["--check", args.check] if args.check else []
    if name == "parts":
        with made.open("w") as out:
            good = subprocess.run(command, stdout=out).returncode == 0
    else:
        good = subprocess.run([*command, "--table", str(made)], stdout=subprocess.DEVNULL).returncode == 0
    head, old, tail = split(page.read_text())
    new_head, new, _ = split(made.read_text())
    lines, changes = merge(old, new, keys)
    page.write_text("".join((new_head if name != "parts" else head) + lines + tail))
    print(f"docs/{name}.md: {len(lines) - 2} rows, {len(changes)} changed{'' if good else ', NOT AS EXPECTED'}")
    for change in changes:
        print(f"  {change}")
    return good, len(changes)


good, changed = True, 0
for name, keys in (("parts", 3), ("mesh_parts", 2), ("block_parts", 1)):
    if name in args.only.split(","):
        fine, rows = remake(name, keys)
        good, changed = good and fine, changed + rows
if "benchmarks" in args.only.split(","):
    good = subprocess.run([sys.executable, str(root / "bench/compile_bench.py")]).returncode == 0 and good
sys.exit(1 if not good else 3 if changed else 0)
