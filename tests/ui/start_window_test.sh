#!/bin/bash
# Drives the start page with real input events: opens a recent project, goes back, locates one
# that was moved, forgets one by the mouse and one by keys, makes one from a video.
# Looks at the window's title, at the list on the disk and at screenshots.
#
#   start_window_test.sh EDITOR OUTPUT_FOLDER VIDEO
set -u
video=$3

. "$(dirname "$0")/window.sh"
need identify
begin_test "$0" "$@"
export HOME=$out/home XDG_DATA_HOME=$out/data
mkdir -p "$HOME"
recent=$XDG_STATE_HOME/lararium/recent.json

start_editor() {
  open_window 1300 860 "$@"
  settle
}
# The folders of the list, newest first.
listed() { tr -d ' \n' < "$recent" | grep -oE '"folder":"[^"]*"' | sed 's/.*\///; s/"//' | xargs; }
lists() { [ "$(listed)" = "$1" ]; }

for name in first second third; do
  "$editor" new "$out/$name.lararium" --title "The $name" > /dev/null || fail "no project"
  start_editor "$out/$name.lararium"
  quit
done
lists "third.lararium second.lararium first.lararium" || fail "the list: $(listed)"
mv "$out/second.lararium" "$out/moved.lararium"
rm -r "$out/first.lararium"

# Opened by a click, left by a key.
start_editor
titled "Lararium$" || fail "this is not the start page"
import -window root "$out/start.png"
colours=$(identify -format %k "$out/start.png")
[ "$colours" -gt 50 ] || fail "the screenshot is blank: $colours colours"
click 560 150
wait_for 20 titled "The third" || fail "the card did not open its project"
press ctrl+o
wait_for 20 titled "Lararium$" || fail "not back on the start page"
sleep 1

# One that is not there cannot be opened; it is located.
click 860 150
sleep 1
titled "Lararium$" || fail "a project that is not there was opened"
click 760 273
import -window root "$out/locate.png"
fill 760 448 "$out/moved.lararium"
import -window root "$out/located.png"
click 941 508
wait_for 5 lists "third.lararium moved.lararium first.lararium" || fail "not located: $(listed)"

# One that is gone is forgotten.
click 1132 273
wait_for 5 lists "third.lararium moved.lararium" || fail "not forgotten: $(listed)"
sleep 2.5
import -window root "$out/forgotten.png"

# By keys: from a card the ring goes to its Forget, which stays for it and is pressed.
quit
start_editor
press Down
press Right
press Down
import -window root "$out/ring.png"
press Return
wait_for 5 lists "moved.lararium" || fail "not forgotten by keys: $(listed)"

# New from a video: the training begins.
click 250 137
import -window root "$out/new.png"
fill 770 372 "tavern"
fill 740 435 "$out"
fill 740 497 "$video"
import -window root "$out/filled.png"
click 933 594
wait_for 20 titled "tavern" || fail "no project was made"
grep -q training "$out/tavern.lararium/project.json" || fail "the project was not saved"
lists "tavern.lararium moved.lararium" || fail "not in the list: $(listed)"
sleep 1
import -window root "$out/training.png"

# Leaving would stop the training: it is asked about. Enter and Escape stay.
for way in "press ctrl+o" "press ctrl+q"; do
  for stay in Return Escape; do
    $way
    shot asked
    press $stay
    sleep 0.5
    titled tavern || fail "$way, then $stay: the project was left"
  done
done
kill -0 $pid || fail "the training was stopped without a question"
press ctrl+o
click 780 498  # stop it and leave
wait_for 60 titled "Lararium$" || fail "not back on the start page"
quit

# A damaged list is told of, and does no harm.
echo '{"schema": 1, "recent": [' > "$recent"
start_editor
import -window root "$out/damaged.png"
[ -e "$recent.damaged" ] || fail "the damaged list was not moved aside"
quit
echo "passed; screenshots: $out/start.png $out/new.png"
