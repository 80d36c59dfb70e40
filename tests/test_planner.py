"""The planner: closed forms, symmetries, and a slow planner in plain Python beside it."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from infill.gcode.limits import INFINITE, JERK_MODELS, MAX_LIMIT, MIN_LIMIT, MODELS, Limits
from infill.paths.speeds import look_ahead
from infill.planner.bounds import Moves, bound_moves
from infill.planner.junctions import joint_limits
from infill.planner.lookahead import MOVES_AT_ONCE, MotionPlan, hump_tops, plan_moves, plan_settled
from infill.planner.struct_of_arrays import concatenate_rows, slice_rows

FREE = (INFINITE,) * 4
# A machine without limits of its axes: what is left is the path's.
PLAIN = Limits(feedrate=FREE, axis_acceleration=FREE, acceleration=1000, travel_acceleration=1000, jerk=(8, 8, 0.4, 5))
STEADY = replace(PLAIN, model="klipper", minimum_cruise_ratio=0)
JUNCTION = replace(PLAIN, model="junction")
VECTOR = replace(PLAIN, model="vector-jerk")
EVERY = [PLAIN, VECTOR, STEADY, JUNCTION, replace(PLAIN, model="klipper")]


def moves_of(delta: ArrayLike, feedrate: ArrayLike) -> Moves:
    """Moves of one setting without stops; missing columns of the displacements are 0."""
    steps = np.atleast_2d(np.asarray(delta, dtype=float))
    steps = np.pad(steps, ((0, 0), (0, 4 - steps.shape[1])))
    speed = np.broadcast_to(np.asarray(feedrate, dtype=float), len(steps)).copy()
    return Moves(
        delta=steps, feedrate=speed, setting=np.zeros(len(steps), dtype=np.intp), stop=np.zeros(len(steps), dtype=bool)
    )


def total(delta: ArrayLike, feedrate: ArrayLike, limits: Limits) -> float:
    return float(plan_moves(moves_of(delta, feedrate), [limits]).seconds.sum())


@st.composite
def paths(draw: st.DrawFn) -> Moves:
    """Walks in x and y of 1 to 40 moves, some with filament, some of filament alone."""
    count = draw(st.integers(1, 40))
    number = st.floats(-5, 5).map(lambda value: round(value, 3))
    steps = np.array(draw(st.lists(st.tuples(number, number), min_size=count, max_size=count)))
    pushed = np.array(draw(st.lists(st.sampled_from([0.0, 0.033, 0.05]), min_size=count, max_size=count)))
    length = np.hypot(*steps.T)
    delta = np.column_stack([steps, np.zeros(count), np.where(length > 0, pushed * length, -0.8)])
    feedrate = draw(st.lists(st.floats(1, 300), min_size=count, max_size=count))
    return moves_of(delta, feedrate)


# --- a single move ---------------------------------------------------------------------------------------


@given(st.floats(0.01, 500), st.floats(1, 500), st.floats(10, 20000))
def test_one_move_from_rest_to_rest(distance: float, speed: float, acceleration: float) -> None:
    """A triangle, or a trapezoid: t = 2 sqrt(d / a), or d / v + v / a."""
    limits = replace(STEADY, travel_acceleration=acceleration)
    if speed**2 / acceleration > distance:
        expected = 2 * math.sqrt(distance / acceleration)
    else:
        expected = distance / speed + speed / acceleration
    assert total([distance, 0], speed, limits) == pytest.approx(expected, rel=1e-12)


@given(st.floats(0.01, 500), st.floats(0.0, 0.9))
def test_a_short_move_cruises_for_the_ratio(distance: float, ratio: float) -> None:
    """Klipper's ratio r: the move rises to v² = a (1 - r) d, so it runs r d at constant speed."""
    limits = replace(STEADY, minimum_cruise_ratio=ratio)
    done = plan_moves(moves_of([distance, 0], 1e6), [limits])
    peak = math.sqrt(1000 * (1 - ratio) * distance)
    assert done.peak[0] == pytest.approx(peak, rel=1e-12)
    assert done.seconds[0] == pytest.approx(2 * peak / 1000 + ratio * distance / peak, rel=1e-9)


