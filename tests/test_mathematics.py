"""What docs/design/mathematics.md claims, and that its tables hold the numbers the code gives."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from scipy import integrate, ndimage
from skimage.measure import find_contours

from examples.paper import walls
from infill import Smoothing
from infill.phasefield.allen_cahn import STEEPNESS, apply_fidelity, diffuse, laplacian, react, smooth_reference, step

PAGE = Path(__file__).resolve().parents[1] / "docs" / "design" / "mathematics.md"
ROUNDING = 1e-12  # relative: sums of some thousand terms in float64
NEVER = "never"


def table(first: str) -> list[list[str]]:
    """The rows of the one table of the page whose first column has this name."""
    found = [block for block in PAGE.read_text(encoding="utf-8").split("\n\n") if block.startswith(f"| {first} |")]
    (lines,) = [block.splitlines() for block in found]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def width_over_root_two(smoothing: Smoothing) -> float:
    """eps / h."""
    return smoothing.interface / (math.sqrt(2) * STEEPNESS)


# The energy, in units of h^(dim - 2), with h the smallest cell size.


@dataclass(frozen=True, kw_only=True)
class Problem:
    """A field under one set of parameters; `components` leading axes tell fields apart, and nothing flows along them."""

    f: np.ndarray
    smoothing: Smoothing
    spacing: tuple[float, ...]
    mask: np.ndarray | None = None
    components: int = 0

    @property
    def weights(self) -> tuple[float, ...]:
        return (0.0,) * self.components + self.smoothing.weights(self.spacing)

    def total(self, density: np.ndarray) -> np.ndarray:
        inside = density if self.mask is None else np.where(self.mask, density, 0)
        return inside.sum(axis=tuple(range(self.components, density.ndim)))

    def diffusion(self, phi: np.ndarray) -> np.ndarray:
        return self.total(-phi * laplacian(phi, self.weights, self.mask) / (2 * self.smoothing.alpha))

    def reaction(self, phi: np.ndarray) -> np.ndarray:
        return self.total((phi**2 - 1) ** 2 / (4 * width_over_root_two(self.smoothing) ** 2))

    def fidelity(self, phi: np.ndarray) -> np.ndarray:
        return self.total(self.smoothing.fidelity * (self.f - phi) ** 2 / 2)

    def energy(self, phi: np.ndarray) -> np.ndarray:
        """(M9)"""
        return self.diffusion(phi) + self.reaction(phi) + self.fidelity(phi)

    def shifted(self, phi: np.ndarray) -> np.ndarray:
        """(M11), less its value at phi = f = 1."""
        decay, pull, alpha = self.smoothing.decay, self.smoothing.pull, self.smoothing.alpha
        y = (1 + pull) * phi - pull * self.f
        scale = math.sqrt(decay) / ((1 - decay) * (1 + pull))
        well = scale * (math.sqrt(decay) - np.sqrt(1 - (1 - decay) * y**2)) + (1 - phi**2) / 2
        return self.diffusion(phi) + self.total(well) / alpha

    @property
    def covered(self) -> bool:
        """(M13)"""
        smoothing = self.smoothing
        return 4 * sum(self.weights) <= 1 + (1 + smoothing.pull) * math.sqrt(smoothing.decay)

    def states(self, steps: int) -> Iterator[np.ndarray]:
        phi = self.f
        for _ in range(steps):
            phi = step(phi, self.f, self.smoothing, self.weights, self.mask)
            yield phi


@st.composite
def problems(draw: st.DrawFn) -> Problem:
    """Small fields in 1 to 3 dimensions, with and without a mask, up to the stability limit."""
    shape = draw(st.sampled_from([(1,), (17,), (6, 7), (4, 3, 5)]))
    spacing = tuple(draw(st.sampled_from([1.0, 1.0, 1.7])) for _ in shape)
    limit = 1 / (2 * sum((min(spacing) / size) ** 2 for size in spacing))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    f = rng.uniform(-1, 1, shape)
    return Problem(
        f=np.sign(f) if draw(st.booleans()) else f,
        smoothing=Smoothing(
            fidelity=draw(st.sampled_from([0.0, 0.01, 1.0, 20.0])),
            interface=draw(st.sampled_from([0.5, 1.0, 2.0, 4.0])),
            alpha=limit * draw(st.floats(0.02, 1)),
        ),
        spacing=spacing,
        mask=rng.random(shape) > 0.3 if draw(st.booleans()) else None,
    )


# The parts of a step.


@pytest.mark.parametrize("start", [-0.9, -0.2, 0.0, 0.01, 0.7, 1.0])
def test_the_reaction_is_solved_exactly(start: float) -> None:
    smoothing = Smoothing(interface=1.3)
    rate = 1 / width_over_root_two(smoothing) ** 2
    ode = integrate.solve_ivp(
        lambda t, y: -rate * (y**3 - y), (0, smoothing.alpha), [start], rtol=1e-11, atol=1e-13, method="DOP853"
    )
    assert react(np.array([start]), smoothing.decay)[0] == pytest.approx(ode.y[0, -1], abs=1e-9)  # of the ODE solver


@given(problem=problems())
def test_no_part_of_a_step_leaves_the_range_of_what_it_starts_from(problem: Problem) -> None:
    """The maximum principle up to the stability limit itself."""
    slack = 4 * np.finfo(float).eps  # a sum of seven terms
    phi = problem.f
    for _ in range(5):
        after = diffuse(phi, problem.weights, problem.mask)
        assert phi.min() - slack <= after.min()
        assert after.max() <= phi.max() + slack
        after = react(after, problem.smoothing.decay)
        assert np.abs(after).max() <= 1 + slack
        phi = apply_fidelity(after, problem.f, problem.smoothing.pull)
        assert np.abs(phi).max() <= 1 + slack


def test_over_the_limit_the_maximum_principle_fails() -> None:
    board = np.where(np.indices((8, 8)).sum(axis=0) % 2, 1.0, -1.0)
    at, over = (np.abs(diffuse(board, (w, w))[1:-1, 1:-1]).max() for w in (1 / 4, 1.01 / 4))
    assert at == 1  # the checkerboard turns its sign and nothing else
    assert over == pytest.approx(1.02)  # |1 - 8 w|


@given(problem=problems(), seed=st.integers(0, 2**32 - 1))
def test_a_step_keeps_the_order_of_two_fields(problem: Problem, seed: int) -> None:
    more = np.minimum(1, problem.f + np.random.default_rng(seed).uniform(0, 0.5, problem.f.shape))
    larger = replace(problem, f=more)
    for low, high in zip(problem.states(6), larger.states(6), strict=True):
        assert (low <= high + ROUNDING).all()


@pytest.mark.parametrize("spacing", [(1.0, 1.0), (0.4, 1.0), (1.0, 1.0, 2.5)])
def test_cosines_are_the_modes_of_diffusion(spacing: tuple[float, ...]) -> None:
    """(M6), (M7): the growth factor of each mode, and that none is over 1 up to the limit."""
    shape = (7, 5, 6)[: len(spacing)]
    limit = 1 / (2 * sum((min(spacing) / size) ** 2 for size in spacing))
    weights = Smoothing(alpha=limit).weights(spacing)
    for mode in np.ndindex(*shape):
        field, growth = np.ones(shape), 1.0
        for axis, (k, n, weight) in enumerate(zip(mode, shape, weights, strict=True)):
            wave = np.cos(np.pi * k * (np.arange(n) + 0.5) / n)
            field = field * np.expand_dims(wave, tuple(a for a in range(len(shape)) if a != axis))
            growth -= 4 * weight * math.sin(math.pi * k / (2 * n)) ** 2
        assert np.abs(diffuse(field, weights) - growth * field).max() < ROUNDING
        assert abs(growth) <= 1


@given(problem=problems())
def test_diffusion_keeps_the_sum(problem: Problem) -> None:
    after = diffuse(problem.f, problem.weights, problem.mask)
    assert problem.total(after) == pytest.approx(problem.total(problem.f), abs=ROUNDING * problem.f.size)
    if problem.mask is not None:
        assert (after == problem.f)[~problem.mask].all()  # what is outside takes no part


# The profile.


def change_of_the_profile(interface: int) -> float:
    """How far one step moves the tanh profile, with no data to hold it."""
    smoothing = Smoothing(interface=interface, fidelity=0)
    x = np.arange(-20 * interface, 20 * interface) + 0.5
    phi = np.tanh(x / (math.sqrt(2) * width_over_root_two(smoothing)))
    return float(np.abs(step(phi, phi, smoothing, smoothing.weights((1.0,))) - phi).max())


@pytest.mark.slow
def test_the_profile_is_fixed_to_fourth_order() -> None:
    changes = [change_of_the_profile(m) for m in (8, 16, 32)]
    for coarse, fine in pairwise(changes):
        assert math.log2(coarse / fine) == pytest.approx(4, abs=0.02)  # the next term is m^-6
    told = table("m")
    assert [[row[0], row[1]] for row in told] == [[str(m), f"{change_of_the_profile(m):.1e}"] for m in (1, 2, 4, 8, 16)]
    steady = {m: f"{cells_to_nine_tenths(m):.2f}" for m in (1, 2, 4, 8)}
    assert {int(row[0]): row[2] for row in told[:-1]} == steady


def cells_to_nine_tenths(interface: int) -> float:
    """Where the steady profile of the scheme passes 0.9, by linear interpolation of artanh phi."""
    smoothing = Smoothing(interface=interface, fidelity=0, steps=200 * interface**2)
    x = np.arange(-6 * interface, 6 * interface) + 0.5
    phi = smooth_reference(np.sign(x), smoothing)
    assert np.abs(step(phi, phi, smoothing, smoothing.weights((1.0,))) - phi).max() < 1e-7  # it stands
    right = x > 0
    return float(np.interp(STEEPNESS, np.arctanh(np.minimum(phi[right], 1 - 1e-9)), x[right]))


def test_the_interface_is_counted_to_nine_tenths() -> None:
    for m in (1, 2, 5):
        assert math.tanh(m / (math.sqrt(2) * width_over_root_two(Smoothing(interface=m)))) == pytest.approx(0.9)


# The energy.


@given(problem=problems())
def test_each_part_of_a_step_lowers_its_own_energy(problem: Problem) -> None:
    phi = problem.f
    for _ in range(5):
        for move, part in (
            (lambda phi: diffuse(phi, problem.weights, problem.mask), problem.diffusion),
            (lambda phi: react(phi, problem.smoothing.decay), problem.reaction),
            (lambda phi: apply_fidelity(phi, problem.f, problem.smoothing.pull), problem.fidelity),
        ):
            after = move(phi)
            assert part(after) <= part(phi) * (1 + ROUNDING) + ROUNDING * problem.f.size
            phi = after


def test_one_part_may_raise_the_energy_of_another() -> None:
    problem = Problem(f=np.sign(np.arange(-8, 8) + 0.5), smoothing=Smoothing(), spacing=(1.0,))
    phi = diffuse(problem.f, problem.weights)
    assert problem.reaction(phi) > problem.reaction(problem.f)


@pytest.mark.slow
@settings(max_examples=80)
@given(problem=problems())
@example(Problem(f=np.sign(np.arange(-8, 8) + 0.5), smoothing=Smoothing(), spacing=(1.0,)))
def test_the_shifted_energy_falls_wherever_it_is_proven_to(problem: Problem) -> None:
    assume(problem.covered)
    smallest = 1 + (1 + problem.smoothing.pull) * math.sqrt(problem.smoothing.decay) - 4 * sum(problem.weights)
    before, phi = problem.shifted(problem.f), problem.f
    # The wells are differences of numbers of size 1 / alpha, and there is one for each cell.
    slack = 1e-14 * problem.f.size / problem.smoothing.alpha
    for after in problem.states(30):
        energy = problem.shifted(after)
        least = smallest * problem.total((after - phi) ** 2) / (2 * problem.smoothing.alpha)
        assert energy <= before - least + slack
        before, phi = energy, after


def test_where_it_is_not_proven_the_shifted_energy_may_rise() -> None:
    f = walls.whole_walls((6,))[0, 0]
    at_limit = Problem(f=f, smoothing=Smoothing(alpha=1 / 2), spacing=(1.0,))
    assert not at_limit.covered
    assert np.diff([at_limit.shifted(phi) for phi in at_limit.states(20)]).max() > 0.01


@pytest.mark.parametrize(("dimensions", "smallest"), [(1, 0), (2, 0.57), (3, 1.36)])
def test_where_the_shifted_energy_is_proven_to_fall(dimensions: int, smallest: float) -> None:
    for m in np.arange(0.25, 4, 0.01).round(2):
        problem = Problem(f=np.ones(1), smoothing=Smoothing(fidelity=0, interface=m), spacing=(1.0,) * dimensions)
        assert problem.covered == (m >= smallest)


def test_the_shifted_energy_is_the_energy_to_first_order() -> None:
    rng = np.random.default_rng(5)
    f, one, other = rng.uniform(-0.9, 0.9, (3, 9, 9))
    gaps = []
    for alpha in (0.02, 0.01, 0.005, 0.0025):
        problem = Problem(f=f, smoothing=Smoothing(alpha=alpha, fidelity=0.7), spacing=(1.0, 1.0))
        exact = problem.energy(one) - problem.energy(other)
        gaps.append(abs(problem.shifted(one) - problem.shifted(other) - exact))
    for coarse, fine in pairwise(gaps):
        assert coarse / fine == pytest.approx(2, abs=0.1)  # the next term is alpha^2


@cache
def fields() -> tuple[np.ndarray, ...]:
    """19 fields, (1D, 2D, 3D) stacked: walls, solids, lines, noise."""
    rng = np.random.default_rng(1)
    x, y = np.indices((32, 32)) - 15.5
    away, across = np.hypot(x, y), x * math.cos(0.3) + y * math.sin(0.3)
    blobs = ndimage.gaussian_filter(rng.standard_normal((32, 32)), 2)
    p = np.indices((12, 12, 12)) - 5.5
    waves = [np.sin(p[i] * math.pi / 6) * np.cos(p[(i + 1) % 3] * math.pi / 6) for i in range(3)]
    plane = [
        away < 10.3,
        away < 2.2,
        np.maximum(abs(x), abs(y)) < 9,
        abs(across) < 1.5,
        across < 0,
        rng.random((32, 32)) < 0.5,
        (away < 10.3) ^ (rng.random((32, 32)) < 0.2),
        blobs > 0,
    ]
    grey = [np.clip(3 - 2 * abs(across), -1, 1), rng.uniform(-1, 1, (32, 32))]
    space = [(p**2).sum(axis=0) < 4.3**2, abs(sum(waves)) < 0.6, rng.random((12, 12, 12)) < 0.5]
    return (
        walls.whole_walls(range(1, 7))[:, 0],
        np.stack([*(np.where(part, 1.0, -1.0) for part in plane), *grey]),
        np.stack([np.where(part, 1.0, -1.0) for part in space]),
    )


def measured_energy(fidelity: float, steps: int = 500) -> tuple[str, str, str]:
    """In how many of the fields the energy rises, when first, and the largest sum of rises over the fall."""
    first, share = [], []
    for f in fields():
        problem = Problem(f=f, smoothing=Smoothing(fidelity=fidelity), spacing=(1.0,) * (f.ndim - 1), components=1)
        energy = np.array([problem.energy(phi) for phi in (f, *problem.states(steps))])
        rise = np.maximum(np.diff(energy, axis=0), 0)
        fall = energy[0] - energy.min(axis=0)
        rise[rise < 1e-11 * fall] = 0  # rounding: real ones are over 1e-9, others under 1e-12
        for component in np.flatnonzero(rise.any(axis=0)):
            first.append(int(np.argmax(rise[:, component] > 0)) + 1)
            share.append(rise[:, component].sum() / fall[component])
    return (f"{len(first)} of 19", str(min(first)), f"{max(share):.0e}") if first else ("0 of 19", NEVER, "0")


@pytest.mark.longest
def test_the_table_of_the_energy() -> None:
    told = table("fidelity λh²")
    assert [row[0] for row in told] == ["0", "0.01", "0.1", "1", "10"]
    for row in told:
        assert tuple(row[1:]) == measured_energy(float(row[0]))


@pytest.mark.slow
def test_the_rise_is_of_second_order() -> None:
    """The rises of the disc at fidelity 0.1 that the page tells."""
    shares = []
    for parts in (1, 2, 4):
        smoothing = Smoothing(fidelity=0.1, alpha=1 / 7 / parts)
        problem = Problem(f=fields()[1][0], smoothing=smoothing, spacing=(1.0, 1.0))
        energy = np.array([problem.energy(phi) for phi in (problem.f, *problem.states(500 * parts))])
        shares.append(np.maximum(np.diff(energy), 0).sum() / (energy[0] - energy.min()))
    assert ", ".join(f"{share:.1e}" for share in shares) in " ".join(PAGE.read_text(encoding="utf-8").split())
    for coarse, fine in pairwise(shares):
        assert coarse / fine == pytest.approx(4, abs=0.3)  # the next term is dt^3


def test_at_the_limit_of_diffusion_the_energy_rises_by_more_than_it_falls() -> None:
    problem = Problem(f=walls.whole_walls((6,))[0, 0], smoothing=Smoothing(alpha=1 / 2), spacing=(1.0,))
    energy = np.array([problem.energy(phi) for phi in (problem.f, *problem.states(300))])
    assert np.maximum(np.diff(energy), 0).sum() > energy[0] - energy.min()


# Order, units, reach.


@cache
def error_of_time(parts: int) -> float:
    """The largest error of phi on a disc after 20 steps of 1/7, each cut into parts, against Richardson's limit."""
    x = np.arange(28) - 13.5
    f = np.clip(2 * (8.3 - np.hypot(x[:, None], x)), -1, 1)
    at = {k: smooth_reference(f, Smoothing(steps=20 * k, alpha=1 / 7 / k, fidelity=0.01)) for k in (parts, 32, 64)}
    return float(np.abs(at[parts] - (2 * at[64] - at[32])).max())


