"""Klipper's printer.cfg: its sections, with the files that it includes, and the limits in them.

As Klipper reads it: later options win over earlier ones, an included file stands where its line does, comments begin
with # or ;, indented lines continue an option, and the block that SAVE_CONFIG wrote yields to the options above it.
"""

from __future__ import annotations

import glob
import math
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from infill.errors import FormatError
from infill.files.broken import wrap_read_errors
from infill.files.excerpts import excerpt
from infill.gcode.limit_names import LIMIT_NAMES, cruise_ratio
from infill.gcode.limits import MAX_LIMIT, Limits
from infill.gcode.printer_limits import LimitMacro, LimitNote, PrinterLimits, read_limit, read_printer_text

Sections = dict[str, dict[str, Any]]
MAX_FILES: Final = 500  # that a configuration includes
SECTION: Final = re.compile(r"\[([^\]]+)\]")
_OPTION: Final = re.compile(r"([^:=\s][^:=]*?)\s*[:=]\s*(.*)")
_COMMENT: Final = re.compile(r"#.*|(?:^|\s);.*")
_SAVED: Final = "#*# <---------------------- SAVE_CONFIG ---------------------->"
_SAVED_LINE: Final = "#*#"
_MACRO: Final = "gcode_macro "
_LIMITING: Final = frozenset({"M204", "SET_VELOCITY_LIMIT", "RESET_VELOCITY_LIMIT"})
_BLOCK: Final = re.compile(r"\{%-?\s*(if|for|endif|endfor)\b")
NOZZLE, FILAMENT = 0.4, 1.75  # mm, where the printer has no extruder in its file
SLOW_AT_THE_EDGE: Final = ("delta", "deltesian", "rotary_delta")
PLANNED_ALIKE: Final = (
    *("cartesian", "corexy", "corexz", "hybrid_corexy", "hybrid_corexz", "generic_cartesian"),
    *("delta", "deltesian", "rotary_delta", "polar", "winch", "none"),
)
_NOT_FOLLOWED: Final = {  # options by section, and why they do not change the plan
    ("extruder", "max_extrude_cross_section"): "makes Klipper refuse moves, and changes no time",
    ("extruder", "max_extrude_only_distance"): "makes Klipper refuse moves, and changes no time",
    ("extruder", "pressure_advance"): "does not change when moves begin and end",
    ("extruder", "pressure_advance_smooth_time"): "does not change when moves begin and end",
    ("gcode_arcs", "resolution"): "is not followed: arcs are planned as chords of 1 mm or 5°",
}
_SECTIONS_NOT_FOLLOWED: Final = {"input_shaper": "does not change when moves begin and end"}


def read_klipper_config(path: Path) -> Sections:
    """Read the sections of a printer.cfg, by name, each with its options in small letters.

    Raises
    ------
    FormatError
        If a file cannot be read, an included file is missing, or files include one another.
    """
    text = read_printer_text(path)
    regular, _, saved = text.partition(_SAVED)
    sections: Sections = {}
    _add_file(sections, regular, (path,), [1])
    lines = (line[len(_SAVED_LINE) :].removeprefix(" ") for line in saved.split("\n") if line.startswith(_SAVED_LINE))
    automatic: Sections = {}
    _add_lines(automatic, "\n".join(lines))
    for name, options in automatic.items():
        sections[name] = {**options, **sections.get(name, {})}
    return sections


def _add_file(sections: Sections, text: str, stack: tuple[Path, ...], file_count: list[int]) -> None:
    """Add the sections of a file, and of those that it includes, in the order of their lines; count the files too."""
    lines: list[str] = []
    for line in text.split("\n"):
        header = SECTION.match(line)
        if header is None or not header[1].startswith("include "):
            lines.append(line)
            continue
        _add_lines(sections, "\n".join(lines))
        lines.clear()
        with wrap_read_errors(stack[-1]):
            included_files = _find_included(stack[-1], header[1][len("include ") :].strip())
        for included in included_files:
            if included.resolve() in (path.resolve() for path in stack):
                names = excerpt(" includes ".join(path.name for path in (*stack, included)), 200)
                raise FormatError(f"{stack[0]}: {names}, in a loop; remove one of these lines")
            file_count[0] += 1
            if file_count[0] > MAX_FILES:
                raise FormatError(f"{stack[0]} includes more than {MAX_FILES} files; remove some of its includes")
            _add_file(sections, read_printer_text(included), (*stack, included), file_count)
    _add_lines(sections, "\n".join(lines))


def _find_included(file: Path, pattern: str) -> list[Path]:
    """Find the files that a line of a file includes; a pattern may match none, a name must exist."""
    place = str(file.parent / pattern)
    if not glob.has_magic(place) or Path(place).is_file():
        if not Path(place).is_file():
            where = excerpt(str(file.parent), 200)
            raise FormatError(
                f"{file} includes {excerpt(pattern)}, which is not in {where}; copy it there, or remove that line"
            )
        return [Path(place)]
    names = sorted(glob.glob(place))  # noqa: PTH207 - a pattern may be absolute, or lead out of the folder
    return [Path(name) for name in names if Path(name).is_file()]


