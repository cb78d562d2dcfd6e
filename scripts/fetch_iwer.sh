#!/usr/bin/env bash
# Fetches iwer, the npm package that stands for a device with WebXR in tests/web.
#
#   scripts/fetch_iwer.sh [FOLDER]      default: build/iwer
#
# FOLDER then has iwer.min.js. Exit status: 0 it is there, 1 it could not be fetched, 2 wrong usage.
set -euo pipefail

package=iwer@2.5.0
integrity='grq7iMyWo4s2DYnATKLPPoAByhcNuwLjMHHOILrFU9q8EGHIEzHyUuq1mz+9Xqy6+xrYPn3Ho8Z9eymZCE+D6w=='

. "$(dirname "$0")/fetched.sh"
begin_fetching iwer "$integrity" "iwer is in" "$@"
need_programs "iwer needs" npm openssl tar
an_empty_folder
fetch_from_npm "$package" "$integrity"
mkdir -p "$folder"
tar -xzf "$archive" -C "$folder" --strip-components=2 --no-same-owner package/build/iwer.min.js
tar -xzf "$archive" -C "$folder" --strip-components=1 --no-same-owner package/LICENSE
echo "$integrity" > "$folder/.complete"
echo "$there"
