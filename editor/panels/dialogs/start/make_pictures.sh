#!/bin/bash
# Makes the start page's pictures from what ./demo left in build/demo:
#
#   make_pictures.sh BIN [OUTPUT_FOLDER]     BIN: build/release/bin; otherwise beside this script
#
# Look at each picture before it is committed: who stands where depends on the drama.
set -u
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../../.." && pwd)
bin=$(realpath "$1")
editor=$bin/lararium-editor
images=$(realpath "${2:-$here}")
out=$root/build/start_pictures
size=560x336

. "$root/tests/ui/window.sh"
need xvfb-run Xvfb xdotool import convert ffmpeg
on_a_display "$0" "$@"
start_clean
film=$root/scenes/maquette/maquette.lararium/places/maquette

# picture NAME CONVERT_ARGUMENT...: writes a picture of the page's size.
picture() {
  local name=$1
  shift
  convert "$@" -strip -quality 80 "$images/$name.jpg" || fail "cannot write $name.jpg"
}
# The image of a video at a time.
frame() { ffmpeg -loglevel error -y -ss "$2" -i "$1" -frames:v 1 "$out/$3.png" || fail "no image"; }

# Film: one image, and others of the film in a strip below it.
strip=()
for seconds in 0 0.8 1.6 2.4 3.6; do
  frame "$film/training.mp4" $seconds "film$seconds"
  strip+=("(" "$out/film$seconds.png" -resize 100x64^ -gravity center -extent 100x64
    -bordercolor white -border 2 ")")
done
frame "$film/training.mp4" 2.8 film
picture film "$out/film.png" -resize "$size^" -gravity north -extent $size \
  "(" -size 560x84 xc:"rgba(15,16,18,0.86)" ")" -gravity south -composite \
  "(" "${strip[@]}" -background none -gravity center +smush 6 ")" \
  -gravity south -geometry +0+8 -composite

# Stage: the axes and the floor of the stage over the first picture.
project=$root/build/demo/thermopolium/pictures.lararium
trap 'rm -rf "$project"' EXIT
rm -rf "$project"
cp -r "$root/build/demo/thermopolium/thermopolium.lararium" "$project"
open_window 1250 870 "$project"
sleep 40  # People are read.
click 48 210  # Stage
press F8      # The messages leave the most room above.
xdotool mousemove 1250 870
sleep 4
import -window root "$out/stage.png"
picture stage "$out/stage.png" -crop 794x476+267+190 +repage -resize "$size!"
quit

# Play: what a visitor sees.
"$bin/lararium-player" "$root/build/demo/thermopolium.larshow" --video "$film/handheld.mp4" --loop \
  --headless --pace fast --frames 300 --audio none --captions en --record "$out/show.mp4" ||
  fail "the show does not play"
frame "$out/show.mp4" 3 play
picture play "$out/play.png" -resize "$size^" -gravity south -extent $size
frame "$out/show.mp4" 8.5 sample
picture sample "$out/sample.png" -gravity south -extent 640x360
ls -l "$images"/*.jpg
