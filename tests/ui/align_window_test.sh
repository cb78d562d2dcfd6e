#!/bin/bash
# Aligns an occluder's model: a corner is clicked on the model and then in two training images, the
# model is laid by that and three more pairs, refined on the map's points, and both are taken back.
# Looks at the saved project, by the subcommand too, and at screenshots.
#
#   align_window_test.sh EDITOR OUTPUT_FOLDER MAKE_ROOM_MAP
set -u
make_room_map=$3

. "$(dirname "$0")/window.sh"
need identify
begin_test "$0" "$@"

# The room's floor and back wall in centimetres, as the map has them.
new_project_with_place
"$make_room_map" "$project/places/site/scene.larscene" || fail "cannot make a map"
cat > "$project/room.obj" << OBJ
v -150 -100 -150
v 150 -100 -150
v 150 100 -150
v -150 100 -150
v -150 -100 150
v 150 -100 150
v 0 -100 50
f 1 2 3
f 1 3 4
f 5 7 1
f 1 7 2
f 2 7 6
f 6 7 5
OBJ
sed -i 's|"occluders": \[\]|"occluders": [{"name": "room", "file": "room.obj", "scale": 0.0085, "translation": [0.3, 1.1, -0.2], "rotation": [0.995, 0, 0.0998749, 0]}]|' "$json"
align() { "$editor" align "$project" --occluder room "$@"; }
align --pair 150,100,-150 --pick 0.png,376.3,164.6 --pick 8.png,518.1,120.6 > /dev/null &&
  align --pair -150,100,-150 --pick 0.png,84.2,127.8 --pick 8.png,213.1,129.3 > /dev/null &&
  align --pair 0,-100,50 --pick 0.png,360.3,386.7 --pick 8.png,304.5,394.4 > /dev/null ||
  fail "cannot add pairs"

pairs() { grep -c on_mesh "$json"; }
has_pairs() { [ "$(pairs)" -eq "$1" ]; }
# off CENTIMETRES: whether all pairs are at most that far off, as the subcommand has it.
off() {
  align --json | tr -d ' ' | grep '"rms_cm"' | sed 's/[^0-9.]//g' |
    awk -v most="$1" '{ exit !($1 <= most) }'
}
off 5 && fail "the model lies well before it is aligned"

open_window 700 780 "$project"
settle
press F8
click 60 365   # the occluder
click 673 44   # Around the place
sleep 1
import -window root "$out/before.png"

# Escape ends adding: the click then takes no point.
click 1263 440  # Add a point
press Escape
click 838 440
press ctrl+s
sleep 1
has_pairs 3 || fail "a point was added after Escape"
press Escape

# A corner of the model, then the same point in two images.
click 1263 440  # Add a point
xdotool mousemove 836 438
sleep 1
import -window root "$out/adding.png"
click 838 440
press ctrl+s
wait_for 10 has_pairs 4 || fail "$(pairs) pairs after a click on the model"
sleep 1
import -window root "$out/picking.png"
click 733 514
click 757 690  # the slider, to image 8
click 892 499
click 1263 587  # Align by the points
press ctrl+s
wait_for 10 off 3 || fail "the model was not laid by the points"
import -window root "$out/aligned.png"
laid=$(tr -d ' \n' < "$json")
click 1263 672  # Refine on the map
refined() { press ctrl+s; [ "$(tr -d ' \n' < "$json")" != "$laid" ]; }
wait_for 10 refined || fail "the model was not refined"
off 5 || fail "refining led the model away"
import -window root "$out/refined.png"
press ctrl+z
press ctrl+z
press ctrl+s
back() { has_pairs 4 && ! off 5; }
wait_for 10 back || fail "undo did not take both back"
quit
echo "passed; screenshots: $out/adding.png $out/picking.png $out/aligned.png $out/refined.png"
