"""A script in front of a slicer: try cells until the block has the density that was asked for.

python examples/03_before_the_slicer.py [folder]
"""

import sys
from pathlib import Path

from infill import make


def main(folder: Path, density: float = 0.2) -> float:
    """Write the block that comes nearest to `density`, and return its own density."""
    blocks = (make("honeycomb", size=30, height=4, cell=cell, stamp="exact") for cell in (3, 4, 5, 6, 8))
    best = min(blocks, key=lambda block: abs(block.report["density"] - density))
    best.save(folder / "block.stl")
    return float(best.report["density"])


if __name__ == "__main__":
    print(f"{main(Path(sys.argv[1] if len(sys.argv) > 1 else '.')):.1%}")
