"""A density that changes over a print: what the G-code pushes out is there what the field says, and no line crosses."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import shapely
from gcode_judge import judge
from gcode_structure import supported
from gradient_judge import FILAMENT, SparseLayer, crossing_paths, local_densities, read_sparse
from handmade_prints import SPACING, Dialect, written
from hypothesis import example, given, settings
from hypothesis import strategies as st
from lines import least_spacing
from PIL import Image
from test_command_line import one_line_error, run, usage_error

from infill import GeometryError, InfillError, UsageError, refill
from infill.interior.conformal_map import map_points, spline_jacobians, wall_density_factor
from infill.interior.plane_map import fit_plane_map
from infill.paths.families.catalogue import FAMILIES
from infill.paths.families.family import TOUCH, PathSpec
from infill.paths.families.waves import WaveFamily
from infill.paths.plane_splines import PlaneMap, PlaneSpline, invert_map, pattern_bounds
from infill.paths.stretching import STRETCHED_TOUCH, stretch_family
from infill.refilling.gradients import map_axes

WIDTH = 0.45
DENSE, SPARSE = 0.4, 0.12
STRETCHING = [name for name, family in FAMILIES.items() if family.stretches]
Field = Callable[[np.ndarray], np.ndarray]
Floats = np.ndarray


@pytest.fixture(scope="session")
def sliced(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A box of 60 mm, 4 layers high."""
    path = tmp_path_factory.mktemp("gradients") / "box.gcode"
    path.write_bytes(written(Dialect(size=60.0, cell=5.0, layers=4)))
    return path


@pytest.fixture(scope="session")
def tall(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A box of 24 mm, 60 layers high."""
    path = tmp_path_factory.mktemp("gradients") / "tall.gcode"
    path.write_bytes(written(Dialect(size=24.0, cell=5.0, layers=60)))
    return path


@pytest.fixture(scope="session")
def thin(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A plate of 40 mm with infill in 5 layers."""
    path = tmp_path_factory.mktemp("gradients") / "thin.gcode"
    path.write_bytes(written(Dialect(size=40.0, cell=5.0, layers=7)))
    return path


def side(pattern: str) -> Callable[[float], float]:
    """Return the side of a box of two cells at a density: cells of waves count as squares of their area."""
    family = FAMILIES[pattern]

    def side_of(density: float) -> float:
        cell = family.cell_for(density, WIDTH)
        if not isinstance(family, WaveFamily):
            return 2 * cell
        rows = family.rows(PathSpec(cell=cell, line_width=WIDTH, radius=math.inf))
        return 2 * math.sqrt(rows.waves[0].period * rows.pitch)

    return side_of


def area(layers: list[SparseLayer]) -> shapely.Polygon:
    """Return the area that infill was drawn in: a box."""
    points = np.concatenate([path for layer in layers for path in layer.paths])
    return shapely.box(*points.min(axis=0), *points.max(axis=0))


def along_x(layers: list[SparseLayer]) -> Field:
    x0, _, x1, _ = area(layers).bounds
    return lambda points: np.interp(points[:, 0], [x0, x1], [DENSE, SPARSE])


def nodes(region: shapely.Polygon, count: int = 60) -> Floats:
    """Return the middles of equal squares that make up a box."""
    low, high = np.array(region.bounds).reshape(2, 2)
    axes = [a + (b - a) * (np.arange(count) + 0.5) / count for a, b in zip(low, high, strict=True)]
    return np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)


def filament_errors(layers: list[SparseLayer], wanted: Callable[[Floats, float], Floats]) -> Floats:
    """Return the relative error of the filament of each layer against what a field at its height integrates to."""
    region = area(layers)
    points = nodes(region)
    needs = np.array([wanted(points, layer.z).mean() * region.area * layer.height for layer in layers])
    return np.array([layer.filament for layer in layers]) * FILAMENT / needs - 1


def written_by(path: Path, out: Path, pattern: str, by: object, density: object = (DENSE, SPARSE)) -> list[SparseLayer]:
    refill(path, output=out, pattern=pattern, density=density, by=by)  # type: ignore[arg-type]
    return read_sparse(out.read_text())


