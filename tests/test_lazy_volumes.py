"""Volumes that are read in parts: every format gives the cells of its array, in its place, and says what is wrong."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import nibabel
import numpy as np
import pytest
import tifffile
import zarr
from hypothesis import given
from hypothesis import strategies as st

from infill import FormatError, ParameterError, read_volume
from infill.imaging.volume_files import write_field
from infill.lazy.opening import open_volume
from infill.lazy.volume import LazyVolume
from infill.lazy.zarr_fields import write_zarr_field

SHAPE = (11, 7, 5)
VALUES = (np.arange(11 * 7 * 5, dtype=np.uint16).reshape(SHAPE) * 7) % 251


def write_zarr(path: Path, **options: Any) -> str:
    array = zarr.create_array(str(path), shape=SHAPE, chunks=(4, 7, 2), dtype=VALUES.dtype, **options)
    array[:] = VALUES
    return str(path)


def write_h5(path: Path, **options: Any) -> str:
    with h5py.File(path, "w") as file:
        file.create_dataset("scan/ct", data=VALUES, **options)
    return f"{path}:/scan/ct"


def write_npy(path: Path, order: str) -> str:
    np.save(path, np.asarray(VALUES, order=order))  # type: ignore[call-overload]
    return str(path)


def write_tiff(path: Path, **options: Any) -> str:
    tifffile.imwrite(path, VALUES.T, **options)
    return str(path)


def write_slices(path: Path) -> str:
    path.mkdir()
    for number, page in enumerate(VALUES.T):
        tifffile.imwrite(path / f"s{number}.tif", page)
    return str(path)


def write_nifti(path: Path) -> str:
    affine = np.array([[-0.5, 0, 0, 3.0], [0, 0.25, 0, 1.0], [0, 0, 2.0, -4.0], [0, 0, 0, 1]])
    image = nibabel.Nifti1Image(VALUES, affine)
    image.header.set_xyzt_units("mm")
    nibabel.save(image, path)
    return str(path)


def write_nrrd(path: Path) -> str:
    head = (
        "NRRD0004\ntype: uint16\ndimension: 3\nsizes: 11 7 5\nspace: left-posterior-superior\n"
        "space directions: (0.5,0,0) (0,0.25,0) (0,0,2)\nspace origin: (3,1,-4)\nendian: little\nencoding: raw\n\n"
    )
    path.write_bytes(head.encode() + VALUES.tobytes(order="F"))
    return str(path)


WRITERS: dict[str, Callable[[Path], str]] = {
    "v3.zarr": write_zarr,
    "v2.zarr": lambda path: write_zarr(path, zarr_format=2),
    "plain.h5": write_h5,
    "packed.h5": lambda path: write_h5(path, chunks=(4, 7, 2), compression="gzip"),
    "c.npy": lambda path: write_npy(path, "C"),
    "f.npy": lambda path: write_npy(path, "F"),
    "plain.tif": write_tiff,
    "big.tif": lambda path: write_tiff(path, bigtiff=True),
    "swapped.tif": lambda path: write_tiff(path, byteorder=">"),
    "packed.tif": lambda path: write_tiff(path, compression="zlib"),
    "imagej.tif": lambda path: write_tiff(path, imagej=True, metadata={"axes": "ZYX", "spacing": 2.0, "unit": "mm"}),
    "slices": write_slices,
    "place.nii": write_nifti,
    "place.nrrd": write_nrrd,
}


@pytest.mark.parametrize("name", WRITERS)
def test_a_box_of_cells_is_that_of_the_array(name: str, tmp_path: Path) -> None:
    volume = open_volume(WRITERS[name](tmp_path / name))
    assert volume.shape == SHAPE
    copy = pickle.loads(pickle.dumps(volume))
    for box in ((slice(0, 11), slice(0, 7), slice(0, 5)), (slice(3, 9), slice(6, 7), slice(1, 4))):
        cells = volume.array.read(box)
        np.testing.assert_array_equal(cells, VALUES[box])
        assert cells.dtype == VALUES.dtype
        assert cells.flags.c_contiguous
        np.testing.assert_array_equal(copy.array.read(box), cells)


def test_an_array_that_is_overwritten_is_opened_again(tmp_path: Path) -> None:
    path = write_zarr(tmp_path / "a.zarr")
    box = tuple(slice(0, count) for count in SHAPE)
    np.testing.assert_array_equal(open_volume(path).array.read(box), VALUES)
    array = zarr.create_array(path, shape=SHAPE, chunks=(11, 7, 5), dtype="f4", overwrite=True)
    array[:] = 0.5
    assert (open_volume(path).array.read(box) == 0.5).all()


@pytest.mark.parametrize("name", ["c.npy", "plain.tif", "imagej.tif", "slices", "place.nii", "place.nrrd"])
def test_the_place_is_that_of_read_volume(name: str, tmp_path: Path) -> None:
    path = WRITERS[name](tmp_path / name)
    lazy, whole = open_volume(path), read_volume(path)
    assert lazy.spacing == tuple(whole.cell_size)
    assert lazy.origin == whole.origin
    np.testing.assert_array_equal(np.asarray(lazy.direction), np.asarray(whole.direction))
    assert lazy.space == whole.space
    np.testing.assert_array_equal(lazy.load().values, whole.values)


@given(low=st.tuples(*[st.integers(0, 2)] * 3), size=st.tuples(*[st.integers(1, 3)] * 3))
def test_boxes_of_crops(low: tuple[int, ...], size: tuple[int, ...]) -> None:
    class Whole:
        shape, dtype = SHAPE, VALUES.dtype

        def read(self, box: tuple[slice, ...]) -> Any:
            return VALUES[box]

    volume = LazyVolume(array=Whole(), spacing=(0.5, 1.0, 2.0), origin=(1.0, 2.0, 3.0))
    ends = [(o + a * h, o + (a + n) * h) for o, a, n, h in zip(volume.origin, low, size, volume.spacing, strict=True)]
    part = volume.crop(tuple(end for pair in ends for end in pair))
    assert part.shape == size
    assert part.origin == tuple(begin for begin, _ in ends)
    box = tuple(slice(a, a + n) for a, n in zip(low, size, strict=True))
    np.testing.assert_array_equal(part.load().values, VALUES[box])


# --- OME-Zarr --------------------------------------------------------------------------------------------


def write_ome(path: Path, *, version: str, axes: str = "zyx", unit: str | None = "micrometer", **more: Any) -> None:
    """Write two levels, [z, y, x] with further axes of one cell before."""
    group = zarr.open_group(str(path), mode="w", zarr_format=3 if version == "0.5" else 2)
    order = [axes.index(axis) for axis in axes if axis in "xyz"]
    stored = VALUES.transpose([{"x": 0, "y": 1, "z": 2}[axes[n]] for n in order])
    stored = stored.reshape((1,) * (len(axes) - 3) + stored.shape)
    sizes = {"x": 500.0, "y": 250.0, "z": 2000.0}
    datasets = []
    for level in range(2):
        part = stored[..., :: 2**level, :: 2**level, :: 2**level]
        array = group.create_array(str(level), shape=part.shape, chunks=part.shape, dtype=part.dtype)
        array[:] = part
        scale = [sizes[axis] * 2**level if axis in sizes else 1.0 for axis in axes]
        changes: list[dict[str, Any]] = [{"type": "scale", "scale": scale}]
        if "shift" in more:
            changes.append({"type": "translation", "translation": [more["shift"] if a in sizes else 0.0 for a in axes]})
        datasets.append({"path": str(level), "coordinateTransformations": changes})
    listed = [
        {"name": axis, **({"type": "space", **({} if unit is None else {"unit": unit})} if axis in sizes else {})}
        for axis in axes
    ]
    scales = [{"version": version, "axes": listed, "datasets": datasets}]
    group.attrs.update(
        {"ome": {"version": "0.5", "multiscales": scales}} if version == "0.5" else {"multiscales": scales}
    )


@pytest.mark.parametrize("version", ["0.4", "0.5"])
@pytest.mark.parametrize("axes", ["zyx", "tczyx", "xyz"])
def test_levels_of_ome_zarr_are_placed_by_their_axes(version: str, axes: str, tmp_path: Path) -> None:
    write_ome(tmp_path / "a.ome.zarr", version=version, axes=axes)
    finest, coarse = open_volume(tmp_path / "a.ome.zarr"), open_volume(tmp_path / "a.ome.zarr" / "1")
    assert finest.spacing == (0.5, 0.25, 2.0)
    assert coarse.spacing == (1.0, 0.5, 4.0)
    assert finest.origin == coarse.origin == (0.0, 0.0, 0.0)
    np.testing.assert_array_equal(finest.load().values, VALUES)
    np.testing.assert_array_equal(coarse.load().values, VALUES[::2, ::2, ::2])


def test_a_translation_places_the_centre_of_the_first_cell(tmp_path: Path) -> None:
    write_ome(tmp_path / "a.zarr", version="0.5", shift=1000.0)
    assert open_volume(tmp_path / "a.zarr").origin == (0.75, 0.875, 0.0)


def test_spacing_and_a_missing_unit(tmp_path: Path) -> None:
    write_ome(tmp_path / "a.zarr", version="0.5", unit=None)
    assert open_volume(tmp_path / "a.zarr").spacing == (500.0, 250.0, 2000.0)
    assert open_volume(tmp_path / "a.zarr", spacing=0.5).spacing == (0.5, 0.5, 0.5)


def test_several_channels_are_refused(tmp_path: Path) -> None:
    group = zarr.open_group(str(tmp_path / "a.zarr"), mode="w")
    group.create_array("0", shape=(2, 3, 3, 3), chunks=(1, 3, 3, 3), dtype="u1")
    axes = [{"name": axis} for axis in "czyx"]
    datasets = [{"path": "0", "coordinateTransformations": [{"type": "scale", "scale": [1, 1, 1, 1]}]}]
    group.attrs["ome"] = {"multiscales": [{"axes": axes, "datasets": datasets}]}
    with pytest.raises(FormatError, match="2 cells along its axis c; save one of them"):
        open_volume(tmp_path / "a.zarr")


# --- faults ----------------------------------------------------------------------------------------------


def test_a_group_of_several_arrays_asks_for_one(tmp_path: Path) -> None:
    group = zarr.open_group(str(tmp_path / "a.zarr"), mode="w")
    for name in ("ct", "pet"):
        group.create_array(name, shape=SHAPE, chunks=SHAPE, dtype="u2")[:] = VALUES
    with pytest.raises(FormatError, match=r"holds 2 arrays \(ct, pet\); give one: .*a.zarr/ct$"):
        open_volume(tmp_path / "a.zarr")
    for volume in (open_volume(tmp_path / "a.zarr", array="pet"), open_volume(tmp_path / "a.zarr" / "pet")):
        np.testing.assert_array_equal(volume.load().values, VALUES)
    with pytest.raises(ParameterError, match="is an array itself; leave it out"):
        open_volume(tmp_path / "a.zarr" / "ct", array="ct")


def test_a_corrupt_chunk_is_named_and_a_missing_one_told(
    tmp_path: Path, log_heard: None, caplog: pytest.LogCaptureFixture
) -> None:
    path = Path(write_zarr(tmp_path / "a.zarr"))
    chunk = path / "c" / "1" / "0" / "1"
    chunk.write_bytes(b"no chunk")
    volume = open_volume(path)
    np.testing.assert_array_equal(volume.array.read((slice(0, 3), slice(0, 7), slice(0, 5))), VALUES[:3])
    with pytest.raises(FormatError, match=r"a.zarr is damaged: its cells 4 to 7, 0 to 6, 0 to 4 cannot be read"):
        volume.array.read((slice(4, 8), slice(0, 7), slice(0, 5)))
    chunk.unlink()
    again = open_volume(path)
    assert "lacks 1 of its 9 chunks, which Zarr reads as 0" in caplog.text
    assert again.warnings
    assert (again.array.read((slice(4, 8), slice(0, 7), slice(2, 4))) == 0).all()


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("none.zarr", "there is no .*none.zarr; check the name"),
        ("empty.zarr", "is broken or not Zarr"),
        ("none.h5", "there is no file .*none.h5"),
        ("junk.h5", "is broken or not HDF5"),
        ("flat.npy", "holds an array of shape"),
        ("a.mha", "cannot be read in parts; save it as"),
        ("packed.nii", "is compressed, so that no part of it can be read"),
        ("packed.nrrd", "is encoded as gzip, so that no part of it can be read; save it raw"),
        ("nothing", "holds no .tif"),
    ],
)
def test_what_cannot_be_opened(name: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "empty.zarr").mkdir()
    (tmp_path / "nothing").mkdir()
    for junk in ("junk.h5", "a.mha"):
        (tmp_path / junk).write_text("hello")
    np.save(tmp_path / "flat.npy", np.zeros((3, 4)))
    import gzip

    packed = gzip.compress(Path(write_nifti(tmp_path / "place.nii")).read_bytes())
    (tmp_path / "packed.nii").write_bytes(packed)
    write_field(read_volume(tmp_path / "place.nii"), tmp_path / "packed.nrrd")
    with pytest.raises(FormatError, match=message):
        open_volume(tmp_path / name)


def test_a_dataset_is_asked_for_by_its_name(tmp_path: Path) -> None:
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["a"], file["b"], file["flat"] = VALUES, VALUES[::-1], VALUES[0]
    with pytest.raises(FormatError, match=r"holds 2 datasets \(/a, /b\); give one: .*a.h5:/a$"):
        open_volume(tmp_path / "a.h5")
    with pytest.raises(FormatError, match="holds no dataset '/c'; it holds /a, /b"):
        open_volume(f"{tmp_path / 'a.h5'}:/c")
    np.testing.assert_array_equal(open_volume(f"{tmp_path / 'a.h5'}:/b").load().values, VALUES[::-1])


def test_a_scaled_nifti_is_refused(tmp_path: Path) -> None:
    image = nibabel.Nifti1Image(VALUES.astype(np.int16), np.eye(4))
    image.header.set_slope_inter(2.0, 1.0)
    nibabel.save(image, tmp_path / "a.nii")
    with pytest.raises(FormatError, match="scales its cells by"):
        open_volume(tmp_path / "a.nii")


@pytest.mark.parametrize(("package", "name"), [("zarr", "a.zarr"), ("h5py", "a.h5")])
def test_a_missing_package_is_named(package: str, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from infill.lazy import hdf5, zarr_arrays

    WRITERS["plain.h5" if package == "h5py" else "v3.zarr"](tmp_path / name)
    for module in (hdf5, zarr_arrays):
        monkeypatch.setattr(module, "find_spec", lambda asked: None if asked == package else True)
    with pytest.raises(ParameterError, match=r"needs .*: pip install dask distributed fsspec h5py zarr$"):
        open_volume(tmp_path / name)


def test_a_field_comes_back_in_its_place(tmp_path: Path) -> None:
    values = VALUES.astype(np.float32) / 251
    write_npy(tmp_path / "a.npy", "C")
    volume = LazyVolume(array=open_volume(tmp_path / "a.npy").array, spacing=(0.5, 0.25, 2.0), origin=(1.0, 2.0, 3.0))
    boxes = [((slice(a, a + 4), slice(0, 7), slice(0, 5)), values[a : a + 4]) for a in range(0, 11, 4)]
    write_zarr_field(tmp_path / "f.zarr", volume, [(b, v) for b, v in boxes])
    again = open_volume(tmp_path / "f.zarr")
    np.testing.assert_array_equal(again.load().values, values)
    assert (again.spacing, again.origin) == (volume.spacing, volume.origin)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.npy", "f.zarr"]


def test_a_field_that_fails_leaves_nothing(tmp_path: Path) -> None:
    def fail() -> Any:
        yield (slice(0, 4), slice(0, 7), slice(0, 5)), np.zeros((4, 7, 5), dtype=np.float32)
        raise KeyboardInterrupt

    write_npy(tmp_path / "a.npy", "C")
    with pytest.raises(KeyboardInterrupt):
        write_zarr_field(tmp_path / "f.zarr", open_volume(tmp_path / "a.npy"), fail())
    assert [path.name for path in tmp_path.iterdir()] == ["a.npy"]
