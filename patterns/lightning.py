"""Lightning: walls only where a roof needs them, which lean to the nearest wall like branches to their trunk."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from patterns.cellular import Cells
from patterns.shared import overhang_parameter


@dataclass(frozen=True, kw_only=True)
class Lightning(Cells):
    """Upright walls under roofs: branches that end at the walls of the part, and whose lower edges rise to their tips.

    Below every roof there are twigs about a cell apart. Each goes to the nearest branch or wall; further down, tips
    recede along their branch, as far as printed walls may lean out.

    Parameters
    ----------
    name, summary, cell
        See `Cells`.
    overhang : float
        Degrees from upright that lower edges lean; a steeper surface does not count as a roof.
    first : (x, y)
        Place of the first twig, in cells: not in the middle of a part, equally far from opposite walls.
    cells : int
        A period, in cells: a power of 2. Twigs at whole multiples of it come first, then those between them at halves,
        and so on, so that few branches are long.

    Notes
    -----
    Source: Tricard, Claux and Lefebvre, "Ribbed support vaults for 3D printing of hollowed objects", Computer
    Graphics Forum 39 (2020) 147-159, whose ribs also lean from their load to existing walls.
    """

    repeats: ClassVar[bool] = False
    paths: ClassVar[bool] = True
    cells: ClassVar[int] = 8

    name: str = "lightning"
    summary: str = "branches below roofs alone, which lean to the walls: carries tops with the least material"
    first: tuple[float, float] = (0.3, 0.2)
    overhang: float = overhang_parameter()
