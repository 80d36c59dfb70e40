"""What slicers call things: whole names, both families of tags, no name in two roles."""

from __future__ import annotations

import pytest

from infill.gcode.dialect import OTHER_ROLE, ROLES, TAGS, UNTAGGED, parse_tag, role_of


def test_a_name_has_one_role() -> None:
    names = [name for several in ROLES.values() for name in several]
    assert len(names) == len(set(names))
    assert OTHER_ROLE not in ROLES
    for role, several in ROLES.items():
        assert {role_of(name) for name in several} == {role}


@pytest.mark.parametrize("name", [b"infill", b"Internal infill 2", b"internal INFILL", b"FILLER", b" "])
def test_only_whole_names_count(name: bytes) -> None:
    assert role_of(name) == OTHER_ROLE


def test_no_name_is_untagged() -> None:
    assert role_of(b"") == UNTAGGED
    assert UNTAGGED not in ROLES


def test_both_families_say_the_same() -> None:
    assert parse_tag(b";TYPE:Perimeter\r\n") == ("role", b"Perimeter")
    assert parse_tag(b"; FEATURE: Inner wall\n") == ("role", b"Inner wall")
    assert parse_tag(b"; Z_HEIGHT: 0.4") == parse_tag(b";Z:0.4") == ("z", b"0.4")
    assert parse_tag(b"; LAYER_HEIGHT: 0.2") == parse_tag(b";HEIGHT:0.2") == ("height", b"0.2")
    assert parse_tag(b"; LINE_WIDTH: 0.45") == parse_tag(b";WIDTH:0.45") == ("width", b"0.45")
    assert parse_tag(b"; CHANGE_LAYER") == parse_tag(b";LAYER_CHANGE") == ("layer", b"")
    assert parse_tag(b"; layer num/total_layer_count: 1/9") is None


def test_no_tag_hides_another() -> None:
    """The first that fits wins, so none may begin like one before it."""
    seen: list[bytes] = []
    for prefix in TAGS:
        assert not any(prefix.startswith(earlier) for earlier in seen)
        seen.append(prefix)
