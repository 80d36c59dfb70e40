"""The studio as a person meets it: the real server, a real browser, files opened, changed, cut, saved and opened again."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from infill import write_sample
from tests.browsing import find_serious, open_page, pixels

pytest.importorskip("starlette", reason="the extra studio is not installed")
pytest.importorskip("uvicorn", reason="the extra studio is not installed")

EXACT = ".save-row a"  # there once the exact answer is
LONG = 300_000  # ms, for exact answers on a busy machine, with loops compiled for the first time
WIDTHS = (1280, 390)


@pytest.fixture(scope="module")
def studio() -> Iterator[str]:
    """Run the command; return the address that it prints."""
    command = [sys.executable, "-m", "infill", "studio", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout
        yield next(word for line in process.stdout for word in line.split() if word.startswith("http"))
        process.terminate()


@pytest.fixture(scope="module")
def samples(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Return small files of each kind."""
    folder = tmp_path_factory.mktemp("samples")
    files = {"part": folder / "cube.stl", "print": folder / "plate.gcode", "scan": folder / "bone.nrrd"}
    trimesh.creation.box((16.0, 14.0, 12.0)).export(files["part"])
    write_sample("print", files["print"])
    write_sample("scan", files["scan"])
    return files


@contextmanager
def open_view(studio: str, view: str, file: Path | None = None, **how: Any) -> Iterator[Any]:
    """Open a view of the studio in a browser, with a file."""
    with open_page(f"{studio}#{view}", **how) as page:
        page.wait_for_selector("nav a")
        if file is not None:
            choose_file(page, file)
        yield page


def choose_file(page: Any, file: Path) -> None:
    """Open a file, and wait until the view shows it."""
    page.locator("input[type=file]:not([tabindex='-1'])").first.set_input_files(file)
    page.wait_for_function("name => document.querySelector('.file-name strong')?.textContent === name", arg=file.name)


def wait_until_exact(page: Any) -> dict[str, str]:
    """Wait for the exact answer; return its numbers as they are shown."""
    page.wait_for_selector(EXACT, timeout=LONG)
    page.wait_for_selector(".cancel", state="hidden", timeout=LONG)  # the surface is shown, too
    return read_numbers(page)


def read_numbers(page: Any) -> dict[str, str]:
    """Return the numbers as they are shown, without those from before."""
    rows = page.locator(".numbers > div").all_inner_texts()
    return dict(row.split("\n")[:2] for row in rows)


def save(page: Any, words: str, folder: Path) -> Path:
    """Save a file by its link, and return it."""
    with page.expect_download(timeout=LONG) as waiting:
        page.get_by_role("link", name=words, exact=True).click()
    path = folder / waiting.value.suggested_filename
    waiting.value.save_as(path)
    return path


def number(text: str) -> float:
    """Return the number at the beginning of a text."""
    match = re.match(r"-?[\d,.]+", text)
    assert match, text
    return float(match[0].replace(",", ""))


def choose(page: Any, label: str, text: str) -> None:
    """Choose one of a row of choices."""
    page.locator("fieldset", has_text=label).locator("label", has_text=re.compile(f"^{text}$")).first.click()


# --- a part ------------------------------------------------------------------------------------------------------


@pytest.mark.longest
def test_a_part_is_filled_cut_saved_and_the_same_when_opened_again(
    studio: str, samples: dict[str, Path], tmp_path: Path
) -> None:
    with open_view(studio, "part", samples["part"]) as page:
        wait_until_exact(page)
        page.get_by_role("button", name="Pattern:").click()
        page.get_by_role("searchbox").fill("honeycomb hexagons")
        page.get_by_role("button", name="Honeycomb Hexagons").first.click()
        page.get_by_role("slider", name="Density", exact=True).fill("35")
        page.get_by_role("slider", name="Shell").fill("1")
        choose(page, "Cut open", "Z")
        page.get_by_role("slider", name="Place of the cut").fill("30")
        page.wait_for_function("!document.querySelector('.save-row a') || document.querySelector('.stale')")
        numbers = wait_until_exact(page)
        assert number(numbers["Density"]) == pytest.approx(35, abs=1)
        assert "pattern=honeycomb" in page.url
        assert "cut=z,0.5" in page.url
        file = save(page, "STL", tmp_path)
        assert trimesh.load(file).is_volume
        choose_file(page, file)
        size, contents = page.locator(".file-facts").inner_text().split("\n")
        assert size == "16 × 14 × 12 mm"
        assert contents == f"{numbers['Volume']} · {numbers['Triangles']} triangles"


