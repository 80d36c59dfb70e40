"""Another density in a region: it is there on the finished mesh, nowhere else, and one that hits nothing is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import manifold3d
import numpy as np
import pytest
import trimesh
from made_shapes import box
from test_3mf_parts import (
    BAMBU,
    COLUMN,
    PART,
    PRUSA,
    by_ranges,
    component,
    group,
    model,
    packed,
    prusa_config,
    thing,
    volume,
)
from test_command_line import one_line_error, run

from infill import GeometryError, InfillError, Region, UsageError, fill, read_mesh, save
from infill.errors import FormatError
from infill.lattices.modifiers import add_modifiers
from infill.lattices.regions import parse_region
from infill.lattices.request import check_request
from infill.lattices.settings import resolve
from infill.meshes.solids import to_manifold
from infill.smoothing.sources import read_source
from infill.voxels.scanlines import fill_rows, intersect_rows

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

HALF_A_POINT = 0.005
COARSE: dict[str, Any] = {"wall": 1, "cell": 4.0, "voxel": 0.4}


def share_in(result: Any, low: tuple[float, ...], high: tuple[float, ...]) -> float:
    """Solid share of a box, by manifold3d."""
    cube = manifold3d.Manifold.cube([h - a for a, h in zip(low, high, strict=True)]).translate(low)
    return 1 - (to_manifold(result.stages.voids) ^ cube).volume() / cube.volume()


@pytest.mark.long
@pytest.mark.parametrize("pattern", ["cross-3d", "gyroid", "octet", "honeycomb"])
def test_the_density_of_a_region_is_that_of_the_finished_mesh(pattern: str) -> None:
    """Of the whole region inside the walls, judged by manifold3d."""
    result = fill(
        box(26, 18, 18), pattern, density=0.2, regions=[Region(density=0.45, box=(0, -9, -9, 13, 9, 9))], **COARSE
    )
    report = result.report
    assert report["problems"] == []
    assert report["closed"]
    assert report["mesh"]["manifold"] == "NoError"
    rest, region = report["regions"]
    assert [rest["place"], region["place"]] == ["rest", "box=0,-9,-9,13,9,9"]
    assert rest["density"] == pytest.approx(0.2, abs=HALF_A_POINT)
    assert region["density"] == pytest.approx(0.45, abs=HALF_A_POINT)
    assert share_in(result, (0, -8, -8), (12, 8, 8)) == pytest.approx(0.45, abs=HALF_A_POINT)
    assert share_in(result, (-12, -8, -8), (0, 8, 8)) == pytest.approx(0.2, abs=HALF_A_POINT)


@pytest.mark.longest
def test_a_region_over_the_whole_part_is_the_plain_density() -> None:
    """Whatever the density elsewhere, where there is nothing."""
    part = box(20, 18, 16)
    whole = fill(part, density=0.2, regions=["z=-20..20:density=40%"], **COARSE).report
    plain = fill(part, density=0.4, **COARSE).report
    assert whole["density"] == pytest.approx(plain["density"], abs=HALF_A_POINT)
    assert whole["regions"][0]["density"] is None
    assert whole["regions"][1]["density"] == pytest.approx(0.4, abs=HALF_A_POINT)
    assert whole["problems"] == []


@pytest.mark.longest
def test_a_region_with_the_density_of_the_rest_changes_nothing() -> None:
    part = box(20, 18, 16)
    same = fill(part, density=0.3, regions=["z=0..:density=30%"], **COARSE).report
    plain = fill(part, density=0.3, **COARSE).report
    assert same["density"] == pytest.approx(plain["density"], abs=HALF_A_POINT)
    assert all(region["density"] == pytest.approx(0.3, abs=HALF_A_POINT) for region in same["regions"])


@pytest.mark.longest
def test_mirrored_and_permuted_boxes_have_the_same_infill() -> None:
    """Schwarz P in a cube is the same from all sides, so a slab on any of them leaves the same solid."""
    slabs = [np.array([[-9.0, -9, -9], [9, 9, 9]]) for _ in range(4)]
    for slab, (end, axis) in zip(slabs, [(0, 0), (1, 0), (0, 1), (1, 2)], strict=True):
        slab[end, axis] = 2 - 4 * end
    results = [
        fill(
            box(16, 16, 16), "schwarz-p", density=0.2, regions=[Region(density=0.4, box=tuple(slab.ravel()))], **COARSE
        )
        for slab in slabs
    ]
    densities = [result.report["density"] for result in results]
    assert densities == pytest.approx([densities[0]] * 4, abs=HALF_A_POINT)
    shares = [
        share_in(result, *(tuple(np.clip(end, -7, 7)) for end in slab))
        for result, slab in zip(results, slabs, strict=True)
    ]
    assert shares == pytest.approx([shares[0]] * 4, abs=HALF_A_POINT)


@pytest.mark.longest
def test_a_box_a_mesh_of_it_and_its_file_are_the_same_region(tmp_path: Path) -> None:
    """Up to the quarters of a cell in which the border of a mesh is sampled; the mesh reaches far out of the part."""
    mesh = box(200, 200, 210, at=(0, 0, 105))
    save(mesh, tmp_path / "upper.stl")
    part = box(18, 16, 16)
    regions = [
        Region(density=0.45, z=(0, np.inf)),
        Region(density=0.45, mesh=mesh),
        f"{tmp_path / 'upper.stl'}:density=45%",
    ]
    reports = [fill(part, density=0.25, regions=[region], **COARSE).report for region in regions]
    for report in reports:
        assert report["density"] == pytest.approx(reports[0]["density"], abs=HALF_A_POINT)
        assert report["regions"][1]["density"] == pytest.approx(0.45, abs=HALF_A_POINT)
        assert report["regions"][1]["volume"] == pytest.approx(reports[0]["regions"][1]["volume"], rel=0.1)


@pytest.mark.longest
def test_later_regions_win_and_one_that_is_covered_is_told() -> None:
    part = box(18, 16, 16)
    report = fill(part, density=0.25, regions=["z=0..:density=50%", "z=-1..:density=35%"], **COARSE).report
    _, covered, last = report["regions"]
    assert covered["density"] is None
    assert last["density"] == pytest.approx(0.35, abs=HALF_A_POINT)
    assert report["problems"] == ["nothing is left of the region z=0..: later regions or walls cover it"]


@pytest.mark.longest
@pytest.mark.parametrize("form", ["infill", "project"])
def test_other_forms_have_regions_too(form: str) -> None:
    report = fill(box(24, 20, 16), "honeycomb", density=0.2, regions=["z=0..:density=40%"], as_=form, voxel=0.5).report
    assert report["problems"] == []
    assert [region["density"] for region in report["regions"]] == pytest.approx([0.2, 0.4], abs=HALF_A_POINT)


@pytest.mark.parametrize(
    ("region", "error", "says"),
    [
        (
            "z=100..120:density=40%",
            GeometryError,
            "z=100..120 lies outside the part; the part spans x -10 to 10, y -9 to 9",
        ),
        ("z=7.5..20:density=40%", GeometryError, "holds nothing of the space inside the walls; the part spans"),
        ("z=1..2", UsageError, "region is 'z=1..2'; give a place and a setting"),
        ("z=a..2:density=40%", UsageError, "give numbers in mm"),
        ("box=1,2,3:density=40%", UsageError, "give six numbers"),
        ("box=1,2,3,x,5,6:density=40%", UsageError, "give numbers in mm"),
        ("z=5..2:density=40%", UsageError, "ends are in the wrong order"),
        ("z=1..2:density=140%", InfillError, "give a density such as"),
        ("z=1..2:density=95%", InfillError, "region density is 95%; give 1% to 90%"),
        ("none.stl:density=40%", FormatError, "no file none.stl"),
        (5, UsageError, "region is 5; give infill.Region"),
        (Region(density=0.4), UsageError, "has 0 places"),
        (Region(density=0.4, z=(0, 1), box=(0, 0, 0, 1, 1, 1)), UsageError, "has 2 places"),
    ],
)
def test_a_region_that_cannot_be_is_refused(region: object, error: type[Exception], says: str) -> None:
    with pytest.raises(error) as caught:
        fill(box(20, 18, 16), regions=[region], **COARSE)
    assert says in str(caught.value)


def test_an_open_mesh_is_no_region() -> None:
    sheet = box(4, 4, 4)
    sheet.update_faces(np.arange(len(sheet.faces)) > 0)
    with pytest.raises(GeometryError, match="whose mesh is not closed"):
        fill(box(20, 18, 16), regions=[Region(density=0.4, mesh=sheet)])


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"density": (0.1, 0.3)}, "the density changes everywhere; give one density"),
        ({"pattern": "lightning"}, "branches of lightning follow roofs"),
        ({"cell": 5.0, "line_width": 0.5}, "cell and line_width decide the density; give density"),
    ],
)
def test_a_request_that_cannot_have_regions_says_so(given: dict[str, Any], says: str) -> None:
    with pytest.raises(UsageError, match=says):
        check_request(**{"pattern": "gyroid", "own": {}, **given}, regions=["z=0..1:density=40%"])


def test_a_cell_alone_keeps_the_density_elsewhere() -> None:
    assert check_request(pattern="gyroid", own={}, cell=5.0, regions=["z=0..1:density=40%"]).density == 0.2


def test_regions_are_typed_saved_and_read_again(tmp_path: Path) -> None:
    """In order, with the unit of the part for their meshes."""
    save(box(4, 4, 4), tmp_path / "cube.stl")
    words = [
        "z=10..20:density=40%",
        "z=..5:density=12.5%",
        "box=0,0,0,1,2,3:density=50%",
        f"{tmp_path / 'cube.stl'}:density=60%",
    ]
    settings = resolve({"region": words, "units": "cm"})
    assert [region.text for region in settings.request.regions] == words
    assert settings.request.regions[3].high.tolist() == [20, 20, 20]
    (tmp_path / "again.toml").write_text(settings.to_toml())
    again = resolve({}, config=tmp_path / "again.toml")
    assert again.request.facts() == settings.request.facts()
    assert resolve({"region": [words[0]]}, config=tmp_path / "again.toml").request.facts()["region"] == words[:1]


def test_a_config_file_reads_no_mesh_from_elsewhere(tmp_path: Path) -> None:
    (tmp_path / "theirs.toml").write_text('region = ["/etc/far.stl:density=40%"]\n')
    with pytest.raises(FormatError, match="asks to read a file from elsewhere: region"):
        resolve({}, config=tmp_path / "theirs.toml")


def test_the_command_says_where_the_part_is(tmp_path: Path) -> None:
    save(box(20, 18, 16), tmp_path / "part.stl")
    for more in ("--dry-run", "-o a.stl"):
        words = ["fill", str(tmp_path / "part.stl"), "--region", "z=100..120:density=40%", *more.split()]
        one_line_error(run(*words), "--region z=100..120 lies outside the part; the part spans x -10 to 10")


def test_rows_of_a_grid_leave_out_what_lies_beyond_it() -> None:
    """A ball that reaches out on all sides marks the cells that it marks in a larger grid."""
    ball = trimesh.creation.icosphere(subdivisions=3, radius=5)
    corners = np.asarray(ball.vertices) + 4.1
    small = fill_rows(intersect_rows(corners, ball.faces, (9, 8, 7)), (9, 8, 7))
    large = fill_rows(intersect_rows(corners + 6, ball.faces, (22, 22, 22)), (22, 22, 22))
    assert 0 < small.sum() < small.size
    assert np.array_equal(small, large[6:15, 6:14, 6:13])


def bambu(path: Path, density: str) -> Path:
    """A modifier as Bambu Studio writes it: a component of the type "other"."""
    rows = f'<metadata key="name" value="boss"/><metadata key="sparse_infill_density" value="{density}"/>'
    parts = f'<part id="1" subtype="normal_part"/><part id="2" subtype="modifier_part">{rows}</part>'
    things = thing(1, PART) + thing(2, COLUMN, kind="other") + group(3, component(1), component(2))
    item = '<item objectid="3" transform="1 0 0 0 1 0 0 0 1 100 0 0"/>'
    return packed(path, model(things, item), **{BAMBU: f'<config><object id="3">{parts}</object></config>'})


def cura(path: Path, density: str) -> Path:
    rows = {"infill_mesh": "True", "infill_sparse_density": density}
    told = "".join(f'<metadata name="c:{key}">{value}</metadata>' for key, value in rows.items())
    things = thing(1, PART) + thing(2, COLUMN, inner=f"<metadatagroup>{told}</metadatagroup>")
    space = 'xmlns:c="http://software.ultimaker.com/xml/cura/3mf/2015/10"'
    item = '<item objectid="3" transform="1 0 0 0 1 0 0 0 1 100 0 0"/>'
    return packed(path, model(things + group(3, component(1), component(2)), item, more=space))


def prusa(path: Path, density: str) -> Path:
    told = prusa_config(
        volume(0, 11, volume_type="ModelPart"),
        volume(12, 23, volume_type="ParameterModifier", name="boss", fill_density=density),
    )
    item = '<item objectid="1" transform="1 0 0 0 1 0 0 0 1 100 0 0"/>'
    return packed(path, model(thing(1, PART, COLUMN), item), **{PRUSA: told})


SLICERS = {"prusa": prusa, "bambu": bambu, "cura": cura}


@pytest.mark.parametrize("slicer", SLICERS)
def test_a_modifier_of_a_slicer_is_a_region_where_its_project_places_it(slicer: str, tmp_path: Path) -> None:
    """Below the regions that were asked for; its note says so, and a unit moves it with the part."""
    path = SLICERS[slicer](tmp_path / "project.3mf", "60%" if slicer != "cura" else "60")
    part = read_mesh(path)
    assert len(part.faces) == 12
    assert "is a modifier with 60 % infill, not a part: only 'infill fill' uses it" in part.notes[0]
    asked = check_request(pattern="gyroid", own={}, density=0.2, regions=["z=0..2:density=30%"])
    _, request = add_modifiers(part, asked)
    assert [region.density for region in request.regions] == [0.6, 0.3]
    assert request.regions[0].low.tolist() == [110, 5, -5]
    assert request.regions[0].high.tolist() == [120, 15, 40]
    assert request.facts()["region"] == ["z=0..2:density=30%"]
    assert read_source(path, units="cm").modifiers[0].surface.bounds[0].tolist() == [1100, 50, -50]


@pytest.mark.longest
def test_a_project_is_filled_with_the_density_of_its_modifier(tmp_path: Path) -> None:
    result = fill(read_mesh(prusa(tmp_path / "project.3mf", "60%")), density=0.2, **COARSE)
    rest, region = result.report["regions"]
    assert "volume 'boss'" in region["place"]
    assert [rest["density"], region["density"]] == pytest.approx([0.2, 0.6], abs=HALF_A_POINT)
    assert share_in(result, (110, 5, 1), (120, 15, 9)) == pytest.approx(0.6, abs=2 * HALF_A_POINT)
    assert result.report["problems"] == []


@pytest.mark.parametrize(
    ("density", "given", "says"),
    [
        ("100%", {}, "regions have a density of 1% to 90%"),
        ("0%", {}, "regions have a density of 1% to 90%"),
        ("60%", {"density": (0.1, 0.3)}, "the density is not one number"),
        ("60%", {"cell": 5.0, "line_width": 0.5}, "the density is not one number"),
    ],
)
def test_a_modifier_that_can_be_no_region_is_left_out_with_a_note(
    density: str, given: dict[str, Any], says: str, tmp_path: Path
) -> None:
    part = read_mesh(prusa(tmp_path / "project.3mf", density))
    noted, request = add_modifiers(part, check_request(**{"pattern": "gyroid", "own": {}, **given}))
    assert request.regions == ()
    assert noted.notes[-1].endswith(f"is left out, as {says}")


def test_a_modifier_without_a_density_is_no_region(tmp_path: Path) -> None:
    part = read_mesh(by_ranges(tmp_path / "project.3mf", volume_type="ParameterModifier", layer_height="0.1"))
    assert part.modifiers == ()
    assert part.notes[0].endswith("is a modifier, not a part: it is left out")


def test_places_as_people_type_them() -> None:
    for text in ("0-10mm", "z=0-10", "0..10", "z = 0 to 10 mm", "z=0..10"):
        assert parse_region("region", f"{text}:density=60%").z == (0.0, 10.0)
    assert parse_region("region", "-5--1:density=60%").z == (-5.0, -1.0)
    assert parse_region("region", "part-2.stl:density=60%").mesh == "part-2.stl"
    with pytest.raises(UsageError, match="give a place and a setting, such as z=10"):
        parse_region("region", "middle:density=60%")


def test_a_density_of_a_region_beyond_its_range_is_shown_with_the_region() -> None:
    with pytest.raises(UsageError, match=r"is 'z=0..10:density=200%', with a density of '200%'; .*, up to 90%"):
        parse_region("region", "z=0..10:density=200%")
