"""Every label in one run: each is smoothed as if it were alone in the whole volume, and goes where its name says."""

from __future__ import annotations

import json
import re
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from test_command_line import one_line_error, refused, run
from test_label_tables import FIELDS, SNAP, VALUES, seg_nrrd

from infill import (
    ParameterError,
    Result,
    Segment,
    Segmentation,
    Smoothing,
    Volume,
    read_mesh,
    read_volume,
    smooth_labels,
    smooth_volume,
)
from infill.errors import FormatError, InfillError, LabelChoiceError
from infill.smoothing.label_runs import LabelWork, count_alone, run_labels
from infill.voxels.labels import MOST_LABELS, label_extents

NAMED = "Segment0_Name:=Femur\nSegment0_LabelValue:=1\nSegment1_Name:=Tibia\nSegment1_LabelValue:=7\n"
pytestmark = pytest.mark.usefixtures("compiled", "silent_compiler")


def ball(shape: tuple[int, ...], middle: tuple[float, ...], radius: float) -> np.ndarray:
    return ((np.indices(shape) - np.reshape(middle, (3, 1, 1, 1))) ** 2).sum(axis=0) <= radius**2


def bones(dtype: Any = np.uint8) -> np.ndarray:
    """Three labels: a ball, one that touches it, and one at the edge of the volume."""
    values = np.zeros((90, 60, 70), dtype=dtype)
    values[ball(values.shape, (30, 30, 35), 12)] = 3
    values[ball(values.shape, (50, 28, 33), 10) & (values == 0)] = 7
    values[ball(values.shape, (85, 30, 60), 14) & (values == 0)] = 200
    return values


# --- where labels lie ------------------------------------------------------------------------------------


@given(arrays.arrays(np.int16, arrays.array_shapes(min_dims=3, max_dims=3, max_side=6), elements=st.integers(-2, 4)))
def test_an_extent_holds_all_of_its_label_and_no_less(values: np.ndarray) -> None:
    for shape in (values, np.asfortranarray(values), values.transpose(2, 0, 1), values[::-1]):
        found = label_extents(Volume(values=shape))
        assert [each.value for each in found] == [value for value in np.unique(values).tolist() if value != 0]
        for each in found:
            where = np.argwhere(shape == each.value)
            assert each.low == tuple(where.min(axis=0))
            assert each.high == tuple(where.max(axis=0) + 1)
            along = int(np.argmin(np.abs(shape.strides)))
            is_here = np.moveaxis(shape == each.value, along, -1)
            if len(set(shape.strides)) == 3:  # else axes of one cell are in no certain order
                assert each.runs == int(np.count_nonzero(np.diff(is_here, axis=-1, prepend=False) & is_here))


@pytest.mark.parametrize(
    "dtype", [bool, np.int8, np.uint8, np.uint16, np.int32, np.int64, np.uint64, np.float32, float]
)
def test_labels_of_every_type(dtype: Any) -> None:
    values = np.zeros((4, 5, 6), dtype=dtype)
    values[1, 2, 3] = 1
    assert [each.value for each in label_extents(Volume(values=values))] == [1]


def test_large_numbers_are_labels_too() -> None:
    values = np.zeros((4, 5, 6), dtype=np.int64)
    values[1], values[2] = 2_000_000_000, 70_000
    assert [each.value for each in label_extents(Volume(values=values))] == [70_000, 2_000_000_000]


def test_grey_values_are_no_labels() -> None:
    with pytest.raises(ParameterError, match="not whole numbers, and so not labels; give --threshold X"):
        label_extents(Volume(values=np.linspace(0, 1, 27).reshape(3, 3, 3)))
    with pytest.raises(ParameterError, match=f"more than the {MOST_LABELS} labels"):
        label_extents(Volume(values=np.arange(20**3, dtype=np.int32).reshape(20, 20, 20)))


