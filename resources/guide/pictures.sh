#!/bin/sh
# The pictures of the user guide (Mod/Polycube/README.md), taken anew from the workbench as it is: sh resources/guide/pictures.sh [OUTDIR]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here/../../Mod/Polycube/guide}
mkdir -p "$out"
out=$(cd "$out" && pwd)
rm -f "$out/failed"
POLYCUBE_GUIDE_OUT="$out" QTWEBENGINE_DISABLE_SANDBOX=1 xvfb-run -a -s "-screen 0 1100x760x24" freecadcmd "$here/pictures.py" || true
[ ! -e "$out/failed" ] || { cat "$out/failed" >&2; rm "$out/failed"; exit 1; }
