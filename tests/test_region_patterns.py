"""Another pattern or wall in a region: inside as if the whole part were filled so, outside as if there were no region."""

from __future__ import annotations

from functools import cache
from typing import Any

import manifold3d
import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from made_shapes import box

from infill import GeometryError, ParameterError, Region, UsageError, fill
from infill.interior.local_walls import LocalWall, subtract_walls
from infill.isosurfaces.components import shell_names
from infill.lattices.areas import find_areas
from infill.lattices.regions import parse_region
from infill.lattices.request import check_request
from infill.lattices.settings import resolve
from infill.meshes.shells import shell_volumes
from infill.meshes.solids import to_manifold
from infill.volume import Volume
from patterns import PATTERNS
from patterns.errors import PatternError

pytestmark = pytest.mark.usefixtures("compiled")

HALF_A_POINT = 0.005
COARSE: dict[str, Any] = {"wall": 1, "cell": 4.0, "voxel": 0.4}
SIDES = (24.0, 18.0, 18.0)
HALF = "box=0,-20,-20,20,20,20"
INSIDE, OUTSIDE = ((2.0, -7.5, -7.5), (10.5, 7.5, 7.5)), ((-10.5, -7.5, -7.5), (-2.0, 7.5, 7.5))  # away from borders
ALIKE = 0.03  # of a box: widths differ by a few hundredths, as a region is as dense as requested with its border


@cache
def filled(pattern: str, *regions: str, **keywords: Any) -> Any:
    return fill(box(*SIDES), pattern, regions=regions, **{**COARSE, **dict(keywords)})


def voids_in(result: Any, low: tuple[float, ...], high: tuple[float, ...]) -> manifold3d.Manifold:
    """The voids in a box, by manifold3d."""
    cube = manifold3d.Manifold.cube([h - a for a, h in zip(low, high, strict=True)]).translate(low)
    return to_manifold(result.stages.voids) ^ cube


def unlike(one: Any, other: Any, corners: tuple[tuple[float, ...], tuple[float, ...]]) -> float:
    """The share of a box that is solid in one of two results and void in the other."""
    first, second = (voids_in(result, *corners) for result in (one, other))
    return ((first - second).volume() + (second - first).volume()) / np.prod(np.subtract(corners[1], corners[0]))


def assert_one_solid(result: Any) -> None:
    """One closed solid without loose pieces, which manifold3d accepts."""
    names, count = shell_names(result.surface)
    assert result.surface.closed
    assert result.report["mesh"]["manifold"] == "NoError"
    assert int((shell_volumes(result.surface, names, count) > 0).sum()) == 1
    assert to_manifold(result.surface).volume() == pytest.approx(result.report["volume"], rel=1e-6)


@pytest.mark.longest
@pytest.mark.parametrize("pattern", ["grid", "octet", "cubic", "gyroid-network"])
def test_a_pattern_in_a_region_is_that_of_a_whole_fill_there_and_nowhere_else(pattern: str) -> None:
    """A level set, lines, planes, bars and a network, in cells of one size, so that the geometry is the same too."""
    result = filled("schwarz-p", f"{HALF}:pattern={pattern},density=40%", density=0.2)
    assert_one_solid(result)
    assert result.report["problems"] == []
    rest, region = result.report["regions"]
    assert [rest["pattern"], region["pattern"]] == ["schwarz-p", pattern]
    assert [rest["density"], region["density"]] == pytest.approx([0.2, 0.4], abs=HALF_A_POINT)
    share = 1 - voids_in(result, (0, -8, -8), (11, 8, 8)).volume() / (11 * 16 * 16)
    assert share == pytest.approx(0.4, abs=HALF_A_POINT)
    assert unlike(result, filled(pattern, density=0.4), INSIDE) < ALIKE
    assert unlike(result, filled("schwarz-p", density=0.2), OUTSIDE) < ALIKE
    assert unlike(result, filled("schwarz-p", density=0.2), INSIDE) > 4 * ALIKE


@pytest.mark.longest
def test_two_patterns_hold_one_another_and_their_voids_run_into_one_another() -> None:
    """Both sides of a gyroid open into the tubes of a network, so that one drain serves all of them."""
    result = filled("gyroid", f"{HALF}:pattern=gyroid-network,density=30%", density=0.2, drain=2.0)
    assert_one_solid(result)
    assert result.report["voids"]["islands"] == 0
    assert result.report["voids"]["count"] == 1
    assert result.report["drains"]["count"] == 1
    assert result.report["voids"]["closed"] == []


@pytest.mark.longest
def test_voids_that_stay_sealed_are_told() -> None:
    result = filled("gyroid", "box=-4,-4,-3,4,4,3:pattern=honeycomb-3d,density=40%", density=0.2, drain=6.0)
    assert_one_solid(result)
    assert bool(result.report["voids"]["closed"]) == any("sealed" in text for text in result.report["problems"])


