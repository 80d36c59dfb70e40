"""What smoothing did to a solid: how it hangs together before and after, and what was lost."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.inspection.thickness import thinnest_walls
from infill.kernels.threads import thread_count
from infill.phasefield.profile import STRAIGHT
from infill.phasefield.sparse import SparseField
from infill.surfaces.components import (
    Components,
    cells_of,
    components,
    cores,
    data_bits,
    fate,
    grown,
    opened,
    solid_bits,
    with_thickness,
)
from infill.surfaces.levels import Levelled
from infill.surfaces.sparse_marching import euler_number_of_bits

WALL = 16  # cells: a piece of wall more than one cell thick and smaller than this may go
NAMED = 5  # of the lost walls are told of
FAINT = -0.9  # a component that only so low a level holds would be gone at level 0
ROUNDED = 2  # cells, and as many as the smoothing blurs: how far edges and corners may draw back


@dataclass(frozen=True, kw_only=True)
class Counts:
    """How a solid hangs together.

    Parameters
    ----------
    components, cavities, tunnels : int
        Components of solid, components of void that it encloses, and holes that lead through.
    euler_number : int
        2 (components + cavities - tunnels).
    """

    components: int
    cavities: int
    tunnels: int
    euler_number: int


def verdict(
    found: Levelled,
    before: Components,
    targets: NDArray[np.float64],
    level: float | str,
    steps: int,
    size: tuple[float, ...],
    threads: int | None,
) -> dict[str, Any]:
    """Return what smoothing did, with the problems in plain words."""
    said = STRAIGHT.phase_level if level == "volume" else float
    field, total = found.against, float(targets.sum())
    raw, now = data_bits(field, threads=threads), solid_bits(field, level=found.height, threads=threads)
    core = cores(field, raw, threads=threads)
    thick = opened(field, core, threads=threads)
    with ThreadPoolExecutor(thread_count(threads)) as pool:
        known = pool.submit(with_thickness, field, before)
        after, walls, sturdy, voids, thick_voids, voids_after = pool.map(
            lambda work: components(field, work[0], void=work[1], thickness=work[2]),
            [
                (now, False, False), (core, False, False), (thick, False, False),
                (raw, True, False), (thick, True, True), (now, True, False),
            ],
        )  # fmt: skip
        before = known.result()
    of_components, of_walls, of_voids = fate(before, after), fate(walls, after), fate(thick_voids, voids_after)
    was = _counts(before, voids, euler_number_of_bits(field, raw, threads=threads))
    firm = _counts(sturdy, thick_voids, euler_number_of_bits(field, thick, threads=threads))
    lost = thick & ~grown(field, now, ROUNDED + math.ceil(math.sqrt(2 * steps / 7)), threads=threads)
    shells = found.shells
    held = Counts(
        components=shells.components, cavities=shells.cavities, tunnels=shells.tunnels,
        euler_number=int(shells.euler.sum()),
    )  # fmt: skip
    gone = components(field, lost, whole=False)
    changes = {
        "vanished": int(before.thick[of_components.vanished].sum()),
        "vanished_thin": int((~before.thick[of_components.vanished]).sum()),
        "broken": int((walls.cells[of_walls.broken] >= WALL).sum()),
        "walls_lost": int((gone.cells >= WALL).sum()),
        "faint": int((before.thick & (before.cells >= WALL) & (_levels(found, said) < FAINT)).sum()),
        "walls_pierced": max(0, held.tunnels - max(was.tunnels, firm.tunnels)),
        "voids_joined": len(of_voids.joined),
        "fused": len(of_components.joined),
        "appeared": len(of_components.appeared),
    }
    wall_before, wall_after = thinnest_walls(field, found.surface, size, found.height)
    volume = float(shells.volume.sum())
    return {
        "level": {
            "method": "volume" if level == "volume" else "fixed",
            "common": said(found.common),
            "lowest": said(float(found.levels.min())),
            "highest": said(float(found.levels.max())),
            "components": len(found.levels),
        },
        "data_volume": total,
        "volume_change": volume / total - 1,
        "data": asdict(was),
        "result": asdict(held),
        "changes": changes,
        "thinnest_wall": {"data": wall_before, "result": wall_after},
        "lost": [
            _piece(field, gone, number, size)
            for number in np.argsort(-gone.cells)[:NAMED]
            if gone.cells[number] >= WALL
        ],
        "problems": list(_problems(changes)),
    }


def _levels(found: Levelled, said: Callable[[float], float]) -> NDArray[np.float64]:
    """Return the level of phi of each component."""
    return np.array([said(float(level)) for level in found.levels])


def _piece(field: SparseField, pieces: Components, number: int, size: tuple[float, ...]) -> dict[str, Any]:
    """Return how large a piece is and the middle of it, mm along the axes of the grid from its lower corner."""
    cells = cells_of(field, pieces, number)
    return {"voxels": len(cells), "at": ((cells.mean(axis=0) + 0.5) * size).tolist()}


def _counts(solid: Components, void: Components, euler_number: int) -> Counts:
    """Return the counts of a solid whose void has the outside for its first component."""
    cavities = void.count - 1
    return Counts(
        components=solid.count, cavities=cavities, tunnels=solid.count + cavities - euler_number // 2,
        euler_number=euler_number,
    )  # fmt: skip


def _problems(changes: dict[str, int]) -> Iterator[str]:
    """Say, one phrase each, what was lost that was more than one cell thick."""
    for name, what, words in (
        ("vanished", "{} vanished", ("component", "components")),
        ("broken", "{} fell apart", ("component", "components")),
        ("fused", "{} ran together out of several", ("component", "components")),
        ("walls_lost", "{} vanished", ("wall", "walls")),
        ("walls_pierced", "{} broke through walls", ("hole", "holes")),
        ("voids_joined", "{} between voids broke", ("wall", "walls")),
    ):
        if count := changes[name]:
            yield what.format(f"{count} {words[count > 1]}") + " in smoothing"