def by_skin(layers: list[SparseLayer]) -> Callable[[Floats, float], Floats]:
    """Return the densities at points and a height in a box, by the distance from its sides, its roof and its floor."""
    x0, y0, x1, y1 = area(layers).bounds
    half = layers[0].height / 2
    bottom, top = layers[0].z - half, layers[-1].z + half

    def depth(points: Floats, z: float) -> Floats:
        sides = [points[:, 0] - x0, x1 - points[:, 0], points[:, 1] - y0, y1 - points[:, 1]]
        return np.minimum(np.minimum.reduce(sides), min(z - bottom, top - z))

    deepest = max(depth(nodes(area(layers)), layer.z).max() for layer in layers)

    def wanted(points: Floats, z: float) -> Floats:
        return DENSE + (SPARSE - DENSE) * depth(points, z) / deepest

    return wanted


# --- the density -----------------------------------------------------------------------------------------


def density_errors(layers: list[SparseLayer], pattern: str) -> Floats:
    """Return the errors of the density in boxes of two cells, each with boxes that are shifted a little."""
    pairs = local_densities(layers, area(layers), along_x(layers), side(pattern))
    assert len(pairs) > 20
    errors: Floats = pairs[:, 1] - pairs[:, 0]
    return errors


def spacing_of(layers: list[SparseLayer]) -> float:
    """Return the least distance of lines, in line widths."""
    return min(least_spacing(layer.paths, near=4 * WIDTH, most=0.6) for layer in layers) / WIDTH


@pytest.mark.long
@pytest.mark.parametrize(
    "pattern", ["honeycomb", *(name for name in STRETCHING if name not in ("honeycomb", "concentric"))]
)
def test_lines_that_follow_a_field_obey_its_laws(sliced: Path, tmp_path: Path, pattern: str) -> None:
    """Density to three points, filament of the print to 1 %, 0.95 line widths between lines, no crossing, time 1.15."""
    out = tmp_path / "new.gcode"
    graded = refill(sliced, output=out, pattern=pattern, density=(DENSE, SPARSE), by="x").report
    layers = read_sparse(out.read_text())
    assert np.abs(density_errors(layers, pattern)).max() < 0.03
    wanted = along_x(layers)
    errors = filament_errors(layers, lambda points, _: wanted(points))
    assert abs(errors.mean()) < 0.01
    if FAMILIES[pattern].prismatic or pattern in ("rectilinear", "gyroid"):  # others make up for layers in the next
        assert np.abs(errors).max() < 0.01
    assert sum(map(crossing_paths, layers)) == 0
    assert spacing_of(layers) > (0.92 if pattern == "cubic" else 0.95)  # one layer of cubic: docs/refill.md says so
    plain = refill(sliced, pattern=pattern, density=(DENSE + SPARSE) / 2, dry_run=True).report
    assert graded["time"]["print_after_s"] < 1.15 * plain["time"]["print_after_s"]


@pytest.mark.longest
def test_rings_that_follow_a_field_obey_its_laws(sliced: Path, tmp_path: Path) -> None:
    """The same, but for boxes where rings end, in the middle, and where they turn: round corners are shorter.

    The area of the infill reaches half a cell around the rings.
    """
    out = tmp_path / "new.gcode"
    graded = refill(sliced, output=out, pattern="concentric", density=(DENSE, SPARSE), by="x").report
    layers = read_sparse(out.read_text())
    x0, y0, *_ = area(read_sparse(sliced.read_text())).bounds
    region = shapely.box(x0, y0, 260 - x0, 260 - y0)  # up to the walls, before which rows of waves end above

    def wanted(points: Floats) -> Floats:
        return np.interp(points[:, 0], [region.bounds[0], region.bounds[2]], [DENSE, SPARSE])

    rings = [shapely.Polygon(path) for path in layers[0].paths]
    middle = shapely.buffer(min(rings, key=lambda ring: ring.area), 2 * FAMILIES["concentric"].cell_for(SPARSE, WIDTH))
    pairs = local_densities(layers, region.difference(middle), wanted, side("concentric"))
    errors = np.abs(pairs[:, 1] - pairs[:, 0])
    assert len(pairs) > 20
    assert np.quantile(errors, 0.75) < 0.005
    assert errors.max() < 0.055
    needs = np.array([wanted(nodes(region)).mean() * region.area * layer.height for layer in layers])
    assert np.abs(np.array([layer.filament for layer in layers]) * FILAMENT / needs - 1).max() < 0.01
    assert sum(map(crossing_paths, layers)) == 0
    assert spacing_of(layers) > 0.95
    plain = refill(sliced, pattern="concentric", density=(DENSE + SPARSE) / 2, dry_run=True).report
    assert graded["time"]["print_after_s"] < 1.05 * plain["time"]["print_after_s"]


