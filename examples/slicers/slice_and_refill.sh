#!/usr/bin/env bash
# Slice a part with PrusaSlicer, give its infill round corners, and say what that saves.
#
#     bash slice_and_refill.sh part.stl --load my-settings.ini
#
# Writes part.gcode, as it was sliced, and part.smooth.gcode. All words after the part are PrusaSlicer's: my-settings.ini
# is what its File > Export > Export Config writes. PRUSA_SLICER names another program, such as that of an AppImage.
set -euo pipefail

if [ $# -eq 0 ]; then
    echo "usage: bash $0 PART.stl [option of PrusaSlicer ...]" >&2
    exit 2
fi
part=$1
shift
plain=${part%.*}.gcode
smooth=${part%.*}.smooth.gcode

"${PRUSA_SLICER:-prusa-slicer}" --export-gcode "$@" --output "$plain" "$part" > /dev/null
infill refill "$plain" --output "$smooth" --force
infill motion "$plain" "$smooth"
