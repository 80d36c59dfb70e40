"""Check whether a mesh is printable and, if not, why."""

from __future__ import annotations

import os
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError
from infill.formats.mesh_files import read_mesh
from infill.imaging.units import STATED_UNITS, guess_unit
from infill.meshes import solids
from infill.meshes.flat_triangles import find_flat_triangles
from infill.meshes.intersections import count_self_intersections
from infill.meshes.merging import WholeMesh, merge_unless_closed, merge_vertices, surface_of
from infill.meshes.sealed_voids import count_sealed_voids
from infill.meshes.shells import vertex_components
from infill.plain_numbers import count_noun, plain_size
from infill.reports.checking import CheckReport
from infill.reports.common import declare
from infill.surface import Edges, Surface

if TYPE_CHECKING:
    import trimesh


@dataclass(frozen=True, kw_only=True)
class Inspection:
    """Result of `check`.

    The attributes are the keys of `infill.reports.checking.CheckReport`, which docs/report.md explains; lengths are in
    the unit of the file, or in mm if the file states its unit.
    """

    printable: bool
    problems: tuple[str, ...]
    warnings: tuple[str, ...]
    triangles: int
    components: int
    closed: bool
    outward: bool
    sealed_voids: int | None
    open_edges: int
    manifold: str
    self_intersections: int
    degenerate: int
    duplicate: int
    volume: float
    area: float
    extents: list[float]
    bounds: list[list[float]]
    unit_guess: str

    def __repr__(self) -> str:
        """Return the verdict with its reasons and the size."""
        reasons = "; ".join((*self.problems, *self.warnings))
        verdict = f"{'printable' if self.printable else 'not printable'}{': ' if reasons else ''}{reasons}"
        return f"Inspection({verdict}; {self.triangles:,} triangles, {plain_size(*self.extents, digits=4)})"

    def to_dict(self) -> CheckReport:
        """Return plain numbers and strings, as ``--json`` prints them."""
        return declare(CheckReport, asdict(self))


def check(mesh: str | os.PathLike[str] | trimesh.Trimesh | Surface | WholeMesh) -> Inspection:
    """Inspect a mesh, the file of one, or a result of `make`, `smooth_mesh`, `fill` and the others.

    Raises
    ------
    FormatError
        If the file cannot be read.

    Notes
    -----
    Printable means closed, facing outwards, accepted by manifold3d, and without duplicate triangles. Degenerate
    triangles, parts of a mesh that pass through each other, sealed voids and an unlikely size are warnings: slicers
    drop the first, print the union of the second and the third as they are, and take the last at face value.
    """
    stated = False
    if isinstance(mesh, (str, os.PathLike)):
        read = read_mesh(mesh)
        notes = read.notes
        stated = Path(mesh).suffix.lower() in STATED_UNITS
    else:
        surface_given = surface_of(mesh)
        read = merge_unless_closed(surface_given.vertices, surface_given.faces)
        notes = surface_given.notes
    collapsed = (read.faces == np.roll(read.faces, 1, axis=1)).any(axis=1)
    if collapsed.all():
        raise FormatError("the mesh has no triangle of three different corners; export it again")
    surface = Surface(vertices=read.vertices, faces=read.faces[~collapsed])
    flat = find_flat_triangles(surface.vertices, surface.faces)
    if flat.all():
        raise FormatError("the mesh has no triangle with an area; export it again")
    merged_surface = merge_vertices(surface.vertices, surface.faces[~flat])
    duplicate = len(merged_surface.faces) - len(np.unique(np.sort(merged_surface.faces, axis=1), axis=0))
    crossings = count_self_intersections(merged_surface.vertices, merged_surface.faces)
    open_edges = int((Edges.of(surface.faces).faces != 2).sum())
    names, components = vertex_components(surface.faces, len(surface.vertices))
    outward = _faces_outwards(surface, names[surface.faces[:, 0]])
    sealed = count_sealed_voids(surface) if surface.closed else None
    status = solids.manifold_status(surface, single=True)
    degenerate = int(collapsed.sum() + flat.sum())
    bounds = surface.bounds
    extents = bounds[1] - bounds[0]
    unit = "mm" if stated else guess_unit(float(extents.max()))
    problems = {
        f"{count_noun(open_edges, 'edge')} without exactly two faces: the mesh is not closed": open_edges,
        "neighbouring faces disagree about which side is out": not open_edges and not surface.closed,
        "the mesh is inside out": surface.closed and not outward,
        f"manifold3d rejects the mesh: {status}": surface.closed and status != "NoError",
        f"{count_noun(duplicate, 'duplicate triangle')}": duplicate,
    }
    warnings = {
        **dict.fromkeys(notes, True),
        f"{count_noun(crossings, 'pair')} of triangles that pass through each other": crossings,
        f"{count_noun(degenerate, 'triangle')} without an area": degenerate,
        f"{count_noun(sealed or 0, 'sealed cavity', 'sealed cavities')}, in which resin and powder stay": sealed,
        f"the size suggests that the unit is {unit}, not mm": unit != "mm",
    }
    return Inspection(
        printable=not any(problems.values()),
        problems=tuple(text for text, holds in problems.items() if holds),
        warnings=tuple(text for text, holds in warnings.items() if holds),
        triangles=len(read.faces),
        components=components,
        closed=surface.closed,
        outward=outward,
        sealed_voids=sealed,
        open_edges=open_edges,
        manifold=status,
        self_intersections=crossings,
        degenerate=degenerate,
        duplicate=duplicate,
        volume=surface.volume,
        area=surface.area,
        extents=extents.tolist(),
        bounds=bounds.tolist(),
        unit_guess=unit,
    )


def _faces_outwards(surface: Surface, component: NDArray[np.integer]) -> bool:
    """Tell whether the mesh as a whole faces outwards, and all components facing inwards are cavities of others."""
    corners = surface.vertices[surface.faces] - surface.vertices.mean(axis=0)
    sixfold = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
    volume = np.bincount(component, weights=sixfold)
    if volume.sum() <= 0:
        return False
    solid = corners[volume[component] > 0]
    inward = np.flatnonzero(volume <= 0)
    first_face = np.unique(component, return_index=True)[1]
    return all(_winding_number(corners[first_face[i]].mean(axis=0), solid) > 0.5 for i in inward)


def _winding_number(point: NDArray[np.floating], corners: NDArray[np.floating]) -> float:
    """Count the windings of closed surfaces (F, 3, 3) around a point: their solid angles, summed, over 4 pi."""
    a, b, c = (corners[:, i] - point for i in range(3))
    length_a, length_b, length_c = (np.linalg.norm(vector, axis=1) for vector in (a, b, c))
    above = np.einsum("ij,ij->i", a, np.cross(b, c))
    dots = (np.einsum("ij,ij->i", p, q) * r for p, q, r in ((a, b, length_c), (b, c, length_a), (c, a, length_b)))
    return float(np.arctan2(above, length_a * length_b * length_c + sum(dots)).sum() / (2 * np.pi))