@pytest.mark.longest
def test_a_link_restores_a_part_and_undo_leads_back(studio: str) -> None:
    link = "part?sample=part&pattern=grid&density=30%25&wall=2&cut=x,0.25"
    with open_view(studio, link) as page:
        page.wait_for_selector(".file-name strong:has-text('part.stl')")
        slider = page.get_by_role("slider", name="Shell")
        assert slider.input_value() == "2"
        assert page.locator(".pattern-title").inner_text().endswith("Grid")
        slider.fill("1.5")
        page.wait_for_url(re.compile("wall=1.5"))
        page.keyboard.press("Control+z")
        page.wait_for_url(re.compile("wall=2"))
        assert slider.input_value() == "2"
        page.keyboard.press("Control+Shift+z")
        page.wait_for_url(re.compile("wall=1.5"))


@pytest.mark.longest
def test_an_error_stands_at_its_control_and_goes(studio: str, samples: dict[str, Path]) -> None:
    with open_view(studio, "part", samples["part"]) as page:
        wait_until_exact(page)
        field = page.locator(".field", has=page.get_by_role("slider", name="Shell"))
        field.get_by_role("spinbutton").fill("50")
        field.get_by_role("spinbutton").press("Enter")
        message = field.get_by_role("alert")
        message.wait_for()
        assert "50" in message.inner_text()
        assert page.locator(EXACT).count() == 0
        field.get_by_role("button", name="auto").click()
        wait_until_exact(page)
        assert not message.is_visible()


@pytest.mark.longest
def test_an_exact_result_is_cancelled_by_keyboard_and_asked_for_again(studio: str) -> None:
    with open_view(studio, "part?sample=part&voxel=0.5") as page:
        page.get_by_role("button", name="Cancel", exact=True).focus(timeout=LONG)
        page.keyboard.press("Enter")
        again = page.get_by_role("button", name="Compute the exact result")
        again.wait_for()
        assert page.locator(".badge").inner_text() == "Preview"
        assert page.locator(".progress").is_hidden()
        assert read_numbers(page)["Density"].startswith("≈ ")
        assert "preview" in page.locator("dd[title]").first.get_attribute("title")
        page.wait_for_timeout(1000)  # in which nothing begins again
        assert again.evaluate("button => button === document.activeElement")
        assert page.locator(EXACT).count() == 0
        page.keyboard.press("Enter")
        page.get_by_role("button", name="Cancel", exact=True).wait_for()
        wait_until_exact(page)
        assert not read_numbers(page)["Density"].startswith("≈")


@pytest.mark.long
@pytest.mark.parametrize("name", ["broken.stl", "words.txt"])
def test_a_broken_file_is_one_clear_message_and_the_page_goes_on(
    studio: str, samples: dict[str, Path], tmp_path: Path, name: str
) -> None:
    broken = tmp_path / name
    broken.write_bytes(b"this is neither a mesh nor a print\n" * 5)
    with open_view(studio, "start") as page:
        page.locator("#first-file").set_input_files(broken)
        message = page.get_by_role("alert").filter(has_text=name)
        message.wait_for()
        choose_file(page, samples["part"])
        assert not message.is_visible()


# --- by keyboard, in light and dark, wide and narrow --------------------------------------------------------------


