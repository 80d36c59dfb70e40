"""The scheme, its laws, and one contract for every kernel."""

from __future__ import annotations

import math
import os
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import ndimage
from shapes import smooth_noise

from infill import ParameterError, Smoothing, rescale, smooth
from infill.phasefield.allen_cahn import laplacian
from infill.phasefield.dense import split_one
from infill.phasefield.methods import KERNELS

FAST = 2e-5  # what float32 may lose over 30 steps
EXACT = 1e-10

every_kernel = pytest.mark.parametrize("method", list(KERNELS))
shapes = st.one_of(
    st.tuples(st.integers(1, 40)),
    st.tuples(st.integers(1, 14), st.integers(1, 14)),
    st.tuples(st.integers(1, 7), st.integers(1, 7), st.integers(1, 7)),
)


def textbook(
    f: np.ndarray,
    smoothing: Smoothing,
    spacing: tuple[float, ...],
    initial: np.ndarray | None = None,
    mask: np.ndarray | None = None,
) -> np.ndarray:
    """The scheme of the paper written down a second time, cell by cell, in units of length (2, 7, 8, 10)."""
    h = min(spacing)
    dt = smoothing.alpha * h**2
    lam = smoothing.fidelity / h**2
    eps = smoothing.interface * h / (math.sqrt(2) * math.atanh(0.9))
    decay = math.exp(-2 * dt / eps**2)
    phi = (f if initial is None else initial).astype(float)
    inside = np.ones(f.shape, dtype=bool) if mask is None else mask
    for _ in range(smoothing.steps):
        diffused = phi.copy()
        for cell in np.ndindex(*f.shape):
            if not inside[cell]:
                continue
            for axis, size in enumerate(spacing):
                for shift in (-1, 1):
                    other = tuple(c + shift * (a == axis) for a, c in enumerate(cell))
                    if 0 <= other[axis] < f.shape[axis] and inside[other]:
                        diffused[cell] += dt * (phi[other] - phi[cell]) / size**2
        reacted = diffused / np.sqrt(decay + diffused**2 * (1 - decay))
        held = (reacted + lam * dt * f) / (1 + lam * dt)
        phi = np.where(inside, held, phi)
    return phi


def cases() -> list[Any]:
    rng = np.random.default_rng(3)
    found = []
    for shape, spacing in [
        ((23,), (1.0,)),
        ((9, 12), (1.0, 1.0)),
        ((9, 12), (0.3, 0.75)),
        ((5, 6, 7), (1.0, 1.0, 1.0)),
        ((5, 6, 7), (0.5, 0.5, 1.25)),
    ]:
        for kind in ("binary", "grey"):
            for extra in ("", "mask", "initial", "mask+initial"):
                f = rng.uniform(-1, 1, shape)
                f = np.sign(f) if kind == "binary" else f
                options = {}
                if "mask" in extra:
                    options["mask"] = rng.random(shape) > 0.25
                if "initial" in extra:
                    options["initial"] = rng.uniform(-1, 1, shape)
                found.append(pytest.param(f, spacing, options, id=f"{len(shape)}D-{spacing}-{kind}-{extra or 'plain'}"))
    return found


@pytest.mark.slow
@pytest.mark.parametrize(("f", "spacing", "options"), cases())
def test_the_reference_is_the_scheme(f: np.ndarray, spacing: tuple[float, ...], options: dict[str, Any]) -> None:
    smoothing = Smoothing(steps=5, fidelity=0.3)
    expected = textbook(f, smoothing, spacing, **options)
    assert np.abs(smooth(f, smoothing, spacing=spacing, method="numpy", **options) - expected).max() < EXACT


def test_the_comparison_can_fail() -> None:
    f = np.random.default_rng(0).uniform(-1, 1, (6, 6))
    other = textbook(f, Smoothing(steps=5, fidelity=0.31), (1.0, 1.0))
    assert np.abs(smooth(f, Smoothing(steps=5, fidelity=0.3), method="numpy") - other).max() > 100 * FAST


