"""What is told by the cells that changed sign is what a comparison of the whole tells."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, label

from infill import InfillError, Smoothing, Surface, Volume, smooth_volume
from infill.inspection.bricks import check_topology, check_topology_by_signs
from infill.inspection.deviation import KEPT, measure_deviation, sample_surface
from infill.inspection.sign_changes import SignChanges, are_surfaces_near
from infill.inspection.uncertain_places import CERTAIN, UncertainPlaces
from infill.isosurfaces.components import data_bits
from infill.isosurfaces.sparse_marching import extract_bricks
from infill.kernels.flips import simple
from infill.meshes.distance import TriangleTree
from infill.phasefield.sparse import smooth_bricks
from infill.smoothing.levelling import extract_surface
from infill.smoothing.request import SmoothedInput, SmoothInput, SmoothRequest
from infill.smoothing.sources import read_source
from infill.smoothing.stages import place_surface, raw_surface
from infill.voxels.from_mesh import voxelise
from infill.voxels.segmentation import segment_volume

FIELDS = 60
TOP = 32  # the last layer that is left of the knob
COARSE = 32  # voxels along the longest side of real files


def random_field(seed: int) -> tuple[Volume, Smoothing, float | str]:
    """Return a blob with bumps, sheets or specks, in cells of some size, and how to smooth it."""
    rng = np.random.default_rng(seed)
    shape = tuple(rng.integers(14, 34, 3).tolist())
    noise = gaussian_filter(rng.normal(size=shape), rng.uniform(1.5, 6), mode="wrap")
    noise -= np.quantile(noise, rng.uniform(0.2, 0.8))
    if rng.random() < 0.4:  # one smooth blob, on which a few cells flip
        away = np.linalg.norm((np.indices(shape).T - np.array(shape) / 2) / (np.array(shape) / 2), axis=-1).T
        noise = 0.75 - away + 0.05 * noise / np.abs(noise).max()
    grey = np.clip(noise / np.abs(noise).max() * rng.uniform(1, 8), -1, 1).astype(np.float32)
    spacing = (1.0, 1.0, 1.0) if rng.random() < 0.6 else tuple(rng.uniform(0.5, 1, 3).tolist())
    smoothing = Smoothing(steps=int(rng.integers(1, 25)))
    return (
        Volume(values=noise > 0 if rng.random() < 0.7 else grey, spacing=spacing, origin=(0.0, 0.0, 0.0)),
        smoothing,
        "volume" if rng.random() < 0.8 else 0.0,
    )


def compared(given: SmoothInput, request: SmoothRequest) -> tuple[bool, bool]:
    """Check both forms against each other; return whether the cells that flipped decided each."""
    data, spacing = given.data, tuple(given.data.cell_size.tolist())
    field = smooth_bricks(data.values, request.smoothing, spacing=spacing)
    surfaced = extract_surface(SmoothedInput(smooth_input=given, request=request, field=field))
    found = surfaced.levelled
    flips = SignChanges.of(found.field, surfaced.components.bits, found.height)
    whole = check_topology(
        found, surfaced.components, spacing=spacing, blur=request.smoothing.blur, levels=surfaced.levels
    )
    part = check_topology_by_signs(found, surfaced.components, flips, levels=surfaced.levels)
    if part is not None:
        assert (part.data, part.result, part.changes, part.problems) == (
            whole.data,
            whole.result,
            whole.changes,
            whole.problems,
        )
        assert part.lost == whole.lost == ()
    near = are_surfaces_near(flips, spacing=spacing)
    if near:
        measured = measure_deviation(
            raw_surface(field, data, None), place_surface(found.surface, data), cell=max(spacing)
        )
        assert measured.word == "kept"
        assert measured.phrases == ()
        assert max(measured.there.max, measured.back.max) <= 1.25 * max(spacing)
    check_uncertain_places(raw_surface(field, data, None), place_surface(found.surface, data), data, flips)
    return part is not None, near


def check_uncertain_places(given: Surface, result: Surface, data: Volume, flips: SignChanges) -> None:
    """Check that surfaces are an edge apart outside the uncertain places, and that these suffice for the verdict."""
    cell = float(data.cell_size.max())
    uncertain = UncertainPlaces.of(flips, data)
    if uncertain is None:
        return
    rng = np.random.default_rng(0)
    shifted = replace(result, vertices=result.vertices + 0.2 * cell * rng.uniform(-1, 1, 3) / np.sqrt(3))
    for surface, places in ((result, uncertain), (shifted, uncertain.after_moving(0.2 * cell, near=KEPT))):
        assert places is not None
        for one, other in ((given, surface), (surface, given)):
            points, _, _ = sample_surface(one, 0.4 * cell)
            sure = points[~places.hold(points)]
            distance = TriangleTree.of(other).nearest(sure)[0]
            limit = CERTAIN * cell if places is uncertain else KEPT * cell
            assert distance.max(initial=0.0) <= limit + 1e-9
        known, whole = (
            measure_deviation(given, surface, cell=cell, exact=False, uncertain=chosen) for chosen in (places, None)
        )
        for name in ("word", "phrases", "lost", "added", "thin", "sheet", "hidden", "given_area", "result_area"):
            assert getattr(known, name) == getattr(whole, name)
    assert uncertain.after_moving(0.3 * cell, near=KEPT) is None


@pytest.mark.longest
def test_both_forms_agree_on_random_fields() -> None:
    decided = []
    for seed in range(FIELDS):
        volume, smoothing, level = random_field(seed)
        try:
            decided.append(
                compared(
                    SmoothInput(data=volume, facts={}),
                    SmoothRequest(smoothing=smoothing, level=level, method="plain", tolerance=None),
                )
            )
        except InfillError:  # nothing is left, or nothing was there
            continue
    assert len(decided) > 0.9 * FIELDS
    # Each way is taken often enough to mean something.
    assert 6 < sum(alike for alike, _ in decided) < len(decided)
    assert 6 < sum(near for _, near in decided) < len(decided)


def is_simple(cells: NDArray[np.bool_]) -> bool:
    """Return whether flipping the middle of 3 x 3 x 3 cells keeps parts of solid and of void as they are: by labels."""
    faces, edges = (np.indices((3, 3, 3)) - 1, np.indices((3, 3, 3)) - 1)
    six = np.abs(faces).sum(axis=0) <= 1
    eighteen = np.abs(edges).sum(axis=0) <= 2

    def touching(there: NDArray[np.bool_], how: NDArray[np.bool_]) -> int:
        rest = there.copy()
        rest[1, 1, 1] = False
        names, _ = label(rest, how)
        beside = names[how & rest]
        return len(np.unique(beside))

    return touching(cells, six) == 1 and touching(~cells, eighteen) == 1


@pytest.mark.slow
def test_simple_cells_are_told_as_labels_tell_them() -> None:
    rng = np.random.default_rng(0)
    told = []
    for _ in range(3000):
        cells = rng.random((3, 3, 3)) < rng.uniform(0.1, 0.9)
        told.append(bool(simple(cells.ravel())))
        assert told[-1] == is_simple(cells)
    assert 100 < sum(told) < 2900


def test_a_loss_that_is_planted_is_not_passed_over() -> None:
    """A knob cut off in the field itself: neither form may say that nothing happened."""
    solid = np.linalg.norm(np.indices((40, 40, 40)) - 19.5, axis=0) < 12
    solid[16:24, 16:24, 30:36] = True
    field = smooth_bricks(solid, Smoothing(steps=2))
    beyond = field.where[:, 2, None] * 16 + np.arange(16) > TOP + 1  # the lattice begins one cell before the grid
    values = np.where(beyond[:, None, None, :], np.float32(-1), field.values)
    for cut, near in ((field, True), (replace(field, values=values), False)):
        flips = SignChanges.of(cut, data_bits(cut), 0.0)
        assert are_surfaces_near(flips, spacing=(1.0, 1.0, 1.0)) == near
        uncertain = UncertainPlaces.of(flips, Volume(values=solid))
        surfaces = raw_surface(cut, Volume(values=solid), None), extract_bricks(cut, spacing=(1.0, 1.0, 1.0))
        assert uncertain is not None
        assert (measure_deviation(*surfaces, cell=1.0, exact=False, uncertain=uncertain).word == "lost") != near
        assert (len(flips.places) > 100) != near


def test_distances_are_measured_when_they_are_asked_for() -> None:
    ball = np.linalg.norm(np.indices((30, 30, 30)) - 14.5, axis=0) < 10
    report: Any = smooth_volume(ball, tolerance=None).report
    assert report.pending("distance")
    assert report["verdict"]["word"] == "kept"
    assert report["distance"]["result"]["max"] < 1.25
    assert not report.pending("distance")


@pytest.mark.longest
def test_both_forms_agree_on_real_files(data: Path) -> None:
    """Every mesh and every volume, on coarse grids: what there is to check for is how they are connected."""
    decided = []
    paths = (path for folder in ("models", "medical", "printable", "volumes") for path in (data / folder).iterdir())
    for path in sorted(paths):
        try:
            source = read_source(path, units="mm")
            if isinstance(source, Surface):
                solid = voxelise(source, resolution=COARSE)
            elif isinstance(source, Volume):
                step = max(1, max(source.values.shape) // COARSE)
                solid, _ = segment_volume(replace(source, values=source.values[::step, ::step, ::step]), otsu=True)
            else:
                continue
        except InfillError:
            continue
        for steps in (2, 8):
            request = SmoothRequest(smoothing=Smoothing(steps=steps), method="plain", tolerance=None)
            decided.append(compared(SmoothInput(data=solid, facts={}), request))
    assert len(decided) > 40
    assert any(alike for alike, _ in decided)
    assert any(near for _, near in decided)


def test_what_was_taken_out_as_a_crumb_is_measured() -> None:
    """A crumb is gone from the surface and not from the field, whose signs therefore say nothing of it."""
    solid = np.zeros((40, 30, 30), dtype=bool)
    solid[3:20, 5:25, 5:25] = solid[21:27, 12:18, 12:18] = solid[20, 15, 15] = True
    options: Any = {"smoothing": Smoothing(steps=1), "method": "plain", "allow_broken": True, "tolerance": None}
    report: Any = smooth_volume(solid, crumbs=300.0, **options).report
    assert report["verdict"]["crumbs"]["removed"] == 1
    assert report["verdict"]["word"] == "lost"


@pytest.mark.slow
@pytest.mark.parametrize("moved", [0.2, 1.0, 1.6, 2.6, 7.0])
def test_what_is_near_need_not_be_measured(moved: float) -> None:
    """Word, phrases and places are the same whether distances of what is near are exact or not."""
    ball = trimesh.creation.icosphere(subdivisions=4, radius=10)
    given = Surface(vertices=ball.vertices, faces=ball.faces)
    dent = np.where(ball.vertices[:, 2:] > 8, moved, 0.3) * [0.0, 0.0, -1.0]
    result = Surface(vertices=ball.vertices + dent, faces=ball.faces)
    exact, rough = (measure_deviation(given, result, cell=1.0, exact=each) for each in (True, False))
    assert (rough.word, rough.phrases, rough.lost, rough.added) == (exact.word, exact.phrases, exact.lost, exact.added)
    assert (rough.thin, rough.sheet, rough.hidden) == (exact.thin, exact.sheet, exact.hidden)
    assert (exact.exact, rough.exact) == (True, False)
