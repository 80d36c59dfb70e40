"""Laws of a method that ours is measured beside: the Cahn-Hilliard smoother of Choi et al."""

from __future__ import annotations

import cmath
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapes import smooth_noise
from skimage.measure import marching_cubes

from benchmarks.peers.cahn_hilliard import CahnHilliard, smooth, wave_numbers
from benchmarks.solids import Shape

EXACT = 1e-12  # transforms of less than a thousand cells in float64, ten steps
DEFAULT = CahnHilliard()
FREE = CahnHilliard(fidelity=0.0)  # no data to hold to: the equation alone, which conserves
# Of both parities, since the half spectrum of an even count ends with a wave that an odd one has not.
shapes = st.one_of(
    st.tuples(st.integers(1, 40)),
    st.tuples(st.integers(1, 14), st.integers(1, 14)),
    st.tuples(st.integers(1, 9), st.integers(1, 9), st.integers(1, 9)),
)
seeds = st.integers(0, 2**32 - 1)


def exactly(f: np.ndarray, settings: CahnHilliard = DEFAULT) -> np.ndarray:
    return smooth(f, settings, kind=np.float64, threads=1)


def binary(shape: tuple[int, ...], seed: int) -> np.ndarray:
    return np.random.default_rng(seed).choice([-1.0, 1.0], size=shape)


def textbook(f: list[float], settings: CahnHilliard) -> list[float]:
    """The scheme written down a second time, by sums over all cells and waves, whole spectrum, in plain Python."""
    n = len(f)

    def spectrum(values: list[float]) -> list[complex]:
        return [sum(v * cmath.exp(-2j * math.pi * k * x / n) for x, v in enumerate(values)) for k in range(n)]

    def field(waves: list[complex]) -> list[float]:
        return [(sum(w * cmath.exp(2j * math.pi * k * x / n) for k, w in enumerate(waves)) / n).real for x in range(n)]

    phi, data = list(f), spectrum(f)
    for _ in range(settings.steps):
        old, bent = spectrum(phi), spectrum([v**3 - 3 * v for v in phi])
        new = []
        for k in range(n):
            laplace = -((2 * math.pi * min(k, n - k) / n) ** 2)
            right = old[k] + settings.dt * (laplace * bent[k] + settings.fidelity * data[k])
            left = 1 + settings.dt * (settings.eps**2 * laplace**2 - 2 * laplace + settings.fidelity)
            new.append(right / left)
        phi = field(new)
    return phi


def energy(phi: np.ndarray, settings: CahnHilliard) -> float:
    """The energy that the equation lowers, sum of (phi² - 1)² / 4 + eps² |grad phi|² / 2, the gradient spectral."""
    waves = [2 * np.pi * np.fft.fftfreq(n) for n in phi.shape]
    squared = sum(wave**2 for wave in np.meshgrid(*waves, indexing="ij"))
    gradient = (squared * np.abs(np.fft.fftn(phi)) ** 2).sum() / phi.size
    return float(((phi**2 - 1) ** 2).sum() / 4 + settings.eps**2 * gradient / 2)


def ball(n: int, radius: float) -> np.ndarray:
    shape = Shape(size=(n,) * 3, value=lambda p: np.linalg.norm(p, axis=1) - radius)
    return shape.voxels()


# --- an independent second form -------------------------------------------------------------------


@pytest.mark.parametrize("n", [1, 2, 7, 12])
@pytest.mark.parametrize(
    "settings", [CahnHilliard(), CahnHilliard(steps=4, dt=0.3, fidelity=0.05, eps=1.7), replace(FREE, dt=1.0)]
)
def test_the_same_as_sums_over_all_waves(n: int, settings: CahnHilliard) -> None:
    f = binary((n,), seed=n)
    np.testing.assert_allclose(exactly(f, settings), textbook(f.tolist(), settings), rtol=0, atol=EXACT)