fast_kernels = pytest.mark.parametrize("method", [method for method in KERNELS if method != "numpy"])


@pytest.mark.longest
@fast_kernels
@pytest.mark.parametrize(("f", "spacing", "options"), cases())
def test_fast_kernels_agree(method: str, f: np.ndarray, spacing: tuple[float, ...], options: dict[str, Any]) -> None:
    for smoothing in (Smoothing(steps=30, fidelity=0.05), Smoothing(steps=3, fidelity=2, interface=8, alpha=0.1)):
        reference = smooth(f, smoothing, spacing=spacing, method="numpy", **options)
        fast = smooth(f, smoothing, spacing=spacing, method=method, **options)
        assert fast.dtype == np.float32
        assert np.abs(fast - reference).max() < FAST


@pytest.mark.slow
@fast_kernels
@given(shape=shapes, seed=st.integers(0, 2**32 - 1), steps=st.integers(0, 30), fidelity=st.floats(0, 1))
def test_fast_kernels_agree_on_any_shape(
    method: str, shape: tuple[int, ...], seed: int, steps: int, fidelity: float
) -> None:
    f = np.random.default_rng(seed).uniform(-1, 1, shape)
    smoothing = Smoothing(steps=steps, fidelity=fidelity)
    assert np.abs(smooth(f, smoothing, method=method) - smooth(f, smoothing, method="numpy")).max() < FAST


@pytest.mark.longest
@given(
    shape=st.one_of(
        st.tuples(st.integers(1, 150)),
        st.tuples(st.integers(1, 60), st.integers(1, 60)),
        st.tuples(st.integers(1, 40), st.integers(1, 40), st.integers(1, 50)),
    ),
    seed=st.integers(0, 2**32 - 1),
    steps=st.integers(0, 40),
    fidelity=st.floats(0, 1),
    feature=st.floats(0.5, 6),
    spacing=st.tuples(*[st.floats(0.6, 1.5)] * 3),
    extra=st.sets(st.sampled_from(["mask", "initial", "int8"])),
)
def test_sparse_is_dense_to_the_last_bit(
    shape: tuple[int, ...], seed: int, steps: int, fidelity: float, feature: float, spacing: Any, extra: set[str]
) -> None:
    """Shapes that are no multiple of a brick, steps beyond a brick, surfaces at the edge, anisotropy, masks."""
    rng = np.random.default_rng(seed)
    f = np.where(ndimage.gaussian_filter(rng.standard_normal(shape), feature) > rng.uniform(-0.05, 0.05), 1.0, -1.0)
    options: dict[str, Any] = {"spacing": spacing[: len(shape)]}
    if "mask" in extra:
        options["mask"] = rng.random(shape) > 0.2
    if "initial" in extra:
        options["initial"] = np.where(rng.random(shape) > 0.9, -f, f)
    data = f.astype(np.int8) if "int8" in extra else f
    smoothing = Smoothing(steps=steps, fidelity=fidelity, alpha=0.1)
    dense, sparse = (smooth(data, smoothing, method=method, **options) for method in ("dense", "sparse"))
    assert np.array_equal(dense, sparse)


@pytest.mark.parametrize("method", ["dense", "sparse"])
def test_compiled_kernels_take_three_axes(method: str) -> None:
    with pytest.raises(ParameterError, match="up to 3 axes, not 4; choose inplace"):
        smooth(np.ones((2, 2, 2, 2)), method=method)


@given(decay=st.floats(1e-30, 1.0))
def test_the_parts_of_one_are_one(decay: float) -> None:
    """In 32 bits too: so that +1 and -1 are fixed points to the last bit."""
    one, other = split_one(decay)
    assert one + other == np.float32(1)
    assert one > 0
    assert one == pytest.approx(decay, abs=1e-7)