def test_jerk_starts_and_stops_at_once() -> None:
    """With jerk 8 it starts at 8 mm/s: (v - 8) / a to speed up, and as much to slow down."""
    expected = 2 * (80 - 8) / 1000 + (100 - (80**2 - 8**2) / 1000) / 80
    assert total([100, 0], 80, PLAIN) == pytest.approx(expected, rel=1e-12)


def test_of_old_half_the_jerk_is_for_starting() -> None:
    expected = 2 * (80 - 4) / 1000 + (100 - (80**2 - 4**2) / 1000) / 80
    assert total([100, 0], 80, VECTOR) == pytest.approx(expected, rel=1e-12)
    done = plan_moves(moves_of([[100, 0], [0, 100]], 80), [VECTOR])
    assert done.exit[0] == pytest.approx(8 / math.sqrt(2), rel=1e-12)  # x and y jump together by 80 sqrt(2)


def test_filament_alone_has_its_own_limits() -> None:
    limits = replace(STEADY, retract_acceleration=500)
    assert total([0, 0, 0, -0.8], 35, limits) == pytest.approx(2 * math.sqrt(0.8 / 500), rel=1e-12)
    slow = replace(limits, feedrate=(INFINITE, INFINITE, INFINITE, 5))
    assert total([0, 0, 0, -0.8], 35, slow) == pytest.approx(0.8 / 5 + 5 / 500, rel=1e-12)


def test_an_axis_limits_by_its_share() -> None:
    """At 45 degrees an axis of 100 mm/s lets the path run at 100 sqrt(2)."""
    limits = replace(JUNCTION, feedrate=(100, 100, 5, 5), axis_acceleration=(500, 500, 100, 100))
    bounds = bound_moves(moves_of([[30, 30, 0], [30, 0, 0], [0, 0, 2]], 400), [limits])
    assert bounds.speed == pytest.approx([100 * math.sqrt(2), 100, 5], rel=1e-12)
    assert bounds.acceleration == pytest.approx([500 * math.sqrt(2), 500, 100], rel=1e-12)


# --- corners ---------------------------------------------------------------------------------------------


def test_klipper_turns_a_right_angle_at_its_velocity() -> None:
    done = plan_moves(moves_of([[100, 0], [0, 100]], 200), [replace(STEADY, square_corner_velocity=7)])
    assert done.exit[0] == pytest.approx(7, rel=1e-12)


def test_klipper_limits_short_moves_by_their_circle() -> None:
    """Moves of 0.1 mm that turn by p: v² = a d / 2 cot(p / 2), below what the deviation allows."""
    p = 0.2
    turn = np.arange(40) * p
    done = plan_moves(moves_of(0.1 * np.column_stack([np.cos(turn), np.sin(turn)]), 200), [STEADY])
    circle = 1000 * 0.05 / math.tan(p / 2)
    deviation = 25 * (math.sqrt(2) - 1) * math.cos(p / 2) / (1 - math.cos(p / 2))
    assert circle < deviation
    assert done.exit.max() == pytest.approx(math.sqrt(circle), rel=1e-9)


def test_marlin_takes_a_corner_by_its_deviation() -> None:
    """At a right angle s = sqrt(1/2): v² = a J s / (1 - s)."""
    s = math.sqrt(0.5)
    done = plan_moves(moves_of([[100, 0], [0, 100]], 200), [replace(JUNCTION, junction_deviation=0.05)])
    assert done.exit[0] == pytest.approx(math.sqrt(1000 * 0.05 * s / (1 - s)), rel=1e-9)


