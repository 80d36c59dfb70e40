"""The verdict on a volume in chunks is that on the whole: the same changes, the same places, the same word."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from infill import Smoothing, Volume, smooth_volume
from infill.chunks.hashing import hash_surface
from infill.errors import GeometryError
from infill.lazy.volume import LazyVolume
from infill.smoothing import chunked_verdict
from infill.smoothing.attempt import Attempt, run_attempt
from infill.smoothing.chunk_changes import MatchedChunk, match_chunk
from infill.smoothing.chunked import smooth_in_chunks
from infill.smoothing.chunked_verdict import ChunkedVerdict
from infill.smoothing.request import SmoothRequest
from infill.smoothing.scans import volume_ways
from tests.test_chunks import Arranged, Case

pytestmark = pytest.mark.usefixtures("silent_compiler")

SPACING = (0.5, 0.5, 0.5)
# Changes of components and walls, which chunks match; those of voids are not known there.
MATCHED = ("vanished", "vanished_thin", "broken", "fused", "appeared", "walls_pierced", "walls_lost", "faint")


def in_memory(values: NDArray[Any], request: SmoothRequest, threshold: float | None, **options: Any) -> Attempt:
    way = volume_ways(Volume(values=values, **options), request, threshold=threshold)[0]
    return run_attempt(way.data, way.request)


def in_chunks(
    values: NDArray[Any], request: SmoothRequest, threshold: float | None, side: int = 16, **options: Any
) -> ChunkedVerdict:
    volume = LazyVolume(array=Arranged(values), **{"origin": (0.0, 0.0, 0.0), **options})
    with smooth_in_chunks(volume, request, threshold=threshold, side=side) as surface:
        return surface.verdict


def changes_of(verdict: ChunkedVerdict | Attempt) -> dict[str, int]:
    facts = verdict.topology.changes.facts()
    return {name: int(facts[name]) for name in MATCHED}


def plain(steps: int, **options: Any) -> SmoothRequest:
    return SmoothRequest(
        method="plain", smoothing=Smoothing(steps=steps), tolerance=None, allow_broken=True, threads=1, **options
    )


# Noise of every kind: thousands of specks, sponges, and smooth bodies that break in a few places.
CASES = [
    Case(seed=11, shape=(36, 48, 57), blur=0.0, share=0.6, steps=5, spacing=(0.3, 0.5, 0.41), size=(1, 1, 1)),
    Case(seed=12, shape=(25, 35, 35), blur=0.0, share=0.85, steps=22, spacing=(0.5, 0.5, 0.5), size=(1, 1, 1)),
    Case(seed=13, shape=(40, 50, 24), blur=0.7, share=0.5, steps=19, spacing=(0.41, 0.5, 0.5), size=(1, 1, 1)),
    Case(seed=14, shape=(53, 44, 53), blur=3.0, share=0.6, steps=20, spacing=(0.3, 0.3, 0.3), size=(1, 1, 1)),
    Case(seed=15, shape=(46, 31, 52), blur=3.0, share=0.5, steps=8, spacing=(0.5, 0.41, 0.3), size=(1, 1, 1)),
    Case(seed=16, shape=(49, 19, 49), blur=1.5, share=0.7, steps=18, spacing=(0.41, 0.41, 0.41), size=(1, 1, 1)),
]


@pytest.mark.longest
@pytest.mark.parametrize("case", CASES, ids=lambda case: str(case.seed))
def test_changes_are_those_of_the_whole(case: Case) -> None:
    request = replace(case.request, allow_broken=True)
    whole = in_memory(case.values, request, case.threshold, spacing=case.spacing)
    found = in_chunks(case.values, request, case.threshold, spacing=case.spacing)
    assert changes_of(found) == changes_of(whole)
    # Of the data, cavities are counted on its surface here, and among its cells there: they differ where cells touch
    # along edges alone.
    assert found.topology.data.components == whole.topology.data.components
    assert found.topology.data.euler_number == whole.topology.data.euler_number
    assert found.topology.result == whole.topology.result
    assert [piece.voxels for piece in found.topology.lost] == [piece.voxels for piece in whole.topology.lost]
    assert found.differences.word == whole.differences.word
    if whole.deviation is not None:
        assert found.deviation.given_area == pytest.approx(whole.deviation.given_area, rel=1e-9)
        # Triangles inside cubes whose signs decide nothing are drawn by other numbers here.
        assert found.deviation.result_area == pytest.approx(whole.deviation.result_area, rel=1e-7)
        far = 6 * min(case.spacing)  # distances are measured so far
        assert found.deviation.back.max == pytest.approx(min(whole.deviation.back.max, far), abs=max(case.spacing))
        missing, expected = (sum(place.area for place in each.lost) for each in (found.deviation, whole.deviation))
        assert missing == pytest.approx(expected, rel=0.1, abs=8 * max(case.spacing) ** 2)


def test_a_chunk_sends_each_pair_of_components_once(monkeypatch: pytest.MonkeyPatch) -> None:
    # Not once for every brick: for 2,048³ voxels that took 4 GiB where all chunks come together.
    sent = []

    def keep(*arguments: Any) -> MatchedChunk:
        sent.append(match_chunk(*arguments))
        return sent[-1]

    monkeypatch.setattr(chunked_verdict, "match_chunk", keep)
    case = CASES[2]
    in_chunks(case.values, replace(case.request, allow_broken=True), case.threshold, spacing=case.spacing)
    assert len(sent) > 8
    for part in sent:
        for rows in (part.of_solid, part.of_walls):
            assert len(np.unique(rows[:, :2], axis=0)) == len(rows)
            assert (rows[:, 2] > 0).all()


def block_with_a_plate(thickness: int, at: int) -> NDArray[np.bool_]:
    """Return two blocks of 60 x 60 x 12 cells, and a plate of some cells that crosses the chunks between them."""
    solid = np.zeros((60, 60, 60), dtype=bool)
    solid[2:58, 2:58, 4:16] = solid[2:58, 2:58, 44:56] = True
    solid[at : at + thickness, 2:58, 4:56] = True
    return solid


@pytest.mark.longest
def test_a_plate_that_is_lost_is_found() -> None:
    # A plate two voxels thick, in the middle of a chunk and on its face: many steps remove it.
    for at in (22, 31):
        values = block_with_a_plate(2, at)
        found = in_chunks(values, plain(30), None, spacing=SPACING)
        whole = in_memory(values, plain(30), None, spacing=SPACING)
        assert found.differences.word == "lost"
        assert whole.differences.word == "lost"
        worst = max(found.deviation.lost, key=lambda place: place.area)
        assert whole.deviation is not None
        assert worst.area == pytest.approx(max(place.area for place in whole.deviation.lost), rel=0.01)
        assert worst.area > 0.75 * 2 * 28 * 56 * 0.5**2  # both sides of 28 x 56 cells, but for what stays at its ends
        assert worst.at[0] == pytest.approx((at + 1) * 0.5, abs=1.0)
        assert changes_of(found) == changes_of(whole)
        assert changes_of(found)["walls_lost"] == 1
        x, _, z = found.topology.lost[0].at
        assert (x, z) == pytest.approx(((at + 1) * 0.5, 15.0), abs=0.5)


@pytest.mark.longest
def test_a_loss_is_refused_and_named() -> None:
    values = block_with_a_plate(2, 31)
    request = replace(plain(60, strict=True), allow_broken=False)
    with pytest.raises(
        GeometryError, match=r"is missing.*leave out --strict, so that other ways are tried, or give --al"
    ):
        in_chunks(values, request, None, spacing=SPACING)
    assert in_chunks(values, replace(request, strict=False), None, spacing=SPACING).word != "lost"  # the remedy


def test_what_is_kept_is_said_to_be_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("nothing was to be matched")

    monkeypatch.setattr(chunked_verdict, "match_chunk", refuse)  # the cells that changed settle it
    found = in_chunks(block_with_a_plate(6, 29), plain(4), None, spacing=SPACING)
    assert found.differences == replace(found.differences, word="kept", losses=(), problems=(), remarks=())
    assert not found.deviation.lost
    assert not found.deviation.added
    assert found.deviation.back.max < 1.25 * 0.5


def test_a_bridge_that_breaks_between_solid_chunks() -> None:
    # Two cubes of 40 cells, solid throughout in their middle, and a bridge of 3 x 3 cells.
    solid = np.zeros((100, 44, 44), dtype=bool)
    solid[2:42, 2:42, 2:42] = solid[58:98, 2:42, 2:42] = True
    solid[42:58, 20:23, 20:23] = True
    found, whole = (each(solid, plain(40), None, spacing=SPACING) for each in (in_chunks, in_memory))
    assert changes_of(found) == changes_of(whole)
    assert changes_of(found)["broken"] == 1
    assert found.topology.result == whole.topology.result
    assert any("1 component fell apart" in phrase for phrase in found.differences.problems)


def test_a_crumb_that_is_taken_out_is_missed() -> None:
    # Knobs of 5 cells on threads of one cell, which break: crumbs, one in a chunk, others on the faces of chunks.
    solid = np.zeros((48, 48, 48), dtype=bool)
    solid[4:44, 4:44, 4:14] = True
    for x in (5, 13, 22, 32):
        solid[x + 2, 22, 14:26] = True
        solid[x : x + 5, 20:25, 24:29] = True
    request = replace(plain(10), crumbs=0.5**3 * 200)
    found, whole = (each(solid, request, None, spacing=SPACING) for each in (in_chunks, in_memory))
    assert whole.crumbs.count == 4
    assert found.differences.word == whole.differences.word == "lost"
    assert whole.deviation is not None
    places = [sorted(place.at[0] for place in verdict.deviation.lost) for verdict in (found, whole)]
    assert len(places[0]) == len(places[1]) == 4
    areas = [sum(place.area for place in verdict.deviation.lost) for verdict in (found, whole)]
    assert areas[0] == pytest.approx(areas[1], rel=0.05)


@pytest.mark.longest
def test_workers_change_nothing() -> None:
    case = CASES[2]
    request = replace(case.request, allow_broken=True)
    volume = LazyVolume(array=Arranged(case.values), spacing=case.spacing, origin=(0.0, 0.0, 0.0))
    reports = []
    for workers in (1, 2):
        with smooth_in_chunks(volume, request, threshold=case.threshold, side=16, workers=workers) as surface:
            reports.append(surface.report()["verdict"])
    assert reports[0] == reports[1]


@pytest.mark.longest
def test_gentler_steps_are_tried_as_in_memory() -> None:
    # A plate two voxels thick: 30 steps lose it, fewer do not.
    values = block_with_a_plate(2, 31)
    request = replace(plain(30), allow_broken=False)
    volume = LazyVolume(array=Arranged(values), spacing=SPACING, origin=(0.0, 0.0, 0.0))
    with smooth_in_chunks(volume, request, side=16) as surface:
        report, solver = surface.report(), surface.solver
        assert list(Path(solver.work.scratch).iterdir())
        assert (
            len([folder for folder in Path(solver.work.scratch).parent.glob("fields*") if any(folder.iterdir())]) == 1
        )
    whole = smooth_volume(values, method="plain", smoothing=Smoothing(steps=30), spacing=SPACING, tolerance=None)
    for key in ("word", "tried", "taken", "instead_of"):
        assert report["verdict"][key] == whole.report["verdict"][key]
    assert report["verdict"]["instead_of"] == {"steps": 30, "radius": None}
    assert report["request"]["steps"] == whole.report["request"]["steps"]
    assert report["hash"] == hash_surface(whole.surface.vertices, whole.surface.faces)
