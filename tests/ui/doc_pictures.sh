#!/bin/bash
# Makes editor.jpg, timeline.jpg, light-panel.jpg, occluders.jpg, check-points.jpg, film.jpg,
# walks.jpg, script.jpg, export.jpg, start.jpg and light-theme.jpg of the docs anew, by real input
# events under Xvfb, from the sample that ./demo leaves trained and baked:
#
#   tests/ui/doc_pictures.sh build/release/bin/lararium-editor \
#       build/demo/thermopolium/thermopolium.lararium [OUTPUT_FOLDER]     docs/images otherwise
#
# Look at each picture before it is committed: who stands where depends on the drama.
set -u
editor=$(realpath "$1")
sample=$(realpath "$2")
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "${3:-$root/docs/images}"
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

# picture NAME CROP WIDTH: of the window, at most WIDTH pixels wide.
picture() {
  import -window root "$out/$1.png"
  convert "$out/$1.png" -crop "$2" +repage -resize "$3x>" -strip -quality 82 "$images/$1.jpg" ||
    fail "cannot write $1.jpg"
}

# check_point NAME X,Y,Z [FRAME U,V]...: a point of the stage, and where it is seen.
check_point() {
  local name=$1
  "$editor" check-points "$project" --set "$name" --at "$2" > /dev/null || fail "no point $name"
  shift 2
  while [ $# -gt 0 ]; do
    "$editor" check-points "$project" --place maquette --pick "$name" --frame "$1" --pixel "$2" \
      > /dev/null
    shift 2
  done
}
check_point "counter, left" -1.25,0,-0.89 000072.png 124,374 000080.png 172,367 000096.png 111,424
check_point "counter, right" 2.2,0,-0.89 000000.png 525,333 000004.png 574,337 000059.png 418,405
check_point "floor, ahead" 0,0,-0.85 000008.png 412,415 000075.png 295,398 000107.png 170,406
check_point "floor, right" 0.8,0,0 000062.png 181,468 000078.png 413,455 000102.png 420,448

open_window 700 300 "$project"
sleep 45        # people are read, the drama is run dry
click 581 574   # the ruler of the timeline
xdotool mousemove 1250 700
sleep 25
picture editor 1440x866+0+0 1200  # without the line that names the folder
click 510 640   # a line of the keeper
xdotool mousemove 1250 800
sleep 2
picture timeline 1424x338+8+522 1424

# The light panel: the messages leave the most room above.
press F8
click 344 690  # the first frame, in which nobody speaks
press l
xdotool mousemove 1250 870
sleep 5
picture light-panel 1204x656+236+62 1000

# Occluders over the picture.
click 48 210    # Stage
press o
xdotool mousemove 1250 870
sleep 2
picture occluders 860x656+236+62 800
press o

# A check point, through the camera.
xdotool mousemove 110 500
for ((n = 0; n < 60; ++n)); do xdotool click 5; sleep 0.05; done
sleep 1
click 66 633
xdotool mousemove 1250 870
sleep 2
picture check-points 1204x656+236+62 1000
press F5

# The recording, filmed as if it were a camera.
click 37 44     # Train
click 720 527   # Film it with a camera instead
fill 720 463 "$root/scenes/maquette/maquette.lararium/places/maquette/training.mp4"
sleep 1
click 912 551   # Film
sleep 2.2
picture film 1100x620+170+140 1000
sleep 4         # the recording is over
press Escape    # keeps the film, in the copy
sleep 1

# The ways of the keeper's walks, around the place.
xdotool mousemove 110 300
for ((n = 0; n < 60; ++n)); do xdotool click 4; sleep 0.05; done
click 90 482    # the keeper
press F8
press 2
xdotool mousemove 1250 870
sleep 8
picture walks 860x656+236+62 800
press F6
sleep 2
picture script 1424x402+8+457 1424

# What an export takes along, and the start page.
click 368 44    # Export
sleep 2
fill 720 315 thermopolium.larshow  # no folder of this machine
xdotool mousemove 1250 870
sleep 1
picture export 524x450+458+224 524
press Escape
press ctrl+o
sleep 3
picture start 1060x520+110+20 1000
click 207 443  # Light
quit
open_window 700 300 "$project"
sleep 45
xdotool mousemove 1250 700
sleep 25
picture light-theme 1440x866+0+0 1000
quit
ls -l "$images"
