#!/usr/bin/env bash
# Installs what the preset `web` needs: Debian's emscripten, and the libraries that have to be compiled for
# WebAssembly, from the sources of Debian 12.
#
#   scripts/install_web_tools.sh [FOLDER]      default: build/web-libraries
#
# FOLDER then has include/ and lib/. What is there already is compiled again only if its version, the compiler or
# its options changed; all of it takes about 15 minutes of processor time. Exit status: 0 all is there, 77 it
# cannot be had here, which a line that begins with "skipped" explains, 1 something cannot be compiled, 2 wrong usage.
set -euo pipefail

# The source packages: each version with the SHA-256 of its .dsc, which holds those of its other files. Recast is the
# release in Debian 14, as its authors made it, with the SHA-256 of their archive: mirrors lack the snapshot that
# Debian 12 has.
declare -A version=(
  [zlib]=1:1.2.13.dfsg-1
  [libjpeg-turbo]=1:2.1.5-2
  [opencv]=4.6.0+dfsg-12
  [libpng1.6]=1.6.39-2+deb12u5
  [lua5.4]=5.4.4-3+deb12u1
  [libsodium]=1.0.18-1+deb12u1
  [recastnavigation]=1.6.0+dfsg-3
  [flac]=1.4.2+ds-2
  [libogg]=1.3.5-3
  [libvorbis]=1.3.7-1
  [opus]=1.3.1-3
  [libsndfile]=1.2.0-1+deb12u1
)
declare -A sha256=(
  [libpng1.6]=7b86211030a34deb6b0a2cd7e1d9db0fe92443fd30cab537fb89b1e7f7c9f188
  [lua5.4]=d47c50154294a68c8a209c5d61bc09e5b22891c01b7c47501ac3f9725eb4a813
  [libsodium]=2c23c57b5a9385dab5a1916014c9b5f2cdd7dadeb8a35b28c1bfb603ce7095c4
  [recastnavigation]=d2f4a25e6e21d72f0cea4dd45152c790ffb312d7675582126602242102bdfec7
  [flac]=2f855e77c68e3e9818b47553bb4f33918fb558fe9cf58b30a089a99f811d3beb
  [libogg]=dd0bac7c6961f95290250f82940aba93582edc3924372afc8fd310af5db995a0
  [libvorbis]=b25d27beb9162607c95cf58aa2b764d110bd1a1568d3926a96c523320b49171f
  [opus]=c373ac82a1afb824819618c12e279ee47b6ac2fa18083b9ef2bb9e8e9e588419
  [libsndfile]=74686b038b925f4b238d0a37e36671e5b924fe1678083037494923140403fa8e
  [zlib]=3fa1e6b2fc525062aa88207dda52fed8e045373c809d362fe8a2bfbf7cf515a8
  [libjpeg-turbo]=d718ead0dfbcbc8523665c02a7f7152e31039ded641d022868722623bb3b486d
  [opencv]=66d014c59f65ed670ee05d5695e5c0a500fa7ce2539a32bfa15ef5a9da2a4ffd
)
# Each comes after those that it needs.
libraries=(zlib libjpeg-turbo opencv libpng1.6 lua5.4 libsodium recastnavigation flac libogg libvorbis opus libsndfile)

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

# Programs are downloaded: what is not called for each pixel or vertex is compiled to be small.
small=-DCMAKE_BUILD_TYPE=MinSizeRel

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

# archive NAME COMPILER OPTION... -- SOURCE...: compiles sources into lib/libNAME.a, without a build system.
archive() {
  local name=$1 compile=() objects=()
  shift
  while [ "$1" != -- ]; do
    compile+=("$1")
    shift
  done
  shift
  for source in "$@"; do
    objects+=("$name.${#objects[@]}.o")
    "${compile[@]}" -Os -msimd128 -fwasm-exceptions -ffp-contract=off -sSUPPORT_LONGJMP=emscripten \
      -c "$source" -o "${objects[-1]}" || return
  done
  rm -f "$folder/lib/lib$name.a"
  emar rcs "$folder/lib/lib$name.a" "${objects[@]}"
}

