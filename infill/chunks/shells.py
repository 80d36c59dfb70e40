"""The shells of the whole surface from the pieces of its chunks: joined where pieces share a vertex."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from infill.chunks.level_parts import LevelParts
from infill.errors import GeometryError
from infill.graph import label_connected
from infill.kernels.chunk_sums import HIGH, LOW

Numbers = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class JoinedShells:
    """The connected parts of the whole surface.

    Parameters
    ----------
    names : mapping of int to (s,) int32
        For each chunk, the shell of the whole that each of its parts belongs to.
    volume, slope : (n,) float64
        Volume of each shell, mm³, and its change when the level rises by one.
    euler : (n,) int64
        Euler number of each shell.
    total : (float, float)
        Volume and slope of all.
    """

    names: Mapping[int, NDArray[np.int32]]
    volume: NDArray[np.float64]
    slope: NDArray[np.float64]
    euler: Numbers
    total: tuple[float, float]


def join_shells(parts: Mapping[int, LevelParts], cell_volume: float) -> JoinedShells:
    """Join the parts of all chunks to shells, and sum their measures, in whole numbers: in any order, the same.

    Raises
    ------
    GeometryError
        If a piece takes a vertex that no chunk has.
    """
    begins, total = {}, 0
    for number, part in parts.items():
        begins[number] = total
        total += len(part.shells.sums)
    shared, shared_node = _gather(parts, begins, "shared")
    foreign, foreign_node = _gather(parts, begins, "foreign")
    used = shared_node >= 0
    shared, shared_node = shared[used], shared_node[used]
    at = find_names(shared, foreign)
    joined, count = label_connected(foreign_node, shared_node[at], total)
    high, low = np.zeros((count, 2), dtype=np.int64), np.zeros((count, 2), dtype=np.int64)
    corners, faces = np.zeros(count, dtype=np.int64), np.zeros(count, dtype=np.int64)
    names = {}
    for number, part in parts.items():
        own = joined[begins[number] : begins[number] + len(part.shells.sums)]
        names[number] = own
        np.add.at(high, own, part.shells.sums[:, ::2])
        np.add.at(low, own, part.shells.sums[:, 1::2])
        np.add.at(corners, own, part.shells.vertices)
        np.add.at(faces, own, part.shells.faces)
    volume, slope = (
        np.array(
            [_sum_of(a, b) for a, b in zip(high[:, n].tolist(), low[:, n].tolist(), strict=True)], dtype=np.float64
        )
        for n in range(2)
    )
    whole = [_sum_of(sum(high[:, n].tolist()), sum(low[:, n].tolist())) for n in range(2)]
    scale = cell_volume / 6
    return JoinedShells(
        names=names,
        volume=volume * scale,
        slope=slope * scale,
        euler=corners - faces // 2,
        total=(whole[0] * scale, whole[1] * scale),
    )


def _gather(parts: Mapping[int, LevelParts], begins: Mapping[int, int], kind: str) -> tuple[Numbers, Numbers]:
    """Gather the names of vertices of all chunks and the nodes of their parts, -1 for none."""
    nothing = np.empty(0, dtype=np.int64)
    names = np.concatenate([nothing, *(getattr(part, kind) for part in parts.values())])
    nodes = [nothing]
    for number, part in parts.items():
        inside = getattr(part, f"{kind}_in").astype(np.int64)
        nodes.append(np.where(inside >= 0, inside + begins[number], -1))
    return names, np.concatenate(nodes)


def find_names(names: Numbers, queries: Numbers) -> Numbers:
    """Return the places of names among known ones; raise GeometryError if one is missing."""
    order = np.argsort(names, kind="stable")
    at = np.searchsorted(names, queries, sorter=order)
    beyond = len(queries) > 0 and (len(names) == 0 or bool((at == len(names)).any()))
    if beyond or (names[order[at]] != queries).any():
        raise GeometryError("two pieces of the surface do not meet between their chunks; the input changed meanwhile")
    places: Numbers = order[at] if len(queries) else np.empty(0, dtype=np.int64)
    return places


def _sum_of(high: int, low: int) -> float:
    """Return the number that two sums of whole numbers stand for."""
    return ((high << LOW) + low) / (1 << (HIGH + LOW))
