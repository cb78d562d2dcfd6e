#!/bin/bash
# Drives the light panel with real input events: drags the sun over the probe's picture, turns
# and brightens the light by keys, undoes, and opens a project whose probe cannot be read.
#
#   light_window_test.sh EDITOR OUTPUT_FOLDER MAKE_PROBE
set -u
make_probe=$3

. "$(dirname "$0")/window.sh"
need identify
begin_test "$0" "$@"

# A field of the first probe, on one line.
probe_field() {
  tr -d ' \n' < "$json" | sed -E 's/.*"probes"://' |
    sed -E "s/.*\"$1\":(\[[^]]*\]|[^],}]*).*/\1/"
}
field_is() { [ "$(probe_field "$1")" = "$2" ]; }
# The heading of the rotation (w, x, y, z) about the vertical lies within two numbers, degrees.
heading_within() {
  probe_field rotation | tr -d '[]' | awk -F, -v low="$1" -v high="$2" '{
    heading = 2 * atan2($3, $1) * 57.29578
    exit !(heading > low && heading < high && $2 * $2 + $4 * $4 < 1e-6)}'
}

start_editor() {
  open_window 700 780 "$project"
  settle
  xdotool key F8 sleep 1  # the messages leave the most room above
  press l
  sleep 2
}

new_project_with_place '{"name": "noon", "file": "probe.exr", "position": [0, 1.2, 0],
  "hour": 12, "rotation": [1, 0, 0, 0], "scale": 1}'
"$make_probe" "$project/probe.exr" || fail "cannot make a probe"

start_editor
import -window root "$out/panel.png"

# Keys: ten degrees to the left, a sixth of a stop less; one command each.
press shift+bracketleft
press ctrl+s
wait_for 10 heading_within 9.9 10.1 || fail "the key did not turn: $(probe_field rotation)"
press minus
press ctrl+s
dimmer() { awk -v s="$(probe_field scale)" 'BEGIN {exit !(s > 0.88 && s < 0.90)}'; }
wait_for 10 dimmer || fail "the key did not dim: $(probe_field scale)"
press ctrl+z
press ctrl+z
press ctrl+s
wait_for 10 field_is rotation "[1.0,0.0,0.0,0.0]" || fail "undo of the keys: $(probe_field rotation)"
field_is scale 1.0 || fail "undo of dimming: $(probe_field scale)"

# The sun stands at three quarters of the picture's width; an eighth of it to the left is 45
# degrees, counted towards the left.
sun=(1334 310)
xdotool mousemove "${sun[0]}" "${sun[1]}" sleep 0.4 mousedown 1 sleep 0.4
xdotool mousemove $((sun[0] - 20)) "${sun[1]}" sleep 0.3
xdotool mousemove $((sun[0] - 40)) "${sun[1]}" sleep 0.5 mouseup 1
sleep 0.5
press ctrl+s
wait_for 10 heading_within 40 50 || fail "the drag did not turn the light: $(probe_field rotation)"
import -window root "$out/dragged.png"
press ctrl+z
press ctrl+s
wait_for 10 field_is rotation "[1.0,0.0,0.0,0.0]" || fail "one drag is one command"
colours=$(identify -format %k "$out/panel.png")
[ "$colours" -gt 100 ] || fail "the screenshot is blank: $colours colours"
quit

# A probe that cannot be read is said in the panel, and the window lives on.
echo "no image" > "$project/probe.exr"
start_editor
import -window root "$out/broken.png"
press bracketright
press ctrl+s
wait_for 10 heading_within -1.1 -0.9 || fail "a broken probe cannot be turned"
quit
echo "passed; screenshots: $out/panel.png $out/dragged.png $out/broken.png"
