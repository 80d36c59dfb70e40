"""Volumes of FreeSurfer and VTK, frames of a series, and a box of a volume: every cell keeps its place and value."""

from __future__ import annotations

import base64
import gzip
import math
import struct
import zlib
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from infill.errors import FormatError, MemoryLimitError, ParameterError
from infill.imaging.volume_files import read_volume
from infill.volume import Volume
from infill.voxels.cropping import crop, cut_cells

SHAPE = (5, 6, 7)
SPACING = (0.5, 0.7, 2.0)
ORIGIN = (10.0, -20.0, 30.0)
NUMBERS = np.arange(math.prod(SHAPE)).reshape(SHAPE)


@pytest.fixture(scope="module")
def sitk() -> Any:
    return pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")


def turn() -> np.ndarray:
    a, b = 0.3, -0.5
    about_z = np.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]])
    about_x = np.array([[1, 0, 0], [0, math.cos(b), -math.sin(b)], [0, math.sin(b), math.cos(b)]])
    return about_x @ about_z


def centre(volume: Volume, cell: tuple[int, ...]) -> np.ndarray:
    return volume.place((np.array([cell]) + 0.5) * volume.cell_size)[0]


def one_line(caught: pytest.ExceptionInfo[Exception], path: Path) -> str:
    said = str(caught.value)
    assert "\n" not in said
    assert len(said) < 500
    assert "; " in said
    assert str(path) in said
    return said


# --- FreeSurfer ------------------------------------------------------------------------------------------

MGH_TYPES = {"u1": 0, "i4": 1, "f4": 3, "i2": 4, "u2": 10}


def mgh(
    values: np.ndarray, *, axes: np.ndarray | None = None, centre_ras: tuple[float, ...] = (1, 2, 3), placed: int = 1
) -> bytes:
    """Return a file as FreeSurfer writes it: [x, y, z] or [x, y, z, frame], axes as columns in RAS."""
    shape = (*values.shape, 1)[:4]
    axes = turn() if axes is None else axes
    head = struct.pack(">7i", 1, *shape, MGH_TYPES[values.dtype.str[1:]], 0)
    head += struct.pack(">h15f", placed, *SPACING, *axes.T.ravel(), *centre_ras)
    return head.ljust(284, b"\0") + values.astype(values.dtype.newbyteorder(">")).tobytes(order="F")


@pytest.mark.parametrize("suffix", [".mgh", ".mgz", ".mgh.gz"])
@pytest.mark.parametrize("dtype", list(MGH_TYPES))
def test_freesurfer_cells_lie_where_its_page_says(suffix: str, dtype: str, tmp_path: Path) -> None:
    """RAS = axes (spacing (i - n / 2)) + centre, and LPS has the other sign in the first two."""
    path = tmp_path / f"a{suffix}"
    whole = mgh(NUMBERS.astype(dtype))
    path.write_bytes(whole if suffix == ".mgh" else gzip.compress(whole))
    volume = read_volume(path)
    assert np.array_equal(volume.values, NUMBERS)
    assert volume.values.dtype == np.dtype(dtype)
    assert volume.space == "LPS"
    for cell in ((0, 0, 0), (4, 0, 6), (1, 5, 2)):
        ras = turn() @ (np.array(SPACING) * (np.array(cell) - np.array(SHAPE) / 2)) + (1, 2, 3)
        assert centre(volume, cell) == pytest.approx(ras * (-1, -1, 1), abs=1e-5)  # 32 bits


