"""What a print says of its own time and filament, told anew: M73, the slicer's comments."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

_LINE = re.compile(
    rb"^(?:M73 [^\n]*|; (?:total )?filament used \[[a-z0-9]+\] = [^\n]*|; (?:total )?filament cost = [^\n]*"
    rb"|; total filament (?:length|volume|weight) \[[a-z0-9^]+\] : [^\n]*"
    rb"|; estimated (?:first layer )?printing time [^\n]*|; model printing time: [^\n]*|; total estimated time: [^\n]*"
    rb"|;TIME:\d[^\n]*|;TIME_ELAPSED:[^\n]*"
    rb"|;PRINT\.TIME:\d[^\n]*|;Filament used: [^\n]*)$",
    re.MULTILINE,
)
_BEGINS = (b"M73 ", b"; filament", b"; total", b"; estimated", b"; model", b";TIME", b";PRINT.", b";Filament")
_WORD = re.compile(rb"([PRQSCD])(\d+(?:\.\d+)?)")
_SPAN = re.compile(rb"(?:(\d+)d ?)?(?:(\d+)h ?)?(?:(\d+)m ?)?(?:(\d+)s)?")
_TIME = re.compile(rb"\d+[dhms](?: ?\d+[hms])*")
HALF = 0.5  # s: slicers round to whole seconds before they cut minutes off
TINY = 1e-9  # what is left of a sum
_NUMBER = re.compile(rb"\d+(?:\.\d+)?")


@dataclass(frozen=True, kw_only=True)
class Change:
    """What a print takes now, and by how much it changed.

    Parameters
    ----------
    seconds : float
        Of the whole print, as planned; 0 if it could not be planned, and then what is told of time stays.
    first_layer : float
        Seconds up to the end of the first layer.
    ratio, first_ratio : float
        New time per old, as planned, of the print and of its first layer: for times that are not planned, such as those
        of a silent mode.
    silent : float
        Seconds in silent mode; 0 if the print tells none.
    prepared : float
        Seconds that the slicer counts for the print beside its moves.
    filament : float
        New length of filament per old, of all tools.
    tools : tuple of float
        The same of each tool, from 0; further tools keep theirs.
    """

    seconds: float = 0.0
    first_layer: float = 0.0
    ratio: float = 1.0
    first_ratio: float = 1.0
    silent: float = 0.0
    prepared: float = 0.0
    filament: float = 1.0
    tools: tuple[float, ...] = ()

    def told_by(self, lines: Iterable[bytes]) -> Change:
        """Return the change with the times that the old lines of a print tell beside that of its moves."""
        silent = prepared = longest = 0.0
        for line in lines:
            longest = max(longest, _words_of(line, b"S").get(b"S", 0.0) * 60)
            if line.startswith(b"; estimated printing time (silent"):
                silent = said_seconds(line) * self.ratio
            elif line.startswith((b"; model printing time", b"; total estimated time")) and b"total estimated" in line:
                spans = [_seconds(found[0]) for found in _TIME.finditer(line)]
                prepared = max(spans[-1] - spans[0], 0.0) if spans else 0.0
        return replace(self, silent=silent or longest * self.ratio, prepared=prepared)

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


def told_anew(line: bytes, elapsed: float, whole: Change, done: bytes = b"") -> bytes:
    """Return a line that tells time or filament as it holds after the change.

    Parameters
    ----------
    line : bytes
    elapsed : float
        Seconds that the print takes up to this line, as planned.
    whole : Change
        Of the whole print.
    done : bytes
        The letters that tell that all is done, see `finished`.

    >>> told_anew(b"M73 P50 R30", 600.0, Change(seconds=3000.0))
    b'M73 P20 R40'
    >>> told_anew(b"; estimated printing time (normal mode) = 1h 0m 0s", 0.0, Change(seconds=3510.0))
    b'; estimated printing time (normal mode) = 58m 30s'
    """
    if b"ilament" in line[:24]:
        head, equals, tail = line.partition(b"= " if b"= " in line else b": ")
        numbers = _NUMBER.findall(tail)
        factors = [*whole.tools, *([1.0] * len(numbers))] if len(numbers) > 1 else [whole.filament]
        scaled = iter([_scaled(number, factor) for number, factor in zip(numbers, factors, strict=False)])
        return head + equals + _NUMBER.sub(lambda _: next(scaled), tail)
    if not whole.seconds:
        return line
    if line.startswith(b"M73"):
        return _progress(line, elapsed, whole, done)
    if line.startswith(b";TIME_ELAPSED:"):
        return b";TIME_ELAPSED:%.6f" % (whole.seconds if done else elapsed)
    if line.startswith((b";TIME:", b";PRINT.TIME:")):
        head, colon, tail = line.partition(b":")
        return head + colon + _NUMBER.sub(b"%d" % _whole(whole.seconds), tail, count=1)
    head, sign, tail = line.partition(b"= " if b"= " in line else b": ")
    if b"total estimated time" in line:
        times = [whole.seconds, whole.seconds + whole.prepared][b"model" not in line :]
    elif b"silent" in head:
        times = [whole.silent or whole.seconds]
        if b"first layer" in head:
            times = [_seconds(found[0]) * whole.first_ratio for found in _TIME.finditer(tail)]
    else:
        times = [whole.first_layer if b"first layer" in head else whole.seconds]
    spans = iter([*times, *times[-1:] * len(tail)])
    return head + sign + _TIME.sub(lambda _: _span(_whole(next(spans))), tail)


def finished(lines: Sequence[bytes]) -> list[bytes]:
    """Return for each line that tells time which of its letters tell that all is done: the last of each in a print.

    A print whose last M73 does not say so in the first place goes on afterwards, and is left out. Of ;TIME_ELAPSED: the
    letter is T.

    >>> finished([b"M73 P0 R9", b"M73 P99 R0", b"M73 P100 R0", b"M73 Q100 S0"])
    [b'', b'', b'PR', b'QS']
    """
    found = [b""] * len(lines)
    for letters in (b"PR", b"QS"):
        words = [_words_of(line, letters) for line in lines]
        places = [place for place, each in enumerate(words) if each]
        if places and (words[places[-1]].get(letters[:1]) == 100.0 or words[places[-1]].get(letters[1:]) == 0.0):
            found[places[-1]] += letters
    elapsed = [place for place, line in enumerate(lines) if line.startswith(b";TIME_ELAPSED:")]
    for place in elapsed[-1:]:
        found[place] = b"T"
    return found


def _words_of(line: bytes, letters: bytes) -> dict[bytes, float]:
    """Return some of the words of an M73 line."""
    if not line.startswith(b"M73"):
        return {}
    words = _WORD.finditer(line.split(b";", 1)[0])
    return {found[1]: float(found[2]) for found in words if found[1] in letters}


def said_grams(lines: Iterable[bytes]) -> float | None:
    """Return the grams of filament that the lines of a print tell, of all tools; None if they tell none."""
    names = (b"; filament used [g] = ", b"; total filament used [g] = ", b"; total filament weight [g] : ")
    return _said_filament(lines, names)


def said_millimetres(lines: Iterable[bytes]) -> float | None:
    """Return the mm of filament that the lines of a print tell, of all tools; None if they tell none."""
    lines = list(lines)
    found = _said_filament(lines, (b"; filament used [mm] = ", b"; total filament length [mm] : "))
    metres = None if found is not None else _said_filament(lines, (b";Filament used: ",))
    return found if metres is None else metres * 1000


def _said_filament(lines: Iterable[bytes], beginnings: Sequence[bytes]) -> float | None:
    lines = list(lines)
    for begin in beginnings:
        for line in lines:
            if line.startswith(begin):
                return sum(float(number) for number in _NUMBER.findall(line[len(begin) :])) or None
    return None


def said_seconds(line: bytes) -> float:
    """Return the seconds of a whole print that a line tells, 0 if it tells none.

    >>> said_seconds(b"; estimated printing time (normal mode) = 1h 1m 1s"), said_seconds(b"; a remark")
    (3661.0, 0.0)
    """
    if line.startswith((b";TIME:", b";PRINT.TIME:")):
        return float(_first(line))
    if line.startswith((b"; estimated printing time", b"; model printing time")):
        found = _TIME.search(line)
        return _seconds(found[0]) if found else 0.0
    return 0.0


def _first(line: bytes) -> bytes:
    found = _NUMBER.search(line)
    return found[0] if found else b"0"


def _whole(seconds: float) -> int:
    """Return whole seconds, one at least."""
    return max(1, round(seconds))


def _progress(line: bytes, elapsed: float, whole: Change, done: bytes) -> bytes:
    """Return an M73 line: share done (P, Q), minutes left (R, S), minutes to the next stop (C, D)."""
    gone = min(max(elapsed / whole.seconds, 0.0), 1.0)
    total = {b"R": whole.seconds + whole.prepared, b"S": whole.silent or whole.seconds}

    def anew(found: re.Match[bytes]) -> bytes:
        letter, decimals = found[1], len(found[2].partition(b".")[2])
        share = 1.0 if letter in done else gone
        if letter in b"PQ":
            return letter + _cut(100 * share, decimals)
        if letter in b"CD":
            return letter + _cut(float(found[2]) * whole.ratio, decimals)
        return letter + _cut((total[letter] * (1 - share) + HALF) / 60, decimals)

    words, mark, remark = line.partition(b";")
    return _WORD.sub(anew, words) + mark + remark


def _cut(value: float, decimals: int) -> bytes:
    """Write a number with its further decimals cut off, as slicers write shares and minutes."""
    unit = 10.0**decimals
    return b"%.*f" % (decimals, math.floor(value * unit + TINY) / unit)


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
