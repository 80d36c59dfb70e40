"""Projects for Cura: a group of two objects, whose settings stand in the model itself."""

from __future__ import annotations

from collections.abc import Mapping
from typing import IO, BinaryIO

from infill.formats.parts import printable_name
from infill.formats.threemf import model_end, model_head, quote_attribute, write_mesh, write_package
from infill.projects.project import INFILL, PART, Project

NAMESPACE = "http://software.ultimaker.com/xml/cura/3mf/2015/10"
PART_SETTINGS = {"infill_sparse_density": "0"}
# One line along each side and lines between them, which Cura's engine extrudes to within 5 % of the body's volume;
# without lines along the sides, concentric infill of thin walls comes out half as much again.
INFILL_SETTINGS = {
    "infill_mesh": "True",
    "infill_mesh_order": "1",
    "infill_sparse_density": "100",
    "infill_pattern": "lines",
    "wall_line_count": "1",
    "top_layers": "0",
    "bottom_layers": "0",
}


def write(project: Project, file: BinaryIO) -> None:
    """Write a project for Cura."""

    def write_model(stream: IO[bytes]) -> None:
        """Write the model: part and infill with their settings."""
        stream.write(model_head(project.metadata, {"cura": NAMESPACE}).encode())
        volumes = ((1, PART, project.part, PART_SETTINGS), (2, INFILL, project.infill, INFILL_SETTINGS))
        for number, name, surface, settings in volumes:
            stream.write(f'<object id="{number}" type="model" name="{name}">{_group(settings)}'.encode())
            write_mesh(stream, surface.vertices, surface.faces)
            stream.write(b"</object>\n")
        name = quote_attribute(printable_name(project.title))
        components = '<component objectid="1"/><component objectid="2"/>'
        stream.write(f'<object id="3" type="model" name={name}><components>{components}</components></object>'.encode())
        stream.write(model_end([3]).encode())

    write_package(file, write_model, project.attached)


def _group(settings: Mapping[str, str]) -> str:
    """Return the XML of Cura's settings of an object."""
    rows = "".join(f'<metadata name="cura:{key}" preserve="1">{value}</metadata>' for key, value in settings.items())
    return f"<metadatagroup>{rows}</metadatagroup>"
