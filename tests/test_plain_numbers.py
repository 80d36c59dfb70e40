"""Numbers and counts in what a person reads: no 1.94e+03 and no "component(s)", in any message or summary."""

from __future__ import annotations

import math
import re
from decimal import Decimal
from pathlib import Path

import pytest
import trimesh
from hypothesis import example, given, settings
from hypothesis import strategies as st
from test_command_line import COMMANDS, run

from infill.plain_numbers import LARGEST, SMALLEST, count_noun, plain_argument, plain_number, plain_size
from patterns.declared import format_decimal

EXPONENT = re.compile(r"\d[eE][+-]?\d\d")
EITHER_NUMBER = re.compile(r"\w\((?:s|es|ies)\)")


# --- the numbers themselves ------------------------------------------------------------------------------


@given(st.floats(SMALLEST, LARGEST / 10), st.integers(1, 10), st.booleans())
@example(value=999.96, digits=4, negative=False)
@example(value=1944.6, digits=3, negative=True)
@settings(deadline=None)
def test_a_number_is_rounded_and_has_no_exponent(value: float, digits: int, negative: bool) -> None:
    """As `:.3g` rounds, where that has no exponent; half a unit of the last digit at most, everywhere."""
    value = -value if negative else value
    text = plain_argument(value, digits)
    assert re.fullmatch(r"-?\d+(\.\d*[1-9])?", text)
    assert abs(Decimal(text) - Decimal(value)) <= Decimal(10) ** (math.floor(math.log10(abs(value))) + 1 - digits)
    assert plain_number(value, digits).replace(",", "") == text
    short = f"{value:.{digits}g}"
    assert "e" in short or short == text


def test_numbers_beyond_all_sizes_name_a_bound() -> None:
    assert plain_number(1e-300) == f"under {SMALLEST:.9f}"
    assert plain_number(-1e300) == "under -1,000,000,000,000,000"
    assert [plain_argument(value) for value in (math.inf, math.nan, 0.0)] == ["inf", "nan", "0"]
    assert format_decimal(1e-7) == "0.0000001"


@pytest.mark.parametrize(("count", "text"), [(0, "0 holes"), (1, "1 hole"), (1200, "1,200 holes")])
def test_a_count_has_its_noun(count: int, text: str) -> None:
    assert count_noun(count, "hole") == text


# --- what is on the screen -------------------------------------------------------------------------------


def assert_plain(text: str) -> None:
    """Raise AssertionError for the first exponent or "(s)" in a text."""
    assert not EXPONENT.search(text), text
    assert not EITHER_NUMBER.search(text), text


@pytest.mark.parametrize("text", ["1.94e+03 mm²", "1e-05", "6 hole(s)"])
def test_a_text_with_a_slip_is_found(text: str) -> None:
    with pytest.raises(AssertionError):
        assert_plain(text)


@pytest.mark.parametrize("command", COMMANDS)
def test_help_is_plain(command: str) -> None:
    assert_plain(run(command, "--help").stdout)


@pytest.mark.parametrize("name", ["", "hilbert", "voronoi-foam"])
def test_the_list_is_plain(name: str) -> None:
    assert_plain(run("list", *name.split()).stdout)


