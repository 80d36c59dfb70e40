"""One HTML page that shows surfaces: it holds everything that it needs, and asks no other computer for anything."""

from __future__ import annotations

import base64
import html
import json
import zlib
from collections.abc import Callable, Mapping, Sequence
from importlib import resources
from typing import Any, Final

import numpy as np

from infill.imaging.label_tables import Colour
from infill.plain_numbers import count_noun, plain_size
from infill.surface import Surface
from infill.viewer.packing import bounds_solid, pack_surfaces

# By key of the report, a section's keys with a dot: the name of the row, and the text of the value.
ROWS: Final[Mapping[str, tuple[str, Callable[[Any], str]]]] = {
    "request.pattern": ("pattern", str),
    "density": ("density", lambda density: f"{density:.1%}"),
    "extents": ("size", lambda size: plain_size(*size, digits=4)),
    "volume": ("volume", lambda volume: plain_size(volume, digits=6, power=3)),
    "volume_change": ("volume, changed", lambda change: f"{change:+z.2%}"),
    "infill.cell": ("cell", lambda cell: plain_size(cell, digits=4)),
    "infill.line_width": ("line width", lambda width: plain_size(width, digits=4)),
    "wall_width.mean": ("wall width", plain_size),
    "walls.least": ("thinnest shell", plain_size),
    "components": ("components", lambda count: f"{count:,}"),
    "voids.count": ("voids", lambda count: f"{count:,}"),
    "drains.count": ("drains", lambda count: f"{count:,}"),
    "triangles": ("triangles", lambda count: f"{count:,}"),
    "closed": ("watertight", lambda closed: "yes" if closed else "no"),
    "verdict.word": ("verdict", str),
    "problems": ("problems", "; ".join),
}
# No address but those that the page makes itself.
POLICY: Final = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:"
KEYS: Final = (
    ("arrows", "turn"),
    ("Shift and arrows", "move"),
    ("+ and -", "come closer, go away"),
    ("F", "show everything"),
)
LEVEL: Final = 6  # of compression: the best, 9, takes ten times as long for 2 % less
SIDES: Final = {"corner": "Corner", "front": "Front", "right": "Right", "top": "Top"}

