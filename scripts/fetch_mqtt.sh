#!/usr/bin/env bash
# Fetches mqtt, the npm package by which the page of a fleet speaks with the broker (fleet/README.md).
#
#   scripts/fetch_mqtt.sh [FOLDER]      default: build/mqtt
#
# FOLDER then has mqtt.min.js. Exit status: 0 it is there, 1 it could not be fetched, 2 wrong usage.
set -euo pipefail

package=mqtt@5.16.0
integrity='G0VsEtuJz5sJUgZJaaADMVfW7SIFPzkIuHR+d6rk+tBeSwdCfd9BaIRycRfd2AbyFDEmLlFM+SDQeti/+IbOnw=='

. "$(dirname "$0")/fetched.sh"
fetch_npm_files mqtt "$package" "$integrity" "dist/mqtt.min.js LICENSE.md" "$@"
