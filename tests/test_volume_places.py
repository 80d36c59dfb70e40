"""Where volumes lie: as nibabel and SimpleITK say, whatever the header says it by; what contradicts itself is told."""

from __future__ import annotations

import contextlib
import gzip
import logging
import math
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from infill.errors import FormatError
from infill.imaging.volume_files import read_volume
from infill.volume import Volume
from tests import volume_writers as w

SHAPE = (3, 4, 5)
VALUES = np.arange(60).reshape(SHAPE).astype("i2")
CELLS = np.array(list(np.ndindex(SHAPE)))
LPS = np.array([-1.0, -1.0, 1.0])
# Headers in 32 bits, cells of up to 10 mm, up to 500 mm away.
ROUNDED = 1e-3


@pytest.fixture(scope="module")
def sitk() -> Any:
    return pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")


@pytest.fixture(scope="module")
def nib() -> Any:
    return pytest.importorskip("nibabel")


@contextlib.contextmanager
def heard() -> Iterator[list[str]]:
    """Collect the warnings of a block."""
    said: list[str] = []

    class Heard(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            said.append(record.getMessage())

    handler, log = Heard(logging.WARNING), logging.getLogger("infill")
    log.addHandler(handler)
    try:
        yield said
    finally:
        log.removeHandler(handler)


def read(written: w.Written, **options: Any) -> tuple[Volume, list[str]]:
    """Return the volume that a file holds, and the warnings, which it carries to the report."""
    with tempfile.TemporaryDirectory() as folder:
        for name, data in written.files().items():
            (Path(folder) / name).write_bytes(data)
        with heard() as said:
            volume = read_volume(Path(folder) / written.name, **options)
        assert volume.warnings == tuple(said)
        return volume, said


def centres(volume: Volume) -> np.ndarray:
    return volume.place((CELLS + 0.5) * volume.cell_size)


def by_affine(affine: np.ndarray) -> np.ndarray:
    return CELLS @ affine[:3, :3].T + affine[:3, 3]


def rotation(a: float, b: float, c: float) -> np.ndarray:
    about_z = np.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]])
    about_x = np.array([[1, 0, 0], [0, math.cos(b), -math.sin(b)], [0, math.sin(b), math.cos(b)]])
    about_y = np.array([[math.cos(c), 0, math.sin(c)], [0, 1, 0], [-math.sin(c), 0, math.cos(c)]])
    return about_z @ about_x @ about_y


angles = st.sampled_from([0.0, math.pi / 2, math.pi, -math.pi / 2]) | st.floats(-math.pi, math.pi)
sizes = st.tuples(*[st.floats(0.1, 10)] * 3)


@st.composite
def affines(draw: st.DrawFn) -> np.ndarray:
    """A turn, a mirror or none, an order of axes, sizes and a place."""
    turn = rotation(*(draw(angles) for _ in range(3)))
    mirror = np.diag([draw(st.sampled_from([1, -1])), 1, 1])
    order = np.eye(3)[:, list(draw(st.permutations(range(3))))]
    first = [draw(st.floats(-500, 500)) for _ in range(3)]
    linear = (turn @ mirror @ order) * np.array(draw(sizes))
    return np.vstack([np.column_stack([linear, first]), [0, 0, 0, 1]])


# --- NIfTI -----------------------------------------------------------------------------------------------


