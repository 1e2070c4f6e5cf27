#!/usr/bin/env bash
# growth.sh [DUOLUX-PEERS]: measures how rays per second decrease from 10^4 to 10^7 triangles (two spheres),
# with Duolux and Embree in turns. Prints a Markdown table: lowest, **median** and highest of kRuns, and the
# slowdown relative to 10^4 triangles. Needs the target duolux-peers (`cmake --build --preset release --target
# duolux-peers`) and 4 GB of memory; takes about 3 minutes on two cores.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

readonly kPeers=${1:-build/release/host/tools/peers/duolux-peers}
readonly kRuns=9

[[ -x $kPeers ]] || {
  echo "growth.sh: $kPeers not found: cmake --build --preset release --target duolux-peers" >&2
  exit 1
}

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

echo "| triangles | rays | Duolux, Mrays/s | Embree, Mrays/s | times slower: Duolux | Embree | Duolux / Embree |"
echo "|---|---|---|---|---|---|---|"
for triangles in 10000 100000 1000000 10000000; do
  "$kPeers" two-spheres-$triangles --only /rays/ --spp 1 --repeat $kRuns >"$folder/peers"
  # Lines of the table: SCENE/rays/KIND/PROGRAM, lowest, median, highest.
  awk -v triangles=$triangles -v OFS='\t' '/\/rays\/.*\/(duolux|embree) / {
    split($1, name, "/")
    print triangles, name[3], name[4], $2, $3, $4 }' "$folder/peers" >>"$folder/rates"
done
awk '
  { low[$1, $2, $3] = $4; median[$1, $2, $3] = $5; high[$1, $2, $3] = $6 }
  NR <= 6 { first[$2, $3] = $5 }
  $3 == "embree" { order[++n] = $1 SUBSEP $2 }
  function rate(i, who) {
    return sprintf("%.1f - **%.1f** - %.1f", low[order[i], who], median[order[i], who], high[order[i], who])
  }
  function fall(i, who,    at) { split(order[i], at, SUBSEP); return first[at[2], who] / median[order[i], who] }
  END {
    for (i = 1; i <= n; i++) {
      split(order[i], at, SUBSEP)
      printf "| %d | %s | %s | %s | %.2f | %.2f | %.2f |\n", at[1], at[2], rate(i, "duolux"), rate(i, "embree"),
        fall(i, "duolux"), fall(i, "embree"), fall(i, "duolux") / fall(i, "embree")
    }
  }' "$folder/rates"
