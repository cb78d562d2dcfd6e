#!/bin/bash
# Opens a project whose files are somewhere else: the window lists them, one is located, the
# other that made the same move comes along, and undo takes both back. Looks at the saved
# project and at screenshots.
#
#   missing_window_test.sh EDITOR OUTPUT_FOLDER MODEL
set -u
model=$3

. "$(dirname "$0")/window.sh"
need identify
begin_test "$0" "$@"

names() { grep -q "$1" "$json"; }

mkdir -p "$out/new/film" "$out/new/models"
cp "$model" "$out/new/models/counter.glb"
echo "no video" > "$out/new/film/walk.mp4"  # it is there: that is all that is looked at
"$editor" new "$project" > /dev/null || fail "cannot make a project"
cat > "$json" << JSON
{"schema": 1, "title": "Test", "credits": "", "cast": [], "places": [{
  "name": "site", "camera_nudge": [0, 0, 0], "training": {"video": "$out/old/film/walk.mp4"},
  "occluders": [{"name": "counter", "file": "$out/old/models/counter.glb",
                 "translation": [0, 0, 0], "rotation": [1, 0, 0, 0], "scale": 1}],
  "adjust": {"translation": [0, 0, 0], "rotation": [1, 0, 0, 0], "scale": 1},
  "picks": {"origin": [], "forward": [], "floor": [], "length_from": [], "length_to": [],
            "length_m": 1}}]}
JSON
open_window 700 300 "$project"
settle
import -window root "$out/missing.png"

click 55 695
click 700 443
hold ctrl a
xdotool type --delay 40 "$out/new/film/walk.mp4"
sleep 1
import -window root "$out/located.png"
click 962 563
press ctrl+s
wait_for 10 names "$out/new/film/walk.mp4" || fail "the recording was not located"
names "$out/new/models/counter.glb" || fail "what moved along did not come along"
import -window root "$out/after.png"
press ctrl+z
press ctrl+s
wait_for 10 names "$out/old/film/walk.mp4" || fail "undo did not take it back"
names "$out/old/models/counter.glb" || fail "undo took one of the two back only"
quit
echo "passed; screenshots: $out/missing.png $out/located.png"