@pytest.mark.longest
def test_rings_of_a_real_print_keep_their_distance(data: Path, tmp_path: Path) -> None:
    """Where nothing of the slicer's stays in a layer, in narrow places too."""
    source, out = data / "prints" / "p29_arcs_honeycomb_klipper.gcode", tmp_path / "new.gcode"
    refill(source, output=out, pattern="concentric", density=(DENSE, SPARSE), by="skin")
    stays = {(layer.z, path.round(2).tobytes()) for layer in read_sparse(source.read_text()) for path in layer.paths}
    layers = [
        layer
        for layer in read_sparse(out.read_text())
        if not any((layer.z, path.round(2).tobytes()) in stays for path in layer.paths)
    ]
    assert len(layers) > 30
    assert sum(map(crossing_paths, layers)) == 0
    assert spacing_of(layers) > 0.95


@pytest.mark.longest
@pytest.mark.parametrize("pattern", ["honeycomb", "grid", "gyroid"])
def test_lines_that_follow_a_field_obey_its_laws_as_arcs(tmp_path: Path, pattern: str) -> None:
    """As straight moves do, in fewer lines: gyroids, whose lines never touch, would allow fewer still."""
    texts, sliced = {}, tmp_path / "box.gcode"
    sliced.write_bytes(written(Dialect(size=60.0, cell=5.0, layers=4, arcs=True)))
    for arcs in ("on", "off"):
        refill(sliced, output=tmp_path / arcs, pattern=pattern, density=(DENSE, SPARSE), by="x", arcs=arcs)
        texts[arcs] = (tmp_path / arcs).read_text()
    assert judge(sliced.read_bytes(), texts["on"].encode(), filament=(0.0, 9.0)) == []
    layers = read_sparse(texts["on"])
    assert np.abs(density_errors(layers, pattern)).max() < 0.03
    wanted = along_x(layers)
    errors = filament_errors(layers, lambda points, _: wanted(points))
    assert np.abs(errors).max() < 0.01
    assert sum(map(crossing_paths, layers)) == 0
    assert spacing_of(layers) > 0.95
    most = 0.65 if pattern == "gyroid" else 0.5
    assert len(texts["on"].splitlines()) < most * len(texts["off"].splitlines())


@pytest.mark.slow
def test_the_laws_can_fail(sliced: Path, tmp_path: Path) -> None:
    """By lines of one density, by a line that is moved, and by more filament."""
    layers = written_by(sliced, tmp_path / "new.gcode", "rectilinear", None, density=(DENSE + SPARSE) / 2)
    assert np.abs(density_errors(layers, "rectilinear")).max() > 0.08
    wanted = along_x(layers)
    layers[0].pushed = [1.2 * pushed for pushed in layers[0].pushed]
    assert filament_errors(layers, lambda points, _: wanted(points))[0] > 0.1
    assert spacing_of(layers) > 0.95
    layers[0].paths += [layers[0].paths[0] + 0.3, np.array([[110.0, 110.0], [150.0, 130.0]])]
    assert spacing_of(layers) < 0.95
    assert crossing_paths(layers[0]) > 0


@pytest.mark.longest
@pytest.mark.parametrize("pattern", ["gyroid", "honeycomb"])
def test_two_equal_densities_are_one(sliced: Path, tmp_path: Path, pattern: str) -> None:
    """To the byte."""
    refill(sliced, output=tmp_path / "graded.gcode", pattern=pattern, density="26%:26%", by="x")
    refill(sliced, output=tmp_path / "plain.gcode", pattern=pattern, density=0.26)
    assert (tmp_path / "graded.gcode").read_bytes() == (tmp_path / "plain.gcode").read_bytes()


