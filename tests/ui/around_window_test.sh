#!/bin/bash
# The map in the view around the place: turned, moved and brought back by keys, points in other colours, a keyframe below the pointer and
# in Picks, a point and a distance, the scale by a known one with undo, a drag in steps, a session
# taken out of the map. Looks at the saved project and at screenshots.
#
#   around_window_test.sh EDITOR OUTPUT_FOLDER MAKE_ROOM_MAP
set -u
make_room_map=$3

. "$(dirname "$0")/window.sh"
need identify convert compare
begin_test "$0" "$@"

# adjust FIELD: of the saved stage, without spaces.
adjust() {
  tr -d ' \n' < "$json" | sed -E 's/.*"adjust":\{([^}]*)\}.*/\1/' |
    sed -E "s/.*\"$1\":(\[[^]]*\]|[^,]*).*/\1/"
}
scale_is_about() { adjust scale | awk -v w="$1" '{exit !($1 > w * 0.98 && $1 < w * 1.02)}'; }
# The view's part of a screenshot has colours, not only greys.
is_coloured() {
  convert "$1" -crop 600x300+400+250 -colorspace HSL -channel G -separate -format '%[fx:mean]' info: |
    awk '{exit !($1 > 0.1)}'
}

"$editor" new "$project" > /dev/null || fail "cannot make a project"
cat > "$json" << JSON
{"schema": 1, "title": "Test", "credits": "", "cast": [], "places": [{
  "name": "site", "camera_nudge": [0, 0, 0], "occluders": [],
  "training": {"video": "morning.mp4"}, "added": [{"source": {"video": "evening.mp4"}}],
  "adjust": {"translation": [0, 0, 0], "rotation": [1, 0, 0, 0], "scale": 1},
  "picks": {"origin": [], "forward": [], "floor": [], "length_from": [], "length_to": [],
            "length_m": 1}}]}
JSON
"$make_room_map" "$project/places/site/scene.larscene" 1500 2 || fail "cannot make a map"
scene=$project/places/site/scene.larscene
before=$(stat -c %s "$scene")
open_window 700 780 "$project"
settle
press F8  # the messages leave the most room above
press 2
sleep 2
import -window root "$out/picture.png"

# By keys round the place, past it and nearer; Home and a button lead back to the stage.
same() { [ "$(difference "$1" "$2")" -lt 100 ]; }
still first
for key in Left Up shift+Right Prior; do
  press $key
  still "$key"
done
for pair in "first Left" "Left Up" "Up shift+Right" "shift+Right Prior"; do
  same $pair && fail "a key does not change the view: $pair"
done
press Home
still home
same first home || fail "Home does not look at the stage as at first"
press shift+Home
still map
same home map && fail "Shift+Home does not look at all of the map"
click 349 170  # Look at: Stage
xdotool mousemove 700 780
still button
same first button || fail "the button does not look at the stage as at first"

for colours in error views sessions; do
  press c
  sleep 0.5
  import -window root "$out/$colours.png"
done
is_coloured "$out/error.png" || fail "points by error are grey"
is_coloured "$out/sessions.png" || fail "points by session are grey"

# A camera: its picture beside the pointer, and a click shows it among the picks.
xdotool mousemove 527 642 sleep 1
import -window root "$out/keyframe.png"
click 527 642
import -window root "$out/picks.png"
press 2

# A point, and with Shift the other end of a distance.
click 601 343
import -window root "$out/point.png"
press v
still looked_at
same point looked_at && fail "V does not look at the chosen point"
press Home
sleep 1
xdotool keydown shift
click 622 616
xdotool keyup shift
sleep 0.5
import -window root "$out/distance.png"

# The distance is typed, and the stage scaled by it: one command.
fill 960 558 2
hold Return
click 917 624
import -window root "$out/scaled.png"
press ctrl+s
wait_for 10 scale_is_about 1.34 || fail "the scale is $(adjust scale)"
press ctrl+z
press ctrl+s
wait_for 10 scale_is_about 1 || fail "undo of the scale: $(adjust scale)"
press Escape
sleep 0.5
import -window root "$out/unselected.png"

# The stage's X arrow, dragged in steps of 5 cm.
xdotool keydown ctrl
drag 705 524 757 546
xdotool keyup ctrl
press ctrl+s
in_steps() {
  adjust translation | tr -d '[]' |
    awk -F, '{s = $1 / 0.05; r = s - int(s + 0.5); exit !(s > 0.5 && r * r < 1e-8 && $2 * $2 < 1e-8)}'
}
wait_for 10 in_steps || fail "the drag in steps: $(adjust translation)"

# The added session goes, after a question.
click 37 147
import -window root "$out/place.png"
click 1307 545
import -window root "$out/question.png"
click 1176 646
smaller() { [ "$(stat -c %s "$scene")" -lt "$before" ]; }
wait_for 20 smaller || fail "the map has all its sessions"
sleep 2
import -window root "$out/removed.png"
forgotten() { ! grep -q evening "$json"; }
press ctrl+s
wait_for 10 forgotten || fail "the project still names the session"
press ctrl+z
press ctrl+s
sleep 1
forgotten || fail "undo brought a session back that the map has no more"
quit
echo "passed; screenshots: $out/*.png"
