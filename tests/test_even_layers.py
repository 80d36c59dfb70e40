"""Layers of even time or filament: a print whose sections change, as sliced, refilled, and refilled evenly."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from handmade_prints import Dialect, written
from hypothesis import given
from hypothesis import strategies as st

from infill import ParameterError, UsageError, motion, refill
from infill.refilling.even_layers import MOST_TIMES_SLOWER, choose_shares, next_paces

SIZES = (30.0, 30.5, 30.1, 30.6, 30.3, 30.8, 30.2)  # mm, of layers, over and over
INNER = slice(1, -1)  # the first and the last layer are solid


@pytest.fixture(scope="module")
def changing(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A box whose sections change from layer to layer, in 23 layers of which 21 hold infill."""
    path = tmp_path_factory.mktemp("changing") / "print.gcode"
    path.write_bytes(written(Dialect(layers=23, size=31.0, sizes=SIZES)))
    return path


def evened(path: Path, **options: Any) -> tuple[Path, dict[str, Any]]:
    """Refill a print under a name of its own; return it with the report."""
    output = path.with_name("-".join(map(str, ["out", *options.values()])) + ".gcode")
    return output, dict(refill(path, output=output, **options).report)


def spread(values: Any) -> float:
    return float(np.std(np.diff(values[INNER])))


def places(path: Path) -> list[bytes]:
    """Return the lines of a print without filament, speed and comments."""
    lines = [re.sub(rb" ?[EF][-.\d]+| *;.*|^M73.*", b"", line).strip() for line in path.read_bytes().splitlines()]
    return [line for line in lines if line not in (b"", b"G1")]


@pytest.mark.longest
@pytest.mark.parametrize("pattern", ["honeycomb", "gyroid"])
def test_layers_of_changing_sections_take_even_filament(changing: Path, pattern: str) -> None:
    """In beads of other widths along the same paths, so that nothing crosses that did not, and of the same filament."""
    plain, _ = evened(changing, pattern=pattern)
    even, report = evened(changing, pattern=pattern, even="volume")
    before, after = motion(plain).by_layer.filament, motion(even).by_layer.filament
    assert spread(after) < spread(before) * 2 / 3
    infill = report["filament"]
    assert infill["infill_after_mm"] == pytest.approx(infill["infill_before_mm"], rel=0.01)
    assert sum(after) == pytest.approx(sum(before), rel=0.01)
    assert places(even) == places(plain)
    told = report["even"]
    assert told["steps"] == 20
    assert told["unit"] == "mm"
    for name, values in {"sliced": motion(changing).by_layer.filament, "before": before, "after": after}.items():
        assert told[f"spread_{name}"] == pytest.approx(spread(values), abs=1e-3)
        assert told[f"median_step_{name}"] == pytest.approx(np.median(np.abs(np.diff(values[INNER]))), abs=1e-3)


@pytest.mark.longest
@pytest.mark.parametrize("pattern", ["honeycomb", "gyroid"])
def test_layers_of_changing_sections_take_even_time(changing: Path, pattern: str) -> None:
    """By infill that is slower, with the same filament along the same paths; never faster, nor slower than allowed."""
    plain, _ = evened(changing, pattern=pattern)
    even, report = evened(changing, pattern=pattern, even="time", leeway="20%")
    before, after = motion(plain).by_layer, motion(even).by_layer
    assert spread(after.seconds) < spread(before.seconds) * 2 / 3
    assert after.filament == pytest.approx(before.filament)
    assert places(even) == places(plain)
    longer = np.subtract(after.seconds, before.seconds)
    assert longer.min() > -0.01
    (infill,) = [each for each in motion(plain).features if each.role == "sparse infill"]
    assert 0 < longer.sum() < 0.2 * infill.seconds
    for name, values in {"before": before.seconds, "after": after.seconds}.items():
        assert report["even"][f"spread_{name}"] == pytest.approx(spread(values), rel=0.02, abs=0.01)


def test_layers_are_evened_out_for_new_patterns_only(changing: Path) -> None:
    with pytest.raises(UsageError, match="pattern"):
        refill(changing, dry_run=True, even="time")
    with pytest.raises(UsageError, match="even time"):
        refill(changing, dry_run=True, pattern="gyroid", leeway="5%")
    with pytest.raises(ParameterError, match="50%"):
        refill(changing, dry_run=True, pattern="gyroid", even="time", leeway="60%")


AMOUNTS = st.lists(st.floats(1, 100), min_size=1, max_size=20).map(np.array)


@given(AMOUNTS, st.floats(0.01, 0.5), st.booleans())
def test_shares_stay_in_their_leeway_and_keep_the_sum(amounts: np.ndarray, leeway: float, keeps_sum: bool) -> None:
    gain = np.where(np.arange(len(amounts)) % 5 == 4, 0.0, amounts / 2)
    shares = choose_shares(
        amounts, gain, np.full(len(gain), 1 - leeway), np.full(len(gain), 1 + leeway), keeps_sum=keeps_sum
    )
    assert (np.abs(shares - 1) <= leeway * (1 + 1e-9)).all()
    assert (shares[gain == 0] == 1).all()
    if keeps_sum:
        assert (shares * gain).sum() == pytest.approx(gain.sum(), rel=1e-6)


def test_a_step_beyond_all_leeway_stays_and_so_do_the_layers_around_it() -> None:
    amounts = np.array([10.0, 10, 10, 90, 90, 90])
    shares = choose_shares(amounts, amounts / 2, np.full(6, 0.9), np.full(6, 1.1), keeps_sum=False)
    assert shares.tolist() == [1.0] * 6


@given(AMOUNTS, st.floats(0, 200), st.floats(0, 200))
def test_paces_slow_down_and_no_more_than_allowed(paces: np.ndarray, gained: float, wanted: float) -> None:
    paces = np.clip(paces, 1, MOST_TIMES_SLOWER)
    new = next_paces([(paces, np.full(len(paces), gained))], np.full(len(paces), wanted))
    assert ((new >= 1) & (new <= MOST_TIMES_SLOWER)).all()
    if gained >= wanted:
        assert (new <= paces + 1e-9).all()