def test_freesurfer_as_nibabel_wrote_it(tmp_path: Path) -> None:
    """By nibabel 5.4, for the affine [[-1, 0, 0, 9], [0, 0, 2, -8], [0, -3, 0, 7]]; x leads to the left."""
    held = "eNpjYGBgZGBgYIJiZgYIn4UBBBjtGxgYHByAGMjZ38CAAWBi9lDaEYgPLACqx6J2SAI2YIhwAkOEHRgiXMAQ4mBgZeDGphAAiH8Hbg=="
    path = tmp_path / "a.mgh"
    path.write_bytes(zlib.decompress(base64.b64decode(held)))
    volume = read_volume(path)
    assert np.array_equal(volume.values, np.arange(12).reshape(2, 2, 3))
    assert centre(volume, (0, 0, 0)) == pytest.approx([-9, 8, 7])
    assert centre(volume, (1, 0, 0)) == pytest.approx([-8, 8, 7])
    assert centre(volume, (0, 1, 0)) == pytest.approx([-9, 8, 4])
    assert centre(volume, (0, 0, 2)) == pytest.approx([-9, 4, 7])


def test_freesurfer_without_a_place_is_coronal(tmp_path: Path) -> None:
    path = tmp_path / "a.mgh"
    path.write_bytes(mgh(NUMBERS.astype("i2"), placed=0))
    volume = read_volume(path)
    assert volume.spacing == (1, 1, 1)
    assert np.array_equal(volume.direction, [[1, 0, 0], [0, 0, -1], [0, -1, 0]])


