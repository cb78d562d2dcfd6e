#!/bin/bash
# Kills the editor's window while it is used, at random moments, and looks whether more than
# the last edit was lost. Each round nudges the camera by keys, one edit for each press.
#
#   killed_window_test.sh EDITOR OUTPUT_FOLDER ROUNDS
set -u
rounds=$3

. "$(dirname "$0")/window.sh"
begin_test "$0" "$@"

new_project_with_place

# How many steps of 5 mm the camera was nudged in what is saved.
steps() {
  tr -d ' \n' < "$json" | sed -E 's/.*"camera_nudge":\[([-0-9.e]+),.*/\1/' |
    awk '{printf "%d", $1 / 0.005 + 0.5}'
}
start_editor() {
  open_window 700 200 "$project"
  sleep 1
}

RANDOM=7
known=0
for ((round = 0; round < rounds; ++round)); do
  start_editor
  # The window may not have the keyboard yet: the first press is waited for.
  pressed=0
  presses=$((1 + RANDOM % 8))
  for ((i = 0; i < presses; ++i)); do
    xdotool key Right
    pressed=$((pressed + 1))
    sleep "0.$(printf '%02d' $((5 + RANDOM % 20)))"
  done
  sleep "0.$(printf '%02d' $((RANDOM % 30)))"
  kill -KILL $pid
  wait $pid 2> /dev/null
  start_editor
  xdotool key ctrl+s
  sleep 1.5
  kill -KILL $pid
  wait $pid 2> /dev/null
  now=$(steps)
  # A press that X still held when the editor was killed was never an edit; keys that reached it
  # and are gone would be a loss. The journal is the witness: nothing saved is ever undone.
  [ "$now" -ge "$known" ] || fail "round $round: $known steps were safe, $now are left"
  [ "$now" -le $((known + pressed)) ] || fail "round $round: more steps than presses"
  [ $((known + pressed - now)) -le "${ALLOWED:-2}" ] ||
    fail "round $round: $pressed presses after $known steps, $now are left"
  known=$now
done
pid=0
[ "$known" -gt "$rounds" ] || fail "the keys did not reach the window"
echo "passed: $rounds kills, $known edits"
