"""Laws of a refill of a small sliced box: filament, density, support, and what is asked and refused."""

from __future__ import annotations

import io
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from infill import FormatError, OutputError, ParameterError, refill
from infill.gcode.survey import survey_print
from infill.paths.contact import sample_paths
from infill.paths.families.catalogue import FAMILIES
from infill.paths.rounding import Rounding
from infill.ragged import concatenate_rows
from infill.refilling.drafting import Drafting
from infill.refilling.layers import LayerPaths, Layers, sample_layers
from infill.refilling.planning import plan_refill
from infill.refilling.report import refill_report
from infill.refilling.request import Request
from infill.refilling.rules import RefillRules
from infill.refilling.stats import InfillAmounts, RefillStats
from infill.refilling.support import AIM, LEAST_SHARE, largest_deviation, largest_sufficient, measure_layers
from tests.gcode_judge import judge, lines_of
from tests.gcode_structure import bonded, layers_of, supported
from tests.handmade_prints import Dialect, written
from tests.prints import box, prusa_print
from tests.slicers import missing_prusa

pytestmark = pytest.mark.skipif(bool(missing_prusa()), reason=missing_prusa())

CENTRE = (125.0, 105.0)  # mm: where prusa_print puts a part
SPACING = 0.45 - 0.2 * (1 - np.pi / 4)  # mm, of lines that fill the plane
FILLED = range(5, 9)  # layers, from 1, between skins
RETRACTION = re.compile(rb"^G1 E-", re.MULTILINE)
LAYER = re.compile(rb"^;LAYER_CHANGE$", re.MULTILINE)