@pytest.mark.longest
def test_every_control_is_reached_and_named_by_keyboard(studio: str, samples: dict[str, Path]) -> None:
    with open_view(studio, "part", samples["part"]) as page:
        wait_until_exact(page)
        wanted = page.evaluate(FOCUSABLE)
        reached = []
        for _ in range(len(wanted) + 1):  # a link to skip the bar comes first
            page.keyboard.press("Tab")
            reached.append(page.evaluate("Number(document.activeElement.dataset.number)"))
        missing = [name for number, name in enumerate(wanted) if number not in reached]
        assert missing == []
        assert reached[1:] == sorted(reached[1:])


# Number what the keyboard should reach; a group of radio buttons is one stop.
FOCUSABLE = """() => {
  const all = [...document.querySelectorAll("a[href], button, input, select, summary, [tabindex='0']")].filter(
    (element) => element.getClientRects().length && !element.disabled && !element.closest("dialog:not([open])")
      && !element.closest("details:not([open]) > :not(summary)") && element.tabIndex >= 0 && !element.matches(".skip")
      && (element.type !== "radio" || element.checked));
  all.forEach((element, number) => (element.dataset.number = number));
  return all.map((element) => element.outerHTML.slice(0, 120));
}"""


@pytest.mark.longest
@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("width", WIDTHS)
def test_no_view_has_a_serious_fault_of_access_or_overflows(
    studio: str, samples: dict[str, Path], width: int, dark: bool
) -> None:
    faults: list[str] = []
    with open_view(studio, "start", width=width, dark=dark) as page:
        for view in ("start", "patterns", "part", "print", "scan", "block"):
            if view == "patterns":
                page.get_by_role("link", name="Patterns", exact=True).click()
            elif view == "block":
                page.get_by_role("link", name="Block", exact=True).click()
                page.wait_for_selector(".view[aria-label=Block] .numbers > div", timeout=LONG)
            elif view != "start":
                page.get_by_role("link", name=view.capitalize(), exact=True).click()
                choose_file(page, samples[view])
                page.wait_for_selector(".numbers > div", timeout=LONG)
            faults += [f"{view}: {fault}" for fault in find_serious(page)]
            if page.evaluate("document.documentElement.scrollWidth > innerWidth"):
                faults.append(f"{view}: wider than {width} pixels")
    assert faults == []


# --- a print -----------------------------------------------------------------------------------------------------


@pytest.mark.longest
def test_a_print_is_refilled_saved_and_the_same_when_opened_again(
    studio: str, samples: dict[str, Path], tmp_path: Path
) -> None:
    with open_view(studio, "print", samples["print"]) as page:
        page.wait_for_selector(".plot canvas")
        page.get_by_role("button", name="Pattern:").click()
        page.get_by_role("searchbox").fill("gyroid")
        page.get_by_role("button", name="Gyroid Alike").first.click()
        page.get_by_role("slider", name="Density", exact=True).fill("30")
        page.get_by_role("slider", name="Layer").fill("12")
        page.wait_for_url(re.compile("layer=12"))
        numbers = wait_until_exact(page)
        assert "density=30%25" in page.url
        assert "infill refill plate.gcode" in page.get_by_label("How to do this again").inner_text()
        changed = page.evaluate(DIFFERENT)
        assert changed > 0.02  # of the pixels: another pattern
        file = save(page, "G-code", tmp_path)
        choose_file(page, file)
        page.wait_for_selector(".features li")
        again = read_numbers(page)
    assert again["Time"] == numbers["Time of the print"]
    assert file.read_bytes() != samples["print"].read_bytes()


# Share of the pixels of the plots before and after that differ.
DIFFERENT = """() => {
  const [a, b] = [...document.querySelectorAll(".plot canvas")].map((canvas) =>
    canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data);
  let count = 0;
  for (let i = 0; i < Math.min(a.length, b.length); i += 4) count += a[i + 3] !== b[i + 3];
  return count / (a.length / 4);
}"""


