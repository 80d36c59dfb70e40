"""The options of `infill motion`, declared once: the printer, and limits for the entire file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from infill.gcode.given_limits import parse_macros
from infill.gcode.limit_names import parse_limits
from infill.options.declaration import Option

PRINTER, ENTIRE, FILES = "The printer", "Limits for the entire file, whatever its commands say", "Files"
AS_IN_FILE = "as in the file"


@dataclass(frozen=True, kw_only=True)
class MotionOptions:
    """Options of a plan; docs/motion.md explains them."""

    printer: Annotated[
        Path | None,
        Option(
            "The printer's own limits: Klipper's printer.cfg, Moonraker's answer as JSON, or Marlin's answer to M503.",
            PRINTER,
            unit="FILE",
            default="the limits in the print",
        ),
    ] = None
    limits: Annotated[
        Mapping[str, float] | None,
        Option(
            "Limits of the printer, such as max_accel=3000,max_z_velocity=15 or 'M205 J=0.02'; may be given again. "
            "Commands in the file change them, as on the printer.",
            PRINTER,
            unit="NAME=VALUE,...",
            read=parse_limits,
            typed=list[str],
        ),
    ] = None
    macros: Annotated[
        Mapping[str, float] | None,
        Option(
            "Time of each call of a macro or command, such as START_PRINT=45s or G28=20s; may be given again.",
            PRINTER,
            unit="NAME=TIME",
            default="none",
            name="macro",
            read=parse_macros,
            typed=list[str],
        ),
    ] = None
    model: Annotated[
        Literal["jerk", "vector-jerk", "junction-deviation", "junction", "klipper"] | None,
        Option(
            "What bounds the speed at corners: jerk as PrusaSlicer estimates, vector-jerk as CuraEngine does, "
            "Marlin's junction deviation, or Klipper.",
            ENTIRE,
            unit="jerk|vector-jerk|junction-deviation|klipper",
            default=AS_IN_FILE,
        ),
    ] = None
    acceleration: Annotated[
        float | None, Option("Acceleration of printing and travel.", ENTIRE, unit="MM/S2", default=AS_IN_FILE)
    ] = None
    jerk: Annotated[float | None, Option("Jerk of x and y.", ENTIRE, unit="MM/S", default=AS_IN_FILE)] = None
    junction_deviation: Annotated[
        float | None, Option("Junction deviation of Marlin.", ENTIRE, unit="MM", default=AS_IN_FILE)
    ] = None
    square_corner_velocity: Annotated[
        float | None, Option("Square corner velocity of Klipper.", ENTIRE, unit="MM/S", default=AS_IN_FILE)
    ] = None
    minimum_cruise_ratio: Annotated[
        float | None,
        Option("Minimum cruise ratio of Klipper, from 0 to less than 1.", ENTIRE, unit="NUMBER", default=AS_IN_FILE),
    ] = None
    plate: Annotated[
        int | None,
        Option("Which plate of an archive, .gcode.3mf.", FILES, unit="N", default="the first"),
    ] = None