def test_jerk_bounds_the_jump_of_each_axis() -> None:
    """From +x to +y at 80 mm/s each axis jumps by the speed; from +x to -x it counts once, as firmware has it."""
    for delta in ([[100, 0], [0, 100]], [[100, 0], [-100, 0]]):
        assert plan_moves(moves_of(delta, 80), [PLAIN]).exit[0] == pytest.approx(8, rel=1e-12)
    gentle = plan_moves(moves_of([[100, 0], [100, 5]], 80), [PLAIN])
    assert gentle.exit[0] == pytest.approx(80, rel=1e-12)  # y jumps by 4


@pytest.mark.parametrize("limits", EVERY, ids=lambda limits: f"{limits.model} {limits.minimum_cruise_ratio}")
def test_a_stop_in_between_is_two_paths(limits: Limits) -> None:
    both = moves_of([[30, 0], [30, 0]], 100)
    stopped = replace(both, stop=np.array([False, True]))
    expected = 2 * total([30, 0], 100, limits)
    assert plan_moves(stopped, [limits]).seconds.sum() == pytest.approx(expected, rel=1e-12)
    assert plan_moves(both, [limits]).seconds.sum() < expected


# --- laws ------------------------------------------------------------------------------------------------


@pytest.mark.slow
@given(paths(), st.sampled_from(EVERY), st.floats(1, 3))
@settings(deadline=None, max_examples=60)
def test_time_falls_when_limits_rise(moves: Moves, limits: Limits, factor: float) -> None:
    before = plan_moves(moves, [limits]).seconds.sum()
    scaled = ("acceleration", "travel_acceleration", "retract_acceleration", "junction_deviation")
    scaled += ("square_corner_velocity", "corner_extrusion_velocity")
    higher = {name: getattr(limits, name) * factor for name in scaled}
    limits = replace(limits, jerk=tuple(value * factor for value in limits.jerk), **higher)
    assert plan_moves(moves, [limits]).seconds.sum() <= before * (1 + 1e-9)


@pytest.mark.slow
@given(st.lists(st.floats(0.05, 20), min_size=1, max_size=30), st.floats(10, 300), st.sampled_from(EVERY))
@settings(deadline=None, max_examples=60)
def test_splitting_a_straight_move_changes_nothing(pieces: list[float], speed: float, limits: Limits) -> None:
    whole = sum(pieces)
    direction = np.array([math.cos(1), math.sin(1), 0, 0.03])  # no axis at its jerk to the last digit
    split = total(np.outer(pieces, direction), speed, limits)
    # The square root of the rounding of a turn of 0 is 1e-8.
    assert split == pytest.approx(total(whole * direction, speed, limits), rel=1e-6)


@pytest.mark.slow
@given(paths(), st.sampled_from([PLAIN, VECTOR, STEADY, JUNCTION]))
@settings(deadline=None, max_examples=60)
def test_the_way_back_takes_as_long(moves: Moves, limits: Limits) -> None:
    """Classic jerk looks at the later move alone in two places, which do not matter in x and y at one speed.

    With its cruise ratio Klipper lets a move before the top of a hump reach that, and holds one after it at its entry.
    """
    if limits.model in JERK_MODELS:
        level = np.where(moves.delta[:, :2].any(axis=1)[:, None], moves.delta, [1.0, 0, 0, 0])
        moves = replace(moves, delta=level, feedrate=np.full(len(moves), 60.0))
    back = replace(moves, delta=-moves.delta[::-1], feedrate=moves.feedrate[::-1])
    # What is drawn back on the way there is pushed on the way back; nothing here limits one and not the other.
    there = plan_moves(moves, [limits]).seconds.sum()
    assert plan_moves(back, [limits]).seconds.sum() == pytest.approx(there, rel=1e-9)


# --- the slow planner ------------------------------------------------------------------------------------


