"""Projects: what slicers read of them, that the doctor sees each rule of the formats broken, and hostile packages."""

from __future__ import annotations

import io
import json
import re
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import lib3mf
import numpy as np
import pytest
import slicers
import trimesh
from made_shapes import box, less, rod, union
from PIL import Image
from test_command_line import one_line_error, usage_error
from test_command_line import run as command

from infill import FormatError, Surface, UsageError, check_project, fill, read_mesh, save_project
from infill.lattices.request import check_request
from infill.lattices.sizing import enlarge
from infill.meshes.solids import to_manifold
from infill.projects.project import SLICERS, Project, Slicer
from infill.projects.saving import writer_for
from infill.reports.filling import FillReport
from infill.result import Result

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

OTHER = {"prusaslicer": "cura", "orcaslicer": "prusaslicer", "bambustudio": "prusaslicer", "cura": "bambustudio"}
PRUSA, BAMBU, MODEL = "Metadata/Slic3r_PE_model.config", "Metadata/model_settings.config", "3D/3dmodel.model"
prusa = pytest.mark.skipif(bool(slicers.missing_prusa()), reason=slicers.missing_prusa() or "there")
cura = pytest.mark.skipif(bool(slicers.missing_cura()), reason=slicers.missing_cura() or "there")


def surface(mesh: trimesh.Trimesh) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))


@pytest.fixture(scope="module")
def filled() -> Result[Any, FillReport]:
    """A block with a hole and a step, on the bed."""
    return fill(inset(0, 0), "gyroid", as_="project")


def inset(side: float, above: float) -> trimesh.Trimesh:
    """Return the block without so many mm along its sides, and above its bottom and below its tops."""
    low = box(30 - 2 * side, 24 - 2 * side, 14 - 2 * above, (0, 0, 7))
    step = box(10 - 2 * side, 24 - 2 * side, 14 - above, (10, 0, 11 - above / 2))
    mesh = union(less(low, rod(5 + side, 50)), step)
    mesh.apply_translation((100, 80, 0))
    assert mesh.bounds == pytest.approx(
        np.array([[85 + side, 68 + side, above], [115 - side, 92 - side, 18 - above]]), abs=1e-6
    )
    return mesh


@pytest.fixture
def project() -> Project:
    """A box in a box: quick, and with a modifier that slicers fill to the full."""
    return Project(part=surface(box(20, 20, 6)), infill=surface(box(10, 10, 6)), title='a "part" & more')


def saved(project: Project, path: Path, slicer: str) -> Path:
    with path.open("wb") as file:
        writer_for(slicer)(project, file)
    return path


def changed(path: Path, name: str, change: Callable[[str], str | None]) -> Path:
    """Return a copy of a package with one file changed, or left out."""
    target = path.with_name("changed.3mf")
    with zipfile.ZipFile(path) as old, zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as new:
        assert name in old.namelist()
        for each in old.namelist():
            text: str | bytes | None = old.read(each)
            if each == name:
                assert isinstance(text, bytes)
                before = text.decode()
                text = change(before)
                assert text != before
            if text is not None:
                new.writestr(each, text)
    return target


def to(old: str, new: str, count: int = 1) -> Callable[[str], str]:
    """Return a change of some words, which must be there."""

    def change(text: str) -> str:
        assert old in text, text[:500]
        return text.replace(old, new, count)

    return change


# --- what a project holds ---------------------------------------------------------------------------------------------


@pytest.mark.longest
def test_the_infill_of_a_project_goes_through_the_walls_and_lies_in_the_part(filled: Result[Any, FillReport]) -> None:
    part, infill, report = filled.surfaces["part"], filled.surfaces["infill"], filled.report
    assert report["problems"] == []
    assert infill.closed
    assert (infill.bounds[0] >= part.bounds[0] - 1e-6).all()
    assert (infill.bounds[1] <= part.bounds[1] + 1e-6).all()
    both = to_manifold(part) ^ to_manifold(infill)
    assert both.volume() == pytest.approx(infill.volume, rel=1e-6)
    assert infill.bounds == pytest.approx(part.bounds, abs=1e-3)  # as far as the skin, on all sides
    inner = to_manifold(surface(inset(0.9, 0.9)))
    share = (inner ^ to_manifold(infill)).volume() / inner.volume()
    assert share == pytest.approx(report["density"], abs=0.01)
    assert report["density"] == pytest.approx(0.2, abs=0.005)
    assert report["walls"] == {"requested": 0.9, "least": None, "at": None}
    assert report["triangles"] == len(infill.faces)


