#!/bin/bash
# Looks through the camera by real input events: the line between before and after is dragged, an
# occluder's corners are drawn on frames of the recording, onion skins are laid over the picture,
# and a live camera is shown and ended.
#
#   camera_window_test.sh EDITOR OUTPUT_FOLDER SAMPLE_PROJECT THIN_MAP [MAP]
#
# MAP: of the sample's place, in place of training it, which takes a minute.
set -u
sample=$3
thin_map=$4
map=${5:-}

. "$(dirname "$0")/window.sh"
need convert
begin_test "$0" "$@"

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
"$thin_map" "$project/places/maquette/scene.larscene" 56 66 || fail "cannot thin the map"
"$editor" bake "$project" >> "$out/editor.log" 2>&1 || fail "cannot bake the sample"
open_window 700 780 "$project"
picture=200x200+560+300  # with a person in its middle
blank=$(part $picture)
wait_for 60 is_other $picture "$blank" || fail "no picture"
press F8  # the messages leave the most room above
settle
# The person's dress is bright; the counter behind it is red, and a dark note lies there until the
# recording is open.
person_is_there() {
  for y in 370 480 530; do
    [ "$(import -window root -crop "1x1+640+$y" rgb:- | od -An -tu1 | awk '{ print ($2 > 150) }')" = 1 ] ||
      return 1
  done
}
wait_for 60 person_is_there || fail "no person"
settle

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
click 820 690  # Before/after
xdotool mousemove 700 780
wait_for 10 is_part $left "$left_after" || fail "the button does not end it"

# Onion skin: somebody walks behind the counter; while the drama plays there is none.
click 435 690  # a frame
xdotool mousemove 700 780
settle
walker=40x40+725+270
without=$(part $walker)
press k
wait_for 10 is_other $walker "$without" || fail "K shows no onion skin"
with=$(part $walker)
click 972 690  # ...
sleep 1
import -window root "$out/onion.png"
xdotool mousemove 955 524 sleep 0.3 mousedown 1 sleep 0.3 mousemove 1010 524 sleep 0.3 mouseup 1
sleep 2
import -window root "$out/onions.png"
press Escape
click 700 760  # closes it
press k
wait_for 10 is_part $walker "$without" || fail "without onion skin the picture is another"
click 435 690
xdotool mousemove 700 780
press b
press b
is_part $walker "$without" || fail "the picture is another after onion skins were drawn"

# An occluder is drawn on frames of the training recording, which the view is told to show: the
# frames become images of the map.
click 107 14   # Place
click 150 205  # Draw an occluder
press 1
sleep 1
import -window root "$out/other_recording.png"
before=$(sha256sum < "$project/places/maquette/scene.larscene")
click 154 14  # View
click 185 571  # The camera is
shown=$(part $picture)
click 460 593  # The training's recording
xdotool mousemove 700 780
wait_for 60 is_other $picture "$shown" || fail "the training's recording is not shown"
settle
# The corners of the yellow wall's picture, in two frames.
click 507 690
sleep 2
for corner in "708 143" "803 143" "803 264" "708 264"; do
  click $corner
done
import -window root "$out/corners.png"
click 538 690
sleep 2
for corner in "877 187" "968 187" "968 297" "877 297"; do
  click $corner
done
xdotool mousemove 700 780
press ctrl+s
corner_picks() { tr -d ' \n' < "$json" | grep -o '"corners":.*"name":"face1"' |
  grep -o '"frame":"[0-9]*.png"' | sort | uniq -c; }
drawn() { [ "$(corner_picks | grep -c "4 \"frame\"")" -eq 2 ]; }
wait_for 10 drawn || fail "two frames with four corners each, not: $(corner_picks)"
kept() { [ "$(sha256sum < "$project/places/maquette/scene.larscene")" != "$before" ]; }
wait_for 10 kept || fail "the frames did not become images of the map"
import -window root "$out/drawn.png"
before=$(tr -d ' \n' < "$json")
drag 877 297 884 306  # a corner
press ctrl+s
moved() { [ "$(tr -d ' \n' < "$json")" != "$before" ]; }
wait_for 10 moved || fail "the corner was not dragged"
drawn || fail "dragging added a corner: $(corner_picks)"
press ctrl+z
press ctrl+s
taken_back() { [ "$(tr -d ' \n' < "$json")" = "$before" ]; }
wait_for 10 taken_back || fail "undo of the drag"

# A live camera, for which a recording stands in, and back.
click 154 14   # View
click 185 571  # The camera is
click 460 615  # A live camera
import -window root "$out/live_dialog.png"
fill 720 448 "$project/places/maquette/handheld.mp4"
shown=$(part $picture)
click 912 535  # Show
xdotool mousemove 700 780
wait_for 60 is_other $picture "$shown" || fail "no live picture"
sleep 8
shown=$(part $picture)
wait_for 10 is_other $picture "$shown" || fail "the live picture stands"
import -window root "$out/live.png"
click 746 690  # End
xdotool mousemove 700 780
settle
shown=$(part $picture)
sleep 1
is_part $picture "$shown" || fail "the recording is not back"
import -window root "$out/back.png"
quit
grep -q handheld "$out/editor.log" && fail "it complained: $(cat "$out/editor.log")"
"$editor" check "$project" > "$out/check.txt" 2>&1
grep -q "fewer than two images" "$out/check.txt" && fail "the corners are not located: $(cat "$out/check.txt")"
echo "passed; screenshots: $out/wipe.png $out/wiped.png $out/onion.png $out/corners.png $out/drawn.png $out/live.png"
