#!/bin/sh
# Takes two pictures of a window over a region with meshes, the second after a flight, as xdotool plays a user:
# window_mesh.sh PROGRAM PATH..., in an empty folder. Ends with the program's own exit code.
program=$1
shift
export XDG_CONFIG_HOME=$PWD/settings XDG_CACHE_HOME=$PWD/settings OROGRAPH_TRACE_WINDOW=1
"$program" view "$@" --size 320x200 --style default >printed.txt 2>states.txt &
viewer=$!
fail() { echo "$*" >&2; cat states.txt >&2; kill "$viewer" 2>/dev/null; exit 90; }
pictures() { ls orograph-*.png 2>/dev/null | wc -l; }
until_pictures() {
  for try in $(seq 600); do
    [ "$(pictures)" -lt "$1" ] || return 0
    kill -0 "$viewer" 2>/dev/null || break
    sleep 0.1
  done
  fail "no picture $1 came"
}
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
xdotool windowfocus --sync "$window" key p
until_pictures 1
xdotool keydown w; sleep 3; xdotool keyup w; sleep 2
xdotool key p
until_pictures 2
xdotool key Escape key ctrl+q
wait "$viewer"
