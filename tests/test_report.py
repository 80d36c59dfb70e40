"""Reports: every product is under one law, and docs/report.md has the keys that are declared."""

from __future__ import annotations

import doctest
import json
import re
import zipfile
from collections.abc import Callable, Collection, Iterator, Mapping
from pathlib import Path
from typing import Any, get_args, get_origin, is_typeddict

import dask.array
import numpy as np
import pytest
import trimesh
from handmade_dicom import save_all, slices
from typer.testing import CliRunner

from infill import (
    Result,
    Segment,
    Segmentation,
    Smoothing,
    Volume,
    fill,
    make,
    motion,
    refill,
    save_project,
    smooth_labels,
    smooth_mesh,
    smooth_points,
    smooth_volume,
    verify,
)
from infill.cli.app import build_app
from infill.lazy.opening import open_volume
from infill.reports.checking import FailedCheck
from infill.reports.common import FORM
from infill.reports.timing import MotionReports
from infill.smoothing.together_chunks import smooth_together_in_chunks
from tests.handmade_prints import Dialect, written
from tools import write_report_page
from tools.write_report_page import CHAPTERS, PAGE, Chapter, Key, is_union, read_key, read_keys, write_page

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

BALL = np.sum((np.indices((24, 24, 24)) - 11.5) ** 2, axis=0) < 64
GREY = 100.0 * (11 - np.sqrt(np.sum((np.indices((24, 24, 24)) - 11.5) ** 2, axis=0)))
LABELS = BALL.astype(np.uint8) * 3 + np.roll(BALL, 13, axis=0) * 4 * ~BALL
SPHERE = trimesh.creation.icosphere(radius=10)
CLOUD = trimesh.creation.icosphere(3, radius=10).vertices
FIN = np.zeros((30, 40, 30), dtype=bool)
FIN[5:25, 5:15, 5:25] = True
FIN[14:16, 5:36, 5:25] = True  # two cells thick: gone after 40 steps


def every_result() -> Iterator[tuple[str, Result[Any, Any]]]:
    """Results over all options that change which keys a report has."""
    yield "block", make("honeycomb", size=20, height=3)
    yield "exact", make("concentric-heart", size=20, height=3, stamp="exact", hearts=2)
    yield "not measured", make("honeycomb", size=1.8, cell=1.35, height=1)
    yield "mask", smooth_volume(BALL, tolerance=None)
    yield "phase", smooth_volume(np.where(BALL, 1.0, -1.0), tolerance=None)
    yield "labels", smooth_volume(LABELS, label=(3, 4), allow_broken=True, tolerance=None)
    yield "larger voxels", smooth_volume(FIN, voxel=2.0, allow_broken=True, tolerance=None)
    yield "threshold", smooth_volume(GREY, threshold=300.0, tolerance=None)
    yield "grey", smooth_volume(GREY, threshold=300.0, grey=True, level=0, tolerance=None)
    yield "range", smooth_volume(GREY, threshold=(300.0, 900.0), allow_broken=True, tolerance=None)
    yield "otsu", smooth_volume(GREY, threshold="otsu", tolerance=None)
    yield "lost", smooth_volume(FIN, smoothing=Smoothing(steps=40), method="plain", allow_broken=True, tolerance=None)
    yield "mesh", smooth_mesh(SPHERE, resolution=24, refine=True, despeckle=1.0, tolerance=None)
    yield "simplified", smooth_mesh(SPHERE, resolution=24, tolerance=0.3)
    yield "facets", smooth_mesh(trimesh.creation.icosphere(1, 15.0), resolution=40, tolerance=None)
    yield "few", smooth_mesh(SPHERE, resolution=24, max_triangles=500)
    yield "points", smooth_points(CLOUD, voxel=1.0, tolerance=None)
    yield "shell", smooth_points(CLOUD, voxel=1.0, shell=3.0, tolerance=None)


@pytest.fixture(scope="module")
def results() -> dict[str, Result[Any, Any]]:
    return dict(every_result())


# --- the reports of every chapter, over all options that change which keys a report has ------------------------------