def test_frames_of_freesurfer(tmp_path: Path) -> None:
    path = tmp_path / "a.mgz"
    path.write_bytes(gzip.compress(mgh(np.stack([NUMBERS, NUMBERS + 5, NUMBERS * 2], axis=-1).astype("i2"))))
    with pytest.raises(
        FormatError, match=r"4 axes, 5 x 6 x 7 x 3 cells; choose one of its 3 frames: --frame 0 to"
    ) as e:
        read_volume(path)
    one_line(e, path)
    assert np.array_equal(read_volume(path, frame=0).values, NUMBERS)
    assert np.array_equal(read_volume(path, frame=2).values, NUMBERS * 2)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda whole: whole[:100], "cut off within its header"),
        (lambda whole: whole[:-1], "cut off: it holds"),
        (lambda whole: struct.pack(">i", 2) + whole[4:], "no header of FreeSurfer"),
        (lambda whole: whole[:4] + struct.pack(">i", -5) + whole[8:], "no header of FreeSurfer"),
        (lambda whole: whole[:4] + struct.pack(">i", 0) + whole[8:], "no header of FreeSurfer"),
        (lambda whole: whole[:20] + struct.pack(">i", 6) + whole[24:], "cells of type 6"),
        (lambda whole: whole[:4] + struct.pack(">3i", 2**30, 2**30, 2**30) + whole[16:], "cut off|GiB"),
        (lambda whole: whole[:30] + struct.pack(">f", math.nan) + whole[34:], "no usable place"),
        (lambda whole: whole[:30] + struct.pack(">f", -1) + whole[34:], "no usable place"),
        (lambda whole: whole[:42] + struct.pack(">f", 9) + whole[46:], "no usable place"),
        (lambda whole: whole[:284] + bytes(len(whole) - 284), "holds 0 in all cells"),
    ],
)
@pytest.mark.parametrize("suffix", [".mgh", ".mgz"])
def test_a_broken_file_of_freesurfer(change: Callable[[bytes], bytes], says: str, suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"a{suffix}"
    whole = change(mgh(NUMBERS.astype("i2")))
    path.write_bytes(whole if suffix == ".mgh" else gzip.compress(whole))
    with pytest.raises((FormatError, MemoryLimitError), match=says) as caught:
        read_volume(path)
    if not isinstance(caught.value, MemoryLimitError):
        one_line(caught, path)


def test_a_broken_gzip_of_freesurfer(tmp_path: Path) -> None:
    path = tmp_path / "a.mgz"
    whole = gzip.compress(mgh(NUMBERS.astype("i2")))
    for end in (0, 5, 50, len(whole) // 2, len(whole) - 9):
        path.write_bytes(whole[:end])
        with pytest.raises(FormatError) as caught:
            read_volume(path)
        one_line(caught, path)


# --- VTK, legacy -----------------------------------------------------------------------------------------

VTK_TYPES = {
    "u1": "unsigned_char",
    "i1": "char",
    "i2": "short",
    "u2": "unsigned_short",
    "i4": "int",
    "f4": "float",
    "f8": "double",
}
VTI_TYPES = {"u1": "UInt8", "i2": "Int16", "u4": "UInt32", "i8": "Int64", "f4": "Float32", "f8": "Float64"}


def vtk(values: np.ndarray, *, text: bool, of: str = "POINT_DATA", lead: str = "", data: bytes | None = None) -> bytes:
    """Return a legacy file [x, y, z] of structured points."""
    points = values.shape if of == "POINT_DATA" else tuple(n + 1 for n in values.shape)
    head = (
        f"# vtk DataFile Version 3.0\nmade by hand\n{'ASCII' if text else 'BINARY'}\nDATASET STRUCTURED_POINTS\n"
        f"DIMENSIONS {points[0]} {points[1]} {points[2]}\nORIGIN 10 -20 30\nSPACING 0.5 0.7 2\n{of} {values.size}\n"
        f"{lead}"
    )
    if not lead:
        head += f"SCALARS numbers {VTK_TYPES[values.dtype.str[1:]]} 1\nLOOKUP_TABLE default\n"
    if data is None:
        flat = values.ravel(order="F")
        swapped = flat.astype(flat.dtype.newbyteorder(">"))
        data = " ".join(map(str, flat.tolist())).encode() if text else swapped.tobytes()
    return head.encode() + data + b"\n"


def assert_in_place(volume: Volume, *, in_cells: bool) -> None:
    assert np.array_equal(volume.values, NUMBERS)
    assert volume.spacing == pytest.approx(SPACING)
    assert volume.space == ""
    first = np.array(ORIGIN) + (np.array(SPACING) / 2 if in_cells else 0)
    assert centre(volume, (0, 0, 0)) == pytest.approx(first)


@pytest.mark.slow
@pytest.mark.parametrize("of", ["POINT_DATA", "CELL_DATA"])
@pytest.mark.parametrize("text", [True, False])
@pytest.mark.parametrize("dtype", list(VTK_TYPES))
def test_legacy_vtk_has_its_points_as_centres(dtype: str, text: bool, of: str, tmp_path: Path) -> None:
    numbers = NUMBERS.astype(dtype)
    path = tmp_path / "a.vtk"
    path.write_bytes(vtk(numbers, text=text, of=of))
    volume = read_volume(path)
    assert volume.values.dtype == np.dtype(dtype)
    if dtype != "i1":  # 210 is beyond it
        assert_in_place(volume, in_cells=of == "CELL_DATA")
    assert np.array_equal(volume.values, numbers)


def test_legacy_vtk_of_simpleitk(sitk: Any, tmp_path: Path) -> None:
    image = sitk.GetImageFromArray(np.ascontiguousarray(NUMBERS.astype("i2").T))
    image.SetSpacing(SPACING)
    image.SetOrigin(ORIGIN)
    sitk.WriteImage(image, str(tmp_path / "a.vtk"))
    assert_in_place(read_volume(tmp_path / "a.vtk"), in_cells=False)


@pytest.mark.parametrize("text", [True, False])
def test_what_stands_before_the_scalars_is_passed_over(text: bool, tmp_path: Path) -> None:
    """VTK writes bytes as colours, and arrays that are not active as fields."""
    numbers = NUMBERS.astype("u1")
    flat = numbers.ravel(order="F")
    shares = " ".join(f"{each / 255:.6g}" for each in flat.tolist()).encode()
    vectors = b"0 " * (3 * flat.size) if text else bytes(12 * flat.size)
    body = b" ".join(str(each).encode() for each in flat.tolist()) if text else flat.tobytes()
    field = b"FIELD FieldData 2\nshort 1 3 int\n" + (b"1 2 3\n" if text else bytes(12) + b"\n")
    cases = {
        "colours": vtk(numbers, text=text, lead="COLOR_SCALARS a 1\n", data=shares if text else flat.tobytes()),
        "field": vtk(numbers, text=text, lead=field.decode() + f"a 1 {flat.size} unsigned_char\n", data=body),
        "vectors": vtk(
            numbers,
            text=text,
            lead="VECTORS v float\n",
            data=vectors + b"\nSCALARS a unsigned_char\nLOOKUP_TABLE default\n" + body,
        ),
    }
    for name, whole in cases.items():
        path = tmp_path / f"{name}.vtk"
        path.write_bytes(whole)
        assert_in_place(read_volume(path), in_cells=False)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda w: w.replace(b"STRUCTURED_POINTS", b"POLYDATA"), "no volume; save an image"),
        (lambda w: w.replace(b"# vtk", b"# vtx"), "not a legacy VTK file"),
        (lambda w: w.replace(b"BINARY", b"OTHER"), "not a legacy VTK file"),
        (lambda w: w.replace(b"DIMENSIONS 5 6 7", b"DIMENSIONS 5 6"), "how many points"),
        (lambda w: w.replace(b"DIMENSIONS 5 6 7", b"DIMENSIONS -5 6 7"), "how many points"),
        (lambda w: w.replace(b"5 6 7", b"500000 600000 700000"), "GiB"),
        (lambda w: w.replace(b"5 6 7", b"5 6 8"), "cut off"),
        (lambda w: w.replace(b"SPACING 0.5", b"SPACING zero"), "broken"),
        (lambda w: w.replace(b"SPACING 0.5", b"SPACING -1"), "no usable place"),
        (lambda w: w.replace(b"short", b"string"), "broken"),
        (lambda w: w.replace(b"short 1", b"short 0"), "broken"),
        (lambda w: w.replace(b"short 1", b"short 2"), "2 numbers per cell; choose one of its 2 frames"),
        (lambda w: w.replace(b"SCALARS", b"SOMETHING"), "where its scalars should begin"),
        (lambda w: w[: w.index(b"SCALARS")], "holds no scalars"),
        (lambda w: w[:-50], "cut off"),
    ],
)
def test_a_broken_legacy_vtk(change: Callable[[bytes], bytes], says: str, tmp_path: Path) -> None:
    path = tmp_path / "a.vtk"
    path.write_bytes(change(vtk(NUMBERS.astype("i2"), text=False)))
    with pytest.raises((FormatError, MemoryLimitError), match=says) as caught:
        read_volume(path)
    if not isinstance(caught.value, MemoryLimitError):
        one_line(caught, path)