@pytest.mark.slow
@given(affines(), affines(), st.integers(0, 4), st.integers(0, 4), st.booleans(), st.sampled_from([0, 1, 2, 3]))
@example(np.diag([2.0, 3, 4, 1]), np.diag([2.0, 3, 4, 1]), 0, 0, False, 2)
@example(np.diag([-1.0, -1, 1, 1]), np.diag([1.0, 1, -1, 1]), 1, 1, True, 3)
def test_nifti_lies_where_nibabel_says(
    sform: np.ndarray, qform: np.ndarray, s: int, q: int, second: bool, unit: int
) -> None:
    """By the codes: the sform, else the qform, else sizes alone; mm, whatever the unit."""
    import nibabel as nib

    kind = nib.Nifti2Image if second else nib.Nifti1Image
    image = kind(VALUES, None)
    image.header.set_sform(sform, s)
    image.header.set_qform(qform, q)
    image.header["xyzt_units"] = unit
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.nii"
        nib.save(image, path)
        told = nib.load(path).affine
        with heard() as said:
            volume = read_volume(path)
    scale = {0: 1.0, 1: 1000.0, 2: 1.0, 3: 1e-3}[unit]
    assert np.abs(centres(volume) - by_affine(told) * LPS * scale).max() < ROUNDED * scale
    assert np.array_equal(volume.values, VALUES)
    assert volume.mirrored == (np.linalg.det(told[:3, :3]) < 0)
    apart = np.abs(by_affine(sform) - by_affine(qform)).max() / np.linalg.norm(sform[:3, :3], axis=0).min()
    if s and q and apart > 0.02:
        assert any("states two places" in each for each in said)
    if s and q and apart < 0.005:
        assert not any("states two places" in each for each in said)
    assert any("both codes are 0" in each for each in said) == (s == q == 0)


@pytest.mark.slow
@given(affines(), st.sampled_from(["<", ">"]), st.sampled_from([1, 2]), st.booleans())
def test_nifti_in_every_form_lies_at_its_matrix(affine: np.ndarray, order: str, version: int, packed: bool) -> None:
    size = tuple(np.linalg.norm(affine[:3, :3], axis=0))
    volume, said = read(w.nifti(VALUES, packed=packed, order=order, version=version, sform=affine, pixdim=(1, *size)))
    assert np.abs(centres(volume) - by_affine(affine) * LPS).max() < ROUNDED
    assert said == []


@pytest.mark.parametrize("nudge", [0.0, 0.001, 0.05, 1.0])
def test_places_that_differ_are_told_and_rounding_is_not(nudge: float) -> None:
    """A shift of the qform by a share of a cell."""
    sform = np.array([[-1, 0, 0, 10], [0, -0.5, 0, -5], [0, 0, 3, 100.0]])
    volume, said = read(
        w.nifti(VALUES, sform=sform, qform_code=1, quaternion=(0, 0, 1, 10 + nudge / 2, -5, 100), pixdim=(1, 1, 0.5, 3))
    )
    assert centres(volume)[0] == pytest.approx([-10, 5, 100])
    assert bool(said) == (nudge > 0.01)


@pytest.mark.parametrize(
    ("pixdim", "told"), [((1, 1, 0.5, 3), False), ((1, 1, 1, 1), True), ((1, 1, 0.5, 3.001), False)]
)
def test_sizes_that_contradict_the_matrix_are_told(pixdim: tuple[float, ...], told: bool) -> None:
    volume, said = read(w.nifti(VALUES, pixdim=pixdim))
    assert volume.spacing == pytest.approx((1, 0.5, 3))
    assert any("pixdim" in each for each in said) == told


def test_a_sheared_matrix_is_refused() -> None:
    sheared = np.array([[-1, 0.3, 0, 10], [0, -0.5, 0, -5], [0, 0, 3, 100.0]])
    with pytest.raises(FormatError, match="no usable place in space"):
        read(w.nifti(VALUES, sform=sheared))
    with pytest.raises(FormatError, match="no usable place in space"):
        read(w.nifti(VALUES, sform=sheared * [[1], [0], [1]]))


@pytest.mark.parametrize("unit", [4, 5, 6, 7])
def test_an_unknown_unit_of_nifti_is_told(unit: int) -> None:
    assert any("unknown unit" in each for each in read(w.nifti(VALUES, units=unit))[1])


@pytest.mark.parametrize("unit", [0, 8, 16, 24])
def test_a_unit_of_nifti_that_is_not_said_is_told(unit: int) -> None:
    volume, said = read(w.nifti(VALUES, units=unit))
    assert ["does not say its unit of length; it is taken as mm" in each for each in said] == [True]
    assert volume.spacing == pytest.approx((1, 0.5, 3))