build_libpng1.6() {
  configure "$1" $small -DPNG_SHARED=OFF -DPNG_TESTS=OFF -DZLIB_LIBRARY="$folder/lib/libz.a" \
    -DZLIB_INCLUDE_DIR="$folder/include" -DM_LIBRARY= &&
    cmake --build "$1/build" --target png_static &&
    install -D -m 644 "$1/build/libpng16.a" "$folder/lib/libpng.a" &&
    install -D -m 644 -t "$folder/include" "$1"/{png,pngconf}.h "$1/build/pnglibconf.h"
}

# Lua is compiled as C++, so that its errors are exceptions.
build_lua5.4() {
  cd "$1/src" &&
    sed -i '/lua5.4-deb-multiarch.h/d; s/DEB_HOST_MULTIARCH/""/' luaconf.h &&
    archive lua em++ -x c++ -DLUA_COMPAT_5_3 -Wno-deprecated -- \
      l{api,code,ctype,debug,do,dump,func,gc,lex,mem,object,opcodes,parser,state,string,table,tm,undump,vm,zio}.c \
      l{auxlib,baselib,corolib,dblib,iolib,mathlib,oslib,strlib,tablib,utf8lib,oadlib,init}.c &&
    install -D -m 644 -t "$folder/include/lua" lua.h luaconf.h lauxlib.h lualib.h
}

