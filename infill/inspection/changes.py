"""The terms for changes by smoothing, the same for a block of infill and for a solid."""

from __future__ import annotations

from dataclasses import asdict, dataclass


@dataclass(frozen=True, kw_only=True)
class ConnectionCounts:
    """The connections of a solid.

    Parameters
    ----------
    components, cavities, tunnels : int
        Components of solid, components of void that it encloses, and holes that pass through it.
    euler_number : int
        Euler number of its surface: 2 (components + cavities - tunnels).
    """

    components: int
    cavities: int
    tunnels: int
    euler_number: int

    @classmethod
    def of(cls, *, components: int, cavities: int, tunnels: int) -> ConnectionCounts:
        """Build the counts, with the matching Euler number.

        >>> ConnectionCounts.of(components=1, cavities=0, tunnels=1).euler_number
        0
        """
        euler_number = 2 * (components + cavities - tunnels)
        return cls(components=components, cavities=cavities, tunnels=tunnels, euler_number=euler_number)


@dataclass(frozen=True, kw_only=True)
class TopologyChanges:
    """Changes of the components of solid and void by smoothing.

    Parameters
    ----------
    vanished : int
        Components of solid that disappeared entirely; for a solid, only those more than one cell thick.
    broken : int
        Components of solid that fell apart; for a solid, its walls more than one cell thick instead.
    fused : int
        Components of solid that ran together.
    appeared : int
        Components of solid where there was none before.
    voids_closed : int
        Voids that are gone; for a solid, only those more than one cell wide.
    voids_cut : int
        Voids cut in two by walls that met across them.
    voids_joined : int
        Voids that merged because the wall between them broke.
    walls_pierced : int
        Holes that broke through walls.
    walls_lost, faint, vanished_thin : int, optional
        For a solid: pieces of wall more than one cell thick that were lost, components that exist only at a very low
        level, and components only one cell thick that disappeared entirely.
    pinholes : int, optional
        For a block: voids that were closed or cut where they were too narrow to print anything in. See
        `infill.inspection.layers`.
    pinhole_share : float, optional
        For a block: the cells of the pinholes over the cells of all holes.
    """

    vanished: int = 0
    broken: int = 0
    fused: int = 0
    appeared: int = 0
    voids_closed: int = 0
    voids_cut: int = 0
    voids_joined: int = 0
    walls_pierced: int = 0
    walls_lost: int | None = None
    faint: int | None = None
    vanished_thin: int | None = None
    pinholes: int | None = None
    pinhole_share: float | None = None

    def facts(self) -> dict[str, int | float]:
        """Return the measurements by name."""
        return {name: value for name, value in asdict(self).items() if value is not None}