@pytest.mark.parametrize("unit", [8, 16, 24, 2 + 8, 3 + 16, 1 + 24])
def test_units_of_time_are_no_units_of_length(unit: int) -> None:
    assert read(w.nifti(VALUES, units=unit))[0].spacing == pytest.approx(
        np.array([1, 0.5, 3]) * {0: 1, 2: 1, 3: 1e-3, 1: 1e3}[unit & 7]
    )


@pytest.mark.slow
@pytest.mark.parametrize("slope", [(2.0, 0.0), (0.5, -7.0), (1.0, 3.0), (0.0, 5.0), (math.nan, math.nan), (1.0, 0.0)])
@pytest.mark.parametrize("dtype", ["u1", "i2", "i4", "f4", "f8"])
def test_values_are_scaled_as_nibabel_does(slope: tuple[float, float], dtype: str, tmp_path: Path, nib: Any) -> None:
    values = VALUES.astype(dtype)
    (tmp_path / "a.nii").write_bytes(w.nifti(values, slope=slope).data)
    assert np.allclose(read_volume(tmp_path / "a.nii").values, nib.load(tmp_path / "a.nii").get_fdata(), rtol=1e-6)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda d: d.replace(b"n+1\0", b"ni1\0"), "header of a pair"),
        (lambda d: d.replace(b"n+1\0", b"abc\0"), "no mark of NIfTI"),
        (lambda d: d[:70] + b"\x20\0" + d[72:], "complex"),
        (lambda d: d[:70] + b"\x80\0" + d[72:], "3 numbers per cell"),
        (lambda d: d[:70] + b"\x00\x06" + d[72:], "cells of type 1536"),
        (lambda d: d[:70] + b"\x08\0" + d[72:], "16 bits and a type of 32"),
        (lambda d: d[:40] + b"\x08\0" + d[42:], "8 axes"),
        (lambda d: d[:42] + b"\0\0" + d[44:], "0 x 4 x 5 cells"),
        (lambda d: d[:40] + b"\x02\0" + d[42:], "single slice"),
        (lambda d: d[:108] + np.float32(100).tobytes() + d[112:], "begin at byte 100"),
        (lambda d: d[:108] + np.float32(np.nan).tobytes() + d[112:], "begin at byte nan"),
        (lambda d: d[:252] + b"\1\0\0\0" + np.array([1, 1, 1], "f4").tobytes() + d[268:], "not a rotation"),
        (lambda d: b"\0\0\0\0" + d[4:], "does not begin with a header"),
    ],
)
def test_a_header_of_nifti_that_is_no_use(change: Any, says: str, tmp_path: Path) -> None:
    (tmp_path / "a.nii").write_bytes(change(w.nifti(VALUES).data))
    with pytest.raises(FormatError, match=says):
        read_volume(tmp_path / "a.nii")


# --- NRRD ------------------------------------------------------------------------------------------------


def vectors(affine: np.ndarray) -> dict[str, str]:
    columns = [f"({','.join(repr(float(x)) for x in column)})" for column in affine[:3, :3].T]
    return {
        "space_directions": " ".join(columns),
        "space_origin": f"({','.join(repr(float(x)) for x in affine[:3, 3])})",
    }


@pytest.mark.slow
@given(affines(), st.sampled_from(["RAS", "LPS", "LAS", "right-anterior-superior", "left-posterior-superior"]))
def test_nrrd_lies_where_simpleitk_says(affine: np.ndarray, space: str) -> None:
    sitk = pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")
    written = w.nrrd(VALUES, space=space, **vectors(affine))
    volume, said = read(written)
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "a.nrrd").write_bytes(written.data)
        image = sitk.ReadImage(str(Path(folder) / "a.nrrd"))
    told = [image.TransformIndexToPhysicalPoint(tuple(map(int, cell))) for cell in CELLS]
    assert np.abs(centres(volume) - told).max() < 1e-6  # 500 mm in 64 bits, through sizes and directions
    assert volume.space == "LPS"
    assert said == []


