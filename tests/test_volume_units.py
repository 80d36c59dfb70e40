"""Units of length in volumes: whatever word a program writes is read as what it means, or told."""

from __future__ import annotations

import logging
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tifffile
from hypothesis import given
from hypothesis import strategies as st

from infill.imaging.units import millimetres
from infill.imaging.volume_files import read_volume
from tests import volume_writers as w

VALUES = np.arange(210).reshape(6, 7, 5).astype("u2")

MEANINGS: dict[float, tuple[str, ...]] = {
    1e-9: ("pm", "picometer", "picometre", "Picometers"),
    1e-7: ("Å", "\u212b", "A\u030a", "angstrom", "Angstrom", "angstroms", "Ångström", "ångström"),
    1e-6: ("nm", "NM", "nanometer", "nanometre", "nanometers", "Nanometres"),
    1e-3: (
        *("um", "µm", "μm", "Um", "\\u00B5m", "\\u03bcm", "micron", "microns", "Micron", "MICRONS", "micrometer"),
        *("micrometre", "Micrometers", "micrometres", "µ", "μ", "µmeter", "micro-meters"),
    ),
    1.0: ("mm", "MM", " mm ", "mm.", "millimeter", "millimetre", "Millimetres", "MILLIMETERS", "mm\0"),
    10.0: ("cm", "CM", "centimeter", "centimetre", "centimeters"),
    100.0: ("dm", "decimetre"),
    1e3: ("m", "meter", "metre", "meters", "Metres"),
    1e4: ("dam",),
    1e6: ("km", "kilometer", "kilometres"),
    25.4: ("in", "In", "inch", "INCH", "inches", "Inches", "in.", '"', "″", "''"),
    0.0254: ("thou", "mil"),
    304.8: ("ft", "foot", "feet", "Feet", "ft.", "'", "′"),
    914.4: ("yd", "yard", "yards"),
    25.4 / 72: ("pt",),
    25.4 / 12: ("li",),
}
NO_LENGTHS = (
    "",
    "pixel",
    "pixels",
    "px",
    "voxel",
    "unitless",
    "reference frame",
    "furlong",
    "s",
    "sec",
    "mmm",
    "Mm",
    "Gm",
)
NO_LENGTHS += ("ly", "parsec", "kg", "m/s", "mm^2", "mm2", "1", "??", "arbitrary", "a.u.", "degree")
WORDS = [(word, scale) for scale, words in MEANINGS.items() for word in words]


@pytest.mark.slow
@pytest.mark.parametrize(("word", "scale"), WORDS)
def test_a_word_has_its_length(word: str, scale: float) -> None:
    assert millimetres(word) == pytest.approx(scale, rel=1e-15)  # 12 or 36 times 25.4, rounded


@pytest.mark.parametrize("word", NO_LENGTHS)
def test_what_is_no_length_has_none(word: str) -> None:
    """Mm is a million metres, and whoever writes it of a scan does not mean that."""
    assert millimetres(word) is None


@given(st.text(max_size=12))
def test_any_word_has_a_length_or_none(word: str) -> None:
    scale = millimetres(word)
    assert scale is None or scale > 0


def warned(caplog: pytest.LogCaptureFixture) -> list[str]:
    """The warnings, without that of cells far smaller than their distance: sizes of axes differ wildly here."""
    told = [record.getMessage() for record in caplog.records if record.levelno == logging.WARNING]
    return [message for message in told if "files of 32-bit numbers" not in message]


# --- ImageJ ----------------------------------------------------------------------------------------------


def imagej(path: Path, metadata: dict[str, Any], resolution: tuple[float, float] = (2.0, 4.0)) -> Path:
    """Write a stack whose cells are 0.5 x 0.25 units."""
    tifffile.imwrite(path, VALUES.T, imagej=True, resolution=resolution, metadata={"axes": "ZYX", **metadata})
    return path


ASCII = [(word, scale) for word, scale in WORDS if word.isascii() and word.strip() == word and word.isprintable()]


