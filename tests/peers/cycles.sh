#!/usr/bin/env bash
# cycles.sh speed|error [DUOLUX [SCENE...]]: compares Duolux with Blender's Cycles on the CPU. Both render the same
# scenes under `global` with 16 scattering events, in turns and on all cores. Prints Markdown tables. Needs
# Debian's `blender` (and python3-numpy for glTF); takes about 6 minutes on two cores.
#
# Scenes are glTF files with a camera and emitting meshes, such as those of lit_model.py and materials.py, or diffuse
# JSON scenes; by default the Cornell box and two spheres of 500,000 triangles.
#
# speed: seconds of rendering alone and of the whole process: lowest, **median** and highest of kRuns.
# error: first checks that both converge to the same image; then compares the seconds of rendering to the RMSE
#        that Cycles reaches at several spp (Duolux: interpolated between its own, on log scales). The RMSE is
#        measured against a reference by either program, with seeds that no other render has. A bias of
#        either program would make the two results differ. Where their materials differ, only the last column
#        means something: each program's RMSE to its own reference.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

readonly kMode=${1:-}
readonly kDuolux=$(readlink -f "${2:-build/duolux}")
readonly kScripts=tests/peers
readonly kBounces=16
readonly kRuns=${RUNS:-3}

fail() {
  echo "cycles.sh: $1" >&2
  exit 1
}
[[ $kMode == speed || $kMode == error ]] || fail "expected \`speed\` or \`error\`, then the program (build/duolux)"
[[ -x $kDuolux ]] || fail "${2:-build/duolux} not found: ./quickstart builds it"
command -v blender >/dev/null || fail "blender not found: apt-get install --no-install-recommends blender python3-numpy"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
scenes=("${@:3}")
if ((${#scenes[@]} == 0)); then
  "$kDuolux" make-scene two-spheres --triangles 500000 -o "$folder" >/dev/null
  scenes=(assets/cornell/cornell.json "$folder/two_spheres.json")
fi
for scene in "${scenes[@]}"; do [[ -f $scene ]] || fail "$scene: no such file"; done

# number KEY FILE: the value of a key in JSON with one key per line.
number() { sed -n "s/.*\"$1\": *\([0-9.eE+-]*\).*/\1/p" "$2" | head -n 1; }

# duolux SCENE SIZE SPP SEED IMAGE, cycles SCENE SIZE SPP SEED IMAGE FREE: render, and print the seconds of
# rendering alone, from the first sample to the last, and those of the whole process.
duolux() {
  local start=$EPOCHREALTIME
  "$kDuolux" render "$1" --preset global --no-lamp --bounces $kBounces --size "$2x$2" --spp "$3" --seed "$4" -o "$5" --quiet \
    --report "$folder/report.json" 2>"$folder/log" || fail "duolux failed: $(cat "$folder/log")"
  echo "$(number render "$folder/report.json") $start $EPOCHREALTIME" | awk '{ print $1, $3 - $2 }'
}
cycles() {
  local log=$folder/cycles.log start
  printf '[{"scene": "%s", "size": %d, "spp": %d, "seed": %d, "output": "%s", "bounces": %d, "free": %d}]' \
    "$1" "$2" "$3" "$4" "$5" $kBounces "$6" >"$folder/job.json"
  start=$EPOCHREALTIME
  blender -b --factory-startup --debug-cycles --python-exit-code 1 -P $kScripts/cycles_render.py -- \
    "$folder/job.json" >"$log" 2>&1 || fail "blender failed: $(tail -n 5 "$log")"
  echo "$(awk '/ Path Tracing  / { print $3 }' "$log") $start $EPOCHREALTIME" | awk '{ print $1, $3 - $2 }'
}

# spread FILE COLUMN: lowest, median, highest.
spread() { sort -g -k "$2,$2" "$1" | awk -v c="$2" '{ v[NR] = $c } END { print v[1], v[int((NR + 1) / 2)], v[NR] }'; }

speed() {
  local size=512 spp=64 scene=$1 run who
  rm -f "$folder"/seconds.*
  for ((run = 1; run <= kRuns; run++)); do
    duolux "$scene" $size $spp $run "$folder/out.exr" >>"$folder/seconds.Duolux"
    cycles "$scene" $size $spp $run "$folder/out.exr" 0 >>"$folder/seconds.Cycles"
    cycles "$scene" $size $spp $run "$folder/out.exr" $kBounces >>"$folder/seconds.Cycles, no roulette"
  done
  for who in "Duolux" "Cycles" "Cycles, no roulette"; do
    echo "$(spread "$folder/seconds.$who" 1) $(spread "$folder/seconds.$who" 2)" \
      "$(spread "$folder/seconds.Duolux" 1) $(spread "$folder/seconds.Duolux" 2)" |
      awk -v scene="$(basename "${scene%.*}")" -v who="$who" -v samples=$((size * size * spp)) '{
        printf "| %s | %s | %.2f - **%.2f** - %.2f | %.2f | %.2f | %.2f - **%.2f** - %.2f | %.2f |\n",
          scene, who, $1, $2, $3, samples / $2 * 1e-6, $2 / $8, $4, $5, $6, $5 / $11 }'
  done
}

# difference METRIC IMAGE REFERENCE
difference() {
  "$kDuolux" compare --json "$2" "$3" >"$folder/compare.json"
  number "$1" "$folder/compare.json"
}

# error SCENE: appends to the files `agreement` and `times`, which are tables.
error() {
  local size=256 spp=1024 scene=$1 name ours=$folder/ours.exr theirs=$folder/theirs.exr out=$folder/out.exr run seconds
  name=$(basename "${scene%.*}")
  duolux "$scene" $size $spp 1001 "$ours" >/dev/null
  cycles "$scene" $size $spp 1002 "$theirs" 0 >/dev/null
  echo "$(number mean "$folder/report.json" | head -n 1) $(difference signed_mean "$theirs" "$ours")" \
    "$(difference rmse "$theirs" "$ours")" |
    awk -v name="$name" '{ printf "| %s | %.5f | %+.5f | %.5f |\n", name, $1, $2, $3 }' >>"$folder/agreement"

  rm -f "$folder/runs"
  for ((run = 1; run <= kRuns; run++)); do
    for spp in 1 4 16 64 256; do
      seconds=$(duolux "$scene" $size $spp $run "$out")
      echo "d $spp $seconds $(difference rmse "$out" "$ours") $(difference rmse "$out" "$theirs")" >>"$folder/runs"
      if ((spp == 1 || spp == 256)); then continue; fi
      seconds=$(cycles "$scene" $size $spp $run "$out" 0)
      echo "c $spp $seconds $(difference rmse "$out" "$ours") $(difference rmse "$out" "$theirs")" >>"$folder/runs"
    done
  done
  # Fields: program, spp, seconds of rendering, of the process, RMSE to Duolux's reference, to Cycles'.
  sort -k 1,1 -k 2,2n -k 3,3g "$folder/runs" | awk -v name="$name" '
    function finish() {
      if (!n) return
      count[who]++
      spp[who, count[who]] = at
      seconds[who, count[who]] = v[int((n + 1) / 2)]
      for (r = 1; r <= 2; r++) rmse[r, who, count[who]] = sqrt(square[r] / n)
      n = square[1] = square[2] = 0
    }
    function secondsOfDuolux(r, goal,    i, slope) {
      for (i = 2; i < count["d"] && rmse[r, "d", i] > goal; i++) {}
      slope = log(seconds["d", i] / seconds["d", i - 1]) / log(rmse[r, "d", i] / rmse[r, "d", i - 1])
      return seconds["d", i] * exp(slope * log(goal / rmse[r, "d", i]))
    }
    who != $1 || at != $2 { finish(); who = $1; at = $2 }
    { v[++n] = $3; square[1] += $5 * $5; square[2] += $6 * $6 }
    END {
      finish()
      for (i = 1; i <= count["c"]; i++) {
        printf "| %s | %d | %.2f |", name, spp["c", i], seconds["c", i]
        for (r = 1; r <= 2; r++) {
          s = secondsOfDuolux(r, rmse[r, "c", i])
          printf " %.5f | %.2f | %.1f |", rmse[r, "c", i], s, seconds["c", i] / s
        }
        s = secondsOfDuolux(1, rmse[2, "c", i])
        printf " %.2f | %.1f |\n", s, seconds["c", i] / s
      }
    }' >>"$folder/times"
}

if [[ $kMode == speed ]]; then
  echo "| scene | program | rendering, s | Msamples/s | times Duolux | whole process, s | times Duolux |"
  echo "|---|---|---|---|---|---|---|"
  for scene in "${scenes[@]}"; do speed "$scene"; done
else
  for scene in "${scenes[@]}"; do error "$scene"; done
  echo "| scene | mean radiance | mean of Cycles - Duolux | RMSE between them |"
  echo "|---|---|---|---|"
  cat "$folder/agreement"
  echo
  echo "| scene | Cycles, spp | Cycles, s | RMSE to Duolux' | Duolux, s | ratio | RMSE to Cycles' | Duolux, s | ratio | to its own: Duolux, s | ratio |"
  echo "|---|---|---|---|---|---|---|---|---|---|---|"
  cat "$folder/times"
fi
grep -q "Using EMBREE layout" "$folder/cycles.log" || echo "cycles.sh: this Cycles was built without Embree" >&2