PAGE: Final = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<link rel="icon" href="data:,">
<title>{title}</title>
<style>{css}</style>
</head>
<body>
<header><h1>{title}</h1></header>
<main>
<div class="views">{views}</div>
<p class="message" role="alert" hidden></p>
<noscript><p class="message">The picture needs JavaScript.</p></noscript>
</main>
<aside aria-label="Controls and numbers">
{controls}
<div class="buttons" role="group" aria-label="Look from">{sides}</div>
{numbers}
<details><summary>Keys and pointer</summary>
<table>{keys}</table>
<p>Drag to turn, drag with Shift or the right button to move, turn the wheel or pinch to come closer.</p>
</details>
</aside>
<script type="application/json" id="settings">{settings}</script>
{data}
<script>{script}</script>
</body>
</html>
"""
CUT_CONTROLS: Final = """<fieldset class="surfaces" id="surfaces" hidden><legend><h2>Surfaces</h2></legend></fieldset>
<h2 id="cut">Cut open</h2>
<label>Across <select id="axis" aria-label="Cut across">
<option value="">nothing</option><option value="x">x</option><option value="y">y</option><option value="z">z</option>
</select></label>
<label><input type="range" id="at" aria-label="Place of the cut, mm" disabled>
<output id="place" for="at"></output></label>
"""


def surface_page(
    surfaces: Mapping[str, Surface],
    *,
    title: str,
    report: Mapping[str, Any] | None = None,
    colours: Mapping[str, Colour] | None = None,
    cut: str | None = None,
    hidden: Sequence[str] = (),
) -> str:
    """Return a page that shows surfaces, and the numbers of a report beside them.

    Parameters
    ----------
    surfaces : mapping of str to Surface, mm
    title : str
    report : mapping, optional
        Of the product that made them.
    colours : mapping of str to (red, green, blue), optional
        From 0 to 1, sRGB.
    cut : "x", "y" or "z", optional
        Across which axis they are cut open in the middle at first.
    hidden : sequence of str
        Names of surfaces that are not shown at first.
    """
    triangles = sum(len(surface.faces) for surface in surfaces.values())
    label = f"{title}: {describe_surfaces(triangles, len(surfaces))}"
    return fill_page(
        title=title,
        settings={"kind": "surfaces", "cut": cut, "hidden": list(hidden)},
        views={label: pack_surfaces(surfaces, colours=colours, compact=True)},
        controls=CUT_CONTROLS,
        numbers=list_numbers({"triangles": triangles} if report is None else report),
    )


def fill_page(
    *,
    title: str,
    settings: Mapping[str, Any],
    views: Mapping[str, bytes],
    controls: str,
    numbers: Sequence[tuple[str, str]],
    captions: Sequence[str] = (),
) -> str:
    """Return the page with its data.

    Parameters
    ----------
    title : str
    settings : mapping
        How the page shows its data; `kind` is "surfaces" or "print".
    views : mapping of str to bytes
        The data of every view, by a sentence about it.
    controls : str
        HTML.
    numbers : sequence of (str, str)
        Names and values.
    captions : sequence of str
        Titles over the views, if there are several.
    """
    bundle = resources.files("infill.viewer") / "bundle"
    heads = [f"<figcaption>{html.escape(caption)}</figcaption>" for caption in captions] or [""]
    figures = [
        f'<figure>{head}<div class="view" data-label="{html.escape(label)}" data-source="data{number}"></div></figure>'
        for number, (head, label) in enumerate(zip(heads, views, strict=True))
    ]
    data = [
        f'<script type="text/plain" id="data{number}">{_to_text(packed)}</script>'
        for number, packed in enumerate(views.values())
    ]
    buttons = [f'<button type="button" data-side="{side}">{name}</button>' for side, name in SIDES.items()]
    return PAGE.format(
        policy=POLICY,
        title=html.escape(title),
        css=(bundle / "page.css").read_text(encoding="utf-8"),
        views="".join(figures),
        controls=controls,
        sides="".join(buttons),
        numbers=_table(numbers),
        keys="".join(f"<tr><th scope=row><kbd>{key}</kbd></th><td>{does}</td></tr>" for key, does in KEYS),
        settings=json.dumps(settings),
        data="\n".join(data),
        script=(bundle / "viewer.js").read_text(encoding="utf-8").replace("</script", "<\\/script"),
    )


def _to_text(packed: bytes) -> str:
    """Return bytes compressed, in base64."""
    return base64.b64encode(zlib.compress(packed, LEVEL)).decode()


def _table(numbers: Sequence[tuple[str, str]]) -> str:
    """Return rows of names and values as a table; nothing without rows."""
    if not numbers:
        return ""
    rows = [f"<tr><th scope=row>{html.escape(name)}</th><td>{html.escape(value)}</td></tr>" for name, value in numbers]
    return f'<h2 id="numbers">Numbers</h2><table aria-labelledby="numbers">{"".join(rows)}</table>'


def embed_page(page: str, height: int = 560) -> str:
    """Return a page as a frame for a notebook; it can reach nothing of the notebook."""
    return (
        f'<iframe srcdoc="{html.escape(page)}" title="3D view" sandbox="allow-scripts" loading="lazy" '
        f'style="width:100%;height:{height}px;border:0"></iframe>'
    )


def measure_surface(surface: Surface) -> dict[str, Any]:
    """Return the numbers of a surface that no product has made, by the keys of reports; the volume if it is closed."""
    if not len(surface.faces):
        return {"triangles": 0}
    closed = bounds_solid(surface)
    volume = {"volume": abs(surface.volume)} if closed else {}
    return {
        "extents": np.ptp(surface.bounds, axis=0).tolist(),
        **volume,
        "triangles": len(surface.faces),
        "closed": closed,
    }


def list_numbers(report: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return the rows of a page: names and values of those numbers that a report has.

    >>> list_numbers({"triangles": 1200, "density": 0.2, "problems": [], "closed": True})
    [('density', '20.0%'), ('triangles', '1,200'), ('watertight', 'yes')]
    """
    rows = []
    for key, (name, text) in ROWS.items():
        value: Any = report
        for part in key.split("."):
            value = value.get(part) if isinstance(value, Mapping) else None
        if value is not None and value != []:
            rows.append((name, text(value)))
    return rows


def describe_surfaces(triangles: int, surfaces: int) -> str:
    """Return a sentence about a picture, for those who cannot see it.

    >>> describe_surfaces(1200, 1)
    '1,200 triangles'
    >>> describe_surfaces(1200, 3)
    '3 surfaces, 1,200 triangles'
    """
    counted = f"{triangles:,} triangles"
    return counted if surfaces == 1 else f"{count_noun(surfaces, 'surface')}, {counted}"
