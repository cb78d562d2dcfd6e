#!/bin/bash
# Drives the cast in the editor's window with real input events: adds a person from a preset
# by its thumbnail, moves a slider, undoes, redoes, dyes a garment; gives a plain figure a voice
# and hears it, renames, adds and removes a recorded motion, turns the portrait by keys; imports a
# figure of another program, names a bone of it, undoes, redoes, saves. Looks at the saved project.
#
#   cast_window_test.sh EDITOR OUTPUT_FOLDER
set -u
model=/usr/share/assimp/models/X/Testwuson.X

. "$(dirname "$0")/window.sh"
if [ ! -e $model ]; then
  echo "skipped: the Debian package assimp-testmodels is not installed"
  exit 77
fi
begin_test "$0" "$@"
project=$out/cast.lararium
json=$project/project.json


# saved CHECK WHAT: saves until the project holds it.
saved() {
  for ((n = 0; n < 10; ++n)); do
    press ctrl+s
    bash -c "$1" && return 0
  done
  fail "$2"
}
has() { echo "tr -d ' \n' < '$json' | grep -qE '$1'"; }
has_not() { echo "! tr -d ' \n' < '$json' | grep -qE '$1'"; }

"$editor" new "$project" > /dev/null || fail "cannot make a project"
open_window 700 780 "$project"
settle
xdotool key F8 sleep 1  # the messages leave the most room above

# The second of the presets' pictures, which gives the name too.
click 206 163
click 618 388
click 912 608
saved "$(has '"preset":"keeper"')" "the person was not added"

# Weight, from one to less; the preset becomes a recipe of the project.
xdotool mousemove 1401 485 sleep 0.4 mousedown 1 sleep 0.4 mousemove 1330 485 sleep 0.3 \
  mousemove 1280 485 sleep 0.4 mouseup 1 sleep 0.5
saved "$(has '"weight":0\.[1-6]')" "the slider did not change the weight"
press ctrl+z
saved "$(has '"preset":"keeper"')" "undo of the whole pull"
press ctrl+shift+z
saved "$(has '"weight":0\.[1-6]')" "redo of the pull"

# The tunic's dye: ochre becomes another.
click 1150 393  # folds Body
click 1150 481  # opens Clothes
click 1280 620
click 1236 414
saved "$(has_not '"colour":"ochre"')" "the tunic keeps its colour"
press ctrl+z
saved "$(has '"colour":"ochre"')" "undo of the dye"
import -window root "$out/recipe.png"

# A figure of another program, and one of its bones named by hand.
click 206 163
click 771 479
xdotool type --delay 80 wuson
click 745 542
xdotool type --delay 40 $model
sleep 0.5
click 912 608
saved "$(has '"name":"wuson"')" "the figure was not added"
wait_for 120 test -e "$project/cast/wuson.larhuman" || fail "the figure was not imported"
sleep 3
for ((n = 0; n < 5; ++n)); do  # its bones may still be read
  click 1280 577
  click 1280 530
  press ctrl+s
  bash -c "$(has '"bones":\{"[a-z_]+":"[A-Za-z]')" && break
done
saved "$(has '"bones":\{"[a-z_]+":"[A-Za-z]')" "no bone was named"
press ctrl+z
saved "$(has_not '"bones":\{')" "undo of the bone"
press ctrl+shift+z
saved "$(has '"bones":\{"[a-z_]+":"[A-Za-z]')" "redo of the bone"

# Both have their thumbnails; the keeper is built last of all.
wait_for 200 test -e "$project/cast/wuson.thumbnail.png" || fail "no thumbnail of the figure"
wait_for 200 test -e "$project/cast/keeper.thumbnail.png" || fail "no thumbnail of the person"
sleep 1
import -window root "$out/bones.png"
quit

# A plain figure with a recorded motion, which the drama names. Sound goes into a file.
project=$out/voice.lararium
json=$project/project.json
motion=$(cd "$(dirname "$0")/../.." && pwd)/scenes/thermopolium/thermopolium.lararium/motion
"$editor" new "$project" > /dev/null || fail "cannot make a project"
cat > "$json" << JSON
{"schema": 1, "title": "Voice", "credits": "", "places": [], "cast": [{
  "name": "ada", "height": 1.6, "tunic": [0.6, 0.5, 0.4],
  "clips": [{"name": "nod", "file": "$motion/nod.bvh"}]}]}
JSON
echo 'hail = "nod"' > "$project/drama.lua"
printf 'drivers=wave\n[wave]\nfile=%s/heard.wav\n' "$out" > "$out/alsoft.conf"
export ALSOFT_CONF=$out/alsoft.conf ALSOFT_DRIVERS=wave
open_window 700 780 "$project"
settle
xdotool key F8 sleep 1
click 60 205
click 1160 484  # opens Clips
click 1160 462  # opens Voice

drag 1337 523 1270 523
saved "$(has '"pitch":[0-9]+')" "the slider did not change the pitch"
saved "$(has_not '"pitch":50')" "the pitch is as it was"
click 1396 523  # the button that sets it back, which goes then
saved "$(has_not '"pitch"')" "the pitch was not set back"
press ctrl+z
saved "$(has '"pitch":')" "undo of that"
click 1260 620
wait_for 60 bash -c "[ \$(stat -c %s '$out/heard.wav') -gt 200000 ]" || fail "the voice was not heard"

click 1160 462  # folds Voice
fill 1280 512 bow
hold Return
saved "$(has '"name":"bow"')" "the motion was not renamed"
shot clips
click 1260 650  # asks for a further one
click 1234 677
xdotool type --delay 40 "$motion/pray.bvh"
sleep 0.5
click 1369 773
saved "$(has '"name":"pray"')" "the motion was not added"
press ctrl+z
saved "$(has_not '"name":"pray"')" "undo of the addition"
click 1396 512
saved "$(has_not '"clips"')" "the motion was not removed"
press ctrl+z
press ctrl+z
saved "$(has '"name":"nod"')" "undo of both"

# The portrait turns by keys once they have come to it.
wait_for 200 test -e "$project/cast/ada.thumbnail.png" || fail "no thumbnail of the plain figure"
press ctrl+shift+Tab
press ctrl+Tab
for ((n = 0; n < 8; ++n)); do press Up; done
# The portrait alone, above what says that it is still being built: until it is it does not turn.
portrait() {
  import -window root -crop 300x190+1114+120 +repage "$out/$1.png"
}
drawn() { portrait front && [ "$(convert "$out/front.png" -format %k info:)" -gt 1000 ]; }
wait_for 60 drawn || fail "the portrait is not drawn"
for ((n = 0; n < 4; ++n)); do press Right; done
turned() { portrait side && [ "$(difference front side)" -gt 3000 ]; }
wait_for 20 turned || fail "the portrait does not turn by keys"
press Home
front_again() { portrait front_again && [ "$(difference front front_again)" -lt 500 ]; }
wait_for 20 front_again || fail "Home does not show the front"
quit
[ -s "$out/heard.wav" ] || fail "nothing was heard"
echo "passed; screenshots: $out/recipe.png $out/bones.png $out/clips.png"