# --- smoothing -------------------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize(
    "options",
    [
        {},
        {"refine": True},
        {"smoothing": Smoothing(steps=60, interface=4.0), "refine": False},
        {"smoothing": Smoothing(steps=20, interface=0.7)},
        {"level": 0},
        {"despeckle": 20.0},
    ],
    ids=str,
)
def test_the_surface_is_that_of_the_whole_volume(options: dict[str, Any]) -> None:
    """Vertex by vertex: nothing beyond the part that a label is smoothed in has an effect."""
    values = bones()
    values[4, 4, 4] = 7  # a speck far away, which makes the part of this label larger
    volume = Volume(values=values, spacing=(0.5, 0.6, 0.7), origin=(10, -20, 30), space="LPS")
    result = smooth_labels(volume, allow_broken=True, tolerance=None, **options)
    assert list(result.surfaces) == ["label_3", "label_7", "label_200"]
    for name, surface in result.surfaces.items():
        whole = smooth_volume(volume, label=int(name[6:]), allow_broken=True, tolerance=None, **options).surface
        assert np.array_equal(surface.faces, whole.faces)
        assert np.abs(surface.vertices - whole.vertices).max() < 1e-12  # corners are added in another order
        assert surface.space == "LPS"
        assert surface.closed


@pytest.mark.slow
def test_a_margin_too_small_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("infill.smoothing.label_stages.REACH_IN_INTERFACES", 0)
    monkeypatch.setattr("infill.smoothing.label_stages.REFINING_MARGIN", 0)
    monkeypatch.setattr("infill.smoothing.label_pieces.BRICK", (1, 1, 1))
    values = bones()
    surface = smooth_labels(values, label=3, tolerance=None).surface
    whole = smooth_volume(values, label=3, tolerance=None).surface
    assert len(surface.vertices) != len(whole.vertices) or np.abs(surface.vertices - whole.vertices).max() > 1e-6


@pytest.mark.slow
def test_labels_that_are_asked_for_come_in_the_order_of_their_numbers() -> None:
    assert list(smooth_labels(bones(), label=(200, 3), tolerance=None).surfaces) == ["label_3", "label_200"]
    assert list(smooth_labels(bones(), label=7, tolerance=None).surfaces) == ["label_7"]
    assert list(smooth_labels(-bones(np.int16), label=-7, tolerance=None).surfaces) == ["label_-7"]


@pytest.mark.slow
def test_names_and_colours_come_from_the_table_or_else_from_the_segmentation() -> None:
    volume = Volume(values=bones())
    own = (Segment(value=3, name="own", colour=(1, 0, 0)), Segment(value=7, name="same"), Segment(value=9, name="none"))
    result = smooth_labels(
        Segmentation(layers=(volume,), segments=own),
        table=[Segment(value=3, name="table"), Segment(value=200, name="same", colour=(0, 0, 1)), Segment(value=5)],
        tolerance=None,
    )
    assert list(result.surfaces) == ["table", "same", "same_200"]
    assert result.colours == {"same_200": (0, 0, 1)}
    assert result.report["absent"] == ["none"]
    assert result.stages.segments["same_200"] == Segment(value=200, name="same", colour=(0, 0, 1))


@pytest.mark.slow
def test_names_stay_different_whatever_they_are() -> None:
    layer = Volume(values=bones())
    names = [Segment(value=value, name="a", layer=k) for k in range(3) for value in (3, 7, 200)]
    result = smooth_labels(Segmentation(layers=(layer, layer, layer), segments=tuple(names)), tolerance=None)
    assert len(result.surfaces) == 9
    assert list(result.surfaces)[:4] == ["a", "a_7", "a_200", "a_3"]


SPECK = bones()
SPECK[10:14, 40:44, 5:9] = 9  # 64 cells, all of them despeckled


@pytest.mark.slow
def test_one_that_fails_is_named_and_nothing_is_returned() -> None:
    with pytest.raises(ParameterError, match=r"^label 9 \(Scapula\): despeckle is 100 mm³") as caught:
        smooth_labels(SPECK, table=[Segment(value=9, name="Scapula")], despeckle=100, tolerance=None)
    assert "\n" not in str(caught.value)


def same(one: Any, other: Any) -> bool:
    """Compare reports but for the seconds."""
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one if key != "seconds")
    return bool(one == other)