@pytest.mark.parametrize("word", [b"x", b"1.5", b"99999", b"9" * 500, b""])
def test_a_word_that_is_no_number_of_its_type(word: bytes, tmp_path: Path) -> None:
    path = tmp_path / "a.vtk"
    path.write_bytes(vtk(NUMBERS.astype("i2"), text=True).replace(b" 77 ", b" " + word + b" "))
    with pytest.raises(FormatError) as caught:
        read_volume(path)
    one_line(caught, path)


# --- VTK, XML --------------------------------------------------------------------------------------------


def vti(
    values: np.ndarray,
    *,
    form: str,
    packed: bool = False,
    raw: bool = False,
    big: bool = False,
    head: str = "UInt32",
    block: int = 100,
    of: str = "PointData",
) -> bytes:
    """Return an image [x, y, z] or [x, y, z, component], in blocks of `block` bytes where it is packed."""
    order = ">" if big else "<"
    word = np.dtype(VTI_TYPES_BACK[head]).newbyteorder(order)
    numbers = 1 if values.ndim == 3 else values.shape[3]
    flat = np.moveaxis(values, -1, 0).ravel(order="F") if numbers > 1 else values.ravel(order="F")
    data = flat.astype(flat.dtype.newbyteorder(order)).tobytes()
    if packed:
        blocks = [data[low : low + block] for low in range(0, len(data), block)]
        held = [zlib.compress(each) for each in blocks]
        last = len(blocks[-1]) % block
        sizes = np.array([len(blocks), block, last, *map(len, held)]).astype(word).tobytes()
        pieces = [sizes, b"".join(held)]
    else:
        pieces = [np.array([len(data)]).astype(word).tobytes() + data]
    coded = b"".join(pieces) if raw else b"".join(base64.b64encode(each) for each in pieces)
    text = " ".join(map(str, flat.tolist())).encode() if form == "ascii" else coded if form == "binary" else b""
    cells = [n + (of == "CellData") for n in values.shape[:3]]
    extent = f"2 {cells[0] + 1} -1 {cells[1] - 2} 0 {cells[2] - 1}"
    where = ' offset="0"' if form == "appended" else ""
    return (
        f'<?xml version="1.0"?>\n<VTKFile type="ImageData" version="1.0" byte_order="{"Big" if big else "Little"}Endian" '
        f'header_type="{head}"{" compressor=" + chr(34) + "vtkZLibDataCompressor" + chr(34) if packed else ""}>\n'
        f'<ImageData WholeExtent="{extent}" Origin="{10 - 2 * 0.5} {-20 + 0.7} 30" Spacing="0.5 0.7 2">\n'
        f'<Piece Extent="{extent}"><{of} Scalars="b"><DataArray type="Float32" Name="a" format="ascii">1</DataArray>'
        f'<DataArray type="{VTI_TYPES[values.dtype.str[1:]]}" Name="b" NumberOfComponents="{numbers}" '
        f'format="{form}"{where}>'
    ).encode() + (
        text
        + f"</DataArray></{of}></Piece></ImageData>\n".encode()
        + (f'<AppendedData encoding="{"raw" if raw else "base64"}">\n _'.encode() if form == "appended" else b"")
        + (coded + b"\n</AppendedData>" if form == "appended" else b"")
        + b"</VTKFile>\n"
    )


