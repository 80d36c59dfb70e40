"""A density that changes: it is there what the field says, cells stay whole, and every kind of field says the same."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import manifold3d
import numpy as np
import pytest
from made_shapes import box
from PIL import Image
from test_command_line import one_line_error, run, usage_error

from infill import GeometryError, InfillError, UsageError, fill
from infill.errors import FormatError
from infill.meshes.solids import to_manifold

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

WALL, CELL = 1.2, 7.0
SIDE = 2 * CELL
LOW, HIGH = 0.1, 0.4


@pytest.mark.longest
@pytest.mark.parametrize(
    ("pattern", "voxel"), [("gyroid", None), ("schwarz-p", 0.4), ("octet", 0.36), ("honeycomb", None)]
)
def test_the_local_density_follows_a_linear_field(pattern: str, voxel: float | None) -> None:
    """In cubes of two cells that make up all of the inside, to two percentage points; and nothing comes apart."""
    block = box(SIDE + 2 * WALL, SIDE + 2 * WALL, 3 * SIDE + 2 * WALL)
    result = fill(block, pattern, density=(LOW, HIGH), by="z", cell=CELL, wall=WALL, voxel=voxel)
    report, voids = result.report, to_manifold(result.stages.voids)
    assert report["problems"] == []
    for level in range(3):
        wanted = LOW + (HIGH - LOW) * (level + 0.5) / 3
        cells = manifold3d.Manifold.cube([SIDE] * 3).translate([-SIDE / 2, -SIDE / 2, (level - 1.5) * SIDE])
        assert 1 - (voids ^ cells).volume() / SIDE**3 == pytest.approx(wanted, abs=0.02)
    # No wall is broken that is whole where all are as thin: voids would hang together that do not there.
    thin = fill(block, pattern, density=LOW, cell=CELL, wall=WALL, voxel=voxel).report
    assert report["voids"]["count"] >= thin["voids"]["count"]
    assert report["voids"]["islands"] == 0
    assert report["density"] == pytest.approx((LOW + HIGH) / 2, abs=0.006)
    steps = report["graded"]
    assert [step["wanted"] for step in steps] == sorted(step["wanted"] for step in steps)
    assert all(abs(step["density"] - step["wanted"]) < 0.02 for step in steps)
    assert report["request"]["density"] is None
    assert report["request"]["densities"] == [LOW, HIGH]


def quick(by: Any, **more: Any) -> Any:
    return fill(box(24, 20, 16), density=(0.15, 0.4), by=by, wall=1, voxel=0.5, cell=8.0, **more)


@pytest.fixture(scope="module")
def by_x() -> Any:
    return quick("x")


@pytest.mark.longest
def test_every_field_that_is_linear_is_the_same(by_x: Any, tmp_path: Path) -> None:
    ends = np.array([[x, y, z, 3 * x] for x in (-12, 12) for y in (-10, 10) for z in (-8, 8)])
    (tmp_path / "stress.csv").write_text("x,y,z,MPa\n" + "\n".join(",".join(map(str, row)) for row in ends))
    (tmp_path / "field.py").write_text("def pressure(points):\n    return 2 * points[:, 0] + 5\n")
    ramp = np.linspace(0, 255, 240).astype(np.uint8)
    Image.fromarray(np.tile(ramp, (20, 1))).save(tmp_path / "ramp.png")
    values = np.tile(np.arange(48.0)[:, None, None], (1, 3, 2))
    np.save(tmp_path / "values.npy", values)
    same: dict[str, Any] = {
        "a table": tmp_path / "stress.csv",
        "a function of a file": f"{tmp_path / 'field.py'}:pressure",
        "a picture": str(tmp_path / "ramp.png"),
        "a file of boxes": tmp_path / "values.npy",
        "boxes": values,
        "points": ends,
        "a function": lambda points: np.asarray(points[:, 0]),
    }
    for name, by in same.items():
        found = quick(by)
        assert found.surface.volume == pytest.approx(by_x.surface.volume, rel=1e-3), name
        for step, wanted in zip(found.report["graded"], by_x.report["graded"], strict=True):
            assert step == pytest.approx(wanted, abs=0.01), name
    assert quick("x", pattern="gyroid").surface.volume == by_x.surface.volume


@pytest.mark.longest
def test_the_other_way_round_is_the_mirror_image() -> None:
    """The gyroid is its own mirror image only with its hand changed; Schwarz P is in every plane through its middle."""
    one = fill(box(24, 20, 16), "schwarz-p", density=(0.15, 0.4), by="x", wall=1, voxel=0.5, cell=8.0, tolerance=0)
    other = fill(box(24, 20, 16), "schwarz-p", density=(0.4, 0.15), by="x", wall=1, voxel=0.5, cell=8.0, tolerance=0)
    assert other.surface.volume == pytest.approx(one.surface.volume, rel=5e-3)
    left, right = (
        to_manifold(each.stages.voids).trim_by_plane([sign, 0, 0], 0) for each, sign in ((one, 1), (other, -1))
    )
    assert left.volume() == pytest.approx(right.volume(), rel=1e-2)


@pytest.mark.longest
def test_the_skin_is_where_its_field_begins() -> None:
    result = fill(box(30, 30, 30), density=(0.4, 0.12), by="skin", wall=1, voxel=0.5, cell=5.0)
    assert result.report["problems"] == []
    voids = to_manifold(result.stages.voids)

    def density(low: float, high: float) -> float:
        """Of what lies between two cubes."""
        outer, inner = (manifold3d.Manifold.cube([side] * 3, center=True) for side in (high, low))
        return 1 - (voids ^ (outer - inner)).volume() / (high**3 - low**3)

    rings = [density(low, low + 5) for low in (8.0, 13.0, 18.0, 23.0)]
    assert rings == sorted(rings)
    assert rings[-1] > rings[0] + 0.12


@pytest.mark.longest
@pytest.mark.parametrize("form", ["infill", "project"])
def test_other_forms_are_graded_too(form: str) -> None:
    report = quick("z", as_=form, pattern="honeycomb").report
    assert report["problems"] == []
    assert all(abs(step["density"] - step["wanted"]) < 0.03 for step in report["graded"])


@pytest.mark.longest
@pytest.mark.parametrize(
    ("given", "width"),
    [
        ({"pattern": "gyroid"}, 0.45),
        ({"pattern": "honeycomb"}, 0.45),
        ({"pattern": "honeycomb", "as_": "project"}, 0.9),
    ],
)
def test_the_thinnest_walls_are_about_as_wide_as_walls_are_otherwise(given: dict[str, Any], width: float) -> None:
    """As drawn: fillets add to them."""
    infill = fill(box(30, 30, 24), density=(0.15, 0.4), voxel=0.5, **given).report["infill"]
    assert infill["widths"][0] == pytest.approx(width, rel=0.2)
    assert infill["widths"][1] > 2 * infill["widths"][0]


@pytest.mark.parametrize(
    ("given", "error", "says"),
    [
        ({"density": 0.2, "by": "x"}, UsageError, "by is given with one density; give two"),
        ({"density": (0.1, 0.2, 0.3)}, UsageError, "density has 3 numbers"),
        ({"density": (0.1, 120)}, InfillError, "density is 120"),
        ({"density": (0.1, 0.3), "by": "w"}, UsageError, "by is 'w'; give x, y, z, skin"),
        ({"density": (0.1, 0.3), "by": 5}, UsageError, "by is 5; give"),
        ({"density": (0.1, 0.3), "by": "none.csv"}, FormatError, "no file none.csv"),
        ({"density": (0.1, 0.3), "by": np.ones((3, 3, 3))}, GeometryError, "which is 1 everywhere in the part"),
        ({"density": (0.1, 0.3), "by": np.array([[0, 0, 0, np.nan]])}, FormatError, "not finite"),
        ({"density": (0.1, 0.3), "by": np.ones((3, 3))}, FormatError, r"of shape \(3, 3\)"),
        ({"density": (0.1, 0.3), "by": lambda points: points}, UsageError, r"return \(N,\)"),
        ({"density": (0.1, 0.3), "by": lambda points: points[:, 0] * np.nan}, GeometryError, "not finite everywhere"),
    ],
)
def test_fields_that_say_nothing_are_refused(given: dict[str, Any], error: type[Exception], says: str) -> None:
    with pytest.raises(error, match=says):
        fill(box(20, 20, 20), voxel=0.5, **given)


@pytest.mark.longest
def test_the_command_grades_and_remembers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    box(20, 16, 14).export("part.stl")
    words = ["fill", "part.stl", "--density", "15%:40%", "--by", "y", "--voxel", "0.5"]
    done = run(*words, "-o", "a.stl", "--save-config", "a.toml", "--json")
    assert done.exit_code == 0
    assert json.loads(done.stdout)["request"]["by"] == "y"
    assert "15% at the lowest y to 40% at the highest y" in done.stderr
    again = run("fill", "part.stl", "--config", "a.toml", "-q", "-o", "b.stl")
    assert again.exit_code == 0
    assert Path("a.stl").read_bytes() == Path("b.stl").read_bytes()
    even = run("fill", "part.stl", "--config", "a.toml", "--density", "20%", "--save-config", "-")
    assert even.exit_code == 0
    assert "by" not in even.stdout.replace("bytes", "")
    assert "density = 0.2" in even.stdout
    usage_error(run(*words[:2], "--density", "15%:x", "-o", "c.stl"), "--density")
    usage_error(run(*words[:2], "--density", "20%", "--by", "y", "-o", "c.stl"), "--by")
    usage_error(run(*words[:2], "--density", "15%:40%", "--by", "w", "-o", "c.stl"), "--by is 'w'")
    Path("bad.csv").write_text("x,y,z,v\n1,2,3,here\n")
    one_line_error(
        run(*words[:4], "--by", "bad.csv", "-o", "c.stl"),
        "line 2 of bad.csv is '1,2,3,here'; write x, y, z and a value, four numbers in each row",
    )
    Path("bad.py").write_text("def field(points):\n    return 1 / 0\n\n\ndef none(:\n")
    one_line_error(run(*words[:4], "--by", "bad.py:field", "-o", "c.stl"), "bad.py cannot be loaded")
    Path("bad.py").write_text("def field(points):\n    return 1 / 0\n")
    one_line_error(run(*words[:4], "--by", "bad.py:other", "-o", "c.stl"), "bad.py has nothing called 'other'")
    one_line_error(
        run(*words[:4], "--by", "bad.py:field", "-o", "c.stl"), "by is bad.py:field, which fails: division by zero"
    )
    assert not Path("c.stl").exists()