@pytest.mark.slow
def test_the_table_of_the_order() -> None:
    parts = (1, 2, 4, 8)
    told = table("α")
    assert [row[0] for row in told] == [f"1/{7 * k}" for k in parts]
    assert [row[1] for row in told] == [f"{error_of_time(k):.4f}" for k in parts]
    orders = [math.log2(error_of_time(a) / error_of_time(b)) for a, b in pairwise(parts)]
    assert [row[2] for row in told[1:]] == [f"{order:.2f}" for order in orders]
    assert orders[-1] == pytest.approx(1, abs=0.02)  # the next term is dt^2


@given(
    unit=st.sampled_from([1e-3, 1 / 25.4, 0.7, 25.4, 1e3]),
    lam=st.floats(0, 1e4),
    h=st.floats(1e-3, 0.1),
    seed=st.integers(0, 99),
)
def test_the_unit_of_length_does_not_matter(unit: float, lam: float, h: float, seed: int) -> None:
    f = np.random.default_rng(seed).uniform(-1, 1, (5, 6))
    one, other = (
        smooth_reference(f, Smoothing.paper(lam=lam / u**2, h=h * u, steps=8), spacing=(h * u, 1.5 * h * u))
        for u in (1, unit)
    )
    assert np.abs(one - other).max() < ROUNDING


