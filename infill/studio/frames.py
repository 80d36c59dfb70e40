"""Frames: progress, answers, errors and meshes, one after another in one stream.

A frame of an answer over HTTP is the length of its payload (uint32), its kind (uint8) and the payload, little endian.
Between a worker and the server, the number of the request (uint32) stands before the payload.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

# Kinds that the page sees.
PROGRESS: Final = 1  # {"stage", "share"}
ANSWER: Final = 2
MESH: Final = 3  # a mesh pack: see `infill.viewer.packing`
ERROR: Final = 4  # {"message", "parameter"}
LAYER: Final = 5  # see `infill.studio.print_layers`
# Kinds between a worker and the server alone.
END: Final = 0  # nothing more of this request
PICTURE: Final = 6  # a PNG
FILE: Final = 7  # {"path", "name"} of a file to hand out
READY: Final = 8  # the worker has loaded what it needs

HTTP_HEAD = struct.Struct("<IB")
WORKER_HEAD = struct.Struct("<IBI")


@dataclass(frozen=True, kw_only=True)
class AnswerFrame:
    """One frame of a request.

    Parameters
    ----------
    kind : int
    payload : bytes
    request : int
        Number of the request; 0 for frames of none.
    """

    kind: int
    payload: bytes = b""
    request: int = 0

    @classmethod
    def of_json(cls, kind: int, value: Mapping[str, Any], request: int = 0) -> AnswerFrame:
        """Return a frame of plain values as JSON; numbers that are not finite become null."""
        return cls(kind=kind, payload=dump_json(value), request=request)

    def to_http(self) -> bytes:
        r"""Return the bytes of the frame in an answer over HTTP.

        >>> AnswerFrame(kind=PROGRESS, payload=b"{}").to_http()
        b'\x02\x00\x00\x00\x01{}'
        """
        return HTTP_HEAD.pack(len(self.payload), self.kind) + self.payload

    def to_server(self) -> bytes:
        """Return the bytes of the frame from a worker to the server."""
        return WORKER_HEAD.pack(len(self.payload), self.kind, self.request) + self.payload


def dump_json(value: object) -> bytes:
    """Return a value as JSON in UTF-8, with null for numbers that are not finite.

    >>> dump_json({"share": 0.5, "width": float("nan")})
    b'{"share":0.5,"width":null}'
    """
    try:
        text = json.dumps(value, allow_nan=False, separators=(",", ":"))
    except ValueError:
        text = json.dumps(_finite(value), separators=(",", ":"))
    return text.encode()


def _finite(value: object) -> object:
    """Return plain values with None in place of numbers that are not finite."""
    if isinstance(value, Mapping):
        return {name: _finite(item) for name, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and value - value != 0 else value