def test_surfaces_and_reports_do_not_depend_on_threads() -> None:
    few, many = (smooth_labels(bones(), allow_broken=True, threads=threads) for threads in (1, 3))
    assert list(few.surfaces) == list(many.surfaces) == ["label_3", "label_7", "label_200"]
    for name, surface in few.surfaces.items():
        assert surface.vertices.tobytes() == many.surfaces[name].vertices.tobytes()
        assert surface.faces.tobytes() == many.surfaces[name].faces.tobytes()
    for one, other in zip(few.report["labels"], many.report["labels"], strict=True):
        assert same({**one["report"]}, {**other["report"]})


def test_distances_of_labels_are_measured_when_they_are_read() -> None:
    """They are those of the label alone in the whole volume; until then, a report holds bits, not the field."""
    volume = Volume(values=bones(), spacing=(0.5, 0.6, 0.7), origin=(10, -20, 30), space="LPS")
    result = smooth_labels(volume, allow_broken=True, tolerance=None)
    for name, label in zip(result.surfaces, result.report["labels"], strict=True):
        report: Any = label["report"]
        assert report.pending("distance")
        solid = report.late["distance"].func.__self__
        arrays_held = (solid.field.values, solid.field.data, solid.field.where)
        assert [array.base for array in arrays_held] == [None] * 3
        assert solid.field.values.size == solid.field.data.size == 0
        assert solid.bits.nbytes == 128 * len(solid.field.where)
        assert solid.place.values.strides == (0, 0, 0)
        distance = smooth_volume(volume, label=int(name[6:]), allow_broken=True, tolerance=None).report["distance"]
        assert report["distance"]["from"] == distance["from"]
        for side in ("result", "input"):
            for key in ("mean", "rms", "p95", "max"):
                assert report["distance"][side][key] == pytest.approx(distance[side][key], rel=1e-6)


def test_thick_slices_are_labels_too() -> None:
    result = smooth_labels(Volume(values=bones()[:, :, ::3], spacing=(1, 1, 3)), label=3)
    assert result.report["labels"][0]["report"]["distance"]["result"]["max"] < 3


@pytest.mark.parametrize("threads", [1, 2, 4])
@pytest.mark.parametrize("stop", [True, False])
def test_labels_run_beside_each_other_and_the_first_error_is_kept(threads: int, stop: bool) -> None:
    """Whatever is large or small: outcomes come in order, and before the first error none is missing."""
    sizes = [3, 500, 20, 20, 1, 90, 4]
    seen: list[float] = []

    def smooth(number: int, inner: int, progress: Any) -> int | InfillError:
        assert 1 <= inner <= threads
        progress("smooth", 0.5)
        return ParameterError(str(number)) if number in (2, 4) else number

    outcomes = run_labels(
        smooth,
        [LabelWork(cells=size, memory=size) for size in sizes],
        stop_early=stop,
        threads=threads,
        max_memory=None,
        progress=lambda stage, share: seen.append(share),
    )
    assert outcomes[:2] == [0, 1]
    assert str(outcomes[2]) == "2"
    assert seen == sorted(seen)
    if not stop:
        assert [outcomes[n] for n in (3, 5, 6)] == [3, 5, 6]
        assert str(outcomes[4]) == "4"


def test_an_interrupt_ends_all_threads() -> None:
    begun: list[int] = []

    def smooth(number: int, inner: int, progress: Any) -> int:
        begun.append(number)
        raise KeyboardInterrupt

    works = [LabelWork(cells=1, memory=1)] * 50
    with pytest.raises(KeyboardInterrupt):
        run_labels(smooth, works, stop_early=False, threads=3, max_memory=None, progress=None)
    assert len(begun) <= 3


@pytest.mark.parametrize(
    ("sizes", "threads", "allowed", "alone"),
    [
        ([10, 10], 2, None, 0),
        ([10, 4, 4], 2, None, 1),  # the other thread would wait for it
        ([10, 6, 4], 2, None, 0),
        ([10, 6, 4], 4, None, 3),
        ([10, 6, 4], 1, None, 0),
        ([10, 6, 6, 4], 2, 15, 1),  # the first two do not fit together
        ([10, 6, 6, 4], 2, 9, 4),
    ],
)
def test_large_labels_come_alone(sizes: list[int], threads: int, allowed: int | None, alone: int) -> None:
    assert count_alone([LabelWork(cells=size, memory=size) for size in sizes], threads, allowed) == alone