@pytest.mark.parametrize(
    ("space", "named"),
    [("scanner-xyz", ""), ("3D-right-handed", ""), ("left-posterior-superior", "LPS"), ("LAS", "LPS"), ("ras", "LPS")],
)
def test_spaces_of_nrrd(space: str, named: str) -> None:
    assert read(w.nrrd(VALUES, space=space))[0].space == named
    assert read(w.nrrd(VALUES, space=None, space_dimension="3"))[0].space == ""


@pytest.mark.parametrize("space", ["3D-left-handed", "3D-left-handed-time", "galactic", "left-posterior"])
def test_a_space_that_is_mirrored_or_unknown_is_refused(space: str) -> None:
    with pytest.raises(FormatError, match=r"left-handed|unknown"):
        read(w.nrrd(VALUES, space=space))


@pytest.mark.slow
@pytest.mark.parametrize("at", [0, 1, 2, 3])
@pytest.mark.parametrize("kind", ["list", "vector", "time", "RGB-color", "2-vector"])
def test_axes_that_are_not_of_space_are_frames_wherever_they_stand(at: int, kind: str) -> None:
    frames = np.stack([VALUES, VALUES + 100], axis=at)
    directions, kinds = ["(1,0,0)", "(0,0.5,0)", "(0,0,3)"], ["domain"] * 3
    directions.insert(at, "none")
    kinds.insert(at, kind)
    written = w.nrrd(frames, space_directions=" ".join(directions), kinds=" ".join(kinds))
    with pytest.raises(FormatError, match="choose one of its 2 frames"):
        read(written)
    for frame in (0, 1):
        volume, _ = read(written, frame=frame)
        assert np.array_equal(volume.values, VALUES + 100 * frame)
        assert volume.spacing == (1, 0.5, 3)
        assert centres(volume)[0] == pytest.approx([-10, 5, 100])
    by_kind = w.nrrd(
        frames, space=None, space_directions=None, space_origin=None, spacings="2 2 2 2", kinds=" ".join(kinds)
    )
    assert np.array_equal(read(by_kind, frame=1)[0].values, VALUES + 100)


def test_a_space_with_time_has_frames() -> None:
    frames = np.stack([VALUES, VALUES + 100], axis=3)
    written = w.nrrd(
        frames,
        space="left-posterior-superior-time",
        space_directions="(1,0,0,0) (0,0.5,0,0) (0,0,3,0) (0,0,0,2)",
        space_origin="(-10,5,100,7)",
    )
    volume, _ = read(written, frame=1)
    assert np.array_equal(volume.values, VALUES + 100)
    assert centres(volume)[-1] == pytest.approx([-8, 6.5, 112])


BARE: dict[str, str | None] = {"space": None, "space_directions": None, "space_origin": None}


@pytest.mark.parametrize(
    ("fields", "spacing", "first"),
    [
        ({"spacings": "1 2 3"}, (1, 2, 3), (0, 0, 0)),
        ({"spacings": "1 2 3", "axis_mins": "10 20 30", "centers": "node node node"}, (1, 2, 3), (10, 20, 30)),
        ({"spacings": "1 2 3", "axis_mins": "10 20 30", "centers": "cell cell cell"}, (1, 2, 3), (10.5, 21, 31.5)),
        ({"spacings": "1 2 3", "axismins": "10 20 30"}, (1, 2, 3), (10.5, 21, 31.5)),
        ({"axis_mins": "0 0 0", "axis_maxs": "3 8 15", "centers": "cell cell cell"}, (1, 2, 3), (0.5, 1, 1.5)),
        ({"axis_mins": "0 0 0", "axis_maxs": "2 6 12", "centerings": "node node node"}, (1, 2, 3), (0, 0, 0)),
        ({"spacings": "1 2 3", "units": '"cm" "mm" "um"'}, (10, 2, 0.003), (0, 0, 0)),
        ({"spacings": "1 2 3", "units": '"mm" "" "mm"'}, (1, 2, 3), (0, 0, 0)),
    ],
)
def test_sizes_of_nrrd_without_a_space(fields: dict[str, str], spacing: Any, first: Any) -> None:
    volume, said = read(w.nrrd(VALUES, **BARE, **fields))
    assert volume.spacing == pytest.approx(spacing)
    assert centres(volume)[0] == pytest.approx(first)
    assert said == []


