#!/bin/bash
# Opens the sample by a click on the start page, first of an installed editor with the prepared sample
# and then in a bare checkout. The prepared one plays by itself: the people move, and not only the
# film in which they are shown. Space pauses it. The shipped files stay as they were. The bare one
# shows the place and says what it prepares.
#
#   sample_window_test.sh EDITOR OUTPUT_FOLDER SAMPLE SCENES
set -u
sample=$3
scenes=$4

. "$(dirname "$0")/window.sh"
need compare convert identify
begin_test "$0" "$@"
copy=$out/data/lararium/sample
built=$editor

# Regions of the picture: people stand below the progress and above captions; the painted wall is
# above them, beside the badge.
people=340x90+500+345
wall=250x60+660+95
# moved REGION A B: the pixels of the region by which two screenshots differ.
moved() {
  convert "$out/$2.png" -crop "$1" +repage "$out/before_part.png"
  convert "$out/$3.png" -crop "$1" +repage "$out/after_part.png"
  difference before_part after_part
}
# Waits until the picture has changed five times, and sets moving to the time of the third change: it
# appears empty at first, then with the place, then with the people, who move from then on.
await_motion() {
  local changes=0
  shot before
  for ((n = 0; n < 240 && changes < 5; ++n)); do
    sleep 0.2
    shot after
    if [ "$(moved $people before after)" -gt 1000 ]; then
      mv "$out/after.png" "$out/before.png"
      ((++changes == 3)) && moving=$(seconds)
    fi
  done
  [ $changes -eq 5 ]
}
# Whether the picture rests; on a busy machine the paused moment is drawn seconds later.
stands() {
  shot before
  sleep 3
  shot after
  [ "$(moved $people before after)" -lt 20 ]
}
seconds() { date +%s.%N; }

install_editor "$out/installed"
install_sample "$sample"
shipped() { find -L "$sample" -type f -printf '%p %s %T@\n' | sort | sha256sum; }
before=$(shipped)
shows_pictures() {
  shot start
  [ "$(identify -format %k "$out/start.png")" -gt 5000 ]
}
open_window 1300 880
wait_for 10 shows_pictures || fail "the start page shows no pictures"
clicked=$(seconds)
click 250 377
wait_for 60 titled "A morning at the thermopolium" || fail "the sample did not open"
opened=$(seconds)
await_motion || fail "nobody moves"
awk -v a="$clicked" -v b="$opened" -v c="$moving" 'BEGIN {
  printf "From the click to the window: %.1f s, to moving people: %.1f s\n", b - a, c - a}'
sleep 3
shot playing

# Paused, one round of the film later: the film's image is the same, the people are not.
press space
wait_for 10 stands || fail "Space does not pause"
shot paused
for ((frame = 0; frame < 150; ++frame)); do xdotool key --delay 8 period; done
wait_for 20 stands || fail "the picture does not come to rest"
shot later
[ "$(moved $wall paused later)" -lt 100 ] || fail "this is another image of the film"
[ "$(moved $people paused later)" -gt 1000 ] || fail "the people stand still"
[ -s "$copy/thermopolium/thermopolium.lararium/places/maquette/scene.larscene" ] ||
  fail "the copy is not trained"
quit
[ "$(shipped)" = "$before" ] || fail "the shipped sample was changed"

# A checkout in which nothing was prepared.
editor=$built
rm -rf "$out/data"
install_editor "$out/checkout/build/release"
cp -r "$scenes" "$out/checkout/scenes"
open_window 1300 880
wait_for 10 shows_pictures || fail "the start page shows no pictures in a checkout"
click 250 377
wait_for 20 titled "A morning at the thermopolium" || fail "the bare sample did not open"
place=500x80+410+380  # The floor, below the progress.
shows_place() {
  import -window root -crop $place +repage "$out/place.png"
  [ "$(identify -format %k "$out/place.png")" -gt 3000 ]
}
wait_for 10 shows_place || fail "the place is not shown at once"
shot preparing
progress=260x50+535+245
goes_on() {
  shot now
  [ "$(moved $progress preparing now)" -gt 20 ]
}
wait_for 30 goes_on || fail "no progress is shown"
[ -e "$copy/thermopolium/thermopolium.lararium/places/maquette/scene.larscene" ] &&
  fail "the bare sample was trained already"
press ctrl+q
shot asked
click 780 498  # Stop it and leave
wait_for 60 bash -c "! kill -0 $pid" || fail "did not quit"
echo "passed; screenshots: $out/start.png $out/playing.png $out/preparing.png"