def test_the_table_of_fidelities() -> None:
    told = table("h")
    assert [row[0] for row in told] == ["0.01", "1/32", "0.1"]
    for (_, fidelity, _), h in zip(told, (0.01, 1 / 32, 0.1), strict=True):
        assert f"{Smoothing.paper(lam=100, h=h).fidelity:.2g}" == fidelity


@given(problem=problems(), steps=st.integers(0, 4))
def test_nothing_moves_farther_than_a_cell_a_step(problem: Problem, steps: int) -> None:
    rng = np.random.default_rng(steps)
    shape = (40,) if problem.f.ndim == 1 else (14,) * problem.f.ndim
    f = np.where(ndimage.gaussian_filter(rng.standard_normal(shape), 2.5) > 0, 1.0, -1.0)
    alike = np.ones(shape, dtype=bool)
    for axis in range(f.ndim):
        low, high = (np.take(f, range(a, b), axis=axis) for a, b in ((0, -1 + shape[axis]), (1, shape[axis])))
        there = np.moveaxis(alike, axis, 0)
        change = np.moveaxis(low != high, axis, 0)
        there[:-1] &= ~change
        there[1:] &= ~change
    # 1 where a neighbour differs, and one more for each cell from there.
    distance = ndimage.distance_transform_cdt(np.pad(alike, 1, constant_values=True), "taxicab")
    distance = distance[(slice(1, -1),) * f.ndim] + 1 if not alike.all() else np.full(shape, steps + 1)
    after = smooth_reference(f, replace(problem.smoothing, steps=steps), spacing=problem.spacing)
    assert (after == f)[distance > steps].all()


