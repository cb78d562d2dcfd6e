#!/bin/bash
# Steps through the recording in the camera view by keys, one frame on and back to the very same
# picture, and not before the first one. Compares what is seen.
#
#   frames_window_test.sh EDITOR OUTPUT_FOLDER MAKE_ROOM_MAP VIDEO
set -u
make_room_map=$3
video=$4

. "$(dirname "$0")/window.sh"
need import
begin_test "$0" "$@"

# The picture as a number that says whether it is the same.
picture() { import -window root -crop 600x300+400+150 +repage rgb:- | sha256sum | cut -c 1-16; }
is_picture() { [ "$(picture)" = "$1" ]; }
is_other() { [ "$(picture)" != "$1" ]; }

new_project_with_place
cp "$video" "$out/film.mp4"
sed -i "s|\"name\": \"site\",|\"name\": \"site\", \"training\": {\"video\": \"$out/film.mp4\"},|" "$json"
"$make_room_map" "$project/places/site/scene.larscene" || fail "cannot make a map"
open_window 700 780 "$project"
blank=$(picture)
wait_for 60 is_other "$blank" || fail "no picture"
settle
first=$(picture)
press period
wait_for 10 is_other "$first" || fail "no frame after the first"
sleep 2
second=$(picture)
press period
wait_for 10 is_other "$second" || fail "no frame after the second"
press comma
wait_for 10 is_picture "$second" || fail "one frame back is not the frame before"
press comma
wait_for 10 is_picture "$first" || fail "two frames back is not where it began"
shot back
press comma
sleep 2
is_picture "$first" || fail "there is a frame before the first"
quit
echo "passed; screenshots: $out/back.png"
