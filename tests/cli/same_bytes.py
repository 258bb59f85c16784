"""Meshes files with every program given, on one thread and on two: the same bytes, the same exit codes.

usage: same_bytes.py [--timeout SECONDS] SCRATCH PROGRAM... -- FILE_OR_DIRECTORY...

The first program and one thread are what the others are compared with. A file that it does not finish within the time
limit (default 60 s) is left out, since where a limit strikes differs from run to run.
"""

import argparse
import hashlib
import pathlib
import subprocess
import sys
import time

SWEEPABLE = {".step", ".stp", ".igs", ".iges", ".brep"}
BLOCKS = SWEEPABLE | {".vtk", ".off", ".stl"}
TIMED_OUT = 124


def files_of(places):
    for place in map(pathlib.Path, places):
        yield from (sorted(file for file in place.rglob("*") if file.suffix in BLOCKS) if place.is_dir() else [place])


def meshed(program, command, file, threads, scratch, limit):
    """Exit code and the hash of the mesh, if there is one."""
    output = scratch / "mesh.vtu"
    output.unlink(missing_ok=True)
    arguments = [program, command, file, "-o", output, "--threads", str(threads), "--timeout", "0", "--quiet"]
    try:
        code = subprocess.run(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=limit,
                              check=False).returncode
    except subprocess.TimeoutExpired:
        return TIMED_OUT, ""
    return code, hashlib.sha256(output.read_bytes()).hexdigest() if output.exists() else ""


def main():
    split = sys.argv.index("--")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--timeout", type=float, default=60)
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("programs", nargs="+")
    given = parser.parse_args(sys.argv[1:split])
    given.scratch.mkdir(parents=True, exist_ok=True)
    runs = [(program, threads) for program in given.programs for threads in (1, 2)]
    compared = meshes = left_out = 0
    different = []
    for file in files_of(sys.argv[split + 1:]):
        for command in ("mesh", "block") if file.suffix in SWEEPABLE else ("block",):
            start = time.monotonic()
            first = meshed(*runs[0][:1], command, file, runs[0][1], given.scratch, given.timeout)
            if first[0] == TIMED_OUT:
                left_out += 1
                continue
            patience = 30 * (time.monotonic() - start) + 30  # without optimisation, on a busy machine
            compared += 1
            meshes += bool(first[1])
            for program, threads in runs[1:]:
                other = meshed(program, command, file, threads, given.scratch, patience)
                if other != first:
                    different.append(f"{command} {file}: {program} on {threads} threads: exit {other[0]}, "
                                     f"not {first[0]}" if other[0] != first[0] else
                                     f"{command} {file}: {program} on {threads} threads: other bytes")
    print(f"{compared} commands, {meshes} meshes, {len(runs)} runs of each, {left_out} left out for time, "
          f"{len(different)} differ")
    print("\n".join(different))
    sys.exit(1 if different or meshes == 0 else 0)


main()
