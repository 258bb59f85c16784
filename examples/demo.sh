#!/usr/bin/env bash
# The main job on real parts: STEP in, valid hexahedra out. Called by ./dev demo; meshes and pictures go to build/demo.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=build/release/pavior
out=build/demo
mkdir -p "$out"
failed=0

# sweep NAME INPUT [options]: one line of result; the mesh must be valid.
sweep() {
    local name=$1 input=$2
    shift 2
    "$program" sweep "$input" -o "$out/$name.vtu" --report "$out/$name.json" "$@" || {
        echo "$name: FAILED with exit code $?"
        failed=1
    }
}

echo "== One-to-one parts, --size 1"
while read -r part; do
    sweep "$part" "examples/data/mfcad/$part.step" --size 1
done < examples/data/mfcad/one-to-one.txt
sweep bridge examples/data/hexme/s09o_bridge.step --size 0.5
sweep limit_cycle examples/data/hexme/n11o_limit_cycle.stp --size 1
sweep cylinder examples/data/hexme/s15o_cylinder.stp --size 2

echo "== An assembly: plate, bolt and washer, conforming, groups kept"
sweep assembly examples/data/assembly/bolt_plate_washer.step --size 2

echo "== A part that no one-to-one sweep can mesh (exit code 3 expected)"
code=0
"$program" sweep examples/data/mfcad/0-1-13-19.step -o "$out/refused.vtu" --size 1 || code=$?
[ "$code" -eq 3 ] || failed=1

echo "== Quality of the bridge"
"$program" quality "$out/bridge.vtu"

echo "== Pictures"
for name in bridge assembly; do
    xvfb-run -a /usr/bin/python3 docs/tools/picture.py "$out/$name.vtu" "$out/$name.png"
done
exit "$failed"
