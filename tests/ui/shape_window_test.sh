#!/bin/bash
# Adds a box and an arch to the occluders by the dialog with real input events, types a size,
# unticks what the arch does and takes that back. Looks at the saved project and at screenshots.
#
#   shape_window_test.sh EDITOR OUTPUT_FOLDER MAKE_ROOM_MAP
set -u
make_room_map=$3

. "$(dirname "$0")/window.sh"
begin_test "$0" "$@"

# has REGEX: the project on disk has it, without blanks.
has() { tr -d ' \n' < "$json" | grep -q "$1"; }
has_not() { ! has "$1"; }
save() { press ctrl+s; }
add_occluder() {
  click 107 14   # Place
  click 150 183  # Add an occluder
}

new_project_with_place
"$make_room_map" "$project/places/site/scene.larscene" || fail "cannot make a map"
open_window 700 780 "$project"
settle
press F8  # the messages leave the most room above
press 2   # around the place

add_occluder
import -window root "$out/dialog.png"
click 912 581  # Add
save
wait_for 10 has '"name":"box"' || fail "no box was added"
has '"shape":{"depth":1.0,"height":1.0,"kind":"box","width":1.0}' || fail "not the usual box"

add_occluder
click 760 401  # Arch
fill 769 370 "gate"
import -window root "$out/arch.png"
click 912 644  # Add
save
wait_for 10 has '"kind":"arch","opening":1.2,"spring":1.8,"width":3.0' || fail "no arch was added"
has '"name":"gate"' || fail "it has another name"
sleep 2
import -window root "$out/added.png"

# A height by the keyboard, within what the arch needs.
type_into 1312 197 "3.5"
save
wait_for 10 has '"height":3.5,"kind":"arch"' || fail "the height was not typed"
type_into 1312 197 "1"
save
wait_for 10 has '"height":2.401,"kind":"arch"' || fail "the height is less than the arch"
press ctrl+z
save
wait_for 10 has '"height":3.5,"kind":"arch"' || fail "undo of a height"

# Nothing is written of what an occluder does but where it does not.
has_not blocks_walking || fail "the usual is written"
click 1120 481  # Blocks walking
save
wait_for 10 has '"blocks_walking":false' || fail "Blocks walking was not unticked"
click 1120 417  # Receives shadow
save
wait_for 10 has '"receives_shadow":false' || fail "Receives shadow was not unticked"
sleep 2
import -window root "$out/unticked.png"
press ctrl+z
save
wait_for 10 has_not receives_shadow || fail "undo of a flag"
has '"blocks_walking":false' || fail "undo took back two"

# The subcommand tells the same.
quit
"$editor" occluder "$project" > "$out/list.txt" || fail "no list"
grep -q 'gate: arch, width 3, height 3.5.*does not block walking' "$out/list.txt" || fail "the list"
echo "passed; screenshots: $out/dialog.png $out/arch.png $out/added.png $out/unticked.png"
