#!/usr/bin/env bash
# layouts.sh [OPTION...]: measures every layout and kernel on a device (duolux bench --help), and prints a
# Markdown table. Takes the options of `duolux bench` except --repeat, --only, --layout, --kernel, --json and
# --quiet, for example --device gpu. Rates are millions of rays or samples per second of wall time: medians
# over ROUNDS (5) rounds. All combinations take turns in each round, because the speed of machines varies. The
# last two columns are for diffuse rays: the rate at which they read memory, and how busy lanes are with nodes
# and with pairs of triangles. Combinations that the device lacks are left out, with the reason on standard
# error. Builds nothing: measures DUOLUX (build/duolux) on SCENES.
set -euo pipefail
readonly kHere=$(dirname "$(readlink -f "$0")")

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0"
  exit
fi

readonly kDuolux=$(readlink -f "${DUOLUX:-$kHere/../../build/duolux}")
readonly kRounds=${ROUNDS:-5}
read -r -a scenes <<<"${SCENES:-cornell two-spheres-500000}"
[[ -x $kDuolux ]] || { echo "layouts.sh: $kDuolux not found: build it with ./quickstart, or set DUOLUX" >&2; exit 2; }
[[ $kRounds =~ ^[1-9][0-9]*$ ]] || { echo "layouts.sh: ROUNDS is $kRounds; expected a whole number from 1" >&2; exit 2; }
readonly kColumns=(rays/primary rays/diffuse rays/shadow rays/crossings render/global/path render/local/path)

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

only=()
for column in "${kColumns[@]}"; do only+=(--only "$column"); done

# measure LAYOUT KERNEL [OPTION...]: runs once; appends a line "SCENE/BENCHMARK RATE" for each result.
measure() {
  local layout=$1 kernel=$2
  shift 2
  "$kDuolux" bench "${scenes[@]}" "${only[@]}" --repeat 1 --quiet --layout "$layout" --kernel "$kernel" \
    --json "$folder/run.json" "$@" >"$folder/out" 2>"$folder/error" || return 1
  awk '{ value = $2; gsub(/[",]/, "", value) }
    /"name":/ { name = value }
    /"wall":/ { wall = 1 }
    /"median":/ && wall { print name, value; wall = 0 }
    /_bytes_per_ray":/ { bytes[name] += value }
    /"lanes_in_/ { key = $1; gsub(/[":]/, "", key); print name "#" key, 100 * value }
    END { for (name in bytes) print name "#bytes", bytes[name] }' "$folder/run.json" >>"$folder/$layout-$kernel"
}

# text KEY N: the N-th value of a key in the newest run's JSON.
text() { sed -n "s/^ *\"$1\": \"\(.*\)\",\?$/\1/p" "$folder/run.json" | sed -n "$2p"; }

# median FILE NAME: the median rate of NAME in a file, or a dash.
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
    elif grep -qE '^duolux: (layout|kernel) ' "$folder/error"; then
      echo "layouts.sh: left out $layout, $kernel: $(cat "$folder/error")" >&2
    else
      cat "$folder/error" >&2
      exit 1
    fi
  done
  combinations=("${there[@]}")
  if ((${#combinations[@]} == 0)); then exit 1; fi
done

echo "$(text name 2), $(text driver 1); duolux $(text commit 1)"
echo
echo "| scene | layout | kernel | primary | diffuse | shadow | crossings | \`global\` | \`local\` | diffuse, GB/s | lanes busy, % |"
echo "|---|---|---|---|---|---|---|---|---|---|---|"
for scene in "${scenes[@]}"; do
  name=$scene
  if [[ -e $scene ]]; then name=$(basename "${scene%.*}"); fi
  for combination in "${combinations[@]}"; do
    read -r layout kernel <<<"$combination"
    rates="$folder/$layout-$kernel"
    row="| $name | $layout | $kernel |"
    for column in "${kColumns[@]}"; do row+=" $(median "$rates" "$name/$column") |"; done
    diffuse=$name/rays/diffuse
    row+=" $(awk -v rate="$(median "$rates" "$diffuse")" -v bytes="$(median "$rates" "$diffuse#bytes")" \
      'BEGIN { if (bytes == "-") print "-"; else printf "%.1f", rate * bytes / 1000 }') |"
    echo "$row $(median "$rates" "$diffuse#lanes_in_nodes"), $(median "$rates" "$diffuse#lanes_in_pairs") |"
  done
done
