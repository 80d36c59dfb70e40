"""Binary G-code: what is read is what was written, damage is named, and other writers and readers agree.

The blocks, the Heatshrink decoder and the MeatPack reader in this file follow the specifications letter by letter,
with nothing from the package in them.
"""

from __future__ import annotations

import io
import struct
import tracemalloc
import zlib
from itertools import accumulate
from types import ModuleType

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from infill.errors import FormatError, OutputError, ParameterError
from infill.gcode import heatshrink, meatpack
from infill.gcode.binary import (
    Block,
    Compression,
    Encoding,
    Kind,
    decode_block,
    edit_metadata,
    encode_block,
    is_binary,
    pack_block,
    read_blocks,
    read_metadata,
    read_text_pieces,
    rewrite_binary,
)
from infill.gcode.stream import MAX_CHUNK_BYTES

TEXT = b"""M201 X1000 Y1000 Z200 E5000
;LAYER_CHANGE
G1 Z.2 F9000
;TYPE:Internal infill
;WIDTH:0.449999
G1 F4800
G1 X132.905 Y95.266 E.09016
G2 X10 Y-2.5 I1 J0 E.2
G92 E0
G4 S2
M117 Printing G1 X of 2
G28 W
"""
HEAD = struct.pack("<4sIH", b"GCDE", 1, 1)
PRINTER, PRINT, SLICER = (
    b"printer_model=MK4\nfilament used [g]=28.18\n",
    b"filament used [g]=28.18\n",
    b"a=1\nb = x=y\n",
)
PICTURE = bytes(range(200))


def block(
    kind: int, data: bytes, parameters: bytes = b"\0\0", *, compression: int = 0, size: int | None = None
) -> bytes:
    """Write one block as the specification says."""
    sizes = [len(data) if size is None else size] + ([len(data)] if compression else [])
    body = struct.pack(f"<HH{len(sizes)}I", kind, compression, *sizes) + parameters + data
    return body + struct.pack("<I", zlib.crc32(body))


def parts(gcode: list[bytes]) -> list[bytes]:
    """Write a whole file, block by block."""
    return [
        HEAD,
        block(0, b"Producer=slicer\n"),
        block(3, PRINTER),
        block(5, PICTURE, struct.pack("<HHH", 0, 16, 16)),
        block(4, PRINT),
        block(2, zlib.compress(SLICER), compression=1, size=len(SLICER)),
        *gcode,
    ]


def made(compression: int, encoding: int) -> Block:
    """Give a block of G-code for others to be like."""
    parameters = struct.pack("<H", encoding)
    return Block(
        kind=Kind.GCODE,
        compression=Compression(compression),
        size=0,
        parameters=parameters,
        data=b"",
        summed=True,
    )


def opened(data: bytes | list[bytes]) -> io.BytesIO:
    return io.BytesIO(data if isinstance(data, bytes) else b"".join(data))


def expanded(data: bytes, size: int, window: int, lookahead: int) -> bytes:
    """Read Heatshrink bit by bit."""
    bits = iter("".join(f"{byte:08b}" for byte in data))

    def number(count: int) -> int:
        return int("".join(next(bits) for _ in range(count)), 2)

    result = bytearray(1 << window)
    while len(result) < size + (1 << window):
        if number(1):
            result.append(number(8))
        else:
            back = number(window) + 1
            for _ in range(number(lookahead) + 1):
                result.append(result[-back])
    return bytes(result[1 << window :])


def unpacked_by_steps(data: bytes) -> bytes:
    """Read MeatPack byte by byte, no blanks put back."""
    packing = spaceless = False
    result, place, waiting = bytearray(), 0, []

    def put(half: int) -> None:
        letters = b"0123456789.%c\nGX" % (b"E" if spaceless else b" ")
        waiting.append(letters[half : half + 1] if half < 15 else None)

    def flush() -> None:
        while waiting and waiting[0] is not None:
            result.extend(waiting.pop(0))

    while place < len(data):
        if data[place : place + 2] == b"\xff\xff":
            command = data[place + 2]
            packing = {251: True, 250: False, 249: False}.get(command, packing)
            spaceless = {247: True, 246: False, 249: False}.get(command, spaceless)
            place += 3
            continue
        byte = data[place]
        place += 1
        if not packing:
            result.append(byte)
        elif waiting:
            waiting[0] = bytes([byte])
            flush()
        else:
            put(byte & 15)
            if byte & 15 != 12:
                put(byte >> 4)
            flush()
    return bytes(result)


