"""The sample print: a plate with two holes, in the dialect of PrusaSlicer, with sharp-cornered honeycomb infill."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
import shapely
import shapely.affinity
from shapely import Polygon
from shapely.geometry.base import BaseGeometry

from infill.arrays import Floats
from infill.version import __version__

Point = tuple[float, float]  # [x, y], mm
Line = list[Point]

LENGTH, WIDTH = 50.0, 30.0  # mm, of the plate
CENTRE = (110.0, 100.0)  # mm, on the bed
ROUND, HOLE = 5.0, 8.0  # mm, radius of the corners and diameter of the holes
LAYER, LINE = 0.2, 0.45  # mm, height and width of a line
LAYERS, BOTTOM, TOP = 30, 3, 3  # layers: all, and solid ones at either end
SPACING = LINE - LAYER * (1 - math.pi / 4)  # mm, of lines side by side
FILAMENT, DENSITY, NOZZLE = 1.75, 1.24, 0.4  # mm, g/cm³, mm
PER_MM = LAYER * SPACING / (math.pi / 4 * FILAMENT**2)  # mm of filament for a mm of line
SKIRT = 6.0  # mm, from the plate to the line around it, which fills the nozzle
SIDE = 3.7  # mm, of a cell of the honeycomb: 15 % of the area is line
RETRACTION, HOP_FREE = 0.8, 5.0  # mm: length, and the longest travel without one
# mm/s by feature; the first layer is printed at FIRST.
SPEEDS = {"Skirt/Brim": 40, "External perimeter": 45, "Perimeter": 60, "Solid infill": 100, "Internal infill": 120}
FIRST, TRAVEL, RETRACT = 20, 180, 35
ACCELERATION = 1000  # mm/s²
SECONDS = 1192  # of the print, as `infill.motion` plans it
SETTINGS = {
    "bed_temperature": "60",
    "fill_density": "15%",
    "fill_pattern": "honeycomb",
    "filament_density": f"{DENSITY:g}",
    "filament_diameter": f"{FILAMENT:g}",
    "filament_type": "PLA",
    "first_layer_height": f"{LAYER:g}",
    "gcode_flavor": "marlin2",
    "infill_extrusion_width": f"{LINE:g}",
    "layer_height": f"{LAYER:g}",
    "machine_limits_usage": "emit_to_gcode",
    "machine_max_acceleration_e": "5000",
    "machine_max_acceleration_extruding": f"{ACCELERATION}",
    "machine_max_acceleration_retracting": f"{ACCELERATION}",
    "machine_max_acceleration_travel": f"{ACCELERATION}",
    "machine_max_acceleration_x": f"{ACCELERATION}",
    "machine_max_acceleration_y": f"{ACCELERATION}",
    "machine_max_acceleration_z": "200",
    "machine_max_feedrate_e": "120",
    "machine_max_feedrate_x": "200",
    "machine_max_feedrate_y": "200",
    "machine_max_feedrate_z": "12",
    "machine_max_jerk_e": "4.5",
    "machine_max_jerk_x": "8",
    "machine_max_jerk_y": "8",
    "machine_max_jerk_z": "0.4",
    "nozzle_diameter": f"{NOZZLE:g}",
    "perimeters": "2",
    "temperature": "210",
}
BEGIN = """M73 P0 R{minutes}
M201 X{a} Y{a} Z200 E5000 ; maximum accelerations, mm/s^2
M203 X200 Y200 Z12 E120 ; maximum feedrates, mm/s
M204 P{a} R{a} T{a} ; accelerations, mm/s^2
M205 X8.00 Y8.00 Z0.40 E4.50 ; jerk limits, mm/s
M107
;TYPE:Custom
M140 S60 ; bed temperature
M104 S210 ; nozzle temperature
G28 ; home all axes
M190 S60
M109 S210
G21 ; millimetres
G90 ; absolute coordinates
M83 ; relative distances of the filament
G92 E0"""
END = """;TYPE:Custom
G1 Z{above:g} F720 ; lift the nozzle
M104 S0
M140 S0
M107
G1 X0 Y200 F10800 ; present the print
M84"""


def plate_print() -> bytes:
    """Make the G-code of a plate of 50 x 30 x 6 mm in PLA, for a bed of 200 x 200 mm or larger and a nozzle of 0.4 mm.

    Returns
    -------
    bytes
        Text as PrusaSlicer writes it: 30 layers, of which 24 have infill; the limits of the machine as commands and
        as settings.

    >>> plate_print().count(b";TYPE:Internal infill")
    24
    """
    pen = _PrintPen()
    for layer, features in enumerate(_features(_plate())):
        pen.rise(layer)
        for feature, lines in features:
            pen.begin(feature, lines[0][0])
            for line in lines:
                pen.draw(line, SPEEDS[feature] if layer else FIRST)
    pen.retract()
    used = pen.used
    volume = used * math.pi / 4 * FILAMENT**2 / 1000  # cm³
    return "\n".join(
        [
            f"; PrusaSlicer 2.9 dialect: a sample print, written by phasefill {__version__} and not by a slicer",
            "",
            BEGIN.format(minutes=round(SECONDS / 60), a=ACCELERATION),
            *pen.lines,
            END.format(above=LAYERS * LAYER + 10),
            "M73 P100 R0",
            f"; filament used [mm] = {used:.2f}",
            f"; filament used [cm3] = {volume:.2f}",
            f"; filament used [g] = {volume * DENSITY:.2f}",
            f"; estimated printing time (normal mode) = {_duration(SECONDS)}",
            "",
            "; prusaslicer_config = begin",
            *(f"; {name} = {value}" for name, value in SETTINGS.items()),
            "; prusaslicer_config = end",
            "",
        ]
    ).encode("ascii")


class _PrintPen:
    """The lines of the print so far, and where the nozzle is."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.at = (0.0, 0.0)  # mm
        self.used = 0.0  # mm of filament
        self._retracted = True  # until the first line
        self._speed = 0.0  # mm/s

    def rise(self, layer: int) -> None:
        """Begin a layer."""
        z = f"{(layer + 1) * LAYER:.3g}"
        self.lines += [";LAYER_CHANGE", f";Z:{z}", f";HEIGHT:{LAYER:g}"]
        self.retract()
        self.lines.append(f"G1 Z{z} F{60 * TRAVEL}")
        self._speed = TRAVEL
        if layer == 1:
            self.lines.append("M106 S255 ; fan")

    def begin(self, feature: str, start: Point) -> None:
        """Travel to a feature and name it."""
        self._travel(start)
        self.lines += [f";TYPE:{feature}", f";WIDTH:{LINE:g}"]

    def draw(self, points: Line, speed: float) -> None:
        """Draw a line through points, mm, at a speed in mm/s."""
        self._travel(points[0])
        if speed != self._speed:
            self.lines.append(f"G1 F{60 * speed:g}")
            self._speed = speed
        for point in points[1:]:
            amount = round(math.dist(point, self.at) * PER_MM, 5)
            if amount:
                self.lines.append(f"G1 X{point[0]:g} Y{point[1]:g} E{amount:.5f}")
                self.at, self.used = point, self.used + amount

    def retract(self) -> None:
        """Pull the filament back, once."""
        if not self._retracted:
            self.lines.append(f"G1 E-{RETRACTION:g} F{60 * RETRACT}")
            self._retracted, self._speed = True, RETRACT

    def _travel(self, point: Point) -> None:
        """Move to a point without a line, and be ready to draw."""
        length = math.dist(point, self.at)
        if length > HOP_FREE:
            self.retract()
        if length:
            self.lines.append(f"G1 X{point[0]:g} Y{point[1]:g} F{60 * TRAVEL}")
            self.at, self._speed = point, TRAVEL
        if self._retracted:
            self.lines.append(f"G1 E{RETRACTION:g} F{60 * RETRACT}")
            self._retracted, self._speed = False, RETRACT


