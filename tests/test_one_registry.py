"""One registry of patterns for every product: a pattern of a user's makes, fills and refills, and so do all of ours."""

from __future__ import annotations

import dataclasses
import json
import re
from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from made_shapes import box
from shapes import BUILT_IN, IN_SPACE, Ripples
from test_command_line import one_line_error, run

import patterns
from infill import ParameterError, fill, make, refill
from infill.errors import UsageError
from infill.formats.volume_settings import SLICER_PATTERNS
from infill.lattices.choosing import place_pattern
from infill.lattices.request import check_request
from infill.lattices.settings import FillOptions
from infill.options.resolve_pattern import NEEDS, instantiate_pattern, resolve_pattern
from infill.paths.families.catalogue import FAMILIES
from infill.paths.families.family import TOUCH, PathSpec
from infill.paths.families.lines import line_paths, separate_lines
from infill.refilling.placement import family_of, resolve_paths
from infill.refilling.request import Request
from patterns import PATTERNS, Gyroid, Honeycomb, Octet, Pattern, PatternError, Zigzag, offers
from patterns.declared import given_parameters
from tests.gcode_judge import judge
from tests.handmade_prints import Dialect, written

pytestmark = pytest.mark.usefixtures("coarse_grids")

MODULE = '''
"""A pattern of a user's: one file."""
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import shapely

from patterns import Pattern, cell_parameter, parameter
from patterns.linework import clip


@dataclass(frozen=True, kw_only=True)
class Bricks(Pattern):
    """Rows, and walls between them, half a brick aside in every second row."""

    name: ClassVar[str] = "bricks"
    summary: ClassVar[str] = "a wall of bricks, seen from the side"
    cell: float = cell_parameter(5.0)
    long: float = parameter(2.0, "length of a brick over its height", unit="", low=1.0, high=5.0)

    def lines(self, region, z=0.0):
        x0, y0, x1, y1 = region.bounds
        rows = np.arange(np.floor(y0 / self.cell), np.ceil(y1 / self.cell) + 1)
        walls = [[(x0, row * self.cell), (x1, row * self.cell)] for row in rows]
        step = self.long * self.cell
        for row in rows:
            for x in np.arange(np.floor(x0 / step) - 1, np.ceil(x1 / step) + 1) * step + row % 2 * step / 2:
                walls.append([(x, row * self.cell), (x, (row + 1) * self.cell)])
        return clip(shapely.linestrings(walls), region)

    def line_spacing(self, region):
        return self.cell
'''
WIDTH = 0.45


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A module with a pattern, a part and a print."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    Path("bricks_module.py").write_text(MODULE)
    box(16, 14, 12).export("part.stl")
    Path("print.gcode").write_bytes(written(Dialect(layers=5)))
    return tmp_path


def installed(monkeypatch: pytest.MonkeyPatch) -> str:
    entry = EntryPoint(name="bricks", value="bricks_module:Bricks", group="infill.patterns")
    monkeypatch.setattr(PATTERNS, "_plugins", lambda: [entry])
    monkeypatch.setattr(PATTERNS, "_plugged_in", None)
    return "bricks"


