"""How noisy a solid is: the kernel beside its specification, and what the share is of noise and of smooth solids."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from infill.kernels.noise import count_overruled
from infill.voxels.noise import NOISY, count_overruled_cells, noise_share, work_shape


@pytest.mark.slow
@given(
    shape=st.tuples(st.integers(1, 9), st.integers(1, 7), st.integers(1, 40)),
    share=st.sampled_from([0.0, 0.05, 0.5, 1.0]),
    seed=st.integers(0, 99),
)
def test_the_kernel_counts_what_the_specification_counts(shape: tuple[int, int, int], share: float, seed: int) -> None:
    slab = np.random.default_rng(seed).random(shape) < share
    counts = np.zeros(3, dtype=np.int64)
    inner = (0, slab.shape[1], 0, slab.shape[2])
    count_overruled(slab.view(np.uint8), np.empty(work_shape(slab), dtype=np.uint8), inner, counts)
    assert tuple(counts) == count_overruled_cells(slab)


@pytest.mark.parametrize("order", ["C", "F"])
def test_noise_is_noisy_and_a_slanted_face_is_not(order: str) -> None:
    smooth = np.indices((40, 40, 40)).sum(axis=0) < 60
    flipped = smooth ^ (np.random.default_rng(1).random(smooth.shape) < 0.1)
    assert noise_share(np.asarray(smooth, order=order)) < 0.1
    assert noise_share(np.asarray(flipped, order=order)) > NOISY
    assert noise_share(np.asarray(flipped, order=order), threads=1) == noise_share(flipped, threads=3)


def test_a_surface_of_a_few_cells_shows_nothing() -> None:
    assert noise_share(np.random.default_rng(2).random((4, 4, 4)) < 0.5) == 0.0
