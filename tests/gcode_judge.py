"""Judge whether of a sliced print nothing but its sparse infill was changed, and that in a way a printer can follow.

Nothing here comes from the package: a second reader of G-code, line by line and slow, so that what both readers
agree on is more than one's own opinion. `judge(old, new)` returns one line for each thing that is wrong, beginning
with its name; no line if all is well.

The print is cut into stretches: what is outside the sparse infill, and sections inside it. A section begins at the tag
of the sparse role and ends at the next tag of a role; tags of layers, labels of objects, changes of tool and custom
blocks cut it in two. (PrusaSlicer says a role once, however many layers it lasts.) Outside, every line must be the same, byte for byte, and move the same way at the same speed from the same
place. Inside, what is no move must be kept, once and in order, and the moves must be lawful.
"""

from __future__ import annotations

import difflib
import functools
import math
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np
import shapely

NEAR = 0.0006  # mm: half of the last digit of X, Y and Z, and a little
PUSHED = 3e-5  # mm of filament: two roundings to five digits, and one of a sum
DEPTH = 1e-3  # mm of filament: a retraction in pieces, each rounded to five digits
WIDER = 0.08  # of the filament per mm: beads may be made so much wider or thinner
OUTSIDE = 0.02  # mm outside of the region of the slicer's own infill
BESIDE_OLD = 0.25  # mm from the old path, within which a new one may lie as near to other beads as that did
LONGEST = 95  # bytes of a line, which is what Marlin takes
FILAMENT = math.pi / 4 * 1.75**2  # mm²
SPARSE = (b"Internal infill", b"Sparse infill", b"FILL")

ROLE = re.compile(rb";\s*(?:TYPE|FEATURE):\s*(.*?)\s*$")
LAYER = re.compile(rb"(;LAYER_CHANGE|; ?CHANGE_LAYER|;LAYER:|;TIME_ELAPSED:|; ?WIPE_TOWER_START)")
WIDTH = re.compile(rb";\s*(?:WIDTH|LINE_WIDTH):\s*([\d.]+)")
HEIGHT = re.compile(rb";\s*(?:HEIGHT|LAYER_HEIGHT):\s*([\d.]+)")
WIPE = re.compile(rb";\s*WIPE_(START|END)")
LABEL = re.compile(
    rb"(; ?(stop |start )?printing object|;MESH:|; OBJECT_ID:|EXCLUDE_OBJECT|M486\b|M62[45]\b|T\d|; PURGING FINISHED"
    rb"|; ?(FLUSH|SKIPPABLE|NOZZLE_CHANGE)_(START|END)|; ?(CUSTOM_GCODE|COLOR_CHANGE|PAUSE_PRINT)|M600\b|M62[01]\b)"
)
VOLUMES = b"; use_volumetric_e = 1"  # then E is in mm³
STAMP = b"; refilled by phasefill "
TIMES = re.compile(
    rb";\s*(estimated (printing|first layer printing) time|(total )?filament (used|cost)|TIME:|TIME_ELAPSED:|"
    rb"Filament used:|model printing time:|M(IN|AX)[XYZ]:|total filament|PRINT\.(TIME|SIZE)|EXTRUDER_TRAIN)",
    re.IGNORECASE,
)
NUMBER = re.compile(rb"[-+]?(?:\d+\.?\d*|\.\d+)")
WORD = re.compile(rb"([A-Za-z])\s*([^A-Za-z\s]*)")
KINDS = {
    b"M106": "fan",
    b"M107": "fan",
    b"M710": "fan",
    b"M104": "temperature",
    b"M109": "temperature",
    b"M140": "temperature",
    b"M190": "temperature",
    b"M141": "temperature",
    b"M191": "temperature",
    b"M204": "acceleration",
    b"M205": "acceleration",
    b"M201": "acceleration",
    b"M203": "acceleration",
    b"M566": "acceleration",
    b"SET_VELOCITY_LIMIT": "acceleration",
    b"M900": "pressure advance",
    b"M572": "pressure advance",
    b"SET_PRESSURE_ADVANCE": "pressure advance",
    b"M220": "override",
    b"M221": "override",
    b"M486": "object label",
    b"M624": "object label",
    b"M625": "object label",
    b"EXCLUDE_OBJECT_START": "object label",
    b"EXCLUDE_OBJECT_END": "object label",
    b"EXCLUDE_OBJECT_DEFINE": "object label",
    b"EXCLUDE_OBJECT": "object label",
    b"M73": "progress",
    b"G90": "coordinates",
    b"G91": "coordinates",
    b"M82": "extruder mode",
    b"M83": "extruder mode",
    b"G92": "origin",
    b"G20": "units",
    b"G21": "units",
    b"G28": "homing",
    b"G4": "dwell",
}


@dataclass(slots=True)
class Line:
    """A line as it stands: `body` without its ending and number, `command` without its comment."""

    number: int
    raw: bytes
    body: bytes
    ending: bytes
    n: int | None
    command: bytes
    name: bytes
    kind: str


def read(number: int, raw: bytes) -> Line:
    body = raw.rstrip(b"\r\n")
    ending = raw[len(body) :]
    if body.startswith((b"G1 ", b"G0 ")) and b";" not in body and b"*" not in body:  # most lines
        return Line(number, raw, body, ending, None, body.strip(), body[:2], "move")
    n = None
    numbered = re.match(rb"\s*N(\d+)\s+", body)
    if numbered:
        n, body = int(numbered[1]), body[numbered.end() :]
    command = re.sub(rb"\*\d+\s*$", b"", body.split(b";", 1)[0]).strip()
    name = command.split(None, 1)[0].upper() if command else b""
    if not name.startswith((b"SET_", b"EXCLUDE", b"T")):
        packed = re.match(rb"([GM])0*(\d+(?:\.\d+)?)", name)
        name = packed[1] + packed[2] if packed else name
    return Line(number, raw, body, ending, n, command, name, kind_of(name, command, body.strip()))


def kind_of(name: bytes, command: bytes, body: bytes) -> str:
    if name in (b"G0", b"G1", b"G2", b"G3"):
        return "move"
    if name in (b"G10", b"G11") and not re.search(rb"[SPR]\d", command):
        return "firmware retraction"
    if name in (b"G10",):
        return "temperature"
    if name in KINDS:
        return KINDS[name]
    if re.fullmatch(rb"T\d+", name):
        return "tool"
    if command:
        return "command"
    if not body:
        return "blank"
    if WIPE.match(body):
        return "wipe tag"
    if LABEL.match(body):
        return "object label"
    if ROLE.match(body) or LAYER.match(body) or WIDTH.match(body) or HEIGHT.match(body):
        return "tag"
    return "comment"


