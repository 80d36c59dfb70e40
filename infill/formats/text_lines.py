"""Text files in all dialects: encodings, line ends, comments, and the numbers on their lines."""

from __future__ import annotations

import codecs
import re
import warnings
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Integers
from infill.errors import FormatError
from infill.files.excerpts import quote_word

TAB, NEWLINE, RETURN, BLANK = 9, 10, 13, 32
COMMENT = re.compile(rb"#[^\n]*")
CONTINUED = re.compile(rb"\\[ \t]*\n")
HEAD_BYTES = 4  # bytes that tell an encoding


def read_plain_text(path: Path) -> bytes:
    """Read a text file; return it in an ASCII-compatible encoding, with a line feed after each line.

    Raises
    ------
    FormatError
        If the file is binary.
    """
    data = path.read_bytes()
    wide = wide_encoding(data)
    if wide:
        data = data.decode(wide, errors="replace").encode()
    data = data.removeprefix(codecs.BOM_UTF8)
    if b"\0" in data:
        raise FormatError(f"{path} holds bytes that no text has; export the mesh again as text")
    return data.replace(b"\r\n", b"\n").replace(b"\r", b"\n") + b"\n\n\n"


def wide_encoding(data: bytes) -> str:
    """Return the encoding of a text with two or four bytes a character, by its mark or zeros, or ""."""
    head = data[:HEAD_BYTES]
    if head.startswith((codecs.BOM_UTF32_LE, codecs.BOM_UTF32_BE)):  # the former begins as UTF-16 does
        return "utf-32"
    if head.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    if len(head) == HEAD_BYTES and head[1] == head[3] == 0 < min(head[0], head[2]):
        return "utf-16-le"
    if len(head) == HEAD_BYTES and head[0] == head[2] == 0 < min(head[1], head[3]):
        return "utf-16-be"
    return ""


def blank_comments(text: bytes) -> bytes:
    """Replace comments, from a # to the end of the line, by blanks of equal length."""
    return COMMENT.sub(_as_blanks, text) if b"#" in text else text


def blank_breaks(text: bytes) -> bytes:
    """Replace a backslash at the end of a line, and the line feed after it, by blanks of equal length."""
    return CONTINUED.sub(_as_blanks, text) if b"\\" in text else text


def _as_blanks(match: re.Match[bytes]) -> bytes:
    """Return blanks for a match."""
    return b" " * len(match[0])