@pytest.mark.slow
def test_the_others_go_on_if_that_is_asked_for() -> None:
    result = smooth_labels(SPECK, keep_going=True, despeckle=100, tolerance=None)
    assert list(result.surfaces) == ["label_3", "label_7", "label_200"]
    assert [(each["number"], "despeckle" in each["error"]) for each in result.report["failed"]] == [(9, True)]
    assert list(result.stages.failed) == ["label_9"]
    with pytest.raises(ParameterError, match="^no label can be smoothed; label 9: "):
        smooth_labels(SPECK, label=9, keep_going=True, despeckle=100, tolerance=None)


@pytest.mark.parametrize(
    ("values", "options", "says"),
    [
        (bones(), {"label": 4}, "label is 4, and the volume holds 3, 7, 200"),
        (np.arange(512).reshape(8, 8, 8), {"label": 999}, "label is 999, and the volume holds 1, 2, 3, .* …"),
        (np.zeros((4, 4, 4), int), {}, "holds no label, only 0"),
        (bones(), {"level": 2}, "^level is 2"),  # and not that of the first label
        (bones(), {"despeckle": -1}, "^despeckle is -1"),
    ],
)
def test_what_cannot_be_is_told(values: np.ndarray, options: dict[str, Any], says: str) -> None:
    with pytest.raises(ParameterError, match=says):
        smooth_labels(values, **options)


@pytest.mark.slow
def test_progress_goes_from_nothing_to_all() -> None:
    seen: list[float] = []
    smooth_labels(bones(), progress=lambda stage, share: seen.append(share), tolerance=None)
    assert seen == sorted(seen)
    assert seen[0] == 0
    assert 0.9 < seen[-1] <= 1


@pytest.mark.slow
@settings(max_examples=15, deadline=None)
@given(arrays.arrays(np.uint8, (9, 8, 7), elements=st.integers(0, 3)))
def test_any_labels_give_closed_surfaces_or_one_line(values: np.ndarray) -> None:
    if not values.any() or (values == values[0, 0, 0]).all():
        return
    result = smooth_labels(values, allow_broken=True, keep_going=True, tolerance=None)
    for surface in result.surfaces.values():
        assert surface.closed


# --- files of several objects ----------------------------------------------------------------------------

TABLE = (
    Segment(value=3, name='Femur <left> & "right"', colour=(1.0, 0.5, 0.0)),
    Segment(value=7, name="骨盆"),
    Segment(value=200, name="a\x01b", colour=(0.0, 0.0, 1.0)),
)


@pytest.fixture(scope="module")
def result(compiled: None) -> Result[Any, Any]:
    return smooth_labels(bones(), table=TABLE, tolerance=None)


@pytest.mark.slow
def test_a_3mf_has_an_object_for_each_with_name_and_colour(result: Result[Any, Any], tmp_path: Path) -> None:
    lib3mf = pytest.importorskip("lib3mf", reason="lib3mf is not installed (extra test)")
    path = result.save(tmp_path / "all.3mf")
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(path))
    assert reader.GetWarningCount() == 0
    items = model.GetBuildItems()
    found = []
    while items.MoveNext():
        mesh = model.GetMeshObjectByID(items.GetCurrent().GetObjectResource().GetResourceID())
        assert mesh.IsManifoldAndOriented()
        colour = None
        number, index, there = mesh.GetObjectLevelProperty()
        if there:
            shade = model.GetBaseMaterialGroupByID(number).GetDisplayColor(index)
            colour = (shade.Red, shade.Green, shade.Blue)
        found.append((mesh.GetName(), colour, mesh.GetVertexCount()))
    counts = [len(surface.vertices) for surface in result.surfaces.values()]
    assert found == [
        ('Femur <left> & "right"', (255, 128, 0), counts[0]),
        ("骨盆", None, counts[1]),
        ("ab", (0, 0, 255), counts[2]),
    ]


