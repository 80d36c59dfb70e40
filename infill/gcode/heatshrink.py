"""Heatshrink, the compression of binary G-code: one bit, then either a byte or a copy of earlier bytes.

    1 + 8 bits              the byte itself
    0 + window + lookahead  copy `lookahead bits + 1` bytes from `window bits + 1` bytes back

Bits come highest first; zero bits fill the last byte. Before the start all bytes count as zero, and encoders do
copy from there. Facts from the documentation and the test vectors of
https://github.com/atomicobject/heatshrink.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError

LITERAL_BITS = 9  # bits
SORTED_BYTES = 1 << 20  # bytes; two names and a place of 21 bits each fill 63 bits


def decompress_heatshrink(data: bytes, *, size: int, window: int, lookahead: int = 4) -> bytes:
    """Decompress a Heatshrink stream; return its bytes.

    Parameters
    ----------
    data : bytes
        The stream.
    size : int
        Bytes of the result; the stream itself does not say.
    window, lookahead : int
        Bits of a distance and of a length, together 8 to 16.

    Raises
    ------
    FormatError
        The stream ends before it has made `size` bytes, or continues after them.

    Examples
    --------
    >>> decompress_heatshrink(bytes([0xB0, 0x80, 0x01, 0x80]), size=5, window=8, lookahead=7)
    b'aaaaa'
    """
    padded = np.frombuffer(data + b"\0\0", np.uint8).astype(np.int32)
    # 24 bits from every byte on hold a token of 17 that starts at any bit of it.
    words = (padded[:-2] << 16 | padded[1:-1] << 8 | padded[2:]).tolist()
    token_bits = 1 + window + lookahead
    spare, mask, literal, literal_shift = 24 - token_bits, (1 << token_bits) - 1, 1 << token_bits - 1, token_bits - 9
    length_mask = (1 << lookahead) - 1
    result = bytearray(1 << window)
    position, made, total = 0, len(result), len(result) + size
    append = result.append
    try:
        while made < total:
            token = words[position >> 3] >> spare - (position & 7) & mask
            if token & literal:
                append(token >> literal_shift & 255)
                position += LITERAL_BITS
                made += 1
                continue
            position += token_bits
            length, back = (token & length_mask) + 1, (token >> lookahead) + 1
            start = made - back
            if back >= length:
                result += result[start : start + length]
            else:  # a copy that reads what it writes repeats the last `back` bytes
                result += (result[start:] * length)[:length]
            made += length
    except IndexError:
        position = 8 * len(data) + 1
    spare_bits = 8 * len(data) - position
    if spare_bits < 0 or spare_bits >= 8 or made != total:
        trouble = "ends before" if spare_bits < 0 else "does not end after"
        raise FormatError(f"Heatshrink data {trouble} the {size} bytes that it should hold; it is damaged")
    return bytes(result[1 << window :])


def compress_heatshrink(data: bytes, *, window: int, lookahead: int = 4) -> bytes:
    """Compress bytes to a Heatshrink stream, with the longest copies that a quick search finds.

    Parameters
    ----------
    data : bytes
        The bytes to compress.
    window, lookahead : int
        Bits of a distance and of a length, together 8 to 16.

    Examples
    --------
    >>> compress_heatshrink(b"aaaaa", window=8, lookahead=7).hex()
    'b0800180'
    """
    if not data:
        return b""
    # Copies never reach from one sorted piece into the previous one; a block of G-code is far shorter than a piece.
    pieces = [data[start : start + SORTED_BYTES] for start in range(0, len(data), SORTED_BYTES)]
    matches = [_find_matches(piece, farthest=1 << window, longest=1 << lookahead) for piece in pieces]
    lengths, backs = (np.concatenate(columns) for columns in zip(*matches, strict=True))
    steps, places, position, count = lengths.tolist(), [], 0, len(data)
    while position < count:
        places.append(position)
        position += steps[position]
    at = np.array(places)
    length = lengths[at].astype(np.int64)
    copied = length > 1
    token = np.where(
        copied, (backs[at] - 1) << lookahead | (length - 1), np.frombuffer(data, np.uint8)[at] + np.int64(256)
    )
    width = np.where(copied, 1 + window + lookahead, LITERAL_BITS)
    end = np.cumsum(width)
    start = end - width
    first_byte, shifted = start >> 3, token << (24 - width - (start & 7))
    # Tokens share bytes but no bits, so a sum joins them. Float64 is exact here.
    written = np.zeros((int(end[-1]) + 7 >> 3) + 2)
    for nth in range(3):
        written += np.bincount(first_byte + nth, weights=shifted >> (16 - 8 * nth) & 255, minlength=len(written))
    return written[:-2].astype(np.uint8).tobytes()


def _find_matches(data: bytes, *, farthest: int, longest: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Find for each byte an earlier place within reach that starts with the same bytes: (length, distance).

    Sorting finds the latest place with the same 2, 3, 4, 6, 8, 12, 16, ... bytes; the names of long runs combine
    the names of shorter ones, as in a suffix array built by doubling. Comparing byte by byte finds the lengths in
    between. Length 1 means no match. At most SORTED bytes.
    """
    count = len(data)
    bits = max(8, count.bit_length())
    values = np.frombuffer(data, np.uint8).astype(np.int64)
    names = {1: values}
    lengths, backs = np.ones(count, np.int64), np.zeros(count, np.int64)
    runs = [(1, 1)] + [(length, part) for length in (2, 4, 8, 16, 32, 64) for part in (length // 2, length)]
    for head, tail in runs:
        run = head + tail
        if run > min(longest, count):
            break
        places = count - run + 1
        # Two names and the place in one number: a plain sort is several times faster than a stable argsort.
        keys = names[head][:places] << 2 * bits | names[tail][head : head + places] << bits | np.arange(places)
        keys.sort()
        order = keys & (1 << bits) - 1
        keys >>= bits
        same = keys[1:] == keys[:-1]
        names[run] = np.empty(places, np.int64)
        names[run][order] = np.concatenate(([0], np.cumsum(~same)))
        back = order[1:] - order[:-1]
        close = np.flatnonzero(same & (back <= farthest))
        later = order[1:][close]
        lengths[later], backs[later] = run, back[close]
    growing = np.flatnonzero((lengths > 1) & (lengths < longest))
    while len(growing):
        after = growing + lengths[growing]
        fits = (after < count) & (lengths[growing] < longest)
        growing, after = growing[fits], after[fits]
        growing = growing[values[after] == values[after - backs[growing]]]
        lengths[growing] += 1
    return lengths, backs
