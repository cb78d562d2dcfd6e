#!/usr/bin/env bash
# Fetches photographs of a real chessboard, which two cameras on a common bar took at the same
# moments, from the Debian package opencv-doc; tests of calibration measure those cameras.
#
#   scripts/fetch_board_photographs.sh [FOLDER]      default: build/board-photographs
#
# FOLDER then has left/*.jpg and right/*.jpg and left_intrinsics.yml, what others found for the
# left camera. Does nothing where they are there already. Exit status: 0 they are there, 1 they
# could not be fetched (tests skip without them), 2 wrong usage.
set -euo pipefail

package=opencv-doc
sha256=4b12681df35878207ac7097dc66184b2ae552e4bf4ddd2af04a0f03ed0b8682a

. "$(dirname "$0")/fetched.sh"
begin_fetching board-photographs "$sha256" "the photographs of a board are in" "$@"
need_programs "the photographs need" apt-get dpkg-deb sha256sum tar
an_empty_folder
echo "fetching $package"
if ! (cd "$work" && apt-get download -qq "$package" 2> errors); then
  cat "$work/errors" >&2
  echo "$0: apt-get cannot fetch $package; is there a network? Run this again when there is" >&2
  exit 1
fi
archive=$(echo "$work"/*.deb)
found=$(sha256sum "$archive" | cut -d ' ' -f 1)
if [ "$found" != "$sha256" ]; then
  echo "$0: $package is not what it was (sha256 $found); it is not unpacked" >&2
  exit 1
fi

mkdir -p "$folder/left" "$folder/right"
rm -f "$folder/.complete"
data=./usr/share/doc/opencv-doc/examples/data
dpkg-deb --fsys-tarfile "$archive" | tar -x -C "$work" --no-same-owner --wildcards \
  "$data/left[0-9][0-9].jpg" "$data/right[0-9][0-9].jpg" "$data/left_intrinsics.yml"
cp "$work/$data"/left[0-9][0-9].jpg "$folder/left"
cp "$work/$data"/right[0-9][0-9].jpg "$folder/right"
cp "$work/$data/left_intrinsics.yml" "$folder"
echo "$sha256" > "$folder/.complete"
echo "$there"
