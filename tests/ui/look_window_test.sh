#!/bin/bash
# Chooses light colours, 200 % and Italian by clicks on the start page: each changes the window at
# once, and all of them outlive a restart to the pixel. At that size each number of the stage still
# has a field of its own that can be clicked and typed into.
#
#   look_window_test.sh EDITOR OUTPUT_FOLDER
set -u
. "$(dirname "$0")/window.sh"
need convert compare identify
begin_test "$0" "$@"
export HOME=$out/home XDG_DATA_HOME=$out/data
mkdir -p "$HOME"
settings=$XDG_CONFIG_HOME/lararium/editor.json

# What is written down, on one line.
chosen() { tr -d ' \n' < "$settings" | grep -q "$1"; }
# The brightness of a screenshot, of 100.
brightness() { identify -format '%[fx:int(100*mean)]' "$out/$1.png"; }
# button NAME X Y HEIGHT: how many pixels below X, Y have the colour of the one in the middle.
button() {
  local colour
  colour=$(identify -format "%[pixel:p{$2,$(($3 + $4 / 2))}]" "$out/$1.png")
  convert "$out/$1.png" -crop 1x"$4"+"$2"+"$3" +repage -fuzz 3% -fill lime -opaque "$colour" \
    -fill black +opaque lime -format '%[fx:int(0.5+mean.g*h)]' info:
}
# Scrolls the start page's column, which is higher than the window at 200 %.
to_the_end() {
  xdotool mousemove 280 600 sleep 0.3 click --repeat 20 --delay 60 5 sleep 1
  xdotool mousemove 1300 860 sleep 1
}
start_editor() {
  open_window 1300 860 "$@"
  settle
}

start_editor
shot dark
click 202 465  # Light
wait_for 5 chosen '"theme":"light"' || fail "light colours were not chosen"
still light
[ "$(brightness dark)" -lt 25 ] || fail "dark is bright: $(brightness dark)"
[ "$(brightness light)" -gt 75 ] || fail "light is dark: $(brightness light)"

small=$(button light 150 97 80)
click 322 523  # 200 %
wait_for 5 chosen '"scale":2' || fail "the size was not chosen"
sleep 1
xdotool mousemove 1300 860 sleep 1
still large
large=$(button large 80 205 140)
[ "$small" -gt 25 ] && [ "$large" -ge $((2 * small - 4)) ] && [ "$large" -le $((2 * small + 4)) ] ||
  fail "a button of $small pixels is now $large high"

to_the_end
still english
click 250 794  # the language
shot languages
click 130 734
wait_for 5 chosen '"language":"it"' || fail "Italian was not chosen"
sleep 1
to_the_end
wait_for 10 differs english italian 500 || fail "the words did not change"
quit

start_editor
to_the_end
still again
[ "$(difference italian again)" -eq 0 ] ||
  fail "after a restart $(difference italian again) pixels differ"
quit

# The stage's position, number by number, where there is room for three of them only just.
new_project_with_place
start_editor "$project"
shot project
type_into 1078 395 1.25
type_into 1200 395 -2.5
type_into 1322 395 -3.75
press ctrl+s
moved() { tr -d ' \n' < "$json" | grep -q '"translation":\[1.25,-2.5,-3.75\]'; }
wait_for 10 moved || fail "the three numbers could not be typed: $(tr -d ' \n' < "$json")"
shot numbers
quit
echo "passed; screenshots: $out/italian.png $out/numbers.png"