@pytest.fixture(scope="module")
def sizes(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Boxes of two metres and of a hundredth of a millimetre, one with a face missing and one with a cavity."""
    folder = tmp_path_factory.mktemp("sizes")
    box = trimesh.creation.box((2000, 1500, 1250))
    cavity = trimesh.creation.box((700, 700, 700))
    cavity.invert()
    meshes = {
        "huge": box,
        "tiny": trimesh.creation.box((0.01, 0.012, 0.011)),
        "open": trimesh.Trimesh(vertices=box.vertices, faces=box.faces[1:]),
        "hollow": trimesh.util.concatenate([box, cavity]),
    }
    for name, mesh in meshes.items():
        mesh.export(folder / f"{name}.stl")
    return {name: folder / f"{name}.stl" for name in meshes}


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("huge", "watertight           yes"),
        ("huge", "volume, area         3.75 m³, 14,750,000 mm²"),
        ("open", "watertight           no, 3 open edges"),
        ("hollow", "1 part with 1 sealed cavity"),
        ("tiny", "1,320 µm³"),
    ],
)
def test_check_is_plain(name: str, says: str, sizes: dict[str, Path]) -> None:
    text = run("check", sizes[name]).stdout
    assert re.sub(r"\s+", " ", says) in re.sub(r"\s+", " ", text)
    assert_plain(text)


@pytest.mark.parametrize(
    "words",
    [
        ("smooth", "huge", "--dry-run", "--resolution", "30"),
        ("smooth", "tiny", "--dry-run", "--resolution", "30"),
        ("smooth", "huge", "--dry-run", "--voxel", "0.0000001"),
        ("smooth", "huge", "--dry-run", "--voxel", "12345678"),
        ("smooth", "tiny", "--dry-run", "--voxel", "1000000"),
        ("fill", "tiny", "--dry-run"),
        ("fill", "huge", "--dry-run", "--wall", "0.0000001"),
        ("fill", "huge", "--dry-run", "--wall", "1000000"),
    ],
)
def test_plans_and_errors_are_plain(words: tuple[str, ...], sizes: dict[str, Path]) -> None:
    """Sizes that `:g` writes with an exponent."""
    result = run(*(sizes.get(word, word) for word in words))
    assert result.stdout or result.stderr
    assert_plain(result.output)


# --- sizes with a unit -----------------------------------------------------------------------------------

MM = {"nm": 1e-6, "µm": 1e-3, "mm": 1.0, "m": 1e3, "km": 1e6}


@given(st.floats(1e-8, 1e9), st.integers(1, 3), st.integers(2, 6))
@example(value=1.23e-4, power=1, digits=3)
@example(value=123456789.0, power=1, digits=3)
@settings(deadline=None)
def test_a_size_is_short_and_its_unit_is_right(value: float, power: int, digits: int) -> None:
    """The value up to the digits; no three zeros behind the point, and at most a thousand millions of a unit."""
    number, unit = plain_size(value, digits=digits, power=power).split()
    name = unit.rstrip("²³")
    assert unit.removeprefix(name) == {1: "", 2: "²", 3: "³"}[power]
    shown = float(number.replace(",", ""))
    assert shown * MM[name] ** power == pytest.approx(value, rel=0.5 * 10 ** (1 - digits) + 1e-9)
    assert not number.startswith("0.000")
    assert len(number.split(".")[0].replace(",", "")) <= 9


def test_sizes_that_belong_together_share_a_unit() -> None:
    assert plain_size(2e6, 2e6, 1) == "2,000 x 2,000 x 0.001 m"
    assert plain_size(2e-5, 1e-5, digits=4) == "0.02 x 0.01 µm"
    assert [plain_size(0), plain_size(1.2), plain_size(99_999, digits=6)] == ["0 mm", "1.2 mm", "99,999 mm"]


@pytest.mark.usefixtures("compiled")
@pytest.mark.parametrize(
    ("radius", "size"), [(1e-4, r"0\.\d+ x 0\.\d+ x 0\.\d+ µm"), (1e6, r"\d,\d+ x \d,\d+ x \d,\d+ m")]
)
def test_parts_of_any_size_are_told_in_short_numbers(radius: float, size: str, tmp_path: Path) -> None:
    trimesh.creation.icosphere(2, radius).export(tmp_path / "ball.stl")
    done = run("smooth", tmp_path / "ball.stl", "--resolution", "24", "-o", tmp_path / "out.stl")
    assert done.exit_code == 0
    assert re.search(size, done.stderr)
    summary = done.stderr[done.stderr.index("mesh  ") :].split("wrote")[0]
    typed = re.sub(r"--[a-z-]+ [\d.]+", "", summary)  # options take mm
    assert not re.search(r"0\.0000\d*(?![\d%])|\d,\d{3},\d{3},\d{3}|under|over", typed), summary
    checked = run("check", tmp_path / "out.stl").stdout
    assert re.search(size, checked)
