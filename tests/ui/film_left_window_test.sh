#!/bin/bash
# Leaves the dialog that films a place in every way, with a recording in place of a camera: Escape
# and the cross ask, the keyboard answers, and only "Discard" deletes what was filmed. Nothing is
# trained, so it is quick.
#
#   film_left_window_test.sh EDITOR OUTPUT_FOLDER MAKE_BOARD_VIDEO
set -u
make_board_video=$3

. "$(dirname "$0")/window.sh"
need compare
begin_test "$0" "$@"
place=$project/places/tavern
video=$out/board.mp4

films() { compgen -G "$place/film-$1.mp4.*.part" > /dev/null; }
# begin NUMBER: films from the dialog that the menu opens.
begin() {
  click 37 44    # Train
  click 720 540  # Film it with a camera instead
  fill 720 416 tavern
  fill 690 479 "$video"
  shot start
  click 912 567  # Film
  wait_for 10 films "$1" || fail "does not film"
}

"$editor" camera --list --json 2> /dev/null | grep -q '"cameras"' || fail "lists no cameras"
"$make_board_video" "$video" 10 || fail "cannot write a video"
"$editor" new "$project" > /dev/null || fail "cannot make a project"
open_window 700 780 "$project"
settle

# Escape asks while filming goes on, and Escape again goes on filming.
begin 1
sleep 1
shot filming
press Escape
asks() { shot question && [ "$(difference question filming)" -gt 500 ]; }
wait_for 5 asks || fail "Escape does not ask"
films 1 || fail "Escape ended the film"
press Escape
films 1 || fail "Escape to the question ended the film"
# Over by itself: Escape keeps what was filmed.
wait_for 90 test -s "$place/film-1.mp4" || fail "the film was not completed"
sleep 1
shot ended
press Escape
sleep 1
shot left
[ -s "$place/film-1.mp4" ] || fail "Escape deleted what was filmed"

# The cross asks too; the keyboard reaches every answer.
begin 2
sleep 1
click 1203 167  # the cross
shot cross
films 2 || fail "the cross ended the film"
press Left
press Left
press Left
shot keyboard
press space  # Discard
wait_for 10 bash -c "! test -e '$place/film-2.mp4.part'" || fail "Discard does not end the film"
[ -e "$place/film-2.mp4" ] && fail "Discard left the film"

quit
echo "passed; screenshots: $out/question.png $out/ended.png $out/keyboard.png"