def printed(*words: object, status: int = 0) -> Any:
    """Return what a command prints with --json."""
    done = CliRunner().invoke(build_app(), [*map(str, words), "--json"])
    assert done.exit_code == status, done.stderr
    return json.loads(done.stdout)


Results = Mapping[str, Result[Any, Any]]


def make_reports(folder: Path, results: Results) -> dict[str, Any]:
    reports = {name: result.report for name, result in results.items() if result.report["product"] == "make"}
    command = printed("make", "honeycomb", "--size", 20, "--height", 3, "-o", folder / "a.stl")
    return {**reports, "command": command}


def make_plans(folder: Path, results: Results) -> dict[str, Any]:
    return {"block": printed("make", "honeycomb", "--size", 20, "--height", 3, "--dry-run")}


def lattice_reports(folder: Path, results: Results) -> dict[str, Any]:
    words = ("make", "gyroid", "--size", "12x10x8", "--density", 0.3)
    command = printed(*words, "-o", folder / "a.stl")
    return {"command": command, "library": make("honeycomb", size=(12, 12, 5), cell=4, density=0.4).report}


def lattice_plans(folder: Path, results: Results) -> dict[str, Any]:
    return {
        "block": printed("make", "gyroid", "--dry-run"),
        "cell": printed("make", "gyroid", "--cell", 8, "--dry-run"),
    }


def smooth_reports(folder: Path, results: Results) -> dict[str, Any]:
    np.save(folder / "ball.npy", BALL)
    reports = {name: result.report for name, result in results.items() if result.report["product"] == "smooth"}
    command = printed("smooth", folder / "ball.npy", "--spacing", 1, "-o", folder / "a.stl")
    plate = np.zeros((48, 48, 48), bool)
    plate[8:40, 8:40, 8:18] = True
    plate[23:25, 8:40, 8:40] = True  # too thin for the radius
    gentler = smooth_volume(Volume(values=plate), radius=4.0, tolerance=None).report
    return {**reports, "command": command, "gentler": gentler}


def smooth_plans(folder: Path, results: Results) -> dict[str, Any]:
    np.save(folder / "grey.npy", GREY)
    np.save(folder / "labels.npy", LABELS)
    np.save(folder / "fin.npy", FIN)
    np.savetxt(folder / "cloud.xyz", CLOUD)
    SPHERE.export(folder / "ball.stl")
    words = {
        "grey.npy": ["--spacing", 1, "--range", "300,900"],
        "labels.npy": ["--spacing", 1, "--label", 3],
        "fin.npy": ["--spacing", 1, "--voxel", 2, "--allow-broken"],
        "cloud.xyz": ["--voxel", 1],
        "ball.stl": ["--resolution", 24],
    }
    save_all(
        slices(np.repeat(GREY.T, 5, axis=0).astype(np.int16), [(0, 0, k) for k in range(5 * GREY.shape[2])]),
        folder / "dicom",
    )
    words["dicom"] = ["--range", "300,900"]
    return {name: printed("smooth", folder / name, *more, "--dry-run") for name, more in words.items()}


def chunks_reports(folder: Path, results: Results) -> dict[str, Any]:
    np.save(folder / "ball.npy", BALL)
    words = (folder / "ball.npy", "--smooth", "plain", "--workers", "1")
    plate = np.zeros((30, 40, 40), dtype=bool)
    plate[14:16, 5:35, 5:35] = plate[6:12, 10:20, 10:20] = True
    steps: dict[str, Any] = {"method": "plain", "smoothing": Smoothing(steps=30)}
    return {
        "array": smooth_volume(dask.array.from_array(BALL), method="plain").report,
        "lost": smooth_volume(dask.array.from_array(plate), allow_broken=True, level=0.5, **steps).report,
        "added": smooth_volume(dask.array.from_array(plate), allow_broken=True, level=-0.999, **steps).report,
        "gentler": smooth_volume(dask.array.from_array(plate), **steps).report,
        "command": printed("smooth", *words, "-o", folder / "chunks.ply"),
    }