VTI_TYPES_BACK = {"UInt32": "u4", "UInt64": "u8"}
WAYS = [
    *({"form": "ascii", "of": of} for of in ("PointData", "CellData")),
    *({"form": "binary", "packed": p, "big": b, "head": h} for p in (0, 1) for b in (0, 1) for h in VTI_TYPES_BACK),
    *({"form": "appended", "packed": p, "raw": r} for p in (0, 1) for r in (0, 1)),
    {"form": "appended", "packed": 1, "raw": 1, "block": 420},  # whole blocks: none is left
    {"form": "appended", "packed": 1, "raw": 1, "block": 10**6},
]


@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS, ids=lambda way: " ".join(f"{key}={each}" for key, each in way.items()))
@pytest.mark.parametrize("dtype", list(VTI_TYPES))
def test_an_image_of_vtk_in_every_coding(dtype: str, way: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "a.vti"
    path.write_bytes(vti(NUMBERS.astype(dtype), **way))
    volume = read_volume(path)
    assert volume.values.dtype == np.dtype(dtype)
    assert_in_place(volume, in_cells=way.get("of") == "CellData")


def test_an_image_as_vtk_wrote_it(tmp_path: Path) -> None:
    """By vtkXMLImageDataWriter of VTK 9.7, packed; the first axis leads along y."""
    (tmp_path / "a.vti").write_text(
        """<?xml version="1.0"?>
<VTKFile type="ImageData" version="0.1" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
  <ImageData WholeExtent="0 1 0 1 0 2" Origin="1 2 3" Spacing="1 1 1" Direction="0 -1 0 1 0 0 0 0 1">
  <Piece Extent="0 1 0 1 0 2">
    <PointData Scalars="s">
      <DataArray type="Int16" Name="s" format="binary" RangeMin="0" RangeMax="11">
        AQAAAACAAAAYAAAAHQAAAA==eJwFwQcBADAIACB07vfvK7AMV9jKk47pawLqAEM=
      </DataArray>
    </PointData>
    <CellData>
    </CellData>
  </Piece>
  </ImageData>
</VTKFile>
"""
    )
    volume = read_volume(tmp_path / "a.vti")
    assert np.array_equal(volume.values, np.arange(12).reshape(2, 2, 3))
    assert centre(volume, (0, 0, 0)) == pytest.approx([1, 2, 3])
    assert centre(volume, (1, 0, 0)) == pytest.approx([1, 3, 3])


def test_components_of_an_image_are_frames(tmp_path: Path) -> None:
    path = tmp_path / "a.vti"
    path.write_bytes(vti(np.stack([NUMBERS, NUMBERS + 1], axis=-1).astype("i2"), form="binary"))
    assert np.array_equal(read_volume(path, frame=1).values, NUMBERS + 1)
    with pytest.raises(FormatError, match="2 numbers per cell; choose one of its 2 frames: --frame 0 to --frame 1"):
        read_volume(path)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda w: w.replace(b"ImageData", b"PolyData"), "no ImageData"),
        (lambda w: w.replace(b"vtkZLib", b"vtkLZ4"), "packed by vtkLZ4DataCompressor; save it packed by zlib"),
        (lambda w: w.replace(b"Int16", b"String"), "not a .vti file|broken|no array"),
        (lambda w: w.replace(b'"UInt32"', b'"Long"'), "broken"),
        (lambda w: w.replace(b"2 6 -1", b"2 600000 -1000000"), "GiB"),
        (lambda w: w.replace(b"2 6 -1", b"2 1 -1"), "broken"),
        (lambda w: w.replace(b'WholeExtent="2 6', b'WholeExtent="2 7'), "do not cover it"),
        (lambda w: w.replace(b'WholeExtent="2 6', b'WholeExtent="2 5'), "pieces that do not fit"),
        (lambda w: w.replace(b"Origin", b"Orign").replace(b"10 ", b"ten "), ""),
        (lambda w: w.replace(b'offset="0"', b'offset="99999"'), "begins where there is nothing"),
        (lambda w: w.replace(b'offset="0"', b'offset="x"'), "broken"),
        (lambda w: w.replace(b"<Piece", b"<Peace").replace(b"/Piece", b"/Peace"), "without a piece"),
        (lambda w: w[: len(w) // 2], "broken|cut off"),
        (lambda w: w[:-100], "broken|cut off"),
        (lambda w: w.replace(b"</DataArray>", b""), "broken"),
    ],
)
def test_a_broken_image_of_vtk(change: Callable[[bytes], bytes], says: str, tmp_path: Path) -> None:
    path = tmp_path / "a.vti"
    path.write_bytes(change(vti(NUMBERS.astype("i2"), form="appended", packed=True, raw=True)))
    if not says:
        read_volume(path)
        return
    with pytest.raises((FormatError, MemoryLimitError), match=says) as caught:
        read_volume(path)
    if not isinstance(caught.value, MemoryLimitError):
        one_line(caught, path)


