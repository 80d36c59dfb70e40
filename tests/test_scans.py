"""One contract for every format of volumes: values keep their type, and every cell its place in space."""

from __future__ import annotations

import gzip
import io
import json
import logging
import math
import sys
import zipfile
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tifffile
from PIL import Image

from infill.errors import FormatError, MemoryLimitError, OutputError, ParameterError
from infill.imaging.volume_files import FIELD_WRITERS, READERS, read_volume, write_field
from infill.volume import Volume

SHAPE = (5, 6, 7)
MARKED = (1, 4, 2)
SPACING = (0.5, 0.7, 2.0)
MEDICAL = [".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd"]
# NIfTI keeps its place in 32 bits: 10 mm to 1e-6 mm.
PLACES = {".nii": 1e-5, ".nii.gz": 1e-5}


@pytest.fixture(scope="module")
def sitk() -> Any:
    return pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")


def turn() -> np.ndarray:
    """A turn about two axes."""
    a, b = 0.3, -0.5
    about_z = np.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]])
    about_x = np.array([[1, 0, 0], [0, math.cos(b), -math.sin(b)], [0, math.sin(b), math.cos(b)]])
    return about_x @ about_z


def marked(dtype: Any = np.int16) -> np.ndarray:
    values = np.zeros(SHAPE, dtype=dtype)
    values[MARKED] = 1
    return values


def centre(volume: Volume, cell: tuple[int, ...]) -> np.ndarray:
    """Return where in space the centre of a cell lies."""
    return volume.place((np.array([cell]) + 0.5) * volume.cell_size)[0]


def place_of_mark(volume: Volume) -> np.ndarray:
    found = np.argwhere(volume.values == volume.values.max())
    assert len(found) == 1
    return centre(volume, tuple(found[0]))


def numbers(dtype: Any = np.int16) -> np.ndarray:
    return np.arange(math.prod(SHAPE)).reshape(SHAPE).astype(dtype)


def one_line(caught: pytest.ExceptionInfo[Exception]) -> str:
    said = str(caught.value)
    assert "\n" not in said
    assert len(said) < 500
    assert "; " in said
    return said


# --- NumPy -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "dtype", [bool, np.int8, np.uint8, np.int16, np.uint16, np.int64, np.float16, np.float32, float, ">i2", ">f4"]
)
def test_npy_keeps_values_and_type(dtype: Any, tmp_path: Path) -> None:
    values = numbers(dtype) if dtype is not bool else numbers() % 3 == 0
    np.save(tmp_path / "a.npy", values)
    volume = read_volume(tmp_path / "a.npy")
    assert np.array_equal(volume.values, values)
    assert volume.values.dtype == np.dtype(dtype).newbyteorder("=")
    assert (volume.spacing, volume.origin, volume.space) == ((1.0, 1.0, 1.0), (0.0, 0.0, 0.0), "")


