#!/bin/sh
# A window that may have too little memory of the GPU for its view, which rests: window_memory.sh PROGRAM PATH..., in an empty
# folder. Ends once it says that all is there, or that memory is full, with the program's own exit code; what it traced is in
# states.txt.
program=$1
shift
export XDG_CONFIG_HOME=$PWD/settings XDG_CACHE_HOME=$PWD/settings OROGRAPH_TRACE_WINDOW=1
"$program" view "$@" --size 640x400 >printed.txt 2>states.txt &
viewer=$!
fail() { echo "$*" >&2; tail -n 20 states.txt >&2; kill "$viewer" 2>/dev/null; exit 90; }
grep_last() { grep '^state: ' states.txt | tail -n 1 | grep -Eq "$1"; }
is_done() { grep -q 'first picture' states.txt && { grep_last 'memory is full' || ! grep_last 'loading|drawing|preparing|moving'; }; }
for try in $(seq 1200); do
  is_done && sleep 0.5 && is_done && break
  kill -0 "$viewer" 2>/dev/null || { cat states.txt >&2; wait "$viewer"; exit $?; }
  sleep 0.1
done
is_done || fail "it goes on for ever"
window=$(xdotool search --onlyvisible --pid "$viewer" 2>/dev/null | head -n 1)
[ -n "$window" ] || fail "no window came"
xdotool windowfocus --sync "$window" key ctrl+q
wait "$viewer"
