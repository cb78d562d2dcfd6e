#!/bin/bash
# Calibrates a camera in the window with a video of a chessboard, first as a recording, then as if it
# were a live camera, from the dialog that trains a place: what was typed there stays, and the numbers
# come into it. Before that the same in a terminal.
#
# Of result.png the dialog is docs/images/calibrate.jpg.
#
#   calibrate_window_test.sh EDITOR OUTPUT_FOLDER MAKE_BOARD_VIDEO
set -u
make_board_video=$3

. "$(dirname "$0")/window.sh"
need convert
begin_test "$0" "$@"
video=$out/board.mp4

# Red of a pixel, 0 to 255: the button "Use" has much of it.
red() {
  import -window root "$out/now.png"
  convert "$out/now.png" -crop "1x1+$1+$2" +repage -format '%[fx:int(255*r)]' info:
}
has_result() { [ "$(red 1110 746)" -gt 120 ]; }
named() { tr -d ' \n' < "$project/project.json" | grep -q "$1"; }

"$make_board_video" "$video" 6 || fail "cannot write a video of a board"
"$editor" calibrate --video "$video" --board 9x6 --device-out "$out/device.json" --json \
  > "$out/result.json" 2> "$out/calibrate.log" || fail "calibrate: $(cat "$out/result.json")"
grep -q '"K"' "$out/device.json" || fail "no camera in the device file"
"$editor" calibrate --video "$video" --board 10x7 > /dev/null 2> "$out/wrong.log" &&
  fail "a board of another size was found"
grep -q "but a board 9x6 was" "$out/wrong.log" || fail "$(cat "$out/wrong.log")"
"$editor" calibrate --print-board "$out/board.svg" > /dev/null || fail "no board to print"

"$editor" new "$project" > /dev/null || fail "cannot make a project"
open_window 700 780 "$project"
settle
click 37 44   # Train
fill 700 361 tavern
fill 700 454 "$video"
click 925 485  # Calibrate
shot start
fill 700 431 "$video"
click 912 582  # Calibrate
sleep 3
shot search
wait_for 20 has_result || fail "the recording calibrates nothing"
shot result
click 1035 746  # Film again
click 792 400   # Live camera
fill 700 431 "$video"
shot live
click 912 601  # Calibrate
sleep 5        # all of it, at its own pace
shot filming
wait_for 20 has_result || fail "the live camera calibrates nothing"
shot filmed
click 1153 746  # Use
sleep 1
shot used
click 912 606  # Train
press ctrl+s
wait_for 20 named '"fx":5[56][0-9]\.' || fail "the intrinsics did not come into the dialog"
named '"name":"tavern"' || fail "what was typed before is lost"
quit
echo "passed; screenshots: $out/search.png $out/result.png $out/used.png"