def _plate() -> Polygon:
    """Return the outline of the plate on the bed, with its holes, mm."""
    x, y = CENTRE
    inner = shapely.box(x - LENGTH / 2, y - WIDTH / 2, x + LENGTH / 2, y + WIDTH / 2).buffer(-ROUND)
    holes = [shapely.Point(x + side * LENGTH / 4, y).buffer(HOLE / 2, quad_segs=12) for side in (-1, 1)]
    return inner.buffer(ROUND, quad_segs=12).difference(shapely.union_all(holes))


def _features(outer: Polygon) -> list[list[tuple[str, list[Line]]]]:
    """Return the features of each layer with their lines: two walls, the inner one first, then infill."""
    walls = {"Perimeter": outer.buffer(-LINE / 2 - SPACING), "External perimeter": outer.buffer(-LINE / 2)}
    outlines = [(name, [_line(ring) for ring in (area.exterior, *area.interiors)]) for name, area in walls.items()]
    skirt = [("Skirt/Brim", [_line(outer.buffer(SKIRT).exterior)])]
    inside = outer.buffer(-LINE / 2 - 2 * SPACING + 0.1 * LINE)  # lines overlap the walls by a tenth
    solid = [("Solid infill", list(_diagonals(inside, angle))) for angle in (-45.0, 45.0)]
    sparse = ("Internal infill", list(_waves(inside)))
    middle = range(BOTTOM, LAYERS - TOP)
    return [
        [*(skirt if layer == 0 else []), *outlines, sparse if layer in middle else solid[layer % 2]]
        for layer in range(LAYERS)
    ]


