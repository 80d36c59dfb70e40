"""Signed distance from a surface known by points and normals: `infill.voxels.point_fields` for many places.

Points are sorted by the bin they lie in, so that those near a place are found in the 27 bins around it.
"""
# mypy: disable-error-code="no-untyped-def"
# ruff: noqa: ANN001, ANN201
# Compiled lines are invisible to coverage tools.

from __future__ import annotations

import math

from infill.kernels.compiling import njit


@njit(nogil=True, cache=True, error_model="numpy")
def signed_distances(
    places, points, normals, bin_start, shape, sigma, reach, sharpness, passes, distances, thread, threads
):
    """Set the distance of each place from the surface of the points: negative inside, NaN where all points are far.

    Parameters
    ----------
    places : (M, 3) int32
        Cells; the centre of the first is 0.
    points, normals : (N, 3) float64
        In cells, sorted by their bin; bins are `reach` wide, and the first begins at -`reach`.
    bin_start : (B + 1,) int64
        First point of each bin.
    shape : (3,) int64
        Bins along each axis.
    sigma, reach : float
        Standard deviation of the weights, and the distance up to which points count, cells.
    sharpness, passes
        See `infill.voxels.point_fields.distance_from_points`.
    distances : (M,) float32
    """
    for m in range(thread, len(places), threads):
        x, y, z = float(places[m, 0]), float(places[m, 1]), float(places[m, 2])
        mx = my = mz = total = 0.0
        distance = math.nan
        for turn in range(passes + 1):
            length = math.sqrt(mx * mx + my * my + mz * mz)
            if turn > 0:
                if length == 0.0:
                    distance = math.nan
                    break
                mx, my, mz = mx / length, my / length, mz / length
            nx = ny = nz = total = summed = 0.0
            bx, by, bz = int(x / reach) + 1, int(y / reach) + 1, int(z / reach) + 1
            for i in range(max(0, bx - 1), min(shape[0], bx + 2)):
                for j in range(max(0, by - 1), min(shape[1], by + 2)):
                    row = (i * shape[1] + j) * shape[2]
                    begin = bin_start[row + min(shape[2], max(0, bz - 1))]
                    end = bin_start[row + min(shape[2], bz + 2)]
                    for p in range(begin, end):
                        dx, dy, dz = x - points[p, 0], y - points[p, 1], z - points[p, 2]
                        squared = dx * dx + dy * dy + dz * dz
                        if squared > reach * reach:
                            continue
                        ax, ay, az = normals[p, 0], normals[p, 1], normals[p, 2]
                        exponent = squared / (2.0 * sigma * sigma)
                        if turn > 0:
                            squared_offset = (ax - mx) ** 2 + (ay - my) ** 2 + (az - mz) ** 2
                            exponent += squared_offset / (sharpness * sharpness)
                        weight = math.exp(-exponent)
                        total += weight
                        nx, ny, nz = nx + weight * ax, ny + weight * ay, nz + weight * az
                        summed += weight * ((ax + mx) * dx + (ay + my) * dy + (az + mz) * dz) / 2.0
            if total == 0.0:
                break
            if turn > 0:
                distance = summed / total
            mx, my, mz = nx, ny, nz
        distances[m] = distance