@pytest.mark.longest
def test_layers_share_one_camera(studio: str, samples: dict[str, Path]) -> None:
    with open_view(studio, "print", samples["print"]) as page:
        wait_until_exact(page)
        before, after = page.locator(".plot").all()
        first = before.screenshot()
        after.focus()
        for key in ("+", "+", "ArrowLeft"):
            page.keyboard.press(key)
        page.wait_for_timeout(200)
        assert before.screenshot() != first
        page.keyboard.press("f")
        page.wait_for_timeout(200)
        assert before.screenshot() == first


# --- a scan ------------------------------------------------------------------------------------------------------


@pytest.mark.longest
def test_a_scan_is_smoothed_cut_saved_and_the_same_when_opened_again(
    studio: str, samples: dict[str, Path], tmp_path: Path
) -> None:
    with open_view(studio, "scan", samples["scan"]) as page:
        threshold = page.get_by_role("slider", name="Threshold", exact=True)
        threshold.fill("226")
        threshold.press("ArrowRight")
        page.get_by_role("slider", name="Smoothing").fill("15")
        choose(page, "Cut open", "Z")
        page.wait_for_url(re.compile("steps=15.*cut=z"))
        numbers = wait_until_exact(page)
        assert numbers["Verdict"] == "kept"
        assert numbers["Steps"] == "15"
        assert page.locator(".pair figure:visible").count() == 2
        file = save(page, "STL", tmp_path)
        choose_file(page, file)
        facts = page.locator(".file-facts").inner_text()
        assert facts.startswith(numbers["Triangles"])
    assert trimesh.load(file).volume == pytest.approx(number(numbers["Volume"]), rel=0.01)


@pytest.mark.longest
def test_the_threshold_is_dragged_on_the_histogram(studio: str, samples: dict[str, Path]) -> None:
    with open_view(studio, "scan", samples["scan"]) as page:
        picture = page.locator(".histogram svg")
        box = picture.bounding_box()
        assert box
        page.mouse.move(box["x"] + 0.3 * box["width"], box["y"] + 20)
        page.mouse.down()
        page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 20, steps=5)
        page.mouse.up()
        page.wait_for_url(re.compile("threshold="))
        least, most = (
            number(text) if text[0] != "-" else -number(text[1:])
            for text in page.locator(".axis span").all_inner_texts()
        )
        value = float(page.get_by_role("slider", name="Threshold", exact=True).input_value())
        assert value == pytest.approx((least + most) / 2, abs=0.02 * (most - least))


@pytest.mark.longest
def test_bone_is_one_click_in_a_ct(studio: str, tmp_path: Path) -> None:
    scan = tmp_path / "ct.npy"
    values = np.full((30, 30, 30), -1024, np.int16)
    values[4:26, 4:26, 4:26] = -40
    values[9:21, 9:21, 9:21] = 492  # 226 lies half-way
    np.save(scan, values)
    with open_view(studio, "scan", scan) as page:
        names = page.get_by_role("group", name="Thresholds of a CT")
        assert names.get_by_role("button", name="Otsu").get_attribute("aria-pressed") == "true"
        names.get_by_role("button", name="Bone 226").click()
        page.wait_for_url(re.compile("threshold=226"))
        assert names.get_by_role("button", name="Bone 226").get_attribute("aria-pressed") == "true"
        assert number(wait_until_exact(page)["Volume"]) == pytest.approx(12**3, rel=0.01)
        assert "--threshold 226" in page.get_by_label("How to do this again").inner_text()


@pytest.mark.longest
def test_what_is_lost_is_marked_where_it_was(studio: str, tmp_path: Path) -> None:
    scan = tmp_path / "spike.npy"
    values = np.full((40, 40, 30), -50, np.int16)
    values[5:35, 5:35, 5:15] = values[18:20, 18:20, 15:26] = 50  # a plate with a thin spike
    np.save(scan, values)
    with open_view(studio, "scan", scan) as page:
        choose(page, "Method", "Plain")
        page.get_by_role("button", name="Make it anyway").click()
        wait_until_exact(page)
        assert "allow_broken" in page.url
        assert "--allow-broken" in page.get_by_label("How to do this again").inner_text()
        switch = page.get_by_role("group", name="Marked places").get_by_label(re.compile("^Lost"))
        places = page.locator(".places td:first-child").all_inner_texts()
        tips = [np.fromstring(place.split(" at ")[1], sep=",") for place in places]
        assert min(np.abs(tip - (19, 19, 25.5)).max() for tip in tips) <= 1.5
        page.wait_for_timeout(1500)  # until the views are drawn in many pixels
        marked = count_red(page)
        page.get_by_role("button", name="Look at: Lost").first.click()
        assert count_red(page) > 0
        switch.uncheck()
        page.wait_for_timeout(300)
        assert count_red(page) < 0.2 * marked