def test_a_glb_has_a_node_for_each_with_name_and_colour(result: Result[Any, Any], tmp_path: Path) -> None:
    scene = trimesh.load_scene(result.save(tmp_path / "all.glb"), process=False)
    assert list(scene.geometry) == ['Femur <left> & "right"', "骨盆", "ab"]
    for mesh, surface in zip(scene.geometry.values(), result.surfaces.values(), strict=True):
        assert np.allclose(mesh.vertices, surface.vertices, atol=1e-4)
        assert np.array_equal(mesh.faces, surface.faces)
    shades = [scene.geometry[name].visual.material.baseColorFactor for name in ('Femur <left> & "right"', "ab")]
    # Half of sRGB is a fifth of the light.
    assert shades[0].tolist() == pytest.approx([255, round(255 * 0.2140), 0, 255], abs=1)
    assert shades[1].tolist() == [0, 0, 255, 255]


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".3mf", ".glb"])
def test_several_objects_are_read_back_as_one_mesh(suffix: str, result: Result[Any, Any], tmp_path: Path) -> None:
    back = read_mesh(result.save(tmp_path / f"all{suffix}"))
    assert back.volume == pytest.approx(sum(each.volume for each in result.surfaces.values()), rel=1e-5)


@pytest.mark.slow
def test_a_format_of_one_mesh_is_told(result: Result[Any, Any], tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"can hold one mesh .*; use .3mf or .glb, or \{label\} in the name"):
        result.save(tmp_path / "all.stl")
    with pytest.raises(FormatError, match="cannot tell a mesh format"):
        result.save(tmp_path / "all.abc")
    assert list(tmp_path.iterdir()) == []
    assert smooth_labels(bones(), label=3, tolerance=None).save(tmp_path / "one.stl").exists()


def test_no_more_files_are_open_at_a_time_than_one(tmp_path: Path) -> None:
    """A system may allow 256."""
    from infill.files.whole_files import write_all_files

    held: list[Any] = []

    def write(file: Any) -> None:
        assert all(other.closed for other in held)
        held.append(file)
        file.write(b"x")

    write_all_files({tmp_path / str(number): write for number in range(300)})
    assert len(list(tmp_path.iterdir())) == 300


# --- the command -----------------------------------------------------------------------------------------


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    np.save("bones.npy", bones())
    np.save("speck.npy", SPECK)
    Path("names.txt").write_text(SNAP.replace("    1   255", "    3   255"))
    return tmp_path


def names(folder: Path) -> set[str]:
    return {each.name for each in folder.iterdir()} - {"bones.npy", "speck.npy", "names.txt"}


@pytest.mark.slow
def test_a_file_for_each_label(folder: Path) -> None:
    done = run("smooth", "bones.npy", "-o", "{label}.stl", "-o", "{number}.ply")
    assert done.exit_code == 0, done.output
    assert done.stdout == ""
    wanted = {f"label_{n}.stl" for n in (3, 7, 200)} | {f"{n}.ply" for n in (3, 7, 200)}
    assert names(folder) == wanted
    for word in ("3 label_3", "200 label_200", "triangles", "6 files"):
        assert word in done.stderr
    assert read_mesh("label_7.stl").volume == pytest.approx((bones() == 7).sum(), rel=1e-3)
    alone = run("smooth", "bones.npy", "--label", "7", "-o", "alone.stl")
    assert alone.exit_code == 0
    assert Path("alone.stl").read_bytes() == Path("label_7.stl").read_bytes()


@pytest.mark.slow
def test_names_of_a_table_and_one_file_for_all(folder: Path) -> None:
    done = run("smooth", "bones.npy", "-o", "x_{label}.stl", "-o", "all.3mf", "--labels", "names.txt", "--json")
    assert done.exit_code == 0, done.output
    assert names(folder) == {"x_Label 1.stl", "x_Os coxae, left.stl", "x_label_200.stl", "all.3mf"}
    found = json.loads(done.stdout)
    assert found["files"] == ["x_Label 1.stl", "x_Os coxae, left.stl", "x_label_200.stl", "all.3mf"]
    assert [(each["number"], each["name"], each["colour"]) for each in found["labels"]] == [
        (3, "Label 1", "#FF0000"),
        (7, "Os coxae, left", "#0080FF"),
        (200, "label_200", None),
    ]
    with zipfile.ZipFile("all.3mf") as package:
        model = package.read("3D/3dmodel.model").decode()
    assert re.findall(r'<object id="\d" type="model" name="([^"]+)"', model) == [
        "Label 1",
        "Os coxae, left",
        "label_200",
    ]


