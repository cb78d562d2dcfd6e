#!/bin/bash
# Films a place with a camera, for which a recording stands in, and presses "Train from it" when that
# is over: the recording is kept in the project, the place is trained from it, and the window shows it.
#
#   film_window_test.sh EDITOR OUTPUT_FOLDER VIDEO
set -u
video=$3

. "$(dirname "$0")/window.sh"
need convert identify ffmpeg
begin_test "$0" "$@"
# Few and small images train in a sixth of the time.
ffmpeg -v error -y -i "$video" -vf scale=320:-2,fps=10 "$out/small.mp4"
film=$project/places/tavern/film-1.mp4
map=$project/places/tavern/scene.larscene

# Colours in the middle of the camera view, which is of one colour as long as there is no picture.
colours() {
  import -window root "$out/now.png"
  convert "$out/now.png" -crop 300x200+500+150 +repage -format %k info:
}
shows_picture() { [ "$(colours)" -gt 2000 ]; }

"$editor" new "$project" > /dev/null || fail "cannot make a project"
open_window 700 780 "$project"
settle
shot empty
shows_picture && fail "a project without a place shows a picture"
click 37 44    # Train
click 720 540  # Film it with a camera instead
shot start
fill 720 416 tavern
fill 720 479 "$out/small.mp4"
click 912 567  # Film
sleep 6        # all of the recording, at its own pace
shot filming
[ -e "$map" ] && fail "there is a map before anything was filmed"
click 1153 735  # Train from it
wait_for 30 test -s "$film" || fail "the recording was not kept"
press ctrl+s
named() { tr -d ' \n' < "$json" | grep -q '"video":"places/tavern/film-1.mp4"'; }
shot training
wait_for 500 test -s "$map" || fail "the place was not trained"
press ctrl+s
wait_for 20 named || fail "the project does not name the recording: $(tr -d ' \n' < "$json")"
wait_for 60 shows_picture || fail "the place is not shown: $(colours) colours"
shot trained
press Escape  # the training's report
quit
echo "passed; screenshots: $out/filming.png $out/trained.png"
