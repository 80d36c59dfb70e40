"""What a filled part has in a region, in the words of summaries and captions."""

from __future__ import annotations

from infill.plain_numbers import plain_number
from infill.reports.filling import FillRegion, FillRequest


def describe_region(region: FillRegion, request: FillRequest) -> str:
    """Describe a region: its density, its pattern and its wall, where these are not those of the part."""
    words = [f"{region['density']:.1%}"]
    if region["pattern"] is not None and region["pattern"] != request["pattern"]:
        words.append(region["pattern"])
    words.append("elsewhere" if region["place"] == "rest" else f"in {region['place']}")
    if region["least"] is not None:
        words.append(f"with a wall of {plain_number(region['least'])} mm")
    return " ".join(words)
