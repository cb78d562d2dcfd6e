#!/bin/bash
# The ways of walks on the floor, around the place: shown of who is selected, an end dragged, an
# end moved by keys, a drag taken back by Escape. Looks at drama.lua and at screenshots.
#
#   walks_window_test.sh EDITOR OUTPUT_FOLDER MAKE_ROOM_MAP
set -u
make_room_map=$3

. "$(dirname "$0")/window.sh"
need compare convert
begin_test "$0" "$@"
script=$project/drama.lua

# The saved end of the walk, x and z.
saved_end() {
  press ctrl+s
  grep -oE 'to = \{[^}]*\}' "$script" | grep -oE '\b[xz] = -?[0-9.]+' | grep -oE -- '-?[0-9.]+$' | xargs
}
# end_is X Z TOLERANCE
end_is() {
  saved_end | awk -v x="$1" -v z="$2" -v most="$3" \
    '{dx = $1 - x; dz = $2 - z; exit !(dx * dx < most * most && dz * dz < most * most)}'
}

new_project_with_place
sed -i 's/"cast": \[\]/"cast": [{"name": "keeper", "height": 1.7, "tunic": [0.5, 0.3, 0.2]}]/' "$json"
"$make_room_map" "$project/places/site/scene.larscene" 1500 2 || fail "cannot make a map"
cat > "$script" << 'LUA'
track{actor = "keeper",
  walks = {
    {at = 0, from = {x = -0.6, z = 0.4, heading = 90}},
    {at = 0.5, to = {x = 0.6, z = 0.2, heading = 180}, id = "along"},
  },
}
LUA
open_window 1300 880 "$project"
settle
press 2
still before
click 90 416  # the keeper, in the list at the left
xdotool mousemove 1300 880
wait_for 10 differs before person 100 || fail "nothing is shown of who is selected"
click 633 626  # the walk, in the timeline
xdotool mousemove 1300 880
# Its way is drawn where the stage was empty, once the drama was played through.
way_is_drawn() {
  import -window root -crop 30x14+620+364 "$out/way.png"
  convert "$out/way.png" -fuzz 12% -fill lime -opaque '#48a8e4' -fill black +opaque lime \
    -format '%[fx:mean.g*w*h]' info: | awk '{exit !($1 > 30)}'
}
wait_for 60 way_is_drawn || fail "no way is drawn"
shot chosen

# Dragged: one edit.
drag 672 384 640 420
shot dragged
wait_for 10 end_is 0.68 0.99 0.08 || fail "the end was not dragged: $(saved_end)"
dragged=$(saved_end)

# Taken back while it is dragged.
xdotool mousemove 640 420 sleep 0.4 mousedown 1 sleep 0.3 mousemove 690 400 sleep 0.5
shot dragging
press Escape
xdotool mouseup 1 sleep 0.5
[ "$(saved_end)" = "$dragged" ] || fail "Escape did not take the drag back: $(saved_end)"

# By keys, after a click on it.
click 640 420
press Right
press shift+Right
by_keys=$(saved_end)
echo "$dragged $by_keys" |
  awk '{d = ($3 - $1) + ($4 - $2); if (d < 0) d = -d; exit !(d > 0.105 && d < 0.115)}' ||
  fail "keys move it from $dragged to $by_keys"
press ctrl+z
press ctrl+z
[ "$(saved_end)" = "$dragged" ] || fail "undo of the keys: $(saved_end)"
press ctrl+z
[ "$(saved_end)" = "0.6 0.2" ] || fail "undo of the drag: $(saved_end)"
quit
echo "passed; screenshots: $out/chosen.png $out/dragging.png $out/dragged.png"
