"""Refilling changes the sparse infill and nothing else, in every print of the corpus: an independent judge says so."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import pytest
from hypothesis import Phase, given, settings

from infill import FormatError, InfillError, ParameterError, refill, verify
from tests.gcode_corpus import CORPUS, prints
from tests.gcode_judge import changed, infilled, judge, pushed
from tests.gcode_structure import bonded, supported

# What a pattern's filament may be of the slicer's own: rounding shortens paths, most so a Hilbert curve's, and a curve in
# the place of chords is a little longer.
FILAMENT = {"keep": (0.8, 1.003), "honeycomb": (0.99, 1.01)}
# A gyroid's length changes with the height: over four layers it does not even out, and beads take 8 % at most.
UNEVEN = {
    ("prusa-gyroid", "honeycomb"): (0.94, 1.03),
    ("cura", "honeycomb"): (0.94, 1.03),
    ("cura-relative", "honeycomb"): (0.94, 1.03),
}
STRAIGHT = "straight lines have no corner"
SLOWED = "every layer is slowed for cooling"
COMBINED = "layers printed as one have no region to tell"
# What is kept as it was, and why: the test fails if it is not.
KEPT: dict[tuple[str, str], str] = {
    ("prusa-loose-lines", "keep"): STRAIGHT,
    ("cura-firmware", "keep"): STRAIGHT,
    ("cura-combined", "keep"): STRAIGHT,
    ("prusa-slowed", "keep"): SLOWED,
    ("prusa-slowed", "honeycomb"): SLOWED,
    ("prusa-equalised", "keep"): "speed changes from move to move",
    ("orca-limits", "honeycomb"): "a G4 in every section, and it is not known when to wait",
}
# Where fewer than half of the sections are replaced.
FEW = {("odd", "honeycomb"): "commands of all kinds stand between the beads"}
# What is refused in one line, and why.
REFUSED: dict[tuple[str, str], str] = {
    ("orca-numbered", "keep"): "with a number before it, a tag is none",
    ("orca-numbered", "honeycomb"): "with a number before it, a tag is none",
}


def refilled(path: Path, output: Path, pattern: str) -> bytes:
    refill(path, output=output, pattern=pattern)
    return output.read_bytes()


def pairs() -> list[tuple[str, str]]:
    """Return each print with one pattern, in turn, and with the other one if something is special about it."""
    special = {*KEPT, *REFUSED, *UNEVEN, *FEW}
    return [
        (name, pattern)
        for number, name in enumerate(CORPUS)
        for turn, pattern in enumerate(FILAMENT)
        if number % 2 == turn or (name, pattern) in special
    ]


@pytest.mark.long
@pytest.mark.parametrize(("name", "pattern"), pairs())
def test_nothing_else_changes(name: str, pattern: str, prints_of_all_kinds: Mapping[str, Path], tmp_path: Path) -> None:
    entry = CORPUS[name]
    if entry.missing():
        pytest.skip(entry.missing())
    path, output = prints_of_all_kinds[name], tmp_path / "out.gcode"
    old = path.read_bytes()
    if (name, pattern) in REFUSED:
        with pytest.raises((FormatError, ParameterError)) as error:
            refill(path, output=output, pattern=pattern)
        assert "\n" not in str(error.value)
        assert not output.exists()
        return
    new = refilled(path, output, pattern)
    assert path.read_bytes() == old
    assert judge(old, new, filament=UNEVEN.get((name, pattern), FILAMENT[pattern])) == []
    if pattern == "honeycomb":  # test_verify.py has the others
        assert list(map(str, verify(path, output).violations)) == []
    replaced = changed(old, new)
    if (name, pattern) in KEPT or not entry.infilled:
        assert replaced == 0
    else:
        assert replaced >= (1 if (name, pattern) in FEW else 0.5 * infilled(old))
    refill(output, pattern=pattern)  # which finds the stamp, and does nothing
    assert output.read_bytes() == new


@pytest.mark.long
@pytest.mark.parametrize("pattern", FILAMENT)
def test_in_place_is_as_beside(pattern: str, prints_of_all_kinds: Mapping[str, Path], tmp_path: Path) -> None:
    path = tmp_path / "print.gcode"
    old = prints_of_all_kinds["orca"].read_bytes()
    path.write_bytes(old)
    beside = refilled(path, tmp_path / "beside.gcode", pattern)
    assert path.read_bytes() == old
    refill(path, pattern=pattern)
    assert path.read_bytes() == beside != old
    assert sorted(p.name for p in tmp_path.iterdir()) == ["beside.gcode", "print.gcode"]


@pytest.mark.slow
def test_a_kept_path_is_shorter(prints_of_all_kinds: Mapping[str, Path], tmp_path: Path) -> None:
    """Filament, as the judge counts it: of the infill, and of all else."""
    path = prints_of_all_kinds["bambu"]
    infill, rest = pushed(path.read_bytes())
    kept = pushed(refilled(path, tmp_path / "keep.gcode", "keep"))
    assert kept[1] == pytest.approx(rest, abs=1e-3)  # mm: roundings of some hundred lines
    assert 0.85 * infill < kept[0] < infill


@pytest.mark.long
@pytest.mark.parametrize(
    "name", ["prusa", "prusa-absolute", "prusa-grid", "prusa-gyroid", "cura-slowed", "cura", "orca"]
)
@pytest.mark.parametrize("deviation", [0.05, 0.15])
def test_kept_paths_lie_as_near_as_is_asked(
    name: str, deviation: float, prints_of_all_kinds: Mapping[str, Path], tmp_path: Path
) -> None:
    """Then travels and retractions are the slicer's too. Curves are cut into chords, which lie 0.02 mm off at most."""
    if CORPUS[name].missing():
        pytest.skip(CORPUS[name].missing())
    path, output = prints_of_all_kinds[name], tmp_path / "out.gcode"
    refill(path, output=output, max_deviation=deviation)
    old, new = path.read_bytes(), output.read_bytes()
    assert changed(old, new)
    assert judge(old, new, deviation=deviation + 0.02, filament=FILAMENT["keep"]) == []


