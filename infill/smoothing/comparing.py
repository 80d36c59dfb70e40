"""Compare a result with its input: distances both ways, and the verdict: kept, changed a little or lost, and why."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from infill.inspection.deviation import (
    COUNTS,
    HIDDEN,
    LOST,
    SHEET,
    THIN,
    Deviation,
    Kinds,
    Word,
    measure_deviation,
    total_area,
)
from infill.inspection.facets import WALL_PER_RADIUS, find_flat_facets
from infill.inspection.thickness import FARTHEST
from infill.isosurfaces.components import data_bits, look_up_cells, open_by_blocks
from infill.meshes.distance import distances
from infill.plain_numbers import count_noun, plain_argument, plain_share, plain_size
from infill.smoothing.stages import raw_surface
from infill.surface import Surface
from infill.voxels.noise import NOISY

if TYPE_CHECKING:
    from infill.inspection.bricks import TopologyCheck
    from infill.inspection.uncertain_places import UncertainPlaces
    from infill.phasefield.sparse import SparseField
    from infill.reports.common import Spread
    from infill.reports.smoothing import CoarseChange, DifferenceKeys, Distance, FacetKeys
    from infill.smoothing.levelling import SurfaceAtLevel
    from infill.smoothing.request import SmoothedInput, SmoothInput, SmoothRequest

SIDE_OFFSET = 5e-5  # cells: distance from a face at which solid is looked for
SLIT_WIDTH = 1.0  # cells: a slit as narrow as this may close
# Of a scan: features thinner than this, in voxels, may vanish. Noise makes specks and pits of two and more by chance.
THICK, THICK_IN_NOISE = 2, 4
MIN_CAP_SHARE = 0.001  # of the area: caps smaller than this are not mentioned
VOLUME_TOLERANCE = 0.01  # of the volume: tolerated error, because of specks that are gone
COARSE_LOSS = 0.05  # of the volume: larger voxels that change the solid by more are a problem
LOST_VOLUME = 0.1  # of the volume: a solid that is off by more is not the one that was given
LOST_HOLES = 10  # holes that broke through, at least as many as there were before: a wall that became a sieve
MAX_LISTED_PLACES = 5  # of the places that were lost or added are listed
MAX_SAMPLES = 5_000  # vertices whose distance is measured


@dataclass(frozen=True, kw_only=True)
class Differences:
    """The verdict on a result, and its reasons, one phrase each.

    Parameters
    ----------
    word : {"kept", "changed a little", "lost"}
    losses : tuple of str
        Features that are lost: much of the surface, a tenth of the volume, or a wall that is full of holes.
    problems : tuple of str
        Parts that broke, fused, opened or vanished, however small.
    remarks : tuple of str
        All other differences from the input.
    fewer : tuple of str
        Of the remarks, those of components, cavities and tunnels of a scan that are fewer than before.
    """

    word: Word
    losses: tuple[str, ...]
    problems: tuple[str, ...]
    remarks: tuple[str, ...]
    fewer: tuple[str, ...] = ()

    def refused(self, *, strict: bool) -> tuple[str, ...]:
        """Return the reasons to refuse a result: losses, and if `strict`, whatever breaks, fuses or vanishes."""
        return (*self.losses, *self.problems, *self.fewer) if strict else self.losses


def compare_with_input(
    surface: Surface, smoothed: SmoothedInput, *, exact: bool = False, uncertain: UncertainPlaces | None = None
) -> Deviation:
    """Measure the distance between a surface and the input, both ways; by default, only where it is large.

    If the places are known that alone may be far apart, only these are examined.
    """
    smooth_input = smoothed.smooth_input
    return measure_deviation(
        _input_surface(smoothed) if smooth_input.mesh is None else smooth_input.mesh,
        surface,
        cell=smooth_input.distance_unit,
        closed=smooth_input.closed_mesh,
        kinds=_loss_classifier(smoothed),
        exact=exact,
        uncertain=uncertain,
        threads=smoothed.threads,
    )


def distance_facts(surface: Surface, smoothed: SmoothedInput) -> Distance:
    """Return the distances between result and input, both ways, and from voxels to mesh, for the report."""
    smooth_input, deviation = smoothed.smooth_input, compare_with_input(surface, smoothed, exact=True)
    facts: Distance = {
        "from": "voxels" if smooth_input.mesh is None else "mesh",
        "result": deviation.there.facts(),
        "input": deviation.back.facts(),
        "thin": deviation.thin_area,
        "sheet": deviation.sheet,
        "hidden": deviation.hidden,
    }
    if smooth_input.closed_mesh is not None:
        vertices = subsample(_input_surface(smoothed).vertices)
        facts["data"] = summarise_distances(distances(vertices, smooth_input.closed_mesh, threads=smoothed.threads))
    return facts


def facet_facts(surface: Surface, smoothed: SmoothedInput, thinnest: float | None) -> FacetKeys | None:
    """Return the flat facets of a coarse mesh that the result still has, for the report; None if they are few.

    Parameters
    ----------
    surface : Surface, mm
    smoothed : SmoothedInput
    thinnest : float or None, mm
        The thinnest walls of the input; None if all are thicker than can be measured.
    """
    mesh = smoothed.smooth_input.mesh
    if mesh is None:
        return None
    found = find_flat_facets(mesh, surface, cell=max(smoothed.spacing), threads=smoothed.threads)
    if found is None:
        return None
    limit = FARTHEST * min(smoothed.spacing) if thinnest is None else thinnest
    return {**found.facts(), "fits": found.radius * WALL_PER_RADIUS <= limit}


def subsample(vertices: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return every n-th vertex: 5,000 to 10,000 of them, or all if there are fewer."""
    return vertices[:: max(1, len(vertices) // MAX_SAMPLES)]


def summarise_distances(distance: NDArray[np.float64]) -> Spread:
    """Return the mean, root mean square and maximum of the distances."""
    return {
        "mean": float(distance.mean()),
        "rms": float(np.sqrt((distance**2).mean())),
        "max": float(distance.max()),
    }


def _input_surface(smoothed: SmoothedInput) -> Surface:
    """Return the surface of the input voxels, mm."""
    smooth_input = smoothed.smooth_input
    return smooth_input.voxel_surface or raw_surface(smoothed.field, smooth_input.data, smoothed.threads)


def _loss_classifier(smoothed: SmoothedInput) -> Kinds:
    """Return the function that classifies places of the input by whether a loss there counts, and if not, why.

    Of a mesh, points with solid on one side count; those inside the solid, and on sheets without thickness, do not.
    Slits narrower than a cell have a class of their own. Of voxels, points between solid and void more than one cell
    thick count; the equation removes walls one cell thick, which have a class of their own.
    """
    smooth_input, field, threads = smoothed.smooth_input, smoothed.field, smoothed.threads
    if smooth_input.mesh_volumes is not None:
        enclosed, mesh = smooth_input.mesh_volumes, smooth_input.closed_mesh
        assert mesh is not None

        def classify_on_mesh(points: NDArray[np.float64], faces: NDArray[np.integer]) -> NDArray[np.integer]:
            """Return the class of each point (N, 3) on faces (N,) of the mesh, by the solid on both sides of them."""
            outside, inside, narrow = (
                enclosed.solid_beside(mesh, points, faces, offset, threads=threads)
                for offset in (SIDE_OFFSET, -SIDE_OFFSET, SLIT_WIDTH)
            )
            sides = np.where(inside & outside, HIDDEN, np.where(inside | outside, COUNTS, SHEET))
            return np.where((sides == COUNTS) & narrow & inside, THIN, sides)

        return classify_on_mesh
    cells = thickness_that_counts(smooth_input)
    data, turn = smooth_input.data, np.asarray(smooth_input.data.direction)

    def classify_in_voxels(points: NDArray[np.float64], faces: NDArray[np.integer]) -> NDArray[np.integer]:  # noqa: ARG001
        """Return the class of each point (N, 3), mm: whether wall and gap are more than one cell thick there."""
        position = (points - np.array(data.origin)) @ turn / data.cell_size
        return classify_by_thickness(field, position, cells, threads=threads)

    return classify_in_voxels


def thickness_that_counts(smooth_input: SmoothInput) -> int:
    """Return the cells that solid and void of a scan must be thick, so that a loss there counts."""
    return THICK_IN_NOISE if _is_noisy(smooth_input) else THICK


def classify_by_thickness(
    field: SparseField, places: NDArray[np.float64], cells: int, *, threads: int | None = None
) -> NDArray[np.integer]:
    """Return `COUNTS` for places (N, 3) between solid and void at least so many cells thick, else `THIN`.

    Places are in cells from the lower corner of the grid.
    """
    bits = data_bits(field, threads=threads)
    solid, empty = (open_by_blocks(field, bits, void=void, cells=cells, threads=threads) for void in (False, True))
    wall, gap = np.zeros((2, len(places)), dtype=bool)
    for step in np.ndindex(2, 2, 2):
        cell = np.floor(places - 0.5).astype(np.int64) + step
        wall |= look_up_cells(field, solid, cell)
        gap |= look_up_cells(field, empty, cell, void=True)
    return np.where(wall & gap, COUNTS, THIN)


def find_differences(
    topology: TopologyCheck, deviation: Deviation | None, smooth_input: SmoothInput, off: float
) -> Differences:
    """Judge a result: return the verdict with its losses, problems and remarks.

    Parameters
    ----------
    topology : TopologyCheck
        The changes of the voxels in smoothing.
    deviation : Deviation or None
        Distances between result and input; None if they are sure to be small everywhere.
    smooth_input : SmoothInput
    off : float
        Relative error of the volume, 0 if it is tolerable: see `volume_error`.
    """
    losses: list[str] = []
    remarks: list[str] = []
    if deviation:
        (losses if deviation.word == "lost" else remarks).extend(deviation.phrases)
    new_holes, holes = _holes_through(topology, smooth_input)
    is_sieve = new_holes >= max(LOST_HOLES, holes)
    if is_sieve or smooth_input.topology is not None:  # told in other words
        topology = replace(topology, changes=replace(topology.changes, walls_pierced=0))
    problems = [*_topology_changes(topology, smooth_input, but_tunnels=is_sieve), *topology.problems]
    if off:
        phrase = f"the volume is {abs(off):.1%} too {'large' if off > 0 else 'small'}"
        (losses if abs(off) >= LOST_VOLUME else problems).append(phrase)
    if is_sieve:
        beside = f", beside {holes} {'hole' if holes == 1 else 'holes'}" if holes else ""
        losses.append(f"{new_holes:,} pinholes broke through walls{beside}")
    if thin_count := topology.changes.vanished_thin:
        specks = "1 speck or flake" if thin_count == 1 else f"{thin_count:,} specks or flakes"
        remarks.append(f"{specks} one voxel thick {'is' if thin_count == 1 else 'are'} gone")
    if deviation and deviation.thin_distance:
        phrase, is_lost = describe_thin(deviation, *_thin_words(smooth_input), counts=_thin_counts(smooth_input))
        (losses if is_lost else remarks).append(phrase)
    if deviation and deviation.sheet:
        remarks.append(f"{plain_size(deviation.sheet, power=2)} of faces that bound no solid are left out")
    if smooth_input.mesh_volumes is not None and smooth_input.topology is None:
        mesh_parts, result_parts = int((smooth_input.mesh_volumes.volumes > 0).sum()), topology.result.components
        if result_parts < mesh_parts:
            remarks.insert(
                0,
                f"the mesh has {mesh_parts} components, some of which overlap or touch, and the result {result_parts}; "
                "--by-component keeps them apart",
            )
    fewer = describe_counts(topology) if smooth_input.mesh_volumes is None else []
    remarks.extend(fewer)
    if coarsened := smooth_input.facts.get("coarsened"):
        if phrase := describe_coarsening(coarsened):
            (losses if abs(coarsened["change"]) >= LOST_VOLUME else problems).append(phrase)
        remarks.append("what is smaller than the voxels that were asked for was not compared")
    repairs = smooth_input.facts.get("repairs", {})
    if (share := repairs.get("hole_share", 0.0)) > MIN_CAP_SHARE:
        verb = "was" if repairs["holes"] == 1 else "were"
        holes_text = count_noun(repairs["holes"], "hole")
        remarks.append(f"{holes_text} of the mesh {verb} closed by caps, {share:.1%} of the area")
    word: Word = "lost" if losses else "changed a little" if problems or remarks else "kept"
    return Differences(
        word=word, losses=tuple(losses), problems=tuple(problems), remarks=tuple(remarks), fewer=tuple(fewer)
    )


def verdict_facts(
    differences: Differences, deviation: Deviation | None, cell: float, cleaned: Sequence[str] = ()
) -> DifferenceKeys:
    """Return a verdict with its places and areas, for the report.

    Parameters
    ----------
    differences : Differences
    deviation : Deviation or None
    cell : float
        Unit in which distances are judged, mm.
    cleaned : sequence of str
        What was taken out on purpose, one phrase each.
    """
    return {
        "word": differences.word,
        "changes": [*differences.losses, *differences.problems, *differences.remarks, *cleaned],
        "lost": [patch.facts() for patch in deviation.lost[:MAX_LISTED_PLACES]] if deviation else [],
        "added": [patch.facts() for patch in deviation.added[:MAX_LISTED_PLACES]] if deviation else [],
        "far": LOST * cell,
        "missing": total_area(deviation.lost if deviation else ()),
        "thin": total_area(deviation.thin if deviation else ()),
        "new": total_area(deviation.added if deviation else ()),
    }


def describe_coarsening(coarsened: CoarseChange) -> str:
    """Describe the change of a solid by larger voxels alone, and voxels without it; "" if it is small."""
    change, fitting = coarsened["change"], coarsened["fitting"]
    if abs(change) < COARSE_LOSS:
        return ""
    advice = "leave --voxel out" if fitting is None else f"--voxel {plain_argument(fitting)} keeps it"
    return (
        f"the larger voxels hold {abs(change):.0%} {'more' if change > 0 else 'less'} than the "
        f"{plain_size(coarsened['volume_before'], digits=4, power=3)} of the scan; {advice}"
    )


def _is_noisy(smooth_input: SmoothInput) -> bool:
    """Tell whether the input is so noisy that only what is thick counts."""
    return smooth_input.facts.get("noise", 0.0) > NOISY


def _thin_words(smooth_input: SmoothInput) -> tuple[str, str]:
    """Return the words for what is too thin to count, and for its loss."""
    if smooth_input.mesh_volumes is not None:
        return "slits narrower than a voxel", "are closed"
    if _is_noisy(smooth_input):
        return f"noise, up to {THICK_IN_NOISE - 1} voxels thick,", "is gone"
    return "walls or gaps one voxel thick", "are gone"


def _thin_counts(smooth_input: SmoothInput) -> bool:
    """Tell whether much that is too thin to count is a loss all the same."""
    return smooth_input.mesh_volumes is None and not _is_noisy(smooth_input)


def describe_thin(deviation: Deviation, feature: str, change: str, *, counts: bool) -> tuple[str, bool]:
    """Describe what is gone and was too thin to count; return the phrase, and whether it is so much that it is lost.

    Parameters
    ----------
    deviation : Deviation
    feature, change : str
        Words for what is too thin, and for its loss.
    counts : bool
        Whether much of it is a loss.
    """
    area = deviation.thin_area
    if not area:
        return f"{feature} moved by up to {plain_size(deviation.thin_distance)}", False
    share = plain_share(area / deviation.given_area)
    is_lost = counts and deviation.is_large(area, deviation.given_area)
    return f"{feature} {change}, {plain_size(area, power=2)} ({share}) of the surface of the input", is_lost


def describe_counts(topology: TopologyCheck) -> list[str]:
    """Describe components, cavities and tunnels of a scan that are fewer in the result, or components that are more."""
    before, after, changes = topology.data, topology.result, topology.changes
    phrases = []
    told = changes.vanished or changes.vanished_thin or changes.fused or changes.faint
    if after.components > before.components and not changes.broken:
        phrases.append(f"{count_noun(before.components, 'component')} fell apart into {after.components:,}")
    elif after.components < before.components and not told:
        phrases.append(f"{before.components:,} components of the data are {after.components:,}")
    for name, plural, old, new in (
        ("cavity", "cavities", before.cavities, after.cavities),
        ("tunnel", "tunnels", before.tunnels, after.tunnels),
    ):
        if new < old:
            phrases.append(f"{old - new:,} of {count_noun(old, name, plural)} {'is' if old - new == 1 else 'are'} gone")
    return phrases


def _holes_through(topology: TopologyCheck, smooth_input: SmoothInput) -> tuple[int, int]:
    """Return the number of holes that broke through walls, and the number of holes before."""
    after = topology.result.tunnels
    new = topology.changes.walls_pierced if smooth_input.topology is None else after - smooth_input.topology.tunnels
    return new, after - new


def _topology_changes(topology: TopologyCheck, smooth_input: SmoothInput, *, but_tunnels: bool) -> list[str]:
    """Describe differences in topology between mesh and result, if the topology of the mesh is known."""
    if smooth_input.topology is None:
        return []
    mesh_counts, result_counts = smooth_input.topology, topology.result
    phrases = []
    for name, singular, before, after in (
        ("components", "component", mesh_counts.components, result_counts.components),
        ("cavities", "cavity", mesh_counts.cavities, result_counts.cavities),
        ("holes through the part", "hole through the part", mesh_counts.tunnels, result_counts.tunnels),
    ):
        if before != after and not (but_tunnels and name.startswith("holes")):
            fused = name == "components" and (topology.changes.fused or topology.data.components < before)
            hint = "; --by-component keeps them apart" if fused and after < before else ""
            phrases.append(f"the mesh has {before} {singular if before == 1 else name}, the result {after}{hint}")
    return phrases


def volume_error(surfaced: SurfaceAtLevel, smoothed: SmoothedInput) -> float:
    """Return the relative error of the volume; 0 if it is tolerable, or the level was fixed."""
    enclosed = smoothed.smooth_input.mesh_volumes
    target = float(surfaced.targets.sum()) if enclosed is None else enclosed.total
    return intolerable_error(surfaced.volume / target - 1, smoothed.request)


def intolerable_error(error: float, request: SmoothRequest) -> float:
    """Return the relative error of the volume; 0 if it is tolerable, or the level was fixed."""
    return error if request.level == "volume" and abs(error) > VOLUME_TOLERANCE else 0.0
