#!/usr/bin/env bash
# Refill every .gcode file of a folder in place; those that were refilled before stay as they are.
#
#     bash refill_folder.sh folder --density same
#
# All words after the folder are those of `infill refill`. A file that fails stays as it was; the others go on.
set -uo pipefail

if [ $# -eq 0 ]; then
    echo "usage: bash $0 FOLDER [option of infill refill ...]" >&2
    exit 2
fi
folder=$1
shift
failed=0
for gcode in "$folder"/*.gcode; do
    [ -e "$gcode" ] || continue # there is none
    infill refill "$@" "$gcode" || failed=$((failed + 1))
done
echo "$failed failed"
[ "$failed" -eq 0 ]
