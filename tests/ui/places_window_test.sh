#!/bin/bash
# Two places of one drama: check points that were picked at both tell that the stage lies wrongly at
# the second, it is laid by them there, undo takes that back; a further point is added and clicked;
# a place is removed and comes back. Looks at the saved project, by the subcommand too, and at
# screenshots.
#
#   places_window_test.sh EDITOR OUTPUT_FOLDER MAKE_ROOM_MAP
set -u
make_room_map=$3

. "$(dirname "$0")/window.sh"
need identify
begin_test "$0" "$@"

# verdict PLACE WORD: what the subcommand says of the saved project.
verdict() { "$editor" check-points "$project" --place "$1" | grep -q "^check points: $2"; }
place_count() { [ "$(grep -c '"camera_nudge"' "$json")" -eq "$1" ]; }

place() {
  cat << JSON
{"name": "$1", "camera_nudge": [0, 0, 0], "occluders": [],
 "adjust": {"translation": [$2, 0, 0], "rotation": [1, 0, 0, 0], "scale": 1},
 "picks": {"origin": [], "forward": [], "floor": [], "length_from": [], "length_to": [],
           "length_m": 1}}
JSON
}
"$editor" new "$project" > /dev/null || fail "cannot make a project"
echo "{\"schema\": 1, \"title\": \"Test\", \"credits\": \"\", \"cast\": [],
      \"places\": [$(place maquette 0), $(place site 0.2)]}" > "$json"
for name in maquette site; do
  "$make_room_map" "$project/places/$name/scene.larscene" || fail "cannot make a map"
done

# point NAME PIXEL PIXEL: where the images 0 and 8 of the room show one point of it.
point() {
  "$editor" check-points "$project" --set "$1" --at 0,0,0 > /dev/null
  for name in maquette site; do
    "$editor" check-points "$project" --place $name --pick "$1" --frame 0.png --pixel "$2" \
      > /dev/null
    "$editor" check-points "$project" --place $name --pick "$1" --frame 8.png --pixel "$3" \
      > /dev/null
  done
  "$editor" check-points "$project" --place maquette --set "$1" --here > /dev/null
}
point left 222.7,324.0 208.0,318.2
point right 437.3,304.9 433.2,317.9
point top 309.0,154.9 346.2,143.8
point near 426.8,259.1 341.7,280.2
verdict maquette good || fail "the stage does not lie at the maquette as it does at the maquette"
verdict site poor || fail "a stage pushed aside is good"

open_window 700 780 "$project"
settle
press F8       # the messages leave the most room above
click 90 169   # the second place
sleep 3
click 90 515   # the first check point
import -window root "$out/poor.png"
click 1258 586  # Lay the stage by the points
press ctrl+s
wait_for 10 verdict site good || fail "the stage was not laid by the points"
verdict maquette good || fail "laying the site's stage moved the maquette's"
import -window root "$out/good.png"
press ctrl+z
press ctrl+s
wait_for 10 verdict site poor || fail "undo did not take the laying back"

# A further point, clicked in one image: Enter in the name adds nothing, the button does.
click 207 488
xdotool type --delay 60 "door"
click 912 524
click 700 300
press ctrl+s
wait_for 10 grep -q '"name": "door"' "$json" || fail "no point was added"
import -window root "$out/picked.png"

click 90 169
sleep 1
import -window root "$out/place.png"
quit
echo "passed; screenshots: $out/poor.png $out/good.png $out/picked.png"
