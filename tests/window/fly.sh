#!/usr/bin/env bash
# Flies the viewer by keys and mouse in a window under Xvfb and reads its title. Arguments: the program, a region.
# Needs xvfb-run, xdotool and exiftool (scripts/packages.sh); run by ctest.
set -u
program=$1 region=$2
if [ "${3:-}" != inside ]; then
  exec xvfb-run -a -s "-screen 0 1280x1024x24" bash "$0" "$program" "$region" inside
fi
folder=$(mktemp -d) && cd "$folder" || exit 1
trap 'kill "$viewer" 2>/dev/null; rm -rf "$folder"' EXIT
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

OROGRAPH_VALIDATION=1 "$program" view "$region" --size 480x270 2> log & viewer=$!
window=
for _ in $(seq 150); do
  window=$(xdotool search --name 'heading' 2>/dev/null | head -n 1)
  [ -n "$window" ] && break
  kill -0 "$viewer" 2>/dev/null || { cat log; echo "FAILED: the viewer ended at once"; exit 1; }
  sleep 0.2
done
[ -n "$window" ] || { cat log; echo "FAILED: no window after 30 s"; exit 1; }
xdotool windowfocus "$window"
sleep 0.5

title() { xdotool getwindowname "$window"; }
# A number of the title: lat, lon, H or heading. The message before a bar is left out.
number() {
  title | sed 's/.*|  //' | awk -v what="$1" '{
    gsub("°", ""); if (what == "lat") print $1; if (what == "lon") print $2
    for (i = 1; i < NF; ++i) if ($i == what) print $(i + 1) }'
}
hold() { xdotool keydown "$1"; sleep "$2"; xdotool keyup "$1"; sleep 0.4; }
expect() { awk "BEGIN { exit !($1) }" || fail "$2: $1 ($(title))"; }
# Waits up to 10 s for the title to hold a text: software rendering is slow on a busy machine.
await() {
  for _ in $(seq 50); do title | grep -qF "$1" && return 0; sleep 0.2; done
  fail "the title never said '$1' but '$(title)'"
}

lat=$(number lat); hold w 1
expect "$(number lat) > $lat + 1e-4" "W goes north when heading north"
lat=$(number lat); hold s 1
expect "$(number lat) < $lat - 1e-4" "S goes back"
lon=$(number lon); hold d 1
expect "$(number lon) > $lon + 1e-4" "D goes right"
height=$(number H); hold space 1
expect "$(number H) > $height + 10" "Space climbs"
heading=$(number heading); hold e 0.6
expect "$(number heading) > $heading + 1" "E turns right"
heading=$(number heading)
xdotool mousemove --window "$window" 200 100 mousedown 1; sleep 0.4
xdotool mousemove_relative 60 0; sleep 0.4; xdotool mouseup 1; sleep 0.4
expect "$(number heading) < $heading - 1" "dragging right turns the view left"

xdotool key g; await "Go to: _"
xdotool type "nowhere"; await "Go to: nowhere_"
xdotool key Return; await "nowhere"
xdotool key g; await "Go to: _"
xdotool type "36.45,-84.3"; await "Go to: 36.45,-84.3_"
xdotool key Return; await "36.450000° -84.300000°"

# Down for long: the eye stops above the ground, whose lowest post is at 230 m.
hold ctrl 4
expect "$(number H) > 230" "Ctrl stops above the ground"
low=$(number H); hold ctrl 1
expect "$(number H) <= $low" "and stays there"

xdotool key p; await "wrote orograph-"
picture=$(ls orograph-*.png 2>/dev/null | head -n 1)
[ -n "$picture" ] && [ -e "${picture%.png}.json" ] || fail "P wrote no picture with its view"
tags=$(exiftool -n -s3 -GPSLatitude -GPSLongitude -GPSImgDirection "$picture" | paste -sd ' ')
set -- $tags
expect "${1:-0} - $(number lat) < 1e-6 && $(number lat) - ${1:-0} < 1e-6" "the picture's latitude is the title's"
expect "${2:-0} - $(number lon) < 1e-6 && $(number lon) - ${2:-0} < 1e-6" "the picture's longitude is the title's"
expect "${3:-0} - $(number heading) < 0.06 && $(number heading) - ${3:-0} < 0.06" "the picture's direction is the title's"

xdotool windowsize "$window" 600 400; sleep 1
xdotool key Escape
for _ in $(seq 50); do kill -0 "$viewer" 2>/dev/null || break; sleep 0.2; done
wait "$viewer"; status=$?
[ "$status" -eq 0 ] || fail "the viewer left with $status"
grep -v 'wrote\|nowhere' log && fail "it said more than it should"
[ "$failures" -eq 0 ] && echo "the viewer flies"
exit "$failures"
