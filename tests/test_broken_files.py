"""A broken file is one clear line; a bug of ours is a bug, whatever file it comes up in."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tifffile
import trimesh
from PIL import Image
from test_frames_and_more_formats import mgh, vti, vtk

from infill import FormatError, MemoryLimitError, Volume, read_mesh, save
from infill.files.broken import wrap_reader_errors
from infill.formats.point_files import read_points
from infill.imaging.volume_files import read_volume, write_field

BOX = trimesh.creation.box((3, 4, 5))
VALUES = np.indices((6, 7, 8)).sum(axis=0).astype(np.uint8)


def mesh(suffix: str, **options: Any) -> Callable[[Path], Path]:
    return lambda folder: save(BOX, folder / f"a{suffix}", **options)


def off(folder: Path) -> Path:
    BOX.export(folder / "a.off")
    return folder / "a.off"


def text(folder: Path) -> Path:
    np.savetxt(folder / "a.xyz", BOX.vertices)
    return folder / "a.xyz"


def array(values: np.ndarray) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        np.save(folder / "a.npy", values)
        return folder / "a.npy"

    return write


def field(suffix: str) -> Callable[[Path], Path]:
    return lambda folder: write_field(Volume(values=VALUES, spacing=0.5), folder / f"a{suffix}")


def tiff(folder: Path) -> Path:
    tifffile.imwrite(folder / "a.tif", VALUES, imagej=True, metadata={"axes": "ZYX", "spacing": 2.0})
    return folder / "a.tif"


def pictures(folder: Path) -> Path:
    (folder / "slices").mkdir()
    for k in range(3):
        Image.fromarray(VALUES[k]).save(folder / "slices" / f"{k}.png")
    return folder / "slices"


def nifti(folder: Path) -> Path:
    sitk = pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")
    sitk.WriteImage(sitk.GetImageFromArray(VALUES), str(folder / "a.nii"))
    return folder / "a.nii"


def mgh_file(folder: Path) -> Path:
    (folder / "a.mgh").write_bytes(mgh(VALUES))
    return folder / "a.mgh"


def vtk_file(folder: Path) -> Path:
    (folder / "a.vtk").write_bytes(vtk(VALUES, text=True))
    return folder / "a.vtk"


def vti_file(folder: Path) -> Path:
    (folder / "a.vti").write_bytes(vti(VALUES, form="binary", packed=True))
    return folder / "a.vti"


# A file, what reads it, and a helper of ours that it calls on the way.
READERS: dict[str, tuple[Callable[[Path], Path], Callable[[Path], object], str]] = {
    "stl": (mesh(".stl", ascii=True), read_mesh, "infill.formats.stl._text_corners"),
    "obj": (mesh(".obj"), read_mesh, "infill.formats.obj._corners"),
    "ply": (mesh(".ply"), read_mesh, "infill.formats.ply._header"),
    "off": (off, read_mesh, "infill.formats.off._count"),
    "glb": (mesh(".glb"), read_mesh, "infill.formats.gltf_reader._local"),
    "3mf": (mesh(".3mf"), read_mesh, "infill.formats.threemf_placing.start_part"),
    "3mf, placed": (mesh(".3mf"), read_mesh, "infill.formats.threemf_reading.parse_transform"),
    "points": (text, read_points, "infill.formats.point_files._find_separator"),
    "ply points": (mesh(".ply"), read_points, "infill.formats.point_files._ply_rows"),
    "npz": (field(".npz"), read_volume, "infill.imaging.arrays._axes"),
    "tif": (tiff, read_volume, "infill.imaging.slices._tiff_spacing"),
    "png": (pictures, read_volume, "infill.imaging.slices._read_png"),
    "nifti": (nifti, read_volume, "infill.imaging.nifti._scaled"),
    "mgh": (mgh_file, read_volume, "infill.imaging.freesurfer._read"),
    "vtk": (vtk_file, read_volume, "infill.imaging.vtk_images._lattice"),
    "vti": (vti_file, read_volume, "infill.imaging.vtk_xml._extent"),
}


@pytest.mark.slow
@pytest.mark.parametrize("error", [AttributeError, AssertionError, NameError, TypeError, KeyError, RuntimeError])
@pytest.mark.parametrize("name", READERS)
def test_a_bug_of_ours_does_not_read_as_a_broken_file(
    name: str, error: type[Exception], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Planted by a line that runs under the name of the helper's own module."""
    write, read, helper = READERS[name]
    path = write(tmp_path)
    read(path)
    space: dict[str, Any] = {"__name__": helper.rpartition(".")[0], "error": error}
    exec("def helper(*arguments, **options):\n    raise error('a bug')", space)
    monkeypatch.setattr(helper, space["helper"])
    with pytest.raises(error, match="a bug") as caught:
        read(path)
    assert not isinstance(caught.value, FormatError)