def _add_lines(sections: Sections, text: str) -> None:
    """Add the sections of lines without includes; later options replace earlier ones."""
    options: dict[str, Any] | None = None
    name = ""
    for line in text.split("\n"):
        words = _COMMENT.sub("", line).rstrip()
        if not words.strip():
            continue
        if words[0].isspace() and name and options is not None:
            options[name] += f"\n{words.strip()}"
            continue
        header, option = SECTION.match(words.strip()), _OPTION.match(words.strip())
        if header is not None:
            options, name = sections.setdefault(" ".join(header[1].split()), {}), ""
        elif option is not None and options is not None:
            name = option[1].lower()
            options[name] = option[2].strip()


@dataclass(frozen=True)
class _NumberReader:
    """Numbers of options, by section; `source` is the name of their file."""

    options: Mapping[str, Mapping[str, Any]]
    source: str

    def read(self, section: str, option: str, field: str, default: float | None = None) -> float:
        """Return the number of an option, or the default; raise FormatError if it has none or an impossible one."""
        value = self.options[section].get(option)
        if value is not None:
            unit = next((limit.unit for limit in LIMIT_NAMES.values() if limit.klipper == (section, option)), "mm")
            place = f"{self.source}: [{section}] {option}"
            return read_limit(place, field, value, unit.replace("s2", "s²"))
        if default is None:
            raise FormatError(f"{self.source}: [{section}] has no {option}; Klipper needs one, such as {option}: 300")
        return default


def _override_options(sections: Mapping[str, Mapping[str, Any]], given: Mapping[str, float]) -> Sections:
    """Return the options of the printer and its extruder, with those that given limits by name override."""
    options = {name: dict(sections.get(name, {})) for name in ("printer", "extruder", "firmware_retraction")}
    if "max_accel_to_decel" in given:
        options["printer"].pop("minimum_cruise_ratio", None)
    for name, value in given.items():
        place = LIMIT_NAMES[name].klipper
        if place is not None:
            options[place[0]][place[1]] = value
    return options


def klipper_limits(
    sections: Mapping[str, Mapping[str, Any]],
    source: str,
    given: Mapping[str, float],
    written: Mapping[str, Mapping[str, Any]] | None = None,
) -> PrinterLimits:
    """Return the limits that the sections of a Klipper printer state, with Klipper's own defaults.

    Parameters
    ----------
    sections : mapping
        Options by section; numbers, or their texts.
    source : str
        Name of the file, for messages.
    given : mapping
        Limits by the names of `LIMIT_NAMES`, which take the place of those in the file.
    written : mapping, optional
        The options that a person wrote, if `sections` has defaults as well; notes are about them.

    Raises
    ------
    FormatError
        If a limit is missing or impossible.
    """
    number = _NumberReader(_override_options(sections, given), source).read
    speed = number("printer", "max_velocity", "feedrate")
    acceleration = number("printer", "max_accel", "acceleration")
    nozzle = number("extruder", "nozzle_diameter", "feedrate", NOZZLE)
    filament = number("extruder", "filament_diameter", "feedrate", FILAMENT)
    share = 4 * nozzle**2 / (math.pi / 4 * filament**2)  # of filament per path, which Klipper's defaults assume
    slow_z = number("printer", "max_z_velocity", "feedrate", speed)
    to_decel = number("printer", "max_accel_to_decel", "acceleration", acceleration / 2)
    ratio = number("printer", "minimum_cruise_ratio", "minimum_cruise_ratio", cruise_ratio(to_decel, acceleration))
    limits = Limits(
        model="klipper",
        feedrate=(speed, speed, slow_z, number("extruder", "max_extrude_only_velocity", "feedrate", speed * share)),
        axis_acceleration=(
            acceleration,
            acceleration,
            number("printer", "max_z_accel", "acceleration", acceleration),
            number("extruder", "max_extrude_only_accel", "acceleration", acceleration * share),
        ),
        acceleration=acceleration,
        travel_acceleration=acceleration,
        retract_acceleration=MAX_LIMIT,  # only that of the extruder limits moves of the extruder alone
        square_corner_velocity=number("printer", "square_corner_velocity", "square_corner_velocity", 5.0),
        corner_extrusion_velocity=number("extruder", "instantaneous_corner_velocity", "corner_extrusion_velocity", 1.0),
        minimum_cruise_ratio=ratio,
    )
    return PrinterLimits(
        firmware="klipper",
        limits=limits,
        stated=frozenset({"feedrate", "axis_acceleration", "acceleration", "square_corner_velocity"})
        | {"travel_acceleration", "corner_extrusion_velocity", "minimum_cruise_ratio"},
        notes=tuple(_notes(written or sections)),
        retraction=_retraction_seconds(number, limits) if "firmware_retraction" in sections else (0.0, 0.0),
        macros=_read_macros(sections),
    )


