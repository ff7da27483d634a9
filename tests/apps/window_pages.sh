#!/bin/sh
# Flies in a window whose GPU chooses the pages of terrain, jumps, changes the window's size, and takes a picture where the eye
# rests, as xdotool plays a user: window_pages.sh PROGRAM PATH..., in an empty folder. What the program traced is in
# states.txt. Ends with the program's own exit code.
program=$1
shift
export XDG_CONFIG_HOME=$PWD/settings XDG_CACHE_HOME=$PWD/settings OROGRAPH_TRACE_WINDOW=1
"$program" view "$@" --size 320x200 --style relief --gpu-pages on >printed.txt 2>states.txt &
viewer=$!
fail() { echo "$*" >&2; tail -n 20 states.txt >&2; kill "$viewer" 2>/dev/null; exit 90; }
# Until the last state says nothing of what is still to come.
until_whole() {
  for try in $(seq 600); do
    grep '^state: ' states.txt | tail -n 1 | grep -Eq 'loading|drawing|preparing|moving' || return 0
    kill -0 "$viewer" 2>/dev/null || break
    sleep 0.1
  done
  fail "$1: it never was whole"
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
until_whole "the first picture"
sleep 0.5
xdotool windowfocus --sync "$window" key Tab
width=240
for place in 46.54,8.00 46.20,7.60 46.80,7.10; do
  xdotool keydown shift keydown w; sleep 1; xdotool keydown Right; sleep 1; xdotool keyup Right keyup w keyup shift
  sleep 0.6
  until_whole "after a flight"
  xdotool key g; sleep 0.3; xdotool key ctrl+a; xdotool type --delay 20 "$place"; sleep 0.3; xdotool key Return Return
  sleep 0.6
  until_whole "after a jump to $place"
  xdotool keydown a; sleep 0.6; xdotool windowsize --sync "$window" $((width += 20)) 180; sleep 0.6; xdotool keyup a
  sleep 0.6
  until_whole "after another size"
done
xdotool key p
for try in $(seq 600); do
  ls orograph-*.png >/dev/null 2>&1 && break
  kill -0 "$viewer" 2>/dev/null || break
  sleep 0.1
done
sleep 1
xdotool key Escape key ctrl+q
wait "$viewer"
