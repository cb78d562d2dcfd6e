#!/bin/bash
# A kiosk over a whole monitor: its show is killed, and hangs, and each time goes on where it was
# while a visitor sees black and never the desktop; a visit has its time, after which the next
# visitor finds what staff chose. Looks at the kiosk's state and log and at screenshots.
#
#   kiosk_window_test.sh EDITOR OUTPUT_FOLDER MAKE_ROOM_MAP VIDEO
set -u
make_room_map=$3
video=$4

. "$(dirname "$0")/window.sh"
need identify convert display
begin_test "$0" "$@"
player=${editor%editor}player
show=$out/Test.larshow
state=$out/kiosk/state.json

# begin_kiosk [OPTION...]
begin_kiosk() {
  "$player" "$show" --video "$video" --loop --kiosk --state "$out/kiosk" --audio none \
    --quality 5 "$@" >> "$out/editor.log" 2>&1 &
  pid=$!
  wait_for 60 titled "Test$" || fail "the kiosk did not open"
}
end_kiosk() {
  kill $pid
  wait $pid || fail "the kiosk ended with $?"
  pid=0
  gone() { ! titled "Test$" && ! titled "Lararium$"; }
  wait_for 10 gone || fail "a window stays"
}
# The process that shows it, which is not the one that watches over it.
shower() { xdotool search --name '^Test$' getwindowpid | tail -1; }
another_shower() { [ -n "$(shower)" ] && [ "$(shower)" != "$1" ]; }
seconds() { grep -oE '"seconds": [0-9.e-]+' "$state" | cut -d' ' -f2; }
beyond() { awk -v s="$(seconds)" -v least="$1" 'BEGIN {exit !(s > least)}'; }
mean() { convert "$1" -colorspace gray -format '%[fx:mean]' info:; }
is_dark() { mean "$1" | awk '{exit !($1 < 0.01)}'; }
now() { date +%s.%N; }
# broken SIGNAL HOW: the show is, and goes on.
broken() {
  local before victim begun
  victim=$(shower)
  before=$(seconds)
  begun=$(now)
  kill "-$1" "$victim"
  if [ "$1" = KILL ]; then
    sleep 0.1
    shot killed
    is_dark "$out/killed.png" || titled "Test$" || fail "something else than black is seen"
  fi
  wait_for 20 another_shower "$victim" || fail "it is not begun again"
  lit() { shot again && ! is_dark "$out/again.png"; }
  wait_for 20 lit || fail "nothing is shown again"
  awk -v b="$begun" -v e="$(now)" -v h="$2" 'BEGIN {printf "%s: shown again after %.1f s\n", h, e - b}'
  wait_for 10 beyond "$before" || fail "$2: it does not go on where it was: $(seconds), $before"
  beyond "$(awk -v b="$before" 'BEGIN {print b + 15}')" && fail "$2: it leaps from $before"
}

new_project_with_place
"$make_room_map" "$project/places/site/scene.larscene" 500 1 || fail "cannot make a map"
printf 'id,speaker,notes,en\nhello,,,Hello\n' > "$project/lines.csv"  # a show with letters
echo 'function main() while true do wait(1) end end' > "$project/drama.lua"
"$editor" export "$project" --out "$show" > "$out/export.log" 2>&1 ||
  { cat "$out/export.log"; fail "nothing was exported"; }

# Of this machine the doctor knows: it has no camera, and draws in software.
"$player" doctor "$show" --state "$out/kiosk" > "$out/doctor.log" 2>> "$out/editor.log" &&
  fail "without a camera the doctor finds nothing bad"
for finding in "warning +bundle +\"Test\"" "good +map .*500 points" "BAD +camera" \
  "(good|warning) +graphics" "(good|warning) +drawing .*pictures a second" "good +display" \
  "good +disk +.*kiosk" "do: plug it in"; do
  grep -qE "$finding" "$out/doctor.log" || { cat "$out/doctor.log"; fail "no line of '$finding'"; }
done

display -window root xc:red  # the desktop
begin_kiosk
wait_for 60 test -s "$state" || fail "it keeps no state"
wait_for 30 beyond 4 || fail "the drama stands still"
shot shown
broken KILL "killed"
wait_for 30 beyond "$(awk -v s="$(seconds)" 'BEGIN {print s + 3}')" || fail "the drama stands still"
broken STOP "hanging"
grep -q "the show hangs" "$out/editor.log" || fail "the log does not say so"
end_kiosk

# A visit of half a minute, whose visitor turns the sound down.
rm -rf "$out/kiosk"
begin_kiosk --visit-minutes 0.5
# A window can have the focus once it is mapped.
xdotool search --sync --onlyvisible --name '^Test$' windowfocus sleep 0.5
press Next
quieter() { grep -q '"volume": 0.9' "$state"; }
wait_for 10 quieter || fail "nothing is turned down"
shot visit
over() { grep -q "the visit is over" "$out/editor.log"; }
wait_for 90 over || fail "the visit does not end"
shot farewell
begun=$(seconds)
press Home
came() { grep -q "a visitor came" "$out/editor.log"; }
wait_for 10 came || fail "nobody comes"
louder() { [ "$(grep -c '"volume": 1.0' "$state")" = 2 ]; }
wait_for 10 louder || fail "the next visitor finds what the last one chose"
from_the_beginning() { ! beyond "$begun"; }
wait_for 10 from_the_beginning || fail "the next visitor does not see the beginning"
end_kiosk
echo "passed"