def test_axis_mins_agree_with_simpleitk(sitk: Any, tmp_path: Path) -> None:
    for center in ("cell", "node"):
        path = tmp_path / "a.nrrd"
        fields = {"spacings": "1 2 3", "axis_mins": "10 20 30", "centers": " ".join([center] * 3)}
        path.write_bytes(w.nrrd(VALUES, **BARE, **fields).data)
        assert centres(read_volume(path))[0] == pytest.approx(sitk.ReadImage(str(path)).GetOrigin())


@pytest.mark.parametrize(
    ("fields", "says"),
    [
        ({}, "any axis"),
        ({"spacings": "1 nan 3"}, "axis 1"),
        ({"spacings": "1 nan nan"}, "axis 1 and 2"),
    ],
)
def test_a_size_that_is_missing_is_told(fields: dict[str, str], says: str) -> None:
    volume, said = read(w.nrrd(VALUES, **BARE, **fields))
    assert len(said) == 1
    assert says in said[0]
    assert "1 mm is taken" in said[0]
    assert volume.spacing[1] == 1


def test_sizes_stated_twice_must_agree() -> None:
    assert read(w.nrrd(VALUES, spacings="1 0.5 3"))[0].spacing == (1, 0.5, 3)
    with pytest.raises(FormatError, match=r"two sizes of a cell along axis 2, 2 \(spacings\) and 3"):
        read(w.nrrd(VALUES, spacings="1 0.5 2"))


def test_units_of_a_space_scale_it(tmp_path: Path) -> None:
    volume, said = read(w.nrrd(VALUES, space_units='"cm" "cm" "cm"'))
    assert volume.spacing == pytest.approx((10, 5, 30))
    assert centres(volume)[0] == pytest.approx([-100, 50, 1000])
    assert said == []
    said = read(w.nrrd(VALUES, space_units='"foo" "foo" "foo"'))[1]
    assert said
    assert all("'foo', no known unit" in each for each in said)


@pytest.mark.parametrize(
    ("fields", "says"),
    [
        ({"space_directions": "(1,0,0) (0.3,1,0) (0,0,1)"}, "no usable place"),
        ({"space_directions": "(1,0,0) (0,0,0) (0,0,1)"}, "no usable place"),
        ({"space_directions": "(1,0,0) (0,1,0) (0,0,nan)"}, "no usable place"),
        ({"space_directions": "(1,0,0) (0,1,0)"}, "2 space directions for 3 axes"),
        ({"space_directions": "(1,0) (0,1) none", "space_origin": "(0,0)", "space": None}, "single slice"),
        ({"space_directions": "(1,0,0) (0,1,0) none"}, "single slice"),
        ({"sizes": "3 4"}, "2 sizes for a dimension of 3"),
        ({"sizes": "3 4 0"}, "with cells"),
        ({"type": "block"}, "cells of type 'block'"),
        ({"endian": None}, "order of its bytes"),
        ({"kinds": "complex domain domain"}, "complex"),
    ],
)
def test_a_header_of_nrrd_that_is_no_use(fields: dict[str, str | None], says: str) -> None:
    with pytest.raises(FormatError, match=says):
        read(w.nrrd(VALUES, **fields))


@pytest.mark.parametrize("encoding", ["zrl", "lzma", ""])
def test_an_encoding_that_is_not_read_is_named(encoding: str) -> None:
    data = w.nrrd(VALUES).data.replace(b"encoding: raw", f"encoding: {encoding}".encode())
    with pytest.raises(FormatError, match=f"encoded as '{encoding}'"):
        read(w.Written(name="a.nrrd", data=data))


# --- MetaImage -------------------------------------------------------------------------------------------