def test_far_from_the_surface_nothing_is_kept() -> None:
    """A half space of 200 cells: ten steps reach two bricks of eight on either side of the surface at most."""
    from infill.kernels.sparse import SOLID_BRICK, VOID_BRICK
    from infill.phasefield.sparse import smooth_bricks

    f = -np.ones((200, 14, 30), dtype=np.int8)
    f[100:] = 1
    slots = smooth_bricks(f, Smoothing(steps=10)).slots
    assert slots.shape == (26, 2, 2)
    assert (slots[:9] == VOID_BRICK).all()
    assert (slots[17:25] == SOLID_BRICK).all()
    assert (slots[12:13] >= 0).all()


def test_threads_do_not_change_the_result(monkeypatch: pytest.MonkeyPatch, rng: np.random.Generator) -> None:
    f = smooth_noise(rng, (90, 70))
    alone = smooth(f, Smoothing(steps=7), method="inplace")
    monkeypatch.setattr("infill.phasefield.inplace.CELLS_PER_BLOCK", 512)
    monkeypatch.setattr("infill.phasefield.inplace.thread_count", lambda _: 3)
    assert np.array_equal(smooth(f, Smoothing(steps=7), method="inplace"), alone)


def test_a_thread_that_fails_is_heard(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("infill.phasefield.inplace.CELLS_PER_BLOCK", 512)
    monkeypatch.setattr("infill.phasefield.inplace.thread_count", lambda _: 2)
    real = np.sqrt
    calls = []

    def failing(*args: Any, **options: Any) -> Any:
        calls.append(1)
        if len(calls) == 5:
            raise MemoryError
        return real(*args, **options)

    monkeypatch.setattr("infill.phasefield.inplace.np.sqrt", failing)
    with pytest.raises(MemoryError):
        smooth(np.ones((80, 80)), Smoothing(steps=50), method="inplace")


@every_kernel
@pytest.mark.parametrize("shape", [(30,), (12, 15), (6, 7, 8)])
class TestLaws:
    """What holds for the equation holds for every kernel."""

    def test_stays_between_void_and_solid(self, method: str, shape: tuple[int, ...], rng: np.random.Generator) -> None:
        for f in (rng.uniform(-1, 1, shape), np.sign(rng.uniform(-1, 1, shape))):
            assert np.abs(smooth(f, Smoothing(steps=20), method=method)).max() <= 1

    def test_what_comes_out_goes_in_again(self, method: str, shape: tuple[int, ...], rng: np.random.Generator) -> None:
        f = np.where(rng.random(shape) < 0.9, 1.0, -1.0)
        once = smooth(f, Smoothing(steps=3), method=method)
        assert smooth(once, method=method).shape == smooth(f, initial=once, method=method).shape == shape

    def test_is_odd(self, method: str, shape: tuple[int, ...], rng: np.random.Generator) -> None:
        f = rng.uniform(-1, 1, shape)
        assert np.array_equal(smooth(-f, method=method), -smooth(f, method=method))

    def test_commutes_with_mirrors(self, method: str, shape: tuple[int, ...], rng: np.random.Generator) -> None:
        f = rng.uniform(-1, 1, shape)
        for axis in range(len(shape)):
            assert np.allclose(
                smooth(np.flip(f, axis), method=method), np.flip(smooth(f, method=method), axis), atol=1e-6
            )

    def test_commutes_with_transposing(self, method: str, shape: tuple[int, ...], rng: np.random.Generator) -> None:
        f = rng.uniform(-1, 1, shape)
        assert np.allclose(smooth(f.T, method=method), smooth(f, method=method).T, atol=1e-6)

    @pytest.mark.slow
    @pytest.mark.parametrize("value", [-1.0, 0.0, 1.0])
    def test_pure_phases_are_fixed(self, method: str, shape: tuple[int, ...], value: float) -> None:
        assert np.abs(smooth(np.full(shape, value), Smoothing(steps=30), method=method) - value).max() < 1e-6

    def test_no_steps_change_nothing(self, method: str, shape: tuple[int, ...], rng: np.random.Generator) -> None:
        f = rng.uniform(-1, 1, shape).astype(np.float32)
        assert np.array_equal(smooth(f, Smoothing(steps=0), method=method), f)

    def test_the_unit_of_length_does_not_matter(
        self, method: str, shape: tuple[int, ...], rng: np.random.Generator
    ) -> None:
        f, spacing = rng.uniform(-1, 1, shape), (0.4, 0.5, 0.9)[: len(shape)]
        in_mm = smooth(f, spacing=spacing, method=method)
        for unit in (1 / 25.4, 1e-3, 1000.0):
            other = smooth(f, spacing=tuple(size * unit for size in spacing), method=method)
            assert np.abs(other - in_mm).max() < 1e-6

    @pytest.mark.long
    def test_the_input_is_left_alone(self, method: str, shape: tuple[int, ...], rng: np.random.Generator) -> None:
        f, mask = rng.uniform(-1, 1, shape), rng.random(shape) > 0.3
        before = f.copy(), mask.copy()
        f.flags.writeable = mask.flags.writeable = False
        smooth(f, mask=mask, initial=f, method=method)
        assert np.array_equal(f, before[0])
        assert np.array_equal(mask, before[1])

    def test_cells_outside_the_mask_stay(self, method: str, shape: tuple[int, ...], rng: np.random.Generator) -> None:
        f = rng.uniform(-1, 1, shape).astype(np.float32)
        mask = rng.random(shape) > 0.5
        assert np.array_equal(smooth(f, mask=mask, method=method)[~mask], f[~mask])
        assert np.array_equal(smooth(f, mask=np.zeros(shape, dtype=bool), method=method), f)

    def test_parts_of_a_mask_know_nothing_of_each_other(
        self, method: str, shape: tuple[int, ...], rng: np.random.Generator
    ) -> None:
        f = rng.uniform(-1, 1, shape)
        mask = np.ones(shape, dtype=bool)
        mask[3] = False
        whole = smooth(f, mask=mask, method=method)
        assert np.allclose(whole[:3], smooth(f[:3], method=method), atol=1e-6)
        assert np.allclose(whole[4:], smooth(f[4:], method=method), atol=1e-6)

    @pytest.mark.long
    @pytest.mark.parametrize("kind", [bool, np.int8, np.uint8, np.float16, np.float32, ">f8"])
    def test_takes_any_real_type(
        self, method: str, shape: tuple[int, ...], kind: Any, rng: np.random.Generator
    ) -> None:
        f = rng.random(shape) > 0.5
        signs = np.where(f, 1.0, -1.0)
        given_as = f if kind is bool else (f if kind is np.uint8 else signs).astype(kind)
        expected = smooth(f.astype(float) if kind is np.uint8 else signs, method=method)
        assert np.allclose(smooth(given_as, method=method), expected, atol=1e-6)

    def test_memory_layout_does_not_matter(self, method: str, shape: tuple[int, ...], rng: np.random.Generator) -> None:
        f = rng.uniform(-1, 1, tuple(2 * n for n in shape))[(slice(None, None, 2),) * len(shape)]
        assert np.array_equal(smooth(f, method=method), smooth(np.ascontiguousarray(f), method=method))


@every_kernel
def test_equal_layers_are_smoothed_as_one(method: str, rng: np.random.Generator) -> None:
    layer = smooth_noise(rng, (14, 17))
    volume = np.repeat(layer[:, :, None], 4, axis=2)
    assert np.allclose(smooth(volume, method=method), smooth(layer, method=method)[:, :, None], atol=1e-6)


@every_kernel
def test_the_energy_falls(method: str, rng: np.random.Generator) -> None:
    """E = sum of |grad phi|²/2 + F(phi)/eps² + fidelity (phi - f)²/2 never rises."""
    f = np.sign(smooth_noise(rng, (40, 40)))
    eps2 = (2 / (math.sqrt(2) * math.atanh(0.9))) ** 2

    def energy(phi: np.ndarray) -> float:
        slopes = sum((np.diff(phi, axis=axis) ** 2).sum() for axis in range(2)) / 2
        return float(slopes + ((phi**2 - 1) ** 2).sum() / (4 * eps2) + 0.01 * ((phi - f) ** 2).sum() / 2)

    energies = [energy(smooth(f, Smoothing(steps=n), method=method)) for n in range(15)]
    assert all(later < earlier for earlier, later in zip(energies, energies[1:], strict=False))


def test_the_laplacian_is_scipys(rng: np.random.Generator) -> None:
    for shape in ((12,), (9, 11), (5, 6, 7)):
        phi = rng.uniform(-1, 1, shape)
        assert np.allclose(laplacian(phi, (1.0,) * len(shape)), ndimage.laplace(phi, mode="nearest"), atol=1e-13)


def test_diffusion_keeps_the_sum(rng: np.random.Generator) -> None:
    phi, mask = rng.uniform(-1, 1, (9, 11)), rng.random((9, 11)) > 0.4
    assert laplacian(phi, (0.1, 0.2), mask).sum() == pytest.approx(0, abs=1e-13)


@pytest.mark.slow
@every_kernel
@pytest.mark.parametrize(
    ("width", "steps", "fidelity", "expected"),
    [
        (3, 5, 0.01, 2.98),
        (3, 10, 0.01, 2.83),
        (3, 30, 0.01, 0),
        (5, 10, 0.01, 5.00),
        (5, 30, 0.01, 4.95),
        (5, 100, 0.01, 4.76),
        (1, 5, 1.0, 0),
        (3, 400, 1.0, 2.93),
    ],
)
def test_straight_walls_shrink_as_measured_beforehand(
    method: str, width: int, steps: int, fidelity: float, expected: float
) -> None:
    """Golden widths of walls of 1, 3 and 5 cells, older than every kernel, to their last digit (4.77 for 4.76)."""
    f = -np.ones(61)
    f[30 - width // 2 : 31 + width // 2] = 1
    phi = smooth(f, Smoothing(steps=steps, fidelity=fidelity), method=method)
    right = phi[30:]
    if right[0] <= 0:
        found = 0.0
    else:
        i = int(np.argmax(right <= 0)) - 1
        found = 2 * float(i + right[i] / (right[i] - right[i + 1]))
    assert found == pytest.approx(expected, abs=0.006)


def test_the_paper_in_units_of_cells() -> None:
    for lam, h, fidelity in ((100, 0.01, 0.01), (100, 1 / 32, 0.09765625), (100, 0.1, 1.0)):
        assert Smoothing.paper(lam=lam, h=h).fidelity == pytest.approx(fidelity)
    assert Smoothing.paper() == Smoothing()
    eps = 2 / (math.sqrt(2) * math.atanh(0.9))
    assert Smoothing().decay == pytest.approx(math.exp(-2 / 7 / eps**2))
    assert Smoothing(fidelity=0.7).pull == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"steps": -1}, "^steps is"),
        ({"steps": 1.5}, "^steps is"),
        ({"interface": 0}, "interface"),
        ({"alpha": -0.1}, "alpha"),
        ({"alpha": math.nan}, "alpha"),
        ({"interface": 0.03}, "interface is 0.03; it must be a number from 0.25 to 1000"),
        ({"interface": "x"}, "it must be a number"),
        ({"fidelity": -1}, "fidelity"),
        ({"fidelity": math.inf}, "fidelity"),
    ],
)
def test_bad_settings_are_refused(options: dict[str, Any], says: str) -> None:
    with pytest.raises(ParameterError, match=says):
        Smoothing(**options)


