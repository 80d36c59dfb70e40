"""A page in a real browser, headless, that may not complain and may ask nobody else for anything."""

from __future__ import annotations

import io
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

ARGUMENTS = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
PATIENCE = 30_000  # ms
# Chromium says so whenever a picture is read back from software rendering, which only tests do.
HARMLESS = ("GPU stall due to ReadPixels", "Automatic fallback to software WebGL")
AXE = Path(__file__).resolve().parents[1] / "page" / "node_modules" / "axe-core" / "axe.min.js"


@contextmanager
def open_page(
    url: str,
    *,
    width: int = 1280,
    height: int = 800,
    dark: bool = False,
    touch: bool = False,
    expected: tuple[str, ...] = (),
) -> Iterator[Any]:
    """Open a page; yield playwright's `Page`. Afterwards, nothing may have been complained of or asked of another host.

    Skipped without chromium or playwright. `expected` are parts of messages of the console that the test provokes.
    """
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.skip("no chromium here; run `make browsers`")
    api = pytest.importorskip("playwright.sync_api")
    complaints: list[str] = []
    requests: list[str] = []
    with api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=list(ARGUMENTS))
        context = browser.new_context(
            viewport={"width": width, "height": height},
            color_scheme="dark" if dark else "light",
            has_touch=touch,
            accept_downloads=True,
        )
        page = context.new_page()
        page.set_default_timeout(PATIENCE)
        page.on(
            "console", lambda message: complaints.append(message.text) if message.type in ("error", "warning") else 0
        )
        page.on("pageerror", lambda error: complaints.append(str(error)))
        context.on("request", lambda request: requests.append(request.url))
        page.goto(url)
        yield page
        browser.close()
    assert [text for text in complaints if not any(part in text for part in (*HARMLESS, *expected))] == []
    assert [request for request in requests if not is_own(request, url)] == []


def wait_until_drawn(page: Any) -> None:
    """Wait until a page of infill.viewer has drawn its data; in a frame, pass the frame."""
    page.wait_for_selector("html[data-ready]", state="attached")


def pixels(page: Any, selector: str = "body") -> NDArray[np.int64]:
    """Return what is seen of an element, (height, width, 3), from 0 to 255."""
    with Image.open(io.BytesIO(page.locator(selector).first.screenshot())) as picture:
        return np.asarray(picture.convert("RGB")).astype(np.int64)


def is_own(request: str, url: str) -> bool:
    """Tell whether a request stays with the page: data, or the host and port of the page; of a file, the file alone."""
    own, other = urlsplit(url), urlsplit(request)
    if other.scheme in ("data", "blob", "about"):
        return True
    return other.path == own.path if own.scheme == "file" else (other.scheme, other.netloc) == (own.scheme, own.netloc)


def find_serious(page: Any) -> list[str]:
    """Return what axe-core finds serious or critical on a page; skip where npm has not brought it."""
    if not AXE.is_file():
        pytest.skip("no axe-core here; run `make page`")
    page.evaluate(AXE.read_text(encoding="utf-8"))  # a script of its own could be forbidden by the page
    found = page.evaluate("async () => (await axe.run()).violations")
    return [
        f"{each['id']}: {each['nodes'][0]['html'][:200]}" for each in found if each["impact"] in ("serious", "critical")
    ]