@pytest.mark.longest
def test_a_wall_divides_patterns_that_would_hang_free() -> None:
    """Below a flat roof, lightning leaves the middle empty, where a box of gyroid touches nothing."""
    region = Region(pattern="gyroid", density=0.3, box=(-6, -5, -5, 6, 5, 0))
    result = fill(box(*SIDES), "lightning", regions=[region], wall=1, voxel=0.4)
    assert_one_solid(result)
    assert result.report["regions"][1]["density"] == pytest.approx(0.3, abs=2 * HALF_A_POINT)


@pytest.mark.longest
@pytest.mark.parametrize("name", [name for name in PATTERNS if name != "gyroid"])
def test_every_pattern_can_be_that_of_a_region(name: str) -> None:
    result = fill(
        box(20, 16, 16), density=0.2, wall=1, voxel=0.4, regions=[f"box=-20,-20,-20,1,3,20:pattern={name},density=30%"]
    )
    assert_one_solid(result)
    assert result.report["regions"][1]["pattern"] == name


@pytest.mark.longest
def test_the_mesh_of_a_region_cuts_its_pattern_out() -> None:
    """A ball that is inside out is the same region, and its density is that of the ball."""
    ball = trimesh.creation.icosphere(subdivisions=3, radius=7)
    result = fill(box(*SIDES), density=0.2, regions=[Region(pattern="grid", density=0.4, mesh=ball)], **COARSE)
    assert_one_solid(result)
    assert result.report["regions"][1]["density"] == pytest.approx(0.4, abs=HALF_A_POINT)
    ball.invert()
    turned = fill(box(*SIDES), density=0.2, regions=[Region(pattern="grid", density=0.4, mesh=ball)], **COARSE)
    assert turned.report["density"] == pytest.approx(result.report["density"], abs=1e-3)


@pytest.mark.longest
def test_keys_of_overlapping_regions_add_up() -> None:
    """Density, pattern and wall each come from the last region that has them."""
    result = filled(
        "gyroid", "z=0..:pattern=cubic", "box=-30,-30,-30,0,30,30:density=40%", "z=-20..3:wall=2", density=0.2
    )
    assert_one_solid(result)
    upper_left = 1 - voids_in(result, (-10, -7, 3.5), (-1, 7, 7.5)).volume() / (9 * 14 * 4)
    whole = 1 - voids_in(filled("cubic", density=0.4), (-10, -7, 3.5), (-1, 7, 7.5)).volume() / (9 * 14 * 4)
    assert upper_left == pytest.approx(whole, abs=0.03)
    assert result.report["regions"][3]["least"] == pytest.approx(2, abs=0.05)
    assert result.report["regions"][1]["least"] == pytest.approx(1, abs=0.05)


@pytest.mark.longest
@pytest.mark.parametrize("wall", [0.6, 2.0])
@pytest.mark.parametrize("pattern", ["gyroid", "honeycomb"])
def test_a_wall_in_a_region_is_that_of_a_whole_fill_there_and_nowhere_else(wall: float, pattern: str) -> None:
    result = filled(pattern, f"{HALF}:wall={wall}mm", density=0.2)
    assert_one_solid(result)
    rest, region = result.report["regions"]
    assert [rest["wall"], region["wall"]] == [1, wall]
    assert rest["least"] == pytest.approx(1, abs=0.04)
    assert region["least"] == pytest.approx(wall, abs=0.04)
    inside, outside = ((2.0, -9, -9), (12.0, 9, 9)), ((-12.0, -9, -9), (-2.0, 9, 9))
    assert unlike(result, filled(pattern, density=0.2, **{"wall": wall}), inside) < ALIKE
    assert unlike(result, filled(pattern, density=0.2), outside) < ALIKE
    skin = voids_in(result, (0.5, -9, 9 - wall + 0.06), (12, 9, 9)).volume()
    assert skin == pytest.approx(0, abs=1e-6)


@pytest.mark.longest
def test_a_region_can_be_all_wall() -> None:
    result = filled("gyroid", "z=0..5:wall=12", density=0.2)
    assert_one_solid(result)
    assert voids_in(result, (-12, -9, 0.3), (12, 9, 4.7)).volume() == pytest.approx(0, abs=1e-6)


@given(
    thin=st.floats(0, 4), thick=st.floats(0, 4), border=st.floats(-6, 6), seed=st.integers(0, 1000), slope=st.booleans()
)
@settings(max_examples=50, deadline=None)
def test_a_depth_below_walls_that_differ_has_the_sign_of_the_wall_there(
    thin: float, thick: float, border: float, seed: int, slope: bool
) -> None:
    """And is nowhere steeper than the depth itself."""
    rng = np.random.default_rng(seed)
    line = np.arange(12, dtype=np.float32)
    depth = np.minimum(line[:, None, None], 6 + 0 * line[:, None] + line * (0.5 if slope else 0)) - 2
    depth = np.ascontiguousarray(depth + rng.uniform(-1, 1), dtype=np.float32)
    inside = np.broadcast_to((line - 6 - border).astype(np.float32)[:, None], depth.shape).copy()
    cells = Volume(values=np.zeros(depth.shape, dtype=bool), spacing=(1, 1, 1))
    place = LocalWall(wall=thick, measure=lambda _cells, reach: np.clip(inside, -reach, reach))
    below = subtract_walls(depth.copy(), cells, thin, [place], reach=50.0)
    wall = np.where(inside > 0, thick, thin)
    sure = np.abs(inside) > 1e-3
    assert np.array_equal(
        (below > 0)[sure], (depth - wall > 0)[sure] | (np.abs(depth - wall) < 1e-5)[sure] & (below > 0)[sure]
    )
    assert np.abs(np.diff(below, axis=1)).max() <= max(np.abs(np.diff(depth, axis=1)).max(), 1) + 1e-5