@dataclass
class Section:
    """A stretch of lines: inside the sparse infill, or outside."""

    sparse: bool
    lines: list[Line]
    layer: int


def sections(data: bytes) -> list[Section]:
    """Cut a print into stretches; of two of a kind in a row the second begins at a label."""
    found = [Section(False, [], 0)]
    sparse, layer = False, 0
    for number, raw in enumerate(_cut(data), 1):
        line = read(number, raw)
        role = ROLE.match(line.body)
        if role:
            sparse = role[1] in SPARSE
        elif LAYER.match(line.body):
            new = not line.body.startswith((b";TIME", b"; WIPE_T", b";WIPE_T"))
            layer += new
            sparse &= new
        inside = sparse and not role and not LABEL.match(line.body) and not LAYER.match(line.body)
        if inside != found[-1].sparse:
            found.append(Section(inside, [], layer))
        found[-1].lines.append(line)
        found[-1].layer = layer
    return found


def purged(parts: list[Section]) -> set[int]:
    """Return the sections that take what is purged: from a change of the tool to the first tag in its layer that ends it."""
    found: set[int] = set()
    since: int | None = None
    for i, part in enumerate(parts):
        for line in part.lines if not part.sparse else []:
            if re.match(rb"T\d", line.body):
                since = i if since is None else since
            elif LAYER.match(line.body):
                since = None
            elif b"; PURGING FINISHED" in line.body and since is not None:
                found |= {k for k in range(since, i) if parts[k].sparse}
                since = None
    return found


def _cut(data: bytes) -> list[bytes]:
    return [line for line in re.split(rb"(?<=\n)", data) if line]


@dataclass(slots=True)
class Move:
    """One line that moves something: where it began, its points, the filament it pushes, how far that was retracted."""

    line: Line
    start: tuple[float, float, float]
    points: tuple[tuple[float, float], ...]
    end: tuple[float, float, float]
    pushed: float
    speed: float
    depth: float
    tool: int
    role: bytes
    width: float
    height: float
    layer: int
    wiping: bool
    logical: float
    retracted: bool  # by the firmware

    length: float
    turn: float  # radians of an arc; 0 of a straight move

    @property
    def rounding(self) -> float:
        """By how much the length may be wrong because places, and the centre of an arc, are rounded, in mm.

        A centre that lies off by d changes the radius by d at most, and the angle by d over the radius at either end.
        """
        return NEAR * (4 + self.turn if self.turn else 2)

    @property
    def extrudes(self) -> bool:
        return self.pushed > 0 and self.length > 0 and len(self.points) > 1

    @property
    def travels(self) -> bool:
        return self.pushed == 0 and self.length > 0

    @property
    def per_mm(self) -> float:
        return self.pushed / self.length

    def seconds(self) -> float:
        way = self.length or abs(self.pushed)
        return way / self.speed * 60 if self.speed else 0.0


@dataclass
class Machine:
    """All that a printer remembers."""

    at: dict[str, float] = field(default_factory=lambda: dict.fromkeys("XYZE", 0.0))  # where it is
    zero: dict[str, float] = field(default_factory=lambda: dict.fromkeys("XYZE", 0.0))  # what it calls 0
    absolute: bool = True
    absolute_e: bool = True
    speed: float = 0.0
    tool: int = 0
    depth: dict[int, float] = field(default_factory=dict)  # mm, by tool
    retracted: dict[int, bool] = field(default_factory=dict)  # by the firmware, by tool
    modes: dict[str, bytes] = field(default_factory=dict)  # fans, temperatures, accelerations, labels
    units: float = 1.0
    role: bytes = b""
    width: float = 0.0
    height: float = 0.0
    layer: int = 0
    wiping: bool = False
    faults: list[str] = field(default_factory=list)

    def copy(self) -> Machine:
        """Return one that goes its own way."""
        dicts = ("at", "zero", "depth", "retracted", "modes")
        return replace(self, **{name: dict(getattr(self, name)) for name in dicts}, faults=[])

    def run(self, line: Line) -> Move | None:
        if line.kind == "move":
            return self._move(line)
        tool = self.tool
        text = line.body.strip()
        if line.kind == "firmware retraction":
            out = line.name == b"G10"
            if self.retracted.get(tool, False) == out:
                self.faults.append(
                    f"{'doubled retract' if out else 'unretract when not retracted'}: line {line.number}"
                )
            self.retracted[tool] = out
        elif line.name in (b"G90", b"G91"):
            self.absolute = line.name == b"G90"
        elif line.name in (b"M82", b"M83"):
            self.absolute_e = line.name == b"M82"
        elif line.name in (b"G20", b"G21"):
            self.units = 25.4 if line.name == b"G20" else 1.0
        elif line.name == b"G92":
            for axis, value in words(line.command):
                if axis in self.zero and value is not None:
                    self.zero[axis] = self.at[axis] - value * self.units
        elif line.name == b"G28":
            for axis in [a for a, _ in words(line.command) if a in "XYZ"] or "XYZ":
                self.at[axis] = self.zero[axis] = 0.0
        elif line.kind == "tool":
            self.tool = int(line.name[1:])
        elif line.kind in ("fan", "temperature", "acceleration", "pressure advance", "override", "object label"):
            self._mode(line)
        elif not line.command:
            for pattern, name in ((WIDTH, "width"), (HEIGHT, "height")):
                if found := pattern.match(text):
                    setattr(self, name, float(found[1]))
            if found := ROLE.match(text):
                self.role = found[1]
            elif LAYER.match(text):
                self.role, self.layer = b"", self.layer + (not text.startswith((b";TIME", b"; WIPE_T", b";WIPE_T")))
            elif found := WIPE.match(text):
                self.wiping = found[1] == b"START"
        return None

    def _mode(self, line: Line) -> None:
        if line.kind == "object label":
            self.modes["object label"] = line.command or line.body.strip()
            return
        if line.name.startswith(b"SET_"):
            for part in line.command.split()[1:]:
                self.modes[f"{line.kind} {part.split(b'=')[0].decode('latin-1')}"] = part
            return
        which = dict(words(line.command))
        if line.kind == "fan":
            on = 0.0 if line.name == b"M107" else which.get("S", 255.0) or 0.0
            self.modes[f"fan {which.get('P', 0)}"] = b"%g" % on
        elif line.kind == "temperature":
            bed = line.name in (b"M140", b"M190")
            chamber = line.name in (b"M141", b"M191")
            of = "bed" if bed else "chamber" if chamber else f"tool {which.get('T', which.get('P', self.tool))}"
            self.modes[f"temperature {of}"] = b"%g" % (which.get("S") or which.get("R") or 0.0)
        else:
            for letter, value in which.items():
                if letter not in "MG":
                    self.modes[f"{line.kind} {line.name.decode()} {letter}"] = b"%g" % (value or 0.0)

    def _move(self, line: Line) -> Move | None:
        start = (self.at["X"], self.at["Y"], self.at["Z"])
        given: dict[str, float] = {}
        for letter, value in words(line.command)[1:]:
            if value is None or not math.isfinite(value):
                self.faults.append(f"odd word: line {line.number}: {line.command[:60]!r}")
                return None
            given[letter] = value
        if "F" in given:
            self.speed = given["F"] * self.units
        pushed = 0.0
        for axis in "XYZ":
            if axis in given:
                value = given[axis] * self.units
                self.at[axis] = self.zero[axis] + value if self.absolute else self.at[axis] + value
        if "E" in given:
            value = given["E"] * self.units
            to = self.zero["E"] + value if self.absolute_e and self.absolute else self.at["E"] + value
            pushed, self.at["E"] = to - self.at["E"], to
            if abs(pushed) < 1e-9:  # mm: what is left of a difference
                pushed = 0.0
        depth = self.depth.get(self.tool, 0.0)
        self.depth[self.tool] = max(0.0, depth - pushed)
        end = (self.at["X"], self.at["Y"], self.at["Z"])
        points = (start[:2], end[:2])
        way, turn = math.dist(*points), 0.0
        if line.name in (b"G2", b"G3"):
            clockwise = line.name == b"G2"
            points = arc(start[:2], end[:2], given, clockwise=clockwise)
            middle, turn = circle(start[:2], end[:2], given, clockwise=clockwise)
            way = turn * (math.dist(start[:2], middle) + math.dist(end[:2], middle)) / 2
        elif start[:2] == end[:2]:
            points = (start[:2],)
        if points == (start[:2],) and start == end and not pushed:
            return None
        return Move(
            line=line,
            start=start,
            points=points,
            end=end,
            pushed=pushed,
            speed=self.speed,
            depth=depth,
            tool=self.tool,
            role=self.role,
            width=self.width,
            height=self.height,
            layer=self.layer,
            wiping=self.wiping,
            logical=self.at["E"] - self.zero["E"],
            retracted=self.retracted.get(self.tool, False),
            length=math.hypot(way, end[2] - start[2]),
            turn=turn,
        )


