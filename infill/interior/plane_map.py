"""Coordinates in a plane in which cells of one size follow a field of scales, and are as round as that allows.

As in `infill.interior.conformal_map`, coordinates come nearest to wanted slopes in the sense of least squares. In a
plane the wanted slope may turn too: s R, where s is the scale and R the turn of the coordinates themselves. Both are
corrected in turn: R to the turn that the coordinates have, s until there is as much line in an area as the field asks
for. Where the field allows it, cells become as round as those of a conformal map: lines fan out.

Source: O. Sorkine, M. Alexa, "As-rigid-as-possible surface modeling", 2007, sections 2 and 3, with scales.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from infill.arrays import Floats
from infill.interior.conformal_map import (
    extrapolate_nodes,
    fit_without_folds,
    solve_poisson,
    spline_jacobians,
    step_divergence,
    wall_density_factor,
)

ROUNDS = 16  # of corrections; after these, the line in an area stays within half a hundredth
RELAXED = 1.7  # power of a correction: each takes effect by about half, as neighbours pull back
MOST = 10.0  # largest correction of a scale, up or down, as a factor


def fit_plane_map(scales: Floats, normals: Floats | None = None) -> tuple[Floats, Floats]:
    """Compute coordinates in which cells follow scales; return them and the resulting increase of line.

    Parameters
    ----------
    scales : (n, m) float64
        At nodes one apart, two or more along each axis: factor of the line in an area.
    normals : (N, 2) float64, optional
        Directions across the lines of the pattern, each for an equal share of line; without them, all alike.

    Returns
    -------
    coordinates : (n + 2, m + 2, 2) float64
        The coefficients of a cubic spline, as `infill.interior.conformal_map.map_points` takes them, in nodes. The node
        in the middle stays where it is, and its surroundings are not turned.
    more : (n, m) float64
        Factor of the line in an area.

    Notes
    -----
    Where scales change so quickly that cells would fold over each other, the scales are evened out until no cell folds.
    """
    return fit_without_folds(scales, partial(_fit_coordinates, normals=normals))


def _fit_coordinates(targets: Floats, normals: Floats | None) -> tuple[Floats, Floats, Floats]:
    """Fit a spline to wanted factors of line; return its coefficients, slopes and the factors reached."""
    scales, cosine, sine = targets, np.ones_like(targets), np.zeros_like(targets)
    for _ in range(ROUNDS):
        along, across = scales * cosine, scales * sine
        rises = [
            step_divergence(along, 0) - step_divergence(across, 1),
            step_divergence(across, 0) + step_divergence(along, 1),
        ]
        coordinates = extrapolate_nodes(solve_poisson(rises))
        slopes = spline_jacobians(coordinates)
        more = wall_density_factor(slopes, normals)
        turn = np.arctan2(slopes[..., 1, 0] - slopes[..., 0, 1], slopes[..., 0, 0] + slopes[..., 1, 1])
        turn -= turn[tuple(count // 2 for count in turn.shape)]
        cosine, sine = np.cos(turn), np.sin(turn)
        scales = np.clip(scales * (targets / more) ** RELAXED, targets / MOST, targets * MOST)
    return coordinates, slopes, more
