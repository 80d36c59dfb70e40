"""What holds infill together is measured as it is: by prints of which it is known."""

from __future__ import annotations

import pytest

from tests.gcode_structure import bonded, supported
from tests.handmade_prints import LAYER, PER_MM, SPACING, Dialect, written


def lines(*layers: list[float]) -> bytes:
    """Layers of parallel lines of infill, 20 mm long, at these places."""
    text = ["M83", "G90"]
    for n, places in enumerate(layers, 1):
        text += [";LAYER_CHANGE", f"G1 Z{n * LAYER:.2f} F9000", ";TYPE:Internal infill", ";WIDTH:0.45"]
        for y in places:
            text += [f"G1 X0 Y{y:.3f} F9000", f"G1 X20 Y{y:.3f} E{20 * PER_MM:.5f} F3000"]
    return "\n".join([*text, ";TYPE:Custom", ""]).encode()


@pytest.mark.parametrize(
    ("aside", "share"),
    [(0.0, 1.0), (0.2, 1.0), (0.25, 0.0)],
)
def test_a_line_is_supported_where_its_middle_lies_on_a_bead(aside: float, share: float) -> None:
    """A bead is 0.225 mm wide to each side; the first layer lies on nothing, and does not count."""
    assert supported(lines([0.0], [aside])) == pytest.approx(share, abs=0.03)  # 0.6 mm: round ends


def test_crossing_lines_are_supported_where_they_cross() -> None:
    along = lines([0.0, 5.0, 10.0, 15.0])
    across = b"G1 X10 Y-5 F9000\nG1 X10 Y20 E.8 F3000\n"
    data = along.replace(b";TYPE:Custom", b";LAYER_CHANGE\nG1 Z.4\n;TYPE:Internal infill\n" + across + b";TYPE:Custom")
    assert supported(data) == pytest.approx(4 * 0.45 / 25, rel=0.02)


@pytest.mark.parametrize("chords", [1, 200])
def test_every_bead_has_its_own_width_however_it_is_cut(chords: int) -> None:
    """Below: infill 0.3 mm wide, of which half is cut into chords, and a wall 0.6 mm wide; above, lines 0.2 mm aside."""
    text = ["M83", "G90", ";LAYER_CHANGE", "G1 Z0.2 F9000", ";TYPE:Internal infill", ";WIDTH:0.3", "G1 X0 Y0 F9000"]
    text += [f"G1 X{20 * (k + 1) / chords:.3f} Y0 E{0.5 / chords:.5f} F3000" for k in range(chords)]
    text += [";TYPE:External perimeter", ";WIDTH:0.6", "G1 X0 Y5 F9000", "G1 X20 Y5 E1"]
    text += [";LAYER_CHANGE", "G1 Z0.4", ";TYPE:Internal infill", ";WIDTH:0.3"]
    for y in (0.2, 5.2):
        text += [f"G1 X0 Y{y} F9000", f"G1 X20 Y{y} E.5"]
    assert supported("\n".join([*text, ";TYPE:Custom", ""]).encode()) == pytest.approx(0.5, abs=0.01)


@pytest.mark.parametrize(("apart", "share"), [(SPACING, 1.0), (0.46, 1.0), (0.5, 0.0)])
def test_lines_are_bonded_where_they_touch(apart: float, share: float) -> None:
    assert bonded(lines([0.0, apart])) == share


def test_a_print_that_repeats_is_supported() -> None:
    data = written(Dialect(layers=5))
    assert supported(data) > 0.999
    assert bonded(data) < 0.02
