"""Nothing of a volume is made up: what is cut off, damaged, or not what its header announces is refused."""

from __future__ import annotations

import gzip
import re
import time
import zipfile
import zlib
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from infill.errors import FormatError, InfillError, MemoryLimitError
from infill.imaging.segmentations import read_segmentation
from infill.imaging.volume_files import read_volume
from tests import volume_writers as w
from tests.volume_writers import WAYS, Written

SHAPE = (6, 7, 8)
VALUES = np.random.default_rng(4).integers(-500, 500, SHAPE).astype("i2")
PACKED = [name for name, way in WAYS.items() if way(VALUES).packed is not None]


def save(folder: Path, written: Written) -> Path:
    for name, data in written.files().items():
        (folder / name).write_bytes(data)
    return folder / written.name


def refused(path: Path, says: str = "") -> str:
    with pytest.raises(FormatError, match=says or None) as caught:
        read_volume(path)
    said = str(caught.value)
    assert "\n" not in said
    assert said.isprintable()
    assert len(said) < 500
    assert "; " in said
    assert str(path) in said
    return said


def flip(data: bytes, at: int, bit: int = 0) -> bytes:
    return data[:at] + bytes([data[at] ^ (1 << bit)]) + data[at + 1 :]


@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS)
def test_a_whole_file_is_read(way: str, tmp_path: Path) -> None:
    volume = read_volume(save(tmp_path, WAYS[way](VALUES)))
    assert np.array_equal(volume.values, VALUES)
    assert volume.values.dtype == VALUES.dtype


