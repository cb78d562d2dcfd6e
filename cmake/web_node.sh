#!/bin/sh
# Node for emscripten (EM_NODE_JS). The loader of Debian 12's emscripten takes Node's own fetch for a browser's,
# which reads no files.
if node --no-experimental-fetch -e 0 2> /dev/null; then
  exec node --no-experimental-fetch "$@"
fi
exec node "$@"
