"""Places where smoothing lost or added something, from reports, for the page to mark them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

CHANGES = ("lost", "added")  # lists of places in a verdict


def list_places(report: Mapping[str, Any]) -> list[dict[str, Any]]:
    """List the places of a report of one solid, or of all labels of a report of labels.

    Parameters
    ----------
    report : mapping
        Of `infill.smooth_volume`, `smooth_mesh` or `smooth_labels`.

    Returns
    -------
    list of dict
        "change" is "lost", "added" or "wall", a piece of wall that vanished; "at" is [x, y, z], mm; "text" says how
        much it is; "label" is the name of the label, or "".

    >>> verdict = {"lost": [{"at": [1.0, 2, 3], "area": 12.5, "distance": 4.0}], "added": []}
    >>> list_places({"verdict": verdict, "walls": {"lost": []}})
    [{'change': 'lost', 'at': [1.0, 2, 3], 'text': '12.5 mm², up to 4 mm away', 'label': ''}]
    """
    labels = report.get("labels")
    if labels is None:
        return list(_places(report, ""))
    return [place for label in labels for place in _places(label.get("report", label), label["name"])]


def _places(report: Mapping[str, Any], label: str) -> Iterator[dict[str, Any]]:
    """Yield the places of one solid."""
    from infill.plain_numbers import plain_size

    verdict = report.get("verdict", {})
    for change in CHANGES:
        for patch in verdict.get(change, ()):
            text = f"{plain_size(patch['area'], power=2)}, up to {plain_size(patch['distance'])} away"
            yield {"change": change, "at": list(patch["at"]), "text": text, "label": label}
    for piece in report.get("walls", {}).get("lost", ()):
        yield {"change": "wall", "at": list(piece["at"]), "text": f"{piece['voxels']:,} voxels", "label": label}
