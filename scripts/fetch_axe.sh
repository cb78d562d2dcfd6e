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
fetch_npm_files axe-core "$package" "$integrity" "axe.min.js LICENSE" "$@"