@pytest.mark.slow
@pytest.mark.parametrize(("word", "scale"), ASCII)
def test_units_of_imagej(word: str, scale: float, tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    volume = read_volume(imagej(tmp_path / "a.tif", {"unit": word, "spacing": 3.0}))
    assert volume.spacing == pytest.approx((0.5 * scale, 0.25 * scale, 3 * scale))
    assert np.array_equal(volume.values, VALUES)
    assert warned(caplog) == []


def test_axes_of_imagej_with_units_of_their_own(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    volume = read_volume(imagej(tmp_path / "a.tif", {"unit": "um", "yunit": "mm", "zunit": "nm", "spacing": 300.0}))
    assert volume.spacing == pytest.approx((0.5e-3, 0.25, 300e-6))
    assert warned(caplog) == []
    volume = read_volume(imagej(tmp_path / "a.tif", {"unit": "mm", "zunit": "inch", "spacing": 1.0}))
    assert volume.spacing == pytest.approx((0.5, 0.25, 25.4))


@pytest.mark.parametrize("word", ["furlong", "pixel", "Mm", "arbitrary"])
def test_an_unknown_unit_of_imagej_is_told(word: str, tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    volume = read_volume(imagej(tmp_path / "a.tif", {"unit": word, "spacing": 3.0}))
    assert volume.spacing == (0.5, 0.25, 3)
    assert warned(caplog)
    assert all(f"{word!r}, no known unit of length; they are taken as mm" in each for each in warned(caplog))


def test_pixels_that_nobody_measured_are_not_told(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    for unit in ("pixel", ""):
        metadata = {"unit": unit} if unit else {}
        assert read_volume(imagej(tmp_path / "a.tif", metadata, resolution=(1, 1))).spacing == (1, 1, 1)
    assert warned(caplog) == []


def test_a_missing_distance_of_pages_is_told(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """ImageJ leaves it out where it is 1."""
    assert read_volume(imagej(tmp_path / "a.tif", {"unit": "cm"})).spacing == (5, 2.5, 10)
    assert len(warned(caplog)) == 1
    assert "along z; 1 cm is taken" in warned(caplog)[0]


# --- OME -------------------------------------------------------------------------------------------------


def ome(path: Path, **sizes: Any) -> Path:
    tifffile.imwrite(path, VALUES.T, ome=True, metadata={"axes": "ZYX", **sizes})
    return path


@pytest.mark.slow
@pytest.mark.parametrize(
    ("word", "scale"), [("µm", 1e-3), ("Å", 1e-7), ("nm", 1e-6), ("mm", 1), ("cm", 10), ("in", 25.4)]
)
@pytest.mark.parametrize("axis", "XYZ")
def test_units_of_ome_are_those_of_each_axis(
    word: str, scale: float, axis: str, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    sizes = {f"PhysicalSize{each}": 0.5 for each in "XYZ"} | {f"PhysicalSize{each}Unit": "mm" for each in "XYZ"}
    volume = read_volume(ome(tmp_path / "a.ome.tif", **{**sizes, f"PhysicalSize{axis}Unit": word}))
    assert volume.spacing == pytest.approx([0.5 * (scale if each == axis else 1) for each in "XYZ"])
    assert warned(caplog) == []


def test_ome_without_units_is_in_micrometres(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    volume = read_volume(ome(tmp_path / "a.ome.tif", PhysicalSizeX=2, PhysicalSizeY=3, PhysicalSizeZ=4))
    assert volume.spacing == pytest.approx((2e-3, 3e-3, 4e-3))
    assert warned(caplog) == []


@pytest.mark.parametrize("missing", ["X", "Y", "Z", "XY", "YZ", "XZ"])
def test_a_size_that_ome_lacks_is_told_and_taken_from_another_axis(
    missing: str, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    sizes = {f"PhysicalSize{axis}": 2.0 for axis in "XYZ" if axis not in missing}
    volume = read_volume(ome(tmp_path / "a.ome.tif", **sizes))
    assert volume.spacing == pytest.approx((2e-3,) * 3)
    assert len(warned(caplog)) == 1
    assert f"along {' and '.join(missing.lower())}; 0.002 mm is taken" in warned(caplog)[0]


@pytest.mark.parametrize("word", ["pixel", "reference frame", "furlong"])
def test_an_unknown_unit_of_ome_is_told(word: str, tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    sizes = {f"PhysicalSize{each}": 2.0 for each in "XYZ"} | {f"PhysicalSize{each}Unit": "mm" for each in "XYZ"}
    path = ome(tmp_path / "a.ome.tif", **sizes)
    with tifffile.TiffFile(path, mode="r+") as file:
        file.pages[0].tags["ImageDescription"].overwrite(file.ome_metadata.replace('Unit="mm"', f'Unit="{word}"'))
    assert read_volume(path).spacing == (2, 2, 2)
    assert len(warned(caplog)) == 1  # of all axes
    assert f"along x, y and z in {word!r}" in warned(caplog)[0]
    assert all(repr(word) in each for each in warned(caplog))


# --- TIFF for printers -----------------------------------------------------------------------------------


def printed(path: Path, per_unit: tuple[Fraction, Fraction], unit: str) -> Path:
    pairs = tuple((each.numerator, each.denominator) for each in per_unit)
    tifffile.imwrite(path, VALUES.T, metadata=None, resolution=pairs, resolutionunit=unit)
    return path


@pytest.mark.parametrize("entry", [b"\x03\0\2\0\0\0\2\0\2\0", b"\x02\0\4\0\0\0inch", b"\x03\0\1\0\0\0\xff\xff\0\0"])
def test_an_odd_unit_of_dots_is_none(entry: bytes, tmp_path: Path) -> None:
    """A tag that is a pair, a word or no known number says as little as one that is not there."""
    path = printed(tmp_path / "a.tif", (Fraction(10), Fraction(10)), "NONE")
    unit = b"\x28\x01"  # the tag's number, before its type, count and value
    whole = path.read_bytes()
    place = whole.index(unit + b"\x03\0\1\0\0\0")
    path.write_bytes(whole[: place + 2] + entry + whole[place + 2 + len(entry) :])
    with tifffile.TiffFile(path) as file:
        assert file.pages[0].tags["ResolutionUnit"].value not in (1, 2, 3)
    assert tuple(read_volume(path).cell_size) == (1.0, 1.0, 1.0)


@pytest.mark.parametrize(("unit", "scale"), [("CENTIMETER", 10.0), ("INCH", 25.4)])
def test_dots_per_length_are_sizes_and_the_distance_of_pages_is_told(
    unit: str, scale: float, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    path = printed(tmp_path / "a.tif", (Fraction(400), Fraction(1000, 3)), unit)
    volume = read_volume(path)
    assert volume.spacing == pytest.approx((scale / 400, scale / 1000 * 3, scale / 400))
    assert len(warned(caplog)) == 1
    assert "along z" in warned(caplog)[0]


@pytest.mark.parametrize("dots", [72, 96])
@pytest.mark.parametrize("unit", ["INCH", "CENTIMETER", "NONE"])
def test_dots_of_a_screen_and_numbers_without_a_unit_are_no_sizes(dots: int, unit: str, tmp_path: Path) -> None:
    per_unit = Fraction(dots) if unit != "CENTIMETER" else Fraction(dots * 100, 254)
    assert read_volume(printed(tmp_path / "a.tif", (per_unit, per_unit), unit)).spacing == (1, 1, 1)


def test_a_folder_of_slices_has_the_sizes_of_the_first_and_tells_once(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    for k in range(5):
        tifffile.imwrite(tmp_path / f"{k}.tif", VALUES[:, :, k].T, resolution=(100, 100), resolutionunit="CENTIMETER")
    assert read_volume(tmp_path).spacing == pytest.approx((0.1, 0.1, 0.1))
    assert len(warned(caplog)) == 1


# --- NRRD ------------------------------------------------------------------------------------------------

BARE: dict[str, str | None] = {"space": None, "space_directions": None, "space_origin": None}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("word", "scale"), [(word, scale) for word, scale in WORDS if '"' not in word and "\0" not in word]
)
def test_units_of_nrrd(word: str, scale: float, tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    path, values = tmp_path / "a.nrrd", VALUES.astype("i2")
    path.write_bytes(w.nrrd(values, **BARE, spacings="1 2 4", units=f'"{word}" "mm" "{word}"').data)
    assert read_volume(path).spacing == pytest.approx((scale, 2, 4 * scale))
    path.write_bytes(w.nrrd(values, space_units=f'"{word}" "{word}" "{word}"').data)
    assert read_volume(path).spacing == pytest.approx((scale, 0.5 * scale, 3 * scale))
    assert warned(caplog) == []


@pytest.mark.parametrize("word", ["furlong", "pixel", "Mm"])
def test_an_unknown_unit_of_nrrd_is_told(word: str, tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    path, values = tmp_path / "a.nrrd", VALUES.astype("i2")
    path.write_bytes(w.nrrd(values, **BARE, spacings="1 2 4", units=f'"mm" "mm" "{word}"').data)
    assert read_volume(path).spacing == (1, 2, 4)
    assert [f"{word!r}, no known unit of length" in each for each in warned(caplog)] == [True]


WRITTEN = ("nrrd", "nrrd of a space", "imagej", "ome")


@pytest.mark.parametrize("way", WRITTEN)
@pytest.mark.parametrize("words", [("furlong",) * 3, ("furlong", "mm", "furlong"), ("mm", "cubit", "furlong")])
def test_an_unknown_unit_is_told_once_with_its_axes(
    way: str, words: tuple[str, ...], tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    path, values = tmp_path / "a.nrrd", VALUES.astype("i2")
    quoted = " ".join(f'"{word}"' for word in words)
    if way == "nrrd":
        path.write_bytes(w.nrrd(values, **BARE, spacings="1 2 4", units=quoted).data)
    elif way == "nrrd of a space":
        path.write_bytes(w.nrrd(values, space_units=quoted).data)
    elif way == "imagej":
        units = {"unit": words[0], "yunit": words[1], "zunit": words[2]}
        path = imagej(tmp_path / "a.tif", {**units, "spacing": 3.0})
    else:
        sizes = {f"PhysicalSize{each}": 2.0 for each in "XYZ"} | {f"PhysicalSize{each}Unit": "mm" for each in "XYZ"}
        path = ome(tmp_path / "a.ome.tif", **sizes)
        with tifffile.TiffFile(path, mode="r+") as file:
            text = file.ome_metadata
            for axis, word in zip("XYZ", words, strict=True):
                text = text.replace(f'PhysicalSize{axis}Unit="mm"', f'PhysicalSize{axis}Unit="{word}"')
            file.pages[0].tags["ImageDescription"].overwrite(text)
    volume = read_volume(path)
    strange = sorted(set(words) - {"mm"})
    assert len(warned(caplog)) == len(strange)
    assert all(sum(repr(word) in each for each in warned(caplog)) == 1 for word in strange)
    assert volume.warnings == tuple(warned(caplog))  # which the report has as input.warnings
