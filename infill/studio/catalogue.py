"""The offer of the studio: products with their options, materials, slicers, and patterns with pictures and facts."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any, get_args

from infill.errors import escape_unprintable
from infill.version import __version__

GALLERY_PLACES = (
    Path(__file__).parent / "gallery",  # in a wheel
    Path(__file__).parents[2] / "docs" / "pictures" / "gallery",  # in the sources
)
FACTS = "facts.json"
# Names that are not written as their words are; longer names begin with some of them.
WRITTEN = {
    "bcc": "BCC",
    "fcc": "FCC",
    "fischer-koch-s": "Fischer-Koch S",
    "i-wp": "I-WP",
    "schwarz-d": "Schwarz D",
    "schwarz-p": "Schwarz P",
    "tri-hexagon": "Tri-hexagon",
}


def describe_studio(limits: dict[str, float], opened: str | None) -> dict[str, Any]:
    """Return the abilities of the studio, as plain values."""
    from infill.lattices.settings import Slicer
    from infill.studio.numbers import MATERIALS
    from infill.studio.products import PRODUCTS, describe_product

    return {
        "version": __version__,
        "limits": limits,
        "products": {name: describe_product(name) for name in PRODUCTS},
        "materials": [{"name": name, "density": density} for name, density in MATERIALS.items()],
        "slicers": list(get_args(Slicer)),
        "file": None if opened is None else {"name": escape_unprintable(opened)},
    }


def find_gallery() -> Path | None:
    """Return the folder of pictures and facts of patterns, if it is installed."""
    return next((place for place in GALLERY_PLACES if (place / FACTS).is_file()), None)


@cache
def gallery_facts() -> dict[str, dict[str, float]]:
    """Return the measured facts of patterns by name; docs/gallery.md explains them."""
    folder = find_gallery()
    return {} if folder is None else json.loads((folder / FACTS).read_text(encoding="utf-8"))


def describe_patterns() -> list[dict[str, Any]]:
    """Return all patterns with facts and parameters, as plain values."""
    from infill.studio.option_forms import describe_parameters
    from patterns import PATTERNS, Cells

    described = []
    for name, kind in PATTERNS.items():
        in_space = issubclass(kind, Cells) or not kind.prismatic
        described.append(
            {
                "name": name,
                "title": write_title(name),
                "sentence": kind.summary,
                "kind": "in space" if in_space else "upright",
                "products": find_products(name),
                "facts": gallery_facts().get(name, {}),
                "parameters": describe_parameters(kind),
                "picture": f"api/patterns/{name}.png",
            }
        )
    return described


def write_title(name: str) -> str:
    """Write the name of a pattern as a title.

    >>> [write_title(name) for name in ("cubic-bars", "schwarz-d-network", "cross-3d", "i-wp")]
    ['Cubic bars', 'Schwarz D network', 'Cross 3D', 'I-WP']
    """
    known = next((known for known in WRITTEN if f"{name}-".startswith(f"{known}-")), "")
    title = WRITTEN.get(known, "") + name.removeprefix(known).replace("-", " ")
    return (title[:1].upper() + title[1:]).replace(" 3d", " 3D")


def find_products(name: str) -> list[str]:
    """Return the products that take a pattern."""
    from infill.errors import InfillError
    from infill.options.resolve_pattern import resolve_pattern
    from infill.refilling.placement import resolve_paths
    from patterns import PatternError

    products = []
    for product in ("fill", "make", "refill"):
        try:
            if product == "refill":
                resolve_paths(name, {})
            else:
                resolve_pattern(name, product)
        except (InfillError, PatternError):
            continue
        products.append(product)
    return products


def draw_pattern(name: str) -> bytes | None:
    """Return the picture of a pattern as a PNG; None if there is no such pattern."""
    from patterns import PATTERNS, Cells

    if name not in PATTERNS:
        return None
    folder = find_gallery()
    picture = None if folder is None else folder / f"{name}.png"
    if picture is not None and picture.is_file():
        return picture.read_bytes()
    from io import BytesIO

    from infill.pictures.drawing import write_drawing

    kind, file = PATTERNS[name], BytesIO()
    if issubclass(kind, Cells) or not kind.prismatic:
        return None
    write_drawing(kind(), file)
    return file.getvalue()