@pytest.mark.long
@pytest.mark.parametrize("pattern", ["gyroid", "honeycomb", "rectilinear"])
def test_a_density_that_hardly_changes_draws_the_lines_of_one_density(
    sliced: Path, tmp_path: Path, pattern: str
) -> None:
    graded = written_by(sliced, tmp_path / "graded.gcode", pattern, "x", density=(0.26, 0.2601))
    plain = written_by(sliced, tmp_path / "plain.gcode", pattern, None, density=0.26)
    for one, other in zip(graded, plain, strict=True):
        assert sum(map(len, one.paths)) < 1.5 * sum(map(len, other.paths))
    # Of a surface, a layer with more line than beads can be narrowed for owes it to the next, and the last one keeps it.
    total, plain_total = (sum(layer.filament for layer in layers) for layers in (graded, plain))
    assert total == pytest.approx(plain_total, rel=0.005)


@pytest.mark.longest
def test_a_density_that_changes_with_height_takes_the_filament_of_every_layer(tall: Path, tmp_path: Path) -> None:
    layers = written_by(tall, tmp_path / "new.gcode", "grid", "z", density=(0.3, 0.15))
    low, high = layers[0].z, layers[-1].z
    errors = filament_errors(layers, lambda points, z: np.full(len(points), np.interp(z, [low, high], [0.3, 0.15])))
    assert np.abs(errors).max() < 0.01
    assert sum(crossing_paths(layer) for layer in layers) == 0


@pytest.mark.longest
def test_by_the_roofs_it_is_dense_below_them(tall: Path, tmp_path: Path) -> None:
    """A box has one roof, so its density falls with the distance from it."""
    layers = written_by(tall, tmp_path / "new.gcode", "grid", "roofs", density=(0.3, 0.15))
    low, high = layers[0].z, layers[-1].z
    errors = filament_errors(layers, lambda points, z: np.full(len(points), np.interp(z, [low, high], [0.15, 0.3])))
    assert np.abs(errors).max() < 0.03  # depths are known to half a layer
    assert abs(errors.mean()) < 0.01


@pytest.mark.longest
def test_by_the_skin_it_is_dense_at_walls_roofs_and_floors(tall: Path, tmp_path: Path) -> None:
    layers = written_by(tall, tmp_path / "new.gcode", "grid", "skin", density=(DENSE, SPARSE))
    errors = filament_errors(layers, by_skin(layers))
    assert np.abs(errors).max() < 0.03  # depths are known to 0.2 mm, which is a hundredth of density
    assert abs(errors.mean()) < 0.015


@pytest.mark.long
@pytest.mark.parametrize("pattern", ["honeycomb", "grid"])
@pytest.mark.parametrize(("by", "tolerance"), [("z", 0.01), ("skin", 0.06)])  # depths are known to a tenth here
def test_where_a_density_changes_faster_than_layers_can_lines_lie_on_lines(
    thin: Path, tmp_path: Path, pattern: str, by: str, tolerance: float
) -> None:
    """Of five layers, neighbours have different densities. All of them get the mean, with the filament of the field."""
    layers = written_by(thin, tmp_path / "new.gcode", pattern, by)
    assert len(layers) == 5
    low, high = layers[0].z, layers[-1].z
    along_z = partial(np.interp, xp=[low, high], fp=[DENSE, SPARSE])
    wanted = by_skin(layers) if by == "skin" else lambda points, z: np.full(len(points), along_z(z))
    region = area(layers)
    needs = [wanted(nodes(region), layer.z).mean() for layer in layers]
    assert max(needs) > 1.5 * min(needs)  # else, lines would lie on lines anyway
    assert supported((tmp_path / "new.gcode").read_bytes()) > 0.98
    errors = filament_errors(layers, lambda points, z: np.full(len(points), np.mean(needs)))
    assert abs(errors.mean()) < tolerance
    pairs = local_densities(
        layers, region, lambda points: np.mean([wanted(points, layer.z) for layer in layers], axis=0), side(pattern)
    )
    assert len(pairs) > 20
    assert np.abs(pairs[:, 1] - pairs[:, 0]).max() < 0.03


