"""Prints that are packed: `refill` and `motion` of archives of plates (.gcode.3mf), and `motion` of binary G-code."""

from __future__ import annotations

import hashlib
import io
import json
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest
from test_binary_gcode import HEAD, block, made, parts
from test_command_line import one_line_error, run

from infill import FormatError, ParameterError, motion, refill
from infill.gcode.binary import encode_block, pack_block
from infill.planner.layer_speeds import layer_speeds, middle_layer
from tests.gcode_judge import changed, judge
from tests.handmade_prints import Dialect, written

STAMP = b"; refilled by phasefill"
ONE = written(Dialect(slicer="bambu", layers=5))
TWO = written(Dialect(slicer="bambu", layers=4, size=9.0))
NAME = "part.gcode.3mf"
POSIX = pytest.mark.skipif(sys.platform == "win32", reason="signals and limits as POSIX has them")


def digest(text: bytes) -> bytes:
    return hashlib.md5(text).hexdigest().upper().encode()


def packed(texts: dict[int, bytes], summed: dict[int, bytes] | None = None) -> bytes:
    """An archive as Bambu Studio writes it, with a picture that is stored and settings that are compressed."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as new:
        new.writestr("[Content_Types].xml", "<Types/>")
        new.writestr("3D/3dmodel.model", "<model/>" * 50)
        for plate, text in texts.items():
            new.writestr(zipfile.ZipInfo(f"Metadata/plate_{plate}.png"), bytes(range(256)))
            new.writestr(f"Metadata/plate_{plate}.gcode", text)
            new.writestr(f"Metadata/plate_{plate}.gcode.md5", digest((summed or texts)[plate]))
        new.writestr("Metadata/slice_info.config", '<metadata key="prediction" value="81"/>')
    return file.getvalue()


def members(path: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def text_of(path: Path, plate: int) -> bytes:
    return members(path)[f"Metadata/plate_{plate}.gcode"]


@pytest.fixture
def archive(tmp_path: Path) -> Path:
    """Two plates, of which the first stands last."""
    path = tmp_path / NAME
    path.write_bytes(packed({2: TWO, 1: ONE}))
    return path


@pytest.fixture
def binary(tmp_path: Path) -> Path:
    path = tmp_path / "part.bgcode"
    path.write_bytes(b"".join(parts([pack_block(encode_block(ONE, like=made(compression=3, encoding=2)))])))
    return path


# --- refill ----------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_every_plate_is_refilled_and_nothing_else(archive: Path) -> None:
    old = members(archive)
    report = refill(archive).report
    new = members(archive)
    assert list(new) == list(old)
    for plate, text, sections in ((1, ONE, 3), (2, TWO, 2)):  # all but the first layer and the last
        name = f"Metadata/plate_{plate}.gcode"
        after = new.pop(name)
        assert old.pop(name) == text
        assert after.count(STAMP) == 1
        assert judge(text, after, filament=(0.85, 1.003)) == []
        assert changed(text, after) == sections
        assert new.pop(f"{name}.md5") == digest(after) != old.pop(f"{name}.md5")
    assert new == old
    assert report["sections"] == {"all": 5, "replaced": 5, "kept": {}}
    assert [path.name for path in archive.parent.iterdir()] == [NAME]


@pytest.mark.slow
def test_a_plate_comes_out_as_its_text_alone(archive: Path, tmp_path: Path) -> None:
    """And the report sums up what those of the texts say."""
    report = refill(archive).report
    alone = []
    for plate, text in ((1, ONE), (2, TWO)):
        path = tmp_path / f"{plate}.gcode"
        path.write_bytes(text)
        alone.append(refill(path).report)
        assert text_of(archive, plate) == path.read_bytes()
    assert report["print"]["plates"] == [1, 2]
    assert report["problems"] == []
    for section, key in (
        ("print", "layers"),
        ("print", "bytes"),
        ("sections", "all"),
        ("sections", "replaced"),
        ("rounding", "corners"),
    ):
        assert report[section][key] == sum(each[section][key] for each in alone), key
    for section, key in (
        ("filament", "infill_before_mm"),
        ("filament", "infill_after_mm"),
        ("time", "infill_before_s"),
        ("time", "infill_after_s"),
        ("contact", "measured_mm"),
    ):
        assert report[section][key] == pytest.approx(sum(each[section][key] for each in alone), rel=1e-12), key
    ratios = sorted(each["filament"]["print_ratio"] for each in alone)
    assert ratios[0] <= report["filament"]["print_ratio"] <= ratios[1]


@pytest.mark.slow
def test_a_second_run_does_nothing(archive: Path) -> None:
    assert run("refill", archive).exit_code == 0
    once = archive.read_bytes()
    result = run("refill", archive)
    assert "it was refilled before" in result.stderr
    assert archive.read_bytes() == once


@pytest.mark.slow
def test_a_plate_that_was_refilled_stays_while_others_are(archive: Path) -> None:
    """As where Bambu Studio ran the script on one plate, and another was sliced later."""
    refill(archive)
    first = text_of(archive, 1)
    archive.write_bytes(packed({1: first, 2: TWO}))
    report = refill(archive).report
    assert not report["print"]["already_refilled"]
    assert report["print"]["layers"] == 4
    assert text_of(archive, 1) == first
    assert STAMP in text_of(archive, 2)


@pytest.mark.slow
def test_the_command_names_the_plates(archive: Path, tmp_path: Path) -> None:
    output = tmp_path / "new.gcode.3mf"
    old = archive.read_bytes()
    result = run("refill", archive, "-o", output, "--json", "--preview", tmp_path / "layer.png")
    assert result.exit_code == 0, result.stderr
    assert "5 of 5 sections in 9 layers" in result.stderr
    assert "plates    1, 2\n" in result.stderr
    assert json.loads(result.stdout)["files"] == [str(output), str(tmp_path / "layer.png")]
    assert archive.read_bytes() == old
    assert (tmp_path / "layer.png").stat().st_size > 1000
    refill(archive)
    assert members(archive) == members(output)


def spoilt(name: str) -> bytes:
    """An archive with something wrong in its second plate, so that all is found before anything is written."""
    if name == "sum":
        return packed({1: ONE, 2: TWO}, summed={1: ONE, 2: ONE})
    if name == "no G-code":
        return packed({})
    if name == "no print":
        return packed({1: ONE, 2: b"hello\n"})
    data = bytearray(packed({1: ONE, 2: TWO}))
    if name == "cut":
        return bytes(data[:-400])
    place = data.index(b"plate_2.gcode") + 500
    data[place : place + 4] = b"\xff" * 4
    return bytes(data)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("sum", rf"{NAME}: plate 2: Metadata/plate_2\.gcode is damaged: its MD5 does not fit"),
        ("no G-code", f"{NAME}: the archive holds no G-code .*; slice the plate, then export it again"),
        ("no print", f"{NAME}: plate 2: the file has no line of G-code in it"),
        ("cut", f"{NAME}: the archive cannot be read"),
        ("bytes", f"{NAME}: plate 2: the archive cannot be read"),
    ],
)
def test_a_damaged_archive_is_one_line_and_stays_as_it_was(name: str, says: str, archive: Path) -> None:
    data = spoilt(name)
    archive.write_bytes(data)
    result = run("refill", archive)
    one_line_error(result, says)
    assert archive.read_bytes() == data
    assert sorted(path.name for path in archive.parent.iterdir()) == [NAME, f"{NAME}.refill.log"]


def test_a_name_that_stands_twice_is_refused(archive: Path) -> None:
    """Readers do not agree on which of the two counts."""
    with zipfile.ZipFile(archive, "a") as more, pytest.warns(UserWarning, match="Duplicate name"):
        more.writestr("Metadata/plate_1.gcode", TWO)
    data = archive.read_bytes()
    with pytest.raises(FormatError, match=r"holds 'Metadata/plate_1\.gcode' twice"):
        refill(archive)
    assert archive.read_bytes() == data


@pytest.mark.longest
@POSIX
def test_ctrl_c_leaves_the_old_archive(archive: Path) -> None:
    """Late in its work, and while it writes."""
    from test_command_line_posix import calls_of, interrupted

    old = archive.read_bytes()
    copy = archive.with_name("copy.3mf")
    copy.write_bytes(old)
    calls = calls_of(["refill", str(copy)])
    copy.unlink()
    for options in ({"calls": int(0.97 * calls)}, {"calls": 30, "writing": archive.parent}):
        interrupted(["refill", str(archive)], **options)
        assert archive.read_bytes() == old
        assert list(archive.parent.iterdir()) == [archive]


@pytest.mark.slow
@POSIX
def test_a_full_disk_leaves_the_old_archive(archive: Path) -> None:
    from test_command_line_posix import limited

    old = archive.read_bytes()
    done = limited(["refill", str(archive)], len(ONE) - 10)
    assert (done.returncode, done.stderr.count("\n")) == (1, 1)
    assert archive.read_bytes() == old


# --- motion ----------------------------------------------------------------------------------------------


def plain(path: Path, text: bytes = ONE) -> dict[str, Any]:
    path.write_bytes(text)
    return {**motion(path).to_dict(), "plate": None, "plates": ()}


def test_motion_takes_the_first_plate_or_the_one_that_is_named(archive: Path, tmp_path: Path) -> None:
    for plate, number, text in ((None, 1, ONE), (1, 1, ONE), (2, 2, TWO)):
        expected = {**plain(tmp_path / "plain.gcode", text), "plate": number, "plates": (1, 2)}
        assert motion(archive, plate=plate).to_dict() == expected
    archive.write_bytes(packed({3: TWO}))
    assert motion(archive).plate == 3


def test_motion_reads_binary_gcode(binary: Path, tmp_path: Path) -> None:
    """The packed text has no comments behind commands, and this one has none to lose."""
    expected = plain(tmp_path / "plain.gcode")
    found = motion(binary).to_dict()
    for name in ("seconds", "filament", "length", "travel"):
        assert found[name] == pytest.approx(expected[name], rel=1e-9), name
    assert found["layers"] == expected["layers"] == 5
    assert [each["name"] for each in found["features"]] == [each["name"] for each in expected["features"]]


def test_binary_gcode_tells_its_machine_outside_the_text(tmp_path: Path) -> None:
    settings = b"gcode_flavor=marlin2\nmachine_max_jerk_x=3\nmachine_max_jerk_y=3\n"
    pieces = [
        HEAD,
        block(0, b"Producer=PrusaSlicer 2.9.0\n"),
        block(4, b"estimated printing time (normal mode)=1m 5s\n"),
        block(2, settings),
        block(1, b"M83\nG1 X0 Y0 F3000\nG1 X10 E.5\nG1 Y10 E.5\n"),
    ]
    path = tmp_path / "print.gcode"
    path.write_bytes(b"".join(pieces))
    found = motion(path)
    assert (found.slicer, found.estimate, found.layers) == ("PrusaSlicer 2.9.0", 65.0, 0)
    assert (found.limits["jerk"][:2], found.sources["jerk"]) == ([3.0, 3.0], "settings")


def test_a_layer_of_a_plate(archive: Path, binary: Path, tmp_path: Path) -> None:
    (tmp_path / "plain.gcode").write_bytes(TWO)
    expected = layer_speeds(tmp_path / "plain.gcode", 2)
    assert (layer_speeds(archive, 2, plate=2).speed == expected.speed).all()
    assert (middle_layer(archive), middle_layer(archive, plate=2), middle_layer(binary)) == (2, 2, 2)
    with pytest.raises(ParameterError, match="layers 1 to 4"):
        layer_speeds(archive, 5, plate=2)


@pytest.mark.slow
def test_the_command_says_which_plate_it_took(archive: Path, binary: Path, tmp_path: Path) -> None:
    assert "1 of 1, 2; --plate chooses" in run("motion", archive).stdout
    told = json.loads(run("motion", archive, "--plate", 2, "--json").stdout)
    assert (told["plate"], told["plates"], told["layers"]) == (2, [1, 2], 4)
    plot = tmp_path / "layer.png"
    assert run("motion", archive, binary, "--plot", plot, "--layer", 3).exit_code == 0
    assert plot.stat().st_size > 1000
    one_line_error(run("motion", archive, "--plate", 3), r"--plate is 3, which is not in part.gcode.3mf; it has 1, 2")
    one_line_error(
        run("motion", binary, "--plate", 1),
        r"--plate is 1, which is not in part.bgcode; it has no plates; leave it out",
    )
    archive.write_bytes(packed({1: ONE}))
    assert "1, the only one" in run("motion", archive).stdout


@pytest.mark.parametrize("name", ["no G-code", "cut", "bytes"])
def test_motion_of_a_damaged_archive_is_one_line(name: str, archive: Path) -> None:
    archive.write_bytes(spoilt(name))
    plate = ["--plate", 2] if name == "bytes" else []
    one_line_error(run("motion", archive, *plate), f"{NAME}: .*the archive")