def chunks_plans(folder: Path, results: Results) -> dict[str, Any]:
    np.save(folder / "ball.npy", BALL)
    words = (folder / "ball.npy", "--smooth", "plain", "--workers", "1", "-o", folder / "chunks.ply")
    return {"command": printed("smooth", *words, "--dry-run")}


def labels_reports(folder: Path, results: Results) -> dict[str, Any]:
    named = (Segment(value=3, name="ball", colour=(1.0, 0.0, 0.0)), Segment(value=9, name="none"))
    segmentation = Segmentation(layers=(Volume(values=LABELS),), segments=named)
    speck = LABELS.copy()
    speck[0, 0, 0] = 5
    np.save(folder / "labels.npy", LABELS)
    words = ["--spacing", 1, "--each-label", "--allow-broken", "-o", folder / "a.3mf"]
    return {
        "absent": smooth_labels(segmentation, allow_broken=True, tolerance=None).report,
        "failed": smooth_labels(speck, allow_broken=True, despeckle=2.0, keep_going=True, tolerance=None).report,
        "command": printed("smooth", folder / "labels.npy", *words),
    }


def together_reports(folder: Path, results: Results) -> dict[str, Any]:
    named = (Segment(value=3, name="ball", colour=(1.0, 0.0, 0.0)), Segment(value=9, name="none"))
    specks = LABELS.copy()
    specks[0, 0, 0], specks[2, 20, 2] = 5, 6
    np.save(folder / "labels.npy", LABELS)
    words = ["--spacing", 1, "--together", "-o", folder / "a.3mf", "-o", folder / "a.vtu"]
    return {
        "absent": smooth_labels(Segmentation(layers=(Volume(values=LABELS),), segments=named), together=True).report,
        "failed": smooth_labels(specks, together=True, method="refine", smoothing=Smoothing(steps=30)).report,
        "command": printed("smooth", folder / "labels.npy", *words),
    }


def parted_reports(folder: Path, results: Results) -> dict[str, Any]:
    segments = (Segment(value=3, name="ball", colour=(1.0, 0.0, 0.0)), Segment(value=9, name="none"))
    specks = LABELS.copy()
    specks[0, 0, 0], specks[2, 20, 2] = 5, 6
    np.save(folder / "labels.npy", specks)
    words = ["--spacing", 1, "--together", "--smooth", "plain", "--workers", 1, "-o", folder / "a.3mf"]
    volume = open_volume(folder / "labels.npy")
    options: dict[str, Any] = {"method": "refine", "smoothing": Smoothing(steps=30)}
    return {
        "absent": smooth_together_in_chunks(volume, segments=segments, **options).report,
        "command": printed("smooth", folder / "labels.npy", *words),
    }


def labels_plans(folder: Path, results: Results) -> dict[str, Any]:
    np.save(folder / "labels.npy", LABELS)
    words = ["--spacing", 1, "--each-label", "-o", folder / "a.3mf", "--dry-run"]
    return {"command": printed("smooth", folder / "labels.npy", *words)}


def components_reports(folder: Path, results: Results) -> dict[str, Any]:
    small = trimesh.creation.icosphere(radius=0.5).apply_translation((20, 0, 0))
    mesh = trimesh.util.concatenate([SPHERE, small])
    mesh.export(folder / "a.stl")
    words = ["--voxel", 1, "--by-component", "--allow-broken", "-o", folder / "b.stl"]
    return {
        "failed": smooth_mesh(mesh, voxel=1.0, by_component=True, allow_broken=True, tolerance=None).report,
        "command": printed("smooth", folder / "a.stl", *words),
    }


def spires() -> trimesh.Trimesh:
    """Two, so steep that holes leave the first by its base alone, and the second, which stands on its tip, not at all."""
    up = trimesh.creation.cone(radius=7, height=26, sections=12)
    down = up.copy()
    down.apply_transform(trimesh.transformations.rotation_matrix(np.pi, (1, 0, 0), (0, 0, 13)))
    down.apply_translation((16, 0, 0))
    return trimesh.util.concatenate([up, down])