@pytest.mark.slow
def test_a_density_that_cannot_change_is_told(thin: Path) -> None:
    def told(path: Path, by: str) -> list[str]:
        problems = refill(path, pattern="grid", density=(DENSE, SPARSE), by=by, dry_run=True).report["problems"]
        return [problem for problem in problems if "so thin" in problem]

    (problem,) = told(thin, "z")
    assert problem.startswith("the density is 26% everywhere: ")
    assert told(thin, "x") == []


# --- the field -------------------------------------------------------------------------------------------


def table(path: Path) -> Path:
    rows = [f"{x},{y},{z},{x}" for x in (0, 250) for y in (0, 210) for z in (0, 5)]
    path.write_text("x,y,z,value\n" + "\n".join(rows))
    return path


def picture(path: Path) -> Path:
    Image.fromarray(np.tile(np.arange(256, dtype=np.uint8), (32, 1))).save(path)
    return path


def code(path: Path) -> str:
    path.write_text("def place(points):\n    return points[:, 0]\n")
    return f"{path}:place"


def array(path: Path) -> Path:
    np.save(path, np.arange(64.0)[:, None, None])
    return path


@pytest.mark.long
@pytest.mark.parametrize("make", [table, picture, code, array])
def test_every_kind_of_field_says_the_same(sliced: Path, tmp_path: Path, make: Callable[[Path], object]) -> None:
    suffix = {"table": ".csv", "picture": ".png", "code": ".py", "array": ".npy"}[make.__name__]
    layers = written_by(sliced, tmp_path / "new.gcode", "honeycomb", make(tmp_path / f"field{suffix}"))
    wanted = along_x(layers)
    pairs = local_densities(layers[:1], area(layers), wanted, side("honeycomb"))
    assert np.abs(pairs[:, 1] - pairs[:, 0]).max() < 0.03


@pytest.mark.slow
def test_the_report_says_what_the_density_follows(sliced: Path) -> None:
    report = refill(sliced, pattern="grid", density="30%:15%", by="y", dry_run=True).report
    assert report["request"]["densities"] == [0.3, 0.15]
    assert report["request"]["by"] == "y"
    assert report["request"]["density"] is None


def test_densities_and_their_field_belong_together() -> None:
    for options, message in (
        (
            {"density": "40%:12%"},
            "density is 40%:12%, and a density that changes follows a field: give it too, such as --by x",
        ),
        ({"density": "40%", "by": "x"}, "by is given without two densities; give these too, such as 40%:12%"),
        ({"by": "x"}, "by is given without two densities"),
        ({"density": "5%:20%:9%", "by": "x"}, "density has 3 numbers; give one, or two such as 40%:12%"),
        ({"density": "5%:70%", "by": "x"}, "density is 70% somewhere; where it changes, give 1% to 60%"),
        ({"density": "0.5%:20%", "by": "x"}, "density is 0.5% somewhere"),
        ({"density": "5%:20%", "by": "w"}, "by is 'w'; give x, y, z, skin, roofs, a .csv"),
        ({"density": "5%:20%", "by": "nothing.csv"}, "there is no file nothing.csv"),
        ({"density": "5%:20%", "by": "x", "cell": 3}, "leave one out"),
        ({"density": "5%:20%", "by": "x", "even": "volume"}, "even and by are both given"),
    ):
        with pytest.raises(InfillError, match=message):
            refill([], pattern="grid", **options)  # type: ignore[arg-type]
    with pytest.raises(UsageError, match="density only works with"):
        refill([], density="40%:12%", by="x")  # type: ignore[arg-type]
    with pytest.raises(UsageError, match="cells of octagons cannot; choose from .*gyroid"):
        refill([], pattern="octagons", density="40%:12%", by="x")  # type: ignore[arg-type]


