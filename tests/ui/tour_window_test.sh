#!/bin/bash
# The guided tour of the sample, step by step, each done as the card asks for it: a training that
# is cancelled and one that is not, what its report says, playing, matches, the view around the
# place, the stage, undo, a person, the light, the drama, the checks, saving, the export. Then a
# session in another recording is added, cancelled at first.
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

# How many of the twelve steps are done, by the card's bar.
steps() {
  import -window root -crop 356x1+708+704 +repage "$out/bar.png"
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

drag 726 392 760 403  # the arrow of x
done_after 5 "a drag of the stage"
press ctrl+z
done_after 6 "undo"
click 88 482  # the keeper
done_after 7 "a person"
press 1
click 64 321  # noon
sleep 1
press braceleft
done_after 8 "the light"
shot light
click 640 835  # the timeline
press a
sleep 1
click 700 881  # Marker
done_after 9 "an item of the drama"
shot marker
press F7
sleep 1
click 393 641  # Check the saved project
wait_for 60 at_step 10 || fail "the check is not done"
shot checks
press ctrl+s
done_after 11 "saving"
click 368 44  # Export
sleep 2
shot export
click 912 651  # Export
wait_for 300 test -s "$XDG_DATA_HOME/lararium/maquette.larshow" || fail "nothing was exported"
sleep 3
press Escape
done_after 12 "the export"
shot finished
click 733 764  # Close

# A session in another recording is added, and cancelled before it is done; then added.
added() { tr -d ' \n' < "$json" | grep -q '"added":\[{'; }
before=$(sha256sum < "$scene")
is_other_map() { [ "$(sha256sum < "$scene")" != "$before" ]; }
add_session() {
  click 167 44  # Add a session
  sleep 1
  fill 720 450 places/maquette/handheld.mp4
  click 912 547  # Add
}
add_session
sleep 6
click 364 877  # Cancel
sleep 4
shot cancelled_session
is_other_map && fail "a cancelled session changed the map"
add_session
wait_for 400 is_other_map || fail "the session was not added"
sleep 5
shot added
before=$(sha256sum < "$scene")
press Return  # keeps this map
sleep 2
shot kept
is_other_map && fail "Enter put the former map back"
press ctrl+s
wait_for 10 added || fail "the project does not name the session"
quit
echo "passed; screenshots: $out/trained.png $out/around.png $out/finished.png $out/added.png"