@pytest.mark.slow
def test_each_label_into_one_file(folder: Path) -> None:
    assert run("smooth", "bones.npy", "-o", "all.glb", "--each-label", "-q").stderr == ""
    assert len(trimesh.load_scene("all.glb").geometry) == 3


@pytest.mark.slow
def test_a_segmentation_of_slicer_with_layers(folder: Path) -> None:
    pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")
    seg_nrrd(folder / "a.seg.nrrd", FIELDS + "Segment11_Name:=plan\nSegment11_LabelValue:=7\nSegment11_Layer:=1\n")
    done = run("smooth", "a.seg.nrrd", "-o", "{label}.stl", "--allow-broken", "--smooth", "plain")
    assert done.exit_code == 0, done.output
    assert names(folder) == {"a.seg.nrrd", "Femur, left_right.stl", "Cartilage.stl", "Plan.stl"}
    assert "without a cell" in done.stderr
    one_line_error(run("smooth", "a.seg.nrrd", "-o", "{number}.obj"), "1.obj would be written for several labels")
    one_line_error(
        run("smooth", "a.seg.nrrd", "-o", "b.stl"),
        r"holds 2 layers of segments; write all with \{label\} .*; choose one of its 2 frames: --frame 0 to --frame 1",
    )
    assert run("smooth", "a.seg.nrrd", "--frame", "1", "-o", "b.stl", "--allow-broken").exit_code == 0
    assert read_mesh("b.stl").volume == pytest.approx(VALUES[1].sum() * 0.5, rel=0.05)


@pytest.mark.slow
def test_only_some_labels(folder: Path) -> None:
    assert run("smooth", "bones.npy", "-o", "{label}.stl", "--label", "7", "--label", "3").exit_code == 0
    assert names(folder) == {"label_3.stl", "label_7.stl"}
    one_line_error(
        run("smooth", "bones.npy", "-o", "x{label}.stl", "--label", "4"), "--label is 4, and the volume holds"
    )


@pytest.mark.slow
def test_nothing_is_written_if_one_fails_unless_it_is_told_to_go_on(folder: Path) -> None:
    words = ("smooth", "speck.npy", "--despeckle", "100", "-o", "{label}.stl")
    one_line_error(run(*words), "label 9: --despeckle is 100")
    assert names(folder) == set()
    done = run(*words, "--keep-going", "--json")
    assert done.exit_code == 1
    assert names(folder) == {"label_3.stl", "label_7.stl", "label_200.stl"}
    assert [each["number"] for each in json.loads(done.stdout)["failed"]] == [9]
    assert "FAILED 9 label_9" in done.stderr
    assert "error: 1 of 4 labels failed; the others were written" in done.stderr


@pytest.mark.slow
def test_files_that_exist_are_kept(folder: Path) -> None:
    Path("label_7.stl").write_text("precious")
    one_line_error(run("smooth", "bones.npy", "-o", "{label}.stl"), "label_7.stl exists; .* --force")
    assert names(folder) == {"label_7.stl"}
    assert run("smooth", "bones.npy", "-o", "{label}.stl", "--force").exit_code == 0
    assert read_mesh("label_7.stl").closed


@pytest.mark.longest
@pytest.mark.parametrize(
    ("words", "says"),
    [
        ("-o {label}.abc", r"use one of \.stl"),
        ("-o {label}.npz", r"use one of \.stl"),
        ("-o all.stl --each-label", "all.stl can hold one mesh"),
        ("-o {label}.stl -o all.obj", "all.obj can hold one mesh"),
        ("-o no/{label}.stl", "there is no folder no"),
        ("-o {label}.stl --labels gone.txt", "there is no file gone.txt"),
        ("-o {label}.stl --labels bones.npy", "not a table of labels"),
        ("-o {label}.stl --as mesh", "labels are those of a volume, and bones.npy is read as mesh"),
        ("-o {label}.obj --ascii", "only .stl can be written as text"),
        ("-o {label}.stl --roi 0,9,0,9,0", "roi is '0,9,0,9,0'; give 6 number"),
        ("-o {label}.stl --roi 500,600,0,9,0,9", "holds no cell of the volume"),
        ("-o a.stl --label 3 --frame 1", "only .* hold frames"),
    ],
)
def test_bad_input_is_one_clear_line(words: str, says: str, folder: Path) -> None:
    refused(run("smooth", "bones.npy", *words.split()), says)
    assert names(folder) == set()


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [
        "-o a.stl --keep-going",
        "-o a.stl --labels names.txt",
        *(
            f"-o {{label}}.stl {more}"
            for more in ("--threshold 3", "--range 3,4", "--otsu", "--grey", "--smooth grey", "--voxel 1")
        ),
        "-o {label}.stl --preview a.png",
        "-o {label}.stl --units mm",
    ],
)
def test_options_that_make_no_sense_together(words: str, folder: Path) -> None:
    assert run("smooth", "bones.npy", *words.split()).exit_code == 2
    assert names(folder) == set()