@given(
    density=st.none() | st.integers(1, 90).map(lambda share: share / 100),
    pattern=st.none() | st.sampled_from(["grid", "octet", "logo.svg", "mine.py:walls"]),
    wall=st.none() | st.integers(1, 50).map(lambda length: length / 10),
    place=st.sampled_from([{"z": (0.0, 10.0)}, {"box": (0.0, 0, 0, 1, 2, 3)}, {"mesh": "a b.stl"}]),
)
def test_a_region_is_read_as_it_is_written(density: Any, pattern: Any, wall: Any, place: dict[str, Any]) -> None:
    if density is None and pattern is None and wall is None:
        return
    region = Region(density=density, pattern=pattern, wall=wall, **place)
    again = parse_region("region", region.text)
    assert (again.text, again.pattern, again.wall) == (region.text, pattern, wall)
    assert again.density == pytest.approx(density) if density else again.density is None


@pytest.mark.parametrize(
    ("text", "error", "says"),
    [
        ("z=0..:perimeters=3", UsageError, "regions have no perimeters; give density, pattern, wall"),
        ("z=0..:pattern=", UsageError, "'pattern=' is not a setting"),
        ("z=0..:pattern=grid,pattern=gyroid", UsageError, "with pattern twice; give it once"),
        ("z=0..:pattern=grid,60%", PatternError, "there is no pattern 'grid,60%'"),
        ("z=0..:pattern=gyroyd", PatternError, "there is no pattern 'gyroyd'; did you mean 'gyroid'?"),
        ("z=0..:wall=thick", UsageError, "has a wall of 'thick'; give a thickness in mm, such as wall=2"),
        ("z=0..:wall=0", UsageError, "a region keeps its shell; give a wall above 0 mm"),
        ("z=0..:wall=-1", ParameterError, "region wall is -1"),
    ],
)
def test_a_setting_that_cannot_be_is_refused(text: str, error: type[Exception], says: str) -> None:
    with pytest.raises(error) as caught:
        fill(box(20, 18, 16), "honeycomb", regions=[text], **COARSE)
    assert says in str(caught.value)


def test_a_wall_of_a_region_needs_a_shell() -> None:
    for given_, says in (({"wall": 0.0}, "wall is 0"), ({"form": "project"}, "whose shell the slicer makes")):
        with pytest.raises(UsageError, match=says):
            check_request(pattern="gyroid", own={}, regions=["z=0..:wall=2"], **given_)


def test_what_a_fill_has_no_room_for_is_refused() -> None:
    with pytest.raises(GeometryError, match="nowhere thicker than two of those"):
        fill(box(20, 18, 4), regions=["z=0..:wall=3"], **{**COARSE, "wall": 2.5})


def test_the_pattern_of_the_part_in_a_region_is_no_other() -> None:
    same = check_request(pattern="gyroid", own={}, regions=["z=0..:pattern=gyroid,density=40%"])
    assert find_areas(same) == ()
    assert same.regions[0].density == 0.4
    over = check_request(pattern="gyroid", own={}, regions=["z=0..:pattern=grid", "z=5..:pattern=gyroid"])
    assert [area.request.pattern for area in find_areas(over)] == ["grid", "gyroid"]


def test_a_pattern_in_a_region_has_the_defaults_of_its_kind() -> None:
    """Bars have a cell and no line width by default, and a density in the region leaves other options alone."""
    request = check_request(
        pattern="gyroid", own={}, density=0.2, cell=5.0, angle=30.0, regions=["z=0..:pattern=octet,density=40%"]
    )
    (area,) = find_areas(request)
    assert (area.request.density, area.request.cell, area.request.angle) == (0.4, 5.0, 30.0)
    (graded,) = find_areas(check_request(pattern="gyroid", own={}, density=(0.1, 0.3), regions=["z=0..:pattern=grid"]))
    assert graded.request.grading is not None
    with pytest.raises(UsageError, match="cell and line_width decide the density"):
        find_areas(
            check_request(
                pattern="gyroid", own={}, cell=5.0, line_width=0.5, regions=["z=0..:pattern=grid,density=40%"]
            )
        )


def test_settings_of_regions_are_saved_and_read_again() -> None:
    words = ["z=10..20:density=40%,pattern=grid,wall=1.6", "box=0,0,0,1,2,3:pattern=octet", "z=..5:wall=2"]
    request = resolve({"region": words}).request
    assert request.facts()["region"] == words
    assert [region.wall for region in request.regions] == [1.6, None, 2.0]