def fill_reports(folder: Path, results: Results) -> dict[str, Any]:
    part, few = trimesh.creation.box((24, 20, 14)), {"voxel": 0.5, "wall": 1.5, "density": 0.3}
    part.export(folder / "part.stl")
    results = {
        "plain": fill(part, **few),
        "lines": fill(part, "zigzag", waves=5, cell=5, line_width=0.5, voxel=0.5, max_triangles=10**6),
        "drained": fill(part, drain=2, drain_at=[(0, 0, -7)], **few),
        "closed": fill(spires(), "grid", drain=2, vent=True, **few),
        "infill": fill(part, "cubic-bars", as_="infill", smooth_radius=0.3, voxel=0.5, density=0.3),
        "graded": fill(part, density=(0.2, 0.4), by="x", voxel=0.5, wall=1.5),
        "cells": fill(part, density=(0.2, 0.4), grade="cell", voxel=0.5, wall=1.5),
        "project": fill(part, as_="project", voxel=0.5),
        "open": fill(part, open_="top", **few),
        "tied": fill(part, "concentric", open_="both", **few),
        "regions": fill(part, regions=["z=0..:density=40%"], **few),
    }
    command = printed("fill", folder / "part.stl", "--voxel", 0.5, "-o", folder / "a.stl")
    return {**{name: result.report for name, result in results.items()}, "command": command}


def fill_plans(folder: Path, results: Results) -> dict[str, Any]:
    SPHERE.export(folder / "ball.stl")
    return {"ball": printed("fill", folder / "ball.stl", "--dry-run")}


def sliced_print(folder: Path) -> Path:
    path = folder / "sliced.gcode"
    path.write_bytes(written(Dialect(layers=5)))
    return path


def archive(folder: Path) -> Path:
    path = folder / "sliced.gcode.3mf"
    with zipfile.ZipFile(path, "w") as plates:
        for number in (1, 2):
            plates.write(sliced_print(folder), f"Metadata/plate_{number}.gcode")
    return path


def refill_reports(folder: Path, results: Results) -> dict[str, Any]:
    sliced, smooth, bare = sliced_print(folder), folder / "smooth.gcode", folder / "bare.gcode"
    bare.write_bytes(written(Dialect(slicer="cura", layers=5)).replace(b";TYPE:FILL", b";TYPE:SKIN"))
    named = folder / "named.gcode"
    named.write_bytes(written(Dialect(labels="comment")))
    every = {"layers": (2, 3), "max_deviation": 0.1, "smooth_radius": 1.0, "part": "box", "density": "same"}
    reports = {
        "kept": refill(sliced, output=smooth).report,
        "already": refill(smooth).report,
        "two plates": refill(archive(folder), dry_run=True).report,
        "every option": refill(named, dry_run=True, **every).report,
        "another pattern": refill(sliced, dry_run=True, pattern="honeycomb", density=0.2).report,
        "chosen": refill(sliced, dry_run=True, pattern="auto").report,
        "even layers": refill(sliced, dry_run=True, pattern="honeycomb", even="volume", leeway="5%").report,
        "no infill": refill(bare, dry_run=True).report,
        "command": printed("refill", sliced, "-o", folder / "a.gcode"),
    }
    done = {"sections", "rounding", "filament", "time", "contact"}
    for name, report in reports.items():
        assert report["print"]["already_refilled"] == (name == "already")
        assert (done <= set(report)) == (name != "already")
    return reports


def motion_reports(folder: Path, results: Results) -> dict[str, Any]:
    sliced = sliced_print(folder)
    both = printed("motion", sliced, sliced)
    assert list(misfits(both, read_key(MotionReports))) == []
    assert both["files"] == [printed("motion", sliced)] * 2
    return {
        "command": both["files"][0],
        "jerk": motion(sliced, jerk=8.0).to_dict(),
        "junction": motion(sliced, junction_deviation=0.02).to_dict(),
        "klipper": motion(sliced, square_corner_velocity=8.0).to_dict(),
        "plate": motion(archive(folder), plate=2).to_dict(),
        "written": motion(
            sliced, limits="jerk=5", model="klipper", macros="G28=20s", write=folder / "written.gcode"
        ).to_dict(),
    }


