"""Parameters of refill's patterns: what a turn keeps, how they are given, what is said of a mistake."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import example, given
from hypothesis import strategies as st
from lines import DISC, least_spacing, length_of
from test_command_line import refused, run
from test_parameters import offered

from infill import FormatError, ParameterError, refill
from infill.paths.covering import cover, solve_cell
from infill.paths.families.catalogue import FAMILIES
from infill.paths.families.family import TOUCH, Family, PathSpec, TurnedFamily
from infill.paths.families.rows import HoneycombPaths
from infill.paths.outlines import outline_of
from infill.refilling.placement import default_parameters, family_of
from infill.refilling.request import ENDLESS, parse_radius, parse_range, parse_share_or_same
from infill.refilling.settings import resolve
from patterns import PatternError
from patterns.declared import describe_values, parameters
from patterns.given import parse_assignment
from patterns.linework import turn
from tests.gcode_judge import judge
from tests.handmade_prints import Dialect, written

ROOT = Path(__file__).resolve().parents[1]
PRINT = written(Dialect(layers=5))
WIDTH = 0.45
GAP = TOUCH * WIDTH
ANGLE = 17.0
AROUND = shapely.Point(0, 0).buffer(9, quad_segs=64)
TILE = '<svg xmlns="http://www.w3.org/2000/svg" width="8mm" height="6mm" viewBox="0 0 8 6"><path d="{}"/></svg>'

TURNING = [name for name in FAMILIES if "angle" in parameters(default_parameters(name))]
# Branches below a roof lean to its walls, which nothing turns.
every_turning = pytest.mark.parametrize("name", [name for name in TURNING if FAMILIES[name].fills])


@pytest.fixture
def gcode(tmp_path: Path) -> Path:
    """A small print."""
    path = tmp_path / "print.gcode"
    path.write_bytes(PRINT)
    return path


@pytest.fixture
def tile(tmp_path: Path) -> Path:
    """A drawing of a wave."""
    path = tmp_path / "tile.svg"
    path.write_text(TILE.format("M0 2L4 4L8 2"))
    return path


def lines(family: Family, *, z: float = 0.6, layer: int = 3) -> shapely.MultiLineString:
    paths = family.strands(AROUND.bounds, PathSpec(cell=4.0, line_width=WIDTH, z=z, layer=layer, radius=0.3))
    return shapely.MultiLineString([shapely.LineString(path) for path in paths])


def apart(one: shapely.MultiLineString, other: shapely.MultiLineString) -> float:
    """Return how far points of lines lie from other lines, and the other way round, in the disc; mm."""
    found = []
    for some, rest in ((one, other), (other, one)):
        long = [line for line in some.geoms if line.distance(shapely.Point(0, 0)) < 8]
        points = shapely.get_coordinates(shapely.segmentize(long, 1.0))
        points = points[np.hypot(*points.T) < 8]
        assert len(points) > 10
        found.append(shapely.distance(rest, shapely.points(points)).max())
    return float(max(found))


def turned(found: shapely.MultiLineString, angle: float) -> shapely.MultiLineString:
    return shapely.transform(found, lambda points: turn(points, angle))


# --- turned and shifted ----------------------------------------------------------------------------------------


def test_what_can_be_turned() -> None:
    """All that have a direction; nested outlines have none."""
    assert [name for name in FAMILIES if name not in TURNING] == ["concentric"]
    assert not parameters(default_parameters("keep"))


@pytest.mark.slow
@every_turning
def test_a_turn_keeps_the_lines(name: str) -> None:
    """They are those of the pattern, turned: as long within a disc about (0, 0), and where they should be."""
    more = {"middle": (0.0, 0.0)} if "middle" in parameters(default_parameters(name)) else {}
    plain, other = lines(family_of(name, more)), lines(family_of(name, {**more, "angle": ANGLE}))
    assert apart(turned(plain, ANGLE), other) < 1e-6
    lengths = [found.intersection(AROUND).length for found in (plain, other)]
    # The disc is a polygon of 256 corners: it lies within 1e-3 mm of a round one.
    assert lengths[1] == pytest.approx(lengths[0], rel=1e-3)
    assert apart(plain, other) > 0.1


@pytest.mark.long
@every_turning
def test_a_turned_pattern_takes_the_length_asked_for(name: str) -> None:
    """Within 1 % on a disc, inside it, without crossing, beads apart as those of the pattern are."""
    family, outline = family_of(name, {"angle": ANGLE}), outline_of(DISC)
    asked = 0.15 * DISC.area / GAP
    solved = solve_cell([(outline, 0.6, 3)], family, asked, line_width=WIDTH)
    assert abs(solved.error) <= 0.01
    paths = cover(outline, family, cell=solved.cell, line_width=WIDTH, z=0.6, layer=3)
    assert length_of(paths) == pytest.approx(solved.length)
    drawn = shapely.MultiLineString([shapely.LineString(path) for path in paths])
    assert drawn.is_simple
    assert DISC.buffer(1e-6).covers(drawn)
    assert least_spacing(paths, near=4 * WIDTH, most=0.6) > 0.95 * GAP - 0.002  # as in the laws of covering


@pytest.mark.parametrize("name", ["rectilinear", "schwarz-p"])
def test_a_turn_by_a_right_angle(name: str) -> None:
    """Straight lines come to lie as those of the next layer, and tubes as they lay."""
    quarter = family_of(name, {"angle": 90})
    after = 4 if name == "rectilinear" else 3
    assert apart(lines(FAMILIES[name], layer=after), lines(quarter)) < 1e-6


@pytest.mark.parametrize("name", ["zigzag", "honeycomb", "gyroid", "schwarz-d", "rectilinear"])
def test_a_turn_by_half_and_a_shift(name: str) -> None:
    """The symmetry that each pattern has: a half turn about a point between two rows."""
    family = FAMILIES[name]
    shift = {"gyroid": (0.0, 2.0), "schwarz-d": (1.0, 1.0), "rectilinear": (0.0, 0.0)}.get(name)
    if shift is None:
        (wave,) = family.rows(PathSpec(cell=4.0, line_width=WIDTH, radius=0.3)).waves  # type: ignore[attr-defined]
        shift = (wave.period / 2, wave.height)
    # Where a gyroid has its corners is interpolated, forwards along one wave and backwards along the other.
    limit = 5e-6 if name == "gyroid" else 1e-6
    assert apart(lines(family), lines(family_of(name, {"angle": 180, "phase": shift}))) < limit


def test_the_comparison_can_fail() -> None:
    family = FAMILIES["honeycomb"]
    assert apart(lines(family), lines(family_of("honeycomb", {"phase": (0.0, 1e-3)}))) > 0.9e-3


def test_without_a_turn_a_family_is_itself() -> None:
    for name in FAMILIES:
        assert not isinstance(family_of(name, {}), TurnedFamily)


def test_hearts_stand_on_a_point() -> None:
    """The tip of every heart lies to the lower left of the middle; turned by 45°, below it."""
    family = family_of("concentric-heart", {"angle": 45, "middle": (50.0, 60.0)})
    paths = family.strands((40, 50, 60, 70), PathSpec(cell=4.0, line_width=WIDTH, z=0.2, layer=0, radius=0.0))
    for path in paths:
        assert path[path[:, 1].argmin(), 0] == pytest.approx(50, abs=1e-9)
        assert path[:, 0].min() + path[:, 0].max() == pytest.approx(100, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("flats", [0.25, 4.0])
def test_flats_of_the_honeycomb(flats: float) -> None:
    """At both ends of the range lines neither cross nor overlap, and the guess of the cell holds."""
    family = family_of("honeycomb", {"flats": flats})
    assert family == HoneycombPaths(flats=flats)
    paths = family.strands((-20, -20, 20, 20), PathSpec(cell=4.0, line_width=WIDTH, z=0, layer=0, radius=1.0))
    assert shapely.MultiLineString([shapely.LineString(path) for path in paths]).is_simple
    assert least_spacing(paths, near=4 * WIDTH, most=0.6) > GAP - 0.002
    asked = 0.15 * DISC.area / GAP
    solved = solve_cell([(outline_of(DISC), 0.6, 3)], family, asked, line_width=WIDTH)
    assert abs(solved.error) <= 0.01
    assert family.cell_for(0.15, WIDTH) == pytest.approx(solved.cell, rel=0.1)


def test_a_drawing_is_turned(tile: Path) -> None:
    found = [family_of(str(tile), each) for each in ({}, {"angle": ANGLE})]
    plain, other = (lines(each) for each in found)
    assert found[1].name == "tile.svg"
    assert apart(turned(plain, ANGLE), other) < 1e-6


# --- how they are given ----------------------------------------------------------------------------------------


def test_the_command_line_wins_over_the_file(tmp_path: Path) -> None:
    config = tmp_path / "a.toml"
    config.write_text(
        'pattern = "honeycomb"\ndensity = "20%"\nsmooth-radius = 1\nmax_deviation = 0.2\nlayers = [5, 20]\n'
        'object = "box"\nflats = 2\n[set]\nangle = 30\nphase = [1, 2]\n'
    )
    filed = {"pattern": "honeycomb", "density": 0.2, "smooth_radius": 1, "max_deviation": 0.2, "layers": (5, 20)}
    filed |= {"part": "box", "flats": 2, "angle": 30, "phase": (1.0, 2.0)}
    assert resolve({"density": None}, config) == filed
    assert resolve({"density": "same", "layers": "7-"}, config, ["angle=-45", "phase=0,0"]) == filed | {
        "density": "same",
        "layers": (7, ENDLESS),
        "angle": -45,
        "phase": (0.0, 0.0),
    }
    with pytest.raises(ParameterError, match="gyroid has no option 'flats'; it has cell, angle, phase, pattern"):
        resolve({"pattern": "gyroid"}, config)


def test_what_is_not_given_is_not_there(tmp_path: Path) -> None:
    config = tmp_path / "a.toml"
    config.write_text("")
    assert resolve({"pattern": None, "layers": None}) == resolve({}, config) == {}


MISTAKES = {
    'patern = "gyroid"': "keep has no option 'patern'; did you mean 'pattern'?",
    "colour = 3": "keep has no option 'colour'; it has pattern, density, by, smooth_radius, max_deviation, max_segments, arcs, even, leeway, layers, object",
    "[set]\nangle = 3": "keep has no parameter 'angle'; it has none",
    "set = 3": "set is 3; it must be a table",
    "pattern = 3": "pattern is 3; it must be a word",
    'pattern = "gyroid"\n[set]\nangle = "wide"': "angle of gyroid is 'wide'; it must be a number from -180 to 180 degr",
    'pattern = "gyroid"\n[set]\nphase = [1]': "phase of gyroid is 1 mm; it must be 2 numbers from -10000 to 10000 mm",
    "density = true": "density is True; it must be a number",
    'density = "dense"': "density is 'dense'; give same, or a share such as 20%",
    "density = 200": "density is 200; give same, or a share such as 20%",
    "smooth-radius = [1]": "smooth_radius is [1]; give auto, or a number in mm",
    'max-deviation = "wide"': "max_deviation is 'wide'; it must be a number",
    "layers = [1, 2, 3]": "layers is [1, 2, 3]; give a range such as 5-20, or 5-",
    "layers = [1.5, 2]": "layers is [1.5, 2]; give a range such as 5-20, or 5-",
    "layers = true": "layers is True; give a range such as 5-20, or 5-",
    "object = 3": "object is 3; it must be a word",
    'object = " "': "object is ' '; it must be a word",
    "layers = ": "is not TOML: ",
}


@pytest.mark.parametrize("text", MISTAKES)
def test_a_mistake_in_the_file_is_one_line(text: str, tmp_path: Path) -> None:
    config = tmp_path / "a.toml"
    config.write_text(text)
    with pytest.raises((ParameterError, PatternError, FormatError)) as caught:
        resolve({}, config)
    said = str(caught.value)
    assert MISTAKES[text] in said
    assert "\n" not in said


@pytest.mark.longest
@given(st.one_of(st.text(), st.integers(), st.floats(), st.lists(st.integers(), max_size=3), st.booleans(), st.none()))
@example("9" * 5000)
@example("5-" + "9" * 5000)
@example("1e999")
@example("nan")
@example(" ٣ - ٤ ")
def test_whatever_is_given_is_read_or_refused_in_one_line(value: object) -> None:
    for name, read in (("layers", parse_range), ("density", parse_share_or_same), ("smooth_radius", parse_radius)):
        try:
            found = read(name, value)
        except ParameterError as error:
            found = str(error)
        assert isinstance(found, (tuple, float, int)) or len(found.splitlines()) == 1


@given(st.integers(0, 999_999_999), st.integers(0, 999_999_999))
def test_ranges_are_read_as_written(first: int, last: int) -> None:
    assert parse_range("layers", f"{first}-{last}") == parse_range("layers", [first, last]) == (first, last)
    assert parse_range("layers", f" {first} - ") == (first, ENDLESS)
    assert parse_range("layers", f"{first}") == parse_range("layers", first) == (first, first)


@pytest.mark.longest
@given(st.floats(-180, 180), st.floats(-1e4, 1e4), st.floats(-1e4, 1e4))
def test_parameters_are_read_as_written(angle: float, x: float, y: float) -> None:
    kind = default_parameters("gyroid")
    assert parse_assignment(kind, f"angle={angle!r}") == ("angle", angle)
    assert parse_assignment(kind, f"phase = {x!r}, {y!r}") == ("phase", (x, y))
    found = resolve({"pattern": "gyroid"}, assigned=[f"angle={angle!r}", f"phase={x!r},{y!r}"])
    assert found == {"pattern": "gyroid", "angle": angle, "phase": (x, y)}


# --- a print refilled ------------------------------------------------------------------------------------------


@pytest.mark.longest
@pytest.mark.parametrize("name", ["honeycomb", "rectilinear", "gyroid", "drawing"])
def test_a_turned_pattern_takes_the_filament_that_was_there(name: str, gcode: Path, tile: Path) -> None:
    """Within 1 %; an independent judge finds nothing else changed, and paths lie elsewhere than those of the pattern."""
    pattern, texts = (str(tile) if name == "drawing" else name), []
    for words in ([], ["--set", "angle=30"]):
        output = gcode.with_name("new.gcode")
        result = run("refill", gcode, "-o", output, "--force", "--pattern", pattern, *words, "--json", "-q")
        assert result.exit_code == 0, result.stderr
        report = json.loads(result.stdout)
        assert report["sections"] == {"all": 3, "replaced": 3, "kept": {}}
        assert report["request"]["parameters"]["angle"] == (30.0 if words else 0.0)
        texts.append(output.read_bytes())
        assert judge(PRINT, texts[-1], filament=(0.99, 1.01)) == []
    assert texts[0] != texts[1]
    refill(gcode, pattern=pattern, angle=30)
    assert gcode.read_bytes() == texts[1]


@pytest.mark.long
@pytest.mark.parametrize("name", ["rectilinear", "gyroid", "concentric", "drawing"])
def test_the_cell_decides_the_filament(name: str, gcode: Path, tile: Path) -> None:
    """Beads are as wide as the slicer's: half the cell takes twice the filament.

    Within a quarter, in a square of 11 mm: lines come and go whole, and what is small keeps the distance of beads.
    """
    taken = {}
    for cell in (2.0, 4.0):
        output = gcode.with_name("new.gcode")
        report = refill(gcode, output=output, pattern=str(tile) if name == "drawing" else name, cell=cell).report
        assert report["sections"]["replaced"] == 3
        assert report["request"]["parameters"]["cell"] == cell
        taken[cell] = report["filament"]["infill_after_mm"]
        assert judge(PRINT, output.read_bytes(), filament=(0.1, 10)) == []
    assert taken[2.0] / taken[4.0] == pytest.approx(2, rel=0.25)


@pytest.mark.longest
def test_hearts_lie_about_the_middle_that_is_given(gcode: Path) -> None:
    """Two middles a cell apart and more give other paths; none given gives those of the part."""
    texts = []
    for more in ({}, {"middle": (100.0, 100.0)}, {"middle": (103.0, 98.0)}):
        refill(gcode, output=gcode.with_name("new.gcode"), pattern="concentric-heart", **more)
        texts.append(gcode.with_name("new.gcode").read_bytes())
    assert len(set(texts)) == 3


# --- from the command, and from Python ---------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--set", "angle=30"], "--set angle=30: keep has no parameter 'angle'; it has none"),
        (["--pattern", "gyroid", "--set", "angel=3"], "gyroid has no parameter 'angel'; did you mean 'angle'?"),
        (["--pattern", "gyroid", "--set", "qq=3"], "gyroid has no parameter 'qq'; it has cell, angle, phase"),
        (["--pattern", "gyroid", "--set", "angle"], "--set angle: give a name and a value with = between"),
        (["--pattern", "gyroid", "--set", "angle=270"], "is 270 degrees; it must be a number from -180 to 180 degrees"),
        (["--pattern", "gyroid", "--set", "angle=nan"], "is nan degrees; it must be a number from -180 to 180 degrees"),
        (["--pattern", "gyroid", "--set", "phase=1"], "it must be 2 numbers from -10000 to 10000 mm"),
        (["--pattern", "gyroid", "--set", "density=1"], "density is not a parameter of gyroid; give --density"),
        (["--pattern", "concentric", "--set", "angle=1"], "concentric has no parameter 'angle'; it has cell"),
        (["--pattern", "gyroid", "--set", "cell=5", "--density", "20%"], "density and cell are both given"),
        (["--pattern", "gyroid", "--set", "cell=0.3"], "cell is 0.3 mm; beads of 0.45 mm need at least 0.40725 mm"),
        (["--pattern", "gyroid", "--set", "cell=0"], "cell of gyroid is 0 mm; it must be a number from 0.1 to 1000 mm"),
        (
            ["--pattern", "concentric-heart", "--set", "middle=3"],
            "it must be 2 numbers from -10000 to 10000 mm, or none",
        ),
        (["--pattern", "honeycomb", "--set", "flats=9"], "flats of honeycomb is 9; it must be a number from 0.25 to 4"),
        (["--pattern", "gyroid", "--set", "angle=1", "--set", "angle=2"], "differ; give angle once"),
        (["--pattern", "gyroid", "--set", "an\ngle=3"], "--set an gle=3: gyroid has no parameter 'an\\ngle'"),
        (["--config", "none.toml"], "there is no config file none.toml; check the name"),
        (["--config", "."], "cannot read .: "),
    ],
)
def test_a_mistake_is_one_line_and_the_print_stays(words: list[str], says: str, gcode: Path) -> None:
    refused(run("refill", gcode, *words), re.escape(says))
    assert gcode.read_bytes() == PRINT


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--layers", "0"], "--layers is 0 to 0; count from 1, the lower one first"),
        (["--layers", "0-3"], "--layers is 0 to 3; count from 1"),
        (["--layers=-3"], "--layers is '-3'; give a range such as 5-20, or 5-"),
        (["--layers", ""], "--layers is ''; give a range"),
        (["--layers", "1.5"], "--layers is '1.5'; give a range"),
        (["--layers", "2-3-4"], "--layers is '2-3-4'; give a range"),
        (["--layers", "1,3"], "--layers is '1,3'; give a range"),
        (["--layers", "9" * 5000], "; give a range"),
        (["--object", ""], "--object is ''; it must be a word"),
        (["--object", " \t"], "it must be a word"),
    ],
)
def test_hostile_layers_and_objects_are_one_line(words: list[str], says: str, gcode: Path) -> None:
    refused(run("refill", gcode, *words), re.escape(says))
    assert gcode.read_bytes() == PRINT


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--layers", "6-"], "--layers is 6 and more, and the print has 5; give some from 1 to 5"),
        (["--layers", "999999999"], "--layers is 999999999, and the print has 5; give some from 1 to 5"),
        (["--object", "näht \x1b[31m"], "which is in no name of an object; nothing in its file names one"),
    ],
)
def test_what_is_not_in_the_print_leaves_it_and_is_said(words: list[str], says: str, gcode: Path) -> None:
    refused(run("refill", gcode, *words), re.escape(says))
    assert gcode.read_bytes() == PRINT


@pytest.mark.longest
def test_python_gives_parameters_by_name(gcode: Path) -> None:
    result = refill(gcode, dry_run=True, pattern="concentric-heart", angle=30, middle=(100, 100))
    assert result.report["request"]["parameters"] == {"cell": None, "angle": 30.0, "middle": [100.0, 100.0]}
    for given_, says in (
        ({"angel": 1}, "concentric-heart has no parameter 'angel'; did you mean 'angle'"),
        ({"angle": 229}, "angle of concentric-heart is 229.* degrees; it must be a number from -180 to 180 degrees"),
        ({"middle": (1, math.nan)}, "middle of concentric-heart is 1,nan mm; it must be 2 numbers"),
        ({"flats": 1}, "concentric-heart has no parameter 'flats'"),
    ):
        with pytest.raises(ParameterError, match=says):
            refill(gcode, dry_run=True, pattern="concentric-heart", **given_)
    with pytest.raises(ParameterError, match="keep has no parameter 'angle'"):
        refill(gcode, dry_run=True, angle=1.0)


@pytest.mark.longest
def test_a_shell_completes_the_parameters_of_the_pattern() -> None:
    assert offered("infill refill a.gcode --pattern honeycomb --set ") == {"cell=", "angle=", "phase=", "flats="}
    assert offered("infill refill a.gcode --pattern concentric-heart --set m") == {"middle="}
    assert offered("infill refill a.gcode --pattern tile.svg --set a") == {"angle="}
    assert not offered("infill refill a.gcode --set ") - {""}  # keep has none


# --- the page -----------------------------------------------------------------------------------------------------


def test_the_page_tells_every_parameter() -> None:
    """Its name, which patterns have it, what it means and what it may be."""
    text = (ROOT / "docs" / "refill.md").read_text(encoding="utf-8")
    text = text.partition("### Their parameters")[2].partition("\n## ")[0]
    rows = [re.split(r"\s*\|\s*", line.strip("| ")) for line in text.splitlines() if line.startswith("| `")]
    told = {row[0].strip("`"): row for row in rows}
    having: dict[str, list[str]] = {}
    for pattern in FAMILIES:
        for name in parameters(default_parameters(pattern)):
            having.setdefault(name, []).append(pattern)
    assert set(told) == set(having)
    for name, (_, of, meaning, may) in told.items():
        named = set(re.findall(r"`([^`]+)`", of))
        assert having[name] == [each for each in FAMILIES if (each in named) != of.startswith("all")]
        field, described = parameters(default_parameters(having[name][0]))[name]
        assert meaning.startswith(described.help)
        assert describe_values(field.default, described).removeprefix("a number ") == may