def test_one_small_wave_grows_and_decays_as_the_linear_equation_says() -> None:
    """With phi = a cos(k x), a -> 0, the cube is nothing, and each step multiplies the wave by one number."""
    k, small = 2 * math.pi * 3 / 32, 1e-6
    f = small * np.cos(k * np.arange(32))
    for eps in (0.5, 1.0, 3.0):  # k² eps² is 0.09, 0.35 and 3.1: waves under 1 grow
        settings = CahnHilliard(steps=1, dt=0.7, fidelity=0.0, eps=eps)
        gain = (1 + 3 * 0.7 * k**2) / (1 + 0.7 * (2 * k**2 + eps**2 * k**4))
        assert (gain > 1) == (k * eps < 1)
        np.testing.assert_allclose(exactly(f, settings), gain * f, rtol=0, atol=10 * small**3)  # the cube


@given(shapes)
def test_wave_numbers_are_those_of_the_transform(shape: tuple[int, ...]) -> None:
    waves = [2 * np.pi * np.fft.fftfreq(n) for n in shape[:-1]] + [2 * np.pi * np.fft.rfftfreq(shape[-1])]
    expected = sum(wave**2 for wave in np.meshgrid(*waves, indexing="ij"))
    found = wave_numbers(shape)
    assert found.shape == np.fft.rfftn(np.zeros(shape)).shape
    np.testing.assert_allclose(found, expected, rtol=1e-14)


# --- what is conserved and what stays -------------------------------------------------------------


@given(shapes, seeds)
def test_without_data_to_hold_to_the_mean_is_conserved(shape: tuple[int, ...], seed: int) -> None:
    f = smooth_noise(np.random.default_rng(seed), shape)
    assert exactly(f, FREE).mean() == pytest.approx(f.mean(), abs=EXACT)


def test_with_data_the_mean_is_conserved_too() -> None:
    """The data have the same mean as the field, so nothing pulls it: what is lost at a corner is gained elsewhere."""
    f = binary((9, 8), seed=1)
    assert exactly(f).mean() == pytest.approx(f.mean(), abs=EXACT)
    assert np.abs(exactly(f) - f).max() > 0.1


@pytest.mark.parametrize("value", [-1.0, 1.0])
@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_solid_alone_and_void_alone_stay(value: float, kind: type) -> None:
    for settings in (CahnHilliard(), FREE):
        phi = smooth(np.full((6, 5, 4), value), settings, kind=kind)
        assert phi.dtype == kind
        np.testing.assert_allclose(phi, value, rtol=0, atol=50 * np.finfo(kind).eps)  # a few roundings a step


def test_a_fidelity_beyond_all_bounds_returns_the_data() -> None:
    f = binary((6, 5, 4), seed=2)
    apart = [np.abs(exactly(f, CahnHilliard(fidelity=10.0**n)) - f).max() for n in (3, 5, 7)]
    assert apart == sorted(apart, reverse=True)
    # The spread of k² (2 + k²) over the fidelity, since lam dt >> 1 makes one step the steady state.
    assert apart[-1] < 1e-4
    assert apart[0] > 1e-2


# --- symmetries -----------------------------------------------------------------------------------


@given(shapes, seeds)
def test_solid_and_void_are_treated_alike(shape: tuple[int, ...], seed: int) -> None:
    f = smooth_noise(np.random.default_rng(seed), shape)
    np.testing.assert_allclose(exactly(-f), -exactly(f), rtol=0, atol=EXACT)


@pytest.mark.slow
@given(shapes, seeds)
def test_smoothing_commutes_with_mirroring_and_transposing(shape: tuple[int, ...], seed: int) -> None:
    f = smooth_noise(np.random.default_rng(seed), shape)
    phi = exactly(f)
    np.testing.assert_allclose(exactly(f.T), phi.T, rtol=0, atol=EXACT)
    for axis in range(f.ndim):
        np.testing.assert_allclose(exactly(np.flip(f, axis)), np.flip(phi, axis), rtol=0, atol=EXACT)


@pytest.mark.slow
@given(shapes, seeds, st.integers(-20, 20))
def test_the_box_has_no_edge(shape: tuple[int, ...], seed: int, shift: int) -> None:
    f = smooth_noise(np.random.default_rng(seed), shape)
    for axis in range(f.ndim):
        moved = exactly(np.roll(f, shift, axis))
        np.testing.assert_allclose(moved, np.roll(exactly(f), shift, axis), rtol=0, atol=EXACT)