@pytest.mark.slow
def test_a_small_image_cannot_unpack_to_all_memory(tmp_path: Path) -> None:
    """Blocks are unpacked to one byte more than their head says, which is what the extent needs."""
    bomb = zlib.compress(bytes(10**8))
    head = np.array([1, 420, 0, len(bomb)], "<u4").tobytes()
    whole = vti(NUMBERS.astype("i2"), form="appended", packed=True, raw=True)
    path = tmp_path / "a.vti"
    begin = whole.index(b"\n _") + 3
    path.write_bytes(whole[:begin] + head + bomb + b"</AppendedData></VTKFile>")
    with pytest.raises(FormatError, match="421 bytes or more where there should be 420"):
        read_volume(path)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["mgh", "mgz", "text.vtk", "bytes.vtk", "text.vti", "packed.vti", "raw.vti"])
def test_damage_is_read_or_told(kind: str, tmp_path: Path, rng: np.random.Generator) -> None:
    """A flipped bit, a word more, a piece less: nothing else than our errors."""
    numbers = NUMBERS.astype("i2")
    whole = {
        "mgh": lambda: mgh(numbers),
        "mgz": lambda: gzip.compress(mgh(numbers)),
        "text.vtk": lambda: vtk(numbers, text=True),
        "bytes.vtk": lambda: vtk(numbers, text=False),
        "text.vti": lambda: vti(numbers, form="ascii"),
        "packed.vti": lambda: vti(numbers, form="binary", packed=True),
        "raw.vti": lambda: vti(numbers, form="appended", raw=True),
    }[kind]()
    path = tmp_path / f"a.{kind}"
    outcomes = Counter[str]()
    for turn_of in range(150):
        bad = bytearray(whole)
        at = int(rng.integers(0, min(len(bad), 700)))
        if turn_of % 3 == 0:
            bad[at] ^= 1 << int(rng.integers(8))
        elif turn_of % 3 == 1:
            bad[at:at] = [b"999999", b"-1 ", b"nan ", b"\n"][int(rng.integers(4))]
        else:
            del bad[at : at + int(rng.integers(1, 40))]
        path.write_bytes(bad)
        try:
            read_volume(path)
        except (FormatError, MemoryLimitError):
            outcomes["told"] += 1
        else:
            outcomes["read"] += 1
    assert outcomes["told"] >= 1
    assert outcomes["read"] >= 1 or kind == "mgz"  # which has a checksum