@pytest.mark.slow
def test_a_field_that_says_nothing_about_the_print_is_refused(sliced: Path, tmp_path: Path) -> None:
    beside = tmp_path / "beside.csv"
    beside.write_text("0,0,0,1\n-10,-10,10,2\n0,-10,0,3\n")
    half = tmp_path / "half.csv"  # of the bed, up to the middle of the box
    half.write_text("0,0,0,1\n130,0,0,2\n0,210,0,3\n130,210,0,3\n")
    for by, message in (
        (half, r"points lie at x 0 to 130, .*the infill at x 101 to 159, .*give points all over it"),
        (beside, r"points lie at x -10 to 0, .*the infill at x .*; give points all over it, x, y and z on the bed"),
        (lambda points: np.full(len(points), 3.0), "which is 3 everywhere in the infill; give one density"),
        (lambda points: points[:, 0] * math.nan, "which is not finite everywhere in the infill; it lies at x "),
    ):
        with pytest.raises(GeometryError, match=message):
            refill(sliced, output=tmp_path / "no.gcode", pattern="grid", density=(0.1, 0.3), by=by)
    assert not (tmp_path / "no.gcode").exists()


@pytest.mark.slow
def test_the_command_takes_two_densities_and_a_field(sliced: Path, tmp_path: Path) -> None:
    out = tmp_path / "new.gcode"
    assert run("refill", sliced, "--pattern", "grid", "--density", "30%:15%", "--by", "x", "-o", out).exit_code == 0
    again = run("refill", out, "--pattern", "grid", "--density", "30%:15%", "--by", "x")
    assert "nothing to do" in again.stderr
    usage_error(run("refill", sliced, "--pattern", "grid", "--density", "30%:15%"), "--density is 30%:15%")
    one_line_error(run("refill", sliced, "--pattern", "grid", "--density", "30%:90%", "--by", "x"), "give 1% to 60%")


# --- the map ---------------------------------------------------------------------------------------------


@given(scale=st.floats(0.2, 5), shape=st.tuples(st.integers(4, 12), st.integers(4, 12)))
@settings(max_examples=20, deadline=None)
def test_one_scale_everywhere_is_a_scale(scale: float, shape: tuple[int, int]) -> None:
    coordinates, more = fit_plane_map(np.full(shape, scale))
    grid = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1).reshape(-1, 2).astype(float)
    middle = (np.array(shape) - 1) / 2
    np.testing.assert_allclose(map_points(coordinates, grid), middle + scale * (grid - middle), atol=1e-9)
    np.testing.assert_allclose(more, scale, rtol=1e-9)


@given(data=st.data())
@settings(max_examples=20, deadline=None)
def test_no_cell_of_the_plane_folds_over(data: st.DataObject) -> None:
    """However wild the field."""
    shape = data.draw(st.tuples(st.integers(4, 20), st.integers(4, 20)))
    random = np.random.default_rng(data.draw(st.integers(0, 1000)))
    coordinates, more = fit_plane_map(np.exp(random.uniform(-1.2, 1.2, shape)))
    assert np.linalg.det(spline_jacobians(coordinates)).min() > 0
    assert np.isfinite(more).all()


@given(size=st.tuples(st.floats(0.3, 300), st.floats(0.3, 300)), cell=st.floats(0.5, 20))
@example(size=(1.7, 1.7), cell=2.0)
def test_a_map_has_as_many_nodes_for_a_pin_as_for_a_plate(size: tuple[float, float], cell: float) -> None:
    """64 nodes along the infill and 48 on either side of it, at most, which reach 3 cells beyond it."""
    low, high = np.array([10.0, 20.0]), np.array([10.0, 20.0]) + size
    axes, step, padding = map_axes(low, high, cell)
    for axis, first, last in zip(axes, low, high, strict=True):
        assert axis[0] <= first - 3 * cell + 1e-9
        assert axis[-1] >= last + 3 * cell - 1e-9
        assert len(axis) <= 64 + 2 * 48 + 3
        np.testing.assert_allclose(np.diff(axis), step, rtol=1e-6)
    assert step <= max(max(size) / 64, cell / 16) + 1e-12
    assert padding >= max(size) / 4 - 1e-9


def linear_map(first: float, last: float) -> PlaneMap:
    """Return the map of a density that changes along x from 0 to 60 mm."""
    corner = np.array([-15.0, -15.0])
    x = corner[0] + np.arange(91.0)
    scales = np.broadcast_to(np.interp(x, [0, 60], [first, last])[:, None], (91, 91))
    coordinates, more = fit_plane_map(scales)
    np.testing.assert_allclose(more[15:76, 15:76], scales[15:76, 15:76], rtol=0.01)
    forward = PlaneSpline(corner=corner, step=1.0, coefficients=corner + coordinates)
    return invert_map(forward, spline_jacobians(coordinates), pattern_bounds(forward, (0, 0, 60, 60)), 15.0)