def are_separators(values: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Return a mask of the bytes that separate words: a blank, a tab, and the ends of lines and pages."""
    blank: NDArray[np.bool_] = (values - np.uint8(TAB) <= np.uint8(RETURN - TAB)) | (values == BLANK)
    return blank


@dataclass(frozen=True, kw_only=True, eq=False)
class Lines:
    """The lines of a text that hold a word.

    Parameters
    ----------
    path : Path
        For messages.
    original, text : bytes
        The content of the file, with all line ends, and the text to parse; of equal length.
    """

    path: Path
    original: bytes
    text: bytes

    @cached_property
    def bytes_of(self) -> NDArray[np.uint8]:
        """The text as numbers."""
        return np.frombuffer(self.text, dtype=np.uint8)

    @cached_property
    def begins(self) -> Integers:
        """Position of the first byte of each word, (W,)."""
        blank = are_separators(self.bytes_of)
        begins = ~blank
        begins[1:] &= blank[:-1]
        return np.flatnonzero(begins)

    @cached_property
    def _rows(self) -> tuple[Integers, Integers, Integers, Integers]:
        """First word, number of words, first byte and end of each line that holds a word."""
        ends = np.flatnonzero(self.bytes_of == NEWLINE) + 1
        line_starts = np.concatenate([[0], ends[:-1]]) if len(ends) else ends
        first_words = np.searchsorted(self.begins, line_starts)
        word_counts = np.diff(first_words, append=len(self.begins))
        has_word = word_counts > 0
        return first_words[has_word], word_counts[has_word], line_starts[has_word], ends[has_word]

    @property
    def first_words(self) -> Integers:
        """Number of the first word of each line, (L,)."""
        return self._rows[0]

    @property
    def word_counts(self) -> Integers:
        """Number of words on each line, (L,)."""
        return self._rows[1]

    def __len__(self) -> int:
        """Return the number of lines with a word."""
        return len(self.word_counts)

    def key_bytes(self, place: int) -> NDArray[np.uint8]:
        """Return byte `place` of the first word of each line, in lower case, or what follows a shorter word: (L,)."""
        letters = self.bytes_of[np.minimum(self.begins[self.first_words] + place, len(self.bytes_of) - 1)]
        return np.where((letters >= ord("A")) & (letters <= ord("Z")), letters + 32, letters).astype(np.uint8)

    def word(self, number: int) -> bytes:
        """Return the word of a number, its first 80 bytes at most."""
        begin = int(self.begins[number])
        return self.text[begin : begin + 80].split(None, 1)[0]

    def line(self, number: int) -> int:
        """Return the number of the line that a word is on, counted from 1."""
        return self.original.count(b"\n", 0, int(self.begins[number])) + 1

    def numbers(
        self, rows: Integers, skip: int, dtype: type[np.generic], *, slashes: bool = False
    ) -> NDArray[np.generic]:
        """Return the numbers on selected lines, line after line, without the first words of each line.

        Parameters
        ----------
        rows : (R,) int64
            Ascending.
        skip : int
            Number of leading words to skip on each line: 0, or 1 with at most two letters.
        dtype : type
            float64 or int64.
        slashes : bool
            Whether a slash ends a number: the rest of its word is left out.

        Raises
        ------
        FormatError
            If one of the words is not a number; the first one is named with its line.
        """
        word_count = int((self.word_counts[rows] - skip).sum())
        if word_count == 0:
            return np.empty(0, dtype=dtype)
        text = self._text_of(rows, skip)
        if slashes and b"/" in text:
            text = re.sub(rb"/\S*", b"", text)
        with warnings.catch_warnings():
            warnings.simplefilter("error", DeprecationWarning)
            try:
                values: NDArray[np.generic] = np.fromstring(text, dtype=dtype, sep=" ")
            except (DeprecationWarning, ValueError):
                values = np.empty(0, dtype=dtype)
        if len(values) != word_count:
            raise self._number_error(rows, skip, dtype, slashes=slashes)
        return values

    def _text_of(self, rows: Integers, skip: int) -> bytes:
        """Return the text of selected lines, without their first words."""
        text = self._text_without_keywords if skip else self.text
        _, _, starts, ends = self._rows
        breaks = np.flatnonzero(np.diff(rows) > 1)  # adjacent lines are copied together
        low, high = rows[np.concatenate([[0], breaks + 1])], rows[np.append(breaks, len(rows) - 1)]
        return b"".join([text[a:b] for a, b in zip(starts[low].tolist(), ends[high].tolist(), strict=True)])

    @cached_property
    def _text_without_keywords(self) -> bytes:
        """The text with blanks for the first word of each line, if that has one or two letters."""
        text = self.bytes_of.copy()
        begins = self.begins[self.first_words]
        text[begins] = BLANK
        after = begins[are_separators(text[begins + 2])] + 1
        text[after[text[after] != NEWLINE]] = BLANK
        return text.tobytes()

    def _number_error(self, rows: Integers, skip: int, dtype: type[np.generic], *, slashes: bool) -> FormatError:
        """Return the error about the first word that is not a number."""
        is_integer = issubclass(dtype, np.integer)
        for first_word, word_count in zip(
            self.first_words[rows].tolist(), self.word_counts[rows].tolist(), strict=True
        ):
            for number in range(first_word + skip, first_word + word_count):
                word = self.word(number)
                if complaint := number_complaint(
                    word.partition(b"/")[0] or word if slashes else word, whole=is_integer
                ):
                    return self.error(number, complaint)
        return self.error(int(self.first_words[rows[0]]), "a number that cannot be read")

    def error(self, number: int, complaint: str, advice: str = "export the mesh again") -> FormatError:
        """Return the error about a word, with its line."""
        return FormatError(f"{self.path}, line {self.line(number)}: {complaint}; {advice}")


def number_complaint(word: bytes, *, whole: bool = False) -> str:
    """Return the defect of a word that should be a number; empty if there is none.

    >>> number_complaint(b"1e-3"), number_complaint(b"1,5")
    ('', "'1,5' has a decimal comma, and numbers in such a file have a decimal point")
    """
    try:
        _ = int(word) if whole else float(word)
    except ValueError:
        pass
    else:
        if b"_" not in word:
            return ""
    if not whole and re.fullmatch(rb"[-+]?\d+,\d*(e[-+]?\d+)?", word, re.IGNORECASE):
        return f"{quote_word(word)} has a decimal comma, and numbers in such a file have a decimal point"
    return f"{quote_word(word)} is not a {'whole ' if whole else ''}number"
