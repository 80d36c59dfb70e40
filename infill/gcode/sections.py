"""Feature, layer and width of each line of a sliced print, from its tags."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats, Places
from infill.gcode.dialect import MAX_TAG_BYTES, UNTAGGED, object_of, parse_tag, role_of, tool_of
from infill.gcode.limits import is_valid_limit
from infill.gcode.lines import COMMENT
from infill.gcode.machine_state import NAN
from infill.gcode.table import GcodeTable

SPARSE = "sparse infill"
WALL_ROLES = ("perimeter", "external perimeter", "overhang perimeter")
SKIN_ROLES = ("solid infill", "top solid infill", "bottom solid infill", "bridge infill", "internal bridge infill")
# Tags that act as remarks where they change nothing: a stroke continues across them.
REMARK_TAGS = {"purged", "tool change", "tool change end", "wipe end"}


class TagState(NamedTuple):
    """State set by the tags before a line.

    Slicers forget an end, repeat a beginning, or write one where nothing follows. So everything that begins also
    ends with the next tag that cannot stand inside it, a new layer at the latest.

    Parameters
    ----------
    role : str
        The role in print: see `infill.gcode.dialect.ROLES`; "untagged" before the first tag. It holds until the next
        tag of a role, as in slicers' own readers: PrusaSlicer writes it once where all layers are of infill alone.
    layer : int
        Number of layers so far. Tags with nothing printed between them, such as those of a slicer and of its settings
        for each layer, begin the same layer.
    layer_tag : bytes
        The last tag of a layer, as it stands.
    printed : bool
        Something was printed since that tag.
    width, height : float
        mm, NaN while unknown.
    part : int
        Number of tags so far that begin or end an object.
    name : str
        Of the object; "" if unnamed.
    numbered : tuple of (str, str)
        Names of objects by the numbers that commands give them.
    number : str
        The last such number.
    commanded : bool
        The object was named by a command, and not by a comment: it lasts until another command, over all layers.
    wiping : bool
        Up to the tag that ends it. A tag of a role, an object or a layer ends it too: then the next move that
        extrudes was not part of it.
    acceleration : float
        mm/s² of printing moves as last commanded; NaN while unknown.
    tool : str
        In use, as `infill.gcode.dialect.tool_of` names it; "" while unknown.
    purging : bool
        The tool was changed, and the lines that follow purge it if a later tag says that purging is over:
        the first such tag in the same layer.
    purged_on_object : bool
        Something other than a wipe tower was printed since the change of tool.
    changing_tool : bool
        Between the tags around a tool change. A tag of a role, an object or a layer ends it too.
    """

    role: str = UNTAGGED
    layer: int = 0
    layer_tag: bytes = b""
    printed: bool = False
    width: float = NAN
    height: float = NAN
    part: int = 0
    name: str = ""
    numbered: tuple[tuple[str, str], ...] = ()
    number: str = ""
    commanded: bool = False
    wiping: bool = False
    acceleration: float = NAN
    tool: str = ""
    purging: bool = False
    purged_on_object: bool = False
    changing_tool: bool = False


@dataclass(frozen=True, kw_only=True)
class LineMarks:
    """Feature, layer and section of every line of a table.

    Parameters
    ----------
    roles : tuple of str
        The roles that occur.
    role : (N,) uint8
        Place in `roles`.
    purged : (N,) bool
        The line is tagged as sparse infill, but prints the purge of a tool change: its role is "wipe tower".
    section : (N,) int
        Number of the run of lines between two tags of role, layer or object, or of purging, from 0 in this table.
    layer : (N,) int
    layers : int
        Number of layers that begin here.
    width, height, acceleration : (N,) float64
    wiping : (N,) bool
        From the tag that begins a wipe to the one that ends it, or, where that is missing, to the next move that
        extrudes.
    names : dict of int to str
        By section, the name of its object.
    tagged : (N,) bool
        The line is a tag of this kind.
    after : TagState
        State at the end.
    """

    roles: tuple[str, ...]
    role: NDArray[np.uint8]
    purged: NDArray[np.bool_]
    section: Places
    layer: Places
    layers: int
    width: Floats
    height: Floats
    acceleration: Floats
    wiping: NDArray[np.bool_]
    names: dict[int, str]
    tagged: NDArray[np.bool_]
    after: TagState

    def is_role(self, role: str) -> NDArray[np.bool_]:
        """Return (N,) bool, True for lines of `role`."""
        matches = self.role == (self.roles.index(role) if role in self.roles else len(self.roles))
        return np.asarray(matches)


def mark_lines(table: GcodeTable, before: TagState) -> LineMarks:
    """Read the tags of a table, starting from the state before it.

    Purging into the infill bears the role of the infill. It stands between a tool change and the first tag after it
    that says that purging is over, and its role is set to "wipe tower". PrusaSlicer writes that tag once for every
    tool of a layer, also for the one in use when the layer begins: then there is no purge.
    """
    lines = len(table)
    at, history = [0], [before]
    tagged = np.zeros(lines, dtype=bool)
    state, last_line = before, 0
    purges: list[tuple[int, int]] = []
    wipes: list[tuple[int, int]] = []
    changed_tool = wipe = 0  # the line, or the first one if it stands in an earlier table
    printed = np.concatenate([[0], np.cumsum(is_printing(table))])
    commands = {command.line: command for command in table.commands}

    def first_printed(line: int) -> int:
        """Return the first printing line, counted from `line`; the end if there is none."""
        return int(np.searchsorted(printed, printed[line], side="right")) - 1

    read = np.array(sorted([*np.flatnonzero(table.kind == COMMENT).tolist(), *commands]), dtype=np.intp)
    # Plain lists: single entries of an array cost several times as much.
    since = np.diff(printed[read], prepend=0).tolist()
    begin_bytes, end_bytes = table.start[read].tolist(), table.start[read + 1].tolist()
    for line, printed_since, begin_byte, end_byte in zip(read.tolist(), since, begin_bytes, end_bytes, strict=True):
        if printed_since:
            state = _after_printing(state)
        last_line, previous_tags = line, state
        command = commands.get(line)
        if command is not None:
            tool = tool_of(command.code, command.words, table.text(line, line + 1))
            if tool and (tool != state.tool or state.changing_tool or state.role == "wipe tower"):
                changed_tool = changed_tool if state.purging else line
                state = state._replace(tool=tool, purging=True)
            elif (marker := object_of(command.code, table.text(line, line + 1))) is not None:
                state = _apply_object_command(state, *marker)
            elif command.code == "M204":
                value = command.words.get("P") or command.words.get("S") or 0.0
                state = state._replace(acceleration=value) if is_valid_limit(value, "acceleration") else state
        else:
            tag = parse_tag(table.data[begin_byte : min(end_byte, begin_byte + MAX_TAG_BYTES)].lstrip())
            if tag is None:
                continue
            if tag[0] == "purged" and state.purging:
                purges.append((changed_tool, line))
            state = _apply_tag(state, *tag)
            if previous_tags.wiping and (tag[0] in ("wipe start", "wipe end") or not state.wiping):
                wipes.append((wipe, line if tag[0] == "wipe end" else min(line, first_printed(wipe))))
            wipe = line if tag[0] == "wipe start" else wipe
            tagged[line] = tag[0] not in REMARK_TAGS or state != previous_tags
        if state is not previous_tags and state != previous_tags:
            at.append(line)
            history.append(state)
    if printed[lines] > printed[last_line]:
        state = _after_printing(state)
    if state.wiping:
        wipes.append((wipe, first_printed(wipe)))
        state = state._replace(wiping=first_printed(wipe) == lines)
    fields = dict(zip(TagState._fields, zip(*history, strict=True), strict=True))  # all values of each field
    place = {role: number for number, role in enumerate(dict.fromkeys([*fields["role"], "wipe tower"]))}
    roles = tuple(place)
    count = np.diff([*at, lines])

    def repeat_values(values: Sequence[Any], kind: Any) -> NDArray[Any]:  # noqa: ANN401 - a NumPy type
        """Repeat each value for the lines that it holds for."""
        return np.repeat(np.array(values, dtype=kind), count)

    role = repeat_values([place[name] for name in fields["role"]], np.uint8)
    purged = repeat_values(fields["changing_tool"], np.bool_)
    keys = list(zip(fields["role"], fields["layer"], fields["part"], strict=True))
    begins = np.zeros(lines + 1, dtype=bool)
    begins[
        [line for line, key, previous_key in zip(at[1:], keys[1:], keys[:-1], strict=True) if key != previous_key]
    ] = True
    for first_line, end in purges:
        purged[first_line:end] = begins[first_line] = begins[end] = True
    begins[0] = False
    wiping = np.zeros(lines, dtype=bool)
    for first_line, end in wipes:
        wiping[first_line:end] = True
    section = np.cumsum(begins[:lines])
    purged &= role == (roles.index(SPARSE) if SPARSE in roles else len(roles))
    role[purged] = roles.index("wipe tower")
    names = {int(section[line]): tags.name for line, tags in zip(at, history, strict=True) if line < lines}
    return LineMarks(
        roles=roles,
        role=role,
        purged=purged,
        section=section,
        layer=repeat_values(fields["layer"], np.intp),
        layers=state.layer - before.layer,
        width=repeat_values(fields["width"], np.float64),
        height=repeat_values(fields["height"], np.float64),
        acceleration=repeat_values(fields["acceleration"], np.float64),
        wiping=wiping,
        names=_fill_names(names, section),
        tagged=tagged,
        after=state,
    )


def is_printing(table: GcodeTable) -> NDArray[np.bool_]:
    """Return (N,) bool, True for lines that extrude along a path."""
    prints: NDArray[np.bool_] = (table.extruded > 0) & (table.given[:, 0] | table.given[:, 1])
    return prints


def _fill_names(names: dict[int, str], section: Places) -> dict[int, str]:
    """Return the names of all sections; a section that begins without a tag takes the name of the previous one."""
    name = ""
    filled = {}
    for number in np.unique(section).tolist():
        name = names.get(number, name)
        filled[number] = name
    return filled


def _after_printing(tags: TagState) -> TagState:
    """Return the state after something was printed."""
    on_object = tags.purging and tags.role != "wipe tower" and not tags.changing_tool
    if tags.printed and (tags.purged_on_object or not on_object):
        return tags  # the most frequent case
    return tags._replace(printed=True, purged_on_object=tags.purged_on_object or on_object)


def _apply_tag(tags: TagState, meaning: str, value: bytes) -> TagState:
    """Return the state of comments after one that sets role, layer, object, width, height or wiping."""
    match meaning:
        case "role":
            role = role_of(value)
            if role == tags.role and not tags.wiping and not tags.changing_tool:
                return tags
            return tags._replace(role=role, wiping=False, changing_tool=False)
        case "layer":
            return _begin_layer(tags, value)
        case "object" | "object end":
            name = value.decode("utf-8", "replace") if meaning == "object" and value != b"NONMESH" else ""
            return tags._replace(part=tags.part + 1, name=name, commanded=False, wiping=False, changing_tool=False)
        case "width":
            width = _parse_length(value, tags.width)
            return tags if width == tags.width else tags._replace(width=width)
        case "height":
            height = _parse_length(value, tags.height)
            return tags if height == tags.height else tags._replace(height=height)
        case "wipe start" | "wipe end":
            return tags._replace(wiping=meaning == "wipe start")
        case "tool change" | "tool change end":
            return tags._replace(changing_tool=meaning == "tool change")
        case "purged":
            return tags._replace(purging=False, purged_on_object=False)
        case _:
            return tags


def _apply_object_command(tags: TagState, meaning: str, value: str) -> TagState:
    """Return the state after a command that begins, names or ends an object; comments that name objects go first."""
    if meaning == "name":
        if (tags.number, value) not in tags.numbered:
            tags = tags._replace(numbered=(*tags.numbered, (tags.number, value)))
        return tags._replace(name=value) if tags.commanded else tags
    if tags.name and not tags.commanded:
        return tags._replace(number=value) if meaning == "number" else tags
    if meaning == "end":
        return tags._replace(part=tags.part + 1, name="", commanded=False) if tags.commanded else tags
    name = value
    if meaning == "number":
        name = dict(tags.numbered).get(value, f"object {value}")
        tags = tags._replace(number=value)
    if tags.commanded and name == tags.name:
        return tags
    return tags._replace(part=tags.part + 1, name=name, commanded=True, wiping=False, changing_tool=False)


def _begin_layer(tags: TagState, value: bytes) -> TagState:
    """Return the state at a tag of a layer.

    A tool change before it whose purging has not ended purged nothing, unless nothing was printed since: then it
    belongs to the new layer. A change before the first layer selects the initial tool.
    """
    if tags.layer and not tags.printed and not _differ_in_number(tags.layer_tag, value):
        return tags._replace(layer_tag=value)
    purging = tags.purging and not tags.purged_on_object and tags.layer > 0
    return tags._replace(
        layer=tags.layer + 1,
        layer_tag=value,
        printed=False,
        part=tags.part + bool(tags.name),
        name=tags.name if tags.commanded else "",
        wiping=False,
        purging=purging,
        purged_on_object=False,
        changing_tool=False,
    )


def _differ_in_number(before: bytes, value: bytes) -> bool:
    """Return True if two tags of layers have different numbers: the layer between them is empty."""
    return bool(before) and bool(value) and before != value


def _parse_length(value: bytes, otherwise: float) -> float:
    """Return a length in mm, or a default if the text is no number between 0 and 100."""
    try:
        length = float(value)
    except ValueError:
        return otherwise
    return length if 0 < length < 100 else otherwise
