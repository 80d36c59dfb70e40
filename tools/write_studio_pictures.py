"""Write the pictures of docs/studio.md: the samples in the studio, as Debian's chromium shows them.

python tools/write_studio_pictures.py
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import sync_playwright

FOLDER = Path(__file__).resolve().parents[1] / "docs" / "pictures"
ARGUMENTS = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
COLOURS = 128  # of a picture, enough for a page of few colours
PATIENCE = 300_000  # ms
LINKS = {
    "part": "part?sample=part&density=15%25:35%25&by=z&cut=y,0.5&material=PETG",
    "print": "print?sample=print&pattern=gyroid&layer=15",
    "scan": "scan?sample=scan&threshold=226&cut=none,0.5",
}


def main() -> None:
    """Write all pictures."""
    command = [sys.executable, "-m", "infill", "studio", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process, sync_playwright() as playwright:
        assert process.stdout
        address = next(word for line in process.stdout for word in line.split() if word.startswith("http"))
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=list(ARGUMENTS))
        for name, link in LINKS.items():
            page = browser.new_page(
                viewport={"width": 1280, "height": 800}, color_scheme="dark" if name == "print" else "light"
            )
            page.goto(f"{address}#{link}")
            page.wait_for_selector(".save-row a", timeout=PATIENCE)
            page.wait_for_timeout(1500)
            write_small(page.screenshot, FOLDER / f"studio-{name}.png")
            page.close()
        browser.close()
        process.terminate()


def write_small(screenshot: Callable[[], Any], path: Path) -> None:
    """Write a screenshot with few colours."""
    with Image.open(BytesIO(screenshot())) as picture:
        picture.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE).save(path, optimize=True)


if __name__ == "__main__":
    main()
