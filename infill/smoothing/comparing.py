"""The verdict on a result: kept, changed a little or lost, and the phrases that say why."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.inspection.fidelity import COUNTS, HIDDEN, SHEET, THIN, Fidelity, Kinds, Word
from infill.isosurfaces.components import data_bits, look_up_cells, open_by_blocks
from infill.voxels.noise import NOISY

if TYPE_CHECKING:
    from infill.inspection.bricks import TopologyCheck
    from infill.phasefield.sparse import SparseField
    from infill.smoothing.request import SmoothInput

SIDE_OFFSET = 5e-5  # cells: distance from a face at which solid is looked for
SLIT_WIDTH = 1.0  # cells: a slit as narrow as this may close
# Of a scan: features thinner than this, in voxels, may vanish. Noise makes specks and pits of two and more by chance.
THICK, THICK_IN_NOISE = 2, 4
MIN_CAP_SHARE = 0.001  # of the area: caps smaller than this are not mentioned


@dataclass(frozen=True, kw_only=True)
class Differences:
    """The verdict on a result, and its reasons, one phrase each.

    Parameters
    ----------
    word : {"kept", "changed a little", "lost"}
    losses : tuple of str
        Features that are lost.
    problems : tuple of str
        Parts that broke, fused, opened or vanished, however small.
    remarks : tuple of str
        All other differences from the input.
    """

    word: Word
    losses: tuple[str, ...]
    problems: tuple[str, ...]
    remarks: tuple[str, ...]


def place_classifier(smooth_input: SmoothInput, field: SparseField, *, threads: int | None = None) -> Kinds:
    """Return the function that classifies points of the input: those that count as lost, and those that do not.

    Of a mesh, points with solid on one side count; those inside the solid, and on sheets without thickness, do not.
    Slits narrower than a cell have a class of their own. Of voxels, points between solid and void more than one cell
    thick count; the equation removes walls one cell thick, which have a class of their own.
    """
    if smooth_input.enclosed is not None:
        enclosed, mesh = smooth_input.enclosed, smooth_input.reference
        assert mesh is not None

        def bounding(points: NDArray[np.float64], faces: NDArray[np.integer]) -> NDArray[np.integer]:
            outside, inside, narrow = (
                enclosed.solid_beside(mesh, points, faces, offset, threads=threads)
                for offset in (SIDE_OFFSET, -SIDE_OFFSET, SLIT_WIDTH)
            )
            sides = np.where(inside & outside, HIDDEN, np.where(inside | outside, COUNTS, SHEET))
            return np.where((sides == COUNTS) & narrow & inside, THIN, sides)

        return bounding
    cells = THICK_IN_NOISE if smooth_input.facts.get("noise", 0.0) > NOISY else THICK
    data, turn = smooth_input.data, np.asarray(smooth_input.data.direction)

    def thick(points: NDArray[np.float64], faces: NDArray[np.integer]) -> NDArray[np.integer]:  # noqa: ARG001
        bits = data_bits(field, threads=threads)
        solid, empty = (open_by_blocks(field, bits, void=void, cells=cells, threads=threads) for void in (False, True))
        position = (points - np.array(data.origin)) @ turn / data.cell_size
        wall, gap = np.zeros((2, len(points)), dtype=bool)
        for step in np.ndindex(2, 2, 2):
            cell = np.floor(position - 0.5).astype(np.int64) + step
            wall |= look_up_cells(field, solid, cell)
            gap |= look_up_cells(field, empty, cell, void=True)
        return np.where(wall & gap, COUNTS, THIN)

    return thick


def find_differences(
    judged: TopologyCheck, deviation: Fidelity | None, smooth_input: SmoothInput, *, off: float = 0.0
) -> Differences:
    """Judge a result: return the verdict with its losses, problems and remarks.

    Parameters
    ----------
    judged : TopologyCheck
        The changes of the voxels in smoothing.
    deviation : Fidelity or None
        Distances between result and input; None if they are sure to be small everywhere.
    smooth_input : SmoothInput
    off : float
        Relative error of the volume.
    """
    problems = [*judged.problems, *_topology_changes(judged, smooth_input)]
    if off:
        problems.append(f"the volume is off by {off:+.1%}, which no level can correct")
    remarks = []
    if thin_count := judged.changes.vanished_thin:
        remarks.append(f"{thin_count} specks or flakes one voxel thick are gone")
    if deviation and deviation.thin:
        feature = (
            "walls or gaps one voxel thick are gone"
            if smooth_input.enclosed is None
            else "slits narrower than a voxel are closed"
        )
        remarks.append(f"{feature}, {deviation.thin:.3g} mm² of their faces")
    if deviation and deviation.sheet:
        remarks.append(f"{deviation.sheet:.3g} mm² of faces that bound no solid are left out")
    if smooth_input.enclosed is not None and smooth_input.topology is None:
        mesh_parts, result_parts = int((smooth_input.enclosed.volumes > 0).sum()), judged.result.components
        if result_parts < mesh_parts:
            remarks.append(
                f"the mesh has {mesh_parts} components, some of which overlap or touch, and the result {result_parts}; "
                "--by-component keeps them apart"
            )
    if smooth_input.facts.get("coarse"):
        remarks.append("what is smaller than the voxels that were asked for was not compared")
    repairs = smooth_input.facts.get("repairs", {})
    if (share := repairs.get("hole_share", 0.0)) > MIN_CAP_SHARE:
        remarks.append(f"{repairs['holes']} holes of the mesh were closed by caps, {share:.1%} of the area")
    phrases = deviation.phrases if deviation else ()
    lost = deviation is not None and deviation.word == "lost"
    losses = phrases if lost else ()
    if not lost:
        remarks = [*phrases, *remarks]
    word: Word = "lost" if lost else "changed a little" if problems or remarks else "kept"
    return Differences(word=word, losses=losses, problems=tuple(problems), remarks=tuple(remarks))


def _topology_changes(judged: TopologyCheck, smooth_input: SmoothInput) -> list[str]:
    """Describe differences in topology between mesh and result, if the topology of the mesh is known."""
    if smooth_input.topology is None:
        return []
    mesh_counts, result_counts = smooth_input.topology, judged.result
    phrases = []
    for name, singular, before, after in (
        ("components", "component", mesh_counts.components, result_counts.components),
        ("cavities", "cavity", mesh_counts.cavities, result_counts.cavities),
        ("holes through the part", "hole through the part", mesh_counts.tunnels, result_counts.tunnels),
    ):
        if before != after:
            phrases.append(f"the mesh has {before} {singular if before == 1 else name}, the result {after}")
    return phrases
