"""Strut lattices: round bars between the nodes of a unit cell."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass

from patterns.unit_cells import Bars

Node = tuple[float, float, float]
Edge = tuple[Node, Node]


def _edges_between(nodes: Iterable[Node], end_nodes: Iterable[Node], length: float) -> tuple[Edge, ...]:
    """Return the edges of a length between two sets of nodes, each once."""
    edges = {
        tuple(sorted((a, b)))
        for a, b in itertools.product(nodes, end_nodes)
        if math.isclose(math.dist(a, b), length, abs_tol=1e-9)
    }
    return tuple(sorted((a, b) for a, b in edges))


CORNERS: tuple[Node, ...] = tuple((float(x), float(y), float(z)) for x, y, z in itertools.product((0, 1), repeat=3))
CENTRE: Node = (0.5, 0.5, 0.5)
FACES: tuple[Node, ...] = tuple(
    (float(x), float(y), float(z))
    for axis in range(3)
    for side in (0.0, 1.0)
    for x, y, z in [tuple(side if a == axis else 0.5 for a in range(3))]
)
QUARTERS: tuple[Node, ...] = ((0.25, 0.25, 0.25), (0.75, 0.75, 0.25), (0.75, 0.25, 0.75), (0.25, 0.75, 0.75))
# The corners of truncated octahedra about the corners and the centre of a cell: 0, 1/4 and 1/2, in any order.
OCTAHEDRON: tuple[Node, ...] = tuple(
    sorted(
        {
            (0.5 + a * signs[0], 0.5 + b * signs[1], 0.5 + c * signs[2])
            for a, b, c in itertools.permutations((0.0, 0.25, 0.5))
            for signs in itertools.product((-1, 1), repeat=3)
        }
    )
)


@dataclass(frozen=True, kw_only=True)
class CubicBars(Bars):
    """Bars along the edges of cubes."""

    name: str = "cubic-bars"
    summary: str = "bars along x, y and z"
    edges: tuple[Edge, ...] = (((0, 0, 0), (1, 0, 0)), ((0, 0, 0), (0, 1, 0)), ((0, 0, 0), (0, 0, 1)))


@dataclass(frozen=True, kw_only=True)
class Octet(Bars):
    """Bars along the edges of octahedra and tetrahedra."""

    name: str = "octet"
    summary: str = "octahedra and tetrahedra: bars without a soft direction"
    edges: tuple[Edge, ...] = _edges_between((*CORNERS, *FACES), FACES, math.sqrt(0.5))


@dataclass(frozen=True, kw_only=True)
class BCC(Bars):
    """Bars of a body-centred cube."""

    name: str = "bcc"
    summary: str = "bars to the corners of a cube"
    edges: tuple[Edge, ...] = _edges_between(CORNERS, [CENTRE], math.sqrt(0.75))


@dataclass(frozen=True, kw_only=True)
class FCC(Bars):
    """Bars of a face-centred cube."""

    name: str = "fcc"
    summary: str = "bars across the faces of a cube"
    edges: tuple[Edge, ...] = _edges_between(CORNERS, FACES, math.sqrt(0.5))


@dataclass(frozen=True, kw_only=True)
class Diamond(Bars):
    """Bars as atoms in diamond are bound."""

    name: str = "diamond"
    summary: str = "four bars at every node; soft, and prints without support"
    edges: tuple[Edge, ...] = _edges_between((*CORNERS, *FACES), QUARTERS, math.sqrt(3) / 4)


@dataclass(frozen=True, kw_only=True)
class Kelvin(Bars):
    """Bars along the edges of truncated octahedra."""

    name: str = "kelvin"
    summary: str = "truncated octahedra, as foam has them"
    edges: tuple[Edge, ...] = _edges_between(OCTAHEDRON, OCTAHEDRON, math.sqrt(0.125))
