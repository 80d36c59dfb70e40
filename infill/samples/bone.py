"""The sample scan: a bone of a finger in grey values such as those of computed tomography."""

from __future__ import annotations

import numpy as np

from infill.arrays import Floats
from infill.volume import Volume

SHAPE = (56, 50, 96)  # voxels
SPACING = (0.45, 0.45, 0.5)  # mm
# Hounsfield units.
AIR, FLESH, MARROW, SPONGY, DENSE = -1000.0, 50.0, -40.0, 420.0, 1150.0
NOISE = 20.0  # standard deviation, HU
SEED = 226  # of the noise
LENGTH = 40.0  # mm, of the bone
# Half the width of the bone along its length, mm, from its base to its head.
PLACES = (0.0, 4.0, 9.0, 15.0, 22.0, 29.0, 34.0, 38.0, 40.0)
HALF_WIDTHS = (6.2, 7.6, 6.6, 5.2, 4.6, 4.9, 5.9, 5.6, 4.2)
FLATNESS = 0.82  # depth of the bone per width
SHELL = 2.0  # mm, thickness of the dense outside
CAVITY = (11.0, 29.0)  # mm along the bone, between which it holds marrow
FINGER = 10.5  # mm, half the width of the finger


def bone_scan() -> Volume:
    """Make a scan of a finger's bone, 25 x 22 x 48 mm, in which everything from 226 HU upwards is bone.

    Returns
    -------
    Volume
        (56, 50, 96) int16, Hounsfield units: air, flesh, dense bone outside, spongy bone at both ends, and marrow.
        Voxels are 0.45 x 0.45 x 0.5 mm. Noise is the same every time.

    >>> scan = bone_scan()
    >>> scan.values.shape, scan.values.dtype, scan.space
    ((56, 50, 96), dtype('int16'), 'LPS')
    """
    corner = -np.array(SHAPE) * SPACING / 2
    x, y, z = np.meshgrid(
        *(low + (np.arange(n) + 0.5) * h for low, n, h in zip(corner, SHAPE, SPACING, strict=True)), indexing="ij"
    )
    along = z + LENGTH / 2
    depth = _depth(x, y, along)
    values = np.full(SHAPE, AIR)
    values = _blend(values, FLESH, FINGER - np.hypot(x, y / 0.92))
    values = _blend(values, DENSE, depth)
    values = _blend(values, SPONGY, depth - SHELL)
    values = _blend(values, MARROW, np.minimum(depth - SHELL, np.minimum(along - CAVITY[0], CAVITY[1] - along)))
    values += np.random.default_rng(SEED).normal(0.0, NOISE, SHAPE)
    return Volume(
        values=np.clip(values.round(), -1024, 3071).astype(np.int16),
        spacing=SPACING,
        origin=tuple(corner.tolist()),
        space="LPS",
    )


def _depth(x: Floats, y: Floats, along: Floats) -> Floats:
    """Return the approximate depth below the surface of the bone, mm, negative outside of it."""
    from scipy.interpolate import PchipInterpolator

    half = PchipInterpolator(PLACES, HALF_WIDTHS)(np.clip(along, PLACES[0], PLACES[-1]))
    shaft = half - np.hypot(x, y / FLATNESS)
    shaft = np.minimum(shaft, np.minimum(along, LENGTH - along))
    knuckles = [4.3 - np.sqrt((x - side) ** 2 + y**2 + (along - LENGTH + 4.0) ** 2) for side in (-2.8, 2.8)]
    socket = 9.0 - np.sqrt(x**2 + y**2 + (along + 7.6) ** 2)
    return np.minimum(np.maximum(shaft, np.maximum(*knuckles)), -socket)


def _blend(values: Floats, inner: float, depth: Floats) -> Floats:
    """Return the values with another one below a surface; across the surface they change within two voxels."""
    share = np.clip(0.5 + depth / (2 * max(SPACING)), 0.0, 1.0)
    return values + share * (inner - values)
