#!/usr/bin/env bash
# layouts.sh [OPTION...]: what a device makes of every layout and kernel (duolux bench --help), as a table in Markdown. The
# options are those of `duolux bench`, for example --device gpu. Millions of rays and samples a second of wall time, medians
# over ROUNDS (5) rounds, in each of which all take turns, because machines vary. What a device does not have is left out,
# and why is told on standard error. Nothing is built: DUOLUX (build/duolux) is measured, on SCENES.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

readonly kDuolux=$(readlink -f "${DUOLUX:-build/duolux}")
readonly kRounds=${ROUNDS:-5}
read -r -a scenes <<<"${SCENES:-cornell two-spheres-500000}"
readonly kColumns=(rays/primary rays/diffuse rays/shadow rays/crossings render/global/path render/local/path)

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

only=()
for column in "${kColumns[@]}"; do only+=(--only "$column"); done

# measure LAYOUT KERNEL [OPTION...]: one run; appends a line "SCENE/BENCHMARK RATE" for each result.
measure() {
  local layout=$1 kernel=$2
  shift 2
  "$kDuolux" bench "${scenes[@]}" "${only[@]}" --repeat 1 --quiet --layout "$layout" --kernel "$kernel" \
    --json "$folder/run.json" "$@" >"$folder/out" 2>"$folder/error" || return 1
  awk '{ value = $2; gsub(/[",]/, "", value) }
    /"name":/ { name = value }
    /"wall":/ { wall = 1 }
    /"median":/ && wall { print name, value; wall = 0 }' "$folder/run.json" >>"$folder/$layout-$kernel"
}

# text KEY N: the N-th value of a key in the newest run's JSON.
text() { sed -n "s/^ *\"$1\": \"\(.*\)\",\?$/\1/p" "$folder/run.json" | sed -n "$2p"; }

# median FILE NAME: of the rates in a file, or a dash.
median() {
  awk -v name="$2" '$1 == name { print $2 }' "$1" | sort -g |
    awk '{ v[NR] = $1 } END { if (NR == 0) print "-"; else printf "%.3g\n", (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }'
}

combinations=("texel refilling" "texel plain" "storage refilling" "storage plain" "ray-query plain")
for ((round = 0; round < kRounds; round++)); do
  there=()
  for combination in "${combinations[@]}"; do
    read -r layout kernel <<<"$combination"
    if measure "$layout" "$kernel" "$@"; then
      there+=("$combination")
    else
      echo "layouts.sh: left out $layout, $kernel: $(cat "$folder/error")" >&2
    fi
  done
  combinations=("${there[@]}")
  if ((${#combinations[@]} == 0)); then exit 1; fi
done

echo "$(text name 2), $(text driver 1); duolux $(text commit 1)"
echo
echo "| scene | layout | kernel | primary | diffuse | shadow | crossings | \`global\` | \`local\` |"
echo "|---|---|---|---|---|---|---|---|---|"
for scene in "${scenes[@]}"; do
  for combination in "${combinations[@]}"; do
    read -r layout kernel <<<"$combination"
    row="| $scene | $layout | $kernel |"
    for column in "${kColumns[@]}"; do row+=" $(median "$folder/$layout-$kernel" "$scene/$column") |"; done
    echo "$row"
  done
done