@pytest.mark.longest
@pytest.mark.usefixtures("compiled")
@pytest.mark.parametrize("way", ["entry point", "module"])
def test_one_file_makes_fills_and_refills(way: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    name = installed(monkeypatch) if way == "entry point" else "bricks_module.py:Bricks"
    made = run("make", name, "--size", "20", "--height", "1", "--set", "long=3", "-o", "a.stl", "--json", "-q")
    assert made.exit_code == 0, made.stderr
    assert json.loads(made.stdout)["request"]["parameters"] == {"cell": 5.0, "long": 3.0}
    filled = run("fill", "part.stl", "--pattern", name, "--density", "30%", "--voxel", "0.5", "-o", "b.stl", "--json")
    assert filled.exit_code == 0, filled.stderr
    report = json.loads(filled.stdout)
    assert report["density"] == pytest.approx(0.3, abs=0.005)
    assert report["closed"]
    words = ("refill", "print.gcode", "--pattern", name, "--set", "long=3", "-o", "c.gcode", "--json", "-q")
    refilled = run(*words)
    assert refilled.exit_code == 0, refilled.stderr
    report = json.loads(refilled.stdout)
    assert report["request"]["pattern"] == name
    assert report["request"]["parameters"] == {"cell": None, "long": 3.0}
    assert report["sections"]["replaced"] == report["sections"]["all"] > 0
    # A region of the print has room for few bricks, so that the length of lines jumps with their size.
    assert judge(Path("print.gcode").read_bytes(), Path("c.gcode").read_bytes(), filament=(0.8, 1.1)) == []


def test_list_shows_a_pattern_of_a_users(folder: Path) -> None:
    shown = run("list", "bricks_module.py:Bricks", "--preview", "bricks.png")
    assert shown.exit_code == 0, shown.stderr
    assert "bricks: a wall of bricks" in shown.stdout
    assert "--set long" in shown.stdout
    assert Path("bricks.png").exists()
    one_line_error(run("list", "bricks_module.py:clip"), "clip is not a class of patterns, .*functions too")


@pytest.mark.parametrize(
    "words",
    [("make",), ("list",), ("fill", "part.stl", "--pattern"), ("refill", "print.gcode", "--pattern")],
    ids=lambda words: words[0],
)
def test_a_file_without_the_name_of_its_pattern_is_one_clear_line(words: tuple[str, ...], folder: Path) -> None:
    out = {"make": ["-o", "a.stl"], "fill": ["-o", "b.stl"], "refill": ["-o", "c.gcode"]}.get(words[0], [])
    one_line_error(run(*words, "bricks_module.py", *out), r"give bricks_module\.py:NAME, where NAME is its class")
    one_line_error(run(*words, "bricks_module.py:bricks", *out), "has nothing called 'bricks'; it has Bricks$")


@pytest.mark.slow
def test_a_drawing_makes_too(folder: Path) -> None:
    Path("cross.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 20"><path d="M0 10 H20 M10 0 V20"/></svg>'
    )
    result = run("make", "cross.svg", "--size", "20", "--height", "1", "--cell", "5", "-o", "a.stl", "--json", "-q")
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout)["request"]["pattern"] == "cross.svg"
    grid = json.loads(run("make", "grid", "--size", "20", "--no-frame", "--cell", "5", "--json", "-q").stdout)
    assert json.loads(result.stdout)["density"] == pytest.approx(grid["density"], abs=0.05)


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (
            ("refill", "print.gcode", "--pattern", "octet", "-o", "a.gcode"),
            "octet offers cells, and refill needs paths, lines or a level set; choose another pattern, or give it to "
            "make or fill",
        ),
    ],
)
def test_an_offer_that_does_not_serve_is_one_clear_line(words: tuple[str, ...], says: str, folder: Path) -> None:
    one_line_error(run(*words), re.escape(says))


@pytest.mark.longest
def test_a_config_file_may_not_run_code_unless_trusted(folder: Path) -> None:
    for command, name in (("make", "a.toml"), ("refill", "b.toml")):
        Path(name).write_text('pattern = "bricks_module.py:Bricks"\n')
        words = (
            command,
            *(["print.gcode", "--set", "cell=5"] if command == "refill" else []),
            "--config",
            name,
            "--dry-run",
        )
        one_line_error(run(*words), "asks to run code: pattern = 'bricks_module.py:Bricks'; .* give --trust")
        assert run(*words, "--trust").exit_code == 0


# --- names and classes -------------------------------------------------------------------------------------------


def test_every_name_of_the_list_has_a_class() -> None:
    listed = [line.split()[0] for line in run("list").stdout.splitlines() if line.startswith("  ")]
    assert listed == [*BUILT_IN, *IN_SPACE]
    for name in listed:
        kind: Any = PATTERNS[name]
        assert getattr(patterns, kind.__name__) is kind
        assert kind.__name__ in patterns.__all__
        assert kind.__name__.lower() == name.replace("-", "")
        assert kind().name == kind.name == name
        assert offers(kind)
        assert resolve_pattern(name, "fill")[0] in (kind, kind())
        with pytest.raises(PatternError, match=f"cell of {name} is 0 mm; it must be a number from 0.001 to 10000 mm"):
            kind(cell=0)