def slow_klipper(moves: Moves, limits: Limits) -> list[float]:
    """Klipper's planner as its documents tell it, move by move: corners, a pass back, a pass forward, trapezoids."""
    a, joints = limits.acceleration, [0.0]
    deviation = limits.square_corner_velocity**2 * (math.sqrt(2) - 1) / a
    length = [math.hypot(*delta[:3]) or abs(delta[3]) for delta in moves.delta]
    speed = list(moves.feedrate)
    for i, j in pairwise(range(len(length))):
        u, w = (moves.delta[k] / length[k] for k in (i, j))
        if not (any(u[:3]) and any(w[:3])):
            joints.append(0.0)
            continue
        inner = math.acos(max(-1.0, min(1.0, -float(u[:3] @ w[:3]))))  # the angle between the moves: pi is straight on
        s = math.sin(inner / 2)
        found = [speed[i] ** 2, speed[j] ** 2]
        if s < 1:
            found += [a * deviation * s / (1 - s), *(a * length[k] / 2 * math.tan(inner / 2) for k in (i, j))]
        if u[3] != w[3]:
            found.append((limits.corner_extrusion_velocity / (u[3] - w[3])) ** 2)
        joints.append(min(found))
    joints.append(0.0)
    return slow_times(joints, length, speed, [a] * len(length))


def slow_times(joints: list[float], length: list[float], speed: list[float], a: list[float]) -> list[float]:
    """The two passes and the trapezoids."""
    u = joints.copy()
    for i in reversed(range(len(length))):
        u[i] = min(u[i], u[i + 1] + 2 * a[i] * length[i])
    for i in range(len(length)):
        u[i + 1] = min(u[i + 1], u[i] + 2 * a[i] * length[i])
    seconds = []
    for i in range(len(length)):
        top = min(speed[i], math.sqrt((u[i] + u[i + 1]) / 2 + a[i] * length[i]))
        enter, leave = math.sqrt(u[i]), math.sqrt(u[i + 1])
        ramps = (2 * top**2 - u[i] - u[i + 1]) / (2 * a[i])
        seconds.append((2 * top - enter - leave) / a[i] + max(length[i] - ramps, 0) / top)
    return seconds


@pytest.mark.slow
@given(paths(), st.floats(1, 20), st.floats(100, 20000))
@settings(deadline=None, max_examples=80)
@example(moves_of([[3, 4], [3, 4], [-3, -4], [0, 1]], [50, 100, 20, 200]), 5.0, 1000.0)
def test_it_agrees_with_a_slow_planner(moves: Moves, corner: float, acceleration: float) -> None:
    same = dict.fromkeys(("acceleration", "travel_acceleration", "retract_acceleration"), acceleration)
    limits = replace(STEADY, square_corner_velocity=corner, **same)
    expected = slow_klipper(moves, limits)
    # An angle by its cosine is exact to 1e-8 only.
    assert plan_moves(moves, [limits]).seconds == pytest.approx(expected, rel=1e-5, abs=1e-9)


@pytest.mark.slow
@given(paths(), st.sampled_from(EVERY))
@settings(deadline=None, max_examples=60)
def test_a_plan_keeps_to_its_limits(moves: Moves, limits: Limits) -> None:
    """Speeds join, no joint is passed too fast, no move speeds up faster than it may, and every length is driven."""
    done = plan_moves(moves, [limits])
    bounds = bound_moves(moves, [limits])
    joints = joint_limits(moves, bounds, [limits])
    slack = 1e-6  # mm²/s², of rounding
    assert done.exit[:-1] == pytest.approx(done.entry[1:])
    assert (np.append(done.entry, done.exit[-1]) ** 2 <= joints + slack).all()
    assert (np.abs(done.exit**2 - done.entry**2) <= bounds.reach + slack).all()
    assert (done.peak <= bounds.speed * (1 + 1e-12)).all()
    assert (done.peak >= np.maximum(done.entry, done.exit)).all()
    ramps = (2 * done.peak**2 - done.entry**2 - done.exit**2) / (2 * bounds.acceleration)
    cruise = done.seconds - (2 * done.peak - done.entry - done.exit) / bounds.acceleration
    assert ramps + cruise * done.peak == pytest.approx(bounds.distance, rel=1e-6, abs=1e-6)


