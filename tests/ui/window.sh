# What tests of the editor's window share; sourced with `out` set, before anything else
# is done.

# need TOOL...: skips the test where one is missing.
need() {
  for tool in "$@"; do
    if ! command -v "$tool" > /dev/null; then
      echo "skipped: $tool is not installed"
      exit 77
    fi
  done
}

# on_a_display "$0" "$@": starts the script anew on a virtual display.
on_a_display() {
  if [ -z "${LARARIUM_UI_TEST_DISPLAY:-}" ]; then
    export LARARIUM_UI_TEST_DISPLAY=1
    exec xvfb-run -a -s "-screen 0 1440x900x24" "$@"
  fi
}

# Empties the output folder, which then holds the program's state too.
start_clean() {
  export LIBGL_ALWAYS_SOFTWARE=1
  export XDG_STATE_HOME=$out/state
  rm -rf "$out"
  mkdir -p "$out"
  pid=0
}

fail() {
  echo "FAILED: $*"
  import -window root "$out/failure.png"
  cat "$out/editor.log"
  [ $pid -ne 0 ] && kill $pid
  exit 1
}

# wait_for SECONDS COMMAND...: until the command succeeds.
wait_for() {
  local tries=$(($1 * 10))
  shift
  for ((i = 0; i < tries; ++i)); do
    "$@" > /dev/null 2>&1 && return 0
    sleep 0.1
  done
  return 1
}
