"""What `keep` leaves of a print: gaps, filament and touch, found by means of their own in sliced prints."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from infill import refill
from infill.refilling.support import LEAST_LENGTH
from infill.refilling.widest_gap import MOST_GROWTH
from tests.gap_judge import PIXEL, filament, touching_walls, widest_gaps
from tests.prints import box, cura_print, prusa_print
from tests.slicers import missing_cura, missing_prusa

# Chords and curves that are cut anew may add this to the way of a path, mm.
CUT = 0.03
# Of the length that touches walls: an arc takes 1.5 % of what touches beside its corner. Where infill touches them with
# little more than corners, chords and numbers of three decimals take some as well.
LEAST_TOUCH = 0.975
PRUSA = ("concentric", "octagramspiral", "hilbertcurve", "grid", "honeycomb", "rectilinear")
CURA: Mapping[str, Mapping[str, object]] = {
    "concentric": {},
    "cross": {},
    "grid": {"infill_line_distance": 4.5, "zig_zaggify_infill": "true"},
}


def sliced(engine: str, pattern: str, density: int, folder: Path) -> Path:
    part, path = box(folder, (30, 30, 1.4)), folder / "print.gcode"
    if engine == "prusa":
        # Not a board of 8 bits, whose paths have fewer segments and touch the walls a little less.
        skins = {"top_solid_layers": 2, "bottom_solid_layers": 2, "gcode_flavor": "marlin2"}
        return prusa_print(part, path, {"fill_pattern": pattern, "fill_density": f"{density}%", **skins})
    skins = {"top_layers": 2, "bottom_layers": 2, "initial_bottom_layers": 2}
    apart = round(45 / density, 3)
    return cura_print(part, path, {"infill_pattern": pattern, "infill_line_distance": apart, **skins, **CURA[pattern]})


CASES = [("prusa", pattern, density) for pattern in PRUSA for density in (20,)]
CASES += [("prusa", "octagramspiral", 40), ("prusa", "3dhoneycomb", 40), ("prusa", "concentric", 10)]
CASES += [("cura", pattern, 20) for pattern in CURA] + [("cura", "cross", 40)]


@pytest.mark.long
@pytest.mark.parametrize(("engine", "pattern", "density"), CASES)
def test_gaps_filament_and_touch_stay(engine: str, pattern: str, density: int, tmp_path: Path) -> None:
    missing = missing_prusa() if engine == "prusa" else missing_cura()
    if missing:
        pytest.skip(missing)
    path, output = sliced(engine, pattern, density, tmp_path), tmp_path / "new.gcode"
    report = refill(path, output=output).report
    old, new = path.read_text(), output.read_text()
    gaps = widest_gaps(old, new)
    assert len(gaps) >= 2
    for before, after in gaps:
        assert after <= (1 + MOST_GROWTH) * before + CUT + PIXEL
    assert filament(new) >= LEAST_LENGTH * filament(old)
    assert touching_walls(new) >= LEAST_TOUCH * touching_walls(old)
    assert report["problems"] == []
    told = report["filament"]["infill_after_mm"] / report["filament"]["infill_before_mm"]
    assert told == pytest.approx(filament(new) / filament(old), abs=1e-4)


@pytest.mark.slow
@pytest.mark.skipif(bool(missing_prusa()), reason=missing_prusa())
def test_the_judge_sees_an_arm_that_is_cut_off(tmp_path: Path) -> None:
    """A spiral without half of its infill has a gap that is wider by far."""
    old = sliced("prusa", "octagramspiral", 20, tmp_path).read_text()
    lines, inside, kept = old.splitlines(), False, []
    for line in lines:
        inside = line == ";TYPE:Internal infill" or (inside and not line.startswith(";TYPE:"))
        x = next((float(word[1:]) for word in line.split() if word.startswith("X")), 0.0)
        kept.append(line.partition(" E")[0] if inside and x > 125 and line.startswith("G1 X") else line)
    gaps = np.array(widest_gaps(old, "\n".join(kept)))
    assert (gaps[:, 1] > 2 * gaps[:, 0]).all()


@pytest.mark.slow
@pytest.mark.skipif(bool(missing_cura()), reason=missing_cura())
def test_a_loss_of_filament_is_a_problem_with_a_remedy_that_was_tried(tmp_path: Path) -> None:
    """Of a cross, arcs as large as gaps allow cut off 5 % and more; what the problem names is what it then takes."""
    path = sliced("cura", "cross", 20, tmp_path)
    asked = refill(path, output=tmp_path / "asked.gcode", smooth_radius=50).report
    lost = filament((tmp_path / "asked.gcode").read_text()) / filament(path.read_text()) - 1
    assert lost < LEAST_LENGTH - 1
    (problem,) = asked["problems"]
    assert problem.startswith(f"the infill takes {lost:+.1%} filament; leave --smooth-radius out")
    refill(path, output=tmp_path / "remedied.gcode")
    remedied = filament((tmp_path / "remedied.gcode").read_text()) / filament(path.read_text()) - 1
    assert problem.endswith(f"and it takes {remedied:+.1%}")


@pytest.mark.slow
@pytest.mark.skipif(bool(missing_cura()), reason=missing_cura())
def test_what_density_same_would_leave_is_what_it_leaves(tmp_path: Path) -> None:
    path = sliced("cura", "cross", 20, tmp_path)
    said = refill(path, dry_run=True).report["filament"]["ratio_with_density_same"]
    done = refill(path, output=tmp_path / "same.gcode", density="same").report["filament"]
    assert said == pytest.approx(done["infill_after_mm"] / done["infill_before_mm"], abs=1e-6)
    assert said == pytest.approx(filament((tmp_path / "same.gcode").read_text()) / filament(path.read_text()), abs=1e-4)
