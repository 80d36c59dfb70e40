"""Pages in a real browser: they draw, turn, cut solids open, rest, obey the keyboard, and ask nobody for anything."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

from infill import fill, make
from infill.formats.mesh_files import save
from infill.planner.layer_speeds import DrawnSpeeds
from infill.surface import Surface
from infill.viewer.page import embed_page, surface_page
from infill.viewer.print_page import print_page
from tests.browsing import find_serious, open_page, pixels, wait_until_drawn
from tests.made_shapes import ball, box, less

COUNT_FRAMES = """() => {
  globalThis.frames_ = 0;
  const [{ renderer }] = viewers;
  const render = renderer.render.bind(renderer);
  renderer.render = (...all) => { frames_++; render(...all); };
}"""
LIGHT, DARK = (247, 246, 243), (21, 23, 26)  # the paper, as page.css has it


def surface_of(mesh: trimesh.Trimesh) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))


def hollow() -> Surface:
    """Return a cube of 40 mm around a ball of 10 mm of nothing."""
    return surface_of(less(box(40, 40, 40), ball(10.0)))


def written(folder: Path, page: str) -> str:
    path = folder / "view.html"
    path.write_text(page, encoding="utf-8")
    return path.as_uri()


def ink(picture: NDArray, paper: tuple[int, int, int]) -> NDArray:
    """Tell which pixels are not paper."""
    return (np.abs(picture - np.array(paper)) > 3).any(axis=2)


def drawn(page: Any) -> NDArray:
    """Return what the first view shows, without its edge, which may lie between two pixels."""
    page.evaluate("viewers[0].frame()")
    return pixels(page, ".view")[2:-2, 2:-2]


def circles(layers: int = 12, sides: int = 40, radius: float = 15.0) -> DrawnSpeeds:
    """Return a print of rings, faster on every layer."""
    turn = np.linspace(0, 2 * np.pi, sides + 1)
    ring = np.column_stack([100 + radius * np.cos(turn), 100 + radius * np.sin(turn)])
    layer = np.repeat(np.arange(1, layers + 1), sides)
    z = 0.3 * layer[:, None]
    start, end = (np.hstack([np.tile(ends, (layers, 1)), z]).astype(np.float32) for ends in (ring[:-1], ring[1:]))
    speed = (10 * layer).astype(np.float32)
    return DrawnSpeeds(start=start, end=end, speed=speed, layer=layer.astype(np.int32), section=0.15)


@pytest.mark.long
@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("width", [1280, 390])
def test_a_page_fits_its_window_by_day_and_night(tmp_path: Path, width: int, dark: bool) -> None:
    page_text = surface_page({"shell": hollow(), "pin": surface_of(box(5, 5, 60))}, title="A part", report={})
    with open_page(written(tmp_path, page_text), width=width, dark=dark) as page:
        wait_until_drawn(page)
        seen = ink(drawn(page), DARK if dark else LIGHT)
        rows, columns = np.flatnonzero(seen.any(axis=1)), np.flatnonzero(seen.any(axis=0))
        assert max(np.ptp(rows) / seen.shape[0], np.ptp(columns) / seen.shape[1]) > 0.8
        assert rows[0] > 0
        assert columns[0] > 0
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        assert [box.is_checked() for box in page.get_by_role("checkbox").all()] == [True, True]
        assert find_serious(page) == []


@pytest.mark.longest
def test_a_cut_is_filled_where_the_solid_is_and_open_where_it_is_hollow(tmp_path: Path) -> None:
    with open_page(written(tmp_path, surface_page({"cube": hollow()}, title="Cube"))) as page:
        wait_until_drawn(page)
        page.get_by_role("button", name="Front").click()
        whole = drawn(page)
        middle, half = np.array(whole.shape[:2]) // 2, int(ink(whole, LIGHT).sum() ** 0.5) // 2
        page.get_by_label("Cut across").select_option("y")
        cut = drawn(page)
        hole, solid = cut[*middle], cut[middle[0], middle[1] - int(0.7 * half)]
        inner, ring = cut[middle[0], middle[1] + int(0.3 * half)], cut[middle[0] - int(0.7 * half), middle[1]]
        assert (solid == ring).all()  # the filled cut has one colour, without shadow
        assert np.abs(hole - solid).max() > 20
        assert np.abs(inner - solid).max() > 20
        page.evaluate("viewers[0].setCut({axis: 'y', at: 15})")  # behind the hollow
        assert (drawn(page)[*middle] == solid).all()
        page.get_by_label("Cut across").select_option("")
        assert (drawn(page) == whole).all()


@pytest.mark.longest
def test_the_keyboard_alone_reaches_everything(tmp_path: Path) -> None:
    page_text = surface_page({"a": surface_of(box(9, 9, 9)), "b": surface_of(ball(6.0, 2))}, title="Two")
    with open_page(written(tmp_path, page_text)) as page:
        wait_until_drawn(page)
        page.keyboard.press("Tab")
        assert page.evaluate("document.activeElement.getAttribute('aria-label')").startswith("Two: 2 surfaces")
        before, camera = drawn(page), page.evaluate("viewers[0].getCamera()")
        for key in ("ArrowLeft", "ArrowUp", "Shift+ArrowRight", "+"):
            page.keyboard.press(key)
        turned = page.evaluate("viewers[0].getCamera()")
        assert all(turned[key] != camera[key] for key in ("azimuth", "elevation", "distance", "target"))
        assert (drawn(page) != before).any()
        page.keyboard.press("f")
        assert page.evaluate("viewers[0].getCamera().target") == camera["target"]
        page.keyboard.press("Tab")
        page.keyboard.press("Space")
        assert not page.get_by_label("a", exact=True).is_checked()
        for _ in range(2):
            page.keyboard.press("Tab")
        page.keyboard.press("z")  # the first letter of a choice takes it
        assert page.get_by_label("Cut across").input_value() == "z"
        page.keyboard.press("Tab")
        place = float(page.get_by_label("Place of the cut, mm").input_value())
        page.keyboard.press("ArrowRight")
        assert float(page.get_by_label("Place of the cut, mm").input_value()) > place
        assert page.locator("#place").inner_text().endswith(" mm")
        page.keyboard.press("Tab")
        assert page.evaluate("document.activeElement.textContent") == "Corner"


@pytest.mark.longest
def test_a_view_rests_until_it_is_moved(tmp_path: Path) -> None:
    with open_page(written(tmp_path, surface_page({"ball": surface_of(ball(6.0))}, title="Ball"))) as page:
        wait_until_drawn(page)
        page.wait_for_timeout(2500)  # a picture without a graphics card is drawn once more, in more pixels
        page.evaluate(COUNT_FRAMES)
        page.wait_for_timeout(1500)
        assert page.evaluate("frames_") == 0
        box_of = page.locator(".view").bounding_box()
        x, y = box_of["x"] + box_of["width"] / 2, box_of["y"] + box_of["height"] / 2
        camera = page.evaluate("viewers[0].getCamera()")
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 80, y + 30, steps=4)
        page.mouse.up()
        page.mouse.wheel(0, -200)
        page.evaluate("viewers[0].frame()")
        assert 0 < page.evaluate("frames_") <= 12
        after = page.evaluate("viewers[0].getCamera()")
        assert after["distance"] < camera["distance"]
        assert after["azimuth"] < camera["azimuth"]  # what is seen follows the pointer
        assert after["elevation"] > camera["elevation"]


@pytest.mark.slow
def test_prints_side_by_side_share_a_camera_and_their_layers(tmp_path: Path) -> None:
    prints = {"before": circles(), "refilled": circles(radius=10.0)}
    page_text = print_page(prints, title="rings.gcode", numbers=[("time", "0:10:00")])
    with open_page(written(tmp_path, page_text)) as page:
        wait_until_drawn(page)
        assert page.locator("#shown").inner_text() == "Layer 6, 1.8 mm high"
        page.get_by_role("button", name="Top").click()
        one = drawn(page)
        assert page.evaluate("viewers.map((v) => v.getCamera().distance)[0] === viewers[1].getCamera().distance")
        page.get_by_label("Last layer that is shown").fill("12")
        page.get_by_label("This layer alone").check()
        shown = page.evaluate("viewers.map((v) => v.lines.get('print').group.children.filter((c) => c.visible).length)")
        assert shown == [1, 1]
        other = drawn(page)
        seen = other[ink(other, LIGHT)]
        assert (seen[:, 0] > seen[:, 2]).mean() > 0.9  # the fastest layer is red
        slow = one[ink(one, LIGHT)]
        assert (slow[:, 0] < slow[:, 1]).mean() > 0.9
        page.locator(".view").nth(1).focus()
        page.keyboard.press("ArrowDown")
        cameras = page.evaluate("viewers.map((v) => v.getCamera())")
        assert cameras[0] == cameras[1]
        assert find_serious(page) == []


@pytest.mark.slow
def test_a_notebook_shows_the_page_in_a_frame_of_its_own(tmp_path: Path) -> None:
    result = make("honeycomb", size=20, height=3)
    html = result._repr_html_()
    assert html == embed_page(result.page())
    with open_page(written(tmp_path, f"<!doctype html><title>notebook</title><body>{html}")) as page:
        frame = page.locator("iframe").element_handle().content_frame()
        wait_until_drawn(frame)
        assert frame.evaluate("viewers[0].stats().triangles") == result.report["triangles"]


@pytest.mark.slow
def test_without_webgl_a_sentence_says_so_and_the_numbers_stay(tmp_path: Path) -> None:
    page_text = surface_page({"ball": surface_of(ball(6.0))}, title="Ball").replace(
        "<body>", "<body><script>HTMLCanvasElement.prototype.getContext = () => null</script>"
    )
    with open_page(written(tmp_path, page_text), expected=("WebGL",)) as page:
        page.get_by_role("alert").wait_for()
        assert "The picture cannot be shown" in page.get_by_role("alert").inner_text()
        assert page.get_by_role("row", name="triangles").is_visible()


@pytest.mark.longest
def test_a_filled_part_is_seen_as_it_was_saved(tmp_path: Path) -> None:
    """The page of a result shows its triangles, its numbers, and its inside at once."""
    save(surface_of(box(30, 24, 20)), tmp_path / "part.stl")
    result = fill(tmp_path / "part.stl", density=0.2, pattern="gyroid")
    result.save(tmp_path / "view.html")
    with open_page((tmp_path / "view.html").as_uri()) as page:
        wait_until_drawn(page)
        assert page.evaluate("viewers[0].stats().triangles") == result.report["triangles"]
        assert page.get_by_label("Cut across").input_value() == "y"
        assert page.get_by_role("row", name="density").inner_text().split()[-1] == f"{result.report['density']:.1%}"


@pytest.mark.longest
def test_650_thousand_triangles_fit_into_two_and_a_half_megabytes(tmp_path: Path) -> None:
    solid = trimesh.creation.icosphere(subdivisions=8, radius=30.0)
    assert len(solid.faces) > 650_000
    solid.vertices *= 1 + 0.05 * np.sin(solid.vertices[:, :1]) * np.cos(solid.vertices[:, 1:2])
    page_text = surface_page({"solid": surface_of(solid)}, title="Large")
    assert len(page_text.encode()) < 2.5e6 * len(solid.faces) / 650_000
    with open_page(written(tmp_path, page_text)) as page:
        wait_until_drawn(page)
        assert page.evaluate("viewers[0].stats().triangles") == len(solid.faces)
