#!/usr/bin/env bash
# Installs what the preset `web` needs: Debian's emscripten, and the libraries that have to be compiled for
# WebAssembly, from the sources of Debian 12.
#
#   scripts/install_web_tools.sh [FOLDER]      default: build/web-libraries
#
# FOLDER then has include/ and lib/. What is there already is compiled again only if its version, the compiler or
# its options changed; all of it takes about ten minutes of processor time. Exit status: 0 all is there, 77 it
# cannot be had here, which a line that begins with "skipped" explains, 1 something cannot be compiled, 2 wrong usage.
set -euo pipefail

# The source packages: each version with the SHA-256 of its .dsc, which holds those of its other files.
declare -A version=(
  [zlib]=1:1.2.13.dfsg-1
  [libjpeg-turbo]=1:2.1.5-2
  [opencv]=4.6.0+dfsg-12
)
declare -A sha256=(
  [zlib]=3fa1e6b2fc525062aa88207dda52fed8e045373c809d362fe8a2bfbf7cf515a8
  [libjpeg-turbo]=d718ead0dfbcbc8523665c02a7f7152e31039ded641d022868722623bb3b486d
  [opencv]=66d014c59f65ed670ee05d5695e5c0a500fa7ce2539a32bfa15ef5a9da2a4ffd
)
# OpenCV needs zlib, which comes before it.
libraries=(zlib libjpeg-turbo opencv)

if [ $# -gt 1 ]; then
  echo "usage: $0 [FOLDER]" >&2
  exit 2
fi
root=$(cd "$(dirname "$0")/.." && pwd)
folder=${1:-$root/build/web-libraries}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
export EM_NODE_JS=$root/cmake/web_node.sh NODE_PATH=/usr/share/nodejs

skip() {
  echo "skipped: the build for browsers: $1"
  exit 77
}

# configure SOURCE OPTION...: configures a library into SOURCE/build.
configure() {
  local source=$1
  shift
  cmake -G Ninja -S "$source" -B "$source/build" -DCMAKE_TOOLCHAIN_FILE="$root/cmake/web.cmake" \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$folder" -DCMAKE_INSTALL_LIBDIR=lib "$@"
}

# Functions that compile run where the shell does not stop at an error by itself.
build_zlib() {
  cd "$1" &&
    CHOST=wasm32 CC=emcc AR=emar RANLIB=emranlib CFLAGS="-O3 -msimd128 -fwasm-exceptions -sSUPPORT_LONGJMP=emscripten" \
    ./configure --static --prefix="$folder" &&
    make libz.a &&
    install -D -m 644 -t "$folder/lib" libz.a &&
    install -D -m 644 -t "$folder/include" zlib.h zconf.h
}

build_libjpeg-turbo() {
  configure "$1" -DWITH_SIMD=OFF -DWITH_TURBOJPEG=OFF -DENABLE_SHARED=OFF &&
    cmake --build "$1/build" --target jpeg-static &&
    install -D -m 644 -t "$folder/lib" "$1/build/libjpeg.a" &&
    install -D -m 644 -t "$folder/include" "$1"/{jpeglib,jmorecfg,jerror}.h "$1/build/jconfig.h"
}

build_opencv() {
  local without=(-DBUILD_{SHARED_LIBS,opencv_apps,opencv_python3,JAVA,TESTS,PERF_TESTS,DOCS,EXAMPLES,ZLIB}"=OFF"
    -DWITH_{PTHREADS_PF,OPENCL,ITT,IPP,LAPACK,EIGEN,QUIRC,PROTOBUF,ADE,FFMPEG,GSTREAMER,V4L,GTK}"=OFF"
    -DWITH_{PNG,JPEG,TIFF,WEBP,OPENJPEG,JASPER,OPENEXR}"=OFF")
  configure "$1" "${without[@]}" -DBUILD_LIST=core,imgproc -DCV_TRACE=OFF -DCPU_BASELINE= -DCPU_DISPATCH= \
    -DENABLE_PIC=OFF -DOPENCV_GENERATE_PKGCONFIG=OFF \
    -DZLIB_LIBRARY="$folder/lib/libz.a" -DZLIB_INCLUDE_DIR="$folder/include" &&
    cmake --build "$1/build" &&
    cmake --install "$1/build" --component dev
}

"$root/scripts/install_packages.sh" web || skip "emscripten cannot be installed; is there a network?"
command -v emcc > /dev/null || skip "it was made for emscripten 3.1.6, which Debian 12 has"

# state LIBRARY: what its compiled files depend on.
state() {
  {
    echo "${sha256[$1]}"
    emcc --version | head -n 1
    cat "$root/cmake/web.cmake"
    declare -f configure "build_$1"
  } | sha256sum | cut -d ' ' -f 1
}

missing=()
for library in "${libraries[@]}"; do
  if [ "$(cat "$folder/.$library" 2> /dev/null)" != "$(state "$library")" ]; then
    missing+=("$library")
  fi
done
if ((${#missing[@]} == 0)); then
  echo "the libraries for browsers are in $folder"
  exit 0
fi

. "$root/scripts/fetched.sh"
an_empty_folder
mkdir -p "$work/lists/partial"
# shellcheck disable=SC2016  # apt-get expands it
mirror=${LARARIUM_DEBIAN_MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' |
  grep -m 1 '/debian/\?$' || true)}
[ -n "$mirror" ] || skip "apt-get names no archive of Debian; set LARARIUM_DEBIAN_MIRROR"
echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror bookworm main" > "$work/sources.list"
source_of() {
  apt-get -qq -o Dir::Etc::sourcelist="$work/sources.list" -o Dir::Etc::sourceparts=/dev/null \
    -o Dir::State::lists="$work/lists" -o Dir::Cache::srcpkgcache= -o Dir::Cache::pkgcache= \
    -o APT::Sandbox::User=root "$@"
}
source_of update || skip "the list of Debian's sources cannot be fetched; is there a network?"
for library in "${missing[@]}"; do
  echo "compiling $library ${version[$library]} for browsers"
  (cd "$work" && source_of source --download-only "$library=${version[$library]}") ||
    skip "apt-get cannot fetch the source of $library ${version[$library]}"
  dsc=$work/${library}_${version[$library]#*:}.dsc
  if [ "$(sha256sum "$dsc" | cut -d ' ' -f 1)" != "${sha256[$library]}" ]; then
    echo "$0: the source of $library is not what it was; it is not unpacked" >&2
    exit 1
  fi
  # It compares every file with the sums in the .dsc, and applies Debian's patches.
  if ! dpkg-source -q -x "$dsc" "$work/$library" > "$work/log" 2>&1 ||
    ! ("build_$library" "$work/$library") > "$work/log" 2>&1; then
    tail -n 40 "$work/log" >&2
    echo "$0: $library cannot be compiled" >&2
    exit 1
  fi
  state "$library" > "$folder/.$library"
  rm -rf "${work:?}/$library"
done
echo "the libraries for browsers are in $folder"