def test_npy_is_mapped_not_loaded(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", numbers())
    assert isinstance(read_volume(tmp_path / "a.npy").values.base, np.memmap)


def test_npz_in_either_order(tmp_path: Path) -> None:
    np.savez(tmp_path / "xyz.npz", anything=numbers(), spacing=SPACING, origin=(1, 2, 3), direction=turn(), space="RAS")
    np.savez(tmp_path / "zyx.npz", hu=numbers().T, spacing_zyx_mm=SPACING[::-1], crop_start_zyx=(0, 1, 2))
    xyz, zyx = read_volume(tmp_path / "xyz.npz"), read_volume(str(tmp_path / "zyx.npz"))
    assert np.array_equal(xyz.values, zyx.values)
    assert xyz.spacing == zyx.spacing == SPACING
    assert (xyz.origin, xyz.space) == ((1.0, 2.0, 3.0), "RAS")
    assert np.array_equal(xyz.direction, turn())
    np.savez(tmp_path / "one.npz", a=numbers(), spacing=0.5)
    assert read_volume(tmp_path / "one.npz").spacing == (0.5, 0.5, 0.5)


def test_npz_with_several_arrays_wants_a_name(tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    np.savez(path, first=numbers(), second=-numbers())
    with pytest.raises(FormatError, match=r"2 arrays .*\(first, second\); choose one: --array first"):
        read_volume(path)
    assert read_volume(path, array="second").values.min() < 0
    with pytest.raises(FormatError, match="no array 'third'; it holds first, second"):
        read_volume(path, array="third")


@pytest.mark.parametrize(
    ("arrays", "says"),
    [
        ({}, "holds no volume"),
        ({"a": np.ones((3, 3))}, "holds no volume"),
        ({"a": numbers(), "spacing": (1, 2)}, r"spacing of shape \(2,\)"),
        ({"a": numbers(), "spacing": (1, 2, 0)}, "no usable place in space: spacing is 0 mm"),
        ({"a": numbers(), "spacing": (1, 2, np.nan)}, "no usable place"),
        ({"a": numbers(), "spacing": "wide"}, "spacing of shape"),
        ({"a": numbers(), "direction": np.ones((3, 3))}, "no usable place in space: direction"),
        ({"a": numbers(), "spacing": 1.0, "spacing_zyx_mm": (1, 2, 3)}, "both spacing"),
        ({"a": np.zeros((3, 4, 5), "c16")}, "complex"),
        ({"a": np.zeros((4, 5, 6, 3), "u1")}, "3 numbers per cell"),
        ({"a": np.zeros((4, 5, 6, 9))}, "three axes"),
        ({"a": np.zeros((4, 0, 6))}, "with cells"),
        ({"a": np.zeros((4, 5, 6))}, "holds 0 in all cells"),
        ({"a": np.ones((4, 5, 6), bool)}, "holds 1 in all cells"),
        ({"a": np.where(numbers() == 5, np.nan, numbers())}, "NaN or infinite"),
        ({"a": np.where(numbers() == 5, np.inf, numbers())}, "NaN or infinite"),
        ({"a": np.full((2, 2, 2), "x")}, "type <U1"),
        ({"a": np.zeros((2, 2, 2), "M8[s]")}, "type datetime64"),
    ],
)
def test_npz_of_something_else_is_one_clear_line(arrays: dict[str, Any], says: str, tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    np.savez(path, **arrays)
    with pytest.raises(FormatError, match=says) as caught:
        read_volume(path)
    assert one_line(caught).startswith(str(path))


class Trap:
    """An object that would run code when it is unpickled."""

    def __reduce__(self) -> Any:
        return (exec, ("raise SystemExit('unpickled')",))


def test_objects_are_never_unpickled(tmp_path: Path) -> None:
    objects = np.array([[[Trap()]]], dtype=object)
    np.save(tmp_path / "a.npy", objects, allow_pickle=True)
    np.savez(tmp_path / "a.npz", a=objects)
    for name in ("a.npy", "a.npz"):
        with pytest.raises(FormatError, match="broken or not a"):
            read_volume(tmp_path / name)


def test_a_small_file_cannot_ask_for_all_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A header may announce any size; and what packs well must still fit."""
    head = io.BytesIO()
    np.lib.format.write_array_header_1_0(head, {"descr": "<f8", "fortran_order": False, "shape": (10**6, 10**6, 10**3)})
    (tmp_path / "a.npy").write_bytes(head.getvalue() + b"\0" * 1000)
    with zipfile.ZipFile(tmp_path / "a.npz", "w") as archive:
        archive.writestr("a.npy", head.getvalue() + b"\0" * 1000)
    for name in ("a.npy", "a.npz"):
        with pytest.raises((FormatError, MemoryLimitError)):
            read_volume(tmp_path / name)
    np.savez_compressed(tmp_path / "b.npz", a=np.zeros((100, 100, 100)))
    monkeypatch.setattr("infill.machine.available_memory", lambda: 10**6)
    with pytest.raises(MemoryLimitError, match="cut the volume"):
        read_volume(tmp_path / "b.npz")


# --- what is written is read back ------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("suffix", list(FIELD_WRITERS))
@pytest.mark.parametrize("space", ["", "LPS"])
@pytest.mark.parametrize("dtype", [bool, np.int16, np.uint8, np.float32, float, np.float16])
def test_a_field_read_back_is_the_same(suffix: str, space: str, dtype: Any, tmp_path: Path) -> None:
    values = numbers(dtype) if dtype is not bool else numbers() % 3 == 0
    mirror = np.diag([1, 1, -1.0])
    field = Volume(values=values, spacing=SPACING, origin=(10, -20, 30), direction=turn() @ mirror, space=space)
    back = read_volume(write_field(field, tmp_path / f"field{suffix}"))
    assert np.array_equal(back.values, values)
    if suffix == ".npz" or dtype not in (bool, np.float16):  # NRRD has no such types
        assert back.values.dtype == values.dtype
    # Decimal text and two sums between corner and centre: a few units in the last place of 30 mm.
    assert back.spacing == pytest.approx(field.spacing, abs=1e-12)
    assert back.origin == pytest.approx(field.origin, abs=1e-12)
    assert np.allclose(back.direction, field.direction, atol=1e-12)
    assert (back.space, back.mirrored) == (space, True)


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("suffix", list(FIELD_WRITERS))
def test_simpleitk_finds_each_cell_where_we_say(suffix: str, order: Any, sitk: Any, tmp_path: Path) -> None:
    field = Volume(
        values=np.asarray(marked(), order=order), spacing=SPACING, origin=(10, -20, 30), direction=turn(), space="LPS"
    )
    path = write_field(field, tmp_path / f"a{suffix}")
    if suffix == ".npz":
        image = sitk.GetImageFromArray(np.load(path)["values"].T)
        image.SetSpacing(SPACING)
        image.SetDirection(turn().ravel().tolist())
        image.SetOrigin(centre(field, (0, 0, 0)).tolist())
    else:
        image = sitk.ReadImage(str(path))
    assert image.GetPixel(*MARKED) == 1
    assert image.TransformIndexToPhysicalPoint(MARKED) == pytest.approx(place_of_mark(field), abs=1e-9)


def test_fields_are_written_whole_or_not(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    field = Volume(values=numbers())
    with pytest.raises(FormatError, match=r"use one of \.npz, \.nrrd"):
        write_field(field, tmp_path / "a.stl")
    with pytest.raises(FormatError, match="has no suffix"):
        write_field(field, tmp_path / "a")
    with pytest.raises(OutputError, match="cannot write .*No such file"):
        write_field(field, tmp_path / "missing" / "a.npz")

    def fails(volume: Volume, file: Any) -> None:
        file.write(b"half")
        raise OSError(28, "No space left on device")

    monkeypatch.setitem(FIELD_WRITERS, ".npz", fails)
    with pytest.raises(OutputError, match="disk is full"):
        write_field(field, tmp_path / "a.npz")
    assert list(tmp_path.iterdir()) == []


# --- stacks of pictures ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "options", [{}, {"metadata": None}, {"compression": "zlib"}, {"byteorder": ">"}, {"bigtiff": True}]
)
@pytest.mark.parametrize("dtype", [np.uint8, np.int16, np.float32])
def test_pages_of_tiff_are_z(options: dict[str, Any], dtype: Any, tmp_path: Path) -> None:
    tifffile.imwrite(tmp_path / "a.tif", numbers(dtype).T, **options)
    volume = read_volume(tmp_path / "a.tif")
    assert np.array_equal(volume.values, numbers(dtype))
    assert volume.values.dtype == dtype
    assert volume.spacing == (1, 1, 1)


@pytest.mark.parametrize(
    ("unit", "size"), [("mm", 1), ("um", 1e-3), ("micron", 1e-3), ("\\u00B5m", 1e-3), ("cm", 10), ("pixel", 1)]
)
def test_cell_size_of_imagej(unit: str, size: float, tmp_path: Path) -> None:
    tifffile.imwrite(
        tmp_path / "a.tif",
        numbers().T,
        imagej=True,
        resolution=(1 / 0.5, 1 / 0.25),
        metadata={"spacing": 2.0, "unit": unit, "axes": "ZYX"},
    )
    assert read_volume(tmp_path / "a.tif").spacing == pytest.approx((0.5 * size, 0.25 * size, 2 * size))


@pytest.mark.parametrize(
    ("unit", "size"),
    [({}, 1e-3), ({"PhysicalSizeXUnit": "mm", "PhysicalSizeYUnit": "mm", "PhysicalSizeZUnit": "mm"}, 1)],
)
def test_cell_size_of_ome(unit: dict[str, str], size: float, tmp_path: Path) -> None:
    sizes = {"PhysicalSizeX": 0.5, "PhysicalSizeY": 0.25, "PhysicalSizeZ": 2}
    tifffile.imwrite(tmp_path / "a.ome.tiff", numbers().T, metadata={"axes": "ZYX", **sizes, **unit})
    assert read_volume(tmp_path / "a.ome.tiff").spacing == pytest.approx((0.5 * size, 0.25 * size, 2 * size))
    tifffile.imwrite(tmp_path / "b.ome.tif", numbers().T, metadata={"axes": "ZYX"})
    assert read_volume(tmp_path / "b.ome.tif").spacing == (1, 1, 1)


def test_tiff_of_something_else_is_one_clear_line(tmp_path: Path) -> None:
    cases = {
        "rgb": (np.zeros((5, 6, 7, 3), np.uint8), {"photometric": "rgb"}, "colours or channels"),
        "one": (numbers()[0], {}, "three axes"),
        "four": (np.zeros((2, 5, 6, 7), np.int16), {"metadata": {"axes": "TZYX"}}, "4 axes .TZYX"),
    }
    for name, (values, options, says) in cases.items():
        tifffile.imwrite(tmp_path / f"{name}.tif", values, **options)
        with pytest.raises(FormatError, match=says) as caught:
            read_volume(tmp_path / f"{name}.tif")
        one_line(caught)
    with tifffile.TiffWriter(tmp_path / "mixed.tif") as file:
        file.write(numbers()[0], metadata=None)
        file.write(numbers()[0, :3], metadata=None)
    with pytest.raises(FormatError, match="pages of different kinds"):
        read_volume(tmp_path / "mixed.tif")


def test_a_tiff_without_its_last_pages_is_told(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    pages = [Image.fromarray(page) for page in numbers(np.uint8).T]
    pages[0].save(tmp_path / "a.tif", save_all=True, append_images=pages[1:])
    assert np.array_equal(read_volume(tmp_path / "a.tif").values, numbers(np.uint8))
    whole = (tmp_path / "a.tif").read_bytes()
    for part in (0.9, 0.5, 0.2):
        (tmp_path / "cut.tif").write_bytes(whole[: int(len(whole) * part)])
        with pytest.raises(FormatError, match="broken"):
            read_volume(tmp_path / "cut.tif")
    assert not caplog.records
    assert not logging.getLogger("tifffile").filters


@pytest.mark.parametrize("suffix", [".tif", ".png"])
def test_a_folder_of_slices_in_the_order_of_their_numbers(suffix: str, tmp_path: Path) -> None:
    values = np.arange(4 * 5 * 12, dtype=np.uint16).reshape(4, 5, 12)
    for k in range(12):
        Image.fromarray(values[:, :, k].T).save(tmp_path / f"slice{k}{suffix}")
    (tmp_path / "notes.txt").write_text("hello")
    (tmp_path / f".hidden{suffix}").write_text("hello")
    volume = read_volume(tmp_path)
    assert np.array_equal(volume.values, values)
    assert volume.values.dtype == np.uint16


def test_slices_that_do_not_belong_together(tmp_path: Path) -> None:
    def folder(name: str, *slices: tuple[str, Image.Image]) -> Path:
        (tmp_path / name).mkdir()
        for file, picture in slices:
            picture.save(tmp_path / name / file)
        return tmp_path / name

    grey, small, colour = Image.new("L", (4, 5)), Image.new("L", (4, 4)), Image.new("RGB", (4, 5))
    for path, says in (
        (folder("size", ("1.png", grey), ("2.png", small)), "keep only slices of one scan"),
        (folder("type", ("1.png", grey), ("2.png", Image.new("I;16", (4, 5)))), "keep only slices of one scan"),
        (folder("both", ("1.png", grey), ("2.tif", grey)), r"as .png and as .tif"),
        (folder("colour", ("1.png", colour)), "mode RGB"),
        (folder("colours", ("1.tif", colour)), "colours"),
        (folder("black", ("1.png", grey), ("2.png", grey)), "holds 0 in all"),
        (folder("empty"), "holds no files"),
    ):
        with pytest.raises(FormatError, match=says) as caught:
            read_volume(path)
        one_line(caught)
    broken = folder("broken", ("1.png", grey)) / "2.png"
    broken.write_bytes((broken.parent / "1.png").read_bytes()[:-30])
    with pytest.raises(FormatError, match=r"cannot .*2\.png"):
        read_volume(broken.parent)


# --- medical images --------------------------------------------------------------------------------------


def image_of(sitk: Any, values: np.ndarray) -> Any:
    image = sitk.GetImageFromArray(np.ascontiguousarray(values.T))
    image.SetSpacing(SPACING)
    image.SetOrigin((10.0, -20.0, 30.0))
    image.SetDirection(turn().ravel().tolist())
    return image


@pytest.mark.slow
@pytest.mark.parametrize("suffix", MEDICAL)
@pytest.mark.parametrize("dtype", [np.uint8, np.int16, np.float32, float])
def test_a_marked_cell_lies_where_simpleitk_says(suffix: str, dtype: Any, sitk: Any, tmp_path: Path) -> None:
    image = image_of(sitk, marked(dtype))
    path = tmp_path / f"a{suffix}"
    sitk.WriteImage(image, str(path))
    volume = read_volume(path)
    assert np.array_equal(volume.values, marked(dtype))
    assert volume.values.dtype == dtype
    assert volume.space == "LPS"
    assert volume.spacing == pytest.approx(SPACING, abs=1e-6)
    said = image.TransformIndexToPhysicalPoint(MARKED)
    assert place_of_mark(volume) == pytest.approx(said, abs=PLACES.get(suffix, 1e-9))


def test_comparing_places_can_fail(sitk: Any) -> None:
    """Half a cell off, as when corner and centre are mixed up, is seen."""
    image = image_of(sitk, marked())
    wrong = Volume(values=marked(), spacing=SPACING, origin=image.GetOrigin(), direction=turn())
    assert np.linalg.norm(place_of_mark(wrong) - image.TransformIndexToPhysicalPoint(MARKED)) > 0.5


def test_values_of_an_image_are_not_copied_and_stay(sitk: Any, tmp_path: Path) -> None:
    sitk.WriteImage(image_of(sitk, numbers()), str(tmp_path / "a.nrrd"))
    volume = read_volume(tmp_path / "a.nrrd")
    assert not volume.values.flags.owndata
    layer = volume.values[:, :, 3]
    del volume
    for _ in range(20):
        np.full(SHAPE, 77, dtype=np.int16)
    assert np.array_equal(layer, numbers()[:, :, 3])


def test_an_nrrd_in_no_named_space_stays_so_and_ras_is_turned(sitk: Any, tmp_path: Path) -> None:
    for space, named, sign in (("space dimension: 3", "", 1), ("space: right-anterior-superior", "LPS", -1)):
        head = (
            f"NRRD0004\ntype: short\ndimension: 3\n{space}\nsizes: 5 6 7\nendian: little\nencoding: raw\n"
            "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (1,2,3)\n\n"
        )
        (tmp_path / "a.nrrd").write_bytes(head.encode() + numbers().tobytes(order="F"))
        volume = read_volume(tmp_path / "a.nrrd")
        assert volume.space == named
        assert centre(volume, (0, 0, 0)) == pytest.approx([sign * 1, sign * 2, 3])
        assert np.array_equal(volume.values, numbers())


def test_images_that_are_no_grey_volume(sitk: Any, tmp_path: Path) -> None:
    image = image_of(sitk, numbers())
    real = sitk.Cast(image, sitk.sitkFloat32)
    cases = {
        "vector": (sitk.Compose(image, image), "holds 2 numbers per cell; choose one of its 2 frames"),
        "complex": (sitk.RealAndImaginaryToComplex(real, real), "complex"),
        "times": (sitk.JoinSeries([image, image]), "4 axes, 5 x 6 x 7 x 2 cells"),
        "slice": (image[:, :, 0], "single slice"),
        "nan": (sitk.Sqrt(real - 5), "NaN"),
        "constant": (image * 0, "holds 0 in all cells"),
    }
    for name, (each, says) in cases.items():
        path = tmp_path / f"{name}.nrrd"
        sitk.WriteImage(each, str(path))
        with pytest.raises(FormatError, match=says) as caught:
            read_volume(path)
        one_line(caught)
    sitk.WriteImage(sitk.JoinSeries([image]), str(tmp_path / "once.nrrd"))
    assert np.array_equal(read_volume(tmp_path / "once.nrrd").values, numbers())


def test_a_skewed_image_is_told(sitk: Any, tmp_path: Path) -> None:
    head = (
        "NRRD0004\ntype: short\ndimension: 3\nspace dimension: 3\nsizes: 5 6 7\nendian: little\nencoding: raw\n"
        "space directions: (1,0,0) (0.3,1,0) (0,0,1)\nspace origin: (1,2,3)\n\n"
    )
    (tmp_path / "a.nrrd").write_bytes(head.encode() + numbers().tobytes(order="F"))
    with pytest.raises(FormatError, match="no usable place in space"):
        read_volume(tmp_path / "a.nrrd")


@pytest.mark.slow
@pytest.mark.parametrize("suffix", MEDICAL)
@pytest.mark.parametrize("part", [0.0, 0.1, 0.5, 0.8])
def test_a_medical_file_that_is_cut_off(
    suffix: str, part: float, sitk: Any, tmp_path: Path, rng: np.random.Generator
) -> None:
    path = tmp_path / f"a{suffix}"
    sitk.WriteImage(image_of(sitk, rng.integers(-999, 999, (10, 12, 14)).astype(np.int16)), str(path))
    held = next((each for each in tmp_path.iterdir() if each != path), path)
    whole = held.read_bytes()
    held.write_bytes(whole[: int(part * len(whole))])
    with pytest.raises(FormatError) as caught:
        read_volume(path)
    assert str(path) in one_line(caught)


def test_a_packed_nifti_may_have_several_parts(sitk: Any, tmp_path: Path) -> None:
    sitk.WriteImage(image_of(sitk, numbers()), str(tmp_path / "a.nii"))
    plain = (tmp_path / "a.nii").read_bytes()
    (tmp_path / "b.nii.gz").write_bytes(gzip.compress(plain[:400]) + gzip.compress(plain[400:]))
    assert np.array_equal(read_volume(tmp_path / "b.nii.gz").values, numbers())


def test_simpleitk_stays_quiet(sitk: Any, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "notes.txt").write_text("hello")
    (tmp_path / "a.nii").write_bytes(b"hello" * 100)
    for path in (tmp_path, tmp_path / "a.nii"):
        with pytest.raises(FormatError):
            read_volume(path)
    assert capfd.readouterr() == ("", "")
    assert sitk.ProcessObject.GetGlobalWarningDisplay()


def test_without_simpleitk_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "SimpleITK", None)
    monkeypatch.setitem(sys.modules, "pydicom", None)
    (tmp_path / "a.dcm").write_bytes(b"x")
    for path, what in (("a.dcm", ".dcm"), (".", "a DICOM folder")):
        with pytest.raises(FormatError) as caught:
            read_volume(tmp_path / path)
        assert str(caught.value) == f"reading {what} needs the extra medical: pip install pydicom SimpleITK"


def write_series(
    sitk: Any, folder: Path, uid: str, image: Any, *, slices: list[int] | None = None, shear: float = 0.0
) -> None:
    """Write an image as CT slices, their names in another order than their places."""
    writer = sitk.ImageFileWriter()
    writer.KeepOriginalImageUIDOn()
    axes = np.array(image.GetDirection()).reshape(3, 3)
    for k in slices or range(image.GetSize()[2]):
        page = image[:, :, k]
        place = np.array(image.TransformIndexToPhysicalPoint((0, 0, k))) + shear * k * axes[:, 1]
        tags = {
            "0008|0060": "CT",
            "0008|0016": "1.2.840.10008.5.1.4.1.1.2",
            "0008|0018": f"{uid}.{k}",
            "0020|000d": "1.2.826.0.1",
            "0020|000e": uid,
            "0020|0013": str(k),
            "0020|0037": "\\".join(f"{x:.10f}" for x in axes[:, :2].T.ravel()),
            "0020|0032": "\\".join(f"{x:.8f}" for x in place),
            "0028|1052": "-1024",
            "0028|1053": "1",
        }
        for tag, text in tags.items():
            page.SetMetaData(tag, text)
        writer.SetFileName(str(folder / f"{uid[-1]}_{99 - k}.dcm"))
        writer.Execute(page)


def test_dicom_slices_become_a_volume(sitk: Any, tmp_path: Path) -> None:
    values = (numbers() * 7 - 1000).astype(np.int16)
    values[MARKED] = 2000
    image = image_of(sitk, values)
    write_series(sitk, tmp_path, "1.2.826.0.1.1", image)
    (tmp_path / "notes.txt").write_text("hello")
    volume = read_volume(tmp_path)
    assert np.array_equal(volume.values, values)
    assert volume.values.dtype.kind == "i"
    assert volume.space == "LPS"
    # The tags hold 8 digits after the point.
    assert place_of_mark(volume) == pytest.approx(image.TransformIndexToPhysicalPoint(MARKED), abs=1e-6)


def test_several_dicom_series_want_a_choice(sitk: Any, tmp_path: Path) -> None:
    write_series(sitk, tmp_path, "1.2.826.0.1.1", image_of(sitk, numbers()))
    write_series(sitk, tmp_path, "1.2.826.0.1.2", image_of(sitk, numbers() + 5))
    with pytest.raises(FormatError, match=r"2 DICOM series, 1.2.826.0.1.1 \(7 slices\), .*choose one: --series 1"):
        read_volume(tmp_path)
    assert np.array_equal(read_volume(tmp_path, series="1.2.826.0.1.2").values, numbers() + 5)
    with pytest.raises(FormatError, match=r"no DICOM series 'x'; it holds 1.2.826.0.1.1 \(7"):
        read_volume(tmp_path, series="x")


@pytest.mark.parametrize("options", [{"slices": [0, 1, 2, 3, 5, 6]}, {"shear": 0.3}])
def test_uneven_dicom_slices_are_told(
    options: dict[str, Any], sitk: Any, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    write_series(sitk, tmp_path, "1.2.826.0.1.1", image_of(sitk, numbers()), **options)
    with pytest.raises(FormatError, match="away from even steps .*resample") as caught:
        read_volume(tmp_path)
    one_line(caught)
    assert capfd.readouterr().err == ""


def test_broken_and_single_dicom_files(sitk: Any, tmp_path: Path) -> None:
    write_series(sitk, tmp_path, "1.2.826.0.1.1", image_of(sitk, numbers()))
    with pytest.raises(FormatError, match="single slice"):
        read_volume(tmp_path / "1_99.dcm")
    (tmp_path / "1_95.dcm").write_bytes((tmp_path / "1_95.dcm").read_bytes()[:-20])
    with pytest.raises(FormatError, match="1_95.dcm is broken or cut off"):
        read_volume(tmp_path)
    (tmp_path / "1_95.dcm").unlink()
    with pytest.raises(FormatError, match="missing, doubled"):
        read_volume(tmp_path)


def test_what_is_no_slice_may_lie_beside_slices(sitk: Any, tmp_path: Path) -> None:
    """A structured report is DICOM too, and no reader of pictures takes it."""
    write_series(sitk, tmp_path, "1.2.826.0.1.1", image_of(sitk, numbers()))
    whole = read_volume(tmp_path).values.shape
    kind = b"1.2.840.10008.5.1.4.1.1.88.11"
    tag = b"\x02\x00\x02\x00UI" + len(kind).to_bytes(2, "little") + kind
    (tmp_path / "report.dcm").write_bytes(b"\0" * 128 + b"DICM" + tag + b"nothing else")
    (tmp_path / "notes.txt").write_text("read me")
    assert read_volume(tmp_path).values.shape == whole


@pytest.mark.parametrize("end", ["1_99.dcm", "1_93.dcm"])
def test_a_dicom_slice_at_the_end_that_is_cut_off_is_told(end: str, sitk: Any, tmp_path: Path) -> None:
    """It leaves no gap behind, and a volume of one slice less."""
    write_series(sitk, tmp_path, "1.2.826.0.1.1", image_of(sitk, numbers()))
    (tmp_path / end).write_bytes((tmp_path / end).read_bytes()[:-20])
    with pytest.raises(FormatError, match="cut off|broken|missing"):
        read_volume(tmp_path)


# --- every suffix ----------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("suffix", list(READERS))
@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"hello\n",
        b"\0" * 400,
        b"nonsense " * 100,
        b"\x93NUMPY\1\0v\0{",
        b"PK\3\4",
        b"II*\0" + b"\xff" * 99,
        b"NRRD0004\n",
    ],
)
def test_rubbish_is_one_clear_line(suffix: str, content: bytes, tmp_path: Path) -> None:
    if suffix == ".dcm":
        pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")
    path = tmp_path / f"rubbish{suffix}"
    path.write_bytes(content)
    with pytest.raises(FormatError) as caught:
        read_volume(path)
    assert str(path) in one_line(caught)


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".npy", ".npz", ".tif", ".png"])
def test_a_file_with_a_flipped_byte_is_read_or_told(suffix: str, tmp_path: Path, rng: np.random.Generator) -> None:
    """No damage may raise anything else than our errors."""
    path = tmp_path / f"1{suffix}"
    if suffix == ".npy":
        np.save(path, numbers())
    elif suffix == ".npz":
        np.savez_compressed(path, a=numbers(), spacing=(1, 2, 3))
    elif suffix == ".tif":
        tifffile.imwrite(path, numbers().T, compression="zlib")
    else:
        Image.fromarray(numbers(np.uint16)[:, :, 0]).save(path)
    whole, outcomes = bytearray(path.read_bytes()), Counter[str]()
    for place in rng.integers(0, len(whole), 150):
        bad = whole.copy()
        bad[place] ^= 1 << int(rng.integers(8))
        path.write_bytes(bad)
        try:
            read_volume(tmp_path if suffix == ".png" else path)
        except (FormatError, MemoryLimitError):
            outcomes["told"] += 1
        else:
            outcomes["read"] += 1
    assert outcomes["told"] >= 1
    assert outcomes["read"] >= 1


def test_names_that_cannot_be(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="there is no file"):
        read_volume(tmp_path / "a.npy")
    (tmp_path / "a.stl").write_bytes(b"x")
    with pytest.raises(FormatError, match=r"cannot tell a volume from 'a.stl'; use one of \.npy, .*\.nii\.gz"):
        read_volume(tmp_path / "a.stl")
    with pytest.raises(ParameterError, match=r"only an \.npz"):
        read_volume(tmp_path / "a.npy", array="x")
    with pytest.raises(ParameterError, match="is not a folder; give the one"):
        read_volume(tmp_path / "a.npy", series="x")


def test_an_unreadable_file_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.npy").write_bytes(b"not empty")
    monkeypatch.setitem(READERS, ".npy", lambda path: open(path / "below"))  # noqa: SIM115 - raises
    with pytest.raises(FormatError, match="cannot read .*check the file"):
        read_volume(tmp_path / "a.npy")


@pytest.mark.slow
def test_reading_arrays_loads_nothing_medical() -> None:
    import subprocess

    done = subprocess.run(
        [
            sys.executable,
            "-c",
            "import infill.imaging.volume_files, infill.imaging.arrays, json, sys; print(json.dumps(list(sys.modules)))",
        ],
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    assert not {"SimpleITK", "tifffile", "PIL", "skimage"} & set(json.loads(done.stdout))


# --- real ones -------------------------------------------------------------------------------------------


def test_real_scans(data: Path) -> None:
    for name, shape, spacing, kind in (
        ("ct_headsq_64x64x93_uint16", (64, 64, 93), (3.2, 3.2, 1.5), np.uint16),
        ("ct_head_cranium_int16", (207, 239, 108), (0.957, 0.957, 1.5), np.int16),
        ("seg_skull_label_seg3d", (160, 232, 160), (1.0, 0.898, 0.898), np.uint8),
    ):
        volume = read_volume(data / "volumes" / f"{name}.npz")
        assert volume.values.shape == shape
        assert volume.values.dtype == kind
        assert volume.spacing == pytest.approx(spacing, abs=1e-3)


def test_a_real_scan_keeps_its_place_through_every_format(data: Path, sitk: Any, tmp_path: Path) -> None:
    scan = read_volume(data / "volumes" / "ct_headsq_64x64x93_uint16.npz")
    own = write_field(scan, tmp_path / "own.nrrd")
    for suffix in (".nrrd", ".nii", ".mha"):
        sitk.WriteImage(sitk.ReadImage(str(own)), str(tmp_path / f"a{suffix}"))
        back = read_volume(tmp_path / f"a{suffix}")
        assert np.array_equal(back.values, scan.values)
        assert centre(back, (63, 0, 92)) == pytest.approx(centre(scan, (63, 0, 92)), abs=1e-4)
