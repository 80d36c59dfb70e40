"""Frames of DICOM: cells, order, places and values come from what the file says of each frame, or it is refused."""

from __future__ import annotations

import json
import logging
import sys
import tempfile
from collections.abc import Mapping, Sequence
from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst
from pydicom.dataset import FileMetaDataset
from pydicom.uid import RLELossless
from test_command_line import run

from infill import Volume, read_volume
from infill.errors import FormatError, InfillError, ParameterError
from infill.imaging.dicom import pixels
from infill.smoothing.sources import read_source
from tests.handmade_dicom import (
    AXIAL,
    CAPTURE,
    CT,
    DOSE,
    ENHANCED_CT,
    ENHANCED_PET,
    NUCLEAR,
    SYNTAXES,
    base,
    enhanced,
    item,
    measures,
    save,
    save_all,
    slices,
)

sitk = pytest.importorskip("SimpleITK", reason="SimpleITK is not installed (extra medical)")

COUNT, STEP, START = 12, 3.0, np.array([-10.0, 5.0, 100.0])
# Text of 16 characters holds numbers of hundreds to 12 digits after the point; a centre adds some of them.
ROUNDING = 1e-9


def body(count: int = COUNT) -> np.ndarray:
    """Return frames [frame, row, column] with a block that no mirroring and no swap of axes leaves as it is."""
    stored = np.zeros((count, 10, 16), dtype=np.uint16)
    stored[2:7, 3:6, 4:14] = 1000
    stored[2:3, 3:4, 4:5] = 2000  # its corner
    return stored


def turned(quaternion: Sequence[float]) -> np.ndarray:
    """Return the rotation of a quaternion."""
    w, x, y, z = np.array(quaternion) / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def places(count: int = COUNT, turn: np.ndarray | None = None, step: float = STEP) -> np.ndarray:
    normal = np.eye(3)[2] if turn is None else turn[:, 2]
    return START + np.outer(np.arange(count) * step, normal)


def axes_of(turn: np.ndarray) -> tuple[float, ...]:
    return tuple(turn[:, :2].T.ravel().tolist())


def centres(volume: Volume, value: float) -> np.ndarray:
    """Return the centres in space of the cells [x, y, z] with a value, mm, in the order of their indices."""
    return volume.place((np.argwhere(np.asarray(volume.values) == value) + 0.5) * volume.cell_size)


def true_centres(
    stored: np.ndarray, at: np.ndarray, axes: Sequence[float], pixel: Sequence[float], value: float
) -> np.ndarray:
    """Return the same by the equation of the standard, C.7.6.2.1.1: pixel spacing is that of rows, then of columns."""
    column, row, frame = np.argwhere(value == stored.T).T
    along, down = np.array(axes[:3]), np.array(axes[3:])
    return at[frame] + np.outer(column * pixel[1], along) + np.outer(row * pixel[0], down)


def agrees(volume: Volume, stored: np.ndarray, at: np.ndarray, axes: Sequence[float], off: float) -> None:
    for value in (1000, 2000):
        true = true_centres(stored, at, axes, (0.5, 1.0), value)
        assert np.abs(centres(volume, value) - true).max() <= off
    assert volume.space == "LPS"
    assert not volume.mirrored


def refusal(path: Path, **options: Any) -> str:
    """Return why a file is refused: one line, and one that a terminal shows as it is."""
    with pytest.raises(InfillError) as caught:
        read_volume(path, **options)
    text = str(caught.value)
    assert str(path) in text
    assert text.isprintable()
    return text


# --- one volume ------------------------------------------------------------------------------------------------


@pytest.mark.slow
@given(
    order=st.permutations(range(COUNT)),
    noise=npst.arrays(np.float64, (COUNT, 3), elements=st.floats(-0.02, 0.02)),
    quaternion=st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: np.linalg.norm(q) > 0.1),
    shared=st.booleans(),
    between=st.sampled_from([None, 3.0, 1.0]),
)
@example(order=[*range(COUNT)], noise=np.zeros((COUNT, 3)), quaternion=(1, 0, 0, 0), shared=True, between=3.0)
def test_frames_lie_where_they_say(
    order: list[int], noise: np.ndarray, quaternion: tuple[float, ...], shared: bool, between: float | None
) -> None:
    """Whatever their order in the file, their rounding, their orientation, and the step that is stated beside."""
    turn = turned(quaternion)
    at, stored, axes = places(turn=turn) + noise, body(), axes_of(turn)
    made = enhanced(ENHANCED_CT, stored[order], at[order], axes=axes, between=between, shared=shared)
    with tempfile.TemporaryDirectory() as folder:
        volume = read_volume(save(made, Path(folder) / "a.dcm"))
    # The line of least squares through noise lies within twice the noise of each direction, of which there are three.
    most = float(np.abs(noise).max())
    agrees(volume, stored, at, axes, 6 * most + ROUNDING)
    assert volume.spacing == pytest.approx((1.0, 0.5, STEP), abs=most + ROUNDING)
    if between == STEP and not noise.any():
        assert volume.spacing == (1.0, 0.5, STEP)