words = st.builds(
    lambda letter, number: f"{letter}{number:g}",
    st.sampled_from("XYZEFIJRPSWHCAD"),
    st.floats(-999, 999).map(lambda value: round(value, 3)),
)
moves = st.builds(
    lambda number, blanks, words: (
        f"G{number}" + "".join(blank + word for blank, word in zip(blanks, words, strict=False))
    ),
    st.integers(0, 99),
    st.lists(st.sampled_from([" ", " ", "", "  "]), min_size=6, max_size=6),
    st.lists(words, max_size=6),
)
others = st.text(st.sampled_from('MTNXGE0123456789 ;."*=_-\t\rxgeé'), max_size=20)
texts = st.lists(moves | others, max_size=30).map(lambda lines: "".join(f"{line}\n" for line in lines).encode())


# --- Heatshrink ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("data", "stream", "window", "lookahead"),
    [
        (bytes(range(5)), "804060503820", 8, 7),
        (b"aaaaa", "b0800180", 8, 7),
        (b"abcdabcd", "b0d8ac76401b", 8, 3),
        (b"abcdabcde", "b0d8ac76401bb280", 8, 3),
        (b"foo", "b35bede0", 7, 3),
        (b"foofoo", "b35bede04080", 7, 7),
    ],
)
def test_heatshrink_reads_and_writes_the_vectors_of_its_own_tests(
    data: bytes, stream: str, window: int, lookahead: int
) -> None:
    assert heatshrink.compress_heatshrink(data, window=window, lookahead=lookahead).hex() == stream
    read = heatshrink.decompress_heatshrink(bytes.fromhex(stream), size=len(data), window=window, lookahead=lookahead)
    assert read == data


def test_before_the_start_of_heatshrink_all_is_zero() -> None:
    assert heatshrink.decompress_heatshrink(bytes.fromhex("0030"), size=4, window=8, lookahead=3) == bytes(4)


@given(
    st.binary(max_size=300) | st.text("ab", max_size=300).map(str.encode), st.sampled_from([(11, 4), (12, 4), (5, 3)])
)
@example(TEXT * 12, (5, 3))
@example(bytes(70_000), (12, 4))
def test_heatshrink_gives_back_what_went_in(data: bytes, bits: tuple[int, int]) -> None:
    window, lookahead = bits
    stream = heatshrink.compress_heatshrink(data, window=window, lookahead=lookahead)
    assert heatshrink.decompress_heatshrink(stream, size=len(data), window=window, lookahead=lookahead) == data
    if len(data) < 2000:
        assert expanded(stream, len(data), window, lookahead) == data
    assert 8 * len(stream) < 9 * len(data) + 8  # never more than a flag beside each byte, and the last byte filled


@pytest.mark.parametrize(
    ("cut", "size", "word"), [(1, 0, "ends before"), (0, 2, "ends before"), (0, -2, "does not end")]
)
def test_heatshrink_of_another_size_is_damaged(cut: int, size: int, word: str) -> None:
    stream = heatshrink.compress_heatshrink(PICTURE, window=11)
    with pytest.raises(FormatError, match=word):
        heatshrink.decompress_heatshrink(stream[: len(stream) - cut], size=len(PICTURE) + size, window=11)


# --- MeatPack --------------------------------------------------------------------------------------------

BEGIN = "fffffb fffff7"


@pytest.mark.parametrize(
    ("text", "data"),
    [
        (b"G1 X10 Y2.5 E0.1\n", "1d 1e f059 a2 b5 a0 c1 cc"),  # blanks left out; the last byte pads
        (b"M106 S255\n", "1f4d 60 ff2053 52 c5"),  # a blank is no half where E is one
        (b"T0\n", "0f54 cc"),
        (b"G4 S2\n", "4d ff2053 c2 cc"),  # old readers put no blank back before S
        (b";A\nG1 X1\n", "fffffa 3b410a fffffb 1d 1e cc"),
    ],
)
def test_meatpack_by_hand(text: bytes, data: str) -> None:
    assert meatpack.pack_text(text).hex() == bytes.fromhex(BEGIN + data).hex()
    assert meatpack.unpack_text(bytes.fromhex(BEGIN + data)) == text