@pytest.mark.longest
@pytest.mark.parametrize("pattern", ["octet", "honeycomb", "concentric-heart"])
def test_other_patterns_are_as_dense_as_asked_too(pattern: str) -> None:
    result = fill(box(24, 20, 12), pattern, as_="project", density=0.25)
    inner = to_manifold(surface(box(24 - 1.8, 20 - 1.8, 12 - 1.8)))
    share = (inner ^ to_manifold(result.surfaces["infill"])).volume() / inner.volume()
    assert share == pytest.approx(0.25, abs=0.006)
    assert result.report["density"] == pytest.approx(0.25, abs=0.005)
    assert result.report["problems"] == []


@pytest.mark.longest
def test_walls_that_are_one_line_are_told() -> None:
    report = fill(box(20, 20, 10), as_="project", line_width=0.45).report
    assert any("less than two lines" in each for each in report["problems"])


@pytest.mark.longest
@pytest.mark.parametrize("side", [6.0, 8.0])
def test_walls_in_small_parts_stay_as_wide_as_two_lines(side: float) -> None:
    """As in a screw that two perimeters all but fill: narrower walls would not be printed."""
    report = fill(box(side, side, 10), as_="project", density=0.2).report
    assert report["infill"]["line_width"] == pytest.approx(0.9, rel=0.06)
    assert report["density"] == pytest.approx(0.2, abs=0.005)
    assert report["problems"] == []


@pytest.mark.longest
def test_walls_that_slicers_leave_out_are_told() -> None:
    """Whether the pattern is shifted or not: here it stays where it is, as eight more places take long to try."""
    report = fill(box(6, 6, 6), as_="project", density=0.2, line_width=0.3, align="bed").report
    assert report["infill"]["line_width"] == pytest.approx(0.3, rel=0.06)
    assert any(
        "less than a line of a usual nozzle: slicers leave most of them out" in each for each in report["problems"]
    )


@pytest.mark.longest
@pytest.mark.parametrize(("width", "told"), [(0.9, False), (1.2, True), (1.6, False)])
def test_walls_between_two_and_three_lines_are_told(width: float, told: bool) -> None:
    report = fill(box(24, 24, 10), as_="project", line_width=width).report
    assert any("slicers leave gaps in them" in each for each in report["problems"]) == told


@pytest.mark.longest
@pytest.mark.parametrize(("thick", "told"), [(2.1, True), (10.0, False)])
def test_room_that_is_narrower_than_a_line_is_told(thick: float, told: bool) -> None:
    report = fill(box(30, thick, 12), "honeycomb", as_="project", density=0.3, line_width=0.9).report
    narrow = report["infill"]["narrow"]
    assert narrow == pytest.approx(1.0 if told else 0.0, abs=0.02)
    assert any("less room than a line of 0.45 mm" in each for each in report["problems"]) == told


def test_larger_walls_of_a_project_leave_no_gap_between_two_lines() -> None:
    """Where there are too many triangles, cells and walls are larger: to 1.5 mm at least, if to more than 1 mm."""
    request, solid = (check_request(pattern="gyroid", own={}, form=form, density=0.2) for form in ("project", "solid"))
    assert enlarge(request, (12.0, 0.9), 1.05) == pytest.approx((12.6, 0.945))
    assert enlarge(request, (12.0, 0.9), 1.3) == pytest.approx((20.0, 1.5))
    assert enlarge(request, (12.0, 0.9), 2.0) == pytest.approx((24.0, 1.8))
    assert enlarge(solid, (12.0, 0.9), 1.3) == pytest.approx((15.6, 1.17))
    assert enlarge(solid, (12.0, 0.9), 0.5) == (12.0, 0.9)