def words(command: bytes) -> list[tuple[str, float | None]]:
    """Return the words of a command as a firmware reads them: a letter and digits; no number is None."""
    return [(letter.decode().upper(), number_of(number)) for letter, number in WORD.findall(command)]


@functools.lru_cache(maxsize=1 << 16)
def number_of(text: bytes) -> float | None:
    """Return the number that a text is, or None."""
    return float(text) if NUMBER.fullmatch(text) else None


def circle(start, end, given, *, clockwise: bool) -> tuple[tuple[float, float], float]:
    """Return the centre of an arc, and by how much it turns."""
    if "R" in given:
        half = math.dist(start, end) / 2
        rise = math.sqrt(max(given["R"] ** 2 - half**2, 0.0)) * (-1 if (given["R"] > 0) == clockwise else 1)
        along = ((end[0] - start[0]) / (2 * half), (end[1] - start[1]) / (2 * half))
        middle = (
            (start[0] + end[0]) / 2 - along[1] * rise,
            (start[1] + end[1]) / 2 + along[0] * rise,
        )
    else:
        middle = (start[0] + given.get("I", 0.0), start[1] + given.get("J", 0.0))
    first, last = (math.atan2(y - middle[1], x - middle[0]) for x, y in (start, end))
    turn = (first - last if clockwise else last - first) % (2 * math.pi)
    return middle, turn if turn > 1e-9 else 2 * math.pi


def arc(start, end, given, *, clockwise: bool) -> tuple[tuple[float, float], ...]:
    """Cut an arc into chords that leave it by less than a micrometre or so."""
    middle, turn = circle(start, end, given, clockwise=clockwise)
    radius = math.dist(start, middle)
    first = math.atan2(start[1] - middle[1], start[0] - middle[0])
    pieces = max(2, math.ceil(turn * math.sqrt(max(radius, 1e-6) / 0.008)))
    sign = -1 if clockwise else 1
    inner = [
        (
            middle[0] + radius * math.cos(first + sign * turn * i / pieces),
            middle[1] + radius * math.sin(first + sign * turn * i / pieces),
        )
        for i in range(1, pieces)
    ]
    return (start, *inner, end)


@dataclass
class Replay:
    """A stretch of lines, run: its moves by line, and the machine before and after."""

    before: Machine
    after: Machine
    moves: list[Move | None]
    faults: list[str]

    def moved(self) -> list[Move]:
        return [move for move in self.moves if move is not None]

    def beads(self) -> list[Move]:
        return [move for move in self.moved() if move.extrudes]


def run(section: Section, machine: Machine) -> Replay:
    """Run the lines of a stretch; `machine` is what they leave."""
    before = machine.copy()
    machine.faults = []
    moves = [machine.run(line) for line in section.lines]
    return Replay(before, machine.copy(), moves, machine.faults)


@functools.lru_cache(maxsize=4)
def replayed(data: bytes) -> tuple[list[Section], list[Replay]]:
    """Return the stretches of a print, and each of them run."""
    machine = Machine()
    parts = sections(data)
    return parts, [run(part, machine) for part in parts]


@dataclass(frozen=True)
class Habits:
    """What a slicer does in a print, which is what may be done in it."""

    travel: float  # mm/min, the fastest of each
    lift: float
    filament: float
    wipe: float
    depth: float  # mm, the deepest retraction
    extra: float  # mm, the most that an unretraction pushes beyond
    hops: tuple[float, ...]  # mm above the bead before
    wipes: bool
    shortest: float  # s, of a layer
    fastest: float  # mm/min, of sparse infill
    cura: bool
    arcs: bool


