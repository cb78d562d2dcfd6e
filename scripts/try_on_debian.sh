#!/usr/bin/env bash
# Runs ./demo or ./check on a bare Debian, or makes the packages there and tries them on a second one: makes a
# root folder with debootstrap, clones the last commit of this checkout into it, and runs the command there as
# an ordinary user who may use sudo.
#
#   scripts/try_on_debian.sh 12|13 [demo|check|packages]      default: check
#
# The root is build/debian/RELEASE; an existing one is used again with a fresh clone, so remove it for a bare
# one. Needs root (sudo), debootstrap and a network. LARARIUM_DEBIAN_MIRROR names the archive; by default it
# is the one that this machine installs from.
set -euo pipefail
cd "$(dirname "$0")/.."

declare -A suites=([12]=bookworm [13]=trixie)
declare -A commands=(
  [demo]='time ./demo'
  [check]='time ./check'
  [packages]='scripts/install_packages.sh package && { command -v npm > /dev/null || scripts/install_packages.sh cast; } &&
    scripts/fetch_cast_library.sh && cmake --preset release &&
    cmake --build --preset release --target lararium-editor lararium-player && (cd build/release && cpack)')
suite=${suites[${1:-}]:-}
command=${2:-check}
if [[ -z $suite || $# -gt 2 || -z ${commands[$command]:-} ]]; then
  echo "usage: $0 12|13 [demo|check|packages]" >&2
  exit 2
fi
if ((EUID != 0)); then
  exec sudo --preserve-env=LARARIUM_DEBIAN_MIRROR "$0" "$@"
fi
if ! command -v debootstrap > /dev/null; then
  echo "$0: debootstrap is not installed; install it: apt-get install debootstrap" >&2
  exit 1
fi

mirror=${LARARIUM_DEBIAN_MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' |
  grep -m 1 '/debian/\?$')}
root=$PWD/build/debian/$1
user=visitor

# make_root FOLDER: a bare system with the user, where there is none yet.
make_root() {
  local root=$1
  [[ -e $root/.complete ]] && return
  rm -rf "$root"
  mkdir -p "$root"
  debootstrap --variant=minbase --include=ca-certificates,sudo "$suite" "$root" "$mirror"
  # Services are not started in a root folder.
  printf '#!/bin/sh\nexit 101\n' > "$root/usr/sbin/policy-rc.d"
  chmod +x "$root/usr/sbin/policy-rc.d"
  chroot "$root" useradd --create-home --shell /bin/bash "$user"
  echo "$user ALL=(ALL) NOPASSWD: ALL" > "$root/etc/sudoers.d/$user"
  cp /etc/hosts /etc/resolv.conf "$root/etc/"
  # Where npm fetches from, and whom it trusts there, are settings of the machine.
  cat /etc/npmrc "$HOME/.npmrc" 2> /dev/null > "$root/home/$user/.npmrc" || true
  cp -r /usr/local/share/ca-certificates "$root/usr/local/share/"
  chroot "$root" update-ca-certificates > /dev/null
  touch "$root/.complete"
}

# run_in FOLDER COMMAND...: the mounts are gone when the command ends, because they are made in a namespace of
# their own.
run_in() {
  # shellcheck disable=SC2016  # expanded by the inner shell
  unshare --mount --pid --fork --kill-child bash -euo pipefail -c '
    root=$1
    shift
    mount --make-rprivate /
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    mount -t tmpfs tmpfs "$root/tmp"
    exec chroot "$root" "$@"
  ' run_in "$@"
}

make_root "$root"
home=$root/home/$user
rm -rf "$home/lararium"
git -c safe.directory="$PWD" clone --quiet --no-hardlinks . "$home/lararium"
chroot "$root" chown -R "$user:$user" "/home/$user"
run_in "$root" su --login "$user" --command "cd lararium && ${commands[$command]}"
[[ $command == packages ]] || exit 0

bare=$root-bare
rm -rf "$bare"
make_root "$bare"
mkdir "$bare/packages"
cp "$home"/lararium/build/release/packages/*.deb packaging/try_packages.sh "$bare/packages/"
run_in "$bare" /packages/try_packages.sh "$user"