@given(st.lists(st.tuples(st.floats(0, 1e4), st.floats(0.001, 1e3)), min_size=1, max_size=40))
def test_look_ahead_is_its_definition(rows: list[tuple[float, float]]) -> None:
    """u_j = min over i of c_i + |S_j - S_i|, a double loop."""
    reach = np.array([reach for _, reach in rows])
    joints = np.array([0.0, *(joint for joint, _ in rows)])
    far = np.concatenate([[0.0], np.cumsum(reach)])
    expected = (joints + np.abs(far[:, None] - far)).min(axis=1)
    assert look_ahead(joints, reach) == pytest.approx(expected, abs=1e-9)


@pytest.mark.longest
@given(paths(), st.sampled_from(EVERY), st.integers(1, 7))
@settings(deadline=None, max_examples=60)
def test_moves_in_pieces_are_planned_as_one(moves: Moves, limits: Limits, size: int) -> None:
    """Planned as a stream, whatever is settled is final."""
    whole, found = plan_moves(moves, [limits]), 0.0
    entry, first, last = None, 0, 0
    while first < len(moves):
        last = min(last + size, len(moves))
        settled, done, entry = plan_settled(
            slice_rows(moves, slice(first, last)), [limits], entry, ends=last == len(moves)
        )
        assert done.seconds == pytest.approx(whole.seconds[first : first + settled], rel=1e-9, abs=1e-9)
        first += settled
        found += done.seconds.sum()
    assert found == pytest.approx(whole.seconds.sum(), rel=1e-9)


@st.composite
def wild_paths(draw: st.DrawFn) -> Moves:
    """Straight runs of moves and corners, under five settings, some of which no machine has, with stops."""
    count = draw(st.integers(2, 40))

    def column(values: st.SearchStrategy[float]) -> list[float]:
        return draw(st.lists(values, min_size=count, max_size=count))

    turn = np.cumsum(column(st.sampled_from([0.0, 0.0, 0.0, 0.003, 0.5, math.pi / 2])))
    length = np.array(column(st.sampled_from([0.0, 0.0125, 0.1, 0.1, 2.0, 2.0, 300.0])))
    delta = np.column_stack([np.cos(turn) * length, np.sin(turn) * length, np.zeros(count), 0.03 * length])
    delta[length == 0, 3] = -0.8
    moves = moves_of(delta, column(st.sampled_from([20.0, 80.0, 200.0])))
    setting = draw(st.lists(st.integers(0, 4), min_size=count, max_size=count))
    setting = draw(st.sampled_from([setting, sorted(setting), [0] * count]))
    stop = draw(st.lists(st.sampled_from([False] * 9 + [True]), min_size=count, max_size=count))
    return replace(moves, setting=np.array(setting), stop=np.array(stop))


def settings_of(limits: Limits) -> list[Limits]:
    """Return five settings of one model: usual ones, and accelerations at the ends of what is taken."""
    return [
        replace(limits, acceleration=a, travel_acceleration=a, retract_acceleration=a, minimum_cruise_ratio=ratio)
        for a, ratio in ((500.0, 0.0), (1000.0, 0.5), (20000.0, 0.9), (MAX_LIMIT, 0.5), (MIN_LIMIT, 0.0))
    ]


