#!/usr/bin/env bash
# Installs the Debian packages of packages.txt that this machine lacks: those for
# everybody, and those for the purposes that are named (cast, check, full, package, web).
set -euo pipefail
cd "$(dirname "$0")/.."

release=$(. /etc/os-release && echo "${VERSION_ID:-}")
mapfile -t wanted < <(sed 's/#.*//' packages.txt |
  awk -v purposes=" $* " -v release="$release" \
    'NF == 1 || (NF >= 2 && index(purposes, " " $2 " ") && (NF == 2 || $3 == release)) {print $1}')
missing=()
for package in "${wanted[@]}"; do
  # shellcheck disable=SC2016  # the format is dpkg-query's, not the shell's
  if [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) != installed ]]; then
    missing+=("$package")
  fi
done
if ((${#missing[@]} == 0)); then
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  as_root=(sudo)
fi
echo "Installing ${#missing[@]} Debian packages: ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
