"""Pictures: the mesh renderer and the four stages."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image, ImageFont
from test_command_line import run

from infill import FormatError, OutputError, Smoothing, Surface, make, smooth_labels, smooth_mesh, smooth_volume
from infill.meshes.winding import is_solid_boundary, winding_numbers
from infill.pictures.before_and_after import FAR_VOXELS, LEAST_HITS, MarkedSurface, draw_before_and_after
from infill.pictures.close_up import FRAME, SIDE, SURROUNDINGS, insert_close_up
from infill.pictures.picture_files import check_preview
from infill.pictures.render import render
from infill.pictures.sheet import CAPTION, LINE, MARGIN, PANEL, arrange_panels, spell_units, wrap_words

WHITE = 255


def surface(mesh: trimesh.Trimesh) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))


def test_a_square_seen_from_above_is_a_square() -> None:
    picture = render(
        surface(trimesh.creation.box((10, 10, 10))), width=100, height=100, elevation=math.pi / 2, azimuth=0
    )
    covered = (picture != WHITE).any(axis=2)
    assert covered.sum() == pytest.approx((0.94 * 100) ** 2, rel=0.03)
    assert covered[50, 50]
    assert not covered[1, 1]


def test_the_nearer_face_hides_the_farther() -> None:
    """A small box above a large one, seen from above, in whatever order they come."""
    large, small = trimesh.creation.box((10, 10, 1)), trimesh.creation.box((4, 4, 1))
    small.apply_translation((0, 0, 3))
    small.apply_transform(trimesh.transformations.rotation_matrix(0.3, (1, 0, 0), (0, 0, 3)))
    pictures = [
        render(surface(trimesh.util.concatenate(order)), width=80, height=80, elevation=math.pi / 2, azimuth=0)
        for order in ([large, small], [small, large])
    ]
    assert np.array_equal(*pictures)
    assert not np.array_equal(pictures[0][40, 40], pictures[0][40, 10])


def test_faces_seen_from_behind_are_not_drawn() -> None:
    triangle = Surface(vertices=np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]]), faces=np.array([[0, 2, 1]]))
    assert (render(triangle, width=20, height=20, elevation=math.pi / 2) == WHITE).all()


def test_many_fragments_are_drawn_some_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    ball = surface(trimesh.creation.icosphere(subdivisions=3))
    whole = render(ball, width=60, height=60)
    monkeypatch.setattr("infill.pictures.render.FRAGMENTS_AT_ONCE", 50)
    assert np.array_equal(render(ball, width=60, height=60), whole)


@pytest.mark.slow
def test_the_preview_shows_four_stages(tmp_path: Path) -> None:
    result = make("honeycomb", size=(40, 20))
    path = result.save(tmp_path / "stages.png")
    with Image.open(path) as picture:
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    panels = np.array_split(pixels, 4, axis=1)
    assert pixels.shape[1] > 3 * pixels.shape[0]
    for panel in panels:  # each stage has ink of its own
        assert (panel.min(axis=2) < 200).mean() > 0.01
    red = (pixels[..., 0] > 150) & (pixels[..., 1:].max(axis=2) < 80)
    assert [bool(part.any()) for part in np.array_split(red, 4, axis=1)] == [False, False, True, False]


def test_y_points_up() -> None:
    """The tip of the heart, at the lower left, is drawn at the lower left."""
    sheet = np.asarray(make("concentric-heart", hearts=1, size=40).picture().convert("L")).astype(int)
    panel = sheet[34:454, 14:434] < 100
    assert panel[-40:, :40].any()
    assert not panel[:40, -40:].any()


@pytest.mark.slow
def test_straight_lines_are_drawn_straight() -> None:
    """Lines of a grid of 60 mm lie on the borders of pixels, up to rounding: each is one row or column, without a jog."""
    sheet = np.asarray(make("grid").picture().convert("L")).astype(int)
    panel = sheet[34:454, 14:434] < 100
    for axis in (0, 1):
        inked = panel.sum(axis=axis)
        whole = np.flatnonzero(inked == inked.max())
        assert len(whole) == 11
        assert inked.max() == whole[-1] - whole[0] + 1  # the frame is as long as the lines in it
    assert panel.sum() == 2 * 11 * inked.max() - 11**2  # and there is no other ink


@pytest.mark.parametrize("name", ["x.jpg", "x", "x.stl"])
def test_only_png_is_written(name: str) -> None:
    with pytest.raises(FormatError, match=r"ends in \.png"):
        check_preview(name)


def test_a_window_shows_lengths_where_they_are() -> None:
    """A box seen along y: from -0.5 to 0.25 across and 0 to 0.5 up, in a frame of -1 to 1."""
    box = trimesh.creation.box(bounds=[(-0.5, -1, 0), (0.25, 1, 0.5)])
    surface = Surface(vertices=np.asarray(box.vertices), faces=np.asarray(box.faces))
    picture = render(surface, width=80, height=80, azimuth=math.radians(-90), elevation=0, window=(-1, 1, -1, 1))
    rows, columns = np.nonzero(picture.min(axis=2) < 255)
    assert (columns.min(), columns.max()) == (20, 49)  # pixels of 1/40
    assert (rows.min(), rows.max()) == (20, 39)  # row 0 is at the top


def test_a_surface_is_painted_where_it_is_seen() -> None:
    """Red where x > 0, and the paint hears of points on the surface only."""
    mesh = trimesh.creation.icosphere(subdivisions=4, radius=10.0)
    ball = surface(mesh).moved(mesh.vertices + np.array([3e4, 0, 0]))
    heard = []

    def paint(points: np.ndarray) -> np.ndarray:
        heard.append(points)
        return np.where(points[:, :1] > 3e4, (255, 0, 0), (255, 255, 255))

    picture = render(ball, width=80, height=80, azimuth=math.radians(-90), elevation=0, paint=paint).astype(int)
    red = picture[..., 0] > picture[..., 1]
    assert red[20:60, 41:70].all()
    assert not red[:, :39].any()
    assert np.linalg.norm(heard[0] - (3e4, 0, 0), axis=1) == pytest.approx(10, abs=0.3)  # a pixel, on steep triangles


def test_paint_of_one_colour_is_that_colour() -> None:
    box = surface(trimesh.creation.box((10, 10, 10)))
    one = render(box, width=60, height=60, colour=(90, 120, 200))
    painted = render(box, width=60, height=60, paint=lambda points: np.full((len(points), 3), (90, 120, 200)))
    assert np.abs(one.astype(int) - painted).max() <= 1  # float32


def panels(sheet: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The two pictures of a sheet, the first with its close-up beside it where it has no room for one."""
    top, beside = 34, sheet.shape[1] - 2 * PANEL - 3 * MARGIN
    before, after = (MARGIN, PANEL + beside), (2 * MARGIN + PANEL + beside, PANEL)
    return tuple(sheet[top : top + PANEL, left : left + width].astype(int) for left, width in (before, after))