build_libsodium() {
  local sources
  cd "$1/src/libsodium" &&
    mapfile -t sources < <(find . -name '*.c' | LC_ALL=C sort) &&
    sed 's/@VERSION@/1.0.18/; s/@SODIUM_LIBRARY_VERSION_MAJOR@/10/; s/@SODIUM_LIBRARY_VERSION_MINOR@/3/;
      /@SODIUM_LIBRARY_MINIMAL_DEF@/d' include/sodium/version.h.in > include/sodium/version.h &&
    archive sodium emcc -Iinclude -Iinclude/sodium -DCONFIGURED=1 -DNDEBUG -DHAVE_C_VARARRAYS=1 \
      -DNATIVE_LITTLE_ENDIAN=1 -Wno-unknown-pragmas -- "${sources[@]}" &&
    install -D -m 644 -t "$folder/include/sodium" include/sodium/*.h &&
    install -D -m 644 -t "$folder/include" include/sodium.h
}

build_recastnavigation() {
  cd "$1" &&
    archive recast em++ -DNDEBUG -I{Recast,Detour,DetourCrowd}/Include -- {Recast,Detour,DetourCrowd}/Source/*.cpp &&
    install -D -m 644 -t "$folder/include/recastnavigation" {Recast,Detour,DetourCrowd}/Include/*.h
}

build_flac() {
  configure "$1" $small -DBUILD_{CXXLIBS,PROGRAMS,EXAMPLES,TESTING,DOCS}=OFF \
    -D{WITH_OGG,WITH_STACK_PROTECTOR,WITH_FORTIFY_SOURCE,INSTALL_MANPAGES}=OFF &&
    cmake --build "$1/build" &&
    cmake --install "$1/build"
}

build_libogg() {
  configure "$1" $small -DBUILD_TESTING=OFF -DINSTALL_DOCS=OFF &&
    cmake --build "$1/build" &&
    cmake --install "$1/build"
}

build_libvorbis() {
  configure "$1" $small -DOGG_LIBRARY="$folder/lib/libogg.a" -DOGG_INCLUDE_DIR="$folder/include" &&
    cmake --build "$1/build" &&
    cmake --install "$1/build"
}

# The archive of Opus lacks a file that its CMakeLists.txt includes.
build_opus() {
  local sources
  cd "$1" &&
    read -r -a sources < <(make -s -f <(
      printf 'include %s_sources.mk\n' opus celt silk
      # shellcheck disable=SC2016  # make expands it
      printf 'all:\n\t@echo $(OPUS_SOURCES) $(OPUS_SOURCES_FLOAT) $(CELT_SOURCES) $(SILK_SOURCES) $(SILK_SOURCES_FLOAT)\n'
    )) &&
    archive opus emcc -Iinclude -Icelt -Isilk -Isilk/float -DOPUS_BUILD -DVAR_ARRAYS -DHAVE_LRINT -DHAVE_LRINTF \
      -D'PACKAGE_VERSION="1.3.1"' -- "${sources[@]}" &&
    install -D -m 644 -t "$folder/include/opus" include/*.h
}

build_libsndfile() {
  configure "$1" $small -DBUILD_{PROGRAMS,EXAMPLES,TESTING}=OFF -DENABLE_{MPEG,CPACK}=OFF \
    -D{OGG,Vorbis_Vorbis,FLAC,OPUS}_INCLUDE_DIR="$folder/include" -DVorbis_Enc_INCLUDE_DIR="$folder/include" \
    -DOGG_LIBRARY="$folder/lib/libogg.a" -DFLAC_LIBRARY="$folder/lib/libFLAC.a" \
    -DVorbis_Vorbis_LIBRARY="$folder/lib/libvorbis.a" -DVorbis_Enc_LIBRARY="$folder/lib/libvorbisenc.a" \
    -DOPUS_LIBRARY="$folder/lib/libopus.a" &&
    grep -q 'HAVE_EXTERNAL_XIPH_LIBS:INTERNAL=1\|define HAVE_EXTERNAL_XIPH_LIBS 1' -r "$1/build" &&
    cmake --build "$1/build" --target sndfile &&
    install -D -m 644 -t "$folder/lib" "$1/build/libsndfile.a" &&
    install -D -m 644 -t "$folder/include" "$1/include/sndfile.h"
}

"$root/scripts/install_packages.sh" web || skip "emscripten cannot be installed; is there a network?"
command -v emcc > /dev/null || skip "it was made for emscripten 3.1.6, which Debian 12 has"

# state LIBRARY: what its compiled files depend on.
state() {
  {
    echo "${sha256[$1]} $small"
    emcc -dumpversion
    cat "$root/cmake/web.cmake"
    declare -f configure "build_$1"
    if [[ $(declare -f "build_$1") == *archive* ]]; then
      declare -f archive
    fi
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
for suite in bookworm forky; do
  echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main"
done > "$work/sources.list"
source_of() {
  apt-get -qq -o Dir::Etc::sourcelist="$work/sources.list" -o Dir::Etc::sourceparts=/dev/null \
    -o Dir::State::lists="$work/lists" -o Dir::Cache::srcpkgcache= -o Dir::Cache::pkgcache= \
    -o APT::Sandbox::User=root "$@"
}
unpack() {
  case $1 in
    *.dsc) dpkg-source -q -x "$1" "$2" ;;
    *) mkdir "$2" && tar -x -f "$1" -C "$2" --strip-components=1 ;;
  esac
}
source_of update || skip "the list of Debian's sources cannot be fetched; is there a network?"
for library in "${missing[@]}"; do
  echo "compiling $library ${version[$library]} for browsers"
  if [ "$library" = recastnavigation ]; then
    part=--tar-only
    file=$work/${library}_${version[$library]%-*}.orig.tar.gz
  else
    part=--download-only
    file=$work/${library}_${version[$library]#*:}.dsc
  fi
  (cd "$work" && source_of source $part "$library=${version[$library]}") ||
    skip "apt-get cannot fetch the source of $library ${version[$library]}"
  if [ "$(sha256sum "$file" | cut -d ' ' -f 1)" != "${sha256[$library]}" ]; then
    echo "$0: the source of $library is not what it was; it is not unpacked" >&2
    exit 1
  fi
  # dpkg-source compares every file with the sums in the .dsc, and applies Debian's patches.
  if ! unpack "$file" "$work/$library" > "$work/log" 2>&1 ||
    ! ("build_$library" "$work/$library") > "$work/log" 2>&1; then
    tail -n 40 "$work/log" >&2
    echo "$0: $library cannot be compiled" >&2
    exit 1
  fi
  state "$library" > "$folder/.$library"
  rm -rf "${work:?}/$library"
done
echo "the libraries for browsers are in $folder"
