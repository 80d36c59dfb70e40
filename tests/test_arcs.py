"""Arcs of sliced prints: read as circles, written in the place of segments, and counted like the straight print."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from infill import UsageError, refill, verify
from infill.gcode.arcs import find_arcs, path_steps
from infill.gcode.machine_state import MachineState
from infill.gcode.path_moves import ARC_DEVIATION, plan_moves
from infill.gcode.survey import SMALL_FILE
from infill.gcode.table import read_table
from tests.arc_fitting import drawn_arcs, straightened
from tests.gcode_judge import Machine, changed, infilled, judge, pushed
from tests.gcode_judge import read as read_line
from tests.gcode_structure import supported
from tests.handmade_prints import Dialect, written

ROUNDED = 0.002  # mm: two decimals of a place, and those of a centre
LAYERS = 8
PRINTS = ["p29_arcs_gyroid_marlin2.gcode", "p29_arcs_honeycomb_klipper.gcode"]


def lower(data: bytes, layers: int) -> bytes:
    """Return the layers that a print of PrusaSlicer begins with, and its end."""
    begins = [found.start() for found in re.finditer(rb"^;LAYER_CHANGE", data, re.MULTILINE)]
    return data[: begins[layers]] + data[data.rindex(b";TYPE:Custom") :]


def outside(faults: list[str]) -> float:
    """Return how far paths leave the region of the infill, mm; no other fault is allowed."""
    assert [fault for fault in faults if not fault.startswith("move outside")] == []
    return max((float(far) for far in re.findall(r"by ([\d.]+) mm", " ".join(faults))), default=0.0)


@given(
    st.tuples(st.floats(-50, 50), st.floats(-50, 50)),
    st.floats(0.3, 80),
    st.floats(-3.1, 3.1),
    st.floats(0.1, 3.0),
    st.booleans(),
    st.booleans(),
)
def test_an_arc_is_read_as_its_circle(
    middle: tuple[float, float], radius: float, angle: float, turn: float, clockwise: bool, by_radius: bool
) -> None:
    """By its centre and by its radius: its length, and points within the sagitta of it."""
    start = np.array(middle) + radius * np.array([math.cos(angle), math.sin(angle)])
    last = angle - turn if clockwise else angle + turn
    end = np.array(middle) + radius * np.array([math.cos(last), math.sin(last)])
    centre = np.array(middle) - start
    circle = f"R{radius:.6f}" if by_radius else f"I{centre[0]:.6f} J{centre[1]:.6f}"
    text = f"G{2 if clockwise else 3} X{end[0]:.6f} Y{end[1]:.6f} {circle} E1 F900\n".encode()
    table = read_table(text, MachineState(x=float(start[0]), y=float(start[1]), z=0.2))
    arcs = find_arcs(table)
    assert len(arcs) == 1
    near = 0.05 if by_radius and turn > 2.5 else 1e-3  # near half a circle, a radius hardly tells the centre
    assert path_steps(table)[0] == pytest.approx(radius * turn, rel=near)
    _, points = arcs.chord_ends(0.004)
    assert np.abs(np.hypot(*(points - middle).T) - radius).max() <= near * max(radius, 1.0)
    assert points[-1] == pytest.approx(end, abs=1e-6)
    path = np.vstack([start, points])
    between = (path[1:] + path[:-1]) / 2
    sagitta = radius - np.hypot(*(between - middle).T)
    assert sagitta.max() <= 0.004 + near * max(radius, 1.0)


@pytest.mark.parametrize(
    "line",
    [
        "G2 X10 Y0 I0 J0 E1",  # of no radius
        "G2 X10 Y0 I3 J0 E1",  # whose ends lie on two circles
        "G2 X10 Y0 R4 E1",  # whose radius does not reach
        "G3 X10 Y0 I5 Z.4 E1",  # that climbs
        "G3 X10 Y0 I5 P3 E1",  # of three turns
        "G2 X10 Y0 E1",  # without a circle
    ],
)
def test_an_arc_that_closes_on_no_circle_is_none(line: str) -> None:
    table = read_table(f"{line}\n".encode(), MachineState(x=0.0, y=0.0, z=0.2))
    assert len(find_arcs(table)) == 0


def curves() -> st.SearchStrategy[np.ndarray]:
    """Paths of straight legs and waves, cut into segments."""

    def make(seed: int, waves: int, step: float) -> np.ndarray:
        rng = np.random.default_rng(seed)
        along = np.arange(0.0, 20.0, step)
        height = sum(
            rng.uniform(0, 1.5) * np.sin(rng.uniform(0.2, 2) * along + rng.uniform(0, 6)) for _ in range(waves)
        )
        corner = rng.uniform(0.0, 8.0, (3, 2)) + np.array([20.0, 0.0])
        return np.round(np.vstack([np.column_stack([along, height + 0 * along]), corner]), 3)

    return st.builds(make, st.integers(0, 10**6), st.integers(0, 3), st.floats(0.1, 0.9))


@given(curves(), st.floats(0.005, 0.05))
def test_arcs_stay_near_their_segments(path: np.ndarray, deviation: float) -> None:
    """Both ways, where the machine draws them: the points within the deviation, the segments within half as much again."""
    moves = plan_moves(path, np.array([0, len(path)]), arc_deviation=deviation)
    text = (
        b"G0 X%.3f Y%.3f\n" % tuple(path[0])
        + moves.write(np.ones(len(moves.end)), np.full(len(moves.end), np.nan), b"\n").text
    )
    table = read_table(b"M83\n" + text, MachineState(z=0.2))
    arcs = find_arcs(table)
    assert len(arcs) == np.count_nonzero(moves.turn)
    drawn = [path[0]]
    for line in range(2, len(table)):
        at = np.flatnonzero(arcs.line == line)
        if len(at):
            drawn += list(arcs.select(arcs.line == line).chord_ends(1e-4)[1])
        else:
            drawn.append(np.array([table.x[line], table.y[line]]))
    new, old = shapely.linestrings(np.array(drawn)), shapely.linestrings(path)
    assert shapely.distance(shapely.points(path), new).max() <= deviation + ROUNDED
    assert shapely.hausdorff_distance(shapely.segmentize(new, 0.05), old) <= 1.5 * deviation + ROUNDED
    assert shapely.hausdorff_distance(shapely.segmentize(old, 0.05), new) <= 1.5 * deviation + ROUNDED
    assert moves.end[-1] == len(path) - 1
    assert (np.diff(moves.end) > 0).all()
    assert np.allclose(path_steps(table)[2:], moves.length, atol=ROUNDED)


def test_a_circle_takes_few_arcs_and_a_square_none() -> None:
    angle = np.linspace(0, 2 * np.pi, 181)
    circle = np.round(5 * np.column_stack([np.cos(angle), np.sin(angle)]), 3)
    assert len(plan_moves(circle, np.array([0, 181]), arc_deviation=ARC_DEVIATION).end) <= 3
    square = np.array([[0.0, 0], [5, 0], [5, 5], [0, 5], [0, 0]])
    assert not plan_moves(square, np.array([0, 5]), arc_deviation=ARC_DEVIATION).turn.any()


def test_no_arc_passes_a_stop() -> None:
    angle = np.linspace(0, 2, 41)
    path = np.column_stack([np.cos(angle), np.sin(angle)]) * 5
    stops = np.zeros(41, dtype=bool)
    stops[[7, 19]] = True
    assert {7, 19} <= set(plan_moves(path, np.array([0, 41]), arc_deviation=0.02, stops=stops).end.tolist())


@pytest.mark.longest
@pytest.mark.parametrize(
    ("name", "pattern"),
    [
        (PRINTS[0], "keep"),
        (PRINTS[0], "gyroid"),
        (PRINTS[0], "triangles"),
        (PRINTS[0], "hilbert"),
        (PRINTS[1], "keep"),
    ],
)
def test_a_print_with_arcs_is_refilled_as_the_straight_one(name: str, pattern: str, data: Path, tmp_path: Path) -> None:
    """As many sections; the same filament and time within 1 %; and an independent judge passes what is written.

    Of the lowest layers: what lies above is filled in the same way. Hilbert, whose times differ most, needs more of them.
    """
    path, straight = tmp_path / "round.gcode", tmp_path / "straight.gcode"
    whole = (data / "prints" / name).read_bytes()
    old = lower(whole, 12 if pattern == "hilbert" else LAYERS)
    path.write_bytes(old)
    straight.write_bytes(straightened(old))
    round_report = refill(path, output=tmp_path / "arcs.gcode", pattern=pattern).report
    straight_report = refill(straight, output=tmp_path / "lines.gcode", pattern=pattern).report
    new, lines = (tmp_path / "arcs.gcode").read_bytes(), (tmp_path / "lines.gcode").read_bytes()
    bounds = (0.8, 1.05)
    allowed = outside(judge(straight.read_bytes(), lines, filament=bounds))  # of a ring 4 mm wide, 0.03 mm
    assert outside(judge(old, new, filament=bounds)) <= (allowed + 0.02 if allowed else 0.0)
    assert changed(old, new) >= 0.95 * straight_report["sections"]["replaced"] > 0
    before, after = pushed(new), pushed(lines)
    assert sum(before) == pytest.approx(sum(after), rel=0.01)
    assert round_report["time"]["print_after_s"] == pytest.approx(straight_report["time"]["print_after_s"], rel=0.01)
    assert supported(new) >= 0.94 * supported(old)
    arcs, moves = drawn_arcs(new)
    straight_moves = drawn_arcs(lines)
    assert straight_moves[0] == 0
    assert arcs or pattern == "triangles"
    assert moves < straight_moves[1]


@pytest.mark.longest
def test_a_large_print_that_misses_its_filament_is_drawn_again(data: Path, tmp_path: Path) -> None:
    """The first cell of a grid would take 2 % more, as only whole lines can be added or removed."""
    path, output = data / "prints" / PRINTS[0], tmp_path / "new.gcode"
    report = refill(path, output=output, pattern="grid").report
    assert path.stat().st_size > SMALL_FILE
    assert report["filament"]["infill_after_mm"] == pytest.approx(report["filament"]["infill_before_mm"], rel=0.01)
    assert report["problems"] == []
    assert not verify(path, output).violations


def test_arcs_are_written_where_they_are_asked_for(data: Path, tmp_path: Path) -> None:
    path, straight, output = data / "prints" / PRINTS[0], tmp_path / "straight.gcode", tmp_path / "out.gcode"
    straight.write_bytes(straightened(path.read_bytes()))
    counts = {}
    for source, arcs in ((path, "auto"), (path, "off"), (straight, "auto"), (straight, "on")):
        refill(source, output=output, arcs=arcs)
        counts[source.name, arcs] = drawn_arcs(output.read_bytes())
    assert counts[path.name, "auto"][0] > 1000 < counts["straight.gcode", "on"][0]
    assert counts[path.name, "off"][0] == counts["straight.gcode", "auto"][0] == 0
    assert 3 * counts[path.name, "auto"][1] < counts[path.name, "off"][1]  # of a gyroid, a third of the lines and fewer
    with pytest.raises(UsageError, match="arcs is 'yes'; give auto, on or off"):
        refill(path, arcs="yes", dry_run=True)


def test_the_judge_measures_arcs_along_their_circle() -> None:
    """Of 0.3 mm, more than half a circle: by chords, and to a centre of three decimals, filament seemed 0.4 % too much."""
    machine = Machine()
    moves = [machine.run(read_line(1, line)) for line in (b"G1 X62.548 Y109.662 Z.2 F4800", b"M83")]
    move = machine.run(read_line(2, b"G2 X62.548 Y110.247 I-.053 J.292 E.03808"))
    assert moves[1] is None
    assert move is not None
    assert move.turn == pytest.approx(3.5001, abs=1e-4)
    assert move.length == pytest.approx(1.0404, abs=2e-4)
    lengths = []
    for rise in (0.0525, 0.0535):  # of the centre over the middle of the chord, which is rounded to 0.053
        radius = math.hypot(rise, 0.2925)
        lengths.append(radius * (math.pi + 2 * math.atan2(rise, 0.2925)))
    assert max(abs(length - move.length) for length in lengths) < move.rounding < 0.005


@pytest.mark.longest
def test_a_binary_print_with_arcs_is_refilled(data: Path, tmp_path: Path) -> None:
    report = refill(
        data / "prints" / "p29_binary_arcs.bgcode", output=tmp_path / "out.bgcode", pattern="honeycomb"
    ).report
    assert report["sections"]["replaced"] >= 0.95 * report["sections"]["all"]


@pytest.mark.longest
def test_a_rise_before_the_first_bead_is_no_lift(data: Path, tmp_path: Path) -> None:
    """The print begins at 5 mm and comes down to its first layer: travel to new paths rises no higher for that."""
    old = lower((data / "prints" / PRINTS[0]).read_bytes(), LAYERS)
    (tmp_path / "old.gcode").write_bytes(old)
    refill(tmp_path / "old.gcode", output=tmp_path / "out.gcode", pattern="grid")
    new = (tmp_path / "out.gcode").read_bytes()
    heights = [{float(z) for z in re.findall(rb"^G1 Z([\d.]+)", text, re.MULTILINE)} for text in (old, new)]
    assert heights[1] <= heights[0]
    assert new.count(b"\nG1 Z") == old.count(b"\nG1 Z")


def test_wipes_along_arcs_are_no_odd_arcs(tmp_path: Path) -> None:
    """Two half circles back to where they began, one of which retracts, after a line of every section."""
    old, output = tmp_path / "old.gcode", tmp_path / "new.gcode"
    straight = written(Dialect(slicer="orca"))
    begins = list(
        re.finditer(rb"(?m)^; FEATURE: (?:Sparse|Internal) infill\n|^;TYPE:(?:Sparse|Internal) infill\n", straight)
    )
    assert len(begins) > 2
    pieces, last = [], 0
    for begin in begins:
        bead = re.compile(rb"(?m)^G1 X([\d.]+) Y([\d.]+) E[\d.]+\n").search(straight, begin.end())
        assert bead
        x, y = float(bead[1]), float(bead[2])
        wipe = b"G2 X%.3f Y%.3f I.5 J0 E-.2\nG2 X%.3f Y%.3f I-.5 J0\nG1 E.2 F2100\n" % (x + 1, y, x, y)
        pieces += [straight[last : bead.end()], wipe]
        last = bead.end()
    old.write_bytes(b"".join([*pieces, straight[last:]]))
    for pattern in ("honeycomb", "gyroid"):
        report = refill(old, output=output, pattern=pattern).report
        assert report["sections"] == {"all": len(begins), "replaced": len(begins), "kept": {}}
        assert verify(old, output).agrees


def test_arcs_of_other_beads_bound_the_region(tmp_path: Path) -> None:
    """Walls as arcs of a round part: infill ends as far from them as from walls of chords."""
    path = tmp_path / "round.gcode"
    path.write_bytes(written(Dialect(slicer="orca", arcs=True)))
    report = refill(path, output=tmp_path / "out.gcode", pattern="honeycomb").report
    assert report["sections"]["replaced"] == report["sections"]["all"] > 0
    assert infilled(path.read_bytes()) == report["sections"]["all"]