def test_diffusion_has_the_variance_of_the_gaussian() -> None:
    phi = np.zeros(201)
    phi[100] = 1
    for _ in range(30):
        phi = diffuse(phi, (1 / 7,))
    assert (phi * (np.arange(201) - 100) ** 2).sum() == pytest.approx(2 * 30 / 7)  # exact but for rounding


def distance_from_gaussian(steps: int) -> float:
    """The rms distance of the zero contour of an ellipse from that of the Gaussian of the same blur, cells."""
    x = np.arange(96) - 47.5
    f = np.where(np.hypot(x[:, None] / 38, x / 20) < 1, 1.0, -1.0)
    blurred = ndimage.gaussian_filter(f, math.sqrt(2 * steps / 7), mode="nearest", truncate=8)
    (ours,), (theirs,) = (find_contours(phi, 0.0) for phi in (smooth_reference(f, Smoothing(steps=steps)), blurred))
    return float(np.sqrt(np.mean(shapely.distance(shapely.points(ours), shapely.LinearRing(theirs)) ** 2)))


def test_smoothing_is_close_to_a_gaussian() -> None:
    told = table("steps")
    assert [row[0] for row in told] == ["5", "10", "20", "30"]
    for steps, sigma, distance in told:
        assert sigma == f"{math.sqrt(2 * int(steps) / 7):.2f}"
        assert distance == f"{distance_from_gaussian(int(steps)):.3f}"


