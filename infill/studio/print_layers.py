"""Layers of prints for a page: beads with speed and feature.

Little endian: b"IFL1", the length of the header as uint32, the header as JSON, padded with spaces to 4 bytes, then
float32 (n, 4), the ends x0, y0, x1, y1 of beads, mm; float32 (n,), speeds, mm/s; uint8 (n,), indices of features.
"""

from __future__ import annotations

import json
import os
from typing import Final

import numpy as np

from infill.planner.layer_speeds import PlannedLayers, plan_layers
from infill.studio.frames import LAYER, AnswerFrame

MAGIC: Final = b"IFL1"
MOST_MOVES: Final = 8_000_000


def plan_print(path: str | os.PathLike[str]) -> PlannedLayers:
    """Plan a print, of a size that fits into memory."""
    return plan_layers(path, most=MOST_MOVES)


def pack_layer(planned: PlannedLayers, number: int) -> bytes:
    """Return a layer of a print, counted from 1, as bytes.

    Raises
    ------
    ParameterError
        If there is no such layer.
    """
    pieces = planned.layer(number)
    rows = planned.steps.layer == number
    seconds = float((planned.plan.seconds[rows] + planned.steps.pause[rows]).sum())
    drawn = pieces.draws
    ends = np.concatenate([pieces.start[drawn, :2], pieces.end[drawn, :2]], axis=1).astype("<f4")
    names, indices = np.unique(pieces.role[drawn], return_inverse=True)
    header = {
        "beads": len(ends),
        "features": names.tolist(),
        "layer": number,
        "z": float(np.median(pieces.end[drawn, 2])) if len(ends) else None,
        "time_s": seconds,
    }
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 4)
    arrays = (ends.tobytes(), pieces.speed[drawn].astype("<f4").tobytes(), indices.astype(np.uint8).tobytes())
    return b"".join([MAGIC, len(text).to_bytes(4, "little"), text, *arrays])


def layer_frame(planned: PlannedLayers, number: int) -> AnswerFrame:
    """Return a layer of a print as a frame."""
    return AnswerFrame(kind=LAYER, payload=pack_layer(planned, number))