@pytest.mark.longest
@pytest.mark.parametrize("slicer", SLICERS)
def test_readers_take_every_flavour(slicer: Slicer, filled: Result[Any, FillReport], tmp_path: Path) -> None:
    path = save_project(filled, tmp_path / "part.3mf", slicer=slicer)
    reader = lib3mf.Wrapper().CreateModel().QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(path))
    assert reader.GetWarningCount() == 0
    mesh = read_mesh(path)  # only in a plain project is the infill a part
    parts = [each for name, each in filled.surfaces.items() if name == "part" or slicer == "plain"]
    assert len(mesh.faces) == sum(len(each.faces) for each in parts)
    assert mesh.volume == pytest.approx(sum(each.volume for each in parts), rel=1e-5)
    assert [("modifier" in each) for each in mesh.notes] == [True] * (slicer != "plain")
    with zipfile.ZipFile(path) as package:
        assert Image.open(io.BytesIO(package.read("Metadata/thumbnail.png"))).size == (256, 256)
        types = package.read("[Content_Types].xml").decode()
        for name in package.namelist()[1:]:  # each of a type that is declared
            assert f'Extension="{name.rpartition(".")[2]}"' in types
    found = check_project(path, slicer)
    assert (found.fine, found.problems) == (True, ())
    assert found.warnings == () or slicer == "plain"
    assert [volume.triangles for volume in found.volumes] == [len(each.faces) for each in filled.surfaces.values()]
    again = save_project(filled, tmp_path / "again.3mf", slicer=slicer, title="part")
    assert again.read_bytes() == path.read_bytes()


@pytest.mark.parametrize(("slicer", "other"), OTHER.items())
def test_what_is_for_another_slicer_is_told(slicer: str, other: Slicer, project: Project, tmp_path: Path) -> None:
    found = check_project(saved(project, tmp_path / "a.3mf", slicer), other)
    assert not found.fine
    assert any(f"make it again with --for {other}" in each for each in found.problems)


@pytest.mark.longest
def test_only_a_project_is_saved_as_one(filled: Result[Any, FillReport], tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"part\.stl is to hold a project"):
        save_project(filled, tmp_path / "part.stl", slicer="cura")
    with pytest.raises(UsageError, match="slicer is 'slic4r'; choose from prusaslicer"):
        save_project(filled, tmp_path / "part.3mf", slicer="slic4r")  # type: ignore[arg-type]
    with pytest.raises(UsageError, match="this holds solid, no part and infill"):
        save_project(fill(box(12, 12, 12), voxel=0.6), tmp_path / "part.3mf", slicer="cura")
    assert not list(tmp_path.iterdir())


# --- the doctor: each rule, broken ------------------------------------------------------------------------------------