# --- frames ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", [".nrrd", ".nii", ".nii.gz", ".mha", ".mhd"])
def test_one_frame_of_a_series_lies_where_it_lay(suffix: str, sitk: Any, tmp_path: Path) -> None:
    image = sitk.GetImageFromArray(np.ascontiguousarray(NUMBERS.astype("i2").T))
    image.SetSpacing(SPACING)
    image.SetOrigin(ORIGIN)
    image.SetDirection(turn().ravel().tolist())
    path = tmp_path / f"a{suffix}"
    sitk.WriteImage(sitk.JoinSeries([image, image + 1, image + 2], 7.0, 2.0), str(path))
    with pytest.raises(FormatError, match=r"5 x 6 x 7 x 3 cells; choose one of its 3 frames: --frame 0 to") as caught:
        read_volume(path)
    one_line(caught, path)
    for frame in range(3):
        volume = read_volume(path, frame=frame)
        assert np.array_equal(volume.values, NUMBERS + frame)
        said = image.TransformIndexToPhysicalPoint((4, 2, 6))
        assert centre(volume, (4, 2, 6)) == pytest.approx(said, abs=1e-5)
    for frame in (3, -1, 10**9):
        with pytest.raises(ParameterError, match=r"holds 3 frames, 0 to 2; give one"):
            read_volume(path, frame=frame)
    sitk.WriteImage(sitk.Compose(image, image + 1), str(path))
    assert np.array_equal(read_volume(path, frame=1).values, NUMBERS + 1)


def test_a_series_that_is_cut_off_is_told_whatever_frame(sitk: Any, tmp_path: Path) -> None:
    image = sitk.GetImageFromArray(np.ascontiguousarray(NUMBERS.astype("i2").T))
    path = tmp_path / "a.nii"
    sitk.WriteImage(sitk.JoinSeries([image, image + 1]), str(path))
    path.write_bytes(path.read_bytes()[:-10])
    with pytest.raises(FormatError, match="cut off"):
        read_volume(path, frame=0)


