#!/bin/sh
# Instructions per node evaluation of an impact with one optional part of the core, over the same
# impact without any. Needs valgrind (Debian: apt install valgrind).
#
#   sh crates/abrade/benches/pay.sh
set -eu
counts=$(mktemp)
trap 'rm "$counts"' EXIT
bench=$(CARGO_PROFILE_BENCH_DEBUG=0 cargo bench -p abrade --bench pay --no-run 2>&1 |
    sed -n 's/.*Executable.*(\(.*\))/\1/p')
parts=$("$bench" | sed -n 's/parts: //p')
for shape in $("$bench" | sed -n 's/shapes: //p'); do
    for part in $parts; do
        nodes=$("$bench" "$shape" "$part")
        test "$nodes" -gt 0 || continue
        valgrind --tool=callgrind --callgrind-out-file=/dev/null \
            --toggle-collect='*Encounter*advance*' "$bench" "$shape" "$part" >"$counts" 2>&1
        sed -n 's/.*Collected : //p' "$counts" | awk -v what="$shape $part" -v nodes="$nodes" \
            '{ printf "%s %d %d %.1f\n", what, nodes, $1, $1 / nodes }'
    done
done | awk '$2 == "nothing" { plain = $5 }
    { printf "%-5s %-12s %9d nodes %12d instructions %9.1f each %+7.2f %%\n", \
        $1, $2, $3, $4, $5, 100 * ($5 / plain - 1) }'