def habits(data: bytes, replays: list[Replay]) -> Habits:
    moves = [move for part in replays for move in part.moved()]
    still = [move for move in moves if not move.length]
    hops, height, top = set(), 0.0, 0.0
    for move in moves:
        top = max(top, move.end[2])
        if move.extrudes:  # a hop is above the bead before and the bead after
            hop = round(top - max(height, move.end[2]), 3)
            hops |= {hop} if 0 < hop < 2 else set()
            height = top = move.end[2]
    config = dict(re.findall(rb"^; (\w+) = (.*?)\r?$", data, re.MULTILINE))
    least = 0.0
    if config.get(b"cooling", config.get(b"slow_down_for_layer_cooling", b"1")).startswith(b"1"):
        value = config.get(b"slowdown_below_layer_time", config.get(b"slow_down_layer_time", b"0"))
        least = float(value.split(b",")[0] or 0)
    return Habits(
        travel=max((m.speed for m in moves if m.travels), default=0.0),
        lift=max((m.speed for m in moves if m.start[2] != m.end[2]), default=0.0),
        filament=max((m.speed for m in still), default=0.0),
        wipe=max((m.speed for m in moves if m.pushed < 0 and m.length), default=0.0),
        depth=max((max(0.0, m.depth - m.pushed) for m in moves), default=0.0),
        extra=max((m.pushed - m.depth for m in still), default=0.0),
        hops=tuple(hops),
        wipes=any(WIPE.match(line) for line in data.split(b"\n")),
        shortest=least,
        fastest=max((m.speed for part in replays for m in part.beads() if m.role in SPARSE), default=0.0),
        cura=b";FLAVOR:" in data,
        arcs=any(m.line.name in (b"G2", b"G3") for m in moves if m.extrudes),
    )


def judge(
    old: bytes, new: bytes, *, deviation: float | None = None, filament: tuple[float, float] = (0.8, 1.02)
) -> list[str]:
    """Return what is wrong with `new`, made of `old` by replacing its sparse infill.

    Parameters
    ----------
    old, new : bytes
        Whole files.
    deviation : float, optional
        If given, the infill must be the old one, nowhere further from it than this, in mm, and retract where it did.
    filament : tuple of float
        Least and most filament of the new infill, over the old one's.

    Returns
    -------
    list of str
        One line for each violation, beginning with its name; empty if there is none.
    """
    if old == new:
        return []
    faults: list[str] = []
    stamps = [line for line in new.split(b"\n") if line.startswith(STAMP)]
    if len(stamps) != 1:
        faults.append(f"stamp: {len(stamps)} stamps, not 1")
    if old.endswith(b"\n") != new.endswith(b"\n"):
        faults.append("newline at the end of the file: not as it was")
    old_parts, old_runs = replayed(old)
    new_parts = sections(new)
    begins = next((x.number for part in new_parts for x in part.lines if LAYER.match(x.body)), 0)
    for part in new_parts:
        stamped = [line for line in part.lines if line.raw.startswith(STAMP)]
        for line in stamped:
            if line.number > begins:
                faults.append(f"stamp: line {line.number} is not near the top")
            if not re.match(rb"; refilled by phasefill [\w.+]+: \S", line.raw):
                faults.append(f"stamp: {line.raw[:60]!r} is no stamp")
            if line.ending != part.lines[0].ending:
                faults.append(f"line ending changed: {_name(line)}")
            part.lines.remove(line)
    if [part.sparse for part in old_parts] != [part.sparse for part in new_parts]:
        faults.append(f"tag: {len(old_parts)} stretches became {len(new_parts)}")
        faults += list(_differences([p for s in old_parts for p in s.lines], [p for s in new_parts for p in s.lines]))
        return _shortened(faults)
    habit = habits(old, old_runs)
    machine = Machine()
    new_runs = []
    purges = purged(old_parts)
    for i, (a, b, was) in enumerate(zip(old_parts, new_parts, old_runs, strict=True)):
        now = run(b, machine)
        new_runs.append(now)
        if a.sparse:
            if i in purges and [x.raw for x in a.lines] != [x.raw for x in b.lines]:
                faults.append(f"purge: line {b.lines[0].number}: what is purged was changed")
            following = next((s.lines[0].number for s in new_parts[i + 1 : i + 2]), "the end")
            faults += _inside(a, b, was, now, habit, strict=deviation is not None)
            # What follows must find what it found: a stretch outside tells by itself what it misses, but its name is here.
            faults += [f"{text} (before line {following})" for text in _states(was.after, now.after)]
        else:
            faults += _outside(a, b, was, now)
        machine = was.after.copy()  # one fault is told once
    faults += _regions(old_parts, old_runs, new_runs, deviation)
    faults += _totals(old_parts, old_runs, new_runs, habit, filament)
    faults += _told(old_parts, new_parts, old_runs, new_runs, 1 / FILAMENT if VOLUMES in old else 1.0)
    faults += _numbers(new_parts)
    faults += _progress(old_parts, new_parts)
    return _shortened(faults)


def _shortened(faults: list[str]) -> list[str]:
    """Tell three faults of a name, and how many more there are."""
    names = Counter(fault.split(":")[0] for fault in faults)
    told: Counter[str] = Counter()
    left = []
    for fault in faults:
        name = fault.split(":")[0]
        told[name] += 1
        if told[name] <= 3:
            left.append(fault)
        elif told[name] == 4:
            left.append(f"{name}: and {names[name] - 3} more")
    return left


def changed(old: bytes, new: bytes) -> int:
    """Return how many sections of the sparse infill have other moves in `new`."""
    return sum(
        a.sparse and [x.raw for x in a.lines if x.kind == "move"] != [x.raw for x in b.lines if x.kind == "move"]
        for a, b in zip(replayed(old)[0], sections(new), strict=True)
    )


def infilled(data: bytes) -> int:
    """Return how many sections of a print extrude sparse infill."""
    parts, runs = replayed(data)
    return sum(part.sparse and bool(ran.beads()) for part, ran in zip(parts, runs, strict=True))


