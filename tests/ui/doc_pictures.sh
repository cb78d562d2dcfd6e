#!/bin/bash
# Makes editor.jpg, timeline.jpg and film.jpg of the docs anew, by real input events under Xvfb, from
# the sample that ./demo leaves trained and baked:
#
#   tests/ui/doc_pictures.sh build/release/bin/lararium-editor \
#       build/demo/thermopolium/thermopolium.lararium [OUTPUT_FOLDER]     docs/images otherwise
#
# Look at each picture before it is committed: who stands where depends on the drama.
set -u
editor=$(realpath "$1")
sample=$(realpath "$2")
root=$(cd "$(dirname "$0")/../.." && pwd)
images=$(realpath "${3:-$root/docs/images}")
out=$root/build/doc_pictures

. "$root/tests/ui/window.sh"
need xvfb-run Xvfb xdotool import convert
on_a_display "$0" "$@"
start_clean
# Beside the sample, whose recordings are named from there; what is done to it is done to the copy.
project=$(dirname "$sample")/pictures.lararium
trap 'rm -rf "$project"' EXIT
rm -rf "$project"
cp -r "$sample" "$project"

# shot NAME CROP WIDTH: of the window, at most WIDTH pixels wide.
shot() {
  import -window root "$out/$1.png"
  convert "$out/$1.png" -crop "$2" +repage -resize "$3x>" -strip -quality 82 "$images/$1.jpg" ||
    fail "cannot write $1.jpg"
}

open_window 700 300 "$project"
sleep 45        # people are read, the drama is run dry
click 581 574   # the ruler of the timeline
xdotool mousemove 1250 700
sleep 25
shot editor 1440x866+0+0 1200  # without the line that names the folder
click 510 640   # a line of the keeper
xdotool mousemove 1250 800
sleep 2
shot timeline 1424x338+8+522 1424

# The recording, filmed as if it were a camera.
click 37 44     # Train
click 720 527   # Film it with a camera instead
fill 720 463 "$root/scenes/maquette/maquette.lararium/places/maquette/training.mp4"
sleep 1
click 912 551   # Film
sleep 2.2
shot film 1100x620+170+140 1000
click 1033 723  # Discard
quit
ls -l "$images"