@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS)
def test_a_file_that_is_cut_off_anywhere_is_refused(way: str, tmp_path: Path) -> None:
    """Whichever of its files: all but a few last bytes, that say nothing, are needed.

    A digit less is another number, and what ends with its cells may begin with anything.
    """
    written = WAYS[way](VALUES)
    path = save(tmp_path, written)
    lost = 120 if "text" in way or "from the end" in way else 0
    for name, data in written.files().items():
        if name == written.name and written.beside:
            continue  # a header without its end has lost fields, not cells
        unneeded = len(b"\n</AppendedData></VTKFile>\n") + 1 if "vti" in way else 20 if "tif" in way else 2
        for end in (0, 1, len(data) // 3, len(data) // 2, len(data) - 60 - lost, len(data) - unneeded - 1 - lost):
            if 0 <= end < len(data):
                (tmp_path / name).write_bytes(data[:end])
                refused(path)
        (tmp_path / name).write_bytes(data)


@pytest.mark.slow
@pytest.mark.parametrize("way", PACKED)
def test_a_bit_that_is_flipped_in_packed_cells_is_seen_by_its_checksum(way: str, tmp_path: Path) -> None:
    """In 40 places, the last bytes too, which are the checksum; nothing but the true cells may be read."""
    written = WAYS[way](VALUES)
    path = save(tmp_path, written)
    assert written.packed is not None
    name, begin, count = written.packed
    data = written.files()[name]
    told = 0
    places = np.random.default_rng(1).integers(0, count, 34).tolist() + list(range(count - 6, count))
    for at in places:
        (tmp_path / name).write_bytes(flip(data, begin + at, at % 8))
        try:
            values = read_volume(path).values
        except FormatError:
            told += 1
        else:  # a name or a time within the header of gzip, which is no part of the cells
            assert np.array_equal(values, VALUES)
    assert told >= 30


SHAPES = [(6, 7, 9), (6, 7, 16), (6, 7, 7), (6, 7, 4), (6, 14, 8), (3, 7, 8)]


def is_seen(way: str, shape: tuple[int, ...]) -> bool:
    """Return whether a header of other sizes cannot be true of the files of a format."""
    if way.startswith(("npz", "tif", "npy")) or "from the end" in way:
        return False  # its sizes are checked by another test, or anything may stand before its cells
    if ("list" in way or "numbered" in way) and shape[2] < SHAPE[2]:
        return False  # its header lists fewer files, and those are whole
    return not way.startswith(("mgh", "mgz", "vtk")) or np.prod(shape) > VALUES.size  # more may follow its cells


@pytest.mark.longest
@pytest.mark.parametrize(("way", "shape"), [(way, shape) for way in WAYS for shape in SHAPES if is_seen(way, shape)])
def test_other_sizes_than_the_cells_have_are_refused(way: str, shape: tuple[int, ...], tmp_path: Path) -> None:
    """More or fewer: the header of another volume, and these cells."""
    written, other = WAYS[way](VALUES), WAYS[way](np.resize(VALUES, shape))
    if written.beside:
        path = save(tmp_path, Written(name=written.name, data=other.data, beside=written.beside))
    elif way.startswith("nii.gz"):
        plain, head = gzip.decompress(written.data), gzip.decompress(other.data)
        path = save(tmp_path, Written(name=written.name, data=gzip.compress(head[:348] + plain[348:])))
    elif way.startswith("mgz"):
        plain, head = gzip.decompress(written.data), gzip.decompress(other.data)
        path = save(tmp_path, Written(name=written.name, data=gzip.compress(head[:284] + plain[284:])))
    else:
        path = save(tmp_path, Written(name=written.name, data=swap_head(way, written.data, shape)))
    refused(path)


def swap_head(way: str, data: bytes, shape: tuple[int, ...]) -> bytes:
    """Return a file with other sizes in its header, and the same cells."""
    new, old = " ".join(map(str, shape)).encode(), b"6 7 8"
    if way.startswith("nii"):
        order, at, kind = ("big" if "big" in way else "little"), (16 if " 2" in way else 40), (8 if " 2" in way else 2)
        sizes = b"".join(size.to_bytes(kind, order) for size in shape)
        return data[: at + kind] + sizes + data[at + 4 * kind :]
    if way.startswith("mgh"):
        return data[:4] + b"".join(size.to_bytes(4, "big") for size in shape) + data[16:]
    if way.startswith("vti"):
        old, new = b"0 5 0 6 0 7", b" ".join(f"0 {size - 1}".encode() for size in shape)
    assert old in data
    return data.replace(old, new)


@pytest.mark.slow
@pytest.mark.parametrize("way", [name for name in WAYS if name.startswith(("nrrd", "nhdr", "mha", "mhd", "nii"))])
def test_sizes_that_no_file_could_hold_are_refused_at_once(way: str, tmp_path: Path) -> None:
    written = WAYS[way](VALUES)
    data = gzip.decompress(written.data) if "nii.gz" in way else written.data
    huge = swap_head(way, data, (6, 7000, 30000))
    path = save(
        tmp_path,
        Written(name=written.name, data=gzip.compress(huge) if "nii.gz" in way else huge, beside=written.beside),
    )
    with pytest.raises((FormatError, MemoryLimitError)):
        read_volume(path)


@pytest.mark.slow
@pytest.mark.parametrize(
    "way", ["nrrd raw", "nhdr raw", "mha", "mhd", "nii", "nrrd gzip", "nhdr bzip2", "nii.gz", "npy"]
)
@pytest.mark.parametrize(
    ("more", "fine"), [(b"\0" * 100, True), (b"\n", True), (b"more" * 9, False), (b"1" * 900, False)]
)
def test_what_follows_the_cells_is_refused_unless_it_is_nothing(
    way: str, more: bytes, fine: bool, tmp_path: Path
) -> None:
    """Packed or not: files may be filled up to whole blocks."""
    written = WAYS[way](VALUES)
    path = save(tmp_path, written)
    name = next(iter(written.beside), written.name)
    with (tmp_path / name).open("ab") as file:
        file.write(more)
    if fine and not (more == b"\n" and ("gz" in way or "bzip2" in way)):
        volume = read_volume(path)
        assert np.array_equal(volume.values, VALUES)
        packed = "gz" in way or "bzip2" in way  # zeros may follow a packed stream
        told = [f"holds {len(more)} bytes more" in each for each in volume.warnings]
        assert told == [True] * (len(more) > 2 and not packed and way != "npy")
    elif not fine:
        refused(path)


@pytest.mark.parametrize("header", [0, 12])
@pytest.mark.parametrize("more", [0, 2, 40, 400])
@pytest.mark.parametrize("beside", [False, True])
def test_cells_at_the_end_of_a_file_are_those_of_simpleitk(
    header: int, more: int, beside: bool, tmp_path: Path
) -> None:
    """HeaderSize = -1: where zeros follow the cells they are taken for cells, and that is told."""
    sitk = pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")
    body = b"#" * header + w.flat(VALUES) + bytes(more)
    written = (
        Written(name="a.mhd", data=w.meta_head(VALUES, "a.raw", HeaderSize="-1"), beside={"a.raw": body})
        if beside
        else Written(name="a.mha", data=w.meta_head(VALUES, "LOCAL", HeaderSize="-1") + body)
    )
    path = save(tmp_path, written)
    volume = read_volume(path)
    assert np.array_equal(volume.values, sitk.GetArrayFromImage(sitk.ReadImage(str(path))).T)
    assert np.array_equal(volume.values, VALUES) == (more == 0)
    told = [f"holds {header + more} bytes more than its header announces" in each for each in volume.warnings]
    assert told == [True] * (header + more > 0)


def test_a_size_of_the_header_counts_from_the_beginning_of_the_file(tmp_path: Path) -> None:
    """Cells behind their own header: as in SimpleITK, which would read that header as cells, too."""
    sitk = pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")
    head = w.meta_head(VALUES, "LOCAL", HeaderSize="1000")
    path = tmp_path / "a.mha"
    path.write_bytes(head + b"#" * (1000 - len(head)) + w.flat(VALUES))
    assert np.array_equal(sitk.GetArrayFromImage(sitk.ReadImage(str(path))).T, VALUES)
    assert np.array_equal(read_volume(path).values, VALUES)
    for size in ("12", str(len(head) - 2)):
        path.write_bytes(w.meta_head(VALUES, "LOCAL", HeaderSize=size) + w.flat(VALUES))
        refused(path, f"HeaderSize of {size}, within its own header")
    path.write_bytes(w.meta_head(VALUES, "LOCAL", HeaderSize="-1") + w.flat(VALUES))  # the remedy
    assert np.array_equal(read_volume(path).values, VALUES)


@pytest.mark.parametrize("by", [-20, -1, 1, 1000])
def test_a_wrong_size_of_packed_data_is_refused(by: int, tmp_path: Path) -> None:
    """MetaImage says how many packed bytes there are."""
    body = zlib.compress(w.flat(VALUES))
    head = w.meta_head(VALUES, "LOCAL", CompressedData="True", CompressedDataSize=str(len(body) + by))
    (tmp_path / "a.mha").write_bytes(head + body)
    refused(tmp_path / "a.mha", "cut off")


def test_a_size_of_packed_data_parts_them_from_what_follows(tmp_path: Path) -> None:
    body = zlib.compress(w.flat(VALUES))
    head = w.meta_head(VALUES, "LOCAL", CompressedData="True", CompressedDataSize=str(len(body)))
    (tmp_path / "a.mha").write_bytes(head + body + b"\n")
    assert np.array_equal(read_volume(tmp_path / "a.mha").values, VALUES)
    (tmp_path / "a.mha").write_bytes(head + body + body)
    refused(tmp_path / "a.mha", "more")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["gzip", "bzip2"])