@pytest.mark.long
@pytest.mark.parametrize(
    "name",
    [
        "prusa",
        "prusa-ring",
        "prusa-combined",
        "prusa-two-tools",
        "prusa-3d-honeycomb",
        "prusa-hilbert",
        "prusa-gyroid",
        "cura",
    ],
)
def test_what_holds_infill_together_stays(name: str, prints_of_all_kinds: Mapping[str, Path], tmp_path: Path) -> None:
    """Round corners leave at least 0.94 of what lies on the layer below, and of what touches the next strand."""
    if CORPUS[name].missing():
        pytest.skip(CORPUS[name].missing())
    path = prints_of_all_kinds[name]
    old, new = path.read_bytes(), refilled(path, tmp_path / "out.gcode", "keep")
    assert supported(new) >= 0.94 * supported(old)
    assert bonded(new) >= 0.94 * bonded(old) - 0.01  # samples are 0.1 mm apart, and such touches 2 mm long


# What fails is a whole print, which to shrink takes minutes.
@pytest.mark.longest
@settings(max_examples=12, phases=[Phase.explicit, Phase.generate])
@given(data=prints())
@pytest.mark.parametrize("pattern", FILAMENT)
def test_nothing_else_changes_in_any_dialect(
    pattern: str, data: bytes, tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder = tmp_path_factory.mktemp("any")
    path = folder / "print.gcode"
    path.write_bytes(data)
    try:
        new = refilled(path, folder / "out.gcode", pattern)
    except InfillError:
        assert pattern != "keep"
        return
    assert judge(data, new, filament=(0.7, 1.01) if pattern == "keep" else (0.5, 1.3)) == []  # of regions of some mm
    if pattern == "keep" and re.search(rb"^M82", new, re.MULTILINE):  # other paths set the counter once a section
        assert new.count(b"G92 E") >= data.count(b"G92 E")


@pytest.mark.longest
def test_one_object_of_two(prints_of_all_kinds: Mapping[str, Path], tmp_path: Path) -> None:
    """The sections of the other one are as they were; a name that no object bears is refused."""
    path, output = prints_of_all_kinds["prusa-labels"], tmp_path / "out.gcode"
    names = sorted(set(re.findall(rb"^; printing object (.*)$", path.read_bytes(), re.MULTILINE)))
    assert len(names) == 2
    whole = refill(path, output=output).report["sections"]
    halves = [refill(path, output=output, part=name.decode()).report["sections"] for name in names]
    assert all(half["replaced"] > 0 for half in halves)
    assert sum(half["replaced"] for half in halves) == whole["replaced"]
    assert halves[0]["kept"]["another object"] == halves[1]["replaced"]
    before = output.read_bytes()
    with pytest.raises(
        ParameterError, match="part is 'nobody', which is in no name of an object; it has .*id:1 copy 0"
    ):
        refill(path, output=output, part="nobody")
    assert output.read_bytes() == before


@pytest.mark.longest
@pytest.mark.parametrize("firmware", ["marlin", "klipper"])
def test_one_object_of_two_that_commands_name(
    firmware: str, prints_of_all_kinds: Mapping[str, Path], tmp_path: Path
) -> None:
    """The same sections as with the comments of the slicer, which M486 or EXCLUDE_OBJECT stand for."""
    original, path = prints_of_all_kinds["prusa-labels"], tmp_path / "print.gcode"
    names = sorted(set(re.findall(rb"^; printing object (.*)$", original.read_bytes(), re.MULTILINE)))
    text = b"".join(b"M486 S%d\nM486 A%b\n" % pair for pair in enumerate(names)) + b"M486 S-1\n"
    text = (text if firmware == "marlin" else b"") + original.read_bytes()
    for number, name in enumerate(names):
        command = b"M486 S%d" % number if firmware == "marlin" else b"EXCLUDE_OBJECT_START NAME='%b'" % name
        text = text.replace(b"; printing object " + name, command)
    ended = rb"M486 S-1" if firmware == "marlin" else rb"EXCLUDE_OBJECT_END"
    path.write_bytes(re.sub(rb"^; stop printing object.*$", ended, text, flags=re.MULTILINE))
    assert b"printing object" not in path.read_bytes()
    for name in names:
        expected, found = (
            refill(each, output=tmp_path / "out.gcode", part=name.decode()).report["sections"]
            for each in (original, path)
        )
        assert found == expected
        assert found["replaced"] > 0
