"""What a print says of its own time and filament, told anew: M73, the slicer's comments."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

_LINE = re.compile(
    rb"^(?:M73 [^\n]*|; (?:total )?filament used \[[a-z0-9]+\] = [^\n]*|; (?:total )?filament cost = [^\n]*"
    rb"|; total filament (?:length|volume|weight) \[[a-z0-9^]+\] : [^\n]*"
    rb"|; estimated printing time [^\n]*|; model printing time: [^\n]*|;TIME:\d[^\n]*|;TIME_ELAPSED:[^\n]*"
    rb"|;PRINT\.TIME:\d[^\n]*|;Filament used: [^\n]*)$",
    re.MULTILINE,
)
_BEGINS = (b"M73 ", b"; filament", b"; total filament", b"; estimated", b"; model", b";TIME", b";PRINT.", b";Filament")
_WORD = re.compile(rb"([PRQSCD])(\d+(?:\.\d+)?)")
_SPAN = re.compile(rb"(?:(\d+)d ?)?(?:(\d+)h ?)?(?:(\d+)m ?)?(?:(\d+)s)?")
_TIME = re.compile(rb"\d+[dhms](?: ?\d+[hms])*")
_NUMBER = re.compile(rb"\d+(?:\.\d+)?")


@dataclass(frozen=True, kw_only=True)
class Change:
    """By how much a print changed, as a whole or up to a line.

    Parameters
    ----------
    seconds : float
        Saved.
    filament : float
        New length of filament per old, of all tools.
    tools : tuple of float
        The same of each tool, from 0; further tools keep theirs.
    """

    seconds: float = 0.0
    filament: float = 1.0
    tools: tuple[float, ...] = ()

    def as_told(self, lines: Iterable[bytes], change: Mapping[int, float], area: float = 1.0) -> Change:
        """Return the change with ratios of the filament that the print says it takes, if it says so by tool.

        Parameters
        ----------
        lines : iterable of bytes
            That tell time or filament.
        change : mapping of int to float
            Filament more, by tool, in what the print counts: mm, or mm³ for volumetric E.
        area : float
            Section of the filament, mm², for volumetric E; else 1.
        """
        for line in lines:
            if line.startswith(b"; filament used [mm] = "):
                said = [float(number) for number in _NUMBER.findall(line.partition(b" = ")[2])]
                now = [length + change.get(tool, 0.0) / area for tool, length in enumerate(said)]
                if all(length > 0 for length in now if length) and sum(said) > 0:
                    ratios = tuple(new / old if old > 0 else 1.0 for new, old in zip(now, said, strict=True))
                    return replace(self, filament=sum(now) / sum(said), tools=ratios)
        return self


def estimates(text: bytes) -> Iterator[tuple[int, int]]:
    """Yield where the lines begin and end that tell time or filament; without their line ends."""
    for place in _line_begins(text):
        found = _LINE.match(text, place) if text.startswith(_BEGINS, place) else None
        if found is not None:
            yield found.start(), found.end() - (text[found.end() - 1 : found.end()] == b"\r")


def _line_begins(text: bytes) -> Iterator[int]:
    """Yield where lines begin with a semicolon or an M: few of those in a print."""
    import numpy as np  # later: a command that finds no file needs none

    data = np.frombuffer(text, dtype=np.uint8)
    begins = np.concatenate([[0], np.flatnonzero(data == ord("\n")) + 1])
    begins = begins[begins < len(data)]
    head = data[begins]
    yield from begins[(head == ord(";")) | (head == ord("M"))].tolist()


def told_anew(line: bytes, so_far: float, whole: Change, total: float) -> bytes:
    """Return a line that tells time or filament as it holds after the change.

    Parameters
    ----------
    line : bytes
    so_far : float
        Seconds saved before this line.
    whole : Change
        Of the whole print.
    total : float
        Seconds that the print was said to take; 0 if it is not known.

    >>> told_anew(b"M73 P50 R30", 300.0, Change(seconds=600.0), 3600.0)
    b'M73 P50 R25'
    >>> told_anew(b"; estimated printing time (normal mode) = 1h 0m 0s", 0.0, Change(seconds=90.0), 3600.0)
    b'; estimated printing time (normal mode) = 58m 30s'
    """
    if line.startswith(b"M73"):
        return _progress(line, so_far, whole.seconds, total)
    if b"ilament" in line[:24]:
        head, equals, tail = line.partition(b"= " if b"= " in line else b": ")
        numbers = _NUMBER.findall(tail)
        factors = [*whole.tools, *([1.0] * len(numbers))] if len(numbers) > 1 else [whole.filament]
        scaled = iter([_scaled(number, factor) for number, factor in zip(numbers, factors, strict=False)])
        return head + equals + _NUMBER.sub(lambda _: next(scaled), tail)
    if line.startswith(b";TIME_ELAPSED:"):
        return b";TIME_ELAPSED:%.6f" % max(0.0, float(_first(line)) - so_far)
    if line.startswith((b";TIME:", b";PRINT.TIME:")):
        head, colon, tail = line.partition(b":")
        return head + colon + _NUMBER.sub(lambda found: b"%d" % _less(float(found[0]), whole.seconds), tail, count=1)
    head, sign, tail = line.partition(b"= " if b"= " in line else b": ")
    return head + sign + _TIME.sub(lambda found: _span(_less(_seconds(found[0]), whole.seconds)), tail)


def said_seconds(line: bytes) -> float:
    """Return the seconds of a whole print that a line tells, 0 if it tells none."""
    if line.startswith((b";TIME:", b";PRINT.TIME:")):
        return float(_first(line))
    if line.startswith((b"; estimated printing time", b"; model printing time")):
        found = _TIME.search(line)
        return _seconds(found[0]) if found else 0.0
    return 0.0


def _first(line: bytes) -> bytes:
    found = _NUMBER.search(line)
    return found[0] if found else b"0"


def _less(seconds: float, saved: float) -> int:
    """Return what is left, a second at least."""
    return max(1, round(seconds - saved))


def _progress(line: bytes, so_far: float, saved: float, total: float) -> bytes:
    """Return an M73 line: share done (P, Q) and minutes left (R, S)."""

    def anew(found: re.Match[bytes]) -> bytes:
        value = float(found[2])
        decimals = len(found[2].partition(b".")[2])
        if found[1] in b"RS":
            return found[1] + b"%.*f" % (decimals, max(0.0, value - (saved - so_far) / 60))
        if found[1] in b"PQ" and total > saved:
            share = (value * total - 100 * so_far) / (total - saved)
            return found[1] + b"%.*f" % (decimals, min(100.0, max(0.0, share)))
        return found[0]

    words, mark, remark = line.partition(b";")
    return _WORD.sub(anew, words) + mark + remark


def _scaled(number: bytes, factor: float) -> bytes:
    decimals = len(number.partition(b".")[2])
    return b"%.*f" % (decimals, float(number) * factor)


def _seconds(text: bytes) -> float:
    found = _SPAN.match(text)
    days, hours, minutes, seconds = (int(part or 0) for part in (found.groups() if found else (0, 0, 0, 0)))
    return ((days * 24 + hours) * 60 + minutes) * 60.0 + seconds


def _span(seconds: int) -> bytes:
    """Return a time as slicers write it."""
    minutes, seconds = divmod(seconds, 60)
    hours, minutes = divmod(minutes, 60)
    days, hours = divmod(hours, 24)
    parts = [(days, b"d"), (hours, b"h"), (minutes, b"m"), (seconds, b"s")]
    while len(parts) > 1 and not parts[0][0]:
        parts.pop(0)
    return b" ".join(b"%d%s" % part for part in parts)