def test_cells_of_a_density_that_changes_along_a_line_stay_round() -> None:
    slopes = linear_map(1.5, 0.45).slopes[15:76, 15:76]
    lengths = np.linalg.svd(slopes, compute_uv=False)
    assert (lengths[..., 0] / lengths[..., 1]).max() < 1.6
    assert wall_density_factor(np.eye(2)) == pytest.approx(1.0)


def test_the_inverse_of_the_map_is_its_inverse() -> None:
    plane_map = linear_map(1.5, 0.45)
    points = np.random.default_rng(0).uniform(2, 58, (500, 2))
    there = plane_map.forward.at(points)
    assert np.hypot(*(plane_map.inverse.at(there) - points).T).max() < 0.03


@pytest.mark.parametrize("name", STRETCHING)
def test_nominal_strands_are_the_strands_with_touching_beads_on_one_another(name: str) -> None:
    family, bounds = FAMILIES[name], (0.0, 0.0, 20.0, 20.0)
    spec = PathSpec(cell=4.0, line_width=WIDTH, z=1.3, layer=3, radius=1.0)
    moved = [strand.offset(spec.gap / 2) for strand in family.nominal_strands(bounds, spec)]
    for one, other in zip(moved, family.strands(bounds, spec), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-9)


@pytest.mark.parametrize("name", STRETCHING)
def test_a_map_that_stretches_nothing_changes_no_line(name: str) -> None:
    """By more than beads that touch are moved apart, of which one may stay in its place."""
    family = stretch_family(FAMILIES[name], linear_map(1.0, 1.0), 1.0)
    spec = PathSpec(cell=4.0, line_width=WIDTH, z=1.3, layer=3, radius=1.0)
    region, around = shapely.box(10, 10, 50, 50), shapely.box(8, 8, 52, 52)
    apart = 1.02 * (STRETCHED_TOUCH - TOUCH) * WIDTH
    if FAMILIES[name].touches:  # others keep more distance at saddles
        one, other = (
            shapely.MultiLineString(each.strands((10.0, 10.0, 50.0, 50.0), spec)) for each in (family, FAMILIES[name])
        )
        for inner, outer in ((one, other), (other, one)):
            assert shapely.buffer(outer.intersection(around), apart).covers(inner.intersection(region))


@pytest.mark.long
@pytest.mark.parametrize("name", STRETCHING)
def test_stretched_lines_never_cross(name: str) -> None:
    family = stretch_family(FAMILIES[name], linear_map(1.5, 0.45), 0.45)
    cell = family.cell_for(0.26, WIDTH)
    for layer in range(4):
        spec = PathSpec(cell=cell, line_width=WIDTH, z=0.9 * layer, layer=layer, radius=0.3 * cell)
        paths = family.strands((5.0, 5.0, 55.0, 55.0), spec)
        assert shapely.MultiLineString(paths).is_simple
        nearest = least_spacing(paths, near=4 * WIDTH, most=0.6, within=shapely.box(5, 5, 55, 55))
        assert nearest > 0.95 * WIDTH


def test_the_judge_sees_crossings_and_densities() -> None:
    lines = [np.array([[0.0, float(y)], [10.0, float(y)]]) for y in range(11)]
    pushed = [np.array([10 * SPACING * 0.2 / FILAMENT]) for _ in lines]
    layer = SparseLayer(z=0.2, height=0.2, paths=lines, pushed=pushed)
    pairs = local_densities([layer], shapely.box(0, 0, 10, 10), lambda points: np.full(len(points), 0.5), lambda _: 4.0)
    np.testing.assert_allclose(pairs[:, 1], SPACING, rtol=0.05)
    assert crossing_paths(layer) == 0
    layer.paths.append(np.array([[1.0, 0.5], [1.0, 3.5]]))
    assert crossing_paths(layer) == 3