def test_the_only_frame_needs_no_choice_and_others_are_not_there(sitk: Any, tmp_path: Path) -> None:
    path = tmp_path / "a.nrrd"
    sitk.WriteImage(sitk.GetImageFromArray(np.ascontiguousarray(NUMBERS.T)), str(path))
    assert np.array_equal(read_volume(path, frame=0).values, NUMBERS)
    with pytest.raises(ParameterError, match="frame is 1 and .* holds one frame, number 0"):
        read_volume(path, frame=1)
    np.save(tmp_path / "a.npy", NUMBERS)
    with pytest.raises(ParameterError, match=r"frame is 0, and only .* hold frames, not .*a.npy"):
        read_volume(tmp_path / "a.npy", frame=0)


# --- a box -----------------------------------------------------------------------------------------------


def test_a_part_keeps_every_cell_in_its_place() -> None:
    volume = Volume(values=NUMBERS, spacing=SPACING, origin=ORIGIN, direction=turn(), space="LPS")
    some = cut_cells(volume, (1, 0, 2), (4, 6, 7))
    assert some.values.base is not None
    assert centre(some, (2, 3, 1)) == pytest.approx(centre(volume, (3, 3, 3)))
    assert some.values[2, 3, 1] == NUMBERS[3, 3, 3]


@pytest.mark.parametrize("axes", [(0, 1, 2), (1, 2, 0), (2, 0, 1)])
@pytest.mark.parametrize("signs", [(1, 1, 1), (-1, 1, -1), (-1, -1, 1)])
def test_a_box_takes_the_cells_with_their_centre_in_it(
    axes: tuple[int, ...], signs: tuple[int, ...], rng: np.random.Generator
) -> None:
    """Whichever way the axes of the grid lead."""
    direction = np.eye(3)[:, list(axes)] * signs
    volume = Volume(values=NUMBERS, spacing=SPACING, origin=ORIGIN, direction=direction)
    centres = volume.place((np.indices(SHAPE).reshape(3, -1).T + 0.5) * volume.cell_size)
    for _ in range(20):
        ends = np.sort(rng.uniform(centres.min(axis=0) - 1, centres.max(axis=0) + 1, (2, 3)), axis=0)
        inside = ((centres > ends[0]) & (centres < ends[1])).all(axis=1)
        if inside.sum() < 2:
            continue
        kept = crop(volume, tuple(ends.T.ravel().tolist()))
        assert sorted(kept.values.ravel()) == sorted(NUMBERS.ravel()[inside])
        cell = (0,) * 3
        assert centre(kept, cell) == pytest.approx(centres[NUMBERS.ravel() == kept.values[cell]][0])


def test_a_box_in_a_turned_grid_is_held_and_told(caplog: pytest.LogCaptureFixture) -> None:
    volume = Volume(values=np.arange(40**3).reshape((40,) * 3), direction=turn())
    middle = volume.place(np.array([[20.0, 20, 20]]))[0]
    kept = crop(volume, tuple(np.stack([middle - 5, middle + 5], axis=1).ravel().tolist()))
    assert all(10 <= count <= 20 for count in kept.values.shape)
    assert "turned by" in caplog.text


@pytest.mark.parametrize(
    ("roi", "says"),
    [
        ((0, 5, 0, 5), "give six finite numbers"),
        ((0, 5, 0, 5, 0, math.nan), "give six finite numbers"),
        ((5, 5, 0, 5, 0, 5), "from 5 to 5 mm in x; give the lower end first"),
        ((0, 5, 4, 3, 0, 5), "from 4 to 3 mm in y; give the lower end first"),
        ((50, 60, 0, 5, 0, 5), "holds no cell of the volume, which reaches 0 to 5, 0 to 6, 0 to 7 mm; move the box"),
        ((0.6, 1.4, 0, 5, 0, 5), "holds no cell"),
        ((0, 1, 0, 1, 0, 1), "holds 0 in all cells"),
    ],
)
def test_a_box_that_cannot_be(roi: tuple[float, ...], says: str) -> None:
    with pytest.raises(ParameterError, match=says) as caught:
        crop(Volume(values=NUMBERS), roi)
    assert "\n" not in str(caught.value)