def reddish(picture: np.ndarray) -> int:
    return int((picture[..., 0] > picture[..., 1] + 80).sum())


def bluish(picture: np.ndarray) -> int:
    return int((picture[..., 2] > picture[..., 0] + 60).sum())


@pytest.mark.longest
@pytest.mark.usefixtures("compiled")
def test_what_is_lost_is_red_before_and_nothing_is_marked_after() -> None:
    """A fin of half a voxel on a plate: far too thin to last."""
    plate, fin = trimesh.creation.box((20, 20, 4)), trimesh.creation.box((16, 0.1, 8))
    fin.apply_translation((0, 0, 5.5))
    result = smooth_mesh(trimesh.util.concatenate([plate, fin]), voxel=0.2, allow_broken=True, tolerance=None)
    before, after = panels(np.asarray(result.picture()))
    assert reddish(before) > 5000
    assert reddish(after) == bluish(before) == bluish(after) == 0


@pytest.mark.slow
@pytest.mark.usefixtures("compiled")
def test_what_is_kept_is_not_marked_and_stays_in_its_place() -> None:
    result = smooth_mesh(trimesh.creation.icosphere(subdivisions=4, radius=10), resolution=60, tolerance=None)
    both = panels(np.asarray(result.picture()))
    assert [reddish(each) + bluish(each) for each in both] == [0, 0]
    one, other = ((each < WHITE).any(axis=2) for each in both)
    assert (one != other).mean() < 0.01