def test_a_small_file_cannot_unpack_to_all_memory(name: str, tmp_path: Path) -> None:
    """A stream of 50 MB of zeros behind a header of 336 cells: unpacking stops soon after these."""
    bomb = w.PACK[name](bytes(5 * 10**7))
    head = w.nrrd_head(VALUES, name).encode() + b"\n"
    (tmp_path / "a.nrrd").write_bytes(head + bomb)
    refused(tmp_path / "a.nrrd", "more bytes than its header announces")


@pytest.mark.parametrize("damage", ["cut", "flip", "fewer"])
def test_all_layers_of_a_segmentation_are_checked(damage: str, tmp_path: Path) -> None:
    layers = np.random.default_rng(2).integers(0, 3, (2, *SHAPE)).astype("u1")
    head = w.nrrd_head(
        layers,
        "gzip",
        space_directions="none (1,0,0) (0,0.5,0) (0,0,3)",
        kinds="list domain domain domain",
        sizes="2 6 7 9" if damage == "fewer" else "2 6 7 8",
    )
    fields = "Segment0_Name:=a\nSegment0_LabelValue:=1\nSegment0_Layer:=0\nSegment1_LabelValue:=1\nSegment1_Layer:=1\n"
    body = gzip.compress(w.flat(layers))
    path = tmp_path / "a.seg.nrrd"
    path.write_bytes(f"{head}{fields}\n".encode() + body)
    if damage != "fewer":
        assert [np.array_equal(x.values, y) for x, y in zip(read_segmentation(path).layers, layers, strict=True)] == [
            1,
            1,
        ]
    bad = {"cut": body[:-9], "flip": flip(body, len(body) // 2), "fewer": body}[damage]
    path.write_bytes(f"{head}{fields}\n".encode() + bad)
    with pytest.raises(FormatError, match="cut off|damaged"):
        read_segmentation(path)
    with pytest.raises(FormatError, match="cut off|damaged"):
        read_volume(path, frame=0)


@pytest.mark.parametrize("frame", [0, 1, 2])
@pytest.mark.parametrize("way", ["nii", "nii.gz", "nrrd gzip", "mha packed", "mha"])
def test_one_frame_is_read_only_from_a_whole_file(way: str, frame: int, tmp_path: Path) -> None:
    values = np.random.default_rng(3).integers(0, 99, (*SHAPE, 3)).astype("i2")
    four = {
        "nii": lambda: w.nifti(values),
        "nii.gz": lambda: w.nifti(values, packed=True),
        "nrrd gzip": lambda: w.nrrd(values, "gzip", space_directions="(1,0,0) (0,0.5,0) (0,0,3) none"),
        "mha packed": lambda: w.mha(values, packed=True, **four_axes()),
        "mha": lambda: w.mha(values, **four_axes()),
    }[way]()
    path = save(tmp_path, four)
    assert np.array_equal(read_volume(path, frame=frame).values, values[..., frame])
    path.write_bytes(four.data[:-15])
    with pytest.raises(FormatError, match="cut off"):
        read_volume(path, frame=frame)


def four_axes() -> dict[str, str]:
    return {
        "TransformMatrix": " ".join(map(str, np.eye(4, dtype=int).ravel())),
        "Offset": "-10 5 100 0",
        "ElementSpacing": "1 0.5 3 1",
    }


# --- NumPy's ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("packed", [True, False])
@pytest.mark.parametrize("shape", [b"(6, 7, 7)", b"(6, 7, 9)", b"(6, 1, 8)"])
def test_an_npz_whose_member_announces_other_sizes(packed: bool, shape: bytes, tmp_path: Path) -> None:
    """Its checksum fits."""
    data = w.npy(VALUES).data.replace(b"(6, 7, 8)", shape)
    with zipfile.ZipFile(tmp_path / "a.npz", "w", zipfile.ZIP_DEFLATED if packed else zipfile.ZIP_STORED) as archive:
        archive.writestr("values.npy", data)
    refused(tmp_path / "a.npz")


@pytest.mark.parametrize("shape", [b"(6, 7, 7)", b"(6, 7, 9)"])
def test_an_npy_that_announces_other_sizes(shape: bytes, tmp_path: Path) -> None:
    (tmp_path / "a.npy").write_bytes(w.npy(VALUES).data.replace(b"(6, 7, 8)", shape))
    refused(tmp_path / "a.npy")


@pytest.mark.slow
def test_a_bomb_in_an_npz_is_not_unpacked(tmp_path: Path) -> None:
    """A member that announces a few bytes and holds 50 MB is left unread behind these."""
    with zipfile.ZipFile(tmp_path / "a.npz", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("values.npy", w.npy(VALUES).data + bytes(5 * 10**7))
    refused(tmp_path / "a.npz", "more")


# --- TIFF ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("compression", ["zlib", None])
@pytest.mark.parametrize("tag", ["ImageLength", "ImageWidth"])
def test_a_page_of_tiff_that_announces_other_sizes(compression: str | None, tag: str, tmp_path: Path) -> None:
    import tifffile

    path = save(tmp_path, w.tiff(np.repeat(VALUES, 2, axis=2), compression, metadata=None))
    with tifffile.TiffFile(path, mode="r+") as file:
        for page in file.pages:
            page.tags[tag].overwrite(page.tags[tag].value * 3)
    refused(path)


@pytest.mark.parametrize("part", [0.2, 0.5, 0.9])
def test_a_packed_page_that_is_shortened(part: float, tmp_path: Path) -> None:
    """Its strip ends early, and the file does not."""
    import tifffile

    written = w.tiff(VALUES, "zlib", metadata=None)
    path = save(tmp_path, written)
    with tifffile.TiffFile(path, mode="r+") as file:
        tag = file.pages[3].tags["StripByteCounts"]
        tag.overwrite(int(tag.value[0] * part))
    refused(path)


# --- anything ----------------------------------------------------------------------------------------------

WORDS = (
    b"999999999",
    b"-1",
    b"nan",
    b"1e308",
    b"\n",
    b"\x1b[31m",
    b"\0\0\0\0",
    b"\xff\xff\xff\x7f",
    b"%99999d",
    b"/dev/zero",
)


def mutate(rng: np.random.Generator, data: bytes) -> bytes:
    """Change a few places of a file, most of them in its header."""
    bad = bytearray(data)
    for _ in range(rng.integers(1, 4)):
        at = int(rng.integers(0, min(len(bad), int(rng.choice([100, 500, 10**6])))))
        word = WORDS[rng.integers(len(WORDS))]
        match rng.integers(5):
            case 0:
                bad[at] ^= 1 << int(rng.integers(8))
            case 1:
                bad[at:at] = word
            case 2:
                bad[at : at + len(word)] = word
            case 3:
                del bad[at : at + int(rng.integers(1, 40))]
            case _:
                numbers = list(re.finditer(rb"-?\d+", bytes(bad[:600])))
                if numbers:
                    low, high = numbers[rng.integers(len(numbers))].span()
                    bad[low:high] = word
        if not bad:
            return b"\0"
    return bytes(bad)


# Ways in which hardly a byte can change unnoticed.
CHECKSUMMED = {"nii.gz", "nii.gz 2 big", "nhdr gzip", "nhdr skipping gzip", "nrrd gz", "nrrd bzip2", "mgz", "tif zlib"}
CHECKSUMMED |= {"npz", "npz stored"}


@pytest.mark.long
@pytest.mark.parametrize("way", WAYS)
def test_a_file_that_is_changed_anywhere_is_read_or_told(way: str, tmp_path: Path) -> None:
    """Nothing else than our errors, each one line that a terminal can show, and never for long."""
    rng = np.random.default_rng(len(way))
    written = WAYS[way](VALUES)
    outcomes = Counter[str]()
    for _ in range(25):
        path = save(tmp_path, written)
        name = rng.choice(sorted(written.files()))
        (tmp_path / name).write_bytes(mutate(rng, written.files()[name]))
        begin, said = time.process_time(), ""
        try:
            read_volume(path)
        except InfillError as error:
            said = str(error)
        outcomes["told" if said else "read"] += 1
        assert said.isprintable()
        assert len(said) < 700
        assert time.process_time() - begin < 3  # such a file of 700 bytes takes milliseconds
    assert outcomes["told"] >= 1
    assert outcomes["read"] >= 1 or way in CHECKSUMMED


def test_a_page_of_tiff_without_rows_is_told(tmp_path: Path) -> None:
    import tifffile

    path = save(tmp_path, w.tiff(VALUES, metadata=None))
    with tifffile.TiffFile(path, mode="r+") as file:
        for page in file.pages:
            page.tags["ImageLength"].overwrite(0)
    refused(path)