@every_kernel
@pytest.mark.parametrize(
    ("dimensions", "spacing", "limit"), [(1, 1.0, 1 / 2), (2, 1.0, 1 / 4), (3, 1.0, 1 / 6), (2, (1.0, 2.0), 0.4)]
)
def test_the_stability_limit(method: str, dimensions: int, spacing: Any, limit: float) -> None:
    f = np.ones((4,) * dimensions)
    smooth(f, Smoothing(alpha=limit), spacing=spacing, method=method)
    with pytest.raises(ParameterError, match=r"stable up to .* lower alpha"):
        smooth(f, Smoothing(alpha=limit * 1.001), spacing=spacing, method=method)


@every_kernel
@pytest.mark.parametrize(
    ("f", "options", "says"),
    [
        (np.full((3, 3), np.nan), {}, "holds NaN"),
        (np.full((3, 3), 1.5), {}, "rescale"),
        (np.zeros((0, 3)), {}, "no cells"),
        (np.array(1.0), {}, "no cells"),
        (np.ones((3, 3), dtype=complex), {}, "real numbers"),
        (np.array([["a"]]), {}, "real numbers"),
        (np.ones((3, 3)), {"initial": np.ones((3, 4))}, "initial field has the shape"),
        (np.ones((3, 3)), {"mask": np.ones((2, 3), dtype=bool)}, "mask has the shape"),
        (np.ones((3, 3)), {"mask": np.ones((3, 3))}, "booleans"),
        (np.ones((3, 3)), {"spacing": (1, 2, 3)}, "3 numbers for 2"),
        (np.ones((3, 3)), {"spacing": 0}, "spacing"),
        (np.ones((3, 3)), {"initial": np.full((3, 3), 2)}, "initial field ranges"),
    ],
)
def test_bad_data_are_refused(method: str, f: np.ndarray, options: dict[str, Any], says: str) -> None:
    with pytest.raises(ParameterError, match=says):
        smooth(f, method=method, **options)


