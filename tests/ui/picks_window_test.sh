#!/bin/bash
# The picks of the stage's origin in three images: gone through by keys and by the arrows beside the
# slider, listed in the inspector, one of them removed by Delete, by its button and by the keyboard
# in the list, each time brought back by undo. Looks at the saved project and at screenshots.
#
#   picks_window_test.sh EDITOR OUTPUT_FOLDER MAKE_ROOM_MAP
set -u
make_room_map=$3

. "$(dirname "$0")/window.sh"
need compare
begin_test "$0" "$@"

# The images that the project on the disk has picks in.
images() { tr -d ' \n' < "$json" | grep -o '"frame":"[^"]*"' | sed 's/.*:"//; s/"//' | sort -n | xargs; }
has_picks_in() { [ "$(images)" = "$1" ]; }
# picked IMAGES WHAT: saves until that is so.
picked() {
  for ((n = 0; n < 8; ++n)); do
    press ctrl+s
    has_picks_in "$1" && return 0
  done
  fail "$2: $(images)"
}
all="0.png 4.png 8.png"
same() { [ "$(difference "$1" "$2")" -lt 100 ]; }

new_project_with_place
"$make_room_map" "$project/places/site/scene.larscene" || fail "cannot make a map"
"$editor" stage "$project" --pick origin=0.png,320,300 --pick origin=4.png,300,310 \
  --pick origin=8.png,280,300 > /dev/null || fail "cannot pick"
has_picks_in "$all" || fail "picked in $(images)"

open_window 700 780 "$project"
settle
press F8  # the messages leave the most room above
click 42 234  # Picks
press 3
still first

# To the next image that has a pick and back, as if each were sought; the ends hold.
press Next
still next
same first next && fail "Page Down does not go to the next picked image"
press Left
press Next
still sought
same next sought || fail "Page Down does not go to the nearest one after"
press Prior
press Prior
still back
same first back || fail "Page Up does not go back"

# Delete removes the pick in the image that is shown, and that one alone.
press Next
press Delete
picked "0.png 8.png" "Delete"
still deleted
press ctrl+z
picked "$all" "undo of Delete"

# In the list: a click shows the image, the button removes the pick.
click 1200 456
xdotool mousemove 700 780
still listed
same listed back && fail "a click in the list does not show its image"
click 1404 456
picked "0.png 4.png" "the button of the last pick"
press ctrl+z
picked "$all" "undo of the button"

# By the keyboard alone: the last row lies above the button that clears them all.
press ctrl+shift+Tab
press ctrl+Tab
press End
press Up
shot walked
press Delete
picked "0.png 4.png" "Delete in the list"
press ctrl+z
picked "$all" "undo of Delete in the list"
quit
echo "passed; screenshots: $out/first.png $out/deleted.png $out/listed.png"
