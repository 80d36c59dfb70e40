"""One HTML page that shows sliced prints side by side, every line of filament in the colour of its speed.

`page/src/viewer/print.js` reads the data: b"IFP1", the length of the header as uint32, the header as JSON, padded with
spaces, and two arrays, whose offsets in the header count from its end:

places : (N, 6) uint16 as 12 planes of bytes
    x, y, z where a line begins, minus those where the line before it ends, and where it ends, minus those where it
    begins, in steps of 1/65535 of the bounds, modulo 2¹⁶, with 2 n for n and 2 n - 1 for -n.
speeds : (N,) uint8
    In steps of 1/255 of `top`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from infill.planner.layer_speeds import DrawnSpeeds
from infill.viewer.compact import fold_signs, split_bytes
from infill.viewer.packing import quantise
from infill.viewer.page import fill_page

MOST_LINES: Final = 300_000  # of one print in a page; of larger ones, not every layer is in it
FAST: Final = 99  # percentile of the speeds at which the scale of colours ends
WIDEST, NARROWEST = 3.0, 0.2  # mm, of lines as they are drawn

LAYER_CONTROLS: Final = """<h2>Layers</h2>
<label>Up to <input type="range" id="layer" min="1" aria-label="Last layer that is shown"></label>
<label><input type="checkbox" id="single">This layer alone</label>
<p><output id="shown" for="layer single"></output></p>
{note}<h2 id="speeds">Speed</h2>
<div class="scale" id="scale" role="img" aria-labelledby="speeds"></div>
<div class="ends"><span>0</span><span>{top:.0f} mm/s</span></div>
"""


def print_page(prints: Mapping[str, DrawnSpeeds], *, title: str, numbers: Sequence[tuple[str, str]] = ()) -> str:
    """Return a page that shows prints side by side, layer by layer, with one camera.

    Parameters
    ----------
    prints : mapping of str to DrawnSpeeds
        By caption.
    title : str
    numbers : sequence of (str, str)
        Names and values beside them.
    """
    stride = max(-(-len(drawn.speed) // MOST_LINES) for drawn in prints.values())
    top = max(float(np.percentile(drawn.speed, FAST)) for drawn in prints.values()) or 1.0
    note = f"<p>To keep the page small, one layer of {stride} is in it.</p>\n" if stride > 1 else ""
    captions = list(prints) if len(prints) > 1 else []
    return fill_page(
        title=title,
        settings={"kind": "print"},
        views={
            f"{title}, {caption}: {int(drawn.layer.max())} layers, coloured by speed": pack_print(
                thin_out(drawn, stride), top
            )
            for caption, drawn in prints.items()
        },
        controls=LAYER_CONTROLS.format(note=note, top=top),
        numbers=numbers,
        captions=captions,
    )


def thin_out(drawn: DrawnSpeeds, stride: int) -> DrawnSpeeds:
    """Return one layer of so many; what comes before the first layer belongs to it.

    Parameters
    ----------
    drawn : DrawnSpeeds
    stride : int
        1 returns every layer.
    """
    layer = np.maximum(drawn.layer, 1)
    kept = (layer - 1) % stride == 0
    return replace(drawn, start=drawn.start[kept], end=drawn.end[kept], speed=drawn.speed[kept], layer=layer[kept])


def pack_print(drawn: DrawnSpeeds, top: float) -> bytes:
    """Pack the lines of a print for a browser.

    Parameters
    ----------
    drawn : DrawnSpeeds
        Places move by half a step of 1/65535 of the bounds at most, along each axis.
    top : float
        mm/s, at which the scale of colours ends.
    """
    ends = np.nan_to_num(np.stack([drawn.start, drawn.end], axis=1).astype(np.float64)).reshape(-1, 3)
    low, size, steps = quantise(ends)
    whole = steps.astype(np.int32)
    before = np.vstack([np.zeros((1, 3), dtype=np.int32), whole[:-1]])
    places = split_bytes(fold_signs(whole - before))
    layers = _list_layers(drawn.layer, ends[1::2, 2])
    heights = np.diff([layer["z"] for layer in layers], prepend=0.0)
    height = float(np.median(heights[heights > 0])) if (heights > 0).any() else 0.2
    header = {
        "lines": len(drawn.speed),
        "low": low.tolist(),
        "size": size.tolist(),
        "layers": layers,
        "height": height,
        "width": float(np.clip(drawn.section / height, NARROWEST, WIDEST)),
        "top": top,
        "places": [0, len(places)],
        "speeds": [len(places), len(drawn.speed)],
    }
    text = json.dumps(header, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    speeds = np.clip(np.rint(drawn.speed * (255 / top)), 0, 255).astype(np.uint8)
    return b"".join([b"IFP1", len(text).to_bytes(4, "little"), text, places.tobytes(), speeds.tobytes()])


def _list_layers(layer: NDArray[np.int32], z: NDArray[np.float64]) -> list[dict[str, Any]]:
    """Return number, first line and height over the bed of every layer."""
    starts = np.flatnonzero(np.diff(layer, prepend=-1))
    stops = np.append(starts[1:], len(layer))
    return [
        {"number": int(layer[start]), "start": int(start), "z": round(float(np.median(z[start:stop])), 4)}
        for start, stop in zip(starts, stops, strict=True)
    ]
