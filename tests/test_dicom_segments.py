"""Segmentations of DICOM: every segment in its own place, with its name and colour, none on top of another."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from infill import Segmentation, Volume, read_segmentation, read_volume, smooth_labels
from infill.errors import FormatError, InfillError
from infill.imaging.dicom.headers import LABEL_MAP
from tests.handmade_dicom import AXIAL, SYNTAXES, enhanced, item, measures, save, save_all, segmentation, slices

SHAPE, STEP = (14, 9, 13), 2.5  # slices, rows, columns: the bits of a frame end within a byte
CORNER = np.array([-20.0, 7.0, 40.0])
CELL = 1.0 * 0.5 * STEP
# Text of 16 characters holds numbers of tens to 13 digits after the point; a centre adds some of them.
ROUNDING = 1e-9


def at(numbers: Sequence[int], axes: Sequence[float] = AXIAL) -> np.ndarray:
    return CORNER + np.outer(np.array(numbers) * STEP, np.cross(axes[:3], axes[3:]))


def written(
    truth: dict[int, np.ndarray],
    path: Path,
    *,
    order: Sequence[int] | None = None,
    empty: bool = False,
    syntax: str = "explicit",
    **more: Any,
) -> Path:
    """Write masks [slice, row, column] of segments: a frame for every slice of each, empty ones left out or not."""
    frames = [(n, k) for n, mask in truth.items() for k in range(len(mask)) if empty or mask[k].any()]
    frames = [frames[k] for k in order] if order is not None else frames
    masks = np.array([truth[n][k] for n, k in frames]).astype(np.uint8) * more.pop("high", 1)
    places = at([k for _, k in frames], more.get("axes", AXIAL))
    more = {"between": STEP, "bits": 1 if more.get("kind", "BINARY") == "BINARY" else 8, **more}
    return save(segmentation(masks, places, [n for n, _ in frames], **more), path, syntax)


def box(low: Sequence[int], high: Sequence[int]) -> np.ndarray:
    mask = np.zeros(SHAPE, dtype=bool)
    mask[tuple(slice(a, b) for a, b in zip(low, high, strict=True))] = True
    return mask


TWO = {1: box((3, 2, 1), (8, 7, 6)), 2: box((6, 1, 8), (12, 8, 12))}
OVERLAPPING = {1: box((3, 2, 1), (8, 7, 6)), 2: box((6, 4, 4), (12, 8, 12)), 5: box((1, 0, 9), (3, 2, 12))}


def centres(volume: Volume, value: int) -> set[tuple[float, ...]]:
    cells = volume.place((np.argwhere(np.asarray(volume.values) == value) + 0.5) * volume.cell_size)
    return {tuple(each) for each in np.round(cells, 6).tolist()}


def true_centres(mask: np.ndarray, axes: Sequence[float] = AXIAL) -> set[tuple[float, ...]]:
    """Return the same by the equation of the standard, C.7.6.2.1.1."""
    frame, row, column = np.argwhere(mask).T
    found = at(frame, axes) + np.outer(column * 1.0, axes[:3]) + np.outer(row * 0.5, axes[3:])
    return {tuple(each) for each in np.round(found, 6).tolist()}


def agrees(found: Segmentation, truth: dict[int, np.ndarray], axes: Sequence[float] = AXIAL) -> None:
    """Check that every segment lies where it should, in one layer, and that nothing else is there."""
    seen: dict[int, set[tuple[float, ...]]] = {}
    for layer in found.layers:
        assert layer.space == "LPS"
        assert layer.spacing == pytest.approx((1.0, 0.5, STEP), abs=ROUNDING)
        for value in np.unique(layer.values):
            if value:
                assert value not in seen
                seen[int(value)] = centres(layer, value)
    assert seen == {n: true_centres(mask, axes) for n, mask in truth.items() if mask.any()}


@pytest.mark.longest
@given(
    data=st.data(),
    count=st.integers(1, 4),
    overlapping=st.booleans(),
    empty=st.booleans(),
    axes=st.sampled_from([AXIAL, (0, 1, 0, 0, 0, -1), (0.6, 0.8, 0, 0, 0, 1), (1, 0, 0, 0, -1, 0)]),
    seed=st.integers(0, 999),
)
@example(data=None, count=2, overlapping=False, empty=False, axes=AXIAL, seed=0)
def test_segments_lie_where_they_say(
    data: Any, count: int, overlapping: bool, empty: bool, axes: tuple[float, ...], seed: int
) -> None:
    """In any order, with or without empty frames, gaps between slices, overlap, and any orientation."""
    rng = np.random.default_rng(seed)
    labels = rng.integers(0, count + 1, SHAPE)
    truth = {n: (labels == n) | (overlapping & (rng.random(SHAPE) < 0.1)) for n in range(1, count + 1)}
    for mask in truth.values():
        mask[rng.permutation(len(mask))[:5]] = False
    left = sum(empty or bool(page.any()) for mask in truth.values() for page in mask)
    order = None if data is None else data.draw(st.permutations(range(left)))
    with tempfile.TemporaryDirectory() as folder:
        path = written(truth, Path(folder) / "a.dcm", order=order, empty=empty, axes=axes)
        found = read_segmentation(path)
    agrees(found, truth, axes)
    assert [each.name for each in found.segments] == [f"segment {n}" for n in truth]
    if not overlapping:
        assert len(found.layers) == 1


@pytest.mark.slow
@pytest.mark.parametrize("syntax", SYNTAXES)
@pytest.mark.parametrize("stated", [STEP, None, -STEP])
def test_every_way_to_write_segments(syntax: str, stated: float | None, tmp_path: Path) -> None:
    agrees(read_segmentation(written(TWO, tmp_path / "a.dcm", syntax=syntax, between=stated)), TWO)


def test_one_segment_is_a_mask(tmp_path: Path) -> None:
    """With slices left out in its middle: two bodies, not one."""
    mask = box((2, 2, 1), (5, 7, 6)) | box((9, 2, 1), (12, 7, 6))
    volume = read_volume(written({3: mask}, tmp_path / "a.dcm"))
    assert set(np.unique(volume.values).tolist()) == {0, 3}
    assert centres(volume, 3) == true_centres(mask)
    assert np.asarray(volume.values)[:, :, [0, -1]].max() == 0  # so that the body is closed


def test_a_volume_of_several_segments_holds_their_numbers(tmp_path: Path) -> None:
    volume = read_volume(written(TWO, tmp_path / "a.dcm"))
    assert {n: np.asarray(volume.values == n).sum() for n in (1, 2)} == {n: mask.sum() for n, mask in TWO.items()}
    path = written(OVERLAPPING, tmp_path / "b.dcm")
    with pytest.raises(FormatError, match=r"2 layers of segments; write all with \{label\}.*--frame 0 to --frame 1"):
        read_volume(path)
    assert centres(read_volume(path, frame=1), 2) == true_centres(OVERLAPPING[2])
    layer = read_segmentation(path, frame=1)
    assert [(each.value, each.layer) for each in layer.segments] == [(2, 0)]


def test_names_and_colours(tmp_path: Path) -> None:
    """White, and the red of sRGB: CIELab 54.29, 80.81, 69.89 for D50 (ICC)."""

    def stored(light: float, a: float, b: float) -> list[int]:
        return [round(light * 655.35), round((a + 128) * 257), round((b + 128) * 257)]

    segments = {
        1: {"SegmentLabel": "Left lung\x1b[2J", "RecommendedDisplayCIELabValue": stored(54.29, 80.81, 69.89)},
        2: {"SegmentLabel": "", "SegmentDescription": "Rib", "RecommendedDisplayCIELabValue": stored(100, 0, 0)},
        7: {"SegmentLabel": "Nowhere"},
    }
    found = read_segmentation(written(TWO, tmp_path / "a.dcm", segments=segments))
    assert [(each.value, each.name) for each in found.segments] == [(1, "Left lung[2J"), (2, "Rib"), (7, "Nowhere")]
    # Two digits of CIELab, and 16 bits, are a hundredth of each colour.
    assert found.segments[0].colour == pytest.approx((1, 0, 0), abs=0.02)
    assert found.segments[1].colour == pytest.approx((1, 1, 1), abs=0.001)
    assert found.segments[2].colour is None
    assert smooth_labels(found, tolerance=None).report["absent"] == ["Nowhere"]


@pytest.mark.longest
def test_segments_become_files_with_their_names(tmp_path: Path, compiled: None) -> None:
    path = written(OVERLAPPING, tmp_path / "a.dcm")
    words = [sys.executable, "-m", "infill", "smooth", str(path), "-o", str(tmp_path / "{label}.stl"), "--json"]
    done = subprocess.run(words, capture_output=True, encoding="utf-8", check=False)
    assert done.returncode == 0, done.stderr
    labels = {each["number"]: each["report"] for each in json.loads(done.stdout)["labels"]}
    for n, mask in OVERLAPPING.items():
        assert (tmp_path / f"segment {n}.stl").is_file()
        assert labels[n]["solid"]["data"] == pytest.approx(mask.sum() * CELL, rel=1e-9)  # a product of floats


def test_shares_of_cells(tmp_path: Path) -> None:
    """Fractions of one segment are grey values from 0 to 1; as labels, cells that lie at least half inside."""
    shares = (np.arange(np.prod(SHAPE)).reshape(SHAPE) % 101).astype(np.uint8)
    made = segmentation(shares, at(range(SHAPE[0])), [1] * SHAPE[0], kind="FRACTIONAL", between=STEP, bits=8)
    made.MaximumFractionalValue = 100
    path = save(made, tmp_path / "a.dcm")
    volume = read_volume(path)
    assert np.asarray(volume.values).max() == 1
    assert np.asarray(volume.values)[0, 0, 2:-2] == pytest.approx(shares[:, 0, 0] / 100, rel=1e-6)  # float32
    labels = read_segmentation(path)
    assert centres(labels.layers[0], 1) == true_centres(shares >= 50)
    assert "at least half" in labels.layers[0].warnings[0]


@pytest.mark.parametrize("colour", ["MONOCHROME2", "PALETTE COLOR"])
def test_a_label_map(colour: str, tmp_path: Path) -> None:
    values = sum(mask * np.uint16(n * 300) for n, mask in TWO.items())
    made = enhanced(LABEL_MAP, values[2:], at(range(2, SHAPE[0])), between=STEP, PhotometricInterpretation=colour)
    made.SegmentSequence = [item(SegmentNumber=n, SegmentLabel=f"part {n}") for n in (0, 300, 600)]
    made.SegmentationType = "LABELMAP"
    found = read_segmentation(save(made, tmp_path / "a.dcm"))
    agrees(found, {n * 300: mask for n, mask in TWO.items()})
    assert [each.name for each in found.segments] == ["part 300", "part 600"]


@pytest.mark.slow
def test_segments_in_several_files(tmp_path: Path) -> None:
    """Each file counts its own segments from 1; none of them is lost."""
    folder = tmp_path / "a"
    folder.mkdir()
    for n, mask in TWO.items():
        written({1: mask}, folder / f"{n}.dcm", segments={1: {"SegmentLabel": f"part {n}"}}, instance=n)
    found = read_segmentation(folder)
    assert [(each.name, each.layer) for each in found.segments] == [("part 1", 0), ("part 2", 1)]
    for layer, mask in zip(found.layers, TWO.values(), strict=True):
        assert centres(layer, 1) == true_centres(mask)
    assert {*smooth_labels(found, tolerance=None).surfaces} == {"part 1", "part 2"}
    save_all(slices(np.zeros(SHAPE, np.uint16), at(range(SHAPE[0])), series="2.25.8"), folder)
    with pytest.raises(FormatError, match="2 DICOM series"):
        read_segmentation(folder)
    assert len(read_segmentation(folder, series="2.25.7").layers) == 2


# --- refused, or told ------------------------------------------------------------------------------------------


def test_segments_that_are_not_even_are_refused(tmp_path: Path) -> None:
    mask = TWO[1][3:8].astype(np.uint8)
    uneven = at(range(5))
    uneven[3:] += (0, 0, 0.8)
    sheared = at(range(5)) + np.outer(np.arange(5) * 0.5, [1, 0, 0])
    doubled = at([0, 1, 2, 2, 3])
    fan = [
        {"PlaneOrientationSequence": [item(ImageOrientationPatient=["1", "0", "0", "0", str(c), str(s)])]}
        for c, s in ((1, 0), (0.8, 0.6), (0.6, 0.8), (0, 1), (-0.6, 0.8))
    ]
    for kind, places in {"uneven": uneven, "sheared": sheared, "doubled": doubled, "one": at([0] * 5)}.items():
        path = save(segmentation(mask, places, [1] * 5, between=STEP, bits=1), tmp_path / f"{kind}.dcm")
        for read in (read_volume, read_segmentation):
            with pytest.raises(InfillError) as caught:
                read(path)
            assert str(path) in str(caught.value)
            assert str(caught.value).isprintable()
    made = segmentation(mask, at(range(5)), [1] * 5, between=STEP, bits=1)
    for each, turn in zip(made.PerFrameFunctionalGroupsSequence, fan, strict=True):
        each.PlaneOrientationSequence = turn["PlaneOrientationSequence"]
    with pytest.raises(FormatError, match="orientations"):
        read_segmentation(save(made, tmp_path / "fan.dcm"))


@pytest.mark.parametrize("lacking", ["segment", "places", "type"])
def test_what_a_segmentation_does_not_say(lacking: str, tmp_path: Path) -> None:
    made = segmentation(TWO[1][3:8].astype(np.uint8), at(range(5)), [1] * 5, between=STEP, bits=1)
    for each in made.PerFrameFunctionalGroupsSequence:
        if lacking == "segment":
            del each.SegmentIdentificationSequence
        elif lacking == "places":
            del each.PlanePositionSequence
    if lacking == "type":
        made.SegmentationType = "SOMETHING"
    with pytest.raises(FormatError):
        read_segmentation(save(made, tmp_path / "a.dcm"))


def test_slices_of_which_none_lie_side_by_side_are_told(tmp_path: Path) -> None:
    made = segmentation(TWO[1][3:7].astype(np.uint8), at([0, 3, 6, 9]), [1] * 4, between=STEP, bits=1)
    found = read_segmentation(save(made, tmp_path / "a.dcm"))
    assert "none that lie side by side" in found.layers[0].warnings[0]


@pytest.mark.parametrize(("numbers", "told"), [((0, 3, 6), True), ((0, 1, 2), False)])
def test_a_step_that_nothing_states_and_the_thickness_contradicts_is_told(
    numbers: tuple[int, ...], told: bool, tmp_path: Path
) -> None:
    """Of frames of 3 mm that lie 7.5 mm apart, some may be left out because they are empty."""
    made = segmentation(TWO[1][3:6].astype(np.uint8), at(numbers), [1] * 3, between=None, bits=1)
    found = read_segmentation(save(made, tmp_path / "a.dcm")).layers[0]
    assert any("does not say how far apart slices are" in each for each in found.warnings) == told
    assert found.spacing == (1.0, 0.5, STEP * numbers[1])


def test_a_step_that_is_stated_wrongly_gives_way_to_the_places(tmp_path: Path) -> None:
    """The thickness, say, stated as the distance."""
    made = segmentation(TWO[1][3:8].astype(np.uint8), at(range(5)), [1] * 5, between=4.0, bits=1)
    assert read_volume(save(made, tmp_path / "a.dcm")).spacing == (1.0, 0.5, STEP)


def test_bits_are_cut_off(tmp_path: Path) -> None:
    path = written(TWO, tmp_path / "a.dcm")
    path.write_bytes(path.read_bytes()[:-4])
    with pytest.raises(FormatError, match="cut off"):
        read_segmentation(path)


def test_measures_of_each_frame(tmp_path: Path) -> None:
    made = segmentation(TWO[1][3:8].astype(np.uint8), at(range(5)), [1] * 5, between=STEP, bits=1, shared=False)
    assert read_volume(save(made, tmp_path / "a.dcm")).spacing == (1.0, 0.5, STEP)
    made.PerFrameFunctionalGroupsSequence[2].PixelMeasuresSequence = [measures((0.6, 1.0), STEP)]
    with pytest.raises(FormatError, match="sizes"):
        read_volume(save(made, tmp_path / "b.dcm"))
