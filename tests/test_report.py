"""The report: every product has the same form, and docs/report.md lists exactly the keys there are."""

from __future__ import annotations

import json
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path
from types import UnionType
from typing import Any, NotRequired, Union, get_args, get_origin, get_type_hints, is_typeddict

import numpy as np
import pytest
import trimesh

from infill import (
    Result,
    Segment,
    Segmentation,
    Smoothing,
    Volume,
    make,
    refill,
    smooth_labels,
    smooth_mesh,
    smooth_points,
    smooth_volume,
)
from infill.reports.common import FORM
from infill.reports.making import MakeReport
from infill.reports.smoothing import ComponentsReport, LabelsReport, SmoothReport
from tests.handmade_prints import Dialect, written

pytestmark = pytest.mark.usefixtures("compiled")

PAGE = Path(__file__).resolve().parents[1] / "docs" / "report.md"
FREE = {"request.parameters", "sections.kept"}  # a pattern's own, by name; reasons
REFILL = "\n## Refill: a sliced print\n"  # its keys stand below, and are its own
ALL_LABELS = "\n## Labels: every label of a segmentation\n"  # likewise
ALL_COMPONENTS = "\n## Components: every component of a mesh\n"
FILL = "\n## Fill: a part with its infill\n"
ONLY_AT_THE_COMMAND_LINE = {"files"}

BALL = np.sum((np.indices((24, 24, 24)) - 11.5) ** 2, axis=0) < 64
GREY = 100.0 * (11 - np.sqrt(np.sum((np.indices((24, 24, 24)) - 11.5) ** 2, axis=0)))
LABELS = BALL.astype(np.uint8) * 3 + np.roll(BALL, 13, axis=0) * 4 * ~BALL
SPHERE = trimesh.creation.icosphere(radius=10)
FIN = np.zeros((30, 40, 30), dtype=bool)
FIN[5:25, 5:15, 5:25] = True
FIN[14:16, 5:36, 5:25] = True  # two cells thick: gone after 40 steps


def every_result() -> Iterator[tuple[str, Result[Any, Any]]]:
    """Results over all options that change which keys a report has."""
    yield "block", make("honeycomb", size=20, height=3)
    yield "exact", make("concentric-heart", size=20, height=3, stamp="exact", hearts=2)
    yield "not measured", make("honeycomb", size=1.8, cell=1.35, height=1)
    yield "mask", smooth_volume(BALL)
    yield "phase", smooth_volume(np.where(BALL, 1.0, -1.0))
    yield "labels", smooth_volume(LABELS, label=(3, 4), allow_broken=True)
    yield "threshold", smooth_volume(GREY, threshold=300.0)
    yield "grey", smooth_volume(GREY, threshold=300.0, grey=True, level=0)
    yield "range", smooth_volume(GREY, threshold=(300.0, 900.0), allow_broken=True)
    yield "otsu", smooth_volume(GREY, threshold="otsu")
    yield "lost", smooth_volume(FIN, smoothing=Smoothing(steps=40), method="plain", allow_broken=True)
    yield "mesh", smooth_mesh(SPHERE, resolution=24, refine=True, despeckle=1.0)
    yield "simplified", smooth_mesh(SPHERE, resolution=24, tolerance=0.3)
    yield "few", smooth_mesh(SPHERE, resolution=24, max_triangles=500)
    yield "points", smooth_points(trimesh.creation.icosphere(3, radius=10).vertices, voxel=1.0)
    yield "shell", smooth_points(trimesh.creation.icosphere(3, radius=10).vertices, voxel=1.0, shell=3.0)


@pytest.fixture(scope="module")
def results() -> dict[str, Result[Any, Any]]:
    return dict(every_result())


def described(text: str) -> dict[str, tuple[str, str]]:
    """Return type and products of every key that a page has a row for."""
    rows = re.findall(r"^\| `([\w.\[\]]+)` \| ([^|]+) \| ([^|]+) \|", text, flags=re.MULTILINE)
    found = {key: (kind.strip(), where.strip()) for key, kind, where in rows}
    assert len(found) == len(rows), "a key stands twice"
    return found


