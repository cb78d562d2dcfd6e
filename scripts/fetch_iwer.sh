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
fetch_npm_files iwer "$package" "$integrity" "build/iwer.min.js LICENSE" "$@"
