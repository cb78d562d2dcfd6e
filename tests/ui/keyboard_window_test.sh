#!/bin/bash
# Uses the editor without one event of a mouse: goes round the panels, chooses a person and makes
# them taller, opens menus and a dialog, cancels it and finds it as it was left, plays, undoes.
# Looks at the saved project and at screenshots.
#
#   keyboard_window_test.sh EDITOR OUTPUT_FOLDER
set -u
. "$(dirname "$0")/window.sh"
need compare
begin_test "$0" "$@"

# times COUNT KEY
times() { for ((n = 0; n < $1; ++n)); do press "$2"; done; }
# Opens the dialog that adds a check point, which is the last but one of the menu Place.
open_dialog() {
  press "$1"
  times 2 Right
  press Down
  times 2 Up
  press Return
  sleep 1
}

new_project_with_place
sed -i 's/"cast": \[\]/"cast": [{"name": "keeper", "height": 1.7, "tunic": [0.5, 0.3, 0.2]}]/' "$json"
echo 'track{markers = {{at = 6, name = "noon"}}}' > "$project/drama.lua"
"$editor" "$project" >> "$out/editor.log" 2>&1 &
pid=$!
wait_for 40 titled Test || fail "no window"
shot begin

# The list at the left lies before the view. Its last rows are a person and two buttons.
press ctrl+shift+Tab
wait_for 10 differs begin list 200 || fail "no ring is seen"
press End
times 2 Up
press Return
shot person

# What is chosen lies behind the view; its first field is how tall somebody is.
times 2 ctrl+Tab
press Tab
xdotool type --delay 80 1.9
press Return
shot field
saved '"height":1.9' "$json" "the field was not changed"

# A dialog from the menus, by Alt and by F10: Enter confirms, Escape cancels and keeps what was typed.
open_dialog Alt_L
xdotool type --delay 80 door
shot dialog
press Return
saved '"check_points":\[\{"name":"door"' "$json" "Enter did not confirm the dialog"
open_dialog F10
xdotool type --delay 80 window
press Escape
shot cancelled
saved '"check_points":\[\{"name":"door"[^}]*\}\]' "$json" "Escape did not cancel the dialog"
open_dialog F10
shot again
press Return
saved '"name":"window"' "$json" "the dialog has not what was typed before Escape"

# A panel is resized; how many skins the onion has is asked for over the camera's view.
press Escape
press ctrl+Tab
shot narrow
times 4 F4
wait_for 10 differs narrow wide 200 || fail "F4 does not make the inspector wider"
press Escape
press shift+k
wait_for 10 differs wide onion 200 || fail "Shift+K does not ask for the onion skin"
press Escape

# Back to the views, where Space plays.
press Escape
press F5
shot still
press space
wait_for 10 differs still playing 50 || fail "Space does not play"
press space

# All of it is undone.
times 3 ctrl+z
saved '"height":1.7' "$json" "undo of the field"
grep -q door "$json" && fail "undo of the dialog"
quit
# 96 more than it was; the state keeps it.
grep -q '"inspector":432' <(tr -d ' \n' < "$(find "$out/state" -name 'window*.json')") ||
  fail "the width of the inspector is not kept: $(cat "$(find "$out/state" -name 'window*.json')")"
echo "passed; screenshots: $out/list.png $out/field.png $out/dialog.png"
