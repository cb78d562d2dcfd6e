#!/usr/bin/env bash
# Writes the man pages of a program and of each of its subcommands from what the program itself says
# with --help.
#
#   make_man_pages.sh PROGRAM OUTPUT_FOLDER
set -euo pipefail
program=$(realpath "$1")
name=$(basename "$program")
out=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

# page NAME [SUBCOMMAND]: help2man takes the name of the page from that of the file that it runs.
page() {
  local runs="$program ${2:-}" says
  printf '#!/bin/sh\n[ "$1" = --version ] && set -- --version && exec %q --version\nexec %s "$@"\n' \
    "$program" "$runs" > "$work/$1"
  chmod +x "$work/$1"
  says=$("$work/$1" --help | sed -n 1p)
  help2man --no-info --name "${says%.}" --output "$work/$1.1" "$work/$1"
  gzip --best --no-name --stdout "$work/$1.1" > "$out/$1.1.gz"
}

page "$name"
"$program" --help | sed -n '/^Subcommands:/,$s/^  \([a-z-]\+\) .*/\1/p' | while read -r subcommand; do
  page "$name-$subcommand" "$subcommand"
done