@pytest.mark.parametrize("name", BUILT_IN)
def test_make_takes_a_name_or_a_pattern(name: str) -> None:
    assert instantiate_pattern(name, {"cell": 5.0}) == instantiate_pattern(PATTERNS[name](cell=5.0), {})  # type: ignore[arg-type]


@pytest.mark.slow
@pytest.mark.parametrize("name", [*BUILT_IN, *IN_SPACE])
def test_fill_takes_a_name_or_a_pattern(name: str) -> None:
    """The same request, with the same voids: cell and density are as open as they are with a name."""
    bounds = np.array([[0.0, 0.0, 0.0], [20.0, 20.0, 20.0]])

    def asked(pattern: object, **options: Any) -> Any:
        apart = ("units", "slicer", "form", "seed", "pattern")
        values = {name: value for name, value in vars(FillOptions()).items() if name not in apart}
        return check_request(pattern=pattern, own={}, form="solid", **{**values, **options})

    one, other = asked(name), asked(PATTERNS[name]())
    assert one.facts() == other.facts()
    first, second = (place_pattern(request, bounds) for request in (one, other))
    assert type(first) is type(second)
    assert getattr(first, "pattern", None) == getattr(second, "pattern", None)
    sized, made = asked(name, cell=7.0), asked(PATTERNS[name](cell=7.0))
    assert sized.facts() == made.facts()
    assert made.cell == 7.0
    with pytest.raises(UsageError, match=f"cell is 6 mm, and {name} is made with 7 mm; give one of them"):
        asked(PATTERNS[name](cell=7.0), cell=6.0)


@pytest.mark.parametrize("name", FAMILIES)
def test_refill_takes_a_name_or_a_pattern(name: str) -> None:
    one, other = Request(pattern=name, parameters={"cell": 5.0}), Request(pattern=PATTERNS[name](cell=5.0))
    assert (one.pattern, one.parameters, one.lines) == (other.pattern, other.parameters, other.lines)
    assert other.cell == 5.0
    assert Request(pattern=PATTERNS[name]()).cell is None
    assert family_of(other.pattern, other.parameters) == family_of(name, {"cell": 5.0})


@pytest.mark.slow
@pytest.mark.usefixtures("compiled")
def test_the_same_voids_and_the_same_print(folder: Path) -> None:
    options: dict[str, Any] = {"density": 0.3, "voxel": 0.5, "wall": 1.0}
    part = box(16, 14, 12)
    one, other = fill(part, "gyroid", cell=6, **{**options}), fill(part, Gyroid(cell=6), **options)
    np.testing.assert_array_equal(one.surface.vertices, other.surface.vertices)
    texts = []
    for pattern, more in (("gyroid", {"cell": 6}), (Gyroid(cell=6), {})):
        refill("print.gcode", output="out.gcode", pattern=pattern, **more)
        texts.append(Path("out.gcode").read_bytes())
    assert texts[0] == texts[1]


def test_the_cell_counts_if_it_was_given() -> None:
    assert given_parameters(Honeycomb()) == given_parameters(dataclasses.replace(Honeycomb(), angle=0)) == {}
    assert given_parameters(Honeycomb(cell=6)) == {"cell": 6.0}
    assert Honeycomb(cell=6) == Honeycomb()
    assert given_parameters(Gyroid(cell=3)) == {"cell": 3.0}
    with pytest.raises(ParameterError, match="zigzag has no parameter 'waves'; it has cell, angle, phase"):
        Request(pattern=Zigzag(waves=3))
    with pytest.raises(ParameterError, match="octet offers cells"):
        Request(pattern=Octet())
    assert make(Gyroid(cell=6), size=(12, 9, 8), density=0.2).report["infill"]["cell"] == 6.0
    with pytest.raises(UsageError, match=r"cell is 4, and gyroid is made with 5\.0; give one of them"):
        Request(pattern=Gyroid(cell=5), parameters={"cell": 4})


# --- paths along lines -------------------------------------------------------------------------------------------


def test_the_families_are_those_of_patterns_that_offer_paths() -> None:
    assert set(FAMILIES) == {name for name in PATTERNS.built_in if "paths" in offers(PATTERNS[name])}
    for name, family in FAMILIES.items():
        assert family.name == name


