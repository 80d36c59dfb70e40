"""``python -m infill``, for places where the script is not on the path."""

from infill.cli import program

program()
