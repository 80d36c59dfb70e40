"""What each line of a sliced print belongs to: its feature, layer, width, and the strokes of its sparse infill."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from infill.gcode.dialect import UNTAGGED, role_of, tag_of
from infill.gcode.lines import BLANK, COMMENT, MOVE
from infill.gcode.table import NAN, Table

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

SPARSE = "sparse infill"
SKINS = ("solid infill", "top solid infill", "bottom solid infill", "bridge infill", "internal bridge infill")
ALIKE = 0.02  # two moves extrude alike if their filament per mm differs by less than this share
FILAMENT_UNIT = 1e-5  # mm: the last decimal of an E word
# Said to the display or the host alone, so that moves before and after it are still one line of plastic.
TALK = {"M73", "M117", "M118", "M70"}


@dataclass(frozen=True, kw_only=True)
class Tags:
    """What the tags before a line have said.

    Parameters
    ----------
    role : str
        What is printed: see `infill.gcode.dialect.ROLES`; "untagged" at the beginning of a layer.
    layer : int
        Number of layer tags so far.
    width, height : float
        mm, NaN while unknown.
    part : int
        Number of tags so far that begin or end an object.
    name : str
        Of the object; "" if none is said.
    wiping : bool
    acceleration : float
        mm/s² of printing moves as last commanded; NaN while unknown.
    """

    role: str = UNTAGGED
    layer: int = 0
    width: float = NAN
    height: float = NAN
    part: int = 0
    name: str = ""
    wiping: bool = False
    acceleration: float = NAN


@dataclass(frozen=True, kw_only=True)
class Marks:
    """What every line of a table belongs to.

    Parameters
    ----------
    roles : tuple of str
        The roles that occur.
    role : (N,) uint8
        Place in `roles`.
    section : (N,) int
        Number of the run of lines between two tags of role, layer or object, from 0 in this table.
    layer : (N,) int
    width, height, acceleration : (N,) float64
    wiping : (N,) bool
    names : dict of int to str
        By section, the name of its object.
    tagged : (N,) bool
        The line is such a tag.
    after : Tags
        What holds at the end.
    """

    roles: tuple[str, ...]
    role: NDArray[np.uint8]
    section: Places
    layer: Places
    width: Floats
    height: Floats
    acceleration: Floats
    wiping: NDArray[np.bool_]
    names: dict[int, str]
    tagged: NDArray[np.bool_]
    after: Tags

    def is_role(self, role: str) -> NDArray[np.bool_]:
        """Return whether each line belongs to `role`."""
        found = self.role == (self.roles.index(role) if role in self.roles else len(self.roles))
        return np.asarray(found)


def marked(table: Table, before: Tags) -> Marks:
    """Read the tags of a table, beginning with what held before it.

    Purging into the infill bears the role of the infill, up to the comment that says it is over: it is set to
    "wipe tower".
    """
    lines = len(table)
    at, said = [0], [before]
    tagged = np.zeros(lines, dtype=bool)
    now = before
    events: list[tuple[int, Tags]] = []
    purges: list[tuple[int, int]] = []
    commands = {command.line: command for command in table.commands}
    tool_changed = 0
    for line in sorted([*np.flatnonzero(table.kind == COMMENT).tolist(), *commands]):
        command = commands.get(line)
        if command is not None:
            if command.code[:1] == "T":
                tool_changed = line
            elif command.code == "M204":
                value = command.words.get("P") or command.words.get("S")
                if value and value > 0:
                    now = replace(now, acceleration=value)
                    events.append((line, now))
            continue
        text = table.text(line, line + 1)[:200].lstrip()
        if text.startswith(b"; PURGING FINISHED"):
            purges.append((tool_changed, line))
            continue
        tag = tag_of(text)
        if tag is None:
            continue
        tagged[line] = True
        now = _said(now, *tag)
        events.append((line, now))
    for line, tags in events:
        at.append(line)
        said.append(tags)
    roles = tuple(dict.fromkeys([tags.role for tags in said] + ["wipe tower"]))
    count = np.diff([*at, lines])
    role = np.repeat(np.array([roles.index(tags.role) for tags in said], dtype=np.uint8), count)
    for first, last in purges:
        role[first:last] = roles.index("wipe tower")
    keys = [(tags.role, tags.layer, tags.part) for tags in said]
    new = np.cumsum([False] + [one != other for one, other in zip(keys[1:], keys[:-1], strict=True)])

    def spread(values: list[float]) -> Floats:
        return np.repeat(np.array(values, dtype=np.float64), count)

    return Marks(
        roles=roles,
        role=role,
        section=np.repeat(new, count),
        layer=np.repeat(np.array([tags.layer for tags in said]), count),
        width=spread([tags.width for tags in said]),
        height=spread([tags.height for tags in said]),
        acceleration=spread([tags.acceleration for tags in said]),
        wiping=np.repeat(np.array([tags.wiping for tags in said]), count),
        names={int(number): tags.name for number, tags in zip(new, said, strict=True)},
        tagged=tagged,
        after=now,
    )


def _said(tags: Tags, meaning: str, value: bytes) -> Tags:
    match meaning:
        case "role":
            return replace(tags, role=role_of(value))
        case "layer":
            return replace(tags, role=UNTAGGED, layer=tags.layer + 1)
        case "object" | "object end":
            name = value.decode("utf-8", "replace") if meaning == "object" else ""
            return replace(tags, part=tags.part + 1, name=name)
        case "width":
            return replace(tags, width=_length(value, tags.width))
        case "height":
            return replace(tags, height=_length(value, tags.height))
        case "wipe start" | "wipe end":
            return replace(tags, wiping=meaning == "wipe start")
        case _:
            return tags


def _length(value: bytes, otherwise: float) -> float:
    try:
        length = float(value)
    except ValueError:
        return otherwise
    return length if 0 < length < 100 else otherwise


@dataclass(frozen=True, kw_only=True)
class Strokes:
    """The sparse infill of a table: runs of moves that extrude alike without a travel between them.

    Parameters
    ----------
    points : (N, 2) float64, mm
        The strokes one after another, each with the point it begins at.
    first : (M + 1,) int
        Stroke k has the points `first[k]` to `first[k + 1]`.
    line : (N,) int
        The line that ends at each point; for the first point of a stroke, the line before its first move.
    filament : (M,) float64, mm
        That the stroke extrudes.
    length : (M,) float64, mm
    """

    points: Floats
    first: Places
    line: Places
    filament: Floats
    length: Floats

    def __len__(self) -> int:
        return len(self.first) - 1

    @property
    def opens(self) -> Places:
        """The line of the first move of every stroke."""
        return self.line[self.first[:-1] + 1]

    @property
    def closes(self) -> Places:
        """The line of its last move."""
        return self.line[self.first[1:] - 1]

    @property
    def moves(self) -> Places:
        """The lines of all their moves."""
        return np.delete(self.line, self.first[:-1])


def strokes(table: Table, marks: Marks, role: str = SPARSE) -> Strokes:
    """Return the strokes of `role`.

    A stroke ends where the feed rate or the filament per mm changes, and at every line other than a comment or talk
    to the display. Lines with something odd (line numbers, relative moves, inches, a change of z) are in no stroke.
    """
    x0, y0, z0 = (_shifted(getattr(table, name), getattr(table.before, name)) for name in "xyz")
    length = np.hypot(table.x - x0, table.y - y0)
    with np.errstate(invalid="ignore"):
        drawn = (table.kind == MOVE) & (table.extruded > 0) & (length > 0) & np.isfinite(length)
    drawn &= (table.z == z0) | ~table.given[:, 2]
    drawn &= marks.is_role(role) & ~marks.wiping & ~table.numbered & ~table.unsure & ~_strange(table)
    passive = ((table.kind == COMMENT) & ~marks.tagged) | (table.kind == BLANK)
    for command in table.commands:
        passive[command.line] |= command.code in TALK
    feed = _shifted(table.f, table.before.f)
    with np.errstate(invalid="ignore"):
        passive |= (table.kind == MOVE) & ~table.moves & (table.f == feed)
    here = np.flatnonzero(drawn)
    broken = np.cumsum(~(drawn | passive))
    rate = table.extruded[here] / length[here]
    unsure = FILAMENT_UNIT / length[here]
    one, other = here[:-1], here[1:]
    joined = (broken[one] == broken[other]) & (table.f[one] == table.f[other])
    joined &= np.abs(np.diff(rate)) <= ALIKE * rate[:-1] + unsure[:-1] + unsure[1:]
    begins = np.flatnonzero(np.concatenate([[True], ~joined])[: len(here)])
    number = np.diff(np.append(begins, len(here)))
    # One point more for every stroke: where it begins.
    order = np.insert(here, begins, -1) if len(here) else here
    at_start = order < 0
    line = order.copy()
    line[at_start] = here[begins] - 1
    points = np.empty((len(order), 2))
    points[~at_start] = np.stack([table.x[here], table.y[here]], axis=1)
    points[at_start] = np.stack([x0[here[begins]], y0[here[begins]]], axis=1)
    first = np.concatenate([[0], np.cumsum(number + 1)])
    sums = (np.add.reduceat(v[here], begins) if len(here) else np.empty(0) for v in (table.extruded, length))
    filament, total = sums
    return Strokes(points=points, first=first, line=line, filament=filament, length=total)


def _shifted(values: Floats, before: float) -> Floats:
    """Return what held before each line."""
    return np.concatenate([[before], values[:-1]])[: len(values)]


def _strange(table: Table) -> NDArray[np.bool_]:
    """Return whether moves are meant in another way on a line: relative or in inches."""
    strange = np.zeros(len(table), dtype=bool)
    relative, inches = table.before.relative, table.before.inches
    since = 0
    for command in table.commands:
        if command.code in ("G90", "G91", "G20", "G21"):
            strange[since : command.line] = relative or inches
            since = command.line
            relative = command.code == "G91" if command.code in ("G90", "G91") else relative
            inches = command.code == "G20" if command.code in ("G20", "G21") else inches
    strange[since:] = relative or inches
    return strange