@pytest.mark.slow
@settings(max_examples=5)
@given(
    order=st.permutations(range(COUNT)),
    quaternion=st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: np.linalg.norm(q) > 0.1),
)
def test_a_file_and_a_folder_of_its_slices_are_one_volume(order: list[int], quaternion: tuple[float, ...]) -> None:
    turn = turned(quaternion)
    at, stored, axes = places(turn=turn), body(), axes_of(turn)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        one = read_volume(save(enhanced(ENHANCED_CT, stored, at, axes=axes), folder / "a.dcm"))
        each = read_volume(save_all(slices(stored, at, axes=axes), folder / "slices", order))
    assert np.array_equal(one.values, each.values)
    assert one.spacing == pytest.approx(each.spacing, abs=ROUNDING)
    assert one.origin == pytest.approx(each.origin, abs=ROUNDING)
    assert np.allclose(one.direction, each.direction, atol=ROUNDING)


@pytest.mark.slow
@pytest.mark.parametrize("syntax", SYNTAXES)
@pytest.mark.parametrize("shared", [True, False])
def test_every_way_to_write_elements(syntax: str, shared: bool, tmp_path: Path) -> None:
    made = enhanced(ENHANCED_CT, body(), places(), shared=shared)
    volume = read_volume(save(made, tmp_path / "a.dcm", syntax))
    agrees(volume, body(), places(), AXIAL, ROUNDING)


def test_an_independent_reader_agrees(tmp_path: Path) -> None:
    """ITK reads even frames rightly, unless they stand in the order of falling places."""
    path = save(enhanced(ENHANCED_CT, body(), places()), tmp_path / "a.dcm")
    image, volume = sitk.ReadImage(str(path)), read_volume(path)
    assert np.array_equal(sitk.GetArrayFromImage(image).T, volume.values)
    assert volume.spacing == pytest.approx(image.GetSpacing(), abs=ROUNDING)
    first = volume.place(0.5 * volume.cell_size[None])[0]
    assert first == pytest.approx(image.GetOrigin(), abs=ROUNDING)


# --- frames that make no volume --------------------------------------------------------------------------------


def shifted(number: int, by: Sequence[float]) -> np.ndarray:
    at = places()
    at[number] += by
    return at


