#!/usr/bin/env bash
# Makes the sample from the scenes: trains the place from its video, bakes, and exports the show. What is
# up to date is not made again.
#
#   scripts/make_sample.sh PROGRAM_FOLDER [OUTPUT_FOLDER]      default: build/demo
set -euo pipefail
cd "$(dirname "$0")/.."

bin=$1
out=${2:-build/demo}
project=$out/thermopolium/thermopolium.lararium
filmed=$out/maquette/maquette.lararium/places/maquette

# The thermopolium is staged on the maquette's place.
mkdir -p "$out"
cp -Ru scenes/maquette scenes/thermopolium "$out/"
if [[ ! $project/places/maquette/scene.larscene -nt $filmed/training.mp4 ]]; then
  "$bin/lararium-editor" train "$project" --place maquette
fi
"$bin/lararium-editor" bake "$project"
"$bin/lararium-editor" export "$project" --out "$out/thermopolium.larshow"