RULES: dict[str, tuple[str, str, Callable[[str], str | None], str]] = {
    "no relations": ("prusaslicer", "_rels/.rels", lambda text: None, r"has no _rels/\.rels"),
    "a unit": ("plain", MODEL, to("millimeter", "parsec"), "its unit is 'parsec'"),
    "an extension": ("plain", MODEL, to("<model ", '<model requiredextensions="x" '), "requires the extension 'x'"),
    "nothing built": ("plain", MODEL, lambda text: re.sub("<item[^>]*/>", "", text), "nothing in it to print"),
    "not there": ("plain", MODEL, to('objectid="2"', 'objectid="7"'), "builds an object 7"),
    "open": ("plain", MODEL, lambda text: re.sub("<triangle [^>]*/>", "", text, count=1), "part is not closed"),
    "inwards": (
        "plain",
        MODEL,
        lambda text: re.sub(r'v1="(\d+)" v2="(\d+)"', r'v1="\2" v2="\1"', text),
        "part faces inwards",
    ),
    "metadata without a type": ("prusaslicer", PRUSA, to('type="volume" ', ""), "without type=.volume.*not opened"),
    "settings of no object": ("prusaslicer", PRUSA, to('<object id="1"', '<object id="5"'), "an object 5 that the model"),
    "too many triangles": ("prusaslicer", PRUSA, to('lastid="23"', 'lastid="24"'), "12 to 24.*not opened"),
    "too few triangles": ("prusaslicer", PRUSA, to('lastid="23"', 'lastid="20"'), "3 triangles of .* left out"),
    "modifier first": (
        "prusaslicer",
        PRUSA,
        lambda text: re.sub(r"(  <volume.*?</volume>\n)(  <volume.*?</volume>\n)", r"\2\1", text, flags=re.DOTALL),
        "infill comes before part.* lost",
    ),
    "no version": (
        "prusaslicer",
        MODEL,
        lambda text: to('<item objectid="1"', '<item objectid="1" transform="1 0 0 0 1 0 0 0 1 9 9 0"')(
            re.sub("<metadata name=.slic3rpe.*\n", "", text)
        ),
        "only the first volume is moved",
    ),
    "a type": ("prusaslicer", PRUSA, to("ParameterModifier", "Modifier"), "infill is a 'Modifier'"),
    "a density": ("prusaslicer", PRUSA, to('"0.1%"', '"lots"'), "fill_density of part is 'lots'"),
    "a density over 100": ("prusaslicer", PRUSA, to('"0.1%"', '"120%"'), "fill_density of part is '120%'"),
    "a pattern": ("prusaslicer", PRUSA, to('"concentric"', '"gyroid"'), "refuses at 100%"),
    "a vase": ("prusaslicer", PRUSA, to('"0.1%"', '"0%"'), "may lose their solid layers; .* --for prusaslicer, or set"),
    "a vase in Orca": ("orcaslicer", BAMBU, to('"0.1%"', '"0"'), "lose their solid layers; .* --for orcaslicer"),
    "a vase in Bambu": ("bambustudio", BAMBU, to('"0.1%"', '"0.0%"'), "lose their solid layers; .* --for bambustudio"),
    "settings of nothing built": ("orcaslicer", BAMBU, to('<object id="3"', '<object id="4"'), "an object 4 that is not"),
    "settings of no part": ("bambustudio", BAMBU, to('<part id="2"', '<part id="8"'), "about a part 8"),
    "a subtype": ("bambustudio", BAMBU, to("modifier_part", "modifier"), "infill is a 'modifier'"),
    "written by another": ("bambustudio", MODEL, to("BambuStudio-02", "Bambu-02"), "only from files of BambuStudio"),
    "written by Orca": ("bambustudio", MODEL, to("BambuStudio-02", "OrcaSlicer-02"), "only from files of BambuStudio"),
    "written by Prusa": ("orcaslicer", MODEL, to("OrcaSlicer-2", "PrusaSlicer-2"), "drops every setting"),
    "a component": ("orcaslicer", MODEL, to('<component objectid="2"', '<component objectid="9"'), "consists of 9"),
    "no namespace": ("cura", MODEL, lambda text: re.sub(' xmlns:cura="[^"]*"', "", text), "no namespace of Cura"),
    "true": ("cura", MODEL, to(">True<", ">yes<"), "infill_mesh of infill is 'yes'"),
    "no order": ("cura", MODEL, lambda text: re.sub("<metadata name=.cura:infill_mesh_order.*?</metadata>", "", text), "order of at least 1"),
}  # fmt: skip
WARNED: dict[str, tuple[str, str, Callable[[str], str | None], str]] = {
    "inches": ("plain", MODEL, to("millimeter", "inch"), "its unit is the inch"),
    "no settings": ("prusaslicer", PRUSA, to('"fill_pattern" value="concentric"', '"fill_patern" value="concentric"'), "fill_patern of infill is not a volume setting"),
    "no sign": ("prusaslicer", PRUSA, to('"0.1%"', '"0.1"'), "without a % sign"),
    "small rooms": ("prusaslicer", PRUSA, to('below_area" value="0"', 'below_area" value="70"'), "small rooms"),
    "small rooms in Orca": ("orcaslicer", BAMBU, to('infill_area" value="0"', 'infill_area" value="15"'), "small rooms"),
    "walls": ("prusaslicer", PRUSA, to('"fill_pattern" value="concentric"', '"perimeters" value="1"'), "walls are made"),
    "walls too": ("orcaslicer", BAMBU, to('"sparse_infill_pattern" value="concentric"', '"wall_loops" value="1"'), "walls"),
    "unknown": ("orcaslicer", BAMBU, to('"sparse_infill_pattern" value="concentric"', '"fill_pattern" value="concentric"'), "fill_pattern of infill is not a"),
    "unknown to Cura": ("cura", MODEL, to("cura:infill_pattern", "cura:fill"), "fill of infill is not a setting"),
    "density of the part": ("cura", MODEL, to(">0</metadata>", ">20</metadata>"), "its density is not 0"),
    "skins": ("cura", MODEL, to('"cura:top_layers" preserve="1">0', '"cura:top_layers" preserve="1">3'), "skins"),
    "sides": ("cura", MODEL, to('wall_line_count" preserve="1">1', 'wall_line_count" preserve="1">0'), "along its sides"),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("rule", RULES)
def test_a_broken_rule_is_found(rule: str, project: Project, tmp_path: Path) -> None:
    slicer, name, change, says = RULES[rule]
    path = changed(saved(project, tmp_path / "a.3mf", slicer), name, change)
    found = check_project(path, slicer)  # type: ignore[arg-type]
    assert not found.fine
    assert any(re.search(says, each) for each in found.problems), found.problems


@pytest.mark.parametrize("rule", WARNED)
def test_what_may_surprise_is_told(rule: str, project: Project, tmp_path: Path) -> None:
    slicer, name, change, says = WARNED[rule]
    path = changed(saved(project, tmp_path / "a.3mf", slicer), name, change)
    found = check_project(path, slicer)  # type: ignore[arg-type]
    assert found.fine, found.problems
    assert any(re.search(says, each) for each in found.warnings), found.warnings


def test_edges_with_four_faces_are_a_warning(project: Project, tmp_path: Path) -> None:
    corners = [[0, 0, 0], [4, 4, 0]]
    both = [box(4, 4, 4, (x, y, z)) for x, y, z in corners]
    touching = trimesh.util.concatenate(both)
    touching.merge_vertices()
    found = check_project(saved(replace(project, part=surface(touching)), tmp_path / "a.3mf", "plain"), "plain")
    assert found.fine
    assert "part has 1 edge with more than two faces" in found.warnings[1] + found.warnings[0]


def test_parts_in_files_of_their_own_are_found(project: Project, tmp_path: Path) -> None:
    """As OrcaSlicer and Bambu Studio write them, by the production extension."""
    path = saved(project, tmp_path / "a.3mf", "orcaslicer")
    with zipfile.ZipFile(path) as package:
        files = {name: package.read(name).decode() for name in package.namelist() if not name.endswith(".png")}
    root, found = files[MODEL], re.findall(r'<object id="[12]".*?</object>', files[MODEL], flags=re.DOTALL)
    assert len(found) == 2
    for each in found:
        root = root.replace(each, "")
    root = root.replace("<model ", '<model xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" ')
    root = root.replace("<component ", '<component p:path="/3D/Objects/object_1.model" ')
    files[MODEL] = root
    head = root[: root.index("<resources>")]
    files["3D/Objects/object_1.model"] = f"{head}<resources>{''.join(found)}</resources><build/></model>"
    with zipfile.ZipFile(tmp_path / "b.3mf", "w") as package:
        for name, text in files.items():
            package.writestr(name, text)
    one, other = (check_project(tmp_path / name, "orcaslicer") for name in ("a.3mf", "b.3mf"))
    assert (other.problems, other.volumes) == ((), one.volumes)
    assert [volume.role for volume in other.volumes] == ["part", "modifier"]


def test_a_profile_and_components_are_told(project: Project, tmp_path: Path) -> None:
    path = saved(project, tmp_path / "a.3mf", "prusaslicer")
    with zipfile.ZipFile(path, "a") as package:
        package.writestr("Metadata/Slic3r_PE.config", "; fill_density = 15%\n")
    found = check_project(path, "prusaslicer")
    assert found.fine
    assert "print profile" in found.warnings[0]
    grouped = saved(project, tmp_path / "b.3mf", "orcaslicer")
    assert any("components" in each for each in check_project(grouped, "prusaslicer").problems)


# --- PrusaSlicer and Cura themselves ----------------------------------------------------------------------------------


@pytest.mark.longest
@prusa
def test_prusaslicer_prints_the_infill_and_no_wall_more(filled: Result[Any, FillReport], tmp_path: Path) -> None:
    path = save_project(filled, tmp_path / "part.3mf", slicer="prusaslicer")
    part = tmp_path / "part.stl"
    trimesh.Trimesh(filled.surfaces["part"].vertices, filled.surfaces["part"].faces).export(part)
    whole, layers, said = slicers.prusa_volumes(path, tmp_path)
    alone, same, _ = slicers.prusa_volumes(part, tmp_path, fill_density="0%")
    assert layers == same
    assert "substituted" not in said
    assert "repair" not in said.lower()
    for kind in ("Perimeter", "External perimeter", "Overhang perimeter"):
        assert whole.get(kind, 0.0) == pytest.approx(alone.get(kind, 0.0), rel=0.01)
    # What the infill body has inside of two perimeters and between three solid layers: the block without those.
    body = (to_manifold(surface(inset(0.857, 0.6))) ^ to_manifold(filled.surfaces["infill"])).volume()
    assert sum(whole.values()) - sum(alone.values()) == pytest.approx(body, rel=0.05)
    facts = slicers.run_slicer(["prusa-slicer", "--datadir", "data", "--info", str(path)], tmp_path)
    assert "manifold = yes" in facts
    assert "edges_fixed" not in facts


@pytest.mark.long
@prusa
@pytest.mark.parametrize(
    "rule", ["too many triangles", "metadata without a type", "modifier first", "settings of no object"]
)
def test_prusaslicer_does_what_the_doctor_says(rule: str, project: Project, tmp_path: Path) -> None:
    path = saved(project, tmp_path / "a.3mf", "prusaslicer")
    right = sum(slicers.prusa_volumes(path, tmp_path)[0].values())
    broken = changed(path, RULES[rule][1], RULES[rule][2])
    if "not opened" in RULES[rule][3]:
        with pytest.raises(RuntimeError):
            slicers.prusa_volumes(broken, tmp_path)
        return
    assert sum(slicers.prusa_volumes(broken, tmp_path, fill_density="0%")[0].values()) < 0.9 * right


@pytest.mark.longest
@cura
def test_cura_prints_the_infill(filled: Result[Any, FillReport], tmp_path: Path) -> None:
    """By its engine, which reads no 3MF: with the settings that the project has."""
    from infill.projects.cura import INFILL_SETTINGS

    own = {**INFILL_SETTINGS, "infill_line_distance": "0.45"}  # which Cura derives from the density
    del own["infill_sparse_density"]
    common = {
        "layer_height": 0.2,
        "layer_height_0": 0.2,
        "infill_sparse_thickness": 0.2,
        "adhesion_type": "none",
        "infill_line_distance": 0,
        "wall_line_count": 2,
        **dict.fromkeys(
            ("line_width", "wall_line_width_0", "wall_line_width_x", "infill_line_width", "skin_line_width"), 0.45
        ),
        **dict.fromkeys(("top_layers", "bottom_layers", "initial_bottom_layers"), 4),
    }
    words = [word for name, value in common.items() for word in ("-s", f"{name}={value}")]
    added = [word for name, value in own.items() for word in ("-s", f"{name}={value}")]
    definitions = slicers.cura_definitions()
    for name, each in filled.surfaces.items():
        moved = each.vertices - np.array([100, 80, 0])
        trimesh.Trimesh(moved, each.faces).export(tmp_path / f"{name}.stl")

    def extruded(*more: str) -> float:
        start = ["CuraEngine", "slice", "-v", "-j", f"{definitions}/fdmprinter.def.json", *words, "-e0", *words]
        start += ["-o", "out.gcode", "-l", "part.stl", *more]
        path = f"{definitions}:{definitions}/../extruders"
        said = slicers.run_slicer(start, tmp_path, CURA_ENGINE_SEARCH_PATH=path)
        return float(re.findall(r"^Filament \(mm\^3\): ([\d.]+)", said, re.MULTILINE)[0])

    body = (to_manifold(surface(inset(0.9, 0.8))) ^ to_manifold(filled.surfaces["infill"])).volume()
    assert extruded("-l", "infill.stl", *added) - extruded() == pytest.approx(body, rel=0.06)


# --- the command ------------------------------------------------------------------------------------------------------


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.chdir(tmp_path)
    box(16, 12, 10).export("part.stl")
    return tmp_path


@pytest.mark.longest
def test_a_project_makes_itself_again(folder: Path) -> None:
    words = ["fill", "part.stl", "--for", "cura", "--pattern", "concentric-heart", "--set", "hearts=3", "-q"]
    assert command(*words, "--phase", "1", "0.5", "0", "-o", "a.3mf").exit_code == 0
    assert command("fill", "part.stl", "--config", "a.3mf", "-q", "-o", "b.3mf").exit_code == 0
    assert Path("a.3mf").read_bytes() == Path("b.3mf").read_bytes()
    assert command("fill", "part.stl", "--config", "a.3mf", "--save-config", "a.toml", "-q").exit_code == 0
    assert command("fill", "part.stl", "--config", "a.toml", "-q", "-o", "c.3mf").exit_code == 0
    assert Path("a.3mf").read_bytes() == Path("c.3mf").read_bytes()
    text = Path("a.toml").read_text()
    assert "hearts = 3" in text
    assert 'for = "cura"' in text


@pytest.mark.slow
def test_projects_for_several_slicers_are_those_of_one_each(folder: Path) -> None:
    """One fill, a file for each slicer, with the bytes that it has alone; its settings name that slicer only."""
    words = ["fill", "part.stl", "--pattern", "grid", "--cell", "6", "--voxel", "0.8", "-q"]
    both = command(*words, "--for", "cura", "--for", "prusaslicer", "-o", "{slicer}.3mf", "--json")
    assert both.exit_code == 0
    assert json.loads(both.stdout)["files"] == ["cura.3mf", "prusaslicer.3mf"]
    for slicer in ("cura", "prusaslicer"):
        assert command(*words, "--for", slicer, "-o", "alone-{slicer}.3mf").exit_code == 0
        assert Path(f"alone-{slicer}.3mf").read_bytes() == Path(f"{slicer}.3mf").read_bytes()
    assert command(*words, "--for", "cura", "--for", "plain", "--save-config", "a.toml").exit_code == 0
    assert 'for = ["cura", "plain"]' in Path("a.toml").read_text()
    one_name = ["fill", "part.stl", "--config", "a.toml", "-o", "a.3mf"]
    one_line_error(command(*one_name), "for is given for 2 slicers, and a.3mf is one file; give -o a-{slicer}.3mf")
    usage_error(command("fill", "part.stl", "--for", "cura", "--for", "plain", "-o", "a.3mf"), "--for is given for 2")
    assert command(*one_name[:-1], "a-{slicer}.3mf", "--dry-run", "-q").exit_code == 0  # what it recommends
    one_line_error(command(*words, "--for", "cura", "-o", "{slicer}.3mf"), "cura.3mf exists")


@pytest.mark.slow
def test_what_is_typed_wins_over_the_file(folder: Path) -> None:
    Path("a.toml").write_text(
        'pattern = "honeycomb"\ndensity = "30%"\nline-width = 0.6\nas = "project"\nfor = "cura"\n'
    )
    saves = ["fill", "part.stl", "--config", "a.toml", "--save-config", "-"]
    said = command(*saves, "--cell", "5").stdout
    assert "cell = 5" in said
    assert "density" not in said
    assert "line_width = 0.6" in said
    said = command(*saves, "--as", "solid", "--pattern", "octet").stdout
    assert 'as = "solid"' in said
    assert "for" not in said
    assert 'pattern = "octet"' in said
    Path("b.toml").write_text('densty = "30%"\n')
    one_line_error(
        command("fill", "part.stl", "--config", "b.toml", "-o", "a.stl"), "fill has no option 'densty'.*density"
    )
    Path("b.toml").write_text('pattern = "gyroid"\n[set]\nwaves = 3\n')
    one_line_error(command("fill", "part.stl", "--config", "b.toml", "-o", "a.stl"), "gyroid has no parameter 'waves'")
    one_line_error(command("fill", "part.stl", "--config", "part.3mf", "-o", "a.stl"), "part.3mf")
    assert sorted(each.name for each in folder.iterdir()) == ["a.toml", "b.toml", "part.stl"]


@pytest.mark.slow
def test_wrong_combinations_are_told(folder: Path) -> None:
    usage_error(command("fill", "part.stl", "--as", "project", "-o", "a.3mf"), "--as is 'project', and for is missing")
    usage_error(command("fill", "part.stl", "--for", "cura", "--as", "solid", "-o", "a.3mf"), "--for is 'cura'")
    usage_error(command("fill", "part.stl", "--for", "cura", "--drain", "2", "-o", "a.3mf"), "--drain is for a shell")
    one_line_error(command("fill", "part.stl", "--for", "cura", "-o", "a.stl"), "a.stl is to hold a project")
    assert [each.name for each in folder.iterdir()] == ["part.stl"]


@pytest.mark.slow
def test_check_says_what_a_slicer_will_do(project: Project, folder: Path) -> None:
    path = saved(project, folder / "a.3mf", "orcaslicer")
    good = command("check", "a.3mf", "--for", "orcaslicer")
    assert good.exit_code == 0
    assert "fine        yes" in good.stdout
    assert "infill: modifier, 12 triangles, closed" in good.stdout
    bad = command("check", "a.3mf", "--for", "prusaslicer", "--json")
    assert bad.exit_code == 1
    assert json.loads(bad.stdout)["problems"]
    both = command("check", "a.3mf", "part.stl", "--for", "orcaslicer", "--json")
    assert both.exit_code == 1
    assert [each.get("fine") for each in json.loads(both.stdout)] == [True, None]
    one_line_error(command("check", "part.stl", "--for", "cura"), "part.stl is a mesh, and .* leave --for out")
    warned = changed(path, MODEL, to("millimeter", "inch"))
    assert command("check", str(warned), "--for", "orcaslicer").exit_code == 0
    assert command("check", str(warned), "--for", "orcaslicer", "--strict").exit_code == 1


# --- hostile packages -------------------------------------------------------------------------------------------------


def packaged(path: Path, model: str, **more: str | bytes) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as package:
        for name, text in {MODEL: model, **more}.items():
            package.writestr(name, text)
    return path


START = '<model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>'


@pytest.mark.longest
def test_hostile_packages_are_refused_in_a_line(tmp_path: Path) -> None:
    laughs = "".join(f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 12))
    entities = f'<?xml version="1.0"?><!DOCTYPE m [<!ENTITY a0 "ha">{laughs}]>{START}&a11;</resources><build/></model>'
    nested = "".join(
        f'<object id="{n}"><components>{f"<component objectid={chr(34)}{n - 1}{chr(34)}/>" * 10}</components></object>'
        for n in range(1, 18)
    )
    mesh = '<mesh><vertices><vertex x="0" y="0" z="0"/></vertices><triangles/></mesh>'
    bombs = {
        "unpack": packaged(tmp_path / "zip.3mf", START + " " * 400_000_000),
        "unpack to": packaged(tmp_path / "rels.3mf", START, **{"_rels/.rels": "<a>" + " " * 400_000_000}),
        "document type": packaged(tmp_path / "entities.3mf", entities),
        "places its objects": packaged(
            tmp_path / "nested.3mf",
            f'{START}<object id="0">{mesh}</object>{nested}</resources><build><item objectid="17"/></build></model>',
        ),
        "refers to an object": packaged(
            tmp_path / "round.3mf",
            f'{START}<object id="1"><components><component objectid="1"/></components></object></resources>'
            '<build><item objectid="1"/></build></model>',
        ),
    }
    for says, path in bombs.items():
        with pytest.raises(FormatError, match=says) as told:
            read_mesh(path)
        assert "\n" not in str(told.value)
    for says, path in bombs.items():
        if says in ("unpack", "unpack to", "document type"):
            with pytest.raises(FormatError, match=says):
                check_project(path, "prusaslicer")
        else:
            assert not check_project(path, "prusaslicer").fine