@pytest.mark.slow
def test_a_box_of_a_volume_closes_the_surface_where_it_cuts(folder: Path) -> None:
    done = run("smooth", "bones.npy", "--label", "3", "--roi", "0,90,0,60,0,35", "-o", "half.ply", "--json")
    assert done.exit_code == 0, done.output
    found = json.loads(done.stdout)
    assert found["grid"]["shape"] == [90, 60, 35]
    half = read_mesh("half.ply")
    assert half.closed
    assert half.volume == pytest.approx((bones() == 3)[:, :, :35].sum(), rel=1e-3)
    assert half.bounds[1, 2] == pytest.approx(35, abs=0.5)
    done = run("smooth", "bones.npy", "--roi", "0,90,0,60,0,35", "-o", "{label}.stl")
    assert done.exit_code == 0, done.output
    assert names(folder) == {"half.ply", "label_3.stl", "label_7.stl"}  # the third lies beyond
    assert read_mesh("label_3.stl").volume == pytest.approx(half.volume, rel=1e-5)


def test_a_box_or_a_frame_of_a_mesh_is_told(folder: Path) -> None:
    trimesh.creation.box((30, 30, 30)).export("a.stl")
    for option, value in (("--roi", "0,9,0,9,0,9"), ("--frame", "0")):
        one_line_error(
            run("smooth", "a.stl", option, value, "-o", "b.stl"),
            f"{option} is for volumes, and a.stl is read as mesh",
        )


@pytest.mark.slow
def test_a_mask_of_any_value_is_a_mask(folder: Path) -> None:
    np.save("mask.npy", (bones() == 3) * np.int16(1000))
    assert run("smooth", "mask.npy", "-o", "mask.stl").exit_code == 0
    assert read_mesh("mask.stl").volume == pytest.approx((bones() == 3).sum(), rel=1e-3)


@pytest.mark.longest
def test_a_real_segmentation(data: Path, tmp_path: Path) -> None:
    skull = read_volume(data / "volumes" / "seg_skull_label_seg3d.npz")
    result = smooth_labels(skull, allow_broken=True, tolerance=None)
    assert [surface.closed for surface in result.surfaces.values()] == [True] * len(result.surfaces)
    for each in result.report["labels"]:
        cells = int((skull.values == each["number"]).sum())
        assert each["report"]["volume"] == pytest.approx(cells * skull.cell_volume, rel=0.01)


# --- a label map, and nothing says which labels ----------------------------------------------------------


def knee() -> np.ndarray:
    """Two bones that touch nothing, 1 and 7."""
    values = np.zeros((30, 14, 14), dtype=np.uint8)
    for value, x in ((1, 7.0), (7, 21.0)):
        values[ball(values.shape, (x, 6.5, 6.5), 4.0)] = value
    return values


def test_the_labels_of_a_map_are_listed_with_their_sizes() -> None:
    values = knee()
    cells = np.bincount(values.ravel())
    with pytest.raises(LabelChoiceError) as caught:
        smooth_volume(values, spacing=0.5, tolerance=None)
    listed = f"2 labels: 1 ({cells[1] / 8:.3g} mm³), 7 ({cells[7] / 8:.3g} mm³)"
    assert str(caught.value).startswith(f"the volume holds {listed}; give -o")
    assert "otsu" not in str(caught.value)
    assert smooth_volume(values, label=7, tolerance=None).surface.closed


