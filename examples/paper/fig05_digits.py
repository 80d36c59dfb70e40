"""Fig. 5: the digits 2, 3 and 5 as mosaics of 64 x 64 cells, smoothed for five steps.

python -m examples.paper.fig05_digits [folder] [--small]
"""

from pathlib import Path

from examples.paper import shapes
from examples.paper.entry import Entry, run
from examples.paper.outlines import LAM, STEPS, compare, told


def main(folder: Path, *, small: bool = False) -> Entry:
    """Smooth the digits and compare the contours with the glyphs."""
    n = 32 if small else 64
    h = 2 / n
    glyphs = {digit: shapes.glyph(digit, n) for digit in "235"}
    digits = {digit: (outline, shapes.covered(outline, n)) for digit, outline in glyphs.items()}
    rows, numbers = compare(digits, h, folder / "fig05.png")
    return Entry(
        name="fig05",
        title="Fig. 5: digits",
        setting=(
            f"DejaVu Sans Bold (the paper's is not known), {n} × {n} cells, h = {h:g}, λ = {LAM}, ε₂, {STEPS} steps. "
            "Choi: dt = 100 h², λh² = 1, ε = h, 10 steps."
        ),
        rows=rows,
        sentence=told(numbers, digits),
        numbers=numbers,
    ).save(folder)


if __name__ == "__main__":
    run(main)