def verify_reports(folder: Path, results: Results) -> dict[str, Any]:
    sliced = sliced_print(folder)
    smooth = folder / "verified.gcode"
    refill(sliced, output=smooth)
    hot = folder / "hot.gcode"
    hot.write_bytes(sliced.read_bytes().replace(b"M109 S215", b"M109 S225"))
    return {
        "same": verify(sliced, sliced).report,
        "refilled": verify(sliced, smooth).report,
        "plate": verify(archive(folder), archive(folder), plate=2).report,
        "allowed": verify(sliced, hot, allow="temperature").report,
        "command": printed("verify", sliced, hot, status=1),
    }


def check_reports(folder: Path, results: Results) -> dict[str, Any]:
    SPHERE.export(folder / "ball.stl")
    trimesh.Trimesh(SPHERE.vertices, SPHERE.faces[5:]).export(folder / "open.stl")
    (folder / "broken.stl").write_text("no mesh")
    ball, holes, broken = printed("check", *(folder / f"{name}.stl" for name in ("ball", "open", "broken")), status=1)
    assert list(misfits(broken, read_key(FailedCheck))) == []
    assert printed("check", folder / "ball.stl") == {key: value for key, value in ball.items() if key != "file"}
    return {"ball": ball, "open": holes}


def print_check_reports(folder: Path, results: Results) -> dict[str, Any]:
    whole, cut = folder / "whole.gcode", folder / "cut.gcode"
    whole.write_bytes(written(Dialect(layers=3)))
    cut.write_bytes(b"; generated by PrusaSlicer 2.9.6\nG1 X1\n")
    both = printed("check", whole, cut, status=1)
    assert printed("check", whole) == {key: value for key, value in both[0].items() if key != "file"}
    assert [each["printable"] for each in both] == [True, False]
    return {"whole": both[0], "cut": both[1]}


def project_reports(folder: Path, results: Results) -> dict[str, Any]:
    save_project(fill(SPHERE, as_="project", voxel=0.8), folder / "ball.3mf", slicer="prusaslicer")
    (folder / "broken.3mf").write_text("no archive")
    fine, broken = printed("check", folder / "ball.3mf", folder / "broken.3mf", "--for", "prusaslicer", status=1)
    assert list(misfits(broken, read_key(FailedCheck))) == []
    return {"fine": fine, "wrong": printed("check", folder / "ball.3mf", "--for", "cura", status=1)}


def lists(folder: Path, results: Results) -> dict[str, Any]:
    return {"all": printed("list"), "one": printed("list", "zigzag"), "in space": printed("list", "kelvin")}


def setup_reports(folder: Path, results: Results) -> dict[str, Any]:
    (folder / "print").mkdir()
    (folder / "print" / "a.ini").write_text("post_process = \n")
    (folder / "print" / "b.ini").write_text('post_process = "\n')
    (folder / "5.9").mkdir()
    words = ("setup", "prusaslicer", "--folder", folder, "--force")
    written = printed(*words, "--write", "--profile", "a")
    cura = printed("setup", "cura", "--folder", folder)
    return {
        "look": printed(*words),
        "written": written,
        "removed": printed(*words, "--remove", "--profile", "a"),
        "cura": cura,
    }


CHAPTER = {chapter.word: chapter for chapter in CHAPTERS}
REPORTS: dict[str, Callable[[Path, Results], dict[str, Any]]] = {
    "make": make_reports,
    "make --dry-run": make_plans,
    "make --density": lattice_reports,
    "make --density --dry-run": lattice_plans,
    "smooth": smooth_reports,
    "smooth --dry-run": smooth_plans,
    "chunks": chunks_reports,
    "chunks --dry-run": chunks_plans,
    "labels": labels_reports,
    "together": together_reports,
    "together in chunks": parted_reports,
    "labels --dry-run": labels_plans,
    "components": components_reports,
    "fill": fill_reports,
    "fill --dry-run": fill_plans,
    "refill": refill_reports,
    "motion": motion_reports,
    "verify": verify_reports,
    "check": check_reports,
    "check PRINT": print_check_reports,
    "check --for": project_reports,
    "list": lists,
    "setup": setup_reports,
}
LONG = {
    **dict.fromkeys(("fill", "smooth --dry-run", "check --for"), pytest.mark.longest),
    **dict.fromkeys(("labels", "refill"), pytest.mark.slow),
}


