"""The components of an uploaded scan or mesh, for the page to keep or drop: as `keep_components` counts them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from infill.surface import Surface

if TYPE_CHECKING:
    from infill.studio.reading import Content

MOST_LISTED = 12  # pieces that are listed; the smaller ones are kept or dropped together
MOST_OF_MESH = 200  # components of a mesh, for which the search takes longer
RULE = ("threshold", "between", "label", "otsu")  # what decides the solid of a scan
KEPT = "pieces"


def list_pieces(content: Content, choice: Mapping[str, Any]) -> dict[str, Any] | None:
    """List the largest components before smoothing; None if there are too many to tell, or it is one.

    Parameters
    ----------
    content : Content
        Pieces are kept there until the rule for what is solid changes.
    choice : mapping
        Arguments of `infill.smoothing.sources.smooth_source`.

    Returns
    -------
    dict or None
        "count", and "volumes" (mm³) and "places" ([x, y, z], mm, a point on each) of the largest; "rest" is the volume
        of all others together.
    """
    is_mesh = isinstance(content.data, Surface)
    rule = () if is_mesh else tuple(repr(choice.get(name)) for name in RULE)
    if KEPT not in content.kept or content.kept[KEPT][0] != rule:
        content.kept[KEPT] = (rule, _find_pieces(content, choice))
    pieces: dict[str, Any] | None = content.kept[KEPT][1]
    return pieces


def _find_pieces(content: Content, choice: Mapping[str, Any]) -> dict[str, Any] | None:
    """Find the pieces that `list_pieces` returns."""
    from infill.smoothing.kept_components import find_mesh_components, find_scan_components
    from infill.smoothing.sources import split_options

    components: Any
    if isinstance(content.data, Surface):
        if not 1 < content.facts["part"]["components"] <= MOST_OF_MESH:
            return None
        components = find_mesh_components(content.data)
    else:
        rule: Any = {name: choice.get(name) for name in RULE}
        arguments, _ = split_options(content.data, rule)
        components = find_scan_components(content.data, **arguments)
    volumes = components.volumes
    if len(volumes) < 2:
        return None
    return {
        "count": len(volumes),
        "volumes": volumes[:MOST_LISTED].tolist(),
        "places": [components.place(number) for number in range(min(MOST_LISTED, len(volumes)))],
        "rest": float(np.sum(volumes[MOST_LISTED:])),
    }
