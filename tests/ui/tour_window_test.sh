#!/bin/bash
# The guided tour of the sample, step by step, each done as the card asks for it: a training that
# is cancelled and one that is not, what its report says, playing, matches, the view around the
# place, the stage, undo, a person, the light, the drama, the checks, saving, the export. Then a
# session in another recording is added and taken out of the map again.
# Looks at how far the card's bar is, at saved files and at screenshots.
#
#   tour_window_test.sh EDITOR OUTPUT_FOLDER
set -u

. "$(dirname "$0")/window.sh"
need convert identify
begin_test "$0" "$@"
export HOME=$out/home XDG_DATA_HOME=$out/data
mkdir -p "$HOME"
project=$XDG_DATA_HOME/lararium/maquette.lararium
json=$project/project.json
scene=$project/places/maquette/scene.larscene

shot() { import -window root "$out/$1.png"; }
# How many of the twelve steps are done, by the card's bar.
steps() {
  import -window root -crop 356x1+262+704 +repage "$out/bar.png"
  convert "$out/bar.png" -channel R -separate +channel -threshold 60% -format '%[fx:int(0.5+mean*12)]' info:
}
at_step() { [ "$(steps)" -eq "$1" ]; }
# done_after NUMBER WHAT
done_after() {
  wait_for 20 at_step "$1" || fail "$2: $(steps) steps are done, not $1"
}

open_window 1300 880
sleep 2
click 250 377  # Open the sample
wait_for 20 titled "The maquette" || fail "the sample did not open"
sleep 3
shot begin
# Cancelled: nothing was written.
click 37 44    # Train
click 912 590  # Train
sleep 8
shot training
at_step 0 || fail "a step is done before anything was"
click 364 877  # Cancel
sleep 4
shot cancelled
[ -e "$scene" ] && fail "a cancelled training left a map"

# Trained, and what the report says.
click 37 44
click 912 590
wait_for 400 test -s "$scene" || fail "the place was not trained"
sleep 6
shot report
press Escape
done_after 1 "training"
shot trained

press space
done_after 2 "playing"
press space
press t
done_after 3 "matches"
press t
press 2
done_after 4 "the view around"
shot around
