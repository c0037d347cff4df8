#!/bin/sh
# Instructions of one impact without and with the energy ledger, and how often its bookkeeping is
# called: never without it. Needs valgrind (Debian: apt install valgrind).
#
#   sh crates/abrade/benches/instructions.sh ["paper HertzNodes 45"]
set -eu
case=${1:-paper HertzNodes 45}
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT
bench=$(CARGO_PROFILE_BENCH_DEBUG=0 cargo bench -p abrade --bench impacts --no-run 2>&1 |
    sed -n 's/.*Executable.*(\(.*\))/\1/p')
for ledger in "" ledger; do
    # shellcheck disable=SC2086
    count=$(valgrind --tool=callgrind --callgrind-out-file="$out/counts" \
        --toggle-collect='*Encounter*advance*' "$bench" --once "$case" 1 $ledger 2>&1 |
        sed -n 's/.*Collected : //p')
    calls=$(callgrind_annotate --tree=calling "$out/counts" 2>/dev/null |
        sed -n 's/.*>.*Ledger.*take.*(\([0-9,]*\)x).*/\1/p' | head -1)
    echo "${ledger:-no ledger}: $count instructions, ${calls:-0} calls of the ledger"
done
