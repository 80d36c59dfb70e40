"""Triply periodic minimal surfaces, by the leading terms of their Fourier series.

Source: von Schnering and Nesper, "Nodal surfaces of Fourier series", Z. Phys. B 83 (1991) 407-412,
doi:10.1007/BF01313411; Neovius and I-WP after Schoen, NASA TN D-5541 (1970).
"""
# mypy: disable-error-code="no-any-return"

from __future__ import annotations

from typing import TYPE_CHECKING

from patterns.unit_cells import Network, Surfaces

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


def _gyroid(x: Floats, y: Floats, z: Floats) -> Floats:
    from numpy import cos, sin

    return sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x)


def _schwarz_p(x: Floats, y: Floats, z: Floats) -> Floats:
    from numpy import cos

    return cos(x) + cos(y) + cos(z)


def _schwarz_d(x: Floats, y: Floats, z: Floats) -> Floats:
    from numpy import cos, sin

    return cos(x) * cos(y) * cos(z) - sin(x) * sin(y) * sin(z)


def _fischer_koch_s(x: Floats, y: Floats, z: Floats) -> Floats:
    from numpy import cos, sin

    return cos(2 * x) * sin(y) * cos(z) + cos(x) * cos(2 * y) * sin(z) + sin(x) * cos(y) * cos(2 * z)


def _lidinoid(x: Floats, y: Floats, z: Floats) -> Floats:
    from numpy import cos, sin

    return (
        sin(2 * x) * cos(y) * sin(z)
        + sin(2 * y) * cos(z) * sin(x)
        + sin(2 * z) * cos(x) * sin(y)
        - cos(2 * x) * cos(2 * y)
        - cos(2 * y) * cos(2 * z)
        - cos(2 * z) * cos(2 * x)
        + 0.3
    )


def _neovius(x: Floats, y: Floats, z: Floats) -> Floats:
    from numpy import cos

    return 3 * (cos(x) + cos(y) + cos(z)) + 4 * cos(x) * cos(y) * cos(z)


def _i_wp(x: Floats, y: Floats, z: Floats) -> Floats:
    from numpy import cos

    return 2 * (cos(x) * cos(y) + cos(y) * cos(z) + cos(z) * cos(x)) - (cos(2 * x) + cos(2 * y) + cos(2 * z))


GYROID = Surfaces(name="gyroid", summary="alike in every direction, prints without support", value=_gyroid)
SCHWARZ_P = Surfaces(name="schwarz-p", summary="round chambers in rows, open in six directions", value=_schwarz_p)
SCHWARZ_D = Surfaces(name="schwarz-d", summary="the surface of diamond; stiff, with narrow channels", value=_schwarz_d)
FISCHER_KOCH_S = Surfaces(name="fischer-koch-s", summary="winding channels, much surface", value=_fischer_koch_s)
LIDINOID = Surfaces(name="lidinoid", summary="winding channels, the most surface", value=_lidinoid)
NEOVIUS = Surfaces(name="neovius", summary="chambers with twelve openings; stiff", value=_neovius)
I_WP = Surfaces(name="i-wp", summary="a wrapped package: chambers along the diagonals", value=_i_wp)

TPMS = (GYROID, SCHWARZ_P, SCHWARZ_D, FISCHER_KOCH_S, LIDINOID, NEOVIUS, I_WP)


def _network(surfaces: Surfaces, summary: str, *, thinnest: float, side: int = 1) -> Network:
    name = f"{surfaces.name}-network"
    return Network(name=name, summary=summary, surfaces=surfaces, side=side, thinnest=thinnest)


# Neovius's surface and the lidinoid have no network: bars along their channels break at usual densities.
NETWORKS = (
    _network(GYROID, "bars that wind, three at every node; prints without support", thinnest=0.02),
    _network(SCHWARZ_P, "thick bars along x, y and z that flow into one another", thinnest=0.08),
    _network(SCHWARZ_D, "the bars of diamond, as if cast", thinnest=0.04),
    _network(FISCHER_KOCH_S, "many thin winding bars", thinnest=0.06),
    _network(I_WP, "bars to the corners of a cube, as if cast", thinnest=0.04, side=-1),
)
