#!/usr/bin/env bash
# Runs every program of libFuzzer in a folder for some seconds, two at a time, on the corpus beside this script and what
# was found before: run.sh FOLDER SECONDS [NAME...]. Fails if one of them finds anything; findings stay in FOLDER/findings.
set -euo pipefail
corpus=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/corpus
folder=$(cd "$1" && pwd) seconds=$2
shift 2
names=("$@")
if [ ${#names[@]} -eq 0 ]; then
    for program in "$folder"/fuzz_*; do [ -x "$program" ] && [ -f "$program" ] && names+=("${program##*/fuzz_}"); done
fi
mkdir -p "$folder/findings"
run() {
    local name=$1 kind=${1##*_}
    local seeds=()
    for seed in "$corpus/$name" "$corpus/$kind"; do [ -d "$seed" ] && seeds+=("$seed"); done
    local leaks=1
    case $name in multi_sweep) leaks=0 ;; esac # Gmsh leaks when it refuses a region
    mkdir -p "$folder/grown/$name"
    if "$folder/fuzz_$name" "$folder/grown/$name" "${seeds[@]}" -max_total_time="$seconds" -timeout=25 -rss_limit_mb=4096 \
        -max_len=65536 -detect_leaks=$leaks -artifact_prefix="$folder/findings/$name-" >"$folder/findings/$name.log" 2>&1; then
        echo "fuzz_$name: nothing found, $(grep -o 'Done [0-9]* runs' "$folder/findings/$name.log" || echo ended)"
    else
        echo "fuzz_$name: FOUND, see $folder/findings/$name.log" && tail -3 "$folder/findings/$name.log" && return 1
    fi
}
export -f run
export corpus folder seconds
printf '%s\0' "${names[@]}" | xargs -0 -n 1 -P "$(nproc)" bash -c 'run "$1"' run
