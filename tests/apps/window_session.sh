#!/bin/sh
# A person at the window, as xdotool plays one: window_session.sh PROGRAM DATA, in an empty folder, on a display.
# Prints the window's state at each stop (OROGRAPH_TRACE_WINDOW), keeps what the program prints in picked.txt; ends with the
# program's own exit code.
program=$1 data=$2
export OROGRAPH_TRACE_WINDOW=1
"$program" view "$data" --style default --size 320x240 --at 36.6,-84.2 --above 500 --heading 30 \
  --sun-time 2026-06-21T16:00-04:00 -q >picked.txt 2>states.txt &
viewer=$!

fail() { echo "$*" >&2; kill "$viewer" 2>/dev/null; exit 90; }
window=
for try in $(seq 300); do
  window=$(xdotool search --onlyvisible --pid "$viewer" 2>/dev/null | head -n 1)
  [ -z "$window" ] || break
  kill -0 "$viewer" 2>/dev/null || { wait "$viewer"; exit $?; }
  sleep 0.1
done
[ -n "$window" ] || fail "no window came"
state() { sed -n 's/^state: //p' states.txt | tail -n 1; }
# says NAME PATTERN: waits until the state holds the pattern.
says() {
  for try in $(seq 200); do
    if state | grep -q "$2"; then printf '%s: %s\n' "$1" "$(state)"; return; fi
    sleep 0.1
  done
  fail "$1: the state stays '$(state)'"
}
# holds KEY...: for a while, as a hand does.
holds() {
  for key in "$@"; do xdotool keydown "$key"; done
  sleep 0.7
  for key in "$@"; do xdotool keyup "$key"; done
  sleep 0.3
}
# picks NAME PATTERN X Y: clicks there, and closes the panel that tells of it.
picks() {
  xdotool mousemove --window "$window" "$3" "$4" click 3; says "$1" "$2"
  xdotool key Escape; sleep 0.2
}

says start 'heading 30'
xdotool windowfocus --sync "$window"
picks sky '^no terrain' 160 2
holds w; says forward 'heading'
holds ctrl Right; says turned 'heading'
# What the left button takes hold of stays under the cursor, which comes from elsewhere.
picks held 'from jacksboro.tif' 100 190
xdotool mousemove --window "$window" 160 60; xdotool mousemove --window "$window" 100 190 mousedown 1; sleep 0.4
xdotool mousemove_relative 20 0; sleep 0.2; xdotool mousemove_relative 20 -10; sleep 0.4; xdotool mouseup 1; sleep 0.5
says dragged 'heading'
picks moved 'from jacksboro.tif' 140 180
holds space; says risen 'heading'
# A key that is held opens the field once, and is not typed into it.
xdotool keydown g; sleep 1.2; xdotool keyup g; says asked 'Go to: _'
# What is wrong is said beside the field, whose text stays; Escape closes it, and nothing else.
xdotool type '0,0'; xdotool key Return; says refused 'Go to: 0,0_.*no elevation data'
xdotool key Escape; sleep 0.5; xdotool key Escape; says nowhere 'no elevation data.*heading'
xdotool key ctrl+l ctrl+a; xdotool type '36.5,-84.3'; says typed 'Go to: 36.5,-84.3'
xdotool key Return; says shown 'Enter stands on it'
# What is looked at is in the middle of the picture.
picks aimed 'from jacksboro.tif' 160 120
xdotool key Return; says stood '^Backspace goes back'
xdotool key BackSpace; sleep 1; says unstood '^[0-9]'
xdotool key BackSpace; sleep 1; says returned '^[0-9]'
xdotool key g; xdotool type '36.5,-84.3'; xdotool key Return Return; says jumped '^Backspace goes back'
holds f; holds f; says looked-down 'heading'
for press in 1 2 3 4; do holds q; done; says sunk 'heading'
xdotool windowsize --sync "$window" 400 200; sleep 1; says resized 'heading'
xdotool key p; says pictured 'wrote orograph-'
# An odd size has a pixel in its middle.
xdotool windowsize --sync "$window" 401 201; sleep 1
picks picked 'from jacksboro.tif' 200 100
[ "$(xdotool getwindowname "$window")" = "Orograph - $(basename "$data")" ] || fail "the title is another"
xdotool key Escape; sleep 0.5
kill -0 "$viewer" 2>/dev/null || fail "Escape has ended it"
xdotool key ctrl+q
wait "$viewer"