# --- the law -----------------------------------------------------------------------------------------------------------


def misfits(value: Any, key: Key, place: str = "report") -> Iterator[str]:
    """Yield where a value differs from its declaration, down to the last number."""
    kind = key.kind
    if is_union(kind):
        if all(any(True for _ in misfits(value, read_key(each), place)) for each in get_args(kind)):
            yield f"{place} is {value!r}, not {kind}"
    elif is_typeddict(kind) and isinstance(value, dict):
        keys = read_keys(kind)
        yield from (f"{place}.{name} is not declared" for name in value if name not in keys)
        yield from (f"{place}.{name} is missing" for name in keys if keys[name].required and name not in value)
        yield from each_misfit({f"{place}.{name}": (value[name], keys[name]) for name in keys if name in value})
    elif get_origin(kind) in (list, tuple) and type(value) in (list, get_origin(kind)):  # JSON has lists alone
        yield from each_misfit({f"{place}[{i}]": (item, read_key(get_args(kind)[0])) for i, item in enumerate(value)})
        if key.length is not None and len(value) != key.length:
            yield f"{place} has {len(value)} items, not {key.length}"
    elif get_origin(kind) is dict and type(value) is dict:
        yield from (f"{place} has a key that is no text, {name!r}" for name in value if type(name) is not str)
        yield from each_misfit({f"{place}.{name}": (value[name], read_key(get_args(kind)[1])) for name in value})
    elif kind is not Any and type(value) is not kind:
        yield f"{place} is {value!r}, not {kind}"


def each_misfit(values: dict[str, tuple[Any, Key]]) -> Iterator[str]:
    for place, (value, key) in values.items():
        yield from misfits(value, key, place)


def places(declaration: Any, known: Collection[Any], values: list[Any] | None = None, name: str = "") -> Iterator[str]:
    """Yield the keys that a report declares, or those that some values of it have; not those of known sections."""
    for inner, key in read_keys(declaration).items():
        found = None if values is None else [value[inner] for value in values if inner in value]
        if found == []:
            continue
        place = f"{name}.{inner}"
        yield place
        if key.section is None or key.section[1] in known:
            continue
        joint, section = key.section
        if found is not None:
            found = [value for value in found if value is not None]
            found = found if not joint else [item for value in found for item in items_of(value)]
        yield from places(section, known, found, place + joint)


def items_of(value: Any) -> list[Any]:
    return list(value.values() if isinstance(value, dict) else value)


def differences(chapter: Chapter, reports: dict[str, Any]) -> list[str]:
    """List all differences between a declaration and reports: misfits, and keys that no report has."""
    found = [f"{name}: {text}" for name, value in reports.items() for text in misfits(value, read_key(chapter.report))]
    seen = set(places(chapter.report, chapter.known, list(reports.values())))
    return found + [f"no report has {place}" for place in places(chapter.report, chapter.known) if place not in seen]


TUPLES = {"motion"}  # `Motion.to_dict` has tuples, which JSON makes lists


def with_lists(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: with_lists(item) for name, item in value.items()}
    return [with_lists(item) for item in value] if isinstance(value, (list, tuple)) else value


@pytest.mark.long
@pytest.mark.parametrize("word", [pytest.param(word, marks=LONG.get(word, ())) for word in REPORTS])
def test_the_declared_keys_are_those_of_real_reports(word: str, results: Results, tmp_path: Path) -> None:
    reports = REPORTS[word](tmp_path, results)
    assert differences(CHAPTER[word], reports) == []
    for report in reports.values():
        assert json.loads(json.dumps(report, allow_nan=False)) == (with_lists(report) if word in TUPLES else report)


def test_every_chapter_is_under_the_law() -> None:
    assert list(REPORTS) == list(CHAPTER)


