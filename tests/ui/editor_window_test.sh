#!/bin/bash
# Drives the editor's window with real input events: types a number, drags a
# handle, undoes, redoes, saves, quits; then edits, crashes and recovers; then lays
# the stage on the floor of a map. Looks at the saved project and at a screenshot.
#
#   editor_window_test.sh EDITOR OUTPUT_FOLDER MAKE_ROOM_MAP
set -u
make_room_map=$3

. "$(dirname "$0")/window.sh"
need identify
begin_test "$0" "$@"

# The numbers of "adjust.translation" in a project file, on one line.
translation() {
  tr -d ' \n' < "$1" | sed -E 's/.*"adjust":\{[^}]*"translation":\[([^]]*)\].*/\1/'
}
translation_is() { [ "$(translation "$json")" = "$1" ]; }

start_editor() {
  open_window 700 780 "$project"
  settle
  xdotool key F8 sleep 1  # the messages leave the most room above
}


new_project_with_place

# A number typed into the inspector: the X of the stage's position.
start_editor
type_into 1241 134 1.25
press ctrl+s
wait_for 10 translation_is "1.25,0.0,0.0" || fail "the number was not saved: $(translation "$json")"
press ctrl+z
press ctrl+s
wait_for 10 translation_is "0.0,0.0,0.0" || fail "undo was not saved: $(translation "$json")"
press ctrl+shift+z
press ctrl+s
wait_for 10 translation_is "1.25,0.0,0.0" || fail "redo was not saved: $(translation "$json")"

# Credits wrap as they are typed, without a sign of it in the file; a letter is deleted across
# rows; and undo works in the field.
credits_are() { grep -q "\"credits\": \"$1\"" "$json"; }
click 47 82     # Project
click 1330 190  # its credits
xdotool type --delay 60 "Frescoes photographed by the museum, voices by the theatre of the town"
xdotool key --delay 200 Home BackSpace  # the space between two rows
sleep 0.5
import -window root "$out/credits.png"
press ctrl+s
wait_for 10 credits_are "Frescoes photographed by the museum, voices by thetheatre of the town" ||
  fail "credits: $(grep credits "$json")"
press ctrl+z
press ctrl+s
wait_for 10 credits_are "" || fail "undo of the credits: $(grep credits "$json")"
click 47 216  # the stage

# The upward arrow of the stage's handles, dragged up in the view around the place.
press ctrl+z
press 2
sleep 1
import -window root "$out/around.png"
xdotool mousemove 664 344 sleep 0.3 mousedown 1 sleep 0.3
xdotool mousemove 664 324 sleep 0.2 mousemove 664 294 sleep 0.3 mouseup 1
sleep 0.5
press ctrl+s
raised() { translation "$json" | awk -F, '{exit !($1 == 0 && $2 > 0.2 && $2 < 2 && $3 == 0)}'; }
wait_for 10 raised || fail "the drag did not raise the stage: $(translation "$json")"

# One drag is one command.
press ctrl+z
press ctrl+s
wait_for 10 translation_is "0.0,0.0,0.0" || fail "undo of the drag: $(translation "$json")"

colours=$(identify -format %k "$out/around.png")
[ "$colours" -gt 100 ] || fail "the screenshot is blank: $colours colours"

# Quitting ends the program well.
quit

# A crash loses nothing: the camera nudged by a key, killed, started again.
start_editor
press Right
wait_for 10 test -e "$project/journal" || fail "no journal"
sleep 0.5
kill -KILL $pid
wait $pid 2> /dev/null
start_editor
press ctrl+s
nudged() { tr -d ' \n' < "$json" | grep -q '"camera_nudge":\[0.005,0.0,0.0\]'; }
wait_for 10 nudged || fail "the edit was not recovered"
wait_for 10 test ! -e "$project/journal" || fail "the journal stayed after saving"
quit

# A map with a floor: nothing is picked, so the stage stands on it but for what
# was moved by hand. F lays it down; undo lifts it again.
"$make_room_map" "$project/places/site/scene.larscene" || fail "cannot make a map"
sed -i -z -E 's/("translation": *\[)[^]]*\]/\10, 0.5, 0]/' "$json"
start_editor
press f
press ctrl+s
laid() { translation "$json" | awk -F, '{exit !($2 > -0.001 && $2 < 0.001)}'; }
for ((i = 0; i < 10; ++i)); do  # the map may still be opening
  laid && break
  press f
  press ctrl+s
done
laid || fail "the stage was not laid on the floor: $(translation "$json")"
press 2
sleep 1
import -window root "$out/floor.png"
press ctrl+z
press ctrl+s
wait_for 10 translation_is "0.0,0.5,0.0" || fail "undo of laying: $(translation "$json")"
quit
echo "passed; screenshot: $out/around.png"