def test_a_disc_shrinks_as_its_curvature_says_and_a_level_gives_it_back() -> None:
    """(M15)"""
    radius, steps = 20.0, 20
    x = np.arange(60) - 29.5
    away = np.hypot(x[:, None], x)
    phi = smooth_reference(np.clip(2 * (radius - away), -1, 1), Smoothing(steps=steps, fidelity=0))
    half_width = math.sqrt(2) * width_over_root_two(Smoothing())
    loss = steps / 7 / radius

    def mean_radius(level: float) -> float:
        (line,) = find_contours(np.arctanh(np.clip(phi, -0.9999, 0.9999)) - math.atanh(level), 0.0)
        return math.sqrt(shapely.Polygon(line).area / math.pi)

    assert radius - mean_radius(0) == pytest.approx(loss, rel=0.1)  # 1 / R is taken for its mean over time
    assert mean_radius(-math.tanh(loss / half_width)) == pytest.approx(radius, abs=0.1 * loss)


# Walls and pins.


def shown(size: float) -> str:
    return f"{size:.2f}"


def test_the_attraction_of_two_faces() -> None:
    """(M16)"""
    e = width_over_root_two(Smoothing())
    assert f"{math.exp(math.sqrt(2) / e):.2f}" == "4.36"
    sizes = walls.history(walls.whole_walls((5,)), 0.0, 120)[0, 0]
    n = int(np.argmax(sizes < 4.75))
    speed = 24 * math.sqrt(2) / e * math.exp(-math.sqrt(2) * 4.75 / e) / 7
    assert (f"{speed:.4f}", f"{sizes[n - 1] - sizes[n]:.4f}") == ("0.0046", "0.0036")