def test_an_unknown_kernel_is_refused() -> None:
    with pytest.raises(ParameterError, match="^method is 'magic'; choose from auto, numpy, inplace, dense, sparse"):
        smooth(np.ones(3), method="magic")


def test_rescaling_is_equation_2() -> None:
    assert rescale([0, 128, 256]).tolist() == [-1, 0, 1]
    for bad in ([1, 1], [], [0, np.inf], [np.nan, 1]):
        with pytest.raises(ParameterError, match="two different finite values"):
            rescale(bad)


@pytest.mark.slow
@every_kernel
@pytest.mark.parametrize("interface", [0.25, 1000.0])
@pytest.mark.parametrize("alpha", [1e-4, 0.25])
@pytest.mark.parametrize("fidelity", [0.0, 1e6])
def test_the_ends_of_the_ranges_give_numbers(method: str, interface: float, alpha: float, fidelity: float) -> None:
    f = np.linspace(-1, 1, 21).reshape(3, 7)
    smoothing = Smoothing(interface=interface, alpha=alpha, fidelity=fidelity)
    assert np.isfinite(smooth(f, smoothing, method=method)).all()


def test_settings_are_plain_numbers() -> None:
    smoothing = Smoothing(steps=np.int64(5), fidelity=np.float32(0.5), alpha=0.125)
    assert [type(value) for value in (smoothing.steps, smoothing.fidelity, smoothing.alpha)] == [int, float, float]
    assert Smoothing(steps=10.0).steps == 10


def test_an_interrupt_is_an_interrupt(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C comes out as such, not as the failure of the thread that works for the main one."""
    monkeypatch.setattr("infill.phasefield.inplace.CELLS_PER_BLOCK", 512)
    monkeypatch.setattr("infill.phasefield.inplace.thread_count", lambda _: 3)
    real = np.sqrt

    def interrupted(*args: Any, **options: Any) -> Any:
        if threading.current_thread().name == "infill-main":
            raise KeyboardInterrupt
        return real(*args, **options)

    monkeypatch.setattr("infill.phasefield.inplace.np.sqrt", interrupted)
    with pytest.raises(KeyboardInterrupt):
        smooth(np.ones((80, 80)), Smoothing(steps=50), method="inplace")


@pytest.mark.longest
def test_the_log_tells_of_compiling(tmp_path: Path) -> None:
    """Once on a machine: here in a process with an empty folder for compiled code."""
    code = "import infill; infill.smooth([[[True, False]]], method='dense')"
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    told = [
        subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, encoding="utf-8", check=True)
        for _ in range(2)
    ]
    assert told[0].stderr == "preparing the smoother for input of this kind, up to a minute, the first time\n"
    assert told[1].stderr == ""
