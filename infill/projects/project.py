"""The contents of a project for a slicer."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

from infill.formats.threemf import APPLICATION, SETTINGS_PATH, Attachment
from infill.surface import Surface

Slicer = Literal["prusaslicer", "orcaslicer", "bambustudio", "cura", "plain"]
SLICERS: tuple[Slicer, ...] = get_args(Slicer)
NAMES = {
    "prusaslicer": "PrusaSlicer",
    "orcaslicer": "OrcaSlicer",
    "bambustudio": "Bambu Studio",
    "cura": "Cura",
    "plain": "any slicer",
}
THUMBNAIL = "Metadata/thumbnail.png"
THUMBNAIL_RELATION = "http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail"
SETTINGS_RELATION = "http://schemas.phasefill.org/package/2026/settings"
PART, INFILL = "part", "infill"  # names of part and infill, as slicers list them


@dataclass(frozen=True, kw_only=True, eq=False)
class Project:
    """A part and its infill, for a slicer.

    Parameters
    ----------
    part : Surface, mm
    infill : Surface, mm
        A body inside the part; walls, bottoms and tops are the slicer's own.
    title : str
    thumbnail : bytes, optional
        A PNG.
    settings : str
        TOML from which ``infill fill --config`` makes the project again; empty for none.
    """

    part: Surface
    infill: Surface
    title: str = "part"
    thumbnail: bytes | None = None
    settings: str = ""

    @property
    def metadata(self) -> dict[str, str]:
        """Metadata that every model has."""
        return {"Title": self.title, "Application": APPLICATION, "Description": f"filled by {APPLICATION}"}

    @property
    def attached(self) -> list[Attachment]:
        """Files that go into the package of every slicer."""
        files = []
        if self.thumbnail is not None:
            files.append(
                Attachment(name=THUMBNAIL, content=self.thumbnail, media="image/png", relation=THUMBNAIL_RELATION)
            )
        if self.settings:
            files.append(
                Attachment(
                    name=SETTINGS_PATH,
                    content=self.settings.encode(),
                    media="application/toml",
                    relation=SETTINGS_RELATION,
                )
            )
        return files
