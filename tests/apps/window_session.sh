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
eye() { state | grep -o '[0-9.-]*° [0-9.-]*°  [0-9.-]* m above sea level  heading [0-9.]*°' | tail -n 1; }
# until_so WHAT COMMAND...: waits for what the window does next, however long its frames take beside other programs.
until_so() {
  what=$1; shift
  for try in $(seq 600); do
    if "$@"; then return; fi
    kill -0 "$viewer" 2>/dev/null || break
    sleep 0.1
  done
  fail "$what: the state stays '$(state)'"
}
holds_pattern() { state | grep -Eq "$1"; }
lacks_pattern() { [ -n "$(state)" ] && ! holds_pattern "$1"; }
still_holds() { lacks_pattern moving && holds_pattern "$1"; }
elsewhere_holds() { still_holds "$1" && [ "$(eye)" != "$said_eye" ]; }
tells() { printf '%s: %s\n' "$1" "$(state)"; said_eye=$(eye); }
# says NAME PATTERN: once the state holds the pattern, and nothing moves. comes: and the eye is elsewhere than it was said last.
says() { until_so "$1" still_holds "$2"; tells "$1"; }
comes() { until_so "$1" elsewhere_holds "$2"; tells "$1"; }
# holds KEY...: for a while, as a hand does, from when the window knows of them until it knows that they are let go.
holds() {
  for key in "$@"; do xdotool keydown "$key"; done
  until_so "$* is held" holds_pattern moving
  sleep 0.7
  for key in "$@"; do xdotool keyup "$key"; done
  until_so "$* is let go" lacks_pattern moving
}
# picks NAME PATTERN X Y: clicks there once the picture is whole, and closes the panel that tells of it.
picks() {
  until_so "$1 is drawn" lacks_pattern 'moving|loading|drawing'
  xdotool mousemove --window "$window" "$3" "$4"; sleep 0.3; xdotool click 3; says "$1" "$2"
  xdotool key Escape; sleep 0.2
}
# sizes WIDTH HEIGHT: what is asked for afterwards has that size, for a field opens and closes after the window has taken it.
sizes() {
  xdotool windowsize --sync "$window" "$1" "$2"
  xdotool key g; until_so "$1 x $2" holds_pattern '^Go to'
  xdotool key Escape; until_so "$1 x $2" lacks_pattern '^Go to'
  sleep 1  # a panel that has gone takes clicks until the window has been shown without it
}

says start 'heading 30'
xdotool windowfocus --sync "$window"
picks sky '^no terrain' 160 2
holds w; says forward 'heading'
holds ctrl Right; says turned 'heading'
# What the left button takes hold of stays under the cursor, which comes from elsewhere.
picks held 'from jacksboro.tif' 100 190
xdotool mousemove --window "$window" 160 60; xdotool mousemove --window "$window" 100 190 mousedown 1; sleep 0.4
xdotool mousemove_relative 20 0; sleep 0.2; xdotool mousemove_relative 20 -10; sleep 0.4; xdotool mouseup 1
comes dragged 'heading'
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
xdotool key BackSpace; comes unstood '^[0-9]'
xdotool key BackSpace; comes returned '^[0-9]'
xdotool key g; xdotool type '36.5,-84.3'; xdotool key Return Return; says jumped '^Backspace goes back'
holds f; holds f; says looked-down 'heading'
for press in 1 2 3 4; do holds q; done; says sunk 'heading'
sizes 400 200; says resized 'heading'
xdotool key p; says pictured 'wrote orograph-'
# An odd size has a pixel in its middle.
sizes 401 201
picks picked 'from jacksboro.tif' 200 100
[ "$(xdotool getwindowname "$window")" = "Orograph - $(basename "$data")" ] || fail "the title is another"
xdotool key Escape; sleep 0.5
kill -0 "$viewer" 2>/dev/null || fail "Escape has ended it"
xdotool key ctrl+q
wait "$viewer"