def flat(value: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    """Yield every key of a report, nested ones with dots, with its value."""
    if name:
        yield name, value
    if isinstance(value, dict) and name not in FREE:
        for key, each in value.items():
            yield from flat(each, f"{name}.{key}" if name else key)
    if isinstance(value, list) and value and isinstance(value[0], dict):
        for each in value:
            for key, inner in each.items():
                yield from flat(inner, f"{name}[].{key}")


def is_of(kind: str, value: Any) -> bool:
    """Whether a value is of one of the types that the page names."""
    for each in kind.split(" or "):
        name, _, count = each.partition(" ")
        fits = {
            "int": isinstance(value, int) and not isinstance(value, bool),
            "float": isinstance(value, float),
            "bool": isinstance(value, bool),
            "str": isinstance(value, str),
            "null": value is None,
            "object": isinstance(value, dict),
            "list": isinstance(value, list) and (not count or len(value) == int(count)),
        }[name]
        if fits:
            return True
    return False


def differences(
    page: dict[str, tuple[str, str]],
    reports: dict[str, dict[str, Any]],
    products: tuple[str, ...] = ("make", "smooth"),
) -> list[str]:
    """Return in what the page and the reports differ, one phrase each."""
    found, seen = [], set()
    for name, report in reports.items():
        product = report["product"]
        keys = dict(flat(report))
        for key, value in keys.items():
            seen.add((product, key))
            if key not in page:
                found.append(f"{key} of {name} is not on the page")
            elif not is_of(page[key][0], value):
                found.append(f"{key} of {name} is {value!r}, not {page[key][0]}")
            elif page[key][1].split(" ")[0] not in ("all", product):
                found.append(f"{key} of {name} is on the page for {page[key][1]} only")
        for key, (_, where) in page.items():
            if (
                where in ("all", product)
                and key not in keys
                and "[]" not in key
                and key not in ONLY_AT_THE_COMMAND_LINE
            ):
                found.append(f"{key} is missing from {name}")
    for key, (_, where) in page.items():
        for product in products:
            wanted = where.split(" ")[0] in ("all", product) and key not in ONLY_AT_THE_COMMAND_LINE
            if wanted and (product, key) not in seen:
                found.append(f"{key} is in no report of {product}")
    return found


@pytest.mark.slow
def test_the_page_lists_exactly_the_keys_of_all_reports(results: dict[str, Result[Any, Any]]) -> None:
    page = described(PAGE.read_text(encoding="utf-8").partition(REFILL)[0])
    assert len(page) > 100
    assert differences(page, {name: result.report for name, result in results.items()}) == []


@pytest.mark.slow
def test_the_page_lists_exactly_the_keys_of_a_refill(tmp_path: Path) -> None:
    page = described(PAGE.read_text(encoding="utf-8").partition(REFILL)[2].partition(ALL_LABELS)[0])
    assert len(page) > 30
    sliced, smooth, bare = (tmp_path / f"{name}.gcode" for name in ("sliced", "smooth", "bare"))
    sliced.write_bytes(written(Dialect(layers=5)))
    bare.write_bytes(written(Dialect(slicer="cura", layers=5)).replace(b";TYPE:FILL", b";TYPE:SKIN"))
    archive = tmp_path / "sliced.gcode.3mf"
    with zipfile.ZipFile(archive, "w") as plates:
        for number in (1, 2):
            plates.write(sliced, f"Metadata/plate_{number}.gcode")
    every = {"layers": (2, 3), "max_deviation": 0.1, "smooth_radius": 1.0, "part": "box", "density": "same"}
    results = {
        "kept": refill(sliced, output=smooth),
        "already": refill(smooth),
        "two plates": refill(archive, dry_run=True),
        "every option": refill(sliced, dry_run=True, **every),
        "another pattern": refill(sliced, dry_run=True, pattern="honeycomb", density=0.2),
        "no infill": refill(bare, dry_run=True),
    }
    reports = {name: result.report for name, result in results.items()}
    assert differences(page, reports, ("refill",)) == []
    assert reports["already"]["print"]["already_refilled"]
    for report in reports.values():
        assert json.loads(json.dumps(report, allow_nan=False)) == report


@pytest.mark.slow
def test_the_page_lists_exactly_the_keys_of_all_labels(results: dict[str, Result[Any, Any]]) -> None:
    """But for the report of each label, which is that of smoothing."""
    page = described(PAGE.read_text(encoding="utf-8").partition(ALL_LABELS)[2].partition(ALL_COMPONENTS)[0])
    assert len(page) > 20
    volume = Volume(values=LABELS)
    named = (Segment(value=3, name="ball", colour=(1.0, 0.0, 0.0)), Segment(value=9, name="none"))
    both = smooth_labels(Segmentation(layers=(volume,), segments=named), allow_broken=True)
    speck = LABELS.copy()
    speck[0, 0, 0] = 5
    some = smooth_labels(speck, allow_broken=True, despeckle=2.0, keep_going=True)
    assert both.report["absent"]
    assert some.report["failed"]
    reports = {}
    for name, result in {"both": both, "some": some}.items():
        for each in result.report["labels"]:
            smooth = dict(flat(results["labels"].report))
            assert {key for key, _ in flat(each["report"])} <= set(smooth) | {"input.segmentation.label"}
        inner = [{**each, "report": {}} for each in result.report["labels"]]
        reports[name] = {**result.report, "labels": inner, "request": {}}
        assert json.loads(json.dumps(result.report, allow_nan=False)) == result.report
        assert list(misfits(result.report, LabelsReport)) == []
    assert differences(page, reports, ("labels",)) == []


def test_the_page_lists_exactly_the_keys_of_all_components(results: dict[str, Result[Any, Any]]) -> None:
    """But for the report of each component, which is that of smoothing."""
    page = described(PAGE.read_text(encoding="utf-8").partition(ALL_COMPONENTS)[2].partition(FILL)[0])
    assert len(page) > 20
    small = trimesh.creation.icosphere(radius=0.5).apply_translation((20, 0, 0))
    mesh = trimesh.util.concatenate([SPHERE, small])
    result = smooth_mesh(mesh, voxel=1.0, by_component=True, allow_broken=True)
    assert result.report["failed"]
    smooth = {key for key, _ in flat(results["mesh"].report)} | {key for key, _ in flat(results["simplified"].report)}
    assert {key for key, _ in flat(result.report["components"][0]["report"])} <= smooth
    inner = [{**each, "report": {}} for each in result.report["components"]]
    report = {**result.report, "components": inner, "request": {}}
    assert json.loads(json.dumps(result.report, allow_nan=False)) == result.report
    assert list(misfits(result.report, ComponentsReport)) == []
    assert differences(page, {"both": report}, ("components",)) == []


# --- for type checkers ----------------------------------------------------------------------------------------------

TYPED = {"make": MakeReport, "smooth": SmoothReport, "labels": LabelsReport, "components": ComponentsReport}
PLAIN = {int: "int", float: "float", bool: "bool", str: "str", type(None): "null"}


def spelt(hint: Any) -> str:
    """Return a hint as the page would say it."""
    if get_origin(hint) is NotRequired:
        return spelt(get_args(hint)[0])
    if get_origin(hint) in (Union, UnionType):
        return " or ".join(spelt(each) for each in get_args(hint))
    if get_origin(hint) is list:
        return "list"
    return PLAIN.get(hint, "object")


def hinted(kind: Any, name: str = "") -> Iterator[tuple[str, str, bool]]:
    """Yield every key of a report's type, nested ones with dots, how it is spelt, and whether it must be there."""
    for key, hint in get_type_hints(kind, include_extras=True).items():
        place = f"{name}.{key}" if name else key
        yield place, spelt(hint), get_origin(hint) is not NotRequired
        inner = get_args(hint)[0] if get_origin(hint) is NotRequired else hint
        item = get_args(inner)[0] if get_origin(inner) is list else None
        if is_typeddict(inner):
            yield from hinted(inner, place)
        elif is_typeddict(item) and item is not SmoothReport:
            yield from hinted(item, f"{place}[]")


def misfits(value: Any, hint: Any, name: str = "report") -> Iterator[str]:
    """Yield where a value is not what a hint says, down to the last number."""
    if get_origin(hint) is NotRequired:
        hint = get_args(hint)[0]
    if get_origin(hint) in (Union, UnionType):
        if all(any(True for _ in misfits(value, each, name)) for each in get_args(hint)):
            yield f"{name} is {value!r}, not {hint}"
    elif is_typeddict(hint):
        hints = get_type_hints(hint, include_extras=True)
        yield from (f"{name}.{key} has no type" for key in value if key not in hints)
        for key, each in hints.items():
            if key in value:
                yield from misfits(value[key], each, f"{name}.{key}")
            elif get_origin(each) is not NotRequired:
                yield f"{name}.{key} is missing"
    elif get_origin(hint) is list:
        if type(value) is not list:
            yield f"{name} is {value!r}, not a list"
        else:
            for number, each in enumerate(value):
                yield from misfits(each, get_args(hint)[0], f"{name}[{number}]")
    elif hint is not Any and type(value) is not (get_origin(hint) or hint):
        yield f"{name} is {value!r}, not {hint}"


@pytest.mark.parametrize("product", ["make", "smooth"])
def test_the_types_are_those_of_the_page(product: str) -> None:
    page = described(PAGE.read_text(encoding="utf-8").partition(REFILL)[0])
    typed = {key: (kind, must) for key, kind, must in hinted(TYPED[product])}
    expected = {
        key: (re.sub(r"(list) \d", r"\1", kind), where in ("all", product) and key not in ONLY_AT_THE_COMMAND_LINE)
        for key, (kind, where) in page.items()
        if where.split(" ")[0] in ("all", product)
    }
    # What is nested in something that may be missing must be there if that is.
    optional = {key for key, (_, must) in typed.items() if not must}
    for key, (kind, must) in expected.items():
        inside = any(key.startswith(f"{each}.") for each in optional)
        assert typed[key][0] == kind, key
        assert typed[key][1] == must or inside, key
    assert set(typed) == set(expected)


@pytest.mark.slow
def test_every_report_is_of_its_type(results: dict[str, Result[Any, Any]]) -> None:
    for name, result in results.items():
        assert list(misfits(result.report, TYPED[result.report["product"]])) == [], name


def test_a_misfit_is_found(results: dict[str, Result[Any, Any]]) -> None:
    report = results["block"].report
    for wrong, said in (
        ({**report, "volume": 3}, "report.volume is 3, not <class 'float'>"),
        ({**report, "new": 3}, "report.new has no type"),
        ({**report, "extents": [1.0, 2, 3.0]}, "report.extents[1] is 2, not <class 'float'>"),
        ({**report, "closed": 1}, "report.closed is 1, not <class 'bool'>"),
        ({key: value for key, value in report.items() if key != "mesh"}, "report.mesh is missing"),
        ({**report, "walls": {"width": {**report["walls"]["width"], "mean": "thin"}, "exact": None}}, "mean is 'thin'"),
    ):
        (found,) = misfits(wrong, MakeReport)
        assert said in found


def test_the_comparison_can_fail() -> None:
    page = {"product": ("str", "all"), "a": ("int", "all"), "b.c": ("float", "make"), "b": ("object", "make")}
    make_report, smooth_report = {"product": "make", "a": 1, "b": {"c": 1.0}}, {"product": "smooth", "a": 1}
    assert differences(page, {"x": make_report, "y": smooth_report}) == []
    for broken, said in (
        ({**make_report, "a": 1.0}, "a of x is 1.0, not int"),
        ({**make_report, "d": 1}, "d of x is not on the page"),
        ({**make_report, "b": {}}, "b.c is missing from x"),
    ):
        assert said in differences(page, {"x": broken, "y": smooth_report})
    assert "b of y is on the page for make only" in differences(
        page, {"x": make_report, "y": {**smooth_report, "b": {}}}
    )


def test_a_report_is_json_as_it_stands(results: dict[str, Result[Any, Any]]) -> None:
    for result in results.values():
        assert json.loads(json.dumps(result.report, allow_nan=False)) == result.report


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
