#!/usr/bin/env python3
"""What pavior costs to compile: user seconds and peak memory, as ratios to Eigen/Dense in the same run.

    python3 bench/compile_bench.py [--compiler g++] [--eigen /usr/include/eigen3] [--repeat 3] [--only WORD] [--print]

Best of the repetitions; Eigen/Dense is measured before each. Replaces its table in docs/benchmarks.md, unless --print.
Run it on an idle machine: seconds vary with what else runs, ratios less, memory by a megabyte.
"""
import argparse
import pathlib
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(root / "cmake"))
from compile_cost import cost  # noqa: E402

# what, the goal for the ratio of seconds against the compiled library
SUBJECTS = [("affine/fit.hpp", "1.0"), ("sweep/sweep.hpp", "2"), ("many_to_many/multi_sweep.hpp", "2.5"),
            ("smooth/improve_hexes.hpp", "2"), ("block/block_solid.hpp", "4"), ("part/mixed_solids.hpp", ""),
            ("part/mesh_part.hpp", "4"), ("examples/quick_start.cpp", "4")]

ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ap.add_argument("--compiler", default="g++")
ap.add_argument("--eigen", default="/usr/include/eigen3")
ap.add_argument("--repeat", type=int, default=3)
ap.add_argument("--only", default="", help="subjects that contain this word")
ap.add_argument("--print", action="store_true", help="leave docs/benchmarks.md as it is")
args = ap.parse_args()

compile_ = [args.compiler, "-std=c++20", "-I", str(root / "include"), "-isystem", args.eigen]


def best(runs):
    return min(seconds for seconds, _ in runs), max(memory for _, memory in runs)


with tempfile.TemporaryDirectory() as folder:

    def measure(subject, flags):
        """Seconds, MB, and the ratio of the seconds to Eigen/Dense."""
        unit = pathlib.Path(folder) / "unit.cpp"
        if subject.endswith(".cpp"):
            command = [*compile_, *flags, "-O0", "-c", str(root / subject), "-o", str(unit.with_suffix(".o"))]
        else:
            unit.write_text(f"#include <{subject if subject.startswith('Eigen') else 'pavior/' + subject}>\n")
            command = [*compile_, *flags, "-fsyntax-only", str(unit)]
        return [cost(command) for _ in range(args.repeat)]

    base_runs, results = [], []
    for subject, goal in SUBJECTS:
        path = root / subject if subject.endswith(".cpp") else root / "include/pavior" / subject
        if args.only in subject and path.exists():
            runs = []
            for flags in (["-DPAVIOR_COMPILED"], []):
                base = measure("Eigen/Dense", [])
                base_runs += base
                seconds, memory = best(measure(subject, flags))
                runs.append((seconds, memory, seconds / best(base)[0]))
            results.append((subject, goal, runs))
            print(subject, *(f"{s:.1f} s, {m:.0f} MB, {r:.1f} x Eigen/Dense;" for s, m, r in runs), flush=True)
    base = best(base_runs)

name = f"`{args.compiler} -std=c++20 -fsyntax-only`"
table = [f"{name} (the program: `-O0 -c`), user seconds, best of {args.repeat}, and peak memory; `Eigen/Dense`: "
         f"{base[0]:.1f} s, {base[1]:.0f} MB.", "",
         "| what | compiled library: s | MB | x Eigen/Dense | goal | headers alone: s | MB | x Eigen/Dense |",
         "| --- | --: | --: | --: | --: | --: | --: | --: |"]
for subject, goal, ((s, m, r), (hs, hm, hr)) in results:
    table.append(f"| `{subject}` | {s:.1f} | {m:.0f} | {r:.1f} | {goal and '<= ' + goal} "
                 f"| {hs:.1f} | {hm:.0f} | {hr:.1f} |")
if args.print:
    print("\n".join(table))
else:
    page = root / "docs/benchmarks.md"
    begin, end = "<!-- compile_bench.py -->\n", "<!-- /compile_bench.py -->"
    head, _, rest = page.read_text().partition(begin)
    _, mark, tail = rest.partition(end)
    if not mark:
        sys.exit(f"{page} lacks the lines {begin.strip()} and {end}")
    page.write_text(head + begin + "\n".join(table) + "\n" + end + tail)
