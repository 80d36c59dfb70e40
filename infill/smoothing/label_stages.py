"""A label to smooth, and the stages of a run over labels."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from infill.imaging.label_tables import Segment
from infill.smoothing.attempt import bytes_per_surface_cell
from infill.smoothing.label_runs import LabelWork
from infill.smoothing.request import SmoothRequest
from infill.voxels.labels import LabelExtent

if TYPE_CHECKING:
    from PIL import Image

    from infill.reports.smoothing import LabelName
    from infill.surface import Surface

# Cells around a label in which phi is not yet void to the last bit: 12 with the usual interface of 2 cells, that is 6
# interfaces; and 8 more, for the averages of refining.
REACH_IN_INTERFACES, REFINING_MARGIN = 6, 8
FACES_PER_RUN = 6  # of cells: two along each of three axes


@dataclass(frozen=True, kw_only=True, eq=False)
class LabelStages:
    """The stages of `infill.smooth_labels`.

    Parameters
    ----------
    segments : mapping of str to Segment
        The label that each surface, by its name, was made from.
    failed : mapping of str to str
        Why a label has no surface, by its name.
    """

    segments: Mapping[str, Segment]
    failed: Mapping[str, str] = field(default_factory=dict)

    def picture(self, surface: Surface, report: Mapping[str, Any]) -> Image.Image:
        """Return all labels as one picture."""
        from infill.pictures.sheet import arrange_panels, draw_mesh_panel

        caption = f"{len(report['labels'])} labels, {report['triangles']:,} triangles"
        return arrange_panels({caption: draw_mesh_panel(surface)}, "")


@dataclass(frozen=True, kw_only=True)
class LabelPiece:
    """One label to smooth: its name, its segment, and its place."""

    name: str
    segment: Segment
    extent: LabelExtent

    @property
    def triangles(self) -> int:
        """Triangles of its surface before it is simplified, about: two for each face of a cell."""
        return 2 * FACES_PER_RUN * self.extent.runs

    @property
    def place(self) -> LabelName:
        """Its name, number and layer."""
        return {"name": self.name, "number": self.segment.value, "layer": self.segment.layer}

    def work(self, request: SmoothRequest) -> LabelWork:
        """Estimate the work of smoothing it."""
        cells = FACES_PER_RUN * self.extent.runs
        return LabelWork(cells=cells, memory=cells * bytes_per_surface_cell(request))


def field_reach(interface: float) -> int:
    """Return the distance from a label beyond which its field is void to the last bit, cells, for an interface."""
    return math.ceil(REACH_IN_INTERFACES * interface) + REFINING_MARGIN
