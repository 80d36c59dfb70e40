"""Sliced prints made by hand, in the dialects of slicers that cannot be run in a test: small, whole and valid.

A part is a box: two walls, solid first and last layers, and between them rows of a honeycomb's waves as infill.
`Dialect` says how it is written down, `written` writes it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

LAYER, WIDTH = 0.2, 0.45  # mm
SPACING = WIDTH - LAYER * (1 - math.pi / 4)
PER_MM = LAYER * SPACING / (math.pi / 4 * 1.75**2)  # mm of filament
ROLES = {
    "prusa": ("External perimeter", "Perimeter", "Solid infill", "Internal infill", "Custom"),
    "orca": ("Outer wall", "Inner wall", "Internal solid infill", "Sparse infill", "Custom"),
    "cura": ("WALL-OUTER", "WALL-INNER", "SKIN", "FILL", ""),
}


@dataclass(frozen=True, kw_only=True)
class Dialect:
    """How a print is written down."""

    slicer: str = "prusa"  # "prusa", "orca", "bambu", "cura"
    absolute: bool = False  # E
    wipe: bool = True
    hop: float = 0.4  # mm
    retract: bool = True  # for travels inside the infill
    firmware: bool = False  # G10 and G11
    crlf: bool = False
    numbered: bool = False  # N words
    labels: str = ""  # "comment", "M486", "EXCLUDE_OBJECT", "M624"
    progress: str = "P{done} R{left}"  # "" for none
    fan_in_infill: bool = False
    arcs: bool = False  # in the infill
    acceleration: str = "M204 S{}"  # "" for none
    zero: bool = False  # G92 E0 at each layer
    comments: bool = False  # behind moves
    sequential: bool = False
    objects: int = 1
    layers: int = 6
    thick: int = 1  # layers of infill printed as one
    heights: tuple[float, ...] = ()  # mm, of layers, over and over
    name: bytes = b"box.stl"
    odd: tuple[bytes, ...] = ()  # lines strewn in
    newline: bool = True  # at the end of the file
    packed: bool = False  # words without blanks between
    size: float = 12.0  # mm
    sizes: tuple[float, ...] = ()  # mm, of layers, over and over
    cell: float = 3.0  # mm
    tools: int = 1
    infill_first: bool = False

    @property
    def roles(self) -> tuple[str, ...]:
        return ROLES["orca" if self.slicer == "bambu" else self.slicer]


class _Pen:
    """What a slicer remembers while it writes."""

    def __init__(self, dialect: Dialect) -> None:
        self.dialect = dialect
        self.lines: list[bytes] = []
        self.at = (0.0, 0.0, 0.0)
        self.filament = 0.0
        self.used = dict.fromkeys(range(dialect.tools), 0.0)
        self.tool = 0
        self.gone: set[int] = set()  # tools whose filament is retracted
        self.speed = 0.0
        self.moves = 0
        self.strewn = 0

    def say(self, text: str | bytes) -> None:
        self.lines.append(text.encode() if isinstance(text, str) else text)

    def tag(self, name: str, value: object) -> None:
        """A layer's number, a role, a width, a height: as each slicer writes it."""
        slicer = self.dialect.slicer
        if slicer == "cura":
            if name in ("TYPE", "LAYER"):
                self.say(f";{name}:{value}")
            return
        if slicer == "bambu":
            spelled = {"TYPE": "FEATURE", "WIDTH": "LINE_WIDTH", "HEIGHT": "LAYER_HEIGHT", "Z": "Z_HEIGHT"}
            self.say("; CHANGE_LAYER" if name == "LAYER" else f"; {spelled[name]}: {value}")
        else:
            self.say(";LAYER_CHANGE" if name == "LAYER" else f";{name}:{value}")

    def words(self, *words: str) -> None:
        words = tuple(word for word in words if word)
        text = words[0] + ("" if self.dialect.packed else " ") + ("" if self.dialect.packed else " ").join(words[1:])
        self.say(text + (" ; move" if self.dialect.comments else ""))
        self.moves += 1
        if self.dialect.progress and self.moves % 23 == 0:
            done = min(99, self.moves // 10)
            self.say("M73 " + self.dialect.progress.format(done=done, left=100 - done))
        if self.dialect.odd and self.moves % 17 == 0:
            self.say(self.dialect.odd[self.strewn % len(self.dialect.odd)])
            self.strewn += 1

    def feed(self, speed: float) -> str:
        if speed == self.speed:
            return ""
        self.speed = speed
        return f"F{speed:g}"

    def pushed(self, amount: float) -> str:
        amount = round(amount, 5)
        self.used[self.tool] += amount
        if not self.dialect.absolute:
            return f"E{_short(amount, 5)}"
        self.filament = round(self.filament + amount, 5)
        return f"E{_short(self.filament, 5)}"

    def line_to(self, x: float, y: float, per_mm: float, speed: float = 0.0) -> None:
        x, y = round(x, 3), round(y, 3)
        length = math.dist(self.at[:2], (x, y))
        if not length:
            return
        self.at = (x, y, self.at[2])
        feed = self.feed(speed) if speed else ""
        self.words("G1", f"X{_short(x)}", f"Y{_short(y)}", self.pushed(length * per_mm), feed)

    def arc_to(self, x: float, y: float, bulge: float, per_mm: float) -> None:
        """A quarter of a circle, or what comes near it; `bulge` +1 is to the left, −1 to the right."""
        x, y = round(x, 3), round(y, 3)
        x0, y0, _ = self.at
        half = ((x - x0) / 2, (y - y0) / 2)
        i, j = round(half[0] - bulge * half[1], 3), round(half[1] + bulge * half[0], 3)
        length = math.hypot(i, j) * math.pi / 2
        self.at = (x, y, self.at[2])
        name = "G3" if bulge > 0 else "G2"
        self.words(
            name, f"X{_short(x)}", f"Y{_short(y)}", f"I{_short(i)}", f"J{_short(j)}", self.pushed(length * per_mm)
        )

    def retract(self, back: tuple[float, float] | None = None) -> None:
        if self.tool in self.gone:
            return
        self.gone.add(self.tool)
        dialect = self.dialect
        left = 0.8
        if dialect.wipe and back and not dialect.firmware and dialect.slicer != "cura":
            self.say("; WIPE_START" if dialect.slicer == "bambu" else ";WIPE_START")
            self.words("G1", self.feed(8640))
            length = math.dist(self.at[:2], back)
            part = min(1.0, 2.0 / length) if length else 0.0
            x, y = (round(a + part * (b - a), 3) for a, b in zip(self.at[:2], back, strict=True))
            self.at = (x, y, self.at[2])
            self.words("G1", f"X{_short(x)}", f"Y{_short(y)}", self.pushed(-0.76))
            left = 0.04
            self.say("; WIPE_END" if dialect.slicer == "bambu" else ";WIPE_END")
        if dialect.firmware:
            self.say("G10")
        else:
            self.words("G1", self.pushed(-left), self.feed(2100))

    def travel(self, x: float, y: float, *, retract: bool, back: tuple[float, float] | None = None) -> None:
        x, y = round(x, 3), round(y, 3)
        if math.dist(self.at[:2], (x, y)) < 0.001:
            return
        z = self.at[2]
        if retract:
            self.retract(back)
            if self.dialect.hop:
                self.words("G1", f"Z{_short(z + self.dialect.hop)}", self.feed(10800))
        self.at = (x, y, z)
        word = "G0" if self.dialect.slicer == "cura" else "G1"
        self.words(word, f"X{_short(x)}", f"Y{_short(y)}", self.feed(10800))
        if retract and self.dialect.hop:
            self.words("G1", f"Z{_short(z)}")
        self.prime()

    def prime(self) -> None:
        if self.tool not in self.gone:
            return
        self.gone.remove(self.tool)
        if self.dialect.firmware:
            self.say("G11")
        else:
            self.words("G1", self.pushed(0.8), self.feed(2100))

    def rise(self, z: float) -> None:
        self.at = (*self.at[:2], round(z, 3))
        self.words("G1", f"Z{_short(z)}", self.feed(10800))


def _short(value: float, digits: int = 3) -> str:
    """A number without trailing zeros, nor the one before the point, as most slicers write it."""
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    text = text.replace("-0.", "-.") if text.startswith("-0.") else text
    text = text.removeprefix("0") if text.startswith("0.") else text
    return "0" if text in ("", "-", "-0") else text


def written(dialect: Dialect) -> bytes:
    """Write the print down."""
    pen = _Pen(dialect)
    _begin(pen)
    heights = [(dialect.heights or (LAYER,))[i % len(dialect.heights or (LAYER,))] for i in range(dialect.layers)]
    places = [(100.0 + 1.5 * dialect.size * i, 100.0) for i in range(dialect.objects)]
    orders = [[place] for place in places] if dialect.sequential else [places]
    number = 0
    for order in orders:
        z = 0.0
        for layer, height in enumerate(heights):
            z = round(z + height, 3)
            _layer_begins(pen, number, z, height, retract=layer == 0 and number > 0)
            number += 1
            for place in order:
                _object(pen, places.index(place), place, layer, heights, z)
            if dialect.slicer == "cura":
                pen.say(f";TIME_ELAPSED:{10.5 * number}")
    _end(pen)
    return _bytes(pen)


def _begin(pen: _Pen) -> None:
    dialect = pen.dialect
    name = {"prusa": "PrusaSlicer 2.5.0", "orca": "OrcaSlicer 2.3.1", "bambu": "BambuStudio 02.00.01.50"}
    if dialect.slicer == "cura":
        for text in (";FLAVOR:Marlin", ";TIME:6666", ";Filament used: 0.42m", ";Layer height: 0.2", ";MINX:100"):
            pen.say(text)
        pen.say(";Generated with Cura_SteamEngine 5.9.0")
    elif dialect.slicer == "prusa":
        pen.say("; generated by PrusaSlicer 2.5.0 on 2026-01-02 at 03:04:05 UTC")
        pen.say("")
        pen.say("; infill extrusion width = 0.45mm")
    else:
        pen.say("; HEADER_BLOCK_START")
        pen.say(f"; generated by {name[dialect.slicer]} on 2026-01-02 at 03:04:05")
        pen.say("; model printing time: 3m 1s; total estimated time: 8m 2s")
        pen.say(f"; total layer number: {dialect.layers}")
        pen.say("; HEADER_BLOCK_END")
        pen.say("")
        if dialect.slicer == "bambu":
            _config(pen)
            pen.say("; EXECUTABLE_BLOCK_START")
    for text in ("M201 X1000 Y1000 Z200 E5000", "M203 X200 Y200 Z12 E120", "M107", "M104 S215"):
        pen.say(text)
    pen.say("")
    pen.tag("TYPE", dialect.roles[4])
    for text in ("G28", "M109 S215", "G21", "G90", "M82" if dialect.absolute else "M83", "G92 E0"):
        pen.say(text)
    if dialect.slicer == "bambu":
        pen.say("; MACHINE_START_GCODE_END")
    if dialect.labels == "EXCLUDE_OBJECT":
        for i in range(dialect.objects):
            pen.say(b"EXCLUDE_OBJECT_DEFINE NAME=%s_%d CENTER=100,100" % (dialect.name, i))
    if dialect.slicer == "cura":
        pen.say(f";LAYER_COUNT:{dialect.layers}")


def _layer_begins(pen: _Pen, number: int, z: float, height: float, *, retract: bool) -> None:
    dialect = pen.dialect
    pen.tag("LAYER", number)
    if dialect.slicer != "cura":
        pen.tag("Z", _short(z).replace(".", "0.", 1) if z < 1 else _short(z))
        pen.tag("HEIGHT", f"{height:g}")
    if dialect.slicer == "bambu":
        pen.say(f"; layer num/total_layer_count: {number + 1}/{dialect.layers}")
        pen.say(f"M73 L{number + 1}")
        pen.say(f"M991 S0 P{number} ;notify layer change")
    if dialect.zero:
        pen.say("G92 E0")
        pen.filament = 0.0
    if retract:
        pen.retract()
    pen.rise(z)
    if number in (0, 2):
        pen.say("M106 S255" if number else "M107")


def _object(pen: _Pen, i: int, place: tuple[float, float], layer: int, heights: list[float], z: float) -> None:
    dialect = whole = pen.dialect
    if dialect.sizes:
        pen.dialect = dialect = replace(dialect, size=dialect.sizes[layer % len(dialect.sizes)])
    _label(pen, i, start=True)
    solid = layer == 0 or layer == len(heights) - 1
    thick = dialect.thick if not solid else 1
    dose = PER_MM * heights[layer] / LAYER
    if dialect.infill_first and not solid:
        _waves(pen, place, layer, dose, thick, heights)
    corner = place
    for name, inset, speed in ((1, WIDTH / 2 + SPACING, 2700), (0, WIDTH / 2, 1500)):
        low = corner[0] + inset, corner[1] + inset
        high = corner[0] + dialect.size - inset, corner[1] + dialect.size - inset
        pen.travel(*low, retract=name == 1, back=None)
        _role(pen, name, 800, heights[layer])
        pen.line_to(high[0], low[1], dose, speed)
        for x, y in ((high[0], high[1]), (low[0], high[1]), (low[0], low[1] + 0.06)):
            pen.line_to(x, y, dose)
    if solid:
        _rows(pen, place, dose, heights[layer])
    elif not dialect.infill_first:
        _waves(pen, place, layer, dose, thick, heights)
    _label(pen, i, start=False)
    pen.dialect = whole


def _role(pen: _Pen, role: int, acceleration: int, height: float, thick: int = 1) -> None:
    dialect = pen.dialect
    if dialect.acceleration:
        pen.say(dialect.acceleration.format(acceleration))
    pen.tag("TYPE", dialect.roles[role])
    if dialect.slicer != "cura":
        pen.tag("WIDTH", WIDTH)
        if dialect.thick > 1:
            pen.tag("HEIGHT", f"{height * thick:g}")


def _inner(dialect: Dialect, place: tuple[float, float]) -> tuple[float, float, float, float]:
    inset = WIDTH / 2 + 2 * SPACING - 0.045
    return (*(v + inset for v in place), *(v + dialect.size - inset for v in place))


def _rows(pen: _Pen, place: tuple[float, float], dose: float, height: float) -> None:
    x0, y0, x1, y1 = _inner(pen.dialect, place)
    count = round((y1 - y0) / SPACING)
    pen.travel(x0, y0, retract=True, back=(x0, y0 - 1))
    _role(pen, 2, 1000, height)
    for row in range(count + 1):
        y = y0 + (y1 - y0) * row / count
        ends = (x0, x1) if row % 2 == 0 else (x1, x0)
        pen.line_to(ends[0], y, dose, 4800)
        pen.line_to(ends[1], y, dose)


def _waves(pen: _Pen, place: tuple[float, float], layer: int, dose: float, thick: int, heights: list[float]) -> None:
    """Rows of half hexagons, each of them mirrored in the next; a travel between, or a wipe and a retraction."""
    if layer % thick:
        return
    dialect = pen.dialect
    dose *= thick
    x0, y0, x1, y1 = _inner(dialect, place)
    step = dialect.cell / 2
    rise = step * 0.8
    first, back = True, None
    row, y = 0, y0
    while y + rise <= y1:
        points, x, up = [(x0, y)], x0, False
        while x + step <= x1:
            x += step
            if round((x - x0) / step) % 2 == 0:
                up = not up
            points.append((x, y + rise if up else y))
        if row % 2:
            points.reverse()
        pen.travel(*points[0], retract=first or dialect.retract, back=back)
        if first:
            _role(pen, 3, 1000, heights[layer], thick)
            if dialect.fan_in_infill:
                pen.say("M106 S127")
            pen.words("G1", pen.feed(4800) or "F4800")
        elif pen.speed != 4800:
            pen.words("G1", pen.feed(4800))
        first = False
        for j, (a, b) in enumerate(zip(points, points[1:], strict=False)):
            if dialect.arcs and a[1] != b[1]:
                pen.arc_to(*b, 1 if j % 4 < 2 else -1, dose)
            else:
                pen.line_to(*b, dose)
        back = points[-2]
        row, y = row + 1, y + rise + 2 * SPACING
    if dialect.fan_in_infill and not first:
        pen.say("M106 S255")
    if dialect.absolute and dialect.slicer == "cura" and layer == 2:
        pen.say("G92 E0")  # as CuraEngine does once in a while, in the middle of a role
        pen.filament = 0.0
    if not first:
        pen.retract(back)


def _label(pen: _Pen, i: int, *, start: bool) -> None:
    dialect = pen.dialect
    word = b"start" if start else b"stop"
    if dialect.labels == "comment":
        begin = b"" if start else b"stop "
        pen.say(b"; %sprinting object %s id:%d copy 0" % (begin, dialect.name, i))
    elif dialect.labels == "M486":
        pen.say(b"M486 S%d" % (i if start else -1))
    elif dialect.labels == "EXCLUDE_OBJECT":
        pen.say(b"EXCLUDE_OBJECT_%s NAME=%s_%d" % (b"START" if start else b"END", dialect.name, i))
    elif dialect.labels == "M624":
        if start:
            pen.say(b"; OBJECT_ID: %d" % (15 + i))
        pen.say(b"; %s printing object, unique label id: %d" % (word, 15 + i))
        pen.say(b"M624 AQAAAAAAAAA=" if start else b"M625")
    elif dialect.slicer == "cura":
        pen.say(b";MESH:%s" % (dialect.name if start else b"NONMESH"))
    if start and dialect.tools > 1:
        pen.retract()
        pen.tool = i % dialect.tools
        pen.say(b"T%d" % pen.tool)


def _config(pen: _Pen) -> None:
    slicer = pen.dialect.slicer
    begin, end = (
        ("; prusaslicer_config = begin", "; prusaslicer_config = end")
        if slicer == "prusa"
        else ("; CONFIG_BLOCK_START", "; CONFIG_BLOCK_END")
    )
    pen.say(begin)
    names = (
        ("fill_density = 15%", "infill_extrusion_width = 0.45", "slowdown_below_layer_time = 0", "cooling = 1")
        if slicer == "prusa"
        else ("sparse_infill_density = 15%", "sparse_infill_line_width = 0.45", "slow_down_layer_time = 0")
    )
    for text in (*names, "filament_diameter = 1.75", "nozzle_diameter = 0.4", "layer_height = 0.2"):
        pen.say(f"; {text}")
    pen.say(end)


def _end(pen: _Pen) -> None:
    dialect = pen.dialect
    pen.retract()
    pen.tag("TYPE", dialect.roles[4])
    if dialect.slicer == "bambu":
        pen.say("; MACHINE_END_GCODE_START")
    pen.rise(pen.at[2] + 5)
    pen.say("M107")
    pen.say("M104 S0 ; turn off temperature")
    if dialect.slicer == "cura":
        pen.say(";End of Gcode")
        return
    pen.say("; filament used [mm] = " + ", ".join(f"{used:.2f}" for used in pen.used.values()))
    pen.say("; filament used [cm3] = 0.12")
    pen.say("; estimated printing time (normal mode) = 3m 1s")
    pen.say("")
    if dialect.slicer == "bambu":
        pen.say("; EXECUTABLE_BLOCK_END")
    else:
        _config(pen)


def _bytes(pen: _Pen) -> bytes:
    dialect = pen.dialect
    ending = b"\r\n" if dialect.crlf else b"\n"
    lines = pen.lines
    if dialect.numbered:
        lines = [b"N%d %s" % (i, line) for i, line in enumerate(lines, 1)]
    return ending.join(lines) + (ending if dialect.newline else b"")
