#!/bin/bash
# Draws an occluder on training images with real input events: corners in one image, the same in
# another, one dragged, one taken back. Looks at the saved project and at screenshots.
#
#   occluder_window_test.sh EDITOR OUTPUT_FOLDER MAKE_ROOM_MAP
set -u
make_room_map=$3

. "$(dirname "$0")/window.sh"
need identify
begin_test "$0" "$@"

# How often the corners were picked in an image: "0.png" and so on.
picks_in() { tr -d ' \n' < "$json" | grep -o "\"frame\":\"$1\"" | wc -l; }
picked() { [ "$(picks_in "$1")" -eq "$2" ]; }

new_project_with_place
"$make_room_map" "$project/places/site/scene.larscene" || fail "cannot make a map"
open_window 700 780 "$project"
settle
press F8  # the messages leave the most room above
click 107 14   # Place
click 150 205  # Draw an occluder
for corner in "560 250" "700 250" "700 400" "560 400"; do
  click $corner
done
press ctrl+s
wait_for 10 picked 0.png 4 || fail "$(picks_in 0.png) corners in the first image"
import -window root "$out/first.png"

# In another image the same four, and no fifth.
click 757 690
for corner in "600 260" "740 250" "742 400" "602 410" "660 300"; do
  click $corner
done
press ctrl+s
wait_for 10 picked 8.png 4 || fail "$(picks_in 8.png) corners in the other image"
picked 0.png 4 || fail "the first image has $(picks_in 0.png) corners now"
import -window root "$out/second.png"

# A corner is dragged: one command, which undo takes back.
before=$(tr -d ' \n' < "$json")
xdotool mousemove 742 400 sleep 0.4 mousedown 1 sleep 0.3 mousemove 752 410 sleep 0.3
xdotool mousemove 762 420 sleep 0.4 mouseup 1
sleep 0.6
press ctrl+s
sleep 0.5
picked 8.png 4 || fail "dragging added a corner"
[ "$(tr -d ' \n' < "$json")" != "$before" ] || fail "the corner was not dragged"
press ctrl+z
press ctrl+s
taken_back() { [ "$(tr -d ' \n' < "$json")" = "$before" ]; }
wait_for 10 taken_back || fail "undo of the drag"
press ctrl+z
press ctrl+s
wait_for 10 picked 8.png 3 || fail "undo of a click"
quit
echo "passed; screenshots: $out/first.png $out/second.png"