def test_a_map_of_many_labels_is_listed_in_part() -> None:
    values = np.repeat(np.arange(1, 41), 50).reshape(40, 5, 10)
    with pytest.raises(LabelChoiceError, match=r"holds 40 labels: 1 \(50 mm³\), .*, 11 \(50 mm³\), 29 more; give"):
        smooth_volume(values, tolerance=None)


@pytest.mark.parametrize(
    "values",
    [
        np.random.default_rng(1).integers(0, 200, (12, 12, 12)),
        np.arange(-864, 864).reshape(12, 12, 12),
        np.add.outer(np.add.outer(np.arange(12.0), np.arange(12.0)), np.arange(12.0)) / 3,
    ],
    ids=["noise", "a ramp", "fractions"],
)
def test_grey_values_are_no_label_map(values: np.ndarray) -> None:
    with pytest.raises(ParameterError, match=r"--otsu \(finds"):
        smooth_volume(values, tolerance=None)


def test_what_is_said_of_a_label_map_works(tmp_path: Path) -> None:
    """By its names; and the remedies, as they are written."""
    path = seg_nrrd(tmp_path / "knee.seg.nrrd", NAMED, knee())
    for more in ([], ["--dry-run"]):
        result = run("smooth", path, "-o", tmp_path / "a.stl", *more)
        one_line_error(result, r"knee.seg.nrrd holds 2 labels: 1 Femur \(\d+ mm³\), 7 Tibia \(\d+ mm³\); ")
    template = re.search(r'-o "(.*?)"', result.stderr)
    assert template
    assert not list(tmp_path.glob("*.stl"))
    assert run("smooth", path, "-o", tmp_path / template[1]).exit_code == 0
    assert sorted(each.name for each in tmp_path.glob("*.stl")) == ["Femur.stl", "Tibia.stl"]
    assert run("smooth", path, "-o", tmp_path / "a.stl", "--label", "7").exit_code == 0


def test_a_dry_run_over_labels_names_the_files_of_the_run(tmp_path: Path) -> None:
    path = seg_nrrd(tmp_path / "knee.seg.nrrd", NAMED, knee())
    typed = ("smooth", path, "-o", tmp_path / "{label}.stl", "-o", tmp_path / "all.3mf")
    plan = json.loads(run(*typed, "--dry-run", "--json").stdout)
    assert not list(tmp_path.glob("*.stl"))
    report = json.loads(run(*typed, "--json").stdout)
    assert plan["files"] == report["files"]
    for planned, made in zip(plan["labels"], report["labels"], strict=True):
        assert [planned[key] for key in ("name", "number", "layer")] == [
            made[key] for key in ("name", "number", "layer")
        ]
        assert planned["data"] == pytest.approx(made["report"]["solid"]["data"], rel=1e-9)
    text = run(*typed, "--dry-run", "--force").stdout
    assert "7 Tibia" in text
    assert "would write" in text


def test_every_label_has_its_verdict(tmp_path: Path) -> None:
    """A rod of one voxel is lost from a ball; another ball is kept."""
    values = np.zeros((40, 20, 20), dtype=np.uint8)
    values[ball(values.shape, (9, 9.5, 9.5), 6.0)] = 1
    values[ball(values.shape, (29, 9.5, 6), 4.0)] = 2
    values[29, 9, 10:18] = 2
    np.save(tmp_path / "labels.npy", values)
    result = run(
        "smooth", tmp_path / "labels.npy", "-o", tmp_path / "{label}.stl", "--allow-broken", "--smooth", "plain"
    )
    assert result.exit_code == 0, result.stderr
    rows = [line for line in result.stderr.splitlines() if "of the data; " in line]
    words = [row.partition("of the data; ")[2].partition(";")[0] for row in rows]
    assert words[0] == "kept"
    assert words[1] in ("changed a little", "lost")


def test_grey_values_are_not_taken_for_labels() -> None:
    noise = np.random.default_rng(0).integers(0, 200, (12, 12, 12)).astype(np.int16)
    with pytest.raises(ParameterError, match=r"199 values that change from voxel to voxel.*--label N,M"):
        smooth_labels(noise)
    grey = noise.astype(np.int16)
    grey[4:8, 4:8, 4:8] = 7
    assert set(smooth_labels(grey, label=7).surfaces) == {"label_7"}  # asked for, it is one
