"""Projects for Bambu Studio and OrcaSlicer: an object whose components are the part and a modifier.

Each of the two keeps the settings of objects only from files that name it, or Bambu Studio, as their application; the
description says what wrote them.
"""

from __future__ import annotations

import html
from collections.abc import Mapping
from functools import partial
from typing import IO, BinaryIO

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

NAMESPACE = "http://schemas.bambulab.com/package/2021"
CONFIG, INFO = "Metadata/model_settings.config", "Metadata/slice_info.config"
BAMBU, ORCA = "BambuStudio-02.00.00.00", "OrcaSlicer-2.0.0"
# As for PrusaSlicer, from which both come: 0 % means a vase, without solid layers behind slopes.
PART_SETTINGS = {
    "sparse_infill_density": "0.1%",
    "sparse_infill_pattern": "hilbertcurve",
    "minimum_sparse_infill_area": "0",
}
INFILL_SETTINGS = {
    "sparse_infill_density": "100%",
    "sparse_infill_pattern": "concentric",
    "minimum_sparse_infill_area": "0",
}
PART_ID, INFILL_ID, WHOLE_ID = 1, 2, 3
MATRIX = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"


def write(project: Project, file: BinaryIO, *, application: str = BAMBU) -> None:
    """Write a project for Bambu Studio, or for another program that keeps the settings of files from an application."""

    def write_model(stream: IO[bytes]) -> None:
        """Write the model: part and infill as components of one object."""
        metadata = {**project.metadata, "Application": application, "BambuStudio:3mfVersion": "1"}
        stream.write(model_head(metadata, {"BambuStudio": NAMESPACE}).encode())
        for number, surface in ((PART_ID, project.part), (INFILL_ID, project.infill)):
            stream.write(f'<object id="{number}" type="model">'.encode())
            write_mesh(stream, surface.vertices, surface.faces)
            stream.write(b"</object>\n")
        components = "".join(f'<component objectid="{number}"/>' for number in (PART_ID, INFILL_ID))
        name = quote_attribute(printable_name(project.title))
        stream.write(
            f'<object id="{WHOLE_ID}" type="model" name={name}><components>{components}</components></object>'.encode()
        )
        stream.write(model_end([WHOLE_ID]).encode())

    settings = Attachment(name=CONFIG, content=_settings_config(project).encode(), media="application/xml")
    version = application.rpartition("-")[2]
    info = Attachment(name=INFO, content=_info(version).encode(), media="application/xml")
    write_package(file, write_model, [*project.attached, settings, info])


write_orcaslicer = partial(write, application=ORCA)


def _settings_config(project: Project) -> str:
    """Return model_settings.config: the part, and the infill as its modifier, on one plate."""
    title = printable_name(project.title)
    return "".join(
        [
            XML_DECLARATION,
            f'<config>\n <object id="{WHOLE_ID}">\n',
            _row("name", title),
            _row("extruder", "1"),
            _part(PART_ID, PART, "normal_part", PART_SETTINGS),
            _part(INFILL_ID, INFILL, "modifier_part", {"extruder": "0", **INFILL_SETTINGS}),
            " </object>\n <plate>\n",
            _row("plater_id", "1"),
            _row("plater_name", ""),
            _row("locked", "false"),
            "  <model_instance>\n",
            _row("object_id", str(WHOLE_ID)),
            _row("instance_id", "0"),
            "  </model_instance>\n </plate>\n</config>\n",
        ]
    )


def _part(number: int, name: str, kind: str, settings: Mapping[str, str]) -> str:
    """Return the XML of one part with its settings."""
    rows = {"name": name, "matrix": MATRIX, **settings}
    return "".join(
        [
            f'  <part id="{number}" subtype="{kind}">\n',
            *(_row(key, value) for key, value in rows.items()),
            "  </part>\n",
        ]
    )


def _info(version: str) -> str:
    """Return slice_info.config, which states the version of the slicer."""
    client = {"X-BBL-Client-Type": "slicer", "X-BBL-Client-Version": version}
    items = "".join(f'  <header_item key="{key}" value="{value}"/>\n' for key, value in client.items())
    return f"{XML_DECLARATION}<config>\n <header>\n{items} </header>\n</config>\n"


def _row(key: str, value: str) -> str:
    """Return the XML of one setting."""
    return f'   <metadata key="{key}" value="{html.escape(value)}"/>\n'
