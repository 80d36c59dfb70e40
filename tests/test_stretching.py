"""Cells that follow a field: coordinates that are never torn, walls as wide as asked for, and the density of the field."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import manifold3d
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from made_shapes import box
from numpy.typing import NDArray
from test_command_line import run, usage_error

from infill import UsageError, fill
from infill.interior.conformal_map import fit_conformal_map, map_points, spline_jacobians, wall_density_factor
from infill.lattices import void_meshes
from infill.lattices.void_meshes import median_width
from infill.lattices.voids import NODES
from infill.meshes.solids import to_manifold
from patterns import Gyroid

pytestmark = pytest.mark.usefixtures("compiled", "coarse_grids")

Floats = NDArray[np.float64]
WALL, CELL = 1.2, 7.0
LOW, HIGH = 0.15, 0.4


@pytest.mark.longest
@given(scale=st.floats(0.2, 5), shape=st.tuples(*[st.integers(2, 6)] * 3))
@settings(max_examples=20, deadline=None)
def test_one_scale_everywhere_is_a_scale(scale: float, shape: tuple[int, int, int]) -> None:
    coordinates, more = fit_conformal_map(np.full(shape, scale))
    nodes = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1).reshape(-1, 3).astype(float)
    middle = (np.array(shape) - 1) / 2
    np.testing.assert_allclose(map_points(coordinates, nodes), middle + scale * (nodes - middle), atol=1e-9)
    np.testing.assert_allclose(more, scale, rtol=1e-9)


def test_coordinates_are_as_their_slopes_say() -> None:
    random = np.random.default_rng(1)
    coordinates, _ = fit_conformal_map(random.uniform(0.7, 1.5, (7, 9, 8)))
    nodes, tiny = np.stack(np.meshgrid(*map(np.arange, (5, 7, 6)), indexing="ij"), axis=-1).reshape(-1, 3) + 1.0, 1e-5
    for axis in range(3):
        step = tiny * np.eye(3)[axis]
        slopes = (map_points(coordinates, nodes + step) - map_points(coordinates, nodes - step)) / (2 * tiny)
        found = spline_jacobians(coordinates)[1:-1, 1:-1, 1:-1, :, axis].reshape(-1, 3)
        np.testing.assert_allclose(found, slopes, atol=1e-8)


@pytest.mark.longest
def test_walls_in_a_volume_are_those_of_the_ellipsoid() -> None:
    """The mean of sqrt(1 - u² + b² u²) over u from 0 to 1 has a closed form."""
    for long in (0.25, 0.9, 1.7, 4.0):
        slope = long**2 - 1
        root = math.sqrt(abs(slope))
        partial = math.asinh(root) if slope > 0 else math.asin(root)
        expected = (long + partial / root) / 2
        assert wall_density_factor(np.diag([1.0, 1.0, long])) == pytest.approx(expected, rel=2e-3)


@pytest.mark.slow
@given(data=st.data())
@settings(max_examples=30, deadline=None)
def test_no_cell_is_torn_or_folded_over(data: st.DataObject) -> None:
    """However wild the field: coordinates are continuous, and turn nowhere inside out."""
    shape = data.draw(st.tuples(*[st.integers(4, 12)] * 3))
    random = np.random.default_rng(data.draw(st.integers(0, 1000)))
    scales = np.exp(random.uniform(-1.2, 1.2, shape))
    coordinates, more = fit_conformal_map(scales)
    assert np.linalg.det(spline_jacobians(coordinates)).min() > 0
    assert np.isfinite(more).all()


@pytest.mark.slow
def test_a_step_that_would_fold_cells_is_evened_out() -> None:
    up = np.linspace(0, 1, 24)
    scales = np.broadcast_to(np.where(up > 0.5, 4.0, 0.2), (12, 12, 24))
    coordinates, more = fit_conformal_map(scales)
    assert np.linalg.det(spline_jacobians(coordinates)).min() > 0
    assert more[..., -1].mean() > 2 * more[..., 0].mean()


def specification(table: NDArray[np.float32], coordinates: Floats, step: float, period: float, shape: Any) -> Floats:
    """Return distances, in cells, as `from_stretched_period` is to: by spline and slopes, in NumPy alone."""
    from scipy.interpolate import RegularGridInterpolator

    around = np.pad(table, ((0, 1),) * 3, mode="wrap").astype(np.float64)
    line = np.arange(NODES + 1) / NODES
    distance = RegularGridInterpolator((line, line, line), around)
    cells = np.indices(shape).reshape(3, -1).T.astype(float)
    tiny = 1e-6

    def where(points: Floats) -> Floats:
        inside: Floats = (map_points(coordinates, points / step) * step / period) % 1.0
        return inside

    value = distance(where(cells))
    # The slope of what is straight between the nodes of the table, within one of its cubes.
    inside = where(cells)
    low = np.minimum(np.floor(inside * NODES), NODES - 1) / NODES
    slope = np.empty((len(cells), 3))
    for axis in range(3):
        ends = np.array([inside, inside])
        ends[:, :, axis] = [low[:, axis], low[:, axis] + 1 / NODES]
        slope[:, axis] = (distance(np.clip(ends[1], 0, 1)) - distance(ends[0])) * NODES
    slope /= np.maximum(np.linalg.norm(slope, axis=1), 0.05)[:, None]
    jacobian = np.stack(
        [
            (
                map_points(coordinates, (cells + tiny * each) / step)
                - map_points(coordinates, (cells - tiny * each) / step)
            )
            * step
            / (2 * tiny)
            for each in np.eye(3)
        ],
        axis=-1,
    )
    across = np.linalg.norm(np.einsum("nj,nja->na", slope, jacobian), axis=1)
    found: Floats = value * period / np.maximum(across, 0.05)
    return found.reshape(shape)


@pytest.mark.slow
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_kernel_computes_what_it_is_to(sign: float) -> None:
    from infill.kernels.stretched import from_stretched_period
    from infill.lattices.voids import period_table

    random = np.random.default_rng(3)
    nodes, step, period = (4, 5, 4), 5.0, 11.0
    coordinates, _ = fit_conformal_map(random.uniform(0.7, 1.5, nodes))
    shape = tuple(int((count - 1) * step) for count in nodes)
    table = period_table(Gyroid())
    depth = np.full(shape, np.float32(np.inf))
    depth[:2] = -3.0
    out = np.empty(shape, dtype=np.float32)
    ratio, half = random.uniform(0.8, 1.2, (1, 1, 1)).astype(np.float32), 0.7
    filled = sum(
        from_stretched_period(
            depth, -2.5, table, np.eye(3), np.zeros(3), period, sign, half, ratio, step, coordinates, out, thread, 2
        )
        for thread in range(2)
    )
    expected = sign * specification(table, coordinates, step, period, shape) - half * float(ratio[0, 0, 0])
    np.testing.assert_array_equal(out[:2], -3.0)
    np.testing.assert_allclose(out[2:], expected[2:], atol=2e-3)
    assert filled == pytest.approx(np.clip(out[2:] + 0.5, 0, 1).sum(), rel=1e-5)


@pytest.fixture(scope="module")
def ramp() -> Any:
    side = 4 * CELL
    return fill(
        box(side + 2 * WALL, side + 2 * WALL, 6 * CELL + 2 * WALL),
        "gyroid",
        density=(LOW, HIGH),
        by="z",
        grade="cell",
        line_width=0.6,
        wall=WALL,
        voxel=0.4,
    )


@pytest.mark.longest
def test_the_local_density_follows_a_linear_field(ramp: Any) -> None:
    """In slabs of the inside, to two percentage points, and walls are as wide where cells are small as where large."""
    report, voids = ramp.report, to_manifold(ramp.stages.voids)
    assert report["problems"] == []
    side, high = 4 * CELL, 6 * CELL
    for level in range(3):
        wanted = LOW + (HIGH - LOW) * (level + 0.5) / 3
        slab = manifold3d.Manifold.cube([side, side, high / 3]).translate(
            [-side / 2, -side / 2, (level - 1.5) * high / 3]
        )
        assert 1 - (voids ^ slab).volume() / slab.volume() == pytest.approx(wanted, abs=0.02)
    assert report["voids"]["count"] == 2
    assert report["voids"]["islands"] == 0
    small, large = report["infill"]["cells"]
    assert large > 2 * small
    narrow, wide = report["infill"]["widths"]
    assert narrow > 0.85 * wide
    assert report["request"]["grade"] == "cell"


@pytest.mark.longest
def test_densities_that_are_told_are_those_of_the_mesh() -> None:
    """Of thin walls too, in cells of the grid as wide as they are: which centres are solid says something else."""
    found = fill(box(90, 24, 24), density=(0.1, 0.4), by="x", grade="cell", voxel=0.9, wall=WALL)
    long, side = 90 - 2 * WALL, 24 - 2 * WALL
    voids = to_manifold(found.stages.voids)
    for third, step in enumerate(found.report["graded"]):
        slab = manifold3d.Manifold.cube([long / 3, side, side], True).translate([(third - 1) * long / 3, 0, 0])
        assert step["wanted"] == pytest.approx(0.1 + 0.3 * (third + 0.5) / 3, abs=0.003)
        assert step["density"] == pytest.approx(1 - (voids ^ slab).volume() / slab.volume(), abs=0.006)


@pytest.mark.longest
def test_walls_are_as_wide_above_as_below(ramp: Any) -> None:
    """Measured across them in the finished mesh, in the lowest and in the highest third."""
    part, voids, third = ramp.stages.part, ramp.stages.voids, 2 * CELL
    heights = np.asarray(voids.vertices)[voids.faces].mean(axis=1)[:, 2]
    widths = []
    for low in (-3 * CELL + 2, third / 2):
        some = type(voids)(vertices=voids.vertices, faces=voids.faces[(heights > low) & (heights < low + third - 2)])
        median, seen = median_width(part, some, wall=WALL, width=0.6)
        assert median is not None
        assert seen > 100
        widths.append(median)
    assert widths[0] == pytest.approx(widths[1], rel=0.1)
    assert widths[1] == pytest.approx(ramp.report["infill"]["line_width"], rel=0.1)


@pytest.mark.longest
def test_a_width_is_measured_with_little_of_the_voids_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    found = fill(box(20, 24, 30), density=0.3, voxel=0.6, wall=WALL).stages
    whole = median_width(found.part, found.voids, wall=WALL, width=0.6)
    monkeypatch.setattr(void_meshes, "AT_A_TIME", 500)
    assert len(found.voids.faces) > 20 * 500
    assert median_width(found.part, found.voids, wall=WALL, width=0.6) == whole


@pytest.mark.longest
def test_a_flat_part_leaves_the_rest_to_the_widths_and_says_so() -> None:
    report = fill(box(40, 40, 12), density=(LOW, HIGH), by="z", grade="cell", wall=WALL, voxel=0.5, cell=8.0).report
    assert any("cells cannot follow the density alone" in problem for problem in report["problems"])
    assert all(abs(step["density"] - step["wanted"]) < 0.03 for step in report["graded"])


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ({"density": 0.2, "grade": "cell"}, "grade is given with one density; give two"),
        ({"density": (0.1, 0.3), "grade": "size"}, "grade is 'size'; choose from width, cell"),
        ({"density": (0.1, 0.3), "grade": "cell", "pattern": "octet"}, "cells of octet cannot follow a field"),
        ({"density": (0.1, 0.3), "grade": "cell", "pattern": "honeycomb"}, "cells of honeycomb cannot follow a field"),
        ({"density": (0.1, 0.3), "grade": "cell", "align": "body"}, "cannot begin again in every body"),
    ],
)
def test_what_cells_cannot_follow_is_refused(words: dict[str, Any], says: str) -> None:
    with pytest.raises(UsageError, match=says):
        fill(box(20, 20, 20), voxel=0.5, **words)


@pytest.mark.longest
def test_the_command_takes_and_remembers_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    box(24, 24, 30).export("part.stl")
    words = ["fill", "part.stl", "--density", "20%:40%", "--grade", "cell", "--voxel", "0.6"]
    done = run(*words, "-o", "a.stl", "--save-config", "a.toml", "--json")
    assert done.exit_code == 0, done.stderr
    assert json.loads(done.stdout)["request"]["grade"] == "cell"
    assert ": cells of " in done.stderr.replace("\n", " ")
    again = run("fill", "part.stl", "--config", "a.toml", "-q", "-o", "b.stl")
    assert again.exit_code == 0
    assert Path("a.stl").read_bytes() == Path("b.stl").read_bytes()
    usage_error(run("fill", "part.stl", "--density", "20%", "--grade", "cell", "-o", "c.stl"), "--grade")
