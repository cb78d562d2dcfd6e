#!/usr/bin/env bash
# Writes the static files of the fleet's page (fleet/README.md), with what it shares with the staff page and the npm package
# mqtt, to build/fleet-page. fleet-setup and the player's package take them from there.
#
# Exit status: 0 they are there, 1 the package could not be fetched.
set -euo pipefail

cd "$(dirname "$0")/.."
scripts/fetch_mqtt.sh
mkdir -p build/fleet-page
cp build/mqtt/{mqtt.min.js,LICENSE.md} player/staff/page/{page.css,parts.js,words.json} fleet/{index.html,fleet.css,fleet.js,report.js} \
  build/fleet-page
cp fleet/words.json build/fleet-page/fleet_words.json
echo "the fleet's page is in build/fleet-page"
