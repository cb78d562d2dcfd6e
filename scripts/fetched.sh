# shellcheck shell=bash
# What scripts that fetch content share; sourced.

# is_complete STAMP HASH WHAT: what a stamp says is there is not fetched again.
is_complete() {
  if [ -f "$1" ] && [ "$(cat "$1")" = "$2" ]; then
    echo "$3"
    return 0
  fi
  return 1
}

# need_programs WHAT PROGRAM...: ends the script where one is missing.
need_programs() {
  local what=$1 program
  shift
  for program in "$@"; do
    if ! command -v "$program" > /dev/null; then
      echo "$0: $what the program $program; install it and run this again" >&2
      exit 1
    fi
  done
}

# an_empty_folder [FOLDER]: sets work to an empty folder, FOLDER if it is given, that goes when the script ends.
an_empty_folder() {
  work=${1:-$(mktemp -d)}
  rm -rf "$work"
  mkdir -p "$work"
  trap 'rm -rf "$work"' EXIT
  trap 'exit 130' INT TERM
}
