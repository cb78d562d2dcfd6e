#!/usr/bin/env bash
# On a bare Debian, as root: installs the packages that lie beside this script, plays the sample, opens the
# editor's window, removes the packages, and looks for what they left. Pictures of both go to ./seen.
#
#   try_packages.sh USER
set -euo pipefail
cd "$(dirname "$0")"
user=$1
sample=/usr/share/lararium/sample
export DEBIAN_FRONTEND=noninteractive

fail() {
  echo "FAILED: $*" >&2
  exit 1
}
as_user() { su --login "$user" --command "$*"; }

install -d -o "$user" seen
chmod a+rx . ./*.deb
apt-get update -qq
apt-get install -qq --yes --download-only ./*.deb > /dev/null
began=$SECONDS
apt-get install -qq --yes ./*.deb > install.log 2>&1 || { tail -n 20 install.log >&2; fail "they do not install"; }
installed=$SECONDS
as_user lararium-player "$sample/thermopolium.larshow" \
  --video "$sample/maquette/maquette.lararium/places/maquette/handheld.mp4" \
  --headless --audio none --pace fast --frames 1 --record "$PWD/seen/first.mp4" ||
  fail "the player does not play the sample"
[[ -s seen/first.mp4 ]] || fail "the player recorded no picture"
echo "installed in $((installed - began)) s, the first picture after $((SECONDS - began)) s"
as_user lararium-player "$sample/thermopolium.larshow" \
  --video "$sample/maquette/maquette.lararium/places/maquette/handheld.mp4" \
  --headless --audio none --pace fast --frames 90 --record "$PWD/seen/played.mp4"
echo "installed size of the player: $(dpkg-query -W -f '${Installed-Size}' lararium-player) kB"
for package in clang opencv-calib ceres assimp embree imgui espeak pocketsphinx; do
  ! dpkg-query -W -f '${Depends}' lararium-player | grep -q "$package" ||
    fail "the player's package depends on $package, which only authoring needs"
done
dpkg --listfiles lararium-editor | grep -q 'man1/lararium-editor-train.1.gz$' || fail "subcommands have no man pages"

apt-get install -qq --yes --no-install-recommends xvfb xauth xdotool imagemagick > /dev/null
cat > seen/look.sh <<'LOOK'
lararium-editor &
editor=$!
for ((i = 0; i < 300; ++i)); do
  xdotool search --name Lararium > /dev/null && break
  sleep 0.1
done
sleep 6
import -window root "$1"
xdotool key ctrl+q
wait $editor
LOOK
as_user "LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s '-screen 0 1440x900x24 -noreset' bash $PWD/seen/look.sh $PWD/seen/editor.png" ||
  fail "the editor's window"
(($(as_user "convert $PWD/seen/editor.png -format %k info:") > 1000)) || fail "the editor's window is empty"

as_user 'find ~ -type f | sort | xargs -r sha256sum' > owned
apt-get purge -qq --yes 'lararium-*' > /dev/null
left=$(find / -xdev -iname '*lararium*' -not -path "$PWD/*" -not -path "/home/*" -not -path '/var/cache/apt/*')
[[ -z $left ]] || fail "files are left: $left"
left=$(grep -rli lararium /etc /usr/share/applications /usr/share/mime /usr/share/icons 2> /dev/null || true)
[[ -z $left ]] || fail "these name it still: $left"
as_user 'find ~ -type f | sort | xargs -r sha256sum' | cmp - owned || fail "files of the user were changed"
echo "passed; pictures: $PWD/seen"
