#!/usr/bin/env bash
# integrators.sh [DUOLUX [SPP]]: prints variance times time of both integrators as a Markdown table. The
# variance is that of a displayed channel of a pixel, averaged over the image: half the mean square difference
# of two renders, over kPairs pairs with different seeds. The integrators take turns, because the speed of
# machines varies. Lower is better; the last column is how many times as long `path` takes for the same noise.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

readonly kDuolux=$(readlink -f "${1:-build/duolux}")
readonly kSpp=${2:-64}
readonly kSize=256x256
readonly kPairs=3

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$kDuolux" make-scene two-spheres --triangles 500000 -o "$folder" >/dev/null

# number KEY FILE: the value of a key in JSON with one key per line.
number() { sed -n "s/.*\"$1\": *\([0-9.eE+-]*\).*/\1/p" "$2" | head -n 1; }

# measure SCENE PRESET INTEGRATOR SEED: renders with seeds SEED and SEED + 1; appends variance and seconds of one render.
measure() {
  local bounces=16 seed
  # In a closed room shadowless light grows with every bounce.
  if [[ $2 == shadowless ]]; then bounces=4; fi
  for seed in $4 $(($4 + 1)); do
    "$kDuolux" render "$1" --preset "$2" --bounces $bounces --integrator "$3" --seed "$seed" --spp "$kSpp" --size $kSize \
      -o "$folder/$seed.pfm" --quiet --report "$folder/$seed.json" 2>/dev/null
  done
  "$kDuolux" compare --json "$folder/$4.pfm" "$folder/$(($4 + 1)).pfm" >"$folder/compare.json"
  echo "$(number rmse "$folder/compare.json") $(number render "$folder/$4.json") $(number render "$folder/$(($4 + 1)).json")" |
    awk '{ print $1 * $1 / 2, ($2 + $3) / 2 }' >>"$folder/$3"
}

# mean INTEGRATOR: variance, seconds.
mean() { awk '{ v += $1; s += $2 } END { print v / NR, s / NR }' "$folder/$1"; }

echo "| scene | preset | path: variance x s | light: variance x s | path / light |"
echo "|---|---|---|---|---|"
for scene in assets/cornell/cornell.json assets/spot/spot.json "$folder/two_spheres.json" assets/uplight/uplight.json; do
  for preset in local global shadowless one-bounce; do
    rm -f "$folder/path" "$folder/light"
    for ((pair = 0; pair < kPairs; pair++)); do
      measure "$scene" $preset path $((1 + 2 * pair))
      measure "$scene" $preset light $((1 + 2 * pair))
    done
    echo "$(basename "$scene" .json) $preset $(mean path) $(mean light)" | awk '{
      path = $3 * $4; light = $5 * $6
      printf "| %s | `%s` | %.2g x %.2f = %.2g | %.2g x %.2f = %.2g | %s |\n", $1, $2, $3, $4, path, $5, $6, light,
        (light > 0 ? sprintf("%.2g", path / light) : "-") }'
  done
done
