# What tests of the editor's window share; sourced before anything else is done.

# need TOOL...: skips the test where one is missing.
need() {
  for tool in "$@"; do
    if ! command -v "$tool" > /dev/null; then
      echo "skipped: $tool is not installed"
      exit 77
    fi
  done
}

# on_a_display "$0" "$@": starts the script anew on a virtual display. A server that resets itself
# when its last client goes refuses whoever comes meanwhile: here the window, between two questions
# whether it is there.
on_a_display() {
  if [ -z "${LARARIUM_UI_TEST_DISPLAY:-}" ]; then
    export LARARIUM_UI_TEST_DISPLAY=1
    exec xvfb-run -a -s "-screen 0 1440x900x24 -noreset" "$@"
  fi
}

# begin_test "$0" "$@": on a display of its own, with $editor, an empty folder $out, and where a
# project may lie in it.
begin_test() {
  need xvfb-run Xvfb xdotool import
  on_a_display "$@"
  editor=$2
  out=$3
  project=$out/ui.lararium
  json=$project/project.json
  start_clean
}

# Empties the output folder, which then holds the program's state too.
start_clean() {
  export LIBGL_ALWAYS_SOFTWARE=1 LANGUAGE=en LC_ALL=C.UTF-8
  # Files are asked for in the window: the developer's desktop has no part in a test.
  export DBUS_SESSION_BUS_ADDRESS=disabled:
  export XDG_STATE_HOME=$out/state XDG_CONFIG_HOME=$out/config XDG_CACHE_HOME=$out/cache
  # Compiling the shaders takes ten seconds of processor time, so all tests share the result.
  export MESA_SHADER_CACHE_DIR=$(dirname "$out")/shader_cache
  rm -rf "$out"
  mkdir -p "$out"
  pid=0
}

# install_editor FOLDER: uses the editor as it is when it is installed there, with share/ and the library of
# objects and sounds beside its bin/ and without the checkout's cast library.
install_editor() {
  local built
  built=$(dirname "$editor")
  mkdir -p "$1/bin" "$1/share"
  cp "$editor" "$1/bin/"
  cp -r "$built/../share/." "$1/share/"
  mkdir -p "$1/share/lararium"
  cp -r "$(dirname "$0")/../../scenes/library" "$1/share/lararium/"
  unset LARARIUM_CAST_LIBRARY
  export HOME=$out/home XDG_DATA_HOME=$out/data
  mkdir -p "$HOME"
  editor=$1/bin/$(basename "$editor")
}

# install_sample SAMPLE: beside the installed editor.
install_sample() { ln -s "$1" "$(dirname "$editor")/../share/lararium/sample"; }

fail() {
  echo "FAILED: $*"
  import -window root "$out/failure.png"
  cat "$out/editor.log"
  [ $pid -ne 0 ] && kill $pid
  exit 1
}

# hold KEY...: together, for as long as a slow frame: fields look at keys once a frame. The last key is
# let go first: an A that outlives its Ctrl on a busy machine repeats itself as a letter.
hold() {
  local held=()
  for key in "$@"; do
    xdotool keydown "$key"
    held=("$key" "${held[@]}")
  done
  sleep 0.4
  for key in "${held[@]}"; do xdotool keyup "$key"; done
  sleep 0.3
}

# wait_for SECONDS COMMAND...: until the command succeeds. SECONDS is what it may take on a quiet
# machine; beside other tests it may take three times as long.
wait_for() {
  local tries=$(($1 * 30))
  shift
  for ((i = 0; i < tries; ++i)); do
    "$@" > /dev/null 2>&1 && return 0
    sleep 0.1
  done
  return 1
}

# new_project_with_place [PROBES]: makes $project, with one place that was not trained yet.
new_project_with_place() {
  "$editor" new "$project" > /dev/null || fail "cannot make a project"
  cat > "$project/project.json" << JSON
{"schema": 1, "title": "Test", "credits": "", "cast": [], "places": [{
  "name": "site", "camera_nudge": [0, 0, 0], "occluders": [],
  "adjust": {"translation": [0, 0, 0], "rotation": [1, 0, 0, 0], "scale": 1},
  "picks": {"origin": [], "forward": [], "floor": [], "length_from": [], "length_to": [],
            "length_m": 1},
  "probes": [${1:-}]}]}
JSON
}

# open_window X Y [PROJECT]: opens a project, or none, and rests the mouse where nothing minds.
open_window() {
  local x=$1 y=$2
  shift 2
  "$editor" "$@" >> "$out/editor.log" 2>&1 &
  pid=$!
  wait_for 40 xdotool search --name Lararium || fail "no window"
  xdotool mousemove "$x" "$y"
}

# A screenshot, NAME.png in the output folder.
shot() { import -window root "$out/$1.png"; }

# difference A B: pixels by which two screenshots differ.
difference() {
  compare -metric AE -fuzz 2% "$out/$1.png" "$out/$2.png" null: 2>&1 | awk '{printf "%d", $1}'
}

# differs A B PIXELS: takes screenshot B and says whether it differs from A by more than that.
differs() {
  shot "$2"
  [ "$(difference "$1" "$2")" -gt "$3" ]
}

press() { xdotool key --delay 60 "$1" && sleep 0.5; }
click() { xdotool mousemove "$1" "$2" sleep 0.4 mousedown 1 sleep 0.2 mouseup 1 sleep 0.6; }
# drag X Y TO_X TO_Y
drag() {
  xdotool mousemove "$1" "$2" sleep 0.4 mousedown 1 sleep 0.3
  xdotool mousemove $((($1 + $3) / 2)) $((($2 + $4) / 2)) sleep 0.3
  xdotool mousemove "$3" "$4" sleep 0.4 mouseup 1 sleep 0.5
}

# The processor time of the program so far, in hundredths of a second.
work_done() { awk '{ print $14 + $15 }' "/proc/$pid/stat"; }

# settle: waits until the program has rested and the screen has stood still for two seconds; at most
# two minutes. A still screen alone says nothing where a frame takes a second.
settle() {
  local last='' now same=0 before
  for ((i = 0; i < 120 && same < 2; ++i)); do
    before=$(work_done)
    sleep 1
    now=$(import -window root rgb:- | sha256sum)
    if [ "$now" = "$last" ] && [ $(($(work_done) - before)) -lt 10 ]; then
      same=$((same + 1))
    else
      same=0
    fi
    last=$now
  done
}

# still NAME: a screenshot of what the window shows in the end, to be compared with others.
still() {
  settle
  shot "$1"
}

# titled REGEX: there is a window whose title begins so.
titled() { xdotool search --name "^$1" > /dev/null; }

# saved REGEX FILE WHAT: saves until the file holds it.
saved() {
  for ((n = 0; n < 8; ++n)); do
    press ctrl+s
    tr -d ' \n' < "$2" | grep -qE "$1" && return 0
  done
  cat "$2"
  fail "$3"
}

# fill X Y TEXT: types into the field of a dialog instead of what is there.
fill() {
  click "$1" "$2"
  hold ctrl a
  xdotool type --delay 40 "$3"
  sleep 0.5
}

# type_into X Y TEXT: the same for a number that can be dragged too.
type_into() {
  xdotool mousemove "$1" "$2" sleep 0.3 keydown ctrl mousedown 1 sleep 0.4 mouseup 1 keyup ctrl
  sleep 0.5
  xdotool type --delay 80 -- "$3"
  hold Return
  sleep 0.4
}

# Waits long: people may be baking.
quit() {
  press ctrl+q
  wait_for 60 bash -c "! kill -0 $pid" || fail "did not quit"
  wait $pid || fail "exit code $?"
}
