"""How fast the studio is for a person at a browser: ``python -m benchmarks.studio_speed``.

The command runs as a user's would, and Debian's chromium opens what it prints. Measured are: seconds until the server
answers, until the page paints, and from a move of the density slider until the viewer has drawn the new mesh of the
sample part, 60 mm long; and pictures a second while a large mesh turns.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from playwright.sync_api import Page, sync_playwright

from infill import Surface, save, write_sample

ARGUMENTS = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
UP, PAINT, PICTURE = 1.5, 1.5, 0.5  # s, what must hold
PATIENCE = 120_000  # ms
# Move the slider as a hand does, and resolve when the picture of it has been drawn.
MOVE = """async (value) => {
  const slider = document.querySelector(".density input[type=range]");
  const begin = performance.now();
  slider.value = value;
  slider.dispatchEvent(new Event("input", { bubbles: true }));
  const after = () => performance.getEntriesByName("picture").filter((mark) => mark.startTime > begin);
  while (!after().length) await new Promise((resolve) => setTimeout(resolve, 2));
  return (after()[0].startTime - begin) / 1000;
}"""
TURN = """async (count) => {
  const begin = performance.now();
  const view = document.querySelector("[role=application]");
  for (let i = 0; i < count; i += 1) {
    view.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  }
  return count / ((performance.now() - begin) / 1000);
}"""


@contextmanager
def serve() -> Iterator[tuple[str, float]]:
    """Run the studio; yield its address, and the seconds until it answered."""
    begin = time.perf_counter()
    command = [sys.executable, "-m", "infill", "studio", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout
        address = next(word for line in process.stdout for word in line.split() if word.startswith("http"))
        with urllib.request.urlopen(address) as answer:
            assert answer.status == 200
        yield address, time.perf_counter() - begin
        process.terminate()


def wave(count: int) -> Surface:
    """Return a closed mesh of about `count` triangles: a ball with waves on it."""
    columns = int(np.sqrt(count))
    rows = columns // 2
    polar, around = np.meshgrid(
        np.linspace(0, np.pi, rows + 2)[1:-1], np.arange(columns) / columns * 2 * np.pi, indexing="ij"
    )
    radius = 30 + np.sin(9 * polar) * np.cos(9 * around)
    ring = (
        np.stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)], -1)
        * radius[..., None]
    )
    vertices = np.concatenate([ring.reshape(-1, 3), [[0, 0, 30], [0, 0, -30]]])
    i, j = np.meshgrid(np.arange(rows - 1), np.arange(columns), indexing="ij")
    a, b = i * columns + j, i * columns + (j + 1) % columns
    sides = np.concatenate([np.stack([a, a + columns, b], -1), np.stack([b, a + columns, b + columns], -1)])
    first, last = np.arange(columns), (rows - 1) * columns + np.arange(columns)
    top = np.stack([np.full(columns, rows * columns), first, np.roll(first, -1)], -1)
    bottom = np.stack([np.full(columns, rows * columns + 1), np.roll(last, -1), last], -1)
    return Surface(vertices=vertices, faces=np.concatenate([sides.reshape(-1, 3), top, bottom]).astype(np.int64))


def open_part(page: Page, address: str, path: Path) -> None:
    """Open a part, and wait for its exact answer."""
    page.goto(f"{address}#part")
    page.locator("input[type=file]").first.set_input_files(path)
    page.wait_for_selector(".save-row a", timeout=PATIENCE)


def first_paint(page: Page) -> float:
    """Return the seconds from the navigation to the first paint with content."""
    entry = "performance.getEntriesByName('first-contentful-paint')[0]?.startTime"
    page.wait_for_function(f"() => {entry}")
    return float(page.evaluate(entry)) / 1000


def measure(count: int) -> dict[str, Any]:
    """Return all figures."""
    with tempfile.TemporaryDirectory() as folder, serve() as (address, up), sync_playwright() as playwright:
        part, large = Path(folder, "part.stl"), Path(folder, "large.ply")
        write_sample("part", part)
        save(wave(500_000), large)
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=list(ARGUMENTS))
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.goto(address)
        page.wait_for_selector(".drop-zone")
        paint = first_paint(page)
        open_part(page, address, part)
        page.evaluate(MOVE, "20")
        times = [float(page.evaluate(MOVE, str(12 + i % 24))) for i in range(count)]
        # On a page by itself, without the work that a file in the studio begins.
        alone = Path(folder, "large.html")
        subprocess.run([sys.executable, "-m", "infill", "view", str(large), "-o", str(alone)], check=True)
        page.goto(alone.as_uri())
        page.wait_for_selector("[role=application] canvas", timeout=PATIENCE)
        page.evaluate(TURN, 2)
        rate = float(page.evaluate(TURN, 10))
        browser.close()
    return {"up": up, "paint": paint, "times": times, "rate": rate}


def main() -> int:
    """Print the figures; return 1 if one of them is too large."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--moves", type=int, default=20, help="moves of the slider")
    figures = measure(parser.parse_args().moves)
    middle, slowest = statistics.median(figures["times"]), max(figures["times"])
    print(f"server answers after    {figures['up']:.2f} s   (at most {UP} s)")
    print(f"page paints after       {figures['paint']:.2f} s   (at most {PAINT} s)")
    print(
        f"slider to picture       {middle:.2f} s   median of {len(figures['times'])}, "
        f"slowest {slowest:.2f} s (at most {PICTURE} s)"
    )
    print(f"500,000 triangles turn  {figures['rate']:.1f} pictures a second, drawn by the processor")
    return int(figures["up"] > UP or figures["paint"] > PAINT or middle > PICTURE)


if __name__ == "__main__":
    sys.exit(main())