@pytest.mark.parametrize(
    ("data", "text"),
    [
        ("fffffb 1d eb a3 c1", b"G1 X3.1\n"),  # with spaces, half 11 is one
        ("fffffb 1d fc 1d cc", b"G1\nG1\n"),  # after a newline the upper half means nothing
        ("4d31 0a fffffb 1d cc fffff9 54 30", b"M1\nG1\nT0"),
        ("fffffb fffff7 1b cc fffff6 1b cc", b"E1\n 1\n"),
        ("fffffb fffff8 1d 0c", b"G1\n"),
    ],
)
def test_meatpack_as_others_may_write_it(data: str, text: bytes) -> None:
    assert meatpack.unpack_text(bytes.fromhex(data)) == text


@pytest.mark.longest
@settings(max_examples=200)
@given(texts, st.booleans())
@example(TEXT, True)
@example(b"G1 X1 E1\n" * 40, True)
def test_packing_loses_what_normalising_left_out_and_no_more(text: bytes, comments: bool) -> None:
    wanted = meatpack.normalise_text(text, comments=comments)
    assert meatpack.normalise_text(wanted, comments=comments) == wanted
    data = meatpack.pack_text(wanted, comments=comments)
    assert meatpack.unpack_text(data) == wanted
    # libbgcode needs a block to be at least half as large as its text.
    assert 2 * len(data) > len(wanted)
    assert unpacked_by_steps(data).replace(b" ", b"").replace(b"\n\n", b"\n") == wanted.replace(b" ", b"")


def test_normalised_says_what_it_leaves_out() -> None:
    text = b"  G1X1   Y2 ; why\n\n;TYPE:A \n \t; b\nM117  two  \r\ng1 x1\n"
    assert meatpack.normalise_text(text) == b"G1 X1 Y2\n;TYPE:A \n; b\nM117  two\ng1 x1\n"
    assert meatpack.normalise_text(text, comments=False) == b"G1 X1 Y2\nM117  two\ng1 x1\n"


@pytest.mark.parametrize(
    ("data", "word"),
    [
        ("fffffb 1f", "within a character"),
        ("ffff20", "command 32"),
        ("ffff", "command -1"),
        ("fffffb f1 fffffa 41", "command within"),
    ],
)
def test_damaged_meatpack_is_named(data: str, word: str) -> None:
    with pytest.raises(FormatError, match=word):
        meatpack.unpack_text(bytes.fromhex(data))


# --- blocks ----------------------------------------------------------------------------------------------

PACKED = bytes.fromhex(BEGIN + "1d 5e cc fffffa 3b410a fffffb 1f4d cc")
PACKED_TEXT = b"G1 X5\n;A\nM1\n"
SHRUNK = bytes.fromhex("b0d8")  # with a window of 12 bits too: a, then b without its end


def a_file() -> list[bytes]:
    deflated = zlib.compress(PACKED)
    return parts([block(1, b"G28\nG1 X1"), block(1, deflated, b"\2\0", compression=1, size=len(PACKED))])


def test_a_file_of_another_writer_is_read() -> None:
    assert is_binary(HEAD)
    assert not is_binary(b"G1 X1")
    read = list(read_blocks(opened(a_file())))
    assert [each.kind for each in read] == [0, 3, 5, 4, 2, 1, 1]
    assert [pack_block(each) for each in read] == a_file()[1:]
    assert decode_block(read[2]) == PICTURE
    assert read_metadata(read[4]) == {"a": "1", "b ": " x=y"}
    # The last line of the first block goes on in the second.
    assert b"".join(read_text_pieces(opened(a_file()))) == b"G28\nG1 X1" + PACKED_TEXT


@pytest.mark.slow
@given(texts, st.sampled_from(Compression), st.sampled_from(Encoding))
@example(TEXT, Compression.HEATSHRINK_12, Encoding.MEATPACK_COMMENTS)
def test_what_is_encoded_decodes_to_the_same(text: bytes, compression: Compression, encoding: Encoding) -> None:
    new = encode_block(text, like=made(compression, encoding))
    assert (new.compression, new.encoding) == (compression, encoding)
    wanted = text
    if encoding:
        wanted = meatpack.normalise_text(text, comments=encoding == Encoding.MEATPACK_COMMENTS)
    assert decode_block(new) == wanted
    assert next(read_blocks(opened([HEAD, pack_block(new)]))).data == new.data


