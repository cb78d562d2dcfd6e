#!/usr/bin/env bash
# processor_test.sh PROGRAM...: a processor without the build's instructions gets one sentence, and one
# with them gets the program. qemu-user plays the processors.
set -euo pipefail

if ! command -v qemu-x86_64 >/dev/null; then
  echo "skipped: qemu-user is not installed"
  exit 77
fi
for program in "$@"; do
  # Nehalem is of 2008 and Sandy Bridge of 2011, which has AVX without AVX2.
  for processor in Nehalem SandyBridge; do
    status=0
    said=$(qemu-x86_64 -cpu "$processor" "$program" --version 2>&1 | grep -v 'TCG') || status=$?
    echo "$program on $processor: exit status $status: $said"
    [[ $status == 1 && $said == 'this processor: lacks the AVX2, '*'; use '* && $(wc -l <<<"$said") == 1 ]]
  done
  # What qemu cannot do of a Haswell it says first.
  said=$(qemu-x86_64 -cpu Haswell "$program" --version 2>/dev/null)
  echo "$program on Haswell: $said"
  [[ $said =~ [0-9]+\.[0-9]+\.[0-9]+ ]]
done