KEPT = [k for k in range(COUNT) if k != 5]
SHEARED = places() + np.outer(np.arange(COUNT) * 0.6, [0, 1, 0])
UNEVEN: Mapping[str, tuple[np.ndarray, str]] = {
    "one is missing": (places()[KEPT], r"away from even steps .*3 mm, and 6 mm after the one at 112 mm\); |; resample"),
    "a gap": (np.concatenate([places(6), places(6) + np.array([0, 0, 40])]), "the step is 3 mm, and 25 mm after"),
    "one is off": (shifted(4, (0, 0, 0.5)), "resample the series"),
    "one is shifted sideways": (shifted(4, (0.5, 0, 0)), "shifted sideways"),
    "a tilted scanner": (SHEARED, "tilted scanner.*shifted sideways"),
    "one twice": (np.concatenate([places(), places()[3:4]]), "13 of them lie at 12 places"),
    "all at one place": (np.repeat(places()[:1], COUNT, axis=0), "all lie at one place"),
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", UNEVEN)
def test_uneven_frames_are_refused_in_a_file_and_in_a_folder(kind: str, tmp_path: Path) -> None:
    at, says = UNEVEN[kind]
    stored = body(len(at))
    path = save(enhanced(ENHANCED_CT, stored, at), tmp_path / "a.dcm")
    folder = save_all(slices(stored, at), tmp_path / "slices")
    for each in (path, folder):
        text = refusal(each)
        assert "away from even steps" in text
        with pytest.raises(FormatError, match=says):
            read_volume(each)


@pytest.mark.slow
@given(at=st.integers(1, COUNT - 2), by=st.floats(0.3, 1.2), axis=st.integers(0, 2))
def test_no_frame_off_by_a_tenth_of_a_step_goes_unseen(at: int, by: float, axis: int) -> None:
    moved = shifted(at, by * np.eye(3)[axis])
    with tempfile.TemporaryDirectory() as folder:
        refusal(save(enhanced(ENHANCED_CT, body(), moved), Path(folder) / "a.dcm"))


def test_frames_of_a_fan_are_refused(tmp_path: Path) -> None:
    """Radial frames turn about an axis: each has an orientation of its own."""
    groups = []
    for k in range(COUNT):
        angle = np.pi * k / COUNT
        axes = [np.cos(angle), np.sin(angle), 0, 0, 0, -1]
        groups.append({"PlaneOrientationSequence": [item(ImageOrientationPatient=[f"{x:.9f}" for x in axes])]})
    path = save(enhanced(ENHANCED_CT, body(), places(), groups=groups), tmp_path / "a.dcm")
    assert "12 orientations" in refusal(path)


def test_pixels_of_two_sizes_are_refused(tmp_path: Path) -> None:
    groups = [{"PixelMeasuresSequence": [measures((0.5, 1.0 + 0.1 * (k == 3)))]} for k in range(COUNT)]
    path = save(enhanced(ENHANCED_CT, body(), places(), groups=groups), tmp_path / "a.dcm")
    assert "sizes" in refusal(path)


def test_a_single_frame_is_no_volume(tmp_path: Path) -> None:
    path = save(enhanced(ENHANCED_CT, body(4)[:1], places(1)), tmp_path / "a.dcm")
    assert "single slice, 16 x 10 x 1 cells" in refusal(path)


@pytest.mark.parametrize("lacking", ["some places", "some frames", "axes", "pixels", "groups", "zero axes"])
def test_what_is_not_described_is_refused(lacking: str, tmp_path: Path) -> None:
    made = enhanced(ENHANCED_CT, body(), places())
    each, shared = made.PerFrameFunctionalGroupsSequence, made.SharedFunctionalGroupsSequence[0]
    if lacking == "some places":
        del each[3].PlanePositionSequence
    elif lacking == "some frames":
        made.PerFrameFunctionalGroupsSequence = [*each][:-1]
    elif lacking == "axes":
        del shared.PlaneOrientationSequence
    elif lacking == "zero axes":
        shared.PlaneOrientationSequence[0].ImageOrientationPatient = ["0"] * 6
    elif lacking == "pixels":
        del shared.PixelMeasuresSequence
    else:
        del made.PerFrameFunctionalGroupsSequence, made.SharedFunctionalGroupsSequence
    refusal(save(made, tmp_path / "a.dcm"))


@pytest.mark.parametrize("end", [1, 20, 1000, 3000])
def test_a_file_that_is_cut_off_is_refused(end: int, tmp_path: Path) -> None:
    path = save(enhanced(ENHANCED_CT, body(), places()), tmp_path / "a.dcm")
    path.write_bytes(path.read_bytes()[:-end])
    refusal(path)


# --- several volumes in one ------------------------------------------------------------------------------------


CONTENT = {
    "TemporalPositionIndex": lambda k: {"TemporalPositionIndex": k + 1},
    "StackID": lambda k: {"StackID": str(k + 1), "InStackPositionNumber": 1},
}
GROUPS = {
    "EffectiveEchoTime": lambda k: {"MREchoSequence": [item(EffectiveEchoTime=5.0 * (k + 1))]},
    "DiffusionBValue": lambda k: {"MRDiffusionSequence": [item(DiffusionBValue=500.0 * k)]},
    "NominalPercentageOfCardiacPhase": lambda k: {
        "CardiacSynchronizationSequence": [item(NominalPercentageOfCardiacPhase=10.0 * k)]
    },
    "ComplexImageComponent": lambda k: {"MRImageFrameTypeSequence": [item(ComplexImageComponent="MP"[k])]},
}


def phases(mark: str, order: Sequence[int]) -> Any:
    """Return two volumes at the same places, the second half as bright, their frames in an order."""
    stored = np.concatenate([body(), body() // 2])[list(order)]
    at = np.concatenate([places(), places()])[list(order)]
    of = [int(k) // COUNT for k in order]
    return enhanced(
        ENHANCED_CT,
        stored,
        at,
        content=[CONTENT[mark](k) for k in of] if mark in CONTENT else None,
        groups=[GROUPS[mark](k) for k in of] if mark in GROUPS else None,
    )


@pytest.mark.slow
@pytest.mark.parametrize("mark", [*CONTENT, *GROUPS])
def test_phases_want_a_choice(mark: str, tmp_path: Path, rng: np.random.Generator) -> None:
    path = save(phases(mark, rng.permutation(2 * COUNT)), tmp_path / "a.dcm")
    text = refusal(path)
    assert f"holds 2 volumes of 12 slices, told apart by {mark}" in text
    assert text.endswith("choose one of its 2 frames: --frame 0 to --frame 1")
    found = sorted(int(np.max(read_volume(path, frame=k).values)) for k in (0, 1))
    assert found == [1000, 2000]
    if mark != "ComplexImageComponent":  # which sorts by its letters, magnitude before phase
        assert [int(np.max(read_volume(path, frame=k).values)) for k in (0, 1)] == [2000, 1000]
    with pytest.raises(ParameterError, match="2 frames, 0 to 1"):
        read_volume(path, frame=2)


@pytest.mark.parametrize("mark", ["TemporalPositionIndex", "StackID", "EffectiveEchoTime"])
def test_volumes_one_behind_the_other_are_not_one(mark: str, tmp_path: Path) -> None:
    """Their frames lie evenly together, and yet are of two volumes."""
    at, half = places(), COUNT // 2
    of = [int(k >= half) for k in range(COUNT)]
    content = [CONTENT[mark](k) for k in of] if mark in CONTENT else None
    groups = [GROUPS[mark](k) for k in of] if mark in GROUPS else None
    path = save(enhanced(ENHANCED_CT, body(), at, content=content, groups=groups), tmp_path / "a.dcm")
    assert f"told apart by {mark}" in refusal(path)
    assert read_volume(path, frame=0).values.shape == (16, 10, half)


def test_a_mark_of_each_frame_makes_no_volumes(tmp_path: Path) -> None:
    content = [{"TemporalPositionIndex": k + 1} for k in range(COUNT)]
    path = save(enhanced(ENHANCED_CT, body(), places(), content=content), tmp_path / "a.dcm")
    agrees(read_volume(path), body(), places(), AXIAL, ROUNDING)


@pytest.mark.slow
def test_two_marks_together_tell_volumes_apart(tmp_path: Path, rng: np.random.Generator) -> None:
    """Neither the echo nor the moment does alone."""
    order = rng.permutation(4 * COUNT)
    stored = np.concatenate([body() + 10 * k for k in range(4)]).astype(np.uint16)[order]
    at, of = np.concatenate([places()] * 4)[order], order // COUNT
    made = enhanced(
        ENHANCED_CT,
        stored,
        at,
        content=[CONTENT["TemporalPositionIndex"](int(k) // 2) for k in of],
        groups=[GROUPS["EffectiveEchoTime"](int(k) % 2) for k in of],
    )
    path = save(made, tmp_path / "a.dcm")
    assert "4 volumes of 12 slices, told apart by TemporalPositionIndex and EffectiveEchoTime" in refusal(path)
    for k in range(4):
        assert np.min(read_volume(path, frame=k).values) == 10 * k


def test_dimensions_that_only_the_file_names(tmp_path: Path) -> None:
    from pydicom.datadict import tag_for_keyword

    pointers = ("InStackPositionNumber", "ContrastBolusAgentNumber")
    dimension = [item(DimensionIndexPointer=tag_for_keyword(name)) for name in pointers]
    at = np.repeat(places(), 2, axis=0)
    content = [{"DimensionIndexValues": [k // 2 + 1, k % 2 + 1]} for k in range(2 * COUNT)]
    stored = np.repeat(body(), 2, axis=0)
    stored[1::2] //= 2
    made = enhanced(ENHANCED_CT, stored, at, content=content, DimensionIndexSequence=dimension)
    path = save(made, tmp_path / "a.dcm")
    assert "told apart by ContrastBolusAgentNumber" in refusal(path)
    assert np.max(read_volume(path, frame=1).values) == 1000


@pytest.mark.parametrize("interleaved", [True, False])
def test_phases_that_nothing_tells_apart(interleaved: bool, tmp_path: Path) -> None:
    """Their order in the file is all there is; where it repeats itself, a frame may be chosen, and a line says so."""
    order = [k // 2 + k % 2 * COUNT for k in range(2 * COUNT)] if interleaved else range(2 * COUNT)
    path = save(phases("", order), tmp_path / "a.dcm")
    assert "told apart by their order in the file alone" in refusal(path)
    for k, most in enumerate((2000, 1000)):
        volume = read_volume(path, frame=k)
        assert np.max(volume.values) == most
        assert "their order in the file alone" in volume.warnings[0]
    mixed = [*range(COUNT), *reversed(range(COUNT, 2 * COUNT))]
    assert "nothing tells them apart" in refusal(save(phases("", mixed), tmp_path / "b.dcm"))


def test_stacks_of_two_orientations_want_a_choice(tmp_path: Path) -> None:
    sagittal = np.array([[0.0, 0, 1], [1, 0, 0], [0, -1, 0]]).T  # rows along y, columns down z
    axes = [np.eye(3)] * COUNT + [sagittal] * COUNT
    at = np.concatenate([places(), START + np.outer(np.arange(COUNT) * STEP, np.cross(sagittal[:, 0], sagittal[:, 1]))])
    groups = [
        {"PlaneOrientationSequence": [item(ImageOrientationPatient=[f"{x:g}" for x in axes_of(a)])]} for a in axes
    ]
    path = save(enhanced(ENHANCED_CT, np.concatenate([body(), body()]), at, groups=groups), tmp_path / "a.dcm")
    assert "2 volumes of 12 slices, told apart by their orientation" in refusal(path)
    agrees(read_volume(path, frame=1), body(), at[COUNT:], axes_of(sagittal), ROUNDING)


# --- folders ---------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_folder_of_slices_has_phases_too(tmp_path: Path, rng: np.random.Generator) -> None:
    stored, at = np.concatenate([body(), body() // 2]), np.concatenate([places(), places()])
    each = [{"TriggerTime": "0" if k < COUNT else "350"} for k in range(2 * COUNT)]
    folder = save_all(slices(stored, at, each=each), tmp_path / "a", rng.permutation(2 * COUNT).tolist())
    assert "2 volumes of 12 slices, told apart by TriggerTime" in refusal(folder)
    assert [int(np.max(read_volume(folder, frame=k).values)) for k in (0, 1)] == [2000, 1000]
    untold = save_all(slices(stored, at), tmp_path / "b")
    assert "doubled" in refusal(untold)


def test_files_of_several_frames_in_one_folder(tmp_path: Path) -> None:
    """Two halves are one volume; two files at the same places are two."""
    half, folder = COUNT // 2, tmp_path / "halves"
    parts = [(body()[half:], places()[half:]), (body()[:half], places()[:half])]
    save_all([enhanced(ENHANCED_CT, stored, at, instance=k) for k, (stored, at) in enumerate(parts)], folder)
    agrees(read_volume(folder), body(), places(), AXIAL, ROUNDING)
    whole = [enhanced(ENHANCED_CT, body() // (k + 1), places(), instance=k) for k in (0, 1)]
    both = save_all(whole, tmp_path / "both")
    assert "told apart by the files that they come from" in refusal(both)
    assert [int(np.max(read_volume(both, frame=k).values)) for k in (0, 1)] == [2000, 1000]


def test_each_slice_of_a_folder_has_its_scale(tmp_path: Path) -> None:
    """As slices of PET do; the first may be whole and others not."""
    scales = [1.0, *np.linspace(0.5, 7.25, COUNT - 1)]
    each = [{"RescaleSlope": f"{slope:.6f}", "RescaleIntercept": "0"} for slope in scales]
    stored = np.full((COUNT, 10, 16), 10, dtype=np.int16)
    volume = read_volume(save_all(slices(stored, places(), each=each), tmp_path / "a"))
    assert np.asarray(volume.values)[0, 0] == pytest.approx(10 * np.array(scales), rel=1e-6)  # of six digits


def test_a_picture_beside_slices_is_another_series(tmp_path: Path) -> None:
    folder = save_all(slices(body(), places()), tmp_path / "a")
    picture = base(CAPTURE, np.zeros((1, 4, 12), np.uint8), series="2.25.8")
    picture.SamplesPerPixel, picture.Columns, picture.PhotometricInterpretation = 3, 4, "RGB"
    picture.PlanarConfiguration = 0
    save(picture, folder / "picture.dcm")
    assert "2 DICOM series, 2.25.7 (12 slices), 2.25.8 (1 slices)" in refusal(folder)
    agrees(read_volume(folder, series="2.25.7"), body(), places(), AXIAL, ROUNDING)
    with pytest.raises(FormatError, match=r"colours \(RGB\)"):
        read_volume(folder, series="2.25.8")


def test_a_scout_in_the_same_series_is_named(tmp_path: Path) -> None:
    scout = slices(body()[:1], places(1), axes=(1, 0, 0, 0, 0, -1))
    folder = save_all([*slices(body(), places()), *scout], tmp_path / "a")
    assert "2 orientations, sizes or coordinate systems (12, 1)" in refusal(folder)


@pytest.mark.slow
def test_files_of_one_enhanced_frame_each(tmp_path: Path, rng: np.random.Generator) -> None:
    """What is shared by the only frame of a file tells it from those of other files."""
    files = []
    for k in range(2 * COUNT):
        phase, at = divmod(k, COUNT)
        made = enhanced(ENHANCED_CT, body()[at : at + 1] // (phase + 1), places()[at : at + 1], instance=k + 1)
        for name, value in GROUPS["EffectiveEchoTime"](phase).items():
            setattr(made.SharedFunctionalGroupsSequence[0], name, value)
        files.append(made)
    folder = save_all(files, tmp_path / "a", rng.permutation(2 * COUNT).tolist())
    assert "told apart by EffectiveEchoTime" in refusal(folder)
    agrees(read_volume(folder, frame=0), body(), places(), AXIAL, ROUNDING)


def test_a_volume_of_ultrasound_lies_in_its_own_space(tmp_path: Path) -> None:
    made = enhanced(ENHANCED_CT, body(), places())
    for frame in made.PerFrameFunctionalGroupsSequence:
        place = frame.PlanePositionSequence[0].ImagePositionPatient
        del frame.PlanePositionSequence
        frame.PlanePositionVolumeSequence = [item(ImagePositionVolume=[float(x) for x in place])]
    shared = made.SharedFunctionalGroupsSequence[0]
    del shared.PlaneOrientationSequence
    shared.PlaneOrientationVolumeSequence = [item(ImageOrientationVolume=list(AXIAL))]
    volume = read_volume(save(made, tmp_path / "a.dcm"))
    assert volume.space == ""
    assert centres(volume, 2000) == pytest.approx(true_centres(body(), places(), AXIAL, (0.5, 1.0), 2000), abs=ROUNDING)


# --- files that say less ---------------------------------------------------------------------------------------


def test_frames_whose_distance_alone_is_stated(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    made = base(CAPTURE, body())
    made.PixelSpacing, made.SpacingBetweenSlices = ["0.5", "1"], "3"
    with caplog.at_level(logging.WARNING, logger="infill"):
        volume = read_volume(save(made, tmp_path / "a.dcm"))
    assert volume.spacing == (1.0, 0.5, 3.0)
    assert volume.space == ""  # so that no program believes its place
    assert np.array_equal(volume.values, body().T)
    assert volume.warnings == tuple(caplog.messages)
    assert "slices 3 mm apart in their order, so the part may be mirrored" in volume.warnings[0]


def test_no_distance_is_taken_from_a_thickness(tmp_path: Path) -> None:
    made = base(CT, body())
    made.PixelSpacing, made.SliceThickness = ["0.5", "1"], "3"
    path = save(made, tmp_path / "a.dcm")
    text = refusal(path)
    assert "only how thick they are (3 mm)" in text
    assert text.endswith("give the size of a cell: --spacing X,Y,Z")
    # The remedy is one, and is told of.
    volume = read_source(path, spacing=(1.0, 0.5, 3.0))
    assert isinstance(volume, Volume)
    assert volume.spacing == (1.0, 0.5, 3.0)
    assert volume.warnings


@pytest.mark.parametrize("kind", ["moments", "time", "turns", "phases"])
def test_frames_that_are_no_slices(kind: str, tmp_path: Path) -> None:
    """However far apart slices are said to be."""
    made = base(NUCLEAR if kind == "turns" else CAPTURE, body())
    made.PixelSpacing, made.SpacingBetweenSlices = ["0.5", "1"], "3"
    if kind == "moments":
        made.FrameIncrementPointer, made.FrameTime = 0x00181063, "33"
    elif kind == "time":
        made.NumberOfTemporalPositions = 12
    elif kind == "turns":
        made.RotationVector = [1] * COUNT
        made.AngularViewVector = [*range(1, COUNT + 1)]
    else:
        made = enhanced(CT, body(), places(), content=[{"TemporalPositionIndex": k % 2 + 1} for k in range(COUNT)])
        for each in made.PerFrameFunctionalGroupsSequence:
            del each.PlanePositionSequence
    refusal(save(made, tmp_path / "a.dcm"))


@pytest.mark.parametrize("between", [3.0, -3.0])
def test_slices_of_nuclear_medicine(between: float, tmp_path: Path) -> None:
    """A negative distance stacks them in front of the first; time slots are volumes of their own."""
    stored = np.concatenate([body(), body() // 2])
    made = base(NUCLEAR, stored)
    made.PixelSpacing, made.SpacingBetweenSlices = ["0.5", "1"], f"{between:g}"
    made.SliceVector = [*range(1, COUNT + 1)] * 2
    made.TimeSlotVector = [1] * COUNT + [2] * COUNT
    made.DetectorInformationSequence = [
        item(ImagePositionPatient=[f"{x:g}" for x in START], ImageOrientationPatient=[f"{x:g}" for x in AXIAL])
    ]
    path = save(made, tmp_path / "a.dcm")
    assert "told apart by TimeSlotVector" in refusal(path)
    along = slice(None, None, -1 if between < 0 else 1)
    agrees(read_volume(path, frame=0), body()[along], places(step=between)[along], AXIAL, ROUNDING)


@pytest.mark.parametrize("first", [0.0, 100.0])
def test_a_dose_has_its_places_and_its_unit(first: float, tmp_path: Path) -> None:
    """Offsets count from the first frame or, if they do not begin with 0, from the origin; and are uneven, or are not."""
    offsets = first + STEP * np.arange(COUNT)
    made = base(DOSE, body().astype(np.uint32))
    made.ImagePositionPatient, made.ImageOrientationPatient = [f"{x:g}" for x in START], [f"{x:g}" for x in AXIAL]
    made.PixelSpacing, made.DoseGridScaling = ["0.5", "1"], "0.001"
    made.FrameIncrementPointer, made.GridFrameOffsetVector = 0x3004000C, [f"{x:g}" for x in offsets]
    volume = read_volume(save(made, tmp_path / "a.dcm"))
    assert np.max(volume.values) == pytest.approx(2.0, rel=1e-6)
    at = volume.place((np.array([[4, 3, 2]]) + 0.5) * volume.cell_size)[0]
    assert at == pytest.approx(START + np.array([4, 1.5, 6]), abs=ROUNDING)
    made.GridFrameOffsetVector = [f"{x:g}" for x in np.delete(first + STEP * np.arange(COUNT + 1), 5)]
    assert "6 mm after" in refusal(save(made, tmp_path / "b.dcm"))


# --- values ----------------------------------------------------------------------------------------------------


def test_every_frame_has_its_scale(tmp_path: Path) -> None:
    scales = [(0.5 + 0.25 * k, -7.0 * k) for k in range(COUNT)]
    made = enhanced(ENHANCED_PET, body(), places(), scales=scales)
    found = np.asarray(read_volume(save(made, tmp_path / "a.dcm")).values).T
    true = body() * np.array([s for s, _ in scales])[:, None, None] + np.array([i for _, i in scales])[:, None, None]
    assert np.array_equal(found, true.astype(np.float32))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("stored", "scale", "kind"),
    [
        (np.uint16, (1, 0), np.uint16),
        (np.int16, (1, 0), np.int16),
        (np.uint8, (1, 0), np.uint8),
        (np.uint16, (1, -1024), np.int32),
        (np.int16, (2, 0), np.int32),
        (np.uint16, (0.5, 0), np.float32),
        (np.uint32, (0.5, 0), np.float64),
    ],
)
def test_numbers_stay_whole_if_they_can(stored: Any, scale: tuple[float, float], kind: Any, tmp_path: Path) -> None:
    most = np.iinfo(stored)
    numbers = np.linspace(float(most.min), float(most.max), COUNT * 160).reshape(COUNT, 10, 16).astype(stored)
    made = enhanced(ENHANCED_CT, numbers, places(), scales=[scale] * COUNT)
    for syntax in SYNTAXES:
        found = read_volume(save(deepcopy(made), tmp_path / f"{syntax}.dcm", syntax)).values
        assert found.dtype == kind
        assert np.array_equal(np.asarray(found, float).T, numbers.astype(float) * scale[0] + scale[1])


def test_bits_that_are_not_used_count_for_nothing(tmp_path: Path) -> None:
    """Twelve bits with a sign, and an overlay in the others."""
    values = np.linspace(-2048, 2047, COUNT * 160).astype(np.int16).reshape(COUNT, 10, 16)
    stored = ((values & 0x0FFF) | 0x7000).astype(np.int16)
    made = enhanced(ENHANCED_CT, stored, places(), bits=12)
    assert np.array_equal(np.asarray(read_volume(save(made, tmp_path / "a.dcm")).values).T, values)


def test_values_do_not_depend_on_how_they_are_shown(tmp_path: Path) -> None:
    made = enhanced(ENHANCED_CT, body(), places())
    made.PhotometricInterpretation = "MONOCHROME1"
    assert np.array_equal(np.asarray(read_volume(save(made, tmp_path / "a.dcm")).values).T, body())


@pytest.mark.parametrize(("padding", "becomes"), [(65535, 0), (0, 0)])
def test_padding_is_no_solid(padding: int, becomes: int, tmp_path: Path) -> None:
    stored = body()
    stored[:, :2] = padding
    made = enhanced(ENHANCED_CT, stored, places(), PixelPaddingValue=padding)
    volume = read_volume(save(made, tmp_path / "a.dcm", "implicit"))
    assert set(np.asarray(volume.values)[:, :2].ravel().tolist()) == {becomes}
    assert len(volume.warnings) == (padding > 0)


def test_a_table_of_values_is_used(tmp_path: Path) -> None:
    table = (np.arange(3000) ** 1.1).astype(np.uint16)
    sequence = [item(LUTDescriptor=[3000, 0, 16], LUTData=table.tobytes(), ModalityLUTType="US")]
    sequence[0]["LUTData"].VR = "OW"
    made = enhanced(ENHANCED_CT, body(), places(), ModalityLUTSequence=sequence)
    assert np.array_equal(np.asarray(read_volume(save(made, tmp_path / "a.dcm")).values).T, table[body()])


@pytest.mark.slow
@pytest.mark.parametrize("packing", ["RLE", "JPEG2000", "JPEG"])
def test_packed_frames_are_the_same(packing: str, tmp_path: Path) -> None:
    """Packed by what is at hand: RLE by pydicom; for the others, single slices that ITK writes."""
    scales = [(0.5 + k, -k) for k in range(COUNT)]
    made = enhanced(ENHANCED_PET, body(), places(), scales=scales)
    plain = read_volume(save(made, tmp_path / "plain.dcm"))
    if packing == "RLE":
        made.compress(RLELossless)
    else:
        made.PixelData, syntax = packed(body(), packing, tmp_path)
        made["PixelData"].VR = "OB"
        made["PixelData"].is_undefined_length = True
        made.file_meta.TransferSyntaxUID = syntax
    made.save_as(tmp_path / "packed.dcm", enforce_file_format=True)
    found = read_volume(tmp_path / "packed.dcm")
    assert np.array_equal(found.values, plain.values)
    assert found.values.dtype == plain.values.dtype
    assert found.spacing == plain.spacing
    assert found.origin == plain.origin
    assert found.warnings == ()


@pytest.mark.slow
def test_packed_slices_of_a_folder_are_unpacked_together(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Not one by one, each in a process: two ways of packing are two."""
    called = []
    unpack = pixels.unpacked_frames
    monkeypatch.setattr(pixels, "unpacked_frames", lambda *words: called.append(words) or unpack(*words))
    each = [{"RescaleSlope": str(k + 1), "RescaleIntercept": "0"} for k in range(COUNT)]
    files = slices(body(), places(), each=each)
    plain = read_volume(save_all(deepcopy(files), tmp_path / "plain"))
    (tmp_path / "packed").mkdir()
    for k, made in enumerate(files):
        made.PixelData, syntax = packed(body()[k : k + 1], "JPEG2000" if k % 2 else "JPEG", tmp_path)
        made["PixelData"].VR = "OB"
        made["PixelData"].is_undefined_length = True
        made.file_meta = FileMetaDataset()
        made.file_meta.TransferSyntaxUID = syntax
        made.save_as(tmp_path / "packed" / f"{k * 7 % COUNT}.dcm", enforce_file_format=True)
    found = read_volume(tmp_path / "packed")
    assert np.array_equal(found.values, plain.values)
    assert len(called) == 2


def packed(stored: np.ndarray, packing: str, folder: Path, broken: float = 1.0) -> tuple[bytes, str]:
    """Return packed frames, the third of them cut off at a part of its length."""
    from pydicom import dcmread
    from pydicom.encaps import encapsulate, generate_frames

    frames = []
    for k, page in enumerate(stored):
        writer = sitk.ImageFileWriter()
        writer.UseCompressionOn()
        writer.SetCompressor(packing)
        writer.SetFileName(str(folder / f"page{k}.dcm"))
        try:
            writer.Execute(sitk.GetImageFromArray(page[None]))
        except RuntimeError as error:
            pytest.skip(f"ITK here does not write {packing} ({error})")
        read = dcmread(folder / f"page{k}.dcm")
        if not read.file_meta.TransferSyntaxUID.is_encapsulated:
            pytest.skip(f"ITK here does not write {packing}")
        frames.append(next(generate_frames(read.PixelData, number_of_frames=1)))
    if broken < 1:
        frames[2] = frames[2][: int(broken * len(frames[2]))]
    return encapsulate(frames), read.file_meta.TransferSyntaxUID


@pytest.mark.long
@pytest.mark.parametrize("packing", ["JPEG2000", "JPEG"])
@pytest.mark.parametrize("part", [0.2, 0.5, 0.8])
def test_a_broken_frame_is_told(packing: str, part: float, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """In an error or in a warning, a line each; nothing appears on the terminal by itself."""
    rough = np.random.default_rng(0).integers(0, 999, body().shape).astype(np.uint16)
    made = enhanced(ENHANCED_CT, rough, places())
    made.PixelData, syntax = packed(rough, packing, tmp_path, broken=part)
    made["PixelData"].VR = "OB"
    made["PixelData"].is_undefined_length = True
    made.file_meta = FileMetaDataset()
    made.file_meta.TransferSyntaxUID = syntax
    made.save_as(tmp_path / "a.dcm", enforce_file_format=True)
    capfd.readouterr()
    try:
        told = list(read_volume(tmp_path / "a.dcm").warnings)
    except FormatError as error:
        told = [str(error)]
    assert told
    assert all(line.isprintable() and str(tmp_path / "a.dcm") in line for line in told)
    assert capfd.readouterr() == ("", "")


# --- the command -----------------------------------------------------------------------------------------------


@pytest.mark.longest
def test_warnings_reach_the_report(tmp_path: Path) -> None:
    made = base(CAPTURE, body())
    made.PixelSpacing, made.SpacingBetweenSlices = ["0.5", "1"], "3"
    path = save(made, tmp_path / "a.dcm")
    done = run("smooth", path, "--threshold", "500", "--json")
    assert done.exit_code == 0, done.stderr
    told = json.loads(done.stdout)["input"]["warnings"]
    assert len(told) == 1
    assert told[0] in done.stderr.splitlines()


def test_without_pydicom_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = save(enhanced(ENHANCED_CT, body(), places()), tmp_path / "a.dcm")
    monkeypatch.setitem(sys.modules, "pydicom", None)
    for each, what in ((path, ".dcm"), (tmp_path, "a DICOM folder")):
        with pytest.raises(FormatError) as caught:
            read_volume(each)
        assert str(caught.value) == f"reading {what} needs the extra medical: pip install pydicom SimpleITK"