def pushed(data: bytes) -> tuple[float, float]:
    """Return the filament of the beads of sparse infill, and of all outside, in mm."""
    parts, runs = replayed(data)
    both = [0.0, 0.0]
    for part, ran in zip(parts, runs, strict=True):
        both[not part.sparse] += sum(move.pushed for move in ran.moved() if move.extrudes or not part.sparse)
    return both[0], both[1]


def _same_but_for_times(a: Line, b: Line) -> bool:
    if a.raw == b.raw:
        return True
    if a.ending != b.ending:
        return False
    if a.kind == b.kind == "progress":
        return [w for w, _ in words(a.command)] == [w for w, _ in words(b.command)] and all(
            value is not None and value >= 0 for _, value in words(b.command)
        )
    if a.command or b.command or not TIMES.match(a.body):
        return False
    split = re.compile(rb"^(.*?[=:])")
    return bool(split.match(a.body) and split.match(b.body) and split.match(a.body)[1] == split.match(b.body)[1])


def _name(line: Line) -> str:
    return f"line {line.number}: {line.raw[:60]!r}"


def _differences(a: list[Line], b: list[Line]) -> Iterator[str]:
    """Tell what became of lines that should all have been kept."""
    if len(a) == len(b) and Counter(x.raw for x in a) != Counter(x.raw for x in b):
        pairs = [(x, y) for x, y in zip(a, b, strict=True) if not _same_but_for_times(x, y)]
        if 2 * len(pairs) <= len(a) + 2:
            for x, y in pairs:
                yield _changed(x, y)
            return
    plain = [[b"M73" if x.kind == "progress" else x.raw for x in lines] for lines in (a, b)]
    for word, i, j, k, m in difflib.SequenceMatcher(None, *plain, autojunk=False).get_opcodes():
        if word == "equal":
            continue
        if word == "replace" and j - i == m - k:
            yield from (_changed(x, y) for x, y in zip(a[i:j], b[k:m], strict=True) if not _same_but_for_times(x, y))
            continue
        moved = Counter(x.raw for x in a) == Counter(x.raw for x in b)
        for x in a[i:j]:
            yield f"{x.kind} {'out of order' if moved else 'lost'}: old {_name(x)}"
        if not moved:
            yield from (f"{y.kind} added: {_name(y)}" for y in b[k:m])


def _changed(x: Line, y: Line) -> str:
    if x.body == y.body and x.n == y.n:
        return f"line ending changed: {_name(y)} was {x.raw[-30:]!r}"
    return f"{x.kind} changed: {_name(y)} was {x.raw[:60]!r}"


def _outside(a: Section, b: Section, was: Replay, now: Replay) -> Iterator[str]:
    """Everything as it was: the lines, and what they do."""
    if len(a.lines) != len(b.lines) or not all(map(_same_but_for_times, a.lines, b.lines)):
        yield from _differences(a.lines, b.lines)
    yield from (fault for fault in now.faults if len(now.faults) > len(was.faults))
    if len(was.moves) != len(now.moves):
        return
    for x, y in zip(was.moves, now.moves, strict=True):
        if (x is None) != (y is None):
            yield f"move changed: {_name((x or y).line)} moves in one file alone"
        elif x is not None and y is not None:
            wrong = [
                name
                for name, bad in (
                    ("E", abs(x.pushed - y.pushed) > PUSHED),
                    ("position", max(math.dist(x.start, y.start), math.dist(x.end, y.end)) > NEAR),
                    ("F", x.speed != y.speed),
                    ("retraction", abs(x.depth - y.depth) > DEPTH or x.retracted != y.retracted),
                    ("tool", x.tool != y.tool),
                )
                if bad
            ]
            if wrong:
                yield f"{', '.join(wrong)} of a move outside the infill: {_name(y.line)}"
                return  # what follows is wrong for the same reason


def _states(a: Machine, b: Machine) -> Iterator[str]:
    """Compare what the following lines find."""
    if any(abs(a.at[axis] - b.at[axis]) > NEAR for axis in "XYZ"):
        yield "position: a section ends at {X:.3f} {Y:.3f} {Z:.3f}".format(**b.at) + (
            ", not {X:.3f} {Y:.3f} {Z:.3f}".format(**a.at)
        )
    if a.speed != b.speed:
        yield f"F: a section leaves F{b.speed:g}, not F{a.speed:g}"
    if a.absolute_e and abs((a.at["E"] - a.zero["E"]) - (b.at["E"] - b.zero["E"])) > PUSHED:
        yield f"E: a section leaves E{b.at['E'] - b.zero['E']:.5f}, not E{a.at['E'] - a.zero['E']:.5f}"
    if any(abs(a.depth.get(t, 0) - b.depth.get(t, 0)) > DEPTH for t in {*a.depth, *b.depth}):
        yield f"retraction: a section leaves {b.depth}, not {a.depth}"
    if {t for t, out in a.retracted.items() if out} != {t for t, out in b.retracted.items() if out}:
        yield "retraction: the firmware's is another"
    for name, one, two in (
        ("coordinates", a.absolute, b.absolute),
        ("extruder mode", a.absolute_e, b.absolute_e),
        ("tool", a.tool, b.tool),
        ("wipe tag", a.wiping, b.wiping),
        ("units", a.units, b.units),
        ("width", (a.width, a.height), (b.width, b.height)),
    ):
        if one != two:
            yield f"{name}: a section leaves {two}, not {one}"
    for name in sorted({*a.modes, *b.modes}):
        if a.modes.get(name) != b.modes.get(name):
            yield f"{name}: a section leaves {b.modes.get(name)}, not {a.modes.get(name)}"
    if any(abs(a.zero[axis] - b.zero[axis]) > NEAR for axis in "XYZ"):
        yield "origin: a section leaves another G92"


FREE = {"move"}
PAIRED = {"wipe tag", "firmware retraction"}


