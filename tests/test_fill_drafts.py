"""Drafts of a fill: near the whole fill, closed, and faster where an earlier draft is remembered."""

from __future__ import annotations

import pytest
import trimesh

from infill import GeometryError, fill
from infill.lattices.draft import MOST_SPACES, DraftMemory, draft_fill
from infill.lattices.request import check_request
from infill.meshes.merging import surface_of
from infill.samples.bracket import bracket


def request(pattern: str = "gyroid", **options):
    return check_request(pattern=pattern, own={}, **{"density": 0.25, **options})


@pytest.fixture(scope="module")
def box():
    return surface_of(trimesh.creation.box((30, 24, 20)))


@pytest.mark.parametrize("pattern", ["gyroid", "octet", "honeycomb", "cubic"])
def test_a_draft_is_near_the_whole_fill(box, pattern: str) -> None:
    draft = draft_fill(box, request(pattern))
    whole = fill(box, pattern, density=0.25, voxel=0.5, tolerance=0.0)
    assert draft.walls_inside.closed
    assert draft.walls_inside.volume == pytest.approx(-draft.hollow.volume, rel=1e-6)
    assert draft.volume == pytest.approx(draft.part.volume + draft.walls_inside.volume, rel=1e-6)
    # Drawn until the density is within 5 %, twice at most; bars may be further off.
    assert draft.hollow.density == pytest.approx(0.25, rel=0.15)
    assert draft.volume == pytest.approx(whole.surface.volume, rel=0.1)


def test_what_stays_the_same_is_computed_once(box) -> None:
    memory = DraftMemory()
    first = draft_fill(box, request(), memory=memory)
    (space,) = memory.spaces.values()
    second = draft_fill(box, request(density=0.3), memory=memory)
    assert second.hollow.space is first.hollow.space is space
    assert len(memory.sizes) == 1
    assert second.hollow.density == pytest.approx(0.3, rel=0.15)
    for wall in (1.0, 1.4, 1.6, 1.8, 2.0):
        draft_fill(box, request(wall=wall), memory=memory)
    assert len(memory.spaces) == MOST_SPACES


def test_a_remembered_draft_has_the_density_of_a_new_one() -> None:
    part, memory = bracket(), DraftMemory()
    for density in (0.15, 0.4, 0.2, 0.3):
        draft = draft_fill(part, request(density=density), memory=memory)
        assert draft.hollow.density == pytest.approx(density, rel=0.15)


def test_gradients_and_open_sides_are_drafted(box) -> None:
    graded = draft_fill(box, request(density=(0.15, 0.4), by="skin"))
    assert 0.15 < graded.hollow.density < 0.4
    assert draft_fill(box, request(open_="top")).hollow.open > 0


def test_it_fails_as_the_whole_fill_does(box) -> None:
    with pytest.raises(GeometryError, match="nowhere thicker than two"):
        draft_fill(box, request(wall=15))
