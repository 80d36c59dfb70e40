"""Another pattern or wall in a region: inside as if the whole part were filled so, outside as if there were no region."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import manifold3d
import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from made_shapes import box
from shapes import one_of_each_kind
from test_3mf_parts import BAMBU, COLUMN, PART, PRUSA, component, group, model, packed, prusa_config, thing, volume
from test_command_line import run

from infill import GeometryError, ParameterError, Region, UsageError, fill, read_mesh, save
from infill.errors import FormatError
from infill.formats.volume_settings import SLICER_PATTERNS
from infill.interior.local_walls import LocalWall, subtract_walls
from infill.isosurfaces.components import shell_names
from infill.lattices.areas import find_areas
from infill.lattices.modifiers import add_modifiers
from infill.lattices.placed_regions import place_region
from infill.lattices.regions import parse_region
from infill.lattices.request import check_request
from infill.lattices.settings import resolve
from infill.meshes.shells import shell_volumes
from infill.meshes.solids import to_manifold
from infill.volume import Volume
from patterns import PATTERNS
from patterns.errors import PatternError

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

HALF_A_POINT = 0.005
COARSE: dict[str, Any] = {"wall": 1, "cell": 4.0, "voxel": 0.5}
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


def planes(x: Any, y: Any, z: Any) -> Any:
    return np.sin(y)


@pytest.mark.longest
def test_a_wall_divides_patterns_that_would_hang_free() -> None:
    """Walls parallel to those around them touch nothing at the sides of a box."""
    region = Region(pattern=planes, density=0.4, box=(-5, -4, -4, 5, 4, 4))
    result = fill(box(*SIDES), "rectilinear", density=0.2, regions=[region], wall=1, voxel=0.4)
    assert_one_solid(result)
    assert result.report["voids"]["islands"] == 0
    assert any(text.startswith("a wall divides the region box=-5,-4,-4,5,4,4") for text in result.report["problems"])
    assert not any("a wall divides" in text for text in filled("gyroid", f"{HALF}:pattern=grid").report["problems"])


@pytest.mark.longest
def test_a_region_of_lightning_and_one_within_it() -> None:
    """Its branches reach only what lies below roofs, and have as many lines there as the whole part."""
    region = Region(pattern="gyroid", density=0.3, box=(-6, -5, -5, 6, 5, 0))
    assert_one_solid(fill(box(*SIDES), "lightning", regions=[region], wall=1, voxel=0.4))
    result = filled("gyroid", f"{HALF}:pattern=lightning", density=0.2)
    assert_one_solid(result)
    assert result.report["regions"][1]["wanted"] is None


@pytest.mark.longest
@pytest.mark.parametrize("name", one_of_each_kind(name for name in PATTERNS.built_in if name != "gyroid"))
def test_every_kind_of_pattern_can_be_that_of_a_region(name: str) -> None:
    """In a part of a few cells, whose region ends beside its middle."""
    result = fill(
        box(14, 12, 12), density=0.2, wall=1, voxel=0.5, regions=[f"box=-20,-20,-20,1,2,20:pattern={name},density=30%"]
    )
    assert_one_solid(result)
    assert result.report["regions"][1]["pattern"] == name


@pytest.mark.longest
def test_the_mesh_of_a_region_cuts_its_pattern_out() -> None:
    """A ball that is inside out is the same region, and its density is that of the ball."""
    ball = trimesh.creation.icosphere(subdivisions=2, radius=7)
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
@pytest.mark.parametrize(("wall", "pattern"), [(2.0, "gyroid"), (0.6, "honeycomb")])
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


def test_depths_in_a_region_are_those_of_its_border() -> None:
    """Of a box that goes as far as the part, the sides there count as none; a mesh has the depths of a box."""
    bounds = np.array([[-5.0, -5, -5], [5, 5, 5]])
    points = np.array([[0.0, 0, 0], [3, 0, 4.5], [-4, 0, 0], [4.9, 4.9, 4.9], [0, 0, -9]])
    half = place_region(Region(wall=2, box=(-1, -5, -5, 5, 5, 5)))
    assert half.depths_at(points, bounds, near=1.0, threads=1).tolist() == pytest.approx([1, 4, -3, 5.9, 1])
    cube = place_region(Region(wall=2, mesh=box(4, 4, 4)))
    assert cube.depths_at(points, bounds, near=1.0, threads=1).tolist()[:1] == pytest.approx([2])
    assert cube.depths_at(points, bounds, near=1.0, threads=1).tolist()[3:] == [-np.inf, -np.inf]
    cells = Volume(values=np.zeros((11, 11, 11), dtype=bool), spacing=(1, 1, 1), origin=(-5.5, -5.5, -5.5))
    same = place_region(Region(wall=2, box=(-2, -2, -2, 2, 2, 2)))
    inside, outside = (region.measure_depths(cells, bounds, 3.0, None) for region in (cube, same))
    assert np.array_equal(inside > 0, outside > 0)
    assert inside[5, 5, 5] == outside[5, 5, 5] == 2


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


def prusa_project(path: Path, **settings: str) -> Path:
    """A part and a modifier, in a project whose perimeters are 0.5 and 0.4 mm wide."""
    told = prusa_config(
        volume(0, 11, volume_type="ModelPart"),
        volume(12, 23, volume_type="ParameterModifier", name="boss", **settings),
    )
    widths = "; external_perimeter_extrusion_width = 0.5\n; perimeter_extrusion_width = 0.4\n; extrusion_width = 0.45"
    return packed(path, model(thing(1, PART, COLUMN)), **{PRUSA: told, "Metadata/Slic3r_PE.config": widths})


def bambu_project(path: Path, **settings: str) -> Path:
    """The same as Bambu Studio and OrcaSlicer write it."""
    rows = "".join(f'<metadata key="{key}" value="{value}"/>' for key, value in {"name": "boss", **settings}.items())
    parts = f'<part id="1" subtype="normal_part"/><part id="2" subtype="modifier_part">{rows}</part>'
    things = thing(1, PART) + thing(2, COLUMN, kind="other") + group(3, component(1), component(2))
    widths = '{"outer_wall_line_width": ["0.5"], "inner_wall_line_width": "0.4", "line_width": "0.45", "x": 3}'
    config = {BAMBU: f'<config><object id="3">{parts}</object></config>', "Metadata/project_settings.config": widths}
    return packed(path, model(things, '<item objectid="3"/>'), **config)


KEYS_OF = {
    prusa_project: ("fill_density", "fill_pattern", "perimeters"),
    bambu_project: ("sparse_infill_density", "sparse_infill_pattern", "wall_loops"),
}


@pytest.mark.parametrize("write", KEYS_OF)
@pytest.mark.parametrize(
    ("values", "expected", "notes"),
    [
        (("60%", "3dhoneycomb", "3"), (0.6, "honeycomb-3d", 1.3), "60 % infill, infill pattern 3dhoneycomb and walls"),
        (("", "grid", ""), (None, "grid", None), "is a modifier with infill pattern grid, not a part"),
        (("", "", "4"), (None, None, 1.7), "is a modifier with walls of 1.7 mm, not a part"),
        (("30%", "crosszag", ""), (0.3, None, None), "its infill pattern crosszag has no equivalent, so that of the"),
        (("100%", "concentric", "2"), (None, None, 0.9), "regions have a density of 1% to 90%, so that of the part"),
        (("40%", "", "0"), (0.4, None, None), "it has no walls, and a region keeps its shell, so that of the part"),
    ],
)
def test_a_modifier_of_a_slicer_has_its_pattern_and_its_walls(
    write: Any, values: tuple[str, ...], expected: tuple[Any, ...], notes: str, tmp_path: Path
) -> None:
    """Perimeters times their widths; names as they are here; what has no equivalent is said."""
    settings = {key: value for key, value in zip(KEYS_OF[write], values, strict=True) if value}
    part = read_mesh(write(tmp_path / "project.3mf", **settings))
    noted, request = add_modifiers(part, check_request(pattern="gyroid", own={}))
    (region,) = request.regions
    assert (region.density, region.pattern, region.wall) == expected
    assert notes in "; ".join(noted.notes)


@pytest.mark.parametrize("values", [("100%", "concentric", ""), ("", "crosszag", "")])
def test_a_modifier_without_a_setting_that_a_fill_has_is_left_out(values: tuple[str, ...], tmp_path: Path) -> None:
    """As the infill of a project that infill itself wrote."""
    settings = {key: value for key, value in zip(KEYS_OF[prusa_project], values, strict=True) if value}
    part = read_mesh(prusa_project(tmp_path / "project.3mf", **settings))
    noted, request = add_modifiers(part, check_request(pattern="gyroid", own={}))
    assert request.regions == ()
    assert "is left out, as" in noted.notes[-1]


def test_every_name_of_a_slicer_is_that_of_a_pattern_here() -> None:
    assert set(SLICER_PATTERNS.values()) <= set(PATTERNS)


@pytest.mark.longest
def test_a_project_is_filled_with_the_pattern_and_the_walls_of_its_modifier(tmp_path: Path) -> None:
    path = prusa_project(tmp_path / "project.3mf", fill_density="40%", fill_pattern="grid", perimeters="4")
    result = fill(read_mesh(path), density=0.2, **COARSE)
    assert_one_solid(result)
    rest, region = result.report["regions"]
    assert (region["pattern"], region["wall"]) == ("grid", 1.7)
    assert region["least"] == pytest.approx(1.7, abs=0.06)
    assert [rest["density"], region["density"]] == pytest.approx([0.2, 0.4], abs=2 * HALF_A_POINT)


def test_settings_of_regions_are_saved_and_read_again() -> None:
    words = ["z=10..20:density=40%,pattern=grid,wall=1.6", "box=0,0,0,1,2,3:pattern=octet", "z=..5:wall=2"]
    request = resolve({"region": words}).request
    assert request.facts()["region"] == words
    assert [region.wall for region in request.regions] == [1.6, None, 2.0]


@pytest.mark.parametrize(
    ("region", "says"),
    [
        ("z=0..:density=40%,pattern=/etc/far.svg", "asks to read a file from elsewhere: region"),
        ("z=0..:pattern=/etc/far.svg,wall=2", "asks to read a file from elsewhere: region"),
        ("z=0..:pattern=mine.py:walls", "asks to run code: region"),
        ("z=0..:pattern=mine.py:walls,density=40%", "asks to run code: region"),
        ("/etc/far.stl:wall=2,pattern=grid", "asks to read a file from elsewhere: region"),
    ],
)
def test_a_config_file_reads_no_pattern_from_elsewhere(region: str, says: str, tmp_path: Path) -> None:
    (tmp_path / "theirs.toml").write_text(f'region = ["{region}"]\n')
    with pytest.raises(FormatError, match=says):
        resolve({}, config=tmp_path / "theirs.toml")


def test_a_config_file_may_name_patterns_and_walls(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text('region = ["z=0..:pattern=grid,density=40%", "0-5mm:wall=2mm"]\n')
    request = resolve({}, config=tmp_path / "mine.toml").request
    assert request.facts()["region"] == ["z=0..:density=40%,pattern=grid", "z=0..5:wall=2"]


@pytest.mark.longest
def test_the_command_tells_patterns_and_walls_of_regions(tmp_path: Path) -> None:
    save(box(20, 16, 16), tmp_path / "part.stl")
    words = ["fill", str(tmp_path / "part.stl"), "--wall", "1", "--cell", "4", "--voxel", "0.4", "--density", "20%"]
    result = run(*words, "--region", "z=0..:pattern=grid,density=40%,wall=1.6", "-o", str(tmp_path / "out.stl"))
    assert result.exit_code == 0
    assert "% grid in z=0.. with a wall of 1.6 mm" in " ".join(result.output.split())
    for extra in (["--dry-run"], ["-o", str(tmp_path / "no.stl")]):
        broken = run(*words, "--line-width", "0.5", "--region", "z=0..:pattern=grid,density=40%", *extra)
        assert broken.exit_code != 0
    assert not (tmp_path / "no.stl").exists()


def test_a_project_as_a_region_is_its_modifiers(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """The column alone, and not the part that it changes, which is said."""
    settings = prusa_config(volume(0, 11, volume_type="ModelPart"), volume(12, 23, modifier=1, fill_density="40%"))
    project = packed(tmp_path / "p.3mf", model(thing(1, PART, COLUMN)), **{PRUSA: settings})
    region = place_region(parse_region("region", f"{project}:density=40%"))
    assert [region.low.tolist(), region.high.tolist()] == [list(map(float, corner)) for corner in COLUMN]
    assert "not the part" in caplog.text