def _line(geometry: BaseGeometry) -> Line:
    """Return the points of a line, as the print states them."""
    return [(x, y) for x, y in shapely.get_coordinates(geometry).round(3).tolist()]


def _diagonals(inside: BaseGeometry, angle: float) -> Iterator[Line]:
    """Yield parallel lines side by side, turned by an angle in degrees."""
    x, y = CENTRE
    reach = math.hypot(LENGTH, WIDTH) / 2
    count = math.ceil(reach / SPACING)
    rows = [np.array([[x - reach, y + i * SPACING], [x + reach, y + i * SPACING]]) for i in range(-count, count + 1)]
    yield from _clip(
        [shapely.get_coordinates(shapely.affinity.rotate(shapely.LineString(row), angle, CENTRE)) for row in rows],
        inside,
    )


def _waves(inside: BaseGeometry) -> Iterator[Line]:
    """Yield the rows of a honeycomb: waves of half cells, each mirrored in the next, so that two rows close a cell."""
    x, y = CENTRE
    rise = SIDE * math.sqrt(3) / 2
    pitch = rise + SPACING
    count = math.ceil(WIDTH / 2 / pitch)
    starts = np.arange(-math.ceil(LENGTH / 2 / (3 * SIDE)), math.ceil(LENGTH / 2 / (3 * SIDE))) * 3 * SIDE
    along = (x + starts[:, None] + SIDE * np.array([0, 1, 1.5, 2.5])).ravel()
    up = np.tile([0.0, 0.0, rise, rise], len(starts))
    rows = [
        np.column_stack([along, y + i * pitch + (rise - up if i % 2 else up)]) for i in range(-count - 1, count + 1)
    ]
    yield from _clip(rows, inside)


def _clip(rows: Sequence[Floats], inside: BaseGeometry) -> Iterator[Line]:
    """Yield the parts inside of each row, from left to right and back."""
    backwards = False
    for row in rows:
        pieces = shapely.get_parts(shapely.line_merge(shapely.intersection(shapely.LineString(row), inside)))
        lines = [_line(piece) for piece in pieces if piece.length > NOZZLE]
        lines = sorted(line if line[0] < line[-1] else line[::-1] for line in lines)
        yield from [line[::-1] for line in reversed(lines)] if backwards else lines
        backwards ^= bool(lines)


def _duration(seconds: float) -> str:
    """Format a time as slicers state it.

    >>> _duration(754.6)
    '12m 35s'
    """
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes}m {rest}s" if minutes < 60 else f"{minutes // 60}h {minutes % 60}m {rest}s"