@pytest.mark.slow
@given(
    affines(),
    st.sampled_from(["TransformMatrix", "Rotation", "Orientation"]),
    st.sampled_from(["Offset", "Position", "Origin"]),
)
def test_meta_images_lie_where_simpleitk_says(affine: np.ndarray, matrix: str, origin: str) -> None:
    sitk = pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")
    size = np.linalg.norm(affine[:3, :3], axis=0)
    fields = {"TransformMatrix": None, "Offset": None}
    fields |= {matrix: " ".join(repr(float(x)) for x in (affine[:3, :3] / size).T.ravel())}
    fields |= {origin: " ".join(repr(float(x)) for x in affine[:3, 3])}
    fields |= {"ElementSpacing": " ".join(repr(float(x)) for x in size)}
    written = w.mha(VALUES, **fields)
    volume, said = read(written)
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "a.mha").write_bytes(written.data)
        image = sitk.ReadImage(str(Path(folder) / "a.mha"))
    told = [image.TransformIndexToPhysicalPoint(tuple(map(int, cell))) for cell in CELLS]
    assert np.abs(centres(volume) - told).max() < 1e-6
    assert volume.space == "LPS"
    assert said == []


@pytest.mark.slow
@given(affines())
def test_what_simpleitk_writes_is_read_in_its_place_without_a_word(affine: np.ndarray) -> None:
    """AnatomicalOrientation too, which it writes beside the matrix."""
    sitk = pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")
    size = np.linalg.norm(affine[:3, :3], axis=0)
    image = sitk.GetImageFromArray(np.ascontiguousarray(VALUES.T))
    image.SetSpacing(size.tolist())
    image.SetDirection((affine[:3, :3] / size).ravel().tolist())
    image.SetOrigin(affine[:3, 3].tolist())
    for suffix in ("mha", "mhd", "nrrd", "nii", "nii.gz"):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"a.{suffix}"
            sitk.WriteImage(image, str(path), True)
            with heard() as said:
                volume = read_volume(path)
        assert np.abs(centres(volume) - by_affine(affine)).max() < ROUNDED
        assert np.array_equal(volume.values, VALUES)
        assert said == []


@pytest.mark.parametrize(
    ("fields", "says"),
    [
        ({"ElementSpacing": None}, "does not say the size of its cells; 1 mm is taken"),
        ({"ElementSize": "1 0.5 4"}, "ElementSize, ElementSpacing"),
        ({"AnatomicalOrientation": "LPI"}, "AnatomicalOrientation = LPI"),
        ({"AnatomicalOrientation": "RAS"}, "AnatomicalOrientation = RAS"),
        ({"DistanceUnits": "furlong"}, "'furlong', no known unit"),
    ],
)
def test_what_a_meta_image_lacks_or_contradicts_is_told(fields: dict[str, str | None], says: str) -> None:
    said = read(w.mha(VALUES, **fields))[1]
    assert len(said) == 1
    assert says in said[0]


@pytest.mark.parametrize(
    "fields",
    [
        {"ElementSize": "1 0.5 3"},
        {"ElementSpacing": None, "ElementSize": "1 0.5 3"},
        {"AnatomicalOrientation": "RAI"},
        {"AnatomicalOrientation": "???"},
        {"DistanceUnits": "mm"},
        {"ElementSpacing": "0.1 0.05 0.3", "DistanceUnits": "cm", "Offset": "-1 .5 10"},
    ],
)
def test_what_agrees_is_not_told(fields: dict[str, str | None]) -> None:
    volume, said = read(w.mha(VALUES, **fields))
    assert volume.spacing == pytest.approx((1, 0.5, 3))
    assert centres(volume)[0] == pytest.approx([-10, 5, 100])
    assert said == []