def _retraction_seconds(number: Callable[[str, str, str, float], float], limits: Limits) -> tuple[float, float]:
    """Return the seconds that G10 and G11 take: moves of the extruder alone, from rest to rest."""
    section, seconds = "firmware_retraction", []
    length = number(section, "retract_length", "minimum_feedrate", 0.0)
    extra = number(section, "unretract_extra_length", "minimum_feedrate", 0.0)
    for name, distance, default in (("retract", length, 20.0), ("unretract", length + extra, 10.0)):
        acceleration = limits.axis_acceleration[3]
        steady = min(acceleration, limits.acceleration * (1 - limits.minimum_cruise_ratio))
        speed = min(number(section, f"{name}_speed", "feedrate", default), limits.feedrate[3])
        speed = min(speed, math.sqrt(steady * distance))
        seconds.append(2 * speed / acceleration + (distance - speed**2 / acceleration) / speed if distance else 0.0)
    return seconds[0], seconds[1]


def _notes(sections: Mapping[str, Mapping[str, Any]]) -> Iterator[LimitNote]:
    """Yield a note for each limit that the plan does not follow or had to assume."""
    printer, extruder = sections.get("printer", {}), sections.get("extruder", {})
    kinematics = excerpt(str(printer.get("kinematics", "cartesian")))
    if kinematics in SLOW_AT_THE_EDGE:
        yield LimitNote(
            name=f"[printer] kinematics: {kinematics}",
            note="slows moves near the edge of the bed, which the plan does not",
        )
    elif kinematics not in PLANNED_ALIKE:
        yield LimitNote(name=f"[printer] kinematics: {kinematics}", note="is not known; planned as cartesian")
    if "nozzle_diameter" not in extruder or "filament_diameter" not in extruder:
        yield LimitNote(
            name="[extruder]",
            note=f"has no diameters in this file; its limits are those of a nozzle of {NOZZLE} mm and filament of "
            f"{FILAMENT} mm, unless stated",
        )
    if {"max_accel_to_decel", "minimum_cruise_ratio"} <= set(printer):
        yield LimitNote(name="[printer] max_accel_to_decel", note="yields to minimum_cruise_ratio, as in Klipper")
    known = {limit.klipper for limit in LIMIT_NAMES.values()}
    for option in printer:
        if option.startswith(("max_", "min_")) and ("printer", option) not in known:
            yield LimitNote(name=f"[printer] {excerpt(option)}", note="is not known, and not followed")
    for (section, option), note in _NOT_FOLLOWED.items():
        if option in sections.get(section, {}):
            yield LimitNote(name=f"[{section}] {option}", note=note)
    for section, note in _SECTIONS_NOT_FOLLOWED.items():
        if section in sections:
            yield LimitNote(name=f"[{section}]", note=note)
    limiting = [limit.klipper[1] for limit in LIMIT_NAMES.values() if limit.klipper and limit.klipper[0] == "extruder"]
    for section, options in sections.items():
        differs = [name for name in limiting if name in options and options[name] != extruder.get(name)]
        if re.fullmatch(r"extruder\d+", section) and differs:
            yield LimitNote(
                name=f"[{section}] {differs[0]}", note="is not followed: all tools are planned as [extruder]"
            )


def _read_macros(sections: Mapping[str, Mapping[str, Any]]) -> dict[str, LimitMacro]:
    """Return the macros that set limits, by name in capitals."""
    texts = {
        name[len(_MACRO) :].strip().upper(): str(options.get("gcode", ""))
        for name, options in sections.items()
        if name.lower().startswith(_MACRO)
    }
    macros = {name: _read_macro(name, texts, ()) for name in texts}
    return {name: macro for name, macro in macros.items() if macro.lines or macro.unread}


def _read_macro(name: str, texts: Mapping[str, str], stack: tuple[str, ...]) -> LimitMacro:
    """Return the limits that a macro sets; none of them if one depends on values that only the printer knows."""
    depth, lines = 0, list[tuple[str, bytes]]()
    for line in texts[name].split("\n"):
        for block in _BLOCK.findall(line):
            depth += -1 if block.startswith("end") else 1
        words = line.split(None, 1)
        code = words[0].upper() if words else ""
        if code in texts and code not in (name, *stack) and len(stack) < 8:
            inner = _read_macro(code, texts, (*stack, name))
        elif code in _LIMITING:
            uncertain = depth > 0 or "{" in line
            inner = LimitMacro(unread=line) if uncertain else LimitMacro(lines=((code, line.encode()),))
        else:
            continue
        if inner.unread or (depth > 0 and inner.lines):
            return LimitMacro(unread=inner.unread or line)
        lines += inner.lines
    return LimitMacro(lines=tuple(lines))


def read_klipper(path: Path, given: Mapping[str, float]) -> PrinterLimits:
    """Read the limits of a printer from its printer.cfg.

    Raises
    ------
    FormatError
        If it cannot be read, has no [printer], or a limit is missing or impossible.
    """
    sections = read_klipper_config(path)
    if "printer" not in sections:
        names = excerpt(", ".join(f"[{name}]" for name in list(sections)[:3]))
        raise FormatError(
            f"{path} has no section [printer]{f', only {names}' if names else ''}; give the printer.cfg that has it"
        )
    return klipper_limits(sections, str(path), given)
