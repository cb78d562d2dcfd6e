#!/usr/bin/env bash
# Makes the sample from the scenes: trains the place from its video, bakes, and exports the show. What is
# up to date is not made again.
#
#   scripts/make_sample.sh PROGRAM_FOLDER OUTPUT_FOLDER [STEP...]      steps: train bake export; default: all
set -euo pipefail
cd "$(dirname "$0")/.."

bin=$1
out=$2
shift 2
project=$out/thermopolium/thermopolium.lararium
filmed=$out/maquette/maquette.lararium/places/maquette

# The thermopolium is staged on the maquette's place.
mkdir -p "$out"
cp -Ru scenes/maquette scenes/thermopolium "$out/"
(($# > 0)) || set -- train bake export
for step in "$@"; do
  case $step in
    train)
      if [[ ! $project/places/maquette/scene.larscene -nt $filmed/training.mp4 ]]; then
        "$bin/lararium-editor" train "$project" --place maquette
      fi
      ;;
    bake) "$bin/lararium-editor" bake "$project" ;;
    export) "$bin/lararium-editor" export "$project" --out "$out/thermopolium.larshow" ;;
    *)
      echo "$0: there is no step $step; the steps are train, bake and export" >&2
      exit 2
      ;;
  esac
done
