#!/bin/bash
# Looks through the camera by real input events: the line between before and after is switched on
# and dragged, whatever is selected.
#
#   camera_window_test.sh EDITOR OUTPUT_FOLDER SAMPLE_PROJECT [MAP]
#
# MAP: of the sample's place, in place of training it, which takes a minute.
set -u
editor=$1
out=$2
sample=$3
map=${4:-}

. "$(dirname "$0")/window.sh"
need xvfb-run Xvfb xdotool import convert
on_a_display "$0" "$@"
start_clean
project=$out/ui.lararium

# A part of the window, WIDTHxHEIGHT+X+Y, as a number that says whether it is the same.
part() { import -window root -crop "$1" +repage rgb:- | sha256sum | cut -c 1-16; }
is_part() { [ "$(part "$1")" = "$2" ]; }
is_other() { [ "$(part "$1")" != "$2" ]; }

cp -r "$sample" "$project"
chmod -R u+w "$project"
if [ -n "$map" ]; then
  cp "$map" "$project/places/maquette/scene.larscene"
else
  "$editor" train "$project" --place maquette --video "$project/places/maquette/training.mp4" \
    >> "$out/editor.log" 2>&1 || fail "cannot train the sample"
fi
"$editor" bake "$project" >> "$out/editor.log" 2>&1 || fail "cannot bake the sample"
open_window 700 780 "$project"
picture=200x200+560+300  # with a person in its middle
blank=$(part $picture)
wait_for 60 is_other $picture "$blank" || fail "no picture"
sleep 8
press F8  # the messages leave the most room above
sleep 2

# Before and after: the line stands in the middle; the person's left half is gone.
left=14x200+636+320
right=14x200+680+320
left_after=$(part $left)
right_after=$(part $right)
press b
wait_for 10 is_other $left "$left_after" || fail "B does not show the image alone"
sleep 1
import -window root "$out/wipe.png"
left_before=$(part $left)
drag 664 400 500 420
xdotool mousemove 700 780
wait_for 10 is_part $left "$left_after" || fail "the line was not dragged"
is_part $right "$right_after" || fail "to the right of the line the picture is another"
drag 500 420 900 380
xdotool mousemove 700 780
wait_for 10 is_part $left "$left_before" || fail "the line was not dragged back"
import -window root "$out/wiped.png"
click 944 690  # Before/after
xdotool mousemove 700 780
wait_for 10 is_part $left "$left_after" || fail "the button does not end it"
quit
echo "passed; screenshots: $out/wipe.png $out/wiped.png"
