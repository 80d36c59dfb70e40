"""Plain data as bytes: arrays, numbers, texts and dataclasses of this package, without running what a file says."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Mapping
from importlib import import_module
from typing import Any

import numpy as np

PACKAGE = "infill."
MAGIC = b"infill.1"
CHECK = 16  # bytes of the checksum
SIZES = 8  # bytes of a length


class DamagedDataError(ValueError):
    """Bytes that `decode_data` cannot read, or whose checksum is wrong."""


def encode_data(value: Any) -> list[bytes]:  # noqa: ANN401 - plain data
    """Return a value as pieces of bytes, to be written one after another; a checksum comes first.

    Parameters
    ----------
    value
        None, booleans, numbers, texts, arrays of numbers, and tuples, lists, dictionaries and dataclasses of them.

    Raises
    ------
    TypeError
        For anything else.

    >>> decode_data(b"".join(encode_data((1, None, 2.5, "a", np.arange(3)))))
    (1, None, 2.5, 'a', array([0, 1, 2]))
    """
    blocks: list[bytes] = []
    tree = json.dumps(_describe(value, blocks)).encode()
    body = [len(tree).to_bytes(SIZES, "little"), tree, *blocks]
    check = hashlib.blake2b(digest_size=CHECK)
    for piece in body:
        check.update(piece)
    return [MAGIC, check.digest(), *body]


def decode_data(data: bytes) -> Any:  # noqa: ANN401 - plain data
    """Return the value of `encode_data`.

    Raises
    ------
    DamagedDataError
        If the bytes are not whole.
    """
    begin = len(MAGIC) + CHECK
    body = memoryview(data)[begin:]
    check = hashlib.blake2b(body, digest_size=CHECK).digest()
    if data[: len(MAGIC)] != MAGIC or data[len(MAGIC) : begin] != check:
        raise DamagedDataError("the data are damaged")
    size = int.from_bytes(body[:SIZES], "little")
    try:
        return _restore(json.loads(bytes(body[SIZES : SIZES + size])), body[SIZES + size :])
    except (ValueError, TypeError, KeyError, ImportError, AttributeError) as error:  # of another version
        raise DamagedDataError("the data are of another version") from error


def digest_data(*values: Any) -> str:  # noqa: ANN401 - plain data
    """Return a name for values that any difference changes, 32 digits; without fields that a class lists as `unkeyed`.

    >>> digest_data(1.0, "a") == digest_data(1.0, "b")
    False
    """
    blocks: list[bytes] = []
    tree = json.dumps(_describe(values, blocks, keyed=True)).encode()
    check = hashlib.blake2b(tree, digest_size=CHECK)
    for block in blocks:
        check.update(block)
    return check.hexdigest()


def _describe(value: Any, blocks: list[bytes], *, keyed: bool = False) -> list[Any]:  # noqa: ANN401
    """Return a value as lists for JSON; arrays are appended to the blocks."""
    if value is None or isinstance(value, (bool, int, str)):
        return ["plain", value]
    if isinstance(value, float):
        return ["float", value.hex()]
    if isinstance(value, (np.ndarray, np.generic)):
        array = np.asarray(value)
        if array.dtype.kind not in "biufc":
            raise TypeError(f"cannot encode an array of {array.dtype}")
        begin = sum(map(len, blocks))
        data = np.ascontiguousarray(array)
        blocks.append(data.tobytes())
        kind = "array" if isinstance(value, np.ndarray) else "scalar"
        return [kind, data.dtype.str, list(array.shape), begin, data.nbytes]
    if isinstance(value, (tuple, list)):
        return [type(value).__name__, [_describe(item, blocks, keyed=keyed) for item in value]]
    if isinstance(value, Mapping):
        return ["dict", [[_describe(part, blocks, keyed=keyed) for part in pair] for pair in value.items()]]
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        made = type(value)
        left_out = getattr(made, "unkeyed", ()) if keyed else ()
        names = [field.name for field in dataclasses.fields(value) if field.name not in left_out]
        described = [[name, _describe(getattr(value, name), blocks, keyed=keyed)] for name in names]
        return ["object", made.__module__, made.__qualname__, described]
    raise TypeError(f"cannot encode a {type(value).__name__}")


def _restore(tree: list[Any], blocks: memoryview) -> Any:  # noqa: ANN401
    """Return the value that `_describe` described."""
    kind = tree[0]
    if kind == "plain":
        return tree[1]
    if kind == "float":
        return float.fromhex(tree[1])
    if kind in ("array", "scalar"):
        _, code, shape, begin, size = tree
        array = np.frombuffer(blocks[begin : begin + size], dtype=np.dtype(code)).reshape(shape).copy()
        return array if kind == "array" else array[()]
    if kind in ("tuple", "list"):
        items = [_restore(item, blocks) for item in tree[1]]
        return tuple(items) if kind == "tuple" else items
    if kind == "dict":
        return {_restore(key, blocks): _restore(value, blocks) for key, value in tree[1]}
    _, module, name, fields = tree
    if not module.startswith(PACKAGE):
        raise DamagedDataError(f"{module} is not part of this package")
    made = getattr(import_module(module), name)
    if not (isinstance(made, type) and dataclasses.is_dataclass(made)):
        raise DamagedDataError(f"{name} is not a dataclass")
    return made(**{field: _restore(value, blocks) for field, value in fields})
