#!/bin/sh
# on_display.sh COMMAND ...: runs it on a virtual display of its own, and ends as it does. (xvfb-run mixes its own
# messages and exit code in when it cannot clear up fast enough.) SCREEN_FILE tells it where the display's pixels are:
# an X window dump, which is always as the screen is. SCREEN_SIZE: of the display, else 640x480. -noreset: a server that
# starts anew after its last client drops one that is just connecting.
folder=$(mktemp -d) || exit 90
mkfifo "$folder/number"
Xvfb -displayfd 4 -noreset -screen 0 "${SCREEN_SIZE:-640x480}x24" -fbdir "$folder" -nolisten tcp 4>"$folder/number" >/dev/null 2>&1 &
server=$!
read -r display <"$folder/number"
unset WAYLAND_DISPLAY
DISPLAY=:$display SCREEN_FILE=$folder/Xvfb_screen0 "$@"
code=$?
kill "$server" 2>/dev/null
wait "$server" 2>/dev/null
rm -r "$folder"
exit "$code"