@pytest.mark.parametrize(
    ("fields", "says"),
    [
        ({"TransformMatrix": "1 0.3 0 0 1 0 0 0 1"}, "no usable place"),
        ({"ElementSpacing": "1 0 3"}, "no usable place"),
        ({"Position": "1 2 3"}, "two places"),
        ({"Offset": "1 2"}, "2 numbers in offset"),
        ({"DimSize": "3 4"}, "2 numbers in dimsize"),
        ({"NDims": "2", "DimSize": "3 4"}, "single slice"),
        ({"ElementType": "MET_STRING"}, "cells of type 'string'"),
        ({"ObjectType": "Tube"}, "holds 'Tube'"),
        ({"CompressedData": "perhaps"}, "compresseddata is 'perhaps'"),
        ({"ElementNumberOfChannels": "0"}, "0 channels"),
        ({"ElementNumberOfChannels": "2", "DimSize": "3 2 5"}, "holds 2 numbers per cell"),
        ({"ElementToIntensityFunctionSlope": "2"}, "scales its values"),
        ({"HeaderSize": "-2"}, "HeaderSize of -2"),
    ],
)
def test_a_header_of_a_meta_image_that_is_no_use(fields: dict[str, str | None], says: str) -> None:
    with pytest.raises(FormatError, match=says):
        read(w.mha(VALUES, **fields))


@pytest.mark.parametrize("name", ["missing.raw", "../missing.raw", "/dev/zero", ".", "", "C:\\scans\\missing.raw"])
def test_cells_that_lie_nowhere_are_refused(name: str, tmp_path: Path) -> None:
    """A device is no file either."""
    (tmp_path / "a.mhd").write_bytes(w.meta_head(VALUES, name))
    (tmp_path / "a.nhdr").write_bytes(w.nrrd_head(VALUES, "raw", data_file=name or "?").encode())
    for suffix in ("mhd", "nhdr"):
        with pytest.raises(FormatError, match="which is not there; put that file beside it"):
            read_volume(tmp_path / f"a.{suffix}")


def test_cells_are_found_beside_a_header_of_another_computer(tmp_path: Path) -> None:
    (tmp_path / "a.raw").write_bytes(w.flat(VALUES))
    (tmp_path / "a.mhd").write_bytes(w.meta_head(VALUES, "C:\\scans\\a.raw"))
    assert np.array_equal(read_volume(tmp_path / "a.mhd").values, VALUES)


# --- VTK and FreeSurfer ----------------------------------------------------------------------------------


@pytest.mark.parametrize("way", ["vtk", "vtk text", "vti raw", "vti zlib", "vti text", "mgh", "mgz"])
def test_a_size_that_other_formats_lack_is_told(way: str) -> None:
    whole = w.WAYS[way](VALUES)
    assert read(whole)[1] == []
    if way.startswith("vt"):
        data = whole.data.replace(b"SPACING 1 0.5 3\n", b"").replace(b' Spacing="1 0.5 3"', b"")
    else:
        data = gzip.decompress(whole.data) if way == "mgz" else whole.data
        data = data[:28] + b"\0\0" + data[30:]
        data = gzip.compress(data) if way == "mgz" else data
    volume, said = read(w.Written(name=whole.name, data=data))
    assert volume.spacing == (1, 1, 1)
    assert len(said) == 1
    assert "does not say the size" in said[0]


@pytest.mark.parametrize(("offset", "size"), [(1e6, 1.0), (-2e6, 1.0), (3.0, 1e-7), (1e11, 1e3)])
def test_a_volume_whose_cells_single_precision_loses_is_told(offset: float, size: float, tmp_path: Path) -> None:
    told = read_volume(far_away(tmp_path, offset, size)).warnings
    assert any("files of 32-bit numbers, such as .stl, lose details" in warning for warning in told)
    assert np.float32(offset) == np.float32(offset + size / 33)  # indeed


def test_a_volume_near_enough_is_not_told(tmp_path: Path) -> None:
    assert read_volume(far_away(tmp_path, 9e5, 1.0)).warnings == ()


def test_a_volume_beyond_all_places_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="lies over 1,000,000,000,000,000 km away; the limit is 1,000,000 km"):
        read_volume(far_away(tmp_path, 1e308, 1.0))


def far_away(folder: Path, offset: float, size: float) -> Path:
    path = folder / "a.mha"
    head = f"ObjectType = Image\nNDims = 3\nDimSize = 4 4 4\nElementType = MET_UCHAR\nElementSpacing = {size} {size} {size}\n"
    path.write_bytes(f"{head}Offset = 0 {offset} 0\nElementDataFile = LOCAL\n".encode() + bytes(range(64)))
    return path
