"""Laws of merged segments: none is shorter than 0.05 mm in a refilled print, and the path stays where it was."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
import shapely
from handmade_prints import Dialect, written
from hypothesis import example, given
from hypothesis import strategies as st
from plain_segments import merge_plainly
from test_corners_and_curves import walk, walks

from infill import ParameterError, refill
from infill.gcode.dialect import role_of
from infill.gcode.machine_state import MachineState
from infill.gcode.sections import SPARSE
from infill.gcode.sliced_file import open_sliced
from infill.gcode.table import read_table
from infill.paths.corners import UNIT, RoundedPaths
from infill.paths.short_segments import MOST_MOVED, SHORTEST_SEGMENT, merge_short_segments
from infill.planner.open_timeline import make_timeline
from infill.refilling.request import Request

BUFFER = 16  # segments: what the planner of Marlin holds
DECIMALS = 1.5 * UNIT  # mm that rounding of coordinates may add to a distance or a length


def merged(path: np.ndarray, wanted: float = SHORTEST_SEGMENT) -> np.ndarray:
    count = len(path)
    paths = RoundedPaths(
        points=path, first=np.array([0, count]), source=np.arange(count), radius=np.full(count, np.inf)
    )
    result = merge_short_segments(paths, wanted)
    assert result.first.tolist() == [0, len(result.points)]
    assert (np.diff(result.source) >= 0).all()
    assert (result.points[[0, -1]] == path[[0, -1]]).all()
    return result.points


def lengths(points: np.ndarray) -> np.ndarray:
    return np.hypot(*np.diff(points, axis=0).T)


def rounded(path: np.ndarray) -> np.ndarray:
    return np.rint(path / UNIT) * UNIT


@pytest.mark.parametrize("wanted", [0.05, 0.4, "each its own"])
@pytest.mark.parametrize("on_units", [True, False])
@pytest.mark.parametrize("seed", range(12))
def test_compiled_rounds_are_those_of_numpy(seed: int, on_units: bool, wanted: float | str) -> None:
    random = np.random.default_rng(seed)
    count = random.integers(1, 60, 30)
    turn, step = random.choice([0.05, 0.5, 1.5], 30), random.choice([0.01, 0.03, 0.1, 0.5], 30)
    walks = [
        complex(*random.random(2)) * 50
        + np.cumsum(random.exponential(mean, n) * np.exp(1j * np.cumsum(random.normal(0, bend, n))))
        for n, mean, bend in zip(count, step, turn, strict=True)
    ]
    points = np.concatenate([np.stack([walk.real, walk.imag], axis=1) for walk in walks])
    paths = RoundedPaths(
        points=rounded(points) if on_units else points,
        first=np.append(0, np.cumsum(count)),
        source=np.sort(random.integers(0, 1000, len(points))),
        radius=np.full(3, np.inf),
    )
    least = random.random(len(points)) if isinstance(wanted, str) else wanted
    plain, compiled = merge_plainly(paths, least), merge_short_segments(paths, least)
    assert len(compiled.points) < len(points)
    for name in ("points", "first", "source"):
        np.testing.assert_array_equal(getattr(compiled, name), getattr(plain, name), err_msg=name)


@given(path=walks(170, shortest=0.002, longest=0.3).map(rounded))
@example(path=walk([(1, 0), (0.03, 45), (1, 45)]))
@example(path=walk([(1, 0), *[(0.01, 9)] * 20, (1, 9)]))
@example(path=walk([(1, 0), *[(0.04, 0)] * 20]))
def test_no_segment_inside_a_path_is_short(path: np.ndarray) -> None:
    """But beside an end, where a longer one would move the path, or where the whole path is one."""
    points = merged(path)
    assert len(points) <= len(path)
    assert (lengths(points)[1:-1] >= SHORTEST_SEGMENT - UNIT / 10).all()
    for ends in (points[:3], points[:-4:-1]):
        if len(ends) == 3 and lengths(ends)[0] < SHORTEST_SEGMENT - UNIT / 10:
            assert shapely.hausdorff_distance(shapely.linestrings(ends), shapely.linestrings(ends[::2])) > 0


@given(path=walks(120, shortest=0.06, longest=2.0).map(rounded), wanted=st.floats(0.05, 3.0))
@example(path=walk([(1, 0), *[(0.1, 2)] * 40]), wanted=1.0)
def test_longer_segments_go_only_where_the_path_stays(path: np.ndarray, wanted: float) -> None:
    points = merged(path, wanted)
    before, after = shapely.linestrings(path), shapely.linestrings(points)
    assert shapely.hausdorff_distance(before, after) <= MOST_MOVED + DECIMALS
    short = np.flatnonzero(lengths(points) < wanted - UNIT)
    for place in short if len(points) > 2 else []:  # without its points, the path would lie elsewhere
        for gone in {max(place, 1), min(place + 1, len(points) - 2)}:
            fewer = shapely.linestrings(np.delete(points, gone, axis=0))
            assert shapely.hausdorff_distance(before, fewer, densify=0.05) > MOST_MOVED / 8


def test_an_arc_of_many_chords_becomes_one_of_few() -> None:
    """As few as stay within 0.02 mm of it: chords of 2 √(2 × 0.02 r) at most."""
    angle = np.linspace(0, np.pi, 315)
    arc = rounded(2.0 * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    assert lengths(arc).max() < 0.0225
    for wanted, fewest, most in ((0.05, 60, 126), (0.4, 11, 32)):
        points = merged(arc, wanted)
        assert fewest <= len(points) - 1 <= most
        assert shapely.hausdorff_distance(shapely.linestrings(arc), shapely.linestrings(points)) <= MOST_MOVED


def test_a_blunt_pair_of_corners_stays_one() -> None:
    """Merged into one corner, a machine would brake at it."""
    points = merged(np.array([[0.0, 0.0], [5.0, 0.0], [5.02, 0.02], [5.02, 5.0]]))
    heading = np.arctan2(*np.diff(points, axis=0).T[::-1])
    assert np.degrees(np.diff(heading)).max() == pytest.approx(45, abs=2)
    assert lengths(points)[1] == pytest.approx(0.052, abs=DECIMALS)


def test_paths_do_not_touch_one_another() -> None:
    """The last point of a path and the first of the next may lie close."""
    one = np.array([[0.0, 0.0], [3.0, 0.0]])
    points = np.concatenate([one, one + np.array([3.01, 0.0]), one])
    paths = RoundedPaths(points=points, first=np.array([0, 2, 4, 6]), source=np.arange(6), radius=np.full(6, np.inf))
    done = merge_short_segments(paths, np.full(6, 9.0))
    assert (done.points == points).all()
    assert done.first.tolist() == [0, 2, 4, 6]
    assert merge_short_segments(
        RoundedPaths(points=np.empty((0, 2)), first=np.array([0]), source=np.arange(0), radius=np.empty(0))
    ).first.tolist() == [0]


def strokes(data: bytes, settled: bytes = b"") -> list[tuple[np.ndarray, float]]:
    """Return the printed lines of a text that another does not have: points, and the feed rate, mm/min."""
    table = read_table(data, MachineState())
    old = set(settled.splitlines())
    text = data.splitlines()
    fresh = [k for k in np.flatnonzero(table.extruded > 0).tolist() if text[k] not in old]
    runs = np.split(fresh, np.flatnonzero(np.diff(fresh) != 1) + 1)
    return [
        (np.stack([table.x, table.y], axis=1)[run[0] - 1 : run[-1] + 1], float(table.f[run[0]]))
        for run in runs
        if len(run)
    ]


def flavoured(path: Path, flavour: str) -> Path:
    """Write a print by hand whose settings name a flavour of G-code."""
    text = written(Dialect(layers=6, size=20.0, cell=3.0))
    path.write_bytes(text + f"; gcode_flavor = {flavour}\n".encode())
    return path


@pytest.mark.parametrize("pattern", ["keep", "gyroid"])
def test_a_refilled_print_has_no_short_segment(pattern: str, tmp_path: Path) -> None:
    path = flavoured(tmp_path / "print.gcode", "reprap")
    refill(path, output=tmp_path / "new.gcode", pattern=pattern)
    new = strokes((tmp_path / "new.gcode").read_bytes(), path.read_bytes())
    assert sum(len(points) for points, _ in new) > 300
    inner = np.concatenate([lengths(points)[1:-1] for points, _ in new if len(points) > 3])
    assert inner.min() >= SHORTEST_SEGMENT - UNIT


def fastest_run(path: Path) -> float:
    """Return the most segments per second that the infill of a print asks for, over as many as a planner buffers."""
    seconds, is_infill = [], []
    with open_sliced(path) as file, file.text(file.part_of_plate(None)) as text:
        timeline = make_timeline(text)
        for steps, plan in timeline:
            sparse = np.array([role_of(name) == SPARSE for name in timeline.features])
            seconds.append(plan.seconds)
            is_infill.append(sparse[steps.feature] & (steps.moves.delta[:, 3] > 0) if len(steps) else np.empty(0, bool))
    spent = np.lib.stride_tricks.sliding_window_view(np.concatenate(seconds), BUFFER).sum(axis=1)
    runs = np.lib.stride_tricks.sliding_window_view(np.concatenate(is_infill), BUFFER).all(axis=1)
    return float(BUFFER / spent[runs].min())


@pytest.mark.parametrize("pattern", ["keep", "honeycomb", "gyroid", "hilbert"])
def test_a_controller_gets_no_more_segments_than_it_can_take(pattern: str, tmp_path: Path) -> None:
    """At the speeds at which the machine passes them: bends are slow, and may be cut finely."""
    path = flavoured(tmp_path / "print.gcode", "marlin")
    refill(path, output=tmp_path / "new.gcode", pattern=pattern)
    assert fastest_run(tmp_path / "new.gcode") <= 200
    if pattern == "gyroid":
        refill(path, output=tmp_path / "free.gcode", pattern=pattern, max_segments="none")
        assert fastest_run(tmp_path / "free.gcode") > 400


def test_fewer_segments_for_a_slow_controller(tmp_path: Path) -> None:
    """As the flavour of the file implies, or as requested; the machine moves a little slower, the path stays."""
    counts: dict[tuple[str, object], int] = {}
    reports: Mapping[tuple[str, object], dict] = {}
    for flavour, limit in (("marlin", "auto"), ("marlin2", "auto"), ("marlin2", 200), ("marlin", "none")):
        path = flavoured(tmp_path / f"{flavour}.gcode", flavour)
        output = tmp_path / f"{flavour}-{limit}.gcode"
        reports[flavour, limit] = refill(path, output=output, max_segments=limit).report
        counts[flavour, limit] = sum(len(points) for points, _ in strokes(output.read_bytes(), path.read_bytes()))
    limits = [report["rounding"]["segments_per_s"] for report in reports.values()]
    assert limits == [200, None, 200, None]
    assert counts["marlin", "auto"] == counts["marlin2", 200] < counts["marlin", "none"] == counts["marlin2", "auto"]
    times = [report["time"] for report in reports.values()]
    assert times[1]["print_after_s"] <= times[0]["print_after_s"] < times[0]["print_before_s"]


def test_bambu_printers_have_no_limit(tmp_path: Path) -> None:
    """Their slicer names the flavour of 8-bit boards."""
    path = tmp_path / "bambu.gcode"
    path.write_bytes(written(Dialect(slicer="bambu")) + b"; gcode_flavor = marlin\n")
    assert refill(path, dry_run=True).report["rounding"]["segments_per_s"] is None


@pytest.mark.parametrize("value", [0, -5, "many", 1e9])
def test_limits_out_of_range_are_refused(value: object) -> None:
    with pytest.raises(ParameterError, match=r"^max_segments is .*; (give|it must be) .*segments per second"):
        Request(max_segments=value)  # type: ignore[arg-type]