def test_lines_that_meet_no_other_are_paths_as_they_are() -> None:
    lines = shapely.MultiLineString([[(0, y), (10, y)] for y in range(5)])
    paths = separate_lines(lines, cell=1.0, line_width=WIDTH)
    assert sorted(map(shapely.LineString, paths), key=lambda line: line.bounds[1]) == list(lines.geoms)


@pytest.mark.long
@pytest.mark.parametrize("name", BUILT_IN)
@pytest.mark.parametrize("cell", [2.0, 4.0])
def test_paths_along_lines_neither_cross_nor_come_too_near(name: str, cell: float) -> None:
    """Whatever a pattern draws, apart from where a region cuts it: paths are simple, apart, and beside the lines."""
    pattern: Any = PATTERNS[name](cell=cell, **({"frame": False} if hasattr(PATTERNS[name], "frame") else {}))
    region = shapely.box(-15, -15, 15, 15)
    lines = pattern.lines(region)
    paths = [shapely.LineString(path) for path in separate_lines(lines, cell=cell, line_width=WIDTH)]
    drawn = shapely.MultiLineString(paths)
    assert drawn.is_simple
    inside = shapely.intersection(paths, shapely.box(-10, -10, 10, 10))
    one, other = shapely.STRtree(inside).query(inside, predicate="dwithin", distance=0.94 * TOUCH * WIDTH)
    assert (one == other).all()
    assert shapely.distance(shapely.points(shapely.get_coordinates(drawn)), lines).max() < 3 * TOUCH * WIDTH


@pytest.mark.slow
def test_paths_along_lines_lie_alike_in_every_region() -> None:
    family = dataclasses.replace(line_paths(Honeycomb()), middle=(100.0, 80.0))
    kinds = [((95, 75, 105, 85), 3.0), ((97, 78, 101, 84), 3.0)]
    large, small = (
        shapely.MultiLineString(
            family.strands(bounds, PathSpec(cell=cell, line_width=WIDTH, z=0.2, layer=0, radius=0.0))
        )
        for bounds, cell in kinds
    )
    window = shapely.box(*kinds[1][0])
    # Rings begin elsewhere in another square, and each is simplified by up to 0.002 mm.
    assert shapely.hausdorff_distance(large.intersection(window), small.intersection(window)) < 0.004


def test_a_wave_that_a_border_cuts_at_its_crest_is_one_path() -> None:
    """The ends of its pieces are near each other, at the border alone."""
    x = np.linspace(-23, 23, 461)
    wave = shapely.LineString(np.stack([x, 5 + np.cos(x)], axis=-1))
    lines = shapely.intersection(wave, shapely.box(-23, -23, 23, 5.99))
    assert len(lines.geoms) == 8
    doubled = separate_lines(lines, cell=3.0, line_width=WIDTH)
    paths = separate_lines(lines, cell=3.0, line_width=WIDTH, inside=shapely.box(-17, -17, 17, 3))
    assert shapely.MultiLineString(doubled).length > 1.5 * lines.length
    assert len(paths) == 8
    assert shapely.hausdorff_distance(shapely.MultiLineString(paths), lines) < 1e-5  # a grid of 1e-6 cells


