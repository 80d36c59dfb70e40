"""The words for what smoothing changed, the same for a block of infill and for a solid."""

from __future__ import annotations

from dataclasses import asdict, dataclass


@dataclass(frozen=True, kw_only=True)
class Counts:
    """How a solid hangs together.

    Parameters
    ----------
    components, cavities, tunnels : int
        Components of solid, components of void that it encloses, and holes that lead through.
    euler_number : int
        Of its surface: 2 (components + cavities - tunnels).
    """

    components: int
    cavities: int
    tunnels: int
    euler_number: int

    @classmethod
    def of(cls, *, components: int, cavities: int, tunnels: int) -> Counts:
        """Return the counts with the Euler number that goes with them.

        >>> Counts.of(components=1, cavities=0, tunnels=1).euler_number
        0
        """
        euler_number = 2 * (components + cavities - tunnels)
        return cls(components=components, cavities=cavities, tunnels=tunnels, euler_number=euler_number)


@dataclass(frozen=True, kw_only=True)
class Changes:
    """What smoothing did to the components of solid and of void.

    Parameters
    ----------
    vanished : int
        Components of solid of which nothing is left; of a solid, those more than one cell thick.
    broken : int
        Components of solid, or of a solid its walls more than one cell thick, that fell apart.
    fused : int
        Components of solid that ran together.
    appeared : int
        Components of solid where there was none.
    voids_closed : int
        Voids that are gone; of a solid, those more than one cell wide.
    voids_cut : int
        Voids that walls which met across them cut in two.
    voids_joined : int
        Voids that ran together, because the wall between them broke.
    walls_pierced : int
        Holes that broke through walls.
    walls_lost, faint, vanished_thin : int, optional
        Of a solid: pieces of wall more than one cell thick that are gone, components that only a very low level
        holds, and components no more than one cell thick of which nothing is left.
    pinholes : int, optional
        Of a block: voids that are gone or cut and so narrow that nothing could be printed in them. See
        `infill.inspection.layers`.
    pinhole_share : float, optional
        Of a block: cells of those over the cells of all holes.
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
        """Return what was measured, by name."""
        return {name: value for name, value in asdict(self).items() if value is not None}
