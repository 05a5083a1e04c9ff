#!/bin/sh
# The window's tests under Xvfb, with pictures in OUTDIR.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
out=${1:?usage: gui.sh OUTDIR}
mkdir -p "$out"
out=$(cd "$out" && pwd)
export POLYCUBE_GUI_OUT="$out" QTWEBENGINE_DISABLE_SANDBOX=1
# FreeCAD's exit can crash after all is done: the status is what the tests wrote.
rm -f "$out/status"
xvfb-run -a -s "-screen 0 1280x1024x24" freecadcmd "$here/gui_main.py" || true
exit "$(cat "$out/status" 2>/dev/null || echo 1)"