def test_paths_out_of_a_package_lead_nowhere(tmp_path: Path) -> None:
    """Nothing is unpacked to disk, and what a component names is looked for in the package alone."""
    (tmp_path / "in").mkdir()
    (tmp_path / "secret.model").write_text(START)
    text = (
        f'{START}<object id="1"><components><component p:path="/../secret.model" objectid="1" xmlns:p="p"/></components>'
        '</object></resources><build><item objectid="1"/></build></model>'
    )
    path = packaged(tmp_path / "in" / "a.3mf", text, **{"../out.txt": "out", "/etc/out.txt": "out"})
    with pytest.raises(FormatError, match="refers to an object 1 that it does not hold"):
        read_mesh(path)
    with pytest.raises(FormatError, match="no options of phasefill"):
        from infill.formats.threemf import read_attached_settings

        read_attached_settings(path)
    assert sorted(each.name for each in tmp_path.rglob("*")) == ["a.3mf", "in", "secret.model"]


@pytest.mark.slow
def test_a_part_is_filled_for_a_slicer(tmp_path: Path) -> None:
    """Python's for_ is the command's --for: the slicer is kept until the project is written."""
    result = fill(box(12, 12, 8), for_="prusa", voxel=0.6)
    path = save_project(result, tmp_path / "a.3mf")
    named = save_project(result, tmp_path / "b.3mf", slicer="prusaslicer", title="a")
    assert path.read_bytes() == named.read_bytes()
    assert save_project(result, tmp_path / "c.3mf", slicer="cura", title="a").read_bytes() != path.read_bytes()
    with pytest.raises(UsageError, match="slicer is missing; choose from prusaslicer"):
        save_project(fill(box(12, 12, 8), as_="project", voxel=0.6), tmp_path / "d.3mf")
    with pytest.raises(UsageError, match="for is 'slic3r'"):
        fill(box(12, 12, 8), for_="slic3r")
    with pytest.raises(UsageError, match="for is 'cura', which makes a project, and as is 'infill'"):
        fill(box(12, 12, 8), as_="infill", for_="cura")
