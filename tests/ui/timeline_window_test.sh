#!/bin/bash
# Drives the timeline with real input events: goes to it from a check, scrubs, adds, chooses, drags,
# trims, copies, pastes, deletes, undoes; chooses several and folds by keys; edits the file by hand
# beside it; types in the script. Looks at drama.lua and at screenshots.
#
#   timeline_window_test.sh EDITOR OUTPUT_FOLDER
set -u
. "$(dirname "$0")/window.sh"
need identify compare
begin_test "$0" "$@"
script=$project/drama.lua

# script_has REGEX WHAT: saves until the script holds it.
script_has() {
  for ((n = 0; n < 6; ++n)); do
    press ctrl+s
    grep -qE "$1" "$script" && return 0
  done
  cat "$script"
  fail "$2"
}

# The opposite: saves until it is gone.
script_has_not() {
  for ((n = 0; n < 6; ++n)); do
    press ctrl+s
    grep -qE "$1" "$script" || return 0
  done
  cat "$script"
  fail "$2"
}

"$editor" new "$project" > /dev/null || fail "cannot make a project"
cat > "$script" << 'LUA'
-- What is said, when.
track{actor = "keeper",
  speech = {
    {id = "hail", at = 2, length = 3, line = "salvete"},  -- to all
    {id = "ask", at = 8, length = 2, line = "quid"},
  },
}
track{markers = {{at = 12, name = "noon"}}}
LUA
open_window 700 300 "$project"
settle
import -window root "$out/timeline.png"

# What a check found leads to the item that it is about, which keys then mean.
press F7
click 394 640  # Check the saved project
sleep 4
click 311 748  # there is no line 'quid'
import -window root "$out/checked.png"
press Delete
script_has_not 'id = "ask"' "the check did not lead to its item"
script_has 'id = "hail"' "the check led to another item"
press ctrl+z
script_has 'id = "ask", at = 8, length = 2' "undo of deleting it"
xdotool mousemove 700 300

# Times on the screen: the first view shows all of the drama.
left=196
per_second=72.1
x_of() { awk -v t="$1" -v l=$left -v s=$per_second 'BEGIN {printf "%d", l + t * s}'; }
speech=640
ruler=577

# Drags are snapped; far from everything they are not. One drag is one command.
drag "$(x_of 3)" $speech "$(x_of 4.5)" $speech
script_has 'id = "hail", at = 3\.[3-7][0-9]*, length = 3, line = "salvete"\},  -- to all' "the drag"
press ctrl+z
script_has 'id = "hail", at = 2, length = 3' "undo of the drag"
press ctrl+shift+z
script_has 'id = "hail", at = 3\.[3-7]' "redo of the drag"
press ctrl+z

# To the end of another item: snapped, to the millisecond.
drag "$(x_of 8.9)" $speech "$(x_of 5.95)" $speech
script_has 'id = "ask", at = 5, length = 2' "the drag that snaps"
press ctrl+z

# The end of an item.
drag "$(x_of 4.97)" $speech "$(x_of 6.5)" $speech
script_has 'id = "hail", at = 2, length = 4\.[0-9]+' "the end was not trimmed"
press ctrl+z

# A click scrubs; a marker is set at the playhead, moved by a key, copied, deleted.
click "$(x_of 7)" $ruler
press m
script_has 'at = (6\.9|7)[0-9.]*, name = "marker"' "no marker at the playhead"
press alt+shift+Right
script_has 'at = (7\.9|8)[0-9.]*, name = "marker"' "the marker did not move"
press ctrl+d
[ "$(grep -c 'name = "marker"' "$script")" -eq 1 ] || fail "saved before it was told"
script_has 'at = (8\.[4-9]|9)[0-9.]*, name = "marker"' "no copy"
press Delete
script_has_not 'at = (8\.[4-9]|9)[0-9.]*, name = "marker"' "the copy was not deleted"
script_has 'at = (7\.9|8)[0-9.]*, name = "marker"' "delete took the other one too"

# With ripple, what comes later moves along.
press r
drag "$(x_of 3)" $speech "$(x_of 4.5)" $speech
script_has 'id = "ask", at = 9\.[0-9]+' "ripple left what comes later"
press r
import -window root "$out/edited.png"

# By keys: one more is chosen along the lane, both go at once; lanes are folded and unfolded.
same() { [ "$(difference "$1" "$2")" -lt 100 ]; }
click "$(x_of 4.5)" $speech
press ctrl+shift+Right
shot both
press Delete
script_has_not 'id = "ask"' "Shift did not add the next item to what is chosen"
script_has_not 'id = "hail"' "Shift chose another item in place of the first"
press ctrl+z
script_has 'id = "hail"' "undo of deleting two"
click "$(x_of 4.5)" $speech
xdotool mousemove 700 300 sleep 0.5
still unfolded
press f
still folded
same unfolded folded && fail "F does not fold the lanes"
press f
still again
same unfolded again || fail "F does not unfold the lanes"
press shift+f
press shift+f
still all
same unfolded all || fail "Shift+F does not fold and unfold all lanes"

# A hand edits the file: the timeline shows it, and undo takes it back.
press ctrl+s
sed -i 's/name = "noon"/name = "evening"/' "$script"
sleep 3
press ctrl+z
script_has 'name = "noon"' "undo of what was changed outside"

# The script: F6, typed at its end.
press F6
click 700 700
press ctrl+End
xdotool type --delay 60 -- '-- typed'
sleep 1.5
script_has '^-- typed' "what was typed"
import -window root "$out/script.png"
press ctrl+z
script_has_not '^-- typed' "undo of typing"

quit
echo "passed; screenshots: $out/timeline.png $out/edited.png $out/script.png"