@pytest.mark.longest
@pytest.mark.usefixtures("compiled")
def test_before_and_after_have_one_scale() -> None:
    """At the level 0 a ball shrinks, and so does its picture."""
    cells = np.sum((np.indices((30, 30, 30)) - 14.5) ** 2, axis=0) < 81
    result = smooth_volume(
        cells, smoothing=Smoothing(steps=60), method="plain", level=0, allow_broken=True, tolerance=None
    )
    before, after = (np.flatnonzero((each < WHITE).any(axis=(0, 2))) for each in panels(np.asarray(result.picture())))
    shrunk = result.surface.bounds[1, 0] - result.surface.bounds[0, 0]
    assert np.ptp(after) / np.ptp(before) == pytest.approx(shrunk / 18, abs=0.03)  # 18 cells wide, pixels of 1/400
    assert shrunk < 17


@pytest.mark.usefixtures("compiled")
def test_only_what_lies_far_from_the_other_has_an_area() -> None:
    one, other = trimesh.creation.box((10, 10, 10)), trimesh.creation.box((10, 10, 10))
    other.apply_translation((0, 0, 14))
    both, lone = surface(trimesh.util.concatenate([one, other])), surface(one)
    added = MarkedSurface(surface=both, other=lone, far=FAR_VOXELS, colour=(0, 0, 255))
    assert added.area == pytest.approx(600, rel=0.02)
    assert MarkedSurface(surface=lone, other=both, far=FAR_VOXELS, colour=(255, 0, 0)).area == 0


@pytest.mark.usefixtures("compiled")
def test_faces_hidden_inside_the_solid_are_not_lost() -> None:
    one, other = trimesh.creation.box((10, 10, 10)), trimesh.creation.box((10, 10, 10))
    other.apply_translation((4, 4, 4))
    both = surface(trimesh.util.concatenate([one, other]))
    union = surface(trimesh.creation.box((60, 60, 60)))
    lost = MarkedSurface(surface=both, other=union, far=FAR_VOXELS, colour=(255, 0, 0))
    assert lost.area == pytest.approx(1200 - 6 * 36, rel=0.02)  # all of both but 6 x 6 mm of six faces


@pytest.mark.usefixtures("compiled")
def test_winding_counts_bodies() -> None:
    one, other = trimesh.creation.box((10, 10, 10)), trimesh.creation.box((10, 10, 10))
    other.apply_translation((4, 4, 4))
    both = surface(trimesh.util.concatenate([one, other]))
    points = np.array([[-3, -3.1, -3.2], [2, 2.1, 2.3], [8, 8.1, 8.2], [20, 0, 0.0]])
    assert winding_numbers(points, both).tolist() == [1, 2, 1, 0]
    inside = surface(trimesh.creation.box((10, 10, 10)))
    face = np.flatnonzero(inside.vertices[inside.faces][..., 0].min(axis=1) == 5)[:1]
    assert is_solid_boundary(np.array([[5.0, 1, 2]]), face, inside, 1e-3).all()
    assert len(is_solid_boundary(np.zeros((0, 3)), np.zeros(0, int), inside, 1e-3)) == 0


def before_and_after(one: trimesh.Trimesh, other: trimesh.Trimesh) -> list[np.ndarray]:
    """The panels of two meshes, with a voxel of 0.5 mm."""
    report = {"extents": [1, 1, 1], "volume": 1.0, "volume_change": 0.0, "verdict": {"word": "lost"}}
    picture = draw_before_and_after(surface(one), surface(other), cell=0.5, report=report, captions=("before", "after"))
    return panels(np.asarray(picture))


@pytest.mark.slow
@pytest.mark.usefixtures("compiled")
def test_a_small_loss_has_a_close_up() -> None:
    """A pin of a sixtieth of the part: some pixels in the picture, a tenth of the close-up."""
    block = trimesh.creation.box((100, 60, 40))
    pin = trimesh.creation.cylinder(radius=0.8, height=6).apply_translation((-49, 0, -21))
    before, after = before_and_after(trimesh.boolean.union([block, pin], engine="manifold"), block)
    framed = 4 * (SIDE - FRAME) * FRAME
    assert reddish(before) > framed + 0.05 * SIDE**2
    assert reddish(after) + bluish(after) == 0