def test_a_layer_repeated_is_smoothed_as_the_layer() -> None:
    layer = binary((11, 8), seed=3)
    volume = exactly(np.repeat(layer[:, :, None], 5, axis=2))
    np.testing.assert_allclose(volume, np.repeat(exactly(layer)[:, :, None], 5, axis=2), rtol=0, atol=EXACT)


# --- energy, precision, the paper's sphere --------------------------------------------------------


@pytest.mark.parametrize("dt", [1e-3, 0.1, 1.0, 100.0, 1e5])
def test_the_energy_never_rises(dt: float) -> None:
    """Eyre: 2 phi taken implicitly is enough for any time step while phi² <= 5/3, where 3 phi² - 1 <= 2 * 2."""
    settings = replace(FREE, steps=1, dt=dt)
    for seed, shape in enumerate([(40,), (16, 15), (9, 10, 8)]):
        phi = smooth_noise(np.random.default_rng(seed), shape)
        before = first = energy(phi, settings)
        for _ in range(20):
            phi = exactly(phi, settings)
            assert (phi**2).max() <= 5 / 3
            after = energy(phi, settings)
            assert after <= before + EXACT * first
            before = after
        assert before < first


def test_the_energy_is_that_of_the_equation() -> None:
    """Its slope against a change of phi is phi³ - phi - eps² Laplace(phi): the helper can fail."""
    settings, rng = CahnHilliard(eps=1.3), np.random.default_rng(4)
    phi, change = smooth_noise(rng, (9, 7)), rng.standard_normal((9, 7))
    squared = sum(np.meshgrid(*((2 * np.pi * np.fft.fftfreq(n)) ** 2 for n in phi.shape), indexing="ij"))
    bent = phi**3 - phi + settings.eps**2 * np.fft.ifftn(squared * np.fft.fftn(phi)).real
    slope = (energy(phi + 1e-5 * change, settings) - energy(phi - 1e-5 * change, settings)) / 2e-5
    assert slope == pytest.approx((bent * change).sum(), rel=1e-7)


@pytest.mark.parametrize("shape", [(500,), (33, 40), (21, 20, 18)])
def test_float32_is_float64_to_its_last_digits(shape: tuple[int, ...]) -> None:
    f = binary(shape, seed=5)
    for settings in (CahnHilliard(), replace(FREE, dt=1.0)):
        for threads in (1, -1):
            single = smooth(f, settings, threads=threads)
            assert single.dtype == np.float32
            np.testing.assert_allclose(single, exactly(f, settings), rtol=0, atol=1e-5)  # 100 eps: ten steps of ten


def test_the_defaults_are_the_paper_s_at_its_cell_size() -> None:
    h, dt, lam, eps = 0.01, 0.01, 1e4, 0.01
    expected = CahnHilliard(steps=10, dt=dt / h**2, fidelity=lam * h**2, eps=eps / h)
    for name, value in vars(expected).items():
        assert getattr(DEFAULT, name) == pytest.approx(value)


def test_the_data_are_not_changed() -> None:
    f = binary((6, 6), seed=6).astype(np.float32)
    kept = f.copy()
    smooth(f, replace(FREE, steps=0))
    smooth(f)
    np.testing.assert_array_equal(f, kept)


def test_the_sphere_changes_as_it_did_when_first_measured() -> None:
    """200³ cells gave a mean (phi - f)² of 0.0080: a square of 0.528 a vertex of the binary surface, whatever n."""
    f = ball(80, 32.0)
    squares = (smooth(f) - f) ** 2
    mean = squares.mean(dtype=np.float64)
    assert mean == pytest.approx(0.0080 * 200 / 80, rel=0.01)
    assert mean == pytest.approx(0.019969, rel=1e-4)
    vertices = len(marching_cubes(f, 0.0)[0])
    assert squares.sum(dtype=np.float64) / vertices == pytest.approx(0.528, rel=0.01)