@pytest.mark.slow
def test_how_thick_a_wall_must_be_to_last() -> None:
    """(M17), (M18), and the walls on either side of it."""
    e = width_over_root_two(Smoothing())
    back = np.linspace(1e-3, 2, 4001)

    def thinnest(fidelity: float) -> tuple[float, float]:
        pull = 6 * e / math.sqrt(2) * fidelity * np.tanh(back / (math.sqrt(2) * e))
        thick = 2 * back - e / math.sqrt(2) * np.log(pull * e / (24 * math.sqrt(2)))
        return float(thick.min()), float(back[thick.argmin()])

    assert thinnest(1) == pytest.approx((3.10, e / math.sqrt(2) * math.asinh(0.5)), abs=0.005)  # as told
    assert f"{thinnest(1)[1]:.2f}" == "0.33"
    assert [f"{thinnest(x)[0]:.1f}" for x in (0.01, 0.1, 1)] == ["6.2", "4.7", "3.1"]
    assert f"{e / math.sqrt(2):.2f}" == "0.68"
    assert f"{e / math.sqrt(2) * math.log(10):.1f}" == "1.6"
    for fidelity, goes, stays in ((0.01, 6, 6.5), (0.1, 4.5, 5), (1, 1.5, 2.5)):
        end = walls.left(
            walls.bars([goes, stays], [(place,) for place in walls.PLACES]), np.array([goes, stays]), fidelity, 1500
        )[:, -1]
        assert end[0] == 0
        assert end[1] > 0.8
    end = walls.history(walls.bars([2], [(0,), (0.5,)]), 1, 1000)[0, :, -1]
    assert [f"{size:.2f}" for size in end] == ["0.03", "1.32"]


