#!/bin/sh
# A window over a world that nobody stores, as xdotool plays a user: window_world.sh PROGRAM PATH..., in an empty folder, on
# a display as large as the window. Keeps the settled screen in settled.xwd, flies a little while levels are measured, and
# takes a picture where the eye rests. What the program traced is in states.txt; prints the processor time until the first
# picture. Ends with the program's own exit code.
program=$1
shift
export XDG_CONFIG_HOME=$PWD/settings XDG_CACHE_HOME=$PWD/settings OROGRAPH_TRACE_WINDOW=1
"$program" view "$@" --size 320x200 >printed.txt 2>states.txt &
viewer=$!
fail() { echo "$*" >&2; tail -n 20 states.txt >&2; kill "$viewer" 2>/dev/null; exit 90; }
until_said() {
  for try in $(seq 6000); do
    grep -Eq "$1" states.txt && return 0
    kill -0 "$viewer" 2>/dev/null || { cat states.txt >&2; wait "$viewer"; exit $?; }
    sleep 0.05
  done
  fail "never said: $1"
}
until_whole() {
  for try in $(seq 6000); do
    grep '^state: ' states.txt | tail -n 1 | grep -Eq 'loading|drawing|preparing|moving' || return 0
    kill -0 "$viewer" 2>/dev/null || break
    sleep 0.1
  done
  fail "$1: it never was whole"
}
until_said 'first picture'
awk -v ticks="$(getconf CLK_TCK)" '{ printf "first picture after %.2f s of processor time\n", ($14 + $15) / ticks }' "/proc/$viewer/stat"
sleep 0.1
cp "$SCREEN_FILE" first.xwd
window=$(xdotool search --onlyvisible --pid "$viewer" 2>/dev/null | head -n 1)
[ -n "$window" ] || fail "no window came"
xdotool windowfocus --sync "$window" key Tab
until_said 'within [0-9.]* px so far'
until_whole "the first picture"
sleep 1
until_whole "the first picture"
cp "$SCREEN_FILE" settled.xwd
xdotool keydown w; sleep 0.5; xdotool keyup w
sleep 1
# While levels of the new view are measured.
xdotool keydown Right; sleep 0.5; xdotool keyup Right
sleep 0.6
until_whole "after a flight"
xdotool key p
for try in $(seq 6000); do
  ls orograph-*.png >/dev/null 2>&1 && break
  kill -0 "$viewer" 2>/dev/null || break
  sleep 0.1
done
sleep 1
xdotool key Escape key ctrl+q
wait "$viewer"
