"""Projects for PrusaSlicer: one object whose triangles are, in ranges, the part and a modifier.

The settings are those of the volumes alone: a print profile in the package would take the place of the user's own.
Both volumes differ in how they are filled and in nothing else, so that walls are made of the part as a whole.
"""

from __future__ import annotations

import html
from collections.abc import Mapping
from typing import IO, BinaryIO

import numpy as np

from infill.formats.parts import printable_name
from infill.formats.threemf import (
    XML_DECLARATION,
    Attachment,
    model_end,
    model_head,
    quote_attribute,
    write_mesh,
    write_package,
)
from infill.projects.project import INFILL, PART, Project

NAMESPACE = "http://schemas.slic3r.org/3mf/2017/06"
CONFIG = "Metadata/Slic3r_PE_model.config"
# At 0 % PrusaSlicer takes the part for a vase and makes no solid layers behind slopes and under domes; at 0.1 % it
# does.
# Lines would then be 450 mm apart, and a Hilbert curve of that size begins outside of the part, so that none is
# printed; other patterns print one or more a layer. Without an area of 0, room between walls counts as a small island,
# and is filled to the full.
PART_SETTINGS = {"fill_density": "0.1%", "fill_pattern": "hilbertcurve", "solid_infill_below_area": "0"}
INFILL_SETTINGS = {"fill_density": "100%", "fill_pattern": "concentric", "solid_infill_below_area": "0"}


def write(project: Project, file: BinaryIO) -> None:
    """Write a project for PrusaSlicer."""
    part, infill = project.part, project.infill

    def write_model(into: IO[bytes]) -> None:
        """Write the model: part and infill as one mesh."""
        # Without its version, the slicer takes the file for another program's, and moves only the first volume.
        metadata = {**project.metadata, "slic3rpe:Version3mf": "1"}
        into.write(model_head(metadata, {"slic3rpe": NAMESPACE}).encode())
        into.write(f'<object id="1" type="model" name={quote_attribute(printable_name(project.title))}>'.encode())
        write_mesh(
            into,
            np.concatenate([part.vertices, infill.vertices]),
            np.concatenate([part.faces, infill.faces + len(part.vertices)]),
        )
        into.write(b"</object>")
        into.write(model_end([1]).encode())

    config = Attachment(name=CONFIG, content=_volumes_config(project).encode(), media="application/xml")
    write_package(file, write_model, [*project.attached, config])


def _volumes_config(project: Project) -> str:
    """Write the ranges of triangles of both volumes; the infill comes last, as it takes the place of volumes before."""
    part_end = len(project.part.faces)
    infill_end = part_end + len(project.infill.faces)
    return "".join(
        [
            XML_DECLARATION,
            '<config>\n <object id="1" instances_count="1">\n',
            _row("object", "name", printable_name(project.title)),
            _volume(0, part_end - 1, PART, "ModelPart", PART_SETTINGS),
            _volume(part_end, infill_end - 1, INFILL, "ParameterModifier", {"modifier": "1", **INFILL_SETTINGS}),
            " </object>\n</config>\n",
        ]
    )


def _volume(first: int, last: int, name: str, kind: str, settings: Mapping[str, str]) -> str:
    """Return the XML of one volume, a range of triangles, with its settings."""
    rows = {"name": name, "volume_type": kind, **settings}
    return "".join(
        [
            f'  <volume firstid="{first}" lastid="{last}">\n',
            *(_row("volume", key, value) for key, value in rows.items()),
            "  </volume>\n",
        ]
    )


def _row(kind: str, key: str, value: str) -> str:
    """Return the XML of one setting of an object or a volume."""
    return f'   <metadata type="{kind}" key="{key}" value="{html.escape(value)}"/>\n'
