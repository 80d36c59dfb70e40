"""The smoothed surface of a volume in chunks: its pieces, its field, its crumbs, and its report."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.chunks.hashing import add_up, face_sums
from infill.chunks.keeping import ResultFolder
from infill.chunks.layout import Chunk
from infill.chunks.placing import place_points
from infill.chunks.solving import MeasuredSurface, Numbering, Solver
from infill.chunks.tasks import ChunkTriangles, field_values, make_part
from infill.errors import GeometryError
from infill.formats.mesh_pieces import MeshPiece
from infill.kernels.sparse import BRICK
from infill.lazy.volume import LazyVolume
from infill.reports.common import GridKeys, Level, Topology, declare, report_head
from infill.reports.smoothing import (
    ChunkKeys,
    ChunksReport,
    ChunksSeconds,
    ChunksSimplified,
    ReplacedSmoothing,
    SegmentationKeys,
)
from infill.smoothing.chunk_plans import ChunkPlan
from infill.smoothing.chunked_simplified import SimplifiedSurface
from infill.smoothing.chunked_verdict import ChunkedVerdict
from infill.smoothing.comparing import verdict_facts
from infill.smoothing.levelling import CRUMB_CELLS, Crumbs, describe_cleaning, find_crumbs
from infill.smoothing.remedies import STRICT_ADVICE
from infill.smoothing.request import SmoothRequest
from infill.surface import Surface
from infill.volume import Volume

if TYPE_CHECKING:
    from infill.result import Progress

BATCH = 4  # pieces that wait to be written, for each worker
WRITING = 0.82  # share of the work that is done when pieces are written


@dataclass(kw_only=True, eq=False)
class ChunkedSurface:
    """The smoothed surface of a volume in chunks, while its fields are kept.

    Parameters
    ----------
    volume : LazyVolume
    request : SmoothRequest
        Lengths are in cells.
    plan : ChunkPlan
    solver : Solver
    surface : MeasuredSurface
    numbering : Numbering
    crumbs : Crumbs
    verdict : ChunkedVerdict
    level : (float, (b,) float64)
        The common level of phi, and that of each component.
    segmentation : SegmentationKeys
    noise : float
        See `infill.voxels.noise.noise_share`.
    grey : bool
        Whether grey values around the threshold were kept.
    specks : int
        Number of specks taken out of the data.
    seconds : dict
    tried, taken, instead_of
        See `infill.reports.smoothing.VerdictKeys`.
    """

    volume: LazyVolume
    request: SmoothRequest
    plan: ChunkPlan
    solver: Solver
    surface: MeasuredSurface
    numbering: Numbering
    crumbs: Crumbs
    verdict: ChunkedVerdict
    level: tuple[float, NDArray[np.float64]]
    segmentation: SegmentationKeys
    noise: float
    grey: bool
    specks: int
    enclosed: float
    target: float
    seconds: dict[str, float]
    progress: Progress | None = None
    tried: list[str] = field(default_factory=list)
    taken: str = ""
    instead_of: ReplacedSmoothing | None = None
    simplified: SimplifiedSurface | None = None
    _sums: list[NDArray[np.int64]] = field(default_factory=list)
    _corners: list[NDArray[np.float64]] = field(default_factory=list)
    _volumes: list[float] = field(default_factory=list)

    @property
    def vertices(self) -> int:
        """Number of vertices."""
        return self.all_vertices if self.simplified is None else self.simplified.vertices

    @property
    def triangles(self) -> int:
        """Number of triangles."""
        return self.all_triangles if self.simplified is None else self.simplified.triangles

    @property
    def all_vertices(self) -> int:
        """Number of vertices before it is simplified."""
        return int(self.numbering.first_vertices[-1])

    @property
    def all_triangles(self) -> int:
        """Number of triangles before it is simplified."""
        return int(self.numbering.first_faces[-1])

    def simplify(self, tolerance: float, folder: ResultFolder, tell: Callable[[float], None]) -> None:
        """Simplify the surface within a tolerance, mm; its fragments are kept in a folder."""
        self.simplified = SimplifiedSurface(
            solver=self.solver,
            surface=self.surface,
            numbering=self.numbering,
            tolerance=tolerance,
            folder=folder,
            place=self.volume.place(np.zeros((1, 1, 1), dtype=bool)),
            tell=tell,
        )
        self.simplified.simplify()

    def pieces(self) -> Iterator[MeshPiece]:
        """Yield the pieces of the surface, in space, in order; the report needs them all."""
        begin = time.perf_counter()
        self._sums.clear()
        self._corners.clear()
        self._volumes.clear()
        place = self.volume.place(np.zeros((1, 1, 1), dtype=bool))
        if self.simplified is not None:
            yield from self._simplified_pieces(self.simplified, place)
            self.seconds["write"] = time.perf_counter() - begin
            return
        chunks, number = self.numbering.chunks, 0
        batch = BATCH * self.plan.workers
        for first in range(0, len(chunks), batch):
            items = [
                (chunk, self.surface.tasks[chunk.number], self.numbering.removed[chunk.number])
                for chunk in chunks[first : first + batch]
            ]
            for part in self.solver.runner.run(make_part, self.solver.work, items, keep=False):
                yield self._piece(part, number, place)
                number += 1
                if self.progress is not None:
                    self.progress("write", WRITING + (1 - WRITING) * number / len(chunks))
        self.seconds["write"] = time.perf_counter() - begin

    def _piece(self, part: ChunkTriangles, number: int, place: Volume) -> MeshPiece:
        """Place a piece in space and give its vertices their numbers in the whole mesh."""
        own_count = len(part.vertices)
        points = place_points(np.concatenate([part.vertices, part.corners]), place)
        local = part.faces[:, ::-1] if place.mirrored else part.faces
        numbers = np.concatenate(
            [self.numbering.first_vertices[number] + np.arange(own_count), self.numbering.find(part.foreign)]
        )
        return self._placed_piece(points, local, own_count, numbers, place)

    def _simplified_pieces(self, simplified: SimplifiedSurface, place: Volume) -> Iterator[MeshPiece]:
        """Yield the pieces of the simplified surface, in space."""
        count = len(simplified.fragments)
        middle = np.array(self.plan.layout.shape) * np.array(self.solver.work.spacing) / 2
        for number, (points, faces, own_count, numbers) in enumerate(simplified.pieces()):
            a, b, c = (points[faces[:, corner]] - middle for corner in range(3))
            self._volumes.append(float(np.einsum("fk,fk->", a, np.cross(b, c))) / 6)
            local = faces[:, ::-1] if place.mirrored else faces
            yield self._placed_piece(place_points(points, place), local, own_count, numbers, place)
            if self.progress is not None:
                self.progress("write", WRITING + (1 - WRITING) * (number + 1) / count)

    def _placed_piece(
        self,
        points: NDArray[np.float64],
        local: NDArray[np.int64],
        own_count: int,
        numbers: NDArray[np.int64],
        place: Volume,
    ) -> MeshPiece:
        """Add a piece to the sums, and return it."""
        unit = float(place.cell_size.max()) ** 2
        self._sums.append(face_sums(points, local, unit))
        if own_count:
            self._corners.append(np.array([points[:own_count].min(axis=0), points[:own_count].max(axis=0)]))
        surface = Surface(vertices=points, faces=local.astype(np.int32), space=place.space)
        return MeshPiece(surface=surface, own=own_count, faces=numbers[local])

    def whole(self) -> Surface:
        """Return the whole surface, mm, in memory."""
        vertices, faces = [np.empty((0, 3))], [np.empty((0, 3), dtype=np.int64)]
        for piece in self.pieces():
            vertices.append(np.asarray(piece.surface.vertices[: piece.own], dtype=np.float64))
            faces.append(piece.faces)
        joined = np.concatenate(faces)
        kind = np.int32 if self.vertices < np.iinfo(np.int32).max else np.int64
        return Surface(vertices=np.concatenate(vertices), faces=joined.astype(kind), space=self.volume.space)

    def field_boxes(self) -> Iterator[tuple[tuple[slice, ...], NDArray[np.float32]]]:
        """Yield boxes of cells with the smoothed field in them: the distance from the surface, +-1 some cells away."""
        chunks = [chunk for chunk in self.solver.chunks.values() if chunk.has_cells]
        surfaced = self.solver.surfaced
        batch = BATCH * self.plan.workers
        for first in range(0, len(chunks), batch):
            batch_chunks = chunks[first : first + batch]
            crossed = [chunk for chunk in batch_chunks if chunk.number in surfaced]
            items = [(chunk, self.surface.level, self.surface.tasks[chunk.number]) for chunk in crossed]
            values = dict(
                zip(
                    [chunk.number for chunk in crossed],
                    self.solver.runner.run(field_values, self.solver.work, items, keep=False),
                    strict=True,
                )
            )
            for chunk in batch_chunks:
                box = tuple(
                    slice(part.start + low, part.stop + low)
                    for part, low in zip(chunk.own_cells, chunk.cell_low, strict=True)
                )
                shape = tuple(part.stop - part.start for part in box)
                yield box, values.get(chunk.number, np.full(shape, self._uniform_value(chunk), dtype=np.float32))

    def _uniform_value(self, chunk: Chunk) -> np.float32:
        """Return the value of the field in a chunk without surface."""
        sign = np.float32(1 if self.solver.smoothed[chunk.number].inside else -1)
        lowered = np.float32(0 if self.surface.levels is not None else self.surface.level)
        return np.clip(sign - lowered, np.float32(-1), np.float32(1))

    def check(self, in_vain: str = "") -> None:
        """Raise GeometryError for a result that is refused; `in_vain` lists the other ways that were tried.

        Raises
        ------
        GeometryError
            If much is lost; with `strict`, if anything broke, fused or vanished.
        """
        strict = self.request.strict
        reasons = self.verdict.differences.refused(strict=strict)
        if reasons and not self.request.allow_broken:
            advice = f"{STRICT_ADVICE}, or give --allow-broken" if strict else "give --allow-broken"
            raise GeometryError(f"{'; '.join(reasons)}{in_vain}; {advice} to have it anyway")

    def report(self) -> ChunksReport:
        """Return the report; the pieces are made for it unless they were made before."""
        if not self._sums:
            for _ in self.pieces():
                pass
        place = self.volume.place(np.zeros((1, 1, 1), dtype=bool))
        number, closed, area = add_up(self._sums, float(place.cell_size.max()) ** 2)
        corners = np.array(self._corners).reshape(-1, 2, 3)
        bounds = np.array([corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)])
        enclosed = self.enclosed if self.simplified is None else math.fsum(self._volumes)
        if self.simplified is not None:
            number = add_up(self.simplified.sums, float(place.cell_size.max()) ** 2)[0]
        change = enclosed / self.target - 1
        differences, topology, deviation = self.verdict.differences, self.verdict.topology, self.verdict.deviation
        cleaned = describe_cleaning(self.crumbs, self.specks, self.request)
        report: ChunksReport = {
            **report_head("chunks"),
            "triangles": self.triangles,
            "closed": closed,
            "area": area,
            "extents": (bounds[1] - bounds[0]).tolist(),
            "bounds": bounds.tolist(),
            "vertices": self.vertices,
            "hash": number,
            "volume": enclosed,
            "volume_change": change,
            "components": topology.result.components,
            "problems": [*differences.losses, *differences.problems],
            "verdict": {
                **verdict_facts(differences, deviation, deviation.cell, cleaned),
                "crumbs": self.crumbs.facts(),
                "tried": self.tried,
                "taken": self.taken,
                "instead_of": self.instead_of,
            },
            "request": self.request.facts(),
            "grid": self._grid_facts(),
            "input": {
                "name": self.volume.name,
                "segmentation": self.segmentation,
                "noise": self.noise,
                "grey": self.grey,
                "warnings": list(self.volume.warnings),
            },
            "solid": {
                "volume": self.enclosed,
                "change": self.enclosed / self.target - 1,
                "data": self.target,
                "level": self._level_facts(),
            },
            "topology": declare(Topology, {"data": asdict(topology.data), "result": asdict(topology.result)}),
            "chunks": self._chunk_facts(),
            "simplified": self._simplification(enclosed),
            "seconds": declare(ChunksSeconds, {**self.seconds, "total": sum(self.seconds.values())}),
        }
        return report

    def _level_facts(self) -> Level:
        """Return the levels of phi, for the report."""
        common, levels = self.level
        return {
            "method": "volume" if self.request.level == "volume" else "fixed",
            "common": common,
            "lowest": float(levels.min()),
            "highest": float(levels.max()),
            "components": len(levels),
        }

    def _simplification(self, enclosed: float) -> ChunksSimplified | None:
        """Return the effect of simplification, for the report; None without one."""
        if self.simplified is None:
            return None
        return {
            "triangles_before": self.all_triangles,
            "tolerance": self.simplified.tolerance,
            "volume_change": enclosed / self.enclosed - 1,
        }

    def _grid_facts(self) -> GridKeys:
        """Return the grid, for the report."""
        return {
            "shape": list(self.plan.layout.shape),
            "spacing": list(self.solver.work.spacing),
            "origin": list(self.volume.origin),
            "space": self.volume.space,
        }

    def _chunk_facts(self) -> ChunkKeys:
        """Return the sizes and the number of chunks, for the report."""
        layout = self.plan.layout
        return {
            "count": len(layout),
            "crossed": len(self.solver.surfaced),
            "cells": [bricks * size for bricks, size in zip(layout.size, BRICK, strict=True)],
            "margin": [bricks * size for bricks, size in zip(layout.margin, BRICK, strict=True)],
            "workers": self.plan.workers,
            "passes": self.solver.passes,
        }


def find_all_crumbs(
    solver: Solver, surface: MeasuredSurface, request: SmoothRequest
) -> tuple[Crumbs, NDArray[np.bool_]]:
    """Mark the shells that are crumbs: see `infill.smoothing.levelling.remove_crumbs`."""
    limit = CRUMB_CELLS * solver.cell_volume if request.crumbs is None else request.crumbs
    volume = surface.shells.volume
    small, marked = np.abs(volume) <= limit, np.zeros(len(volume), dtype=bool)
    assert solver.joined is not None
    if small.any() and not small[volume > 0].all():
        component, _ = solver.vote(surface)
        marked = find_crumbs(volume, component, solver.targets, limit, solver.cell_volume)
    return Crumbs(count=int(marked.sum()), volume=float(np.abs(volume[marked]).sum()), limit=limit), marked