@pytest.mark.parametrize("line", [b"GRAB  BOX ; a\n", b' M118 "a;b"\n', b"M117 \xff \n", b'G1 "X"\n', b"G\n"])
def test_a_line_that_packing_would_change_is_kept_as_it_is(line: bytes) -> None:
    new = encode_block(line + TEXT + line + line, like=made(3, 2))
    assert decode_block(new) == line + TEXT + line + line


def test_what_meatpack_cannot_hold_is_refused() -> None:
    assert decode_block(encode_block(b"M117 \xff\xff\n", like=made(3, 0))) == b"M117 \xff\xff\n"
    with pytest.raises(OutputError, match="does not read back"):
        encode_block(b"M117 \xff\xff\n", like=made(3, 2))


@pytest.mark.parametrize("broken", [b"", b"\xff\xff\xfb\x1d\x1f", b"\xff\xff\xfb\x1d\x1d"])
@pytest.mark.parametrize(("place", "name"), [(meatpack, "pack_text"), (heatshrink, "compress_heatshrink")])
def test_a_packer_that_errs_is_found_out(
    broken: bytes, place: ModuleType, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(place, name, lambda text, **_: broken)
    with pytest.raises(OutputError, match="does not read back"):
        encode_block(b"G1\n", like=made(3, 2))


def test_a_file_cut_anywhere_is_told() -> None:
    whole = b"".join(a_file())
    borders = set(accumulate(len(each) for each in a_file()))
    for length in range(len(whole)):
        cut = opened(whole[:length])
        if length in borders:
            assert len(list(read_blocks(cut))) < 7
            continue
        with pytest.raises(FormatError) as told:
            list(read_blocks(cut))
        assert "\n" not in str(told.value)
        assert "cut off" in str(told.value) or length < 4
        if length > len(HEAD):
            assert f"block {sum(border <= length for border in borders)} " in str(told.value)


def test_one_changed_bit_anywhere_is_told() -> None:
    whole = b"".join(a_file())
    for place in range(len(whole)):
        damaged = bytearray(whole)
        damaged[place] ^= 1 << place % 8
        with pytest.raises(FormatError) as told:
            list(read_blocks(opened(bytes(damaged))))
        assert "\n" not in str(told.value)


@pytest.mark.parametrize(
    ("data", "word"),
    [
        (b"G1 X1 Y1 Z1", "starts with b'G1 X'"),
        (struct.pack("<4sIH", b"GCDE", 2, 1), "version 2"),
        (struct.pack("<4sIH", b"GCDE", 1, 2), "checksum type 2"),
        (HEAD + block(6, b""), "block 1 is of kind 6"),
        (HEAD + block(4, b"", compression=4), "block 1 \\(print metadata\\) has compression 4"),
        (HEAD + block(1, b"", b"\3\0"), "block 1 \\(G-code\\) has encoding 3"),
        (HEAD + block(1, b"", size=1 << 29), "states 536870912 bytes"),
        (HEAD + block(1, b"")[:-1] + b"!", "block 1 \\(G-code\\) is damaged: its checksum"),
        (HEAD + block(1, b"junk", compression=1, size=9), "block 1 \\(G-code\\): its data cannot be inflated"),
        (HEAD + block(1, zlib.compress(b"text"), compression=1, size=3), "does not inflate to the 3 bytes"),
        (HEAD + block(1, zlib.compress(b"text")[:-5], compression=1, size=4), "does not inflate to the 4 bytes"),
        (HEAD + block(1, SHRUNK, compression=3, size=2), "block 1 \\(G-code\\): Heatshrink data ends before"),
        (HEAD + block(1, b"\xff\xff!", b"\1\0"), "block 1 \\(G-code\\): MeatPack data has command 33"),
        (HEAD + block(4, PRINT), "without a block of G-code"),
        (HEAD, "without a block of G-code"),
    ],
)
def test_what_is_wrong_is_one_line(data: bytes, word: str) -> None:
    with pytest.raises(FormatError, match=word) as told:
        list(read_text_pieces(opened(data)))
    assert "\n" not in str(told.value)


def test_a_file_without_checksums_is_read_and_written_without() -> None:
    whole = opened([struct.pack("<4sIH", b"GCDE", 1, 0), *(each[:-4] for each in a_file()[1:])])
    target = io.BytesIO()
    rewrite_binary(whole, target, [b"G28\n"])
    assert target.getvalue()[:10] == whole.getvalue()[:10]
    assert b"".join(read_text_pieces(opened(target.getvalue()))) == b"G28\n"
    assert not any(each.summed for each in read_blocks(opened(target.getvalue())))


# --- written anew ----------------------------------------------------------------------------------------

FILAMENT = "filament used [g]"


@pytest.mark.parametrize("compression", [0, 1, 2, 3])
@pytest.mark.parametrize("encoding", [0, 1, 2])
def test_only_the_text_and_the_metadata_that_are_named_change(compression: int, encoding: int) -> None:
    old = parts([pack_block(encode_block(TEXT, like=made(compression, encoding)))])
    target = io.BytesIO()
    found = rewrite_binary(opened(old), target, iter([TEXT[:-3], TEXT[-3:], b"M84\n"]), {FILAMENT: "9.1", "mass": "2"})
    assert found == {FILAMENT}
    whole = target.getvalue()
    new = list(read_blocks(opened(whole)))
    assert whole == b"".join([HEAD, *map(pack_block, new)])
    assert [pack_block(new[place]) for place in (0, 2, 4)] == [old[place + 1] for place in (0, 2, 4)]
    assert decode_block(new[1]) == PRINTER.replace(b"28.18", b"9.1")
    assert decode_block(new[3]) == PRINT.replace(b"28.18", b"9.1")
    assert {(each.compression, each.encoding) for each in new[5:]} == {(compression, encoding)}
    wanted = TEXT + b"M84\n"
    if encoding:
        wanted = meatpack.normalise_text(wanted, comments=encoding == 2)
    assert b"".join(read_text_pieces(opened(whole))) == wanted


def test_compressed_metadata_is_edited_and_a_line_break_is_refused() -> None:
    slicer = list(read_blocks(opened(a_file())))[4]
    new = edit_metadata(slicer, {"b ": "é", "c": "3"})
    assert (new.compression, decode_block(new)) == (Compression.DEFLATE, "a=1\nb =é\n".encode())
    assert edit_metadata(slicer, {"c": "3"}) is slicer
    with pytest.raises(ParameterError, match="one line each"):
        edit_metadata(slicer, {"a": "1\n2"})


def test_blocks_hold_whole_lines_and_no_more_than_the_limit() -> None:
    lines = [b"G1 X%d\n" % number for number in range(30_000)]
    longest = b";" + b"a" * MAX_CHUNK_BYTES + b"\n"
    text = b"".join(lines) + longest + lines[0]
    target = io.BytesIO()
    rewrite_binary(opened(a_file()), target, (text[start : start + 999] for start in range(0, len(text), 999)))
    found = [decode_block(each) for each in read_blocks(opened(target.getvalue())) if each.kind == Kind.GCODE]
    assert b"".join(found) == text
    assert all(each.endswith(b"\n") for each in found)
    # As full as whole lines allow: the next line would not have fitted.
    assert all(len(each) > MAX_CHUNK_BYTES - 10 for each in found[:-3])
    assert [len(each) > MAX_CHUNK_BYTES for each in found] == [each == longest for each in found]
    assert list(read_text_pieces(opened(target.getvalue()))) == found


def test_memory_does_not_grow_with_the_file(tmp_path) -> None:
    path, new = tmp_path / "a.bgcode", tmp_path / "b.bgcode"
    gcode = block(1, zlib.compress(TEXT * 200), compression=1, size=len(TEXT * 200))

    def peak(count: int) -> int:
        path.write_bytes(b"".join(parts([gcode] * count)))
        tracemalloc.start()
        with path.open("rb") as source, path.open("rb") as text, new.open("wb") as target:
            rewrite_binary(source, target, read_text_pieces(text))
        most = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return most

    # 6 MB of text against 0.2 MB. A tenth more is for what the interpreter keeps for itself.
    assert peak(120) < 1.1 * peak(4)