def _inside(a: Section, b: Section, was: Replay, now: Replay, habit: Habits, *, strict: bool) -> Iterator[str]:
    """Judge the new moves of a section."""
    if [line.raw for line in a.lines] == [line.raw for line in b.lines]:
        return
    free = FREE if strict else FREE | PAIRED
    kept = [[line for line in part.lines if line.kind not in free] for part in (a, b)]
    absolute = was.before.absolute_e
    if absolute and strict:  # G92 E may be added where it is needed
        kept[1] = _without_new_origins(*kept)
    elif absolute:  # and other paths go on counting, or count anew: what they push and where they end is judged as well
        kept = [[line for line in part if not re.fullmatch(rb"G92 E-?[\d.]+", line.command)] for part in kept]
    if len(kept[0]) != len(kept[1]) or not all(map(_same_but_for_times, *kept)):
        yield from _differences(*kept)
    else:
        yield from _places(*kept, a, b, was, now)
    yield from (fault for fault in now.faults if len(now.faults) > len(was.faults))
    endings = {line.ending for line in a.lines if line.ending}
    written = {line.raw for line in a.lines}
    for line in b.lines:
        if line.ending and line.ending not in endings:
            yield f"line ending changed: {_name(line)}"
        elif not line.ending and any(x.ending for x in a.lines[-1:]):
            yield f"newline lost: {_name(line)}"
        if line.kind == "move" and line.raw not in written:
            if len(line.command) > LONGEST:
                yield f"line too long: {_name(line)}"
            if any(re.fullmatch(rb"[A-Z]-?[\d.]+[eE][-+]?\d+", word) for word in line.command.split()):
                yield f"odd word: {_name(line)} has an exponent"
            if not line.raw.isascii():
                yield f"not ASCII: {_name(line)}"
            if any(w == "F" and (v is None or v <= 0) for w, v in words(line.command)):
                yield f"F0: {_name(line)}"
            if line.name in (b"G2", b"G3") and not habit.arcs:
                yield f"arc: {_name(line)} where there was none"
    yield from _moves(was, now, habit)
    if strict:
        yield from _ways(was, now)


def _ways(was: Replay, now: Replay) -> Iterator[str]:
    """Where paths are the slicer's own, so are the ways between them: as high, and as far retracted."""
    between = [
        [m for m in ran.moved() if m.travels or (m.pushed and not m.length)]  # wipes may follow another path
        for ran in (was, now)
    ]
    if len(between[0]) != len(between[1]):
        yield f"way between paths: {len(between[1])} travels and retractions, not {len(between[0])} {_lines(now)}"
        return
    for a, b in zip(*between, strict=True):
        far = math.dist(a.end, b.end) > NEAR or abs(a.depth - b.depth) > 2 * DEPTH or a.retracted != b.retracted
        if far or abs(a.pushed - b.pushed) > 2 * DEPTH:
            yield f"way between paths: {_name(b.line)} was {a.line.raw[:60]!r}"
            return


def _lines(ran: Replay) -> str:
    moves = ran.moved()
    return f"in lines {moves[0].line.number} to {moves[-1].line.number}" if moves else "in none"


def _without_new_origins(old: list[Line], new: list[Line]) -> list[Line]:
    left, i = [], 0
    for line in new:
        expected = old[i] if i < len(old) else None
        if re.fullmatch(rb"G92 E-?[\d.]+", line.command) and (expected is None or expected.raw != line.raw):
            continue
        left.append(line)
        i += 1
    return left


def _places(x: list[Line], y: list[Line], a: Section, b: Section, was: Replay, now: Replay) -> Iterator[str]:
    """A command that came before all beads, or after them, still does; one between is not far from where it was."""
    for p, q, one, two in zip(x, y, _shares(x, a, was), _shares(y, b, now), strict=True):
        if p.kind in ("progress", "blank", "comment", "origin") or p.name == b"M117" or None in (one, two):
            continue
        if (one == 0) != (two == 0) or (one == 1) != (two == 1) or abs(one - two) > 0.35:
            yield f"{p.kind} moved: {_name(q)} stands after {two:.0%} of the infill, not after {one:.0%}"


def _shares(lines: list[Line], part: Section, ran: Replay) -> list[float | None]:
    total = sum(move.pushed for move in ran.beads())
    wanted = {line.number for line in lines}
    done, shares = 0.0, []
    last = max((i for i, move in enumerate(ran.moves) if move is not None and move.extrudes), default=-1)
    for i, (line, move) in enumerate(zip(part.lines, ran.moves, strict=True)):
        if move is not None and move.extrudes:
            done += move.pushed
        if line.number in wanted:
            shares.append(None if not total else 1.0 if i > last else min(done / total, 1 - 1e-9))
    return shares


def _moves(was: Replay, now: Replay, habit: Habits) -> Iterator[str]:
    """Speeds, heights, filament and retraction of the new moves."""
    old, new = was.moved(), now.moved()
    beads = was.beads()
    own = {_whole(m) for m in old}
    top = max((m.speed for m in beads), default=0.0)
    least = min((m.speed for m in beads), default=0.0)
    heights = {round(m.end[2], 3) for m in beads}
    hops = {round(m.end[2], 3) for m in old} | {round(was.before.at["Z"], 3)}
    hops |= {round(z + hop, 3) for z in heights for hop in habit.hops}
    flow = max((m.per_mm * m.speed for m in beads if m.length > 0.5), default=math.inf)
    doses = _doses(beads)
    late = any(m.extrudes and (m.depth > 2 * DEPTH or m.retracted) for m in old)
    for m in new:
        if _whole(m) in own:
            continue
        at = _name(m.line)
        if m.speed <= 0:
            yield f"F0: {at} moves at F{m.speed:g}"
        if round(m.end[2], 3) not in (heights if m.extrudes else hops):
            yield f"Z: {at} is at {m.end[2]:g}"
        if m.extrudes:
            if m.start[2] != m.end[2]:
                yield f"Z: {at} extrudes while it rises"
            if m.speed > top:
                yield f"F: {at} extrudes at F{m.speed:g}, the slicer at F{top:g}"
            if m.speed < 0.2 * least:  # mm/s taken for mm/min, say
                yield f"F: {at} extrudes at F{m.speed:g}, the slicer at F{least:g} or more"
            if (m.depth > 2 * DEPTH or m.retracted) and not late:
                yield f"extrusion while retracted: {at}"
            low, high = doses.get((m.width, m.height), doses[0, 0])
            slack = (2 * PUSHED + m.per_mm * m.rounding) / m.length
            if not low - slack <= m.per_mm <= high + slack:
                yield f"E per mm: {at} is {m.per_mm:.5f}, not {low:.5f} to {high:.5f}"
            if m.length > 0.5 and m.per_mm * m.speed > flow * (1 + WIDER) + slack * m.speed:
                yield f"flow: {at} is {m.per_mm * m.speed:.1f}, the slicer's {flow:.1f}"
        elif m.pushed > 0 and m.pushed > m.depth + max(habit.extra, 0.0) + DEPTH:
            yield f"unretract when not retracted: {at} pushes {m.pushed:.5f}, retracted were {m.depth:.5f}"
        elif m.pushed < 0:
            if m.depth - m.pushed > habit.depth + DEPTH:
                yield f"doubled retract: {at} retracts to {m.depth - m.pushed:.5f}"
            if len(m.points) > 1 and habit.wipes and not m.wiping:
                yield f"wipe: {at} wipes outside of its tags"
        if m.pushed and m.speed > (habit.wipe if m.length else habit.filament) and not m.extrudes:
            yield f"F: {at} moves filament at F{m.speed:g}"
        if m.travels and m.speed > max(habit.travel, habit.lift):
            yield f"F: {at} travels at F{m.speed:g}"