@pytest.mark.longest
def test_a_piece_is_dropped_and_a_link_remembers_it(studio: str, tmp_path: Path) -> None:
    scan = tmp_path / "two.npy"
    values = np.full((40, 24, 24), -50, np.int16)
    values[4:20, 4:20, 4:20] = values[26:36, 8:18, 8:18] = 50
    np.save(scan, values)
    with open_view(studio, "scan", scan) as page:
        whole = number(wait_until_exact(page)["Volume"])
        pieces = page.get_by_role("group", name="2 pieces")
        assert [number(text) for text in pieces.locator(".piece-volume").all_inner_texts()] == [4096, 1000]
        pieces.get_by_label("Piece 2").uncheck()
        page.wait_for_url(re.compile("keep_components=%221%22"), wait_until="commit")
        page.wait_for_function("!document.querySelector('.save-row a') || document.querySelector('.stale')")
        assert number(wait_until_exact(page)["Volume"]) == pytest.approx(whole - 1000, rel=0.01)
        assert "--keep-components 1 " in page.get_by_label("How to do this again").inner_text()
        page.get_by_label("Piece 1").click()  # one has to stay
        assert page.get_by_label("Piece 1").is_checked()


@pytest.mark.longest
def test_a_density_that_changes_is_painted_with_a_legend(studio: str, samples: dict[str, Path]) -> None:
    with open_view(studio, "part?density=15%25:45%25&by=skin&cut=y,0.5", samples["part"]) as page:
        switch = page.get_by_label("Paint the density")
        switch.wait_for(timeout=LONG)
        wait_until_exact(page)
        ends = page.locator(".density-paint .legend").inner_text()
        assert [number(text) for text in re.findall(r"[\d.]+ %", ends)] == pytest.approx([15, 45], abs=1)
        page.wait_for_timeout(1500)  # until it is drawn in many pixels
        painted = count_blue(page)
        switch.uncheck()
        page.wait_for_timeout(300)
        assert count_blue(page) < 0.2 * painted


@pytest.mark.longest
def test_a_block_needs_no_file(studio: str, tmp_path: Path) -> None:
    with open_view(studio, "block?size=%2230x20%22") as page:
        numbers = wait_until_exact(page)
        file = save(page, "STL", tmp_path)
        assert trimesh.load(file).volume == pytest.approx(number(numbers["Volume"]), rel=0.01)
        assert page.get_by_label("How to do this again").inner_text().startswith("infill make honeycomb --size 30x20")
        page.get_by_role("slider", name="Height").fill("10")
        page.wait_for_url(re.compile("height=10"))
        page.wait_for_function("!document.querySelector('.save-row a') || document.querySelector('.stale')")
        assert number(wait_until_exact(page)["Volume"]) == pytest.approx(number(numbers["Volume"]) * 10 / 6, rel=0.01)


def count_blue(page: Any) -> int:
    """Count the pixels of the view that have the blue of a low density."""
    red, green, blue = np.moveaxis(pixels(page, ".viewer"), 2, 0)
    return int(((blue > red + 50) & (blue > green + 20)).sum())


def count_red(page: Any) -> int:
    """Count the pixels of the views that have the red of a mark."""
    red, green, blue = np.moveaxis(pixels(page, ".pair"), 2, 0)
    return int(((red > 180) & (green < 110) & (blue < 100)).sum())