def test_the_page_is_the_one_of_the_declarations() -> None:
    """`python tools/write_report_page.py` writes it again."""
    assert PAGE.read_text(encoding="utf-8") == write_page()
    assert doctest.testmod(write_report_page) == (0, 2)


def test_every_key_has_a_meaning() -> None:
    for chapter in CHAPTERS:
        for declaration in [chapter.report, *sections(chapter.report)]:
            for name, key in read_keys(declaration).items():
                assert re.match(r"[A-Z`\d]", key.meaning), f"{declaration.__name__}.{name}"
                assert not key.meaning.endswith("."), name


def sections(declaration: Any) -> Iterator[Any]:
    for key in read_keys(declaration).values():
        if key.section is not None:
            yield key.section[1]
            yield from sections(key.section[1])


def test_a_difference_is_found(results: Results) -> None:
    report = results["block"].report
    assert differences(CHAPTER["make"], {"block": report}) == ["no report has .files"]
    assert differences(CHAPTER["make --dry-run"], {}) == [
        f"no report has .{name}" for name in ("request", "grid", "memory", "triangles", "stl_bytes")
    ]
    for wrong, said in (
        ({**report, "volume": 3}, "report.volume is 3, not <class 'float'>"),
        ({**report, "planted": 3}, "report.planted is not declared"),
        ({**report, "extents": [1.0, 2, 3.0]}, "report.extents[1] is 2, not <class 'float'>"),
        ({**report, "extents": [1.0, 2.0]}, "report.extents has 2 items, not 3"),
        ({**report, "extents": (1.0, 2.0, 3.0)}, "report.extents is (1.0, 2.0, 3.0), not list"),
        ({**report, "request": {**report["request"], "parameters": {1: 2}}}, "parameters has a key that is no text, 1"),
        ({**report, "closed": 1}, "report.closed is 1, not <class 'bool'>"),
        ({key: value for key, value in report.items() if key != "mesh"}, "report.mesh is missing"),
        ({**report, "mesh": {**report["mesh"], "planted": 1}}, "report.mesh.planted is not declared"),
        ({**report, "mesh": None}, "report.mesh is None, not"),
        ({**report, "walls": {"width": {**report["walls"]["width"], "mean": "thin"}, "exact": None}}, "mean is 'thin'"),
    ):
        (found,) = misfits(wrong, read_key(CHAPTER["make"].report))
        assert said in found


# --- what the numbers mean ---------------------------------------------------------------------------------------------


def test_what_stands_first_is_what_the_sections_say(results: dict[str, Result[Any, Any]]) -> None:
    for result in results.values():
        report = result.report
        assert report["form"] == FORM
        for name in ("triangles", "closed", "area", "extents", "bounds"):
            assert report[name] == report["mesh"][name]
        assert report["volume"] == report["solid"]["volume"]
        assert report["volume_change"] == report["solid"]["change"]
        assert report["components"] == report["topology"]["result"]["components"]
        assert report.get("density") == report["solid"].get("density")
        assert report.get("wall_width") == report["walls"].get("width")


def test_a_report_tells_of_the_mesh_that_is_handed_over(results: dict[str, Result[Any, Any]]) -> None:
    for name, result in results.items():
        report, mesh = result.report, result.mesh
        assert report["mesh"]["vertices"] == len(mesh.vertices), name
        assert report["mesh"]["euler_number"] == mesh.euler_number, name
        assert report["volume"] == pytest.approx(mesh.volume, rel=1e-6), name
        if report["product"] == "smooth":  # a block is judged by its layer, without the rims
            assert report["volume_change"] == pytest.approx(mesh.volume / report["solid"]["data"] - 1, abs=1e-6), name
        for counts in report["topology"].values():
            expected = 2 * (counts["components"] + counts["cavities"] - counts["tunnels"])
            assert counts["euler_number"] == expected, name


def test_a_named_surface_is_the_main_one(results: dict[str, Result[Any, Any]]) -> None:
    assert {tuple(result.surfaces) for result in results.values()} == {("block",), ("solid",)}
    for result in results.values():
        assert result.surface is next(iter(result.surfaces.values()))
