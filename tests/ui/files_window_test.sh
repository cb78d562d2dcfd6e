#!/bin/bash
# Chooses files by real input events: in the window's own list, by typing ahead and by keys, where the
# desktop has no dialog; from a portal of the test's own, on a bus of its own; and by dropping them as
# a file manager does. A project gets a title whose folder follows.
#
#   files_window_test.sh EDITOR OUTPUT_FOLDER MOCK_PORTAL DROP_FILES VIDEO
set -u
mock_portal=$3
drop_files=$4
video=$5

. "$(dirname "$0")/window.sh"
need dbus-daemon
begin_test "$0" "$@"
export HOME=$out/home XDG_DATA_HOME=$out/data
mkdir -p "$HOME/films/old takes" "$HOME/frames"
cp "$video" "$HOME/films/walk one.mp4"
cp "$video" "$HOME/films/Größe.mp4"
touch "$HOME/films/notes.txt" "$HOME/probe.hdr" "$HOME/statue.glb" "$HOME/figure.vrm"
import -window root "$HOME/frames/1.png"
"$editor" new "$HOME/second.lararium" --title "The second" > /dev/null || fail "no project"

drop() { "$drop_files" "$(xdotool search --name Lararium | head -1)" "$@" || fail "$* was not taken"; sleep 1; }
begin() {
  open_window 1300 860 "$@"
  settle
}

# The window's own list: home, f for films, Right opens it; w for the file, Enter takes it.
begin
press ctrl+n
shot untouched
fill 740 372 "Casa del Fauno, atrio"
shot titled
click 958 497  # Browse
shot list
press f
press Right
shot films
press w
press Return
shot chosen
click 933 594  # Train
wait_for 20 titled "Casa del Fauno, atrio" || fail "no project was made"
json=$HOME/Casa_del_Fauno_atrio.lararium/project.json
[ -e "$json" ] || fail "its folder does not follow from the title"
tr -d '\n' < "$json" | grep -q 'walk one.mp4' || fail "it has no recording"
tr -d '\n' < "$json" | grep -q '"title": "Casa del Fauno, atrio"' || fail "it has no title"
kill $pid
wait $pid

# Dropped on the start page: a video begins a project, a project is opened.
begin
drop "file://$HOME/films/Gr%C3%B6%C3%9Fe.mp4"
shot dropped_video
press Escape
drop "file://$HOME/films/notes.txt"
shot dropped_notes
drop "file://$HOME/second.lararium"
wait_for 20 titled "The second" || fail "a dropped project was not opened"

# In the project: a model is asked about, a figure becomes a person, and what is of no use is told.
sleep 1
drop "file://$HOME/statue.glb"
shot dropped_model
press Escape
drop "file://$HOME/figure.vrm"
shot dropped_figure
press Escape
drop "file://$HOME/films/notes.txt"
shot dropped_text
press Return
# A video in place of the one that a dialog names.
press F1
press Escape
drop "file://$HOME/films/walk%20one.mp4"
shot dropped_recording
drop "file://$HOME/films/Gr%C3%B6%C3%9Fe.mp4"
shot dropped_other
press Escape
# An edit that is not saved outlives the change to another project.
drop "file://$HOME/Casa_del_Fauno_atrio.lararium/project.json"
wait_for 20 titled "Casa del Fauno" || fail "the other project was not opened"
quit

# The desktop's dialog.
cat > "$out/bus.conf" << CONF
<busconfig><type>session</type><listen>unix:dir=$out</listen><auth>EXTERNAL</auth>
<policy context="default"><allow send_destination="*" eavesdrop="true"/><allow eavesdrop="true"/>
<allow own="*"/></policy></busconfig>
CONF
exec 3< <(exec dbus-daemon --config-file="$out/bus.conf" --nofork --print-address 2> "$out/bus.log")
bus=$!
read -r address <&3
trap 'kill $bus ${portal:-} 2> /dev/null' EXIT
export DBUS_SESSION_BUS_ADDRESS=$address
"$mock_portal" choose "file://$HOME/films/Gr%C3%B6%C3%9Fe.mp4" > "$out/portal.log" 2>&1 &
portal=$!
wait_for 5 grep -q ready "$out/portal.log" || fail "no portal"
begin
press ctrl+n
click 958 497
sleep 1
shot portal
grep -q '^OpenFile parent=x11:[0-9a-f]* title=Choose a video .*filters=Videos:\*' "$out/portal.log" ||
  fail "the portal was asked: $(cat "$out/portal.log")"
fill 740 372 "By the desktop"
click 933 594
wait_for 20 titled "By the desktop" || fail "no project was made"
tr -d '\n' < "$HOME/By_the_desktop.lararium/project.json" | grep -q 'Größe.mp4' || fail "not the chosen file"
kill $pid
wait $pid
echo "passed; screenshots: $out/list.png $out/titled.png"