def _whole(m: Move) -> tuple[object, ...]:
    """Return what a move is, with all that it is done with."""
    push = (round(m.pushed, 4), round(m.depth, 3), m.retracted, m.wiping)
    return (m.line.raw, m.start, m.speed, m.tool, m.width, m.height, *push)


def _doses(beads: list[Move]) -> dict[tuple[float, float], tuple[float, float]]:
    """Return the least and the most filament per mm, by width and height as they are tagged, and of all."""
    found: dict[tuple[float, float], tuple[float, float]] = {}
    for tags in {(0.0, 0.0), *((m.width, m.height) for m in beads)}:
        these = [m for m in beads if tags == (0.0, 0.0) or (m.width, m.height) == tags]
        if not these:
            found[tags] = (0.0, 0.0)
            continue
        longest = max(m.length for m in these)
        these = sorted((m for m in these if m.length >= min(0.5, longest)), key=lambda m: m.per_mm)
        weight = np.cumsum([min(m.length, 10.0) for m in these])  # mm: a line that runs away is one line
        share = weight / weight[-1]
        low, high = (these[int(np.searchsorted(share, q).clip(0, len(these) - 1))].per_mm for q in (0.02, 0.98))
        found[tags] = (low * (1 - WIDER), high * (1 + WIDER))
    return found


def lines_of(moves: list[Move]) -> list[np.ndarray]:
    """Join moves that follow one another into paths."""
    paths: list[list[tuple[float, float]]] = []
    for move in moves:
        if paths and math.dist(paths[-1][-1], move.points[0]) < NEAR:
            paths[-1] += move.points[1:]
        else:
            paths.append(list(move.points))
    return [np.array(path) for path in paths if len(path) > 1]


def _width(move: Move, layer_height: float) -> float:
    if move.width:
        return move.width
    height = move.height or layer_height
    area = move.per_mm * FILAMENT
    return area / height + height * (1 - math.pi / 4) if height else 0.45


def walls(others: list[Move], height: float):
    """Return where a layer is printed by what is not sparse infill."""
    groups: dict[float, list[Move]] = {}
    for move in others:
        if move.length > 0:
            groups.setdefault(min(max(round(_width(move, height), 2), 0.1), 1.5), []).append(move)
    return shapely.union_all(
        [
            shapely.buffer(shapely.union_all([shapely.linestrings(p) for p in lines_of(moves)]), width / 2, quad_segs=4)
            for width, moves in groups.items()
        ]
    )


def region(others: list[Move], old: list[Move], height: float):
    """Return where the centre lines of a section's infill may lie, and how much of the old ones lies elsewhere.

    It is what is free between the beads of all else in the layer, as far into it, or as far from its border, as the
    slicer's own infill goes; and that infill itself.
    """
    paths = shapely.union_all([shapely.linestrings(path) for path in lines_of(old)])
    width = float(np.median([_width(move, height) for move in old]))
    solid = walls(others, height)
    filled = shapely.union_all([shapely.Polygon(part.exterior) for part in shapely.get_parts(solid)])
    free = [part for part in shapely.get_parts(shapely.difference(filled, solid)) if part.area > width**2]
    free = [part for part in free if shapely.intersection(part, paths).length > width]
    own = shapely.buffer(paths, 1e-6)
    if not free:
        return shapely.convex_hull(paths), 1.0
    room = shapely.union_all(free)
    points = shapely.points(np.vstack(lines_of(old)))
    signed = shapely.distance(points, room.boundary) * np.where(shapely.contains(room, points), -1, 1)
    reach = float(np.clip(signed.max(), -width / 2, width / 2))
    wide = grown(room, reach)
    return shapely.union(wide, own), shapely.difference(paths, wide).length / paths.length


def grown(room, reach: float):
    """Return a region that is larger by `reach` mm all round, with its corners; a mitred outline may touch itself."""
    outline = shapely.buffer(room, reach, join_style="mitre", mitre_limit=2.0)
    return shapely.make_valid(outline, method="structure")


def _regions(parts: list[Section], was: list[Replay], now: list[Replay], deviation: float | None) -> Iterator[str]:
    layers: dict[int, list[Move]] = {}
    heights: dict[int, float] = {}
    for part, ran in zip(parts, was, strict=True):
        for move in ran.beads():
            heights[move.layer] = move.end[2]
            if not part.sparse:
                layers.setdefault(move.layer, []).append(move)
    below = sorted(heights.values())
    for part, old, new in zip(parts, was, now, strict=True):
        beads = old.beads()
        if not part.sparse:
            continue
        if not beads:
            if new.beads():
                yield f"move outside: {_name(new.beads()[0].line)} extrudes where there was no infill"
            continue
        own = {(m.line.raw, m.start) for m in old.moved()}
        fresh = [m for m in new.moved() if len(m.points) > 1 and (m.line.raw, m.start) not in own]
        if not fresh:
            continue
        level = beads[0].end[2]
        step = level - max((z for z in below if z < level - NEAR), default=0.0)
        # Round about a section alone: other objects of the layer are too far to bound it.
        others = layers.get(part.layer, [])
        room, _ = region(others, beads, step)
        drawn, solid = (
            shapely.union_all([shapely.linestrings(path) for path in lines_of(moves)]) for moves in (beads, others)
        )
        near = shapely.buffer(room, OUTSIDE)
        shapely.prepare(near)
        over_walls = shapely.buffer(room, beads[0].width or 0.45)  # a travel along a wall does no harm
        ends = {tuple(round(v, 3) for v in m.end) for m in old.moved()}
        for m in fresh:
            line = shapely.linestrings(m.points)
            if shapely.covers(near, line):
                continue
            out = shapely.difference(line, near if m.pushed else over_walls)
            far = max(shapely.distance(shapely.points(shapely.get_coordinates(out)), room), default=0.0)
            if m.pushed and far < OUTSIDE + NEAR:
                continue
            if m.extrudes and _no_nearer(out, drawn, solid):
                continue
            if m.extrudes:
                yield f"move outside: {_name(m.line)} leaves the region of the infill by {far:.3f} mm"
            elif m.pushed < 0:
                yield f"wipe outside: {_name(m.line)} leaves the region of the infill by {far:.3f} mm"
            elif (
                m.depth < DEPTH
                and not m.retracted
                and out.length > 0.5
                and tuple(round(v, 3) for v in m.end) not in ends
            ):
                yield f"travel outside: {_name(m.line)} leaves the region unretracted for {out.length:.2f} mm"
        if deviation is not None:
            yield from _deviation(part, beads, new.beads(), deviation)


