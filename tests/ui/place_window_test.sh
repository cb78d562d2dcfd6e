#!/bin/bash
# What is said of a place and of the project: another recording plays in the camera view, which
# follows at once, and undo brings back the training's; the place gets reverberation and a fire that
# is always heard; it is renamed and put first; languages are chosen; a sound is brought in; one
# object is of the library, another is a model of its own. Looks at the saved project, at its folder
# and at screenshots.
#
#   place_window_test.sh EDITOR OUTPUT_FOLDER MAKE_ROOM_MAP VIDEO MODEL
set -u
make_room_map=$3
video=$4
model=$5

. "$(dirname "$0")/window.sh"
need identify convert compare
begin_test "$0" "$@"

place() {
  cat << JSON
{"name": "$1", "camera_nudge": [0, 0, 0], "occluders": [],
 "training": {"images": "walk"},
 "adjust": {"translation": [0, 0, 0], "rotation": [1, 0, 0, 0], "scale": 1},
 "picks": {"origin": [], "forward": [], "floor": [], "length_from": [], "length_to": [],
           "length_m": 1}}
JSON
}
"$editor" new "$project" > /dev/null || fail "cannot make a project"
echo "{\"schema\": 1, \"title\": \"Test\", \"credits\": \"\", \"cast\": [],
      \"places\": [$(place site), $(place front)]}" > "$json"
"$make_room_map" "$project/places/site/scene.larscene" || fail "cannot make a map"
mkdir "$project/walk"
for n in 1 2 3; do convert -size 640x480 xc:teal "$project/walk/$n.png"; done
printf 'id,speaker,notes,la,it\nhail,keeper,,Salve,Salve\n' > "$project/lines.csv"
cp "$video" "$out/evening.mp4"
cp "$model" "$out/shrine.glb"

# view NAME: the middle of the camera view in a screenshot.
view() {
  shot "$1"
  convert "$out/$1.png" -crop 400x300+460+200 +repage "$out/$1.png"
}
# another_view A B: the view of A is another than that of B now.
another_view() {
  view "$2"
  [ "$(difference "$1" "$2")" -gt 60000 ]
}
same() {
  view "$2"
  [ "$(difference "$1" "$2")" -lt 6000 ]
}

mkdir -p "$project/places/front"
echo "by the door" > "$project/places/front/notes.txt"
open_window 700 780 "$project"
settle
press F8       # the messages leave the most room above
click 90 147   # the first place
wait_for 60 test -e "$project/speech/la/hail.flac" || fail "nothing was baked"
settle
view training

# Another recording, and back.
click 1263 395
click 600 451  # Video
fill 700 487 "$out/evening.mp4"
press Return
wait_for 20 another_view training evening || fail "the camera view does not follow"
saved '"preview":\{"video":' "$json" "the place names no other recording"
press ctrl+z
wait_for 20 same training undone || fail "undo does not bring the training's recording back"
press ctrl+s
grep -q '"preview"' "$json" && fail "undo left the other recording"

# How the other place sounds.
click 90 169
sleep 2
click 1313 266
click 1290 432  # Vault
saved '"reverb":"vault"' "$json" "the place has no vault"
click 1264 332
click 1200 363  # brazier
saved '"sound":"brazier"' "$json" "no fire is heard"
click 1317 398  # A point
saved '"at":\[' "$json" "the fire is not at a point"
shot sound
press ctrl+z
press ctrl+s
grep -q '"at":' "$json" && fail "undo left the fire at a point"

# Its name and its rank.
click 1255 510
fill 768 395 tavern
fill 768 428 tavern
press Return
saved '"name":"tavern"' "$json" "the place was not renamed"
[ -e "$project/places/tavern/notes.txt" ] || fail "its files are not under the new name"
press ctrl+z
saved '"name":"front"' "$json" "undo did not bring the old name back"
[ -e "$project/places/front/notes.txt" ] || fail "undo did not find its files"
press ctrl+shift+z
saved '"name":"tavern"' "$json" "redo did not rename it again"
click 90 169
sleep 2
click 1255 541
"$editor" place "$project" | head -1 | grep -q '^site' || fail "it is the first already"
saved '"places":\[\{.*"name":"tavern".*"name":"site"' "$json" "the place was not put first"
shot renamed

# Languages.
click 90 82
click 1320 284
shot languages
click 1245 315  # la
press Escape
saved '"spoken":\["la"\]' "$json" "no language is spoken"

# A sound of the project's own.
cp "$(dirname "$0")/../../scenes/library/sounds/brazier.flac" "$out/bell.flac"
click 1264 408
fill 762 448 "$out/bell.flac"
press Return
wait_for 10 test -e "$project/audio/bell.flac" || fail "the sound was not brought in"
shot project

# An object of the library, and one that is a model of its own.
click 207 445
sleep 2
shot library
press Return
saved '"model":"amphora"[^}]*"name":"amphora"' "$json" "the object of the library was not added"
click 207 445
click 612 406
fill 700 445 "$out/shrine.glb"
shot object
press Return
saved '"file":"[^"]*shrine.glb"[^}]*"name":"shrine"' "$json" "the model was not added"
quit
echo "passed; screenshots: $out/sound.png $out/renamed.png $out/project.png $out/library.png $out/object.png"
