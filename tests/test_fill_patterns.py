"""What may be given to `fill` as a pattern: a name, a drawing, a module's, an object, a function."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest
import shapely
from made_shapes import box
from shapes import IN_SPACE
from test_command_line import one_line_error
from test_command_line import run as command

from infill import FormatError, ParameterError, fill
from infill.drawings.tiled import read_tiled
from infill.options.resolve_pattern import resolve_pattern
from patterns import Honeycomb, Pattern, PatternError, parameter
from patterns.linework import clip

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

GIVEN: dict[str, Any] = {"density": 0.3, "voxel": 0.5, "wall": 1.0}
PART = box(16, 14, 12)
CROSS = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 10"><path d="M0 5 H20 M10 0 V10"/></svg>'
MODULE = '''
"""Patterns of a user's own."""
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from patterns import Honeycomb

def sheet(x, y, z):
    return np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)

def never(x, y, z):
    return 2 + np.sin(x)

def fails(x, y, z):
    return x / undefined

def scalar(x, y, z):
    return 0.5

@dataclass(frozen=True, kw_only=True)
class Mine(Honeycomb):
    name: ClassVar[str] = "mine"

number = 7
'''


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cross.svg").write_text(CROSS)
    (tmp_path / "user.py").write_text(MODULE)
    PART.export(tmp_path / "part.stl")
    return tmp_path


@pytest.mark.longest
def test_a_drawing_is_repeated(folder: Path) -> None:
    """A tile of `cell` by half of it, with a line along each side: 1 / cell + 2 / cell mm of it per mm^2."""
    pattern = read_tiled(folder / "cross.svg")
    assert pattern.name == "cross.svg"
    assert pattern.height == pytest.approx(0.5)
    for cell, angle in ((8.0, 0.0), (5.0, 33.0)):
        placed = type(pattern)(name="cross", drawn=pattern.drawn, height=pattern.height, cell=cell, angle=angle)
        region = shapely.Point(1, 2).buffer(80)
        assert placed.lines(region).length / region.area == pytest.approx(3 / cell, rel=0.01)
        assert placed.line_spacing(region) == cell
        # A whole number of tiles along each side of them brings it back.
        turn = np.array([[math.cos(math.radians(angle)), math.sin(math.radians(angle))]])
        step = (turn * 3 * cell + turn[:, ::-1] * (-1, 1) * 4 * cell / 2).ravel()
        there = placed.lines(shapely.affinity.translate(region, *step))
        assert there.length == pytest.approx(placed.lines(region).length, rel=1e-9)
        assert shapely.hausdorff_distance(shapely.affinity.translate(there, *-step), placed.lines(region)) < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("angle", [0.0, 30.0])
def test_a_part_is_filled_with_a_drawing(folder: Path, angle: float) -> None:
    report = fill(PART, "cross.svg", angle=angle, **GIVEN).report
    assert report["request"]["pattern"] == "cross.svg"
    assert report["density"] == pytest.approx(0.3, abs=0.005)


@pytest.mark.longest
@pytest.mark.parametrize("name", ["user.py:sheet", "user.py:Mine"])
def test_a_part_is_filled_with_what_a_module_holds(folder: Path, name: str) -> None:
    """The same as the pattern of ours that it is."""
    ours = {"user.py:sheet": "gyroid", "user.py:Mine": "honeycomb"}[name]
    one, other = fill(PART, name, **GIVEN), fill(PART, ours, **GIVEN)
    assert one.report["request"]["pattern"] == name
    assert one.report["infill"]["cell"] == pytest.approx(other.report["infill"]["cell"], rel=1e-3)
    assert one.surface.volume == pytest.approx(other.surface.volume, rel=1e-3)


@pytest.mark.longest
def test_what_a_name_stands_for_may_be_given_itself(folder: Path) -> None:
    def waves(x: Any, y: Any, z: Any) -> Any:
        return np.cos(x) + np.cos(y) + np.cos(z)

    volumes = {
        name: fill(PART, kind, **GIVEN).surface.volume
        for name, kind in (
            ("class", Honeycomb),
            ("object", Honeycomb()),
            ("honeycomb", "honeycomb"),
            ("function", waves),
            ("surfaces", IN_SPACE["schwarz-p"]),
        )
    }
    assert volumes["class"] == volumes["object"] == volumes["honeycomb"]
    assert volumes["function"] == pytest.approx(volumes["surfaces"], rel=1e-3)


@pytest.mark.longest
def test_a_pattern_that_is_turned_itself_is_turned_by_both_angles() -> None:
    one, other = fill(PART, Honeycomb(angle=170.0), angle=40.0, **GIVEN), fill(PART, "honeycomb", angle=-150.0, **GIVEN)
    np.testing.assert_array_equal(one.surface.vertices, other.surface.vertices)


@pytest.mark.slow
def test_a_pattern_that_cannot_be_turned_says_so() -> None:
    @dataclass(frozen=True, kw_only=True)
    class Rows(Pattern):
        name: ClassVar[str] = "rows"
        cell: float = parameter(3.0, "distance", unit="mm", low=0.1, high=100.0)

        def lines(self, region: Any, z: float = 0.0) -> shapely.MultiLineString:
            x0, y0, x1, y1 = region.bounds
            rows = np.arange(math.floor(y0 / self.cell), math.ceil(y1 / self.cell) + 1) * self.cell
            return clip([shapely.LineString([(x0, y), (x1, y)]) for y in rows], region)

        def line_spacing(self, region: Any) -> float:
            return self.cell

    assert fill(PART, Rows, **GIVEN).report["density"] == pytest.approx(0.3, abs=0.005)
    with pytest.raises(ParameterError, match="angle is 30 degrees, and rows cannot be turned; leave it out"):
        fill(PART, Rows, angle=30.0, **GIVEN)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("pattern", "error", "says"),
    [
        ("honycomb", PatternError, "no pattern 'honycomb'; did you mean 'honeycomb'"),
        ("user.py:none", FormatError, "nothing called 'none'; it has "),
        ("absent.py:sheet", FormatError, "absent.py"),
        ("absent.svg", FormatError, "absent.svg"),
        ("user.py:never", ParameterError, r"0 nowhere: .* from 1.* to 2\.98"),
        ("user.py:fails", ParameterError, "fails: NameError: name 'undefined'"),
        ("user.py:scalar", ParameterError, "does not return a finite number for each point"),
        ("user.py:number", ParameterError, "which is int; give a Pattern"),
    ],
)
def test_what_is_no_pattern_is_one_clear_line(folder: Path, pattern: str, error: type[Exception], says: str) -> None:
    with pytest.raises(error, match=says):
        resolve_pattern(pattern, "fill")
    result = command("fill", "part.stl", "--pattern", pattern, "-o", "a.stl")
    one_line_error(result, says)
    assert not Path("a.stl").exists()


@pytest.mark.longest
def test_a_seed_on_the_command_line(folder: Path) -> None:
    def volume(*words: str) -> float:
        given = ("fill", "part.stl", "-o", "a.stl", "--force", "--pattern", "voronoi", "--cell", "6", "--json", "-q")
        result = command(*given, *words)
        assert result.exit_code == 0, result.stderr
        return float(json.loads(result.stdout)["volume"])

    assert volume() == volume("--seed", "0") == volume("--set", "seed=0") != volume("--seed", "5")
    one_line_error(command("fill", "part.stl", "-o", "b.stl", "--pattern", "gyroid", "--seed", "3"), "--seed")
    one_line_error(
        command("fill", "part.stl", "-o", "b.stl", "--pattern", "voronoi", "--seed", "3", "--set", "seed=4"), "seed"
    )
