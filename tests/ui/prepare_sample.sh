#!/bin/bash
# Makes the sample as ./demo prepares it, trained and baked, for tests of the window. Plain figures
# stand in for the people, because those of the cast library take many minutes to bake. What is up to
# date is not made again.
#
#   prepare_sample.sh EDITOR OUTPUT_FOLDER SCENES
set -eu
editor=$1
sample=$2/sample
scenes=$3
out=$2
. "$(dirname "$0")/window.sh"
built=$editor
install_editor "$out/installed"
project=$sample/thermopolium/thermopolium.lararium
mkdir -p "$sample"
cp -Ru "$scenes/maquette" "$scenes/thermopolium" "$sample/"
if [ ! "$project/places/maquette/scene.larscene" -nt "$built" ]; then
  "$editor" train "$project" --place maquette
fi
"$editor" bake "$project"
