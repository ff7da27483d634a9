#!/bin/sh
# A long flight in a window with panels open, as xdotool plays a user: window_flight.sh PROGRAM SECONDS PATH..., in an empty
# folder, on a display of 960 x 540 pixels. The eye goes to one of FLIGHT_PLACES after the other and flies on there, again and
# again. Prints, once a turn, "turn SECONDS RESIDENT_KB FILES THREADS" of the program's process; ends with the program's own exit code.
program=$1 seconds=$2
shift 2
export XDG_CONFIG_HOME=$PWD/settings XDG_CACHE_HOME=$PWD/settings OROGRAPH_TRACE_WINDOW=1
"$program" view "$@" --size 960x540 --style default --memory 64 --gpu-memory 100 >printed.txt 2>states.txt &
viewer=$!
fail() { echo "$*" >&2; kill "$viewer" 2>/dev/null; exit 90; }
window=
for try in $(seq 3000); do
  window=$(xdotool search --onlyvisible --pid "$viewer" 2>/dev/null | head -n 1)
  [ -z "$window" ] || break
  kill -0 "$viewer" 2>/dev/null || { cat states.txt >&2; wait "$viewer"; exit $?; }
  sleep 0.1
done
[ -n "$window" ] || fail "no window came"
for try in $(seq 3000); do
  grep -Eq 'first picture' states.txt && break
  kill -0 "$viewer" 2>/dev/null || { cat states.txt >&2; wait "$viewer"; exit $?; }
  sleep 0.1
done
xdotool windowfocus --sync "$window"
# The panels of layers and of figures, by their buttons above the picture.
for x in 344 687; do xdotool mousemove --window "$window" $x 27 click 1; sleep 0.5; done
xdotool mousemove --window "$window" 480 400
begun=$(date +%s) turn=0
while now=$(($(date +%s) - begun)); [ "$now" -lt "$seconds" ]; do
  turn=$((turn + 1))
  set -- $FLIGHT_PLACES
  shift $((turn % $#))
  xdotool key g; sleep 0.3; xdotool key ctrl+a; xdotool type --delay 20 "$1"; sleep 0.3; xdotool key Return Return; sleep 0.5
  xdotool keydown shift keydown w; sleep 1.5; xdotool keydown Right; sleep 0.7; xdotool keyup Right; sleep 0.7
  xdotool keyup w keyup shift
  xdotool click 5; xdotool click 5; sleep 0.3; xdotool click 3; sleep 0.3; xdotool key Escape
  case $((turn % 4)) in
    1) xdotool key Home ;;
    2) xdotool key BackSpace ;;
    3) xdotool windowsize --sync "$window" $((800 + turn % 160)) 500 ;;
    0) xdotool windowsize --sync "$window" 960 540 ;;
  esac
  sleep 0.5
  kill -0 "$viewer" 2>/dev/null || { tail -n 3 states.txt >&2; wait "$viewer"; exit $?; }
  printf 'turn %s %s %s %s\n' "$now" "$(sed -n 's/^VmRSS:[[:space:]]*\([0-9]*\).*/\1/p' "/proc/$viewer/status")" \
    "$(ls "/proc/$viewer/fd" | wc -l)" "$(ls "/proc/$viewer/task" | wc -l)"
  # What a trace holds is not what is measured.
  [ $((turn % 50)) -ne 0 ] || : >states.txt
done
xdotool windowfocus --sync "$window" key Escape key ctrl+q
wait "$viewer"
code=$?
[ "$code" -eq 0 ] || tail -n 3 states.txt >&2
exit "$code"