@pytest.mark.longest
@given(wild_paths(), st.sampled_from([PLAIN, VECTOR, STEADY, JUNCTION]), st.integers(1, 45))
@settings(deadline=None, max_examples=150)
@example(
    replace(moves_of([[1, 0]] * 8, 200), setting=np.array([0] * 4 + [1] * 4)), STEADY, 4
)  # a ratio behind a joint that is settled without one
def test_a_move_means_the_same_in_any_surroundings(moves: Moves, limits: Limits, size: int) -> None:
    """In pieces of any size as in one, and behind or before a move by which a machine could reach any speed."""
    several = settings_of(limits)
    _, whole, _ = plan_settled(moves, several, None, ends=True)
    entry, first, last, found = None, 0, 0, []
    while first < len(moves):
        last = min(last + size, len(moves))
        settled, done, entry = plan_settled(
            slice_rows(moves, slice(first, last)), several, entry, ends=last == len(moves)
        )
        found.append(done)
        first += settled
    pieces = concatenate_rows(found)
    # A square root doubles the share that rounding is of a small speed: 1e-12 of 200 mm/s is 1e-6 of 1e-4 mm/s.
    for name in ("seconds", "entry", "peak", "exit"):
        assert getattr(pieces, name) == pytest.approx(getattr(whole, name), rel=1e-9, abs=1e-9)


@given(st.lists(st.tuples(st.floats(0, 1e4), st.floats(1e-9, 1e3)), min_size=1, max_size=40))
def test_what_lies_behind_a_long_ramp_is_exact(rows: list[tuple[float, float]]) -> None:
    """After a move that could reach the speed of light, a profile is the same to the last digits."""
    reach = np.array([reach for _, reach in rows])
    joints = np.array([0.0, *(joint for joint, _ in rows)])
    alone = look_ahead(joints, reach)
    behind = look_ahead(np.concatenate([[0.0], joints]), np.concatenate([[9e22], reach]))[1:]
    before = look_ahead(np.concatenate([joints, [0.0]]), np.concatenate([reach, [9e22]]))[:-1]
    assert behind == pytest.approx(alone, rel=1e-12, abs=0)
    assert before == pytest.approx(alone, rel=1e-12, abs=0)


def test_a_long_file_is_as_exact_as_a_short_one() -> None:
    """The same 60,000 moves four times over, with a stop after each, take four times as long to ten digits."""
    turn = np.cumsum(np.random.default_rng(1).normal(0, 0.3, MOVES_AT_ONCE - 4000))
    once = moves_of(2 * np.column_stack([np.cos(turn), np.sin(turn)]), 200)
    stop = np.zeros(4 * len(once), dtype=bool)
    stop[:: len(once)] = True
    several = replace(moves_of(np.tile(once.delta, (4, 1)), 200), stop=stop)
    limits = [replace(STEADY, travel_acceleration=20000)]
    assert plan_moves(several, limits).seconds.sum() == pytest.approx(
        4 * plan_moves(once, limits).seconds.sum(), rel=1e-10
    )


# --- the cruise ratio ------------------------------------------------------------------------------------


def test_a_rise_and_a_fall_share_a_top() -> None:
    """Humps: up over two moves, down over two; the moves in between keep the top."""
    joints = np.array([0.0, 50, 100, 100, 50, 0])
    reach = np.array([50.0, 50, 30, 50, 50])
    assert hump_tops(joints, reach, np.full(5, 900.0)).tolist() == [115.0] * 5
    assert hump_tops(joints, reach, np.full(5, 101.0)).tolist() == [101.0] * 5


def test_a_higher_ratio_takes_longer() -> None:
    turn = np.cumsum(np.random.default_rng(2).normal(0, 0.8, 500))
    moves = moves_of(np.column_stack([np.cos(turn), np.sin(turn)]), 200)
    times = [plan_moves(moves, [replace(STEADY, minimum_cruise_ratio=r)]).seconds.sum() for r in (0, 0.2, 0.5, 0.9)]
    assert times == sorted(times)
    assert times[-1] > 1.05 * times[0]


def test_every_model_is_tried() -> None:
    assert {limits.model for limits in EVERY} == set(MODELS)


def test_nothing_takes_no_time() -> None:
    assert isinstance(plan_moves(moves_of(np.empty((0, 4)), []), [PLAIN]), MotionPlan)
    assert total(np.empty((0, 4)), [], PLAIN) == 0
