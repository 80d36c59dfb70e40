"""Numbers and choices at every door: options of commands, config files and Python take the same forms."""

from __future__ import annotations

import math
from typing import Any, get_args, get_origin

import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_command_line import COMMANDS, run, usage_error
from test_options import options_of

from infill import UsageError
from infill.cli.typed_values import NUMBERS, WHOLE, TypedValueError, rewrite_values
from infill.lattices.request import check_request
from infill.lattices.settings import FillOptions
from infill.making.settings import MakeSettings
from infill.options.declaration import DeclaredOption, declared_options, unit_of
from infill.options.keyword_options import parse_share
from infill.refilling.request import Request
from infill.smoothing.settings import SmoothSettings
from patterns.quantities import UNITS, parse_quantity

# The table of docs/commands.md: text, and the number that it means in the unit of the option.
FORMS = {"0.5": 0.5, ".5": 0.5, "0,5": 0.5, "5e-1": 0.5, " 0.5 ": 0.5, "-2": -2.0, "3": 3.0}
LENGTHS = {"5mm": 5.0, "5 mm": 5.0, "0,5cm": 5.0, "500um": 0.5, "1in": 25.4, "1 INCH": 25.4, "0.002m": 2.0}
NO_NUMBERS = ("", "x", "5 5", "1,500", "1.2.3", "5mm5", "0x10", "5 parsec", "--5")
DECLARATIONS: dict[str, Any] = {"make": MakeSettings, "fill": FillOptions, "smooth": SmoothSettings}


@given(number=st.floats(allow_nan=False, allow_infinity=False), unit=st.sampled_from(sorted(UNITS)))
def test_numbers_are_read_as_python_writes_them(number: float, unit: str) -> None:
    assert parse_quantity(repr(number)) == number
    for typed, factor in UNITS[unit].items():
        assert parse_quantity(f"{number!r}{typed}", unit) == number * factor
        assert parse_quantity(f"{number!r} {typed}") is None  # a unit where none belongs


@pytest.mark.parametrize("command", COMMANDS)
def test_every_option_takes_every_form(command: str) -> None:
    options, numbers = list(options_of(command)), 0
    for option in options:
        flag = max(option.opts, key=len)
        placeholder = option.metavar or ""
        if placeholder in NUMBERS:
            numbers += 1
            forms = FORMS | (LENGTHS if unit_of(placeholder) == "mm" else {})
            count = len(placeholder.split())
            for text, number in forms.items():
                assert rewrite_values(options, [flag, *[text] * count]) == [flag, *[repr(number)] * count]
                assert rewrite_values(options, [f"{flag}={text}"]) == [f"{flag}={number!r}"]
            for text in NO_NUMBERS:
                with pytest.raises(TypedValueError, match=f"^{flag} is .*; (give a number such as|write)"):
                    rewrite_values(options, [flag, text])
        elif placeholder == WHOLE:
            assert rewrite_values(options, [flag, "7"]) == [flag, "7"]
            with pytest.raises(TypedValueError, match=f"^{flag} is .2.5.; give a whole number"):
                rewrite_values(options, [flag, "2.5"])
    assert numbers or command in (
        "check",
        "list",
        "mcp",
        "sample",
        "setup",
        "studio",
        "verify",
        "view",
    )  # which take none, or shares alone


def test_what_follows_two_dashes_and_flags_stay_as_they_are() -> None:
    options = list(options_of("fill"))
    words = ["0,5.stl", "--vent", "--", "--cell", "5mm"]
    assert rewrite_values(options, words) == words


@pytest.mark.parametrize("command", DECLARATIONS)
def test_config_files_take_the_same_forms(command: str) -> None:
    entries = [entry for entry in declared_options(DECLARATIONS[command]).values() if is_plain_number(entry)]
    assert len(entries) > 4
    for entry in entries:
        forms = FORMS | (LENGTHS if unit_of(entry.option.unit) == "mm" else {})
        assert all(entry.read(text) == entry.read(number) == number for text, number in forms.items())
        for text in NO_NUMBERS:
            with pytest.raises(UsageError, match=entry.key):
                entry.read(text)


def is_plain_number(entry: DeclaredOption) -> bool:
    return entry.kind is float and entry.option.read is None


@pytest.mark.parametrize("share", ["20%", "20", "0.2", "0,2", "20.0 %", 20, 20.0, 0.2])
def test_a_density_is_the_same_at_every_door(share: Any) -> None:
    assert parse_share("density", share) == pytest.approx(0.2, rel=1e-15)
    assert check_request(pattern="gyroid", own={}, density=share).density == pytest.approx(0.2, rel=1e-15)
    assert declared_options(FillOptions)["density"].read(share) == pytest.approx(0.2, rel=1e-15)
    assert declared_options(MakeSettings)["density"].read(share) == pytest.approx(0.2, rel=1e-15)
    assert Request(pattern="gyroid", density=share).density == pytest.approx(0.2, rel=1e-15)


def test_a_density_of_one_or_less_is_a_share() -> None:
    assert [parse_share("density", value) for value in (1, "1", "1%", 1.5, "100")] == [1.0, 1.0, 0.01, 0.015, 1.0]
    assert math.isclose(check_request(pattern="gyroid", own={}, density=(40, 0.15)).grading.first, 0.4)  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("option", "typed", "meant"),
    [
        ("units", "inch", "in"),
        ("units", "MM", "mm"),
        ("for", "prusa", "prusaslicer"),
        ("for", "Orca", "orcaslicer"),
        ("for", "bambu", "bambustudio"),
        ("for", "Cura", "cura"),
        ("align", "BED", "bed"),
    ],
)
def test_choices_have_other_names(option: str, typed: str, meant: str) -> None:
    assert rewrite_values(list(options_of("fill")), [f"--{option}", typed]) == [f"--{option}", meant]
    assert declared_options(FillOptions)[option].read(typed) == ((meant,) if option == "for" else meant)


def test_a_choice_that_is_none_shows_what_was_typed() -> None:
    usage_error(run("fill", "part.stl", "--for", "slic3r", "-o", "a.3mf"), "--for.*slic3r.*prusaslicer")


def test_every_choice_of_every_declaration_is_itself() -> None:
    for declaration in DECLARATIONS.values():
        for entry in declared_options(declaration).values():
            if get_origin(entry.kind) is not None and all(isinstance(word, str) for word in get_args(entry.kind)):
                assert [entry.read(word) for word in get_args(entry.kind)] == list(get_args(entry.kind))
