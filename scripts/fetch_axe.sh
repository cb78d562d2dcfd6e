#!/usr/bin/env bash
# Fetches axe-core, the npm package that checks pages against the Web Content Accessibility Guidelines in tests/web.
#
#   scripts/fetch_axe.sh [FOLDER]      default: build/axe-core
#
# FOLDER then has axe.min.js. Exit status: 0 it is there, 1 it could not be fetched, 2 wrong usage.
set -euo pipefail

package=axe-core@4.14.1
integrity='FHfa+lmNjQZfJz1q8wKqIDwC6DExcHt/pkjNQb09a3NPjCKg2rhu5qb2S4r76ASyFNNtuFooJpZe37OgudVGtQ=='

. "$(dirname "$0")/fetched.sh"
begin_fetching axe-core "$integrity" "axe-core is in" "$@"
need_programs "axe-core needs" npm openssl tar
an_empty_folder
fetch_from_npm "$package" "$integrity"
mkdir -p "$folder"
tar -xzf "$archive" -C "$folder" --strip-components=1 --no-same-owner package/axe.min.js package/LICENSE
echo "$integrity" > "$folder/.complete"
echo "$there"
