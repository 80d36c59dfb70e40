"""Volumes in chunks by every method: the method that memory would choose first, with its surface, to the last bit."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import zarr
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter
from test_command_line import refused, run

from infill import InfillError, ParameterError, Smoothing, Volume, smooth_volume
from infill.chunks.hashing import hash_surface
from infill.chunks.layout import ChunkLayout
from infill.chunks.running import Runner
from infill.chunks.solids import GreyScale, SolidRule
from infill.chunks.surveys import measure_noise, measure_window
from infill.chunks.tasks import smooth
from infill.chunks.work import Work, open_field
from infill.kernels.sparse import BRICK
from infill.lazy.volume import LazyVolume
from infill.phasefield.refining import refine_bricks
from infill.smoothing.attempt import run_attempt
from infill.smoothing.chunked import smooth_in_chunks
from infill.smoothing.chunked_surface import ChunkedSurface
from infill.smoothing.request import SmoothRequest
from infill.smoothing.scans import Threshold, volume_ways
from infill.voxels.exact_sums import exact_sum, sums_by_side
from infill.voxels.noise import noise_share
from infill.voxels.segmentation import EdgeSums, edge_window

pytestmark = pytest.mark.usefixtures("compiled", "silent_compiler")


@dataclass(frozen=True)
class Arranged:
    """An array in memory as a source of chunks."""

    array: NDArray[Any]

    @property
    def shape(self) -> tuple[int, ...]:
        return self.array.shape

    @property
    def dtype(self) -> np.dtype[Any]:
        return self.array.dtype

    def read(self, box: tuple[slice, ...]) -> NDArray[Any]:
        return self.array[box]


@dataclass(frozen=True, kw_only=True)
class Case:
    """A volume, how it is smoothed, and how it is divided."""

    seed: int
    shape: tuple[int, int, int]
    kind: str = "u1"
    blur: float = 1.5
    share: float = 0.5
    whole: bool = True  # thresholds and values are whole numbers
    method: Any = "auto"
    steps: int = 5
    level: Any = "volume"
    grey: bool | None = None
    specks: int = 0  # cells
    spacing: tuple[float, float, float] = (0.5, 0.5, 0.5)
    side: int = 16

    @property
    def brightness(self) -> NDArray[np.float64]:
        noise = gaussian_filter(np.random.default_rng(self.seed).normal(size=self.shape), self.blur)
        scaled = 255 * (noise - noise.min()) / np.ptp(noise)
        return np.round(scaled) if self.whole else scaled

    @property
    def threshold(self) -> Threshold:
        low = float(np.quantile(self.brightness, self.share))
        return None if self.is_mask or self.kind == "phase" else math.floor(low) + (0 if self.whole else 0.25)

    @property
    def is_mask(self) -> bool:
        return self.kind in ("mask", "noise")

    @property
    def values(self) -> NDArray[Any]:
        values = self.brightness
        low = np.quantile(values, self.share)
        if self.kind == "phase":
            return np.tanh((values - low) / 20).astype(np.float32)
        if self.is_mask:
            flips = np.random.default_rng(self.seed + 1).random(self.shape) < 0.08
            return (values >= low) ^ (flips if self.kind == "noise" else False)
        return values.astype(self.kind)

    @property
    def request(self) -> SmoothRequest:
        cell = math.prod(self.spacing)
        return SmoothRequest(
            method=self.method,
            smoothing=Smoothing(steps=self.steps),
            level=self.level,
            despeckle=self.specks * cell,
            tolerance=None,
            threads=1,
            allow_broken=True,
            strict=True,  # no other way is tried
        )


@contextmanager
def chunked(case: Case) -> Iterator[ChunkedSurface]:
    volume = LazyVolume(array=Arranged(case.values), spacing=case.spacing)
    with smooth_in_chunks(
        volume, case.request, threshold=case.threshold, grey=case.grey, side=case.side, workers=1
    ) as surface:
        yield surface


def check_case(case: Case) -> None:
    """Compare with the first way that memory takes: surface, counts, targets and levels, or the same error."""
    scan = Volume(values=case.values, spacing=case.spacing)
    failed: InfillError | None = None
    try:
        way = volume_ways(scan, case.request, threshold=case.threshold, grey=case.grey)[0]
        attempt = run_attempt(way.data, way.request)  # type: ignore[arg-type]
    except InfillError as error:
        failed = error
    if failed is not None:
        with pytest.raises(type(failed)) as caught, chunked(case):
            pass
        assert str(caught.value)[:25] == str(failed)[:25]
        return
    with chunked(case) as surface:
        found, report = surface.whole(), surface.report()
    expected, surfaced = attempt.surface, attempt.surfaced
    assert report["request"]["method"] == way.request.method
    assert report["request"]["despeckle"] == way.request.despeckle
    facts = asdict(way.data)["facts"]
    assert report["input"]["segmentation"] == facts["segmentation"]
    assert report["input"]["grey"] == facts["grey"]
    assert report["input"]["noise"] in (None, facts["noise"])
    assert surface.specks == attempt.specks
    assert report["hash"] == hash_surface(expected.vertices, expected.faces)
    assert hash_surface(found.vertices, found.faces) == report["hash"]
    assert report["closed"]
    assert report["verdict"]["crumbs"]["removed"] == attempt.crumbs.count
    assert report["solid"]["data"] == pytest.approx(float(surfaced.targets.sum()), rel=1e-9)
    assert report["volume"] == pytest.approx(surfaced.volume, rel=1e-9)
    assert report["solid"]["level"]["common"] == pytest.approx(surfaced.common, rel=1e-9, abs=1e-12)
    assert report["solid"]["level"]["lowest"] == pytest.approx(float(surfaced.levels.min()), rel=1e-9, abs=1e-12)
    shells = surfaced.levelled.shells
    counts = {"components": shells.components, "cavities": shells.cavities, "tunnels": shells.tunnels}
    assert report["topology"]["result"] == {**counts, "euler_number": int(shells.euler.sum())}
    assert report["topology"]["data"]["euler_number"] == attempt.topology.data.euler_number


@st.composite
def cases(draw: st.DrawFn, largest: int = 30) -> Case:
    kind = draw(st.sampled_from(["u1", "u2", "f4", "f8", "mask", "noise", "phase"]))
    method = draw(st.sampled_from(["auto", "auto", "refine", "plain", "grey"]))
    is_mask = kind in ("mask", "noise")
    return Case(
        seed=draw(st.integers(0, 2**31)),
        shape=tuple(draw(st.integers(10, largest)) for _ in range(3)),
        kind=kind,
        blur=draw(st.sampled_from([0.7, 1.5, 3.0])),
        share=draw(st.floats(0.3, 0.7)),
        whole=kind in ("u1", "u2") or draw(st.booleans()),
        method="refine" if is_mask and method == "grey" else method,
        steps=draw(st.sampled_from([4, 5, 7, 10])),
        level=draw(st.sampled_from(["volume", "volume", 0.1])),
        grey=None if is_mask or method == "grey" else draw(st.sampled_from([None, None, True, False])),
        specks=draw(st.sampled_from([0, 0, 5, 20])),
        spacing=tuple(draw(st.sampled_from([0.3, 0.41, 0.5])) for _ in range(3)),
        side=draw(st.sampled_from([16, 32, 100])),
    )


GREY = Case(seed=1, shape=(23, 30, 31), kind="u1")  # in chunks of one brick along z, and two along the others
REFINED = Case(seed=2, shape=(40, 15, 47), kind="mask", steps=4, spacing=(0.3, 0.5, 0.41))
NOISE = Case(seed=5, shape=(33, 40, 37), kind="noise", blur=3.0, steps=7, side=32)
FLOATS = Case(seed=4, shape=(31, 22, 25), kind="f4", whole=False, share=0.6, level=0.1, method="grey")
PHASE = Case(seed=6, shape=(25, 17, 33), kind="phase")


@settings(max_examples=2)
@example(case=GREY)
@example(case=REFINED)
@example(case=NOISE)
@example(case=FLOATS)
@example(case=PHASE)
@given(case=cases())
def test_chunks_give_what_memory_gives_first(case: Case) -> None:
    check_case(case)


@pytest.mark.longest
@settings(max_examples=150)
@given(case=cases(largest=60))
def test_many_chunks_give_what_memory_gives_first(case: Case) -> None:
    check_case(case)


def test_the_cases_take_every_method() -> None:
    taken = []
    for case in (GREY, REFINED, NOISE, PHASE):
        with chunked(case) as surface:
            taken.append((surface.request.method, surface.specks > 0, surface.grey))
    assert taken == [("grey", False, True), ("refine", False, False), ("plain", True, False), ("refine", False, False)]


# --- the field -------------------------------------------------------------------------------------------


def check_fields(data: NDArray[np.bool_], steps: int, size: tuple[int, int, int]) -> None:
    """Compare the refined fields of all chunks with that of the whole, bit for bit."""
    whole = refine_bricks(data, Smoothing(steps=steps), threads=1).to_dense()
    layout = ChunkLayout(shape=data.shape, size=size, steps=steps, refined=True)  # type: ignore[arg-type]
    work = Work(
        source=Arranged(data),
        rule=SolidRule(),
        layout=layout,
        smoothing=Smoothing(steps=steps),
        spacing=(1.0, 1.0, 1.0),
        level=None,
        refined=True,
    )
    for chunk in layout:
        if not chunk.has_cells or smooth(work, chunk).start is None:
            continue
        first = np.maximum(np.array(chunk.low) * BRICK - 1, 0) - np.array(chunk.kept_low) * BRICK
        low = np.array(chunk.cell_low) + [part.start for part in chunk.own_cells]
        # And one layer more, which the last cubes of the chunk take.
        sizes = np.minimum([part.stop - part.start + 1 for part in chunk.own_cells], np.array(data.shape) - low)
        own = open_field(work, chunk).field.to_dense(threads=1)
        box = tuple(slice(a, a + n) for a, n in zip(first, sizes, strict=True))
        np.testing.assert_array_equal(own[box], whole[tuple(slice(a, a + n) for a, n in zip(low, sizes, strict=True))])


@pytest.mark.longest
@pytest.mark.parametrize("blur", [0.0, 2.0])
@pytest.mark.parametrize(("steps", "size"), [(4, (1, 1, 1)), (7, (2, 1, 1))])
def test_refined_fields_are_those_of_the_whole(blur: float, steps: int, size: tuple[int, int, int]) -> None:
    values = np.random.default_rng(steps).normal(size=(45, 42, 52))
    check_fields((gaussian_filter(values, blur) if blur else values) > 0, steps, size)


@pytest.mark.parametrize(("axis", "seeds"), [(0, (8, 110, 152)), (2, (3,))])
def test_a_refined_margin_one_brick_narrower_is_not_enough(
    axis: int, seeds: tuple[int, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """What comes from afar is weak by then: along the first axes, one volume in twenty shows it, in single cells."""
    cases = []
    for seed in seeds:
        rng = np.random.default_rng(seed)
        values = rng.normal(size=(96, 17, 17))
        cases.append(np.moveaxis(gaussian_filter(values, rng.choice([0.7, 1, 1.5, 2.5])) > 0, 0, axis).copy())
    size = ((1, 3, 3), (3, 1, 3), (3, 3, 1))[axis]
    check_fields(cases[0], 4, size)
    margin = ChunkLayout(shape=cases[0].shape, size=size, steps=4, refined=True).margin  # type: ignore[arg-type]
    narrow = tuple(bricks - (n == axis) for n, bricks in enumerate(margin))
    monkeypatch.setattr(ChunkLayout, "margin", property(lambda self: narrow))
    with pytest.raises(AssertionError):
        for data in cases:
            check_fields(data, 4, size)


# --- what is global --------------------------------------------------------------------------------------


def work_of(values: NDArray[Any], size: tuple[int, int, int], rule: SolidRule) -> Work:
    layout = ChunkLayout(shape=values.shape, size=size, steps=3)  # type: ignore[arg-type]
    return Work(
        source=Arranged(values),
        rule=rule,
        layout=layout,
        smoothing=Smoothing(steps=3),
        spacing=(1.0, 1.0, 1.0),
        level=None,
    )


@pytest.mark.parametrize("shape", [(3, 40, 21), (37, 19, 50), (90, 33, 34)])
@pytest.mark.parametrize("size", [(1, 1, 1), (2, 3, 2), (20, 20, 20)])
def test_noise_is_that_of_the_whole(shape: tuple[int, int, int], size: tuple[int, int, int]) -> None:
    values = gaussian_filter(np.random.default_rng(0).normal(size=shape), 2.0)
    solid = (values > 0) ^ (np.random.default_rng(1).random(shape) < 0.05)
    noise = measure_noise(work_of(solid, size, SolidRule()), Runner(workers=1), lambda _: None)
    assert noise == noise_share(solid) > 0


@pytest.mark.parametrize("kind", ["u1", "i2", "u4", "f4", "f8", "i8"])
@pytest.mark.parametrize("size", [(1, 1, 1), (2, 3, 1), (9, 9, 9)])
def test_the_window_of_grey_values_is_that_of_the_whole(kind: str, size: tuple[int, int, int]) -> None:
    values = (gaussian_filter(np.random.default_rng(2).normal(size=(21, 30, 19)), 1.0) * 1000 + 500).astype(kind)
    level = float(np.median(values)) + 0.5
    window = measure_window(work_of(values, size, SolidRule()), Runner(workers=1), level, lambda _: None)
    assert window == edge_window(Volume(values=values), level)
    above = values > level
    # The NumPy form, whose sums are rounded; 10,000 numbers of 16 digits.
    step = values[above].mean(dtype=np.float64) - values[~above].mean(dtype=np.float64)
    assert window <= step * (1 + 1e-12)
    assert EdgeSums.of(values, level).cells == (int((~above).sum()), int(above.sum()))


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), max_size=30), st.randoms())
def test_exact_sums_are_exact(numbers: list[float], order: Any) -> None:
    expected = sum((Fraction(number) for number in numbers), Fraction(0))
    order.shuffle(numbers)
    assert exact_sum(np.array(numbers, dtype=np.float64)) == expected
    side = np.arange(len(numbers)) % 2 == 0
    assert sum(sums_by_side(np.array(numbers, dtype=np.float64), side)) == expected


def test_a_grey_scale_is_that_of_memory() -> None:
    values = np.array([0, 25, 100], dtype=np.uint8)
    assert GreyScale(level=50, window=100).scale(values).tolist() == [-1, -0.5, 1]
    assert GreyScale().scale(np.array([-0.5, 0.25])).tolist() == [-0.5, 0.25]


# --- specks ----------------------------------------------------------------------------------------------


def with_specks(cells: int) -> NDArray[np.bool_]:
    """Return a block, and rods of some cells and of one more, along all axes and across the borders of chunks."""
    solid = np.zeros((70, 70, 70), dtype=bool)
    solid[20:60, 20:60, 20:60] = True
    for n, length in enumerate((cells, cells, cells + 1)):
        solid[10 : 10 + length, 3 + 4 * n, 3] = True
        solid[3, 12 : 12 + length, 5 + 4 * n] = True
        solid[3 + 4 * n, 5, 12 : 12 + length] = True
    return solid


@pytest.mark.parametrize("cells", [1, 27])
def test_specks_are_taken_out_once(cells: int) -> None:
    solid = with_specks(cells)
    request = SmoothRequest(
        method="plain", despeckle=cells, smoothing=Smoothing(steps=1), crumbs=0, allow_broken=True, tolerance=None
    )
    volume = LazyVolume(array=Arranged(solid))
    way = volume_ways(Volume(values=solid), replace(request, tolerance=None))[0]
    attempt = run_attempt(way.data, way.request)  # type: ignore[arg-type]
    with smooth_in_chunks(volume, request, side=32) as surface:
        report = surface.report()
    assert surface.specks == attempt.specks == 6
    assert f"6 specks of up to {cells} mm³ taken out beforehand" in report["verdict"]["changes"]
    assert report["hash"] == hash_surface(attempt.surface.vertices, attempt.surface.faces)


def test_specks_alone_and_specks_too_large_are_refused() -> None:
    solid = np.zeros((40, 40, 40), dtype=bool)
    solid[3:6, 3:6, 3:6] = solid[30:32, 30:32, 30:32] = True
    volume = LazyVolume(array=Arranged(solid), spacing=(2.0, 2.0, 2.0))
    for despeckle, says in (
        (27 * 8, "despeckle is 216 mm³ and the largest component has 216 mm³; give less"),
        (1025, "takes out specks of up to 128 voxels; give at most 1024"),
    ):
        request = SmoothRequest(method="plain", despeckle=despeckle, allow_broken=True)
        with pytest.raises(ParameterError, match=says), smooth_in_chunks(volume, request, side=16):
            pass
    request = SmoothRequest(method="plain", despeckle=1024, allow_broken=True)
    with pytest.raises(ParameterError, match="the largest component has"), smooth_in_chunks(volume, request):
        pass


# --- the product -----------------------------------------------------------------------------------------


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    x, y, z = np.indices((40, 44, 48), dtype=np.float32) * np.float32(2 * np.pi / 30)
    level = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
    values = np.clip(128 + 80 * level, 0, 255).astype(np.uint8)
    zarr.create_array("g.zarr", shape=values.shape, chunks=(32, 32, 32), dtype="u1")[:] = values
    np.save("g.npy", values)
    return tmp_path


THRESHOLD = ("--threshold", "120", "--steps", "5", "--tolerance", "0")


@pytest.mark.parametrize("method", [(), ("--smooth", "refine"), ("--no-grey",), ("--smooth", "grey", "--level", "0")])
def test_the_command_takes_every_method(method: tuple[str, ...], folder: Path) -> None:
    done = run(
        "smooth",
        "g.npy",
        *THRESHOLD,
        *method,
        "--workers",
        "2",
        "--strict",
        "--allow-broken",
        "--json",
        "-q",
        "-o",
        "a.ply",
    )
    assert done.exit_code == 0, done.output
    report = json.loads(done.stdout)
    whole = run(
        "smooth",
        "g.npy",
        *THRESHOLD,
        *method,
        "--strict",
        "--allow-broken",
        "--hash",
        "--json",
        "-q",
    )
    expected = json.loads(whole.stdout)
    assert report["product"] == "chunks"
    assert report["hash"] == expected["hash"]
    assert report["request"] == expected["request"]
    assert Path("a.ply").is_file()


@pytest.mark.longest
def test_a_zarr_is_smoothed_in_chunks_once_memory_does_not_suffice(folder: Path) -> None:
    in_memory = json.loads(run("smooth", "g.zarr", *THRESHOLD, "--json", "-q").stdout)
    assert in_memory["product"] == "smooth"
    for limit in ("1M", "300k"):  # of the surface, which is known when the voxels were read; and of the voxels
        words = ("smooth", "g.zarr", *THRESHOLD, "--max-memory", limit)
        done = run(*words, "--json", "-q")
        assert done.exit_code == 0, done.output
        report = json.loads(done.stdout)
        assert report["product"] == "chunks"
        assert report["request"]["method"] == in_memory["request"]["method"] == "grey"
        plan = run(*words, "--dry-run", "-o", "a.ply")
        assert "chunks" in plan.stdout, plan.output
    refused(
        run("smooth", "g.zarr", *THRESHOLD, "--max-memory", "300k", "-o", "a.ply", "--voxel", "1.5"), "GiB is allowed"
    )
    result = smooth_volume("g.zarr", threshold=120, smoothing=Smoothing(steps=5), max_memory=10**6)
    assert result.report["product"] == "chunks"


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("--despeckle", "129"), "specks of up to 128 voxels; give at most 128"),
        (("--refine", "--steps", "3"), "takes at least 4"),
        (("--smooth", "grey", "--no-grey"), "is left out, and"),
    ],
)
def test_what_chunks_refuse_of_methods(words: tuple[str, ...], says: str, folder: Path) -> None:
    before = set(folder.iterdir())
    refused(run("smooth", "g.zarr", "--threshold", "120", *words, "--workers", "1", "-o", "a.ply"), says)
    assert set(folder.iterdir()) == before
