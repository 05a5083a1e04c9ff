#!/bin/sh
# The window's tests under Xvfb, with pictures in OUTDIR. Each module has a FreeCAD of its own, all of them run unless some are named.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
out=${1:?usage: gui.sh OUTDIR [MODULE...]}
shift
mkdir -p "$out"
out=$(cd "$out" && pwd)
export POLYCUBE_GUI_OUT="$out" QTWEBENGINE_DISABLE_SANDBOX=1
[ $# -gt 0 ] || set -- gui_first gui_tests gui_panel gui_keys gui_refine gui_follow gui_blocks gui_aids gui_solve gui_user gui_rounds gui_openings
worst=0
for module; do
    # FreeCAD's exit can crash after all is done: the status is what the tests wrote.
    rm -f "$out/status"
    POLYCUBE_GUI_MODULE=$module xvfb-run -a -s "-screen 0 1280x1024x24" freecadcmd "$here/gui_main.py" || true
    [ "$(cat "$out/status" 2>/dev/null || echo 1)" = 0 ] || worst=1
done
exit $worst
