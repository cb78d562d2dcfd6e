#!/usr/bin/env bash
# Runs ./demo or ./check on a bare Debian: makes a root folder with debootstrap, clones the last commit of
# this checkout into it, and runs the command there as an ordinary user who may use sudo.
#
#   scripts/try_on_debian.sh 12|13 [demo|check]      default: check
#
# The root is build/debian/RELEASE; an existing one is used again with a fresh clone, so remove it for a bare
# one. Needs root (sudo), debootstrap and a network. LARARIUM_DEBIAN_MIRROR names the archive; by default it
# is the one that this machine installs from.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  echo "usage: $0 12|13 [demo|check]" >&2
  exit 2
}
declare -A suites=([12]=bookworm [13]=trixie)
suite=${suites[${1:-}]:-}
command=${2:-check}
[[ -n $suite && $# -le 2 && ($command == demo || $command == check) ]] || usage

if ((EUID != 0)); then
  exec sudo --preserve-env=LARARIUM_DEBIAN_MIRROR "$0" "$@"
fi
if ! command -v debootstrap >/dev/null; then
  echo "$0: debootstrap is not installed; install it: apt-get install debootstrap" >&2
  exit 1
fi

mirror=${LARARIUM_DEBIAN_MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' |
  grep -m 1 '/debian/\?$')}
root=$PWD/build/debian/$1
user=visitor
home=$root/home/$user
if [[ ! -e $root/.complete ]]; then
  rm -rf "$root"
  mkdir -p "$root"
  debootstrap --variant=minbase --include=ca-certificates,sudo "$suite" "$root" "$mirror"
  # Services are not started in a root folder.
  printf '#!/bin/sh\nexit 101\n' > "$root/usr/sbin/policy-rc.d"
  chmod +x "$root/usr/sbin/policy-rc.d"
  chroot "$root" useradd --create-home --shell /bin/bash "$user"
  echo "$user ALL=(ALL) NOPASSWD: ALL" > "$root/etc/sudoers.d/$user"
  touch "$root/.complete"
fi
cp /etc/hosts /etc/resolv.conf "$root/etc/"
# Where npm fetches from is a setting of the machine.
for settings in /etc/npmrc "$HOME/.npmrc"; do
  [[ -e $settings ]] && cp "$settings" "$home/.npmrc"
done

rm -rf "$home/lararium"
git -c safe.directory="$PWD" clone --quiet --no-hardlinks . "$home/lararium"
chroot "$root" chown -R "$user:$user" "/home/$user"

# The mounts are gone when the command ends, because they are made in a namespace of their own.
exec unshare --mount --pid --fork bash -euo pipefail -c '
  root=$1 user=$2 command=$3
  mount --make-rprivate /
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  mount -t tmpfs tmpfs "$root/tmp"
  # The compiler and the shared memory of windows get what this machine has.
  exec chroot "$root" su --login "$user" --command "cd lararium && time ./$command"
' try_on_debian "$root" "$user" "$command"
