"""What a result is told to be: kept, changed a little or lost, and in which words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.inspection.fidelity import COUNTS, HIDDEN, SHEET, THIN, Fidelity, Kinds, Word
from infill.isosurfaces.components import data_bits, set_at, sturdy
from infill.voxels.noise import NOISY

if TYPE_CHECKING:
    from infill.inspection.bricks import Verdict
    from infill.phasefield.sparse import SparseField
    from infill.smoothing.request import Given

JUST = 5e-5  # cells: how far from a face it is looked whether there is solid
SLIT = 1.0  # cells: a slit as narrow as this may close
# Of a scan: what is thinner than this many voxels may go. Noise makes specks and pits of two and more by chance.
THICK, THICK_IN_NOISE = 2, 4
CAPS = 0.001  # of the area: caps smaller than this are not worth a word


@dataclass(frozen=True, kw_only=True)
class Differences:
    """The verdict on a result, and what it rests on, one phrase each.

    Parameters
    ----------
    word : {"kept", "changed a little", "lost"}
    losses : tuple of str
        What makes it "lost".
    problems : tuple of str
        What broke, fused, opened or vanished, however small it is.
    remarks : tuple of str
        What else is not as it was given.
    """

    word: Word
    losses: tuple[str, ...]
    problems: tuple[str, ...]
    remarks: tuple[str, ...]


def kinds_of_places(given: Given, field: SparseField, *, threads: int | None = None) -> Kinds:
    """Return what tells which points of what was given count when it is asked whether they were lost.

    Of a mesh, those with solid on one side: what lies inside the solid, and sheets without thickness, do not. Slits
    narrower than a cell are told apart. Of voxels, those between solid and void more than one cell thick: what is one
    cell thick, the equation removes, and it is told apart.
    """
    if given.enclosed is not None:
        held, mesh = given.enclosed, given.reference
        assert mesh is not None

        def bounding(points: NDArray[np.float64], faces: NDArray[np.integer]) -> NDArray[np.integer]:
            outside, inside, narrow = (
                held.solid_beside(mesh, points, faces, way, threads=threads) for way in (JUST, -JUST, SLIT)
            )
            sides = np.where(inside & outside, HIDDEN, np.where(inside | outside, COUNTS, SHEET))
            return np.where((sides == COUNTS) & narrow & inside, THIN, sides)

        return bounding
    cells = THICK_IN_NOISE if given.facts.get("noise", 0.0) > NOISY else THICK
    data, turn = given.data, np.asarray(given.data.direction)

    def thick(points: NDArray[np.float64], faces: NDArray[np.integer]) -> NDArray[np.integer]:  # noqa: ARG001
        bits = data_bits(field, threads=threads)
        solid, empty = (sturdy(field, bits, void=void, cells=cells, threads=threads) for void in (False, True))
        place_of = (points - np.array(data.origin)) @ turn / data.cell_size
        wall, gap = np.zeros((2, len(points)), dtype=bool)
        for step in np.ndindex(2, 2, 2):
            place = np.floor(place_of - 0.5).astype(np.int64) + step
            wall |= set_at(field, solid, place)
            gap |= set_at(field, empty, place, void=True)
        return np.where(wall & gap, COUNTS, THIN)

    return thick


def differences(judged: Verdict, found: Fidelity | None, given: Given, *, off: float = 0.0) -> Differences:
    """Return the verdict.

    Parameters
    ----------
    judged : Verdict
        What smoothing did to the voxels.
    found : Fidelity or None
        How far the result lies from what was given; None if it is sure to be near everywhere.
    given : Given
    off : float
        By which part of itself the volume is off.
    """
    problems = [*judged.problems, *_of_mesh(judged, given)]
    if off:
        problems.append(f"the volume is off by {off:+.1%}, which no level can correct")
    remarks = []
    if gone := judged.changes.vanished_thin:
        remarks.append(f"{gone} specks or flakes one voxel thick are gone")
    if found and found.thin:
        what = (
            "walls or gaps one voxel thick are gone"
            if given.enclosed is None
            else "slits narrower than a voxel are closed"
        )
        remarks.append(f"{what}, {found.thin:.3g} mm² of their faces")
    if found and found.sheet:
        remarks.append(f"{found.sheet:.3g} mm² of faces that bound no solid are left out")
    if given.enclosed is not None and given.topology is None:
        parts, now = int((given.enclosed.volumes > 0).sum()), judged.result.components
        if now < parts:
            remarks.append(
                f"the mesh has {parts} components, some of which overlap or touch, and the result {now}; "
                "--by-component keeps them apart"
            )
    if given.facts.get("coarse"):
        remarks.append("what is smaller than the voxels that were asked for was not compared")
    repairs = given.facts.get("repairs", {})
    if (share := repairs.get("hole_share", 0.0)) > CAPS:
        remarks.append(f"{repairs['holes']} holes of the mesh were closed by caps, {share:.1%} of the area")
    phrases = found.phrases if found else ()
    lost = found is not None and found.word == "lost"
    losses = phrases if lost else ()
    if not lost:
        remarks = [*phrases, *remarks]
    word: Word = "lost" if lost else "changed a little" if problems or remarks else "kept"
    return Differences(word=word, losses=losses, problems=tuple(problems), remarks=tuple(remarks))


def _of_mesh(judged: Verdict, given: Given) -> list[str]:
    """Return how the result is connected differently from the mesh, where that is known: voxels may have lost it."""
    if given.topology is None:
        return []
    was, now = given.topology, judged.result
    said = []
    for name, one, before, after in (
        ("components", "component", was.components, now.components),
        ("cavities", "cavity", was.cavities, now.cavities),
        ("holes through the part", "hole through the part", was.tunnels, now.tunnels),
    ):
        if before != after:
            said.append(f"the mesh has {before} {one if before == 1 else name}, the result {after}")
    return said