@pytest.mark.parametrize("shape", [(420, 420), (300, 380)])
@pytest.mark.parametrize("room", [0, SIDE - 1, SIDE, 200])
def test_a_close_up_covers_nothing_of_the_model(shape: tuple[int, int], room: int) -> None:
    """It lies in an empty square of the picture if there is one, wherever it is, and else beside the picture."""
    pixels = np.full((*shape, 3), 255, dtype=np.uint8)
    pixels[1:, 1:] = 90
    pixels[60 : 60 + room, 40 : 40 + room] = 255
    inset = Image.new("RGB", (SIDE, SIDE), (200, 30, 30))
    picture = insert_close_up(Image.fromarray(pixels), inset, 3.0, (200, 30, 30))
    drawn = np.asarray(picture)
    assert (drawn[: shape[0], : shape[1]][(pixels == 90).all(axis=2)] == 90).all()
    assert picture.width == shape[1] + (0 if room >= SIDE else SIDE)
    assert picture.height == shape[0]
    assert (drawn == (200, 30, 30)).all(axis=2).sum() > 0.9 * SIDE**2


@pytest.mark.slow
@pytest.mark.usefixtures("compiled")
def test_what_is_lost_inside_is_cut_open() -> None:
    """No view shows a cavity; the close-up does: half a ball, on a cut that is not marked."""
    block = trimesh.creation.box((100, 60, 40))
    ball = trimesh.creation.icosphere(subdivisions=3, radius=3).apply_translation((10, 5, 2))
    before, _ = before_and_after(trimesh.boolean.difference([block, ball], engine="manifold"), block)
    framed, disc = 4 * (SIDE - FRAME) * FRAME, math.pi * (SIDE / (2 * SURROUNDINGS)) ** 2
    assert framed + 0.6 * disc < reddish(before) < framed + 1.1 * disc  # some of the ball lies in the dark


@pytest.mark.slow
@pytest.mark.usefixtures("compiled")
def test_a_large_loss_needs_no_close_up() -> None:
    """It is seen in the picture itself, which keeps its corners."""
    block = trimesh.creation.box((40, 40, 40))
    half = trimesh.creation.box((40, 40, 20)).apply_translation((0, 0, -10))
    before, _ = before_and_after(block, half)
    assert reddish(before) > LEAST_HITS / 4
    corners = [before[y, x] for y in (slice(0, 5), slice(-5, None)) for x in (slice(0, 5), slice(-5, None))]
    assert all((corner >= WHITE).all() for corner in corners)


# --- of a result -----------------------------------------------------------------------------------------


@pytest.mark.longest
def test_a_notebook_shows_what_is_saved_and_what_the_command_writes(tmp_path: Path) -> None:
    result = make("honeycomb", size=20, height=3)
    shown = result._repr_png_()
    assert shown == result.save(tmp_path / "a.PNG").read_bytes()
    with Image.open(tmp_path / "a.PNG") as picture:
        assert np.array_equal(np.asarray(picture), np.asarray(result.picture()))
    done = run("make", "honeycomb", "--size", "20", "--height", "3", "--preview", tmp_path / "b.png")
    assert done.exit_code == 0, done.output
    assert (tmp_path / "b.png").read_bytes() == shown


@pytest.mark.slow
def test_all_labels_are_one_picture() -> None:
    labels = np.zeros((40, 20, 20), dtype=np.uint8)
    labels[4:16, 4:16, 4:16], labels[24:36, 4:16, 4:16] = 1, 2
    panel = (np.asarray(smooth_labels(labels, tolerance=None).picture()) < WHITE).any(axis=2)[CAPTION : CAPTION + PANEL]
    seen = panel.any(axis=0)
    assert np.count_nonzero(np.diff(seen.astype(int)) == 1) >= 1
    assert panel.mean() > 0.1