@pytest.mark.parametrize("name", READERS)
def test_memory_that_is_used_up_is_told_as_that(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write, read, helper = READERS[name]
    path = write(tmp_path)

    def greedy(*arguments: object, **options: object) -> None:
        raise MemoryError

    monkeypatch.setattr(helper, greedy)
    with pytest.raises((MemoryLimitError, MemoryError)) as caught:
        read(path)
    assert "broken" not in str(caught.value)


def test_a_glb_whose_text_is_none_is_one_line(tmp_path: Path) -> None:
    path = save(BOX, tmp_path / "a.glb")
    whole = bytearray(path.read_bytes())
    whole[30:34] = b"\xff\xfe\xff\xff"
    path.write_bytes(whole)
    with pytest.raises(FormatError, match="is broken"):
        read_mesh(path)


@pytest.mark.parametrize("error", [ValueError, EOFError, OverflowError])
def test_what_data_make_our_lines_raise_is_a_broken_file(error: type[Exception], tmp_path: Path) -> None:
    space: dict[str, Any] = {"__name__": "infill.formats.made_up", "error": error}
    exec("def parse():\n    raise error('no number')", space)
    with (
        pytest.raises(FormatError, match=r"x.stl is broken or not a .stl file \(no number\); save it again"),
        wrap_reader_errors(Path("x.stl")),
    ):
        space["parse"]()


PLY = "ply\n{}\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n"


@pytest.mark.parametrize(
    "head",
    [
        "format latin 1.0\nelement vertex 1",
        "format ascii 1.0",
        "format ascii 1.0\nproperty list uchar int a\nelement vertex 1",
        "format ascii 1.0\nelement vertex 1\nproperty quaternion q",
    ],
)
def test_a_header_of_nonsense_is_one_line(head: str, tmp_path: Path) -> None:
    (tmp_path / "a.ply").write_text(PLY.format(head))
    with pytest.raises(FormatError, match="header that is broken"):
        read_points(tmp_path / "a.ply")


@pytest.mark.parametrize(("resolution", "usable"), [((0, 1), True), ((1, 0), False), ((2, 1), True)])
def test_a_tiff_with_a_resolution_of_nothing(resolution: tuple[int, int], usable: bool, tmp_path: Path) -> None:
    """No cells to the length: nothing is said of them. Cells of no length: there is no such thing."""
    tifffile.imwrite(tmp_path / "a.tif", VALUES, imagej=True, metadata={"axes": "ZYX"})
    with tifffile.TiffFile(tmp_path / "a.tif", mode="r+b") as file:
        for name in ("XResolution", "YResolution"):
            file.pages[0].tags[name].overwrite(resolution)
    if usable:
        assert read_volume(tmp_path / "a.tif").cell_size[0] == (1 / resolution[0] if resolution[0] else 1)
    else:
        with pytest.raises(FormatError, match="no usable place"):
            read_volume(tmp_path / "a.tif")
