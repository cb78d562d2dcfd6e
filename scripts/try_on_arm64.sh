#!/usr/bin/env bash
# Builds both programs for 64-bit ARM on a PC, and runs tests of the lowest rooms in qemu-user.
#
#   scripts/try_on_arm64.sh [TARGET...]      default: both programs and those tests
#
# The libraries are unpacked into build/debian/arm64, which takes 2 GB; an existing folder is used again.
# Needs g++-aarch64-linux-gnu, mmdebstrap, qemu-user and a network. LARARIUM_DEBIAN_MIRROR names the archive; by
# default it is the one that this machine installs from.
set -euo pipefail
cd "$(dirname "$0")/.."

rooms=(core geometry vision)
targets=("$@")
((${#targets[@]})) || targets=(lararium-editor lararium-player "${rooms[@]/%/_test}")

root=build/debian/arm64
libraries=$root/usr/lib/aarch64-linux-gnu
if [[ ! -e $root/.complete ]]; then
  # shellcheck disable=SC2016  # apt-get expands it
  mirror=${LARARIUM_DEBIAN_MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' |
    grep -m 1 '/debian/\?$')}
  # What the build looks for, of this machine's release, because flatc and its headers must be of one version.
  release=$(. /etc/os-release && echo "$VERSION_CODENAME")
  packages=$(sed 's/#.*//' packages.txt | awk 'NF == 1 && /-dev$|^pocketsphinx/ {print $1}' | paste -sd ,)
  rm -rf "$root"
  # The packages are unpacked and never configured, which needs neither ARM nor root.
  # shellcheck disable=SC2016  # the hook's shell expands it
  mmdebstrap --mode=chrootless --variant=extract --architectures=arm64 --include="libc6-dev,$packages" \
    --setup-hook='mkdir -p "$1/usr/lib" && ln -s usr/lib "$1/lib"' "$release" "$root" "$mirror"
  # What configuring would do: these are alternatives.
  for library in "$libraries"/{blas,lapack,atlas}/lib{blas,lapack}.so{,.3}; do
    [[ ! -e $library ]] || ln -sfr "$library" "$libraries"
  done
  find "$root" -type l -lname '/*' -printf '%p %l\n' | while read -r link target; do
    ln -sfnr "$root$target" "$link"
  done
  # Some CMake files name what they find by its place in a whole system.
  # shellcheck disable=SC2016  # CMake expands it
  find "$libraries/cmake" -name '*.cmake' -exec sed -i 's|\([";:]\)/usr\([/"]\)|\1${CMAKE_SYSROOT}/usr\2|g' {} +
  touch "$root/.complete"
fi

cmake --preset arm64
cmake --build --preset arm64 --target "${targets[@]}"
if (($# == 0)); then
  ctest --preset arm64 --tests-regex "^($(IFS='|' && echo "${rooms[*]}"))/unit"
fi
