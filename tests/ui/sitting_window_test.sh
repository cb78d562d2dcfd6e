#!/bin/bash
# A curator's whole sitting by real input events: a new project from a video, its training, the
# stage tied to the floor by picks and a known length, two occluders drawn on training images,
# somebody who walks behind the counter and speaks, the export, a visitor who chooses by looking,
# and the show in the player.
# Looks at the saved files and at screenshots.
#
#   sitting_window_test.sh EDITOR OUTPUT_FOLDER VIDEO MAKE_GAZE_VIDEO [OPENXR_RUNTIME]
set -u
video=$3
make_gaze_video=$4
openxr=${5:-}  # its manifest

. "$(dirname "$0")/window.sh"
need identify
begin_test "$0" "$@"
export HOME=$out/home XDG_DATA_HOME=$out/data
mkdir -p "$HOME"
project=$out/tavern.lararium
json=$project/project.json
script=$project/drama.lua

# The training image of that number, and the place on the screen of one of its pixels.
image() { type_into 620 690 "$1"; }
pixel() {
  awk -v u="$1" -v v="$2" \
    'BEGIN {printf "%d %d", 288.7 + (u + 0.5) * 1.1745, 106.2 + (v + 0.5) * 1.1745}'
}
pick() {
  image "$1"
  click $(pixel "$2" "$3")
}
# face IMAGE "U V"...: corners of an occluder.
face() {
  image "$1"
  shift
  for corner in "$@"; do
    click $(pixel $corner)
  done
}

# New from a video; the place is trained at once.
open_window 1300 860
settle
click 250 137
fill 770 372 "tavern"
fill 740 435 "$out"
fill 740 497 "$video"
click 933 594
wait_for 20 titled "tavern" || fail "no project was made"
wait_for 500 test -s "$project/places/tavern/scene.larscene" || fail "the place was not trained"
settle
shot report
press Escape  # the training's report
press F8  # the messages leave the most room above
shot trained

# The stage: each point in three training images, then a length that was measured.
click 783 44
click 284 87
pick 0 421 439
pick 71 201 441
pick 95 333 454
click 361 87
pick 8 412 415
pick 75 295 398
pick 107 170 406
click 437 87
pick 62 181 468
pick 78 413 455
pick 102 420 448
click 524 87
pick 72 124 374
pick 80 172 367
pick 96 111 424
click 624 87
pick 0 525 333
pick 4 574 337
pick 59 418 405
click 42 234
sleep 1
shot picked
type_into 1313 284 3.45
saved '"length_m":3.45' "$json" "the length was not saved"

# Two occluders: the counter, 0.6 m deep, and the table's top.
click 107 14
click 150 205
face 0 "152 278" "530 232" "525 333" "159 435"
face 92 "129 255" "568 254" "563 367" "131 386"
type_into 1313 134 0.6
click 107 14
click 150 205
face 62 "115 431" "561 468" "512 352" "205 336"
face 68 "249 401" "628 445" "580 357" "304 334"
shot drawn
saved '"depth":0.6.*"name":"face2"' "$json" "the occluders were not saved"
[ "$(tr -d ' \n' < "$json" | grep -o '"frame":"000068.png"' | wc -l)" -eq 4 ] ||
  fail "the table's corners were not saved"

# Somebody, from the presets by their picture.
click 206 424
click 618 388
click 912 608
saved '"preset":"keeper"' "$json" "the person was not added"

# A walk behind the counter, by numbers.
press 1
click 54 745  # the timeline
sleep 2
click 512 545
xdotool mousemove 575 586 sleep 1
click 705 651
type_into 1251 664 0.9
type_into 1335 664 -1.95
type_into 1310 696 180
type_into 1251 727 -0.9
type_into 1335 727 -1.95
type_into 1310 759 -90
saved 'to={heading=180,x=0.9,z=-1.95}' "$script" "where the walk goes was not saved"
saved 'from={heading=-90,x=-0.9,z=-1.95}' "$script" "where it begins was not saved"
wait_for 120 test -s "$project/cast/keeper.larhuman" || fail "the keeper was not baked"