@pytest.fixture(scope="module")
def honeycomb(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A box of 20 × 20 × 2.6 mm: thirteen layers, of which four hold honeycomb."""
    folder = tmp_path_factory.mktemp("box")
    return prusa_print(box(folder, (20, 20, 2.6)), folder / "honeycomb.gcode")


@pytest.fixture(scope="module")
def taller(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """With six layers of honeycomb: what one cannot take, in beads from 0.92 to 1.08 as wide, is left to the next."""
    folder = tmp_path_factory.mktemp("taller")
    return prusa_print(box(folder, (20, 20, 3)), folder / "honeycomb.gcode")


@pytest.fixture(scope="module")
def wide(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A box of 60 × 60 × 2 mm, of which one layer holds lines: as wide as seven cells at 5 %."""
    folder = tmp_path_factory.mktemp("wide")
    return prusa_print(box(folder, (60, 60, 2)), folder / "lines.gcode", {"fill_pattern": "rectilinear"})


@pytest.fixture(scope="module")
def kept(honeycomb: Path) -> Path:
    """The same with its corners rounded as far as may be."""
    path = honeycomb.with_name("kept.gcode")
    refill(honeycomb, output=path)
    return path


@pytest.fixture(scope="module")
def looked_at(honeycomb: Path) -> list[Layers]:
    with honeycomb.open("rb") as file:
        return sample_layers(survey_print(file), file)


def infill_of(path: Path) -> list[np.ndarray]:
    return [line for _, moves, _ in layers_of(path.read_bytes()) if moves for line in lines_of(moves)]


def length_of(path: Path) -> float:
    return float(sum(shapely.LineString(line).length for line in infill_of(path)))


def room(path: Path) -> float:
    """Return the area, mm², between the outermost centre lines of the infill: it runs along all four walls."""
    low, high = np.array([[line.min(axis=0), line.max(axis=0)] for line in infill_of(path)]).transpose(1, 0, 2)
    return float(np.prod(high.max(axis=0) - low.min(axis=0)))


def test_a_sampled_layer_knows_its_height_though_the_nozzle_rose_before_its_tag(tmp_path: Path) -> None:
    """As Cura writes layers that begin with infill."""
    text = written(Dialect(slicer="cura", layers=8, hop=0.0))
    late = re.sub(rb"(;LAYER:\d\n)(G1 Z[^\n]*\n)", rb"\2\1", text)
    assert late != text
    heights = [
        [layer.z for layer in layers] for layers in sample_layers(survey_print(io.BytesIO(late)), io.BytesIO(late))
    ]
    assert sum(map(len, heights)) >= 4
    assert np.isfinite(np.concatenate(heights)).all()
    (tmp_path / "late.gcode").write_bytes(late)
    report = refill(tmp_path / "late.gcode", output=tmp_path / "new.gcode", pattern="gyroid").report
    assert report["sections"]["replaced"] > 0


@pytest.mark.slow
def test_layers_that_are_alike_are_drawn_once(honeycomb: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Sampled layers are rounded as they are drawn, with short segments merged, so that they keep the same contact."""
    drawings = []
    draw = Drafting.draw
    monkeypatch.setattr(Drafting, "draw", lambda self, *given: drawings.append(given) or draw(self, *given))
    for number in (100, 200, 400):
        refill(honeycomb, output=tmp_path / "new.gcode", max_segments=number)
    assert len(drawings) == 3


# --- patterns --------------------------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize("name", [name for name, family in FAMILIES.items() if family.fills])
def test_a_pattern_takes_the_filament_that_was_there(name: str, taller: Path, tmp_path: Path) -> None:
    """Within 1 %, with no more retractions; an independent judge finds nothing else changed."""
    report = refill(taller, output=tmp_path / "new.gcode", pattern=name).report
    old, new = taller.read_bytes(), (tmp_path / "new.gcode").read_bytes()
    # As some patterns are: rings of concentric and loops of schwarz-p stand free by nature.
    known = "% less of this infill rests on the layer below", "the new infill is slower", "touches no wall"
    assert all(any(words in problem for words in known) for problem in report["problems"])
    assert report["sections"] == {"all": 6, "replaced": 6, "kept": {}}
    assert judge(old, new, filament=(0.99, 1.01)) == []
    assert len(RETRACTION.findall(new)) <= len(RETRACTION.findall(old))


@pytest.mark.longest
@pytest.mark.parametrize(("part", "name"), [("far_out_ring", "honeycomb"), ("spur_gear", "honeycomb")])
def test_what_small_regions_owe_is_paid(part: str, name: str, data: Path, tmp_path: Path) -> None:
    """Cells that lay 15 % too little, in column upon column, are chosen anew; and what is off is told."""
    sliced = prusa_print(
        data / "printable" / f"{part}.stl", tmp_path / "part.gcode", {"fill_pattern": "grid", "fill_density": "20%"}
    )
    report = refill(sliced, output=tmp_path / "new.gcode", pattern=name).report
    filament = report["filament"]
    assert filament["infill_after_mm"] / filament["infill_before_mm"] == pytest.approx(1, abs=0.01)
    assert not any("filament" in problem for problem in report["problems"])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("asked", "ratio", "told"),
    [
        ({"pattern": "grid"}, 0.985, True),
        ({"pattern": "grid"}, 1.015, True),
        ({"pattern": "grid"}, 0.995, False),
        ({"pattern": "grid", "density": 0.3}, 0.5, False),
        ({"pattern": "grid", "parameters": {"cell": 4.0}}, 0.5, False),
        ({"pattern": "keep"}, 0.975, False),
        ({"pattern": "keep"}, 0.965, True),
        ({"pattern": "keep", "density": "same"}, 0.93, True),
    ],
)
def test_filament_that_is_off_is_told(asked: dict[str, Any], ratio: float, told: bool, honeycomb: Path) -> None:
    with honeycomb.open("rb") as file:
        found = survey_print(file)
    tally = RefillStats(
        sections=1, replaced=1, infill=InfillAmounts(filament=100.0), infill_after=InfillAmounts(filament=100 * ratio)
    )
    request = Request(**asked)
    rules = RefillRules(request=request, rounding=Rounding())
    problems = refill_report(request, found, tally, already=False, rules=rules)["problems"]
    assert [f"{ratio - 1:+.1%} filament" in problem for problem in problems] == [True] * told


@pytest.mark.long
@pytest.mark.parametrize("density", [0.05, 0.2, 0.4])
@pytest.mark.parametrize("name", ["honeycomb", "rectilinear", "grid"])
def test_density_is_the_share_that_lines_fill(name: str, density: float, wide: Path, tmp_path: Path) -> None:
    """Filament, as length times spacing over the area; lines come and go whole, and beads make up for that."""
    new = tmp_path / "new.gcode"
    report = refill(wide, output=new, pattern=name, density=density).report
    drawn = length_of(new) * SPACING / room(wide)
    assert drawn == pytest.approx(density, rel=0, abs=0.01 * density + 15 * SPACING / room(wide))
    filament, per_mm = report["filament"], report["filament"]["infill_before_mm"] / length_of(wide)
    assert filament["infill_after_mm"] / per_mm * SPACING / room(wide) == pytest.approx(density, rel=0.01)


@pytest.mark.slow
def test_a_whole_number_is_a_density_too(honeycomb: Path) -> None:
    """1 is all of it, not the filament that was there; rows of beads beside one another leave no room to turn."""
    for density in (1, 1.0):
        with pytest.raises(ParameterError, match="do not fit into"):
            refill(honeycomb, dry_run=True, pattern="rectilinear", density=density)


@pytest.mark.slow
@pytest.mark.parametrize("pattern", ["honeycomb", "adaptive-cubic"])
@pytest.mark.parametrize("solid", [0, 4000])
def test_a_single_layer_of_infill_is_found(tmp_path: Path, pattern: str, solid: int) -> None:
    """The only layer of a print, or one below thousands that have none: no sample of the file shows it."""
    sliced, new = tmp_path / "old.gcode", tmp_path / "new.gcode"
    text = written(Dialect(size=24.0, layers=3, retract=False))
    begin, *_, end = (found.start() for found in re.finditer(b"(?m)^;LAYER_CHANGE", text))
    last = begin + text[begin:].index(b";LAYER_CHANGE", 1)
    above = b"".join(
        b";LAYER_CHANGE\n;Z:%.1f\n;HEIGHT:0.2\nG1 Z%.1f F600\n;TYPE:Solid infill\n" % (z, z)
        + b"G1 X100 Y100 F7800\nG1 X120 E0.6 F4800\n" * 4
        for z in 0.6 + 0.2 * np.arange(solid)
    )
    tail = text[end:].partition(b"; filament used")
    sliced.write_bytes(text[:begin] + text[last:end] + above + b"".join(tail[1:]))
    assert (len(above) > 1 << 19) == bool(solid)
    report = refill(sliced, output=new, pattern=pattern).report
    assert report["sections"] == {"all": 1, "replaced": 1, "kept": {}}


@pytest.mark.slow
@pytest.mark.parametrize("pattern", ["honeycomb", "adaptive-cubic"])
def test_infill_denser_than_beads_that_touch_stays(tmp_path: Path, pattern: str) -> None:
    """Lines of a grid cross in a pin of 3 mm; a slicer that runs the command on it must not fail."""
    sliced, new = tmp_path / "pin.gcode", tmp_path / "new.gcode"
    dense = {"perimeters": 1, "solid_infill_below_area": 0, "fill_pattern": "grid", "fill_density": "30%"}
    prusa_print(box(tmp_path, (2.7, 2.7, 4)), sliced, dense)
    report = refill(sliced, output=new, pattern=pattern).report
    assert report["sections"]["all"] > 0
    assert report["sections"]["kept"] == {"no room found between walls": report["sections"]["all"]}
    assert new.read_bytes() == sliced.read_bytes()


@pytest.mark.slow
def test_hearts_lie_about_the_middle_of_the_part(looked_at: list[Layers]) -> None:
    """Half a node of the grid that regions are found on is 0.1 mm."""
    plan = plan_refill(FAMILIES["concentric-heart"], looked_at, Rounding(), density=None, acceleration=1000.0)
    assert plan is not None
    assert plan.family.middle == pytest.approx(CENTRE, abs=0.1)  # type: ignore[attr-defined]


# --- what holds infill up --------------------------------------------------------------------------------------


@pytest.mark.slow
def test_support_and_contact_are_as_reported(honeycomb: Path, kept: Path) -> None:
    """By areas and by pairs of points, within 0.01 of the infill's length."""
    found = refill(honeycomb, dry_run=True).report["contact"]
    for when, path in (("before", honeycomb), ("after", kept)):
        data = path.read_bytes()
        assert found[f"supported_{when}"] == pytest.approx(supported(data), abs=0.01)
        assert found[f"bonded_{when}"] == pytest.approx(bonded(data), abs=0.01)
    assert found["measured_mm"] == pytest.approx(length_of(honeycomb), rel=1e-3)


@pytest.mark.longest
def test_rounding_leaves_what_it_promises(honeycomb: Path, kept: Path) -> None:
    """At least 0.94 of what was held before; another measure may err by a hundredth, on 700 mm of infill."""
    old, new = honeycomb.read_bytes(), kept.read_bytes()
    assert supported(new) >= LEAST_SHARE * supported(old)
    assert bonded(new) >= LEAST_SHARE * bonded(old) - 0.01


@pytest.mark.long
@pytest.mark.parametrize("chosen", [0.15, 0.3, float("inf")])
def test_a_print_that_lost_too_much_is_drawn_again(
    chosen: float, honeycomb: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever a few layers told."""
    monkeypatch.setattr("infill.refilling.support.largest_deviation", lambda *_: chosen)
    report = refill(honeycomb, output=tmp_path / "again.gcode").report
    assert report["rounding"]["deviation_mm"] < chosen
    assert min(report["contact"]["kept_supported"], report["contact"]["kept_bonded"]) >= LEAST_SHARE
    assert report["problems"] == []
    assert judge(honeycomb.read_bytes(), (tmp_path / "again.gcode").read_bytes()) == []
    # What was asked for by number is what is done, and what it costs is said.
    asked = refill(honeycomb, output=tmp_path / "asked.gcode", smooth_radius=50, max_deviation=0.3).report
    assert asked["rounding"]["deviation_mm"] == 0.3
    assert asked["problems"]


@pytest.mark.longest
def test_a_dense_print_gets_no_cell_that_beads_do_not_fit_into(tmp_path: Path) -> None:
    """Drawn again with more lines, it would take one."""
    dense = prusa_print(
        box(tmp_path, (20, 20, 3)), tmp_path / "dense.gcode", {"fill_density": "75%", "fill_pattern": "rectilinear"}
    )
    report = refill(dense, output=tmp_path / "new.gcode", pattern="grid").report
    assert report["sections"]["replaced"]
    assert report["filament"]["infill_after_mm"] <= report["filament"]["infill_before_mm"] * 1.01


@given(
    st.lists(st.floats(0.005, 0.3), min_size=1, max_size=40, unique=True).map(lambda some: sorted(some, reverse=True)),
    st.floats(0.01, 20),
    st.floats(0.2, 3),
)
def test_the_first_deviation_that_is_enough_is_found(candidates: list[float], slope: float, power: float) -> None:
    """However the share falls with the deviation, as long as it falls: that of a search one by one."""
    tried: list[float] = []

    def share(deviation: float) -> float:
        tried.append(deviation)
        return float(1 - slope * deviation**power)

    wanted = next((each for each in candidates if 1 - slope * each**power >= AIM), 0.0)
    assert largest_sufficient(candidates, share) == wanted
    assert len(set(tried)) == len(tried) <= 14  # none twice; by halves after a few


@pytest.mark.slow
def test_the_largest_deviation(looked_at: list[Layers]) -> None:
    """It is one of those tried, not above the one asked for, and larger ones hold less."""
    best = largest_deviation(looked_at, Rounding(), 1000.0)
    assert 0.02 <= best <= 0.2
    assert largest_deviation(looked_at, Rounding(deviation=0.01), 1000.0) == 0.01
    assert LEAST_SHARE < AIM < LEAST_SHARE + 0.005


def stacked(aside: float) -> LayerPaths:
    """Ten lines 3 mm apart, on five layers, each layer `aside` of the one below."""
    paths = [np.array([[0, 3 * k + n * aside], [30, 3 * k + n * aside]]) for n in range(1, 6) for k in range(10)]
    points, first = concatenate_rows(paths)
    return LayerPaths(points=points, first=first, layer=np.repeat(np.arange(1, 6), 10))


def test_the_measure_can_fail() -> None:
    nothing = sample_paths(np.empty((0, 2)), np.zeros(1, dtype=np.intp))
    old, new, last = measure_layers(
        stacked(0.0), stacked(0.45), lambda _: nothing, np.arange(1, 6), line_width=0.45, stride=1, last=None
    )
    assert old.length == new.length == pytest.approx(4 * 300)  # of the lowest layer, nothing is known
    assert old.shares == pytest.approx((1, 0))
    assert new.shares == (0, 0)
    assert last is not None
    assert last.number == 5


# --- what is asked ---------------------------------------------------------------------------------------------


def same(report: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in report.items() if name != "request"}


@pytest.mark.longest
def test_lines_are_refilled_as_a_file_is(honeycomb: Path, kept: Path) -> None:
    text = honeycomb.read_bytes().decode()
    wanted = kept.read_bytes().decode()
    for lines in (text.splitlines(keepends=True), iter(text.splitlines())):
        done = refill(lines)
        assert done.path is None
        assert done.lines is not None
        assert "".join(done.lines) == wanted
        assert all(line.endswith("\n") and line.count("\n") == 1 for line in done.lines)


@pytest.mark.slow
def test_lines_end_where_they_did(honeycomb: Path) -> None:
    """Some characters end a line for Python, but not in G-code."""
    lines = honeycomb.read_text().splitlines(keepends=True)
    odd = "; a\x0bform\x0cfeed\x1c and\x85more\u2028of them\n"
    plain, done = (refill(each, pattern="zigzag").lines for each in (lines, [lines[0], odd, *lines[1:]]))
    assert plain is not None
    assert done is not None
    assert [line for line in done if line != odd] == list(plain)
    assert odd in done


@pytest.mark.longest
def test_a_dry_run_writes_nothing(honeycomb: Path, tmp_path: Path) -> None:
    path = tmp_path / "print.gcode"
    path.write_bytes(honeycomb.read_bytes())
    dry = refill(path, dry_run=True)
    assert dry.path is None
    assert path.read_bytes() == honeycomb.read_bytes()
    assert [each.name for each in tmp_path.iterdir()] == ["print.gcode"]
    assert refill(path).report == dry.report
    assert path.read_bytes() != honeycomb.read_bytes()


@pytest.mark.slow
def test_what_is_refilled_already_is_copied(kept: Path, tmp_path: Path) -> None:
    copy = tmp_path / "copy.gcode"
    done = refill(kept, output=copy)
    assert done.report["print"]["already_refilled"]
    assert done.path == copy
    assert copy.read_bytes() == kept.read_bytes()
    assert refill(copy).path is None
    # Onto itself, by whatever name.
    assert refill(copy, output=tmp_path / "." / "copy.gcode").path is not None
    (tmp_path / "link.gcode").symlink_to(copy)
    refill(copy, output=tmp_path / "link.gcode")
    assert copy.read_bytes() == kept.read_bytes()
    with pytest.raises(OutputError, match="exists"):
        refill(kept, output=copy, overwrite=False)


@pytest.mark.slow
def test_a_copy_that_cannot_be_written_is_told(kept: Path, tmp_path: Path) -> None:
    with pytest.raises(OutputError) as error:
        refill(kept, output=tmp_path / "no folder" / "copy.gcode")
    assert "\n" not in str(error.value)


@pytest.mark.long
@pytest.mark.parametrize("pattern", ["keep", "honeycomb"])
def test_layers_asked_for(pattern: str, honeycomb: Path, tmp_path: Path) -> None:
    """Only these change, counted from 1; corners are counted where they were rounded."""
    new = tmp_path / "new.gcode"
    report = refill(honeycomb, output=new, pattern=pattern, layers=(6, 7)).report
    before, after = (LAYER.split(path.read_bytes()) for path in (honeycomb, new))
    differ = [
        n for n in range(1, len(before)) if re.sub(rb"M73.*\n", b"", before[n]) != re.sub(rb"M73.*\n", b"", after[n])
    ]
    assert [n for n in differ if n in FILLED] == [6, 7]
    assert report["sections"]["replaced"] == 2
    assert report["sections"]["kept"] == {"not among the layers asked for": 2}
    assert judge(honeycomb.read_bytes(), new.read_bytes(), filament=(0.9, 1.01)) == []
    if pattern == "keep":
        whole = refill(honeycomb, dry_run=True).report["rounding"]["corners"]
        assert report["rounding"]["corners"] == pytest.approx(whole / 2, rel=0.15)
    else:
        # The layers of a honeycomb that turns have 36 to 39 mm of filament each: these keep theirs.
        filament = report["filament"]
        assert filament["infill_after_mm"] == pytest.approx(filament["infill_before_mm"], rel=0.005)


def test_radius_0_changes_nothing_of_honeycomb(honeycomb: Path, tmp_path: Path) -> None:
    done = refill(honeycomb, output=tmp_path / "new.gcode", smooth_radius=0)
    assert (tmp_path / "new.gcode").read_bytes() == honeycomb.read_bytes()
    assert done.report["rounding"]["corners"] == 0


@pytest.mark.slow
def test_radii_are_as_asked(honeycomb: Path, kept: Path) -> None:
    """Reported by tenths of an octave, 4 % to either side."""
    report = refill(honeycomb, dry_run=True, smooth_radius=0.5).report
    radius = report["rounding"]["radius_mm"]
    assert radius["smallest_hundredth"] <= radius["median"] <= radius["largest_hundredth"] <= 0.5 * 1.04
    assert length_of(kept) < length_of(honeycomb)


@pytest.mark.longest
def test_same_filament_widens_beads(honeycomb: Path, tmp_path: Path) -> None:
    new = tmp_path / "new.gcode"
    filament = refill(honeycomb, output=new, density="same").report["filament"]
    assert filament["infill_after_mm"] == pytest.approx(filament["infill_before_mm"], rel=0.001)
    assert filament["density_for_the_same_percent"] is None
    assert length_of(new) < 0.99 * length_of(honeycomb)
    assert judge(honeycomb.read_bytes(), new.read_bytes(), filament=(0.999, 1.001)) == []


@pytest.mark.slow
@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"pattern": "honycomb"}, "did you mean 'honeycomb'"),
        ({"pattern": "xyz"}, "give keep, or one of"),
        ({"pattern": ""}, "there is no pattern"),
        ({"pattern": "no such file.svg"}, "no such file.svg"),
        ({"density": 0.2}, "only works with --pattern NAME"),
        ({"pattern": "grid", "density": 0}, "density is 0"),
        ({"pattern": "grid", "density": 200}, "density is 200"),
        ({"pattern": "grid", "density": -0.1}, "density is -0.1"),
        ({"pattern": "grid", "density": float("nan")}, "density is nan"),
        ({"pattern": "grid", "density": "lots"}, "give same"),
        ({"smooth_radius": "large"}, "give 'auto'"),
        ({"smooth_radius": -1}, "smooth_radius is -1"),
        ({"smooth_radius": 1e9}, "from 0 to 100 mm"),
        ({"max_deviation": -0.1}, "max_deviation is -0.1"),
        ({"max_deviation": float("inf")}, "max_deviation is inf"),
        ({"layers": (0, 4)}, "count from 1"),
        ({"layers": (5, 4)}, "the lower one first"),
    ],
)
def test_mistakes_are_told_in_one_line(asked: dict[str, Any], said: str, honeycomb: Path, tmp_path: Path) -> None:
    with pytest.raises((ParameterError, FormatError, OSError)) as error:
        refill(honeycomb, output=tmp_path / "new.gcode", **asked)
    assert said in str(error.value)
    assert "\n" not in str(error.value)
    assert list(tmp_path.iterdir()) == []