def _no_nearer(out, drawn, solid) -> bool:
    """Tell if what is outside a region lies where the old path was outside too, and no nearer to other beads."""
    points = shapely.points(shapely.get_coordinates(out))
    before = shapely.points(shapely.get_coordinates(shapely.shortest_line(points, drawn)).reshape(-1, 2, 2)[:, 1])
    moved = shapely.distance(points, before)
    closer = shapely.distance(before, solid) - shapely.distance(points, solid)
    return bool(((moved < BESIDE_OLD) & (closer < OUTSIDE)).all())


def _deviation(part: Section, old: list[Move], new: list[Move], deviation: float) -> Iterator[str]:
    """Tell if new paths are further from the old ones, or old ones from the new, than is stated."""
    if not new:
        yield f"path lost: line {part.lines[0].number}: no infill is left"
        return
    paths = [shapely.union_all([shapely.linestrings(path) for path in lines_of(moves)]) for moves in (old, new)]
    for name, path, other in (("path moved", paths[1], paths[0]), ("path lost", paths[0], paths[1])):
        out = shapely.difference(path, shapely.buffer(other, deviation + 0.005))
        if out.length > 0.02:
            far = shapely.distance(shapely.points(shapely.get_coordinates(out)), other).max()
            x, y = shapely.get_coordinates(out)[0]
            yield f"{name}: by {far:.3f} mm near {x:.2f} {y:.2f}, section of old line {part.lines[0].number}"


def _totals(parts, was: list[Replay], now: list[Replay], habit: Habits, filament: tuple[float, float]) -> Iterator[str]:
    sums = [[0.0, 0.0], [0.0, 0.0]]
    seconds: dict[int, list[float]] = {}
    slowed: set[int] = set()
    first = min((m.layer for ran in was for m in ran.beads()), default=0)
    for part, *both in zip(parts, was, now, strict=True):
        for i, ran in enumerate(both):
            for move in ran.moved():
                if move.extrudes or not part.sparse:  # what is retracted inside comes back outside, or the other way
                    sums[not part.sparse][i] += move.pushed
                seconds.setdefault(move.layer, [0.0, 0.0])[i] += move.seconds()
                infill = part.sparse and move.extrudes and move.layer > first
                if habit.cura and infill and move.speed < 0.999 * habit.fastest:
                    slowed.add(move.layer)
    (old, new), (other, another) = sums
    if abs(other - another) > 1e-3 + PUSHED * math.sqrt(sum(len(ran.moves) for ran in was)):
        yield f"filament outside: {another:.4f} mm, not {other:.4f} mm"
    if old and not filament[0] <= new / old <= filament[1]:
        yield f"filament: the infill takes {new / old:.4f} of the slicer's, not {filament[0]:g} to {filament[1]:g}"
    for layer, (before, after) in seconds.items():
        least = before if layer in slowed else min(before, habit.shortest)
        if after < 0.98 * least:  # s: the slicer counts with its own accelerations
            yield f"cooling: layer {layer} takes {after:.2f} s, {before:.2f} s before, and may not take less than {least:.2f} s"


def _numbers(parts: list[Section]) -> Iterator[str]:
    """Line numbers rise, and checksums are right."""
    last = -1
    for part in parts:
        for line in part.lines:
            if line.n is None:
                continue
            if line.n <= last:
                yield f"line number: {_name(line)} after N{last}"
            last = line.n
            summed = re.match(rb"([^;]*)\*(\d+)\s*$", line.raw.split(b";")[0].rstrip())
            if summed and functools.reduce(lambda x, y: x ^ y, summed[1], 0) != int(summed[2]):
                yield f"checksum: {_name(line)}"


def _progress(old: list[Section], new: list[Section]) -> Iterator[str]:
    """What is done never falls, and what is left never rises, if neither did before."""
    for letter, sign in (("P", 1), ("R", -1)):
        told = [
            [sign * (dict(words(x.command)).get(letter) or 0.0) for p in parts for x in p.lines if x.kind == "progress"]
            for parts in (old, new)
        ]
        rises = [all(a <= b for a, b in zip(values, values[1:], strict=False)) for values in told]
        if rises == [True, False]:
            yield f"progress: M73 {letter} goes back"


def _told(old: list[Section], new: list[Section], was: list[Replay], now: list[Replay], unit: float) -> Iterator[str]:
    """What a comment says of filament, tool by tool, changes as the filament does, if it is told anew."""
    pattern = re.compile(rb"; filament used \[mm\] ?= ?([\d., ]+)")
    told = [[m for p in parts for x in p.lines if (m := pattern.match(x.body))] for parts in (old, new)]
    if len(told[0]) != 1 or len(told[1]) != 1 or told[0][0][1] == told[1][0][1]:
        return
    numbers = [[float(v) for v in m[0][1].split(b",") if v.strip()] for m in told]
    taken: list[Counter[int]] = []
    for runs in (was, now):
        taken.append(Counter())
        for ran in runs:
            for move in ran.beads():
                taken[-1][move.tool] += move.pushed
    tools = sorted(taken[0])
    for i, (a, b) in enumerate(zip(*numbers, strict=True)):
        tool = tools[0] if len(numbers[0]) == 1 else i
        less = (taken[1][tool] - taken[0][tool]) * unit
        if abs(b - a - less) > 0.03:  # mm: it is told to 0.01
            yield f"filament told: tool {tool} takes {less:+.2f} mm, by the comment {b - a:+.2f} mm"
