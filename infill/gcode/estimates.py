"""Times and filament that a print states about itself, updated: M73 and the slicer's comments."""

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
HALF_SECOND = 0.5  # s: slicers round to whole seconds before they cut minutes off
ROUND_OFF = 1e-9  # rounding error of a sum
_NUMBER = re.compile(rb"\d+(?:\.\d+)?")


@dataclass(frozen=True, kw_only=True)
class EstimateChange:
    """Time and filament that a print takes now, and their ratio to the old ones.

    Parameters
    ----------
    seconds : float
        Of the entire print, as planned; 0 if it could not be planned, and then stated times stay unchanged.
    first_layer : float
        Seconds up to the end of the first layer.
    ratio, first_ratio : float
        New time per old, as planned, of the print and of its first layer: for times that are not planned, such as those
        of a silent mode.
    silent : float
        Seconds in silent mode; 0 if the print states none.
    prepared : float
        Seconds that the slicer adds to the print besides its moves.
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

    def with_stated_times(self, lines: Iterable[bytes]) -> EstimateChange:
        """Return the change with the silent and preparation times that the old lines of a print state."""
        silent = prepared = longest = 0.0
        for line in lines:
            longest = max(longest, _words_of(line, b"S").get(b"S", 0.0) * 60)
            if line.startswith(b"; estimated printing time (silent"):
                silent = stated_seconds(line) * self.ratio
            elif line.startswith((b"; model printing time", b"; total estimated time")) and b"total estimated" in line:
                spans = [_parse_duration(match[0]) for match in _TIME.finditer(line)]
                prepared = max(spans[-1] - spans[0], 0.0) if spans else 0.0
        return replace(self, silent=silent or longest * self.ratio, prepared=prepared)

    def with_stated_filament(self, lines: Iterable[bytes], change: Mapping[int, float]) -> EstimateChange:
        """Return the change with ratios from the filament that the print states by tool, if it does.

        Parameters
        ----------
        lines : iterable of bytes
            Lines that state time or filament.
        change : mapping of int to float
            Additional filament by tool, mm.
        """
        for line in lines:
            if line.startswith(b"; filament used [mm] = "):
                stated = [float(number) for number in _NUMBER.findall(line.partition(b" = ")[2])]
                updated = [length + change.get(tool, 0.0) for tool, length in enumerate(stated)]
                if all(length > 0 for length in updated if length) and sum(stated) > 0:
                    ratios = tuple(new / old if old > 0 else 1.0 for new, old in zip(updated, stated, strict=True))
                    return replace(self, filament=sum(updated) / sum(stated), tools=ratios)
        return self


@dataclass(frozen=True, kw_only=True)
class StatedAmounts:
    """Filament that a print states, of all tools: mm and grams, None where it states none."""

    millimetres: float | None
    grams: float | None


@dataclass(frozen=True, kw_only=True)
class Restatement:
    """Statements of time and filament of a print, updated.

    Parameters
    ----------
    lines : list of bytes
        Of the text.
    metadata : dict
        New values outside the text, by name.
    before, after : StatedAmounts
    seconds : float
        That the print stated before; 0 if it stated none.
    """

    lines: list[bytes]
    metadata: dict[str, str]
    before: StatedAmounts
    after: StatedAmounts
    seconds: float


def restate(
    lines: Sequence[bytes],
    metadata: Iterable[tuple[bytes, bytes]],
    change: EstimateChange,
    increase: Mapping[int, float],
    elapsed: Sequence[float] | None,
) -> Restatement:
    """Update all that a print states of time and filament.

    Parameters
    ----------
    lines : sequence of bytes
        Those of the text that `find_estimates` finds.
    metadata : iterable of (name, value)
        Of the print, outside the text.
    change : EstimateChange
        As planned; its silent and preparation times, and its ratios, may follow from the statements.
    increase : mapping of int to float
        Additional filament by tool, mm.
    elapsed : sequence of float, optional
        Seconds that the print takes up to each line; None if nothing changes.
    """
    outside = {name: b"; %s = %s" % (name, value) for name, value in metadata}
    old = [*lines, *outside.values()]
    change = change.with_stated_times(old).with_stated_filament(lines, increase)
    new_lines, new_outside = list(lines), {}
    if elapsed is not None:
        progress = zip(lines, elapsed, completion_letters(lines), strict=True)
        new_lines = [update_estimate(line, seconds, change, is_finished) for line, seconds, is_finished in progress]
        stating = {name: line for name, line in outside.items() if any(find_estimates(line))}
        new_outside = {name: update_estimate(line, 0.0, change) for name, line in stating.items()}
    return Restatement(
        lines=new_lines,
        metadata={
            name.decode("utf-8", "surrogateescape"): line.partition(b" = ")[2].decode("utf-8", "surrogateescape")
            for name, line in new_outside.items()
        },
        before=_stated_amounts(old),
        after=_stated_amounts([*new_lines, *(outside | new_outside).values()]),
        seconds=max((stated_seconds(line) for line in old if b"silent" not in line), default=0.0),
    )


def restate_times(
    lines: Sequence[bytes],
    metadata: Iterable[tuple[bytes, bytes]],
    seconds: float,
    first_layer: float,
    elapsed: Sequence[float],
) -> Restatement:
    """Update all that a print states of its time, and nothing of its filament.

    Times that are not planned, such as those of a silent mode, change in the proportion of the stated to the new time.

    Parameters
    ----------
    lines : sequence of bytes
        Those of the text that state time, see `states_time`.
    metadata : iterable of (name, value)
        Of the print, outside the text.
    seconds, first_layer : float
        As planned, of the entire print and up to the end of its first layer.
    elapsed : sequence of float
        Seconds that the print takes up to each line.
    """
    times = [(name, value) for name, value in metadata if states_time(b"; %s = %s" % (name, value))]
    old = [*lines, *(b"; %s = %s" % pair for pair in times)]
    stated = max((stated_seconds(line) for line in old if b"silent" not in line), default=0.0)
    stated_first = max((_stated_first_layer(line) for line in old if b"silent" not in line), default=0.0)
    ratio = seconds / stated if stated else 1.0
    change = EstimateChange(
        seconds=seconds,
        first_layer=first_layer,
        ratio=ratio,
        first_ratio=first_layer / stated_first if stated_first else ratio,
    )
    return restate(lines, times, change, {}, elapsed)


def states_time(line: bytes) -> bool:
    """Tell whether a line states a time of the print, or its progress.

    >>> states_time(b"M73 P0 R9"), states_time(b"; filament cost = 1.20"), states_time(b"; a remark")
    (True, False, False)
    """
    return b"ilament" not in line[:24] and any(find_estimates(line))


def _stated_first_layer(line: bytes) -> float:
    """Return the seconds that a line states for the first layer, 0 if it states none."""
    match = _TIME.search(line) if line.startswith(b"; estimated first layer printing time") else None
    return _parse_duration(match[0]) if match else 0.0


def find_estimates(text: bytes) -> Iterator[tuple[int, int]]:
    """Find the lines that state time or filament; yield their begin and end, without line ends."""
    for place in _line_begins(text):
        match = _LINE.match(text, place) if text.startswith(_BEGINS, place) else None
        if match is not None:
            yield match.start(), match.end() - (text[match.end() - 1 : match.end()] == b"\r")


def _line_begins(text: bytes) -> Iterator[int]:
    """Find the lines that begin with a semicolon or an M, a small part of a print; yield their begins."""
    import numpy as np  # later: commands without a file need no NumPy

    data = np.frombuffer(text, dtype=np.uint8)
    begins = np.concatenate([[0], np.flatnonzero(data == ord("\n")) + 1])
    begins = begins[begins < len(data)]
    head = data[begins]
    yield from begins[(head == ord(";")) | (head == ord("M"))].tolist()


def update_estimate(line: bytes, elapsed: float, change: EstimateChange, completed: bytes = b"") -> bytes:
    """Return a line that states time or filament, updated for the change.

    Parameters
    ----------
    line : bytes
    elapsed : float
        Seconds that the print takes up to this line, as planned.
    change : EstimateChange
        Of the entire print.
    completed : bytes
        The letters that state completion, see `completion_letters`.

    >>> update_estimate(b"M73 P50 R30", 600.0, EstimateChange(seconds=3000.0))
    b'M73 P20 R40'
    >>> update_estimate(b"; estimated printing time (normal mode) = 1h 0m 0s", 0.0, EstimateChange(seconds=3510.0))
    b'; estimated printing time (normal mode) = 58m 30s'
    """
    if b"ilament" in line[:24]:
        head, equals, tail = line.partition(b"= " if b"= " in line else b": ")
        numbers = _NUMBER.findall(tail)
        factors = [*change.tools, *([1.0] * len(numbers))] if len(numbers) > 1 else [change.filament]
        scaled = iter([_scale_number(number, factor) for number, factor in zip(numbers, factors, strict=False)])
        return head + equals + _NUMBER.sub(lambda _: next(scaled), tail)
    if not change.seconds:
        return line
    if line.startswith(b"M73"):
        return _format_progress(line, elapsed, change, completed)
    if line.startswith(b";TIME_ELAPSED:"):
        return b";TIME_ELAPSED:%.6f" % (change.seconds if completed else elapsed)
    if line.startswith((b";TIME:", b";PRINT.TIME:")):
        head, colon, tail = line.partition(b":")
        return head + colon + _NUMBER.sub(b"%d" % _round_seconds(change.seconds), tail, count=1)
    head, sign, tail = line.partition(b"= " if b"= " in line else b": ")
    if b"total estimated time" in line:
        times = [change.seconds, change.seconds + change.prepared][b"model" not in line :]
    elif b"silent" in head:
        times = [change.silent or change.seconds]
        if b"first layer" in head:
            times = [_parse_duration(match[0]) * change.first_ratio for match in _TIME.finditer(tail)]
    else:
        times = [change.first_layer if b"first layer" in head else change.seconds]
    spans = iter([*times, *times[-1:] * len(tail)])
    return head + sign + _TIME.sub(lambda _: _format_duration(_round_seconds(next(spans))), tail)


def completion_letters(lines: Sequence[bytes]) -> list[bytes]:
    """Find for each line the letters that state completion: the last of each letter in a print.

    Leave out a print whose last M73 does not state completion: it continues afterwards. The letter of ;TIME_ELAPSED:
    is T.

    >>> completion_letters([b"M73 P0 R9", b"M73 P99 R0", b"M73 P100 R0", b"M73 Q100 S0"])
    [b'', b'', b'PR', b'QS']
    """
    letters_by_line = [b""] * len(lines)
    for letters in (b"PR", b"QS"):
        words = [_words_of(line, letters) for line in lines]
        places = [place for place, word in enumerate(words) if word]
        last = words[places[-1]] if places else {}
        if last.get(letters[:1], 100.0 if last.get(letters[1:]) == 0.0 else 0.0) == 100.0:
            letters_by_line[places[-1]] += letters
    elapsed = [place for place, line in enumerate(lines) if line.startswith(b";TIME_ELAPSED:")]
    for place in elapsed[-1:]:
        letters_by_line[place] = b"T"
    return letters_by_line


def _words_of(line: bytes, letters: bytes) -> dict[bytes, float]:
    """Return some of the words of an M73 line."""
    if not line.startswith(b"M73"):
        return {}
    words = _WORD.finditer(line.split(b";", 1)[0])
    return {match[1]: float(match[2]) for match in words if match[1] in letters}


def _stated_amounts(lines: Sequence[bytes]) -> StatedAmounts:
    """Read the filament, of all tools, that the lines of a print state."""
    names = (b"; filament used [g] = ", b"; total filament used [g] = ", b"; total filament weight [g] : ")
    millimetres = _stated_filament(lines, (b"; filament used [mm] = ", b"; total filament length [mm] : "))
    metres = None if millimetres is not None else _stated_filament(lines, (b";Filament used: ",))
    return StatedAmounts(
        millimetres=millimetres if metres is None else metres * 1000, grams=_stated_filament(lines, names)
    )


def _stated_filament(lines: Sequence[bytes], beginnings: Sequence[bytes]) -> float | None:
    """Return the sum of the numbers on the first line with one of these beginnings, None if there is none."""
    for begin in beginnings:
        for line in lines:
            if line.startswith(begin):
                return sum(float(number) for number in _NUMBER.findall(line[len(begin) :])) or None
    return None


def stated_seconds(line: bytes) -> float:
    """Return the seconds that a line states for the entire print, 0 if it states none.

    >>> stated_seconds(b"; estimated printing time (normal mode) = 1h 1m 1s"), stated_seconds(b"; a remark")
    (3661.0, 0.0)
    """
    if line.startswith((b";TIME:", b";PRINT.TIME:")):
        return float(_first_number(line))
    if line.startswith((b"; estimated printing time", b"; model printing time")):
        match = _TIME.search(line)
        return _parse_duration(match[0]) if match else 0.0
    return 0.0


def _first_number(line: bytes) -> bytes:
    """Return the first number on a line, as text, or b"0"."""
    match = _NUMBER.search(line)
    return match[0] if match else b"0"


def _round_seconds(seconds: float) -> int:
    """Return whole seconds, at least one."""
    return max(1, round(seconds))


def _format_progress(line: bytes, elapsed: float, change: EstimateChange, completed: bytes) -> bytes:
    """Return an M73 line: share completed (P, Q), minutes remaining (R, S), minutes to the next stop (C, D)."""
    share_elapsed = min(max(elapsed / change.seconds, 0.0), 1.0)
    total = {b"R": change.seconds + change.prepared, b"S": change.silent or change.seconds}

    def update_word(match: re.Match[bytes]) -> bytes:
        """Return a word of M73 with its new number."""
        letter, decimals = match[1], len(match[2].partition(b".")[2])
        share = 1.0 if letter in completed else share_elapsed
        if letter in b"PQ":
            return letter + _format_truncated(100 * share, decimals)
        if letter in b"CD":
            return letter + _format_truncated(float(match[2]) * change.ratio, decimals)
        return letter + _format_truncated((total[letter] * (1 - share) + HALF_SECOND) / 60, decimals)

    words, mark, remark = line.partition(b";")
    return _WORD.sub(update_word, words) + mark + remark


def _format_truncated(value: float, decimals: int) -> bytes:
    """Write a number with excess decimals cut off, as slicers write shares and minutes."""
    unit = 10.0**decimals
    return b"%.*f" % (decimals, math.floor(value * unit + ROUND_OFF) / unit)


def _scale_number(number: bytes, factor: float) -> bytes:
    """Multiply a number given as text, and keep its decimals."""
    decimals = len(number.partition(b".")[2])
    return b"%.*f" % (decimals, float(number) * factor)


def _parse_duration(text: bytes) -> float:
    """Return the seconds of a text such as b"1d 2h 3m 4s"."""
    match = _SPAN.match(text)
    days, hours, minutes, seconds = (int(part or 0) for part in (match.groups() if match else (0, 0, 0, 0)))
    return ((days * 24 + hours) * 60 + minutes) * 60.0 + seconds


def _format_duration(seconds: int) -> bytes:
    """Return a time in the format of slicers."""
    minutes, seconds = divmod(seconds, 60)
    hours, minutes = divmod(minutes, 60)
    days, hours = divmod(hours, 24)
    parts = [(days, b"d"), (hours, b"h"), (minutes, b"m"), (seconds, b"s")]
    while len(parts) > 1 and not parts[0][0]:
        parts.pop(0)
    return b" ".join(b"%d%s" % part for part in parts)
