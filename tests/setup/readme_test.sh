#!/usr/bin/env bash
# readme_test.sh DUOLUX SOURCE_DIR: the commands of the README and the performance notes work, and so does the
# scene file of host/loaders/README.md.
set -euo pipefail
duolux=$1
source=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cp "$source"/assets/cornell/cornell.{obj,mtl} .
ln -s "$source/assets" assets

# The JSON block is indented by four, from the line of the opening brace to that of the closing one.
sed -n '/^    {$/,/^    }$/s/^    //p' "$source/host/loaders/README.md" >scene.json
grep -q '"duolux": 1' scene.json
"$duolux" info scene.json
"$duolux" render scene.json --size 16x16 --spp 1 --quiet -o scene.png

# Runs the commands with small images of a model that exists.
cp cornell.obj model.obj
sed -n 's/^    build\/duolux \([^#]*\)\(#.*\)\?$/\1/p' "$source"/{README.md,tests/bench/PERFORMANCE.md} >commands
(($(wc -l <commands) >= 3))
while read -r -a arguments; do
  extra=()
  if [[ ${arguments[0]} == render ]]; then extra=(--time-limit 0.1 --quiet); fi
  # Times of tiny runs are not meaningful: any of them may be slower than before.
  if [[ ${arguments[0]} == bench ]]; then extra=(--size 16x16 --spp 1 --repeat 1 --quiet --threshold 1); fi
  echo "duolux ${arguments[*]} ${extra[*]}"
  "$duolux" "${arguments[@]}" "${extra[@]}"
done <commands
test -s model.png && test -s model.exr
