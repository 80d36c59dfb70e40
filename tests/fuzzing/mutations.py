"""Ways to break a file: bytes, words, lines, what is packed inside it. The same generator gives the same file."""

from __future__ import annotations

import gzip
import json
import re
from collections.abc import Callable
from random import Random

from tests.fuzzing.seeds import glb_parts, gunzipped, repacked_zip, unzipped

NUMBERS = [
    "0",
    "-0",
    "1",
    "-1",
    "2",
    "3",
    "7",
    "255",
    "256",
    "65535",
    "65536",
    "2147483647",
    "2147483648",
    "-2147483649",
    "4294967296",
    "9223372036854775808",
    "1e9",
    "1e38",
    "1e39",
    "1e308",
    "1e309",
    "1e-320",
    "nan",
    "NaN",
    "inf",
    "-inf",
    "Infinity",
    "0x10",
    "1_000",
    "1,5",
    "1.",
    ".5",
    "+5",
    "-1e-3",
    "١٢",
    "½",
]
LONG = ("9" * 5000, "1" + "0" * 400, "0." + "0" * 300 + "1")
WORDS = (
    "",
    " ",
    "\x00",
    "\x1b[31m",
    "\x07",
    "\u202e",
    "é",
    "\ufeff",
    "#",
    ";",
    '"',
    "'",
    "<",
    "&",
    "%s",
    "{}",
    "../x",
    "\\",
    "end",
    "null",
    "true",
)
NUMBER = re.compile(rb"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
WORD = re.compile(rb"[A-Za-z_]\w+")
BYTES = (0, 1, 2, 127, 128, 254, 255)


def mutate(name: str, data: bytes, rng: Random, others: tuple[bytes, ...] = ()) -> bytes:
    """Return a broken copy of a file: one to four faults, inside what is packed as often as not."""
    for _ in range(1 + (rng.random() < 0.4) + (rng.random() < 0.2) * 2):
        data = _mutate_once(name, data, rng, others)
    return data


def _mutate_once(name: str, data: bytes, rng: Random, others: tuple[bytes, ...]) -> bytes:
    suffix = name.rpartition(".")[2].lower()
    if rng.random() < 0.7:
        if suffix in ("3mf", "npz") and (members := unzipped(data)):
            return _mutate_member(members, rng)
        if suffix in ("gz", "mgz") and (inner := gunzipped(data)):
            return gzip.compress(_break(inner, rng, others), mtime=0)
        if suffix == "glb" and len(data) > 20 and rng.random() < 0.7:
            return _mutate_glb(data, rng)
    return _break(data, rng, others)


def _mutate_member(members: dict[str, bytes], rng: Random) -> bytes:
    names = sorted(members)
    chosen = rng.choice(names)
    action = rng.random()
    if action < 0.06:
        del members[chosen]
    elif action < 0.1:
        members[chosen + rng.choice(("~", "/", "\\x", ".model"))] = members.pop(chosen)
    else:
        members[chosen] = _break(members[chosen], rng, ())
    return repacked_zip(members)


def _mutate_glb(data: bytes, rng: Random) -> bytes:
    try:
        tree, rest = glb_parts(data)
    except (ValueError, IndexError, RecursionError):
        return _break(data, rng, ())
    text = json.dumps(_mutate_tree(tree, rng)).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + len(rest)
    return data[:8] + (total % 2**32).to_bytes(4, "little") + len(text).to_bytes(4, "little") + b"JSON" + text + rest


def _mutate_tree(tree: object, rng: Random) -> object:
    """Change one value somewhere in parsed JSON."""
    places: list[tuple[dict | list, object]] = []

    def visit(node: object) -> None:
        pairs = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
        for key, value in pairs:
            places.append((node, key))
            visit(value)

    visit(tree)
    if not places:
        return tree
    holder, key = rng.choice(places)
    value = holder[key]
    choices: list[object] = [
        None,
        -1,
        0,
        1,
        2**31,
        2**63,
        1e308,
        "x",
        [],
        {},
        True,
        [1],
        [[]],
        value,
        [value],
        -0.5,
        float("nan"),
        [0] * 15,
        [0.0] * 16,
    ]
    action = rng.random()
    if action < 0.15:
        holder.pop(key)
    elif action < 0.25 and isinstance(holder, list):
        holder.insert(key, value)
    elif isinstance(value, (int, float)) and action < 0.6:
        holder[key] = value + rng.choice((-1, 1, 2, 100, -value, value, 0.5))
    else:
        holder[key] = rng.choice(choices)
    return tree


def _break(data: bytes, rng: Random, others: tuple[bytes, ...]) -> bytes:
    if not data:
        return bytes(rng.choices(range(256), k=8))
    text = data[:2000].count(b"\n") > 3 or data[:1] in b"<;#%{" or b"\0" not in data[:400]
    ways = (*BINARY_WAYS, *(TEXT_WAYS * 2 if text else HEADER_WAYS))
    if others and rng.random() < 0.05:
        return _splice(data, rng.choice(others), rng)
    return rng.choice(ways)(data, rng)


def _splice(data: bytes, other: bytes, rng: Random) -> bytes:
    return data[: rng.randrange(len(data) + 1)] + other[rng.randrange(len(other) + 1) :]


def _change_byte(data: bytes, rng: Random) -> bytes:
    at = rng.randrange(len(data))
    return (
        data[:at]
        + bytes([rng.choice((*BYTES, data[at] ^ (1 << rng.randrange(8)), rng.randrange(256)))])
        + data[at + 1 :]
    )


def _change_early_byte(data: bytes, rng: Random) -> bytes:
    return _change_byte(data[:400], rng) + data[400:]


def _change_number_of_bytes(data: bytes, rng: Random) -> bytes:
    at, size = rng.randrange(len(data)), rng.choice((1, 2, 4, 8))
    value = rng.choice((0, 1, 2**31 - 1, 2**31, 2**32 - 1, 2**62, 0x7FC00000, 0x7F800000))
    return data[:at] + (value % 256**size).to_bytes(size, rng.choice(("little", "big"))) + data[at + size :]


def _cut_off(data: bytes, rng: Random) -> bytes:
    return data[: rng.randrange(len(data))]


def _remove(data: bytes, rng: Random) -> bytes:
    at = rng.randrange(len(data))
    return data[:at] + data[at + rng.choice((1, 2, 4, 16, 64, 400)) :]


def _repeat(data: bytes, rng: Random) -> bytes:
    at, size = rng.randrange(len(data)), rng.choice((1, 4, 16, 64, 400))
    return data[:at] + data[at : at + size] * rng.choice((2, 3, 30)) + data[at + size :]


def _append(data: bytes, rng: Random) -> bytes:
    return data + rng.choice(
        (b"\0", b"\n", b"\r\n", b"\0" * 500, b"end\n", data[:100], bytes(rng.choices(range(256), k=50)))
    )


def _replace(data: bytes, found: re.Match[bytes], new: str) -> bytes:
    return data[: found.start()] + new.encode("utf-8", "surrogatepass") + data[found.end() :]


def _change_number(data: bytes, rng: Random) -> bytes:
    found = _match(NUMBER, data, rng)
    return _replace(data, found, rng.choice(NUMBERS) if rng.random() < 0.9 else rng.choice(LONG)) if found else data


def _change_word(data: bytes, rng: Random) -> bytes:
    found, other = _match(WORD, data, rng), _match(WORD, data, rng)
    if not found or not other:
        return data
    return _replace(
        data, found, rng.choice((*WORDS, other[0].decode(), found[0].decode().swapcase(), found[0].decode() * 200))
    )


def _match(pattern: re.Pattern[bytes], data: bytes, rng: Random) -> re.Match[bytes] | None:
    at = rng.randrange(len(data)) if rng.random() < 0.6 else rng.randrange(min(len(data), 400))
    return pattern.search(data, at) or pattern.search(data)


def _insert(data: bytes, rng: Random) -> bytes:
    at = rng.randrange(len(data) + 1)
    return data[:at] + rng.choice((*WORDS, *NUMBERS, "\t", "\n", "\r", "\n\n", " # c", "\\\n")).encode() + data[at:]


def _change_lines(data: bytes, rng: Random) -> bytes:
    lines = data.splitlines(keepends=True)
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    action = rng.randrange(5)
    if action == 0:
        del lines[i]
    elif action == 1:
        lines.insert(j, lines[i])
    elif action == 2:
        lines[i], lines[j] = lines[j], lines[i]
    elif action == 3:
        words = lines[i].split()
        rng.shuffle(words)
        lines[i] = b" ".join(words[: rng.randrange(len(words) + 1)]) + b"\n"
    else:
        lines[i : i + 1] = [lines[i]] * rng.choice((2, 50))
    return b"".join(lines)


def _change_line_ends(data: bytes, rng: Random) -> bytes:
    return data.replace(b"\n", rng.choice((b"\r\n", b"\r", b"\n\n", b" \n", b"")))


def _change_encoding(data: bytes, rng: Random) -> bytes:
    text = data.decode("latin-1")
    return rng.choice((text.encode("utf-16"), text.encode("utf-8-sig"), text.encode("utf-32"), b"\xef\xbb\xbf" + data))


Way = Callable[[bytes, Random], bytes]
BINARY_WAYS: tuple[Way, ...] = (
    _change_byte,
    _change_early_byte,
    _change_number_of_bytes,
    _cut_off,
    _remove,
    _repeat,
    _append,
)
TEXT_WAYS: tuple[Way, ...] = (
    _change_number,
    _change_number,
    _change_word,
    _insert,
    _change_lines,
    _change_lines,
    _change_line_ends,
    _change_encoding,
)
HEADER_WAYS: tuple[Way, ...] = (_change_number, _change_word, _change_early_byte, _change_number_of_bytes)
