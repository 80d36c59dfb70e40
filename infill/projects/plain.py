"""Projects of the core specification alone: the part and its infill are two objects, in place."""

from __future__ import annotations

from typing import IO, BinaryIO

from infill.formats.threemf import model_end, model_head, write_mesh, write_package
from infill.projects.project import INFILL, PART, Project


def write(project: Project, file: BinaryIO) -> None:
    """Write part and infill as two objects."""

    def write_model(stream: IO[bytes]) -> None:
        """Write the model: part and infill as two objects."""
        stream.write(model_head(project.metadata).encode())
        for number, name, surface in ((1, PART, project.part), (2, INFILL, project.infill)):
            stream.write(f'<object id="{number}" type="model" name="{name}">'.encode())
            write_mesh(stream, surface.vertices, surface.faces)
            stream.write(b"</object>\n")
        stream.write(model_end([1, 2]).encode())

    write_package(file, write_model, project.attached)