@pytest.mark.slow
def test_a_level_set_is_drawn_around_the_region_alone_and_alike_in_every_region() -> None:
    drawn: list[float] = []

    class Watched(Ripples):
        def level_set(self, x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
            drawn.append(float(np.abs(y).min()) if x.ndim == 2 else np.inf)
            return super().level_set(x, y, z)

    family = line_paths(Watched(frame=False, angle=7))
    spec = PathSpec(cell=3.0, line_width=WIDTH, z=0.2, layer=0, radius=0.0)
    small, large = (
        shapely.MultiLineString(family.strands(bounds, spec)) for bounds in ((30, 40, 38, 44), (-50, -50, 50, 50))
    )
    assert drawn[0] > 30  # the middle of the print is far away
    window = shapely.box(30, 40, 38, 44)
    assert shapely.intersection(small, window).length > 0
    # Each is simplified by up to 0.002 mm.
    assert shapely.hausdorff_distance(large.intersection(window), small.intersection(window)) < 0.004


@pytest.mark.longest
@pytest.mark.parametrize("name", ["honeycomb", "rectilinear"])
def test_the_cell_for_a_density_gives_it(name: str) -> None:
    family = line_paths(PATTERNS[name]())  # type: ignore[arg-type]
    cell = family.cell_for(0.2, WIDTH)
    half = 20 * cell
    square = shapely.box(-half, -half, half, half)
    paths = family.strands(square.bounds, PathSpec(cell=cell, line_width=WIDTH, z=0.2, layer=0, radius=0.0))
    length = shapely.MultiLineString(paths).intersection(square).length
    assert TOUCH * WIDTH * length / square.area == pytest.approx(0.2, rel=0.1)  # as it is found in a few cells


def test_a_pattern_of_a_users_is_resolved_once_for_all(folder: Path) -> None:
    name, parameters, lines = resolve_paths("bricks_module.py:Bricks", {"long": 2.5})
    assert (name, parameters) == ("bricks_module.py:Bricks", {"long": 2.5})
    assert lines is not None
    made: Pattern = resolve_pattern("bricks_module.py:Bricks", "make")[0]()  # type: ignore[operator]
    assert made.name == "bricks"


# --- names as people and slicers spell them --------------------------------------------------------------

SPELLINGS = {
    "Gyroid": "gyroid",
    "3D Honeycomb": "honeycomb-3d",
    "Adaptive Cubic": "adaptive-cubic",
    "archimedean_chords": "archimedean-chords",
    "CrossHatch": "cross-hatch",
    "Zig-Zag": "zigzag",
    " cubic ": "cubic",
}


@pytest.mark.parametrize(("typed", "name"), SPELLINGS.items())
def test_every_product_knows_a_pattern_as_slicers_spell_it(typed: str, name: str) -> None:
    """The name is in requests and reports as the registry has it."""
    assert PATTERNS.find(typed) is PATTERNS[name]
    assert resolve_pattern(typed, "fill")[1] == name
    assert check_request(pattern=typed, own={}, density=0.2).pattern == name
    if set(offers(PATTERNS[name])) & set(NEEDS["refill"]):
        assert resolve_paths(typed, {})[0] == name
        assert Request(pattern=typed).pattern == name
    assert json.loads(run("list", typed, "--json").stdout) == json.loads(run("list", name, "--json").stdout)


def test_the_names_of_two_patterns_are_never_spelled_alike() -> None:
    for name in PATTERNS:
        assert PATTERNS.spelled(name.replace("-", " ").title()) == name
        assert PATTERNS.spelled(name.replace("-", "").upper()) == name


def test_a_block_is_named_as_the_registry_has_it(tmp_path: Path) -> None:
    done = run("make", "Tri Hexagon", "--size", "20", "--json", "-o", tmp_path / "a.stl")
    assert json.loads(done.stdout)["request"]["pattern"] == "tri-hexagon"
    done = run("make", "CUBIC", "--size", "20", "--dry-run")
    assert done.stdout.startswith("cubic, 20 x 20 x 6 mm: nothing is written")


def test_a_name_of_a_slicer_is_the_same_pattern_everywhere() -> None:
    """A name that a modifier of a project has is that pattern, or is answered with it."""
    for typed, name in SLICER_PATTERNS.items():
        spelled = PATTERNS.spelled(typed)
        if spelled in PATTERNS:
            assert spelled == name or typed == "zigzag"  # of Cura: straight lines; zigzag is a pattern of ours
            continue
        for resolve in (PATTERNS.find, lambda value: resolve_paths(value, {})):
            with pytest.raises(ValueError, match=f"did you mean '{name}'"):
                resolve(typed)


@pytest.mark.parametrize("command", [["make", "part.stl"], ["fill", "PART", "--pattern", "part.stl"]])
def test_a_mesh_in_the_place_of_a_pattern_is_recognised(command: list[str], tmp_path: Path) -> None:
    part = tmp_path / "cube.stl"
    box(10, 10, 10).export(part)
    words = [str(part) if word == "PART" else word for word in command]
    one_line_error(run(*words, "-o", tmp_path / "out.stl"), "named like a mesh; infill fill part.stl --pattern NAME")