# A line, in a language that is named first; its voice is made.
click 850 575
click 520 545
xdotool mousemove 570 586 sleep 1
click 705 630
click 1313 736
xdotool type --delay 60 la
hold Return
click 1313 715
xdotool type --delay 60 "Salvete, hospites! Quid bibitis?"
wait_for 20 grep -q '^keeper1,keeper,,"Salvete, hospites! Quid bibitis?"' "$project/lines.csv" ||
  fail "the line was not written"
wait_for 240 test -s "$project/speech/la/keeper1.flac" || fail "no voice was made"
settle
shot staged

# The export, signed with keys made for it; what is not saved yet goes in too.
click 368 44
sleep 1
shot export
click 928 377
click 912 651
wait_for 300 test -s "$out/tavern.larshow" || fail "nothing was exported"
settle
shot exported
player=${editor%editor}player
"$player" info "$out/tavern.larshow" > "$out/info.txt" || fail "the player cannot read it"
grep -q "^lines *1, spoken: la" "$out/info.txt" || fail "the line is not in the show"
"$player" "$out/tavern.larshow" --trust "$out/tavern.pub" --video "$video" --headless --audio none \
  --pace fast --frames 20 --record "$out/played.mp4" >> "$out/editor.log" 2>&1 ||
  fail "the player refuses the show"

# On a headset that is not there, where the runtime for it was built.
if [ -n "$openxr" ]; then
  XR_RUNTIME_JSON=$openxr LARARIUM_NULL_XR="log=$out/openxr.txt" "$player" "$out/tavern.larshow" \
    --video "$video" --audio none --display openxr --frames 10 >> "$out/editor.log" 2>&1 ||
    fail "the player does not play on a headset"
  grep -q "^quad eye both space room" "$out/openxr.txt" || fail "the headset shows nothing"
  grep -q "^end session" "$out/openxr.txt" || fail "the headset's session was not ended"
fi

# A visitor, who opens the menu and looks at the item that takes the captions away.
visit=("$player" "$out/tavern.larshow" --trust "$out/tavern.pub" --audio none)
"${visit[@]}" --video "$video" --headless --pace fast --poses-out "$out/poses.json" \
  >> "$out/editor.log" 2>&1 || fail "the player cannot follow the video"
"$make_gaze_video" "$out/tavern.larshow" "$video" "$out/poses.json" "$out/gaze.mp4" \
  >> "$out/editor.log" 2>&1 || fail "no visitor can be filmed who looks at the menu"
"${visit[@]}" --video "$out/gaze.mp4" --loop --kiosk --state "$out/kiosk" >> "$out/editor.log" 2>&1 &
kiosk=$!
wait_for 60 titled "tavern$" || fail "the kiosk did not open"
sleep 3
xdotool windowfocus "$(xdotool search --name "^tavern$" | tail -1)" sleep 0.5
# A visitor who opens it in the wrong moment looks past it, and opens it again when it has gone.
look_at_menu() {
  press m
  shot menu
  wait_for 4 grep -q '"captions": "off"' "$out/kiosk/state.json"
}
for ((looks = 0; looks < 9; ++looks)); do
  look_at_menu && break
done
((looks < 9)) || fail "looking at the menu chooses nothing"
sleep 2
shot chosen
kill $kiosk
gone() { ! titled "tavern$"; }
wait_for 20 gone || fail "the kiosk stays"

# In the player, which is a window of its own. The path above the dialog's buttons takes one line or two, and this point
# lies on the button in both cases.
click 912 554
wait_for 60 titled "tavern$" || fail "the player did not open"
sleep 12
shot played
xdotool windowfocus "$(xdotool search --name "^tavern$" | tail -1)" sleep 0.5 key Escape
wait_for 20 gone || fail "the player stays"
xdotool windowfocus "$(xdotool search --name Lararium | tail -1)" sleep 0.5
click 794 554  # Close
quit
echo "passed; screenshots: $out/staged.png $out/export.png $out/played.png"
