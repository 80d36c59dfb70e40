"""Triply periodic minimal surfaces, by the leading terms of their Fourier series.

Source: von Schnering and Nesper, "Nodal surfaces of Fourier series", Z. Phys. B 83 (1991) 407-412,
doi:10.1007/BF01313411; Neovius and I-WP after Schoen, NASA TN D-5541 (1970).
"""
# mypy: disable-error-code="no-any-return"

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from patterns.unit_cells import Network, Surfaces

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


def _gyroid(x: Floats, y: Floats, z: Floats) -> Floats:
    """Return sin x cos y + sin y cos z + sin z cos x, which is 0 on the surface."""
    from numpy import cos, sin

    return sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x)


def _schwarz_p(x: Floats, y: Floats, z: Floats) -> Floats:
    """Return cos x + cos y + cos z, which is 0 on the surface."""
    from numpy import cos

    return cos(x) + cos(y) + cos(z)


def _schwarz_d(x: Floats, y: Floats, z: Floats) -> Floats:
    """Return the level set of Schwarz' D surface, which is 0 on the surface."""
    from numpy import cos, sin

    return cos(x) * cos(y) * cos(z) - sin(x) * sin(y) * sin(z)


def _fischer_koch_s(x: Floats, y: Floats, z: Floats) -> Floats:
    """Return the level set of Fischer and Koch's S surface, which is 0 on the surface."""
    from numpy import cos, sin

    return cos(2 * x) * sin(y) * cos(z) + cos(x) * cos(2 * y) * sin(z) + sin(x) * cos(y) * cos(2 * z)


def _lidinoid(x: Floats, y: Floats, z: Floats) -> Floats:
    """Return the level set of Lidin's surface, which is 0 on the surface."""
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
    """Return the level set of Neovius' surface, which is 0 on the surface."""
    from numpy import cos

    return 3 * (cos(x) + cos(y) + cos(z)) + 4 * cos(x) * cos(y) * cos(z)


def _i_wp(x: Floats, y: Floats, z: Floats) -> Floats:
    """Return the level set of Schoen's I-WP surface, which is 0 on the surface."""
    from numpy import cos

    return 2 * (cos(x) * cos(y) + cos(y) * cos(z) + cos(z) * cos(x)) - (cos(2 * x) + cos(2 * y) + cos(2 * z))


@dataclass(frozen=True, kw_only=True)
class Gyroid(Surfaces):
    """Walls along Schoen's gyroid."""

    paths: ClassVar[bool] = True

    name: str = "gyroid"
    summary: str = "alike in every direction, prints without support"
    value: Callable[[Floats, Floats, Floats], Floats] = _gyroid


@dataclass(frozen=True, kw_only=True)
class SchwarzP(Surfaces):
    """Walls along Schwarz's primitive surface."""

    paths: ClassVar[bool] = True

    name: str = "schwarz-p"
    summary: str = "round chambers in rows, open in six directions"
    value: Callable[[Floats, Floats, Floats], Floats] = _schwarz_p


@dataclass(frozen=True, kw_only=True)
class SchwarzD(Surfaces):
    """Walls along Schwarz's diamond surface."""

    paths: ClassVar[bool] = True

    name: str = "schwarz-d"
    summary: str = "the surface of diamond; stiff, with narrow channels"
    value: Callable[[Floats, Floats, Floats], Floats] = _schwarz_d


@dataclass(frozen=True, kw_only=True)
class FischerKochS(Surfaces):
    """Walls along the surface S of Fischer and Koch."""

    name: str = "fischer-koch-s"
    summary: str = "winding channels, much surface"
    value: Callable[[Floats, Floats, Floats], Floats] = _fischer_koch_s


@dataclass(frozen=True, kw_only=True)
class Lidinoid(Surfaces):
    """Walls along the lidinoid."""

    name: str = "lidinoid"
    summary: str = "winding channels, the most surface"
    value: Callable[[Floats, Floats, Floats], Floats] = _lidinoid


@dataclass(frozen=True, kw_only=True)
class Neovius(Surfaces):
    """Walls along Neovius's surface."""

    name: str = "neovius"
    summary: str = "chambers with twelve openings; stiff"
    value: Callable[[Floats, Floats, Floats], Floats] = _neovius


@dataclass(frozen=True, kw_only=True)
class IWP(Surfaces):
    """Walls along Schoen's surface I-WP."""

    name: str = "i-wp"
    summary: str = "a wrapped package: chambers along the diagonals"
    value: Callable[[Floats, Floats, Floats], Floats] = _i_wp


# Neovius's surface and the lidinoid have no network: bars along their channels break at usual densities.


@dataclass(frozen=True, kw_only=True)
class GyroidNetwork(Network):
    """One side of `Gyroid`."""

    name: str = "gyroid-network"
    summary: str = "bars that wind, three at every node; prints without support"
    surfaces: Surfaces = Gyroid()
    thinnest: float = 0.02


@dataclass(frozen=True, kw_only=True)
class SchwarzPNetwork(Network):
    """One side of `SchwarzP`."""

    name: str = "schwarz-p-network"
    summary: str = "thick bars along x, y and z that flow into one another"
    surfaces: Surfaces = SchwarzP()
    thinnest: float = 0.08


@dataclass(frozen=True, kw_only=True)
class SchwarzDNetwork(Network):
    """One side of `SchwarzD`."""

    name: str = "schwarz-d-network"
    summary: str = "the bars of diamond, as if cast"
    surfaces: Surfaces = SchwarzD()
    thinnest: float = 0.04


@dataclass(frozen=True, kw_only=True)
class FischerKochSNetwork(Network):
    """One side of `FischerKochS`."""

    name: str = "fischer-koch-s-network"
    summary: str = "many thin winding bars"
    surfaces: Surfaces = FischerKochS()
    thinnest: float = 0.06


@dataclass(frozen=True, kw_only=True)
class IWPNetwork(Network):
    """One side of `IWP`."""

    name: str = "i-wp-network"
    summary: str = "bars to the corners of a cube, as if cast"
    surfaces: Surfaces = IWP()
    side: int = -1
    thinnest: float = 0.04
