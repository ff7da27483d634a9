#!/bin/sh
# A tour of the window, as xdotool plays a user: window_tour.sh PROGRAM DATA, in an empty folder, on a display of 960 x 540
# pixels. DATA holds N46E007 and N46E008, and is a folder. Keeps the screen after each stop as NAME.xwd, and prints its name
# and the window's state; ends with the program's own exit code.
program=$1 data=$2
export OROGRAPH_TRACE_WINDOW=1 XDG_CONFIG_HOME=$PWD/settings XDG_CACHE_HOME=$PWD/settings
printf '%s' '{"type": "LineString", "coordinates": [[7.95, 46.55], [7.99, 46.56], [8.03, 46.53], [8.06, 46.50]]}' >way.geojson
"$program" view "$data" --size 960x540 >printed.txt 2>states.txt &
viewer=$!

fail() { echo "$*" >&2; cp "$SCREEN_FILE" failed.xwd; kill "$viewer" 2>/dev/null; exit 90; }
window=
for try in $(seq 600); do
  window=$(xdotool search --onlyvisible --pid "$viewer" 2>/dev/null | head -n 1)
  [ -z "$window" ] || break
  kill -0 "$viewer" 2>/dev/null || { wait "$viewer"; exit $?; }
  sleep 0.1
done
[ -n "$window" ] || fail "no window came"
state() { sed -n 's/^state: //p' states.txt | tail -n 1; }
# rests NAME: waits until nothing moves or is loaded, and the screen has been the same for a while; keeps that.
rests() {
  same=0
  for try in $(seq 900); do
    sleep 0.2
    now=$(cksum <"$SCREEN_FILE")
    if [ "$now" = "$last" ] && ! state | grep -Eq 'moving|loading|preparing|opening|drawing'; then
      same=$((same + 1))
    else
      same=0
    fi
    last=$now
    [ "$same" -lt 12 ] || break
  done
  [ "$same" -ge 12 ] || fail "$1: the window does not come to rest: $(state)"
  cp "$SCREEN_FILE" "$1.xwd"
  printf '%s: %s\n' "$1" "$(state)"
}
goes() { xdotool key g; sleep 0.5; xdotool key ctrl+a; xdotool type --delay 30 "$1"; sleep 0.3; xdotool key Return; }
points() { xdotool mousemove --window "$window" "$1" "$2"; sleep 0.3; }
clicks() { points "$1" "$2"; xdotool click 1; sleep 0.5; }
press() { for one in "$@"; do xdotool key "$one"; sleep 0.4; done; }

rests start
xdotool windowfocus --sync "$window"
press question; rests keys; press Escape
goes N46E008; rests cell
points 480 200; xdotool click 4; sleep 0.3; xdotool click 4; sleep 0.3; xdotool click 4; sleep 0.3; rests zoomed
xdotool mousedown 1; xdotool mousemove_relative 80 40; sleep 0.5; xdotool mousemove_relative 80 40; sleep 0.5; xdotool mouseup 1
points 900 480; rests grabbed
points 480 270; xdotool mousedown 3; xdotool mousemove_relative 60 -30; sleep 0.5; xdotool mousemove_relative 60 -30; sleep 0.5
xdotool mouseup 3; points 900 480; rests orbited
press n; rests north
press u u u; rests undone
press Home; rests home
goes '46.577,8.005'; rests eiger
press Return; rests stood
goes '46.54,8.00'; rests ground
points 480 300; xdotool click 3; sleep 1; rests place; press Escape
# Each panel by its button; a line is measured by clicks, a film has two keys.
panel() { clicks "$2" 27; points 900 480; rests "$1"; press Escape; }
panel layers 344; panel sun 395; panel statistics 687; panel picture 618
clicks 452 27; clicks 560 330; clicks 640 300; clicks 720 350; points 900 480; rests measured; press Escape Escape
clicks 511 27; clicks 70 95; clicks 70 95; points 900 480; rests film; press Escape
points 480 300; xdotool click 3; sleep 1; clicks 694 140; points 900 480; rests viewshed; press Escape Escape
points 480 300; xdotool click 3; sleep 1; clicks 804 140; points 900 480; rests panorama; press Escape Escape
# A cursor blinks.
goes nowhere-at-all; sleep 3; cp "$SCREEN_FILE" refused.xwd; printf 'refused: %s\n' "$(state)"; press Escape Escape
press ctrl+o; sleep 0.5; press ctrl+a; xdotool type --delay 30 "$PWD/way.geojson"; sleep 0.3; press Return; sleep 2
press Escape Escape; sleep 5; rests overlay
press Tab; rests bare; press Tab
xdotool windowsize --sync "$window" 720 480; sleep 1; rests resized
xdotool windowunmap --sync "$window"; sleep 0.5; xdotool windowmap --sync "$window"; sleep 1; rests shown-again
press p; sleep 3; rests pictured
xdotool windowfocus --sync "$window"; press ctrl+q
wait "$viewer"