@pytest.mark.slow
def test_an_existing_file_is_replaced_unless_it_may_not_be(tmp_path: Path) -> None:
    """As other Python libraries do, and as the command does."""
    result, path = make("honeycomb", size=20, height=3), tmp_path / "a.stl"
    path.write_text("precious")
    for suffix in (".stl", ".png"):
        path = tmp_path / f"a{suffix}"
        path.write_text("precious")
        with pytest.raises(OutputError, match=r"a\.\w+ exists; give another name, or leave out overwrite=False"):
            result.save(path, overwrite=False)
        assert path.read_text() == "precious"
        assert result.save(path).stat().st_size > 1000
        path.unlink()
        assert result.save(path, overwrite=False).stat().st_size > 1000
    with pytest.raises(FormatError, match=r"\.glb, \.png"):
        result.save(tmp_path / "a.jpg")
    with pytest.raises(OutputError, match="there is no folder|No such file"):
        result.save(tmp_path / "no" / "a.png")
    assert sorted(each.name for each in tmp_path.iterdir()) == ["a.png", "a.stl"]


def test_all_words_below_the_panels_are_seen() -> None:
    """Facts and legends wider than a picture go on in further lines, and nothing reaches its edges."""
    panel = Image.new("RGB", (PANEL, PANEL), (255, 255, 255))
    entry = ((214, 39, 40), "452 mm² of a wall that is too thin to count")
    short = arrange_panels({"a": panel}, "one line", [entry])
    facts = "as many words as a picture has no room for " * 4
    lines = wrap_words(facts, PANEL, ImageFont.load_default(16))
    assert len(lines) > 2
    long = arrange_panels({"a": panel}, facts, [entry] * 3)
    assert long.height == short.height + LINE * (len(lines) - 1 + 2)  # each entry needs a row
    pixels = np.asarray(long)[CAPTION + PANEL :]
    assert (pixels[:, :MARGIN] == WHITE).all()
    assert (pixels[:, -MARGIN // 2 :] == WHITE).all()
    assert (pixels[-MARGIN // 2 :] == WHITE).all()
    rows = (pixels < WHITE).any(axis=(1, 2))
    assert all(rows[10 + LINE * line : 10 + LINE * (line + 1)].any() for line in range(len(lines) + 3))


def test_lines_of_words_keep_all_words_within_the_width() -> None:
    font, text = ImageFont.load_default(16), "1 22 333 4444 " * 20 + "w" * 80
    lines = wrap_words(text, 200, font)
    assert " ".join(lines).split() == text.split()
    assert all(font.getlength(line) <= 200 for line in lines[:-1])


def test_a_picture_has_no_sign_that_its_font_lacks() -> None:
    """The font of pictures draws a box for the signs of powers and of micro."""
    text = spell_units("12 µm², 3 mm³ ± 0.5 mm, 5°")
    font = ImageFont.load_default(16)
    box = bytes(font.getmask("\uffff"))
    assert bytes(font.getmask("³")) == box
    assert not [sign for sign in text if bytes(font.getmask(sign)) == box]
    assert text == "12 square um, 3 cubic mm ± 0.5 mm, 5°"


def test_a_caption_has_one_unit(monkeypatch: pytest.MonkeyPatch) -> None:
    """Size, volume, distance and areas of a part a tenth of a millimetre long are in the unit of its size."""
    mesh = surface(trimesh.creation.icosphere(subdivisions=2, radius=0.05))
    report = {
        "extents": [0.1] * 3,
        "volume": 5.1e-5,
        "volume_change": 0.0,
        "verdict": {"word": "kept", "far": 0.00107, "missing": 2e-6, "thin": 0.0, "new": 0.0},
    }
    words: list[str] = []

    def record(panels: object, facts: str, legend: list[tuple[object, str]]) -> Image.Image:
        words.extend([facts, *(text for _, text in legend)])
        return Image.new("RGB", (1, 1))

    monkeypatch.setattr("infill.pictures.before_and_after.arrange_panels", record)
    draw_before_and_after(mesh, mesh, cell=0.0005, report=report, captions=("a", "b"))
    assert words[0] == (
        "0.1 x 0.1 x 0.1 mm, volume 0.000051 mm³ (+0.0000%); marked if more than 0.00107 mm (2 voxels) apart"
    )
    assert words[2].startswith("0.000002 mm² lost")