def test_where_the_grid_holds_a_wall() -> None:
    widths = walls.history(walls.bars([7.5], [(place,) for place in walls.PLACES]), 0.01, 300)[0, :, -1]
    assert [f"{width:.2f}" for width in widths] == ["7.18", "7.48", "7.79"]


@cache
def wall_history(fidelity: float, steps: int) -> np.ndarray:
    return walls.history(walls.whole_walls(range(1, 7)), fidelity, steps)[:, 0]


@pytest.mark.slow
def test_the_table_of_walls() -> None:
    told = table("fidelity")
    assert len(told) == 18
    for fidelity, cells, *after, end in told:
        sizes = wall_history(float(fidelity), walls.LONG)[int(cells) - 1]
        assert after == [shown(sizes[n - 1]) for n in (5, 10, 20, 30)]
        (gone,) = walls.gone(sizes[None])
        assert end == (NEVER if gone is None else str(gone))


@pytest.mark.slow
def test_the_table_of_pins() -> None:
    told = table("pin, cells")
    f = walls.bars([int(row[0]) for row in told], [(0, 0), (0, 0.5), (0.5, 0.5)])
    for column, fidelity in enumerate((0.01, 0.1, 1), start=1):
        ends = walls.gone(walls.left(f, np.array([float(row[0]) for row in told]), fidelity, walls.STEPS))
        assert [row[column] for row in told] == [NEVER if end is None else str(end) for end in ends]


def test_walls_side_by_side_are_the_scheme() -> None:
    f = walls.bars([3.3, 5], [(0,), (0.25,)])
    *_, phi = zip(range(12), walls.states(f, Smoothing(fidelity=0.1)), strict=False)
    alone = smooth_reference(f[0, 1], Smoothing(fidelity=0.1, steps=12))
    assert np.abs(phi[1][0, 1] - alone).max() < ROUNDING
    plate = smooth_reference(np.broadcast_to(f[0, 1], (3, 4, f.shape[-1])), Smoothing(fidelity=0.1, steps=12))
    assert np.abs(plate - alone).max() < ROUNDING  # a straight wall is a matter of one dimension


def test_widths_are_those_of_marching_cubes() -> None:
    phi = np.random.default_rng(2).uniform(-1, 1, 40)
    phi[[0, -1]] = -1
    lines = find_contours(np.repeat(phi[:, None], 2, axis=1), 0.0)
    ends = sorted(float(line[:, 0].mean()) for line in lines)
    assert walls.widths(phi) == pytest.approx(sum(b - a for a, b in zip(ends[::2], ends[1::2], strict=True)))


@pytest.mark.longest
def test_the_script_of_walls(tmp_path: Path) -> None:
    entry = walls.main(tmp_path, small=True)
    assert entry.numbers["width of a 3-cell wall after 10 steps"] == pytest.approx(
        2.83, abs=0.005
    )  # the page's own table has 2.83 too
    assert entry.numbers["steps after which a 3-cell wall is gone"] == 25
    assert {path.name for path in tmp_path.iterdir()} == {"walls.png", "walls.json"}
