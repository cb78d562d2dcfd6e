#!/bin/bash
# The guided tour of the sample, step by step, each done as the card asks for it: pausing, the
# training's report, matches, the view around the place, the stage, undo, a person, the light, the
# drama, the checks, saving, the export. Then a session in another recording is added, and cancelled.
# Looks at how far the card's bar is, at saved files and at screenshots. The sample is trained
# already, so that the tour's first step is done; sitting_window_test.sh trains a place.
#
#   tour_window_test.sh EDITOR OUTPUT_FOLDER SAMPLE
set -u
sample=$3

. "$(dirname "$0")/window.sh"
need convert identify
begin_test "$0" "$@"
install_editor "$out/installed"
install_sample "$sample"
copy=$XDG_DATA_HOME/lararium/sample/thermopolium

# How many of the thirteen steps are done, by the card's bar.
steps() {
  import -window root -crop 356x1+708+719 +repage "$out/bar.png"
  convert "$out/bar.png" -channel R -separate +channel -threshold 60% -format '%[fx:int(0.5+mean*13)]' info:
}
at_step() { [ "$(steps)" -eq "$1" ]; }
# done_after NUMBER WHAT
done_after() {
  wait_for 20 at_step "$1" || fail "$2: $(steps) steps are done, not $1"
}

open_window 1300 880
settle
click 250 377  # Open the sample
wait_for 20 titled "A morning at the thermopolium" || fail "the sample did not open"
wait_for 120 at_step 1 || fail "the tour does not begin with the picture"
shot begin
press space
done_after 2 "pausing"
click 107 13  # Place
click 159 88  # The training's report
sleep 1
shot report
press Escape  # The dialog dims the card.
done_after 3 "the report"
press t
done_after 4 "matches"
press t
press 2
done_after 5 "the view around"
shot around

drag 723 393 757 404  # the arrow of x
done_after 6 "a drag of the stage"
press ctrl+z
done_after 7 "undo"
click 88 482  # the keeper
done_after 8 "a person"
press 1
click 64 321  # noon
sleep 1
press braceleft
done_after 9 "the light"
shot light
click 640 835  # the timeline
press a
sleep 1
click 700 881  # Marker
done_after 10 "an item of the drama"
shot marker
press F7
sleep 1
click 393 641  # Check the saved project
wait_for 90 at_step 11 || fail "the check is not done"
shot checks
press ctrl+s
done_after 12 "saving"
click 368 44  # Export
sleep 2
shot export
click 912 651  # Export
wait_for 120 test -s "$copy/thermopolium.larshow" || fail "nothing was exported"
sleep 3
press Escape
done_after 13 "the export"
shot finished
grep -q 'name = "marker"' "$copy/thermopolium.lararium/drama.lua" || fail "the marker was not saved"
grep -q 'name = "marker"' "$sample/thermopolium/thermopolium.lararium/drama.lua" &&
  fail "the shipped drama was changed"

# A session that is cancelled leaves the map.
scene=$copy/thermopolium.lararium/places/maquette/scene.larscene
before=$(sha256sum < "$scene")
click 167 44  # Add a session
sleep 1
fill 720 450 ../../maquette/maquette.lararium/places/maquette/handheld.mp4
click 912 547  # Add
sleep 4
shot adding
# Cancel, which stands behind a text of changing length.
for x in 340 375 410 445 480; do
  click $x 877
done
sleep 4
shot cancelled
[ "$(sha256sum < "$scene")" = "$before" ] || fail "a cancelled session changed the map"
quit
echo "passed; screenshots: $out/begin.png $out/around.png $out/finished.png"
